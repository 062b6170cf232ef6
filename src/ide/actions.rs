//! Actions that an editor offers for a finding or for a whole form.

use similar::{Algorithm, DiffOp, capture_diff_slices};

use super::Document;
use crate::diag::{Diag, Fix, Severity, suggestion};
use crate::lint::{Changed, edited};
use crate::span::Span;
use crate::syntax::{Head, Line, Tail};

/// An action that the user can select in the editor.
#[derive(Clone, Debug, PartialEq)]
pub struct Action {
    /// Title of the action, as an instruction.
    pub title: String,
    /// Kind of the action.
    pub kind: Kind,
    /// Index of the finding that the action is for, in [`Document::findings`].
    pub finding: Option<usize>,
    /// Edits of the text.
    pub edits: Vec<(Span, String)>,
    /// The effect on the program of the current job, if the program changes.
    pub preview: Option<Preview>,
}

/// Kinds of actions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Fixes a finding. The fix changes no program.
    Safe,
    /// Fixes a finding. The fix may change programs.
    Unsafe,
    /// Allows a finding at its location.
    Allow,
    /// Allows a finding in the whole file.
    AllowFile,
    /// Sorts letter formats.
    Formats,
}

/// The effect of a change of the form on a program.
#[derive(Clone, Debug, PartialEq)]
pub struct Preview {
    /// Number of changed blocks.
    pub blocks: usize,
    /// Removed blocks begin with a minus and added blocks with a plus. The number of lines is limited.
    pub text: String,
}

/// Maximum number of lines in a preview.
const MOST_LINES: usize = 24;

/// The order of letters in a form: axes, arcs, cycles, feeds and tools, and then letters of the program itself.
const ORDER: &[u8] = b"XYZUVWABCIJKRQFPESTHDONLGM";

impl Document {
    /// The actions for findings whose span overlaps `within`. `print` returns the program of the current job for changed texts of files (by
    /// file name), or `None` if it can't be printed.
    pub fn actions(&self, within: Span, print: &mut dyn FnMut(&Changed) -> Option<String>) -> Vec<Action> {
        let mut actions = Vec::new();
        let mut before: Option<Option<String>> = None;
        for (index, diag) in self.findings().iter().enumerate() {
            let Some(span) = diag.labels.first().map(|label| label.span).filter(|span| touches(*span, within)) else {
                continue;
            };
            if let Some(fix) = &diag.fix.as_deref().cloned().or_else(|| suggestion(diag, self.files())) {
                let before = if fix.safe { None } else { before.get_or_insert_with(|| print(&Changed::new())).clone() };
                actions.push(self.fixing(index, diag, fix, before.as_deref(), print));
            }
            if diag.severity < Severity::Error || diag.code.row().severity < Severity::Error {
                actions.extend(self.allowing(index, diag, span));
            }
        }
        actions
    }

    fn fixing(
        &self,
        index: usize,
        diag: &Diag,
        fix: &Fix,
        before: Option<&str>,
        print: &mut dyn FnMut(&Changed) -> Option<String>,
    ) -> Action {
        let mut title = capital(&fix.title);
        let mut preview = None;
        if !fix.safe {
            match (before, print(&self.changed(&fix.edits))) {
                (Some(before), Some(after)) => {
                    let seen = compare(before, &after);
                    title += &match seen.blocks {
                        0 => " (the program stays the same)".to_owned(),
                        1 => " (changes 1 block of the program)".to_owned(),
                        blocks => format!(" (changes {blocks} blocks of the program)"),
                    };
                    preview = Some(seen);
                }
                _ => title += " (may change the program)",
            }
        }
        let kind = if fix.safe { Kind::Safe } else { Kind::Unsafe };
        Action {
            title: format!("{title} [{}]", diag.code.name()),
            kind,
            finding: Some(index),
            edits: fix.edits.clone(),
            preview,
        }
    }

    /// The new texts of the files that these edits change.
    fn changed(&self, edits: &[(Span, String)]) -> Changed {
        let mut changed = Changed::new();
        for (file, source) in self.files().iter().enumerate() {
            let own = edits.iter().filter(|(span, _)| span.file as usize == file);
            let mut own: Vec<(Span, &str)> = own.map(|(span, text)| (*span, text.as_str())).collect();
            own.sort_by_key(|(span, _)| span.start);
            if !own.is_empty() {
                changed.insert(source.name.clone(), edited(&source.text, &own));
            }
        }
        changed
    }

