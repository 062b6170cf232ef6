//! Formulas: expressions whose names are resolved and whose types are checked. A formula can be evaluated.

use std::borrow::Cow;

use super::near;
use super::property::Target;
use crate::lang::{Coolant, TextId, TextSet, VarId, VarSet};
use crate::span::Span;
use crate::syntax::{Arithmetic, Comparison};

/// A calculation or a condition.
#[derive(Clone, Debug, PartialEq)]
pub enum Formula {
    /// A number.
    Number(f64),
    /// A text.
    Text(String),
    /// The constant yes or no.
    Yes(bool),
    /// The value of a variable.
    Var(VarId),
    /// A text of the job.
    TextVar(TextId),
    /// True if the coolant includes this kind.
    Cools(Coolant),
    /// A property with a numeric value, by its row.
    Property(u16),
    /// A property with a text value, by its row.
    PropertyText(u16),
    /// True if the yes-or-no property is yes.
    PropertyHolds(u16),
    /// True if the variable has a value.
    Has(VarId),
    /// True if the variable is 1. The variable is always 1 or 0.
    True(VarId),
    /// True if the text is not empty.
    HasText(TextId),
    /// A number with reversed sign.
    Negative(Box<Formula>),
    /// An operation on two numbers. The span is the location of the second number.
    Arithmetic(Arithmetic, Box<[Formula; 2]>, Span),
    /// A function of numbers.
    Call(Function, Vec<Formula>),
    /// Comparison of two values.
    Compare(Comparison, Box<[Formula; 2]>),
    /// Comparison of a text with a pattern.
    Like(Box<Formula>, String),
    /// Negation of a condition.
    Not(Box<Formula>),
    /// True if both conditions are true.
    And(Box<[Formula; 2]>),
    /// True if at least one condition is true.
    Or(Box<[Formula; 2]>),
}

/// Functions of numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Function {
    /// Absolute value.
    Abs,
    /// Minimum.
    Min,
    /// Maximum.
    Max,
    /// The nearest whole number. Halves are rounded away from zero.
    Round,
    /// The next lower whole number.
    Floor,
    /// The next higher whole number.
    Ceil,
}

impl Function {
    /// All functions by their names.
    pub const ALL: [(&'static str, Function); 6] = [
        ("abs", Function::Abs),
        ("min", Function::Min),
        ("max", Function::Max),
        ("round", Function::Round),
        ("floor", Function::Floor),
        ("ceil", Function::Ceil),
    ];

    /// Finds a function by its name; upper and lower case are equal.
    pub fn parse(name: &str) -> Option<Function> {
        Function::ALL.iter().find(|(own, _)| own.eq_ignore_ascii_case(name)).map(|(_, function)| *function)
    }

    /// Whether the function takes several numbers.
    pub fn takes_several(self) -> bool {
        matches!(self, Function::Min | Function::Max)
    }

    fn of(self, values: &[f64]) -> f64 {
        let first = values.first().copied().unwrap_or_default();
        match self {
            Function::Abs => first.abs(),
            Function::Min => values.iter().copied().fold(first, f64::min),
            Function::Max => values.iter().copied().fold(first, f64::max),
            Function::Round => near::round(first),
            Function::Floor => near::floor(first),
            Function::Ceil => near::ceil(first),
        }
    }
}

/// The source of the values for a formula.
pub trait Values {
    /// The current value of a variable; `None` if the variable has no value.
    fn number(&self, var: VarId) -> Option<f64>;
    /// A text of the job; empty if the job does not have the text.
    fn text(&self, id: TextId) -> &str;
    /// The coolant that the job currently requests.
    fn coolant(&self) -> Coolant;
    /// A property as a number, by its row. Yes is 1.
    fn property(&self, row: u16) -> f64;
    /// A property as a text.
    fn property_text(&self, row: u16) -> &str;
}

/// A source without values. A formula that can be calculated without values is constant.
pub struct NoValues;

impl Values for NoValues {
    fn number(&self, _: VarId) -> Option<f64> {
        None
    }

    fn text(&self, _: TextId) -> &str {
        ""
    }

    fn coolant(&self) -> Coolant {
        Coolant::OFF
    }

    fn property(&self, _: u16) -> f64 {
        0.0
    }

    fn property_text(&self, _: u16) -> &str {
        ""
    }
}

/// Result of a formula.
#[derive(Clone, Debug, PartialEq)]
pub enum Value<'a> {
    /// A number.
    Number(f64),
    /// A text.
    Text(Cow<'a, str>),
    /// Yes or no.
    Yes(bool),
}

impl Value<'_> {
    /// The value with an owned copy of its text.
    pub fn into_owned(self) -> Value<'static> {
        match self {
            Value::Number(number) => Value::Number(number),
            Value::Text(text) => Value::Text(Cow::Owned(text.into_owned())),
            Value::Yes(yes) => Value::Yes(yes),
        }
    }
}

/// The reason why a formula has no result.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Without {
    /// A variable has no value.
    Value(VarId),
    /// A division by zero. The span is the location of the divisor.
    Divisor(Span),
}

