//! PF311: P counts milliseconds on some controls and seconds on others.

use crate::diag::{Code, Diag};
use crate::lang::CommandId;
use crate::lint::view::View;
use crate::number::Point;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    let settings = view.settings;
    let command = view.command(CommandId::Dwell).or(view.command(CommandId::Control));
    let Some(command) = command.filter(|_| settings.dwell.letter == b'P') else { return };
    let wanted = match settings.control.as_str() {
        "fanuc" | "fadal" => true,
        "linuxcnc" | "emc2" | "grbl" => false,
        // with a point seconds, without one milliseconds
        "haas" => {
            let format = view.letters[b'P'].format;
            format.dec.count == 0 || format.point == Point::Implied
        }
        _ => return,
    };
    if settings.dwell.milliseconds == wanted {
        return;
    }
    let (unit, times) = if wanted { ("ms", "a thousandth of") } else { ("s", "a thousand times") };
    diags.push(
        Diag::new(Code::PF311, format!("P of a dwell is in {unit} on {}", settings.control))
            .at(command.line.span, format!("this would dwell {times} the time"))
            .help(format!("write `Dwell G4 P {unit}`")),
    );
}
