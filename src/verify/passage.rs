//! A passage: everything between two cuts, such as rapids, changes of tool and work offset, stops and dwells. The job
//! has a passage between its cuts, and the program has a passage between its cuts.

use std::ops::{Deref, DerefMut};

use super::beside::{AtMachine, Beside, Compensated, Mark};
use super::cut::{ACROSS, ALL, DEPTH, Place, Rapid, place, same};
use crate::toolpath::{self, StopKind};

/// The coordinate frame in which positions are given; the tool and the work offset define it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Frame {
    pub tool: Option<f64>,
    pub work: Option<f64>,
}

/// The rapids in one frame.
#[derive(Clone, Debug, Default)]
pub(super) struct Leg {
    pub frame: Frame,
    /// Number of rapids in the passage before this leg.
    from: usize,
    /// Whether the leg begins where the job sends the tool home.
    home: bool,
    /// Whether the leg begins where the job changes the tool.
    pub loads: bool,
    /// The first position of the operation that begins with this leg, and its axes as bits. A tool change may go to this
    /// position, although several rapids give it.
    pub first: Option<(Place, u8)>,
    /// Length registers that were active while the tool moved to known heights. For a job: the tool's length register.
    pub lengths: Vec<Option<f64>>,
}

/// A change of the work offset. The tool stays at its height, but the number of this height in the new offset is
/// unknown.
#[derive(Clone, Copy, Debug)]
pub(super) struct Entry {
    /// The new work offset.
    pub work: Option<f64>,
    /// The height of the tool, if it is known in an earlier frame.
    pub height: Option<Standing>,
    /// The first rapid in the new offset.
    pub first: Option<Rapid>,
}

impl Entry {
    /// Whether the first rapid in the new offset stays at the height that the tool had before the change.
    pub fn keeps_height(&self) -> bool {
        self.first.is_some_and(|first| first.kept & 1 << DEPTH != 0)
    }

    /// Whether the tool moves across at the height that it had before the change, or from that height.
    pub fn crosses(&self) -> bool {
        let stays_over = |first: Rapid| first.kept & ACROSS == 0b11 && first.kept & 1 << DEPTH == 0;
        self.first.is_some_and(|first| !stays_over(first))
    }
}

/// The height of the tool in the last frame in which it is known.
#[derive(Clone, Copy, Debug)]
pub(super) struct Standing {
    /// The work offset of this frame.
    pub work: Option<f64>,
    /// Infinite at a machine position.
    pub height: f64,
    /// Whether the tool is still at the end of the last cut, and this cut did not go up.
    pub in_cut: bool,
}

impl Leg {
    /// The rapids of this leg, for a tool change that goes to the first position of the operation: the axes that no rapid
    /// has given yet are at this position. `None`: the first rapid gives all axes of this position.
    pub fn by_first(&self, rapids: &[Rapid]) -> Option<Vec<Rapid>> {
        let (first, axes) = self.first?;
        let filled = |rapid: &Rapid| {
            let mut to = rapid.to;
            for axis in (0..to.len()).filter(|axis| rapid.unknown & axes & 1 << axis != 0) {
                to[axis] = first[axis];
            }
            Rapid { to, unknown: rapid.unknown & !axes, ..*rapid }
        };
        rapids.iter().any(|rapid| rapid.unknown & axes != 0).then(|| rapids.iter().map(filled).collect())
    }
}

/// Everything between two cuts.
#[derive(Clone, Debug)]
pub(super) struct Passage {
    /// The start position of the passage; `None` if this position is known only at the machine.
    pub start: Option<Rapid>,
    /// Whether the passage begins at the end of a cut. `false`: it begins at the start of the program.
    after_cut: bool,
    /// Whether this cut went up.
    rises: bool,
    pub rapids: Vec<Rapid>,
    /// The cutter compensation that is on now.
    pub side: Option<Compensated>,
    /// The parts of the path (legs), one for each frame. The list has at least one leg.
    legs: Vec<Leg>,
    /// Whether the job's path moves away from the axis of its hole.
    pub aside: bool,
    /// Whether the job's path moved away from the axis of its hole before the last change of the frame.
    pub left_aside: bool,
    /// Everything except the path.
    beside: Beside,
    /// Whether `beside` may have been changed since the passage began.
    touched: bool,
}

