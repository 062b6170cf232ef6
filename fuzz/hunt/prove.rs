//! A form for the hunt: it prints jobs and verifies programs.

use std::collections::BTreeSet;

use postform::internals::verify::Batch;
use postform::internals::verify::Finding;
use postform::toolpath::{Place, Units};
use postform::{Error, Job, NoFiles, Options, Post, Proven, Source, Verdict};

use crate::job::{Kind, Takes};
use crate::judge::languages::{as_fanuc, is_one};
use crate::judge::{Act, MAIN, beam, lathe, run, wire};
use crate::random::Random;

/// A form that prints.
pub struct Form {
    /// The file name without its extension.
    pub name: String,
    /// The control that runs the form's programs.
    pub control: String,
    /// The kinds of jobs that the form can print.
    pub kinds: Vec<Kind>,
    /// The features of jobs that the form supports.
    pub takes: Takes,
    /// Whether programs are in inches, if the form fixes the units. `None`: a program has the units of its job.
    pub inch: Option<bool>,
    /// Tolerance of positions in millimetres: the resolution of the form's digits, with an allowance for sums of
    /// positions.
    pub within: f64,
    /// Whether the program has another letter for the job's A.
    pub renames: bool,
    /// Whether X of a lathe is a diameter.
    pub by_diameter: bool,
    /// Whether `lint` warns that the formats round away digits of a job.
    pub cuts_digits: bool,
    /// The text of the form.
    pub text: String,
    post: Post,
}

/// The code and the message of an error.
pub type Said = (String, String);

impl Form {
    /// Reads a form that calls no other form.
    ///
    /// # Errors
    /// An error of the form.
    pub fn read(name: &str, text: &str) -> Result<Form, Error> {
        let post = Post::compile(Source::from_text(name, text), &NoFiles)?;
        let cuts_digits = post.findings().diags.iter().any(|diag| diag.code.name() == "PF306");
        let says = |line: &str| text.lines().any(|other| other.trim_end() == line);
        let inch = [("Units inch", true), ("Units mm", false)].into_iter().find(|(line, _)| says(line));
        let control = text.lines().find_map(|line| line.strip_prefix("Control ")).unwrap_or("fanuc");
        let kinds = match (says("Machine Lathe"), says("Machine EDM")) {
            (true, _) => vec![Kind::Lathe],
            (_, true) => vec![Kind::Wire],
            _ if says("Machine Torch") || says("Machine Laser") => vec![Kind::Beam],
            _ => {
                let more = [(Kind::Rotary, text.contains("A[rotangle]")), (Kind::Subprograms, says("SubCall"))];
                let more = more.into_iter().filter(|(_, can)| *can).map(|(kind, _)| kind);
                let mills = [Kind::Mill, Kind::Statements, Kind::Program, Kind::Document];
                mills.into_iter().chain(more).collect()
            }
        };
        Ok(Form {
            name: name.into(),
            control: control.trim().into(),
            kinds,
            inch: inch.map(|(_, inch)| inch),
            takes: Takes {
                customs: ["Custom1", "Custom2", "Custom3"].map(says),
                home: says("MoveHome"),
                codes: !is_one(control.trim()),
                works: text.contains("\nMoreWork "),
            },
            within: if text.contains("X->5.>2") { 0.011 } else { 0.0035 },
            renames: says("Rename A B"),
            by_diameter: !says("ByDiameter? N"),
            cuts_digits,
            text: text.into(),
            post,
        })
    }

    /// Runs a program of this form on the judge's own machine. `inch`: the units are inches until the program sets them.
    ///
    /// # Errors
    /// The line at which the machine stops, and the reason.
    pub fn run(&self, program: &str, inch: bool) -> Result<Vec<Act>, (usize, String)> {
        match self.kinds.first() {
            Some(Kind::Lathe) => lathe::run(program, self.by_diameter, inch),
            Some(Kind::Wire) => wire::run(program, inch),
            Some(Kind::Beam) => Ok(beam::flat(run(program, &self.control, inch)?)),
            _ if is_one(&self.control) => {
                let text = as_fanuc(program, &self.control)?;
                run(&text, "fanuc", inch)
            }
            _ => run(program, &self.control, inch),
        }
    }

    /// Prints a job in inches or millimetres. Returns true if lint or the renderer warns that digits are lost.
    ///
    /// # Errors
    /// The code and the message of the error.
    pub fn render(&self, job: Job<'_>, inch: bool) -> Result<(String, bool), Said> {
        let mut options = options(inch);
        options.proof = None;
        let program = self.post.render(job, &options);
        let lost = |program: &postform::Program| program.notes().iter().any(|note| note.code.name() == "PR025");
        program
            .map(|program| {
                let lost = self.cuts_digits || lost(&program);
                (program.into_text(), lost)
            })
            .map_err(|error| said(&error))
    }

