//! Searches for labels, subprograms, and the ends of structured blocks.

use super::head::{PARTS, head, opens, section, without_comment};
use super::ways::{Part, Section};
use crate::diag::Code;
use crate::nc::fault::{Done, refuse};
use crate::nc::simulator::{RunError, Simulator};
use crate::nc::way::{Frame, Search, Spot};

impl Simulator<'_> {
    /// Position in the input before the current line.
    fn this_line(&self) -> Spot {
        Spot { byte: self.at.byte - self.line.len() as u64, line: self.at.line - 1 }
    }

    /// Searches for the target of a jump, and jumps there.
    pub(in crate::nc::languages) fn search_siemens(&mut self, search: Search) -> Result<(), RunError> {
        let text = self.line.clone();
        let (back, farthest) = (self.at, self.farthest);
        let this = self.this_line();
        if self.siemens.sections.is_none() {
            self.find_sections()?;
        }
        let found = match search {
            Search::Label(label, forwards) => self.find_label(&label, forwards, this),
            Search::Part(enters) => self.find_part(&text, back, enters),
            Search::Call(name, arguments, times) => self.find_program(&name, arguments, times, back),
        };
        self.line = text;
        // reading ahead must not count as a jump back
        self.farthest = farthest;
        match found? {
            Ok(spot) => self.go(spot),
            Err(fault) => {
                self.at = back;
                Err(self.refused(fault))
            }
        }
    }

    /// Reads the lines from a position to the end of the input. If `each` returns `false`, the reading ends.
    fn lines_from(&mut self, spot: Spot, each: &mut dyn FnMut(&[u8], Spot, Spot) -> bool) -> Result<(), RunError> {
        self.go(spot)?;
        while self.read_line()? {
            if !each(&self.line, self.this_line(), self.at) {
                break;
            }
        }
        Ok(())
    }

    fn find_sections(&mut self) -> Result<(), RunError> {
        let start = Spot { byte: 0, line: 0 };
        let mut sections = vec![Section { name: String::new(), start }];
        self.lines_from(start, &mut |line, before, _| {
            if let Some(name) = section(line) {
                // `PROC NAME` after a header with the same name does not begin another section
                if sections.last().is_none_or(|last| last.name != name) {
                    sections.push(Section { name, start: before });
                }
            }
            true
        })?;
        self.siemens.sections = Some(sections);
        Ok(())
    }

    /// The index of the section that contains a line, and the first line of the next section.
    fn section_of(&self, line: u64) -> (usize, u64) {
        let sections = self.siemens.sections.as_deref().unwrap_or_default();
        let at = sections.iter().rposition(|section| section.start.line <= line).unwrap_or(0);
        (at, sections.get(at + 1).map_or(u64::MAX, |next| next.start.line))
    }

    fn find_label(&mut self, label: &str, forwards: Option<bool>, this: Spot) -> Result<Done<Spot>, RunError> {
        let (section, end) = self.section_of(this.line);
        let key = (section, label.to_owned());
        if !self.siemens.labels.contains_key(&key) {
            let start =
                self.siemens.sections.as_deref().and_then(|all| all.get(section)).map_or(this, |section| section.start);
            let mut found = Vec::new();
            self.lines_from(start, &mut |line, before, _| {
                if before.line >= end {
                    return false;
                }
                let head = head(line);
                if head.is(label) {
                    found.push(before);
                }
                true
            })?;
            self.siemens.labels.insert(key.clone(), found);
        }
        let spots = &self.siemens.labels[&key];
        let ahead = spots.iter().find(|spot| spot.line > this.line).copied().filter(|_| forwards != Some(false));
        let behind = spots.iter().rev().find(|spot| spot.line <= this.line).copied().filter(|_| forwards != Some(true));
        Ok(match ahead.or(behind) {
            Some(spot) => Ok(spot),
            None => {
                let way = match forwards {
                    Some(true) => " after this block",
                    Some(false) => " before this block",
                    None => "",
                };
                refuse(Code::PN015, format!("there is no label {label}{way}"), "check the spelling")
            }
        })
    }

    /// Finds the end of the part that is opened by the line before `back`.
    fn find_part(&mut self, text: &[u8], back: Spot, enters: bool) -> Result<Done<Spot>, RunError> {
        let own = head(text);
        let Some(kind) = opens(&own, text) else { return Ok(Ok(back)) };
        let line = back.line;
        let (_, section_end) = self.section_of(line - 1);
        let (mut open, mut middle, mut end) = (vec![kind], None, None);
        let mut stray = None;
        self.lines_from(back, &mut |text, before, after| {
            if before.line >= section_end {
                return false;
            }
            let head = head(text);
            if let Some(kind) = opens(&head, text) {
                open.push(kind);
            } else if head.word == "ELSE" && open.len() == 1 && open[0] == 0 {
                middle = Some((after, before));
            } else if let Some(kind) = PARTS.iter().position(|(_, end)| *end == head.word) {
                if open.pop() != Some(kind) {
                    stray = Some(before.line + 1);
                    return false;
                }
                if open.is_empty() {
                    end = Some((after, before));
                    return false;
                }
            }
            true
        })?;
        let (Some((after, end_line)), None) = (end, stray) else {
            let message = format!("{} has no {}", own.word, PARTS[kind].1);
            return Ok(refuse(Code::PN015, message, "end each branch or loop with its own word"));
        };
        let opening = Spot { byte: back.byte - text.len() as u64, line: line - 1 };
        // records where the run continues after the line in the middle of the part, and after its last line
        let start = if matches!(own.word.as_ref(), "WHILE" | "FOR") { opening } else { back };
        if own.word != "IF" {
            self.siemens.ends.insert(end_line.line + 1, start);
        }
        if let Some((_, else_line)) = middle {
            self.siemens.ends.insert(else_line.line + 1, after);
        }
        let part = Part { middle: middle.map(|(after, _)| after), end: after };
        self.siemens.parts.insert(line, part);
        Ok(Ok(if enters { back } else { part.middle.unwrap_or(part.end) }))
    }

    fn find_program(
        &mut self,
        name: &str,
        arguments: Vec<Option<f64>>,
        times: u32,
        back: Spot,
    ) -> Result<Done<Spot>, RunError> {
        if times == 0 {
            return Ok(Ok(back));
        }
        let section =
            self.siemens.sections.as_deref().unwrap_or_default().iter().find(|section| section.name == name).cloned();
        let Some(section) = section else {
            let help = "subprograms in other files are not simulated: add the subprogram after the main program, as \
                %_N_NAME_SPF";
            return Ok(refuse(Code::PN016, format!("there is no subprogram {name} in this file"), help));
        };
        // the header of the section is skipped
        let mut start = section.start;
        self.lines_from(section.start, &mut |line, before, after| {
            if line.trim_ascii_start().starts_with(b"%") {
                start = after;
                return true;
            }
            if without_comment(line).0.trim_ascii().is_empty() {
                return true;
            }
            start = before;
            false
        })?;
        let has_proc = head(&self.line).word == "PROC";
        if !has_proc && !arguments.is_empty() {
            return Ok(refuse(
                Code::PN018,
                format!("{name} takes no arguments"),
                "write PROC with its arguments at the beginning of the subprogram",
            ));
        }
        if has_proc && times > 1 {
            return Ok(refuse(
                Code::PN016,
                format!("{name} with PROC can be called only once per block"),
                "write the call again in the next block",
            ));
        }
        self.siemens.arguments = has_proc.then_some(arguments);
        let frame = Frame::Call { label: name.to_owned(), back, start, times, arguments: false };
        Ok(self.push(frame).map(|()| start))
    }
}
