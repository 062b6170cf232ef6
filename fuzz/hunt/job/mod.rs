//! Random jobs. They are correct, as a CAM system could write them, and use every feature of jobs.

mod beam;
mod cycles;
pub mod document;
mod lathe;
mod mill;
mod pen;
mod rotary;
mod statements;
mod subprograms;
mod wire;

use serde_json::{Value, json};

use crate::random::Random;

/// The machine or format of a job.
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
    /// A CL file with all words of CYCLE; the job is a list of lines.
    Statements,
    /// An NC program that another form printed; the job is a list of lines.
    Program,
    /// A FreeCAD document; the job is a list of commands for each operation.
    Document,
    /// A torch or a laser.
    Beam,
}

impl Kind {
    /// All kinds, with their names on the command line.
    pub const ALL: [(&'static str, Kind); 9] = [
        ("mill", Kind::Mill),
        ("rotary", Kind::Rotary),
        ("subprograms", Kind::Subprograms),
        ("lathe", Kind::Lathe),
        ("wire", Kind::Wire),
        ("cl", Kind::Statements),
        ("nc", Kind::Program),
        ("freecad", Kind::Document),
        ("beam", Kind::Beam),
    ];

    /// The name of the kind.
    pub fn name(self) -> &'static str {
        Kind::ALL.iter().find(|(_, kind)| *kind == self).map_or("", |(name, _)| name)
    }
}

/// The features of a job that the printing form supports.
#[derive(Clone, Copy, Debug, Default)]
pub struct Takes {
    /// For each custom cycle: whether the form has it.
    pub customs: [bool; 3],
    /// Whether the form can send the tool home.
    pub home: bool,
    /// Whether the text may contain comments and codes of a Fanuc.
    pub codes: bool,
    /// Whether the form has more than six work offsets.
    pub works: bool,
}

/// A random job as a document: an object whose last key is `operations`. The kind `Program` starts from a milling job.
pub fn job(kind: Kind, takes: Takes, random: &mut Random) -> Value {
    let inch = random.once_in(2);
    match kind {
        Kind::Statements => return statements::statements(inch, random),
        Kind::Document => return document::commands(random),
        _ => {}
    }
    let mut job = json!({
        "postform": 1,
        "program": 1 + random.below(8999),
        "units": if inch { "inch" } else { "mm" },
    });
    if random.once_in(3) {
        job["name"] = json!("PART 7");
    }
    match kind {
        Kind::Rotary | Kind::Subprograms => mill::fill(&mut job, kind, inch, takes, random),
        Kind::Lathe => lathe::fill(&mut job, inch, random),
        Kind::Wire => wire::fill(&mut job, inch, random),
        Kind::Beam => beam::fill(&mut job, inch, takes.works, random),
        _ => mill::fill(&mut job, Kind::Mill, inch, takes, random),
    }
    job
}
