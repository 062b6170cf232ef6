//! Compares the moves of a canned cycle with the moves of the job's cycle. A cycle whose moves the job's cycle does not
//! make is refused, and the message names the argument.

use crate::control::{Code, Motions};
use crate::nc::action::{Action, Drilling, Rotation};

/// Heights, lengths, feeds and times that differ by less than this are equal.
const SAME: f64 = 1e-9;

/// A part of a program's cycle that the job's cycle does not have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Lost {
    /// A dwell between two strokes.
    DwellBetween,
    /// Another dwell at the bottom.
    DwellBelow,
    /// A stroke with another feed.
    StrokeFeed,
    /// Another feed out of the hole.
    FeedOut,
    /// A retract out of the hole between chip breaks.
    FullRetract,
    /// A chip break between retracts out of the hole.
    ChipBreak,
    /// A stroke that is shorter than the first one.
    ShorterStroke,
    /// A tap in several strokes.
    TapStrokes,
    /// Another spindle speed than the active one.
    Speed,
    /// Another spindle speed out of the hole.
    SpeedOut,
}

/// The letters of the cycles of Siemens and of Klartext in [`Drilling`].
const SIEMENS: u8 = b'c';
const KLARTEXT: u8 = b'q';

/// The arguments that cause a part of a cycle: the part, the cycle, and the names of the arguments.
const ARGUMENTS: [(Lost, u8, u16, &str); 24] = [
    (Lost::DwellBetween, SIEMENS, 83, "DTB, DTS"),
    (Lost::DwellBetween, KLARTEXT, 200, "Q210"),
    (Lost::DwellBetween, KLARTEXT, 203, "Q210"),
    (Lost::DwellBelow, SIEMENS, 84, "DTB"),
    (Lost::DwellBelow, SIEMENS, 840, "DTB"),
    (Lost::StrokeFeed, SIEMENS, 83, "FRF"),
    (Lost::FeedOut, SIEMENS, 85, "RFF"),
    (Lost::FeedOut, KLARTEXT, 201, "Q208"),
    (Lost::FeedOut, KLARTEXT, 203, "Q208"),
    (Lost::FeedOut, KLARTEXT, 205, "Q208"),
    (Lost::FullRetract, KLARTEXT, 203, "Q213"),
    (Lost::ChipBreak, KLARTEXT, 203, "Q213"),
    (Lost::ChipBreak, KLARTEXT, 205, "Q257"),
    (Lost::ShorterStroke, SIEMENS, 83, "DAM"),
    (Lost::ShorterStroke, KLARTEXT, 203, "Q212"),
    (Lost::ShorterStroke, KLARTEXT, 205, "Q212"),
    (Lost::TapStrokes, SIEMENS, 84, "VARI, DAM"),
    (Lost::TapStrokes, KLARTEXT, 209, "Q257"),
    (Lost::Speed, SIEMENS, 84, "SST"),
    (Lost::SpeedOut, SIEMENS, 84, "SST1"),
    (Lost::SpeedOut, KLARTEXT, 209, "Q403"),
    // on an Okuma
    (Lost::ChipBreak, b'G', 83, "I, J"),
    (Lost::FeedOut, b'G', 85, "FA"),
    (Lost::FeedOut, b'G', 89, "FA"),
];

impl Lost {
    /// What the cycle does.
    fn what(self) -> &'static str {
        match self {
            Lost::DwellBetween => "dwells between its strokes",
            Lost::DwellBelow => "dwells at the bottom of a tap",
            Lost::StrokeFeed => "has a stroke with another feed",
            Lost::FeedOut => "leaves the hole with another feed",
            Lost::FullRetract => "leaves the hole between two chip breaks",
            Lost::ChipBreak => "breaks chips between two retracts out of the hole",
            Lost::ShorterStroke => "makes strokes of different lengths",
            Lost::TapStrokes => "taps in several strokes",
            Lost::Speed => "taps with another spindle speed than the active one",
            Lost::SpeedOut => "leaves the hole with another spindle speed",
        }
    }

    /// The message for a cycle with this code.
    pub fn message(self, hole: &Drilling) -> String {
        let Code { letter, tenths } = hole.cycle.code;
        let is_own = |row: &&(Lost, u8, u16, &str)| (row.0, row.1, row.2 * 10) == (self, letter, tenths);
        let arguments = ARGUMENTS.iter().find(is_own).map_or(String::new(), |row| format!(" ({})", row.3));
        format!("{} {}{arguments}, and a job's cycle can't do this", hole.cycle.name(), self.what())
    }

    /// The text that the user should type instead.
    pub fn help(self) -> &'static str {
        match self {
            Lost::Speed => "write S with the speed of the tap before the cycle",
            _ => "write a cycle without it, or program the moves of the cycle",
        }
    }
}

