//! Arguments of commands: reading them.

use super::settings::{ArcCentre, Code, Prompt, SequenceNumbers};
use crate::lang::{Args, CommandId, VarId};
use crate::span::Span;
use crate::syntax::Spanned;

/// What is wrong with an argument: the place, if it is one of the arguments, and what to say.
pub struct BadArg {
    /// The argument.
    pub span: Option<Span>,
    /// A sentence.
    pub message: String,
}

/// An argument that was read.
pub type Read<T> = Result<T, BadArg>;

/// This argument can't be read.
pub fn bad<T>(arg: Option<&Spanned>, message: impl Into<String>) -> Read<T> {
    Err(BadArg { span: arg.map(|a| a.span), message: message.into() })
}

/// The arguments of one command.
pub struct Arguments<'a> {
    pub id: CommandId,
    pub all: &'a [Spanned],
}

impl Arguments<'_> {
    pub fn count(&self, least: usize, most: usize, what: &str) -> Read<()> {
        let given = self.all.len();
        if (least..=most).contains(&given) {
            return Ok(());
        }
        let wanted = if least == most { least.to_string() } else { format!("{least} to {most}") };
        bad(self.all.get(most), format!("{} takes {wanted} {what}, here are {given}", self.id.name()))
    }

    pub fn switch(&self) -> Read<bool> {
        self.count(1, 1, "argument, Y or N")?;
        match self.all[0].text.to_ascii_uppercase().as_str() {
            "Y" | "YES" => Ok(true),
            "N" | "NO" => Ok(false),
            _ => bad(self.all.first(), format!("{} is Y or N", self.id.name())),
        }
    }

    pub fn codes(&self, least: usize, most: usize, letter: u8) -> Read<Vec<Code>> {
        self.count(least, most, "codes")?;
        self.all.iter().map(|arg| code(arg, letter)).collect()
    }

    /// G codes: an M code moves nothing, whatever its number.
    pub fn g_codes(&self, least: usize, most: usize) -> Read<Vec<Code>> {
        let codes = self.codes(least, most, b'G')?;
        match codes.iter().zip(self.all).find(|(code, _)| !code.letter.eq_ignore_ascii_case(&b'G')) {
            None => Ok(codes),
            Some((_, arg)) => bad(Some(arg), format!("`{}` is no G code, and only a G code moves the tool", arg.text)),
        }
    }

    /// The G code of an arc and, if it is given, the M code of the spindle that turns the same way.
    pub fn turn(&self, spindle: &mut f64) -> Read<Code> {
        self.count(1, 2, "codes: of arcs, and of the spindle, as `G2 M3`")?;
        let arc = Arguments { id: self.id, all: &self.all[..1] }.g_codes(1, 1)?.remove(0);
        if let Some(second) = self.all.get(1) {
            let turn = code(second, b'M')?;
            if !turn.letter.eq_ignore_ascii_case(&b'M') {
                return bad(Some(second), format!("`{}` is no M code of the spindle", second.text));
            }
            *spindle = turn.value;
        }
        Ok(arc)
    }

    /// So many values, the later ones optional: those not given keep what they are.
    pub fn values<const N: usize>(&self, into: &mut [f64; N], least: usize, letter: u8) -> Read<()> {
        for (slot, code) in into.iter_mut().zip(self.codes(least, N, letter)?) {
            *slot = code.value;
        }
        Ok(())
    }

    /// Letters, apart or together: `X Y Z` or `XYZ`.
    pub fn letters(&self, least: usize, most: usize) -> Read<Vec<u8>> {
        let mut letters = Vec::new();
        for arg in self.all {
            if !arg.text.bytes().all(|b| b.is_ascii_alphabetic()) {
                return bad(Some(arg), format!("`{}` is no letter", arg.text));
            }
            letters.extend(arg.text.bytes());
        }
        if letters.len() < least || letters.len() > most {
            let wanted = if least == most { least.to_string() } else { format!("{least} to {most}") };
            let plural = if most == 1 { "letter" } else { "letters" };
            return bad(None, format!("{} takes {wanted} {plural}, here are {}", self.id.name(), letters.len()));
        }
        Ok(letters)
    }

    pub fn letter(&self) -> Read<u8> {
        Ok(self.letters(1, 1)?[0])
    }

    pub fn number(&self) -> Read<f64> {
        self.count(1, 1, "number")?;
        number(&self.all[0])
    }

    /// A length that is not negative.
    pub fn length(&self) -> Read<f64> {
        let value = self.number()?;
        if value < 0.0 {
            return bad(self.all.first(), format!("{} can't be negative", self.id.name()));
        }
        Ok(value)
    }

    pub fn text(&self) -> String {
        self.all.iter().map(|a| a.text.as_str()).collect::<Vec<_>>().join(" ")
    }
}

pub fn number(arg: &Spanned) -> Read<f64> {
    match arg.text.parse::<f64>() {
        Ok(value) if value.is_finite() && arg.text.bytes().all(|b| !b.is_ascii_alphabetic()) => Ok(value),
        _ => bad(Some(arg), format!("`{}` is no number", arg.text)),
    }
}