    /// The actions that allow a finding by a comment: above its line, and at the head of the file.
    fn allowing(&self, index: usize, diag: &Diag, span: Span) -> Vec<Action> {
        let code = diag.code.name();
        let Some((line, _)) = self.line_before(span.file, span.start) else { return Vec::new() };
        let new = |title: String, kind, at: u32, verb: &str| {
            let text = format!("# postform: {verb} {code}\n");
            let place = Span { file: span.file, start: at, end: at };
            Action { title, kind, finding: Some(index), edits: vec![(place, text)], preview: None }
        };
        vec![
            new(format!("Allow {code} here"), Kind::Allow, line, "allow"),
            new(format!("Allow {code} in the whole file"), Kind::AllowFile, 0, "allow-file"),
        ]
    }

    /// An action that sorts letter formats by their letters; `None` if they are sorted. Each block of adjacent formats is sorted
    /// separately, and a comment stays with its format.
    pub fn organised_formats(&self, file: u32) -> Option<Action> {
        let mut edits = Vec::new();
        let mut group: Vec<(&Line, u8)> = Vec::new();
        for item in self.items(file) {
            match item {
                Head::Format { line, letter, .. } => group.push((line, letter.text.bytes().next().unwrap_or(0))),
                _ => self.order(&mut group, &mut edits),
            }
        }
        self.order(&mut group, &mut edits);
        let title = "Put the letter formats in order".to_owned();
        (!edits.is_empty()).then_some(Action { title, kind: Kind::Formats, finding: None, edits, preview: None })
    }

    /// Whether a span touches a letter format.
    pub fn has_format(&self, within: Span) -> bool {
        let touched = |item: &Head| matches!(item, Head::Format { line, .. } if touches(line.span, within));
        self.items(within.file).iter().any(touched)
    }

    fn order(&self, group: &mut Vec<(&Line, u8)>, edits: &mut Vec<(Span, String)>) {
        let formats = std::mem::take(group);
        let rank = |letter: u8| ORDER.iter().position(|own| *own == letter).unwrap_or(ORDER.len());
        let mut sorted = formats.clone();
        sorted.sort_by_key(|(_, letter)| rank(*letter));
        // text that is lost after two spaces must stay where it is, so that it stays visible
        let lost = formats.iter().any(|(line, _)| matches!(line.tail, Tail::Lost(_)));
        if lost || sorted.iter().map(|(line, _)| line.span).eq(formats.iter().map(|(line, _)| line.span)) {
            return;
        }
        for ((old, _), (new, _)) in formats.iter().zip(&sorted) {
            if old.span != new.span {
                edits.push((old.span, self.slice(new.span).trim_end().to_owned()));
            }
        }
    }
}

fn touches(one: Span, other: Span) -> bool {
    one.file == other.file && one.start <= other.end && other.start <= one.end
}

fn capital(title: &str) -> String {
    let mut chars = title.chars();
    chars.next().map_or_else(String::new, |first| first.to_uppercase().chain(chars).collect())
}

/// Compares two programs.
fn compare(before: &str, after: &str) -> Preview {
    let [old, new]: [Vec<&str>; 2] = [before, after].map(|text| text.lines().collect());
    let (mut gone, mut come, mut lines) = (0, 0, Vec::new());
    for op in capture_diff_slices(Algorithm::Myers, &old, &new) {
        let (_, old_lines, new_lines) = op.as_tag_tuple();
        if matches!(op, DiffOp::Equal { .. }) {
            continue;
        }
        gone += old_lines.len();
        come += new_lines.len();
        lines.extend(old[old_lines].iter().map(|line| format!("-{}", line.trim_end())));
        lines.extend(new[new_lines].iter().map(|line| format!("+{}", line.trim_end())));
    }
    if lines.len() > MOST_LINES {
        let more = lines.len() - MOST_LINES;
        lines.truncate(MOST_LINES);
        lines.push(format!("… and {more} more"));
    }
    Preview { blocks: gone.max(come), text: lines.join("\n") }
}

