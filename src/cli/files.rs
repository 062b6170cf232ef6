//! Input files.

use std::fs::File;
use std::io::{self, BufReader, Read, Seek};
use std::path::Path;

use postform::cl::{Assumed, Options, Report, read_cl};
use postform::control::Control;
use postform::diag::escaped;
use postform::nc::{JobOptions, Settings, Unpointed, read_program};
use postform::sema::MOST_TEXT;
use postform::toolpath::json::{read_document, read_lines};
use postform::toolpath::{ReadError, Sink, Units};

use super::args::{From, NoPoint, ReadArgs, UnitsArg};
use super::spool::Spool;

/// Largest form: a longer file is none.
const LARGEST_FORM: u64 = MOST_TEXT as u64;

/// A file that could not be read or written, as a message.
pub fn io_message(what: &str, path: &Path, error: &io::Error) -> String {
    let name = if what == "write" { output_name(path) } else { name(path) };
    format!("error: can't {what} {name}: {error}")
}

/// The name that messages use for an input.
pub fn name(path: &Path) -> String {
    if path == Path::new("-") { "standard input".into() } else { escaped(&path.to_string_lossy()) }
}

/// The same for an output.
pub fn output_name(path: &Path) -> String {
    if path == Path::new("-") { "standard output".into() } else { escaped(&path.to_string_lossy()) }
}

/// The folder that a file is in.
pub fn folder(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
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

/// An NC program, which must be a file that can be gone back in: others are copied into one.
pub fn open_program(path: &Path) -> Result<BufReader<File>, String> {
    Ok(buffered(Again::open(path)?.file))
}

/// A file as a program is read.
pub fn buffered(file: File) -> BufReader<File> {
    BufReader::with_capacity(PROGRAM_BUFFER, file)
}

/// An input that is read more than once: what can't be gone back in is copied into a file.
pub struct Again {
    file: File,
}

impl Again {
    /// Opens a file; standard input and pipes are copied.
    pub fn open(path: &Path) -> Result<Again, String> {
        let fail = |error: io::Error| io_message("read", path, &error);
        if path != Path::new("-") {
            let file = File::open(path).map_err(fail)?;
            let meta = file.metadata().map_err(fail)?;
            if meta.is_dir() {
                return Err(fail(io::Error::from(io::ErrorKind::IsADirectory)));
            }
            if meta.is_file() {
                return Ok(Again { file });
            }
        }
        let mut spool = Spool::new().map_err(fail)?;
        io::copy(&mut open(path)?, &mut spool).map_err(fail)?;
        Ok(Again { file: spool.into_file().map_err(fail)? })
    }

    /// The file itself.
    pub fn into_file(mut self) -> Result<File, String> {
        self.file.rewind().map_err(|error| io_message("read", Path::new("the program"), &error))?;
        Ok(self.file)
    }

    /// From its beginning; only one reader at a time.
    pub fn read(&self) -> Result<Box<dyn Read>, String> {
        let fail = |error: io::Error| io_message("read", Path::new("the job"), &error);
        let mut file = self.file.try_clone().map_err(fail)?;
        file.rewind().map_err(fail)?;
        Ok(Box::new(file))
    }
}

/// Bytes of a program that are read at once.
const PROGRAM_BUFFER: usize = 128 << 10;

/// A whole form.
pub fn read_form(path: &Path) -> Result<Vec<u8>, String> {
    let mut bytes = Vec::new();
    match open(path)?.take(LARGEST_FORM + 1).read_to_end(&mut bytes) {
        Ok(_) if bytes.len() as u64 > LARGEST_FORM => {
            Err(format!("error: {} is larger than {} KB: it is no form", name(path), LARGEST_FORM >> 10))
        }
        // what comes of it would be written back by a fix
        Ok(_) if bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff") => {
            Err(format!("error: {} is UTF-16\n  help: save it as UTF-8: forms are plain text", name(path)))
        }
        Ok(_) => Ok(bytes),
        Err(error) => Err(io_message("read", path, &error)),
    }
}

