//! Jumps in a program: subprograms, branches, loops.

use std::io::{Seek as _, SeekFrom};

use super::fault::{Done, Fault, refuse};
use super::flow::{Flow, Step};
use super::scan::{Kind, tokens};
use super::simulator::{RunError, Simulator};
use super::way::{Ends, Frame, Jump, Spot};
use crate::control::{self, Meaning, Rules};
use crate::diag::Code;

/// Maximum number of loop rounds, calls and repeated blocks. A program with more of them is refused.
const MOST_JUMPS: u64 = 1_000_000;
/// Maximum nesting of subprograms and loops.
const DEEPEST: usize = 64;

fn no_end() -> Box<Fault> {
    Fault::new(Code::PN015, "the subprogram has no end", "end the subprogram with M99 before the next O number")
}

impl Simulator<'_> {
    /// Continues the run at a position of the program.
    pub(super) fn go(&mut self, spot: Spot) -> Result<(), RunError> {
        self.farthest = self.farthest.max(self.at.line);
        if self.jumps == 0 {
            // if the input can't seek, fail at the first jump, even if the target is still in the buffer
            self.input.get_mut().stream_position()?;
        }
        let offset = i128::from(spot.byte) - i128::from(self.at.byte);
        match i64::try_from(offset) {
            // if possible, the target is read from the buffer
            Ok(offset) => self.input.seek_relative(offset)?,
            Err(_) => _ = self.input.seek(SeekFrom::Start(spot.byte))?,
        }
        self.at = spot;
        self.count_jump()
    }

    /// Counts a jump. A program that jumps too often has a loop without an end.
    pub(super) fn count_jump(&mut self) -> Result<(), RunError> {
        self.jumps += 1;
        if self.jumps > MOST_JUMPS {
            let help = "check the condition of the loop";
            return Err(self.refused(Fault::new(Code::PN015, "the program does not end", help)));
        }
        Ok(())
    }

    pub(super) fn push(&mut self, frame: Frame) -> Done {
        if self.frames.len() == DEEPEST {
            let help = "find a subprogram that calls itself";
            return refuse(Code::PN015, format!("subprograms and loops more than {DEEPEST} deep"), help);
        }
        self.frames.push(frame);
        Ok(())
    }

    /// Runs a block with an O word.
    pub(super) fn follow(&mut self, flow: Flow) -> Done<Jump> {
        self.state.holes.alike = 0;
        let Flow { label, step } = flow;
        let inner = self.frames.last().is_some_and(|frame| frame.label() == label);
        match step {
            Step::Program => self.program_begins(label),
            Step::Sub => {
                self.labels.insert(label.clone(), self.at);
                Ok(Jump::Skip(label, Ends::Sub))
            }
            Step::Call(arguments) => self.call_with(label, &arguments),
            Step::EndSub(value) | Step::Return(value) => {
                self.parameters.returns(value);
                self.return_from(&format!("o{label}"))
            }
            Step::If(true) => self.push(Frame::If { label }).map(|()| Jump::On),
            Step::If(false) => {
                self.push(Frame::If { label: label.clone() })?;
                Ok(Jump::Skip(label, Ends::Branch))
            }
            // another branch of this `if` has already run
            Step::ElseIf(_) | Step::Else if inner => {
                self.frames.pop();
                Ok(Jump::Skip(label, Ends::If))
            }
            Step::EndIf if inner => {
                self.frames.pop();
                Ok(Jump::On)
            }
            Step::While(is_so) => self.loop_while(label, is_so),
            Step::Do => {
                let start = self.at;
                self.push(Frame::Do { label, start })?;
                Ok(Jump::On)
            }
            Step::Repeat(times) => self.repeat(label, times.round()),
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

    /// Runs the beginning of a program or subprogram, as on a Fanuc. A subprogram without M99 that continues into this
    /// beginning is an error.
    fn program_begins(&mut self, label: String) -> Done<Jump> {
        let number = label.parse().ok();
        if self.frames.is_empty() && self.program.is_some_and(|main| Some(main) != number) {
            let message = format!("O{label} begins another program before M30 has ended this program");
            return refuse(Code::PN015, message, "write M30 before it, or remove the O word");
        }
        self.program = self.program.or(number);
        self.begins_at(label, self.at)?;
        match self.frames.last() {
            Some(Frame::Call { .. }) => Err(no_end()),
            _ => Ok(Jump::On),
        }
    }

    /// Records the beginning of a program. Two programs with one number are an error, because a call means one of them.
    fn begins_at(&mut self, label: String, at: Spot) -> Done {
        match self.labels.get(&label) {
            Some(known) if *known != at => {
                let message = format!("O{label} of line {} has the number of an earlier program", at.line);
                refuse(Code::PN015, message, "give each program of the file a number of its own")
            }
            _ => {
                self.labels.insert(label, at);
                Ok(())
            }
        }
    }

    /// Runs `o.. call`.
    fn call_with(&mut self, label: String, arguments: &[f64]) -> Done<Jump> {
        let Some(&start) = self.labels.get(&label) else {
            let help =
                "subprograms in other files are not simulated: define the subprogram in this file, before its call";
            return refuse(Code::PN016, format!("there is no subprogram o{label}"), help);
        };
        self.parameters.enter(arguments);
        self.push(Frame::Call { label, back: self.at, start, times: 1, arguments: true })?;
        Ok(Jump::To(start))
    }

    /// Runs `o.. while`, which is at the beginning of a loop or at the end of a `do`.
    fn loop_while(&mut self, label: String, is_so: bool) -> Done<Jump> {
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

    /// Runs `o.. repeat`.
    fn repeat(&mut self, label: String, times: f64) -> Done<Jump> {
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

    /// Leaves a loop (`for_good`), or ends only the current round of the loop.
    pub(super) fn out_of_loop(&mut self, label: String, for_good: bool) -> Done<Jump> {
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

    pub(super) fn stray<T>(&self, label: &str) -> Done<T> {
        let help = "give every O word of a loop or branch the number of the first O word";
        refuse(Code::PN015, format!("o{label} does not belong to an open loop or branch"), help)
    }

    /// Returns from a subprogram, at its end or by M99.
    pub(super) fn return_from(&mut self, what: &str) -> Done<Jump> {
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
            self.frames.pop(); // a loop or branch ends together with its subprogram
        }
        if self.state.settings.control.is_linuxcnc() {
            return refuse(
                Code::PN015,
                format!("the end of {what}, which was not called"),
                "call the subprogram, or remove the end",
            );
        }
        // M99 in a main program starts the program again; here it is run once
        self.again = true;
        Ok(Jump::End)
    }

    /// Skips the lines up to the end of the part that begins at a label.
    pub(super) fn skip(&mut self, label: &str, ends: Ends) -> Result<(), RunError> {
        let begin = self.at.line;
        loop {
            if !self.read_line()? {
                let message = format!("o{label} of line {begin} has no end");
                return Err(self.refused(Fault::new(Code::PN015, message, "write its end word")));
            }
            // a line that is read for the first time does not count as a round of a loop
            if self.at.line <= self.farthest {
                self.count_jump()?;
            }
            let Some((found, step)) = Flow::head(&self.line) else { continue };
            if found != label {
                continue;
            }
            match (ends, step) {
                (Ends::Sub, Step::EndSub(_))
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
                    // the condition of the ELSEIF is evaluated only now
                    let read = self.block.read(&self.line, &mut self.parameters, &self.state.settings);
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

    /// Skips the programs before the main one. Each of these programs is a subprogram, which must have an M99 even if
    /// no program calls it.
    pub(super) fn pass_programs(&mut self) -> Result<(), RunError> {
        let mut left = std::mem::take(&mut self.passing);
        let mut returns = true;
        while left > 0 {
            if !self.read_line()? {
                return self.go(Spot { byte: 0, line: 0 }); // without O words, the run begins at the first line
            }
            if let Some((label, Step::Program)) = Flow::head(&self.line) {
                if !std::mem::take(&mut returns) {
                    return Err(self.refused(no_end()));
                }
                let at = self.at;
                self.begins_at(label, at).map_err(|fault| self.refused(fault))?;
                left -= 1;
            }
            returns |= self.has_return();
        }
        Ok(())
    }

    /// Checks the lines after the end of the program: they may contain subprograms, but not another main program, which
    /// would not be run.
    pub(super) fn check_after_end(&mut self) -> Result<(), RunError> {
        if self.state.settings.control.rules() != Rules::Fanuc {
            return Ok(());
        }
        let (end, text) = (self.at, self.line.clone());
        self.ended = true; // nothing is run after an error in these lines
        let mut last = None; // the beginning of the last program, until its M99 is found
        while self.read_line()? && !self.line.starts_with(b"%") {
            if let Some((label, Step::Program)) = Flow::head(&self.line)
                && let Some(before) = last.replace((label, self.at))
            {
                return Err(self.another_program(before));
            }
            last = last.filter(|_| !self.has_return());
        }
        if let Some(last) = last {
            return Err(self.another_program(last));
        }
        (self.at, self.line) = (end, text);
        Ok(())
    }

    /// Refuses a program that begins at this position after the end of the main program.
    fn another_program(&mut self, (label, at): (String, Spot)) -> RunError {
        self.at = at;
        self.line.clear();
        let message = format!("O{label} is another program, because it has no M99; it is not run");
        self.refused(Fault::new(Code::PN015, message, "write each main program into a file of its own"))
    }

    /// Whether the line has a code that ends a subprogram.
    fn has_return(&self) -> bool {
        let control = self.state.settings.control;
        tokens(&self.line).any(|token| match token.kind {
            Kind::Word(b'M', number) => {
                let row = control::Code::of(b'M', number.value).and_then(|code| control.row(code));
                row.is_some_and(|row| row.meaning == Meaning::Return)
            }
            _ => false,
        })
    }

    /// Calls a subprogram by M98. The subprogram may be after the main program.
    pub(super) fn find(&mut self, label: String, times: u32) -> Result<(), RunError> {
        let back = self.at;
        if !self.labels.contains_key(&label) && !self.searched {
            let text = self.line.clone();
            while self.read_line()? {
                match Flow::head(&self.line) {
                    Some((found, Step::Program)) => {
                        let at = self.at;
                        self.begins_at(found, at).map_err(|fault| self.refused(fault))?;
                    }
                    Some((found, Step::Sub)) => _ = self.labels.entry(found).or_insert(self.at),
                    _ => {}
                }
            }
            self.searched = true;
            // reading ahead must not count as a jump back
            let farthest = self.farthest;
            self.go(back)?;
            self.farthest = farthest;
            self.line = text;
        }
        let Some(&start) = self.labels.get(&label) else {
            let help = "subprograms in other files are not simulated: add the subprogram after M30";
            return Err(self.refused(Fault::new(Code::PN016, format!("there is no subprogram O{label}"), help)));
        };
        if let Err(fault) = self.push(Frame::Call { label, back, start, times, arguments: false }) {
            return Err(self.refused(fault));
        }
        self.go(start)
    }
}
