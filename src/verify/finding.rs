//! What comparing finds.

use crate::diag::Code;
use crate::toolpath;

/// A difference or hazard: where in the job and in the program.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// Row in the table of codes.
    pub code: Code,
    /// What differs, with both values.
    pub message: String,
    /// What to look at.
    pub help: &'static str,
    /// The job's item, where one is concerned.
    pub place: Option<toolpath::Place>,
    /// The program's line, from 1; 0 where it has none.
    pub line: u64,
    /// The line of the program as written.
    pub block: String,
    /// How often the difference was found, this time included: what follows from one cause is one finding.
    pub times: u64,
}

macro_rules! allowed {
    ($($name:ident $one:literal $how:literal $about:literal;)*) => {
        /// What a program does otherwise than its job, and as well: how often.
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        pub struct Equivalences { $(#[doc = $about] pub $name: u64),* }

        impl Equivalences {
            /// All equivalences, in the order of the docs: how often, of what (as `hole`), and how (as `with other
            /// pecks`).
            pub fn counts(&self) -> impl Iterator<Item = (u64, &'static str, &'static str)> {
                [$((self.$name, $one, $how)),*].into_iter()
            }

            /// What each equivalence allows, in the order of the docs.
            pub const ABOUT: &'static [(&'static str, &'static str)] = &[$((stringify!($name), $about)),*];
        }
    };
}

allowed! {
    pecks   "hole" "with other pecks" "Holes whose pecks or retracts differ.";
    ways    "way" "in another order of axes or higher" "Ways that move the axes in another order, or higher.";
    tails   "tail" "that ends elsewhere" "Programs that go elsewhere after their last cut, and nowhere lower.";
    arcs    "arc" "made of parts" "Arcs made of parts.";
    parts   "straight cut" "made of parts" "Straight cuts made of parts.";
    short   "cut" "shorter than the tolerance left out or put in" "Cuts shorter than the tolerance that only one side has.";
    outs    "hole" "left at feed farther up" "Taps and reamed holes that are left at feed up to the return plane.";
    entries "cut" "left and entered again" "Cuts that were left and entered again where they go on.";
    slow    "rapid" "at feed that turn compensation on or off" "Feeds where the job has a rapid that turns compensation on or off.";
    dwells  "dwell" "of the form" "Dwells outside cuts that the job does not have, as for a spindle to spin up.";
    stops   "stop" "of the form" "Stops outside cuts that the job does not have.";
    feeds   "feed" "of the form" "Cuts at a feed that the form types itself.";
    speeds  "speed" "of the form" "Cuts at a speed that the form types itself.";
    custom  "hole" "of a custom cycle" "Holes of custom cycles: the form's own moves along the axis of the hole, to the job's depth.";
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

/// Why nothing is proven.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Unproven {
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
}

impl Unproven {
    /// `not proven from N120: fanuc has no G201 that we know`, without its first two words.
    pub fn from(&self) -> String {
        match (self.block.as_str(), self.line) {
            ("", 0) => String::new(),
            ("", line) => format!("from line {line}: "),
            (block, _) => format!("from {block}: "),
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
            why: format!("the form names no control; by the rules of {control} it is {would}"),
            help: "write `Control` into the form, or give --control".into(),
            notes,
            ..Unproven::default()
        }))
    }

    /// Does the program do what its job asks for?
    pub fn is_proven(&self) -> bool {
        matches!(self, Verdict::Identical | Verdict::Equivalent(_))
    }
}
