//! Compares the motions of the machine in two programs. If different codes make the same motions, the programs are
//! equal.

use std::io::{Read, Seek};
use std::rc::Rc;

use super::cut::{ACROSS, Cut, DEPTH, Place, Rapid, State, number, over, same, shown};
use super::expectation::Expectation;
use super::folded::{begin_alike, hole, is_stroke, rounded_alike};
use super::in_order::InOrder;
use super::measured::Frames;
use super::passage::TOO_LONG;
use super::program::{Doubt, Program};
use super::program_cuts::{Names, differs, leads_otherwise};
use super::program_passages::{between, endings, frames_of_rapids, leaving, offsets_left, switching};
use super::rapid_path::{RapidPath, highest, turn_alike, turned_low};
use super::strokes::{lost, retracts_instead};
use super::tails::leaves_low;
use super::ways::{Compared, compare};
use crate::lang::Machine;
use crate::nc::{RunError, RunSettings};
use crate::toolpath::Units;

/// The first difference between the motions of two programs.
#[derive(Clone, Debug, PartialEq)]
pub struct MotionDifference {
    /// Description of the difference.
    pub message: String,
    /// The line number and text of the block in the old and in the new program; the line is 0 if the program has ended.
    pub blocks: [(u64, String); 2],
}

/// The result of comparing the motions of two programs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Motions {
    /// The first difference. The comparison ends at this difference.
    pub difference: Option<MotionDifference>,
    /// Number of paths between two cuts that differ, although the path of neither program is lower.
    pub ways: u64,
    /// Number of cuts before which the two programs have different codes that are not simulated.
    pub codes: u64,
    /// Number of holes with different pecks. Different pecks are allowed only if the programs are for different
    /// controls.
    pub pecks: u64,
    /// Number of retracts out of a hole by the new program where the old program only breaks the chips (G83 in place of
    /// G73).
    pub retracts: u64,
    /// Number of feeds that differ by rounding. Rounding differences of feeds are allowed only if the programs are for
    /// different controls.
    pub feeds: u64,
    /// Number of cuts compared.
    pub cuts: u64,
    /// Whether a compared block has a slash: the result is for one position of the switch for block delete.
    pub has_slash: bool,
}

/// The reason why motions can't be compared: program 0 (old) or 1 (new) can't be read, or the control of this program
/// refuses a block.
#[derive(Debug)]
pub struct NoMotion(pub usize, pub RunError);

/// Compares the motions of two programs, cut by cut. The programs may use different units, another order of words, or
/// canned cycles instead of single moves.
///
/// # Errors
/// One of the programs can't be run.
pub fn compare_motions(
    programs: [(impl Read + Seek, RunSettings); 2],
    units: Units,
    tolerance: f64,
) -> Result<Motions, NoMotion> {
    let [a, mut b] = programs.map(|(input, settings)| {
        let expectation = Expectation { tools: false, units_due: false, ..Expectation::default() };
        let mut program = Program::new(input, settings, &expectation);
        program.want(units);
        program.measure_rapids();
        program
    });
    b.share_tool_names(&a);
    let names = Names::of(a.control(), b.control());
    let ways = [RapidPath::default(), RapidPath::default()];
    let mut pair =
        Pair { a, b, names, tolerance, ways, before: [None, None], begun: None, motions: Motions::default() };
    pair.compare()?;
    Ok(Motions { has_slash: pair.a.has_slash() || pair.b.has_slash(), ..pair.motions })
}

/// Two programs that are compared.
struct Pair<'a> {
    /// The old program.
    a: Program<'a>,
    /// The new program.
    b: Program<'a>,
    names: Names,
    tolerance: f64,
    /// The rapids of both programs since the last cut.
    ways: [RapidPath; 2],
    /// The frames of both programs at the last cut.
    before: [Option<Rc<Frames>>; 2],
    /// The position where the first cut of the current hole began.
    begun: Option<Place>,
    motions: Motions,
}

