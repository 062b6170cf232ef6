//! The printer: joins words to blocks, numbers and ends them, and keeps the source map and the notes.

use std::ops::Range;

use super::fault::Done;
use super::layout::Layout;
use super::numbers::{as_number, units_of, unprintable};
use crate::compile::{Letter, LetterTable};
use crate::diag::{Code, Diag};
use crate::number::{Lead, LetterFormat, Unprintable, write_number};
use crate::sema::{SequenceNumbers, Settings};
use crate::span::Span;
use crate::toolpath::Place;

/// Origin of an output line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TraceLine {
    /// Line of the program, from 1.
    pub line: u64,
    /// Line of the form; `None` when the block was generated.
    pub form: Option<Span>,
    /// Item of the job.
    pub place: Place,
}

/// Output of a word of the form in one block.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TraceWord {
    /// Line of the program, from 1.
    pub line: u64,
    /// The word of the form.
    pub form: Span,
    /// The text of the word; empty if the word was left out because the control already had its value.
    pub text: String,
}

/// A block that is longer than its control reads.
#[derive(Clone, Copy, Debug)]
struct TooLong {
    /// Length of the block, as far as it was printed.
    length: usize,
    /// Maximum block length of the control.
    most: usize,
    /// The `Replace` that made the block too long.
    replaced: Option<Span>,
}

/// The program as printed so far, and the block that is being printed.
#[derive(Debug)]
pub struct Printer {
    layout: Layout,
    /// Current item of the job.
    pub place: Place,
    page: Page,
    /// Where the open block begins in the text.
    start: usize,
    words: usize,
    numbered: bool,
    next_number: i64,
    first_done: bool,
    /// Parts of the open block that `Replace` must not change.
    kept: Vec<Range<usize>>,
    too_long: Option<TooLong>,
    notes: Vec<Diag>,
}

/// Text with its source map: the program itself, or text that is stored until the program reaches the position of the
/// text.
#[derive(Debug, Default)]
pub struct Page {
    /// Finished blocks and the open one. The caller takes the finished blocks.
    pub text: Vec<u8>,
    /// Blocks printed so far.
    pub lines: u64,
    /// The source map, if requested.
    pub trace: Option<Vec<TraceLine>>,
    /// Output of the form's words, if requested.
    pub words: Option<Vec<TraceWord>>,
}

impl Printer {
    /// An empty printer. The number of the first block is the number that the form sets.
    pub fn new(settings: &Settings, letters: &LetterTable, trace: bool, words: bool) -> Printer {
        let layout = Layout::new(settings, letters);
        Printer {
            place: Place::default(),
            page: Page {
                text: Vec::with_capacity(128 * 1024),
                lines: 0,
                trace: trace.then(Vec::new),
                words: words.then(Vec::new),
            },
            start: 0,
            words: 0,
            numbered: false,
            next_number: layout.start,
            first_done: false,
            kept: Vec::new(),
            too_long: None,
            notes: Vec::new(),
            layout,
        }
    }

    /// Sets the letters once the job's units are known, because their formats depend on the units.
    pub fn set_letters(&mut self, settings: &Settings, letters: &LetterTable) {
        self.layout = Layout::new(settings, letters);
    }

    /// The current page.
    pub fn page(&mut self) -> &mut Page {
        &mut self.page
    }

    /// Swaps the current page with another one.
    pub fn turn_to(&mut self, page: &mut Page) {
        if self.page.trace.is_some() {
            page.trace.get_or_insert_default();
        }
        if self.page.words.is_some() {
            page.words.get_or_insert_default();
        }
        std::mem::swap(&mut self.page, page);
    }

    /// Appends a stored page.
    pub fn append(&mut self, aside: Page) {
        let before = self.page.lines;
        self.page.text.extend_from_slice(&aside.text);
        self.page.lines += aside.lines;
        if let Some(trace) = &mut self.page.trace {
            let lines = aside.trace.into_iter().flatten();
            trace.extend(lines.map(|line| TraceLine { line: line.line + before, ..line }));
        }
        if let Some(words) = &mut self.page.words {
            words.extend(aside.words.into_iter().flatten().map(|word| TraceWord { line: word.line + before, ..word }));
        }
    }

