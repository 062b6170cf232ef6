//! CYCLE statements, which select the cycle for the following points.

use super::coded::{Coded, cycle_type, over, read_options};
use super::cycle_camplete::{Converted, camplete};
use super::cycle_dialects::{Heights, autodesk, in_gener_words, returns_to_start};
use super::cycle_words::Opt;
use super::dialect::Dialect;
use super::fault::{Done, fault};
use super::job::Job;
use super::spec::spec;
use super::state::{CodedReturn, Cycle, ReturnMode, State};
use super::words::Word;
use crate::cycle::check;
use crate::diag::Code;
use crate::toolpath::CycleKind;

/// Handles CYCLE/type and CYCLE/ON, OFF, NOMORE, AUTO and RETURN.
pub(super) fn cycle(words: &[Word], state: &mut State<'_>) -> Done {
    let Some(first) = words.first().and_then(Word::name) else {
        return fault(Code::PC001, "CYCLE without a type", "write CYCLE/DRILL,DEPTH,10,MMPM,100,CLEAR,2");
    };
    let dialect = state.job.notes.dialect();
    match first {
        "OFF" | "NOMORE" if state.cycle.is_active() => {
            end(&mut state.cycle, &mut state.job)?;
            state.motion.rapid_after_cycle = true;
            Ok(())
        }
        "OFF" | "NOMORE" => {
            if dialect != Dialect::SolidWorksCam {
                state.job.notes.warn(Code::PC051, format!("CYCLE/{first}, but no cycle is active"), "take it out");
            }
            Ok(())
        }
        "INIT" | "CLEAR" if dialect == Dialect::SolidWorksCam => Ok(()),
        "AUTO" => auto(&words[1..], &mut state.cycle, &mut state.job),
        "RETURN" => return_mode(&words[1..], &mut state.cycle),
        "ON" => match state.cycle.last.clone() {
            Some(last) => begin(last, &words[1..], false, state),
            None => fault(Code::PC038, "CYCLE/ON without an earlier cycle", "write the whole cycle"),
        },
        _ if dialect == Dialect::Autodesk => {
            let (words, heights) = autodesk(words)?;
            begin_in_gener(&words, state)?;
            let shifted = |height| state.motion.shift.of([0.0, 0.0, height])[2];
            let heights =
                Heights { clearance: shifted(heights.clearance), retract: shifted(heights.retract), ..heights };
            let returns = CodedReturn::Height { height: heights.clearance, above: None };
            state.cycle.returns = state.cycle.return_mode.over(Some(returns));
            state.cycle.heights = Some(heights);
            Ok(())
        }
        _ if dialect == Dialect::Camplete => {
            let Converted { words, returns } = of_camplete(words, state)?;
            begin_in_gener(&words, state)?;
            state.cycle.returns = state.cycle.return_mode.over(Some(returns));
            Ok(())
        }
        _ => {
            begin_in_gener(&in_gener_words(words, dialect)?, state)?;
            if returns_to_start(words, dialect) {
                state.cycle.returns = state.cycle.return_mode.over(Some(CodedReturn::Start));
            }
            Ok(())
        }
    }
}

/// Begins a cycle that is given in the words of GENER.
fn begin_in_gener(words: &[Word], state: &mut State<'_>) -> Done {
    let (coded, rest) = cycle_type(words)?;
    begin(coded, rest, true, state)
}

/// Converts a cycle of Autodesk's post for CAMplete. The points of a cycle have no tool axis.
fn of_camplete(words: &[Word], state: &mut State<'_>) -> Done<Converted> {
    if state.motion.many_axes {
        let help = "in the CAM system, make the holes in an operation with a fixed tool axis";
        return fault(Code::PL004, "a cycle after MULTAX/ON: the tool axis at its points is unknown", help);
    }
    let State { job, motion, .. } = state;
    let mut made = camplete(words, job.spindle.now.turn, &mut job.notes)?;
    if let CodedReturn::Height { height, .. } = &mut made.returns {
        *height = motion.shift.of([0.0, 0.0, *height])[2];
    }
    Ok(made)
}

fn auto(words: &[Word], cycle: &mut Cycle, job: &mut Job<'_>) -> Done {
    match words {
        [word] if word.is("ON") || word.is("OFF") => {
            let emulate = word.is("OFF");
            if emulate != cycle.emulate {
                job.close_holes()?; // the new return plane applies to the following points
            }
            cycle.emulate = emulate;
            if let Some(spec) = &mut cycle.active {
                spec.emulate = emulate;
            }
            Ok(())
        }
        _ => fault(Code::PC039, "a CYCLE/AUTO that can't be read", "write CYCLE/AUTO,ON or OFF"),
    }
}

fn return_mode(words: &[Word], cycle: &mut Cycle) -> Done {
    cycle.return_mode = match words {
        [word] if word.is("ON") => ReturnMode::AtStart,
        [word] if word.is("OFF") => ReturnMode::Off,
        [word] if word.is("AUTO") => ReturnMode::AsCoded,
        [Word::Number(height)] => ReturnMode::Above(*height),
        _ => {
            let help = "write CYCLE/RETURN,ON, OFF, AUTO or a height";
            return fault(Code::PC040, "a CYCLE/RETURN that can't be read", help);
        }
    };
    Ok(())
}

/// Begins a cycle from the words of this statement and of an earlier CYCLE statement.
fn begin(coded: Coded, words: &[Word], whole: bool, state: &mut State<'_>) -> Done {
    let State { job, motion, feeds, cycle, .. } = state;
    job.close_holes()?;
    cycle.active = None;
    motion.rapid = false; // a RAPID before a cycle has no effect
    motion.rapid_after_cycle = false;
    feeds.cut_off = None;
    if motion.cutcom.is_in_use() {
        return fault(
            Code::PC041,
            "a cycle under cutter compensation",
            "before the cycle, end compensation with CUTCOM/OFF and a motion",
        );
    }
    let said = read_options(&mut job.notes, &coded, words, whole, feeds.feed)?;
    let coded = if whole { said } else { over(coded, said) };
    let spec = spec(cycle, job, &coded)?;
    check(&spec)?;
    let above = |numbers: &[f64]| numbers.first().map_or(CodedReturn::Clearance, |above| CodedReturn::Above(*above));
    let own = coded.numbers(Opt::Return).map(above);
    // a manual cycle has no return plane: the tool stays where it stopped
    cycle.returns = if spec.kind == CycleKind::Manual { None } else { cycle.return_mode.over(own) };
    cycle.heights = None;
    cycle.plane = None;
    cycle.last = Some(coded);
    cycle.active = Some(spec);
    Ok(())
}

/// After a change of the spindle speed, converts the feeds per revolution of the active cycle again.
pub(super) fn follow_spindle(cycle: &mut Cycle, job: &mut Job<'_>) -> Done {
    if cycle.active.is_some()
        && let Some(coded) = cycle.last.clone()
    {
        job.close_holes()?;
        cycle.active = Some(spec(cycle, job, &coded)?);
    }
    Ok(())
}

/// Ends the cycle. The points after the end of the cycle are motions.
pub(super) fn end(cycle: &mut Cycle, job: &mut Job<'_>) -> Done {
    cycle.active = None;
    cycle.heights = None;
    job.close_holes()
}
