//! Input files.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use postform::diag::escaped;
use postform::toolpath::Sink;
use postform::toolpath::json::{ReadError, read_document, read_lines};

use super::args::From;

/// Largest form: a longer file is none.
const LARGEST_FORM: u64 = 16 << 20;

/// A file that could not be read or written, as a message.
pub fn io_message(what: &str, path: &Path, error: &io::Error) -> String {
    format!("error: can't {what} {}: {error}", escaped(&path.to_string_lossy()))
}

/// The name that messages use.
pub fn name(path: &Path) -> String {
    if path == Path::new("-") { "standard input".into() } else { escaped(&path.to_string_lossy()) }
}

/// Opens a file, or standard input for `-`.
pub fn open(path: &Path) -> Result<Box<dyn Read>, String> {
    if path == Path::new("-") {
        return Ok(Box::new(io::stdin().lock()));
    }
    match File::open(path) {
        Ok(file) => Ok(Box::new(file)),
        Err(error) => Err(io_message("read", path, &error)),
    }
}

/// A whole form.
pub fn read_form(path: &Path) -> Result<Vec<u8>, String> {
    let mut bytes = Vec::new();
    match open(path)?.take(LARGEST_FORM + 1).read_to_end(&mut bytes) {
        Ok(_) if bytes.len() as u64 > LARGEST_FORM => {
            Err(format!("error: {} is larger than 16 MB: it is no form", name(path)))
        }
        Ok(_) => Ok(bytes),
        Err(error) => Err(io_message("read", path, &error)),
    }
}

/// The format of a job: as said, else by its extension.
pub fn job_format(path: &Path, from: Option<From>) -> Result<From, String> {
    let extension = path.extension().and_then(|e| e.to_str()).unwrap_or("").to_ascii_lowercase();
    match (from, extension.as_str()) {
        (Some(from), _) => Ok(from),
        (None, "jsonl" | "ndjson") => Ok(From::Jsonl),
        (None, "json") => Ok(From::Json),
        (None, _) if path == Path::new("-") => Ok(From::Json),
        (None, _) => Err(format!(
            "error: can't tell what {} is by its name: say it with --from json or --from jsonl",
            name(path)
        )),
    }
}

/// Reads a job into a sink.
pub fn read_job(input: Box<dyn Read>, from: From, sink: &mut dyn Sink) -> Result<(), ReadError> {
    match from {
        From::Json => read_document(input, sink),
        From::Jsonl => read_lines(input, sink),
    }
}
