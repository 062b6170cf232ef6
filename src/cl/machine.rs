//! Statements that switch something: units, spindle, coolant, cutter compensation.

use super::cycle::follow_spindle;
use super::dialect::Dialect;
use super::fault::{Done, fault};
use super::ignored::{ignore, ignore_with_number};
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
    if let (true, [Word::Name(word)]) = (job.notes.dialect().is_of_autodesk(), words)
        && matches!(word.as_str(), "ON" | "OFF")
    {
        let message = format!("SPINDL/{word}: Autodesk's post exchanges ON and OFF");
        return fault(
            Code::PL004,
            message,
            "remove the manual command from the setup in the CAM system, or write SPINDL/CLW",
        );
    }
    let said = match (job.notes.dialect(), words) {
        // the post negates the speed of a left-hand tap, and writes the direction of the tool library
        (Dialect::Camplete, [unit, Word::Number(speed), _]) if *speed < 0.0 => {
            spindle(&[unit.clone(), Word::Number(-speed), Word::Name("CCLW".into())], job)?
        }
        _ => spindle(words, job)?,
    };
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
fn spindle(words: &[Word], job: &mut Job<'_>) -> Done<Spindle> {
    let mut said = Spindle::default();
    let (mut unit, mut is_on) = (None, false);
    let mut words = words.iter().peekable();
    while let Some(word) = words.next() {
        match word {
            Word::Number(speed) if *speed >= 0.0 && said.speed.is_none() => said.speed = Some(*speed),
            Word::Name(name) => match name.as_str() {
                "RPM" | "SFM" | "SMM" => once(&mut unit, name.as_str(), word)?,
                "CLW" => once(&mut said.turn, SpindleTurn::Cw, word)?,
                "CCLW" => once(&mut said.turn, SpindleTurn::Ccw, word)?,
                "OFF" | "STOP" => once(&mut said.turn, SpindleTurn::Off, word)?,
                "ON" => is_on = true,
                "MAXRPM" => match words.next().and_then(Word::number) {
                    Some(max) => once(&mut said.max, max, word)?,
                    None => return fault(Code::PL001, "MAXRPM without its number", "write MAXRPM,2000"),
                },
                _ if ignore_with_number("SPINDL", name, &mut words, &mut job.notes) => {}
                _ => {
                    let help = "write SPINDL/1200,RPM,CLW";
                    return fault(Code::PL002, format!("SPINDL can't take `{name}`"), help);
                }
            },
            word => return fault(Code::PL001, format!("SPINDL with `{word}`"), "write SPINDL/1200,RPM,CLW"),
        }
    }
    let factor = unit.map_or(Ok(1.0), |unit| surface(unit, job))?;
    said.speed = said.speed.map(|speed| speed * factor);
    said.css = unit.map(|unit| unit != "RPM");
    said.turn = said.turn.or_else(|| turn_without_word(is_on, said.speed.is_some(), job));
    Ok(said)
}

/// The factor that converts a speed to the unit of the job. Surface speeds are in feet or metres, as the file's units require.
fn surface(unit: &str, job: &mut Job<'_>) -> Done<f64> {
    if unit == "RPM" {
        return Ok(1.0);
    }
    Ok(match (unit, job.units()? == Units::Mm) {
        ("SFM", true) => METRES_A_FOOT,
        ("SMM", false) => 1.0 / METRES_A_FOOT,
        _ => 1.0,
    })
}

/// The direction after a SPINDL without a direction. `None`: the direction stays unchanged. ON, or a speed while the spindle is
/// off, turns the spindle in its last direction. For the first speed of a tool, the default of APT is clockwise.
fn turn_without_word(is_on: bool, has_speed: bool, job: &Job<'_>) -> Option<SpindleTurn> {
    match job.spindle.now.turn {
        Some(SpindleTurn::Off) if has_speed => Some(job.spindle.direction()),
        None if has_speed && !is_on => Some(SpindleTurn::Cw),
        _ => is_on.then(|| job.spindle.direction()),
    }
}

