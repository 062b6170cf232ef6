//! Runs a program block by block: reads lines, follows subprograms and loops, and hands on what the machine does.

use std::collections::HashMap;
use std::io::{self, BufRead, Seek, SeekFrom};

use super::action::{Action, Item};
use super::block::Block;
use super::fault::{Done, Fault, refuse};
use super::flow::{Flow, Step};
use super::machine::{Machine, Next, Settings};
use super::parameters::Parameters;
use crate::diag::{Code, Diag};

/// Longest line in bytes; LinuxCNC takes 255.
const LONGEST: usize = 1 << 16;
const LONGEST_OF_LINUXCNC: usize = 255;
/// Deepest nesting of subprograms and loops.
const DEEPEST: usize = 64;
/// Rounds of loops, calls, and blocks passed over, before a program counts as endless.
const MOST_JUMPS: u64 = 2_000_000;

/// Actions of subprograms and loops after which a program counts as endless.
const MOST_REPEATED: u64 = 50_000_000;

/// Why a program was not run to its end.
#[derive(Debug)]
pub enum RunError {
    /// The program could not be read.
    Io(io::Error),
    /// The control refuses a block.
    Refused(Box<Diag>, u64),
}

impl From<io::Error> for RunError {
    fn from(error: io::Error) -> Self {
        RunError::Io(error)
    }
}

/// A place in the program to go to: byte and lines before it.
#[derive(Clone, Copy, Debug)]
struct Spot {
    byte: u64,
    line: u64,
}

/// What runs inside the main program.
#[derive(Debug)]
enum Frame {
    /// A subprogram: where it was called, and how often it still runs.
    Call { label: String, back: Spot, start: Spot, times: u32, arguments: bool },
    /// A `while`, from its line.
    While { label: String, start: Spot },
    /// A `do`, from its line.
    Do { label: String, start: Spot },
    /// A `repeat`, from the line behind it.
    Repeat { label: String, start: Spot, left: u32 },
    /// An `if` one of whose branches runs.
    If { label: String },
}

impl Frame {
    fn label(&self) -> &str {
        match self {
            Frame::Call { label, .. }
            | Frame::While { label, .. }
            | Frame::Do { label, .. }
            | Frame::Repeat { label, .. }
            | Frame::If { label } => label,
        }
    }
}

/// Runs a program.
///
/// Memory does not grow with the program: a line is read at a time, and jumps seek in the input.
#[derive(Debug)]
pub struct Simulator<R> {
    input: R,
    machine: Machine,
    parameters: Parameters,
    block: Block,
    line: Vec<u8>,
    /// Behind the line.
    at: Spot,
    frames: Vec<Frame>,
    /// Subprograms by their O number or name, with the byte behind their first line.
    labels: HashMap<String, Spot>,
    /// All labels of the rest are known.
    searched: bool,
    /// The first O number.
    program: Option<f64>,
    percent: bool,
    over: bool,
    /// It ended with M99, which begins it again.
    again: bool,
    jumps: u64,
    /// Actions inside subprograms and loops.
    repeated: u64,
    blocks: u64,
}

impl<R: BufRead + Seek> Simulator<R> {
    /// From the beginning of a program.
    pub fn new(input: R, settings: Settings) -> Simulator<R> {
        Simulator {
            input,
            machine: Machine::new(settings),
            parameters: Parameters::new(settings.control),
            block: Block::default(),
            line: Vec::new(),
            at: Spot { byte: 0, line: 0 },
            frames: Vec::new(),
            labels: HashMap::new(),
            searched: false,
            program: None,
            percent: false,
            over: false,
            again: false,
            jumps: 0,
            repeated: 0,
            blocks: 0,
        }
    }

    /// The program counts in these units until it says others; before the first block.
    pub fn begin_in(&mut self, units: crate::toolpath::Units) {
        self.machine.begin_in(units);
    }

    /// The state of the control.
    pub fn machine(&self) -> &Machine {
        &self.machine
    }

    /// The block that was run last, as written.
    pub fn text(&self) -> &[u8] {
        &self.line
    }

    /// The line that was run last.
    pub fn line(&self) -> u64 {
        self.at.line
    }

    /// Did the program end with M99, which begins it again?
    pub fn begins_again(&self) -> bool {
        self.again
    }

    /// The program's number, where it has one.
    pub fn program(&self) -> Option<f64> {
        self.program
    }

    /// Back to the beginning, with everything as switched on.
    ///
    /// # Errors
    /// The input can't be gone back in.
    pub fn again(mut self) -> io::Result<Simulator<R>> {
        self.input.seek(SeekFrom::Start(0))?;
        Ok(Simulator::new(self.input, self.machine.settings))
    }

    /// Blocks run so far.
    pub fn blocks(&self) -> u64 {
        self.blocks
    }

