//! Operators of expressions.

/// Operators on two numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Arithmetic {
    /// `+`.
    Add,
    /// `-`.
    Subtract,
    /// `*`.
    Multiply,
    /// `/`.
    Divide,
}

/// Comparisons of two values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Comparison {
    /// `=`.
    Equal,
    /// `<>`.
    Unequal,
    /// `<`.
    Less,
    /// `<=`.
    AtMost,
    /// `>`.
    Greater,
    /// `>=`.
    AtLeast,
}

/// All operators.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operator {
    /// An operation on two numbers. `-` also reverses the sign of one number.
    Arithmetic(Arithmetic),
    /// A comparison of two values.
    Comparison(Comparison),
    /// `like`.
    Like,
    /// `and`.
    And,
    /// `or`.
    Or,
    /// `not`.
    Not,
}

impl Operator {
    /// The operator as it is written.
    pub fn name(self) -> &'static str {
        match self {
            Operator::Arithmetic(Arithmetic::Add) => "+",
            Operator::Arithmetic(Arithmetic::Subtract) => "-",
            Operator::Arithmetic(Arithmetic::Multiply) => "*",
            Operator::Arithmetic(Arithmetic::Divide) => "/",
            Operator::Comparison(Comparison::Equal) => "=",
            Operator::Comparison(Comparison::Unequal) => "<>",
            Operator::Comparison(Comparison::Less) => "<",
            Operator::Comparison(Comparison::AtMost) => "<=",
            Operator::Comparison(Comparison::Greater) => ">",
            Operator::Comparison(Comparison::AtLeast) => ">=",
            Operator::Like => "like",
            Operator::And => "and",
            Operator::Or => "or",
            Operator::Not => "not",
        }
    }
}
