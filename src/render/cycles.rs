//! Canned cycles: which sequence serves a cycle, when it begins and ends.

use super::fault::{Done, fault};
use super::numbers::quantised;
use super::options::Cycles;
use super::renderer::Renderer;
use super::vars::Vars;
use crate::compile::{CycleStyle, Routine};
use crate::control::Group;
use crate::cycle::{Plan, check};
use crate::diag::Code;
use crate::lang::{Machine, SequenceId, VarId};
use crate::sema::kind_of_remark;
use crate::toolpath::{Axes, CycleKind, CycleSpec, Hole, Peck, Place, SpindleTurn};

/// A cycle between its begin and its end.
pub(super) struct ActiveCycle {
    /// In program units.
    pub spec: CycleSpec,
    /// What prints it: a sequence, or moves.
    pub sequence: Option<SequenceId>,
    /// Holes so far.
    pub holes: u64,
    /// The control is in the cycle: it needs its Cancel.
    pub in_force: bool,
    /// Values at the last start, for advanced cycles.
    pub setup: Vars,
    /// The last hole: where, and the height at which the tool left it.
    pub last: Option<Axes>,
    /// The exit height is certain.
    pub exit_known: bool,
    /// Depth position of the last point.
    pub point: Option<f64>,
    /// Return plane of the first point.
    pub return_plane: Option<f64>,
    /// Where the control returns to: the tool's height when the cycle was started.
    pub initial_level: f64,
    /// A hole that waits: only the next event tells whether it is the last.
    pub held: Option<(Hole, Place)>,
    /// The feed that comes back after the cycle.
    pub feed: Option<f64>,
    /// The height at which the job leaves the last hole.
    pub left: Option<f64>,
    /// The spindle's direction that comes back after a tap that turned it.
    pub turned: Option<f64>,
}

