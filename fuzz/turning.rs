//! Random programs for lathes, run by postform and by another executor: both must make the same motions.
//!
//! `turning COUNT SEED [CONTROL]`. With `change` at the end, each program is changed once, and the comparison of the motions must
//! find the change. Without `change`, the exit status is failure if the motions differ. `turning show FILE [CONTROL]` runs one
//! program; `turning compare OLD NEW [CONTROL]` compares two.

#![allow(clippy::disallowed_methods, reason = "programs are files")]

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::process::ExitCode;

use postform_fuzz::random::Random;
use postform_fuzz::tally::Tally;
use postform_fuzz::turning::against::{Class, compared, difference, is_point, moves, settings, shown};
use postform_fuzz::turning::change::change;
use postform_fuzz::turning::contour::EXACT;
use postform_fuzz::turning::executor::{Move, Stopped, run, run_noting};
use postform_fuzz::turning::program::program;
use postform_fuzz::turning::unroll::unrolled;

/// Number of programs of each kind that are shown.
const SHOWN: u64 = 2;
/// Number of changed programs for each correct one.
const EACH: usize = 6;

fn main() -> ExitCode {
    let mut args: Vec<String> = std::env::args().skip(1).collect();
    let changes = args.iter().any(|arg| arg == "change");
    args.retain(|arg| arg != "change");
    if args.first().is_some_and(|arg| arg == "show") {
        show(&args[1], args.get(2).map_or("fanuc-lathe", String::as_str));
        return ExitCode::SUCCESS;
    }
    let number = |at: usize, usual: u64| args.get(at).and_then(|arg| arg.parse().ok()).unwrap_or(usual);
    if args.first().is_some_and(|arg| arg == "compare") {
        compare([&args[1], &args[2]], args.get(3).map_or("fanuc-lathe", String::as_str));
        return ExitCode::SUCCESS;
    }
    let (count, first) = (number(0, 1000), number(1, 0));
    std::panic::set_hook(Box::new(|_| {}));
    let mut hunt = Hunt { tally: Tally::default() };
    for seed in first..first + count {
        for control in ["fanuc-lathe", "haas-lathe"] {
            if args.get(2).is_none_or(|named| named == control) {
                hunt.look(seed, control, changes);
            }
        }
    }
    hunt.tally.print();
    // for changed programs, the user must judge the list
    let wrong = hunt.tally.total("wrong");
    if wrong > 0 && !changes { ExitCode::FAILURE } else { ExitCode::SUCCESS }
}

/// The tolerance of lengths.
fn within(inch: bool) -> f64 {
    if inch { 2e-6 } else { 2e-5 }
}

fn compare(files: [&String; 2], control: &str) {
    let [old, new] = files.map(|file| std::fs::read_to_string(file).expect("a program"));
    let inch = old.contains("G20");
    let [one, two] = [&old, &new].map(|text| run(text, control == "haas-lathe", inch));
    match (one, two) {
        (Ok(one), Ok(two)) => println!("   expected {:?}", difference(&one, &two, within(inch))),
        (one, two) => println!("   expected {:?}, {:?}", one.err(), two.err()),
    }
    println!("   postform {:?}", compared(&old, &new, settings(control, inch)));
}

fn show(file: &str, control: &str) {
    let text = std::fs::read_to_string(file).expect("a program");
    let settings = settings(control, text.contains("G20"));
    match run(&text, control == "haas-lathe", text.contains("G20")) {
        Ok(list) => list.iter().for_each(|one| println!("   expected {}", shown(one))),
        Err(why) => println!("   expected {why:?}"),
    }
    match moves(&text, settings) {
        Ok(list) => list.iter().for_each(|one| println!("   postform {}", shown(one))),
        Err(why) => println!("   postform {why:?}"),
    }
}

/// The result for a program.
#[derive(Clone, PartialEq)]
enum Found {
    Equal,
    Differs(Class, String),
    /// postform refuses a program that the executor runs.
    Refused(String),
    /// postform runs a program that the executor refuses.
    Runs(String),
    BothRefuse(String),
    Unsure(String),
    Panic,
}

fn found(text: &str, control: &str, inch: bool) -> Found {
    let mine = run(text, control == "haas-lathe", inch);
    let Ok(other) = catch_unwind(AssertUnwindSafe(|| moves(text, settings(control, inch)))) else {
        return Found::Panic;
    };
    match (mine, other) {
        (Err(Stopped::Unsure(why)), other) => {
            Found::Unsure(format!("{why}: {}", other.map_or_else(|(_, why)| bare(&why), |_| "runs".into())))
        }
        (Ok(mine), Ok(other)) => match difference(&mine, &other, within(inch)) {
            None => Found::Equal,
            Some((class, why)) => Found::Differs(class, why),
        },
        (Ok(_), Err((_, why))) => Found::Refused(bare(&why)),
        (Err(Stopped::Alarm(why)), Ok(_)) => Found::Runs(why),
        (Err(Stopped::Alarm(why)), Err((_, other))) => Found::BothRefuse(format!("{why}: {}", bare(&other))),
    }
}

