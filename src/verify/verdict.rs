//! The result of a proof, and the allowed differences that it counts.

use std::fmt;

use super::finding::Finding;
use crate::diag::Diag;
use crate::toolpath;

macro_rules! allowed {
    ($($name:ident $one:literal $how:literal $file:literal $about:literal;)*) => {
        /// Allowed differences (equivalences): how often a program differs from its job with an equally good result.
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        pub struct Equivalences {
            $(#[doc = concat!($about, " Decided in `src/verify/", $file, "`.")] pub $name: u64),*
        }

        impl Equivalences {
            /// All equivalences in the order of docs/verify.md: the count, the noun (such as `hole`), and the difference
            /// (such as `with other pecks`).
            pub fn counts(&self) -> impl Iterator<Item = (u64, &'static str, &'static str)> {
                [$((self.$name, $one, $how)),*].into_iter()
            }

            /// All equivalences with their names and counts, in the order of docs/verify.md.
            pub fn named(&self) -> impl Iterator<Item = (&'static str, u64)> {
                [$((stringify!($name), self.$name)),*].into_iter()
            }

            /// The name of each equivalence, and the difference that it allows, in the order of docs/verify.md.
            pub const ABOUT: &'static [(&'static str, &'static str)] = &[$((stringify!($name), $about)),*];
        }
    };
}

// columns: name, noun, difference, the only file that counts it, description
allowed! {
    pecks   "hole" "with other pecks" "holes.rs" "Holes with other pecks or retracts than in the job. Also holes that the job drills in one stroke, but the program drills in pecks.";
    retracts "hole" "with full retracts where the job only breaks the chips" "holes.rs" "Holes in which the tool retracts out of the hole (as with G83), but the pecks of the job only break the chips (as with G73).";
    taps    "tapping cut" "made rigidly where the job has a floating holder" "modal.rs" "Cuts of a rigid tap (the feed follows the spindle), where the job has a tap with a floating holder.";
    ways    "path" "between cuts with the axes in another order or at a greater height" "rapids.rs" "Paths between cuts that move the axes in another order than the job, or at a greater height.";
    tails   "path" "to another position after the last cut" "rapids.rs" "Paths after the last cut that go to other positions than in the job. These paths are at the greatest height of the job's path or higher.";
    idle    "path" "to other positions by a tool or in a work offset without cuts" "rapids.rs" "Paths to other positions than in the job, if the tool makes no cut, or if nothing is cut in the work offset. These paths are nowhere lower than the job's path.";
    arcs    "arc" "made of parts" "arcs.rs" "Arcs made of several lines or arcs.";
    parts   "straight cut" "made of parts" "lines.rs" "Straight cuts made of several moves.";
    short   "cut" "left out or added with a length near or below the tolerance" "align.rs" "Cuts of the job that are shorter than the tolerance and are missing in the program. Also cuts that are shorter than twice the tolerance and that only the program has.";
    outs    "hole" "with a higher retract at feed" "lines.rs" "Taps and reamed holes in which the retract at feed ends at the return plane, higher than in the job.";
    entries "cut" "interrupted and continued" "align.rs" "Cuts that the program interrupts and continues at the same position.";
    slow    "rapid" "made at feed to turn compensation on or off" "comparer.rs" "Moves at feed that turn compensation on or off, where the job has a rapid.";
    dwells  "dwell" "added by the form" "pauses.rs" "Dwells that the job does not have, if they are outside cuts and holes. In a cut, a dwell of up to 30 s is allowed after the spindle starts, or with a torch or laser on.";
    stops   "stop" "added by the form" "pauses.rs" "Stops that the job does not have, outside cuts and holes.";
    pauses  "pause" "at another position between the same cuts" "pauses.rs" "Stops and dwells of the job that the program makes at another position between the same cuts. The position of a stop is not lower than in the job.";
    feeds   "feed" "set by the form" "modal.rs" "Cuts at a feed that the form contains, or computes from the job's feed. The feed is 0.2 to 2 times the job's feed.";
    speeds  "speed" "set by the form" "modal.rs" "Cuts at a speed that the form contains, or computes from the job's speed, as `S[min(speed,800)]`. The speed is 0.2 to 2 times the job's speed. For taps, such a speed is not allowed.";
    threads "thread" "with other passes" "threads.rs" "Threads that are cut to the job's depth, but in other passes than in the job. No pass is deeper than 1.5 times the deepest pass of the job.";
    custom  "hole" "of a custom cycle" "comparer.rs" "Holes of custom cycles. The form's moves go along the axis of the hole to the job's depth.";
}

/// The result of a proof.
#[derive(Clone, Debug, PartialEq)]
#[must_use]
#[non_exhaustive]
pub enum Verdict {
    /// The program makes the job's motions in the job's order.
    Identical,
    /// The program makes the job's cuts and holes, with allowed differences such as other pecks or other paths.
    Equivalent(Equivalences),
    /// From some item of the job or block of the program on, the effect is unknown.
    NotProven(Box<Unproven>),
    /// The program differs from its job, or the program has a hazard.
    Different(Vec<Finding>),
}

/// Kinds of reasons why a program is not proven (`Verdict::NotProven`).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum UnprovenKind {
    /// The effect of a block of the program or of an item of the job is unknown. [`Unproven::line`] or
    /// [`Unproven::place`] gives the location of the block or item.
    #[default]
    Unknown,
    /// Neither the form nor the caller named a control. The program was compared by the rules of an assumed control.
    ControlAssumed,
    /// The options requested no proof.
    NotAsked,
}

