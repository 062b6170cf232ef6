//! Prints random jobs with the forms that ship and with unusual ones. Each program is compared with its job by postform, and by
//! a judge that shares no code with it.
//!
//! The arguments are `jobs COUNT SEED KIND FORM`; each may be missing. `FOUND=FOLDER` keeps each fault. A fault is
//! printed with its seed (`jobs 1 SEED` makes the fault again) and with a job that was made as small as possible. The
//! exit status is failure in three cases: postform proves a wrong program, postform reports a difference in a program
//! that the judge accepts, or a form prints a wrong program. The third case does not count if lint or the renderer
//! warns that digits are lost.

use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Instant;

use postform_fuzz::case::{Asked, Case, End};
use postform_fuzz::forms::forms;
use postform_fuzz::job::Kind;
use postform_fuzz::prove::Proof;
use postform_fuzz::random::Random;
use postform_fuzz::shrink::shrunk;
use postform_fuzz::tally::Tally;
use postform_fuzz::text::ending;

/// Number of faults of a kind that are made small and shown.
const SHOWN: u64 = 2;
/// One program in this number is also run by LinuxCNC's interpreter.
const INTERPRETED: u64 = 16;
/// One job in this number is also proven during printing, in parts of random size.
const BESIDE: u64 = 8;
/// One job in this number is also printed with a form that contains one mistake.
const WRONG_FORMS: u64 = 4;
/// Differences that depend only on words that are typed in a form: whether the spindle stops in Bore, how a wire is
/// threaded, the codes of its coolant.
const FORMS_OWN: [&str; 3] = ["out with the spindle turning", "Stop is missing", "coolant"];
/// Two units of the last digit of a length in inches. The value is in millimetres.
const DIGITS: f64 = 0.0052;
/// Tolerance of positions in `verify`, in millimetres.
const PLACES: f64 = 0.002;

