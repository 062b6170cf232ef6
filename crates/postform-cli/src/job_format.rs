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
    let Some((seems, other)) = other_kind(format, start) else { return Ok(format) };
    let help = match other {
        Some(other) => format!("name the format with `--from {}`", other.name()),
        None if is_packed(start) => PACKED.to_owned(),
        None => format!("give a job; if this file is one, name its format with `--from {}`", format.name()),
    };
    Err(not_of(format, path, start, &seems, &help))
}

/// Checks the first bytes of an NC program.
///
/// # Errors
/// A message: the bytes are those of a job or of another kind of file.
pub fn check_program(path: &Path, start: &[u8]) -> Result<(), String> {
    let name = name(path);
    match other_kind(Format::Nc, start) {
        None => Ok(()),
        Some((_, Some(Format::Json | Format::JsonLines | Format::Nci))) => Err(format!(
            "error: {name} is a job, not an NC program\n  help: `postform render {name} --form FORM` prints the program of a job"
        )),
        Some((seems, _)) => Err(not_of(Format::Nc, path, start, &seems, "give an NC program")),
    }
}

/// What the bytes of a file in a format seem to be instead, and the other format if they seem to be a job.
fn other_kind(format: Format, start: &[u8]) -> Option<(String, Option<Format>)> {
    match Format::of_content(start) {
        Some(other) if group(other) == group(format) => None,
        Some(Format::Freecad) => Some(("a FreeCAD document or another zip archive".to_owned(), Some(Format::Freecad))),
        Some(other) => Some((described(other), Some(other))),
        None => foreign(start).map(|what| (what, None)),
    }
}

fn not_of(format: Format, path: &Path, start: &[u8], seems: &str, help: &str) -> String {
    let (name, what, begins) = (name(path), described(format), shown(start));
    format!("error: {name} is not {what}: it begins with `{begins}` and seems to be {seems}\n  help: {help}")
}

/// Formats of one group can't be told apart by all of their first bytes.
fn group(format: Format) -> Format {
    match format {
        Format::JsonLines => Format::Json,
        Format::Nc => Format::Cl,
        other => other,
    }
}

const PACKED: &str = "if this file is a compressed job, end its name with .gz";

fn is_packed(start: &[u8]) -> bool {
    FileFormat::from_bytes(start) == FileFormat::Gzip
}

/// The format by the first bytes only. Standard input without any text is an empty JSON job.
fn unnamed(path: &Path, start: &[u8]) -> Result<Format, String> {
    let is_empty = start.trim_ascii().is_empty();
    let empty = (path == Path::new("-") && is_empty).then_some(Format::Json);
    Format::of_content(start).or(empty).ok_or_else(|| {
        let seems = foreign(start).map(|what| format!(" and seems to be {what}")).unwrap_or_default();
        let begins = match is_empty {
            true => String::new(),
            false => format!(": it begins with `{}`{seems}", shown(start)),
        };
        let known = Format::ALL.map(Format::name).join(", ");
        let help = match is_packed(start) {
            true => PACKED.to_owned(),
            false => format!("give a job, or name its format with --from: one of {known}"),
        };
        format!("error: the format of {} is unknown{begins}\n  help: {help}", name(path))
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
fn foreign(start: &[u8]) -> Option<String> {
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
fn shown(start: &[u8]) -> String {
    let start = start.trim_ascii_start();
    let shown = &start[..start.len().min(SHOWN)];
    let line = shown.split(|byte| b"\r\n".contains(byte)).next().unwrap_or_default();
    match str::from_utf8(line) {
        Ok(line) if is_text(start) => escaped(line),
        _ => shown.escape_ascii().to_string(),
    }
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
