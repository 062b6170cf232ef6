//! The layout of blocks, from the form's settings.

use crate::compile::LetterTable;
use crate::sema::{LineEnd, Replacement, SequenceNumbers, Settings};
use crate::span::Span;

/// The limit of the block length for controls that accept long blocks. Other controls accept between 80 and a few
/// hundred characters.
pub const LONGEST: usize = 4096;

/// Layout of blocks, computed once from the settings.
#[derive(Debug)]
pub struct Layout {
    /// Words are separated by a blank.
    pub blanks: bool,
    /// Numbers below one print as `0.5`, not as `.5`.
    pub leading_zeros: bool,
    /// Columns of the words. A single value is the width of every column.
    pub columns: Vec<usize>,
    /// Texts to be replaced, their replacements, and the lines of the form.
    pub replace: Vec<(Vec<u8>, Vec<u8>, Span)>,
    /// Longest block that the control reads.
    pub longest: usize,
    /// Text at the end of each block.
    pub eob: Vec<u8>,
    /// Letter of block numbers.
    pub number_letter: Option<u8>,
    /// The first block number.
    pub start: i64,
    /// Step of block numbers.
    pub step: i64,
    /// The largest block number.
    pub largest: i64,
    /// Least number of digits of a block number.
    pub width: usize,
    /// The first block is numbered too.
    pub number_first: bool,
    /// Lines end with CR LF.
    pub carriage_return: bool,
}

impl Layout {
    /// The layout of a form. `letters` gives the format of block numbers.
    pub fn new(settings: &Settings, letters: &LetterTable) -> Layout {
        let own = settings.numbers.letter.filter(|&letter| letter != SequenceNumbers::BARE);
        let format = letters[own.unwrap_or(b'N')].format;
        let width = format.int.count;
        let bytes = |row: &Replacement| (row.old.clone().into_bytes(), row.new.clone().into_bytes(), row.span);
        // if the control only truncates long blocks, a long block is no error
        let control = settings.control().traits();
        Layout {
            blanks: settings.blanks,
            leading_zeros: settings.leading_zeros,
            columns: settings.columns.clone(),
            replace: settings.replace.iter().map(bytes).collect(),
            longest: control.longest_line.filter(|_| control.stops_at_longer).unwrap_or(LONGEST),
            eob: settings.eob.clone().into_bytes(),
            number_letter: settings.numbers.letter,
            start: settings.numbers.start,
            step: settings.numbers.step,
            largest: crate::number::POWERS[usize::from(width.min(18))] - 1,
            width: if format.int.fixed { usize::from(width) } else { 1 },
            number_first: settings.number_first,
            carriage_return: settings.line_end == LineEnd::CrLf,
        }
    }
}
