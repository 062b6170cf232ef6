//! Evaluates expressions in words: `[#1 * 2 + SIN[30]]`.

use super::fault::{Done, Fault, quoted, refuse};
use super::macros::{Function, Language, Operator};
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
    /// The last operator between the current brackets.
    last: Option<&'static Operator>,
    /// The step to which ROUND rounds.
    step: Step,
}

/// The step to which ROUND rounds.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Step {
    /// Whole numbers.
    One,
    /// The least increment of the word that gets the value.
    Increment(f64),
    /// Not public for the word that gets the value.
    Unknown(u8),
}

impl<'a> Reader<'a> {
    /// A reader that begins at the next token of `tokens`.
    pub fn new(line: &'a [u8], tokens: Tokens<'a>) -> Reader<'a> {
        let mut reader = Reader { line, tokens, ahead: None, depth: 0, last: None, step: Step::One };
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

    /// Reads the value of a word, as `value`.
    ///
    /// # Errors
    /// The value is missing or not defined.
    pub fn word_value(&mut self, letter: u8, parameters: &Parameters) -> Done<f64> {
        self.step = match letter {
            _ if parameters.language().is_linuxcnc => Step::One,
            b'A'..=b'C' => Step::Increment(1e-3),
            b'I'..=b'K' | b'Q' | b'R' | b'U'..=b'Z' => Step::Increment(parameters.increment),
            b'E' | b'F' | b'P' => Step::Unknown(letter),
            _ => Step::One,
        };
        let value = self.value(parameters);
        self.step = Step::One;
        value
    }

    /// Reads the value of an assignment.
    ///
    /// # Errors
    /// The value is missing or not defined.
    pub fn assigned_value(&mut self, parameters: &Parameters) -> Done<f64> {
        if parameters.language().is_linuxcnc {
            return self.value(parameters);
        }
        self.last = None;
        self.operation(parameters, 0)
    }

    fn plain_value(&mut self, parameters: &Parameters) -> Done<f64> {
        let minus = self.takes(b'-');
        if minus || self.takes(b'+') {
            let again = self.ahead.is_some_and(|token| matches!(token.kind, Kind::Symbol(b'-' | b'+')));
            if again && !parameters.language().is_linuxcnc {
                return self.unexpected("a value");
            }
            let value = self.value(parameters)?;
            return Ok(if minus { -value } else { value });
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
        let is_linuxcnc = parameters.language().is_linuxcnc;
        let has_number = self.ahead.is_some_and(|token| matches!(token.kind, Kind::Number(_) | Kind::Symbol(b'[')));
        if !is_linuxcnc && !has_number {
            return self.unexpected("the number of a parameter or `[`");
        }
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
        let last = self.last.take();
        let value = self.operation(parameters, 0)?;
        self.last = last;
        if !self.takes(b']') {
            return self.unexpected("`]` or an operator");
        }
        Ok(value)
    }

    /// Reads values that are joined by operators of this rank or a higher one.
    fn operation(&mut self, parameters: &Parameters, rank: u8) -> Done<f64> {
        let mut left = self.value(parameters)?;
        while let Some(operator) = self.operator(parameters.language(), rank)? {
            let right = self.operation(parameters, operator.rank + 1)?;
            left = (operator.apply)(left, right)?;
        }
        Ok(left)
    }

    /// Takes the next token if it is an operator of this rank or a higher one.
    fn operator(&mut self, language: &Language, rank: u8) -> Done<Option<&'static Operator>> {
        let named = |token: &Token| matches!(token.kind, Kind::Symbol(_) | Kind::Name);
        let Some(token) = self.ahead.filter(named) else { return Ok(None) };
        let Some(operator) = language.operator(self.text(token)).filter(|operator| operator.rank >= rank) else {
            return Ok(None);
        };
        if let Some(last) = self.last.replace(operator)
            && (last.alone || operator.alone)
            && last.name != operator.name
        {
            let message =
                format!("{} and {} without brackets: which one is first is not public", last.name, operator.name);
            return Err(Fault::at(Code::PN016, token.start, message, "write brackets, as [#1 AND #2] + 1"));
        }
        self.next();
        Ok(Some(operator))
    }

    fn function(&mut self, parameters: &Parameters) -> Done<f64> {
        let Some(token) = self.next() else { return self.unexpected("a function") };
        let name = String::from_utf8_lossy(self.text(token)).to_ascii_uppercase();
        let language = parameters.language();
        let Some(function) = language.function(&name) else {
            let help = format!("functions are {}", language.names());
            return Err(Fault::at(Code::PN014, token.start, format!("there is no function {name}"), help));
        };
        let x = self.bracketed(parameters)?;
        match function {
            Function::Of(of) => of(x),
            Function::Ratio(of) => {
                let second = if self.takes(b'/') { Some(self.bracketed(parameters)?) } else { None };
                of(x, second)
            }
            Function::Round => match self.step {
                Step::One => Ok(x.round()),
                Step::Increment(step) => Ok((x / step).round() * step),
                Step::Unknown(letter) => {
                    let letter = char::from(letter);
                    let message = format!("ROUND in the value of {letter}, whose least increment is not public");
                    Err(Fault::at(Code::PN016, token.start, message, format!("write #1=ROUND[..] and {letter}#1")))
                }
            },
        }
    }
}
