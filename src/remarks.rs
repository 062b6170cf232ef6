//! What a file contains besides its toolpath.

use crate::diag::Diag;

/// What a reader of a CAM system's files notices besides the events.
#[derive(Clone, Debug, Default)]
pub struct Remarks {
    /// For whoever looks at the job: the system's version, the job's name, values for another post.
    pub facts: Vec<String>,
    /// What is left out, or read in a way that the file does not give.
    pub warnings: Vec<Diag>,
}
