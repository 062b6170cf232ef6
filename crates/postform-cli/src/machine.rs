//! Machine files, and the check whether programs fit into a machine.

use std::io::{Read, Seek, Write as _};
use std::path::Path;

use postform::diag::{Diag, Location, Severity};
use postform::internals::machine::{self, Machine};
use postform::internals::nc::{RunSettings, settings_for};
use postform::internals::preflight::{Fitted, Known, Times, preflight};
use postform::internals::terminal::{escaped, escaped_lines};
use postform::toolpath::Units;
use postform::{Control, Finding, Job, Options, Post, Proof, Source};

use super::args::{ControlArgs, FitArgs, MachineArg, MachineArgs, MachineCommand, VerifyFormat};
use super::config::Config;
use super::files::{self, io_message};
use super::prepare::Prepared;
use super::report::{Reporter, count, place_in, place_in_jobs};
use super::say::{message, say};
use super::{Ending, output};

/// Reads the file of a machine, and the files that it names.
///
/// # Errors
/// A message: a file can't be read, or contains an error, with line and column.
pub fn read(path: &Path) -> Result<Machine, String> {
    let folder = files::folder(path).to_owned();
    let beside = |name: &str| text(&folder.join(name)).map_err(|why| why.trim_start_matches("error: ").to_owned());
    let read = machine::read(&files::name(path), &text(path)?, &beside);
    read.map_err(|wrong| format!("error: {}", escaped_lines(&wrong.to_string())))
}

fn text(path: &Path) -> Result<String, String> {
    files::small_text(path, "a machine file")
}

/// The machine from an option, the form, or postform.toml.
///
/// # Errors
/// The machine file can't be read, or contains an error.
pub fn named(arg: &MachineArg, form: Option<(&Path, &Post)>, config: &Config) -> Result<Option<Machine>, String> {
    let of_form = form.and_then(|(form, post)| Some(files::folder(form).join(post.machine_file()?)));
    let path = arg.machine.clone().or(of_form).or(config.machine.clone());
    path.as_deref().map(read).transpose()
}

/// The machine of a form that prints programs. Its accelerations are used for the times in the programs.
///
/// # Errors
/// The machine file can't be read, or contains an error.
pub fn of_prepared(arg: &MachineArg, form: &Path, prepared: &mut Prepared) -> Result<Option<Machine>, String> {
    let machine = named(arg, Some((form, &prepared.post)), &prepared.config)?;
    prepared.options.rates = machine.as_ref().and_then(|machine| machine.rates().ok());
    Ok(machine)
}

/// A program and the machine into which it must fit.
pub struct Fitting<'a> {
    pub machine: &'a Machine,
    /// The settings for running the program.
    pub settings: RunSettings,
    /// What the job and the form add, if there is a job.
    pub known: Known,
    /// The name of the program.
    pub program: &'a str,
}

impl Fitting<'_> {
    /// Runs the program on the machine.
    ///
    /// # Errors
    /// The program can't be read.
    pub fn fitted(&self, program: impl Read + Seek) -> Result<Fitted, String> {
        let fitted = preflight(program, self.settings, self.machine, &self.known);
        fitted.map_err(|error| io_message("read", Path::new(self.program), &error))
    }

    /// The control that determines the names of offsets.
    pub fn control(&self) -> &'static Control {
        self.settings.control
    }

    /// Shows the findings, and everything that is not checked.
    pub fn show(&self, fitted: &Fitted, (jobs, sources): (&[&Path], &[Source]), reporter: &Reporter) {
        let diags: Vec<Diag> = fitted.findings.iter().map(|finding| diag(finding, self.program, jobs)).collect();
        say(&reporter.text(&diags, sources));
        for what in &fitted.fit.not_checked {
            message(&format!("not checked: {}", escaped(what)));
        }
    }

    /// The allowed range for each unknown offset and length, one sentence each.
    pub fn sentences(&self, fitted: &Fitted) -> String {
        let sentences = fitted.fit.sentences(self.machine, self.control());
        sentences.iter().map(|sentence| format!("{sentence}\n")).collect()
    }

    /// The time of the program on the machine, in one line.
    pub fn time(&self, times: &Times) -> String {
        format!("time on {} {}\n", escaped(&self.machine.name), times.sentence())
    }

    /// The result in a sentence.
    pub fn sentence(&self, fitted: &Fitted) -> String {
        let (program, machine) = (self.program, escaped(&self.machine.name));
        let sentences = fitted.fit.sentences(self.machine, self.control());
        let errors = fitted.findings.iter().filter(|finding| finding.code.row().severity == Severity::Error).count();
        match (errors, fitted.findings.len()) {
            (0, 0) if fitted.refused.is_some() => format!("{program} could not be run to its end for {machine}\n"),
            (0, 0) if sentences.is_empty() => format!("{program} fits into {machine}\n"),
            (0, 0) => format!("{program} fits into {machine} if the offsets and lengths are in the intervals above\n"),
            (0, warnings) => format!("{program} fits into {machine}, with {}\n", count(warnings, "warning")),
            (errors, _) => format!("{program} does not fit into {machine}: {}\n", count(errors, "error")),
        }
    }

    /// The result as JSON for other programs.
    pub fn document(&self, fitted: &Fitted) -> serde_json::Value {
        let mut document = fitted.fit.json(self.machine, self.control());
        let findings: Vec<serde_json::Value> = fitted.findings.iter().map(finding_json).collect();
        if let Ok(times) = &fitted.times {
            document["seconds"] = times.json();
        }
        document["findings"] = findings.into();
        document["fits"] = fitted.fits().into();
        document
    }
}

