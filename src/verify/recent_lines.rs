//! Keeps the texts of the last lines of a program, because findings show the block that was just run.

use crate::source::text_of;

/// Number of lines kept.
const KEPT: usize = 16;

/// A ring buffer of lines.
#[derive(Debug, Default)]
pub(super) struct Recent {
    lines: Vec<(u64, Vec<u8>)>,
    next: usize,
}

impl Recent {
    /// Keeps a line that was run. Its text is swapped with the text of the oldest line, so no memory is allocated.
    #[inline]
    pub fn keep(&mut self, line: u64, text: &mut Vec<u8>) {
        if self.lines.len() < KEPT {
            self.lines.push((line, std::mem::take(text)));
            return;
        }
        let slot = &mut self.lines[self.next];
        self.next = (self.next + 1) % KEPT;
        slot.0 = line;
        std::mem::swap(&mut slot.1, text);
    }

    /// The block number of a line's text as written: `N120`.
    pub fn number(text: &str) -> String {
        let digits: String = match text.strip_prefix(['N', 'n']) {
            Some(rest) => rest.chars().take_while(char::is_ascii_digit).collect(),
            None => String::new(),
        };
        if digits.is_empty() { digits } else { format!("N{digits}") }
    }

    /// Text of a line of the program, if the line is still kept.
    pub fn text(&self, line: u64) -> Option<String> {
        let (_, text) = self.lines.iter().find(|(number, _)| *number == line)?;
        Some(text_of(text).trim().to_owned())
    }
}
