//! Prints the conditions that the control lacks and that no sequence prints, each in a separate block.

use super::body::run_all;
use super::cx::{Cx, Writer};
use super::fault::{Done, fault, fault_at};
use super::more_coolants::{begin_beside, end_beside};
use super::printer::Printer;
use super::said::Said;
use super::shape::Shape;
use super::targets::set_targets;
use super::upon::upons;
use super::want::Want;
use super::words::{speed_word, value_code};
use super::work::work_block;
use crate::compile::{LetterKind, Op, Routine};
use crate::diag::Code;
use crate::lang::{SequenceId, VarId, VarSet};

/// Prints waiting changes before the next move.
#[cold]
pub fn settle(cx: &mut Cx<'_>) -> Done {
    let shape = cx.shape;
    knows_after_stop(shape, cx.want, cx.said)?;
    print_lacking(cx)
}

/// Prints waiting changes at the current position. `cuts`: a cut follows, so an Upon must not leave the tool at another
/// position.
#[cold]
pub fn settle_here(cuts: bool, cx: &mut Cx<'_>) -> Done {
    let shape = cx.shape;
    for var in [VarId::H, VarId::V, VarId::D] {
        cx.want.put(var, None);
    }
    let here = cx.said.stand.position;
    set_targets(&here, shape, cx.want, cx.said)?;
    if cuts {
        knows_after_stop(shape, cx.want, cx.said)?;
    }
    print_lacking(cx)?;
    if cuts { stands_at_cut(cx.said) } else { Ok(()) }
}

/// Prints waiting changes.
pub fn print_lacking(cx: &mut Cx<'_>) -> Done {
    let shape = cx.shape;
    (cx.want.changed, cx.said.differs) = (false, false);
    print_conditions(cx)?;
    check_reading(shape, cx.want, cx.said)
}

/// Prints changes that no other block printed, each in a separate block.
pub fn print_conditions(cx: &mut Cx<'_>) -> Done {
    let shape = cx.shape;
    upons(cx.said.lacks(cx.want, shape), cx)?;
    own_change(SequenceId::WorkChange, &[VarId::Work], cx)?;
    if let Some(work) = cx.want.get(VarId::Work)
        && cx.said.conditions.get(VarId::Work) != Some(work)
    {
        work_block(work, &mut cx.writer())?;
    }
    if let Some(max) = cx.want.get(VarId::Maxrpm)
        && cx.said.conditions.get(VarId::Maxrpm) != Some(max)
    {
        let message = format!("the spindle is limited to {max} from here, but nothing prints the limit");
        let help = "the form prints [maxrpm] at a tool change: give the limit at the tool change, for all operations \
            of the tool";
        return fault(Code::PR038, message, help);
    }
    check_own_limit(shape, cx.want, cx.said)?;
    spindle_change(cx)?;
    own_change(SequenceId::CoolantChange, &[VarId::Cool], cx)?;
    end_beside(cx.want.coolant, &mut cx.writer())?;
    if let Some(ends) = cx.want.ends_coolant.take().filter(|&ends| cx.said.coolant_ended != Some(ends)) {
        value_code(b'M', ends, &mut cx.writer())?;
        cx.out.end_block();
    }
    if let Some(cool) = cx.said.due(VarId::Cool, cx.want)
        && cx.said.conditions.get(VarId::Cool) != Some(cool)
    {
        takes_back(VarId::Cool, cool, shape, cx.said, cx.out);
        value_code(b'M', cool, &mut cx.writer())?;
        cx.out.end_block();
        cx.said.conditions.put(VarId::Cool, Some(cool));
    }
    begin_beside(&mut cx.writer())?;
    // a coolant code may have stopped the spindle
    spindle_change(cx)?;
    own_change(SequenceId::FeedModeChange, &[VarId::Feedtype], cx)?;
    if let Some(feed_type) = cx.want.get(VarId::Feedtype)
        && cx.said.conditions.get(VarId::Feedtype) != Some(feed_type)
    {
        value_code(b'G', feed_type, &mut cx.writer())?;
        cx.out.end_block();
        cx.said.conditions.put(VarId::Feedtype, Some(feed_type));
    }
    cx.said.conditions_are_settled(cx.want);
    cx.want.ends_what_is_on(shape);
    Ok(())
}