    /// Verifies a program against its job. The tolerance is in the job's units.
    pub fn verify(&self, program: &str, job: Job<'_>, inch: bool, tolerance: Option<f64>) -> Proof {
        let mut proof = postform::Proof::default();
        proof.tolerance = tolerance;
        let program = std::io::Cursor::new(program);
        proof_of(self.post.verify_with(job, program, &options(inch), &proof))
    }

    /// The verdict in one line with its counts, as the files of `tests/data/proofs` contain it.
    pub fn verdict(&self, program: &str, job: Job<'_>, inch: bool) -> String {
        let program = std::io::Cursor::new(program);
        match self
            .post
            .verify_with(job, program, &options(inch), &postform::Proof::default())
            .map(|proven| proven.verdict)
        {
            Ok(Verdict::Identical) => "identical".into(),
            Ok(Verdict::Equivalent(allowed)) => {
                let counted = allowed.named().filter(|(_, count)| *count > 0);
                format!(
                    "equivalent: {}",
                    counted.map(|(name, count)| format!("{count} {name}")).collect::<Vec<_>>().join(", ")
                )
            }
            Ok(Verdict::Different(findings)) => {
                let codes: BTreeSet<&str> = findings.iter().map(|finding| finding.code.name()).collect();
                format!("different: {}", codes.into_iter().collect::<Vec<_>>().join(", "))
            }
            Ok(Verdict::NotProven(unproven)) => format!("not proven: {}", unproven.why),
            Ok(_) => "unknown".into(),
            Err(error) => format!("error: {}", said(&error).0),
        }
    }

    /// Prints a job and proves it during printing, as `render` of the command line does, but in parts of random size.
    pub fn prove_beside(&self, job: Job<'_>, inch: bool, random: &mut Random) -> Proof {
        let mut whole = Batch::default();
        let rendered = self.post.render_beside(job, &options(inch), &mut |_| Ok(()), &mut |batch| {
            whole.events.extend(batch.events);
            whole.text.extend(batch.text);
            whole.trace.extend(batch.trace);
            Some(Batch::default())
        });
        if let Err(error) = rendered {
            return Proof::NotProven(said(&error));
        }
        let mut batches = Vec::new();
        let Batch { mut events, mut text, .. } = whole;
        while !events.is_empty() || !text.is_empty() {
            let mut batch = Batch::default();
            let (some, more) = (random.below(events.len() + 1), random.below(text.len() + 1));
            let of = 1 + random.below(8);
            batch.events = events.drain(..some.div_ceil(of)).collect();
            batch.text = text.drain(..more.div_ceil(of)).collect();
            batches.push(batch);
        }
        proof_of(self.post.prove(batches.into_iter(), &options(inch), &postform::Proof::default()))
    }
}

/// Options for printing. They set the program number, because a CL file has no program number.
fn options(inch: bool) -> Options {
    let mut options = Options::default();
    options.program = Some(MAIN);
    options.units = Some(if inch { Units::Inch } else { Units::Mm });
    options
}

fn proof_of(proven: Result<Proven, Error>) -> Proof {
    match proven.map(|proven| proven.verdict) {
        Ok(Verdict::Identical) => Proof::Identical,
        Ok(Verdict::Equivalent(_)) => Proof::Equivalent,
        Ok(Verdict::Different(findings)) => {
            let place = |place: Option<Place>| place.map(|place| place.to_string()).unwrap_or_default();
            let what = |f: &Finding| format!("line {}: {} [{}] {}", f.line, f.message, f.block, place(f.place));
            Proof::Different(findings.iter().map(|f| (f.code.name().to_owned(), what(f))).collect())
        }
        Ok(Verdict::NotProven(unproven)) => Proof::NotProven(("unproven".into(), unproven.why)),
        Ok(_) => Proof::NotProven(("unknown".into(), "a verdict that is not known here".into())),
        Err(error) => Proof::NotProven(said(&error)),
    }
}

fn said(error: &Error) -> Said {
    let diag = error.findings().diags.iter().find(|diag| diag.is_error());
    match diag {
        Some(diag) => {
            let place = diag.place.as_ref().map(ToString::to_string).unwrap_or_default();
            (diag.code.name().to_owned(), format!("{} {place}", diag.message))
        }
        None => ("none".into(), error.to_string()),
    }
}

/// The result of verifying.
#[derive(Clone, Debug, PartialEq)]
pub enum Proof {
    /// Identical: the same motions.
    Identical,
    /// Equivalent: the same cuts.
    Equivalent,
    /// The differences.
    Different(Vec<Said>),
    /// The reason why nothing is proven.
    NotProven(Said),
}

impl Proof {
    /// Whether the verdict is identical or equivalent.
    pub fn holds(&self) -> bool {
        matches!(self, Proof::Identical | Proof::Equivalent)
    }

    /// The verdict in one word; for a difference, with its first code.
    pub fn name(&self) -> String {
        match self {
            Proof::Identical => "identical".into(),
            Proof::Equivalent => "equivalent".into(),
            Proof::Different(list) => format!("different {}", list.first().map_or("", |(code, _)| code)),
            Proof::NotProven((code, _)) => format!("not proven {code}"),
        }
    }
}
