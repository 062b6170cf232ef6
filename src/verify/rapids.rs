//! Compares the paths between cuts. The program's path may be higher than the job's path, but not lower, and may not go
//! to other positions.

use super::arrival::arrives_at_depth;
use super::beside::{Compensated, Mark};
use super::cut::{ACROSS, ALL, DEPTH, Place, RADIUS, Rapid, is_length, number, same, shown};
use super::idle;
use super::in_order::InOrder;
use super::modal::{TOOL_LENGTH, WITHOUT};
use super::passage::{Entry, Frame, Leg, Passage};
use super::rapid_path::{turn_alike, turned_low};
use super::sides::Sides;
use super::tails::leaves_low;
use super::ways::{Compared, Low, are_the_same, compare as compare_way, enters_hole, leaves_hole};
use crate::diag::Code;
use crate::lang::Machine;

/// Whether job and program make the same rapids to a cut, one by one, from the same known start.
pub(super) fn same_rapids(s: &Sides<'_>) -> bool {
    let tolerance = s.limits.tolerance;
    let (Some(a), Some(b)) = (s.job.start, s.program.passage.start) else { return false };
    let (own, other) = (&s.job.rapids, &s.program.passage.rapids);
    are_the_same(&[a], &[b], tolerance)
        && are_the_same(own, other, tolerance)
        && own.first().zip(other.first()).is_none_or(|(to, is)| turn_alike(&[a, *to], &[b, *is]))
}

/// Compares the cutter compensations with which the rapids are made. The compensation moves the tool beside its
/// programmed path also where it does not cut.
fn compensated(s: &mut Sides<'_>, line: u64) {
    let is =
        |(a, b): (&Compensated, &Compensated)| a.side == b.side && a.register.is_none_or(|_| a.register == b.register);
    let program = &s.program.passage.compensated[..];
    let alike = |job: &[Compensated]| job.len() == program.len() && job.iter().zip(program).all(is);
    // where the job has no rapid, the form may add rapids with the compensation that is on
    let job = if s.job.rapids.is_empty() { s.job.side.as_slice() } else { &s.job.compensated };
    if alike(job) || s.job.rapids.is_empty() && program.is_empty() {
        return;
    }
    let text = |list: &[Compensated]| {
        let one =
            |on: &Compensated| on.register.map_or(on.side.name().to_owned(), |d| format!("{} D{d}", on.side.name()));
        if list.is_empty() { "off".to_owned() } else { list.iter().map(one).collect::<Vec<_>>().join(" and ") }
    };
    let (job, program) = (text(job), text(program));
    s.found(Code::PV018, line, "print G41, G42 and G40 only in InFeed and OutFeed", || {
        format!("during the rapids here, the cutter compensation is {program}, but {job} in the job")
    });
}

/// Compares the paths of job and program to the next cut. `goes_down`: whether the job's cut ends below its beginning.
pub(super) fn compare(s: &mut Sides<'_>, goes_down: bool, line: u64) {
    let tolerance = s.limits.tolerance;
    if s.program.passage.rapids.is_empty() && s.job.rapids.is_empty() && !s.job.changed() {
        return;
    }
    compensated(s, line);
    moved_with(s, line);
    goes_home(s, line);
    loads_again(s);
    if let Some(rule) = InOrder::of(s.machine) {
        return beside_the_part(s, rule, line);
    }
    let (lost, changed) = (s.job.changed(), s.program.passage.changed());
    // fast path: most paths are equal, so their corners need no comparison
    if !(lost || changed) && same_rapids(s) {
        return;
    }
    if lost {
        let leaving = if changed { s.program.passage.leaving().len() } else { 0 };
        leave(s, leaving, line);
    }
    if changed {
        between(s, line, false);
    }
    if lost {
        s.report.allowed.idle += idle::otherwise(&s.job, &s.program.passage, false, s.tools, tolerance);
    }
    let [job, program] = &mut s.ways;
    let passage = &s.program.passage;
    // after a change of tool or work offset, the path may begin anywhere
    let both = lost && changed;
    let known = !lost && passage.start.is_some_and(|start| start.unknown == 0);
    let mut compared = |own: &[Rapid]| {
        job.set(if lost { None } else { s.job.start }, own, tolerance);
        program.set(
            if both { None } else { passage.start },
            if both { passage.arriving() } else { &passage.rapids },
            tolerance,
        );
        compare_way(job, program, known, tolerance)
    };
    let is_good = |way: &Compared| !matches!(way, Compared::Lower(_) | Compared::Elsewhere(_));
    let mut way = compared(s.job.arriving());
    if !is_good(&way)
        && let Some(own) = s.job.arriving_by_first()
    {
        way = Some(compared(&own)).filter(is_good).unwrap_or(way);
    }
    let arrives = both && !goes_down && is_good(&way);
    if arrives && let Some(to) = arrives_at_depth(&job.corners, &program.corners, tolerance) {
        s.found(Code::PV009, line, "print X and Y before the height", || {
            format!("a rapid across goes to {}, at the depth of the next cut", to.text())
        });
        return;
    }
    match way {
        Compared::Same => {}
        Compared::AsGood { step_by_step } if step_by_step || !s.job.aside => {
            s.report.allowed.ways += u64::from(known);
        }
        Compared::AsGood { .. }
            if leaves_hole(job, program, tolerance).is_none()
                && s.hole.over.is_none_or(|over| enters_hole(job, program, &over.at, tolerance)) =>
        {
            s.report.allowed.ways += u64::from(known);
        }
        Compared::AsGood { .. } => stays_at_wall(s, line),
        Compared::Turning => turns_otherwise(s, line),
        Compared::Turned(to, axes) => turns_part_otherwise(s, &to, axes, line),
        Compared::Lower(low) => {
            let help = "print the height before the position, or return to [rplane]";
            s.found(Code::PV009, line, help, || low.message());
        }
        Compared::Elsewhere(to) => {
            s.found(Code::PV001, line, "check the words that the form prints for the rapids here", || {
                format!("a rapid goes to {}, but the job does not go to this position", to.text())
            });
        }
    }
}

