//! Reads a CL file: joins lines to statements and executes the statements in order.

use std::io::Read;

use super::cycle;
use super::fault::{Done, fault};
use super::feed_unit::Feed;
use super::job::Job;
use super::lines::{LONGEST, Lines, text_statement, without_comment};
use super::machine::no_cutcom_waits;
use super::majors::{Major, major, run};
use super::motion::{goto, goto_words};
use super::options::Options;
use super::report::Report;
use super::setup::{Setup, Setups};
use super::state::{Arcs, Cycle, Feeds, Motion, State};
use super::texts::{Insert, lone_insert, text};
use super::words::{LINE_END, Word, plain_goto, words};
use crate::diag::Code;
use crate::source::text_of;
use crate::toolpath::{Event, Flow, Place, ReadError, Sink, Stop};

/// Number of lines that are searched for the CAM system.
const HEAD: usize = 50;

/// The state of reading a file.
struct Reader<'s> {
    state: State<'s>,
    /// The text of the current statement so far.
    joined: Vec<u8>,
    /// Whether the statement continues on the next line.
    continues: bool,
    /// The last major word. Lines that contain only numbers continue the statement of the last major word.
    major: Major,
    /// Whether FINI or END was read.
    ended: bool,
    insert: Insert,
    /// Whether the file counts as complete, whatever its last statement is.
    whole: bool,
}

/// Reads a CL file and pushes its events. Memory use does not grow with the file.
///
/// # Errors
/// The file has an error, or the sink refused an event. The error has its location. Warnings before the error are in
/// the report.
pub fn read_cl(input: impl Read, options: &Options, report: &mut Report, sink: &mut dyn Sink) -> Result<(), ReadError> {
    read(input, options, options.setup.map(|setup| Setups::new(Some(setup))), report, sink).map(drop)
}

/// Lists the setups of a file. A setup is a sequence of motions with one tool axis. Other statements are not checked.
///
/// # Errors
/// The input can't be read, or a line is not a statement.
pub fn setups(input: impl Read, options: &Options) -> Result<Vec<Setup>, ReadError> {
    struct Nothing;
    impl Sink for Nothing {
        fn event(&mut self, _: Event<'_>, _: Place) -> Flow {
            Flow::Continue(())
        }
    }
    let found = read(input, options, Some(Setups::new(None)), &mut Report::default(), &mut Nothing)?;
    Ok(found.map_or_else(Vec::new, |setups| setups.found().to_vec()))
}

/// Reads a whole file, or one of its setups.
fn read(
    input: impl Read,
    options: &Options,
    setups: Option<Setups>,
    report: &mut Report,
    sink: &mut dyn Sink,
) -> Result<Option<Setups>, ReadError> {
    let mut lines = Lines::new(input);
    let mut job = Job::new(options, report, sink);
    job.aside = setups.as_ref().is_some_and(|setups| !setups.is_chosen());
    job.notes.look_at(lines.ahead(HEAD).map_err(ReadError::Io)?);
    let mut reader = Reader {
        state: State {
            job,
            motion: Motion { position: options.start, ..Motion::default() },
            arcs: Arcs::default(),
            feeds: Feeds { feed: options.feed.map(Feed::Minute), cut_off: None },
            cycle: Cycle::default(),
            setups,
        },
        joined: Vec::new(),
        continues: false,
        major: Major::None,
        ended: false,
        insert: None,
        whole: options.end,
    };
    let mut number = 0;
    while let Some(line) = lines.next().map_err(ReadError::Io)? {
        number += 1;
        if !reader.continues {
            reader.state.job.notes.place = Place { line: number, column: 1, ..Place::default() };
        }
        let line = if number == 1 { line.strip_prefix(b"\xef\xbb\xbf").unwrap_or(line) } else { line };
        let read = reader.line(line);
        read.map_err(|stop| reader.placed(stop))?;
    }
    let end = reader.finish();
    end.map_err(|stop| reader.placed(stop))?;
    reader.state.job.notes.tell_unknown();
    Ok(reader.state.setups)
}