fn main() -> ExitCode {
    let asked = Asked::of(std::env::args().skip(1), forms());
    std::panic::set_hook(Box::new(|_| {}));
    let mut hunt = Hunt { tally: Tally::default(), folder: std::env::var_os("FOUND").map(PathBuf::from) };
    let start = Instant::now();
    for seed in asked.first..asked.first + asked.count {
        if let Some((case, mut random)) = asked.case(seed) {
            hunt.look(&case);
            if seed.is_multiple_of(BESIDE) {
                hunt.beside(&case, &mut random);
            }
        }
        if seed.is_multiple_of(WRONG_FORMS)
            && let Some(case) = asked.wrong(seed)
        {
            hunt.wrong_form(&case);
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

/// The subject of a difference, without its numbers.
fn gist(why: &str) -> String {
    let text: String = why.chars().filter(|c| c.is_alphabetic() || *c == ' ').collect();
    text.split_whitespace().take(6).collect::<Vec<_>>().join(" ")
}

/// Classifies a program with the verdict `different`. `rounded`: the judge finds the difference too, and lint or the
/// renderer warns about the lost digits. `refused by the control`: the control does not run the program. `swallowed by
/// inches`: the shortest moves of a metric job are lost in the digits of an inch. `defects`: the judge finds the
/// difference too, and there is no such warning. All others are `alarms`.
fn called(case: &Case, end: &End) -> &'static str {
    let End::Printed(program, Proof::Different(list), lost) = end else { return "alarms" };
    // if the job is a program, it may contain codes that the form's control refuses
    if case.kind == Kind::Program && list.iter().all(|(code, _)| code == "PV015") {
        return "refused by the control";
    }
    let feeds = list.iter().all(|(code, _)| code == "PV006");
    // the fourth digit of an inch is larger than the tolerance of a metric job
    if !feeds && case.inch && case.job["units"] == "mm" && case.is_within(program, DIGITS) {
        return "swallowed by inches";
    }
    let is_wrong = |within: f64| matches!(case.judged_within(program, within), Some(Err(_)));
    match lost {
        true if feeds || is_wrong(PLACES) || case.is_rounded(program) => "rounded",
        false if is_wrong(case.form.within) => "defects",
        _ => "alarms",
    }
}

impl Hunt {
    fn look(&mut self, case: &Case) {
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

    /// Checks that the proof in parts has the same verdict as the proof of the whole program.
    fn beside(&mut self, case: &Case, random: &mut Random) {
        let End::Printed(_, proof, _) = case.end() else { return };
        let parts = case.proof_beside(random);
        // a proof in parts can't go back in the program, as calls and loops require
        if matches!(parts, Proof::NotProven(_)) {
            return self.tally.count("beside", "not proven");
        }
        let is_same = parts.name() == proof.name();
        self.tally.count("beside", if is_same { "the same" } else { "another" });
        if !is_same {
            println!("== seed {}: {}: in parts {parts:?}, as a whole {}", case.seed, case.form.name, proof.name());
            self.tally
                .count("wrong", format!("{} in parts {}, as a whole {}", case.form.name, parts.name(), proof.name()));
        }
    }

    /// Prints with a form that contains a mistake. postform may refuse the program or find it different, but must not
    /// prove a program that the judge finds wrong.
    fn wrong_form(&mut self, case: &Case) {
        let end = case.end();
        let End::Printed(program, proof, _) = &end else {
            self.tally.count("wrong forms", end.name().split(' ').next().unwrap_or(""));
            if let End::Panicked = end {
                self.found(case, "wrong", "panic", &mut |end, _| matches!(end, End::Panicked));
            }
            return;
        };
        let name = proof.name();
        let verdict = name.split(' ').next().unwrap_or("").to_owned();
        // for example, codes of the machine's builder
        if let Err((_, why)) = case.run(program) {
            return self.tally.count("wrong forms", format!("{verdict}, not run by the judge: {}", gist(&why)));
        }
        let is_own = |why: &String| FORMS_OWN.iter().any(|own| gist(why).contains(own));
        let judged = case.judged(program).filter(|judged| !judged.as_ref().is_err_and(is_own));
        let said = match &judged {
            None => "not read",
            Some(Ok(())) => "right",
            Some(Err(_)) => "wrong",
        };
        self.tally.count("wrong forms", format!("{verdict}, judged {said}"));
        if let (true, Some(Err(why))) = (proof.holds(), judged) {
            let gist = gist(&why);
            self.found(case, "wrong", &format!("wrong form, {verdict}: {gist}"), &mut |end, case| match end {
                End::Printed(program, proof, _) => {
                    proof.holds() && matches!(case.judged(program), Some(Err(why)) if self::gist(&why) == gist)
                }
                _ => false,
            });
        }
    }

    /// Handles the verdict `different`: either the verdict is a false alarm, or the program is wrong.
    fn different(&mut self, case: &Case, end: &End, name: &str) {
        let group = called(case, end);
        match group {
            "rounded" | "refused by the control" | "swallowed by inches" => {
                self.tally.count(group, format!("{} {name}", case.form.name))
            }
            _ => self.found(case, group, name, &mut |end, case| end.name() == name && called(case, end) == group),
        }
    }

    /// Counts the contents of the job.
    fn contents(&mut self, case: &Case) {
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

    /// Compares the program with its job by the judges.
    fn judge(&mut self, case: &Case, program: &str, name: &str) {
        let verdict = name.split(' ').next().unwrap_or("");
        let judged = case.judged(program);
        let said = match &judged {
            None => "not read",
            Some(Ok(())) => "right",
            Some(Err(_)) => "wrong",
        };
        self.tally.count("judge", format!("{said}, compared {verdict}"));
        // a program with the verdict `different` was shown already
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

    /// Records a fault. The first faults of each kind are made small and shown.
    fn found(&mut self, case: &Case, group: &'static str, what: &str, still: &mut dyn FnMut(&End, &Case) -> bool) {
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
        if what.starts_with("wrong form") {
            println!("{}", case.form.text);
        }
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
