//! Contents of a file besides the toolpath.

use crate::diag::Diag;

/// Notes that a reader takes from a CAM system's file, besides the events.
#[derive(Clone, Debug, Default)]
pub struct Remarks {
    /// Information for people who look at the job: the system's version, the job's name, values for another post.
    pub facts: Vec<String>,
    /// Parts of the file that are left out, or read in a way that the file does not specify.
    pub warnings: Vec<Diag>,
}
