//! `corpus COUNT SEED` prints the verdicts of COUNT random programs. Some of these programs are printed by a form; the
//! others are printed programs that are changed in one place.
//!
//! `corpus COUNT SEED VERDICTS FOLDER` compares the verdicts with earlier output in the file VERDICTS. The shortest of
//! the first programs with a different verdict is written into FOLDER, with the earlier verdict. `mutants` runs
//! `corpus` to make the cases of `tests/data/proofs`.

use std::fs;
use std::path::Path;
use std::process::ExitCode;

use postform::Format;
use postform_fuzz::case::{Asked, End};
use postform_fuzz::forms::forms;
use postform_fuzz::mutate::{mutant, with_block};

/// Number of programs for each job: the printed program and changed programs.
const EACH: usize = 6;
/// Number of programs with a different verdict from which the shortest is chosen.
const FIRST: usize = 4;

/// A program and its job, as the text of a file.
struct Found {
    name: String,
    text: String,
}

fn main() -> ExitCode {
    let mut args: Vec<String> = std::env::args().skip(1).collect();
    let kept = args.split_off(args.len().min(2));
    let asked = Asked::of(args.into_iter(), forms());
    let before = kept.first().map(|path| fs::read_to_string(path).unwrap_or_else(|error| panic!("{path}: {error}")));
    let mut verdicts = before.iter().flat_map(|text| text.lines());
    let mut found: Vec<Found> = Vec::new();
    for seed in asked.first..asked.first + asked.count {
        let Some((case, mut random)) = asked.case(seed) else { continue };
        if !matches!(case.format, Format::Json) {
            continue;
        }
        let End::Printed(program, ..) = case.end() else { continue };
        for number in 0..EACH {
            let changed = match number {
                0 => Some(program.clone()),
                1..4 => mutant(&program, &mut random).map(|mutant| mutant.text),
                _ => with_block(&program, &mut random).map(|mutant| mutant.text),
            };
            let Some(changed) = changed else { continue };
            let name = format!("{seed}-{number}");
            let now = case.verdict(&changed);
            let Some(then) = verdicts.next().map(|line| line.split_once(' ').unwrap_or_default()) else {
                if before.is_some() {
                    return end(&found, kept.get(1));
                }
                println!("{name} {now}");
                continue;
            };
            assert_eq!(then.0, name, "the verdicts are of other programs");
            if then.1 != now {
                let units = if case.inch { "inch" } else { "mm" };
                let (form, job) = (&case.form.name, case.text());
                found.push(Found {
                    name,
                    text: format!("form {form}\nunits {units}\nverdict {}\n{job}\n{changed}", then.1),
                });
            }
            if found.len() == FIRST {
                return end(&found, kept.get(1));
            }
        }
    }
    end(&found, kept.get(1))
}

/// Writes the shortest program. Exit status 1: none was found.
fn end(found: &[Found], folder: Option<&String>) -> ExitCode {
    let (Some(shortest), Some(folder)) = (found.iter().min_by_key(|found| found.text.len()), folder) else {
        return ExitCode::from(u8::from(folder.is_some()));
    };
    let path = Path::new(folder).join(&shortest.name).with_extension("txt");
    fs::write(&path, &shortest.text).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    println!("{}", path.display());
    ExitCode::SUCCESS
}
