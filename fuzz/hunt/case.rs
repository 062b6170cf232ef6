//! What a seed makes: a job, its format, and a form to print it with.

use postform::Format;
use serde_json::Value;

use crate::cl::for_cl;
use crate::job::{Kind, job};
use crate::judge::rs274::interpreted;
use crate::judge::{Want, Wanted, against, wants};
use crate::prove::{Form, Proof, Said};
use crate::random::Random;
use crate::text::written;

/// What the command line asks for: `COUNT SEED KIND FORM`, of which each may be missing.
pub struct Asked {
    /// How many.
    pub count: u64,
    /// The first seed.
    pub first: u64,
    kinds: Vec<Kind>,
    forms: Vec<Form>,
}

impl Asked {
    /// Of the command line.
    pub fn of(args: impl Iterator<Item = String>, forms: Vec<Form>) -> Asked {
        let args: Vec<String> = args.collect();
        let number = |at: usize, default: u64| args.get(at).and_then(|arg| arg.parse().ok()).unwrap_or(default);
        let asked = |at: usize, name: &str| args.get(at).is_none_or(|arg| arg == "all" || arg == name);
        Asked {
            count: number(0, 10_000),
            first: number(1, 0),
            kinds: Kind::ALL.iter().filter(|(name, _)| asked(2, name)).map(|(_, kind)| *kind).collect(),
            forms: forms.into_iter().filter(|form| asked(3, &form.name)).collect(),
        }
    }

    /// The case of a seed, and the random numbers behind it; none where no form prints such a job.
    pub fn case(&self, seed: u64) -> Option<(Case<'_>, Random)> {
        let mut random = Random::new(seed);
        let kind = random.pick(&self.kinds);
        let able: Vec<&Form> = self.forms.iter().filter(|form| form.kinds.contains(&kind)).collect();
        let form = *able.get(random.below(able.len()))?;
        let job = job(kind, form.takes, &mut random);
        let format = match kind {
            Kind::Mill => random.pick(&[Format::Json, Format::JsonLines, Format::Cl]),
            _ => random.pick(&[Format::Json, Format::JsonLines]),
        };
        Some((Case { seed, kind, form, format, job }, random))
    }
}

/// A job that is printed with a form.
pub struct Case<'f> {
    /// Which makes it again.
    pub seed: u64,
    /// What the job is for.
    pub kind: Kind,
    /// The form.
    pub form: &'f Form,
    /// How the job is written.
    pub format: Format,
    /// The job, as a document.
    pub job: Value,
}

/// What became of a job.
#[derive(Clone, Debug)]
pub enum End {
    /// The form does not print it.
    Refused(Said),
    /// A panic.
    Panicked,
    /// The program, what comparing says of it, and whether lint or the renderer says that its digits are too few.
    Printed(String, Proof, bool),
}

impl End {
    /// In a few words: what must stay the same while a job is made smaller.
    pub fn name(&self) -> String {
        match self {
            End::Refused((code, _)) => format!("refused {code}"),
            End::Panicked => "panic".into(),
            End::Printed(_, proof, _) => proof.name(),
        }
    }
}

impl<'f> Case<'f> {
    /// The same with another job.
    pub fn with(&self, job: &Value) -> Case<'f> {
        Case { job: job.clone(), ..*self }
    }

    /// The job's text.
    pub fn text(&self) -> String {
        written(&self.job, self.format)
    }

    /// What the text says, as a document.
    pub fn said(&self) -> Value {
        if self.format == Format::Cl { for_cl(&self.job) } else { self.job.clone() }
    }

    /// Prints it and compares.
    pub fn end(&self) -> End {
        let text = self.text();
        let run = || match self.form.render(&text, self.format) {
            Err(said) => End::Refused(said),
            Ok((program, lost)) => {
                let proof = self.form.verify(&program, &text, self.format);
                End::Printed(program, proof, lost)
            }
        };
        std::panic::catch_unwind(std::panic::AssertUnwindSafe(run)).unwrap_or(End::Panicked)
    }

    /// What the judge says of a program; `None` where it does not read such jobs.
    pub fn judged(&self, program: &str) -> Option<Result<(), String>> {
        self.judged_within(program, self.form.within)
    }

    /// The same, with places within so many millimetres.
    pub fn judged_within(&self, program: &str, within: f64) -> Option<Result<(), String>> {
        let wants = self.wants()?;
        let inch = self.job["units"] == "inch";
        let ran = self.form.run(program, inch);
        let against = match ran {
            Err((line, why)) => Some(format!("line {line}: {why}")),
            Ok(mut acts) if self.form.renames => {
                acts.iter_mut().for_each(|act| {
                    act.from.swap(3, 4);
                    act.to.swap(3, 4);
                });
                against::difference(&wants, &acts, within)
            }
            Ok(acts) => against::difference(&wants, &acts, within),
        };
        Some(against.map_or(Ok(()), Err))
    }

    /// Is a program its job's, with places as near as the digits of its form are, but for feeds?
    pub fn is_rounded(&self, program: &str) -> bool {
        let unit = if self.job["units"] == "inch" { 25.4 } else { 1.0 };
        match self.form.verify_within(program, &self.text(), self.format, Some(self.form.within / unit)) {
            Proof::Different(list) => list.iter().all(|(code, _)| code == "PV006"),
            proof => proof.holds(),
        }
    }

    /// What LinuxCNC's interpreter makes of a program, against the job; `None` where it has no say.
    pub fn interpreted(&self, program: &str) -> Option<Result<(), String>> {
        // it prints the path that compensation makes
        if self.form.control != "linuxcnc" || program.contains("G41") || program.contains("G42") {
            return None;
        }
        let wants = self.wants()?;
        // several hunts may run beside each other
        let folder = std::env::temp_dir().join(format!("postform-hunt-{}", std::process::id()));
        std::fs::create_dir_all(&folder).ok()?;
        let acts = interpreted(program, &folder);
        std::fs::remove_dir_all(&folder).ok()?;
        let acts = acts?;
        Some(acts.and_then(|acts| against::difference(&wants, &acts, self.form.within).map_or(Ok(()), Err)))
    }

    /// Radii of the crests of the job's threads.
    pub fn crests(&self) -> Vec<f64> {
        let crest = |wanted: &Wanted| if let Want::Thread { crest, .. } = wanted.want { Some(crest) } else { None };
        self.wants().iter().flatten().filter_map(crest).collect()
    }

    fn wants(&self) -> Option<Vec<Wanted>> {
        wants(&self.said())
    }
}
