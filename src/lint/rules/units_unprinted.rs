//! PF316: a form names its units, but its programs contain no unit code.

use crate::control::Kept;
use crate::diag::{Code, Diag};
use crate::lang::{CommandId, UnitChoice, VarId};
use crate::lint::view::View;
use crate::sema::{Word, WordKind};

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    let Some(units) = view.command(CommandId::Units).filter(|_| !view.printed().has(VarId::Unitmode)) else { return };
    let (label, help) = match view.settings.units {
        UnitChoice::Both => ("programs in inches and in millimetres look the same", "G[unitmode]"),
        // a program in one unit may rely on a control that begins each program in the same units
        _ if view.traits().modes_at_start != Kept::Yes || view.words().any(|word| sets_units(view, word)) => return,
        UnitChoice::Inch => (KEPT, "G[unitmode]` or `G20"),
        UnitChoice::Mm => (KEPT, "G[unitmode]` or `G21"),
    };
    let finding = Diag::new(Code::PF316, "the program has no unit code");
    diags.push(finding.at(units.line.span, label).help(format!("print `{help}` in StartCode")));
}

/// The label of a form for one unit.
const KEPT: &str = "the control keeps the units of the previous program";

/// Whether the word may set the units: by a typed code, in a macro, or by text that lint does not read.
fn sets_units(view: &View, word: &Word) -> bool {
    let is_code = word.typed(b'G').is_some_and(|code| view.settings.inch_mm.contains(&code));
    is_code || matches!(word.kind, WordKind::Quote(_) | WordKind::PropertyText(_))
}
