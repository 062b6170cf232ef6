//! Evaluates formulas of the languages: numbers, parameters, functions and brackets.

use super::cursor::Cursor;
use crate::diag::Code;
use crate::nc::fault::{Done, Fault, refuse};

/// Maximum nesting of brackets.
const DEEPEST: u32 = 64;

/// A function that returns the value of a name. `None`: the name is unknown.
pub type Values<'v> = dyn Fn(&str) -> Option<f64> + 'v;

/// How a language calculates formulas.
#[derive(Clone, Copy)]
pub struct Rules<'v> {
    /// The operators and functions of the language.
    pub words: &'static Vocabulary,
    /// The values of names.
    pub values: &'v Values<'v>,
    /// Two numbers are equal in a comparison if they differ by at most this part of their size.
    pub equal: f64,
}

/// The operators, functions and constants of a language.
pub struct Vocabulary {
    /// Binary operators by precedence. Operators of the same precedence are evaluated from left to right.
    operators: &'static [&'static [(&'static str, Operator)]],
    functions: [&'static [Function]; 2],
    constants: &'static [(&'static str, f64)],
    /// Whether the language has `NOT` and `ATAN2(y,x)`.
    not_and_atan2: bool,
    /// Whether the logical operators join the bits of numbers. They are then run only between truth values.
    joins_bits: bool,
}

/// Whether two numbers are equal in a comparison. `equal`: the greatest difference, as a part of their size.
pub fn is_equal(a: f64, b: f64, equal: f64) -> bool {
    (a - b).abs() <= equal * a.abs().max(b.abs())
}

const COMPARISONS: &[(&str, Operator)] = &[
    ("EQ", Operator::Equal),
    ("NE", Operator::Other),
    ("GE", Operator::GreaterOrEqual),
    ("LE", Operator::LessOrEqual),
    ("GT", Operator::Greater),
    ("LT", Operator::Less),
];

const SUMS: &[(&str, Operator)] = &[("+", Operator::Add), ("-", Operator::Subtract)];

/// The functions that all languages have. Angles are in degrees.
const COMMON: &[Function] = &[
    ("SIN", |x| x.to_radians().sin()),
    ("COS", |x| x.to_radians().cos()),
    ("TAN", |x| x.to_radians().tan()),
    ("ASIN", |x| x.asin().to_degrees()),
    ("ACOS", |x| x.acos().to_degrees()),
    ("ATAN", |x| x.atan().to_degrees()),
    ("SQRT", f64::sqrt),
    ("ABS", f64::abs),
    ("ROUND", f64::round),
];

/// Formulas of Siemens and Heidenhain controls.
pub const GENERAL: Vocabulary = Vocabulary {
    operators: &[
        &[("OR", Operator::Or)],
        &[("XOR", Operator::Xor)],
        &[("AND", Operator::And)],
        &[
            ("==", Operator::Equal),
            ("<>", Operator::Other),
            (">=", Operator::GreaterOrEqual),
            ("<=", Operator::LessOrEqual),
            (">", Operator::Greater),
            ("<", Operator::Less),
            ("EQ", Operator::Equal),
            ("NE", Operator::Other),
            ("GE", Operator::GreaterOrEqual),
            ("LE", Operator::LessOrEqual),
            ("GT", Operator::Greater),
            ("LT", Operator::Less),
        ],
        SUMS,
        &[
            ("*", Operator::Multiply),
            ("/", Operator::Divide),
            ("DIV", Operator::WholeDivide),
            ("MOD", Operator::Modulo),
        ],
        &[("^", Operator::Power)],
    ],
    functions: [
        COMMON,
        &[
            ("POT", |x| x * x),
            ("SQ", |x| x * x),
            ("TRUNC", f64::trunc),
            ("INT", f64::trunc),
            ("FRAC", f64::fract),
            ("LN", f64::ln),
            ("EXP", f64::exp),
        ],
    ],
    constants: &[("PI", std::f64::consts::PI), ("TRUE", 1.0), ("FALSE", 0.0)],
    not_and_atan2: true,
    joins_bits: false,
};

/// Formulas of Okuma OSP controls, from a public list of their operators and functions. The list does not define the
/// results of ATAN2, MOD, DROUND, DFIX, DFUP and NOT, so these are not run. The rank of the logical operators is not
/// public, so they share one level.
pub const OSP: Vocabulary = Vocabulary {
    operators: &[
        &[("OR", Operator::Or), ("EOR", Operator::Xor), ("AND", Operator::And)],
        COMPARISONS,
        SUMS,
        &[("*", Operator::Multiply), ("/", Operator::Divide)],
    ],
    functions: [COMMON, &[("FIX", f64::trunc), ("FUP", |x| x.abs().ceil().copysign(x))]],
    constants: &[],
    not_and_atan2: false,
    joins_bits: true,
};

#[derive(Clone, Copy, PartialEq)]
enum Operator {
    And,
    Or,
    Xor,
    Equal,
    Other,
    GreaterOrEqual,
    LessOrEqual,
    Greater,
    Less,
    Add,
    Subtract,
    Multiply,
    Divide,
    WholeDivide,
    Modulo,
    Power,
}

impl Operator {
    fn is_logical(self) -> bool {
        matches!(self, Operator::And | Operator::Or | Operator::Xor)
    }

