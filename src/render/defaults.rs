//! What a form gives to cycles that name nothing, and the factors between units.

use crate::cycle::Defaults;
use crate::sema::{Settings, UnitChoice};
use crate::toolpath::Units;

/// Millimetres in an inch.
const MM: f64 = 25.4;

/// Defaults before the job has said its units.
pub fn no_defaults() -> Defaults {
    Defaults {
        clear: 0.0,
        step: None,
        min_step: 0.0,
        back_deep: 0.0,
        back_chipbreak: 0.0,
        back_thru: 0.0,
        dwell: 0.0,
        dwell_at_steps: false,
        dwell_at_retracts: false,
        orient: 0.0,
        jog: 0.0,
        sink_clear: None,
        sink_as_printed: false,
        rigid: false,
    }
}

/// What holds where neither cycle nor form says it: in inches and in millimetres.
const CLEAR: [f64; 2] = [0.1, 3.0];
const BACK: [f64; 2] = [0.05, 1.0];
const JOG: [f64; 2] = [0.02, 0.5];

/// What a form gives where a cycle names nothing, in these units.
pub fn cycle_defaults(settings: &Settings, units: Units, sink_as_printed: bool) -> Defaults {
    let scale = factor(form_units(settings).unwrap_or(Units::Inch), units);
    let length = |value: f64| value * scale;
    // what a form for both units says is inches; what it leaves to the default is the job's own
    let own = form_units(settings).unwrap_or(units);
    let or = |said: Option<f64>, default: [f64; 2]| {
        said.map_or_else(|| default[usize::from(own == Units::Mm)] * factor(own, units), length)
    };
    Defaults {
        clear: or(settings.cycle_clear, CLEAR),
        step: settings.cycle_step.map(length),
        min_step: length(settings.cycle_min_step),
        back_deep: or(settings.cycle_back_deep, BACK),
        back_chipbreak: or(settings.cycle_back_chipbreak, BACK),
        back_thru: or(settings.cycle_back_thru, BACK),
        dwell: settings.cycle_dwell,
        dwell_at_steps: settings.cycle_dwell_steps,
        dwell_at_retracts: settings.cycle_dwell_retracts,
        orient: settings.cycle_orient,
        jog: or(settings.cycle_jog, JOG),
        sink_clear: settings.cycle_sink_clear.map(length),
        sink_as_printed,
        rigid: false,
    }
}

/// The one unit that a form is for.
pub fn form_units(settings: &Settings) -> Option<Units> {
    match settings.units {
        UnitChoice::Inch => Some(Units::Inch),
        UnitChoice::Mm => Some(Units::Mm),
        UnitChoice::Both => None,
    }
}

/// What a length in one unit is multiplied with in the other.
pub fn factor(from: Units, to: Units) -> f64 {
    match (from, to) {
        (Units::Inch, Units::Mm) => MM,
        (Units::Mm, Units::Inch) => 1.0 / MM,
        _ => 1.0,
    }
}
