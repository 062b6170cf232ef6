//! Lathes of the Fanuc kind: the turret, and threads by G32, G92 and G76 (G code system A).

use super::action::{Action, Passes, Rotation, Threading};
use super::block::Block;
use super::codes::{Group, bit, letters};
use super::fault::{Done, refuse};
use super::out::Out;
use super::state::State;
use crate::control::Meaning;
use crate::diag::Code;
use crate::toolpath::Units;

/// Flank angles that G76 accepts, in degrees.
const FLANKS: [f64; 6] = [0.0, 29.0, 30.0, 55.0, 60.0, 80.0];
/// The maximum number of passes of a thread.
const MOST: u32 = 10_000;

/// Data of the first block of G76. The data is kept until another first block of G76.
#[derive(Clone, Copy, Debug, Default)]
pub struct FirstBlock {
    /// The number of times that the last pass is cut.
    last: u32,
    /// Smallest cut, on the radius.
    least: f64,
    /// Allowance for the last pass, on the radius.
    allowance: f64,
    /// Distance from the end of the thread at which the tool begins to move out, as a number of leads.
    pull_out: f64,
    /// The angle between the flanks in degrees.
    flanks: f64,
}

/// The state of threads and passes that a lathe keeps between blocks.
#[derive(Clone, Copy, Debug, Default)]
pub struct Threads {
    first: Option<FirstBlock>,
    /// The last pass of G90, G92 or G94.
    pass: Option<Pass>,
}

/// A pass of G90, G92 or G94. Later blocks need to contain only the words that change.
#[derive(Clone, Copy, Debug)]
struct Pass {
    /// The code of the pass: G90, G92 or G94.
    made_by: Meaning,
    /// End of the pass: radius and Z.
    end: [f64; 2],
    /// Radius at the start of the pass minus the radius at its end.
    taper: f64,
}

impl Threads {
    /// Deletes the stored pass at a code that is not a pass: another motion, or a code that takes effect only in its
    /// block. A dwell does not delete the stored pass.
    pub(super) fn end_passes(&mut self, by: Option<Meaning>) {
        let goes_on =
            matches!(by, None | Some(Meaning::Dwell | Meaning::TurnPass | Meaning::FacePass | Meaning::ThreadPass));
        if !goes_on {
            self.pass = None;
        }
    }
}

impl State {
    /// Runs a T word. The last two digits of the T word are the offset. The turret indexes at once.
    pub(super) fn turn_turret(&mut self, word: f64, out: &mut Out<'_>) {
        const STATIONS: f64 = 100.0;
        let offset = word % STATIONS;
        self.tool.length_on = offset != 0.0;
        if self.settings.places_unknown {
            self.place.becomes_unknown(0b111);
        }
        out.push(Action::Tool((word / STATIONS).trunc()));
        out.push(Action::Length(Some(offset).filter(|offset| *offset != 0.0)));
    }

    /// Converts a number of least increments to a length.
    pub(super) fn increments(&self, count: f64) -> f64 {
        count * if self.modes.units == Units::Inch { 1e-4 } else { 1e-3 }
    }

    /// Reads the first block of G76. P has pairs of digits for passes, chamfer and angle. Q is the smallest cut, R the
    /// allowance for the last pass.
    pub(super) fn first_block(&mut self, block: &Block) -> Done {
        let Some(packed) = block.get(b'P').filter(|p| (0.0..=999_999.0).contains(p) && p.fract() == 0.0) else {
            return refuse(Code::PN007, "the first block of G76 without P", "write P010060: passes, chamfer, angle");
        };
        // the control keeps Q and R of an earlier first block; without an earlier block, it takes them from its parameters
        let kept = self.threads.first;
        let least = block.get(b'Q').map(|least| self.increments(least)).or(kept.map(|first| first.least));
        let allowance = block.get(b'R').or(kept.map(|first| first.allowance));
        let (Some(least), Some(allowance)) = (least, allowance) else {
            let letter = if least.is_none() { "Q" } else { "R" };
            let message = format!("the first block of G76 without {letter}: the control takes it from a parameter");
            return refuse(Code::PN007, message, "write Q (the smallest cut) and R (the allowance), as Q100 R0.05");
        };
        if least < 0.0 || allowance < 0.0 {
            return refuse(Code::PN018, "a negative Q or R in the first block of G76", "write Q and R without a sign");
        }
        let flanks = packed % 100.0;
        if !FLANKS.contains(&flanks) {
            let message = format!("G76 with flanks of {flanks} degrees");
            return refuse(Code::PN018, message, "the last two digits of P must be 00, 29, 30, 55, 60 or 80");
        }
        self.threads.first = Some(FirstBlock {
            last: (packed / 10_000.0) as u32,
            least,
            allowance,
            pull_out: (packed / 100.0).trunc() % 100.0 / 10.0,
            flanks,
        });
        Ok(())
    }

