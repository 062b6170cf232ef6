//! Operations: one for each tool, one where the feed mode changes.

use super::reader::Reader;
use super::switches::Switches;
use super::{Done, unsaid};
use crate::nc::action::Rotation;
use crate::toolpath::{Coolant, Event, First, Tool, ToolChange};

impl Reader<'_> {
    pub(super) fn begin_operation(&mut self, first: First) -> Done {
        let Some(number) = self.tool.or(self.options.tool) else {
            return unsaid(
                self.place.line,
                "the program moves before it loads a tool",
                "say which with `--assume-tool NUMBER`",
            );
        };
        let registers = self.survey.registers.get(self.changes).copied().unwrap_or_default();
        let wanted = self.wanted;
        self.place.operation += 1;
        self.place.item = 0;
        let change = ToolChange {
            name: None,
            tool: Some(Tool {
                number,
                length_offset: registers.length,
                diameter_offset: registers.diameter,
                ..Tool::default()
            }),
            spindle: Some(self.spindle()),
            coolant: Some(wanted.coolant.unwrap_or(Coolant::Off)),
            work: wanted.work,
            feed: None,
            plunge: None,
            feed_mode: Some(self.mode),
            comment: None,
            set: Vec::new(),
            first,
        };
        self.said = wanted;
        self.push(Event::ToolChange(&change))?;
        for text in std::mem::take(&mut self.comments) {
            self.push(Event::Comment(&text))?;
        }
        Ok(())
    }

    /// Does the operation that begins load another tool?
    pub(super) fn tool_is_new(&self) -> bool {
        self.place.operation == 0 || self.changes > 0 && self.said == Switches::default()
    }

    pub(super) fn tool_change(&mut self, number: f64) -> Done {
        self.end_cycle()?;
        if self.side.is_some() || self.turning.is_some() {
            return unsaid(
                self.place.line,
                "the tool changes under cutter compensation",
                "end it with G40 and a move before",
            );
        }
        self.changes += 1;
        self.operation = true;
        self.wanted.rotation = Some(Rotation::Stop);
        self.said = Switches::default();
        if self.tool.replace(number) == Some(number) && self.place.operation > 0 {
            // no form prints a change to the tool that is there
            self.said.rotation = Some(Rotation::Stop);
        } else {
            self.home = None;
        }
        Ok(())
    }
}
