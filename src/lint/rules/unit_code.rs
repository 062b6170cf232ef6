//! PF315: a sequence prints the code for other units than those of the form.

use crate::diag::{Code, Diag};
use crate::lang::UnitChoice;
use crate::lint::view::View;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    let [inch, mm] = view.settings.inch_mm;
    for word in view.words() {
        let Some(code) = word.typed(b'G').filter(|&code| code == inch || code == mm) else { continue };
        let wrong = match view.settings.units {
            UnitChoice::Inch => code == mm,
            UnitChoice::Mm => code == inch,
            UnitChoice::Both => true,
        };
        if wrong {
            let units = match view.settings.units {
                UnitChoice::Inch => "inches",
                UnitChoice::Mm => "millimetres",
                UnitChoice::Both => "both units",
            };
            diags.push(
                Diag::new(Code::PF315, format!("G{code} in a form for {units}"))
                    .at(word.span, "lengths are read in the wrong unit: moves are 25.4 times too long or too short")
                    .help("write `G[unitmode]`, or give the units of the form with `Units`"),
            );
        }
    }
}
