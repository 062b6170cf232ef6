//! Coolants that are on at once: `[cool]` prints the first of a list, the others are said beside it.

use super::coolant::{codes, codes_of};
use super::fault::Done;
use super::printer::Printer;
use super::said::{Beside, Said};
use super::shape::Shape;
use super::want::Want;
use super::words::value_code;
use crate::lang::{Coolant, VarId};

/// Ends what is on beside the first, but for the kinds that the job keeps.
pub fn end_beside(keeps: Coolant, shape: &Shape, want: &Want, said: &mut Said, out: &mut Printer) -> Done {
    let settings = &shape.program.settings;
    while let Some(kind) = said.beside.other_than(keeps) {
        let own = codes(kind, settings).and_then(|codes| codes.own_off);
        value_code(b'M', own.unwrap_or(settings.coolant[1]), shape, want, said, out)?;
        out.end_block();
        said.beside.end(kind);
        if own.is_none() {
            // nothing is on behind it
            said.beside = Beside::OFF;
            said.conditions.put(VarId::Cool, Some(settings.coolant[1]));
        }
    }
    Ok(())
}

/// Turns on what the job wants beside the first.
pub fn begin_beside(shape: &Shape, want: &Want, said: &mut Said, out: &mut Printer) -> Done {
    said.beside.end(want.coolant.first());
    for kind in want.coolant.others().filter(|kind| !said.beside.holds(*kind)).collect::<Vec<_>>() {
        value_code(b'M', codes_of(kind, &shape.program.settings)?.on, shape, want, said, out)?;
        out.end_block();
        said.beside.begin(kind);
    }
    Ok(())
}
