//! Why nothing can be said of a cut of the program.

use crate::verify::passage::TOO_LONG;

/// Why nothing can be said of a cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Doubt {
    /// More lies before it than is held.
    TooLong,
    /// This line leads on by an increment from a position that is unknown.
    Astray(u64),
    /// The move of this line at feed ends at a position that only the machine knows.
    Home(u64),
}

impl Doubt {
    /// Why, what to do, and the program's line; 0: of no line.
    pub fn told(self) -> (&'static str, &'static str, u64) {
        match self {
            Doubt::TooLong => (TOO_LONG, "split the job", 0),
            Doubt::Astray(line) => (
                "an increment leads on from a position that only the machine knows",
                "write the position under G90, or go there by G53",
                line,
            ),
            Doubt::Home(line) => (
                "a move at feed goes to a position that only the machine knows",
                "write G0 with G53; what a probe touches is known at the machine alone",
                line,
            ),
        }
    }
}
