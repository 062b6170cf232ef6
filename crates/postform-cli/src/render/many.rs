//! Prints many jobs, or the parts of jobs, into a folder.

use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use super::super::args::{RenderArgs, SplitArg};
use super::super::config::Config;
use super::super::each::each_on;
use super::super::files::{self, io_message};
use super::super::packed::unpacked_name;
use super::super::report::{Reporter, count, stopped};
use super::super::say::{kept, message, say};
use super::super::{Ending, inputs, many};
use super::name::{Pattern, Values};
use super::print::{self, Task};
use super::split::{self, Part};
use super::{Ready, form_of};

/// A program to print.
struct Planned {
    job: PathBuf,
    part: Option<Part>,
    /// The number of the program; `None`: the number comes from the job.
    number: Option<u32>,
    /// The number that the program prints, if it is known.
    printed: Option<u32>,
    /// The index of the form.
    ready: usize,
    /// The path of the program, or the reason why it can't be printed.
    to: Result<PathBuf, Refused>,
}

/// A job that can't be printed.
#[derive(Debug)]
struct Refused {
    messages: String,
    ending: Ending,
}

/// Prints each job into the folder of the command line.
///
/// # Errors
/// A message: nothing was printed.
pub fn run(args: &RenderArgs, colour: bool) -> Result<Ending, String> {
    let Some(folder) = &args.out_dir else { return Err("error: give --out-dir FOLDER".into()) };
    let reporter = Reporter::new(colour);
    let pattern = args.name.as_deref().or(args.split.map(|_| "{job}-{part}")).map(Pattern::parse).transpose()?;
    if let Some(pattern) = &pattern {
        pattern.fits(args.split)?;
    }
    if folder.exists() && !folder.is_dir() {
        return Err(format!("error: {} is not a folder", files::output_name(folder)));
    }
    let jobs = many::jobs(&args.jobs)?;
    files::check_formats(&jobs, &args.read)?;
    let mut forms = Forms::default();
    let mut rows = Vec::with_capacity(jobs.len());
    for job in &jobs {
        let Some(row) = forms.of(job, args, &reporter)? else { return Ok(Ending::Findings) };
        rows.push(row);
    }
    let newest = inputs::newest();
    inputs::are_many();
    jobs.iter().for_each(|job| inputs::note(job));
    let jobs: Vec<(PathBuf, usize)> = jobs.into_iter().zip(rows).collect();
    let parts = each_on(args.at_a_time, jobs, |(job, row)| parts_of(&job, row, args, &reporter));
    let numbered = parts.into_iter().flatten().enumerate().map(|(at, program)| {
        let number = args.options.program.map(|first| first.saturating_add(at as u32));
        Planned { number: number.or(program.number), ..program }
    });
    let mut planned = each_on(args.at_a_time, numbered.collect(), |mut program: Planned| {
        if program.to.is_ok() {
            let name = refused(|| name(&program, &forms.ready[program.ready], pattern.as_ref(), args, &reporter));
            match name {
                Ok((name, number)) => (program.to, program.printed) = (Ok(folder.join(name)), number),
                Err(refused) => program.to = Err(refused),
            }
        }
        program
    });
    apart(&planned)?;
    if !args.options.quiet {
        same_numbers(&planned, &forms.ready);
    }
    fs::create_dir_all(folder).map_err(|error| io_message("write", folder, &error))?;
    if args.changed {
        let all = planned.len();
        planned.retain(|program| !is_current(program, newest));
        if !args.options.quiet {
            let current = all - planned.len();
            let (is, its) = if current == 1 { ("is", "its") } else { ("are", "their") };
            message(&format!(
                "{current} of {} {is} newer than {its} job and form: not printed again",
                count(all, "program")
            ));
        }
    }
    let called = |program: &Planned| {
        let job = files::name(&program.job);
        program.part.map_or(job.clone(), |part| format!("{job} {}", part.name()))
    };
    many::run(args.at_a_time, planned, called, "program", |program| match &program.to {
        Ok(output) => {
            let name = files::output_name(output);
            let file = output.file_name().map(|name| name.to_string_lossy().into_owned());
            let task = Task {
                jobs: &[&program.job],
                output: folder,
                name: file.as_deref(),
                called: &name,
                part: program.part,
                number: program.number,
            };
            let ending =
                while_unchanged(output, newest, || print::print(&task, &forms.ready[program.ready], args, &reporter))?;
            Ok((String::new(), ending))
        }
        Err(refused) => {
            say(&refused.messages);
            Ok((String::new(), refused.ending))
        }
    })
}