fn stays_at_wall(s: &mut Sides<'_>, line: u64) {
    s.found(Code::PV001, line, "print the cycle's orientation and shift, as G76 Q[sleave]", || {
        "in the job the tool moves off the wall of the hole, but the program does not make this move".to_owned()
    });
}

fn turns_otherwise(s: &mut Sides<'_>, line: u64) {
    s.found(Code::PV011, line, "check the spindle codes of the cycle", || {
        "while the tool retracts, the spindle does not turn, or does not stop at an angle, as in the job".to_owned()
    });
}

/// Reports a rapid before the retract that turns the part otherwise than the job.
fn turns_part_otherwise(s: &mut Sides<'_>, to: &Place, axes: u8, line: u64) {
    let help = "retract before the part turns, or check the travel of the rotary axis (`Limits`)";
    s.found(Code::PV001, line, help, || {
        format!(
            "before the tool is retracted, a rapid to {} turns the part in another direction than in the job, or by \
             more turns",
            shown(to, 0b111 | axes)
        )
    });
}

/// Whether the program still moves in the coordinate frame of its last cut, and with the length register of that cut.
pub(super) fn moves_as_before(s: &Sides<'_>) -> bool {
    let (frame, length) = (s.frame_before(), s.before.length);
    frame.tool.is_some()
        && s.program.passage.legs().all(|(leg, _)| leg.frame == frame && leg.lengths.iter().all(|own| *own == length))
}

/// Checks the coordinate frames of a path. Each move must be in a frame of the job, with the offset registers of that
/// frame.
pub(super) fn moved_with(s: &mut Sides<'_>, line: u64) {
    let tools = s.tools;
    let passage = &s.program.passage;
    if moves_as_before(s) {
        return;
    }
    let before = (s.frame_before(), s.before.length);
    let is_frame =
        |a: &Frame, b: &Frame| a.work.is_none_or(|work| Some(work) == b.work) && (!tools || a.tool == b.tool);
    let mut wrong = None;
    let count = s.job.legs().count();
    // before a cut of a mill, rapids across at an unknown height are checked too; only frames with rapids of the job are allowed
    let by_rapids = s.machine == Machine::Mill && !s.switches && line != 0;
    let moves = |at: usize, leg: &Leg, rapids: &[Rapid]| {
        !leg.lengths.is_empty() || by_rapids && at > 0 && rapids.iter().any(|rapid| rapid.unknown & 0b11 != 0b11)
    };
    let is_own = |at: usize, rapids: &[Rapid]| !by_rapids || at == 0 || at + 1 == count || !rapids.is_empty();
    for (at, (leg, rapids)) in passage.legs().enumerate() {
        if !moves(at, leg, rapids) {
            continue;
        }
        let was = is_frame(&before.0, &leg.frame) && before.0.tool.is_some();
        let own = s
            .job
            .legs()
            .enumerate()
            .filter(|(at, (own, rapids))| is_frame(&own.frame, &leg.frame) && is_own(*at, rapids));
        let known: Vec<Option<f64>> = own
            .flat_map(|(_, (own, _))| match own.lengths.is_empty() {
                // if the frame has the tool of the last cut, the length register of that cut is still active
                true if was => vec![before.1],
                true => vec![None],
                false => own.lengths.clone(),
            })
            .collect();
        if known.is_empty() && !was {
            let mut tools = s
                .job
                .legs()
                .map(|(own, _)| own.frame)
                .filter(|own| tools && own.work == leg.frame.work && own.tool != leg.frame.tool);
            wrong = Some((leg.frame, tools.next_back().map_or(Astray::Frame, |own| Astray::Tool(own.tool))));
            break;
        }
        let allowed = |length: &Option<f64>| {
            (was && *length == before.1) || known.iter().any(|known| known.is_none() || is_length(*known, *length))
        };
        if let Some(length) = leg.lengths.iter().find(|length| !allowed(length)).filter(|_| tools) {
            wrong = Some((leg.frame, Astray::Length { is: *length, wanted: known.first().copied().flatten() }));
            break;
        }
    }
    if let Some((frame, astray)) = wrong {
        moves_astray(s, frame, astray, line);
    }
}