    /// The taper of a pass: R, or I on some controls.
    fn taper(block: &Block) -> Done<Option<f64>> {
        match (block.get(b'R'), block.get(b'I')) {
            (Some(_), Some(_)) => refuse(Code::PN004, "R and I in one block: both are the taper", "write only R"),
            (r, i) => Ok(r.or(i)),
        }
    }

    /// Refuses an axis other than X and Z in the block of a cycle that makes several passes.
    pub(super) fn only_turns(&self, block: &Block) -> Done {
        match b"YVABC".iter().find(|letter| block.has(bit(**letter))) {
            Some(letter) => {
                let letter = char::from(*letter);
                let message = format!("{letter} in the block of a turning cycle, which moves only X and Z");
                refuse(Code::PN016, message, format!("write {letter} in a block before the cycle"))
            }
            None => Ok(()),
        }
    }

    /// The end and the taper of a pass, from the words of the block and the stored pass.
    pub(super) fn pass_end(&mut self, does: Meaning, block: &Block) -> Done<([f64; 6], f64)> {
        self.only_turns(block)?;
        let mut end = self.target(block)?;
        let says = [letters("XU"), letters("ZW")].map(|words| block.has(words));
        let taper = Self::taper(block)?;
        let code =
            block.row(Group::Motion).or(self.modes.motion).map_or("a pass".to_owned(), |row| row.code.to_string());
        let kept = self.threads.pass.filter(|pass| pass.made_by == does);
        for (at, name) in ["X", "Z"].into_iter().enumerate().filter(|(at, _)| !says[*at]) {
            let Some(kept) = kept else {
                let message = format!("{code} has no {name}, and there is no earlier pass of {code}");
                return refuse(Code::PN007, message, format!("write {name} in this block, or {}", ["U", "W"][at]));
            };
            end[2 * at] = kept.end[at];
            self.place.at_machine &= !(1 << (2 * at));
        }
        // if the code is written again, some controls keep the taper of the previous pass and others do not
        let before = self.threads.pass.map_or(0.0, |pass| pass.taper);
        if taper.is_none() && before != 0.0 && block.row(Group::Motion).is_some() {
            let message = format!("{code} is written again after a tapered pass, but without its taper");
            return refuse(Code::PN016, message, "write R in this block; R0. for no taper");
        }
        let taper = taper.unwrap_or(before);
        self.threads.pass = Some(Pass { made_by: does, end: [end[0], end[2]], taper });
        Ok((end, taper))
    }