/// Prints a program. The form and the other files that all programs share are read once, so it is an error if one of them
/// has changed since: the program would be newer than the form, but not of this form.
fn while_unchanged(
    output: &Path,
    newest: Option<SystemTime>,
    print: impl FnOnce() -> Result<Ending, String>,
) -> Result<Ending, String> {
    let unchanged = || match inputs::newest() == newest {
        true => Ok(()),
        false => Err("error: a form or another file that was read at the start has changed since\n  help: print the \
                      programs again, for example with --changed"
            .to_owned()),
    };
    unchanged()?;
    let ending = print()?;
    if ending == Ending::Clean
        && let Err(why) = unchanged()
    {
        // not newer than the form, so that `--changed` prints it again
        let old = fs::File::options().write(true).open(output);
        let set = old.and_then(|file| file.set_modified(newest.unwrap_or(SystemTime::UNIX_EPOCH)));
        set.map_err(|error| io_message("write", output, &error))?;
        return Err(why);
    }
    Ok(ending)
}

/// The forms of the jobs. Each form is prepared only once.
#[derive(Default)]
struct Forms {
    /// Indices of forms, by the path of the form and of the postform.toml of a job.
    rows: HashMap<(PathBuf, Option<PathBuf>), usize>,
    ready: Vec<Ready>,
}

impl Forms {
    /// The index of a job's form. `None`: the form has errors, which have been shown.
    fn of(&mut self, job: &Path, args: &RenderArgs, reporter: &Reporter) -> Result<Option<usize>, String> {
        let config = Config::near(job)?;
        let form = form_of(job, args, &config)?;
        let key = (form.clone(), config.path.clone());
        if let Some(&row) = self.rows.get(&key) {
            return Ok(Some(row));
        }
        let Some(ready) = Ready::of(&form, job, args, reporter)? else { return Ok(None) };
        self.ready.push(ready);
        self.rows.insert(key, self.ready.len() - 1);
        Ok(Some(self.ready.len() - 1))
    }
}

/// Runs some work for a job and keeps its messages. If the work fails, the messages become the reason for the failure.
fn refused<R>(work: impl FnOnce() -> Result<Result<R, Ending>, String>) -> Result<R, Refused> {
    let (done, messages) = kept(work);
    match done {
        Ok(Ok(done)) => Ok(done),
        Ok(Err(ending)) => Err(Refused { messages, ending }),
        Err(error) => Err(Refused { messages: format!("{messages}{error}\n"), ending: Ending::Failed }),
    }
}

/// The programs of a job.
fn parts_of(job: &Path, ready: usize, args: &RenderArgs, reporter: &Reporter) -> Vec<Planned> {
    let planned = |part, number, to| Planned { job: job.to_path_buf(), part, number, printed: None, ready, to };
    let Some(by) = args.split else { return vec![planned(None, None, Ok(PathBuf::new()))] };
    let found = refused(|| match split::parts(&mut files::job(job, &args.read, true)?, by) {
        Ok(found) if found.parts.is_empty() => {
            let what = if by == SplitArg::Setup { "setups: only CL files have setups" } else { "operations" };
            Err(format!("error: {} has no {what}\n  help: choose another --split", files::name(job)))
        }
        Ok(found) => Ok(Ok(found)),
        Err(error) => stopped(error, &[job], reporter, &[]).map(Err),
    });
    match found {
        Ok(found) => {
            if found.left_out > 0 && !args.options.quiet {
                let job = files::name(job);
                message(&format!("only a part of {job} is printed: its other operations are not in the programs"));
            }
            let numbers = |at: usize| Some((found.number? as u32).saturating_add(at as u32));
            let parts = found.parts.iter().enumerate();
            parts.map(|(at, part)| planned(Some(*part), numbers(at), Ok(PathBuf::new()))).collect()
        }
        Err(refused) => vec![planned(None, None, Err(refused))],
    }
}