/// How the frame of a path differs from the job's frames.
enum Astray {
    /// The job moves in this work offset with this tool.
    Tool(Option<f64>),
    /// The job does not move in this work offset.
    Frame,
    /// The length register differs. `wanted`: the register of the job in this frame, if the job moves in this frame.
    Length { is: Option<f64>, wanted: Option<f64> },
}

/// Reports a path in a frame in which the job does not move.
fn moves_astray(s: &mut Sides<'_>, frame: Frame, astray: Astray, line: u64) {
    let way = if line == 0 { "after the last cut" } else { "before this cut" };
    let work = frame.work.map_or("no work offset".to_owned(), |work| format!("work offset {}", number(work)));
    let tool = frame.tool.filter(|_| s.tools).map(|tool| format!("tool {}", s.program.tool_text(tool)));
    let moving = tool.as_deref().unwrap_or("the tool");
    let (code, help, message) = match astray {
        Astray::Tool(Some(wanted)) => {
            let tool = tool.as_deref().unwrap_or("no tool");
            let message =
                format!("{way} {tool} is loaded for moves in {work}, but the job has tool {} there", number(wanted));
            (Code::PV012, "print T[tool] M6 in the tool change", message)
        }
        Astray::Tool(None) | Astray::Frame => {
            let help = "print the offsets before the first move to a height";
            (Code::PV012, help, format!("{way} {moving} moves in {work}, but the job has no move there"))
        }
        Astray::Length { is, wanted } => {
            let is = is.map_or("no length register".to_owned(), |h| format!("H{}", number(h)));
            let (help, job) = match wanted {
                Some(0.0) => (WITHOUT, "the length is off in the job".to_owned()),
                Some(h) => (TOOL_LENGTH, format!("the job has H{} there", number(h))),
                None => (TOOL_LENGTH, "not in the job".to_owned()),
            };
            (Code::PV014, help, format!("{way} the tool moves in {work} with {is}, but {job}"))
        }
    };
    s.found(code, line, help, || message.clone());
}

/// The axes to check for a move home, as bits. At least one of these axes must go home.
pub(super) fn away(machine: Machine) -> u8 {
    match machine {
        Machine::Mill => 1 << DEPTH,
        Machine::Lathe => 1 << RADIUS,
        Machine::Edm => 0b11, // a wire has no other axes
    }
}

/// Checks that the program goes home where the job goes home. At the home position, a new leg of both paths begins.
fn goes_home(s: &mut Sides<'_>, line: u64) {
    let away = away(s.machine);
    if s.job.was_sent_home() && !s.program.passage.splits_at_home(away) {
        s.found(Code::PV001, line, "print the control's code for a move home in MoveHome, as `G28 G91 Z0.`", || {
            "the job sends the tool home here, but the program does not".to_owned()
        });
    }
}

/// Where the job changes to the tool that is in the spindle, a new leg of both paths begins.
fn loads_again(s: &mut Sides<'_>) {
    let count = s.job.reloads();
    let marks: Vec<Mark<()>> = s.program.passage.reloads.iter().take(count).copied().collect();
    for mark in marks.iter().rev() {
        s.program.passage.split(mark);
    }
}

/// The first position that has a known height and is not straight above or below `from`.
fn crosses(from: Option<&Rapid>, rapids: &[Rapid], tolerance: f64) -> Option<Place> {
    let from = from?;
    let beside = |rapid: &&Rapid| rapid.unknown & 0b111 == 0 && !same(&rapid.to, &from.to, ACROSS, tolerance);
    rapids.iter().take_while(|rapid| rapid.unknown & 1 << DEPTH == 0).find(beside).map(|rapid| rapid.to)
}

