//! The operations of a job. A new operation begins at each change of the tool or of the feed mode. This file also adds
//! the events for spindle, coolant and work offset inside an operation.

use super::fault::{Done, unsaid, warning};
use super::reader::{Reader, Waiting};
use super::switches::Switches;
use crate::nc::action::Rotation;
use crate::toolpath::{Coolant, Event, First, Tool, ToolChange};

impl Reader<'_> {
    pub(super) fn begin_operation(&mut self, first: First) -> Done {
        let Some(number) = self.tool.or(self.options.tool) else {
            return unsaid(
                self.place.line,
                "the program moves before it loads a tool",
                "give the tool with `--assume-tool NUMBER`",
            );
        };
        let registers = self.survey.registers.get(self.changes).copied().unwrap_or_default();
        let wanted = self.wanted;
        self.place.operation += 1;
        self.place.item = 0;
        let change = ToolChange {
            tool: Some(Tool {
                number,
                length_offset: registers.length,
                diameter_offset: registers.diameter,
                name: self.tool_name.clone(),
                ..Tool::default()
            }),
            spindle: Some(wanted.spindle()),
            coolant: Some(wanted.coolant.unwrap_or(Coolant::OFF)),
            work: wanted.work,
            feed_mode: Some(self.mode),
            first,
            ..ToolChange::default()
        };
        self.said = wanted;
        self.push(Event::ToolChange(&change))?;
        for waiting in std::mem::take(&mut self.waiting) {
            match waiting {
                Waiting::Comment(text) => self.push(Event::Comment(&text))?,
                Waiting::Dwell(seconds) => self.push(Event::Dwell(seconds))?,
                Waiting::Stop(kind) => self.push(Event::Stop(kind))?,
            }
        }
        Ok(())
    }

    /// Whether the new operation has another tool than the previous operation.
    pub(super) fn tool_is_new(&self) -> bool {
        self.place.operation == 0 || self.changes > 0 && self.said == Switches::default()
    }

    pub(super) fn tool_change(&mut self, number: f64) -> Done {
        self.end_cycle()?;
        if self.side.is_some() || self.turning.is_some() {
            return unsaid(
                self.place.line,
                "the tool changes under cutter compensation",
                "end the compensation with G40 and a move before the tool change",
            );
        }
        self.changes += 1;
        let (line, text) = &self.remark;
        let named = || self.options.tool_names.iter().find(|(_, known)| *known == number).map(|(name, _)| name.clone());
        self.tool_name = (*line == self.place.line).then(|| text.clone()).or_else(named);
        self.operation = true;
        self.wanted.rotation = Some(Rotation::Stop);
        self.said = Switches::default();
        if self.tool.replace(number) == Some(number) && self.place.operation > 0 {
            // a form prints no tool change if the tool is already loaded
            self.said.rotation = Some(Rotation::Stop);
        } else {
            self.home = None;
        }
        Ok(())
    }

    pub(super) fn coolant(&mut self, kind: Coolant) {
        if !self.wanted.cool(kind) {
            let message = "flood and mist are on at once, but the job contains only the coolant that was turned on \
                           later";
            self.warnings.push(warning(self.place.line, message, "let the form print the other coolant"));
        }
    }

    /// Adds events for everything that was switched since the last move.
    pub(super) fn switch(&mut self) -> Done {
        self.switch_to(self.wanted)
    }

    /// Adds events for the difference between the switches of the job and these switches.
    pub(super) fn switch_to(&mut self, wanted: Switches) -> Done {
        let said = std::mem::replace(&mut self.said, wanted);
        said.changes(wanted).try_for_each(|event| self.push(event))
    }
}