/// The name of a program's file, and the program's number.
fn name(
    program: &Planned,
    ready: &Ready,
    pattern: Option<&Pattern>,
    args: &RenderArgs,
    reporter: &Reporter,
) -> Result<Result<(String, Option<u32>), Ending>, String> {
    let mut job = files::job(&program.job, &args.read, false)?;
    if let Some(part) = program.part {
        part.select(&mut job.reading);
    }
    let own_name = job_name(&program.job);
    let mut options = ready.prepared.options.clone();
    options.program = program.number.or(options.program);
    options.job_file = Some(own_name.clone());
    let (name, number) = match ready.prepared.post.file_name(job, &options) {
        Ok(named) => named,
        Err(error) => return stopped(error, &[&program.job], reporter, &[]).map(Err),
    };
    let number = number.map(|number| number as u32);
    let Some(pattern) = pattern else { return Ok(Ok((name, number))) };
    let extension = name.rsplit_once('.').map_or("nc", |(_, extension)| extension);
    let job = own_name.rsplit_once('.').map_or(own_name.as_str(), |(stem, _)| stem);
    let name = pattern.name(&Values { job, part: program.part, number, extension })?;
    Ok(Ok((name, number)))
}

/// The file name of a job, without the `.gz` of a compressed job; a file called `job` gets the name of its folder.
fn job_name(job: &Path) -> String {
    let unpacked = unpacked_name(job);
    let name = unpacked.as_deref().unwrap_or(job).file_name().unwrap_or_default().to_string_lossy();
    let (stem, extension) = name.rsplit_once('.').unwrap_or((&name, ""));
    let folder = files::folder(job).canonicalize().ok();
    match folder.as_deref().and_then(Path::file_name) {
        Some(folder) if stem == "job" => format!("{}.{extension}", folder.to_string_lossy()),
        _ => name.into_owned(),
    }
}

/// Checks that no program replaces another program.
fn apart(planned: &[Planned]) -> Result<(), String> {
    let mut names = HashMap::new();
    for program in planned {
        let Ok(to) = &program.to else { continue };
        // some file systems ignore the case of names
        let key = to.to_string_lossy().to_lowercase();
        if let Some(other) = names.insert(key, &program.job) {
            let (to, job, other) = (files::output_name(to), files::name(&program.job), files::name(other));
            let whose = match (job == other, program.part) {
                (true, Some(_)) => format!("two parts of {job}"),
                (true, None) => format!("{job}, given twice"),
                (false, _) => format!("{other} and {job}"),
            };
            return Err(format!(
                "error: {to} is the output file of {whose}: nothing was printed\n  help: give the programs different \
                 names, as --name '{{job}}-{{number}}'; for a job file named `job`, {{job}} is the name of its folder"
            ));
        }
    }
    Ok(())
}

/// Maximum number of equal program numbers that are named.
const MOST_NUMBERS: usize = 5;

/// Warns of programs with the same number: a control that stores programs by their numbers keeps only one program for
/// each number.
fn same_numbers(planned: &[Planned], forms: &[Ready]) {
    let prints: Vec<bool> = forms.iter().map(|form| form.prepared.post.prints_program_number()).collect();
    let mut first: HashMap<(usize, u32), &Planned> = HashMap::new();
    let mut equal = Vec::new();
    for program in planned.iter().filter(|program| program.to.is_ok() && prints[program.ready]) {
        let Some(number) = program.printed else { continue };
        match first.entry((program.ready, number)) {
            Entry::Vacant(entry) => _ = entry.insert(program),
            Entry::Occupied(entry) => equal.push((number, *entry.get(), program)),
        }
    }
    let name = |program: &Planned| program.to.as_ref().map_or(String::new(), |to| files::output_name(to));
    for (number, one, other) in equal.iter().take(MOST_NUMBERS) {
        message(&format!(
            "warning: {} and {} have the same program number {number}\n  help: give different numbers in the jobs, \
             or number all programs upwards: --program {number}",
            name(one),
            name(other)
        ));
    }
    if equal.len() > MOST_NUMBERS {
        message(&format!("and {} more with a number that another program has", equal.len() - MOST_NUMBERS));
    }
}

/// Whether the program exists and is newer than all of its sources.
fn is_current(program: &Planned, newest: Option<SystemTime>) -> bool {
    let changed = |path: &Path| fs::metadata(path).and_then(|meta| meta.modified()).ok();
    let made = program.to.as_ref().ok().and_then(|to| changed(to));
    made > changed(&program.job) && made > newest && newest.is_some()
}
