//! Statements that switch something: units, spindle, coolant, cutter compensation.

use super::cycle::follow_spindle;
use super::dialect::Dialect;
use super::fault::{Done, fault};
use super::job::Job;
use super::state::{Cutcom, Cycle};
use super::words::Word;
use crate::diag::Code;
use crate::toolpath::{Coolant, Event, Side, Spindle, SpindleTurn, Units};

/// Metres in a foot.
const METRES_A_FOOT: f64 = 0.3048;

/// Handles UNITS/MM and UNITS/INCHES.
pub(super) fn units(words: &[Word], job: &mut Job<'_>) -> Done {
    match words {
        [Word::Name(name)] if name == "MM" => job.set_units(Units::Mm),
        [Word::Name(name)] if matches!(name.as_str(), "INCHES" | "INCH" | "IN") => job.set_units(Units::Inch),
        _ => fault(Code::PL004, "units that postform does not read", "write UNITS/MM or UNITS/INCHES"),
    }
}

/// Handles SPINDL. After a change of the speed, feeds per revolution are converted again.
pub(super) fn spindl(words: &[Word], cycle: &mut Cycle, job: &mut Job<'_>) -> Done {
    if let (Dialect::Autodesk, [Word::Name(word)]) = (job.notes.dialect(), words)
        && matches!(word.as_str(), "ON" | "OFF")
    {
        let message = format!("SPINDL/{word}: Autodesk's post exchanges ON and OFF");
        return fault(
            Code::PL004,
            message,
            "remove the manual command from the setup in the CAM system, or write SPINDL/CLW",
        );
    }
    let said = spindle(words, job)?;
    job.spindle.say(said);
    follow_spindle(cycle, job)?;
    if job.changes() || !job.has_operation() {
        return Ok(()); // the spindle becomes part of the tool change
    }
    // on mills, programs begin in revolutions per minute
    let css = job.spindle.now.css.filter(|css| *css || job.turns_part());
    job.between(Event::Spindle(Spindle { css, ..said }))
}

/// Reads the speed, its unit and the direction, in any order.
fn spindle(words: &[Word], job: &Job<'_>) -> Done<Spindle> {
    let mut said = Spindle::default();
    let mut surface = 1.0;
    let mut words = words.iter().peekable();
    while let Some(word) = words.next() {
        match word {
            Word::Number(speed) if *speed >= 0.0 && said.speed.is_none() => said.speed = Some(*speed),
            Word::Name(name) => match name.as_str() {
                "RPM" => said.css = Some(false),
                "SFM" | "SMM" => {
                    said.css = Some(true);
                    // a surface speed is converted to feet or metres, as the file's units require
                    let metric = job.units()? == Units::Mm;
                    surface = match (name.as_str(), metric) {
                        ("SFM", true) => METRES_A_FOOT,
                        ("SMM", false) => 1.0 / METRES_A_FOOT,
                        _ => 1.0,
                    };
                }
                "CLW" => said.turn = Some(SpindleTurn::Cw),
                "CCLW" => said.turn = Some(SpindleTurn::Ccw),
                "OFF" | "STOP" => said.turn = Some(SpindleTurn::Off),
                "ON" => said.turn = said.turn.or(Some(job.spindle.direction())),
                "MAXRPM" => said.max = words.next().and_then(Word::number),
                "RANGE" | "LOW" | "MEDIUM" | "HIGH" => {
                    words.next_if(|word| word.number().is_some());
                }
                _ => {
                    let help = "write SPINDL/1200,RPM,CLW";
                    return fault(Code::PL002, format!("SPINDL can't take `{name}`"), help);
                }
            },
            word => return fault(Code::PL001, format!("SPINDL with `{word}`"), "write SPINDL/1200,RPM,CLW"),
        }
    }
    said.speed = said.speed.map(|speed| speed * surface);
    if said.speed.is_some() && said.turn.is_none() && job.spindle.now.turn.is_none() {
        said.turn = Some(SpindleTurn::Cw); // APT's default direction
    }
    Ok(said)
}

/// Handles COOLNT.
pub(super) fn coolnt(words: &[Word], job: &mut Job<'_>) -> Done {
    let name = match words {
        [Word::Name(name)] => name.as_str(),
        _ => return fault(Code::PL002, "COOLNT with more than one word", "write ON, FLOOD, MIST or OFF"),
    };
    let coolant = match name {
        "ON" | "FLOOD" => Coolant::FLOOD,
        "MIST" => Coolant::MIST,
        "OFF" => Coolant::OFF,
        "THRU" => Coolant::THROUGH,
        "AIR" => Coolant::AIR,
        "HIGH" => Coolant::HIGH,
        "TAPKUL" | "LOW" => {
            let message = format!("COOLNT/{name} is printed as flood coolant");
            job.notes.warn(Code::PL008, message, "change the program, or write COOLNT/FLOOD");
            Coolant::FLOOD
        }
        _ => return fault(Code::PL002, format!("COOLNT can't take `{name}`"), "write ON, FLOOD, MIST or OFF"),
    };
    job.coolant(coolant)
}

/// Handles CUTCOM/LEFT, RIGHT and OFF. Compensation changes with the next motion.
pub(super) fn cutcom(words: &[Word], cutcom: &mut Cutcom, cycle: &Cycle, job: &mut Job<'_>) -> Done {
    if let (Dialect::Autodesk, [Word::Name(word)]) = (job.notes.dialect(), words)
        && word == "ON"
    {
        return Ok(()); // a later statement gives the side
    }
    let side = |name: &str| match name {
        "LEFT" => Some(Some(Side::Left)),
        "RIGHT" => Some(Some(Side::Right)),
        "OFF" => Some(None),
        _ => None,
    };
    let known = ["XYPLAN", "OSETNO", "OFSETNO", "NORMDS"];
    let mut asked = None;
    for word in words {
        match word {
            Word::Name(name) if side(name).is_some() => asked = side(name),
            Word::Name(name) if known.contains(&name.as_str()) => {}
            Word::Number(_) => job.notes.warn(
                Code::PL008,
                "the offset register of the tool is printed, not the register of CUTCOM",
                "check the D word in the program",
            ),
            word => return fault(Code::PL002, format!("CUTCOM can't take `{word}`"), "write LEFT, RIGHT or OFF"),
        }
    }
    let Some(asked) = asked else {
        return fault(Code::PL002, "CUTCOM without a side", "write CUTCOM/LEFT, RIGHT or OFF");
    };
    if cycle.is_active() && asked.is_some() {
        return fault(Code::PC041, "CUTCOM inside a cycle", "end the cycle first");
    }
    // OFF has no effect if compensation is off
    cutcom.asked = Some(asked).filter(|_| asked.is_some() || cutcom.on);
    cutcom.on = asked.is_some();
    Ok(())
}