/// Warns if a line of the form has set the next printed condition to another value than the job requests.
fn takes_back(var: VarId, due: f64, shape: &Shape, said: &mut Said, out: &mut Printer) {
    let Some((typed, line)) = said.take_typed(var) else { return };
    let letter = if var == VarId::Speed { char::from(shape.program.settings.speed_code) } else { 'M' };
    let message =
        format!("the form prints {letter}{typed}, but the job requests {letter}{due}, which is printed after it");
    let help = "remove the word from the form, or the value from the job";
    out.note_at(Code::PR056, message, help, line);
}

/// Runs the form's own sequence for a change that no other sequence printed. A part of the change that the sequence
/// does not print is generated afterwards.
fn own_change(id: SequenceId, vars: &[VarId], cx: &mut Cx<'_>) -> Done {
    let shape = cx.shape;
    match shape.program.routine(id) {
        Some(routine) if cx.said.lacks(cx.want, shape).meets(VarSet::of(vars)) => {
            run_all(shape.way(routine, cx.want, cx.said), &mut cx.writer())?;
            if !shape.program.settings.control().prints_codes() {
                // in another language, the form's own sequence printed the change in its own words
                for &var in vars {
                    cx.said.conditions.put(var, cx.said.due(var, cx.want));
                }
            }
            Ok(())
        }
        _ => Ok(()),
    }
}

/// Prints speed and direction by the form's own sequence, otherwise as a block.
fn spindle_change(cx: &mut Cx<'_>) -> Done {
    let vars = [VarId::Speed, VarId::Direct, VarId::Speedtype];
    own_change(SequenceId::SpindleChange, &vars, cx)?;
    print_spindle(&mut cx.writer())
}

/// Prints speed and direction of the spindle if no other block did, unless the form's own sequences switch the spindle.
fn print_spindle(writer: &mut Writer<'_>) -> Done {
    let shape = writer.shape;
    let settings = &shape.program.settings;
    let [cw, ccw, off] = settings.spindle;
    if shape.program.switches_spindle {
        return Ok(());
    }
    let speed = writer.said.due(VarId::Speed, writer.want);
    let direct = writer.want.get(VarId::Direct);
    let turns = direct.is_some_and(|code| code == cw || code == ccw);
    let speed_type = writer.want.get(VarId::Speedtype);
    let other_mode = writer.said.conditions.get(VarId::Speedtype) != speed_type;
    if direct != Some(off)
        && (turns || speed.is_some())
        && (writer.said.conditions.get(VarId::Direct) != direct
            || writer.said.conditions.get(VarId::Speed) != speed
            || other_mode)
    {
        if let Some(mode) = speed_type.filter(|_| other_mode) {
            value_code(b'G', mode, writer)?;
            writer.said.conditions.put(VarId::Speedtype, Some(mode));
        }
        if let Some(speed) = speed {
            takes_back(VarId::Speed, speed, shape, writer.said, writer.out);
            speed_word(speed, writer)?;
            writer.said.conditions.put(VarId::Speed, Some(speed));
        }
        if let Some(direct) = direct {
            takes_back(VarId::Direct, direct, shape, writer.said, writer.out);
            value_code(b'M', direct, writer)?;
        }
        writer.out.end_block();
    } else if direct == Some(off) && writer.said.conditions.get(VarId::Direct) != Some(off) {
        takes_back(VarId::Direct, off, shape, writer.said, writer.out);
        value_code(b'M', off, writer)?;
        writer.out.end_block();
    }
    Ok(())
}

/// Checks the spindle limit of a tool whose tool change printed the first speed as the limit. A higher speed or a
/// surface speed is an error.
fn check_own_limit(shape: &Shape, want: &Want, said: &Said) -> Done {
    let Some(limit) = said.conditions.get(VarId::Maxrpm).filter(|_| want.get(VarId::Maxrpm).is_none()) else {
        return Ok(());
    };
    if !want.is_surface(shape) && want.get(VarId::Speed).is_none_or(|speed| speed <= limit) {
        return Ok(());
    }
    let message = format!("the tool change limited the spindle to its first speed, {limit}");
    fault(Code::PR038, message, "give the operation's spindle its `max`")
}