/// `G0`, `0`, `M19`: with its letter or without.
pub fn code(arg: &Spanned, letter: u8) -> Read<Code> {
    let first = arg.text.bytes().next().unwrap_or(b' ');
    let (given, digits) =
        if first.is_ascii_alphabetic() { (Some(first), &arg.text[1..]) } else { (None, arg.text.as_str()) };
    match digits.parse::<f64>() {
        Ok(value) if value >= 0.0 && digits.bytes().all(|b| b.is_ascii_digit() || b == b'.') => {
            Ok(Code { letter: given.unwrap_or(letter), text: given.map(|_| arg.text.clone()), value })
        }
        _ => bad(Some(arg), format!("`{}` is no code, as `{}{}` is", arg.text, char::from(letter), 0)),
    }
}

/// `I J K`, `IJK`, `R`, `R-`.
pub fn centre(args: &Arguments) -> Read<ArcCentre> {
    let given: String = args.all.iter().map(|a| a.text.trim_matches('-')).collect();
    match given.as_bytes() {
        [r @ (b'R' | b'r')] => Ok(ArcCentre::Radius(*r)),
        letters if (1..=3).contains(&letters.len()) && letters.iter().all(u8::is_ascii_alphabetic) => {
            Ok(ArcCentre::Letters(letters.to_vec()))
        }
        _ => bad(args.all.first(), format!("{} takes centre letters as `I J K`, or `R`", args.id.name())),
    }
}

/// What a command wants, for a message.
pub fn wants(id: CommandId) -> String {
    match id.row().args {
        Args::Text => "text".into(),
        Args::Switch => "Y or N".into(),
        Args::Codes(a, b) if a == b && a == 1 => "a code".into(),
        Args::Codes(a, b) if a == b => format!("{a} codes"),
        Args::Codes(a, b) => format!("{a} to {b} codes"),
        Args::Letters(1, 1) => "a letter".into(),
        Args::Letters(a, b) if a == b => format!("{a} letters"),
        Args::Letters(..) => "letters".into(),
        Args::Numbers(1, 1) => "a number".into(),
        Args::Numbers(..) => "numbers".into(),
        Args::Choice(words) => format!("one of {}", words.join(", ")),
        Args::Words(what) => what.into(),
    }
}

/// The word of a choice, as the table writes it.
pub fn choice_of(id: CommandId, text: &str) -> Option<&'static str> {
    match id.row().args {
        Args::Choice(words) => words.iter().find(|w| w.eq_ignore_ascii_case(text)).copied(),
        _ => None,
    }
}

pub fn choice(args: &Arguments) -> Read<&'static str> {
    args.count(1, 1, "word")?;
    match choice_of(args.id, &args.all[0].text) {
        Some(word) => Ok(word),
        None => bad(args.all.first(), format!("{} needs {}", args.id.name(), wants(args.id))),
    }
}

pub fn whole(arg: &Spanned, least: i64, most: i64) -> Read<i64> {
    match arg.text.parse::<i64>() {
        Ok(n) if (least..=most).contains(&n) => Ok(n),
        _ => bad(Some(arg), format!("`{}` is no whole number from {least} to {most}", arg.text)),
    }
}

/// `N 10 10`, `None`, `None 100 10`: with None, start and step are those of `[block]`.
pub fn numbers(args: &Arguments) -> Read<SequenceNumbers> {
    args.count(1, 3, "words: letter, start, step")?;
    let letter = match &args.all[0].text {
        none if none.eq_ignore_ascii_case("None") => None,
        letter if letter.len() == 1 && letter.as_bytes()[0].is_ascii_alphabetic() => Some(letter.as_bytes()[0]),
        _ => return bad(args.all.first(), "Sequence#s begins with a letter, or is None"),
    };
    let start = args.all.get(1).map_or(Ok(10), |a| whole(a, 0, 99_999_999))?;
    let step = args.all.get(2).map_or(Ok(10), |a| whole(a, 1, 99_999_999))?;
    Ok(SequenceNumbers { letter, start, step })
}

/// `Ask val1 "Fixture height" 2.5`.
pub fn prompt(args: &Arguments, span: Span) -> Read<Prompt> {
    args.count(1, 3, "words: variable, prompt in quotes, default")?;
    let name = args.all[0].text.trim_matches(['[', ']', '<', '>']);
    let Some(var) = VarId::parse(name) else {
        return bad(args.all.first(), format!("`{name}` is no variable"));
    };
    if var.row().origin == crate::lang::Origin::Computed {
        return bad(
            args.all.first(),
            format!("[{name}] comes from the toolpath and can't be asked for: use val1 to val10"),
        );
    }
    let text = args.all.get(1).map_or_else(|| var.row().meaning.to_owned(), |a| a.text.clone());
    let default = args.all.get(2).map(number).transpose()?;
    Ok(Prompt { var, text, default, span })
}
