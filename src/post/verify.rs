//! Verifies programs: simulates a program by the rules of its control and compares it with its job.

use std::collections::HashSet;
use std::io::{Cursor, Read, Seek};
use std::path::Path;

use super::Post;
use super::options::{Options, Proof};
use super::reading::read_for;
use crate::compile;
use crate::control::{self, Control};
use crate::diag::{Code, Diag, Findings};
use crate::error::{Error, ErrorKind};
use crate::job::{Format, Job};
use crate::nc::{RunSettings, settings_for};
use crate::number::Point;
use crate::preflight::JobTool;
use crate::render::coolant_codes;
use crate::toolpath::{Coolant, Event, Flow, Place, Sink, Units};
use crate::verify::{Batch, Comparer, Counts, Expectation, Finding, Outcome, Verdict, prove_beside};

/// The result of a verification.
#[derive(Clone, Debug)]
#[must_use = "a program may be proven to be wrong"]
#[non_exhaustive]
pub struct Proven {
    /// Verdict on the motions.
    pub verdict: Verdict,
    /// How many cuts and holes were compared.
    pub counts: Counts,
    /// Warnings about the program from its simulation. The locations of the warnings are lines of the program.
    pub warnings: Vec<Diag>,
}

impl Post {
    /// Verifies that a program makes the motions of its job. The program is simulated by the rules of the control that the form names.
    ///
    /// # Errors
    /// The job can't be read or contains an error. Errors in the program are part of the verdict.
    pub fn verify(&self, job: Job<'_>, program: impl AsRef<[u8]>) -> Result<Verdict, Error> {
        let proven = self.verify_with(job, Cursor::new(program.as_ref()), &Options::default(), &Proof::default())?;
        Ok(proven.verdict)
    }

    /// Verifies that a program makes the motions of its job. `options` are the options with which the program was
    /// printed.
    ///
    /// # Errors
    /// The job or the program can't be read, or the job contains an error. Errors in the program are part of the verdict.
    pub fn verify_with(
        &self,
        job: Job<'_>,
        program: impl Read + Seek,
        options: &Options,
        proof: &Proof,
    ) -> Result<Proven, Error> {
        prove(Some(&self.0.program), job, program, options, proof)
    }

    /// Settings for simulating a program that this form printed. `units` apply until the program sets its own units.
    #[doc(hidden)]
    pub fn run_settings(&self, proof: &Proof, units: Units) -> RunSettings {
        proof.settings(Some(&self.0.program), units)
    }

    /// Whether X in the programs of a lathe form is a diameter. `None`: the form is not for a lathe.
    #[doc(hidden)]
    pub fn turns(&self) -> Option<bool> {
        let settings = &self.0.program.settings;
        (settings.machine == crate::lang::Machine::Lathe).then_some(settings.by_diameter)
    }

    /// The tools of a job. The diameters of the tools are in millimetres.
    ///
    /// # Errors
    /// The job can't be read.
    #[doc(hidden)]
    pub fn job_tools(&self, job: Job<'_>) -> Result<Vec<JobTool>, Error> {
        tools_of(Some(&self.0.program), job)
    }

    /// The codes that turn on coolant in the form, with the kinds of coolant.
    #[doc(hidden)]
    pub fn coolant_codes(&self) -> Vec<(control::Code, Coolant)> {
        let settings = &self.0.program.settings;
        let kinds = [Coolant::FLOOD, Coolant::MIST].into_iter().chain(Coolant::FURTHER);
        let code = |kind| Some((control::Code::of(b'M', coolant_codes(kind, settings)?.on)?, kind));
        kinds.filter_map(code).collect()
    }

    /// Completes findings about the machine: adds the form line and the job item that printed the block of each finding.
    ///
    /// # Errors
    /// The job can't be read again, or an option is invalid.
    #[doc(hidden)]
    pub fn locate(&self, findings: &mut [Finding], job: Job<'_>, options: &Options) -> Result<(), Error> {
        let lines: Vec<u64> = findings.iter().map(|finding| finding.line).collect();
        if lines.is_empty() {
            return Ok(());
        }
        for (finding, origin) in findings.iter_mut().zip(self.origins(job, options, &lines)?) {
            if let Some(origin) = origin {
                finding.locate(origin);
            }
        }
        Ok(())
    }