#[cfg(test)]
mod tests {
    use super::super::document::tests::{haas, marked};
    use super::*;
    use crate::post::{NoFiles, sample_program};
    use crate::sema::{Limits, analyse};
    use crate::source::Source;

    /// The actions that are offered at this byte offset, each with the text of the form after the action.
    fn done(document: &Document, offset: u32) -> Vec<(Action, String)> {
        let at = Span { file: 0, start: offset, end: offset };
        let read = |changed: &Changed| {
            let text = changed.get("my.pf").unwrap_or(&document.files()[0].text);
            analyse(Source::from_text("my.pf", text.as_str()), Limits::default(), &mut |name| {
                crate::post::Files::read(&NoFiles, name)
            })
        };
        let mut print = |changed: &Changed| sample_program(&read(changed), None).ok()?.ok();
        let after = |action: &Action| document.changed(&action.edits)["my.pf"].clone();
        document
            .actions(at, &mut print)
            .into_iter()
            .map(|action| (after(&action), action))
            .map(|(a, b)| (b, a))
            .collect()
    }

    #[test]
    fn an_unsafe_fix_shows_what_it_does_to_the_program() {
        let drill = "Z[d] R[vclear] F[frate]\nEnd Cancel\n\nCustom1";
        let (document, _) = haas(drill, "Z[d] R[vclear] F[frate]\nEnd\n\nCustom1");
        let found = document.findings().iter().find(|diag| diag.code.name() == "PF409").unwrap();
        let offset = found.labels[0].span.start;
        let all = done(&document, offset);
        let (action, after) = all.iter().find(|(action, _)| action.kind == Kind::Unsafe).unwrap();
        assert!(
            action.title.starts_with("Cancel the cycle (changes ") && action.title.ends_with("[PF409]"),
            "{}",
            action.title
        );
        let preview = action.preview.as_ref().unwrap();
        assert!(preview.blocks > 0 && preview.text.contains("+G80"), "{preview:?}");
        assert!(after.contains("F[frate]\nEnd Cancel"));
    }

    #[test]
    fn a_safe_fix_needs_no_preview_and_a_finding_can_be_allowed() {
        let (document, offset) = haas("G90 G[work] X[h]", "G90G[work|] X[h]");
        let all = done(&document, offset);
        let (safe, after) = all.iter().find(|(action, _)| action.kind == Kind::Safe).unwrap();
        assert!(safe.preview.is_none() && after.contains("G90 G[work] X[h]"), "{after}");
        let (allow, after) = all.iter().find(|(action, _)| action.kind == Kind::Allow).unwrap();
        let code = &allow.title["Allow ".len()..]["".len()..].split(' ').next().unwrap();
        let found = |text: &str| marked(text).0.findings().iter().filter(|diag| diag.code.name() == *code).count();
        assert_eq!(found(after) + 1, found(&document.files()[0].text), "{after}");
        let (_, after) = all.iter().find(|(action, _)| action.kind == Kind::AllowFile).unwrap();
        assert_eq!(found(after), 0);
    }

    #[test]
    fn a_misspelt_name_is_written_as_proposed() {
        let (document, offset) = haas("Z[d] R[vclear] F[frate]", "Z[d] R[vcl|aer] F[frate]");
        let all = done(&document, offset);
        let (action, after) = all.iter().find(|(action, _)| action.title.starts_with("Write `vclear`")).unwrap();
        assert!(action.kind == Kind::Unsafe && after.contains("Z[d] R[vclear] F[frate]"), "{action:?}");
        // no name is suggested if none is similar
        let (document, offset) = haas("Z[d] R[vclear] F[frate]", "Z[d] R[qq|qqqq] F[frate]");
        assert!(done(&document, offset).iter().all(|(action, _)| !action.title.starts_with("Write")));
    }

    #[test]
    fn formats_are_put_in_order_with_their_comments() {
        let (document, _) = marked("F >4.1 # feed\nX->3.3\n\nY->3.3\nG 2\n");
        let action = document.organised_formats(0).unwrap();
        assert_eq!(document.changed(&action.edits)["my.pf"], "X->3.3\nF >4.1 # feed\n\nY->3.3\nG 2\n");
        assert!(marked("X->3.3\nF >4.1\n").0.organised_formats(0).is_none());
    }
}
