//! Makes a wrong program from a correct program by one change. The comparison with the job must find the change.
//!
//! The arguments are `programs COUNT SEED KIND FORM`; each may be missing. With `insert` at the end, blocks are inserted at random
//! positions, also in holes. `FOUND=FOLDER` keeps each fault. Changed programs that postform proves although their
//! motions differ are listed by the kind of difference.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::time::Instant;

use postform_fuzz::case::{Asked, Case, End};
use postform_fuzz::forms::forms;
use postform_fuzz::judge::Act;
use postform_fuzz::judge::pair::{Class, difference, without_short};
use postform_fuzz::mutate::{Mutant, mutant, with_block};
use postform_fuzz::tally::Tally;

/// Number of programs of each kind that are shown.
const SHOWN: u64 = 3;
/// Number of changed programs for each correct one.
const EACH: usize = 10;
/// Tolerance of positions in millimetres.
const NEAR: f64 = 0.004;

fn main() {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let change = if args.iter().any(|arg| arg == "insert") { with_block } else { mutant };
    let asked = Asked::of(args.into_iter().filter(|arg| arg != "insert"), forms());
    std::panic::set_hook(Box::new(|_| {}));
    let mut hunt = Hunt { tally: Tally::default(), folder: std::env::var_os("FOUND").map(PathBuf::from) };
    let start = Instant::now();
    let mut made = 0;
    for seed in asked.first.. {
        if made >= asked.count {
            break;
        }
        let Some((case, mut random)) = asked.case(seed) else { continue };
        let End::Printed(program, proof, _) = case.end() else { continue };
        if !proof.holds() {
            continue;
        }
        let Ok(right) = case.run(&program) else {
            hunt.tally.count("not run", case.form.name.clone());
            continue;
        };
        for _ in 0..EACH {
            if let Some(mutant) = change(&program, &mut random) {
                made += 1;
                hunt.look(&case, &program, &right, &mutant, made);
            }
        }
    }
    hunt.tally.print();
    println!("{made} programs, {:.0} s", start.elapsed().as_secs_f64());
}

struct Hunt {
    tally: Tally,
    folder: Option<PathBuf>,
}

impl Hunt {
    fn look(&mut self, case: &Case, program: &str, right: &[Act], mutant: &Mutant, made: u64) {
        self.tally.count("mutations", mutant.kind);
        self.tally.count("forms", case.form.name.clone());
        let verify = || case.verify(&mutant.text);
        let Ok(proof) = catch_unwind(AssertUnwindSafe(verify)) else {
            self.tally.count("verdicts", "panic");
            return self.show(case, program, mutant, made, "panic", "comparing panics");
        };
        self.tally.count("verdicts", proof.name());
        if !proof.holds() {
            return;
        }
        let judged = case.run(&mutant.text);
        let crests = case.crests();
        let differs = |acts: Vec<Act>| match difference(right, &acts, &crests, NEAR) {
            // except for moves that are too short for the digits of a program
            Some((class, why)) if !class.is_harmless() => {
                let long = difference(&without_short(right), &without_short(&acts), &crests, NEAR);
                Some(long.map_or((Class::Short, why), |long| long))
            }
            other => other,
        };
        let (class, why) = match judged.map(differs) {
            Ok(None) => return self.tally.count("quiet", format!("{}: does the same", proof.name())),
            Ok(Some((class, why))) => (Ok(class), why),
            Err((line, why)) => (Err(()), format!("line {line}: {why}")),
        };
        let name = class.map_or("refused".to_owned(), |class| format!("{class:?}"));
        self.tally.count("quiet", format!("{}: {name}", proof.name()));
        let group = format!("{name}, {}", mutant.kind);
        self.tally.count("quiet by mutation", group.clone());
        let harmless = class.is_ok_and(Class::is_harmless);
        if !harmless && self.tally.get("quiet by mutation", &group) <= SHOWN {
            self.show(case, program, mutant, made, &format!("{}, {name}", proof.name()), &why);
        }
    }

    fn show(&self, case: &Case, program: &str, mutant: &Mutant, made: u64, what: &str, why: &str) {
        println!("== seed {}: {} ({}) {what}", case.seed, case.form.name, mutant.kind);
        println!("{}\n{why}", mutant.what);
        let Some(folder) = &self.folder else { return };
        let name = format!("{}-{made}-{}.{}", case.seed, what.replace([' ', ','], "-"), case.form.name);
        let job = (case.text(), postform_fuzz::text::ending(case.format));
        let files = [(job.0.as_str(), job.1), (mutant.text.as_str(), "nc"), (program, "right.nc")];
        for (text, ending) in files {
            if let Err(error) = std::fs::write(folder.join(format!("{name}.{ending}")), text) {
                println!("{name}: {error}");
            }
        }
    }
}