/// Checks the path after the last cut of a tool, of a work offset or of the program. `until`: how many of the program's
/// rapids belong to this path.
fn leave(s: &mut Sides<'_>, until: usize, line: u64) -> bool {
    let tolerance = s.limits.tolerance;
    let [job, program] = &mut s.ways;
    if s.job.start.is_none() {
        return true; // nothing was cut before
    }
    let aside = if s.job.changed() { s.job.left_aside } else { s.job.aside };
    let (own, other) = (s.job.leaving(), &s.program.passage.rapids[..until]);
    let as_job = goes_as(own, other, tolerance);
    // after the job's last position before home, the program may only go straight up or down before the move home
    let beyond =
        other.split_at_checked(own.len()).filter(|(way, _)| s.job.was_sent_home() && goes_as(own, way, tolerance));
    let before_home = beyond.and_then(|(_, beyond)| crosses(own.last().or(s.job.start.as_ref()), beyond, tolerance));
    job.set(s.job.start, own, tolerance);
    program.set(s.program.passage.start, other, tolerance);
    let turned = turned_low(&job.corners, &program.corners, tolerance);
    let low_entry = low_entry(&s.job, &s.program.passage, tolerance);
    match leaves_hole(job, program, tolerance) {
        Some(Compared::Turning) => turns_otherwise(s, line),
        Some(_) if aside => stays_at_wall(s, line),
        _ if low_entry.is_some() => enters_low(s, low_entry, line),
        // the job's own path, and then only rapids to a machine height
        _ if as_job && turned.is_none() && other[own.len()..].iter().all(|rapid| rapid.unknown & 1 << DEPTH != 0) => {}
        _ => {
            if let Some((to, axes)) = turned {
                turns_part_otherwise(s, &to, axes, line);
            } else if let Some(to) = before_home {
                s.found(Code::PV001, line, "print the move home before the next position", || {
                    format!("a rapid goes to {} before the tool goes home", shown(&to, 0b111))
                });
            } else if let Some((to, limit)) = leaves_low(job, program, tolerance) {
                s.found(Code::PV009, line, "retract first, as high as in the job", || {
                    format!("after the last cut a rapid goes to {}, not above Z{}", shown(&to, 0b111), number(limit))
                });
            }
        }
    }
    as_job
}

/// The program's first move across in another work offset at a height that is too low: lower than the job when it
/// changes the offset, or still at the end of the cut although the job leaves this height. Heights are compared only in
/// the same work offset.
fn low_entry(job: &Passage, program: &Passage, tolerance: f64) -> Option<(Entry, f64)> {
    let end = Entry { work: None, height: job.last_height(), first: None };
    let own = job.entries().chain((!job.changed()).then_some(end));
    program.entries().zip(own).filter(|(made, _)| made.crosses()).find_map(|(made, own)| {
        let (is, wanted) = (made.height?, own.height?);
        // the heights before and after the change are not compared, because their zero points differ
        let leaves = is.in_cut && made.keeps_height() && own.first.is_some_and(|first| first.unknown & 1 << DEPTH == 0);
        let is_lower = is.height < wanted.height - tolerance && wanted.height.is_finite();
        let is_same = wanted.work.is_none() || is.work == wanted.work;
        (is_same && (leaves || is_lower)).then_some((made, wanted.height))
    })
}

/// Reports a move across in another work offset that is too low.
fn enters_low(s: &mut Sides<'_>, entry: Option<(Entry, f64)>, line: u64) {
    let Some((Entry { work, height: Some(is), .. }, limit)) = entry else { return };
    let work = work.map_or("another work offset".to_owned(), |work| format!("work offset {}", number(work)));
    s.found(Code::PV009, line, "retract before the change of the work offset, as high as in the job", || {
        let [is_at, limit] = [is.height, limit].map(number);
        let than =
            if is_at < limit { format!("below the job's Z{limit}") } else { "the depth of the last cut".to_owned() };
        format!("the first rapid in {work} crosses at Z{is_at} of the offset before, which is {than}")
    });
}

/// Whether the program goes to exactly the job's positions. Positions after the first one that is known only at the
/// machine are not compared.
fn goes_as(job: &[Rapid], program: &[Rapid], tolerance: f64) -> bool {
    let known = program.iter().take_while(|rapid| rapid.unknown == 0);
    let count = known.clone().count();
    count == job.len() && known.zip(job).all(|(a, b)| same(&a.to, &b.to, ALL, tolerance))
}

