//! Proves a restart: after the entry, the new program must make the same motions as the old one.

use std::fmt::Write as _;

use super::entry::{Entry, Found, Switches};
use super::{AXES, Refused, refuse};
use crate::nc::{Action, Drilling, Item, Position, ROTARY, RunError, RunSettings, Simulator, Standing};
use crate::toolpath::Plane;

/// Two positions are equal if they differ by at most this value. The value is in the program's units; positions are
/// written with six decimals.
const SAME: f64 = 2e-6;

/// X and Y, as bits.
const ACROSS: u8 = 0b11;

/// Runs both programs in parallel and returns the number of equal moves. `across`: whether the new program has moved to
/// the X and Y of the entry, as far as X and Y are known.
pub fn same(
    old: &[u8],
    new: &[u8],
    settings: RunSettings,
    found: &Found,
    (head_lines, across): (u64, bool),
) -> Result<u64, Refused> {
    let mut old = Side::new(super::run(old, settings), found.entry.line);
    let mut new = Side::new(super::run(new, settings), head_lines + 1);
    // run both programs up to the entry
    old.reach("the program")?;
    new.reach("the new program")?;
    let mut moves = 0;
    let open = open(&found.entry, across);
    loop {
        let (one, other) = (old.next("the program")?, new.next("the new program")?);
        match (&one, &other) {
            (None, None) => break,
            (Some(one), Some(_)) if one.goes_down_unsaid(open) != 0 => {
                return goes_down_unsaid(old.line(), one.goes_down_unsaid(open));
            }
            (Some(one), Some(other)) if one.is_as(other) => moves += 1,
            _ => {
                let apart = one.as_ref().zip(other.as_ref()).map_or(0, |(one, other)| one.apart(other));
                let text =
                    |seen: &Option<Seen>| seen.as_ref().map_or("it has ended".to_owned(), |seen| seen.text(apart));
                return refuse(
                    format!(
                        "the new program would not make the same moves: at line {} of the old program {}, in the new \
                         program {}",
                        old.line(),
                        text(&one),
                        text(&other)
                    ),
                    "begin at a tool change, or print the job again with `render --from-tool`",
                );
            }
        }
    }
    Ok(moves)
}

/// As bits, the axes whose positions at the entry the new program does not restore. If the program does not give them
/// after the entry, the tool must not move down.
fn open(entry: &Entry, across: bool) -> u8 {
    let unknown = entry.standing.unknown;
    let is_placed = across && unknown & ACROSS == 0;
    let turned = unknown & entry.turned & ROTARY;
    if is_placed { turned } else { turned | ACROSS }
}

/// Refuses a move down at an unknown position of these axes.
fn goes_down_unsaid<T>(line: u64, axes: u8) -> Result<T, Refused> {
    let turned = (3..6).find(|axis| axes & 1 << axis != 0).map(|axis| AXES[axis]);
    let (why, given) = match turned {
        None => ("the X and Y of the move are given only before the entry".to_owned(), "X and Y are".to_owned()),
        Some(axis) => {
            let why =
                format!("its angle {axis} is unknown: it was given as a machine position or in another work offset");
            (why, format!("{axis} is"))
        }
    };
    refuse(
        format!("at line {line} the tool moves down, but {why}"),
        format!("begin at another line, so that {given} given between this line and the move down"),
    )
}

/// A move or a stop, with the modal state at this move or stop.
#[derive(Debug)]
struct Seen {
    action: Action,
    standing: Standing,
    switches: Switches,
}