impl Deref for Passage {
    type Target = Beside;

    #[inline]
    fn deref(&self) -> &Beside {
        &self.beside
    }
}

impl DerefMut for Passage {
    #[inline]
    fn deref_mut(&mut self) -> &mut Beside {
        self.touched = true;
        &mut self.beside
    }
}

/// The message for a passage that is too long.
pub(super) const TOO_LONG: &str = "too many rapids, stops and dwells between two cuts";
/// The largest number of rapids between two cuts. All rapids between two cuts are kept in memory, and no real job has
/// more.
const MOST: usize = 1 << 16;
/// The largest number of stops and dwells between two cuts. Each stop or dwell is compared with all others, and no real
/// job has more.
const MOST_MARKS: usize = 1 << 12;
/// The largest number of changes of tool or work offset between two cuts. No real job has more.
const MOST_LEGS: usize = 1 << 11;

impl Passage {
    /// A passage that begins at the position `start` in the coordinate frame `frame`.
    pub fn new(start: Option<Rapid>, frame: Frame) -> Passage {
        Passage {
            start,
            after_cut: false,
            rises: false,
            rapids: Vec::new(),
            side: None,
            legs: vec![Leg { frame, ..Leg::default() }],
            aside: false,
            left_aside: false,
            beside: Beside::default(),
            touched: false,
        }
    }

    /// Begins the next passage at the end of a cut.
    #[inline]
    pub fn begin(&mut self, start: Rapid) {
        let from = self.rapids.last().or(self.start.as_ref());
        self.rises = from.is_some_and(|from| from.unknown & 1 << DEPTH == 0 && from.to[DEPTH] < start.to[DEPTH]);
        (self.start, self.after_cut) = (Some(start), true);
        self.rapids.clear();
        if self.legs.len() > 1 {
            self.legs.swap_remove(0);
            self.legs.truncate(1);
        }
        if let Some(leg) = self.legs.first_mut() {
            (leg.from, leg.home, leg.first) = (0, false, None);
            leg.lengths.clear();
        }
        (self.aside, self.left_aside) = (false, false);
        if std::mem::take(&mut self.touched) {
            self.beside.clear();
        }
    }

    /// Adds a rapid, with the compensation that is on.
    pub fn rapid(&mut self, rapid: Rapid) {
        self.rapids.push(rapid);
        if let Some(side) = self.side
            && self.compensated.last() != Some(&side)
        {
            self.compensated.push(side);
        }
    }

    /// Whether the passage is only rapids straight up or down.
    pub fn only_lifts(&self) -> bool {
        let is_over = |start: &Rapid| self.rapids.iter().all(|rapid| rapid.to[..2] == start.to[..2]);
        self.only_moves() && self.start.as_ref().is_some_and(is_over)
    }

    /// Moves the whole passage across.
    pub fn shift(&mut self, at: [f64; 2]) {
        for rapid in self.start.iter_mut().chain(&mut self.rapids) {
            (rapid.to[0], rapid.to[1]) = (at[0], at[1]);
        }
    }

    /// Records a rapid of these axes to a machine position, measured from this reference point. `length`: the axis of
    /// the tool length and its register, if the length may count in this position.
    pub fn reaches_machine(&mut self, axes: u8, point: usize, to: &Place, length: Option<(usize, f64)>) {
        self.homes |= axes;
        for (axis, places) in self.machine.iter_mut().enumerate().filter(|(axis, _)| axes & 1 << axis != 0) {
            let length = length.filter(|(along, _)| *along == axis).map(|(_, register)| register);
            // an axis stays at its machine position while other axes move
            let stays = places.last().is_some_and(|last| last.at == to[axis] && last.length == length);
            if point != 0 || !stays {
                places.push(AtMachine { at: to[axis], point, length });
            }
        }
    }

