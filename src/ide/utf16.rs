//! Positions as editors count them: the line, and the number of UTF-16 code units before the position in its line.
//! Lines and code units are counted from 0.

use crate::source::Source;
use crate::span::Span;

/// A position in a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Default)]
pub struct Place {
    /// Line, from 0.
    pub line: u32,
    /// Number of UTF-16 code units before the position in its line.
    pub character: u32,
}

/// The position of a byte. For a byte inside a character, the result is the position of this character.
pub fn place(source: &Source, at: u32) -> Place {
    let mut at = (at as usize).min(source.text.len());
    while !source.text.is_char_boundary(at) {
        at -= 1;
    }
    let line = source.line(at as u32);
    let start = source.line_starts()[line] as usize;
    let units: usize = source.text[start..at].chars().map(char::len_utf16).sum();
    Place { line: line as u32, character: units as u32 }
}

/// The byte at a position. A position after the end of its line counts as the end of the line. A position after the end
/// of the text counts as the end of the text.
pub fn offset(source: &Source, place: Place) -> u32 {
    let starts = source.line_starts();
    let Some(&start) = starts.get(place.line as usize) else { return source.text.len() as u32 };
    let end = starts.get(place.line as usize + 1).map_or(source.text.len(), |&next| next as usize);
    let line = source.text[start as usize..end].trim_end_matches(['\n', '\r']);
    let mut units = 0;
    for (at, c) in line.char_indices() {
        if units >= place.character {
            return start + at as u32;
        }
        units += c.len_utf16() as u32;
    }
    start + line.len() as u32
}

/// The start and end positions of a span.
pub fn range(source: &Source, span: Span) -> (Place, Place) {
    (place(source, span.start), place(source, span.end))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_go_there_and_back() {
        let source = Source::from_text("f", "aä😀b\r\nX[h]\n");
        for (at, line, character) in [(0, 0, 0), (1, 0, 1), (3, 0, 2), (7, 0, 4), (8, 0, 5), (10, 1, 0), (15, 2, 0)] {
            let there = Place { line, character };
            assert_eq!(place(&source, at), there, "{at}");
            assert_eq!(offset(&source, there), at, "{at}");
        }
        assert_eq!(place(&source, 5), Place { line: 0, character: 2 }, "inside a character");
        assert_eq!(offset(&source, Place { line: 0, character: 99 }), 8, "the line end is no part of the line");
        assert_eq!(offset(&source, Place { line: 9, character: 0 }), 15);
        assert_eq!(offset(&Source::from_text("f", ""), Place::default()), 0);
    }
}
