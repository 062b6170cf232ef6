//! Default values of cycles, and factors between units.

use crate::cycle::Defaults;
use crate::lang::UnitChoice;
use crate::sema::Settings;
use crate::toolpath::Units;

/// Millimetres in an inch.
const MM: f64 = 25.4;

/// Defaults before the units of the job are known.
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

/// Default values of the form for a cycle, converted from units of the job or the form to the units `into`.
pub fn cycle_defaults(settings: &Settings, job: Units, into: Units, sink_as_printed: bool) -> Defaults {
    let scale = factor(form_units(settings).unwrap_or(Units::Inch), into);
    let length = |value: f64| value * scale;
    // lengths in a form for both units are inches; for a value that the form lacks, the default of a form in the job's
    // units applies
    let of_job = if job == Units::Mm { UnitChoice::Mm } else { UnitChoice::Inch };
    let usual = Settings::new(settings.machine, of_job);
    let usual_scale = factor(job, into);
    let or = |said: Option<f64>, usual: Option<f64>| {
        said.map(length).or(usual.map(|value| value * usual_scale)).unwrap_or_default()
    };
    Defaults {
        clear: or(settings.cycle_clear, usual.cycle_clear),
        step: settings.cycle_step.map(length),
        min_step: length(settings.cycle_min_step),
        back_deep: or(settings.cycle_back_deep, usual.cycle_back_deep),
        back_chipbreak: or(settings.cycle_back_chipbreak, usual.cycle_back_chipbreak),
        back_thru: or(settings.cycle_back_thru, usual.cycle_back_thru),
        dwell: settings.cycle_dwell,
        dwell_at_steps: settings.cycle_dwell_steps,
        dwell_at_retracts: settings.cycle_dwell_retracts,
        orient: settings.cycle_orient,
        jog: or(settings.cycle_jog, usual.cycle_jog),
        sink_clear: settings.cycle_sink_clear.map(length),
        sink_as_printed,
        rigid: false,
    }
}

/// The unit of the form; `None` if the form is for both units.
pub fn form_units(settings: &Settings) -> Option<Units> {
    match settings.units {
        UnitChoice::Inch => Some(Units::Inch),
        UnitChoice::Mm => Some(Units::Mm),
        UnitChoice::Both => None,
    }
}

/// The factor that converts a length from one unit to the other.
pub fn factor(from: Units, to: Units) -> f64 {
    match (from, to) {
        (Units::Inch, Units::Mm) => MM,
        (Units::Mm, Units::Inch) => 1.0 / MM,
        _ => 1.0,
    }
}
