//! Input files.

use std::fs::{self, File};
use std::io::{self, Read, Seek};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::SystemTime;

use postform::internals::control::Control;
use postform::internals::nc::control_of_name;
use postform::internals::sema::MOST_TEXT;
use postform::internals::terminal::{escaped, escaped_lines};
use postform::{Format, Job};

use super::args::ReadArgs;
pub use super::destination::folder;
use super::inputs;
use super::job_format::{check_program, job_format, start};
use super::packed::{unpacked, unpacked_name};
use super::spool::Spool;

/// Maximum size of a form: a longer file is not a form.
pub const LARGEST_FORM: u64 = MOST_TEXT as u64;

/// The message about a file that can't be read or written.
pub fn io_message(what: &str, path: &Path, error: &io::Error) -> String {
    let name = if what == "write" { output_name(path) } else { name(path) };
    format!("error: can't {what} {name}: {error}")
}

/// The name of an input in messages.
pub fn name(path: &Path) -> String {
    if path == Path::new("-") { "standard input".into() } else { escaped(&path.to_string_lossy()) }
}

/// The name of an output in messages.
pub fn output_name(path: &Path) -> String {
    if path == Path::new("-") { "standard output".into() } else { escaped(&path.to_string_lossy()) }
}

/// Opens a file, or standard input for `-`.
pub fn open(path: &Path) -> Result<Box<dyn Read>, String> {
    inputs::note(path);
    if path == Path::new("-") {
        return Ok(Box::new(io::stdin().lock()));
    }
    match File::open(path) {
        Ok(file) if unpacked_name(path).is_some() => Ok(Box::new(unpacked(io::BufReader::new(file)))),
        Ok(file) => Ok(Box::new(file)),
        Err(error) => Err(io_message("read", path, &error)),
    }
}

/// An NC program as a file in which postform can seek.
///
/// # Errors
/// A message: the file can't be read, or it is a job and not a program.
pub fn open_program(path: &Path) -> Result<File, String> {
    let mut file = seekable(path)?;
    let mut head = Vec::new();
    let fail = |error: io::Error| io_message("read", path, &error);
    file.by_ref().take(Format::LOOKED_AT as u64).read_to_end(&mut head).map_err(fail)?;
    file.rewind().map_err(fail)?;
    check_program(path, &head)?;
    Ok(file)
}

/// The bytes of a regular file. A pipe or a device, which may never end, is refused.
///
/// # Errors
/// A message: the file can't be read, or is no regular file.
pub fn read_regular(path: &Path) -> Result<Vec<u8>, String> {
    check_regular(path)?;
    fs::read(path).map_err(|error| io_message("read", path, &error))
}

/// Checks that a path is a regular file, which can be read more than once.
///
/// # Errors
/// A message: there is no file, or it is a pipe or a device.
pub fn check_regular(path: &Path) -> Result<(), String> {
    match fs::metadata(path) {
        Ok(meta) if meta.is_file() => Ok(()),
        Ok(_) => Err(format!("error: can't read {}: it is not a regular file", name(path))),
        Err(error) => Err(io_message("read", path, &error)),
    }
}

/// A file in which postform can seek: standard input, pipes and the text of compressed files are copied into one.
///
/// # Errors
/// A message: the file can't be read.
pub fn seekable(path: &Path) -> Result<File, String> {
    inputs::note(path);
    let fail = |error: io::Error| io_message("read", path, &error);
    if path != Path::new("-") {
        let file = File::open(path).map_err(fail)?;
        let meta = file.metadata().map_err(fail)?;
        if meta.is_dir() {
            return Err(fail(io::Error::from(io::ErrorKind::IsADirectory)));
        }
        if meta.is_file() && unpacked_name(path).is_none() {
            return Ok(file);
        }
    }
    let mut spool = Spool::new().map_err(fail)?;
    io::copy(&mut open(path)?, &mut spool).map_err(fail)?;
    spool.into_file().map_err(fail)
}

/// A file that must not change while it is read more than once.
struct Steady {
    file: File,
    stamp: Option<Stamp>,
}

