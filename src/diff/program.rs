//! A program in memory: its bytes, and the positions of its lines.

use super::targets::Targets;

/// A program with an index of its lines.
#[derive(Clone, Debug, Default)]
pub struct Program {
    bytes: Vec<u8>,
    /// Start of each line in bytes, then the end of the last line.
    starts: Vec<u32>,
    targets: Targets,
}

/// The error for a program whose positions don't fit into 32 bits. The number is the size of the program in bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TooLarge(pub usize);

impl Program {
    /// Finds the lines of a program.
    ///
    /// # Errors
    /// The program is larger than four gigabytes.
    pub fn new(bytes: Vec<u8>) -> Result<Program, TooLarge> {
        if u32::try_from(bytes.len()).is_err() {
            return Err(TooLarge(bytes.len()));
        }
        let mut starts = vec![0];
        starts.extend(memchr::memchr_iter(b'\n', &bytes).map(|at| at as u32 + 1));
        if starts.last().is_some_and(|&last| (last as usize) < bytes.len()) {
            starts.push(bytes.len() as u32);
        }
        let targets = Targets::of(&bytes);
        Ok(Program { bytes, starts, targets })
    }

    /// The text of the program.
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// The block numbers to which blocks refer.
    pub(super) fn targets(&self) -> &Targets {
        &self.targets
    }

    /// The number of lines.
    pub fn len(&self) -> usize {
        self.starts.len() - 1
    }

    /// Whether the program is empty.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// A line with its line end. Lines are counted from 0.
    pub fn line(&self, number: usize) -> &[u8] {
        &self.bytes[self.starts[number] as usize..self.starts[number + 1] as usize]
    }

    /// A line without its line end.
    pub fn text(&self, number: usize) -> &[u8] {
        let line = self.line(number);
        let line = line.strip_suffix(b"\n").unwrap_or(line);
        line.strip_suffix(b"\r").unwrap_or(line)
    }
}
