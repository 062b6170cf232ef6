//! Answers requests of the form editor in the page: the meaning of a word, and the words that are possible at a location.

use serde::Deserialize;
use serde_json::{Value, json};

use super::Request;
use super::form;
use crate::explain::explain;
use crate::fmt::format;
use crate::ide::utf16::{Place, offset};
use crate::ide::{CompletionKind, Current, Document, about};
use crate::source::Source;

/// The kind of a request.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Ask {
    /// The words that are possible at the location.
    Complete,
    /// The meaning of the word at the location, and the text that its line printed.
    Hover,
    /// The explanation of a code, whose name is in `file`.
    Explain,
    /// The canonical layout of the file.
    Format,
}

/// A location in a form, with the request about it. Lines and columns are counted as by the editor in the browser.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct At {
    /// Name of the file.
    pub file: String,
    /// Line, from 0.
    pub line: u32,
    /// Number of UTF-16 code units before the location in that line.
    pub column: u32,
    /// The kind of the request.
    pub ask: Ask,
}

/// Answers a request. The answer contains `list` or `text`. `list` has the possible words, each with the text that it
/// replaces. `text` is Markdown, with its location `at`. Null: there is no answer.
pub fn help(request: Request<'_>, at: &At) -> Value {
    if at.ask == Ask::Explain {
        return explain(&at.file).map_or(Value::Null, |text| json!({ "text": text }));
    }
    let Request { form, files, limits, levels, job, job_name, .. } = request;
    let document = Document::new(form.clone(), files, limits, levels);
    let found = document.files().iter().position(|file| file.name == at.file);
    let Some((file, source)) = found.and_then(|file| Some((file as u32, document.files().get(file)?))) else {
        return Value::Null;
    };
    if at.ask == Ask::Format {
        return json!({ "text": format(source) });
    }
    let place = offset(source, Place { line: at.line, character: at.column });
    let mut job = job.ok();
    let mut current = job.as_mut().and_then(|job| document.print(short(job_name), job.again()));
    if at.ask == Ask::Hover {
        let Some(hover) = document.hover(file, place, current.as_ref()) else { return Value::Null };
        return json!({ "at": form::place(hover.span, document.files()), "text": hover.text });
    }
    // a form with an incomplete word prints no program: the values are taken from the form without that word
    if let Some(job) = job.filter(|_| current.is_none() && file == 0) {
        let form = Source::from_text(form.name.clone(), without_word(&source.text, place as usize));
        current = Document::new(form, files, limits, levels).print(short(job_name), job);
    }
    list(&document, file, place, current.as_ref())
}

/// The name of a file without its folders.
fn short(name: &str) -> &str {
    name.rsplit(['/', '\\']).next().unwrap_or(name)
}

fn list(document: &Document, file: u32, place: u32, current: Option<&Current>) -> Value {
    let found = document.complete(file, place, current);
    let rows = found.into_iter().map(|found| {
        let info = match found.kind {
            // an explanation needs a search for an example, which is fast for a few variables but too slow for all
            // commands
            CompletionKind::Variable => about(found.kind, &found.label, document.control()),
            _ => None,
        };
        json!({
            "label": found.label,
            "kind": kind(found.kind),
            "detail": found.detail,
            "at": form::place(found.replaces, document.files()),
            "text": found.text,
            "snippet": found.snippet,
            "info": info,
        })
    });
    json!({ "list": rows.collect::<Vec<Value>>() })
}

fn kind(kind: CompletionKind) -> &'static str {
    match kind {
        CompletionKind::Command => "command",
        CompletionKind::Value => "value",
        CompletionKind::Sequence => "sequence",
        CompletionKind::Keyword => "keyword",
        CompletionKind::Variable => "variable",
        CompletionKind::Code => "code",
        CompletionKind::Finding => "finding",
    }
}

/// The text without the word at a location, and without the spaces before that word, because two spaces would begin a comment.
fn without_word(text: &str, place: usize) -> String {
    let start = text[..place].rfind(char::is_whitespace).map_or(0, |at| at + 1);
    let end = text[place..].find(char::is_whitespace).map_or(text.len(), |at| place + at);
    format!("{}{}", text[..start].trim_end_matches([' ', '\t']), &text[end..])
}
