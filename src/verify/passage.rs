//! What lies between two cuts: rapids, changes of tool and work offset, stops, dwells. Job and program have one each.

use super::cut::{ALL, DEPTH, Place, Rapid, same};
use super::wire_codes::Coded;
use crate::nc::Rotation;
use crate::toolpath::{self, StopKind};

/// The coordinates in which places are said.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Frame {
    pub tool: Option<f64>,
    pub work: Option<f64>,
}

/// The rapids in one frame.
#[derive(Clone, Debug, Default)]
pub(super) struct Leg {
    pub frame: Frame,
    /// How many rapids come before the leg.
    from: usize,
    /// It begins at the machine's own place, to which the job sends the tool.
    home: bool,
    /// Length registers in force while the tool moved to heights that are known; of the job, the tool's.
    pub lengths: Vec<Option<f64>>,
}

/// Something that is done on the way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Mark<T> {
    pub what: T,
    /// How many rapids come before the mark.
    at: usize,
    /// How often the frame was changed before the mark, since the cut.
    leg: usize,
    /// The spindle was started from standing before it, since the cut.
    pub started: bool,
    /// A torch or a laser is off there: it is in no cut.
    pub is_off: bool,
    /// The program's line; 0 of a job.
    pub line: u64,
    /// The job's item.
    pub place: toolpath::Place,
}

/// What lies between the last cut and the next.
#[derive(Clone, Debug)]
pub(super) struct Passage {
    /// Where the passage begins; `None`: only the machine knows.
    pub start: Option<Rapid>,
    /// It begins where a cut ended, and not where the program begins.
    after_cut: bool,
    pub rapids: Vec<Rapid>,
    /// The way in pieces, one a frame; at least one.
    legs: Vec<Leg>,
    pub stops: Vec<Mark<StopKind>>,
    /// Dwells in seconds; not a number: of any length.
    pub waits: Vec<Mark<f64>>,
    /// How the spindle was switched.
    pub turns: Vec<Rotation>,
    /// The spindle was started from standing.
    pub started: bool,
    /// A torch or a laser is off now.
    pub is_off: bool,
    /// Codes of the program that are not simulated: letter, and ten times the number.
    pub codes: Vec<(u8, u16)>,
    /// Codes that thread and cut a wire.
    pub does: Vec<Mark<Coded>>,
    /// The tool was changed.
    pub new_tool: bool,
    /// For each change of a lathe's tool, the axes at a place of the machine.
    pub turrets: Vec<u8>,
    /// Axes that went to a place of the machine which the program says.
    pub homes: u8,
    /// The job's way leaves the axis of its hole.
    pub aside: bool,
    /// The job's way left the axis of its hole before the last change of the frame.
    pub left_aside: bool,
    /// Where increments from a place of the machine led, with their lines.
    pub astray: Vec<(u64, Place)>,
}

/// Why nothing is proven where a passage is too long.
pub(super) const TOO_LONG: &str = "more rapids, stops and dwells between two cuts than are held";
/// More rapids between two cuts than any job has: they would have to be held.
const MOST: usize = 1 << 16;
/// More stops and dwells between two cuts than any job has: each is compared with each.
const MOST_MARKS: usize = 1 << 12;
/// More changes of the tool or the work offset between two cuts than any job has: the same.
const MOST_LEGS: usize = 1 << 11;

impl Passage {
    /// A passage from a start in a frame.
    pub fn new(start: Option<Rapid>, frame: Frame) -> Passage {
        Passage {
            start,
            after_cut: false,
            rapids: Vec::new(),
            legs: vec![Leg { frame, ..Leg::default() }],
            stops: Vec::new(),
            waits: Vec::new(),
            turns: Vec::new(),
            started: false,
            is_off: false,
            codes: Vec::new(),
            does: Vec::new(),
            new_tool: false,
            turrets: Vec::new(),
            homes: 0,
            aside: false,
            left_aside: false,
            astray: Vec::new(),
        }
    }

