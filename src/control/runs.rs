//! Values that the simulator needs to run a code, besides its meaning: motions of a cycle, work offset, reference point.

use super::words::Words;

macro_rules! motions {
    ($($name:ident $text:literal $about:literal;)*) => {
        /// The motions of a canned cycle. Control files select the motions with the key `motions`. The key `motions`
        /// may be left out if `makes` contains a kind of hole that only one kind of motions can make.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Motions { $(#[doc = $about] $name),* }

        impl Motions {
            /// All motions.
            pub const ALL: &[Motions] = &[$(Motions::$name),*];

            /// The name in control files.
            pub const fn name(self) -> &'static str {
                match self { $(Motions::$name => $text),* }
            }

            /// A description of the motions.
            pub const fn about(self) -> &'static str {
                match self { $(Motions::$name => $about),* }
            }
        }
    };
}

motions! {
    Drill     "drill"     "Feeds in, retracts at rapid.";
    Peck      "peck"      "Feeds in by pecks, retracts out of the hole after each.";
    Chipbreak "chipbreak" "Feeds in by pecks, retracts a little after each.";
    Tap       "tap"       "Feeds in clockwise, turns back, feeds out.";
    LeftTap   "left-tap"  "Feeds in counter-clockwise, turns back, feeds out.";
    FeedOut   "feed-out"  "Feeds in and out.";
    StopOut   "stop-out"  "Feeds in, stops the spindle, retracts at rapid.";
    ShiftOut  "shift-out" "Feeds in, orients the spindle, moves off the wall, retracts at rapid.";
    Back      "back"      "Goes through the hole off its axis, cuts upwards from below.";
    ByHand    "by-hand"   "Feeds in, stops the spindle and the program; the operator retracts the tool.";
}

impl Motions {
    /// The motions with this name in control files.
    pub fn parse(name: &str) -> Option<Motions> {
        Motions::ALL.iter().copied().find(|motions| motions.name() == name)
    }

    /// Whether the tool moves sideways at the bottom. The distance of the sideways move is in Q, or in I and J; K is
    /// then not a number of repeats.
    pub const fn shifts(self) -> bool {
        matches!(self, Motions::ShiftOut | Motions::Back)
    }

    /// Whether the cycle drills in pecks.
    pub const fn pecks(self) -> bool {
        matches!(self, Motions::Peck | Motions::Chipbreak)
    }

    /// Whether the cycle taps.
    pub const fn taps(self) -> bool {
        matches!(self, Motions::Tap | Motions::LeftTap)
    }
}

/// The work offset that a code selects.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WorkOffset {
    /// One of the offsets G54 to G59.3. The offset is stored as its usual code in tenths: 540 for G54, 593 for G59.3.
    Usual(u16),
    /// One of the additional offsets, numbered from 1: G54.1 P1.
    Additional(u16),
    /// One of the additional offsets. The word with this letter contains the number of the offset.
    Word(u8),
    /// One of the offsets of a control that has only numbered offsets, from 1. The word with this letter contains the
    /// number of the offset.
    Counted(u8),
}

/// The codes of the usual work offsets, in order.
const USUAL: [u16; 9] = [540, 550, 560, 570, 580, 590, 591, 592, 593];

impl WorkOffset {
    /// The highest number of an additional offset.
    pub const MOST: u16 = 99;

    /// Reads `G54`, `G59.1`, `G54.1 P7`, or the letter of a word: `P`, or `number H` if all offsets are numbered from
    /// 1. `None`: the text does not name an offset.
    pub fn parse(text: &str) -> Option<WorkOffset> {
        if let [letter @ b'A'..=b'Z'] = text.as_bytes() {
            return Some(WorkOffset::Word(*letter));
        }
        if let Some([letter @ b'A'..=b'Z']) = text.strip_prefix("number ").map(str::as_bytes) {
            return Some(WorkOffset::Counted(*letter));
        }
        if let Some(number) = text.strip_prefix("G54.1 P") {
            let number = number.parse().ok().filter(|number| (1..=WorkOffset::MOST).contains(number))?;
            return Some(WorkOffset::Additional(number));
        }
        let code: super::Code = text.parse().ok()?;
        (code.letter == b'G' && USUAL.contains(&code.tenths)).then_some(WorkOffset::Usual(code.tenths))
    }

    /// The work offset that is `count` offsets after this offset; `None`: this work offset does not exist.
    pub fn after(self, count: u16) -> Option<WorkOffset> {
        match self {
            WorkOffset::Usual(code) => {
                let at = USUAL.iter().position(|usual| *usual == code)?;
                USUAL.get(at + usize::from(count)).map(|code| WorkOffset::Usual(*code))
            }
            WorkOffset::Additional(number) => {
                let number = number.checked_add(count).filter(|number| *number <= WorkOffset::MOST)?;
                Some(WorkOffset::Additional(number))
            }
            WorkOffset::Word(_) | WorkOffset::Counted(_) => Some(self),
        }
    }

