//! Renames elements whose names the form can choose: the variables val1 to val10, the three Custom sequences, and properties.

use super::{At, Document, What};
use crate::lang::{SequenceId, VarId};
use crate::sema::check_name;
use crate::span::Span;

/// The replacements that rename an element.
pub type Renamed = Vec<(Span, String)>;

/// The reason why an element can't be renamed, as a sentence.
pub type CantRename = String;

const CUSTOM: [SequenceId; 3] = [SequenceId::Custom1, SequenceId::Custom2, SequenceId::Custom3];

/// Whether the variable is one of `val1` to `val10`.
fn is_free(var: VarId) -> bool {
    var.name().strip_prefix("val").is_some_and(|number| number.parse::<u8>().is_ok())
}

impl Document {
    /// The span of the name at a byte of a file, if the element can be renamed.
    ///
    /// # Errors
    /// The element is a fixed word of the language.
    pub fn renameable(&self, file: u32, offset: u32) -> Result<Span, CantRename> {
        match self.at(file, offset) {
            Some(At { span, what: What::Variable(var, _) }) if is_free(var) => Ok(name_in(self, span, var)),
            Some(At { span, what: What::Sequence(id) }) if CUSTOM.contains(&id) => Ok(span),
            Some(At { span, what: What::Property(row) }) if self.renamed_property(row).is_some() => {
                Ok(text_in(self, span, self.renamed_property(row).unwrap_or_default()))
            }
            _ => Err(
                "only val1 to val10, Custom1 to Custom3 and properties can be renamed: the other names are words of \
                 the language"
                    .into(),
            ),
        }
    }

    /// The edits that rename the element at a byte of a file. `name`: the new name.
    ///
    /// # Errors
    /// The element can't be renamed, or the new name is invalid or already used.
    pub fn rename(&self, file: u32, offset: u32, name: &str) -> Result<Renamed, CantRename> {
        self.renameable(file, offset)?;
        let Some(At { what, .. }) = self.at(file, offset) else { return Ok(Vec::new()) };
        let name = name.trim().trim_matches(['[', ']', '<', '>']);
        match what {
            What::Variable(var, _) => {
                let new = VarId::parse(name).filter(|new| is_free(*new));
                let new = new.ok_or_else(|| format!("`{name}` is not a free variable: use val1 to val10"))?;
                if new != var && !self.places(&What::Variable(new, None)).is_empty() {
                    return Err(format!("[{}] is already used in this form", new.name()));
                }
                let places = self.places(&What::Variable(var, None));
                Ok(places.into_iter().map(|span| (name_in(self, span, var), new.name().to_owned())).collect())
            }
            What::Property(row) => {
                check_name(name)?;
                let properties = &self.checked.form.settings.properties;
                if properties.iter().enumerate().any(|(at, other)| at != usize::from(row) && other.name == name) {
                    return Err(format!("the property `{name}` exists already"));
                }
                let old = self.renamed_property(row).unwrap_or_default();
                let places = self.places(&what);
                Ok(places.into_iter().map(|span| (text_in(self, span, old), name.to_owned())).collect())
            }
            What::Sequence(id) => {
                let new = SequenceId::parse(name).filter(|new| CUSTOM.contains(new));
                let new = new.ok_or_else(|| format!("`{name}` is not Custom1, Custom2 or Custom3"))?;
                if new != id && self.checked.form.sequences.contains_key(&new) {
                    return Err(format!("the form already has a {}", new.name()));
                }
                let places = self.places(&What::Sequence(id));
                Ok(places.into_iter().map(|span| (span, new.name().to_owned())).collect())
            }
            _ => Ok(Vec::new()),
        }
    }
}

impl Document {
    /// The name of a property that the form declares; `None` if the property is a field of the job's tools.
    fn renamed_property(&self, row: u16) -> Option<&str> {
        let property = self.checked.form.settings.properties.get(usize::from(row))?;
        property.of_tool().is_none().then_some(property.name.as_str())
    }
}

/// The span of only the variable's name, inside the span of a word such as `X[val1]`.
fn name_in(document: &Document, span: Span, var: VarId) -> Span {
    text_in(document, span, var.name())
}

/// The span of only the name, inside the span of its word. `name` is in lower case.
fn text_in(document: &Document, span: Span, name: &str) -> Span {
    match document.slice(span).to_ascii_lowercase().find(name) {
        Some(at) => {
            let start = span.start as usize + at;
            Span::new(span.file, start, start + name.len())
        }
        None => span,
    }
}

#[cfg(test)]
mod tests {
    use super::super::document::tests::{haas, marked};

    #[test]
    fn free_values_and_customs_get_other_names() {
        let (document, offset) = haas("T[tool] M6", "T[tool] M6 P[val1]\n(VISE [val1]) Q[va|l1]");
        let edits = document.rename(0, offset, "[val7]").unwrap();
        assert_eq!(edits.len(), 3);
        assert!(edits.iter().all(|(span, text)| document.slice(*span) == "val1" && text == "val7"), "{edits:?}");
        assert!(document.rename(0, offset, "height").unwrap_err().contains("val1 to val10"));
        let (document, offset) = haas("Custom1   Face", "Cus|tom1   Face");
        assert_eq!(document.rename(0, offset, "Custom3").unwrap().len(), 1);
        assert!(document.rename(0, offset, "Drill").is_err());
    }

    #[test]
    fn properties_get_other_names() {
        let form = "T[tool] M6\n@if [float]\n  M29 S[flo|at+1] (FLOAT [float])\n@end\n@set float = 2\n`[float]`";
        let head = "\nProperty float number 1 Floating tapping\n\nStartCode";
        let haas = include_str!("../../postforms/haas.pf");
        let text = haas.replacen("\nStartCode", head, 1).replacen("T[tool] M6", form, 1);
        let (document, offset) = marked(&text);
        let edits = document.rename(0, offset, "loose").unwrap();
        let old: Vec<&str> = edits.iter().map(|(span, _)| document.slice(*span)).collect();
        assert_eq!(old, ["float"; 5], "the declaration, a condition, an expression, a comment, a new value; no quote");
        for (name, why) in
            [("tool", "is a variable"), ("not", "conditions"), ("header", "exists already"), ("A b", "lower-case")]
        {
            assert!(document.rename(0, offset, name).unwrap_err().contains(why), "{name}");
        }
    }

    #[test]
    fn names_that_are_taken_and_words_of_the_language_stay() {
        let (document, offset) = haas("T[tool] M6", "T[tool] M6 P[val1] Q[va|l2]");
        assert!(document.rename(0, offset, "val1").unwrap_err().contains("already"));
        let (document, offset) = haas("X[h]", "X[|h]");
        assert!(document.renameable(0, offset).is_err());
    }
}