impl Steady {
    fn new(file: File) -> Steady {
        Steady { stamp: stamp(&file), file }
    }
}

/// The size of a file, the time of its last change, and the time at which its directory entry changed. No program can
/// set the last of these times back.
pub type Stamp = (u64, SystemTime, (i64, i64));

/// The state of an open file, if the system has it.
fn stamp(file: &File) -> Option<Stamp> {
    stamp_in(&file.metadata().ok()?)
}

/// The state of a file at a path.
pub fn stamp_of(path: &Path) -> Option<Stamp> {
    stamp_in(&fs::metadata(path).ok()?)
}

fn stamp_in(meta: &fs::Metadata) -> Option<Stamp> {
    #[cfg(unix)]
    let entry = {
        use std::os::unix::fs::MetadataExt;
        (meta.ctime(), meta.ctime_nsec())
    };
    #[cfg(not(unix))]
    let entry = (0, 0);
    Some((meta.len(), meta.modified().ok()?, entry))
}

impl Read for Steady {
    fn read(&mut self, out: &mut [u8]) -> io::Result<usize> {
        self.file.read(out)
    }
}

impl Seek for Steady {
    fn seek(&mut self, to: io::SeekFrom) -> io::Result<u64> {
        if to == io::SeekFrom::Start(0) && stamp(&self.file) != self.stamp {
            return Err(io::Error::other("the file changed while it was read: try again when it is complete"));
        }
        self.file.seek(to)
    }
}

/// Whether a file has the name of a form.
pub fn is_form(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("pf"))
}

/// A help line with the forms in the folder of a missing form.
fn forms_beside(path: &Path) -> String {
    const MOST: usize = 8;
    if path == Path::new("-") || path.exists() {
        return String::new();
    }
    let entries = fs::read_dir(folder(path)).into_iter().flatten().filter_map(|entry| Some(entry.ok()?.path()));
    let names =
        entries.filter(|path| is_form(path)).filter_map(|path| Some(path.file_name()?.to_string_lossy().into_owned()));
    let mut forms: Vec<String> = names.collect();
    forms.sort();
    forms.truncate(MOST);
    if forms.is_empty() { String::new() } else { format!("\n  help: forms in that folder: {}", forms.join(", ")) }
}

/// Reads a complete form.
pub fn read_form(path: &Path) -> Result<Vec<u8>, String> {
    let mut bytes = Vec::new();
    let file = open(path).map_err(|message| format!("{message}{}", forms_beside(path)))?;
    match file.take(LARGEST_FORM + 1).read_to_end(&mut bytes) {
        Ok(_) if bytes.len() as u64 > LARGEST_FORM => {
            Err(format!("error: {} is larger than {} KB: it is not a form", name(path), LARGEST_FORM >> 10))
        }
        Ok(_) if bytes.trim_ascii_start().starts_with(b"{") => {
            let name = name(path);
            Err(format!(
                "error: {name} is a job, not a form\n  help: `postform check {name}` checks a job; in `postform \
                 render JOB --form FORM` the job comes first"
            ))
        }
        Ok(_) if !is_form(path) && bytes.trim_ascii_start().starts_with(b"%") => {
            let name = name(path);
            Err(format!("error: {name} is an NC program, not a form\n  help: `postform simulate {name}` runs programs"))
        }
        // UTF-16 text would be damaged when a fix writes it
        Ok(_) if bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff") => {
            Err(format!("error: {} is UTF-16\n  help: save the form as UTF-8: forms are plain text", name(path)))
        }
        Ok(_) => Ok(bytes),
        Err(error) => Err(io_message("read", path, &error)),
    }
}

/// Largest settings file: of a control, of a machine, or postform.toml.
const LARGEST_SETTINGS: u64 = 1 << 20;

/// Reads a settings file. `what` is the kind of the file, as `a machine file`.
///
/// # Errors
/// A message: the file can't be read, is larger than 1 MB, or is not UTF-8.
pub fn small_text(path: &Path, what: &str) -> Result<String, String> {
    let mut bytes = Vec::new();
    let read = open(path)?.take(LARGEST_SETTINGS + 1).read_to_end(&mut bytes);
    read.map_err(|error| io_message("read", path, &error))?;
    if bytes.len() as u64 > LARGEST_SETTINGS {
        return Err(format!("error: {} is larger than 1 MB: it is not {what}", name(path)));
    }
    String::from_utf8(bytes).map_err(|_| format!("error: {} is not UTF-8", name(path)))
}

