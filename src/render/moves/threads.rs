//! Threads on a lathe: by the control's cycle, by a cycle for each pass, or by generated passes.

use super::rapid_blocks::rapid_to;
use crate::compile::{Op, Routine};
use crate::cycle::thread_passes;
use crate::diag::Code;
use crate::lang::{Machine, SequenceId, VarId};
use crate::render::body::{Mode, go_on, run_part};
use crate::render::cx::{Cx, Writer};
use crate::render::fault::{Done, fault, fault_at};
use crate::render::printer::Printer;
use crate::render::said::{LastMove, Said};
use crate::render::settle::settle;
use crate::render::shape::Shape;
use crate::render::targets::set_targets;
use crate::render::upon::{run_with_upons, upons};
use crate::render::want::Want;
use crate::render::words::{axis_word, code_word, letter_word};
use crate::sema;
use crate::toolpath::{Axes, Thread};

/// A thread in program units. Radii are real radii, not diameters.
struct Cut {
    /// Position of the thread's end along its axis.
    end: f64,
    /// Radius of the crest at the thread's end.
    crest: f64,
    /// Direction of the passes: -1 towards the spindle axis, 1 away from the spindle axis.
    inward: f64,
    passes: Vec<f64>,
    lead: f64,
    /// Decrease of the crest's radius from start to end, per unit of length.
    slope: f64,
}

impl Cut {
    /// Radius at the start of a pass minus radius at its end.
    fn taper(&self, begin: f64) -> f64 {
        self.slope * (begin - self.end).abs()
    }
}

/// Prints a thread of the path. The sequence AutoThread has priority, then the sequence CanThread. If the form has
/// neither sequence, postform generates the passes.
pub fn cut_thread(thread: &Thread, cx: &mut Cx<'_>) -> Done {
    let shape = cx.shape;
    check_state(shape, cx.want, cx.out)?;
    let cut = planned(thread, shape, cx.said)?;
    check_beside(thread, &cut, shape, cx.said)?;
    let starts = thread.starts.unwrap_or(1.0);
    let begin = cx.said.stand.target(&thread.from, shape).values[0];
    thread_variables(thread, &cut, shape, cx.want);
    let routine = |id: SequenceId| shape.routine(id, cx.want, cx.said);
    let cycle = routine(SequenceId::AutoThread).or(routine(SequenceId::CanThread));
    if let Some(routine) = cycle {
        check_thread_words(thread, &cut, routine, shape, cx.want)?;
    } else if thread.chamfer.is_some_and(|length| length != 0.0) {
        let help = "leave the chamfer out, or give the form a sequence AutoThread that prints [chams]";
        return fault(Code::PR031, "passes made of single moves have no chamfer", help);
    }
    for start in 0..starts as u32 {
        // each start begins one pitch further back
        let back = f64::from(start) * thread.pitch * shape.scale;
        let begin = begin + back * if begin >= cut.end { 1.0 } else { -1.0 };
        cx.want.set(VarId::Taper, cut.taper(begin));
        let mut at = cx.said.stand.position;
        at.set(0, begin);
        set_targets(&at, shape, cx.want, cx.said)?;
        if cx.said.is_unsettled(cx.want) {
            settle(cx)?;
        }
        rapid_to(&at, cx)?;
        let here = cx.said.stand.position;
        match (
            shape.routine(SequenceId::AutoThread, cx.want, cx.said),
            shape.routine(SequenceId::CanThread, cx.want, cx.said),
        ) {
            (Some(routine), _) => {
                pass_variables(&cut, cut.passes[cut.passes.len() - 1], shape, cx.want, cx.said)?;
                run_with_upons(routine, cx)?;
            }
            (None, Some(routine)) => canned_passes(routine, &cut, cx)?,
            (None, None) => own_passes(&cut, &here, cx)?,
        }
        if cycle.is_some_and(|routine| routine.cancel)
            && let Some(cancel) = shape.routine(SequenceId::Cancel, cx.want, cx.said)
        {
            run_with_upons(cancel, cx)?; // otherwise the next rapid would be a pass
        }
        cx.said.forget_words();
        cx.said.stand.position = here;
        cx.said.last_move = LastMove::None;
    }
    let feed = cx.want.feed();
    cx.want.keep_feed(feed, shape);
    Ok(())
}

/// Refuses a thread that the machine can't cut in its current state.
fn check_state(shape: &Shape, want: &Want, out: &mut Printer) -> Done {
    let settings = &shape.program.settings;
    if settings.machine != Machine::Lathe {
        return fault(Code::PR008, "threads are for lathes", "program the thread as milling moves, or tap it");
    }
    if !want.get(VarId::Direct).is_some_and(|code| code != settings.spindle[2]) {
        return fault(Code::PR032, "the spindle does not turn", "give the operation a spindle with a direction");
    }
    if want.compensated {
        let help = "end the compensation with an `outfeed` first";
        return fault(Code::PR030, "a thread under cutter compensation", help);
    }
    if want.is_surface(shape) {
        let message =
            "a thread at constant surface speed: the passes have different speeds and different starting angles"
                .to_owned();
        out.note(Code::PR029, message, "give the operation of the thread a spindle with \"mode\": \"rpm\"");
    }
    if settings.incremental {
        let help = "use a form that prints positions";
        return fault(Code::PR031, "the words of a thread are positions, but the form prints increments", help);
    }
    Ok(())
}