    /// Verifies that the program from [`Post::render_beside`] makes the motions of its job. `batches` may be the receiving end of
    /// a channel. A batch is requested only when it is compared next, and none is requested after the verdict is known. Each
    /// batch is dropped after its comparison; a type that wraps a batch may then return it to be filled again. This function does
    /// not check whether the job can be printed to its end.
    ///
    /// # Errors
    /// No error is expected, because a printed program can always be read.
    #[doc(hidden)]
    pub fn prove<B: AsRef<Batch>>(
        &self,
        batches: impl Iterator<Item = B>,
        options: &Options,
        proof: &Proof,
    ) -> Result<Proven, Error> {
        let plan = Plan::new(Some(&self.0.program), options, proof);
        let outcome = prove_beside(batches, plan.settings, plan.expectation, proof.tolerance, plan.in_units_of_job);
        let Outcome { verdict, counts, warnings } = outcome.map_err(|error| Error::of_io(ErrorKind::Program, error))?;
        Ok(Proven {
            verdict: if plan.assumed { verdict.assumed(plan.settings.control.name()) } else { verdict },
            counts,
            warnings,
        })
    }

    /// The verdict on a program that was printed immediately before.
    pub(super) fn proven(
        &self,
        mut job: Job<'_>,
        text: &str,
        options: &Options,
        proof: &Proof,
    ) -> Result<Verdict, Error> {
        let proven = self.verify_with(job.again(), Cursor::new(text), options, proof)?;
        Ok(self.located(proven, job, options)?.verdict)
    }

    /// The error for a verdict with which a program must not be used; `None` if it may be used.
    pub(super) fn refused(&self, verdict: &Verdict, proof: &Proof) -> Option<Error> {
        let diags = match verdict {
            Verdict::Different(_) => verdict.diags("the program"),
            Verdict::NotProven(unproven) if proof.required => {
                vec![Diag::new(Code::PV020, verdict.to_string()).help(&unproven.help)]
            }
            _ => return None,
        };
        Some(Error::proof(Findings { diags, files: self.files().to_vec(), suppressed: 0 }))
    }

    /// Completes the findings of a verification: adds the form line that printed the block of each finding. If there
    /// are findings, the job is printed again to find these lines. `options` are the options with which the program was
    /// printed.
    ///
    /// # Errors
    /// The job can't be read again, or an option is invalid.
    #[doc(hidden)]
    pub fn located(&self, mut proven: Proven, job: Job<'_>, options: &Options) -> Result<Proven, Error> {
        let findings = match &mut proven.verdict {
            Verdict::Different(findings) => findings,
            Verdict::NotProven(unproven) => &mut unproven.notes,
            _ => return Ok(proven),
        };
        self.locate(findings, job, options)?;
        Ok(proven)
    }
}

/// A sink that collects the tools of a job.
struct Tools {
    /// Number of millimetres in a unit of the job.
    scale: f64,
    tools: Vec<JobTool>,
    /// The numbers of these tools.
    numbers: HashSet<u32>,
}

fn tools_of(form: Option<&compile::Program>, mut job: Job<'_>) -> Result<Vec<JobTool>, Error> {
    let mut tools = Tools { scale: 1.0, tools: Vec::new(), numbers: HashSet::new() };
    read_for(form.map(|form| &form.settings), &mut job, &mut tools)?;
    Ok(tools.tools)
}

impl Sink for Tools {
    fn event(&mut self, event: Event<'_>, _: Place) -> Flow {
        match event {
            Event::Start(start) => self.scale = start.units.in_mm(),
            Event::ToolChange(change) => {
                if let Some(tool) = &change.tool
                    && self.numbers.insert(tool.number as u32)
                {
                    let [diameter, corner_radius] =
                        [tool.diameter, tool.corner_radius].map(|length| length.map(|length| length * self.scale));
                    let (number, name) = (tool.number as u32, tool.name.clone());
                    self.tools.push(JobTool { number, name, diameter, corner_radius });
                }
            }
            _ => {}
        }
        Flow::Continue(())
    }
}

impl Proof {
    /// Verifies that a program makes the motions of its job. There is no form, so the job gets no defaults.
    ///
    /// # Errors
    /// The job or the program can't be read, or the job contains an error. Errors in the program are part of the verdict.
    pub fn verify(&self, job: Job<'_>, program: impl Read + Seek) -> Result<Proven, Error> {
        let options = Options { units: self.units, ..Options::default() };
        prove(None, job, program, &options, self)
    }