/// Checks the frames between the first and the last frame; with `at_end`, all frames after the first. In each frame, no
/// rapid may be lower than the job's rapids in that frame.
fn between(s: &mut Sides<'_>, line: u64, at_end: bool) {
    let tolerance = s.limits.tolerance;
    let tools = s.tools;
    let legs: Vec<_> = s.program.passage.legs().collect();
    // the path after the last cut is compared by `leave`
    let first = usize::from(s.job.start.is_some());
    let inner = legs.get(first..legs.len() - usize::from(!at_end)).unwrap_or_default();
    let mut low = None;
    for (leg, rapids) in inner.iter().filter(|(leg, _)| !leg.lengths.is_empty()) {
        let same_frame = |frame: &Frame| frame.work == leg.frame.work && (!tools || frame.tool == leg.frame.tool);
        let own_legs: Vec<_> =
            s.job.legs().filter(|(own, rapids)| same_frame(&own.frame) && !rapids.is_empty()).collect();
        let own: Vec<&[Rapid]> = own_legs.iter().map(|(_, rapids)| *rapids).collect();
        if own.is_empty() {
            // the job has no move with this tool in this work offset, so no height is allowed
            let known = rapids.iter().find(|rapid| rapid.unknown & 0b100 == 0);
            low = low.or(known.map(|rapid| (rapid.to, leg.frame.work)));
            continue;
        }
        let all = own.concat();
        let by_first: Vec<_> = own_legs.iter().filter_map(|(leg, rapids)| leg.by_first(rapids)).collect();
        let [job, program] = &mut s.ways;
        let mut lower = None;
        let others = [all.as_slice()].into_iter().chain(by_first.iter().map(Vec::as_slice));
        let as_good = own.iter().copied().chain(others).any(|own| {
            job.set(None, own, tolerance);
            program.set(None, rapids, tolerance);
            match compare_way(job, program, false, tolerance) {
                Compared::Lower(Low { to: Rapid { to, .. }, .. }) | Compared::Elsewhere(Rapid { to, .. }) => {
                    lower = lower.or(Some(to));
                    false
                }
                _ => true,
            }
        });
        if !as_good {
            low = low.or(lower.map(|to| (to, leg.frame.work)));
        }
    }
    let Some((to, work)) = low else { return };
    let work = work.map_or(String::new(), |work| format!(" in work offset {}", number(work)));
    s.found(Code::PV009, line, "print the height before the position, or return to [rplane]", || {
        format!("a rapid goes to {}{work}, which is below the job's rapids there", shown(&to, 0b111))
    });
}

/// Compares the path from the last cut to the end of the program.
pub(super) fn end(s: &mut Sides<'_>) {
    compensated(s, 0);
    moved_with(s, 0);
    goes_home(s, 0);
    loads_again(s);
    if let Some(rule) = InOrder::of(s.machine) {
        return beside_the_part(s, rule, 0);
    }
    let passage = &s.program.passage;
    let changed = passage.changed();
    let until = if s.job.changed() && changed { passage.leaving().len() } else { passage.rapids.len() };
    if changed || s.job.start.is_none() {
        between(s, 0, true);
    }
    let as_job = leave(s, until, 0);
    let idle = idle::otherwise(&s.job, &s.program.passage, true, s.tools, s.limits.tolerance);
    s.report.allowed.tails += u64::from(!as_job || idle > 0);
}

/// Compares paths on lathes and wire EDM machines, where the part or the wire may be on any side. The tool must go to
/// the job's positions in their order, and may go to machine positions. On a lathe, a slanted rapid may be replaced by
/// two rapids on the side away from the chuck. If the job gives only one axis first after the tool was home, the program
/// must move this axis first.
fn beside_the_part(s: &mut Sides<'_>, rule: InOrder, line: u64) {
    let tolerance = s.limits.tolerance;
    let starts = [s.job.start, s.program.passage.start];
    let both_known = starts.iter().all(|start| start.is_some_and(|start| start.unknown == 0));
    let [from, begun] = starts.map(|start| start.filter(|_| both_known));
    let [wanted, is] = match rule.follows(&s.job.path(from), &s.program.passage.path(begun), tolerance) {
        Ok(rounds) => {
            s.report.allowed.ways += rounds;
            return;
        }
        Err(corners) => *corners,
    };
    let shown = |corner: Option<Rapid>| corner.map_or("nowhere".to_owned(), |corner| rule.shown(&corner));
    s.found(Code::PV001, line, "check the words that the form prints for the rapids here", || {
        format!("a rapid goes to {}, but the job's rapid goes to {}", shown(is), shown(wanted))
    });
}
