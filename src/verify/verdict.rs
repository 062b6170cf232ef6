//! The result of a proof, and the equivalences that it allowed.

use std::fmt;

use super::finding::Finding;
use crate::diag::Diag;
use crate::toolpath;

macro_rules! allowed {
    ($($name:ident $one:literal $how:literal $file:literal $about:literal;)*) => {
        /// Equivalences: how often a program does something differently from its job and equally well.
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        pub struct Equivalences {
            $(#[doc = concat!($about, " Decided in `src/verify/", $file, "`.")] pub $name: u64),*
        }

        impl Equivalences {
            /// All equivalences, in the order of the docs: the count, the noun (such as `hole`), and the difference (such
            /// as `with other pecks`).
            pub fn counts(&self) -> impl Iterator<Item = (u64, &'static str, &'static str)> {
                [$((self.$name, $one, $how)),*].into_iter()
            }

            /// All equivalences with their names and counts, in the order of the docs.
            pub fn named(&self) -> impl Iterator<Item = (&'static str, u64)> {
                [$((stringify!($name), self.$name)),*].into_iter()
            }

            /// The name of each equivalence and what it allows, in the order of the docs.
            pub const ABOUT: &'static [(&'static str, &'static str)] = &[$((stringify!($name), $about)),*];
        }
    };
}

// columns: name, noun, difference, the one file that counts it, description
allowed! {
    pecks   "hole" "with other pecks" "holes.rs" "Holes with other pecks or retracts, and holes that the job drills in one stroke and the program in pecks.";
    ways    "path" "between cuts in another order of axes or higher" "rapids.rs" "Paths between cuts that move the axes in another order, or higher.";
    tails   "path" "after the last cut to another position" "rapids.rs" "Paths after the last cut that go to other positions, and nowhere lower.";
    idle    "path" "without a cut at other positions" "rapids.rs" "Paths of a tool that makes no cut, or in a work offset without a cut: to other positions, and nowhere lower.";
    arcs    "arc" "made of parts" "arcs.rs" "Arcs made of several lines or arcs.";
    parts   "straight cut" "made of parts" "lines.rs" "Straight cuts made of several moves.";
    short   "cut" "shorter than the tolerance left out or added" "align.rs" "Cuts that only one side has: in the job shorter than the tolerance, in the program shorter than twice the tolerance.";
    outs    "hole" "with a higher retract at feed" "lines.rs" "Taps and reamed holes whose retract is at feed as far as the return plane.";
    entries "cut" "interrupted and continued" "align.rs" "Cuts that are interrupted and continued at the same position.";
    slow    "rapid" "at feed to turn compensation on or off" "comparer.rs" "Feed moves instead of the job's rapids that turn compensation on or off.";
    dwells  "dwell" "added by the form" "pauses.rs" "Dwells that the job does not have: outside cuts and holes; or up to 30 s in a cut, after the start of a stopped spindle or with a torch or laser on.";
    stops   "stop" "added by the form" "pauses.rs" "Stops that the job does not have, outside cuts and holes.";
    pauses  "pause" "elsewhere between the same cuts" "pauses.rs" "Stops and dwells of the job that the program makes elsewhere between the same cuts; stops nowhere lower.";
    feeds   "feed" "set by the form" "modal.rs" "Cuts at a feed that the form contains, or computes from the job's feed: 0.2 to 2 times the job's feed.";
    speeds  "speed" "set by the form" "modal.rs" "Cuts at a speed that the form contains, or computes from the job's speed, as `S[min(speed,800)]`: 0.2 to 2 times the job's speed; never for taps.";
    threads "thread" "with other passes" "threads.rs" "Threads with other passes: no coarser than the job's, to the same depth.";
    custom  "hole" "of a custom cycle" "comparer.rs" "Holes of custom cycles: the form's own moves along the axis of the hole, to the job's depth.";
}

/// The result of a proof.
#[derive(Clone, Debug, PartialEq)]
#[must_use]
#[non_exhaustive]
pub enum Verdict {
    /// The program makes the job's motions in the job's order.
    Identical,
    /// The program makes the job's cuts and holes, with other pecks or other paths between them.
    Equivalent(Equivalences),
    /// From some point on, it is not known what the job or the program does.
    NotProven(Box<Unproven>),
    /// The program does something else, or something dangerous.
    Different(Vec<Finding>),
}

/// Kinds of reasons why a program is not proven.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum UnprovenKind {
    /// The effect of a block of the program or of an item of the job is unknown. [`Unproven::line`] and
    /// [`Unproven::place`] contain its location.
    #[default]
    Unknown,
    /// Neither the form nor the caller gave a control. The program was compared by the rules of an assumed control.
    ControlAssumed,
    /// The options requested no proof.
    NotAsked,
}

