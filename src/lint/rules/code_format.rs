//! PF310: a command sets a code that its letter's format can't print.

use crate::diag::{Code, Diag};
use crate::lang::VarId;
use crate::lint::view::View;
use crate::number::Point;
use crate::sema::{Settings, WordKind};

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for word in view.words() {
        let WordKind::Var(letter, var) = word.kind else { continue };
        let format = view.letters[letter].format;
        let bad = codes(view.settings, var).into_iter().find(|code| {
            let whole = code.trunc();
            let too_long = whole >= 10f64.powi(i32::from(format.int.count));
            too_long || (code.fract() != 0.0 && (format.dec.count == 0 || format.point == Point::Implied))
        });
        if let Some(code) = bad {
            diags.push(
                Diag::new(Code::PF310, format!("{} can't print {code}", char::from(letter)))
                    .at(word.span, format!("[{}] may be {code}", var.name()))
                    .help("give the letter a format with more digits, as `G >3~>1`"),
            );
        }
    }
}

/// The values that commands assign to a variable.
fn codes(settings: &Settings, var: VarId) -> Vec<f64> {
    match var {
        VarId::Work => vec![settings.work, settings.work_default],
        VarId::Direct => settings.spindle.to_vec(),
        VarId::Cool => settings.coolant.to_vec(),
        VarId::Coolantoff => vec![settings.coolant[1]],
        VarId::Side => settings.cdc.to_vec(),
        VarId::Feedtype => settings.feed_type.to_vec(),
        VarId::Speedtype => settings.speed_type.to_vec(),
        VarId::Retplane => settings.return_plane.to_vec(),
        VarId::Unitmode => settings.inch_mm.to_vec(),
        VarId::Incmode => settings.inc_abs.to_vec(),
        VarId::Stop => settings.stop_code.to_vec(),
        _ => Vec::new(),
    }
}