/// The reason why a program is not proven.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Unproven {
    /// The kind of reason.
    pub kind: UnprovenKind,
    /// The reason, such as `G201 is unknown for fanuc`.
    pub why: String,
    /// What the user can do so that the program is proven.
    pub help: String,
    /// The line number of the program after which nothing is proven, from 1; 0 if the reason is in the job.
    pub line: u64,
    /// Block number as written, such as `N120`; empty if there is none.
    pub block: String,
    /// The item of the job after which nothing is proven.
    pub place: Option<toolpath::Place>,
    /// The differences that were found by the rules of the assumed control.
    pub notes: Vec<Finding>,
    /// Whether the program could be proven if it were read from a file, because a file can be read again from an
    /// earlier position.
    pub in_a_file: bool,
}

impl Unproven {
    /// The location after which nothing is proven: ` from N120`, ` from line 7`, or empty if the job is the reason.
    pub fn from(&self) -> String {
        match (self.block.as_str(), self.line) {
            ("", 0) => String::new(),
            ("", line) => format!(" from line {line}"),
            (block, _) => format!(" from {block}"),
        }
    }
}

impl Verdict {
    /// The verdict under an assumed control. This verdict is never `Different`, because the user may mean another
    /// control.
    pub fn assumed(self, control: &str) -> Verdict {
        let (notes, would) = match self {
            Verdict::Different(findings) => (findings, "different"),
            Verdict::Identical => (Vec::new(), "identical"),
            Verdict::Equivalent(_) => (Vec::new(), "equivalent"),
            other => return other,
        };
        Verdict::NotProven(Box::new(Unproven {
            kind: UnprovenKind::ControlAssumed,
            why: format!("the form has no `Control`; if the control is {control}, the program is {would}"),
            help: "write `Control` into the form, or give --control".into(),
            notes,
            ..Unproven::default()
        }))
    }

    /// The differences as messages; if the program is not proven, the notes. `program`: name of the program.
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
        let (why, help) = ("no proof was requested".into(), "set `proof` in the options".into());
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

    /// Whether the program is proven: identical or equivalent.
    pub fn is_proven(&self) -> bool {
        matches!(self, Verdict::Identical | Verdict::Equivalent(_))
    }
}

/// Prints one line, such as `equivalent: 4 holes with other pecks`.
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

/// Prints the counts, such as `4 holes with other pecks, 1 path to another position after the last cut`.
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
