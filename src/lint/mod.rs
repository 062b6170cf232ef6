//! Rules for forms: each finds one thing that costs a part or a spindle. One rule a file, one row in `rules`.

mod allow;
mod blocks;
mod levels;
mod mend;
mod rules;
mod tokens;
mod view;

pub use levels::{Level, Levels, UnknownCode};
pub use mend::{Edits, edited, edits_of, fixes_of};
pub use rules::{RULES, Rule};

use crate::diag::{Code, Diag};
use crate::sema::Checked;
use crate::span::Span;
use view::View;

/// What was found in a form.
#[derive(Debug, Default)]
pub struct Findings {
    /// In the order of the files and of the places in them.
    pub diags: Vec<Diag>,
    /// How many more there are that a comment of the form allows.
    pub suppressed: usize,
}

/// All findings of a form: those of reading it and those of the rules.
pub fn lint(checked: &Checked, levels: &Levels) -> Findings {
    let view = View::new(checked);
    let mut diags = checked.diags.clone();
    let broken = broken(checked);
    for rule in RULES {
        let from = diags.len();
        (rule.check)(&view, &mut diags);
        debug_assert!(diags[from..].iter().all(|diag| diag.code == rule.code), "{:?}", rule.code);
    }
    // what a broken sequence leaves out, nobody knows: its other findings would only follow from the error
    let follows = |diag: &Diag| {
        let at = diag.labels.first().map_or(0, |label| label.span.start);
        let file = diag.labels.first().map_or(0, |label| label.span.file);
        diag.code >= Code::PF401 && broken.iter().any(|b| b.file == file && (b.start..=b.end).contains(&at))
    };
    diags.retain_mut(|diag| (diag.is_error() || !follows(diag)) && levels.apply(diag));
    let suppressed = allow::take_allowed(checked, levels, &mut diags);
    sort(&mut diags);
    Findings { diags, suppressed }
}

/// The sequences with an error in them.
fn broken(checked: &Checked) -> Vec<Span> {
    let errors: Vec<Span> = checked
        .diags
        .iter()
        .filter(|diag| diag.is_error())
        .filter_map(|diag| Some(diag.labels.first()?.span))
        .collect();
    if errors.is_empty() {
        return Vec::new();
    }
    let nodes = checked.trees.iter().flat_map(|tree| tree.sequences());
    let whole = nodes.map(|node| {
        let name = node.name.line.span;
        node.end
            .as_ref()
            .map_or(node.body.last().map_or(name, |body| name.to(body.line.span)), |end| name.to(end.line.span))
    });
    whole.filter(|w| errors.iter().any(|e| e.file == w.file && (w.start..=w.end).contains(&e.start))).collect()
}

/// In the order of file and place; the worst first where they share one.
pub fn sort(diags: &mut [Diag]) {
    diags.sort_by_key(|d| {
        let span = d.labels.first().map(|l| l.span).unwrap_or_default();
        (span.file, span.start, std::cmp::Reverse(d.severity), d.code)
    });
}
