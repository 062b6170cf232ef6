//! The lint rules for forms. Each rule finds one fault that can damage a part or a spindle. Each rule has its own file
//! and a row in `rules`.

mod allow;
mod blocks;
mod fix;
mod levels;
mod parts;
mod places;
mod rules;
mod tokens;
mod view;

pub(crate) use fix::edited;
pub use fix::{Changed, Fixed, fix};
pub use levels::{Level, Levels};
pub use parts::parts;
pub use rules::RULES;

use crate::compile::{Program, compile};
use crate::diag::{Code, Diag, Severity};
use crate::sema::Checked;
use crate::syntax::SequenceNode;
use places::{Cover, Places};
use view::View;

/// Findings in a form.
#[derive(Debug, Default)]
pub struct Found {
    /// The findings that are shown, sorted by file and location.
    pub diags: Vec<Diag>,
    /// Number of findings that are not shown because comments of the form allow them.
    pub suppressed: usize,
}

/// Finds everything that is wrong in a form: the findings of its analysis and of the rules.
pub fn lint(checked: &Checked, levels: &Levels) -> Found {
    let view = View::new(checked);
    let mut diags: Vec<Diag> = Vec::new();
    let is_run = view.settings.control().prints_codes();
    for rule in RULES.iter().filter(|rule| is_run || !rule.of_codes) {
        let from = diags.len();
        (rule.check)(&view, &mut diags);
        debug_assert!(diags[from..].iter().all(|diag| diag.code == rule.code), "{:?}", rule.code);
    }
    diags.splice(0..0, checked.diags.iter().cloned());
    diags.retain_mut(|diag| levels.apply(diag));
    let suppressed = allow::take_allowed(checked, levels, &mut diags);
    leave_causes(checked, &mut diags);
    sort(&mut diags);
    Found { diags, suppressed }
}

/// A compiled form without errors, and its warnings.
#[derive(Debug)]
pub struct Ready {
    /// The compiled form.
    pub program: Program,
    /// Warnings and notes about the form, sorted by location.
    pub findings: Vec<Diag>,
}

/// Compiles an analysed form. The levels and the form's suppression comments are applied first.
///
/// # Errors
/// At least one finding is an error, either from the form itself or because of the levels. The result contains all
/// errors and warnings.
pub fn ready(checked: &Checked, levels: &Levels) -> Result<Ready, Vec<Diag>> {
    ready_of(checked, lint(checked, levels).diags)
}

/// Like [`ready`], but uses the findings of an earlier run of lint.
///
/// # Errors
/// As [`ready`].
pub fn ready_of(checked: &Checked, mut diags: Vec<Diag>) -> Result<Ready, Vec<Diag>> {
    if diags.iter().any(Diag::is_error) {
        diags.retain(|diag| diag.severity > Severity::Note);
        return Err(diags);
    }
    Ok(Ready { program: compile(&checked.form), findings: diags })
}

/// Removes findings that are only consequences of another finding. If postform does not understand some words of a
/// sequence, a finding about a missing word may be wrong.
fn leave_causes(checked: &Checked, diags: &mut Vec<Diag>) {
    let lost = [Code::PF101, Code::PF104, Code::PF205, Code::PF206];
    let is_cause = |diag: &&Diag| stops_printing(diag) || lost.contains(&diag.code);
    let place = |diag: &Diag| diag.labels.first().map(|label| label.span);
    let causes: Places = diags.iter().filter(is_cause).filter_map(place).collect();
    let nodes = checked.trees.iter().flat_map(|tree| tree.sequences()).map(SequenceNode::span);
    let unclear: Cover = nodes.filter(|whole| causes.any_in(*whole)).collect();
    // only PF401 and higher codes report missing words of a sequence
    let may_follow = |diag: &Diag| diag.code >= Code::PF401 && !is_cause(&diag);
    diags.retain(|diag| !(may_follow(diag) && place(diag).is_some_and(|at| unclear.holds(at))));
}

/// Whether the finding is an error of the form itself, independent of the levels. A form with such an error prints
/// nothing until the error is fixed.
fn stops_printing(diag: &Diag) -> bool {
    diag.is_error() && diag.code.row().severity == Severity::Error
}

/// Sorts findings by file and location. At the same location, the most severe finding comes first.
pub fn sort(diags: &mut [Diag]) {
    diags.sort_by_key(|d| {
        let span = d.labels.first().map(|l| l.span).unwrap_or_default();
        (span.file, span.start, std::cmp::Reverse(d.severity), d.code)
    });
}
