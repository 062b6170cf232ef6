//! Runs a program block by block: reads lines, follows subprograms and loops, and returns the actions of the machine.

use std::collections::HashMap;
use std::io::{self, BufRead, BufReader, Read, Seek, SeekFrom};

use super::action::{Item, Rotation};
use super::block::Block;
use super::fault::{Done, Fault, refuse};
use super::foreign::{Foreign, foreign, turned};
use super::languages::klartext::Klartext;
use super::languages::osp::Osp;
use super::languages::siemens::Siemens;
use super::out::Next;
use super::parameters::Parameters;
use super::settings::RunSettings;
use super::state::State;
use super::turning::profile;
use super::way::{Frame, Jump, Spot};
use crate::control::Rules;
use crate::diag::{Code, Diag};

/// Maximum length of a line on any control, in bytes.
const LONGEST: usize = 1 << 16;

/// Maximum number of actions from subprograms, loops and long blocks. A program with more actions is refused.
const MOST_REPEATED: u64 = 20_000_000;

/// The reason why a program was not run to its end.
#[derive(Debug)]
pub enum RunError {
    /// The program can't be read.
    Io(io::Error),
    /// The control refuses a block. The number is the line of this block.
    Refused(Box<Diag>, u64),
}

impl From<io::Error> for RunError {
    fn from(error: io::Error) -> Self {
        RunError::Io(error)
    }
}

/// The input of a program. Lines are read in sequence, and jumps seek.
pub(super) trait Input: Read + Seek {}

impl<T: Read + Seek> Input for T {}

impl std::fmt::Debug for dyn Input + '_ {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Input")
    }
}

/// The number of bytes that are read at once.
const BUFFER: usize = 128 << 10;

