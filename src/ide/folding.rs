//! Parts of a form that an editor can fold.

use super::Document;
use crate::syntax::{Head, Tail};

/// A range of lines that an editor can fold. Lines are counted from 0; the line `last` is part of the range.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fold {
    /// The first line. It stays visible.
    pub first: u32,
    /// The last line.
    pub last: u32,
    /// Whether the folded lines are comments.
    pub comment: bool,
}

impl Document {
    /// The parts that can be folded: sequences, and comments of several lines.
    pub fn folding(&self, file: u32) -> Vec<Fold> {
        let Some(source) = self.files().get(file as usize) else { return Vec::new() };
        let line = |at: u32| source.line(at) as u32;
        let mut folds = Vec::new();
        let mut comments: Option<(u32, u32)> = None;
        let close = |comments: &mut Option<(u32, u32)>, folds: &mut Vec<Fold>| {
            if let Some((first, last)) = comments.take().filter(|(first, last)| last > first) {
                folds.push(Fold { first, last, comment: true });
            }
        };
        for item in self.items(file) {
            match item {
                Head::Blank(blank) if matches!(blank.tail, Tail::Comment(_)) => {
                    let here = line(blank.span.start);
                    comments = Some((comments.map_or(here, |(first, _)| first), here));
                }
                Head::Sequence(node) => {
                    close(&mut comments, &mut folds);
                    let span = node.span();
                    let (first, last) = (line(span.start), line(span.end));
                    if last > first {
                        folds.push(Fold { first, last, comment: false });
                    }
                }
                _ => close(&mut comments, &mut folds),
            }
        }
        close(&mut comments, &mut folds);
        folds
    }
}

#[cfg(test)]
mod tests {
    use super::super::document::tests::marked;
    use super::*;

    #[test]
    fn sequences_and_comments_fold() {
        let (document, _) = marked("# one\n# two\nMachine Mill\n# alone\nDrill\nG81\nEnd Cancel\nTap\n");
        let fold = |first, last, comment| Fold { first, last, comment };
        assert_eq!(document.folding(0), [fold(0, 1, true), fold(4, 6, false)]);
    }
}