/// Prints the speed mode before the speed, if the block with the speed does not print the mode.
pub fn speed_mode_before(writer: &mut Writer<'_>) -> Done {
    let Some(mode) =
        writer.want.get(VarId::Speedtype).filter(|mode| writer.said.conditions.get(VarId::Speedtype) != Some(*mode))
    else {
        return Ok(());
    };
    value_code(b'G', mode, writer)?;
    writer.said.conditions.put(VarId::Speedtype, Some(mode));
    // without a new speed, the code would apply to the old speed in the new unit
    if let Some(speed) = writer.want.get(VarId::Speed) {
        speed_word(speed, writer)?;
        writer.said.conditions.put(VarId::Speed, Some(speed));
    }
    writer.out.end_block();
    Ok(())
}

/// Whether no change except the work offset waits.
pub fn only_work_waits(shape: &Shape, want: &Want, said: &Said) -> bool {
    said.lacks(want, shape).without(VarSet::of(&[VarId::Work])).is_empty()
}

/// Checks that spindle and coolant are known in a subprogram after a stop, because its callers may have set any values.
pub fn knows_after_stop(shape: &Shape, want: &Want, said: &Said) -> Done {
    let unknown = |var: VarId| want.get(var).is_none();
    let by_form = shape.program.switches_spindle; // then nothing is printed again
    let stops = said.sub.is_some_and(|sub| sub.stops);
    if !stops || by_form || ![VarId::Speed, VarId::Direct, VarId::Cool].into_iter().any(unknown) {
        return Ok(());
    }
    let help = "give the subprogram its own `spindle` and `coolant` before the stop";
    fault(Code::PR033, "the subprogram continues after a stop, but its spindle and coolant are unknown here", help)
}

/// Checks that the control reads positions as positions, increments as increments, and both in the units of the program.
pub fn check_reading(shape: &Shape, want: &Want, said: &Said) -> Done {
    if let Some(code) = said.misread_by(shape, want) {
        let message = format!("the control is in {code} here, and would misread every length");
        let help = "remove the code from the sequence, or print the program's own code after it: `G[unitmode]`";
        return fault(Code::PR041, message, help);
    }
    if said.distance_is_wrong(shape) {
        let [increments, positions] = shape.program.settings.inc_abs;
        let (now, needed, read) = match shape.program.settings.incremental {
            true => (positions, increments, "increments as positions"),
            false => (increments, positions, "positions as increments"),
        };
        let message = format!("the control is in G{now} here, and would read {read}");
        let help = format!("print G{needed} in the sequence that printed G{now}, after the words that need it");
        return fault(Code::PR040, message, help);
    }
    Ok(())
}

/// Checks a sequence that prints axis words before its own G90 or G91. The control reads these words by the code that was
/// active before.
pub fn check_reading_of(routine: &Routine, shape: &Shape, want: &Want, said: &Said) -> Done {
    for i in routine.steps() {
        let letter = match shape.program.ops[i] {
            Op::Var { letter, .. } | Op::Formula { letter, .. } => letter,
            Op::Literal { index, .. } => {
                let literal = &shape.program.literals[index as usize];
                let distances = shape.program.settings.inc_abs;
                if literal.code.is_some_and(|code| distances.iter().any(|&number| code.is_g(number))) {
                    return Ok(());
                }
                literal.letter
            }
            _ => continue,
        };
        if shape.letters[letter].kind == LetterKind::Axis && !shape.program.settings.incremental {
            return check_reading(shape, want, said);
        }
    }
    Ok(())
}

/// Checks that a cut begins where the path requires it, not where a sequence moved the tool.
pub fn stands_at_cut(said: &Said) -> Done {
    match said.stand.moved_by {
        Some(span) => {
            let message = "this sequence moves the tool away, but the path continues with a cut";
            fault_at(Code::PR012, message, "before the cut, put a rapid to its start", Some(span))
        }
        None => Ok(()),
    }
}