impl Renderer<'_> {
    /// A cycle begins; nothing is printed before its first hole.
    pub(super) fn cycle_begin(&mut self, spec: &CycleSpec) -> Done {
        self.close_cycle()?;
        self.left = None; // its holes come by rapids
        if self.shape.program.settings.machine == Machine::Edm {
            return fault(Code::PR008, "a wire EDM machine has no canned cycles", "take the cycle out of the job");
        }
        if self.compensated {
            let message = "cutter compensation is on, and no control allows a cycle then";
            return fault(Code::PC041, message, "end the compensation with an `outfeed` before the cycle");
        }
        if self.inverse_time() {
            let message = "a canned cycle in an operation whose feeds are inverse time";
            return fault(Code::PR006, message, "give the holes an operation of their own with feeds per minute");
        }
        check(spec)?;
        let spec = self.scaled(spec);
        let sequence = self.choose(&spec)?;
        self.warn_of(&spec, sequence);
        let turned = self.turn_for_tap(&spec)?;
        self.cycle = Some(ActiveCycle {
            spec,
            sequence,
            holes: 0,
            in_force: false,
            setup: Vars::default(),
            last: None,
            exit_known: false,
            point: None,
            return_plane: None,
            initial_level: 0.0,
            held: None,
            feed: self.feed,
            left: None,
            turned,
        });
        Ok(())
    }

    /// What a cycle leaves out or contradicts, without being wrong.
    fn warn_of(&mut self, spec: &CycleSpec, sequence: Option<SequenceId>) {
        let pecks = matches!(spec.kind, CycleKind::Deep | CycleKind::Chipbreak);
        if pecks && spec.step.or(self.shape.defaults.step).is_none() && spec.pecks.is_empty() {
            let message = format!("`{}` has no step and goes down in one peck", spec.kind.name());
            self.out.note(Code::PC060, message, "give the cycle a `step`, or the form a `CycleStep`");
        }
        let clear = spec.clear.unwrap_or(self.shape.defaults.clear);
        if let Some(height) = spec.return_height.filter(|&height| height < clear) {
            let message = format!("the return plane, {height} above the point, is below the clearance, {clear}");
            self.out.note(Code::PC053, message, "the clearance is used: give `return` above `clear`, or leave it out");
        }
        let [cw, ccw, _] = self.shape.program.settings.spindle;
        let needed = if spec.kind == CycleKind::LTap { ccw } else { cw };
        if spec.kind.is_tap()
            && self.vars.get(VarId::Direct).is_some_and(|code| code != needed && [cw, ccw].contains(&code))
        {
            let (name, turns) = (spec.kind.name(), cw + ccw - needed);
            let message = format!("a `{name}` with the spindle in M{turns}: it is turned for the tap");
            self.out.note(Code::PC054, message, "say the direction of the spindle in the job, or take the other tap");
        }
        if spec.back.is_some()
            && sequence
                .and_then(|id| self.shape.program.routine(id))
                .is_some_and(|routine| !routine.vars.has(VarId::Sclear) && !routine.vars.has(VarId::Vleave))
        {
            let message = "the distance that pecks go back, `back`, is the control's own setting here";
            self.out.note(Code::PR021, message.into(), "set it at the control, or print [vleave] in the cycle");
        }
        let printed = sequence
            .and_then(|id| self.shape.program.routine(id))
            .is_some_and(|routine| routine.vars.has(VarId::Vbite));
        if spec.kind.is_tap() && spec.mode.is_none() && spec.step.is_some() && !printed {
            let message = "`step` without effect: this tap goes down in one";
            self.out.note(Code::PC061, message.into(), "say how it pecks with `mode`, or take `step` out");
        }
        if spec.ratio.is_some() && (spec.norevr || spec.rapout) {
            let message = "`ratio` without effect: this tap does not feed out";
            self.out.note(Code::PC057, message.into(), "take `ratio` out");
        }
        if self.shape.options.sink_as_printed
            && spec.kind == CycleKind::Csink
            && spec.angle.is_some_and(|angle| angle > 90.0)
        {
            let message = "the printed formula makes this countersink too deep";
            self.out.note(Code::PC059, message.into(), "render without `--csink-depth printed`");
        }
        if spec.min_step.is_some() && spec.decr.is_none() && self.shape.program.settings.cycle_min_step == 0.0 {
            let message = "`min_step` without effect: the steps do not shrink";
            self.out.note(Code::PC055, message.into(), "take it out, or give `decr`");
        }
        if let (Some(mode), true) = (spec.mode, sequence.is_some()) {
            let message = format!("how the tap pecks, here `{}`, is the control's own setting", mode.name());
            self.out.note(Code::PR021, message, "set the control to it: no word of a form says which");
        }
    }

    /// A tap goes in turning its own way: a floating one needs the spindle to, with a rigid one the control turns it.
    /// The direction that comes back after the cycle, if it is another.
    fn turn_for_tap(&mut self, spec: &CycleSpec) -> Done<Option<f64>> {
        let [cw, ccw, off] = self.shape.program.settings.spindle;
        let inwards = match spec.kind.inwards() {
            Some(SpindleTurn::Ccw) => ccw,
            Some(_) => cw,
            None => return Ok(None),
        };
        let (rigid, before) = (self.is_rigid(spec), self.vars.get(VarId::Direct));
        if before == Some(off) && !rigid {
            self.turning(before)?;
        }
        if before.is_none_or(|code| code == inwards || ![cw, ccw].contains(&code)) {
            return Ok(None);
        }
        if !rigid && self.shape.program.switches_spindle {
            let message = "the tap goes in turning the other way, and the form's own sequences turn the spindle";
            return fault(Code::PR006, message, "say the direction of the spindle in the job, or take the other tap");
        }
        self.vars.set(VarId::Direct, inwards);
        if rigid {
            self.served.direct = Some(inwards);
        }
        self.attention = true;
        Ok(before)
    }

    /// A rigid tap keeps step with the spindle, in and out. One that does not reverse is made as a face or drill.
    pub(super) fn is_rigid(&self, spec: &CycleSpec) -> bool {
        let reverses = spec.kind.is_tap() && !spec.norevr && !spec.rapout;
        reverses && spec.rigid.unwrap_or(self.shape.program.settings.rigid_tap)
    }

    /// The cycle ends.
    pub(super) fn cycle_end(&mut self) -> Done {
        self.close_cycle()
    }

    /// Ends the open cycle, if any: the hole that waits, Cancel, and what is known afterwards.
    pub(super) fn close_cycle(&mut self) -> Done {
        let Some(cycle) = &mut self.cycle else { return Ok(()) };
        if let Some((hole, place)) = cycle.held.take() {
            let now = std::mem::replace(&mut self.out.place, place);
            self.vars.set(VarId::Lasthole, 1.0);
            self.make_hole(&hole)?;
            self.vars.set(VarId::Lasthole, 0.0);
            self.out.place = now;
        }
        self.leave_cycle()?;
        let Some(cycle) = self.cycle.take() else { return Ok(()) };
        let stands = self.position.get(self.shape.depth);
        let as_left = |height: f64| cycle.exit_known && stands.is_some_and(|at| (at - height).abs() < 1e-9);
        self.left = cycle.left.filter(|&height| !as_left(height)).map(|height| (self.position, height));
        self.keep_feed(cycle.feed);
        if let Some(direct) = cycle.turned {
            self.vars.set(VarId::Direct, direct);
            self.attention = true;
        }
        self.vars.put(VarId::Dwell, None);
        Ok(())
    }

    /// The control leaves the cycle: Cancel, and what is known of the axes after the last hole.
    pub(super) fn leave_cycle(&mut self) -> Done {
        self.cancel()?;
        let Some((last, exit_known)) = self.cycle.as_ref().and_then(|cycle| Some((cycle.last?, cycle.exit_known)))
        else {
            return Ok(());
        };
        self.position = last;
        self.set_targets(&last)?;
        self.registers.forget_letters();
        self.registers.forget_group(Group::Motion);
        let known = if exit_known { 0b111 } else { 0b111 & !self.shape.depth_bit() };
        for axis in 0..3 {
            if known & last.given & 1 << axis != 0 {
                let info = &self.shape.letters[self.shape.axes[axis]];
                let units = quantised(info, last.values[axis] * self.shape.scales[axis])?;
                self.registers.set(info.printed, units, info.format.dec.count);
            }
        }
        if !exit_known {
            self.displaced(self.shape.depth_bit()); // an increment must know from where
        }
        Ok(())
    }

    /// Prints the Cancel sequence if the control is in the cycle.
    pub(super) fn cancel(&mut self) -> Done {
        let program = self.shape.program;
        let Some(cycle) = &mut self.cycle else { return Ok(()) };
        let cancels = cycle.sequence.and_then(|id| program.routine(id)).is_some_and(|routine| routine.cancel);
        if std::mem::take(&mut cycle.in_force)
            && cancels
            && let Some(routine) = program.routine(SequenceId::Cancel)
        {
            self.run_with_upons(routine)?;
            self.registers.forget_group(Group::Motion);
        }
        Ok(())
    }

    /// The same cycle in program units.
    pub(super) fn scaled(&self, spec: &CycleSpec) -> CycleSpec {
        let scale = self.shape.scale;
        let length = |value: Option<f64>| value.map(|v| v * scale);
        CycleSpec {
            depth: length(spec.depth),
            clear: length(spec.clear),
            return_height: length(spec.return_height),
            feed: length(spec.feed),
            plunge: length(spec.plunge),
            step: length(spec.step),
            first_step: length(spec.first_step),
            back: length(spec.back),
            rapto: length(spec.rapto),
            offset: length(spec.offset),
            offset_y: length(spec.offset_y),
            decr: length(spec.decr),
            min_step: length(spec.min_step),
            diameter: length(spec.diameter),
            hole_diameter: length(spec.hole_diameter),
            webs: spec.webs.iter().map(|w| w * scale).collect(),
            pecks: spec.pecks.iter().map(|p| Peck { to: p.to * scale, feed: p.feed.map(|f| f * scale) }).collect(),
            jog: length(spec.jog),
            ..spec.clone()
        }
    }

    /// The sequence that prints a cycle, or none where moves are generated.
    fn choose(&mut self, spec: &CycleSpec) -> Done<Option<SequenceId>> {
        let program = self.shape.program;
        let rigid = self.is_rigid(spec);
        let emulated = self.shape.options.cycles == Cycles::Emulated || spec.emulate && !rigid;
        let candidate = self.candidate(spec).filter(|_| !emulated);
        let floats = |routine: &Routine| !program.settings.rigid_tap && !routine.vars.has(VarId::Rigid);
        if rigid && spec.rigid == Some(true) && candidate.and_then(|id| program.routine(id)).is_some_and(floats) {
            let message = "a rigid tap, and the form's tap is for a floating holder";
            return fault(
                Code::PC021,
                message,
                "say `RigidTap? Y` in the form where its tap is rigid, or print [rigid]",
            );
        }
        let why = match candidate.and_then(|id| program.routine(id).map(|routine| (id, routine))) {
            Some((id, routine)) => match self.cannot_say(spec, routine) {
                None => return Ok((routine.style != CycleStyle::Generated).then_some(id)),
                Some(what) => format!("{} does not print {what}", id.name()),
            },
            None if emulated => "cycles are emulated".to_owned(),
            None => format!("the form has no sequence for `{}`", spec.kind.name()),
        };
        if rigid {
            let message = format!("a rigid tap can't be made of single moves, and {why}");
            return fault(Code::PC021, message, "add a Tap sequence that prints what the tap needs");
        }
        if candidate.is_some() {
            self.out.note(Code::PR014, format!("the cycle is printed as single moves: {why}"), "look at the moves");
        }
        Ok(None)
    }

    /// Which sequence serves which kind (render.md section 3).
    fn candidate(&self, spec: &CycleSpec) -> Option<SequenceId> {
        use SequenceId as S;
        let program = self.shape.program;
        let custom = |kind: CycleKind| {
            let labels = program.custom.iter().zip([S::Custom1, S::Custom2, S::Custom3]);
            let name = kind.name();
            let is_kind = |label: &String| kind_of_remark(label).is_some_and(|kind| kind.eq_ignore_ascii_case(name));
            labels.filter(|(label, _)| label.as_ref().is_some_and(is_kind)).map(|(_, id)| id).next()
        };
        let serves = |kind: CycleKind| match kind.sequence() {
            Some(own) if program.routine(own).is_some() => Some(own),
            None if kind == CycleKind::Face => custom(kind).or_else(|| {
                let prints_dwell = |routine: &&Routine| routine.vars.has(VarId::Dwell);
                program.routine(S::Drill).filter(prints_dwell).map(|_| S::Drill)
            }),
            _ => custom(kind),
        };
        made_as(spec).into_iter().flatten().find_map(serves)
    }

    /// What a cycle asks for that its sequence does not print.
    fn cannot_say(&self, spec: &CycleSpec, routine: &Routine) -> Option<&'static str> {
        if routine.style == CycleStyle::Generated {
            return None;
        }
        let prints = |vars: &[VarId]| vars.iter().any(|&var| routine.vars.has(var));
        let pecks = matches!(spec.kind, CycleKind::Deep | CycleKind::Chipbreak) || spec.mode.is_some();
        let custom = matches!(spec.kind, CycleKind::Custom1 | CycleKind::Custom2 | CycleKind::Custom3);
        let program = self.shape.program;
        let own = !custom; // what a custom cycle must say, only its form knows
        let across = own && program.settings.machine == Machine::Mill; // a lathe drills at its centre
        let absolute = |code| code == program.settings.inc_abs[1];
        let positions = &[VarId::H, VarId::V, VarId::D, VarId::Vclear, VarId::Rplane];
        let steps = program.settings.incremental && prints(positions) && !self.says_code(routine, b'G', absolute);
        let feeds_out = !spec.norevr && !spec.rapout;
        let by_form = self.shape.defaults.orient;
        let other_angle = spec.orient.is_some_and(|orient| orient.angle(by_form) != by_form);
        let missing = [
            (steps, &[][..], "increments, which the control expects here"),
            (across, &[VarId::H], "the position: [h]"),
            (across, &[VarId::V], "the position: [v]"),
            (own && spec.kind != CycleKind::Manual, &[VarId::D, VarId::Depth], "the depth: [d]"),
            (own && spec.kind != CycleKind::Manual, &[VarId::Frate, VarId::Plunge, VarId::Pitch], "the feed: [frate]"),
            (!spec.pecks.is_empty(), &[], "absolute pecks (`pecks`)"),
            (spec.times.is_some(), &[], "full retracts between chip breaks (`times`)"),
            (spec.decr.is_some(), &[], "shrinking pecks (`decr`)"),
            (!spec.webs.is_empty(), &[], "webs"),
            (spec.rapto.is_some(), &[], "the extra rapid (`rapto`)"),
            (feeds_out && spec.ratio.is_some_and(|r| r != 1.0), &[], "the retract feed (`ratio`)"),
            (spec.starts.is_some_and(|s| s > 1.0), &[VarId::Vclear], "several starts: [vclear]"),
            (spec.hole_diameter.is_some(), &[], "the rapid to the cone (`hole_diameter`)"),
            (other_angle, &[], "the spindle angle (`orient`)"),
            // at the control's own angle only a cycle that leaves the wall stops the spindle at one
            (spec.kind == CycleKind::Bore && spec.orient.is_some(), &[VarId::Sleave], "an oriented spindle: [sleave]"),
            (spec.jog.is_some(), &[], "the lift of the jog (`jog`)"),
            (spec.offset_y.is_some(), &[], "a jog along both axes (`offset_y`)"),
            (spec.offset.is_some(), &[VarId::Sleave], "the jog off the wall: [sleave]"),
            (spec.dwell.or(spec.revs).is_some_and(|t| t > 0.0), &[VarId::Dwell], "the dwell: [dwell]"),
            (spec.first_step.is_some(), &[VarId::Peck1, VarId::Inidep], "the first peck: [peck1]"),
            (spec.min_step.is_some(), &[VarId::Sbite], "the least peck: [sbite]"),
            (pecks && spec.step.is_some(), &[VarId::Vbite], "the peck: [vbite]"),
        ];
        missing.into_iter().find(|(asked, vars, _)| *asked && !prints(vars)).map(|(_, _, what)| what)
    }

    /// The planes of a cycle at a hole.
    pub(super) fn planes(&self, spec: &CycleSpec, hole: &Hole) -> Done<Plan> {
        let depth = hole.depth.map(|d| d * self.shape.scale);
        Ok(Plan::of(spec, depth, &self.shape.defaults, self.vars.get(VarId::Speed))?)
    }

    /// Where the tool is before the first hole of a cycle: over it, at the return plane. For tool changes.
    pub(super) fn hole_position(&self, spec: &CycleSpec, hole: &Hole) -> Done<Axes> {
        let spec = self.scaled(spec);
        let planes = self.planes(&spec, hole)?;
        let mut target = self.target(&hole.at);
        let Some(point) = hole.at.get(self.shape.depth) else { return no_height() };
        let point = point * self.shape.scale;
        target.set(self.shape.depth, point + spec.return_height.unwrap_or(planes.clear).max(planes.clear));
        Ok(target)
    }
}

/// The first point of a cycle must say how high it is.
pub(super) fn no_height<T>() -> Done<T> {
    fault(
        Code::PR006,
        "the cycle's first point has no height",
        "give its third coordinate, the top of the hole, as [1, 1, 0]",
    )
}

/// The kinds whose sequences make a cycle, the best first: GENER makes some cycles as others.
fn made_as(spec: &CycleSpec) -> [Option<CycleKind>; 3] {
    use CycleKind as K;
    let dwells = spec.dwell.or(spec.revs).is_some_and(|time| time > 0.0);
    let faces = dwells.then_some(K::Face);
    match spec.kind {
        K::Drill => [faces, Some(K::Drill), None],
        K::Csink => [Some(K::Csink), faces, Some(K::Drill)],
        K::Tap | K::LTap if spec.norevr => [Some(K::Face), None, None],
        K::Tap | K::LTap if spec.rapout => [faces, Some(K::Drill), None],
        kind => [Some(kind), None, None],
    }
}
