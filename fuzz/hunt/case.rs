//! What a seed makes: a job, its format, and a form to print it with.

use std::rc::Rc;

use postform::toolpath::Units;
use postform::{Control, Format, Job};
use serde_json::{Value, json};

use crate::cl::for_cl;
use crate::forms::changed;
use crate::job::{Kind, document, job};
use crate::judge::rs274::interpreted;
use crate::judge::{Act, Want, Wanted, against, beam, done, planned, run, wants};
use crate::mutate::mutant;
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
    forms: Vec<Rc<Form>>,
    /// All forms: each may print a program that is another form's job.
    writers: Vec<Rc<Form>>,
}

impl Asked {
    /// Of the command line.
    pub fn of(args: impl Iterator<Item = String>, forms: Vec<Form>) -> Asked {
        let args: Vec<String> = args.collect();
        let number = |at: usize, default: u64| args.get(at).and_then(|arg| arg.parse().ok()).unwrap_or(default);
        let asked = |at: usize, name: &str| args.get(at).is_none_or(|arg| arg == "all" || arg == name);
        let forms: Vec<Rc<Form>> = forms.into_iter().map(Rc::new).collect();
        Asked {
            count: number(0, 10_000),
            first: number(1, 0),
            kinds: Kind::ALL.iter().filter(|(name, _)| asked(2, name)).map(|(_, kind)| *kind).collect(),
            forms: forms.iter().filter(|form| asked(3, &form.name)).cloned().collect(),
            writers: forms.into_iter().filter(|form| form.kinds.contains(&Kind::Program)).collect(),
        }
    }

    /// The case of a seed, and the random numbers behind it; none where no form prints such a job.
    pub fn case(&self, seed: u64) -> Option<(Case, Random)> {
        let mut random = Random::new(seed);
        let kind = random.pick(&self.kinds);
        let able: Vec<&Rc<Form>> = self.forms.iter().filter(|form| form.kinds.contains(&kind)).collect();
        let form = Rc::clone(able.get(random.below(able.len()))?);
        let case = self.of_form(seed, kind, form, &mut random)?;
        Some((case, random))
    }

    /// The same for a form that was changed in one place; none where it is no form any more.
    pub fn wrong(&self, seed: u64) -> Option<Case> {
        let (case, mut random) = self.case(seed)?;
        let text = changed(&case.form.text, &mut random)?;
        let form = Form::read(&case.form.name, &text).ok()?;
        // what the judge knows of the machine is not what was changed
        let is_same = (&form.control, form.renames, form.by_diameter)
            == (&case.form.control, case.form.renames, case.form.by_diameter);
        // a form says itself which offset of the machine is its first
        let offsets =
            |text: &str| text.lines().filter(|line| line.starts_with("Work")).map(str::to_owned).collect::<Vec<_>>();
        let is_same = is_same && offsets(&text) == offsets(&case.form.text);
        (is_same && form.kinds.contains(&case.kind)).then(|| Case { form: Rc::new(form), ..case })
    }

    fn of_form(&self, seed: u64, kind: Kind, form: Rc<Form>, random: &mut Random) -> Option<Case> {
        let mut job = job(kind, form.takes, random);
        let mut writer = None;
        let format = match kind {
            Kind::Mill => random.pick(&[Format::Json, Format::JsonLines, Format::Cl]),
            Kind::Statements => Format::Cl,
            Kind::Document => Format::Freecad,
            Kind::Program => {
                let other = Rc::clone(&self.writers[random.below(self.writers.len())]);
                let text = written(&job, Format::Json);
                let inch = other.inch.unwrap_or(job["units"] == "inch");
                let (mut program, _) = other.render(Job::json(&text), inch).ok()?;
                // also programs that no form prints
                if random.once_in(3) {
                    program = mutant(&program, random)?.text;
                }
                let lines: Vec<&str> = program.lines().collect();
                job = json!({ "units": if inch { "inch" } else { "mm" }, "lines": lines });
                writer = Some(other);
                Format::Nc
            }
            _ => random.pick(&[Format::Json, Format::JsonLines]),
        };
        let of_job = job["units"] == "inch";
        // a form for both may print the other
        let inch = form.inch.unwrap_or(of_job != random.once_in(4));
        Some(Case { seed, kind, form, writer, format, inch, job })
    }
}

