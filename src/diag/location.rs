//! Locations in jobs and programs. Locations are stored as data and converted to text only for display.

use std::fmt;

/// A location in a job or in a program. Unknown parts of the location are `None`.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Location {
    /// The name of the job or program, if it has one.
    pub file: Option<String>,
    /// Line of the file, from 1.
    pub line: Option<u64>,
    /// Column in that line, in bytes from 1.
    pub column: Option<u32>,
    /// Step of the job, as a path in the document: `operations[0].path[3].cycle.points[2]`.
    pub step: Option<String>,
    /// The number of the job among joined jobs, from 1; 0 if the job is not joined.
    pub part: u16,
    /// The line of the program, from 1, if the finding is about a program that was printed from the job.
    pub program_line: Option<u64>,
}

impl Location {
    /// A line and a column of the input, both from 1.
    pub fn at(line: u64, column: u32) -> Location {
        Location { column: Some(column), ..Location::line(line) }
    }

    /// A line of the input, from 1.
    pub fn line(line: u64) -> Location {
        Location { line: Some(line), ..Location::default() }
    }

    /// Adds the step of the job; an empty step becomes `None`.
    pub(crate) fn step(mut self, step: String) -> Location {
        self.step = Some(step).filter(|step| !step.is_empty());
        self
    }

    /// Whether all parts of the location are unknown.
    pub fn is_empty(&self) -> bool {
        *self == Location::default()
    }
}

impl fmt::Display for Location {
    /// Writes `job.json:12:9, operations[0].path[3]`, without the line of the program.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut between = "";
        if let Some(file) = &self.file {
            f.write_str(file)?;
            between = ":";
        }
        if let Some(line) = self.line {
            write!(f, "{between}{line}")?;
            if let Some(column) = self.column {
                write!(f, ":{column}")?;
            }
            between = ", ";
        }
        match &self.step {
            Some(step) => write!(f, "{between}{step}"),
            None => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_is_shown_as_far_as_it_is_known() {
        let whole = Location { file: Some("job.json".into()), ..Location::at(12, 9).step("operations[0]".into()) };
        assert_eq!(whole.to_string(), "job.json:12:9, operations[0]");
        assert_eq!(Location { line: None, column: None, ..whole.clone() }.to_string(), "job.json:operations[0]");
        assert_eq!(Location { step: None, column: None, ..whole }.to_string(), "job.json:12");
        assert_eq!(Location::at(7, 1).step(String::new()).to_string(), "7:1");
        assert_eq!(Location::default().to_string(), "");
        assert!(Location::default().is_empty());
    }
}
