//! Random jobs: right ones, as a CAM system could write them, with everything that a job can say.

mod cycles;
mod lathe;
mod mill;
mod pen;
mod rotary;
mod subprograms;
mod wire;

use serde_json::{Value, json};

use crate::random::Random;

/// What a job is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Three axes.
    Mill,
    /// With rotary angles.
    Rotary,
    /// With subprograms.
    Subprograms,
    /// A lathe.
    Lathe,
    /// Wire EDM.
    Wire,
}

impl Kind {
    /// All, with the names that the command line takes.
    pub const ALL: [(&'static str, Kind); 5] = [
        ("mill", Kind::Mill),
        ("rotary", Kind::Rotary),
        ("subprograms", Kind::Subprograms),
        ("lathe", Kind::Lathe),
        ("wire", Kind::Wire),
    ];

    /// Its name.
    pub fn name(self) -> &'static str {
        Kind::ALL.iter().find(|(_, kind)| *kind == self).map_or("", |(name, _)| name)
    }
}

/// What the form that will print a job takes.
#[derive(Clone, Copy, Debug, Default)]
pub struct Takes {
    /// Jobs in these units alone.
    pub inch: Option<bool>,
    /// Its own cycles, by number.
    pub customs: [bool; 3],
    /// Jobs that send the tool home.
    pub home: bool,
}

/// A job as a document: an object whose last key is its operations.
pub fn job(kind: Kind, takes: Takes, random: &mut Random) -> Value {
    let inch = random.once_in(2);
    let inch = takes.inch.unwrap_or(inch);
    let mut job = json!({
        "postform": 1,
        "program": 1 + random.below(8999),
        "units": if inch { "inch" } else { "mm" },
    });
    if random.once_in(3) {
        job["name"] = json!("PART 7");
    }
    match kind {
        Kind::Mill | Kind::Rotary | Kind::Subprograms => mill::fill(&mut job, kind, inch, takes, random),
        Kind::Lathe => lathe::fill(&mut job, inch, random),
        Kind::Wire => wire::fill(&mut job, inch, random),
    }
    job
}