    /// The end of the text so far, as the start for [`Printer::trace_word`]. `None`: words are not recorded.
    #[inline]
    pub fn mark(&self) -> Option<usize> {
        self.page.words.as_ref().map(|_| self.page.text.len())
    }

    /// Records a word of the form: its output is the text after the mark.
    #[cold]
    pub fn trace_word(&mut self, from: usize, form: Span) {
        let text = String::from_utf8_lossy(self.page.text.get(from..).unwrap_or(b""));
        let word = TraceWord { line: self.page.lines + 1, form, text: text.trim_start().to_owned() };
        self.page.words.get_or_insert_default().push(word);
    }

    /// Lines printed so far.
    pub fn lines(&self) -> u64 {
        self.page.lines
    }

    /// Adds a note on the current item; each kind of note is added once.
    pub fn note(&mut self, code: Code, message: String, help: &str) {
        self.note_at(code, message, help, None);
    }

    /// Adds a note on the current item and a line of the form.
    pub fn note_at(&mut self, code: Code, message: String, help: &str, form: Option<Span>) {
        if !self.notes.iter().any(|n| n.code == code && n.message == message) && self.notes.len() < 100 {
            let diag = Diag::new(code, message).help(help).place(self.place);
            self.notes.push(match form {
                Some(span) => diag.at(span, "printed from here"),
                None => diag,
            });
        }
    }

    /// The notes so far.
    pub fn notes(&self) -> &[Diag] {
        &self.notes
    }

    /// Checks that every block so far is short enough for the control.
    #[inline]
    pub fn blocks_fit(&self) -> Done {
        self.too_long.map_or(Ok(()), too_long)
    }

    /// Prints a value in units of its letter's last decimal. If the value does not fit its format, the open block is
    /// discarded.
    #[inline]
    pub fn letter(&mut self, info: &Letter, units: i64, glued: bool) -> Done {
        let mut lead = Lead::default();
        if self.begins_word(glued) {
            lead.push(b' ');
        }
        if !info.dummy {
            lead.push(info.printed);
        }
        // a block number that exceeds its width starts again at its first value; for all other letters, such a value is
        // an error
        match info.printing.write(&mut self.page.text, lead, units, self.layout.leading_zeros) {
            Ok(()) => Ok(()),
            Err(why) => self.not_written(why, info, units),
        }
    }

    #[cold]
    fn not_written(&mut self, why: Unprintable, info: &Letter, units: i64) -> Done {
        self.clear_block();
        let value = as_number(units, info.format.dec.count);
        unprintable(why, &char::from(info.printed).to_string(), value, &info.format)
    }

    /// Prints a value without a letter.
    pub fn bare(&mut self, value: f64, format: &LetterFormat, glued: bool) -> Done {
        let units = units_of(value, format, "the value")?;
        let leading = self.layout.leading_zeros;
        match write_number(self.word(glued), units, format, leading) {
            Ok(()) => Ok(()),
            Err(why) => unprintable(why, "the value", value, format),
        }
    }

    /// Prints a text as a word.
    pub fn text(&mut self, text: &str, glued: bool) {
        self.word(glued).extend_from_slice(text.as_bytes());
    }

    /// Ends a generated block, which has no line in the form.
    #[inline]
    pub fn end_block(&mut self) {
        self.finish(true, None);
    }

    /// The open block, for appending a word. A space or column comes first unless the word is `glued` to the previous one.
    #[inline]
    pub fn word(&mut self, glued: bool) -> &mut Vec<u8> {
        if self.begins_word(glued) {
            self.page.text.push(b' ');
        }
        &mut self.page.text
    }

    /// Begins a word in the open block. Returns whether the caller must print a space before the word.
    #[inline]
    fn begins_word(&mut self, glued: bool) -> bool {
        let before = self.words;
        if before == 0 {
            self.start = self.page.text.len();
        } else if glued {
            return false;
        }
        self.words += 1;
        let blank = self.layout.blanks && before > 0;
        if self.layout.columns.is_empty() {
            return blank;
        }
        if blank {
            self.page.text.push(b' ');
        }
        self.pad(before);
        false
    }