impl Reader<'_> {
    /// Reads a line of the file: a statement, a part of a statement, or a comment.
    #[inline]
    fn line(&mut self, line: &[u8]) -> Done {
        if !self.continues
            && self.state.job.has_started()
            && !self.ended
            && let Some((values, count)) = plain_goto(line)
        {
            self.major = Major::Goto;
            return goto(&values[..count], &mut self.state);
        }
        self.other_line(line)
    }

    fn other_line(&mut self, line: &[u8]) -> Done {
        if line.len() + self.joined.len() > LONGEST {
            return fault(Code::PL001, "a statement longer than 1 MB", "check that this is a CL file");
        }
        let line = line.trim_ascii();
        if line.starts_with(b"\xff\xfe") || line.starts_with(b"\xfe\xff") {
            return fault(Code::PL001, "the file is UTF-16", "save it as plain text (ASCII or UTF-8)");
        }
        if line.contains(&b'\r') {
            let help = "save the file with LF or CRLF line ends";
            return fault(Code::PL001, "the lines end only with carriage returns", help);
        }
        if self.ended && line == b"\x1a" {
            return Ok(()); // the end-of-file character of DOS
        }
        let mut line = line;
        if !self.continues {
            if let Some(data) = line.strip_prefix(b"$$->") {
                // Creo stores data in comments; the name `$DATA` can't occur in a real statement
                self.joined.extend_from_slice(b"$DATA/");
                line = data;
            } else if line.starts_with(b"$$*") {
                return Ok(());
            } else if let Some((word, said)) = text_statement(line) {
                let said = text_of(said.strip_suffix(b"~").unwrap_or(said)).into_owned();
                return if self.ended { Ok(()) } else { text(word, said, &mut self.insert, &mut self.state.job) };
            }
        }
        let (part, goes_on) = without_comment(line);
        self.joined.extend_from_slice(part.strip_suffix(b"~").unwrap_or(part));
        self.continues = goes_on || part.ends_with(b"~");
        if self.continues {
            self.joined.push(LINE_END);
            return Ok(());
        }
        let text = std::mem::take(&mut self.joined);
        let read = if text.trim_ascii().is_empty() { Ok(()) } else { self.statement(&text) };
        self.joined = text;
        self.joined.clear();
        read
    }

    fn statement(&mut self, text: &[u8]) -> Done {
        if let Some(bad) = text.iter().find(|b| !b.is_ascii() || (b.is_ascii_control() && !b.is_ascii_whitespace())) {
            let message = format!("a byte that can't be in a statement: {bad:#04x}");
            return fault(Code::PL001, message, "check that this is a CL file");
        }
        let mut list = match words(text) {
            Ok(list) => list,
            Err(number) => return fault(Code::PL001, format!("`{number}` is not a number"), "fix the number"),
        };
        // PTED writes a number before each record, as `N27 , GOTO/..`
        let is_number = |w: &Word| w.name().and_then(|n| n.strip_prefix('N')).is_some_and(|n| n.parse::<u64>().is_ok());
        if list.len() > 1 && is_number(&list[0]) {
            list.remove(0);
        }
        let Some(first) = list.first() else { return Ok(()) };
        if self.ended {
            if first.is("FINI") {
                return Ok(()); // lines after END are ignored
            }
            return fault(
                Code::PL001,
                "a statement after FINI or END",
                "remove it, or remove the FINI or END before it",
            );
        }
        let Some(name) = first.name().map(str::to_owned) else {
            whole_numbers(&list)?;
            // UG writes several points after one GOTO, and some of its records continue without `$`
            return match self.major {
                Major::Goto => goto_words(&list, &mut self.state),
                Major::Cutter | Major::Data => Ok(()),
                _ => {
                    let help = "put GOTO/ before them, or `$` at the end of the line before";
                    fault(Code::PL001, "numbers without a statement", help)
                }
            };
        };
        let name = unnumbered(&name).to_owned();
        list.remove(0);
        self.major = major(&name);
        if !self.major.takes_no_number() {
            whole_numbers(&list)?;
        }
        if ends_with_comma(&list) && !self.major.may_end_with_comma() {
            let help = "put `$` after the comma if the statement continues on the next line, or remove the comma";
            return fault(Code::PL001, format!("{name} ends with a comma: a part of it may be missing"), help);
        }
        self.ended = self.major == Major::Fini;
        if self.major == Major::Cutter {
            self.insert = None; // the INSERT before this statement described the tool
        } else {
            lone_insert(&mut self.insert, &mut self.state.job.notes);
        }
        run(self.major, &name, &list, &mut self.state)
    }

    /// Handles the end of the file.
    fn finish(&mut self) -> Done {
        if self.continues || self.state.arcs.pending.is_some() {
            return fault(Code::PL007, "the file ends inside a statement", "get the complete file");
        }
        let dialect = self.state.job.notes.dialect();
        let ends = self.whole || self.ended || self.major == Major::EndOfPath || dialect.last_statement().is_none();
        if !ends {
            let last = dialect.last_statement().unwrap_or("FINI");
            let message = format!("the file ends without {last}: it may be incomplete");
            let help =
                format!("get the complete file; if it is complete, put {last} at its end, or give `--assume-end`");
            return fault(Code::PL007, message, help);
        }
        cycle::end(&mut self.state.cycle, &mut self.state.job)?;
        no_cutcom_waits(&self.state.motion.cutcom, "the end of the file")?;
        match &self.state.setups {
            Some(setups) => setups.end(&mut self.state.job),
            None => self.state.job.finish(),
        }
    }

    fn placed(&self, stop: Stop) -> ReadError {
        let mut stop = stop.placed(|| self.state.job.notes.place.into());
        if let Stop::Wrong(diag) = &mut stop {
            let notes = &self.state.job.notes;
            let help = diag.help.take().unwrap_or_default() + &notes.early(diag) + &notes.ignored();
            diag.help = Some(help).filter(|help| !help.is_empty());
        }
        stop.into()
    }
}

/// Checks that no number has blanks inside.
fn whole_numbers(words: &[Word]) -> Done {
    let Some(text) = words.iter().find_map(Word::parted) else { return Ok(()) };
    let (one, two) = (text.replace(' ', ""), text.replace(' ', ","));
    let help = format!(
        "if it is one number, write {one}; if a comma is missing, write {two}; if the last digits are the number of a punched \
         card (columns 73 to 80), remove the card numbers"
    );
    fault(Code::PL001, format!("a number with blanks inside: `{text}`"), help)
}

/// Whether one comma ends the statement. Several commas are empty fields, which CATIA writes.
fn ends_with_comma(words: &[Word]) -> bool {
    matches!(words, [.., last, Word::Null] if *last != Word::Null)
}

/// A major word without the record number before it, as in `N29 GOTO` or `100 GOTO`.
fn unnumbered(name: &str) -> &str {
    let rest =
        name.strip_prefix('N').unwrap_or(name).trim_start_matches(|c: char| c.is_ascii_digit()).trim_start_matches(')');
    if major(name) == Major::Unknown && major(rest) != Major::Unknown { rest } else { name }
}
