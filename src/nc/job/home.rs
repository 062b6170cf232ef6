//! Moves to the reference point: the form prints them before a tool change and at the end of the program. Before a stop,
//! the job contains the move home.

use super::fault::{Done, warning};
use super::reader::{AtHome, Reader};
use crate::toolpath::{Axes, Event, First};

impl Reader<'_> {
    /// Records a move to a height that is known only at the machine.
    pub(super) fn goes_home(&mut self) {
        let (line, switches, across) = (self.place.line, self.wanted, self.across());
        self.home.get_or_insert(AtHome { line, switches, is_said: false, across });
    }

    /// X and Y of the tool; `None`: unknown.
    fn across(&self) -> Option<[f64; 2]> {
        (self.known & 0b011 == 0b011).then(|| [self.at[0], self.at[1]])
    }

    /// Moves the tool from the reference point to the highest Z of the program, above the position `to`. If the position of
    /// the tool is known in the job, the tool first moves up to this height and then across.
    pub(super) fn move_above(&mut self, home: AtHome, to: Axes) -> Done {
        let message = "between the moves of a tool, the reference point becomes the highest Z of the program";
        self.warn_once(home.line, message, "check that the tool clears the clamps at this height");
        let mut above = to;
        above.values[2] = self.survey.top;
        // after a move home, the position is unknown. In another work offset, X and Y of the old offset are another position
        if home.is_said || self.said.work != self.wanted.work {
            self.move_begins(First::Rapid(above))?;
            self.step();
            return self.push(Event::Rapid(above));
        }
        let up = Axes { given: 0b100, ..above };
        self.move_begins(First::Rapid(up))?;
        self.step();
        self.push(Event::Rapid(up))?;
        self.push(Event::Rapid(Axes { given: to.given & !0b100, ..above }))
    }

    /// Adds the move home before a stop or a dwell, because the operator expects the tool there.
    pub(super) fn stay_home(&mut self) -> Done {
        let Some(mut home) = self.home else { return Ok(()) };
        if !std::mem::replace(&mut home.is_said, true) {
            let message = "a move to the reference point before a stop or a dwell becomes the move home of the form";
            self.warn_once(home.line, message, "check the position in the form's sequence MoveHome");
            if !self.operation {
                self.switch_to(home.switches)?;
            }
            self.step();
            self.push(Event::Home)?;
        }
        let across = self.across();
        if across.is_some() && across != home.across {
            let to = Axes { values: self.at, given: self.used() & !0b100 };
            self.move_begins(First::Rapid(to))?;
            self.step();
            self.push(Event::Rapid(to))?;
        }
        self.home = Some(AtHome { across, ..home });
        Ok(())
    }

    fn warn_once(&mut self, line: u64, message: &str, help: &str) {
        if !self.warnings.iter().any(|warning| warning.message == message) {
            self.warnings.push(warning(line, message, help));
        }
    }
}
