//! The macro languages of controls: which operators and functions an expression may have, and what they calculate.

use super::fault::{Done, refuse};
use crate::control::{Control, Macros};
use crate::diag::Code;

/// A macro language.
#[derive(Debug)]
pub struct Language {
    operators: [&'static [Operator]; 2],
    functions: [&'static [(&'static str, Function)]; 2],
    /// Whether the language is the one of LinuxCNC: parameters have names, `#` and signs may be repeated, an assignment
    /// may be beside words, and the value of an assignment is a single value. On other controls, the value of an
    /// assignment is an expression without brackets, and nothing else is in its block.
    pub is_linuxcnc: bool,
}

/// An operator between two values.
#[derive(Debug)]
pub struct Operator {
    /// The operator as written.
    pub name: &'static str,
    /// Operators of a higher rank are evaluated first. Operators of one rank are evaluated from left to right.
    pub rank: u8,
    /// Whether the rank is not public. The operator may not be beside another operator without brackets.
    pub alone: bool,
    /// Calculates the result.
    pub apply: fn(f64, f64) -> Done<f64>,
}

/// A function of an expression.
#[derive(Clone, Copy, Debug)]
pub enum Function {
    /// A function of the value in its brackets.
    Of(fn(f64) -> Done<f64>),
    /// ATAN, which may have a second value: `ATAN[1]/[2]`.
    Ratio(fn(f64, Option<f64>) -> Done<f64>),
    /// ROUND. In the value of a word, some controls round to the least increment of the word.
    Round,
}

impl Language {
    /// The macro language of a control.
    pub fn of(control: &Control) -> &'static Language {
        match control.traits().macros {
            Macros::Linuxcnc => &LINUXCNC,
            Macros::Fanuc => &FANUC,
            Macros::Haas => &HAAS,
        }
    }

    /// The operator with this name.
    pub fn operator(&self, name: &[u8]) -> Option<&'static Operator> {
        self.operators.into_iter().flatten().find(|operator| operator.name.as_bytes().eq_ignore_ascii_case(name))
    }

    /// The function with this name, in upper case.
    pub fn function(&self, name: &str) -> Option<Function> {
        self.functions.into_iter().flatten().find(|(known, _)| *known == name).map(|(_, function)| *function)
    }

    /// The names of the functions, in alphabetical order.
    pub fn names(&self) -> String {
        let mut names: Vec<&str> = self.functions.into_iter().flatten().map(|(name, _)| *name).collect();
        names.sort_unstable();
        names.join(" ")
    }
}

const fn operator(name: &'static str, rank: u8, apply: fn(f64, f64) -> Done<f64>) -> Operator {
    Operator { name, rank, alone: false, apply }
}

/// An operator whose rank is not public.
const fn alone(name: &'static str, apply: fn(f64, f64) -> Done<f64>) -> Operator {
    Operator { name, rank: 0, alone: true, apply }
}

/// The operators that all languages have.
const ARITHMETIC: &[Operator] = &[
    operator("+", 2, |left, right| Ok(left + right)),
    operator("-", 2, |left, right| Ok(left - right)),
    operator("*", 3, |left, right| Ok(left * right)),
    operator("/", 3, quotient),
];

/// The functions that all languages have.
const COMMON: &[(&str, Function)] = &[
    ("ABS", Function::Of(|x| Ok(x.abs()))),
    ("ACOS", Function::Of(|x| Ok(x.acos().to_degrees()))),
    ("COS", Function::Of(|x| Ok(x.to_radians().cos()))),
    ("SIN", Function::Of(|x| Ok(x.to_radians().sin()))),
    ("SQRT", Function::Of(|x| Ok(x.sqrt()))),
    ("TAN", Function::Of(|x| Ok(x.to_radians().tan()))),
];

static LINUXCNC: Language = Language {
    operators: [
        ARITHMETIC,
        &[
            operator("AND", 0, |left, right| truth(left != 0.0 && right != 0.0)),
            operator("OR", 0, |left, right| truth(left != 0.0 || right != 0.0)),
            operator("XOR", 0, |left, right| truth((left != 0.0) != (right != 0.0))),
            // values that differ by less than 0.0001 are equal
            operator("EQ", 1, |left, right| truth((left - right).abs() < 1e-4)),
            operator("NE", 1, |left, right| truth((left - right).abs() >= 1e-4)),
            operator("GT", 1, |left, right| truth(left > right)),
            operator("GE", 1, |left, right| truth(left >= right)),
            operator("LT", 1, |left, right| truth(left < right)),
            operator("LE", 1, |left, right| truth(left <= right)),
            operator("MOD", 3, |left, right| divisor(right).map(|right| left.rem_euclid(right.abs()))),
            operator("**", 4, power),
        ],
    ],
    functions: [
        COMMON,
        &[
            ("ASIN", Function::Of(|x| Ok(x.asin().to_degrees()))),
            ("ATAN", Function::Ratio(|y, x| ratio(y, x).map(|(y, x)| y.atan2(x).to_degrees()))),
            ("EXP", Function::Of(|x| Ok(x.exp()))),
            ("FIX", Function::Of(|x| Ok(x.floor()))),
            ("FUP", Function::Of(|x| Ok(x.ceil()))),
            ("LN", Function::Of(|x| Ok(x.ln()))),
            ("ROUND", Function::Of(|x| Ok(x.round()))),
        ],
    ],
    is_linuxcnc: true,
};