/// A shop's own control.
///
/// # Errors
/// A message: the file can't be read, or contains an error, with line and column.
pub fn control(path: &Path) -> Result<&'static Control, String> {
    let text = small_text(path, "a control file")?;
    Control::own(&name(path), &text).map_err(|wrong| format!("error: {}", escaped_lines(&wrong.to_string())))
}

/// Options that apply only to some formats.
struct Only {
    is_given: bool,
    applies_to: &'static [Format],
    /// The text of the message before the name of a file in another format.
    message: &'static str,
    /// The text of the message after the name of the file. Empty: the message ends with the name.
    other: &'static str,
}

impl Only {
    fn wrong(&self, path: &Path) -> String {
        format!("error: {} {}{}", self.message, name(path), self.other)
    }
}

/// The options for reading that apply only to some formats.
fn only(args: &ReadArgs) -> [Only; 6] {
    [
        Only {
            is_given: args.dialect.is_some(),
            applies_to: &[Format::Cl],
            message: "--dialect is for CL files only:",
            other: " is not a CL file",
        },
        Only {
            is_given: args.job_name.is_some(),
            applies_to: &[Format::Freecad],
            message: "--job is for FreeCAD documents only:",
            other: " is not a FreeCAD document",
        },
        Only {
            is_given: args.assume_units.is_some(),
            applies_to: ReadArgs::UNITS,
            message: "--assume-units is for CL files, NCI files and NC programs, not for the format of",
            other: "",
        },
        Only {
            is_given: args.assume_tool.is_some() || args.assume_start.is_some(),
            applies_to: ReadArgs::TOOL,
            message: "--assume-tool and --assume-start are for CL files and NC programs, not for the format of",
            other: "",
        },
        Only {
            is_given: args.assumes_of_cl(),
            applies_to: &[Format::Cl],
            message: "--assume-speed, -feed and -end and --setup are for CL files only:",
            other: " is not a CL file",
        },
        Only {
            is_given: args.job_control.is_some() || args.job_no_point.is_some(),
            applies_to: &[Format::Nc],
            message: "--job-control and --job-no-point are for NC programs only:",
            other: " is not an NC program",
        },
    ]
}

/// Checks that the format of a job is known and that the options apply to it.
pub fn check_format(path: &Path, args: &ReadArgs) -> Result<(), String> {
    let format = job_format(path, args, || start(path))?;
    let other = only(args).into_iter().find(|only| only.is_given && !only.applies_to.contains(&format));
    other.map_or(Ok(()), |only| Err(only.wrong(path)))
}

/// Checks that each option applies to at least one of several jobs. An option is ignored for jobs in formats to which
/// it does not apply.
pub fn check_formats(paths: &[PathBuf], args: &ReadArgs) -> Result<(), String> {
    let given: Vec<Only> = only(args).into_iter().filter(|only| only.is_given).collect();
    let Some(first) = paths.first().filter(|_| !given.is_empty()) else { return Ok(()) };
    // a job whose format is unknown fails when it is read
    let formats: Vec<Format> = paths.iter().filter_map(|path| job_format(path, args, || start(path)).ok()).collect();
    let unused = |only: &&Only| !formats.is_empty() && !formats.iter().any(|format| only.applies_to.contains(format));
    given.iter().find(unused).map_or(Ok(()), |only| Err(only.wrong(first)))
}

/// Opens a job. `again`: the job is read more than once, so an input that is not seekable is copied into a file.
pub fn job(path: &Path, args: &ReadArgs, again: bool) -> Result<Job<'static>, String> {
    let format = job_format(path, args, || start(path))?;
    // an NC program is run twice, and an archive is read from its end
    let twice = again || matches!(format, Format::Nc | Format::Freecad);
    let is_file = path != Path::new("-") && fs::metadata(path).is_ok_and(|meta| meta.is_file());
    let mut job = match twice || is_file {
        true => Job::file(format, Steady::new(seekable(path)?)),
        false => Job::stream(format, open(path)?),
    };
    settle(&mut job, format, path, args);
    Ok(job)
}

