//! Evaluates expressions in words: `[#1 * 2 + SIN[30]]`.

use super::fault::{Done, Fault, quoted, refuse};
use super::parameters::{Parameters, Target};
use super::scan::{Kind, Token, Tokens};
use crate::diag::Code;

/// Maximum nesting of brackets.
const DEEPEST: u32 = 64;

/// The tokens of a line, without spaces. The reader always holds the next token.
pub struct Reader<'a> {
    line: &'a [u8],
    tokens: Tokens<'a>,
    ahead: Option<Token>,
    depth: u32,
}

/// Operators by precedence. Operators of the same precedence are evaluated from left to right.
const OPERATORS: [&[&str]; 5] =
    [&["AND", "OR", "XOR"], &["EQ", "NE", "GT", "GE", "LT", "LE"], &["+", "-"], &["*", "/", "MOD"], &["**"]];

impl<'a> Reader<'a> {
    /// A reader that begins at the next token of `tokens`.
    pub fn new(line: &'a [u8], tokens: Tokens<'a>) -> Reader<'a> {
        let mut reader = Reader { line, tokens, ahead: None, depth: 0 };
        reader.ahead = reader.pull();
        reader
    }

    fn pull(&mut self) -> Option<Token> {
        self.tokens.find(|token| token.kind != Kind::Blank)
    }

    /// Returns the next token without taking it.
    pub fn peek(&self) -> Option<Token> {
        self.ahead
    }

    /// Takes the next token.
    pub fn next(&mut self) -> Option<Token> {
        let token = self.ahead;
        self.ahead = self.pull();
        token
    }

    /// Takes the next token if it is this symbol.
    pub fn takes(&mut self, symbol: u8) -> bool {
        let is_next = self.ahead.is_some_and(|token| token.kind == Kind::Symbol(symbol));
        if is_next {
            self.next();
        }
        is_next
    }

    /// The text of a token.
    pub fn text(&self, token: Token) -> &'a [u8] {
        &self.line[token.start..token.end]
    }

    fn unexpected<T>(&self, what: &str) -> Done<T> {
        let help = "a value is a number, #1, [..] or a function like SIN[..]";
        match self.ahead {
            Some(token) if token.kind != Kind::LineEnd => {
                let text = quoted(self.line, token.start, token.end);
                Err(Fault::at(Code::PN014, token.start, format!("{what} instead of `{text}`"), help))
            }
            _ => Err(Fault::at(Code::PN014, self.line.len(), format!("the block ends, but {what} is missing"), help)),
        }
    }

    /// Reads a value with its signs: a number, a parameter, an expression in brackets, or a function.
    ///
    /// # Errors
    /// The value is missing or not defined, such as the result of a division by zero.
    pub fn value(&mut self, parameters: &Parameters) -> Done<f64> {
        self.depth += 1;
        if self.depth > DEEPEST {
            return refuse(
                Code::PN014,
                format!("brackets more than {DEEPEST} deep"),
                "write the expression in several blocks",
            );
        }
        let value = self.plain_value(parameters);
        self.depth -= 1;
        let value = value?;
        if !value.is_finite() {
            return refuse(
                Code::PN014,
                "the expression has no finite result",
                "check the division or the function in the expression",
            );
        }
        Ok(value)
    }

    fn plain_value(&mut self, parameters: &Parameters) -> Done<f64> {
        if self.takes(b'-') {
            return Ok(-self.value(parameters)?);
        }
        if self.takes(b'+') {
            return self.value(parameters);
        }
        if self.takes(b'#') {
            return match self.target(parameters)? {
                Target::Number(number) => parameters.get(number),
                Target::Name(name) => parameters.named(&name),
            };
        }
        match self.ahead.map(|token| token.kind) {
            Some(Kind::Number(number)) => {
                self.next();
                Ok(number.value)
            }
            Some(Kind::Symbol(b'[')) => self.bracketed(parameters),
            Some(Kind::Name) => self.function(parameters),
            _ => self.unexpected("a value"),
        }
    }

    /// Reads the parameter after `#`, to which a value is assigned.
    ///
    /// # Errors
    /// There is no parameter.
    pub fn target(&mut self, parameters: &Parameters) -> Done<Target> {
        if let Some(token) = self.ahead.filter(|token| token.kind == Kind::Quoted) {
            self.next();
            let text = String::from_utf8_lossy(&self.line[token.start + 1..token.end - 1]);
            return Ok(Target::Name(text.split_whitespace().collect::<String>().to_ascii_lowercase()));
        }
        Ok(Target::Number(Parameters::number(self.value(parameters)?)?))
    }

    /// Reads an expression in brackets, `[..]`.
    ///
    /// # Errors
    /// The bracket is not closed, or its content is not an expression.
    pub fn bracketed(&mut self, parameters: &Parameters) -> Done<f64> {
        if !self.takes(b'[') {
            return self.unexpected("`[`");
        }
        let value = self.operation(parameters, 0)?;
        if !self.takes(b']') {
            return self.unexpected("`]` or an operator");
        }
        Ok(value)
    }

    /// Reads values that are joined by operators of precedence `strength` or higher.
    fn operation(&mut self, parameters: &Parameters, strength: usize) -> Done<f64> {
        if strength == OPERATORS.len() {
            return self.value(parameters);
        }
        let mut left = self.operation(parameters, strength + 1)?;
        while let Some(operator) = self.operator(strength) {
            let right = self.operation(parameters, strength + 1)?;
            left = apply(operator, left, right)?;
        }
        Ok(left)
    }

    fn operator(&mut self, strength: usize) -> Option<&'static str> {
        let token = self.ahead.filter(|token| matches!(token.kind, Kind::Symbol(_) | Kind::Name))?;
        let text = self.text(token);
        let operator = OPERATORS[strength].iter().find(|o| o.as_bytes().eq_ignore_ascii_case(text))?;
        self.next();
        Some(operator)
    }

    fn function(&mut self, parameters: &Parameters) -> Done<f64> {
        let Some(token) = self.next() else { return self.unexpected("a function") };
        let name = String::from_utf8_lossy(self.text(token)).to_ascii_uppercase();
        let x = self.bracketed(parameters)?;
        Ok(match name.as_str() {
            "ABS" => x.abs(),
            "ACOS" => x.acos().to_degrees(),
            "ASIN" => x.asin().to_degrees(),
            "ATAN" => {
                if !self.takes(b'/') {
                    return self.unexpected("`/` of ATAN[..]/[..]");
                }
                x.atan2(self.bracketed(parameters)?).to_degrees()
            }
            "COS" => x.to_radians().cos(),
            "EXP" => x.exp(),
            "FIX" => x.floor(),
            "FUP" => x.ceil(),
            "LN" => x.ln(),
            "ROUND" => x.round(),
            "SIN" => x.to_radians().sin(),
            "SQRT" => x.sqrt(),
            "TAN" => x.to_radians().tan(),
            _ => {
                let help = "functions are ABS ACOS ASIN ATAN COS EXP FIX FUP LN ROUND SIN SQRT TAN";
                return Err(Fault::at(Code::PN014, token.start, format!("there is no function {name}"), help));
            }
        })
    }
}

fn apply(operator: &str, left: f64, right: f64) -> Done<f64> {
    let truth = |is_so: bool| f64::from(u8::from(is_so));
    Ok(match operator {
        "AND" => truth(left != 0.0 && right != 0.0),
        "OR" => truth(left != 0.0 || right != 0.0),
        "XOR" => truth((left != 0.0) != (right != 0.0)),
        // as on LinuxCNC, values that differ by less than 0.0001 are equal
        "EQ" => truth((left - right).abs() < 1e-4),
        "NE" => truth((left - right).abs() >= 1e-4),
        "GT" => truth(left > right),
        "GE" => truth(left >= right),
        "LT" => truth(left < right),
        "LE" => truth(left <= right),
        "+" => left + right,
        "-" => left - right,
        "*" => left * right,
        "/" | "MOD" if right == 0.0 => return refuse(Code::PN014, "a division by zero", "check the divisor"),
        "/" => left / right,
        "MOD" => left.rem_euclid(right.abs()),
        _ if left < 0.0 && right.fract() != 0.0 => {
            return refuse(Code::PN014, "a negative number with a fractional exponent", "check the exponent");
        }
        _ => left.powf(right),
    })
}