    /// Skips a cut that does not matter. The passage then continues from the end of the skipped cut.
    pub fn goes_on(&mut self, to: Place) {
        match &mut self.start {
            Some(start) if self.rapids.is_empty() && self.legs.len() == 1 => {
                *start = Rapid { to, unknown: 0, ..*start }
            }
            _ => self.rapids.push(Rapid { to, unknown: 0, kept: 0, spin: None }),
        }
    }

    /// Changes the frame. Positions after the change are in another coordinate frame.
    pub fn change(&mut self, frame: Frame) {
        if let [.., before, last] = self.legs.as_slice()
            && last.from == self.rapids.len()
            && before.frame == frame
        {
            // the frame changed and changed back without a move between
            self.legs.pop();
            if self.legs.len() == 1 {
                self.aside = std::mem::take(&mut self.left_aside);
            }
            return;
        }
        if self.legs.len() == 1 {
            self.left_aside = std::mem::take(&mut self.aside);
        }
        self.legs.push(Leg { frame, from: self.rapids.len(), ..Leg::default() });
    }

    /// Sends the tool home. A new leg begins at the home position, in the same frame.
    pub fn goes_home(&mut self, length: Option<f64>) {
        if self.legs.len() == 1 {
            self.left_aside = std::mem::take(&mut self.aside);
        }
        let frame = self.legs.last().map_or_else(Frame::default, |leg| leg.frame);
        self.legs.push(Leg { frame, from: self.rapids.len(), home: true, lengths: vec![length], ..Leg::default() });
    }

    /// Whether the tool was sent home.
    pub fn was_sent_home(&self) -> bool {
        self.legs.iter().any(|leg| leg.home)
    }

    /// Begins a new leg after each machine position along one of these axes. The job's passage also begins a leg where
    /// the job sends the tool home. Returns whether the passage contains a machine position along one of these axes.
    pub fn splits_at_home(&mut self, axes: u8) -> bool {
        let is_home = |rapid: &Rapid| rapid.is_at_machine(axes);
        let ends: Vec<usize> = (1..=self.rapids.len())
            .filter(|&at| is_home(&self.rapids[at - 1]) && !self.rapids.get(at).is_some_and(is_home))
            .collect();
        for &at in ends.iter().rev() {
            let behind = self.legs.iter().rposition(|leg| leg.from < at).unwrap_or_default();
            if self.legs.get(behind + 1).is_none_or(|next| next.from > at) {
                let leg = Leg { from: at, ..self.legs[behind].clone() };
                self.legs.insert(behind + 1, leg);
            }
        }
        !ends.is_empty()
    }

    /// Begins a new leg at a mark, for example where the operator changes the tool.
    pub fn split<T>(&mut self, mark: &Mark<T>) {
        let behind = self.legs.iter().rposition(|leg| leg.from <= mark.at).unwrap_or_default();
        let leg = Leg { from: mark.at, ..self.legs[behind].clone() };
        self.legs.insert(behind + 1, leg);
    }

    /// The number of stops before a leg.
    pub fn stops_before(&self, leg: usize, kind: StopKind) -> usize {
        self.stops.iter().filter(|stop| stop.what == kind && stop.leg < leg).count()
    }

    /// The indices of the job's legs that begin with a tool change. `true`: the tool is the first tool of the program.
    pub fn tool_changes(&self) -> Vec<(usize, bool)> {
        let pairs = self.legs.windows(2).enumerate().filter(|(_, pair)| pair[1].loads);
        pairs.map(|(at, pair)| (at + 1, pair[0].frame.tool.is_none())).collect()
    }

    /// The number of the job's tool changes to the tool that is in the spindle.
    pub fn reloads(&self) -> usize {
        self.legs.windows(2).filter(|pair| pair[1].loads && pair[0].frame.tool == pair[1].frame.tool).count()
    }

    /// The current leg, which is the last leg of the passage.
    pub fn leg(&mut self) -> Option<&mut Leg> {
        self.legs.last_mut()
    }

    /// Whether the passage is too long to be kept in memory or compared.
    #[inline]
    pub fn is_too_long(&self) -> bool {
        self.rapids.len() > MOST || self.legs.len() > MOST_LEGS || self.touched && self.has_too_much_beside()
    }

