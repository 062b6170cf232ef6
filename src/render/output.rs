//! Blocks: words joined, numbered, ended, and appended to the output.

use crate::control::Control;
use crate::sema::{Replacement, Settings};
use crate::span::Span;
use crate::toolpath::Place;

/// Longest block of a control that takes long ones; they read from 80 characters to a few hundred.
const LONGEST: usize = 4096;

/// Where an output line came from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TraceLine {
    /// Line of the program, from 1.
    pub line: u64,
    /// Line of the form; `None` when the block was generated.
    pub form: Option<Span>,
    /// Item of the job.
    pub place: Place,
}

/// A block that its control does not read.
#[derive(Clone, Copy, Debug)]
pub struct TooLong {
    /// Its length, as far as it was made.
    pub length: usize,
    /// The longest that the control reads.
    pub most: usize,
    /// The `Replace` that made it too long.
    pub replaced: Option<Span>,
}

/// The block being built and the output so far.
#[derive(Debug)]
pub struct Output {
    /// Finished blocks; the caller takes them.
    pub text: Vec<u8>,
    /// Where the open block begins in it.
    start: usize,
    words: usize,
    numbered: bool,
    next_number: i64,
    first_done: bool,
    /// Blocks printed so far.
    pub lines: u64,
    /// The source map, when asked for.
    pub trace: Option<Vec<TraceLine>>,
    /// The first block that was too long.
    pub too_long: Option<TooLong>,
}

/// How blocks look, taken from the settings once.
#[derive(Debug)]
pub struct Layout {
    blanks: bool,
    columns: Vec<usize>,
    replace: Vec<(Vec<u8>, Vec<u8>, Span)>,
    longest: usize,
    eob: Vec<u8>,
    number_letter: Option<u8>,
    start: i64,
    step: i64,
    largest: i64,
    width: usize,
    number_first: bool,
}

impl Layout {
    /// `width` is the number of digits of a block number's format, `fixed` whether they are padded.
    pub fn new(settings: &Settings, width: u8, fixed: bool) -> Layout {
        let bytes = |row: &Replacement| (row.old.clone().into_bytes(), row.new.clone().into_bytes(), row.span);
        // what a sender cuts is no reason to print nothing
        let control = Control::named(&settings.control).filter(|control| control.stops_at_longer());
        Layout {
            blanks: settings.blanks,
            columns: settings.columns.clone(),
            replace: settings.replace.iter().map(bytes).collect(),
            longest: control.and_then(Control::longest_line).unwrap_or(LONGEST),
            eob: settings.eob.clone().into_bytes(),
            number_letter: settings.numbers.letter,
            start: settings.numbers.start,
            step: settings.numbers.step,
            largest: crate::number::POWERS[usize::from(width.min(18))] - 1,
            width: if fixed { usize::from(width) } else { 1 },
            number_first: settings.number_first,
        }
    }
}

impl Output {
    /// Empty; the first block number is the layout's start.
    pub fn new(layout: &Layout, trace: bool) -> Output {
        Output {
            text: Vec::with_capacity(128 * 1024),
            start: 0,
            words: 0,
            numbered: false,
            next_number: layout.start,
            first_done: false,
            lines: 0,
            trace: trace.then(Vec::new),
            too_long: None,
        }
    }

    /// The open block, to append a word to. A blank or column comes first, unless the word sticks to the one before.
    #[inline]
    pub fn word(&mut self, layout: &Layout, glued: bool) -> &mut Vec<u8> {
        if !glued || self.words == 0 {
            if self.words == 0 {
                self.start = self.text.len();
            } else if layout.blanks {
                self.text.push(b' ');
            }
            if !layout.columns.is_empty() {
                self.pad(layout);
            }
            self.words += 1;
        }
        &mut self.text
    }

    #[cold]
    fn pad(&mut self, layout: &Layout) {
        let column = match layout.columns.as_slice() {
            [width] => self.words * width,
            columns => columns.get(self.words).map_or(0, |column| column - 1),
        };
        while self.text.len() < self.start + column {
            self.text.push(b' ');
        }
    }

