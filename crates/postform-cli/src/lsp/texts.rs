//! The texts that are open in the editor; they are used in place of the files on the disk.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use gen_lsp_types::Uri;
use postform::{Format, Source};

use super::uri;
use crate::files;

/// The kind of a file, by its name or by the language that the editor has set for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A form.
    Form,
    /// An NC program.
    Program,
    /// postform.toml.
    Settings,
    /// Any other text, perhaps a job.
    Other,
}

/// An open text.
#[derive(Debug)]
pub struct Text {
    /// The URI in the editor.
    pub uri: Uri,
    /// The file of the text, if there is one.
    pub path: Option<PathBuf>,
    /// The version number of the text in the editor.
    pub version: i32,
    /// The kind of the text.
    pub kind: Kind,
    /// The text.
    pub source: Source,
}

/// All open texts, by their URIs.
#[derive(Debug, Default)]
pub struct Texts(BTreeMap<String, Text>);

impl Texts {
    /// A text was opened.
    pub fn open(&mut self, uri: Uri, language: &str, version: i32, text: String) {
        let path = uri::path(&uri);
        let named = path.clone().unwrap_or_else(|| PathBuf::from(uri.as_ref()));
        let kind = kind(&named, language);
        let source = Source::from_text(files::name(&named), text);
        self.0.insert(uri.as_ref().to_owned(), Text { uri, path, version, kind, source });
    }

    /// Replaces an open text by its new version. Returns `false` if the text is not open.
    pub fn change(&mut self, uri: &Uri, version: i32, text: String) -> bool {
        let Some(open) = self.0.get_mut(uri.as_ref()) else { return false };
        open.version = version;
        open.source = Source::from_text(open.source.name.clone(), text);
        true
    }

    /// A text was closed: from now on the file on the disk is used.
    pub fn close(&mut self, uri: &Uri) {
        self.0.remove(uri.as_ref());
    }

    /// A text by its URI.
    pub fn get(&self, uri: &Uri) -> Option<&Text> {
        self.0.get(uri.as_ref())
    }

    /// The text of a file, if it is open.
    pub fn of_path(&self, path: &Path) -> Option<&Text> {
        self.0.values().find(|text| text.path.as_deref() == Some(path))
    }

    /// All open texts.
    pub fn all(&self) -> impl Iterator<Item = &Text> {
        self.0.values()
    }
}

/// The kind of a file: the editor's language ranks before the file name.
fn kind(path: &Path, language: &str) -> Kind {
    let extension = path.extension().map(|extension| extension.to_string_lossy().to_ascii_lowercase());
    let extension = extension.as_deref().unwrap_or("");
    match language {
        "postform" => return Kind::Form,
        "nc" | "gcode" | "postform-nc" => return Kind::Program,
        _ => {}
    }
    match extension {
        "pf" => Kind::Form,
        // a header file of C has the extension of Klartext programs
        _ if !matches!(language, "c" | "cpp") && Format::of_name(&path.to_string_lossy()) == Some(Format::Nc) => {
            Kind::Program
        }
        _ if path.file_name().is_some_and(|name| name == "postform.toml") => Kind::Settings,
        _ => Kind::Other,
    }
}