    fn has_too_much_beside(&self) -> bool {
        let marks = self.stops.len() + self.reloads.len() + self.waits.len() + self.turns.len() + self.does.len();
        let codes = self.codes.len() + self.words.len() + self.tool_data.len();
        self.rapids.len() + codes + self.astray.len() > MOST || marks > MOST_MARKS
    }

    /// Whether the frame was changed.
    pub fn changed(&self) -> bool {
        self.legs.len() > 1
    }

    /// The legs with their rapids.
    pub fn legs(&self) -> impl DoubleEndedIterator<Item = (&Leg, &[Rapid])> {
        let end = |next: usize| self.legs.get(next).map_or(self.rapids.len(), |leg| leg.from);
        self.legs.iter().enumerate().map(move |(i, leg)| (leg, &self.rapids[leg.from..end(i + 1)]))
    }

    /// The start and the ends of all rapids. Where the job sends the tool home or changes the tool, all axes are unknown.
    pub fn path(&self, start: Option<Rapid>) -> Vec<Rapid> {
        let lost = Rapid { to: place(&[0.0; 6]), unknown: ALL, kept: ALL, spin: None };
        let own = |(leg, rapids): (&Leg, &[Rapid])| {
            let before = (leg.home || leg.loads).then_some(lost);
            before.into_iter().chain(rapids.iter().copied()).collect::<Vec<_>>()
        };
        start.into_iter().chain(self.legs().flat_map(own)).collect()
    }

    /// The rapids before the first change of the frame.
    pub fn leaving(&self) -> &[Rapid] {
        &self.rapids[..self.legs.get(1).map_or(self.rapids.len(), |leg| leg.from)]
    }

    /// The rapids after the last change of the frame.
    pub fn arriving(&self) -> &[Rapid] {
        &self.rapids[self.legs.last().map_or(0, |leg| leg.from)..]
    }

    /// The rapids after the last change of the frame, for a tool change that goes to the first position of the operation.
    /// `None`: this position is the end of the first rapid.
    pub fn arriving_by_first(&self) -> Option<Vec<Rapid>> {
        self.legs.last().and_then(|leg| leg.by_first(self.arriving()))
    }

    /// A mark for an action at the tool's current position.
    pub fn mark<T>(&self, what: T, line: u64, place: toolpath::Place) -> Mark<T> {
        let (at, leg) = (self.rapids.len(), self.legs.len() - 1);
        Mark { what, at, leg, started: self.started, is_off: self.is_off, line, place }
    }

    /// Position of the tool at a mark; `None` if the position is not yet known.
    pub fn standing<T>(&self, mark: &Mark<T>) -> Option<Rapid> {
        let corner = match mark.at.checked_sub(1) {
            Some(last) => self.rapids.get(last).copied(),
            None => self.start,
        };
        let moved = mark.leg == 0 || self.legs.get(mark.leg).is_some_and(|leg| leg.from < mark.at);
        corner.filter(|corner| corner.unknown == 0 && moved)
    }

    /// The height of the tool after this number of rapids, in this leg. A change of the work offset does not move the
    /// tool; at the position to which the job sends it, the tool is at least as high. `None`: the tool was changed since.
    fn height_after(&self, rapids: usize, leg: usize) -> Option<Standing> {
        let moved = (1..=rapids).rev().find(|&at| self.rapids[at - 1].kept & 1 << DEPTH == 0).unwrap_or_default();
        let corner = moved.checked_sub(1).map_or(self.start, |last| self.rapids.get(last).copied())?;
        let made = self.legs.iter().rposition(|leg| leg.from < moved).unwrap_or_default();
        let [own, since @ ..] = self.legs.get(made..=leg)? else { return None };
        let stays = |leg: &Leg| leg.frame.tool == own.frame.tool;
        let height = corner.height();
        let in_cut = self.after_cut && !self.rises && moved == 0;
        since.iter().all(stays).then_some(Standing { work: own.frame.work, height, in_cut })
    }

    /// The height of the tool at a mark.
    pub fn height_at<T>(&self, mark: &Mark<T>) -> Option<Standing> {
        self.height_after(mark.at, mark.leg)
    }

