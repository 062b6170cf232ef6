//! Rules for forms: each finds one thing that costs a part or a spindle. One rule a file, one row here.

mod cancel_emulated;
mod cycle_without_position;
mod letter_formats;
mod lost_words;
mod machine_code_without_count;
mod missing_blank;
mod without_effect;

use crate::diag::Diag;
use crate::sema::Checked;

/// A rule looks at a form and says what it finds.
type Rule = fn(&Checked, &mut Vec<Diag>);

/// All rules.
const RULES: &[Rule] = &[
    lost_words::check,
    missing_blank::check,
    without_effect::check,
    letter_formats::check,
    cancel_emulated::check,
    machine_code_without_count::check,
    cycle_without_position::check,
];

/// All findings of a form: those of reading it and those of the rules, in the order of the file.
pub fn lint(checked: &Checked) -> Vec<Diag> {
    let mut diags = checked.diags.clone();
    for rule in RULES {
        rule(checked, &mut diags);
    }
    sort(&mut diags);
    diags
}

/// In the order of file and place; the worst first where they share one.
pub fn sort(diags: &mut [Diag]) {
    diags.sort_by_key(|d| {
        let span = d.labels.first().map(|l| l.span).unwrap_or_default();
        (span.file, span.start, std::cmp::Reverse(d.severity), d.code)
    });
}