/// A job that is printed with a form.
#[derive(Clone)]
pub struct Case {
    /// Which makes it again.
    pub seed: u64,
    /// What the job is for.
    pub kind: Kind,
    /// The form.
    pub form: Rc<Form>,
    /// Which form printed the program that is the job.
    pub writer: Option<Rc<Form>>,
    /// How the job is written.
    pub format: Format,
    /// The program counts inches, whatever the job counts.
    pub inch: bool,
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

impl Case {
    /// The same with another job.
    pub fn with(&self, job: &Value) -> Case {
        Case { job: job.clone(), ..self.clone() }
    }

    /// The job's text, to be looked at.
    pub fn text(&self) -> String {
        written(&self.job, self.format)
    }

    /// The job as it is read.
    fn bytes(&self) -> Vec<u8> {
        match self.format {
            Format::Freecad => document::archive(&self.job),
            _ => self.text().into_bytes(),
        }
    }

    fn reads<'b>(&self, bytes: &'b [u8]) -> Job<'b> {
        let mut job = Job::bytes(self.format, bytes);
        if let Some(writer) = &self.writer {
            job.reading.control = Control::named(&writer.control);
            job.reading.units = Some(if self.is_inch() { Units::Inch } else { Units::Mm });
        }
        job
    }

    fn is_inch(&self) -> bool {
        self.job["units"] == "inch"
    }

    /// What the text says, as a document.
    pub fn said(&self) -> Value {
        if self.kind == Kind::Mill && self.format == Format::Cl { for_cl(&self.job) } else { self.job.clone() }
    }

    /// Prints it and compares.
    pub fn end(&self) -> End {
        let bytes = self.bytes();
        let run = || match self.form.render(self.reads(&bytes), self.inch) {
            Err(said) => End::Refused(said),
            Ok((program, lost)) => {
                let proof = self.form.verify(&program, self.reads(&bytes), self.inch, None);
                End::Printed(program, proof, lost)
            }
        };
        std::panic::catch_unwind(std::panic::AssertUnwindSafe(run)).unwrap_or(End::Panicked)
    }

    /// Compares another program with the job.
    pub fn verify(&self, program: &str) -> Proof {
        self.form.verify(program, self.reads(&self.bytes()), self.inch, None)
    }

    /// The verdict of another program in one line, with all that is counted.
    pub fn verdict(&self, program: &str) -> String {
        self.form.verdict(program, self.reads(&self.bytes()), self.inch)
    }

    /// The proof of the program while it is printed, in parts of any size.
    pub fn proof_beside(&self, random: &mut Random) -> Proof {
        let bytes = self.bytes();
        let run = || self.form.prove_beside(self.reads(&bytes), self.inch, random);
        std::panic::catch_unwind(std::panic::AssertUnwindSafe(run))
            .unwrap_or_else(|_| Proof::NotProven(("panic".into(), String::new())))
    }

    /// Runs a program of the form by the judge's machine.
    ///
    /// # Errors
    /// The line, and why it stops there.
    pub fn run(&self, program: &str) -> Result<Vec<Act>, (usize, String)> {
        self.form.run(program, self.inch)
    }

    /// What the judge says of a program; `None` where it does not read such jobs.
    pub fn judged(&self, program: &str) -> Option<Result<(), String>> {
        self.judged_within(program, self.form.within)
    }

    /// The same, with places within so many millimetres.
    pub fn judged_within(&self, program: &str, within: f64) -> Option<Result<(), String>> {
        let wants = self.wants()?;
        let against = match self.run(program) {
            // the judge reads of these languages what the forms print for a job, and no text as it stands
            Err(_) if crate::judge::languages::is_one(&self.form.control) => return None,
            Err((line, why)) => Some(format!("line {line}: {why}")),
            Ok(mut acts) if self.form.renames => {
                acts.iter_mut().for_each(|act| {
                    act.from.swap(3, 4);
                    act.to.swap(3, 4);
                });
                against::difference(&wants, &acts, within)
            }
            Ok(acts) => {
                let is_laser = self.form.text.contains("\nMachine Laser\n");
                let switched = Some(&acts).filter(|_| self.kind == Kind::Beam);
                let switched = switched.and_then(|acts| beam::switched_wrongly(acts, is_laser));
                switched.or_else(|| against::difference(&wants, &acts, within))
            }
        };
        Some(against.map_or(Ok(()), Err))
    }

    /// Is a program its job's, with places as near as the digits of its form are, but for feeds?
    pub fn is_rounded(&self, program: &str) -> bool {
        self.is_within(program, self.form.within)
    }

    /// The same with places within so many millimetres.
    pub fn is_within(&self, program: &str, within: f64) -> bool {
        let unit = if self.is_inch() { 25.4 } else { 1.0 };
        match self.form.verify(program, self.reads(&self.bytes()), self.inch, Some(within / unit)) {
            Proof::Different(list) => list.iter().all(|(code, _)| code == "PV006"),
            proof => proof.holds(),
        }
    }

    /// What LinuxCNC's interpreter makes of a program, against the job; `None` where it has no say.
    pub fn interpreted(&self, program: &str) -> Option<Result<(), String>> {
        // it prints the path that compensation makes, and the pecks of its own cycles
        let own = ["G41", "G42", "G73", "G83"].iter().any(|code| program.contains(code));
        if self.form.control != "linuxcnc" || own {
            return None;
        }
        let wants = self.wants()?;
        // several hunts may run beside each other
        let folder = std::env::temp_dir().join(format!("postform-hunt-{}", std::process::id()));
        std::fs::create_dir_all(&folder).ok()?;
        let acts = interpreted(program, &folder);
        std::fs::remove_dir_all(&folder).ok()?;
        let acts = acts?;
        // LinuxCNC's interpreter takes the end of a probe for the sheet
        let acts = acts.map(|acts| if self.kind == Kind::Beam { beam::flat(acts) } else { acts });
        Some(acts.and_then(|acts| against::difference(&wants, &acts, self.form.within).map_or(Ok(()), Err)))
    }

    /// Radii of the crests of the job's threads.
    pub fn crests(&self) -> Vec<f64> {
        let crest = |wanted: &Wanted| if let Want::Thread { crest, .. } = wanted.want { Some(crest) } else { None };
        self.wants().iter().flatten().filter_map(crest).collect()
    }

    fn wants(&self) -> Option<Vec<Wanted>> {
        let mut wants = self.wants_of_job()?;
        if self.form.control != "okuma" && crate::judge::languages::is_one(&self.form.control) {
            // the tool has its own length
            wants.iter_mut().for_each(|wanted| wanted.length = wanted.tool);
        }
        Some(wants)
    }

    fn wants_of_job(&self) -> Option<Vec<Wanted>> {
        match self.kind {
            Kind::Program | Kind::Document => {
                // frames that a program moves are left out before its first move, and followed after it
                if ["G52", "G92"].iter().any(|code| self.text().contains(code)) {
                    return None;
                }
                let acts = match &self.writer {
                    Some(writer) => writer.run(&self.text(), self.is_inch()),
                    None => run(&document::program(&self.job), "linuxcnc", false),
                };
                done::wants(&acts.ok()?)
            }
            Kind::Statements => planned::wants(&self.text()).ok(),
            Kind::Beam => wants(&self.said()).map(beam::across),
            _ => wants(&self.said()),
        }
    }
}
