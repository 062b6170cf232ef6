//! Applies fixes: selects fixes that do not overlap, and edits the text.

use std::collections::{BTreeMap, HashMap};

use super::{Found, Levels, lint};
use crate::diag::Diag;
use crate::sema::Checked;
use crate::span::Span;

/// The changed texts of files, by the name that messages use for the file.
pub type Changed = HashMap<String, String>;

/// A form after its fixes.
#[derive(Debug)]
pub struct Fixed {
    /// The fixed form.
    pub checked: Checked,
    /// Findings in the fixed form.
    pub findings: Found,
    /// Files that the fixes changed.
    pub changed: Changed,
    /// Findings that were fixed. A finding from a later round has no location, because its location refers to an intermediate text.
    pub made: Vec<Diag>,
}

/// Maximum number of rounds. A fix may make another fix possible; this limit ends an endless sequence of fixes.
const MOST_ROUNDS: usize = 50;

/// Applies fixes in rounds until no fix is left. `unsafe_too`: also applies fixes that change the output. `read`
/// analyses the form with the changed texts.
pub fn fix(levels: &Levels, unsafe_too: bool, read: &mut dyn FnMut(&Changed) -> Checked) -> Fixed {
    let mut changed = Changed::new();
    let mut made: Vec<Diag> = Vec::new();
    let mut checked = read(&changed);
    let mut findings = lint(&checked, levels);
    for round in 0..MOST_ROUNDS {
        let fixes = fixes_of(&findings.diags, unsafe_too);
        if fixes.is_empty() {
            break;
        }
        for (file, source) in checked.files.iter().enumerate() {
            let edits = edits_of(&fixes, file as u32);
            if !edits.is_empty() {
                changed.insert(source.name.clone(), edited(&source.text, &edits));
            }
        }
        let places = |diag: &Diag| if round == 0 { diag.labels.clone() } else { Vec::new() };
        made.extend(fixes.into_iter().map(|diag| Diag { labels: places(diag), ..diag.clone() }));
        checked = read(&changed);
        findings = lint(&checked, levels);
    }
    Fixed { checked, findings, changed, made }
}

/// Text replacements that do not overlap, in order.
pub(crate) type Edits<'a> = Vec<(Span, &'a str)>;

/// Selects fixes that do not overlap. `unsafe_too`: also fixes that change the output. If two fixes change the same
/// text, only the earlier fix is selected. The next round finds the later fix again.
fn fixes_of(diags: &[Diag], unsafe_too: bool) -> Vec<&Diag> {
    // by file, from start to end; the selected edits never overlap, so only the last edit that begins before a span can
    // touch the span
    let mut taken: BTreeMap<(u32, u32), u32> = BTreeMap::new();
    let mut chosen = Vec::new();
    for diag in diags {
        let Some(fix) = diag.fix.as_ref().filter(|fix| fix.safe || unsafe_too) else { continue };
        let touches = |span: &Span| {
            let before = taken.range((span.file, 0)..=(span.file, span.end)).next_back();
            before.is_some_and(|(_, &end)| span.start <= end)
        };
        if fix.edits.iter().any(|(span, _)| touches(span)) {
            continue;
        }
        taken.extend(fix.edits.iter().map(|(span, _)| ((span.file, span.start), span.end)));
        chosen.push(diag);
    }
    chosen
}

/// The edits of these findings in file number `file`.
fn edits_of<'a>(diags: &[&'a Diag], file: u32) -> Edits<'a> {
    let fixes = diags.iter().filter_map(|diag| diag.fix.as_ref());
    let edits = fixes.flat_map(|fix| &fix.edits).filter(|(span, _)| span.file == file);
    let mut edits: Edits = edits.map(|(span, text)| (*span, text.as_str())).collect();
    edits.sort_by_key(|(span, _)| span.start);
    edits
}

/// Applies edits to a text. If an edit makes a line empty, the line is removed.
pub(crate) fn edited(text: &str, edits: &Edits) -> String {
    let mut out = String::with_capacity(text.len());
    let mut at = 0;
    for (span, new) in edits {
        let (start, mut end) = (span.start as usize, span.end as usize);
        let (Some(kept), true) = (text.get(at..start), text.is_char_boundary(end)) else { continue };
        out.push_str(kept);
        out.push_str(new);
        let whole_line = start < end && (out.is_empty() || out.ends_with('\n'));
        if whole_line && new.is_empty() {
            let rest = &text[end..];
            end += rest.len() - rest.strip_prefix("\r\n").or(rest.strip_prefix('\n')).unwrap_or(rest).len();
        }
        at = end;
    }
    out.push_str(&text[at..]);
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edits_are_made_in_order_and_empty_lines_go() {
        let edits = vec![(Span::new(0, 1, 2), "XX"), (Span::new(0, 4, 6), ""), (Span::new(0, 7, 7), "!")];
        assert_eq!(edited("abc\nde\nf", &edits), "aXXc\n!f");
        assert_eq!(edited("de\r\nf", &vec![(Span::new(0, 0, 2), "")]), "f");
        assert_eq!(edited("ä", &vec![(Span::new(0, 0, 1), "x")]), "ä");
    }
}
