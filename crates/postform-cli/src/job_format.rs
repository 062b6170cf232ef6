//! The format of a job: by the option `--from`, else by the file name, else by the first bytes. A file whose first bytes
//! are those of another kind of file is refused with what the file seems to be.

use std::fs::File;
use std::io::{self, BufRead, Read};
use std::path::Path;

use file_format::FileFormat;
use postform::Format;
use postform::internals::terminal::escaped;

use super::args::ReadArgs;
use super::files::{io_message, is_form, name};
use super::packed::{unpacked, unpacked_name};

/// Most first bytes of a file that a message shows.
const SHOWN: usize = 32;

/// Formats of text that are easily mistaken for a job or a program. A signature of another format in a text, such as
/// `MZ`, can be a word of a program.
const TEXTS: [FileFormat; 10] = [
    FileFormat::DrawingExchangeFormatAscii,
    FileFormat::ExtensibleMarkupLanguage,
    FileFormat::HypertextMarkupLanguage,
    FileFormat::InitialGraphicsExchangeSpecification,
    FileFormat::PortableDocumentFormat,
    FileFormat::Postscript,
    FileFormat::RichTextFormat,
    FileFormat::ScalableVectorGraphics,
    FileFormat::StandardForTheExchangeOfProductModelData,
    FileFormat::StereolithographyAscii,
];

/// The format by the extension of a file, without the `.gz` of a compressed file.
pub fn format_of_name(path: &Path) -> Option<Format> {
    Format::of_name(&unpacked_name(path).as_deref().unwrap_or(path).to_string_lossy())
}

/// The format of a job. `start`: the first bytes of the file.
///
/// # Errors
/// A message: the path is a form or a folder, the format is unknown, or the first bytes are those of another kind of file.
pub fn job_format(
    path: &Path,
    args: &ReadArgs,
    start: impl FnOnce() -> Result<Vec<u8>, String>,
) -> Result<Format, String> {
    if let Some(format) = args.from {
        refuse_folder(path)?;
        return Ok(format);
    }
    if is_form(path) {
        let name = name(path);
        return Err(format!(
            "error: {name} is a form, not a job\n  help: `postform lint {name}` checks a form; in `postform render \
             JOB --form FORM` the job comes first"
        ));
    }
    refuse_folder(path)?;
    match format_of_name(path) {
        // the reader of the format reports a file that can't be read
        Some(format) => agreed(format, path, &start().unwrap_or_default()),
        None => unnamed(path, &start()?),
    }
}

fn refuse_folder(path: &Path) -> Result<(), String> {
    if !path.is_dir() {
        return Ok(());
    }
    let name = name(path);
    Err(format!(
        "error: can't read {name}: it is a folder\n  help: `postform render {name} --form FORM --out-dir OUT` prints each job in it"
    ))
}

/// The format of the file name, if the first bytes are not those of another kind of file.
fn agreed(format: Format, path: &Path, start: &[u8]) -> Result<Format, String> {
    let (seems, help) = match (Format::of_content(start), foreign(start)) {
        (None, Some(what)) => {
            (what, format!("give a job; if this file is one, name its format with `--from {}`", format.name()))
        }
        (Some(other), _) if group(other) != group(format) => {
            (described(other), format!("name the format with `--from {}`", other.name()))
        }
        _ => return Ok(format),
    };
    let (name, what) = (name(path), described(format));
    Err(format!(
        "error: {name} is not {what}: it begins with `{}` and seems to be {seems}\n  help: {help}",
        shown(start)
    ))
}

/// Formats of one group can't be told apart by all of their first bytes.
fn group(format: Format) -> Format {
    match format {
        Format::JsonLines => Format::Json,
        Format::Nc => Format::Cl,
        other => other,
    }
}

/// The format by the first bytes only. Standard input without any text is an empty JSON job.
fn unnamed(path: &Path, start: &[u8]) -> Result<Format, String> {
    let is_empty = start.trim_ascii().is_empty();
    let empty = (path == Path::new("-") && is_empty).then_some(Format::Json);
    Format::of_content(start).or(empty).ok_or_else(|| {
        let seems = foreign(start).map(|what| format!(" and seems to be {what}")).unwrap_or_default();
        let begins = if is_empty { String::new() } else { format!(": it begins with `{}`{seems}", shown(start)) };
        let known = Format::ALL.map(Format::name).join(", ");
        format!("error: the format of {} is unknown{begins}\n  help: give a job, or name its format with --from: one of {known}", name(path))
    })
}

/// What a file in a format is, in the middle of a sentence: `an APT CL file`, `JSON Lines`.
fn described(format: Format) -> String {
    match format.about().strip_prefix('A') {
        Some(rest) => format!("a{rest}"),
        None => format.about().to_owned(),
    }
}

/// What a file is that is neither a job nor a program, by its first bytes, such as `a file in the format PDF (Portable
/// Document Format)`.
pub fn foreign(start: &[u8]) -> Option<String> {
    let found = FileFormat::from_bytes(start);
    let is_known = match is_text(start) {
        true => TEXTS.contains(&found),
        false => !matches!(found, FileFormat::ArbitraryBinaryData | FileFormat::Empty),
    };
    is_known.then(|| match found.short_name() {
        Some(short) => format!("a file in the format {short} ({})", found.name()),
        None => format!("a file in the format {}", found.name()),
    })
}

/// No control characters apart from those of lines, pages and the end of a tape.
fn is_text(start: &[u8]) -> bool {
    !start.iter().any(|&byte| byte < 0x20 && !matches!(byte, b'\t' | b'\n' | b'\r' | 0x0b | 0x0c | 0x1a))
}

/// The first bytes of a file in a message: the first line of a text.
pub fn shown(start: &[u8]) -> String {
    let start = start.trim_ascii_start();
    if !is_text(start) {
        return start[..start.len().min(SHOWN)].escape_ascii().to_string();
    }
    let line = start.split(|byte| b"\r\n".contains(byte)).next().unwrap_or_default();
    escaped(&String::from_utf8_lossy(&line[..line.len().min(SHOWN)]))
}

/// The first bytes of a file or of standard input, in which they stay; none of another input that is not seekable.
///
/// # Errors
/// A message: the file can't be read.
pub fn start(path: &Path) -> Result<Vec<u8>, String> {
    let fail = |error: io::Error| io_message("read", path, &error);
    if path == Path::new("-") {
        return io::stdin().lock().fill_buf().map(<[u8]>::to_vec).map_err(fail);
    }
    if !std::fs::metadata(path).map_err(fail)?.is_file() {
        return Ok(Vec::new());
    }
    beginning(path).map_err(fail)
}

/// The first bytes of a file, decompressed if its name ends with `.gz`.
pub fn beginning(path: &Path) -> io::Result<Vec<u8>> {
    let (file, mut start, most) = (File::open(path)?, Vec::new(), Format::LOOKED_AT as u64);
    match unpacked_name(path) {
        Some(_) => unpacked(io::BufReader::new(file)).take(most).read_to_end(&mut start)?,
        None => file.take(most).read_to_end(&mut start)?,
    };
    Ok(start)
}