impl Formula {
    /// Calculates the value.
    ///
    /// # Errors
    /// A variable has no value, or a divisor is zero.
    pub fn value<'a>(&'a self, values: &'a dyn Values) -> Result<Value<'a>, Without> {
        Ok(match self {
            Formula::Text(text) => Value::Text(Cow::Borrowed(text)),
            Formula::TextVar(id) => Value::Text(Cow::Borrowed(values.text(*id))),
            Formula::PropertyText(row) => Value::Text(Cow::Borrowed(values.property_text(*row))),
            Formula::Yes(_)
            | Formula::PropertyHolds(_)
            | Formula::Cools(_)
            | Formula::Has(_)
            | Formula::True(_)
            | Formula::HasText(_)
            | Formula::Compare(..)
            | Formula::Like(..)
            | Formula::Not(_)
            | Formula::And(_)
            | Formula::Or(_) => Value::Yes(self.holds(values)?),
            _ => Value::Number(self.number(values)?),
        })
    }

    /// Calculates a number.
    ///
    /// # Errors
    /// As [`Formula::value`].
    pub fn number(&self, values: &dyn Values) -> Result<f64, Without> {
        match self {
            Formula::Number(number) => Ok(*number),
            Formula::Property(row) => Ok(values.property(*row)),
            Formula::Var(var) => values.number(*var).ok_or(Without::Value(*var)),
            Formula::Negative(of) => Ok(-of.number(values)?),
            Formula::Arithmetic(operator, sides, span) => {
                let (left, right) = (sides[0].number(values)?, sides[1].number(values)?);
                match operator {
                    Arithmetic::Add => Ok(left + right),
                    Arithmetic::Subtract => Ok(left - right),
                    Arithmetic::Multiply => Ok(left * right),
                    Arithmetic::Divide if near::is_zero(right) => Err(Without::Divisor(*span)),
                    Arithmetic::Divide => Ok(left / right),
                }
            }
            Formula::Call(function, args) => {
                let args: Result<Vec<f64>, Without> = args.iter().map(|arg| arg.number(values)).collect();
                Ok(function.of(&args?))
            }
            // not reached, because sema checked the types
            _ => Ok(f64::from(u8::from(self.holds(values)?))),
        }
    }

    /// Evaluates a condition. A comparison is false if one of its variables has no value.
    ///
    /// # Errors
    /// A divisor is zero.
    pub fn holds(&self, values: &dyn Values) -> Result<bool, Without> {
        let without = |error| match error {
            Without::Value(_) => Ok(false),
            Without::Divisor(_) => Err(error),
        };
        match self {
            Formula::Yes(yes) => Ok(*yes),
            Formula::Cools(kind) => Ok(values.coolant().holds(*kind)),
            Formula::PropertyHolds(row) => Ok(values.property(*row) != 0.0),
            Formula::Has(var) => Ok(values.number(*var).is_some()),
            Formula::True(var) => Ok(values.number(*var).is_some_and(|value| value != 0.0)),
            Formula::HasText(id) => Ok(!values.text(*id).is_empty()),
            Formula::Compare(comparison, sides) => match (sides[0].value(values), sides[1].value(values)) {
                (Ok(left), Ok(right)) => Ok(holds(*comparison, &left, &right)),
                (Err(error), _) | (_, Err(error)) => without(error),
            },
            Formula::Like(text, pattern) => match text.value(values) {
                Ok(Value::Text(text)) => Ok(is_like(&text, pattern)),
                Ok(_) => Ok(false),
                Err(error) => without(error),
            },
            Formula::Not(of) => Ok(!of.holds(values)?),
            Formula::And(both) => Ok(both[0].holds(values)? && both[1].holds(values)?),
            Formula::Or(both) => Ok(both[0].holds(values)? || both[1].holds(values)?),
            // not reached, because sema checked the types
            _ => Ok(false),
        }
    }

    /// Calls `take` for the formula and then for each of its parts.
    pub fn each(&self, take: &mut dyn FnMut(&Formula)) {
        take(self);
        match self {
            Formula::Negative(of) | Formula::Not(of) | Formula::Like(of, _) => of.each(take),
            Formula::Arithmetic(_, both, _) | Formula::Compare(_, both) | Formula::And(both) | Formula::Or(both) => {
                both.iter().for_each(|side| side.each(take));
            }
            Formula::Call(_, args) => args.iter().for_each(|arg| arg.each(take)),
            _ => {}
        }
    }

    /// The variables in the formula.
    pub fn vars(&self) -> VarSet {
        let mut vars = VarSet::default();
        self.each(&mut |part| match part {
            Formula::Var(var) | Formula::Has(var) | Formula::True(var) => vars.insert(*var),
            Formula::Cools(_) => vars.insert(VarId::Cool),
            _ => {}
        });
        vars
    }

