//! Findings of forms and verdicts on programs, in formats for other programs.

mod github;
mod json;
mod proof;
mod row;
mod sarif;

pub use github::{annotations as github, data as github_text, property as github_property};
pub use json::report as json;
pub use proof::{finding, proof};
pub use row::{Row, row};
pub use sarif::log as sarif;
