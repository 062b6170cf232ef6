//! Proves a restart: after the entry, the new program must make the same motions as the old one.

use std::fmt::Write as _;

use super::entry::{Found, Switches};
use super::{Refused, refuse};
use crate::nc::{Action, Drilling, Item, RunError, RunSettings, Simulator, Standing};
use crate::toolpath::Plane;

/// Two positions are equal if they differ by at most this value. The value is in the program's units; positions are
/// written with six decimals.
const SAME: f64 = 2e-6;

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
    // if the program does not repeat X and Y after the entry, both programs must be at the same X and Y there
    let placed = across && found.entry.standing.unknown & 0b11 == 0;
    loop {
        let (one, other) = (old.next("the program")?, new.next("the new program")?);
        match (&one, &other) {
            (None, None) => break,
            (Some(one), Some(_)) if !placed && one.goes_down_unsaid() => {
                return refuse(
                    format!(
                        "at line {} the tool moves down, but the X and Y of the move are given only before the entry",
                        old.line()
                    ),
                    "begin at another line, so that X and Y are given between this line and the move down",
                );
            }
            (Some(one), Some(other)) if one.is_as(other) => moves += 1,
            _ => {
                let text = |seen: &Option<Seen>| seen.as_ref().map_or("it has ended".to_owned(), Seen::text);
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
                near(&turn.to, &own.to)
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
        // at a machine height the tool length has no effect
        let (mut on, own) = (self.switches.clone(), &other.switches);
        if self.is_at_machine_height() {
            on.length = own.length;
        }
        same && stands && on == *own
    }

    /// Whether the move goes down or cuts while X or Y (X or Z on a lathe) is at an unknown machine position.
    fn goes_down_unsaid(&self) -> bool {
        let across = |machine: u8| machine & if self.standing.plane == Plane::Xz { 0b101 } else { 0b011 } != 0;
        match &self.action {
            Action::Feed { machine, .. } => across(*machine),
            Action::Arc(turn) => across(turn.machine),
            Action::Rapid { machine, .. } => {
                self.standing.plane != Plane::Xz && machine & 0b100 == 0 && across(*machine)
            }
            _ => false,
        }
    }

    fn is_at_machine_height(&self) -> bool {
        match &self.action {
            Action::Rapid { machine, .. } | Action::Feed { machine, .. } => machine & 0b100 != 0,
            Action::Arc(turn) => turn.machine & 0b100 != 0,
            Action::Hole(_) => false,
            _ => true,
        }
    }

    fn text(&self) -> String {
        let mut text = match &self.action {
            Action::Rapid { to, .. } => format!("a rapid goes to {}", at(to)),
            Action::Feed { to, feed, .. } => format!("a cut goes to {} at F{feed}", at(to)),
            Action::Arc(turn) => format!("an arc goes to {} at F{}", at(&turn.to), turn.feed),
            Action::Hole(hole) => format!("{} drills at {}", hole.cycle.code, at(&hole.at)),
            Action::Tool(tool) => format!("it changes to T{tool}"),
            Action::Dwell(seconds) => format!("it waits {seconds} s"),
            Action::Stop(_) => "it stops".to_owned(),
            Action::Orient(angle) => format!("the spindle stops at {angle} degrees"),
            _ => "it ends".to_owned(),
        };
        let Standing { tool, speed, rotation, .. } = &self.standing;
        _ = write!(text, " with T{} and the spindle {} S{speed}", tool.unwrap_or(0.0), rotation.name());
        text
    }
}

fn at(to: &[f64; 6]) -> String {
    format!("X{} Y{} Z{}", to[0], to[1], to[2])
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
            self.switches.follow(&item.action, &self.run);
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