    /// The tools of a job if there is no form. The diameters of the tools are in millimetres.
    ///
    /// # Errors
    /// The job can't be read.
    #[doc(hidden)]
    pub fn job_tools(&self, job: Job<'_>) -> Result<Vec<JobTool>, Error> {
        tools_of(None, job)
    }

    /// The settings for simulating a program. `form`: the form that printed the program, if any.
    fn settings(&self, form: Option<&compile::Program>, units: Units) -> RunSettings {
        let implied =
            |form: &compile::Program| form.letters.iter().all(|letters| letters[b'F'].format.point == Point::Implied);
        let whole_feeds = form.is_some_and(implied);
        let form = form.map(|form| &form.settings);
        let of_form = form.and_then(|form| form.control);
        let control = self.control.or(of_form).or(self.default_control).unwrap_or_else(Control::usual);
        let lathe = form.filter(|form| form.machine == crate::lang::Machine::Lathe);
        let control = match form.map(|form| form.machine) {
            Some(crate::lang::Machine::Lathe) => control.of_lathe(),
            Some(crate::lang::Machine::Edm) => control.of_wire(),
            _ => control,
        };
        RunSettings {
            by_diameter: lathe.map(|form| form.by_diameter),
            units,
            block_delete: self.block_delete,
            back_off: self.back_off,
            unpointed: self.unpointed,
            whole_feeds,
            centers_absolute: form.is_some_and(|form| !form.centre_incremental),
            assumed: self.control.or(self.default_control).is_none() && form.is_none(),
            ..RunSettings::new(control)
        }
    }
}

/// The settings of a simulation, and the values with which its motions are compared.
struct Plan {
    settings: RunSettings,
    expectation: Expectation,
    /// Whether the program begins in the units of the job.
    in_units_of_job: bool,
    /// Whether the control is assumed, because neither the caller nor the form names a control.
    assumed: bool,
}

impl Plan {
    fn new(form: Option<&compile::Program>, options: &Options, proof: &Proof) -> Plan {
        let settings = proof.settings(form, options.units.unwrap_or(Units::Mm));
        Plan::of(form, options, proof, settings)
    }

    fn of(form: Option<&compile::Program>, options: &Options, proof: &Proof, settings: RunSettings) -> Plan {
        Plan {
            settings,
            expectation: form.map_or_else(
                || Expectation::of_control(&settings),
                |form| {
                    // an invalid value is reported as an error when the program is printed
                    let given = options.given_properties(&form.settings).unwrap_or_default();
                    Expectation::of_form(&form.settings, options.sink_as_printed).typed(form).given(&given)
                },
            ),
            in_units_of_job: options.units.is_none(),
            assumed: proof.control.or(proof.default_control).is_none()
                && form.is_some_and(|form| form.settings.control.is_none()),
        }
    }
}

fn prove(
    form: Option<&compile::Program>,
    mut job: Job<'_>,
    mut program: impl Read + Seek,
    options: &Options,
    proof: &Proof,
) -> Result<Proven, Error> {
    let settings = proof.settings(form, options.units.unwrap_or(Units::Mm));
    let settings =
        settings_for(&mut program, Path::new(""), settings).map_err(|error| Error::of_io(ErrorKind::Program, error))?;
    let Plan { settings, mut expectation, in_units_of_job, assumed } = Plan::of(form, options, proof, settings);
    // if the job is itself an NC program, it has its own length registers, or none
    expectation.lengths_due = form.is_some() || job.format() != Format::Nc;
    // in an NC program, M29 makes a tap rigid, so the other program needs M29 too
    expectation.announces_taps |= form.is_none() && job.format() == Format::Nc;
    expectation.units_due &= form.is_some() || options.units.is_none();
    let mut comparer = Comparer::new(program, settings, expectation, proof.tolerance, in_units_of_job);
    let read = read_for(form.map(|form| &form.settings), &mut job, &mut comparer);
    let (counts, warnings, decided) = (comparer.counts(), comparer.warnings(), comparer.is_decided());
    let verdict = comparer.verdict().map_err(|error| Error::of_io(ErrorKind::Program, error))?;
    let verdict = if assumed { verdict.assumed(settings.control.name()) } else { verdict };
    match read {
        Err(error) if !decided => Err(job.names(error).after(warnings, &[])),
        // the comparison stopped the reader, so the rest of the job is not checked
        _ => Ok(Proven { verdict, counts, warnings }),
    }
}
