//! Operators of expressions.

/// What makes one number of two.
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

/// How two values are compared.
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
    /// Two numbers make one; `-` stands before one, too.
    Arithmetic(Arithmetic),
    /// Two values are compared.
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
    /// As it is written.
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
