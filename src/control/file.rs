//! Control files: TOML, read into what a control is. What a file says wrongly is an error with its line and column.

use std::collections::BTreeMap;
use std::fmt;

use serde::Deserialize;
use toml::Spanned;

use super::code::Code;
use super::meaning::Meaning;
use super::words::Words;
use super::{Control, Row, Rows, Rules};

/// Longest chain of `like`.
const LONGEST_CHAIN: usize = 8;

/// What is wrong with a control file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Wrong {
    /// The file's name.
    pub file: String,
    /// Line and column, from 1.
    pub at: (usize, usize),
    /// What, one sentence.
    pub message: String,
    /// What to write instead; empty where the message says it.
    pub help: String,
}

impl fmt::Display for Wrong {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}:{}: {}", self.file, self.at.0, self.at.1, self.message)?;
        if self.help.is_empty() { Ok(()) } else { write!(f, "\n  help: {}", self.help) }
    }
}

impl std::error::Error for Wrong {}

/// A file as it is written.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    name: Spanned<String>,
    title: Option<String>,
    like: Option<Spanned<String>>,
    rules: Option<Rules>,
    #[serde(default)]
    text: Text,
    #[serde(default)]
    words: WordsOf,
    #[serde(default)]
    tool: Tool,
    #[serde(default)]
    codes: BTreeMap<Spanned<String>, RowText>,
}

/// `[text]`: what the control reads besides words.
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct Text {
    line: Option<usize>,
    longer: Option<Longer>,
    open_comments: Option<bool>,
}

/// What becomes of a block that is longer.
#[derive(Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Longer {
    Stops,
    Cut,
}

/// `[words]`: words that need no code.
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct WordsOf {
    everywhere: Option<Spanned<String>>,
    work: Option<Spanned<String>>,
}

/// `[tool]`: its length.
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct Tool {
    without_length: Option<Height>,
}

/// What a height is while no length of a tool counts.
#[derive(Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Height {
    Work,
    Machine,
}

/// A row of `[codes]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RowText {
    is: Spanned<String>,
    words: Option<Spanned<String>>,
    text: Option<String>,
}

/// Where a key of `[codes]` stands for more than one code.
enum Key {
    One(Code),
    /// `G31.*`: all codes of a number.
    Number(u8, u16),
    /// `M*`: all others of a letter.
    Letter(u8),
}

impl Key {
    fn parse(text: &str) -> Option<Key> {
        if let Some(number) = text.strip_suffix(".*") {
            let code: Code = number.parse().ok()?;
            return code.tenths.is_multiple_of(10).then_some(Key::Number(code.letter, code.tenths / 10));
        }
        match text {
            "G*" => Some(Key::Letter(b'G')),
            "M*" => Some(Key::Letter(b'M')),
            _ => text.parse().ok().map(Key::One),
        }
    }
}

/// Finds the control that a file is like, which is so deep in its chain.
type Find = dyn Fn(&str, usize) -> Option<Result<Control, Wrong>>;

/// Reads a file's text. `find` gives the control that it is `like`.
pub(super) fn read(name: &str, text: &str, find: &Find, depth: usize) -> Result<Control, Wrong> {
    let reader = Reader { name, text };
    let file: File = toml::from_str(text).map_err(|error| {
        let at = error.span().map_or(0, |span| span.start);
        reader.wrong(at, error.message().to_owned(), "")
    })?;
    let mut control = match &file.like {
        None => Control::empty(),
        Some(like) if depth == LONGEST_CHAIN => {
            return Err(reader.wrong(
                like.span().start,
                "the chain of `like` comes back to itself",
                "end it somewhere",
            ));
        }
        Some(like) => match find(like.get_ref(), depth + 1) {
            Some(found) => found?,
            None => {
                let message = format!("there is no control `{}` to be like", like.get_ref());
                let help = format!("one of {}", super::names().collect::<Vec<_>>().join(", "));
                return Err(reader.wrong(like.span().start, message, help));
            }
        },
    };
    control.chain.insert(0, file.name.get_ref().clone());
    control.title = file.title.unwrap_or(control.title);
    control.rules = file.rules.unwrap_or(control.rules);
    control.longest_line = file.text.line.or(control.longest_line);
    control.stops_at_longer = file.text.longer.map_or(control.stops_at_longer, |longer| longer == Longer::Stops);
    control.open_comments = file.text.open_comments.unwrap_or(control.open_comments);
    if let Some(words) = &file.words.everywhere {
        control.everywhere = reader.words(words)?;
    }
    if let Some(letter) = &file.words.work {
        reader.words(letter)?;
        let [letter] = letter.get_ref().as_bytes() else {
            return Err(reader.wrong(
                letter.span().start,
                "the word of a work offset has one letter",
                "write it alone, as \"E\"",
            ));
        };
        control.work_letter = Some(*letter);
    }
    if let Some(height) = file.tool.without_length {
        control.height_is_machine = height == Height::Machine;
    }
    reader.rows(&file.codes, &mut control.rows)?;
    control.rows.finish();
    Ok(control)
}

/// The text that is being read, for places.
struct Reader<'t> {
    name: &'t str,
    text: &'t str,
}

impl Reader<'_> {
    fn rows(&self, codes: &BTreeMap<Spanned<String>, RowText>, rows: &mut Rows) -> Result<(), Wrong> {
        for (key, row) in codes {
            let Some(parsed) = Key::parse(key.get_ref()) else {
                let message = format!("`{}` is no code", key.get_ref());
                return Err(self.wrong(
                    key.span().start,
                    message,
                    "write G154, G59.1, `G31.*` for all of a number, or `M*` for all others",
                ));
            };
            let Some(meaning) = Meaning::parse(row.is.get_ref()) else {
                let names = Meaning::ALL.iter().map(|meaning| meaning.name());
                let near = crate::control::nearest(row.is.get_ref(), names);
                let message = format!("`{}` is no meaning of a code", row.is.get_ref());
                return Err(self.wrong(row.is.span().start, message, near));
            };
            let words = row.words.as_ref().map_or(Ok(Words::NONE), |words| self.words(words))?;
            let (code, text) = (Code { letter: b'G', tenths: 0 }, row.text.clone().unwrap_or_default());
            let row = Row { code, meaning, words, text };
            match parsed {
                Key::One(code) => rows.put(Row { code, ..row }),
                Key::Number(letter, number) => {
                    rows.put_number(Row { code: Code { letter, tenths: number * 10 }, ..row })
                }
                Key::Letter(letter) => rows.put_others(Row { code: Code { letter, tenths: 0 }, ..row }),
            }
        }
        Ok(())
    }

    fn words(&self, words: &Spanned<String>) -> Result<Words, Wrong> {
        match words.get_ref().bytes().find(|letter| !letter.is_ascii_uppercase()) {
            None => Ok(Words::of(words.get_ref())),
            Some(letter) => {
                let message = format!("`{}` is no letter of a word", char::from(letter).escape_default());
                Err(self.wrong(words.span().start, message, "write the letters alone, as \"PQR\""))
            }
        }
    }

    fn wrong(&self, at: usize, message: impl Into<String>, help: impl Into<String>) -> Wrong {
        let before = self.text.get(..at).unwrap_or(self.text);
        let line = before.matches('\n').count() + 1;
        let column = before.rsplit('\n').next().map_or(0, |rest| rest.chars().count()) + 1;
        Wrong { file: self.name.to_owned(), at: (line, column), message: message.into(), help: help.into() }
    }
}
