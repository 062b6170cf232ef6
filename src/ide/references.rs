//! Finds all occurrences of an element, and its definition.

use super::{At, Document, What};
use crate::lang::SequenceId;
use crate::span::Span;

impl Document {
    /// All occurrences of the element at a byte of a file, in all files of the form. The element may be a variable, a code, a
    /// letter (its words and its format), a sequence (its name and its calls), or a command.
    pub fn references(&self, file: u32, offset: u32) -> Vec<Span> {
        self.at(file, offset).map_or_else(Vec::new, |at| self.places(&at.what))
    }

    /// All occurrences of an element.
    pub(super) fn places(&self, what: &What) -> Vec<Span> {
        let mut found = Vec::new();
        for file in 0..self.checked.trees.len() as u32 {
            self.each(file, |at| {
                if same(&at, what) {
                    found.push(at.span);
                }
            });
        }
        found
    }

    /// The definition of the element at a byte of a file: the sequence for `Cancel`, the prompt or property for a variable, the
    /// format for a letter.
    pub fn definition(&self, file: u32, offset: u32) -> Option<Span> {
        let at = self.at(file, offset)?;
        match at.what {
            What::Cancel => self.checked.form.sequences.get(&SequenceId::Cancel).map(|sequence| sequence.span),
            What::Variable(var, letter) => {
                let mut asked = None;
                for file in 0..self.checked.trees.len() as u32 {
                    let statements = self.checked.trees[file as usize].statements();
                    for statement in statements {
                        let named = |text: &str| crate::lang::VarId::parse(text.trim_matches(['[', ']', '<', '>']));
                        let asks = statement.args.first().is_some_and(|arg| named(&arg.text) == Some(var));
                        asked = asked.or(asks.then_some(statement.line.span));
                    }
                }
                let format = || letter.and_then(|letter| self.checked.form.formats.get(&letter).map(|(_, span)| *span));
                asked.or_else(format)
            }
            What::Word(letter) => self.checked.form.formats.get(&letter).map(|(_, span)| *span),
            What::Property(row) => {
                self.checked.form.settings.properties.get(usize::from(row)).map(|property| property.span)
            }
            _ => None,
        }
    }
}

fn same(at: &At, what: &What) -> bool {
    match (&at.what, what) {
        (What::Variable(one, _), What::Variable(other, _)) => one == other,
        (What::Command(one), What::Argument(other, _)) => one == other,
        (What::Word(one) | What::Format(one), What::Word(other) | What::Format(other)) => one == other,
        (What::Variable(_, Some(one)), What::Format(other)) => one == other,
        (What::Cancel, What::Sequence(SequenceId::Cancel)) | (What::Sequence(SequenceId::Cancel), What::Cancel) => true,
        (What::End | What::Nothing | What::Quote, _) => false,
        (one, other) => one == other,
    }
}

#[cfg(test)]
mod tests {
    use super::super::document::tests::{haas, marked};

    #[test]
    fn all_places_of_a_thing() {
        let places = |from: &str, to: &str| {
            let (document, offset) = haas(from, to);
            document.references(0, offset).iter().map(|span| document.slice(*span).to_owned()).collect::<Vec<_>>()
        };
        let vclear = places("R[vclear]", "R[vc|lear]");
        assert!(vclear.len() > 3 && vclear.iter().all(|text| text.ends_with("[vclear]")), "{vclear:?}");
        let cancel = places("\nCancel", "\nCan|cel");
        assert!(cancel.len() > 3 && cancel.iter().all(|text| text == "Cancel"), "{cancel:?}");
        assert_eq!(places("G81", "G|81"), ["G81"]);
        let q = places("Q >4.>4", "Q| >4.>4");
        assert!(q[0] == "Q >4.>4" && q[1..].iter().all(|text| text == "Q[vbite]") && q.len() > 2, "{q:?}");
        assert!(places("# Haas", "# H|aas").is_empty());
    }

    #[test]
    fn cancel_leads_to_its_sequence_and_a_word_to_its_format() {
        let said = |from: &str, to: &str| {
            let (document, offset) = haas(from, to);
            document.definition(0, offset).map(|span| document.slice(span).to_owned())
        };
        assert_eq!(said("End Cancel", "End Can|cel").as_deref(), Some("Cancel"));
        assert_eq!(said("Q[vbite]", "Q[vb|ite]").as_deref(), Some("Q >4.>4"));
        let (document, offset) = marked("Ask val3 \"Height\" 1\nStartCode\n(VISE [val|3])\nEnd\n");
        assert_eq!(document.definition(0, offset).map(|span| document.slice(span)), Some("Ask val3 \"Height\" 1"));
    }
}
