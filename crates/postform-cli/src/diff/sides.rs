//! Gets the two programs of a comparison.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use postform::internals::control::Control;
use postform::internals::diff::Program;
use postform::internals::render::TraceLine;
use postform::internals::source::Source;
use postform::internals::trace::Trace;

use super::super::args::DiffArgs;
use super::super::files::{self, io_message};
use super::super::prepare::{Prepared, prepare};
use super::super::rendered::rendered;
use super::super::report::Reporter;

/// A program, and the information about it.
pub struct Side {
    /// The name of the program.
    pub name: String,
    /// The text of the program.
    pub program: Program,
    /// The control of the form that printed the program.
    pub control: Option<&'static Control>,
    /// The origin of the program's lines, and the form's text.
    pub trace: Option<(Trace, Vec<Source>)>,
}

impl Side {
    /// Form line and job item that printed a line, counted from 0: `form.pf:12, operations[0].path[3]`.
    pub fn origin(&self, line: usize) -> Option<String> {
        let (trace, files) = self.trace.as_ref()?;
        let TraceLine { form, place, .. } = trace.line(line as u64 + 1)?;
        let form = form.and_then(|span| {
            let source = files.get(span.file as usize)?;
            Some(format!("{}:{}", source.name, source.line(span.start) + 1))
        });
        let form = form.unwrap_or_else(|| "generated".to_owned());
        let path = place.path();
        Some(if path.is_empty() { form } else { format!("{form} for {path}") })
    }
}

impl Side {
    /// The form line that printed a line.
    pub fn form_line(&self, line: usize) -> Option<&str> {
        let (trace, files) = self.trace.as_ref()?;
        let span = trace.line(line as u64 + 1)?.form?;
        let source = files.get(span.file as usize)?;
        source.text.lines().nth(source.line(span.start))
    }
}

/// Both programs of a comparison. `None`: one program can't be rendered; the reason has been shown.
pub fn sides(args: &DiffArgs, reporter: &Reporter) -> Result<Option<[Side; 2]>, String> {
    match (&args.form, &args.against, args.files.as_slice()) {
        (Some(form), Some(old), [job]) => {
            let old = read(old)?;
            let Some([new]) = printed([form], job, args, reporter)? else { return Ok(None) };
            Ok(Some([old, new]))
        }
        (Some(_), ..) => {
            Err("error: --form and --against take one job: postform diff --form FORM --against OLD JOB".into())
        }
        (None, _, [old, new, job]) if args.forms => printed([old, new], job, args, reporter),
        (None, _, [old, new]) if !args.forms => {
            if old == new && *old == Path::new("-") {
                return Err("error: only one of the programs can be standard input".into());
            }
            Ok(Some([read(old)?, read(new)?]))
        }
        _ if args.forms => {
            Err("error: --forms takes two forms and a job: postform diff --forms OLD.pf NEW.pf JOB".into())
        }
        _ => Err("error: diff takes two programs: postform diff OLD NEW".into()),
    }
}

fn read(path: &Path) -> Result<Side, String> {
    let mut bytes = Vec::new();
    let mut input = files::open(path)?;
    input.read_to_end(&mut bytes).map_err(|error| io_message("read", path, &error))?;
    Ok(Side { name: files::name(path), program: program(path, bytes)?, control: None, trace: None })
}

fn program(path: &Path, bytes: Vec<u8>) -> Result<Program, String> {
    Program::new(bytes).map_err(|_| format!("error: {} is larger than 4 GB", files::name(path)))
}

/// The job printed by each form.
fn printed<const N: usize, P: AsRef<Path>>(
    forms: [P; N],
    job: &Path,
    args: &DiffArgs,
    reporter: &Reporter,
) -> Result<Option<[Side; N]>, String> {
    files::check_format(job, &args.read)?;
    let mut made = Vec::with_capacity(N);
    for form in &forms {
        let form = form.as_ref();
        let Some(prepared) = prepare(form, &args.options, job, reporter)? else { return Ok(None) };
        made.push((form, prepared));
    }
    let Ok(made) = made.try_into() else { return Ok(None) };
    let made: [(&Path, Prepared); N] = made;
    printed_by(&made, job, args, reporter)
}

/// The job printed by prepared forms. `None`: one form can't print the job; the reason has been shown.
pub fn printed_by<const N: usize>(
    forms: &[(&Path, Prepared); N],
    job: &Path,
    args: &DiffArgs,
    reporter: &Reporter,
) -> Result<Option<[Side; N]>, String> {
    let mut input = files::job(job, &args.read, true)?;
    let mut sides = Vec::with_capacity(N);
    for (form, prepared) in forms {
        let prepared = prepared.for_job(job);
        let Ok((file, lines)) = rendered(&mut input, &[job], &prepared, true, reporter)? else { return Ok(None) };
        sides.push(side(form, file, lines, &prepared)?);
    }
    Ok(sides.try_into().ok())
}

fn side(form: &Path, mut file: File, lines: Vec<TraceLine>, prepared: &Prepared) -> Result<Side, String> {
    let mut bytes = Vec::new();
    file.read_to_end(&mut bytes).map_err(|error| io_message("read", Path::new("the program"), &error))?;
    Ok(Side {
        name: format!("the program of {}", files::name(form)),
        program: program(form, bytes)?,
        control: prepared.post.control(),
        trace: Some((Trace::new(lines), prepared.post.files().to_vec())),
    })
}