    /// Makes the moves of a thread. G32 makes one cut that follows the spindle. G92 makes one pass with its retract.
    /// G76 makes all passes.
    pub(super) fn lathe_thread(&mut self, does: Meaning, block: &Block, out: &mut Out<'_>) -> Done {
        if self.drive.spindle == Rotation::Stop {
            return refuse(Code::PN012, "a thread with the spindle stopped", "write M3 or M4 before the thread");
        }
        if self.drive.feed <= 0.0 {
            return refuse(Code::PN008, "a thread without its lead", "write F in the block of the thread");
        }
        if self.tool.side.is_some() {
            return refuse(Code::PN013, "a thread under cutter compensation", "end the compensation with G40 first");
        }
        let lead = Some(self.drive.feed);
        let first = self.threads.first.filter(|_| does == Meaning::ThreadCycle);
        out.push(Action::Threading(Threading {
            // Q is in thousandths of a degree; in G76, Q is a depth
            start: block.get(b'Q').filter(|_| first.is_none()).map_or(0.0, |angle| (angle / 1e3).rem_euclid(360.0)),
            flanks: first.map_or(0.0, |first| first.flanks),
            pull_out: first.map_or(0.0, |first| first.pull_out),
        }));
        let (begin, unsaid) = (self.place.position, self.place.at_machine);
        if does == Meaning::Thread {
            if let Some(letter) = b"IKR".iter().find(|letter| block.get(**letter).is_some_and(|value| value != 0.0)) {
                let letter = char::from(*letter);
                let message = format!("{letter} in a thread of one cut, where the positions of X and Z give the taper");
                return refuse(Code::PN016, message, format!("remove the {letter}, and write X and Z of the end"));
            }
            let end = self.target(block)?;
            self.place.feed_to(end, self.drive.feed, lead, out);
            return Ok(());
        }
        let (end, taper) = match does {
            Meaning::ThreadPass => self.pass_end(does, block)?,
            _ => {
                self.begins_in_the_program("G76")?;
                self.only_turns(block)?;
                (self.target(block)?, Self::taper(block)?.unwrap_or(0.0))
            }
        };
        let mut ways = vec![end[0]];
        if does == Meaning::ThreadCycle {
            let (passes, list) = self.passes(begin, end, taper, block)?;
            out.push(Action::Passes(Box::new(passes)));
            ways = list;
        }
        // the block contains the radii and the end of each pass; the start position comes from earlier blocks
        let at_end = self.place.at_machine;
        let [radius_is_said, z_is_said] = [0b001, 0b100].map(|axis| unsaid & !axis | at_end & axis);
        out.by_cycle = true;
        for radius in ways {
            let mut to = begin;
            to[0] = radius + taper;
            self.place.at_machine = radius_is_said;
            self.place.rapid_to(to, out);
            (to[0], to[2]) = (radius, end[2]);
            self.place.feed_to(to, self.drive.feed, lead, out);
            to[0] = begin[0];
            self.place.at_machine = z_is_said;
            self.place.rapid_to(to, out);
            self.place.at_machine = unsaid;
            self.place.rapid_to(begin, out);
        }
        out.by_cycle = false;
        Ok(())
    }

    /// The thread of G76, and the radius at the end of each pass. The depth of the n-th pass is the depth of the first
    /// pass times the square root of n.
    fn passes(&self, begin: [f64; 6], end: [f64; 6], taper: f64, block: &Block) -> Done<(Passes, Vec<f64>)> {
        let Some(first) = self.threads.first else {
            return refuse(
                Code::PN007,
                "G76 without its first block",
                "write the first block before this block: G76 P010060 Q.. R..",
            );
        };
        let (Some(depth), Some(cut)) = (block.get(b'P'), block.get(b'Q')) else {
            return refuse(Code::PN007, "G76 without P or Q", "G76 X Z R P(depth) Q(first cut) F(lead)");
        };
        let (depth, cut) = (self.increments(depth), self.increments(cut));
        if depth <= 0.0 || cut <= 0.0 || block.has(letters("K")) {
            return refuse(
                Code::PN018,
                "P and Q of G76 must be above 0",
                "P is the depth and Q the first cut, both on the radius",
            );
        }
        // the direction of the infeed: -1 towards the axis of the spindle, 1 away from it
        let inward = if begin[0] >= end[0].max(end[0] + taper) { -1.0 } else { 1.0 };
        let crest = end[0] - inward * depth;
        let whole = depth - first.allowance;
        let mut list = Vec::new();
        let mut reached = 0.0f64;
        let mut count = 0u32;
        while reached < whole - 1e-9 {
            count += 1;
            if count > MOST {
                return refuse(Code::PN018, "a thread of more than 10000 passes", "write a larger Q");
            }
            reached = (cut * f64::from(count).sqrt()).max(reached + first.least).min(whole);
            list.push(crest + inward * reached);
        }
        let again = if first.allowance > 0.0 { first.last.max(1) } else { first.last.saturating_sub(1) };
        list.extend(std::iter::repeat_n(end[0], again.min(MOST) as usize));
        let thread = Passes {
            from: [crest + taper, begin[2]],
            to: [crest, end[2]],
            lead: self.drive.feed,
            depth: -inward * depth,
            first: cut,
            least: first.least,
            allowance: first.allowance,
            last: again,
            taper,
        };
        Ok((thread, list))
    }
}