    /// The height of the tool at the end of the passage.
    pub fn last_height(&self) -> Option<Standing> {
        self.height_after(self.rapids.len(), self.legs.len() - 1)
    }

    /// The changes of the work offset. Changes before which the tool does not move count as one.
    pub fn entries(&self) -> impl Iterator<Item = Entry> {
        let last = self.legs.len() - 1;
        (1..=last).filter(|&at| self.legs[at].frame.work != self.legs[at - 1].frame.work).filter_map(move |at| {
            let (from, end) = (self.legs[at].from, self.legs.get(at + 1).map_or(self.rapids.len(), |leg| leg.from));
            let first = self.rapids[from..end].first().copied();
            let entry = Entry { work: self.legs[at].frame.work, height: self.height_after(from, at), first };
            (at == last || first.is_some()).then_some(entry)
        })
    }

    /// Whether the tool is at a machine position along one of these axes, or at the position to which the job sent it home.
    pub fn at_home<T>(&self, mark: &Mark<T>, axes: u8) -> bool {
        let sent = self.legs.get(mark.leg).is_some_and(|leg| leg.home && leg.from == mark.at);
        let last = mark.at.checked_sub(1).and_then(|last| self.rapids.get(last));
        sent || last.is_some_and(|rapid| rapid.is_at_machine(axes))
    }

    /// Whether the tool is still at the end of the last cut at this mark (such as a dwell).
    pub fn in_cut<T>(&self, mark: &Mark<T>, tolerance: f64) -> bool {
        let is_here = |leg: &Leg| leg.frame.tool == self.legs[0].frame.tool && !leg.home;
        let in_frames = mark.leg == 0 || mark.at == 0 && self.legs.iter().take(mark.leg + 1).all(is_here);
        let Some(start) = self.start.filter(|_| self.after_cut && in_frames && !mark.is_off) else { return false };
        let stays = |rapid: &Rapid| {
            rapid.unknown == start.unknown && same(&rapid.to, &start.to, ALL & !start.unknown, tolerance)
        };
        self.rapids.iter().take(mark.at).all(stays)
    }

    /// Whether the tool is below this height from the last cut to the mark.
    pub fn below_since<T>(&self, mark: &Mark<T>, height: f64) -> bool {
        let mut way = self.start.iter().chain(self.rapids.iter().take(mark.at));
        mark.leg == 0 && self.start.is_some() && way.all(|corner| is_below(corner, height))
    }

    /// Whether the tool is below this height from the mark to the next cut.
    pub fn below_until<T>(&self, mark: &Mark<T>, height: f64) -> bool {
        let stands = self.standing(mark).is_some_and(|corner| is_below(&corner, height));
        stands && self.rapids.iter().skip(mark.at).all(|corner| is_below(corner, height))
    }

    /// Whether the tool stays at the end of the last cut. Rapids smaller than the tolerance are allowed.
    pub fn stays(&self, tolerance: f64) -> bool {
        self.rapids.is_empty()
            || self.start.is_some_and(|start| {
                let here = |rapid: &Rapid| rapid.unknown == start.unknown && same(&rapid.to, &start.to, ALL, tolerance);
                !self.changed() && self.rapids.iter().all(here)
            })
    }

    /// The current position of the tool, if known.
    pub fn here(&self) -> Option<Rapid> {
        // in a new frame, the position is unknown until the first rapid
        let fresh = self.changed() && self.legs.last().is_some_and(|leg| leg.from == self.rapids.len());
        if fresh { None } else { self.rapids.last().copied().or(self.start) }
    }

    /// Whether the next cut follows directly on the last cut, without a rapid or another action between the two cuts.
    #[inline]
    pub fn is_plain(&self) -> bool {
        self.rapids.is_empty() && self.only_moves()
    }

    /// Whether the passage contains only rapids without compensation, all in one frame.
    #[inline]
    pub fn only_moves(&self) -> bool {
        let only_path =
            || self.compensated.is_empty() && self.stops.is_empty() && self.waits.is_empty() && self.does.is_empty();
        self.legs.len() == 1 && (!self.touched || only_path())
    }
}

fn is_below(corner: &Rapid, height: f64) -> bool {
    corner.height() < height
}
