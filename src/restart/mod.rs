//! Makes a program that begins in the middle of an old program, with the modal state that the old program has there.
//!
//! The new program has four parts: the head of the old program, blocks that restore the modal state at the entry, an
//! approach from above, and the unchanged rest of the old program. The old and the new program are run, and their
//! motions are compared. If their motions differ anywhere after the entry, no new program is returned.

mod blocks;
mod entry;
mod follow;
mod levels;

use std::io::{self, Cursor, Read, Seek, SeekFrom};

pub use entry::Target;

use crate::control::Rules;
use crate::nc::RunSettings;

/// The request for a restart.
#[derive(Clone, Debug)]
pub struct Asked {
    /// The location at which the program should begin.
    pub target: Target,
    /// A height above all obstacles, in the program's units, for a control that can't retract to machine zero.
    pub clear: Option<f64>,
    /// Whether the program must begin at the requested block itself, even in the middle of a cut. In the middle of a
    /// cut, the tool moves down at feed.
    pub exactly: bool,
}

/// The new program, and how it was made.
#[derive(Debug)]
pub struct Restarted {
    /// The text of the new program.
    pub text: Vec<u8>,
    /// The line of the old program at which the new program continues.
    pub line: u64,
    /// The requested line.
    pub asked: u64,
    /// Notes for the operator, one sentence each.
    pub notes: Vec<String>,
    /// Number of moves after the entry that are equal in both programs.
    pub moves: u64,
}

/// The reason why there is no new program.
#[derive(Debug)]
pub enum Refused {
    /// The program can't be read.
    Io(io::Error),
    /// A sentence with the reason, and a proposed solution.
    Why(String, String),
}

impl From<io::Error> for Refused {
    fn from(error: io::Error) -> Refused {
        Refused::Io(error)
    }
}

fn refuse<T>(why: impl Into<String>, help: impl Into<String>) -> Result<T, Refused> {
    Err(Refused::Why(why.into(), help.into()))
}

/// The letters of the axes of a position.
const AXES: [&str; 6] = ["X", "Y", "Z", "A", "B", "C"];

/// Maximum size of a program, in bytes.
const LARGEST: u64 = 1 << 30;

/// Makes a program that begins at the requested location.
///
/// # Errors
/// The program can't be read, the location does not exist, or the modal state there can't be restored.
pub fn restart(mut program: impl Read + Seek, settings: RunSettings, asked: &Asked) -> Result<Restarted, Refused> {
    if !matches!(settings.control.rules(), Rules::Fanuc | Rules::Linuxcnc | Rules::Emc2 | Rules::Grbl) {
        let name = settings.control.name();
        return refuse(
            format!("programs of {name} can't be restarted: they are not in G codes"),
            "print the job again from this tool on: `postform render JOB --form FORM --from-tool 3`",
        );
    }
    let size = program.seek(SeekFrom::End(0))?;
    if size > LARGEST {
        return refuse("the program is larger than 1 GB", "print the job again from this tool on");
    }
    program.seek(SeekFrom::Start(0))?;
    let mut text = Vec::new();
    program.read_to_end(&mut text)?;
    let settings = RunSettings { places_unknown: true, ..settings };
    let found = entry::find(&text, settings, asked)?;
    let made = |way: Way| -> Result<Restarted, Refused> {
        let (new, head_lines, mut notes) = blocks::program(&text, settings.control, &found, asked, way)?;
        notes.extend(entry::note_of_others(&text, &asked.target, found.asked));
        let moves = follow::same(&text, &new, settings, &found, (head_lines, way.across))?;
        Ok(Restarted { text: new, line: found.entry.line, asked: found.asked, notes, moves })
    };
    // before a tool change, four approaches are tried: no move and no spindle start, a move, a spindle start, both
    match found.entry.height {
        None => {
            let [first, ways @ ..] = [[false, false], [true, false], [false, true], [true, true]];
            let way = |[across, turning]: [bool; 2]| Way { across, turning };
            ways.into_iter().fold(made(way(first)), |tried, next| tried.or_else(|_| made(way(next))))
        }
        Some(_) => made(Way { across: true, turning: true }),
    }
}

/// The approach to the entry.
#[derive(Clone, Copy, Debug)]
struct Way {
    /// The tool moves to a position above the entry.
    across: bool,
    /// The spindle is started.
    turning: bool,
}

/// A simulator for a text. On a mill, the rotary axes are at unknown angles until the program gives them: after an
/// interruption, the table may be at any angle. The C axis of a lathe is its spindle.
fn run(text: &[u8], settings: RunSettings) -> crate::nc::Simulator<'_> {
    let mut run = crate::nc::Simulator::new(Cursor::new(text), settings);
    if !settings.control.is_lathe() {
        run.begin_turned();
    }
    run
}