    fn compares(self) -> bool {
        use Operator as O;
        matches!(self, O::Equal | O::Other | O::GreaterOrEqual | O::LessOrEqual | O::Greater | O::Less)
    }

    /// The result for two numbers. `equal`: whether the numbers are equal in a comparison.
    fn apply(self, a: f64, b: f64, equal: bool) -> f64 {
        let truth = |is: bool| f64::from(u8::from(is));
        match self {
            Operator::And => truth(a != 0.0 && b != 0.0),
            Operator::Or => truth(a != 0.0 || b != 0.0),
            Operator::Xor => truth((a != 0.0) != (b != 0.0)),
            Operator::Equal => truth(equal),
            Operator::Other => truth(!equal),
            Operator::GreaterOrEqual => truth(a > b || equal),
            Operator::LessOrEqual => truth(a < b || equal),
            Operator::Greater => truth(a > b && !equal),
            Operator::Less => truth(a < b && !equal),
            Operator::Add => a + b,
            Operator::Subtract => a - b,
            Operator::Multiply => a * b,
            Operator::Divide => a / b,
            Operator::WholeDivide => (a / b).trunc(),
            Operator::Modulo => a % b,
            Operator::Power => a.powf(b),
        }
    }

    /// Compares or calculates by the rules of a language. `text` is the operator as written.
    fn of(self, text: &str, a: f64, b: f64, rules: Rules<'_>) -> Done<f64> {
        let is_truth = |value: f64| value == 0.0 || value == 1.0;
        if rules.words.joins_bits && self.is_logical() && !(is_truth(a) && is_truth(b)) {
            let help = "write a comparison in brackets on each side, or the result as a number";
            return refuse(
                Code::PN016,
                format!("{a} {text} {b} joins the bits of the numbers: it is not simulated"),
                help,
            );
        }
        let equal = is_equal(a, b, rules.equal);
        // whether > and < take the small difference for 0 depends on the machine data 10280 of a Siemens control
        if equal && a != b && matches!(self, Operator::Greater | Operator::Less) {
            let help = "compare by >= or <=, or round the values before the comparison";
            return refuse(Code::PN014, format!("{a} and {b} differ only by rounding errors"), help);
        }
        Ok(self.apply(a, b, equal))
    }
}

/// A function of one argument: its name, and the function itself.
type Function = (&'static str, fn(f64) -> f64);

/// Reads a formula and calculates its value.
///
/// # Errors
/// The formula can't be read, the value of a name is unknown, or the result is not finite.
pub fn formula(cursor: &mut Cursor<'_>, rules: Rules<'_>) -> Done<f64> {
    let begin = cursor.at();
    let value = binary(cursor, rules, 0, 0)?;
    if value.is_finite() {
        return Ok(value);
    }
    let message = format!("the result is {value}, not a number");
    Err(Fault::at(Code::PN014, begin, message, "check for a division by zero, or a root of a negative number"))
}

fn binary(cursor: &mut Cursor<'_>, rules: Rules<'_>, strength: usize, depth: u32) -> Done<f64> {
    Ok(compared(cursor, rules, strength, depth)?.0)
}

/// The value of a part of a formula, and whether the part compares values without brackets around it. The precedence of
/// comparisons and logical operators differs between the controls. A formula that joins comparisons with logical
/// operators therefore needs brackets around each comparison. A formula with several logical operators of one level
/// needs brackets, too.
fn compared(cursor: &mut Cursor<'_>, rules: Rules<'_>, strength: usize, depth: u32) -> Done<(f64, bool)> {
    let Some(operators) = rules.words.operators.get(strength) else {
        return Ok((unary(cursor, rules, depth)?, false));
    };
    let (mut value, mut compares) = compared(cursor, rules, strength + 1, depth)?;
    let mut before = None;
    loop {
        let at = cursor.at();
        let Some(&(text, operator)) = operators.iter().find(|(text, _)| takes_operator(cursor, text)) else {
            return Ok((value, compares));
        };
        let (other, also) = compared(cursor, rules, strength + 1, depth)?;
        if operator.is_logical() {
            let beside = match before.replace(text) {
                Some(before) if before != text => Some(before),
                _ => (compares || also).then_some("a comparison"),
            };
            if let Some(beside) = beside {
                let message = format!("{text} and {beside} in one formula without brackets");
                let help = "put each comparison into brackets: `(R1==5) AND (R2==7)`";
                return Err(Fault::at(Code::PN014, at, message, help));
            }
        }
        compares |= operator.compares();
        value = operator.of(text, value, other, rules)?;
    }
}

/// Takes an operator if it comes next. An operator of letters must be a whole word.
fn takes_operator(cursor: &mut Cursor<'_>, text: &str) -> bool {
    let is_word = text.as_bytes()[0].is_ascii_alphabetic();
    if is_word { cursor.takes_word(text) } else { cursor.takes(text.as_bytes()) }
}

fn unary(cursor: &mut Cursor<'_>, rules: Rules<'_>, depth: u32) -> Done<f64> {
    if depth > DEEPEST {
        let message = format!("brackets and signs more than {DEEPEST} deep");
        return Err(Fault::at(Code::PN014, cursor.at(), message, "calculate the value in several blocks"));
    }
    if cursor.takes(b"-") {
        return Ok(-unary(cursor, rules, depth + 1)?);
    }
    if cursor.takes(b"+") {
        return unary(cursor, rules, depth + 1);
    }
    for (open, close) in [(b"(", b")"), (b"[", b"]")] {
        if cursor.takes(open) {
            let value = binary(cursor, rules, 0, depth + 1)?;
            cursor.needs(close)?;
            return Ok(value);
        }
    }
    if let Some(value) = cursor.unsigned() {
        return Ok(value);
    }
    let begin = cursor.at();
    let Some(name) = cursor.name() else { return Err(cursor.unreadable()) };
    named(cursor, rules, &String::from_utf8_lossy(name).to_ascii_uppercase(), begin, depth)
}

/// The value of a name that is a constant, a function or a variable. The name begins at column `begin`.
fn named(cursor: &mut Cursor<'_>, rules: Rules<'_>, name: &str, begin: usize, depth: u32) -> Done<f64> {
    let words = rules.words;
    match name {
        "NOT" if words.not_and_atan2 => return Ok(f64::from(u8::from(unary(cursor, rules, depth + 1)? == 0.0))),
        "ATAN2" if words.not_and_atan2 => {
            cursor.needs(b"(")?;
            let y = binary(cursor, rules, 0, depth + 1)?;
            cursor.needs(b",")?;
            let x = binary(cursor, rules, 0, depth + 1)?;
            cursor.needs(b")")?;
            return Ok(y.atan2(x).to_degrees());
        }
        _ => {}
    }
    if let Some((_, value)) = words.constants.iter().find(|(constant, _)| *constant == name) {
        return Ok(*value);
    }
    if let Some((_, function)) = words.functions.into_iter().flatten().find(|(function, _)| *function == name) {
        return Ok(function(unary(cursor, rules, depth + 1)?));
    }
    if let Some(value) = (rules.values)(name) {
        return Ok(value);
    }
    let (message, help) = match cursor.peek() {
        Some(b'(' | b'[') => (
            format!("`{name}` with a value in brackets is not simulated"),
            "calculate the value before, and write the result as a number",
        ),
        _ => (
            format!("the value of `{name}` is unknown"),
            "set the variable earlier in the program: its value in the machine is unknown",
        ),
    };
    Err(Fault::at(Code::PN016, begin, message, help))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formulas_are_calculated() {
        let values = |name: &str| (name == "R1").then_some(4.0);
        let rules = Rules { words: &GENERAL, values: &values, equal: 0.0 };
        for (text, result) in [
            ("1+2*3", 7.0),
            ("(1+2)*3", 9.0),
            ("-R1^2", 16.0),
            ("10-4-3", 3.0),
            ("SQRT(R1)+ABS(-2)", 4.0),
            ("COS 60", 0.5),
            ("ATAN2(1,0)", 90.0),
            ("7 DIV 2 + 7 MOD 2", 4.0),
            ("(R1 > 3) AND NOT (R1 == 5)", 1.0),
            ("[R1 LT 3]", 0.0),
        ] {
            let value = formula(&mut Cursor::new(text.as_bytes(), 0), rules).unwrap();
            assert!((value - result).abs() < 1e-12, "{text} = {value}");
        }
        for text in
            ["1/0", "R1 > 3 AND NOT (R1 == 5)", "R2", "1+", "(1", "SQRT(-1)", &"(".repeat(500), &"-".repeat(500)]
        {
            assert!(formula(&mut Cursor::new(text.as_bytes(), 0), rules).is_err(), "{text}");
        }
    }
}
