//! PF311: the unit of P in a dwell may be wrong. Some controls read milliseconds, others seconds.

use crate::control::DwellUnit;
use crate::diag::{Code, Diag};
use crate::lang::{CommandId, SequenceId, VarId};
use crate::lint::view::View;
use crate::number::Point;
use crate::span::Span;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    let settings = view.settings;
    let Some((place, wanted)) = wrong_unit(view) else { return };
    let (unit, times) = if wanted { ("ms", "a thousandth of") } else { ("s", "a thousand times") };
    diags.push(
        Diag::new(Code::PF311, format!("P of a dwell is in {unit} on {}", settings.control().shown()))
            .at(place, format!("the dwell would last {times} the programmed time"))
            .help(format!("write `Dwell G4 P {unit}`")),
    );
}

/// Finds a dwell whose unit is not that of the control. Returns its location, and whether the control's unit is the
/// millisecond.
pub(super) fn wrong_unit(view: &View) -> Option<(Span, bool)> {
    let settings = view.settings;
    // the letter P in a dwell, or in a cycle with a dwell
    let cycle =
        view.words().find(|word| word.printed_var() == Some(VarId::Dwell) && view.printed_letter(word) == Some(b'P'));
    let command = view.command(CommandId::Dwell).or(view.command(CommandId::Control)).map(|command| command.line.span);
    let generated = settings.dwell.letter == b'P' && view.body(SequenceId::DwellBlock).is_none();
    let place = if generated { command } else { cycle.map(|word| word.span) };
    let place = place?;
    let wanted = match view.traits().dwell {
        DwellUnit::Ms => true,
        DwellUnit::S => false,
        DwellUnit::ByPoint => {
            let format = view.letters[b'P'].format;
            format.dec.count == 0 || format.point == Point::Implied
        }
        DwellUnit::Unknown => return None,
    };
    (settings.dwell.milliseconds != wanted).then_some((place, wanted))
}
