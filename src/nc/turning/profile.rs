//! The profiles of turning cycles. A cycle finds its profile by block numbers and reads it in a trial run. The finish
//! runs the profile again.

use super::rough::{Move, Piece, Point, Profile, moves};
use crate::diag::Code;
use crate::nc::action::{Action, Item, Position, Turn};
use crate::nc::block::Block;
use crate::nc::codes::letters;
use crate::nc::fault::{Done, Fault, refuse};
use crate::nc::out::{Next, Out};
use crate::nc::profiled::{How, Profiled};
use crate::nc::scan::{Kind, tokens};
use crate::nc::simulator::{RunError, Simulator};
use crate::nc::way::{Frame, Spot};
use crate::toolpath::{Direction, Plane};

/// Location of a profile in the program.
#[derive(Clone, Copy, Debug)]
pub(in crate::nc) struct Found {
    /// The numbers of the first and last block.
    numbers: [f64; 2],
    /// Position in the input before the first block.
    begin: Spot,
    /// Position in the input after the last block.
    end: Spot,
}

impl Simulator<'_> {
    /// Makes a cycle that follows a profile. Call this function at the block of the cycle.
    pub(in crate::nc) fn follow_profile(&mut self, asked: Profiled, items: &mut Vec<Item>) -> Result<(), RunError> {
        let (back, text) = (self.at, self.line.clone());
        let start = *self.state.position();
        let found = self.profile(asked, back)?;
        if asked.how == How::Finish {
            self.line = text;
            let frame = Frame::Profile { back, end: found.end, start };
            if let Err(fault) = self.push(frame) {
                return Err(self.refused(fault));
            }
            return self.go(found.begin);
        }
        self.profiles.retain(|other| other.numbers != found.numbers);
        self.profiles.push(found);
        let profile = self.read_profile(&found, matches!(asked.how, How::Passes { .. }))?;
        let made = moves(&profile, [start[0], start[2]], &asked.how);
        // faults of the cycle are reported with the block of the cycle, not of the profile
        let after = std::mem::replace(&mut self.at, back);
        self.line = text;
        let made = made.map_err(|fault| self.refused(fault))?;
        let mut out = Out::new(items, back.line);
        let place = &mut self.state.place;
        let feed = self.state.drive.feed;
        let position = |[radius, z]: Point| {
            let mut to: Position = start;
            (to[0], to[2]) = (radius, z);
            to
        };
        for step in made {
            match step {
                Move::Rapid(to) => place.rapid_to(position(to), &mut out),
                Move::Cut(Piece { to, arc: None }) => place.feed_to(position(to), feed, None, &mut out),
                Move::Cut(Piece { to, arc: Some(([radius, z], ccw)) }) => {
                    place.position = position(to);
                    out.push(Action::Arc(Turn {
                        to: position(to),
                        center: [radius, start[1], z],
                        plane: Plane::Xz,
                        direction: if ccw { Direction::Ccw } else { Direction::Cw },
                        turns: 0,
                        feed,
                        machine: place.at_machine,
                    }));
                }
            }
        }
        self.at = after;
        self.state.modes.motion = None; // controls differ: last motion of the profile, or the one before it
        // the run continues after the profile
        self.go(found.end)
    }

    /// After the last block of a profile: moves to the start of the cycle, and continues after the block of the cycle.
    pub(in crate::nc) fn end_profile(&mut self, items: &mut Vec<Item>) -> Option<Spot> {
        let Some(&Frame::Profile { back, end, start }) = self.frames.last() else { return None };
        if self.at.byte < end.byte {
            return None;
        }
        self.frames.pop();
        self.state.modes.motion = None;
        self.state.place.rapid_to(start, &mut Out::new(items, back.line));
        Some(back)
    }

    /// Finds a profile: a profile that an earlier cycle has followed, or otherwise the profile after this block.
    fn profile(&mut self, asked: Profiled, after: Spot) -> Result<Found, RunError> {
        let numbers = [asked.first, asked.last];
        if asked.how == How::Finish
            && let Some(found) = self.profiles.iter().find(|found| found.numbers == numbers)
        {
            return Ok(*found);
        }
        let text = self.line.clone();
        let mut begin = None;
        let (mut before, mut end) = (self.at, None);
        while end.is_none() && self.read_line()? {
            let number = number_of(&self.line);
            if begin.is_none() && number == Some(asked.first) {
                begin = Some(before);
            }
            if begin.is_some() && number == Some(asked.last) {
                end = Some(self.at);
            }
            before = self.at;
        }
        self.go(after)?;
        self.line = text;
        let (Some(begin), Some(end)) = (begin, end) else {
            let which = if begin.is_none() { asked.first } else { asked.last };
            let message = format!("the profile's block N{which} does not follow this block");
            let help = match asked.how {
                How::Finish => {
                    "the profile of a finishing cycle comes after this cycle or an earlier cycle with the same P and Q"
                }
                _ => "write the block numbers of the first and the last block of the profile: P10 Q20",
            };
            let fault = Fault::new(Code::PN018, message, help);
            return Err(self.refused(fault));
        };
        Ok(Found { numbers, begin, end })
    }

    /// Reads the cuts of a profile by a trial run of its blocks. `in_passes`: the cycle is G71 or G72.
    fn read_profile(&mut self, found: &Found, in_passes: bool) -> Result<Profile, RunError> {
        self.go(found.begin)?;
        // the trial run uses copies of the state: only the finish changes the state itself
        let (mut aside, mut parameters) = (self.state.clone(), self.parameters.clone());
        let (mut items, mut reading) = (Vec::new(), Reading::default());
        while self.at.byte < found.end.byte && self.read_line()? {
            let read = self.block.read(&self.line, &mut parameters, &self.state.settings);
            let begins = reading.profile.is_none() && in_passes;
            let read = read.and_then(|()| if begins { is_first_kind(&self.block) } else { Ok(()) });
            let run = read.and_then(|()| match self.block.flow.take() {
                Some(_) => refuse(Code::PN016, "a jump or a call in a profile", "write the moves into the profile"),
                None => match aside.run(&mut self.block, self.at.line, &mut items)? {
                    Next::On => Ok(()),
                    _ => refuse(
                        Code::PN016,
                        "a profile may contain only moves",
                        "write this block before the turning cycle",
                    ),
                },
            });
            let taken = run.and_then(|()| items.drain(..).try_for_each(|item| reading.take(&item)));
            taken.map_err(|fault| self.refused(fault))?;
        }
        let Some(profile) = reading.profile else {
            let help = "P and Q are the block numbers of the first and the last block of the profile";
            return Err(self.refused(Fault::new(Code::PN018, "the profile has no move", help)));
        };
        Ok(profile)
    }
}

