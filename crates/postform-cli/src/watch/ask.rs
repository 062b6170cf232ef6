//! The requests of a page.

use std::collections::HashMap;

use postform::internals::scene::At;
use serde::Deserialize;

/// The request with which a page asks for a scene.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Ask {
    /// The job, counted from 0.
    pub job: usize,
    /// Unsaved texts of forms, by their names.
    #[serde(default)]
    pub texts: HashMap<String, String>,
    /// The identifier of the program that the page shows, from its scene.
    #[serde(default)]
    pub shown: Option<String>,
    /// The hashes of the sections that the page has, from the heads of their scenes.
    #[serde(default)]
    pub has: HashMap<String, String>,
    /// Values of the form's properties, by their names.
    #[serde(default)]
    pub properties: Vec<(String, String)>,
}

/// A request of a page for help about a word.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AskHelp {
    /// The job, counted from 0.
    pub job: usize,
    /// Unsaved texts of forms, by their names.
    #[serde(default)]
    pub texts: HashMap<String, String>,
    /// The location of the word.
    pub at: At,
}

/// A request to save a form.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Save {
    /// Name of the file, from the scene.
    pub name: String,
    /// The text to save.
    pub text: String,
    /// The text of the file on the disk when the page got the file.
    pub was: String,
}

/// A request to close a job.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Close {
    /// The job, counted from 0.
    pub job: usize,
    /// The name of the job, from the scene.
    pub name: String,
}
