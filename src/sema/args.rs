//! Reads the arguments of commands.

use super::code::Code;
use crate::control;
use crate::lang::{Args, CommandId, Coolant};
use crate::span::Span;
use crate::syntax::Spanned;

/// An error in an argument: a message, and the location if a single argument is wrong.
pub struct BadArg {
    /// The argument.
    pub span: Option<Span>,
    /// The message, which is a whole sentence.
    pub message: String,
    /// What to write instead. `None`: the meaning of the command is shown.
    pub help: Option<String>,
}

/// Result of reading arguments.
pub type Read<T> = Result<T, BadArg>;

/// Returns the error of an argument that can't be read.
pub fn bad<T>(arg: Option<&Spanned>, message: impl Into<String>) -> Read<T> {
    Err(BadArg { span: arg.map(|a| a.span), message: message.into(), help: None })
}

/// Returns the error of an argument that can't be read, with the correction.
pub fn bad_with<T>(arg: Option<&Spanned>, message: impl Into<String>, help: impl Into<String>) -> Read<T> {
    Err(BadArg { span: arg.map(|a| a.span), message: message.into(), help: Some(help.into()) })
}

/// The arguments of one command.
pub struct Arguments<'a> {
    pub id: CommandId,
    pub all: &'a [Spanned],
    /// The whole command.
    pub span: Span,
    /// Whether the arguments are written in the form and are not defaults. Codes in written arguments are printed as
    /// written.
    pub typed: bool,
}

impl Arguments<'_> {
    fn name(&self) -> &'static str {
        self.id.name()
    }

    /// Checks the number of arguments.
    pub fn check(&self) -> Read<()> {
        let (takes, given) = (self.id.row().args, self.all.len());
        if given == 0 && !matches!(self.id, CommandId::Name | CommandId::Eob) {
            return bad(None, format!("{} needs {}", self.name(), wants(self.id)));
        }
        if let (CommandId::Coolant, Some(kind)) = (self.id, self.all.first().filter(|arg| is_further_kind(&arg.text))) {
            let message = format!("`{}` is a further kind of coolant", kind.text);
            return bad_with(Some(kind), message, format!("write `CoolantKind {}`", self.text()));
        }
        let Some((least, most)) = takes.count().filter(|&(least, most)| !(least..=most).contains(&given)) else {
            return Ok(());
        };
        let what = match takes {
            Args::Codes(..) => "codes".into(),
            Args::Motion(1, 2) => "codes: one for arcs and one for the spindle, as `G2 M3`".into(),
            Args::Motion(..) => "G codes".into(),
            Args::Switch => "argument, Y or N".into(),
            Args::Choice(_) => "word".into(),
            Args::Words(_, _, what) => format!("words ({what})"),
            _ if most == 1 => "number".into(),
            _ => "numbers".to_owned(),
        };
        bad(self.all.get(most), format!("{} takes {} {what}, but here are {given}", self.name(), range(least, most)))
    }

    pub fn switch(&self) -> Read<bool> {
        match self.all[0].text.to_ascii_uppercase().as_str() {
            "Y" | "YES" => Ok(true),
            "N" | "NO" => Ok(false),
            _ => bad(self.all.first(), format!("{} is Y or N", self.name())),
        }
    }

    /// Reads codes. The first code of a motion command must be a G code, because no M code moves the tool.
    pub fn codes(&self) -> Read<Vec<Code>> {
        let takes = self.id.row().args;
        let letter = if let Args::Codes(letter, ..) = takes { letter } else { 'G' };
        let codes: Vec<Code> = self.all.iter().map(|arg| self.code(arg, letter)).collect::<Read<_>>()?;
        match codes.iter().zip(self.all).find(|(code, _)| !code.code.letter.eq_ignore_ascii_case(&b'G')) {
            Some((_, arg)) if matches!(takes, Args::Motion(..)) => {
                bad(Some(arg), format!("`{}` is not a G code, and only a G code moves the tool", arg.text))
            }
            _ => Ok(codes),
        }
    }

    /// Reads one code, with or without its letter: `G0`, `0`, `M19`.
    pub fn code(&self, arg: &Spanned, letter: char) -> Read<Code> {
        let first = arg.text.bytes().next().unwrap_or(b' ');
        let (given, digits) =
            if first.is_ascii_alphabetic() { (Some(first), &arg.text[1..]) } else { (None, arg.text.as_str()) };
        let plain = digits.bytes().all(|b| b.is_ascii_digit() || b == b'.');
        let number = digits.parse::<f64>().ok().filter(|_| plain);
        match number.and_then(|number| control::Code::of(b'G', number)) {
            Some(code) => {
                let text = given.filter(|_| self.typed).map(|_| arg.text.clone());
                Ok(Code { code: control::Code { letter: given.unwrap_or(letter as u8), ..code }, text })
            }
            None => bad(Some(arg), format!("`{}` is not a code such as `{letter}0`", arg.text)),
        }
    }

    /// Reads letters, separate or joined: `X Y Z` or `XYZ`.
    pub fn letters(&self) -> Read<Vec<u8>> {
        let mut letters = Vec::new();
        for arg in self.all {
            if !arg.text.bytes().all(|b| b.is_ascii_alphabetic()) {
                return bad(Some(arg), format!("`{}` is not a letter", arg.text));
            }
            letters.extend(arg.text.bytes());
        }
        let (least, most) = match self.id.row().args {
            Args::Letters(least, most) => (least.into(), most.into()),
            _ => (1, 1),
        };
        if !(least..=most).contains(&letters.len()) {
            let plural = if most == 1 { "letter" } else { "letters" };
            let (takes, given) = (range(least, most), letters.len());
            return bad(None, format!("{} takes {takes} {plural}, but here are {given}", self.name()));
        }
        Ok(letters)
    }

    /// Reads an argument that must be one letter.
    pub fn letter(&self, arg: &Spanned) -> Read<u8> {
        match arg.text.as_bytes() {
            [letter] if letter.is_ascii_alphabetic() => Ok(*letter),
            _ => bad(Some(arg), format!("`{}` is not a letter", arg.text)),
        }
    }

    /// Reads a number, and checks that the command accepts the number.
    pub fn number(&self) -> Read<f64> {
        let takes = self.id.row().args;
        match takes {
            Args::Number => number(&self.all[0]),
            Args::LengthAboveZero if self.length(&self.all[0])? == 0.0 => {
                bad(self.all.first(), format!("{} must be above zero", self.name()))
            }
            _ => self.length(&self.all[0]),
        }
    }

    /// Reads a length, which must not be negative.
    pub fn length(&self, arg: &Spanned) -> Read<f64> {
        match number(arg)? {
            value if value < 0.0 => bad(Some(arg), format!("{} can't be negative", self.name())),
            value => Ok(value),
        }
    }

    /// Reads the word of a choice. Returns the word in the spelling of the command table.
    pub fn choice(&self) -> Read<&'static str> {
        match choice_of(self.id, &self.all[0].text) {
            Some(word) => Ok(word),
            None => bad(self.all.first(), format!("{} needs {}", self.name(), wants(self.id))),
        }
    }

    pub fn text(&self) -> String {
        self.all.iter().map(|a| a.text.as_str()).collect::<Vec<_>>().join(" ")
    }
}