/// What CL files are called.
const CL: [&str; 7] = ["cl", "apt", "aptsource", "ncl", "cls", "cldata", "as"];

/// What NC programs are called.
const NC: [&str; 6] = ["nc", "ngc", "tap", "eia", "min", "mpf"];

/// The format of a job: as said, else by its extension.
pub fn job_format(path: &Path, args: &ReadArgs) -> Result<From, String> {
    let extension = path.extension().and_then(|e| e.to_str()).unwrap_or("").to_ascii_lowercase();
    let from = format_of(path, args.from, &extension)?;
    if from != From::Cl && args.dialect.is_some() {
        return Err(format!("error: --dialect is for CL files, which {} is not", name(path)));
    }
    if !matches!(from, From::Cl | From::Nc) && (args.assume_units.is_some() || args.assume_tool.is_some()) {
        return Err(format!("error: --assume-.. is for CL files and NC programs, which {} is not", name(path)));
    }
    if from != From::Nc && (args.job_control.is_some() || args.job_no_point.is_some()) {
        return Err(format!("error: --job-.. is for NC programs, which {} is not", name(path)));
    }
    if from == From::Nc && args.assume_tool.as_ref().is_some_and(|tool| tool.one().is_none()) {
        return Err(format!("error: --assume-tool takes one number for an NC program, which {} is", name(path)));
    }
    Ok(from)
}

fn format_of(path: &Path, from: Option<From>, extension: &str) -> Result<From, String> {
    // Creo numbers its versions: op010.ncl.1
    let version = extension.bytes().all(|b| b.is_ascii_digit()) && !extension.is_empty();
    let stem = path.file_stem().map(Path::new).and_then(Path::extension).and_then(|e| e.to_str()).unwrap_or("");
    let extension = if version { stem.to_ascii_lowercase() } else { extension.to_owned() };
    match (from, extension.as_str()) {
        (Some(from), _) => Ok(from),
        (None, "jsonl" | "ndjson") => Ok(From::Jsonl),
        (None, "json") => Ok(From::Json),
        (None, extension) if CL.contains(&extension) => Ok(From::Cl),
        (None, extension) if NC.contains(&extension) => Ok(From::Nc),
        (None, _) if path == Path::new("-") => Ok(From::Json),
        (None, _) => Err(format!(
            "error: can't tell what {} is by its name: say it with --from json, jsonl, cl or nc",
            name(path)
        )),
    }
}

/// An NC program as a job: it is run twice, so it is copied.
fn read_nc(
    mut input: Box<dyn Read>,
    args: &ReadArgs,
    report: &mut Report,
    sink: &mut dyn Sink,
) -> Result<(), ReadError> {
    let mut spool = Spool::new().map_err(ReadError::Io)?;
    io::copy(&mut input, &mut spool).map_err(ReadError::Io)?;
    let copy = spool.into_file().map_err(ReadError::Io)?;
    let control = args.job_control.unwrap_or_else(Control::usual);
    let unpointed = args.job_no_point.map_or(Unpointed::Refused, NoPoint::unpointed);
    let units = args.assume_units.map(UnitsArg::units);
    let settings = Settings { unpointed, units: units.unwrap_or(Units::Mm), ..Settings::new(control) };
    let options = JobOptions { settings, units, tool: args.assume_tool.as_ref().and_then(Assumed::one) };
    read_program(buffered(copy), &options, &mut report.warnings, sink)
}

/// Reads a job into a sink. The report is that of a CL file.
pub fn read_job(
    input: Box<dyn Read>,
    from: From,
    args: &ReadArgs,
    sink: &mut dyn Sink,
) -> (Result<(), ReadError>, Report) {
    let mut report = Report::default();
    let read = match from {
        From::Json => read_document(input, sink),
        From::Jsonl => read_lines(input, sink),
        From::Cl => {
            let options = Options {
                dialect: args.dialect,
                units: args.assume_units.map(|units| units.units()),
                tool: args.assume_tool.clone(),
            };
            read_cl(input, &options, &mut report, sink)
        }
        From::Nc => read_nc(input, args, &mut report, sink),
    };
    (read, report)
}