    /// The number of the offset among G54 to G59.3, from 1. `None`: it is an additional offset.
    pub fn usual(self) -> Option<usize> {
        let WorkOffset::Usual(code) = self else { return None };
        USUAL.iter().position(|usual| *usual == code).map(|at| at + 1)
    }
}

/// The unit of the word for the pitch of a tap.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PitchUnit {
    /// The distance per revolution in the program's units; F is then the spindle speed in revolutions per minute.
    Turn,
    /// The distance per revolution in millimetres, only in programs in millimetres; S is the spindle speed.
    Mm,
    /// Threads per inch, only in programs in inches; S is the spindle speed.
    PerInch,
}

/// A word for the pitch of a tap.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pitch {
    /// Letter of the word.
    pub letter: u8,
    /// Unit of the word.
    pub unit: PitchUnit,
}

/// The moves of rotary axes that a code changes in a way that is not simulated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum StopsRotary {
    /// All moves.
    Moves,
    /// Feed moves.
    Feeds,
}

/// The values in a code's row that only the simulator uses.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Runs {
    /// The motions of a canned cycle.
    pub motions: Option<Motions>,
    /// The work offset that the code selects.
    pub work: Option<WorkOffset>,
    /// The number of the reference point: 1 for G28, 2 for G30.
    pub point: Option<u8>,
    /// The word of a tapping cycle for the spindle speed on the way out; L is then not a number of repeats.
    pub speed_out: Option<u8>,
    /// The tool that the code makes active, for a machine with a drill bank.
    pub tool: Option<u16>,
    /// Whether the axis words in a block with this code belong to a move. Used only for harmless G codes.
    pub beside_moves: bool,
    /// As bits, the axes along which a move by this code ends the tool length offset. The offset is active again after
    /// the next code or register of a tool length.
    pub ends_length: u8,
    /// Whether the active tool length may count in a move to a machine position by this code.
    pub may_keep_length: bool,
    /// The moves of rotary axes that are not run while the code is active.
    pub stops_rotary: Option<StopsRotary>,
    /// The code that this code ends.
    pub ends: Option<super::Code>,
    /// The words that give the angle at which the code stops the spindle.
    pub angle: Words,
    /// For a tapping cycle: whether the control synchronises feed and spindle. `None`: the code does not define it.
    pub rigid: Option<bool>,
    /// Whether cutter compensation uses no register: D is a diameter, or the diameter belongs to the tool.
    pub by_diameter: bool,
}

impl super::Row {
    /// Whether a canned cycle dwells at the bottom: true if the cycle has a P word.
    pub fn dwells(&self) -> bool {
        self.words.has(b'P')
    }

    /// The value that is missing in the control file and without which the code can't be run; `None`: nothing is
    /// missing.
    pub fn lacks(&self) -> Option<&'static str> {
        use super::Meaning as M;
        let runs = &self.runs;
        match self.meaning {
            M::Cycle if runs.motions.is_none() => Some("its motions: `motions = \"peck\"`"),
            M::Work if runs.work.is_none() => {
                Some("its work offset: `work = \"G54\"`, `\"G54.1 P1\"`, or the letter of its word, `\"P\"`")
            }
            M::ToolNumber if runs.tool.is_none() => Some("its tool: `tool = 5`"),
            M::Reference | M::SetReference if runs.point.is_none() => Some("its reference point: `point = 1`"),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn offsets_are_named_and_counted() {
        let parse = WorkOffset::parse;
        assert_eq!(parse("G54").and_then(|first| first.after(8)), Some(WorkOffset::Usual(593)));
        assert_eq!(parse("G59").and_then(WorkOffset::usual), Some(6));
        assert_eq!(parse("G54.1 P1").and_then(|first| first.after(19)), Some(WorkOffset::Additional(20)));
        assert_eq!([parse("G53"), parse("G54.1"), parse("G54.1 P0"), parse("G54.1 P100"), parse("p")], [None; 5]);
        assert_eq!(
            [parse("G54").and_then(|first| first.after(9)), parse("G54.1 P99").and_then(|last| last.after(1))],
            [None; 2]
        );
        assert_eq!([parse("P"), parse("number H")], [Some(WorkOffset::Word(b'P')), Some(WorkOffset::Counted(b'H'))]);
    }

    #[test]
    fn motions_have_names_of_their_own() {
        for motions in Motions::ALL {
            assert_eq!(Motions::parse(motions.name()), Some(*motions));
        }
    }
}