    /// Takes the open block back: a word of it could not be printed.
    pub fn clear_block(&mut self) {
        if self.words > 0 {
            self.text.truncate(self.start);
        }
        self.words = 0;
        self.numbered = false;
    }

    /// Is a block open?
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

    /// The open block prints its number itself.
    pub fn prints_number(&mut self) {
        self.numbered = true;
    }

    /// Ends the open block. An empty one is not printed. `number`: it may have a block number.
    #[inline]
    pub fn finish(&mut self, layout: &Layout, number: bool, form: Option<Span>, place: Place) {
        if self.words == 0 {
            return;
        }
        if layout.number_letter.is_some() && !self.numbered && number && !is_frame(&self.text[self.start..]) {
            if self.first_done || layout.number_first {
                self.insert_number(layout);
                self.numbered = true;
            }
            self.first_done = true;
        }
        if self.numbered {
            self.next_number += layout.step;
            if self.next_number > layout.largest {
                self.next_number = layout.start;
            }
        }
        if !layout.replace.is_empty() {
            self.replace(layout);
        }
        if !layout.eob.is_empty() {
            self.text.extend_from_slice(&layout.eob);
        }
        self.fits(layout, None);
        self.text.push(b'\n');
        self.lines += 1;
        if let Some(trace) = &mut self.trace {
            trace.push(TraceLine { line: self.lines, form, place });
        }
        self.words = 0;
        self.numbered = false;
    }

    /// Puts the number before the block: only now is it known that it has none of its own.
    fn insert_number(&mut self, layout: &Layout) {
        let mut prefix = [b' '; 24];
        let mut at = prefix.len() - usize::from(layout.blanks);
        let (end, mut rest) = (at, self.next_number);
        while rest > 0 || end - at < layout.width {
            at -= 1;
            prefix[at] = b'0' + (rest % 10) as u8;
            rest /= 10;
        }
        if let Some(letter) = layout.number_letter {
            at -= 1;
            prefix[at] = letter;
        }
        let (length, shift) = (self.text.len(), prefix.len() - at);
        self.text.extend_from_slice(&prefix[at..]); // as many bytes as are needed
        self.text.copy_within(self.start..length, self.start + shift);
        self.text[self.start..self.start + shift].copy_from_slice(&prefix[at..]);
    }

    #[cold]
    fn replace(&mut self, layout: &Layout) {
        for (old, new, span) in &layout.replace {
            if memchr::memmem::find(&self.text[self.start..], old).is_none() {
                continue;
            }
            let block = self.text.split_off(self.start);
            let mut from = 0;
            for at in memchr::memmem::find_iter(&block, old) {
                self.text.extend_from_slice(&block[from..at]);
                self.text.extend_from_slice(new);
                from = at + old.len();
                // each row may double the block: the first that makes it too long is the last
                if !self.fits(layout, Some(*span)) {
                    return;
                }
            }
            self.text.extend_from_slice(&block[from..]);
        }
    }

    /// Is the open block longer than its control reads?
    #[inline]
    pub fn is_too_long(&self, layout: &Layout) -> bool {
        self.text.len() - self.start > layout.longest
    }

    /// Is the open block, as far as it is made, one that the control reads? The first that is not is kept.
    #[inline]
    fn fits(&mut self, layout: &Layout, replaced: Option<Span>) -> bool {
        let length = self.text.len() - self.start;
        if length > layout.longest && self.too_long.is_none() {
            self.too_long = Some(TooLong { length, most: layout.longest, replaced });
        }
        length <= layout.longest
    }
}

/// `%` and O lines frame a program and are never numbered.
fn is_frame(block: &[u8]) -> bool {
    matches!(block, [b'%' | b':', ..]) || matches!(block, [b'O' | b'o', digit, ..] if digit.is_ascii_digit())
}
