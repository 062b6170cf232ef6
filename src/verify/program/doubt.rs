//! Reasons why a cut of the program can't be compared.

use crate::verify::passage::TOO_LONG;

/// The reason why a cut of the program can't be compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Doubt {
    /// The passage before the cut is too long to keep.
    TooLong,
    /// This line has an incremental move from an unknown position.
    Astray(u64),
    /// The feed move of this line ends at a position that is known only at the machine.
    Home(u64),
}

impl Doubt {
    /// The reason, the correction, and the line number in the program; 0 if no line is the reason.
    pub fn told(self) -> (&'static str, &'static str, u64) {
        match self {
            Doubt::TooLong => (TOO_LONG, "split the job", 0),
            Doubt::Astray(line) => (
                "an increment from an unknown machine position",
                "write the position under G90, or go there by G53",
                line,
            ),
            Doubt::Home(line) => (
                "a feed move goes to an unknown machine position",
                "write G0 with G53; the position of a probe touch is known only at the machine",
                line,
            ),
        }
    }
}
