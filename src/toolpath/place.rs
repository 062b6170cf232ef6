//! Locations in a job. Locations are small, because every event is passed with its location.

use std::fmt;

use crate::diag::Location;

/// The location of an event in its input.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct Place {
    /// Line of the input, from 1; 0 if the event has no line.
    pub line: u64,
    /// Column, from 1.
    pub column: u32,
    /// Operation, from 1; 0 outside operations.
    pub operation: u32,
    /// Item of the operation's path, from 1; 0 for the operation itself.
    pub item: u64,
    /// Point of the item's cycle, from 1; 0 for the item itself.
    pub point: u32,
    /// Subprogram, from 1, if the event is not in an operation. All subprograms after number 65,535 share the number 65,535.
    pub subprogram: u16,
    /// The number of the job among several joined jobs, from 1; 0: there is only one job.
    pub part: u16,
}

impl Place {
    /// The path inside the document, such as `operations[0].path[3].cycle.points[2]`. The path is empty outside of
    /// operations and subprograms.
    pub fn path(&self) -> String {
        let mut path = match (self.operation, self.subprogram) {
            (0, 0) => return String::new(),
            (0, sub) => format!("subprograms[{}]", sub - 1),
            (operation, _) => format!("operations[{}]", operation - 1),
        };
        if self.item > 0 {
            path += &format!(".path[{}]", self.item - 1);
        }
        if self.point > 0 {
            path += &format!(".cycle.points[{}]", self.point - 1);
        }
        path
    }
}

impl From<Place> for Location {
    fn from(place: Place) -> Location {
        let line = if place.line > 0 { Location::at(place.line, place.column.max(1)) } else { Location::default() };
        Location { part: place.part, ..line.step(place.path()) }
    }
}

impl fmt::Display for Place {
    /// Prints the location, such as `12:9, operations[0].path[3]`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        Location::from(*self).fmt(f)
    }
}
