//! Programs proven: run as the control would, and compared with their job.

use std::io::{BufRead, Cursor, Seek};

use super::Post;
use super::options::{Options, Proof};
use crate::compile;
use crate::control::Control;
use crate::diag::Diag;
use crate::error::{Error, ErrorKind};
use crate::job::Job;
use crate::nc::RunSettings;
use crate::toolpath::{Event, Flow, Place, Sink, Units};
use crate::verify::{Comparer, Counts, Expectation, Verdict};

/// How a proof came out.
#[derive(Clone, Debug)]
#[must_use = "a program may be proven to be wrong"]
#[non_exhaustive]
pub struct Proven {
    /// Does the program make the job's motions?
    pub verdict: Verdict,
    /// How much was compared.
    pub counts: Counts,
    /// Warnings of running the program; their places are lines of it.
    pub warnings: Vec<Diag>,
}

impl Post {
    /// Does a program make the motions of its job? It is run by the rules of the form's `Control`.
    ///
    /// # Errors
    /// The job can't be read, or is wrong. What is wrong with the program is in the verdict.
    pub fn verify(&self, job: Job<'_>, program: impl AsRef<[u8]>) -> Result<Verdict, Error> {
        let proven = self.verify_with(job, Cursor::new(program.as_ref()), &Options::default(), &Proof::default())?;
        Ok(proven.verdict)
    }

    /// Does a program make the motions of its job? `options` are those that it was printed with.
    ///
    /// # Errors
    /// The job or the program can't be read, or the job is wrong. What is wrong with the program is in the verdict.
    pub fn verify_with(
        &self,
        job: Job<'_>,
        program: impl BufRead + Seek,
        options: &Options,
        proof: &Proof,
    ) -> Result<Proven, Error> {
        prove(Some(&self.0.program), job, program, options, proof)
    }

    /// How the control of this form runs a program that it printed, which counts in these units until it says others.
    pub fn run_settings(&self, proof: &Proof, units: Units) -> RunSettings {
        proof.settings(Some(&self.0.program), units)
    }
}

impl Proof {
    /// Does a program make the motions of its job? No form is known: nothing is filled in for the job.
    ///
    /// # Errors
    /// The job or the program can't be read, or the job is wrong. What is wrong with the program is in the verdict.
    pub fn verify(&self, job: Job<'_>, program: impl BufRead + Seek) -> Result<Proven, Error> {
        prove(None, job, program, &Options::default(), self)
    }

    /// How the control runs a program that this form printed.
    fn settings(&self, form: Option<&compile::Program>, units: Units) -> RunSettings {
        let form = form.map(|form| &form.settings);
        let of_form = form.and_then(|form| form.control);
        let control = self.control.or(of_form).unwrap_or_else(Control::usual);
        RunSettings {
            units,
            block_delete: self.block_delete,
            back_off: self.back_off,
            unpointed: self.unpointed,
            centers_absolute: form.is_some_and(|form| !form.centre_incremental),
            ..RunSettings::new(control)
        }
    }
}

fn prove(
    form: Option<&compile::Program>,
    mut job: Job<'_>,
    program: impl BufRead + Seek,
    options: &Options,
    proof: &Proof,
) -> Result<Proven, Error> {
    let settings = proof.settings(form, options.units.unwrap_or(Units::Mm));
    let expectation = form.map_or_else(Expectation::default, |form| {
        Expectation::of_form(&form.settings, options.sink_as_printed).typed(form)
    });
    let assumed = proof.control.is_none() && form.is_some_and(|form| form.settings.control.is_none());
    let comparer = Comparer::new(program, settings, expectation, proof.tolerance);
    let mut comparer = Started { comparer, of_job: form.is_none() || options.units.is_none() };
    let read = job.read(&mut comparer);
    let mut comparer = comparer.comparer;
    let (counts, warnings) = (comparer.counts(), comparer.warnings());
    let verdict = comparer.verdict().map_err(|error| Error::of_io(ErrorKind::Program, error))?;
    let verdict = if assumed { verdict.assumed(settings.control.name()) } else { verdict };
    match (read, &verdict) {
        // the comparison stopped the reader: the rest of the job was not looked at
        (Err(_), Verdict::Different(_) | Verdict::NotProven(_)) | (Ok(()), _) => {
            Ok(Proven { verdict, counts, warnings })
        }
        (Err(error), _) => Err(error.after(warnings, &[])),
    }
}

/// Before the first event, the program counts in the job's units unless it was printed in others.
struct Started<R> {
    comparer: Comparer<R>,
    of_job: bool,
}

impl<R: BufRead + Seek> Sink for Started<R> {
    fn event(&mut self, event: Event<'_>, place: Place) -> Flow {
        if let (Event::Start(start), true) = (&event, self.of_job) {
            self.comparer.begin_in(start.units);
        }
        self.comparer.event(event, place)
    }
}
