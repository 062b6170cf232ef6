//! What the simulator must know of a code besides its meaning: how a cycle moves, which offset, which reference point.

macro_rules! motions {
    ($($name:ident $text:literal $about:literal;)*) => {
        /// How a canned cycle moves. A control file names it by `motions`; where its `makes` allows one alone, that one holds.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Motions { $(#[doc = $about] $name),* }

        impl Motions {
            /// All of them.
            pub const ALL: &[Motions] = &[$(Motions::$name),*];

            /// As control files write it.
            pub const fn name(self) -> &'static str {
                match self { $(Motions::$name => $text),* }
            }

            /// What the tool does, in words.
            pub const fn about(self) -> &'static str {
                match self { $(Motions::$name => $about),* }
            }
        }
    };
}

motions! {
    Drill     "drill"     "Feeds in, goes out as a rapid.";
    Peck      "peck"      "Feeds in by pecks, comes out of the hole after each.";
    Chipbreak "chipbreak" "Feeds in by pecks, lifts a little after each.";
    Tap       "tap"       "Feeds in clockwise, turns back, feeds out.";
    LeftTap   "left-tap"  "Feeds in counter-clockwise, turns back, feeds out.";
    FeedOut   "feed-out"  "Feeds in and out.";
    StopOut   "stop-out"  "Feeds in, stops the spindle, goes out as a rapid.";
    ShiftOut  "shift-out" "Feeds in, stops at an angle, moves off the wall, goes out as a rapid.";
    Back      "back"      "Goes through the hole beside its axis, cuts upwards from below.";
    ByHand    "by-hand"   "Feeds in, stops the spindle and the program; the operator takes the tool out.";
}

impl Motions {
    /// The motions that control files name so.
    pub fn parse(name: &str) -> Option<Motions> {
        Motions::ALL.iter().copied().find(|motions| motions.name() == name)
    }

    /// Does the tool go aside at the bottom? Q, or I and J, say how far, and K is then no number of repeats.
    pub const fn shifts(self) -> bool {
        matches!(self, Motions::ShiftOut | Motions::Back)
    }

    /// Does it drill by pecks?
    pub const fn pecks(self) -> bool {
        matches!(self, Motions::Peck | Motions::Chipbreak)
    }

    /// Does it tap?
    pub const fn taps(self) -> bool {
        matches!(self, Motions::Tap | Motions::LeftTap)
    }
}

/// Which work offset a code selects.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WorkOffset {
    /// One of G54 to G59.3, by ten times its usual number: 540, 593.
    Usual(u16),
    /// An additional one, from 1: G54.1 P1.
    Additional(u16),
    /// An additional one, whose number the word of this letter says.
    Word(u8),
    /// The one of a number that the word of this letter says; they count from 1, and there are no others.
    Counted(u8),
}

/// The codes of the usual work offsets, in their order.
const USUAL: [u16; 9] = [540, 550, 560, 570, 580, 590, 591, 592, 593];

impl WorkOffset {
    /// Highest additional offset.
    pub const MOST: u16 = 99;

    /// `G54`, `G59.1`, `G54.1 P7`, or the letter of a word: `P`. or `number H` where they count from 1. `None`: it is none of them.
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

    /// The one that is so many after it; `None`: there are not so many.
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

    /// Its place among the usual ones, from 1. `None`: it is an additional one.
    pub fn usual(self) -> Option<usize> {
        let WorkOffset::Usual(code) = self else { return None };
        USUAL.iter().position(|usual| *usual == code).map(|at| at + 1)
    }
}

/// What the word of a tap's pitch counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PitchUnit {
    /// The distance of one turn in the program's units; F is then the turns a minute.
    Turn,
    /// The distance of one turn in millimetres, in programs in millimetres alone; S turns.
    Mm,
    /// Threads an inch, in programs in inches alone; S turns.
    PerInch,
}

/// A word that says the pitch of a tap.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pitch {
    /// Its letter.
    pub letter: u8,
    /// What it counts.
    pub unit: PitchUnit,
}

/// What a row says for the simulator alone.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Runs {
    /// How a canned cycle moves.
    pub motions: Option<Motions>,
    /// Which work offset the code selects.
    pub work: Option<WorkOffset>,
    /// Which reference point it means: 1 as G28, 2 as G30.
    pub point: Option<u8>,
    /// The word of a tap that says how fast the spindle turns on the way out; L is then no number of repeats.
    pub speed_out: Option<u8>,
    /// The tool that the code brings in: drills of a bank.
    pub tool: Option<u16>,
    /// A compensation names no register: D is a diameter, or the tool has its own.
    pub by_diameter: bool,
}

impl super::Row {
    /// Does a canned cycle dwell at the bottom? Where it takes P.
    pub fn dwells(&self) -> bool {
        self.words.has(b'P')
    }

    /// What its file must say so that it can be run; `None`: it says all.
    pub fn lacks(&self) -> Option<&'static str> {
        use super::Meaning as M;
        let runs = &self.runs;
        match self.meaning {
            M::Cycle if runs.motions.is_none() => Some("how it moves: `motions = \"peck\"`"),
            M::Work if runs.work.is_none() => {
                Some("which work offset: `work = \"G54\"`, `\"G54.1 P1\"`, or the letter of its word, `\"P\"`")
            }
            M::ToolNumber if runs.tool.is_none() => Some("which tool: `tool = 5`"),
            M::Reference | M::SetReference if runs.point.is_none() => Some("which reference point: `point = 1`"),
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