    /// Moves to the column of the next word, after this number of words.
    #[cold]
    fn pad(&mut self, words: usize) {
        let column = match self.layout.columns.as_slice() {
            [width] => words * width,
            columns => columns.get(words).map_or(0, |column| column - 1),
        };
        while self.page.text.len() < self.start + column {
            self.page.text.push(b' ');
        }
    }

    /// Discards the open block, because one of its words could not be printed.
    pub fn clear_block(&mut self) {
        if self.words > 0 {
            self.page.text.truncate(self.start);
        }
        self.words = 0;
        self.numbered = false;
        self.kept.clear();
    }

    /// Prints text that `Replace` must not change.
    pub fn quote(&mut self, text: &str, glued: bool) {
        self.word(glued);
        let from = self.length();
        self.page.text.extend_from_slice(text.as_bytes());
        if !self.layout.replace.is_empty() {
            self.kept.push(from..self.length());
        }
    }

    /// The length of the open block so far.
    pub fn length(&self) -> usize {
        if self.words > 0 { self.page.text.len() - self.start } else { 0 }
    }

    /// The text of the open block.
    fn block(&self) -> &[u8] {
        &self.page.text[self.page.text.len() - self.length()..]
    }

    /// The text of the open block after its first `length` bytes.
    pub fn block_from(&self, length: usize) -> &[u8] {
        self.page.text.get(self.start + length..).unwrap_or_default()
    }

    /// Whether the open block ends inside round brackets.
    pub fn is_in_brackets(&self) -> bool {
        self.block().iter().rev().find(|c| b"()".contains(c)) == Some(&b'(')
    }

    /// Whether the open block ends between quotation marks.
    pub fn is_in_quotes(&self) -> bool {
        self.block().iter().filter(|&&c| c == b'"').count() % 2 == 1
    }

    /// Whether a block is open.
    #[inline]
    pub fn has_words(&self) -> bool {
        self.words > 0
    }

    /// The number of the open block.
    pub fn number(&self) -> i64 {
        self.next_number
    }

    /// Sets the number of the next block.
    pub fn set_number(&mut self, number: i64) {
        self.next_number = number;
    }

    /// Records that the open block prints its own number.
    pub fn prints_number(&mut self) {
        self.numbered = true;
    }

    /// Ends the open block. An empty block is not printed. `number`: the block may have a block number.
    #[inline]
    pub fn finish(&mut self, number: bool, form: Option<Span>) {
        if self.words == 0 {
            return;
        }
        if self.layout.number_letter.is_some() && !self.numbered && number && !is_frame(&self.page.text[self.start..]) {
            if self.first_done || self.layout.number_first {
                self.insert_number();
                self.numbered = true;
            }
            self.first_done = true;
        }
        if self.numbered {
            self.next_number += self.layout.step;
            if self.next_number > self.layout.largest {
                self.next_number = self.layout.start;
            }
        }
        if !self.layout.replace.is_empty() {
            self.replace();
        }
        if !self.layout.eob.is_empty() {
            self.page.text.extend_from_slice(&self.layout.eob);
        }
        self.fits(None);
        if self.layout.carriage_return {
            self.page.text.push(b'\r');
        }
        self.page.text.push(b'\n');
        self.page.lines += 1;
        if let Some(trace) = &mut self.page.trace {
            trace.push(TraceLine { line: self.page.lines, form, place: self.place });
        }
        self.words = 0;
        self.numbered = false;
    }

    /// The position of the block number: the beginning of the block, or after the slash of block delete. A number without
    /// a letter stays before the slash, because a slash and a number are a switch for block delete.
    fn number_start(&self, bare: bool) -> usize {
        match self.block() {
            [b'/', rest @ ..] if !bare => {
                let switch = usize::from(rest.first().is_some_and(u8::is_ascii_digit));
                let blanks = rest[switch..].iter().take_while(|&&byte| byte == b' ').count();
                self.start + 1 + switch + blanks
            }
            _ => self.start,
        }
    }

