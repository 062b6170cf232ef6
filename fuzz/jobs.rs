//! Random jobs through the forms that ship and through unusual ones: each program is compared with its job, by postform and
//! by a judge that shares no code with it.
//!
//! `jobs COUNT SEED KIND FORM`, of which each may be missing; `FOUND=FOLDER` keeps what is found. What goes wrong is printed as the
//! smallest such job, with its seed (`jobs 1 SEED` makes it again). It fails where a program is wrong though it was proven, where one
//! is called different that the judge finds right, and where one is wrong for another reason than digits that lint or the renderer
//! names.

use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Instant;

use postform_fuzz::case::{Asked, Case, End};
use postform_fuzz::forms::forms;
use postform_fuzz::prove::Proof;
use postform_fuzz::shrink::shrunk;
use postform_fuzz::tally::Tally;
use postform_fuzz::text::ending;

/// How many of a kind are made small and shown.
const SHOWN: u64 = 2;
/// One program in so many goes through LinuxCNC's interpreter.
const INTERPRETED: u64 = 16;
/// How near places must be for `verify`, in millimetres.
const PLACES: f64 = 0.002;

fn main() -> ExitCode {
    let asked = Asked::of(std::env::args().skip(1), forms());
    std::panic::set_hook(Box::new(|_| {}));
    let mut hunt = Hunt { tally: Tally::default(), folder: std::env::var_os("FOUND").map(PathBuf::from) };
    let start = Instant::now();
    for seed in asked.first..asked.first + asked.count {
        if let Some((case, _)) = asked.case(seed) {
            hunt.look(&case);
        }
    }
    hunt.tally.print();
    let [wrong, alarms, defects, rounded] =
        ["wrong", "alarms", "defects", "rounded"].map(|group| hunt.tally.total(group));
    let seconds = start.elapsed().as_secs_f64();
    println!(
        "{} jobs: {wrong} wrong though proven, {alarms} false alarms, {defects} wrong and found, {rounded} rounded by their form, {seconds:.0} s",
        asked.count
    );
    if wrong + alarms + defects > 0 { ExitCode::FAILURE } else { ExitCode::SUCCESS }
}

struct Hunt {
    tally: Tally,
    folder: Option<PathBuf>,
}

/// What a difference is about, without its numbers.
fn gist(why: &str) -> String {
    let text: String = why.chars().filter(|c| c.is_alphabetic() || *c == ' ').collect();
    text.split_whitespace().take(6).collect::<Vec<_>>().join(" ")
}

