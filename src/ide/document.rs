//! A form that is open in an editor.

use crate::compile::compile;
use crate::control::Control;
use crate::diag::Diag;
use crate::lint::{Found, Levels, lint};
use crate::post::{Files, Post};
use crate::sema::{Checked, Limits, analyse};
use crate::source::Source;
use crate::span::Span;
use crate::syntax::{Head, SequenceNode};

/// A form that is open in an editor, and the forms that it calls. The form is parsed and checked. A form without errors
/// is also compiled.
#[derive(Debug)]
pub struct Document {
    pub(super) checked: Checked,
    found: Found,
    post: Option<Post>,
    /// The shop's values for the form's properties, by name.
    pub(super) properties: Vec<(String, String)>,
}

impl Document {
    /// Checks a form. `files` returns the texts of the files that the form calls. Unsaved text has priority over the file on the disk.
    pub fn new(form: Source, files: &dyn Files, limits: Limits, levels: &Levels) -> Document {
        Document::of(analyse(form, limits, &mut |name| files.read(name)), levels)
    }

    /// The document of a form that is already analysed.
    pub fn of(checked: Checked, levels: &Levels) -> Document {
        let found = lint(&checked, levels);
        let is_right = !found.diags.iter().any(Diag::is_error);
        let post = is_right.then(|| Post::of(compile(&checked.form), found.diags.clone(), &checked.files));
        Document { checked, found, post, properties: Vec::new() }
    }

    /// Sets the shop's values for the form's properties, by name. These values are used when programs are printed.
    #[must_use]
    pub fn with_properties(self, properties: &[(String, String)]) -> Document {
        Document { properties: properties.to_vec(), ..self }
    }

    /// The files of the form: the main file first, then the files that it calls. The file numbers in spans are indices
    /// of this list.
    pub fn files(&self) -> &[Source] {
        &self.checked.files
    }

    /// The result of the analysis.
    pub fn checked(&self) -> &Checked {
        &self.checked
    }

    /// The findings of lint, sorted by location.
    pub fn findings(&self) -> &[Diag] {
        &self.found.diags
    }

    /// The compiled form; `None` if the form has errors.
    pub fn post(&self) -> Option<&Post> {
        self.post.as_ref()
    }

    /// The control whose codes apply: the control of the form, otherwise the default control.
    pub fn control(&self) -> &'static Control {
        self.checked.form.settings.control.unwrap_or_else(Control::of_no_name)
    }

    /// The text of a span.
    pub fn slice(&self, span: Span) -> &str {
        self.files().get(span.file as usize).map_or("", |source| source.slice(span))
    }

    /// The items of a file.
    pub(super) fn items(&self, file: u32) -> &[Head] {
        self.checked.trees.get(file as usize).map_or(&[], |tree| &tree.items)
    }

    /// The sequence that contains a location. The line with its name and the line with its end are part of the
    /// sequence. If a sequence has no end, the lines that follow are part of the sequence.
    pub(super) fn sequence_at(&self, file: u32, offset: u32) -> Option<&SequenceNode> {
        let nodes = self.checked.trees.get(file as usize)?.sequences();
        let above = nodes.take_while(|node| node.span().start <= offset).last();
        above.filter(|node| node.end.is_none() || offset <= node.span().end)
    }

    /// The text of a line up to a location, and the offset of the line.
    pub(super) fn line_before(&self, file: u32, offset: u32) -> Option<(u32, &str)> {
        let source = self.files().get(file as usize)?;
        let start = *source.line_starts().get(source.line(offset))?;
        Some((start, source.text.get(start as usize..offset as usize)?))
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::post::NoFiles;

    /// Creates a form from a text with the mark `|`. Removes the mark and returns its location.
    pub(in crate::ide) fn marked(text: &str) -> (Document, u32) {
        let at = text.find('|').unwrap_or(0);
        let text = text.replacen('|', "", 1);
        let form = Source::from_text("my.pf", text);
        (Document::new(form, &NoFiles, Limits::default(), &Levels::default()), at as u32)
    }

    /// The shipped form for Haas mills, with the first `from` replaced by `to`.
    pub(in crate::ide) fn haas(from: &str, to: &str) -> (Document, u32) {
        let text = include_str!("../../postforms/haas.pf");
        assert!(text.contains(from), "{from}");
        marked(&text.replacen(from, to, 1))
    }

    #[test]
    fn a_form_with_errors_has_findings_and_no_post() {
        let (whole, _) = haas("", "").0.post().map_or_else(|| panic!("prints"), |post| (post.clone(), 0));
        assert_eq!(whole.control().map(Control::name), Some("haas"));
        let (broken, _) = haas("X[h]", "X[hh]");
        assert!(broken.post().is_none() && broken.findings().iter().any(Diag::is_error));
    }
}