/// Checks that the tool is beside the thread, on the side from which the thread is cut.
fn check_beside(thread: &Thread, cut: &Cut, shape: &Shape, said: &Said) -> Done {
    let Some(beside) = said.stand.position.get(1) else {
        let help = "begin with a rapid to a position next to the thread, with the distance from the axis";
        return fault(Code::PR001, "the radius at which the passes of the thread begin is unknown", help);
    };
    let from = said.stand.target(&thread.from, shape).values[1];
    let wrong = [from, cut.crest].iter().any(|crest| (beside - crest) * cut.inward > 1e-9);
    if wrong {
        let (kind, place) = if cut.inward > 0.0 { ("inner", "outside") } else { ("outer", "inside") };
        let message = format!("the tool is at the radius {beside}, {place} the crest of an {kind} thread");
        return fault(Code::PR031, message, "first make a rapid to the other side of the crest");
    }
    Ok(())
}

fn planned(thread: &Thread, shape: &Shape, said: &Said) -> Done<Cut> {
    let from = said.stand.target(&thread.from, shape);
    let to = said.stand.target(&thread.to, shape);
    let (Some(start), Some(end)) = (from.get(1), to.get(0)) else {
        return fault(
            Code::PR031,
            "the thread's start or end is unknown",
            "give both coordinates of `from`, and z of `to`",
        );
    };
    let Some(begin) = from.get(0).filter(|&begin| begin != end) else {
        return fault(Code::PR031, "the thread has no length", "give `from` and `to` different z");
    };
    let taper = thread.taper.map(|taper| taper * shape.scale);
    let crest = if thread.to.given & 0b10 != 0 { to.values[1] } else { start - taper.unwrap_or(0.0) };
    let falls = start - crest;
    if let Some(taper) = taper.filter(|taper| (taper - falls).abs() > 1e-9) {
        let message = format!("the ends of the thread differ by {falls} in radius, but its `taper` is {taper}");
        return fault(
            Code::PR031,
            message,
            "give only x of `to`, or only `taper`, or a `taper` equal to the change of x",
        );
    }
    let depth = thread.depth.abs() * shape.scale;
    let first = thread.first_depth.map(|d| d * shape.scale);
    let least = thread.min_depth.unwrap_or(0.0) * shape.scale;
    let passes = thread_passes(depth, first, thread.passes.map(|n| n as usize), least)?;
    Ok(Cut {
        end,
        crest,
        inward: if thread.depth < 0.0 { 1.0 } else { -1.0 },
        passes,
        lead: thread.pitch * thread.starts.unwrap_or(1.0) * shape.scale,
        slope: falls / (begin - end).abs() * shape.scales[1].signum(),
    })
}

fn thread_variables(thread: &Thread, cut: &Cut, shape: &Shape, want: &mut Want) {
    let first = cut.passes[0];
    let depth = thread.depth.abs() * shape.scale;
    let angle = thread.angle.unwrap_or(60.0);
    want.set(VarId::Pitch, thread.pitch * shape.scale);
    want.set(VarId::Frate, cut.lead);
    want.set(VarId::Depth, depth);
    want.set(VarId::Peck1, first);
    want.set(VarId::Vbite, thread.min_depth.unwrap_or(0.0) * shape.scale);
    want.set(VarId::Vleave, 0.0);
    want.set(VarId::Passes, thread.passes.unwrap_or(cut.passes.len() as f64));
    want.set(VarId::Chams, thread.chamfer.unwrap_or(0.0));
    want.set(VarId::Tipang, angle);
    want.set(VarId::Startang, angle / 2.0);
}