/// The reason why nothing is proven.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Unproven {
    /// The kind of reason.
    pub kind: UnprovenKind,
    /// The reason, such as `fanuc has no G201 that we know`.
    pub why: String,
    /// The correction for the reason.
    pub help: String,
    /// The program's line from which nothing is proven, from 1; 0 if the job is the reason.
    pub line: u64,
    /// Block number as written, such as `N120`; empty if there is none.
    pub block: String,
    /// The item of the job from which nothing is proven.
    pub place: Option<toolpath::Place>,
    /// Differences by the rules of the assumed control.
    pub notes: Vec<Finding>,
    /// Whether the program may be proven from a file, because a file can seek.
    pub in_a_file: bool,
}

impl Unproven {
    /// The location from which nothing is proven: ` from N120`, ` from line 7`, or empty if the job is the reason.
    pub fn from(&self) -> String {
        match (self.block.as_str(), self.line) {
            ("", 0) => String::new(),
            ("", line) => format!(" from line {line}"),
            (block, _) => format!(" from {block}"),
        }
    }
}

impl Verdict {
    /// The verdict for an assumed control. It is never different, because another control may be meant.
    pub fn assumed(self, control: &str) -> Verdict {
        let (notes, would) = match self {
            Verdict::Different(findings) => (findings, "different"),
            Verdict::Identical => (Vec::new(), "identical"),
            Verdict::Equivalent(_) => (Vec::new(), "equivalent"),
            other => return other,
        };
        Verdict::NotProven(Box::new(Unproven {
            kind: UnprovenKind::ControlAssumed,
            why: format!("the form has no `Control`; by the rules of {control} the program would be {would}"),
            help: "write `Control` into the form, or give --control".into(),
            notes,
            ..Unproven::default()
        }))
    }

    /// The differences, or the notes if the program is not proven, as findings. `program`: name of the program.
    pub(crate) fn diags(&self, program: &str) -> Vec<Diag> {
        let found = match self {
            Verdict::Different(findings) => findings,
            Verdict::NotProven(unproven) => &unproven.notes,
            _ => return Vec::new(),
        };
        found.iter().map(|finding| finding.diag(program)).collect()
    }

    /// The verdict for a program that was not compared.
    pub(crate) fn not_asked_for() -> Verdict {
        let (why, help) = ("no proof was requested".into(), "request a proof with the options".into());
        Verdict::NotProven(Box::new(Unproven { kind: UnprovenKind::NotAsked, why, help, ..Unproven::default() }))
    }

    /// The verdict in words: `identical`, `equivalent`, `not proven`, `different`.
    pub fn name(&self) -> &'static str {
        match self {
            Verdict::Identical => "identical",
            Verdict::Equivalent(_) => "equivalent",
            Verdict::NotProven(_) => "not proven",
            Verdict::Different(_) => "different",
        }
    }

    /// Whether the program is proven to do what its job requests.
    pub fn is_proven(&self) -> bool {
        matches!(self, Verdict::Identical | Verdict::Equivalent(_))
    }
}

/// One line: `equivalent: 4 holes with other pecks`.
impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Verdict::Identical => f.write_str("identical"),
            Verdict::Equivalent(other) => write!(f, "equivalent: {other}"),
            Verdict::NotProven(unproven) => write!(f, "not proven{}: {}", unproven.from(), unproven.why),
            Verdict::Different(findings) => {
                let (one, more) =
                    (findings.first().map_or("", |first| &first.message), findings.len().saturating_sub(1));
                let more = if more == 0 { String::new() } else { format!(" (and {more} more)") };
                write!(f, "different: {one}{more}")
            }
        }
    }
}

/// `4 holes with other pecks, 1 path after the last cut to another position`.
impl fmt::Display for Equivalences {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let met = self.counts().filter(|(number, ..)| *number > 0);
        for (i, (number, one, how)) in met.enumerate() {
            let (comma, s) = (if i > 0 { ", " } else { "" }, if number == 1 { "" } else { "s" });
            write!(f, "{comma}{number} {one}{s} {how}")?;
        }
        Ok(())
    }
}