/// A finding of a program with its location in the job, or in the program if there is no job.
pub fn diag(finding: &Finding, program: &str, jobs: &[&Path]) -> Diag {
    if jobs.is_empty() {
        let text = match finding.block.as_str() {
            "" => finding.message.clone(),
            block => format!("{}, in `{block}`", finding.message),
        };
        let mut diag = Diag::new(finding.code, text).help(finding.help);
        if finding.line > 0 {
            diag = diag.place(Location::line(finding.line));
        }
        place_in(program, &mut diag);
        return diag;
    }
    let mut diag = finding.diag(program);
    place_in_jobs(jobs, &mut diag);
    diag
}

/// A finding of a program as JSON.
fn finding_json(finding: &Finding) -> serde_json::Value {
    serde_json::json!({
        "code": finding.code.name(), "severity": finding.code.row().severity.name(),
        "message": finding.message, "help": finding.help, "line": finding.line, "block": finding.block,
        "times": finding.times,
    })
}

/// Checks a form's program on a machine. If the job can be read again, the findings contain form lines and job items.
///
/// # Errors
/// The program can't be read.
pub fn of_post<'a>(
    post: &Post,
    machine: &'a Machine,
    (job, options): (&mut Job<'_>, &Options),
    proof: &Proof,
    (program, name): (impl Read + Seek, &'a str),
) -> Result<(Fitted, Fitting<'a>), String> {
    let again = !job.is_stream();
    let reads = again && machine.tools.is_some();
    let tools = if reads { post.job_tools(job.again()) } else { Ok(Vec::new()) };
    let tools = tools.map_err(|error| format!("error: the job can't be read again: {error}"))?;
    let settings = post.run_settings(proof, options.units.unwrap_or(Units::Mm));
    let known = Known { tools, coolant: post.coolant_codes() };
    let fitting = Fitting { machine, settings, known, program: name };
    let mut fitted = fitting.fitted(program)?;
    if again {
        // if this fails, the findings stay without locations
        _ = post.locate(&mut fitted.findings, job.again(), options);
    }
    Ok((fitted, fitting))
}

/// `postform fit`.
pub fn fit(args: &FitArgs, colour: bool) -> Result<Ending, String> {
    let config = Config::near(&args.program)?;
    let Some(machine) = named(&args.machine, None, &config)? else {
        let help = "give --machine, or name a machine in a postform.toml in the folder of the program or above: \
            machine = \"vf2.toml\"";
        return Err(format!("error: no machine is given\n  help: {help}"));
    };
    let control =
        ControlArgs { control: args.control.control.or(machine.control).or(config.control), ..args.control.clone() };
    let mut program = files::open_program(&args.program)?;
    let settings = settings_for(&mut program, &args.program, control.settings(None, args.units.units()))
        .map_err(|error| io_message("read", &args.program, &error))?;
    let name = files::name(&args.program);
    let fitting = Fitting { machine: &machine, settings, known: Known::default(), program: &name };
    let fitted = fitting.fitted(program)?;
    let text = match args.format {
        VerifyFormat::Text => {
            fitting.show(&fitted, (&[], &[]), &Reporter::new(colour));
            let time = fitted.times.as_ref().map_or_else(|_| String::new(), |times| fitting.time(times));
            let table = fitted.fit.table(&machine, fitting.control());
            table + &time + &fitting.sentences(&fitted) + &fitting.sentence(&fitted)
        }
        VerifyFormat::Json => output::json(&fitting.document(&fitted)),
    };
    output::standard_output(|out| out.write_all(text.as_bytes()))?;
    Ok(if fitted.fits() { Ending::Clean } else { Ending::Findings })
}

/// `postform machine`.
pub fn run(args: &MachineArgs) -> Result<Ending, String> {
    let MachineCommand::Check { file } = &args.command;
    let machine = read(file)?;
    output::shown(|out| out.write_all(machine::summary(&machine).as_bytes()))
}
