//! A program that begins in the middle of another one, with everything in force that is in force there.
//!
//! The new program has the head of the old one up to its first move or tool change, blocks that put in force what is in force at
//! the entry, a way in from above, and the rest of the old program as it is. It is then run beside the old one: from the entry on both do the
//! same, or there is no new program.

mod blocks;
mod entry;
mod follow;

use std::io::{self, Cursor, Read, Seek, SeekFrom};

pub use entry::Target;

use crate::control::Rules;
use crate::nc::RunSettings;

/// What is asked for.
#[derive(Clone, Debug)]
pub struct Asked {
    /// Where to begin.
    pub target: Target,
    /// Above this height nothing is in the way, in the program's units; where the control can't go up to the machine's zero.
    pub clear: Option<f64>,
    /// Begin with the very block that is asked for, though the tool stands in its cut there: it goes down at feed.
    pub exactly: bool,
}

/// The new program.
#[derive(Debug)]
pub struct Restarted {
    /// Its text.
    pub text: Vec<u8>,
    /// The line of the old program from which on it goes.
    pub line: u64,
    /// The line that was asked for.
    pub asked: u64,
    /// What the operator must know, a sentence each.
    pub notes: Vec<String>,
    /// Moves that are the same in both, from the entry on.
    pub moves: u64,
}

/// Why there is no new program.
#[derive(Debug)]
pub enum Refused {
    /// The program can't be read.
    Io(io::Error),
    /// A sentence, and what would do.
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

/// Largest program that is restarted, in bytes.
const LARGEST: u64 = 1 << 30;

/// Makes a program that begins where it is asked to.
///
/// # Errors
/// It can't be read, or there is no such place in it, or what is in force there can't be put in force again.
pub fn restart(mut program: impl Read + Seek, settings: RunSettings, asked: &Asked) -> Result<Restarted, Refused> {
    if !matches!(settings.control.rules(), Rules::Fanuc | Rules::Linuxcnc | Rules::Emc2 | Rules::Grbl) {
        let name = settings.control.name();
        return refuse(
            format!("programs of {name} are not restarted: their blocks are in a language of their own"),
            "print the job again from the tool on: `postform render JOB --form FORM --from-tool 3`",
        );
    }
    let size = program.seek(SeekFrom::End(0))?;
    if size > LARGEST {
        return refuse("the program is larger than 1 GB", "print the job again from the tool on");
    }
    program.seek(SeekFrom::Start(0))?;
    let mut text = Vec::new();
    program.read_to_end(&mut text)?;
    let settings = RunSettings { places_unknown: true, ..settings };
    let found = entry::find(&text, settings, asked)?;
    let made = |way: Way| -> Result<Restarted, Refused> {
        let (new, head_lines, notes) = blocks::program(&text, settings.control, &found, asked, way)?;
        let moves = follow::same(&text, &new, settings, &found, (head_lines, way.across))?;
        Ok(Restarted { text: new, line: found.entry.line, asked: found.asked, notes, moves })
    };
    // to a change of the tool the spindle stands, and the tool stays where it is; else only where the blocks after it count on it
    match found.entry.height {
        None => {
            let [first, ways @ ..] = [[false, false], [true, false], [false, true], [true, true]];
            let way = |[across, turning]: [bool; 2]| Way { across, turning };
            ways.into_iter().fold(made(way(first)), |tried, next| tried.or_else(|_| made(way(next))))
        }
        Some(_) => made(Way { across: true, turning: true }),
    }
}

/// How the tool comes to the entry.
#[derive(Clone, Copy, Debug)]
struct Way {
    /// It goes over the entry.
    across: bool,
    /// The spindle turns.
    turning: bool,
}

/// A run of a text.
fn run(text: &[u8], settings: RunSettings) -> crate::nc::Simulator<'_> {
    crate::nc::Simulator::new(Cursor::new(text), settings)
}