    /// A cut ended: the next passage begins there.
    pub fn begin(&mut self, start: Rapid) {
        (self.start, self.after_cut) = (Some(start), true);
        self.rapids.clear();
        if self.legs.len() > 1 {
            self.legs.swap_remove(0);
            self.legs.truncate(1);
        }
        if let Some(leg) = self.legs.first_mut() {
            (leg.from, leg.home) = (0, false);
            leg.lengths.clear();
        }
        self.stops.clear();
        self.waits.clear();
        self.turns.clear();
        (self.started, self.is_off) = (false, false);
        self.codes.clear();
        self.does.clear();
        self.astray.clear();
        self.turrets.clear();
        self.homes = 0;
        (self.new_tool, self.aside, self.left_aside) = (false, false, false);
    }

    /// A cut that counts for nothing was on the way.
    pub fn goes_on(&mut self, to: Place) {
        match &mut self.start {
            Some(start) if self.rapids.is_empty() && self.legs.len() == 1 => {
                *start = Rapid { to, unknown: 0, ..*start }
            }
            _ => self.rapids.push(Rapid { to, unknown: 0, spin: None }),
        }
    }

    /// The frame changes: places are in other coordinates from here on.
    pub fn change(&mut self, frame: Frame) {
        if let [.., before, last] = self.legs.as_slice()
            && last.from == self.rapids.len()
            && before.frame == frame
        {
            // there and back again without a move
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

    /// The tool goes to the machine's own place: the way from there is one of its own, in the same frame.
    pub fn goes_home(&mut self, length: Option<f64>) {
        if self.legs.len() == 1 {
            self.left_aside = std::mem::take(&mut self.aside);
        }
        let frame = self.legs.last().map_or_else(Frame::default, |leg| leg.frame);
        self.legs.push(Leg { frame, from: self.rapids.len(), home: true, lengths: vec![length] });
    }

    /// Was the tool sent home?
    pub fn was_sent_home(&self) -> bool {
        self.legs.iter().any(|leg| leg.home)
    }

    /// Ways from places of the machine along one of these axes begin again, as the job's do where it goes home. Is there such a place?
    pub fn splits_at_home(&mut self, axes: u8) -> bool {
        let is_home = |rapid: &Rapid| rapid.unknown & axes != 0;
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

    /// The frame changes at a mark, as where the operator changes the tool.
    pub fn split<T>(&mut self, mark: &Mark<T>) {
        let behind = self.legs.iter().rposition(|leg| leg.from <= mark.at).unwrap_or_default();
        let leg = Leg { from: mark.at, ..self.legs[behind].clone() };
        self.legs.insert(behind + 1, leg);
    }

    /// How many stops come before a leg.
    pub fn stops_before(&self, leg: usize, kind: StopKind) -> usize {
        self.stops.iter().filter(|stop| stop.what == kind && stop.leg < leg).count()
    }

    /// The legs that begin with another tool, and whether it is the first of all.
    pub fn tool_changes(&self) -> Vec<(usize, bool)> {
        let pairs = self.legs.windows(2).enumerate().filter(|(_, pair)| pair[0].frame.tool != pair[1].frame.tool);
        pairs.map(|(at, pair)| (at + 1, pair[0].frame.tool.is_none())).collect()
    }

    /// The last leg, which goes on.
    pub fn leg(&mut self) -> Option<&mut Leg> {
        self.legs.last_mut()
    }

    /// Is there more than can be held?
    #[inline]
    pub fn is_too_long(&self) -> bool {
        let marks = self.stops.len() + self.waits.len() + self.turns.len() + self.does.len();
        self.rapids.len() + self.codes.len() + self.astray.len() > MOST
            || marks > MOST_MARKS
            || self.legs.len() > MOST_LEGS
    }

    /// Was the frame changed?
    pub fn changed(&self) -> bool {
        self.legs.len() > 1
    }

    /// The legs with their rapids.
    pub fn legs(&self) -> impl DoubleEndedIterator<Item = (&Leg, &[Rapid])> {
        let end = |next: usize| self.legs.get(next).map_or(self.rapids.len(), |leg| leg.from);
        self.legs.iter().enumerate().map(move |(i, leg)| (leg, &self.rapids[leg.from..end(i + 1)]))
    }

    /// The rapids before the first change of the frame.
    pub fn leaving(&self) -> &[Rapid] {
        &self.rapids[..self.legs.get(1).map_or(self.rapids.len(), |leg| leg.from)]
    }

    /// The rapids after the last change of the frame.
    pub fn arriving(&self) -> &[Rapid] {
        &self.rapids[self.legs.last().map_or(0, |leg| leg.from)..]
    }

    /// Notes that something is done here.
    pub fn mark<T>(&self, what: T, line: u64, place: toolpath::Place) -> Mark<T> {
        let (at, leg) = (self.rapids.len(), self.legs.len() - 1);
        Mark { what, at, leg, started: self.started, is_off: self.is_off, line, place }
    }

    /// Where the tool is at a mark; `None` before the first place that is known.
    pub fn standing<T>(&self, mark: &Mark<T>) -> Option<Rapid> {
        let corner = match mark.at.checked_sub(1) {
            Some(last) => self.rapids.get(last).copied(),
            None => self.start,
        };
        let moved = mark.leg == 0 || self.legs.get(mark.leg).is_some_and(|leg| leg.from < mark.at);
        corner.filter(|corner| corner.unknown == 0 && moved)
    }

    /// Does the tool stand at a place of the machine along one of these axes, or where the job sent it home?
    pub fn at_home<T>(&self, mark: &Mark<T>, axes: u8) -> bool {
        let sent = self.legs.get(mark.leg).is_some_and(|leg| leg.home && leg.from == mark.at);
        let last = mark.at.checked_sub(1).and_then(|last| self.rapids.get(last));
        sent || last.is_some_and(|rapid| rapid.unknown & axes != 0)
    }

    /// Does the tool still stand where the cut ended?
    pub fn in_cut<T>(&self, mark: &Mark<T>, tolerance: f64) -> bool {
        let Some(start) = self.start.filter(|_| self.after_cut && mark.leg == 0 && !mark.is_off) else { return false };
        let stays = |rapid: &Rapid| {
            rapid.unknown == start.unknown && same(&rapid.to, &start.to, ALL & !start.unknown, tolerance)
        };
        self.rapids.iter().take(mark.at).all(stays)
    }

    /// Is the tool below this height at a mark, and was it ever since the cut?
    pub fn below_since<T>(&self, mark: &Mark<T>, height: f64) -> bool {
        let mut way = self.start.iter().chain(self.rapids.iter().take(mark.at));
        mark.leg == 0 && self.start.is_some() && way.all(|corner| is_below(corner, height))
    }

    /// Is the tool below this height at a mark, and stays there until the next cut?
    pub fn below_until<T>(&self, mark: &Mark<T>, height: f64) -> bool {
        let stands = self.standing(mark).is_some_and(|corner| is_below(&corner, height));
        stands && self.rapids.iter().skip(mark.at).all(|corner| is_below(corner, height))
    }

    /// Does the tool stay where the last cut ended, but for rapids that no digits show?
    pub fn stays(&self, tolerance: f64) -> bool {
        self.rapids.is_empty()
            || self.start.is_some_and(|start| {
                let here = |rapid: &Rapid| rapid.unknown == start.unknown && same(&rapid.to, &start.to, ALL, tolerance);
                !self.changed() && self.rapids.iter().all(here)
            })
    }

    /// Where the tool is now, if that is known.
    pub fn here(&self) -> Option<Rapid> {
        // in a new frame no position was given yet
        let fresh = self.changed() && self.legs.last().is_some_and(|leg| leg.from == self.rapids.len());
        if fresh { None } else { self.rapids.last().copied().or(self.start) }
    }

    /// Does the next cut follow on the last without anything between?
    pub fn is_plain(&self) -> bool {
        self.rapids.is_empty()
            && self.legs.len() == 1
            && self.stops.is_empty()
            && self.waits.is_empty()
            && self.does.is_empty()
    }
}

fn is_below(corner: &Rapid, height: f64) -> bool {
    corner.unknown & 1 << DEPTH == 0 && corner.to[DEPTH] < height
}