    /// Runs the next line and appends what the machine does; `false` when the program is over.
    ///
    /// # Errors
    /// The input fails, or the control refuses the block. What the block did before is in `items`.
    #[inline]
    pub fn step(&mut self, items: &mut Vec<Item>) -> Result<bool, RunError> {
        if self.over {
            return Ok(false);
        }
        if !self.read_line()? {
            return self.at_end().map_err(|fault| self.refused(fault));
        }
        match self.line_step(items) {
            Ok(Jump::On) => Ok(true),
            Ok(Jump::End) => {
                self.over = true;
                Ok(false)
            }
            Ok(Jump::To(spot)) => self.go(spot).map(|()| true),
            Ok(Jump::Find(label, times)) => self.find(label, times).map(|()| true),
            Ok(Jump::Skip(label, ends)) => self.skip(&label, ends).map(|()| true),
            Err(fault) => Err(self.refused(fault)),
        }
    }

    /// Warnings since the last call, as findings.
    pub fn take_warnings(&mut self) -> Vec<Diag> {
        let list = self.machine.take_warnings();
        let (line, text) = (self.at.line, self.text());
        list.into_iter().map(|(code, message)| Fault::new(code, message, code.row().title).diag(line, text)).collect()
    }

    #[expect(clippy::boxed_local, reason = "faults come in boxes")]
    fn refused(&mut self, fault: Box<Fault>) -> RunError {
        self.over = true;
        // a loop is refused at its beginning, which is behind the line before
        let line = self.at.line.max(u64::from(self.blocks > 0));
        RunError::Refused(Box::new(fault.diag(line, self.text())), line)
    }

    /// The next line into `self.line`; `false` at the end of the input.
    #[inline]
    fn read_line(&mut self) -> Result<bool, RunError> {
        self.line.clear();
        loop {
            let buffer = self.input.fill_buf()?;
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
            // the mark that some editors put before UTF-8: blanks keep columns and bytes right
            self.line[..3].fill(b' ');
        }
        self.at.byte += self.line.len() as u64;
        self.at.line += 1;
        Ok(true)
    }

    #[inline]
    fn line_step(&mut self, items: &mut Vec<Item>) -> Done<Jump> {
        let linuxcnc = self.machine.settings.control.is_linuxcnc();
        let longest = if linuxcnc { LONGEST_OF_LINUXCNC } else { LONGEST };
        if self.line.len() > longest && self.line.trim_ascii_end().len() > longest {
            self.line.truncate(80);
            return refuse(Code::PN001, format!("a line of over {longest} bytes"), "break it into several blocks");
        }
        self.parameters.position = *self.machine.position();
        self.block.read(&self.line, &mut self.parameters, &self.machine.settings)?;
        if self.block.is_empty() && self.block.comment.is_none() {
            if self.block.percent {
                let ends = self.percent || self.blocks > 0;
                self.percent = true;
                return Ok(if ends { Jump::End } else { Jump::On });
            }
            return Ok(Jump::On);
        }
        if self.block.deleted {
            if self.machine.settings.block_delete {
                return Ok(Jump::On);
            }
            items.push(Item { line: self.at.line, by_cycle: false, action: Action::LeftOut(b'/', 0) });
        }
        self.blocks += 1;
        if let Some(flow) = self.block.flow.take() {
            return self.follow(flow);
        }
        let before = items.len();
        let next = self.machine.run(&mut self.block, self.at.line, items)?;
        if !self.frames.is_empty() {
            self.repeated += (items.len() - before) as u64;
            if self.repeated > MOST_REPEATED {
                let help = "look at the repeats of subprograms, loops and cycles inside each other";
                return refuse(Code::PN015, "the program does not come to an end", help);
            }
        }
        match next {
            Next::On => Ok(Jump::On),
            Next::End => Ok(Jump::End),
            Next::Call(_, 0) => Ok(Jump::On),
            Next::Call(number, times) => Ok(Jump::Find(format!("{number}"), times)),
            Next::Return => self.return_from("a subprogram"),
        }
    }

    /// The input is over before the program.
    fn at_end(&mut self) -> Done<bool> {
        self.over = true;
        let help = "a program ends with M2, M30 or %";
        refuse(Code::PN010, "the program is cut off: its end is missing", help)
    }

    fn go(&mut self, spot: Spot) -> Result<(), RunError> {
        let offset = i128::from(spot.byte) - i128::from(self.at.byte);
        match i64::try_from(offset) {
            // stays inside the buffer where it can
            Ok(offset) => self.input.seek_relative(offset)?,
            Err(_) => _ = self.input.seek(SeekFrom::Start(spot.byte))?,
        }
        self.at = spot;
        self.count_jump()
    }

