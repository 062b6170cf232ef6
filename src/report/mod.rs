//! Findings of forms as reports for programs.

mod github;
mod json;
mod sarif;

pub use github::annotations as github;
pub use json::report as json;
pub use sarif::log as sarif;