/// Runs a program. The input is a trait object, so the simulator is compiled only once for all kinds of input. The
/// simulator buffers the input itself.
///
/// Memory use does not grow with the program: one line is read at a time, and jumps seek in the input.
#[derive(Debug)]
pub struct Simulator<'a> {
    pub(super) input: BufReader<Box<dyn Input + 'a>>,
    pub(super) state: State,
    pub(super) parameters: Parameters,
    pub(super) block: Block,
    /// The block that was read ahead. Only `Block::read_plain` writes to it.
    pub(super) ahead: Block,
    pub(super) line: Vec<u8>,
    /// Position in the input after the current line.
    pub(super) at: Spot,
    /// Number of the line that was run last.
    pub(super) ran: u64,
    pub(super) frames: Vec<Frame>,
    /// Positions after the first line of each subprogram, by O number or name.
    pub(super) labels: HashMap<String, Spot>,
    /// Whether the rest of the input has been searched for labels.
    pub(super) searched: bool,
    /// Profiles that a roughing cycle has followed. These profiles are stored for the finish.
    pub(super) profiles: Vec<profile::Found>,
    /// The first O number of the program.
    pub(super) program: Option<f64>,
    percent: bool,
    /// The first block with a slash, until its warning is taken: its line and text.
    pub(super) slash: Option<(u64, Vec<u8>)>,
    /// Whether the program has had a block with a slash.
    pub(super) has_slash: bool,
    pub(super) over: bool,
    /// Whether the program ended with M99. The control would start the program again.
    pub(super) again: bool,
    pub(super) jumps: u64,
    /// The highest line that was read before a jump. A jump back reads lines again only up to this line.
    pub(super) farthest: u64,
    /// Number of actions from subprograms, loops and long blocks.
    repeated: u64,
    /// Whether the current block has further actions.
    pub(super) unfinished: bool,
    pub(super) blocks: u64,
    /// Whether any block so far had words.
    pub(super) words: bool,
    /// State of a Siemens program.
    pub(super) siemens: Box<Siemens>,
    /// State of a Klartext program.
    pub(super) klartext: Box<Klartext>,
    /// State of an Okuma program.
    pub(super) osp: Box<Osp>,
    /// Whether the input has ended, so that nothing more can be run.
    pub(super) ended: bool,
    /// Whether the first block has been read, or is being read.
    pub(super) begun: bool,
    /// Number of O words to skip before the first block.
    pub(super) passing: usize,
    /// The warnings so far, each with its code and its text without the block.
    pub(super) warnings: Vec<((Code, &'static str), Diag)>,
}

impl<'a> Simulator<'a> {
    /// A simulator at the beginning of a program.
    pub fn new(input: impl Read + Seek + 'a, settings: RunSettings) -> Simulator<'a> {
        Simulator::of(BufReader::with_capacity(BUFFER, Box::new(input)), settings)
    }

    fn of(input: BufReader<Box<dyn Input + 'a>>, settings: RunSettings) -> Simulator<'a> {
        Simulator {
            input,
            state: State::new(settings),
            parameters: Parameters::new(settings.control),
            block: Block::default(),
            ahead: Block::default(),
            line: Vec::new(),
            at: Spot { byte: 0, line: 0 },
            ran: 0,
            frames: Vec::new(),
            labels: HashMap::new(),
            searched: false,
            profiles: Vec::new(),
            program: None,
            percent: false,
            slash: None,
            has_slash: false,
            over: false,
            again: false,
            jumps: 0,
            farthest: 0,
            repeated: 0,
            unfinished: false,
            blocks: 0,
            words: false,
            siemens: Box::default(),
            klartext: Box::default(),
            osp: Box::default(),
            ended: false,
            begun: false,
            passing: 0,
            warnings: Vec::new(),
        }
    }

    /// The state of the control.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// The text of the block that was run last.
    pub fn text(&self) -> &[u8] {
        &self.line
    }

    /// The text of the line that was run last. Take the text before the next step. `None`: the line has more actions.
    #[inline]
    pub fn text_to_keep(&mut self) -> Option<&mut Vec<u8>> {
        if self.unfinished { None } else { Some(&mut self.line) }
    }

    /// Number of the line that was run last.
    pub fn line(&self) -> u64 {
        self.ran
    }

    /// Whether the program ended with M99. The control would start the program again.
    pub fn begins_again(&self) -> bool {
        self.again
    }

    /// The program's number, if it has one.
    pub fn program(&self) -> Option<f64> {
        self.program
    }

    /// Starts again at the beginning of the program, in the power-up state.
    ///
    /// # Errors
    /// The input can't seek.
    pub fn again(self) -> io::Result<Simulator<'a>> {
        let settings = self.state.settings;
        self.again_with(settings)
    }

    /// Starts again at the beginning of the program, with other settings.
    ///
    /// # Errors
    /// The input can't seek.
    pub fn again_with(mut self, settings: RunSettings) -> io::Result<Simulator<'a>> {
        self.input.seek(SeekFrom::Start(0))?;
        Ok(Simulator::of(self.input, settings))
    }

    /// Number of blocks that have been run so far.
    pub fn blocks(&self) -> u64 {
        self.blocks
    }

    /// Runs the next line and adds its actions to `items`. Returns `false` when the program has ended. If a line has
    /// more than some thousand actions, they are returned in several steps.
    ///
    /// # Errors
    /// The input can't be read, or the control refuses the block. `items` then contains the actions before the refusal.
    #[inline]
    pub fn step(&mut self, items: &mut Vec<Item>) -> Result<bool, RunError> {
        if self.over {
            return Ok(false);
        }
        if !self.begun {
            self.begin()?;
        }
        if !self.unfinished && !self.read_lines()? {
            return self.at_end().map_err(|fault| self.refused(fault));
        }
        let behind = self.at;
        self.ran = behind.line;
        let stepped = self.line_step(items);
        self.place_warnings();
        let jump = match stepped {
            Ok(Jump::On) => return Ok(true),
            Ok(Jump::End) => {
                self.over = true;
                return self.check_after_end().map(|()| false);
            }
            Ok(Jump::To(spot)) => self.go(spot),
            Ok(Jump::Find(label, times)) => self.find(label, times),
            Ok(Jump::Skip(label, ends)) => self.skip(&label, ends),
            Ok(Jump::Profile(asked)) => self.follow_profile(asked, items),
            Ok(Jump::Search(search)) => self.search(search),
            Err(fault) => Err(self.refused(fault)),
        };
        if let Err(error) = jump {
            // after a failed search, the run continues with the block after this one
            self.input.seek(SeekFrom::Start(behind.byte))?;
            self.at = behind;
            return Err(error);
        }
        Ok(true)
    }

    /// Skips a refused block, as an operator could do. Returns `false` if the program has no further block.
    pub fn pass_over(&mut self) -> bool {
        if self.ended {
            return false;
        }
        (self.over, self.unfinished) = (false, false);
        self.block.settings.clear();
        self.state.gives_up_block();
        true
    }

    /// Checks the language of the program, and skips the programs before the main one.
    #[cold]
    fn begin(&mut self) -> Result<(), RunError> {
        self.begun = true;
        self.check_language()?;
        if self.passing > 0 {
            self.pass_programs()?;
        }
        Ok(())
    }

    /// Refuses a program whose first blocks are in a language that postform does not read.
    fn check_language(&mut self) -> Result<(), RunError> {
        let head = loop {
            match self.input.fill_buf() {
                Ok(head) => break head,
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(error) => return Err(error.into()),
            }
        };
        let control = self.state.settings.control;
        if !control.is_run() {
            return Ok(()); // the first block is refused when it is read
        }
        if self.state.settings.assumed
            && !control.is_lathe()
            && let Some((line, text)) = turned(head)
        {
            (self.at.line, self.line, self.ended) = (line, text, true);
            let help = "name the control: `--control fanuc-lathe` or `haas-lathe`, for a job `--job-control`";
            return Err(self.refused(Fault::new(
                Code::PN016,
                "the program is for a lathe, but no lathe control is named",
                help,
            )));
        }
        let reads = |found: &Foreign| found.control.is_some_and(|own| own.rules() == control.rules());
        let Some(found) = foreign(head).filter(|found| !reads(found)) else { return Ok(()) };
        (self.at.line, self.line, self.ended) = (found.line, found.text, true);
        let (message, help) = match found.control {
            Some(own) => (
                format!("the program is {}, but {} reads another language", found.is, control.name()),
                format!("name the control of the program: `--control {0}`, for a job `--job-control {0}`", own.name()),
            ),
            None => (
                format!("the program is {}: postform can't read it", found.is),
                "let the CAM system write the program for one of the controls of `--control`".to_owned(),
            ),
        };
        Err(self.refused(Fault::new(Code::PN016, message, help)))
    }

    #[expect(clippy::boxed_local, reason = "faults come in boxes")]
    pub(super) fn refused(&mut self, fault: Box<Fault>) -> RunError {
        self.over = true;
        // a loop is refused before its first line is read; `at` is then still the line before it
        let line = self.at.line.max(u64::from(self.blocks > 0));
        RunError::Refused(Box::new(fault.diag(line, self.text())), line)
    }

    /// Reads the lines of the next block.
    #[inline]
    fn read_lines(&mut self) -> Result<bool, RunError> {
        match self.state.settings.control.rules() {
            Rules::Klartext => self.read_klartext_lines(),
            _ => self.read_line(),
        }
    }

    /// Reads the next line into `self.line`. Returns `false` if the input has ended.
    #[inline]
    pub(super) fn read_line(&mut self) -> Result<bool, RunError> {
        self.line.clear();
        loop {
            let buffer = match self.input.fill_buf() {
                Ok(buffer) => buffer,
                Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
                Err(error) => return Err(error.into()),
            };
            if buffer.is_empty() {
                break;
            }
            let (length, ended) = match memchr::memchr(b'\n', buffer) {
                Some(end) => (end + 1, true),
                None => (buffer.len(), false),
            };
            self.line.extend_from_slice(&buffer[..length]);
            self.input.consume(length);
            if ended || self.line.len() > LONGEST {
                break;
            }
        }
        if self.line.is_empty() {
            return Ok(false);
        }
        if self.at.byte == 0 && self.line.starts_with(b"\xef\xbb\xbf") {
            // the line begins with a UTF-8 byte order mark: spaces in its place keep columns and bytes correct
            self.line[..3].fill(b' ');
        }
        self.at.byte += self.line.len() as u64;
        self.at.line += 1;
        Ok(true)
    }

    /// Runs the current line, or the rest of this line. Returns the point at which the program continues.
    #[inline]
    fn line_step(&mut self, items: &mut Vec<Item>) -> Done<Jump> {
        let before = items.len();
        let next = if std::mem::take(&mut self.unfinished) {
            self.state.run_on(&self.block, self.at.line, items)?
        } else {
            if let Some(jump) = self.read_block(items)? {
                return Ok(jump);
            }
            self.state.run(&mut self.block, self.at.line, items)?
        };
        self.unfinished = next == Next::Rest;
        // a single block may make as many actions as a loop
        if self.unfinished || !self.frames.is_empty() {
            self.repeated += (items.len() - before) as u64;
            if next == Next::On
                && let Some(back) = self.end_profile(items)
            {
                return Ok(Jump::To(back));
            }
            if self.repeated > MOST_REPEATED {
                let message = format!("repeats, loops and pecks make more than {MOST_REPEATED} actions");
                return refuse(Code::PN015, message, "check Q, K or L, and nested loops");
            }
        }
        match next {
            Next::Rest | Next::On => Ok(Jump::On),
            Next::End => Ok(Jump::End),
            Next::Call(_, 0) => Ok(Jump::On),
            Next::Call(number, times) => Ok(Jump::Find(format!("{number}"), times)),
            Next::Return => self.return_from("a subprogram"),
            Next::Profile(asked) => Ok(Jump::Profile(asked)),
        }
    }

    /// Reads the line into the block. If the line contains nothing to run, returns where the program continues.
    #[inline]
    fn read_block(&mut self, items: &mut Vec<Item>) -> Done<Option<Jump>> {
        let control = self.state.settings.control;
        if !control.is_run() {
            let message = format!("postform does not read the language of {}", control.name());
            return refuse(
                Code::PN016,
                message,
                "check the program yourself: programs of this control are neither run nor proven",
            );
        }
        let traits = control.traits();
        let counts = traits.stops_at_longer && !traits.bare_line;
        let longest = traits.longest_line.filter(|_| counts).unwrap_or(LONGEST);
        if self.line.len() > longest && self.line.trim_ascii_end().len() > longest {
            self.line.truncate(80);
            return refuse(Code::PN001, format!("a line of more than {longest} bytes"), "break it into several blocks");
        }
        self.parameters.position = *self.state.position();
        self.parameters.increment = self.state.least_increment();
        match control.rules() {
            Rules::Grbl => super::grbl::read(&mut self.block, &self.line, control)?,
            Rules::Siemens => return self.read_siemens(items),
            Rules::Klartext => return self.read_klartext(items),
            Rules::Osp => return self.read_osp(items),
            _ => self.block.read(&self.line, &mut self.parameters, &self.state.settings)?,
        }
        if self.block.is_empty() && self.block.comment.is_none() {
            if self.block.percent {
                // lines without words before the first `%` are not part of the program
                let ends = self.percent || self.words;
                self.percent = true;
                if ends && control.rules() == Rules::Fanuc {
                    self.ended = true;
                    let help = "print M30 or M2 at the end: a Fanuc stops at `%` with an alarm and a turning spindle";
                    return refuse(Code::PN010, "the program ends at `%` without M30 or M2", help);
                }
                return Ok(Some(if ends { Jump::End } else { Jump::On }));
            }
            return Ok(Some(Jump::On));
        }
        if self.block.deleted && self.deletes(items) {
            return Ok(Some(Jump::On));
        }
        self.blocks += 1;
        self.words |= !self.block.is_empty();
        if let Some(flow) = self.block.flow.take() {
            return self.follow(flow).map(Some);
        }
        Ok(None)
    }

    /// Handles an input that ends before the end of the program.
    fn at_end(&mut self) -> Done<bool> {
        (self.over, self.ended) = (true, true);
        if self.state.settings.control.rules() == Rules::Grbl {
            // Grbl runs block by block, and needs no code for the end of the program
            if self.state.drive.spindle != Rotation::Stop {
                let message = "the program ends while the spindle turns: check that the file is complete";
                let help = "end the program with M5 and M30";
                self.state.warnings.push((Code::PN037, message, help));
            }
            return Ok(false);
        }
        let help = "a program ends with M2, M30 or %";
        refuse(Code::PN010, "the program is incomplete: its end is missing", help)
    }
}
