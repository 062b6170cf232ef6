//! The test case of a seed: a job, its format, and a form that prints it.

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

/// The arguments of the command line: `COUNT SEED KIND FORM`. Each of them may be missing.
pub struct Asked {
    /// Number of cases.
    pub count: u64,
    /// The first seed.
    pub first: u64,
    kinds: Vec<Kind>,
    forms: Vec<Rc<Form>>,
    /// All forms that can print the program of a job of the kind `Program`.
    writers: Vec<Rc<Form>>,
}

impl Asked {
    /// Reads the arguments of the command line.
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

    /// The case of a seed, and its random numbers. `None` if no form prints such a job.
    pub fn case(&self, seed: u64) -> Option<(Case, Random)> {
        let mut random = Random::new(seed);
        let kind = random.pick(&self.kinds);
        let able: Vec<&Rc<Form>> = self.forms.iter().filter(|form| form.kinds.contains(&kind)).collect();
        let form = Rc::clone(able.get(random.below(able.len()))?);
        let case = self.of_form(seed, kind, form, &mut random)?;
        Some((case, random))
    }

    /// The same case with a form that was changed in one place. `None` if the changed text is no valid form.
    pub fn wrong(&self, seed: u64) -> Option<Case> {
        let (case, mut random) = self.case(seed)?;
        let text = changed(&case.form.text, &mut random)?;
        let form = Form::read(&case.form.name, &text).ok()?;
        // the change must not affect the data that the judge has about the machine
        let is_same = (&form.control, form.renames, form.by_diameter)
            == (&case.form.control, case.form.renames, case.form.by_diameter);
        // the form alone defines which code selects the first work offset
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
                // sometimes the program is changed, so that no form prints it
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
        // a form for both units sometimes prints the other unit
        let inch = form.inch.unwrap_or(of_job != random.once_in(4));
        Some(Case { seed, kind, form, writer, format, inch, job })
    }
}

/// A job that is printed with a form.
#[derive(Clone)]
pub struct Case {
    /// The seed that produces this case again.
    pub seed: u64,
    /// The kind of the job.
    pub kind: Kind,
    /// The form.
    pub form: Rc<Form>,
    /// The form that printed the program, if the job is a program.
    pub writer: Option<Rc<Form>>,
    /// The format of the job.
    pub format: Format,
    /// Whether the program is in inches. The job may have other units.
    pub inch: bool,
    /// The job, as a document.
    pub job: Value,
}

/// The result of printing a job.
#[derive(Clone, Debug)]
pub enum End {
    /// The form can't print it.
    Refused(Said),
    /// Printing panicked.
    Panicked,
    /// The program, its verdict, and whether lint or the renderer warns that digits are lost.
    Printed(String, Proof, bool),
}

impl End {
    /// The result in a few words. While a job is made smaller, these words must stay the same.
    pub fn name(&self) -> String {
        match self {
            End::Refused((code, _)) => format!("refused {code}"),
            End::Panicked => "panic".into(),
            End::Printed(_, proof, _) => proof.name(),
        }
    }
}

impl Case {
    /// The same case with another job.
    pub fn with(&self, job: &Value) -> Case {
        Case { job: job.clone(), ..self.clone() }
    }

    /// The text of the job, for display.
    pub fn text(&self) -> String {
        written(&self.job, self.format)
    }

    /// The bytes of the job, as they are read.
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

    /// The meaning of the job's text, as a document.
    pub fn said(&self) -> Value {
        if self.kind == Kind::Mill && self.format == Format::Cl { for_cl(&self.job) } else { self.job.clone() }
    }

    /// Prints the job and verifies the program.
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

    /// Verifies another program against the job.
    pub fn verify(&self, program: &str) -> Proof {
        self.form.verify(program, self.reads(&self.bytes()), self.inch, None)
    }

    /// The verdict on another program in one line, with its counts.
    pub fn verdict(&self, program: &str) -> String {
        self.form.verdict(program, self.reads(&self.bytes()), self.inch)
    }

