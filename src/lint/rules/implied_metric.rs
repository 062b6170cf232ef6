//! PF317: a format with an implied point can't be correct in both units, because its last digit is 0.0001 inch or 0.001
//! mm.

use crate::control::WithoutPoint;
use crate::diag::{Code, Diag};
use crate::lang::{Unit, UnitChoice};
use crate::lint::view::View;
use crate::sema::Word;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    let settings = view.settings;
    if settings.units == UnitChoice::Inch || view.traits().without_point != WithoutPoint::LeastIncrement {
        return;
    }
    for (&letter, (format, span)) in &view.form.formats {
        let is_length = |word: &Word| {
            let own = view.format_letter(word) == Some(letter);
            own && word.printed_var().is_some_and(|var| var.row().unit == Unit::Length)
        };
        let lengths = settings.axes.contains(&letter) || view.words().any(is_length);
        if format.is_implied() && format.dec.count == 4 && lengths {
            let name = char::from(letter);
            diags.push(
                Diag::new(Code::PF317, format!("{name} prints 1 mm as 10000"))
                    .at(*span, "in millimetres the control counts thousandths: 10000 is 10 mm")
                    .help(format!("print a point, as `{name}->4.>4`; or use 3 decimals and `Units mm`")),
            );
        }
    }
}