/// A message without its numbers.
fn bare(why: &str) -> String {
    let why = why.split(", in `").next().unwrap_or(why);
    let numbers: Vec<f64> = why.split(' ').filter_map(|word| word.trim_end_matches(',').parse().ok()).collect();
    // the numbers are equal except for the rounding of floating-point numbers
    let exact = matches!(numbers[..], [a, b] if (a.abs() - b.abs()).abs() < 1e-9);
    let why = &if exact { format!("{why} (alike)") } else { why.to_owned() };
    let mut text: String = why.chars().map(|c| if c.is_ascii_digit() { '#' } else { c }).collect();
    while text.contains("##") {
        text = text.replace("##", "#");
    }
    text.replace("#.#", "#").replace("-#", "#").chars().take(160).collect()
}

/// Removes lines as long as the result stays the same.
fn shrunk(text: &str, fails: &dyn Fn(&str) -> bool) -> String {
    let mut lines: Vec<&str> = text.lines().collect();
    loop {
        let before = lines.len();
        for at in (0..lines.len()).rev() {
            let mut other = lines.clone();
            other.remove(at);
            if fails(&(other.join("\n") + "\n")) {
                lines = other;
            }
        }
        if lines.len() == before {
            return lines.join("\n") + "\n";
        }
    }
}

struct Hunt {
    tally: Tally,
}

impl Hunt {
    fn look(&mut self, seed: u64, control: &'static str, changes: bool) {
        let (text, inch, kinds) = program(seed, control == "haas-lathe");
        self.tally.count("programs", control);
        kinds.iter().for_each(|kind| self.tally.count("made", *kind));
        let end = found(&text, control, inch);
        let (group, name) = match &end {
            Found::Equal => {
                self.tally.count("results", "equal");
                if !changes {
                    let exact = kinds.contains(&EXACT);
                    self.unrolled(&text, seed, control, inch, exact);
                }
                if changes {
                    let exact = kinds.contains(&EXACT);
                    self.changed(&text, seed, control, inch, exact);
                }
                return;
            }
            Found::Differs(class, _) => {
                let corner = run_noting(&text, control == "haas-lathe", inch).is_ok_and(|(_, corner)| corner);
                let at = if corner { ", with a cut at a corner" } else { "" };
                ("different", format!("{control} {class:?}{at}"))
            }
            Found::Refused(why) => ("refused", format!("{control} {why}")),
            Found::Runs(why) => ("runs an alarm", why.clone()),
            Found::BothRefuse(why) => ("both refuse", why.clone()),
            Found::Unsure(why) => ("unsure", why.clone()),
            Found::Panic => ("panics", String::new()),
        };
        self.tally.count("results", group);
        if !changes && matches!(end, Found::Differs(..) | Found::Runs(_) | Found::Panic) {
            self.tally.count("wrong", group);
        }
        self.tally.count(group, name.clone());
        if changes || group == "unsure" || group == "both refuse" {
            return;
        }
        let same = |other: &str| match (&end, found(other, control, inch)) {
            (Found::Differs(one, _), Found::Differs(two, _)) => *one == two,
            (one, other) => *one == other,
        };
        let small = shrunk(&text, &same);
        let codes = codes(&small);
        let shape = format!("{name} | {codes}");
        self.tally.count("shapes", shape.clone());
        if self.tally.get("shapes", &shape) > SHOWN {
            return;
        }
        println!("== seed {seed} {control}: {group}: {name}\n{small}");
        if let Found::Differs(_, why) = found(&small, control, inch) {
            println!("   {why}");
        }
    }

    /// Checks that postform finds no difference between a program and its copy without cycles, in which moves replace
    /// the cycles.
    fn unrolled(&mut self, text: &str, seed: u64, control: &'static str, inch: bool, exact: bool) {
        let Ok(moves) = run(text, control == "haas-lathe", inch) else { return };
        if moves.iter().any(|one| one.speed.0.is_nan()) {
            return;
        }
        // in millimetres, a surface speed has decimals, and a Fanuc refuses a decimal point in S
        let mixed = inch && seed.is_multiple_of(3) && control == "haas-lathe";
        let flat = unrolled(&moves, inch, inch && !mixed);
        let said = compared(text, &flat, settings(control, inch));
        let verdict = match &said {
            Err(why) => format!("refused: {}", bare(why)),
            Ok(motions) => match &motions.difference {
                Some(difference) => {
                    let bare: String = difference.message.chars().filter(|c| !c.is_ascii_digit()).take(50).collect();
                    format!("different: {bare}")
                }
                None if motions.ways > 0 || motions.codes > 0 => "equivalent".to_owned(),
                None => "identical".to_owned(),
            },
        };
        let verdict = verdict + if mixed { ", in millimetres" } else { "" };
        let verdict = verdict + if exact { ", with a corner as long as its cut" } else { "" };
        self.tally.count("without cycles", verdict.clone());
        if !verdict.starts_with("identical") && !verdict.starts_with("equivalent") {
            self.tally.count("wrong", format!("without cycles {verdict}"));
        }
        if !verdict.starts_with("identical") && self.tally.get("without cycles", &verdict) <= SHOWN {
            println!("== seed {seed} {control}: without cycles {verdict}\n{text}");
            println!("   {said:?}\n{flat}");
        }
    }

