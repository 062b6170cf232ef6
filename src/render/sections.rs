//! Named parts of a path, dwells, stops, comments and text as it stands.

use super::fault::{Done, fault};
use super::numbers::{quantised, tenths};
use super::renderer::{LastMove, Renderer};
use crate::control::Meaning;
use crate::diag::{Code, steers};
use crate::lang::{Machine, SequenceId, VarId};
use crate::sema;
use crate::toolpath::{EdmAction, Section, StopKind};

/// The sequences before and after each part.
fn sequences(section: Section) -> (SequenceId, SequenceId) {
    use SequenceId as S;
    match section {
        Section::Leadin => (S::BeginLeadin, S::EndLeadin),
        Section::Leadout => (S::BeginLeadout, S::EndLeadout),
        Section::Plunge => (S::BeginPlunge, S::EndPlunge),
        Section::Retract => (S::BeginRetract, S::EndRetract),
        Section::SideStep => (S::BeginSideStep, S::EndSideStep),
        Section::ZLevel => (S::BeginZLevel, S::EndZLevel),
        Section::Row => (S::BeginRow, S::EndRow),
    }
}

impl Renderer<'_> {
    /// A part begins.
    pub(super) fn begin(&mut self, section: Section) -> Done {
        let (begin, _) = sequences(section);
        self.check_section(begin)?;
        self.sections.push(section);
        self.run_section(begin)
    }

    /// The part that began last ends.
    pub(super) fn end(&mut self, section: Section) -> Done {
        let (begin, end) = sequences(section);
        self.check_section(begin)?;
        match self.sections.pop() {
            Some(open) if open == section => self.run_section(end),
            Some(open) => fault(
                Code::PJ005,
                format!("a {} ends inside a {}", part(section), part(open)),
                "end the parts in the reverse order of their beginnings",
            ),
            None => fault(
                Code::PJ005,
                format!("a {} ends that did not begin", part(section)),
                "begin it first, or take the end out",
            ),
        }
    }

    fn run_section(&mut self, id: SequenceId) -> Done {
        self.close_cycle()?;
        match self.shape.program.routine(id) {
            Some(routine) => {
                self.set_here()?;
                // an arc's code would want a centre; among cuts it stays a cut
                if matches!(self.last_move, LastMove::Cw | LastMove::Ccw) {
                    self.cutting = true;
                    self.way_before(routine)?;
                }
                self.run_with_upons(routine)?;
                if self.names_axes(routine, true) {
                    self.moved_by = Some(routine.span);
                }
                Ok(())
            }
            None => Ok(()),
        }
    }

    fn check_section(&self, id: SequenceId) -> Done {
        let machine = self.shape.program.settings.machine;
        if id.row().machines.has(machine) {
            return Ok(());
        }
        let message = format!("a {} has no such part of a path", machine.name());
        fault(Code::PR008, message, format!("{} is for {}", id.name(), id.row().machines))
    }

    /// Parts must be closed where an operation ends.
    pub(super) fn check_sections_closed(&self) -> Done {
        match self.sections.last() {
            None => Ok(()),
            Some(&open) => {
                fault(Code::PJ005, format!("a {} is still open here", part(open)), "end it before the operation ends")
            }
        }
    }

    /// What a wire EDM machine does between moves: the form must have a sequence for it.
    pub(super) fn edm(&mut self, action: EdmAction) -> Done {
        let machine = self.shape.program.settings.machine;
        if machine != Machine::Edm {
            let message = format!("a {} has no wire", machine.name());
            return fault(Code::PR008, message, "take the item out, or render it for a wire EDM machine");
        }
        let (id, what) = match action {
            EdmAction::Thread => (SequenceId::EdmThread, "threads the wire"),
            EdmAction::Cut => (SequenceId::EdmCut, "cuts the wire"),
            EdmAction::PreDrill => (SequenceId::EdmPreDrillThread, "drills a start hole"),
            EdmAction::Submerge => (SequenceId::SubmergeTank, "fills the tank"),
        };
        if self.shape.program.routine(id).is_none() {
            let message = format!("the job {what} here, and the form has no {}", id.name());
            let help = format!("add the sequence `{}` with what the machine needs, to its `End`", id.name());
            return fault(Code::PR008, message, help);
        }
        self.run_section(id)
    }

    /// A dwell in seconds.
    pub(super) fn dwell(&mut self, seconds: f64) -> Done {
        self.close_cycle()?;
        self.attend_changes()?;
        self.dwell_block(seconds)
    }

    /// The generated dwell block.
    pub(super) fn dwell_block(&mut self, seconds: f64) -> Done {
        let dwell = &self.shape.program.settings.dwell;
        let (info, time) =
            (&self.shape.letters[dwell.letter], if dwell.milliseconds { seconds * 1000.0 } else { seconds });
        let units = quantised(info, time)?;
        self.check_feed(info, VarId::Dwell, time, units)?;
        self.code_word(&dwell.code)?;
        self.parameter_word(dwell.letter, time)?;
        self.out.end_block();
        Ok(())
    }

    /// A program stop or an optional one.
    pub(super) fn stop(&mut self, kind: StopKind) -> Done {
        self.close_cycle()?;
        self.attend_changes()?;
        let [program, optional] = self.shape.program.settings.stop_code;
        let code = if kind == StopKind::Program { program } else { optional };
        self.vars.set(VarId::Stop, code);
        match self.shape.program.routine(SequenceId::Stop) {
            Some(routine) => {
                self.set_here()?;
                self.run_with_upons(routine)?;
                if !routine.vars.has(VarId::Stop)
                    && !self.says_code(routine, b'M', |code| {
                        self.meaning_of(b'M', tenths(code)).is_some_and(Meaning::is_stop)
                    })
                {
                    self.stopped(); // by words of its own
                }
            }
            None => {
                self.code_word(&sema::Code::plain(b'M', code))?;
                self.out.end_block();
            }
        }
        Ok(())
    }

    /// The program stops, or may. Many controls stop spindle and coolant with it: before the next move that cuts or
    /// crosses they are said again, whoever printed the stop.
    pub(super) fn stopped(&mut self) {
        self.subs.stops();
        for (var, served) in [
            (VarId::Speed, &mut self.served.speed),
            (VarId::Direct, &mut self.served.direct),
            (VarId::Cool, &mut self.served.cool),
        ] {
            let off = [self.shape.program.settings.spindle[2], self.shape.program.settings.coolant[1]];
            if self.vars.get(var).is_some_and(|value| !off.contains(&value)) {
                *served = None;
            }
        }
        self.attention = true;
    }

    /// Changes of spindle and coolant come before a dwell or stop too.
    fn attend_changes(&mut self) -> Done {
        // where nobody knows the place, what would move the tool waits for the next rapid
        let lost = self.position.given & 0b11 != 0b11 && self.upon_is_due(self.pending(), true);
        if self.attention && !lost { self.attend_here(false) } else { Ok(()) }
    }

    /// A comment in the marks of the form.
    pub(super) fn comment(&mut self, text: &str) -> Done {
        self.close_cycle()?;
        self.comment_block(text);
        Ok(())
    }

    /// A comment, in as many blocks as the control's line asks for.
    pub(super) fn comment_block(&mut self, text: &str) {
        let room = self.comment_room();
        for (i, line) in wrapped(text, room).enumerate() {
            if i == 1 {
                let message = "a comment is longer than the control's line, and goes on in the next";
                self.out.note(Code::PR026, message.into(), "shorten it, if it is to stand in one block");
            }
            self.comment_line(line);
        }
    }

    /// How many characters of a comment a block has room for, beside its marks, number and end.
    fn comment_room(&self) -> usize {
        let settings = &self.shape.program.settings;
        let number =
            settings.numbers.letter.map_or(0, |letter| usize::from(self.shape.letters[letter].format.int.count) + 2);
        let others = number + settings.eob.len() + settings.comment.iter().map(String::len).sum::<usize>();
        let longest = settings.control().traits().longest_line;
        longest.map_or(usize::MAX, |longest| longest.saturating_sub(others).max(1))
    }

    fn comment_line(&mut self, text: &str) {
        let settings = &self.shape.program.settings;
        let [open, close] = &settings.comment;
        let out = self.out.word(false);
        out.extend_from_slice(open.as_bytes());
        for c in text.chars() {
            let c = if settings.upper_comments { c.to_ascii_uppercase() } else { c };
            out.push(match c {
                // a mark inside would end the comment early and let the rest move the machine
                '(' if close.contains(')') => b'[',
                ')' if close.contains(')') => b']',
                c if close.contains(c) && !c.is_alphanumeric() => b'_',
                '%' => b'_', // ends the program for many controls
                ' '..='~' => c as u8,
                '\t' => b' ',
                _ => b'?',
            });
        }
        out.extend_from_slice(close.as_bytes());
        self.out.end_block();
    }

    /// A block as it stands: nobody knows what it did.
    pub(super) fn verbatim(&mut self, text: &str) -> Done {
        if let Some(c) = text.chars().find(|&c| steers(c) && c != '\t') {
            let message = format!("the text holds U+{:04X}, which steers instead of being printed", u32::from(c));
            return fault(Code::PR008, message, "take it out");
        }
        if text.trim() == "%" {
            let message = "the text is a lone `%`, at which a control takes the program to be over";
            return fault(Code::PR008, message, "take it out: StartCode and EndCode print it");
        }
        self.close_cycle()?;
        self.fresh_tool = false;
        if text.trim().is_empty() {
            return Ok(()); // an empty block is not printed
        }
        self.attend_changes()?;
        self.registers.forget_all();
        self.displaced(0x3f);
        self.text_codes(text)?;
        self.out.text(text, false);
        self.out.end_block();
        Ok(())
    }
}

/// A text in lines of at most so many characters, broken at blanks where it has them.
fn wrapped(text: &str, most: usize) -> impl Iterator<Item = &str> {
    let mut rest = Some(text);
    std::iter::from_fn(move || {
        let text = rest.take()?;
        let Some((end, _)) = text.char_indices().nth(most) else { return Some(text) };
        let blank = if text[end..].starts_with(' ') { Some(end) } else { text[..end].rfind(' ') };
        let (line, later) = text.split_at(blank.filter(|&at| at > 0).unwrap_or(end));
        rest = Some(later.trim_start_matches(' ')).filter(|later| !later.is_empty());
        Some(line)
    })
}

fn part(section: Section) -> &'static str {
    match section {
        Section::Leadin => "lead-in",
        Section::Leadout => "lead-out",
        Section::Plunge => "plunge",
        Section::Retract => "retract",
        Section::SideStep => "side step",
        Section::ZLevel => "Z level",
        Section::Row => "row",
    }
}