/// Refuses a profile whose first block moves along X and Z. A profile with this first block is of type II, for pockets.
fn is_first_kind(block: &Block) -> Done {
    if [letters("XU"), letters("ZW")].iter().all(|words| block.has(*words)) {
        let message = "the first block of the profile moves along X and Z: the cycle then cuts pockets, and each \
            control does this differently";
        return refuse(Code::PN016, message, "write only X in it for G71, only Z for G72");
    }
    Ok(())
}

/// The block number of a block.
fn number_of(line: &[u8]) -> Option<f64> {
    let mut words = tokens(line).filter(|token| !matches!(token.kind, Kind::Blank | Kind::Delete));
    match words.next()?.kind {
        Kind::Word(b'N', number) => Some(number.value),
        _ => None,
    }
}

/// A profile that is being read.
#[derive(Debug, Default)]
struct Reading {
    profile: Option<Profile>,
    /// Whether a rapid has already left the profile. No cut may follow this rapid.
    is_over: bool,
}

impl Reading {
    /// Handles an action of a block of the profile.
    fn take(&mut self, item: &Item) -> Done {
        let point = |to: &Position| [to[0], to[2]];
        let (to, arc, rapid) = match &item.action {
            Action::Rapid { to, .. } => (point(to), None, true),
            Action::Feed { to, lead: None, .. } => (point(to), None, false),
            Action::Arc(turn) if turn.plane == Plane::Xz && turn.turns == 0 => {
                let [radius, _, z] = turn.center;
                (point(&turn.to), Some(([radius, z], turn.direction == Direction::Ccw)), false)
            }
            Action::Comment(..)
            | Action::BlockDelete
            | Action::Compensation(_)
            | Action::Spindle(..)
            | Action::SurfaceSpeed(_)
            | Action::FeedMode(_) => return Ok(()),
            _ => {
                return refuse(
                    Code::PN016,
                    "a profile may contain only moves",
                    "write this block before the turning cycle",
                );
            }
        };
        match &mut self.profile {
            None if arc.is_none() => self.profile = Some(Profile { rapid, begin: to, pieces: Vec::new() }),
            None => return refuse(Code::PN016, "a profile begins with an arc", "begin the profile with G0 or G1"),
            Some(_) if rapid => self.is_over = true,
            Some(_) if self.is_over => {
                return refuse(Code::PN016, "a cut after a rapid inside a profile", "write G1 instead of the rapid");
            }
            Some(profile) => profile.pieces.push(Piece { to, arc }),
        }
        Ok(())
    }
}