/// Sets a value that a statement may give only once.
fn once<T: PartialEq>(value: &mut Option<T>, new: T, word: &Word) -> Done {
    if value.as_ref().is_some_and(|before| *before != new) {
        return fault(Code::PL002, format!("{word} contradicts a word before it"), "keep one of the two words");
    }
    *value = Some(new);
    Ok(())
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
        _ if job.notes.dialect() == Dialect::Camplete => camplete_coolant(name)?,
        _ => return no_coolant(name),
    };
    if job.notes.dialect() == Dialect::Camplete {
        return job.coolant(with_coolant(job.tools.coolant, coolant, name == "ON"));
    }
    job.coolant(coolant)
}

/// The kinds of coolant that Autodesk's post for CAMplete writes with a number. `None`: forms have no such kind.
const CUSTOM: [(&str, Option<Coolant>, &str); 3] =
    [("CUSTOM1", Some(Coolant::AIR), "air"), ("CUSTOM2", None, "air through the tool"), ("CUSTOM3", None, "suction")];

/// Reads COOLNT/CUSTOMn.
fn camplete_coolant(name: &str) -> Done<Coolant> {
    match CUSTOM.iter().find(|(word, ..)| *word == name) {
        Some((_, Some(coolant), _)) => Ok(*coolant),
        Some((_, None, kind)) => {
            let help = "select another coolant in the CAM system, or write COOLNT/AIR or THRU";
            fault(Code::PL002, format!("COOLNT/{name} is {kind}, which forms can't print"), help)
        }
        None => no_coolant(name),
    }
}

fn no_coolant<T>(name: &str) -> Done<T> {
    fault(Code::PL002, format!("COOLNT can't take `{name}`"), "write ON, FLOOD, MIST or OFF")
}

/// The coolant after a statement that turns on one more kind. ON, which names no kind, leaves the kinds that are on.
fn with_coolant(before: Option<Coolant>, said: Coolant, is_on: bool) -> Coolant {
    match before.filter(|before| *before != Coolant::OFF) {
        Some(before) if is_on => before,
        Some(before) if said != Coolant::OFF => before.and(said),
        _ => said,
    }
}

/// Handles CUTCOM/LEFT, RIGHT and OFF. Compensation changes with the next motion.
pub(super) fn cutcom(words: &[Word], cutcom: &mut Cutcom, cycle: &Cycle, job: &mut Job<'_>) -> Done {
    if job.notes.dialect().is_of_autodesk() && matches!(words, [word] if word.is("ON")) {
        return Ok(()); // a later statement gives the side
    }
    let side = |name: &str| match name {
        "LEFT" => Some(Some(Side::Left)),
        "RIGHT" => Some(Some(Side::Right)),
        "OFF" => Some(None),
        _ => None,
    };
    let mut asked = None;
    for word in words {
        match (word, word.name().and_then(side)) {
            (_, Some(side)) => once(&mut asked, side, word)?,
            (Word::Name(name), _) if ignore("CUTCOM", name, &mut job.notes) => {}
            (Word::Number(register), _) if job.diameter_register() == Some(*register) => {}
            (Word::Number(_), _) => job.notes.warn(
                Code::PL008,
                "the offset register of the tool is printed, not the register of CUTCOM",
                "check the D word in the program",
            ),
            _ => return fault(Code::PL002, format!("CUTCOM can't take `{word}`"), "write LEFT, RIGHT or OFF"),
        }
    }
    let Some(asked) = asked else {
        return fault(Code::PL002, "CUTCOM without a side", "write CUTCOM/LEFT, RIGHT or OFF");
    };
    if cycle.is_active() && asked.is_some() {
        return fault(Code::PC041, "CUTCOM inside a cycle", "end the cycle first");
    }
    if let Some(side) = cutcom.waiting_side().filter(|_| cutcom.asked != Some(asked)) {
        let message = format!("CUTCOM/{side} has no effect: no motion in the plane comes before the next CUTCOM");
        job.notes.warn(Code::PL008, message, "put CUTCOM before the motion that turns compensation on");
    }
    // OFF has no effect if compensation is off
    cutcom.asked = Some(asked).filter(|_| asked.is_some() || cutcom.on);
    Ok(())
}

/// Checks that compensation does not wait for a motion in the plane. `end` is what comes instead of this motion.
pub(super) fn no_cutcom_waits(cutcom: &Cutcom, end: &str) -> Done {
    let Some(side) = cutcom.waiting_side() else { return Ok(()) };
    let message = format!("CUTCOM/{side} has no effect: {end} comes before a motion in the plane");
    fault(Code::PL004, message, "put CUTCOM before the motion that turns compensation on, or remove it")
}