    fn count_jump(&mut self) -> Result<(), RunError> {
        self.jumps += 1;
        if self.jumps > MOST_JUMPS {
            let help = "look at the condition of its loop";
            return Err(self.refused(Fault::new(Code::PN015, "the program does not come to an end", help)));
        }
        Ok(())
    }

    fn push(&mut self, frame: Frame) -> Done {
        if self.frames.len() == DEEPEST {
            let help = "look for a subprogram that calls itself";
            return refuse(Code::PN015, format!("subprograms and loops more than {DEEPEST} deep"), help);
        }
        self.frames.push(frame);
        Ok(())
    }

    /// A block with an O word.
    fn follow(&mut self, flow: Flow) -> Done<Jump> {
        let Flow { label, step } = flow;
        let inner = self.frames.last().is_some_and(|frame| frame.label() == label);
        match step {
            Step::Program => {
                self.program = self.program.or(label.parse().ok());
                self.labels.insert(label, self.at);
                // the next program begins: a subprogram without M99 runs into it
                match self.frames.last() {
                    Some(Frame::Call { .. }) => {
                        refuse(Code::PN015, "the subprogram has no end", "end it with M99 before the next O number")
                    }
                    _ => Ok(Jump::On),
                }
            }
            Step::Sub => {
                self.labels.insert(label.clone(), self.at);
                Ok(Jump::Skip(label, Ends::Sub))
            }
            Step::Call(arguments) => {
                let Some(&start) = self.labels.get(&label) else {
                    let help = "subprograms in other files are not simulated: define it in this one, before its call";
                    return refuse(Code::PN015, format!("there is no subprogram o{label}"), help);
                };
                self.parameters.enter(&arguments);
                self.push(Frame::Call { label, back: self.at, start, times: 1, arguments: true })?;
                Ok(Jump::To(start))
            }
            Step::EndSub | Step::Return => self.return_from(&format!("o{label}")),
            Step::If(true) => self.push(Frame::If { label }).map(|()| Jump::On),
            Step::If(false) => {
                self.push(Frame::If { label: label.clone() })?;
                Ok(Jump::Skip(label, Ends::Branch))
            }
            // a branch has run
            Step::ElseIf(_) | Step::Else if inner => {
                self.frames.pop();
                Ok(Jump::Skip(label, Ends::If))
            }
            Step::EndIf if inner => {
                self.frames.pop();
                Ok(Jump::On)
            }
            Step::While(is_so) => {
                if let Some(Frame::Do { label: opened, start }) = self.frames.last()
                    && *opened == label
                {
                    let start = *start;
                    if is_so {
                        return Ok(Jump::To(start));
                    }
                    self.frames.pop();
                    return Ok(Jump::On);
                }
                if !is_so {
                    return Ok(Jump::Skip(label, Ends::While));
                }
                let start = Spot { byte: self.at.byte - self.line.len() as u64, line: self.at.line - 1 };
                self.push(Frame::While { label, start })?;
                Ok(Jump::On)
            }
            Step::Do => {
                let start = self.at;
                self.push(Frame::Do { label, start })?;
                Ok(Jump::On)
            }
            Step::Repeat(times) => {
                let times = times.round();
                if !(0.0..=1e9).contains(&times) {
                    return refuse(Code::PN015, format!("{times} repeats"), "repeat a number of times from 0 on");
                }
                if times < 1.0 {
                    return Ok(Jump::Skip(label, Ends::Repeat));
                }
                let start = self.at;
                self.push(Frame::Repeat { label, start, left: times as u32 - 1 })?;
                Ok(Jump::On)
            }
            Step::EndWhile if inner => match self.frames.pop() {
                Some(Frame::While { start, .. }) => Ok(Jump::To(start)),
                _ => self.stray(&label),
            },
            Step::EndRepeat if inner => match self.frames.last_mut() {
                Some(Frame::Repeat { left: 0, .. }) => {
                    self.frames.pop();
                    Ok(Jump::On)
                }
                Some(Frame::Repeat { left, start, .. }) => {
                    *left -= 1;
                    Ok(Jump::To(*start))
                }
                _ => self.stray(&label),
            },
            Step::Break | Step::Continue => self.out_of_loop(label, step == Step::Break),
            _ => self.stray(&label),
        }
    }

