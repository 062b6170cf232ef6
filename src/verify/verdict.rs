//! The outcome of a proof, and what it allowed.

use std::fmt;

use super::finding::Finding;
use crate::diag::Diag;
use crate::toolpath;

macro_rules! allowed {
    ($($name:ident $one:literal $how:literal $file:literal $about:literal;)*) => {
        /// What a program does otherwise than its job, and as well: how often.
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        pub struct Equivalences {
            $(#[doc = concat!($about, " Decided in `src/verify/", $file, "`.")] pub $name: u64),*
        }

        impl Equivalences {
            /// All equivalences, in the order of the docs: how often, of what (as `hole`), and how (as `with other
            /// pecks`).
            pub fn counts(&self) -> impl Iterator<Item = (u64, &'static str, &'static str)> {
                [$((self.$name, $one, $how)),*].into_iter()
            }

            /// All equivalences by name, in the order of the docs: how often.
            pub fn named(&self) -> impl Iterator<Item = (&'static str, u64)> {
                [$((stringify!($name), self.$name)),*].into_iter()
            }

            /// What each equivalence allows, in the order of the docs.
            pub const ABOUT: &'static [(&'static str, &'static str)] = &[$((stringify!($name), $about)),*];
        }
    };
}

// name, one of them, how it is otherwise, the one file that counts it, what is allowed
allowed! {
    pecks   "hole" "with other pecks" "holes.rs" "Holes whose pecks or retracts differ, and drilled holes made in pecks.";
    ways    "way" "in another order of axes or higher" "rapids.rs" "Ways that move the axes in another order, or higher.";
    tails   "tail" "that ends elsewhere" "rapids.rs" "Programs that go elsewhere after their last cut, and nowhere lower.";
    idle    "way" "to no cut otherwise" "rapids.rs" "Ways of a tool or in a work offset that cuts nothing: elsewhere, and nowhere lower.";
    arcs    "arc" "made of parts" "arcs.rs" "Arcs made of parts.";
    parts   "straight cut" "made of parts" "lines.rs" "Straight cuts made of parts.";
    short   "cut" "shorter than the tolerance left out or put in" "align.rs" "Cuts shorter than the tolerance that only one side has; of the program, than twice the tolerance.";
    outs    "hole" "left at feed farther up" "lines.rs" "Taps and reamed holes that are left at feed up to the return plane.";
    entries "cut" "left and entered again" "align.rs" "Cuts that were left and entered again where they go on.";
    slow    "rapid" "at feed that turn compensation on or off" "comparer.rs" "Feeds where the job has a rapid that turns compensation on or off.";
    dwells  "dwell" "of the form" "pauses.rs" "Dwells that the job does not have: outside cuts and holes, or one of up to 30 s in a cut after a spindle that stood was started, or with a torch or laser on.";
    stops   "stop" "of the form" "pauses.rs" "Stops outside cuts and holes that the job does not have.";
    pauses  "pause" "elsewhere on the way" "pauses.rs" "Stops and dwells of the job that the program makes elsewhere on the way; stops nowhere lower.";
    feeds   "feed" "of the form" "modal.rs" "Cuts at a feed that the form types, or makes of the job's: 0.2 to 2 times it.";
    speeds  "speed" "of the form" "modal.rs" "Cuts at a speed that the form types, or makes of the job's, as `S[min(speed,800)]`: 0.2 to 2 times it; never taps.";
    threads "thread" "with other passes" "threads.rs" "Threads whose passes differ: no coarser than the job's, to the same depth.";
    custom  "hole" "of a custom cycle" "comparer.rs" "Holes of custom cycles: the form's own moves along the axis of the hole, to the job's depth.";
}

/// The outcome.
#[derive(Clone, Debug, PartialEq)]
#[must_use]
#[non_exhaustive]
pub enum Verdict {
    /// The program makes the job's motions in the job's order.
    Identical,
    /// The program makes the job's cuts and holes, with other pecks or other ways between them.
    Equivalent(Equivalences),
    /// Nothing is known from somewhere on of what job or program do.
    NotProven(Box<Unproven>),
    /// Something else, or something dangerous.
    Different(Vec<Finding>),
}

/// What kind of reason there is that a program is not proven.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum UnprovenKind {
    /// From a block of the program or an item of the job on, what it does is unknown: [`Unproven::line`] and
    /// [`Unproven::place`] have it.
    #[default]
    Unknown,
    /// The form names no control and the caller gave none: the program was compared by the rules of an assumed one.
    ControlAssumed,
    /// The options asked for no proof.
    NotAsked,
}

/// Why nothing is proven.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Unproven {
    /// The kind of reason.
    pub kind: UnprovenKind,
    /// The reason, as `fanuc has no G201 that we know`.
    pub why: String,
    /// What to do about the reason.
    pub help: String,
    /// The program's line from which on nothing is proven, from 1; 0 where the job is the reason.
    pub line: u64,
    /// Block number as written, as `N120`; else empty.
    pub block: String,
    /// The item of the job from which on nothing is proven.
    pub place: Option<toolpath::Place>,
    /// What differs by the rules that were assumed.
    pub notes: Vec<Finding>,
    /// The program may be proven in a file, which can be gone back in.
    pub in_a_file: bool,
}

impl Unproven {
    /// From where on nothing is proven: ` from N120`, ` from line 7`, or empty where the job is the reason.
    pub fn from(&self) -> String {
        match (self.block.as_str(), self.line) {
            ("", 0) => String::new(),
            ("", line) => format!(" from line {line}"),
            (block, _) => format!(" from {block}"),
        }
    }
}

impl Verdict {
    /// The verdict where the control was only assumed: nothing is different by rules that may be another's.
    pub fn assumed(self, control: &str) -> Verdict {
        let (notes, would) = match self {
            Verdict::Different(findings) => (findings, "different"),
            Verdict::Identical => (Vec::new(), "identical"),
            Verdict::Equivalent(_) => (Vec::new(), "equivalent"),
            other => return other,
        };
        Verdict::NotProven(Box::new(Unproven {
            kind: UnprovenKind::ControlAssumed,
            why: format!("the form names no `Control`; by the rules of {control} the program is {would}"),
            help: "write `Control` into the form, or give --control".into(),
            notes,
            ..Unproven::default()
        }))
    }

    /// What it is about, as findings: what differs, or what is not proven. `program`: what the program is called.
    pub(crate) fn diags(&self, program: &str) -> Vec<Diag> {
        let found = match self {
            Verdict::Different(findings) => findings,
            Verdict::NotProven(unproven) => &unproven.notes,
            _ => return Vec::new(),
        };
        found.iter().map(|finding| finding.diag(program)).collect()
    }

    /// The verdict on a program that was not compared.
    pub(crate) fn not_asked_for() -> Verdict {
        let (why, help) = ("no proof was asked for".into(), "ask for one with the options".into());
        Verdict::NotProven(Box::new(Unproven { kind: UnprovenKind::NotAsked, why, help, ..Unproven::default() }))
    }

    /// In a word or two: `identical`, `equivalent`, `not proven`, `different`.
    pub fn name(&self) -> &'static str {
        match self {
            Verdict::Identical => "identical",
            Verdict::Equivalent(_) => "equivalent",
            Verdict::NotProven(_) => "not proven",
            Verdict::Different(_) => "different",
        }
    }

    /// Does the program do what its job asks for?
    pub fn is_proven(&self) -> bool {
        matches!(self, Verdict::Identical | Verdict::Equivalent(_))
    }
}

/// In a line: `equivalent: 4 holes with other pecks`.
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

/// `4 holes with other pecks, 1 tail that ends elsewhere`.
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
