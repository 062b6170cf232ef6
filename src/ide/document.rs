//! A form as it stands in the editor.

use crate::compile::compile;
use crate::control::Control;
use crate::diag::Diag;
use crate::lint::{Found, Levels, lint};
use crate::post::{Files, Post};
use crate::sema::{Checked, Limits, analyse};
use crate::source::Source;
use crate::span::Span;
use crate::syntax::{Head, SequenceNode};

/// A form as it stands in the editor, with those that it calls: read, checked, and compiled where it can print.
#[derive(Debug)]
pub struct Document {
    pub(super) checked: Checked,
    found: Found,
    post: Option<Post>,
    /// What the shop gives the form's properties, by their names.
    pub(super) properties: Vec<(String, String)>,
}

impl Document {
    /// Checks a form. `files` gives the text of the files that it calls, unsaved text before that of the disk.
    pub fn new(form: Source, files: &dyn Files, limits: Limits, levels: &Levels) -> Document {
        Document::of(analyse(form, limits, &mut |name| files.read(name)), levels)
    }

    /// A form that was analysed.
    pub fn of(checked: Checked, levels: &Levels) -> Document {
        let found = lint(&checked, levels);
        let is_right = !found.diags.iter().any(Diag::is_error);
        let post = is_right.then(|| Post::of(compile(&checked.form), found.diags.clone(), &checked.files));
        Document { checked, found, post, properties: Vec::new() }
    }

    /// With values of the shop for the form's properties, by their names: what is printed has them.
    #[must_use]
    pub fn with_properties(self, properties: &[(String, String)]) -> Document {
        Document { properties: properties.to_vec(), ..self }
    }

    /// The files: the form itself first, then those that it calls. Spans are places in them.
    pub fn files(&self) -> &[Source] {
        &self.checked.files
    }

    /// The analysis.
    pub fn checked(&self) -> &Checked {
        &self.checked
    }

    /// What lint finds in it, in the order of the places.
    pub fn findings(&self) -> &[Diag] {
        &self.found.diags
    }

    /// What prints; `None`: the form has errors.
    pub fn post(&self) -> Option<&Post> {
        self.post.as_ref()
    }

    /// The control whose codes count: the form's own, else what most controls have.
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

    /// The sequence that a place lies in, its name line and its end included. One without an end takes the lines after it.
    pub(super) fn sequence_at(&self, file: u32, offset: u32) -> Option<&SequenceNode> {
        let nodes = self.checked.trees.get(file as usize)?.sequences();
        let above = nodes.take_while(|node| node.span().start <= offset).last();
        above.filter(|node| node.end.is_none() || offset <= node.span().end)
    }

    /// The line of a file that a place is in, up to that place, and where the line begins.
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

    /// A form from text, with the place of the mark `|`, which is taken out.
    pub(in crate::ide) fn marked(text: &str) -> (Document, u32) {
        let at = text.find('|').unwrap_or(0);
        let text = text.replacen('|', "", 1);
        let form = Source::from_text("my.pf", text);
        (Document::new(form, &NoFiles, Limits::default(), &Levels::default()), at as u32)
    }

    /// The post for Haas mills that ships, in which the first `from` is replaced.
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