    /// Inserts the block number. The number is inserted last, because the block may print a number of its own.
    fn insert_number(&mut self) {
        let mut prefix = [b' '; 24];
        let bare = self.layout.number_letter == Some(SequenceNumbers::BARE);
        let mut at = prefix.len() - usize::from(self.layout.blanks || bare);
        let (end, mut rest) = (at, self.next_number);
        while rest > 0 || end - at < self.layout.width {
            at -= 1;
            prefix[at] = b'0' + (rest % 10) as u8;
            rest /= 10;
        }
        if let Some(letter) = self.layout.number_letter.filter(|_| !bare) {
            at -= 1;
            prefix[at] = letter;
        }
        let (start, length, shift) = (self.number_start(bare), self.page.text.len(), prefix.len() - at);
        let moved = |at: usize| if at < start - self.start { at } else { at + shift };
        self.kept.iter_mut().for_each(|kept| *kept = moved(kept.start)..kept.end + shift);
        self.page.text.extend_from_slice(&prefix[at..]); // reserves the space for the shift
        self.page.text.copy_within(start..length, start + shift);
        self.page.text[start..start + shift].copy_from_slice(&prefix[at..]);
    }

    #[cold]
    fn replace(&mut self) {
        let rows = std::mem::take(&mut self.layout.replace);
        _ = rows.iter().try_for_each(|row| self.replace_by(row));
        self.layout.replace = rows;
        self.kept.clear();
    }

    /// Applies one `Replace`; `None` if the block has become too long.
    fn replace_by(&mut self, (old, new, span): &(Vec<u8>, Vec<u8>, Span)) -> Option<()> {
        if memchr::memmem::find(&self.page.text[self.start..], old).is_none() {
            return Some(());
        }
        let block = self.page.text.split_off(self.start);
        let mut from = 0;
        for kept in std::mem::take(&mut self.kept).into_iter().chain(std::iter::once(block.len()..block.len())) {
            for at in memchr::memmem::find_iter(&block[from..kept.start], old).map(|at| from + at).collect::<Vec<_>>() {
                self.page.text.extend_from_slice(&block[from..at]);
                self.page.text.extend_from_slice(new);
                from = at + old.len();
                // each row may double the block, so postform stops at the first row that makes the block too long
                if !self.fits(Some(*span)) {
                    return None;
                }
            }
            self.page.text.extend_from_slice(&block[from..kept.start]);
            let begin = self.length();
            self.page.text.extend_from_slice(&block[kept.clone()]);
            if !kept.is_empty() {
                self.kept.push(begin..self.length());
            }
            from = kept.end;
        }
        Some(())
    }

    /// Whether the open block is longer than the control accepts.
    #[inline]
    pub fn is_too_long(&self) -> bool {
        self.page.text.len() - self.start > self.layout.longest
    }

    /// Whether the open block is short enough for the control so far. The first block that is too long is recorded.
    #[inline]
    fn fits(&mut self, replaced: Option<Span>) -> bool {
        let length = self.page.text.len() - self.start;
        if length > self.layout.longest && self.too_long.is_none() {
            self.too_long = Some(TooLong { length, most: self.layout.longest, replaced });
        }
        length <= self.layout.longest
    }
}

/// `%` and O lines are the frame of a program and are never numbered.
fn is_frame(block: &[u8]) -> bool {
    matches!(block, [b'%' | b':', ..]) || matches!(block, [b'O' | b'o', digit, ..] if digit.is_ascii_digit())
}

#[cold]
fn too_long(block: TooLong) -> Done {
    let TooLong { length, most, replaced } = block;
    let diag = Diag::new(Code::PR027, format!("a block of {length} characters, but the control reads only {most}"));
    Err(Box::new(match replaced {
        Some(span) => diag
            .at(span, "this makes the block too long")
            .help("remove this Replace: a later Replace replaces its new text again"),
        None => diag.help("split it into several blocks, or shorten its comment"),
    }))
}