impl Pair<'_> {
    fn compare(&mut self) -> Result<(), NoMotion> {
        loop {
            let x = self.a.run_to_cut().map_err(|error| NoMotion(0, error))?.cloned();
            let y = self.b.run_to_cut().map_err(|error| NoMotion(1, error))?.cloned();
            let programs = [&self.a, &self.b];
            if let Some(at) = programs.iter().position(|program| program.doubt() == Some(Doubt::TooLong)) {
                return Err(NoMotion(at, RunError::Io(std::io::Error::other(TOO_LONG))));
            }
            for (way, program) in self.ways.iter_mut().zip(programs) {
                way.set(Some(program.start()), &program.passage.rapids, self.tolerance);
                way.join(self.tolerance);
            }
            let [a, b] = programs.map(|program| (&program.passage.codes, &program.passage.words));
            self.motions.codes += u64::from(a != b);
            let message = match (&x, &y) {
                (Some(cut), Some(found)) => self.cut(cut, found)?,
                (Some(cut), None) => Some(format!("the new program ends before a cut to {}", end(cut))),
                (None, Some(cut)) => {
                    Some(format!("the new program cuts to {} after the end of the old program", end(cut)))
                }
                (None, None) => self.tail(),
            };
            if let Some(message) = message {
                let blocks = [block(&self.a, &x), block(&self.b, &y)];
                self.motions.difference = Some(MotionDifference { message, blocks });
                return Ok(());
            }
            if x.is_none() {
                return Ok(());
            }
        }
    }

    /// Compares a cut of each program, and everything between this cut and the cut before. Ends both cuts.
    fn cut(&mut self, cut: &Cut, found: &Cut) -> Result<Option<String>, NoMotion> {
        let (tolerance, names) = (self.tolerance, self.names);
        let way = self.way();
        self.motions.cuts += 1;
        let folds = names.by_order && begin_alike(cut, found, tolerance);
        let mut alike = found.clone();
        if folds {
            alike.what = cut.what;
        }
        if names.by_order && rounded_alike(cut.feed, found.feed) {
            self.motions.feeds += u64::from(found.feed != cut.feed);
            alike.feed = cut.feed;
        }
        if names.by_order && rounded_alike(cut.state.speed, found.state.speed) && cut.state.speed != found.state.speed {
            alike.state = State { speed: cut.state.speed, ..*found.state }.into();
        }
        let message = differs(cut, &alike, tolerance, names, &self.a)
            .or_else(|| between(&self.a, &self.b, names, tolerance))
            .or_else(|| switching(&self.a, &self.b, names))
            .or_else(|| self.frames(true))
            .or_else(|| leads_otherwise(way))
            .or_else(|| self.peck(cut, way));
        if message.is_some() {
            return Ok(message);
        }
        self.before = [&self.a, &self.b].map(|program| program.frames().cloned());
        if folds {
            return self.hole(cut, found);
        }
        self.a.take();
        self.b.take();
        Ok(None)
    }

    /// Compares the retracts between two cuts in one hole, and counts the other paths that differ. A program that leaves
    /// the hole clears the chips (G83). A program that stays in the hole only breaks the chips (G73).
    fn peck(&mut self, cut: &Cut, way: Compared) -> Option<String> {
        let tolerance = self.tolerance;
        let goes_on = |begun: &Place| {
            let stays = |way: &RapidPath| {
                way.corners.iter().all(|corner| corner.unknown == 0 && same(&corner.to, begun, ACROSS, tolerance))
            };
            same(&cut.from, begun, ACROSS, tolerance) && self.ways.iter().all(stays)
        };
        let begun = self.begun.filter(goes_on);
        let is_first = begun.is_none() && cut.end()[DEPTH] < cut.from[DEPTH];
        self.begun = begun.or(is_first.then_some(cut.from)).filter(|_| is_stroke(cut, tolerance));
        let comes_out =
            |begun: Place| self.ways.each_ref().map(|way| highest(&way.corners) >= begun[DEPTH] - tolerance);
        match begun.map(comes_out) {
            Some([true, false]) => {
                return Some(format!(
                    "between two pecks in the hole at {} the tool only breaks the chips, but in the old program it \
                     retracts out of the hole",
                    over(&cut.from)
                ));
            }
            Some([false, true]) => self.motions.retracts += 1,
            _ => self.motions.ways += u64::from(matches!(way, Compared::AsGood { .. })),
        }
        None
    }

    /// The rule for the rapids since the last cut, if the machine is not a mill.
    fn in_order(&self) -> Option<InOrder> {
        InOrder::of(match self.a.machine() {
            Machine::Lathe if self.b.machine() != Machine::Lathe => Machine::Mill,
            machine => machine,
        })
    }

    /// The first corner of the new path that is not on the old path, on a lathe or a wire EDM machine.
    fn astray(&self, rule: InOrder) -> Option<Rapid> {
        let known = self.ways.iter().all(|way| way.corners.first().is_none_or(|start| rule.is_known(start)));
        let [old, new] = self.ways.each_ref().map(|way| &way.corners[usize::from(!known)..]);
        let [wanted, is] = *rule.follows(old, new, self.tolerance).err()?;
        is.or(wanted)
    }

    /// Compares the rapids since the last cut. If the old path is lower, the paths are different.
    fn way(&mut self) -> Compared {
        let known = [&self.a, &self.b].iter().all(|program| program.start().unknown == 0);
        let [left, right] = &self.ways;
        if left.is(right, self.tolerance) && turn_alike(&left.corners, &right.corners) {
            return Compared::Same;
        }
        if let Some(rule) = self.in_order() {
            return self.astray(rule).map_or(Compared::AsGood { step_by_step: true }, Compared::Elsewhere);
        }
        let [left, right] = &mut self.ways;
        match compare(left, right, known, self.tolerance) {
            Compared::Same if known => turned_low(&right.corners, &left.corners, self.tolerance)
                .map_or(Compared::Same, |(to, axes)| Compared::Turned(to, axes)),
            Compared::AsGood { .. } => higher(compare(right, left, known, self.tolerance)),
            other => other,
        }
    }

    /// Compares the frames of the rapids since the last cut. `next`: whether the programs have reached a next cut.
    fn frames(&self, next: bool) -> Option<String> {
        frames_of_rapids(
            [&self.a, &self.b],
            self.before.each_ref().map(Option::as_deref),
            next,
            self.names,
            self.tolerance,
        )
    }

    /// Compares what both programs do after the last cut. The end of a program stops spindle and coolant anyway, so
    /// their codes are compared only at the cut.
    fn tail(&mut self) -> Option<String> {
        // check both directions, because a higher path after the last cut also counts as another motion
        let low = |a: usize, b: usize| {
            let (a, b) = (&self.ways[a], &self.ways[b]);
            leaves_low(a, b, self.tolerance).is_some() || turned_low(&a.corners, &b.corners, self.tolerance).is_some()
        };
        let same_way = self.ways[0].is(&self.ways[1], self.tolerance);
        let alike = same_way && turn_alike(&self.ways[0].corners, &self.ways[1].corners);
        self.motions.ways += u64::from(!same_way);
        let elsewhere =
            || !alike && self.in_order().map_or_else(|| low(0, 1) || low(1, 0), |rule| self.astray(rule).is_some());
        between(&self.a, &self.b, self.names, self.tolerance)
            .or_else(|| leaving(&self.a, &self.b, self.names))
            .or_else(|| self.frames(false))
            .or_else(|| elsewhere().then(|| "the path after the last cut is different".to_owned()))
            .or_else(|| endings(&self.a, &self.b))
            .or_else(|| offsets_left(&self.a, &self.b, self.names, self.tolerance))
    }

    /// Compares a hole that both programs make in other pecks, and ends the hole.
    fn hole(&mut self, cut: &Cut, found: &Cut) -> Result<Option<String>, NoMotion> {
        let before = hole(&mut self.a, cut, self.tolerance).map_err(|error| NoMotion(0, error))?;
        let now = hole(&mut self.b, found, self.tolerance).map_err(|error| NoMotion(1, error))?;
        let near = |a: f64, b: f64| (a - b).abs() <= self.tolerance;
        let [old, new] = [&before, &now].map(|drilled| drilled.strokes.deepest);
        if !near(old, new) {
            return Ok(Some(format!("a hole goes to Z{}, but to Z{} in the old program", number(new), number(old))));
        }
        if let Some(lost) = lost(&before.strokes, &now.strokes, true, self.tolerance).next() {
            return Ok(Some(format!("in the hole at {} {}", over(&cut.from), lost.text("the old program"))));
        }
        let alike =
            before.depths.len() == now.depths.len() && before.depths.iter().zip(&now.depths).all(|(a, b)| near(*a, *b));
        let [a, b] = [&before.strokes, &now.strokes];
        if retracts_instead(a, b) {
            self.motions.retracts += b.counts[1];
        } else {
            self.motions.pecks += u64::from(!alike || a.counts != b.counts);
        }
        Ok(None)
    }
}

/// Converts the result of the comparison of the old path with the new path. If the old path is lower, the paths are
/// different.
fn higher(other: Compared) -> Compared {
    match other {
        Compared::Lower(low) => Compared::Elsewhere(low.to),
        other => other,
    }
}

/// The line and the text of the block with a cut. Without a cut, the text of the last block of the program.
fn block(program: &Program<'_>, cut: &Option<Cut>) -> (u64, String) {
    cut.as_ref().map_or_else(|| (0, program.text()), |cut| (cut.line, program.text_of(cut.line)))
}

fn end(cut: &Cut) -> String {
    shown(&cut.end(), 0b111)
}
