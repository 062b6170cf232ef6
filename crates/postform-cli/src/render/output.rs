//! The outputs of a job: its program, and its source map.

use std::io;
use std::path::{Path, PathBuf};

use postform::internals::post::Part;
use postform::internals::render::TraceLine;
use postform::internals::source::Source;

use super::super::Ending;
use super::super::files::{self, io_message};
use super::super::output::Target;
use super::super::say::message;

/// Whether the output is a folder. In a folder, the program gets its name from the form and the job.
fn is_folder(output: &Path) -> bool {
    output.is_dir() || output.to_string_lossy().ends_with(['/', std::path::MAIN_SEPARATOR])
}

/// A closed standard output is no error, but a named output must be complete.
fn output_failed(path: &Path, error: &io::Error) -> Result<Ending, String> {
    match error.kind() {
        io::ErrorKind::BrokenPipe if path == Path::new("-") => Ok(Ending::Clean),
        io::ErrorKind::BrokenPipe => {
            message(&format!(
                "error: {} was closed by its reader before the whole program was written",
                files::output_name(path)
            ));
            Ok(Ending::Findings)
        }
        _ => Err(io_message("write", path, error)),
    }
}

/// The program and its source map while they are being written.
pub struct Output<'p> {
    path: PathBuf,
    target: Target,
    trace: Option<(PathBuf, Target)>,
    files: &'p [Source],
    /// The job, or the joined jobs.
    jobs: &'p [&'p Path],
    /// Whether the write error occurred in the source map, and not in the program.
    trace_failed: bool,
}

impl<'p> Output<'p> {
    /// Prepares the outputs. `files` are the files of the form, and `jobs` are the job or the joined jobs. In a folder,
    /// the program gets its name from [`Output::name`]; `name` is this name if it is already known.
    ///
    /// # Errors
    /// A message: an output can't be created, or is also an input.
    pub fn open(
        (path, name): (&Path, Option<&str>),
        trace: Option<&Path>,
        stream: bool,
        (files, jobs): (&'p [Source], &'p [&'p Path]),
    ) -> Result<Output<'p>, String> {
        let target = if is_folder(path) { Target::open_in(path, name)? } else { Target::open(path, stream)? };
        let trace = trace.map(|path| Ok::<_, String>((path.to_path_buf(), Target::open(path, false)?))).transpose()?;
        Ok(Output { path: path.to_path_buf(), target, trace, files, jobs, trace_failed: false })
    }

    /// Sets the name of a program in a folder, and returns its path. `None`: the program already has a name.
    ///
    /// # Errors
    /// A message: the existing file with this name must not be replaced.
    pub fn name(&mut self, file_name: &str) -> Result<Option<PathBuf>, String> {
        if !is_folder(&self.path) {
            return Ok(None);
        }
        let path = self.path.join(file_name);
        self.target = std::mem::replace(&mut self.target, Target::Stream).named(&path)?;
        self.path.clone_from(&path);
        Ok(Some(path))
    }

    /// Writes a part.
    ///
    /// # Errors
    /// As reported by the system.
    pub fn write(&mut self, part: &Part<'_>) -> io::Result<()> {
        self.target.write(part.text)?;
        let Some((_, target)) = &mut self.trace else { return Ok(()) };
        let mut text = Vec::new();
        for line in part.trace {
            trace_line(line, self.files, self.jobs, &mut text);
        }
        target.write(&text).inspect_err(|_| self.trace_failed = true)
    }

    /// Handles a part that could not be written.
    ///
    /// # Errors
    /// A message.
    pub fn failed(&self, error: &io::Error) -> Result<Ending, String> {
        let trace = self.trace.as_ref().filter(|_| self.trace_failed);
        output_failed(trace.map_or(&self.path, |(path, _)| path), error)
    }

    /// Completes the program.
    ///
    /// # Errors
    /// A message.
    pub fn finish(self) -> Result<Ending, String> {
        // the map is completed first: if this fails, no program appears, because a program without its map would look
        // complete
        if let Some((path, trace)) = self.trace
            && let Err(error) = trace.complete()
        {
            return output_failed(&path, &error);
        }
        match self.target.complete() {
            Ok(()) => Ok(Ending::Clean),
            Err(error) => output_failed(&self.path, &error),
        }
    }
}

/// One line of the source map. The line names the file of the job only if jobs are joined.
fn trace_line(line: &TraceLine, files: &[Source], jobs: &[&Path], out: &mut Vec<u8>) {
    let form = line.form.and_then(|span| {
        let source = files.get(span.file as usize)?;
        Some(serde_json::json!({ "file": source.name, "line": source.line(span.start) + 1 }))
    });
    let place = &line.place;
    let mut job = serde_json::json!({ "line": place.line, "column": place.column, "path": place.path() });
    if let Some(file) = usize::from(place.part).checked_sub(1).and_then(|part| jobs.get(part)) {
        job["file"] = file.to_string_lossy().into();
    }
    let row = serde_json::json!({ "line": line.line, "form": form, "job": job });
    out.extend_from_slice(row.to_string().as_bytes());
    out.push(b'\n');
}