/// What a program that is called different is: `rounded` where the judge sees it too and lint or the renderer names the digits that are
/// lost, `defects` where the judge sees it too, else one of the `alarms`.
fn called(case: &Case<'_>, end: &End) -> &'static str {
    let End::Printed(program, Proof::Different(list), lost) = end else { return "alarms" };
    let feeds = list.iter().all(|(code, _)| code == "PV006");
    let is_wrong = |within: f64| matches!(case.judged_within(program, within), Some(Err(_)));
    match lost {
        true if feeds || is_wrong(PLACES) || case.is_rounded(program) => "rounded",
        false if is_wrong(case.form.within) => "defects",
        _ => "alarms",
    }
}

impl Hunt {
    fn look(&mut self, case: &Case<'_>) {
        let end = case.end();
        let name = end.name();
        let verdict = name.split(' ').next().unwrap_or("");
        self.contents(case);
        self.tally.count("kinds", case.kind.name());
        self.tally.count("formats", ending(case.format));
        self.tally.count("forms", format!("{} {verdict}", case.form.name));
        self.tally.count("verdicts", name.clone());
        match &end {
            End::Refused(_) => {}
            End::Panicked => self.found(case, "wrong", "panic", &mut |end, _| matches!(end, End::Panicked)),
            End::Printed(program, proof, _) => {
                if let Proof::Different(_) = proof {
                    self.different(case, &end, &name);
                }
                self.judge(case, program, &name);
            }
        }
    }

    /// Something is called different: a false alarm, or a wrong program.
    fn different(&mut self, case: &Case<'_>, end: &End, name: &str) {
        let group = called(case, end);
        match group {
            "rounded" => self.tally.count(group, format!("{} {name}", case.form.name)),
            _ => self.found(case, group, name, &mut |end, case| end.name() == name && called(case, end) == group),
        }
    }

    /// What is in the job.
    fn contents(&mut self, case: &Case<'_>) {
        let said = case.said();
        let list = |value: &serde_json::Value, key: &str| value[key].as_array().cloned().unwrap_or_default();
        for path in list(&said, "operations").iter().chain(&list(&said, "subprograms")) {
            self.tally.count("items", "path");
            for item in list(path, "path") {
                let key = item.as_object().and_then(|item| item.keys().next().cloned()).unwrap_or_default();
                if let Some(cycle) = item.get("cycle") {
                    self.tally.count("cycles", cycle["kind"].as_str().unwrap_or(""));
                    list(cycle, "points").iter().for_each(|_| self.tally.count("items", "hole"));
                }
                self.tally.count("items", key);
            }
        }
    }

    /// The judges' word.
    fn judge(&mut self, case: &Case<'_>, program: &str, name: &str) {
        let verdict = name.split(' ').next().unwrap_or("");
        let judged = case.judged(program);
        let said = match &judged {
            None => "not read",
            Some(Ok(())) => "right",
            Some(Err(_)) => "wrong",
        };
        self.tally.count("judge", format!("{said}, compared {verdict}"));
        // what is called different was shown
        if let (Some(Err(why)), true) = (judged, verdict != "different") {
            let gist = gist(&why);
            self.found(case, "wrong", &format!("judge, {verdict}: {gist}"), &mut |end, case| match end {
                End::Printed(program, proof, _) => {
                    let same = |why: &str| self::gist(why) == gist;
                    proof.name().starts_with(verdict) && matches!(case.judged(program), Some(Err(why)) if same(&why))
                }
                _ => false,
            });
        }
        if case.seed.is_multiple_of(INTERPRETED)
            && let Some(done) = case.interpreted(program)
        {
            self.tally.count("interpreter", if done.is_ok() { "right" } else { "wrong" });
            if let Err(why) = done {
                let gist = gist(&why);
                self.found(case, "wrong", &format!("interpreter, {verdict}: {gist}"), &mut |end, case| match end {
                    End::Printed(program, ..) => {
                        matches!(case.interpreted(program), Some(Err(why)) if self::gist(&why) == gist)
                    }
                    _ => false,
                });
            }
        }
    }

    /// Something is wrong: the first of its kind are made small and shown.
    fn found(
        &mut self,
        case: &Case<'_>,
        group: &'static str,
        what: &str,
        still: &mut dyn FnMut(&End, &Case<'_>) -> bool,
    ) {
        let name = format!("{} {what}", case.form.name);
        self.tally.count(group, name.clone());
        if self.tally.get(group, &name) > SHOWN {
            return;
        }
        let small = case.with(&shrunk(&case.job, &mut |job| {
            let case = case.with(job);
            still(&case.end(), &case)
        }));
        println!("== seed {}: {} ({}, {}) {what}", case.seed, case.form.name, case.kind.name(), ending(case.format));
        println!("{}", small.text().trim_end());
        if let End::Printed(program, proof, _) = small.end() {
            if let Proof::Different(list) = proof {
                list.iter().take(2).for_each(|(code, what)| println!("{code} {what}"));
            }
            if let Some(Err(why)) = small.judged(&program) {
                println!("judge: {why}");
            }
            println!("{program}");
        }
        if let Some(folder) = &self.folder {
            let name = format!(
                "{}-{}.{}.{}",
                case.seed,
                what.replace([' ', ',', ':'], "-"),
                case.form.name,
                ending(case.format)
            );
            if let Err(error) = std::fs::write(folder.join(&name), small.text()) {
                println!("{name}: {error}");
            }
        }
    }
}