    /// The verdict if the program is proven during printing, in parts of random size.
    pub fn proof_beside(&self, random: &mut Random) -> Proof {
        let bytes = self.bytes();
        let run = || self.form.prove_beside(self.reads(&bytes), self.inch, random);
        std::panic::catch_unwind(std::panic::AssertUnwindSafe(run))
            .unwrap_or_else(|_| Proof::NotProven(("panic".into(), String::new())))
    }

    /// Runs a program of the form on the judge's machine.
    ///
    /// # Errors
    /// The line at which the machine stops, and the reason.
    pub fn run(&self, program: &str) -> Result<Vec<Act>, (usize, String)> {
        self.form.run(program, self.inch)
    }

    /// The judge's result for a program. `None` if the judge can't read such jobs.
    pub fn judged(&self, program: &str) -> Option<Result<(), String>> {
        self.judged_within(program, self.form.within)
    }

    /// The judge's result for a program, with positions that may differ by this number of millimetres.
    pub fn judged_within(&self, program: &str, within: f64) -> Option<Result<(), String>> {
        let wants = self.wants()?;
        let against = match self.run(program) {
            // the judge reads only the words of these languages that the forms print for a job, and not the text of the
            // job
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

    /// Whether a program matches its job within the resolution of the form's digits. Feeds are not compared.
    pub fn is_rounded(&self, program: &str) -> bool {
        self.is_within(program, self.form.within)
    }

    /// Whether a program matches its job, with positions that may differ by this number of millimetres.
    pub fn is_within(&self, program: &str, within: f64) -> bool {
        let unit = if self.is_inch() { 25.4 } else { 1.0 };
        match self.form.verify(program, self.reads(&self.bytes()), self.inch, Some(within / unit)) {
            Proof::Different(list) => list.iter().all(|(code, _)| code == "PV006"),
            proof => proof.holds(),
        }
    }

    /// Runs a program with LinuxCNC's interpreter and compares the result with the job. `None` if the interpreter is
    /// not used for the program.
    pub fn interpreted(&self, program: &str) -> Option<Result<(), String>> {
        // the interpreter outputs the compensated path, and the pecks of its own cycles
        let own = ["G41", "G42", "G73", "G83"].iter().any(|code| program.contains(code));
        if self.form.control != "linuxcnc" || own {
            return None;
        }
        let wants = self.wants()?;
        // several hunts may run at the same time
        let folder = std::env::temp_dir().join(format!("postform-hunt-{}", std::process::id()));
        std::fs::create_dir_all(&folder).ok()?;
        let acts = interpreted(program, &folder);
        std::fs::remove_dir_all(&folder).ok()?;
        let acts = acts?;
        // the interpreter takes the end of a probe as the sheet's surface
        let acts = acts.map(|acts| if self.kind == Kind::Beam { beam::flat(acts) } else { acts });
        Some(acts.and_then(|acts| against::difference(&wants, &acts, self.form.within).map_or(Ok(()), Err)))
    }

    /// Crest radii of the job's threads.
    pub fn crests(&self) -> Vec<f64> {
        let crest = |wanted: &Wanted| if let Want::Thread { crest, .. } = wanted.want { Some(crest) } else { None };
        self.wants().iter().flatten().filter_map(crest).collect()
    }

    fn wants(&self) -> Option<Vec<Wanted>> {
        let mut wants = self.wants_of_job()?;
        if self.form.control != "okuma" && crate::judge::languages::is_one(&self.form.control) {
            // each tool uses the length register of its own number
            wants.iter_mut().for_each(|wanted| wanted.length = wanted.tool);
        }
        Some(wants)
    }

    fn wants_of_job(&self) -> Option<Vec<Wanted>> {
        match self.kind {
            Kind::Program | Kind::Document => {
                // `done::wants` does not convert a frame that was moved before the first move
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