    /// Checks that postform refuses a changed program that stops with an alarm, or finds a difference.
    fn alarm(&mut self, text: &str, other: &str, of: (u64, &'static str, bool), what: &str) {
        let (seed, control, inch) = of;
        let said = catch_unwind(AssertUnwindSafe(|| compared(text, other, settings(control, inch))));
        let verdict = match said {
            Err(_) => "panic",
            Ok(Err(_)) => "refused",
            Ok(Ok(motions)) if motions.difference.is_some() => "different",
            Ok(Ok(_)) => "alike",
        };
        self.tally.count("changes", format!("an alarm: {verdict}"));
        if verdict == "panic" || verdict == "alike" {
            let why = what.split(':').next().unwrap_or("");
            let shape = format!("an alarm, {verdict}, {why}");
            self.tally.count("wrong", shape.clone());
            if self.tally.get("wrong", &shape) <= SHOWN {
                println!("== seed {seed} {control}: {shape}: {what}\n{text}");
            }
        }
    }

    fn changed(&mut self, text: &str, seed: u64, control: &'static str, inch: bool, exact: bool) {
        let haas = control == "haas-lathe";
        let mut random = Random::new(seed ^ 0x5eed);
        let Ok(right) = run(text, haas, inch) else { return };
        for _ in 0..EACH {
            let Some((other, what)) = change(text, &mut random) else { continue };
            let list = match run(&other, haas, inch) {
                Ok(list) => list,
                Err(Stopped::Alarm(why)) => {
                    self.alarm(text, &other, (seed, control, inch), &format!("{why}: {}", what.1));
                    continue;
                }
                Err(Stopped::Unsure(_)) => {
                    self.tally.count("changes", "unsure");
                    continue;
                }
            };
            let differs = difference(&right, &list, within(inch));
            let said = catch_unwind(AssertUnwindSafe(|| compared(text, &other, settings(control, inch))));
            let (verdict, why) = match said {
                Err(_) => ("panic", String::new()),
                Ok(Err(why)) => ("refused", bare(&why)),
                Ok(Ok(motions)) => match motions.difference {
                    Some(difference) => ("different", difference.message),
                    None if motions.ways > 0 || motions.codes > 0 => ("equivalent", String::new()),
                    None => ("identical", String::new()),
                },
            };
            let name = differs.as_ref().map_or("alike".to_owned(), |(class, _)| format!("{class:?}"));
            self.tally.count("changes", format!("{name}: {verdict}"));
            let quiet = verdict == "identical" || verdict == "equivalent";
            // postform counts cuts of zero length
            let points = |list: &[Move]| list.iter().filter(|one| is_point(one)).count();
            let wrong = match &differs {
                None => verdict == "different" && points(&right) == points(&list),
                Some((Class::Way, _)) => verdict == "identical",
                Some(_) => quiet,
            };
            if wrong || verdict == "panic" {
                let known: String =
                    why.chars().filter(|c| !c.is_ascii_digit() && *c != '.' && *c != '-').take(60).collect();
                let corner = if exact { ", with a corner as long as its cut" } else { "" };
                let shape = format!("{name}, {verdict}, {}, {known}{corner}", what.0);
                self.tally.count("wrong", shape.clone());
                if self.tally.get("wrong", &shape) <= SHOWN {
                    println!("== seed {seed} {control}: {shape}: {}\n{text}", what.1);
                    println!("   {why} {}", differs.map_or(String::new(), |(_, why)| why));
                }
            }
        }
    }
}

/// The G codes of a program, each once.
fn codes(text: &str) -> String {
    let mut list: Vec<String> = Vec::new();
    for part in text.split('G').skip(1) {
        let code: String = part.chars().take_while(char::is_ascii_digit).collect();
        let code = format!("G{}", code.trim_start_matches('0'));
        if !["G2", "G3", "G18", "G40", "G99", "G98", "G20", "G21"].contains(&code.as_str()) && !list.contains(&code) {
            list.push(code);
        }
    }
    list.sort();
    list.join(" ")
}