/// Checks that the cycle's words, or its packed parameters, print everything that the thread requests.
fn check_thread_words(thread: &Thread, cut: &Cut, routine: &Routine, shape: &Shape, want: &Want) -> Done {
    let packed = packed_parameters(routine, shape, want);
    let in_packed = |digits: std::ops::Range<usize>, value: f64| {
        packed.as_deref().and_then(|text| text.get(digits)?.parse().ok()) == Some(value)
    };
    let prints = |vars: &[VarId]| vars.iter().any(|&var| routine.vars.has(var));
    let starts = thread.starts.unwrap_or(1.0);
    let auto = shape.program.routine(SequenceId::AutoThread).is_some();
    let missing = [
        (cut.slope != 0.0 && !prints(&[VarId::Taper]), "the taper: [taper]"),
        (starts > 1.0 && !prints(&[VarId::Frate]), "the lead of several starts: [frate]"),
        (!prints(&[VarId::Frate, VarId::Pitch]), "the lead: [frate]"),
        (auto && thread.min_depth.is_some() && !prints(&[VarId::Vbite]), "the least cut: [vbite]"),
        (
            auto && thread.first_depth.is_some() && !prints(&[VarId::Peck1, VarId::Inidep, VarId::Passes]),
            "the first cut: [peck1]",
        ),
        (
            thread.angle.is_some_and(|angle| !in_packed(4..6, angle)) && !prints(&[VarId::Tipang, VarId::Startang]),
            "the angle of the tip: [tipang]",
        ),
        (
            thread.chamfer.is_some_and(|length| !in_packed(2..4, length)) && !prints(&[VarId::Chams]),
            "the chamfer: [chams]",
        ),
    ];
    match missing.iter().find(|(lost, _)| *lost) {
        None => Ok(()),
        Some((_, what)) => {
            let message = format!("the thread cycle does not print {what}");
            let help = "add the word, or give the value in the packed parameters: `--set tparams=010029` is 1 \
                finishing pass, no chamfer, 29 degrees";
            fault_at(Code::PR017, message, help, Some(routine.span))
        }
    }
}

/// The digits of a packed `[tparams]` word: finishing passes, chamfer and angle, with two digits each.
fn packed_parameters(routine: &Routine, shape: &Shape, want: &Want) -> Option<String> {
    let letter = routine.steps().find_map(|i| match shape.program.ops[i] {
        Op::Var { letter, var: VarId::Tparams, .. } => Some(letter),
        _ => None,
    })?;
    match want.get(VarId::Tparams) {
        Some(set) => Some(format!("{set:06}")),
        None => shape.letters.packed.iter().find(|(packed, _)| *packed == letter).map(|(_, digits)| digits.clone()),
    }
}

/// Sets the position variables to the end of a pass.
fn pass_variables(cut: &Cut, depth: f64, shape: &Shape, want: &mut Want, said: &mut Said) -> Done<Axes> {
    let mut end = said.stand.position;
    end.set(0, cut.end);
    end.set(1, cut.crest + cut.inward * depth);
    set_targets(&end, shape, want, said)?;
    Ok(end)
}

/// Prints the sequence CanThread: its first lines once, and its other lines for every pass.
fn canned_passes(routine: &Routine, cut: &Cut, cx: &mut Cx<'_>) -> Done {
    let shape = cx.shape;
    upons(routine.vars, cx)?;
    for (i, &depth) in cut.passes.iter().enumerate() {
        pass_variables(cut, depth, shape, cx.want, cx.said)?;
        cx.said.forget_letters();
        if i == 0 {
            run_part(routine, routine.ops.start..routine.repeat, Mode::All, &mut cx.writer())?;
        }
        let rest = routine.repeat..routine.ops.end;
        match i {
            0 => go_on(routine, rest, Mode::Hole, &mut cx.writer())?,
            _ => run_part(routine, rest, Mode::Hole, &mut cx.writer())?,
        }
    }
    Ok(())
}

/// Prints passes with the code of the `Thread` command.
fn own_passes(cut: &Cut, here: &Axes, cx: &mut Cx<'_>) -> Done {
    let shape = cx.shape;
    let program = shape.program;
    let Some(code) = &program.settings.thread else {
        let help = "add AutoThread, CanThread or the line `Thread G33` to the form";
        return fault(Code::PR008, "the form can't print a thread", help);
    };
    for (i, &depth) in cut.passes.iter().enumerate() {
        let end = pass_variables(cut, depth, shape, cx.want, cx.said)?;
        if program.settings.thread_full {
            let mut start = *here;
            start.set(1, end.values[1] + cut.taper(here.values[0]) * shape.scales[1].signum());
            rapid_to(&start, cx)?;
        }
        if i == 0 || program.settings.thread_full {
            thread_block(code, (here, &end), cut, &mut cx.writer())?;
        } else {
            axis_word(1, &end, shape, cx.said, cx.out)?;
            cx.out.end_block();
        }
        cx.said.stand.position = end;
        if program.settings.thread_full {
            cx.said.say_motion_again();
            let mut clear = end;
            clear.values[1] = here.values[1];
            rapid_to(&clear, cx)?;
            rapid_to(here, cx)?;
        }
    }
    Ok(())
}

/// Prints the block of a pass: code, radius, length, taper, lead.
fn thread_block(code: &sema::Code, (here, end): (&Axes, &Axes), cut: &Cut, writer: &mut Writer<'_>) -> Done {
    let shape = writer.shape;
    code_word(code, writer)?;
    axis_word(1, end, shape, writer.said, writer.out)?;
    axis_word(0, end, shape, writer.said, writer.out)?;
    letter_word(b'I', cut.taper(here.values[0]), shape, writer.said, writer.out)?;
    letter_word(shape.program.settings.feed_code, cut.lead, shape, writer.said, writer.out)?;
    writer.out.end_block();
    Ok(())
}
