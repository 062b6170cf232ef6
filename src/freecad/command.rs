//! Reads the text of a path. Each line has one command, which begins with its name.

use std::io::{BufRead, Read};

use super::archive::unpacked;
use crate::control;
use crate::diag::{Code, Diag};
use crate::number::decimal;
use crate::toolpath::{ReadError, Stop};

/// Maximum length of a line in a path, in bytes.
const LONGEST: u64 = 64 << 10;

/// The height to which the tool returns after a hole, as selected by G98 and G99.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Return {
    /// To the height before the cycle: G98.
    Before,
    /// To the R plane: G99.
    Clearance,
}

/// One line of a path.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Command<'a> {
    /// A comment, without its parentheses.
    Comment(String),
    /// A code and its words.
    Code(control::Code, &'a Words),
}

/// The words of a command, by their capital letters. Each letter occurs only once.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Words {
    values: Vec<(u8, f64)>,
    /// The return height, which FreeCAD 1.2 writes after the words.
    pub returns: Option<Return>,
}

impl Words {
    /// The value of a letter.
    pub fn get(&self, letter: u8) -> Option<f64> {
        self.values.iter().find(|(own, _)| *own == letter).map(|(_, value)| *value)
    }

    /// The command as a block of a program. `feed` converts the feed of the command.
    pub fn block(&self, code: control::Code, feed: impl Fn(f64) -> f64) -> String {
        let words = self.values.iter().map(|&(letter, value)| {
            let value = if letter == b'F' { feed(value) } else { value };
            // FreeCAD saves numbers with six decimals
            format!(" {}{}", char::from(letter), (value * 1e6).round() / 1e6)
        });
        format!("{code}{}", words.collect::<String>())
    }

    /// The first letter that is not in `known`.
    pub fn beyond(&self, known: &[u8]) -> Option<char> {
        self.values.iter().map(|(letter, _)| *letter).find(|letter| !known.contains(letter)).map(char::from)
    }
}

/// Calls `take` for each command of a path, with the number of its line from 1. `name`: the path's file in the archive.
pub(super) fn each(
    name: &str,
    path: Option<impl BufRead>,
    mut take: impl FnMut(u64, &Command<'_>) -> Result<(), Stop>,
) -> Result<(), ReadError> {
    let Some(mut path) = path else { return Ok(()) };
    let (mut line, mut words) = (Vec::new(), Words::default());
    let mut number = 0;
    loop {
        line.clear();
        let count = match path.by_ref().take(LONGEST).read_until(b'\n', &mut line) {
            Ok(count) => count as u64,
            Err(error) => return Err(unpacked(name, error)),
        };
        if count == 0 {
            return Ok(());
        }
        number += 1;
        if count == LONGEST {
            return Err(ReadError::Job(unread(&line)));
        }
        if let Some(command) = parse(&line, &mut words).ok_or_else(|| unread(&line))? {
            take(number, &command)?;
        }
    }
}

fn unread(line: &[u8]) -> Box<Diag> {
    let help = "write the line as FreeCAD saves it: a command and its words, as `G1 X1.000000`";
    let message = format!("a line of a path that can't be read: {}", String::from_utf8_lossy(line).trim());
    Box::new(Diag::new(Code::PD003, message).help(help))
}

/// Parses a line and stores the words of the line in `words`. `Some(None)`: the line is empty. `None`: the line can't
/// be read.
fn parse<'a>(line: &[u8], words: &'a mut Words) -> Option<Option<Command<'a>>> {
    let line = line.trim_ascii();
    if line.is_empty() {
        return Some(None);
    }
    // FreeCAD does not always remove inner parentheses, so the comment extends to the last one
    if let Some(rest) = line.strip_prefix(b"(") {
        let end = rest.iter().rposition(|byte| *byte == b')').unwrap_or(rest.len());
        return Some(Some(Command::Comment(String::from_utf8_lossy(&rest[..end]).trim().to_owned())));
    }
    let (line, notes) = match memchr::memchr(b';', line) {
        Some(at) => (&line[..at], &line[at + 1..]),
        None => (line, &line[line.len()..]),
    };
    let mut tokens = line.split(u8::is_ascii_whitespace).filter(|token| !token.is_empty());
    let (letter, value) = word(tokens.next()?)?;
    let code = control::Code::of(letter, value)?;
    words.values.clear();
    words.returns = if notes.is_empty() { None } else { returns(str::from_utf8(notes).ok()?)? };
    for token in tokens {
        let (letter, value) = word(token)?;
        if words.get(letter).is_some() {
            return None;
        }
        words.values.push((letter, value));
    }
    Some(Some(Command::Code(code, words)))
}

/// Reads a word: a letter and a finite number.
fn word(token: &[u8]) -> Option<(u8, f64)> {
    let (&letter, number) = token.split_first()?;
    let (sign, digits) = number.strip_prefix(b"-").map_or((1.0, number), |digits| (-1.0, digits));
    let value = match decimal(digits).filter(|number| number.length == digits.len()) {
        Some(number) => sign * number.value(),
        None => str::from_utf8(number).ok()?.parse().ok()?,
    };
    (letter.is_ascii_uppercase() && value.is_finite()).then_some((letter, value))
}

/// Reads the notes of FreeCAD 1.2, such as `RetractMode:'G98' operation:'tapping' depth:1.5`. `None`: one of the notes
/// is unknown.
fn returns(notes: &str) -> Option<Option<Return>> {
    let mut returns = None;
    for note in notes.split_ascii_whitespace() {
        match note.split_once(':')? {
            ("RetractMode", "'G98'") => returns = Some(Return::Before),
            ("RetractMode", "'G99'") => returns = Some(Return::Clearance),
            ("operation" | "depth", _) => {}
            _ => return None,
        }
    }
    Some(returns)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn code(line: &str) -> (String, Words) {
        match parse(line.as_bytes(), &mut Words::default()) {
            Some(Some(Command::Code(code, words))) => (code.to_string(), words.clone()),
            other => panic!("{line}: {other:?}"),
        }
    }

    #[test]
    fn a_line_is_a_code_and_its_words() {
        let (name, words) = code("G01 F11.666667 X-5.000000");
        assert_eq!(
            (name.as_str(), words.get(b'F'), words.get(b'X'), words.get(b'Y')),
            ("G1", Some(11.666667), Some(-5.0), None)
        );
        assert_eq!(words.beyond(b"F"), Some('X'));
        let (_, words) = code("G84 F1.25 S300 ; RetractMode:'G98' operation:'tapping' depth:1.500000");
        assert_eq!(words.returns, Some(Return::Before));
        assert_eq!(parse(b" \r\n", &mut Words::default()), Some(None));
    }

    #[test]
    fn a_comment_reaches_to_its_last_parenthesis() {
        for (line, text) in
            [("(Slot 8 wide))", "Slot 8 wide)"), ("(TC: 1/4\" X5)", "TC: 1/4\" X5"), ("()", ""), ("(open", "open")]
        {
            let mut words = Words::default();
            let parsed = parse(line.as_bytes(), &mut words);
            assert_eq!(parsed, Some(Some(Command::Comment(text.into()))), "{line}");
        }
    }

    #[test]
    fn what_is_no_command_is_refused() {
        for line in [
            "X1",
            "G1 x1",
            "G1 X",
            "G1 X1 X2",
            "G1 Xnan",
            "G1 Xinf",
            "G1 X1e999",
            "hello",
            "G81 Z1 ; spin:'fast'",
            "G1 X1 (c)",
        ] {
            assert_eq!(parse(line.as_bytes(), &mut Words::default()), None, "{line}");
        }
    }
}