    /// Leaves a loop, or its rest.
    fn out_of_loop(&mut self, label: String, for_good: bool) -> Done<Jump> {
        while let Some(frame) = self.frames.last_mut() {
            if frame.label() != label {
                if !matches!(frame, Frame::If { .. }) {
                    return self.stray(&label);
                }
                self.frames.pop();
                continue;
            }
            match frame {
                Frame::While { start, .. } if !for_good => {
                    let start = *start;
                    self.frames.pop();
                    return Ok(Jump::To(start));
                }
                Frame::Repeat { start, left, .. } if !for_good && *left > 0 => {
                    *left -= 1;
                    return Ok(Jump::To(*start));
                }
                Frame::While { .. } => {
                    self.frames.pop();
                    return Ok(Jump::Skip(label, Ends::While));
                }
                Frame::Repeat { .. } => {
                    self.frames.pop();
                    return Ok(Jump::Skip(label, Ends::Repeat));
                }
                Frame::Do { .. } if !for_good => return Ok(Jump::Skip(label, Ends::Test)),
                Frame::Do { .. } => {
                    self.frames.pop();
                    return Ok(Jump::Skip(label, Ends::Do));
                }
                _ => return self.stray(&label),
            }
        }
        self.stray(&label)
    }

    fn stray<T>(&self, label: &str) -> Done<T> {
        let help = "every part of a loop or branch has the number of its beginning";
        refuse(Code::PN015, format!("o{label} belongs to nothing that is open here"), help)
    }

    /// The end of a subprogram, or M99.
    fn return_from(&mut self, what: &str) -> Done<Jump> {
        while let Some(frame) = self.frames.last_mut() {
            if let Frame::Call { back, start, times, arguments, .. } = frame {
                *times -= 1;
                if *times > 0 {
                    return Ok(Jump::To(*start));
                }
                let (back, arguments) = (*back, *arguments);
                if arguments {
                    self.parameters.leave();
                }
                self.frames.pop();
                return Ok(Jump::To(back));
            }
            self.frames.pop(); // loops and branches end with their subprogram
        }
        if self.machine.settings.control.is_linuxcnc() {
            return refuse(Code::PN015, format!("{what} ends, and was not called"), "call it, or take the end out");
        }
        // M99 in a main program begins it again: once is enough
        self.again = true;
        Ok(Jump::End)
    }

    /// Passes over lines until the end of what a label began.
    fn skip(&mut self, label: &str, ends: Ends) -> Result<(), RunError> {
        let begin = self.at.line;
        loop {
            if !self.read_line()? {
                let message = format!("o{label} of line {begin} has no end");
                return Err(self.refused(Fault::new(Code::PN015, message, "end it with the word that belongs to it")));
            }
            self.count_jump()?;
            let Some((found, step)) = Flow::head(&self.line) else { continue };
            if found != label {
                continue;
            }
            match (ends, step) {
                (Ends::Sub, Step::EndSub)
                | (Ends::While, Step::EndWhile)
                | (Ends::Do, Step::While(_))
                | (Ends::Repeat, Step::EndRepeat)
                | (Ends::If, Step::EndIf) => return Ok(()),
                (Ends::Test, Step::While(_)) => {
                    let line = Spot { byte: self.at.byte - self.line.len() as u64, line: self.at.line - 1 };
                    return self.go(line);
                }
                (Ends::Branch, Step::EndIf) => {
                    self.frames.pop();
                    return Ok(());
                }
                (Ends::Branch, Step::Else) => return Ok(()),
                (Ends::Branch, Step::ElseIf(_)) => {
                    // its condition counts now
                    let read = self.block.read(&self.line, &mut self.parameters, &self.machine.settings);
                    if let Err(fault) = read {
                        return Err(self.refused(fault));
                    }
                    if let Some(Flow { step: Step::ElseIf(true), .. }) = self.block.flow.take() {
                        return Ok(());
                    }
                }
                _ => {}
            }
        }
    }

    /// A subprogram of M98, which may stand behind the main program.
    fn find(&mut self, label: String, times: u32) -> Result<(), RunError> {
        let back = self.at;
        if !self.labels.contains_key(&label) && !self.searched {
            let text = self.line.clone();
            while self.read_line()? {
                if let Some((found, Step::Program | Step::Sub)) = Flow::head(&self.line) {
                    self.labels.entry(found).or_insert(self.at);
                }
            }
            self.searched = true;
            self.go(back)?;
            self.line = text;
        }
        let Some(&start) = self.labels.get(&label) else {
            let help = "subprograms in other files are not simulated: add it behind M30";
            return Err(self.refused(Fault::new(Code::PN015, format!("there is no subprogram O{label}"), help)));
        };
        if let Err(fault) = self.push(Frame::Call { label, back, start, times, arguments: false }) {
            return Err(self.refused(fault));
        }
        self.go(start)
    }
}

/// What ends a part that is passed over.
#[derive(Clone, Copy, Debug)]
enum Ends {
    Sub,
    While,
    Do,
    Repeat,
    If,
    Branch,
    /// The condition of a `do`, which is run.
    Test,
}

/// Where to go from a line.
enum Jump {
    On,
    End,
    To(Spot),
    Find(String, u32),
    Skip(String, Ends),
}