impl Seen {
    fn is_as(&self, other: &Seen) -> bool {
        let near = |one: &[f64], two: &[f64]| one.iter().zip(two).all(|(one, two)| (one - two).abs() <= SAME);
        let same = match (&self.action, &other.action) {
            (Action::Rapid { to, machine, .. }, Action::Rapid { to: own, machine: of_own, .. }) => {
                machine == of_own && near_known(to, own, *machine)
            }
            (
                Action::Feed { to, feed, lead, machine, .. },
                Action::Feed { to: own, feed: of_own, lead: own_lead, machine: own_machine, .. },
            ) => {
                near_known(to, own, *machine)
                    && machine == own_machine
                    && near(&[*feed], &[*of_own])
                    && lead == own_lead
            }
            (Action::Arc(turn), Action::Arc(own)) => {
                near_known(&turn.to, &own.to, turn.machine)
                    && turn.machine == own.machine
                    && near(&turn.center, &own.center)
                    && (turn.plane, turn.direction, turn.turns) == (own.plane, own.direction, own.turns)
                    && near(&[turn.feed], &[own.feed])
            }
            (Action::Hole(hole), Action::Hole(own)) => {
                let numbers = |of: &Drilling| {
                    let [x, y, z, a, b, c] = of.at;
                    [
                        x,
                        y,
                        z,
                        a,
                        b,
                        c,
                        of.r,
                        of.bottom,
                        of.clear,
                        of.dwell,
                        of.peck,
                        of.shift[0],
                        of.shift[1],
                        of.level,
                        of.feed,
                    ]
                };
                (hole.cycle, hole.plane, hole.heights) == (own.cycle, own.plane, own.heights)
                    && near(&numbers(hole), &numbers(own))
            }
            (one, two) => one == two,
        };
        let (one, two) = (&self.standing, &other.standing);
        // the spindle may be off before the first cut
        let cuts = matches!(self.action, Action::Feed { .. } | Action::Arc(_) | Action::Hole(_));
        let turns = !cuts || (one.rotation, one.speed) == (two.rotation, two.speed);
        let stands = (one.tool, one.work, one.units, one.plane, one.feed_mode, one.compensated)
            == (two.tool, two.work, two.units, two.plane, two.feed_mode, two.compensated)
            && turns;
        // at a machine height the tool length and the angle of the spindle have no effect
        let (mut on, own) = (self.switches.clone(), &other.switches);
        if self.is_at_machine_height() {
            (on.length, on.oriented) = (own.length, own.oriented);
        }
        same && stands && on == *own
    }

    /// As bits, those of the open axes that are at an unknown machine position while the move goes down or cuts. On a
    /// lathe, these are X and Z instead of X and Y.
    fn goes_down_unsaid(&self, open: u8) -> u8 {
        let is_turned = self.standing.plane == Plane::Xz;
        let open = if is_turned && open & ACROSS != 0 { open & ROTARY | 0b101 } else { open };
        match &self.action {
            Action::Feed { machine, .. } => machine & open,
            Action::Arc(turn) => turn.machine & open,
            Action::Rapid { machine, .. } if !is_turned && machine & 0b100 == 0 => machine & open,
            _ => 0,
        }
    }

    /// The end of the move, and as bits the axes whose end is a machine position.
    fn end(&self) -> Option<(&Position, u8)> {
        match &self.action {
            Action::Rapid { to, machine, .. } | Action::Feed { to, machine, .. } => Some((to, *machine)),
            Action::Arc(turn) => Some((&turn.to, turn.machine)),
            Action::Hole(hole) => Some((&hole.at, 0)),
            _ => None,
        }
    }

    /// As bits, the axes on which two moves end at different positions.
    fn apart(&self, other: &Seen) -> u8 {
        let Some(((to, machine), (own, of_own))) = self.end().zip(other.end()) else { return 0 };
        let differs = |axis: &usize| {
            (machine ^ of_own) & 1 << axis != 0
                || (machine | of_own) & 1 << axis == 0 && (to[*axis] - own[*axis]).abs() > SAME
        };
        (0..6).filter(differs).map(|axis| 1 << axis).sum()
    }

    fn is_at_machine_height(&self) -> bool {
        match &self.action {
            Action::Rapid { machine, .. } | Action::Feed { machine, .. } => machine & 0b100 != 0,
            Action::Arc(turn) => turn.machine & 0b100 != 0,
            Action::Hole(_) => false,
            _ => true,
        }
    }