/// Reads a decimal number. Exponents and infinity are not allowed.
pub fn number(arg: &Spanned) -> Read<f64> {
    match arg.text.parse::<f64>() {
        Ok(value) if value.is_finite() && arg.text.bytes().all(|b| !b.is_ascii_alphabetic()) => Ok(value),
        _ => bad(Some(arg), format!("`{}` is not a number", arg.text)),
    }
}

pub fn whole(arg: &Spanned, least: i64, most: i64) -> Read<i64> {
    match arg.text.parse::<i64>() {
        Ok(n) if (least..=most).contains(&n) => Ok(n),
        _ => bad(Some(arg), format!("`{}` is not a whole number from {least} to {most}", arg.text)),
    }
}

fn range(least: usize, most: usize) -> String {
    if least == most { least.to_string() } else { format!("{least} to {most}") }
}

/// The number and kind of arguments that a command needs, for a message.
fn wants(id: CommandId) -> String {
    let many = |least: u8, most: u8, one: &str, many: &str| match (least, most) {
        (1, 1) => one.to_owned(),
        _ => format!("{} {many}", range(least.into(), most.into())),
    };
    match id.row().args {
        Args::Text => "text".into(),
        Args::Switch => "Y or N".into(),
        Args::Codes(_, least, most) | Args::Motion(least, most) => many(least, most, "a code", "codes"),
        Args::Letters(least, most) => many(least, most, "a letter", "letters"),
        Args::Whole(least, most) => many(least, most, "a number", "numbers"),
        Args::Number | Args::Length | Args::LengthAboveZero => "a number".into(),
        Args::Choice(words) => format!("one of {}", words.join(", ")),
        Args::Words(_, _, what) => what.into(),
    }
}

/// Whether the text is a kind of coolant that `CoolantKind` defines.
fn is_further_kind(text: &str) -> bool {
    Coolant::parse(text).is_some_and(|kind| Coolant::FURTHER.contains(&kind))
}

/// Finds the word of a choice. Returns the word in the spelling of the command table.
pub fn choice_of(id: CommandId, text: &str) -> Option<&'static str> {
    match id.row().args {
        Args::Choice(words) => words.iter().find(|w| w.eq_ignore_ascii_case(text)).copied(),
        _ => None,
    }
}
