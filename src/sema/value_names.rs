//! The names of values in conditions, such as `through` for `[cool]` and `cw` for `[direct]`.

use super::settings::Settings;
use crate::lang::VarId;

/// The names of a variable's values, each with its number.
pub fn names_of(var: VarId, settings: &Settings) -> Vec<(&'static str, f64)> {
    let table = |names: &[&'static str], values: &[f64]| names.iter().copied().zip(values.iter().copied()).collect();
    match var {
        VarId::Cool => {
            let [on, off, mist] = settings.coolant;
            let kinds = settings.coolant_kinds.iter().map(|own| (own.kind.name(), own.on));
            [("on", on), ("flood", on), ("off", off), ("mist", mist)].into_iter().chain(kinds).collect()
        }
        VarId::Flush => table(&["on", "off", "mist"], &settings.flush),
        VarId::Direct => table(&["cw", "ccw", "off"], &settings.spindle),
        VarId::Side => table(&["left", "right", "off"], &settings.cdc),
        VarId::Feedtype => table(&["per_minute", "per_rev", "inverse_time"], &settings.feed_type),
        VarId::Speedtype => table(&["css", "rpm"], &settings.speed_type),
        VarId::Incmode => table(&["inc", "abs"], &settings.inc_abs),
        VarId::Unitmode => table(&["inch", "mm"], &settings.inch_mm),
        VarId::Stop => table(&["program", "optional"], &settings.stop_code),
        VarId::Retplane => table(&["clear", "return"], &settings.return_plane),
        _ => Vec::new(),
    }
}
