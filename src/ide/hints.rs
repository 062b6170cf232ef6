//! Hints, which show what each word of a form prints in the current job.

use super::{Current, Document};
use crate::sema::WordKind;
use crate::span::Span;

/// A hint after a word.
#[derive(Clone, Debug, PartialEq)]
pub struct Hint {
    /// The word.
    pub span: Span,
    /// The text that the word printed in the first block of its line. Empty if the word was left out because its value did not change.
    pub text: String,
}

impl Document {
    /// Hints for the words with variables in a span. The hints show the first block of each line.
    pub fn hints(&self, within: Span, current: &Current) -> Vec<Hint> {
        let mut hints = Vec::new();
        let form = &self.checked.form;
        let bodies =
            form.sequences.values().map(|sequence| &sequence.lines).chain(form.upons.iter().map(|upon| &upon.lines));
        for line in bodies.flatten() {
            let span = line.span;
            if span.file != within.file || span.end < within.start || span.start > within.end {
                continue;
            }
            let Some(seen) = current.all_seen().iter().find(|seen| seen.form == span) else { continue };
            for word in &line.words {
                if matches!(word.kind, WordKind::Literal(..) | WordKind::Text(_) | WordKind::Note(_)) {
                    continue;
                }
                if let Some(printed) = seen.words.iter().find(|printed| printed.form == word.span) {
                    hints.push(Hint { span: word.span, text: printed.text.clone() });
                }
            }
        }
        hints.sort_by_key(|hint| hint.span.start);
        hints
    }
}

#[cfg(test)]
mod tests {
    use super::super::document::tests::haas;
    use super::*;

    #[test]
    fn words_show_what_they_print() {
        let (document, offset) = haas("G[retplane] G81", "|G[retplane] G81");
        let current = document.print_sample().unwrap();
        let line = document.line_of(0, offset).unwrap();
        let hints = document.hints(line, &current);
        let shown: Vec<String> =
            hints.iter().map(|hint| format!("{}={}", document.slice(hint.span), hint.text)).collect();
        let block = current.printed(line, 1).first[0].1.to_owned();
        assert_eq!(shown.len(), 6, "{shown:?}");
        assert!(shown[0].starts_with("G[retplane]=G9"), "{shown:?}");
        assert!(hints.iter().all(|hint| block.contains(&hint.text)), "{block}: {shown:?}");
        assert!(document.hints(Span::new(0, 0, 10), &current).is_empty(), "no words in comments");
    }
}
