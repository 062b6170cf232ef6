//! PF311: P of a dwell is in milliseconds on some controls, and in seconds on others.

use crate::control::DwellUnit;
use crate::diag::{Code, Diag};
use crate::lang::{CommandId, SequenceId, VarId};
use crate::lint::view::View;
use crate::number::Point;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    let settings = view.settings;
    // P of a dwell, or of a cycle that dwells
    let cycle =
        view.words().find(|word| word.printed_var() == Some(VarId::Dwell) && view.printed_letter(word) == Some(b'P'));
    let command = view.command(CommandId::Dwell).or(view.command(CommandId::Control)).map(|command| command.line.span);
    let generated = settings.dwell.letter == b'P' && view.body(SequenceId::DwellBlock).is_none();
    let place = if generated { command } else { cycle.map(|word| word.span) };
    let Some(place) = place else { return };
    let wanted = match view.traits().dwell {
        DwellUnit::Ms => true,
        DwellUnit::S => false,
        DwellUnit::ByPoint => {
            let format = view.letters[b'P'].format;
            format.dec.count == 0 || format.point == Point::Implied
        }
        DwellUnit::Unknown => return,
    };
    if settings.dwell.milliseconds == wanted {
        return;
    }
    let (unit, times) = if wanted { ("ms", "a thousandth of") } else { ("s", "a thousand times") };
    diags.push(
        Diag::new(Code::PF311, format!("P of a dwell is in {unit} on {}", settings.control().shown()))
            .at(place, format!("the dwell would be {times} the time"))
            .help(format!("write `Dwell G4 P {unit}`")),
    );
}