/// The operator's manuals of the 0i and 30i: comparisons are only in conditions.
static FANUC: Language = Language {
    operators: [ARITHMETIC, &[alone("AND", and), alone("OR", or), alone("XOR", xor), operator("MOD", 3, remainder)]],
    functions: [
        COMMON,
        &[
            ("ASIN", Function::Of(|x| positive("ASIN", x.asin().to_degrees()))),
            ("ATAN", Function::Ratio(|y, x| ratio(y, x).and_then(|(y, x)| positive("ATAN", y.atan2(x).to_degrees())))),
            ("EXP", Function::Of(|x| Ok(x.exp()))),
            ("FIX", Function::Of(|x| Ok(x.trunc()))),
            ("FUP", Function::Of(|x| Ok(x.abs().ceil().copysign(x)))),
            ("LN", Function::Of(|x| Ok(x.ln()))),
            ("ROUND", Function::Round),
        ],
    ],
    is_linuxcnc: false,
};

/// The operator's manual of the mills (2017), chapter 6.14: comparisons are also in expressions, and ATAN has one value.
static HAAS: Language = Language {
    operators: [
        ARITHMETIC,
        &[
            alone("AND", and),
            alone("OR", or),
            alone("XOR", xor),
            alone("EQ", |left, right| truth(left == right)),
            alone("NE", |left, right| truth(left != right)),
            alone("GT", |left, right| truth(left > right)),
            alone("GE", |left, right| truth(left >= right)),
            alone("LT", |left, right| truth(left < right)),
            alone("LE", |left, right| truth(left <= right)),
            operator("MOD", 3, remainder),
        ],
    ],
    functions: [
        COMMON,
        &[
            ("ASIN", Function::Of(|x| positive("ASIN", x.asin().to_degrees()))),
            ("ATAN", Function::Ratio(arctangent)),
            ("FIX", Function::Of(|x| Ok(x.trunc()))),
            ("ROUND", Function::Round),
        ],
    ],
    is_linuxcnc: false,
};

fn truth(is_so: bool) -> Done<f64> {
    Ok(f64::from(u8::from(is_so)))
}

fn divisor(value: f64) -> Done<f64> {
    if value == 0.0 { refuse(Code::PN014, "a division by zero", "check the divisor") } else { Ok(value) }
}

fn quotient(left: f64, right: f64) -> Done<f64> {
    divisor(right).map(|right| left / right)
}

fn power(left: f64, right: f64) -> Done<f64> {
    if left < 0.0 && right.fract() != 0.0 {
        return refuse(Code::PN014, "a negative number with a fractional exponent", "check the exponent");
    }
    Ok(left.powf(right))
}

fn and(left: f64, right: f64) -> Done<f64> {
    bits(left, right, |left, right| left & right)
}

fn or(left: f64, right: f64) -> Done<f64> {
    bits(left, right, |left, right| left | right)
}

fn xor(left: f64, right: f64) -> Done<f64> {
    bits(left, right, |left, right| left ^ right)
}

/// Joins two values bit by bit. The result for a fraction or a negative number is not public.
fn bits(left: f64, right: f64, join: fn(u32, u32) -> u32) -> Done<f64> {
    match (whole(left), whole(right)) {
        (Some(left), Some(right)) => Ok(f64::from(join(left, right))),
        _ => refuse(
            Code::PN016,
            format!("AND, OR or XOR of {left} and {right}, which is known only for whole numbers from 0 on"),
            "write the result as a number",
        ),
    }
}

/// The remainder of a division. The result for a fraction or a negative number is not public.
fn remainder(left: f64, right: f64) -> Done<f64> {
    match (whole(left), whole(divisor(right)?)) {
        (Some(left), Some(right)) => Ok(f64::from(left % right)),
        _ => refuse(
            Code::PN016,
            format!("{left} MOD {right}, which is known only for whole numbers from 0 on"),
            "write the result as a number",
        ),
    }
}

fn whole(value: f64) -> Option<u32> {
    (value.fract() == 0.0 && (0.0..=f64::from(i32::MAX)).contains(&value)).then_some(value as u32)
}

/// An angle that does not depend on the range of angles that a parameter selects: 0 to 360, or also negative angles.
fn positive(name: &str, angle: f64) -> Done<f64> {
    if angle >= 0.0 || angle.is_nan() {
        return Ok(angle);
    }
    let message =
        format!("{name} gives {angle:.3} or {:.3} degrees: a parameter of the control decides", angle + 360.0);
    refuse(Code::PN016, message, "write the angle as a number")
}

/// The two values of ATAN.
fn ratio(y: f64, x: Option<f64>) -> Done<(f64, f64)> {
    match x {
        Some(x) => Ok((y, x)),
        None => refuse(Code::PN014, "ATAN without its second value", "write ATAN[1]/[2]"),
    }
}

fn arctangent(value: f64, second: Option<f64>) -> Done<f64> {
    match second {
        None => positive("ATAN", value.atan().to_degrees()),
        Some(_) => refuse(
            Code::PN016,
            "`/` after ATAN: the ATAN of this control has one value, so that this may be a division",
            "write ATAN[1/2], or [ATAN[1]]/2 for a division",
        ),
    }
}