    /// The move as text: X, Y and Z, and those of the axes `apart` that the move or the other move has.
    fn text(&self, apart: u8) -> String {
        let at = |to: &Position| at(to, self.end().map_or(0, |(_, machine)| machine), apart);
        let mut text = match &self.action {
            Action::Rapid { to, .. } => format!("a rapid goes to {}", at(to)),
            Action::Feed { to, feed, .. } => format!("a cut goes to {} at F{feed}", at(to)),
            Action::Arc(turn) => format!("an arc goes to {} at F{}", at(&turn.to), turn.feed),
            Action::Hole(hole) => format!("{} drills at {}", hole.cycle.code, at(&hole.at)),
            Action::Tool(tool) => format!("it changes to T{tool}"),
            Action::Dwell(seconds) => format!("it waits {seconds} s"),
            Action::Stop(_) => "it stops".to_owned(),
            Action::Orient(Some(angle)) => format!("the spindle stops at {angle} degrees"),
            Action::Orient(None) => "the spindle stops at the control's own angle".to_owned(),
            _ => "it ends".to_owned(),
        };
        let Standing { tool, speed, rotation, .. } = &self.standing;
        _ = write!(text, " with T{} and the spindle {} S{speed}", tool.unwrap_or(0.0), rotation.name());
        if let Some(angle) = self.switches.oriented {
            _ = write!(text, " at {angle} degrees");
        }
        text
    }
}

/// A position as text: X, Y and Z, and the angles that are in `axes`. Of the axes in `axes`, those that are also in
/// `machine` are at unknown positions.
fn at(to: &Position, machine: u8, axes: u8) -> String {
    let word = |axis: usize| match machine & axes & 1 << axis {
        0 => format!("{}{}", AXES[axis], to[axis]),
        _ => format!("an unknown {}", AXES[axis]),
    };
    let words: Vec<String> = (0..6).filter(|axis| (axes | 0b111) & 1 << axis != 0).map(word).collect();
    words.join(" ")
}

/// Whether two positions are equal. An axis is not compared if the program does not contain its position.
fn near_known(one: &[f64; 6], two: &[f64; 6], machine: u8) -> bool {
    (0..6).all(|axis| machine & 1 << axis != 0 || (one[axis] - two[axis]).abs() <= SAME)
}

/// One of the two programs, while it is run.
struct Side<'a> {
    run: Simulator<'a>,
    switches: Switches,
    begin: u64,
    waiting: std::collections::VecDeque<Seen>,
    items: Vec<Item>,
    over: bool,
}

impl<'a> Side<'a> {
    fn new(run: Simulator<'a>, begin: u64) -> Side<'a> {
        Side {
            run,
            switches: Switches::default(),
            begin,
            waiting: std::collections::VecDeque::new(),
            items: Vec::new(),
            over: false,
        }
    }

    fn line(&self) -> u64 {
        self.run.line()
    }

    /// Runs the blocks before the entry.
    fn reach(&mut self, what: &str) -> Result<(), Refused> {
        while !self.over && (self.run.depth() > 0 || self.run.next_line() < self.begin) {
            self.step(what)?;
        }
        self.waiting.clear();
        Ok(())
    }

    fn next(&mut self, what: &str) -> Result<Option<Seen>, Refused> {
        while self.waiting.is_empty() && !self.over {
            self.step(what)?;
        }
        Ok(self.waiting.pop_front())
    }

    fn step(&mut self, what: &str) -> Result<(), Refused> {
        self.items.clear();
        let more = match self.run.step(&mut self.items) {
            Ok(more) => more,
            Err(RunError::Io(error)) => return Err(error.into()),
            Err(RunError::Refused(diag, line)) => {
                let help = diag.help.unwrap_or_default();
                return refuse(format!("line {line} of {what} is refused: {}", diag.message), help);
            }
        };
        self.over = !more;
        for item in &self.items {
            self.switches.follow(&item.action);
            let counts = matches!(
                item.action,
                Action::Rapid { .. }
                    | Action::Feed { .. }
                    | Action::Arc(_)
                    | Action::Dwell(_)
                    | Action::Stop(_)
                    | Action::Tool(_)
                    | Action::Orient(_)
                    | Action::Hole(_)
                    | Action::End
            );
            if counts {
                let standing = self.run.state().standing();
                self.waiting.push_back(Seen { action: item.action.clone(), standing, switches: self.switches.clone() });
            }
        }
        Ok(())
    }
}