    /// Whether the formula uses the target of this `@set`.
    pub fn asks(&self, target: Target) -> bool {
        let mut asks = false;
        self.each(&mut |part| {
            asks |= match (part, target) {
                (Formula::Var(var) | Formula::Has(var) | Formula::True(var), Target::Var(own)) => *var == own,
                (
                    Formula::Property(row) | Formula::PropertyText(row) | Formula::PropertyHolds(row),
                    Target::Property(own),
                ) => *row == own,
                _ => false,
            };
        });
        asks
    }

    /// The texts in the formula.
    pub fn texts(&self) -> TextSet {
        let mut texts = TextSet::default();
        self.each(&mut |part| {
            if let Formula::TextVar(id) | Formula::HasText(id) = part {
                texts.insert(*id);
            }
        });
        texts
    }

    /// Whether the value is constant.
    pub fn is_constant(&self) -> bool {
        self.asks_only(&|_| false)
    }

    /// Whether the formula depends only on properties for which `known` is true.
    fn asks_only(&self, known: &dyn Fn(u16) -> bool) -> bool {
        let mut only = self.vars().is_empty() && self.texts() == TextSet::default();
        self.each(&mut |part| {
            if let Formula::Property(row) | Formula::PropertyText(row) | Formula::PropertyHolds(row) = part {
                only &= known(*row);
            }
        });
        only
    }

    /// Evaluates a condition if the known properties decide its result. `None`: the result depends on the job.
    pub fn decided(&self, values: &dyn Values, known: &dyn Fn(u16) -> bool) -> Option<bool> {
        let both = |both: &[Formula; 2]| both.each_ref().map(|side| side.decided(values, known));
        match self {
            Formula::Not(of) => of.decided(values, known).map(|holds| !holds),
            Formula::And(sides) => match both(sides) {
                [Some(false), _] | [_, Some(false)] => Some(false),
                [Some(true), other] | [other, Some(true)] => other,
                [None, None] => None,
            },
            Formula::Or(sides) => match both(sides) {
                [Some(true), _] | [_, Some(true)] => Some(true),
                [Some(false), other] | [other, Some(false)] => other,
                [None, None] => None,
            },
            _ if self.asks_only(known) => self.holds(values).ok(),
            _ => None,
        }
    }
}

/// Evaluates a comparison. Every comparison of values of different types is false, even `<>`.
fn holds(comparison: Comparison, left: &Value, right: &Value) -> bool {
    use std::cmp::Ordering::{Equal, Greater, Less};
    let order = match (left, right) {
        (Value::Number(left), Value::Number(right)) => near::order(*left, *right),
        (Value::Text(left), Value::Text(right)) => Some(left.cmp(right)),
        (Value::Yes(left), Value::Yes(right)) => Some(left.cmp(right)),
        _ => None,
    };
    let Some(order) = order else { return false };
    match comparison {
        Comparison::Equal => order == Equal,
        Comparison::Unequal => order != Equal,
        Comparison::Less => order == Less,
        Comparison::AtMost => order != Greater,
        Comparison::Greater => order == Greater,
        Comparison::AtLeast => order != Less,
    }
}

/// Whether a text matches a pattern. `*` matches any text, and `?` matches one character; upper and lower case are
/// equal.
fn is_like(text: &str, pattern: &str) -> bool {
    let text: Vec<char> = text.chars().flat_map(char::to_lowercase).collect();
    let pattern: Vec<char> = pattern.chars().flat_map(char::to_lowercase).collect();
    let (mut at, mut asked) = (0, 0);
    // the position of the last `*` in the pattern, and the end of its match in the text so far
    let mut star: Option<(usize, usize)> = None;
    while at < text.len() {
        match pattern.get(asked) {
            Some('*') => {
                star = Some((asked, at));
                asked += 1;
            }
            Some(&c) if c == '?' || c == text[at] => {
                at += 1;
                asked += 1;
            }
            _ => {
                let Some((before, covered)) = star else { return false };
                star = Some((before, covered + 1));
                (asked, at) = (before + 1, covered + 1);
            }
        }
    }
    pattern[asked..].iter().all(|&c| c == '*')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patterns_have_stars() {
        for pattern in ["DRILL 8", "drill*", "*8", "*ill*", "d?ill ?", "*", "**8", "d*i*8"] {
            assert!(is_like("Drill 8", pattern), "{pattern}");
        }
        for pattern in ["drill", "", "*9", "d?ll*", "?", "drill 8?"] {
            assert!(!is_like("Drill 8", pattern), "{pattern}");
        }
        assert!(is_like("", "") && is_like("", "*") && !is_like("", "?"));
        assert!(!is_like(&"a".repeat(5000), &format!("{}b", "a*".repeat(100))));
    }

    #[test]
    fn functions_round_half_away_from_zero() {
        let of = |name: &str, values: &[f64]| Function::parse(name).unwrap().of(values);
        assert_eq!([of("Round", &[-2.5]), of("floor", &[-2.5]), of("ceil", &[-2.5])], [-3.0, -3.0, -2.0]);
        assert_eq!([of("min", &[3.0, 1.0, 2.0]), of("max", &[3.0, 1.0]), of("abs", &[-1.0])], [1.0, 3.0, 1.0]);
    }
}