/// The moves of a hole, compared one by one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moves {
    /// The hole.
    pub hole: Drilling,
    /// Height of the tool.
    height: f64,
    /// The greatest height since the last stroke.
    highest: f64,
    /// The depth that the strokes have reached; `None` before the first stroke.
    reached: Option<f64>,
}

impl Moves {
    /// The moves of a hole before the first one.
    pub fn of(hole: &Drilling) -> Moves {
        Moves { hole: *hole, height: f64::INFINITY, highest: f64::INFINITY, reached: None }
    }

    /// Compares the next action of the hole. `speed` is the active spindle speed.
    ///
    /// # Errors
    /// The job's cycle does not have this action.
    pub fn take(&mut self, action: &Action, speed: Option<f64>) -> Result<(), Lost> {
        match action {
            Action::Rapid { to, .. } => {
                self.comes_to(to[2]);
                Ok(())
            }
            Action::Feed { to, feed, .. } => self.feed(to[2], *feed),
            Action::Dwell(seconds) => self.dwell(*seconds),
            Action::Spindle(rotation, own) if *rotation != Rotation::Stop => self.turns(*own, speed),
            _ => Ok(()),
        }
    }

    fn taps(&self) -> bool {
        self.hole.cycle.motions.taps()
    }

    /// Whether the tool has been at the bottom.
    fn is_through(&self) -> bool {
        self.reached.is_some_and(|reached| reached <= self.hole.bottom + SAME)
    }

    fn comes_to(&mut self, height: f64) {
        self.height = height;
        self.highest = self.highest.max(height);
    }

    fn feed(&mut self, to: f64, feed: f64) -> Result<(), Lost> {
        let other = (feed - self.hole.feed).abs() > SAME * self.hole.feed.max(1.0);
        let down = to < self.height;
        let done = match (down, self.is_through()) {
            (true, _) => self.stroke(to, other),
            (false, true) if self.taps() && other => Err(Lost::SpeedOut),
            (false, true) if !self.taps() && (other || self.hole.cycle.motions != Motions::FeedOut) => {
                Err(Lost::FeedOut)
            }
            _ => Ok(()),
        };
        if down {
            (self.height, self.highest) = (to, to);
        } else {
            self.comes_to(to);
        }
        done
    }

    fn stroke(&mut self, to: f64, other: bool) -> Result<(), Lost> {
        let before = self.reached.replace(to);
        if other {
            return Err(Lost::StrokeFeed);
        }
        let Some(before) = before else { return Ok(()) };
        let Drilling { r, bottom, peck, .. } = self.hole;
        let full = self.highest >= r - SAME;
        match self.hole.cycle.motions {
            Motions::Tap | Motions::LeftTap if peck == 0.0 => Err(Lost::TapStrokes),
            Motions::Peck if !full => Err(Lost::ChipBreak),
            // a chip break may end at R above a first stroke that is short
            Motions::Chipbreak if full && r - before > peck + SAME => Err(Lost::FullRetract),
            Motions::Peck | Motions::Chipbreak if to > bottom + SAME && before - to < peck - SAME => {
                Err(Lost::ShorterStroke)
            }
            _ => Ok(()),
        }
    }

    fn dwell(&self, seconds: f64) -> Result<(), Lost> {
        // a dwell of a G code between strokes belongs to the control, as that of EMC2, and not to the program
        match self.height <= self.hole.bottom + SAME {
            true if (seconds - self.hole.dwell).abs() > SAME => Err(Lost::DwellBelow),
            false if self.hole.cycle.code.letter != b'G' => Err(Lost::DwellBetween),
            _ => Ok(()),
        }
    }

    fn turns(&self, own: f64, speed: Option<f64>) -> Result<(), Lost> {
        match speed {
            _ if !self.taps() => Ok(()),
            Some(speed) if (speed - own).abs() <= SAME * speed => Ok(()),
            _ if self.is_through() => Err(Lost::SpeedOut),
            _ => Err(Lost::Speed),
        }
    }
}