/// Opens a job whose content is in memory; `path` is the name of its file.
///
/// # Errors
/// A message: the format is unknown.
pub fn job_in_memory(path: &Path, bytes: &Arc<[u8]>, args: &ReadArgs) -> Result<Job<'static>, String> {
    let format = job_format(path, args, || Ok(bytes[..bytes.len().min(Format::LOOKED_AT)].to_vec()))?;
    let mut job = Job::file(format, io::Cursor::new(Arc::clone(bytes)));
    settle(&mut job, format, path, args);
    Ok(job)
}

/// Largest content of a compressed file that is kept in memory.
const LARGEST_UNPACKED: u64 = 512 << 20;

/// The content of a file of this name, without its compression.
///
/// # Errors
/// A message: the compressed content is damaged.
pub fn unpacked_bytes(path: &Path, bytes: Vec<u8>) -> Result<Arc<[u8]>, String> {
    if unpacked_name(path).is_none() {
        return Ok(bytes.into());
    }
    let mut text = Vec::new();
    let read = unpacked(&bytes[..]).take(LARGEST_UNPACKED + 1).read_to_end(&mut text);
    read.map_err(|error| io_message("read", path, &error))?;
    if text.len() as u64 > LARGEST_UNPACKED {
        return Err(format!("error: {} is larger than {} MB", name(path), LARGEST_UNPACKED >> 20));
    }
    Ok(text.into())
}

/// Applies the options for reading. The file name of an NC program may determine its control.
fn settle(job: &mut Job<'_>, format: Format, path: &Path, args: &ReadArgs) {
    job.reading = args.reading(format);
    if format == Format::Nc {
        job.reading.control = job.reading.control.or_else(|| control_of_name(path));
    }
}

#[cfg(test)]
mod tests {
    use std::io::Write as _;

    use postform::toolpath::{Event, Flow, Place, Sink};

    use super::*;

    /// A reader that changes the job during a read.
    struct Writes(File);

    impl Sink for Writes {
        fn event(&mut self, _: Event<'_>, _: Place) -> Flow {
            self.0.write_all(b" ").unwrap();
            Flow::Continue(())
        }
    }

    #[test]
    fn a_job_that_changes_while_it_is_read_is_an_error() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("job.json");
        let text = r#"{"postform":1,"units":"mm","tools":[{"number":1}],"operations":[{"name":"a","tool":1,"spindle":{"speed":1000,"direction":"cw"},"feed":100,"path":[{"rapid":[0,0,1]},{"line":[1,0,0]}]}]}"#;
        fs::write(&path, text).unwrap();
        let mut job = super::job(&path, &ReadArgs::default(), true).unwrap();
        let error = job.read(&mut Writes(File::options().append(true).open(&path).unwrap())).unwrap_err();
        assert!(error.io().is_some_and(|error| error.to_string().contains("changed while it was read")), "{error}");
    }

    /// The test changes a file in place and then sets its time back, as `touch -r` does: size and time are then the old
    /// values.
    #[cfg(unix)]
    #[test]
    fn a_time_that_is_put_back_hides_no_change() {
        let mut file = tempfile::tempfile().unwrap();
        file.write_all(b"before").unwrap();
        let before = file.metadata().unwrap().modified().unwrap();
        let mut steady = Steady::new(file.try_clone().unwrap());
        assert!(steady.seek(io::SeekFrom::Start(0)).is_ok());
        // file times may have a resolution of milliseconds
        std::thread::sleep(std::time::Duration::from_millis(20));
        file.seek(io::SeekFrom::Start(0)).unwrap();
        file.write_all(b"behind").unwrap();
        file.set_modified(before).unwrap();
        assert_eq!(file.metadata().unwrap().modified().unwrap(), before);
        assert!(steady.seek(io::SeekFrom::Start(0)).is_err());
    }
}
