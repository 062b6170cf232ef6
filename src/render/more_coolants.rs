//! Several coolants at once: `[cool]` prints the first kind of a list, and the other kinds are printed in separate
//! blocks.

use super::coolant::{codes, codes_of};
use super::cx::Writer;
use super::fault::Done;
use super::said::Beside;
use super::words::value_code;
use crate::lang::{Coolant, VarId};

/// Turns off the further kinds of coolant, except the kinds in `keeps`.
pub fn end_beside(keeps: Coolant, writer: &mut Writer<'_>) -> Done {
    let shape = writer.shape;
    let settings = &shape.program.settings;
    while let Some(kind) = writer.said.beside.other_than(keeps) {
        let own = codes(kind, settings).and_then(|codes| codes.own_off);
        value_code(b'M', own.unwrap_or(settings.coolant[1]), writer)?;
        writer.out.end_block();
        writer.said.beside.end(kind);
        if own.is_none() {
            // this code turned off all coolant
            writer.said.beside = Beside::OFF;
            writer.said.conditions.put(VarId::Cool, Some(settings.coolant[1]));
        }
    }
    Ok(())
}

/// Turns on the further kinds of coolant that the job requests.
pub fn begin_beside(writer: &mut Writer<'_>) -> Done {
    let shape = writer.shape;
    writer.said.beside.end(writer.want.coolant.first());
    for kind in writer.want.coolant.others().filter(|kind| !writer.said.beside.holds(*kind)).collect::<Vec<_>>() {
        value_code(b'M', codes_of(kind, &shape.program.settings)?.on, writer)?;
        writer.out.end_block();
        writer.said.beside.begin(kind);
    }
    Ok(())
}
