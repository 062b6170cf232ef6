//! Reads control files, written in TOML. An error in a file is reported with its line and column.

use std::collections::BTreeMap;
use std::fmt;

use toml::Spanned;

use super::arcs::Arcs;
use super::code::Code;
use super::file_text::{
    EndsLength, File, Height, InRapids, Longer, RepeatsInP, RowText, SecondTool, Semicolon, WithoutAxes, ZeroRegister,
};
use super::hole::Hole;
use super::key::{ABSENT, Key};
use super::meaning::Meaning;
use super::runs::{Motions, Pitch, PitchUnit, Runs, WorkOffset};
use super::traits::{Rules, Traits};
use super::words::Words;
use super::{Control, Row, Rows};
use crate::suggest::did_you_mean_one_of;

/// The maximum length of a chain of control files in which each file names the next one with `like`.
const LONGEST_CHAIN: usize = 8;

/// An error in the file of a control or a machine.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Wrong {
    /// Name of the file.
    pub file: String,
    /// Line and column, from 1.
    pub at: (usize, usize),
    /// Position of the wrong part in the text, in bytes.
    pub start: usize,
    /// The problem, in one sentence.
    pub message: String,
    /// A proposed correction; empty if the message contains it.
    pub help: String,
}

impl Wrong {
    /// An error at a byte of a file's text.
    pub(crate) fn at(file: &str, text: &str, at: usize, message: impl Into<String>, help: impl Into<String>) -> Wrong {
        let before = text.get(..at).unwrap_or(text);
        let line = before.matches('\n').count() + 1;
        let column = before.rsplit('\n').next().map_or(0, |rest| rest.chars().count()) + 1;
        let (message, help) = (message.into(), help.into());
        Wrong { file: file.to_owned(), at: (line, column), start: before.len(), message, help }
    }
}

impl fmt::Display for Wrong {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}:{}: {}", self.file, self.at.0, self.at.1, self.message)?;
        if self.help.is_empty() { Ok(()) } else { write!(f, "\n  help: {}", self.help) }
    }
}

impl std::error::Error for Wrong {}

/// Finds the control that a file names with `like`. The number is the depth of that control in the chain.
type Find = dyn Fn(&str, usize) -> Option<Result<Control, Wrong>>;

/// Reads the text of a control file. `find` returns the control that the file names with `like`.
pub(super) fn read(name: &str, text: &str, find: &Find, depth: usize) -> Result<Control, Wrong> {
    let reader = Reader { name, text };
    let file: File = toml::from_str(text).map_err(|error| {
        let at = error.span().map_or(0, |span| span.start);
        reader.wrong(at, error.message().to_owned(), "")
    })?;
    let is_run = file.rules != Some(Rules::None);
    if is_run && file.like.is_none() && file.codes.is_empty() {
        let message = format!("`{}` has no codes: it has neither `like` nor [codes]", file.name.get_ref());
        return Err(reader.wrong(
            file.name.span().start,
            message,
            "write like = \"fanuc\", or write the codes under [codes], or rules = \"none\" if the language has no G \
             codes",
        ));
    }
    let mut control = match &file.like {
        None => Control::empty(),
        Some(like) if depth == LONGEST_CHAIN => {
            return Err(reader.wrong(
                like.span().start,
                "this control is based on itself through `like`",
                "remove `like` from one of the controls",
            ));
        }
        Some(like) => match find(like.get_ref(), depth + 1) {
            Some(found) => found?,
            None => {
                let message = format!("there is no control `{}`", like.get_ref());
                let help = format!("one of {}", super::names().collect::<Vec<_>>().join(", "));
                return Err(reader.wrong(like.span().start, message, help));
            }
        },
    };
    control.chain.insert(0, file.name.get_ref().clone());
    control.title = file.title.clone().unwrap_or(control.title);
    // `unknown` is not inherited: the rows of this file may supply the missing facts
    control.unknown = file.unknown.clone().unwrap_or_default();
    reader.traits(&file, &mut control.traits)?;
    reader.rows(&file.codes, &mut control.rows)?;
    if !control.is_run() {
        // the rows of another language must not be inherited: their codes would be read as words of this control
        control.rows = Rows::default();
    }
    control.rows.finish();
    Ok(control)
}

/// The text that is being read. The name and the text of the file are needed for the locations of errors.
struct Reader<'t> {
    name: &'t str,
    text: &'t str,
}

impl Reader<'_> {
    /// Reads the traits in the file. All other traits keep their inherited values.
    fn traits(&self, file: &File, traits: &mut Traits) -> Result<(), Wrong> {
        fn take<T: Copy>(to: &mut T, said: Option<T>) {
            *to = said.unwrap_or(*to);
        }
        take(&mut traits.rules, file.rules);
        take(&mut traits.turns, file.machine);
        traits.longest_line = file.text.line.or(traits.longest_line);
        take(&mut traits.stops_at_longer, file.text.longer.map(|longer| longer == Longer::Stops));
        take(&mut traits.complete, file.complete);
        take(&mut traits.one_m, file.blocks.one_m);
        take(&mut traits.bare_line, file.text.comments_count.map(|count| !count));
        take(&mut traits.no_mist, file.coolant.mist.map(|mist| !mist));
        take(&mut traits.junction_deviation, file.corners.junction_deviation);
        take(&mut traits.open_comments, file.text.open_comments);
        take(&mut traits.small_letters, file.text.small_letters);
        take(&mut traits.without_point, file.numbers.length_without_point);
        take(&mut traits.feed_without_point, file.numbers.feed_without_point);
        take(&mut traits.macros, file.macros.language);
        take(&mut traits.semicolon_ends_block, file.text.semicolon.map(|sign| sign == Semicolon::EndOfBlock));
        take(&mut traits.repeats_in_p, file.subprograms.repeats_in_p.as_ref().map(RepeatsInP::known));
        take(&mut traits.dwell, file.dwell.p);
        take(&mut traits.centres, file.arcs.centres);
        take(&mut traits.modes_at_start, file.start.modes);
        traits.basic = file.start.units.or(traits.basic);
        take(&mut traits.spindle_at_stop, file.stops.spindle);
        take(&mut traits.coolant_at_change, file.tool.coolant);
        take(&mut traits.tool_length, file.tool.length);
        take(&mut traits.beam_off_in_rapids, file.laser.rapids.map(|InRapids::Off| true));
        take(&mut traits.all_go_home, file.reference.without_axes.map(|WithoutAxes::All| true));
        take(&mut traits.next_beside_change, file.tool.second.map(|SecondTool::Next| true));
        take(&mut traits.zero_is_tool, file.tool.zero.map(|zero| zero == ZeroRegister::Tool));
        take(&mut traits.height_is_machine, file.tool.without_length.map(|height| height == Height::Machine));
        if let Some(words) = &file.words.everywhere {
            traits.everywhere = self.words(words)?;
        }
        if let Some(letters) = &file.numbers.no_point {
            traits.no_point = self.words(letters)?;
        }
        if let Some(letter) = &file.words.work {
            traits.work_letter = Some(self.letter(letter)?);
        }
        if let Some(most) = file.words.most_work {
            traits.most_work = Some(most);
        }
        if let Some(letters) = &file.words.letters {
            traits.letters = self.words(letters)?;
        }
        if let Some(said) =
            [&file.arcs.mm, &file.arcs.inch].into_iter().flatten().find(|said| !said.get_ref().is_possible())
        {
            let help = "write lengths of 0 or more, as { least = 0.005, part = 0.001, most = 0.5, chord = 0 }";
            return Err(self.wrong(said.span().start, "this is not a valid tolerance of arcs", help));
        }
        if let Some(mm) = &file.arcs.mm {
            traits.arcs = Arcs { mm: *mm.get_ref(), inch: None };
        }
        if let Some(inch) = &file.arcs.inch {
            traits.arcs.inch = Some(*inch.get_ref());
        }
        Ok(())
    }

    fn letter(&self, text: &Spanned<String>) -> Result<u8, Wrong> {
        self.words(text)?;
        match text.get_ref().as_bytes() {
            [letter] => Ok(*letter),
            _ => Err(self.wrong(text.span().start, "the letter of a word is one letter", "write one letter, as \"E\"")),
        }
    }

    /// Reads the words for the pitch of a tap.
    fn pitch(&self, said: &Spanned<toml::Value>) -> Result<Vec<Pitch>, Wrong> {
        let wrong = || {
            let help = "write pitch = \"Q\", or pitch = { I = \"mm\", J = \"per-inch\" }";
            self.wrong(said.span().start, "not a letter, and not letters with their units", help)
        };
        let letter = |text: &str| match text.as_bytes() {
            [letter @ b'A'..=b'Z'] => Ok(*letter),
            _ => Err(wrong()),
        };
        match said.get_ref() {
            toml::Value::String(text) => Ok(vec![Pitch { letter: letter(text)?, unit: PitchUnit::Turn }]),
            toml::Value::Table(units) => {
                let pitch = |(name, unit): (&String, &toml::Value)| {
                    let unit = unit.clone().try_into().map_err(|_| wrong())?;
                    Ok(Pitch { letter: letter(name)?, unit })
                };
                units.iter().map(pitch).collect()
            }
            _ => Err(wrong()),
        }
    }

    /// Reads the holes that a cycle makes.
    fn holes(&self, text: &Spanned<String>) -> Result<Vec<Hole>, Wrong> {
        let parse = |word: &str| {
            Hole::parse(word).ok_or_else(|| {
                let near = did_you_mean_one_of(word, Hole::ALL.iter().map(|hole| hole.name()));
                self.wrong(text.span().start, format!("`{word}` is not a kind of hole"), near)
            })
        };
        text.get_ref().split_ascii_whitespace().map(parse).collect()
    }

    fn rows(&self, codes: &BTreeMap<Spanned<String>, RowText>, rows: &mut Rows) -> Result<(), Wrong> {
        for (key, row) in codes {
            let Some(parsed) = Key::parse(key.get_ref()) else {
                let message = format!("`{}` is not a code", key.get_ref());
                return Err(self.wrong(
                    key.span().start,
                    message,
                    "write G154, G59.1 or G110-G129; `G31.*` is all codes from G31 to G31.9, `M*` is all other M codes",
                ));
            };
            if row.is.get_ref() == ABSENT {
                rows.remove(parsed);
                continue;
            }
            let Some(meaning) = Meaning::parse(row.is.get_ref()) else {
                let names = Meaning::ALL.iter().map(|meaning| meaning.name());
                let near = did_you_mean_one_of(row.is.get_ref(), names);
                let message = format!("`{}` is not a meaning of a code", row.is.get_ref());
                return Err(self.wrong(row.is.span().start, message, near));
            };
            if meaning == Meaning::Cycle && row.makes.is_none() && row.not_run.is_none() {
                let message = format!("`{}` is a cycle, but its kind of hole is missing", key.get_ref());
                let names: Vec<&str> = Hole::ALL.iter().map(|hole| hole.name()).collect();
                let help = format!("write makes = \"drill\"; the holes are {}", names.join(", "));
                return Err(self.wrong(row.is.span().start, message, help));
            }
            let words = row.words.as_ref().map_or(Ok(Words::NONE), |words| self.words(words))?;
            let makes = row.makes.as_ref().map_or(Ok(Vec::new()), |makes| self.holes(makes))?;
            let pitch = row.pitch.as_ref().map_or(Ok(Vec::new()), |pitch| self.pitch(pitch))?;
            let (code, text) = (Code { letter: b'G', tenths: 0 }, row.text.clone().unwrap_or_default());
            let only = row.only.as_ref().map_or(Ok(Vec::new()), |only| self.values(only))?;
            let (not_run, stops_spindle) = (row.not_run.clone(), row.stops_spindle.unwrap_or(false));
            let runs = self.runs(row, meaning, &makes)?;
            let (work, tool) = (runs.work, runs.tool);
            let row = Row { code, meaning, words, makes, pitch, text, not_run, only, stops_spindle, runs };
            match parsed {
                Key::One(code) => rows.put(Row { code, ..row }),
                Key::Range(first, last) => {
                    for (count, tenths) in (0..).zip((first.tenths..=last.tenths).step_by(10)) {
                        let work = work.and_then(|first| first.after(count));
                        let tool = tool.and_then(|first| first.checked_add(count));
                        let runs = Runs { work, tool, ..row.runs.clone() };
                        rows.put(Row { code: Code { tenths, ..first }, runs, ..row.clone() });
                    }
                }
                Key::Number(letter, number) => {
                    rows.put_number(Row { code: Code { letter, tenths: number * 10 }, ..row })
                }
                Key::Letter(letter) => rows.put_others(Row { code: Code { letter, tenths: 0 }, ..row }),
            }
        }
        Ok(())
    }

    /// Reads those values of a row that only the simulator uses.
    fn runs(&self, row: &RowText, meaning: Meaning, makes: &[Hole]) -> Result<Runs, Wrong> {
        let of_another = |key: &str, at: usize, of: &str| {
            self.wrong(
                at,
                format!("`{key}` is only for {of}"),
                format!("the meaning of this row is `{}`: remove the key", meaning.name()),
            )
        };
        let motions = match &row.motions {
            None => only_motions(makes),
            Some(text) if meaning != Meaning::Cycle => return Err(of_another("motions", text.span().start, "cycles")),
            Some(text) => Some(Motions::parse(text.get_ref()).ok_or_else(|| {
                let near = did_you_mean_one_of(text.get_ref(), Motions::ALL.iter().map(|motions| motions.name()));
                self.wrong(text.span().start, format!("`{}` is not a kind of cycle motions", text.get_ref()), near)
            })?),
        };
        let work = match &row.work {
            None => None,
            Some(text) if meaning != Meaning::Work => {
                return Err(of_another("work", text.span().start, "work offsets"));
            }
            Some(text) => Some(WorkOffset::parse(text.get_ref()).ok_or_else(|| {
                let help =
                    "write \"G54\" to \"G59.3\" or \"G54.1 P1\" to \"G54.1 P99\"; if a word of the code gives the \
                     number, write the letter of this word, as \"P\"";
                self.wrong(text.span().start, format!("`{}` is not a work offset", text.get_ref()), help)
            })?),
        };
        let point = match &row.point {
            None => None,
            Some(at) if !matches!(meaning, Meaning::Reference | Meaning::SetReference) => {
                return Err(of_another("point", at.span().start, "reference points"));
            }
            Some(at) if !(1..=2).contains(at.get_ref()) => {
                return Err(self.wrong(
                    at.span().start,
                    "there are two reference points",
                    "write 1 for the point of G28, or 2 for the point of G30",
                ));
            }
            Some(at) => Some(*at.get_ref()),
        };
        let tool = match &row.tool {
            Some(at) if meaning != Meaning::ToolNumber => {
                return Err(of_another("tool", at.span().start, "codes with the meaning `tool-number`"));
            }
            tool => tool.as_ref().map(|at| *at.get_ref()),
        };
        let ends_length = match &row.ends_length {
            None => 0,
            Some(at) if !matches!(meaning, Meaning::Reference | Meaning::Machine) => {
                return Err(of_another("ends_length", at.span().start, "reference points and machine coordinates"));
            }
            Some(at) => match at.get_ref() {
                EndsLength::AlongZ => 0b100,
                EndsLength::Always => 0x3f,
            },
        };
        let beside_moves = match &row.beside_moves {
            Some(at) if meaning != Meaning::Harmless => {
                return Err(of_another("beside_moves", at.span().start, "harmless codes"));
            }
            beside => beside.as_ref().is_some_and(|beside| *beside.get_ref()),
        };
        let angle = match &row.angle {
            None => Words::NONE,
            Some(at) if meaning != Meaning::Orient => {
                return Err(of_another("angle", at.span().start, "codes that orient the spindle"));
            }
            Some(letters) => self.words(letters)?,
        };
        let speed_out = row.speed_out.as_ref().map(|letter| self.letter(letter)).transpose()?;
        let may_keep_length = match &row.may_keep_length {
            Some(at) if meaning != Meaning::Machine => {
                return Err(of_another("may_keep_length", at.span().start, "machine coordinates"));
            }
            keeps => keeps.as_ref().is_some_and(|keeps| *keeps.get_ref()),
        };
        let rigid = match &row.rigid {
            Some(at) if !motions.is_some_and(Motions::taps) => {
                return Err(of_another("rigid", at.span().start, "cycles that tap"));
            }
            rigid => rigid.as_ref().map(|at| *at.get_ref()),
        };
        let ended = |text: &Spanned<String>| {
            let message = format!("`{}` is not a code", text.get_ref());
            text.get_ref().parse::<Code>().map_err(|_| self.wrong(text.span().start, message, "write M126 or G43"))
        };
        let ends = row.ends.as_ref().map(ended).transpose()?;
        let (stops_rotary, by_diameter) = (row.stops_rotary, row.by_diameter);
        Ok(Runs {
            motions,
            work,
            point,
            speed_out,
            tool,
            beside_moves,
            ends_length,
            may_keep_length,
            stops_rotary,
            ends,
            angle,
            rigid,
            by_diameter,
        })
    }

    /// Reads words with their values, such as `P0 P10000`.
    fn values(&self, text: &Spanned<String>) -> Result<Vec<(u8, f64)>, Wrong> {
        let parse = |word: &str| {
            let letter = word.bytes().next().filter(u8::is_ascii_uppercase)?;
            Some((letter, word[1..].parse::<f64>().ok().filter(|value| value.is_finite())?))
        };
        let values = text.get_ref().split_ascii_whitespace().map(|word| {
            let message = || format!("`{}` is not a word with a value", word.escape_default());
            parse(word)
                .ok_or_else(|| self.wrong(text.span().start, message(), "write words with values, as \"P0 P10000\""))
        });
        values.collect()
    }

    fn words(&self, words: &Spanned<String>) -> Result<Words, Wrong> {
        match words.get_ref().bytes().find(|letter| !letter.is_ascii_uppercase()) {
            None => Ok(Words::of(words.get_ref())),
            Some(letter) => {
                let message = format!("`{}` is not a letter of a word", char::from(letter).escape_default());
                Err(self.wrong(words.span().start, message, "write only letters, as \"PQR\""))
            }
        }
    }

    fn wrong(&self, at: usize, message: impl Into<String>, help: impl Into<String>) -> Wrong {
        Wrong::at(self.name, self.text, at, message, help)
    }
}

/// The motions of a cycle, if the kind of its holes allows only one kind of motions. `None`: the file must define the
/// motions, for example for bores.
fn only_motions(makes: &[Hole]) -> Option<Motions> {
    match makes {
        [Hole::Drill] => Some(Motions::Drill),
        [Hole::Peck] => Some(Motions::Peck),
        [Hole::Chipbreak] => Some(Motions::Chipbreak),
        [Hole::Tap] => Some(Motions::Tap),
        [Hole::LeftTap] => Some(Motions::LeftTap),
        [Hole::Back] => Some(Motions::Back),
        _ => None,
    }
}
