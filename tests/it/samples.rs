//! Tests every folder of samples/: the program that its form prints for its job must be the expected one, byte for
//! byte. `SAMPLES=overwrite cargo test samples::` writes the printed programs; check the differences before a commit.

use crate::program_commands::{postform, text};
use crate::support;
use std::collections::BTreeSet;
use std::fs;

use crate::support::{check_file, render_sample, render_sample_with, root, sample_form, samples};
use postform::internals::control::Meaning;
use postform::internals::render::Options;
use postform::toolpath::Place;
use serde_json::Value;

/// Runs `postform test`, which tests a user's own cases in the same way.
#[test]
fn samples_print_what_they_say() {
    for folder in samples() {
        assert!(folder.join("README.md").exists(), "{} has no README.md", folder.display());
    }
    let update = std::env::var("SAMPLES").is_ok_and(|asked| asked == "overwrite");
    let arguments = ["test", "samples", "--update"];
    let output = postform(&arguments[..if update { 3 } else { 2 }]);
    let said = text(&output.stdout);
    assert_eq!(output.status.code(), Some(0), "{said}{}", text(&output.stderr));
    let last = said.lines().last().unwrap();
    assert!(update || last.starts_with("86 cases, 85 forms: 110 programs"), "{last}");
}

#[test]
fn every_post_that_ships_is_clean_and_prints_its_part() {
    let mut posts = 0;
    for entry in fs::read_dir(root().join("postforms")).unwrap() {
        let path = entry.unwrap().path();
        let checked = support::check_file(&path);
        let found = postform::internals::lint::lint(&checked, &Default::default()).diags;
        assert!(found.is_empty(), "{}: {found:?}", path.display());
        posts += 1;
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        if checked.form.settings.machine == postform::internals::lang::Machine::Mill {
            // a control without compensation prints the path of the tool's centre
            let control = checked.form.settings.control();
            let part = match checked.form.settings.beam {
                Some(_) => "plasma",
                None if control.has(Meaning::SideLeft) => "bracket",
                None => "plate",
            };
            let expected = root().join(format!("samples/{part}/expected.{name}.nc"));
            assert!(expected.exists(), "the {part} is not printed by {name}");
        }
    }
    assert!(posts >= 5);
}

#[test]
fn every_program_line_has_its_place_in_the_job_and_traces_lose_nothing() {
    let (mut items, mut of_forms) = (BTreeSet::new(), 0);
    for folder in samples() {
        let Some(form) = sample_form(&folder) else { continue };
        let rendered = render_sample(&folder, &form).unwrap();
        assert_eq!(rendered.trace.len(), rendered.text.lines().count(), "{}", folder.display());
        let checked = check_file(&form);
        let job = fs::read_to_string(folder.join("job.json")).ok();
        let job: Option<Value> = job.map(|text| serde_json::from_str(&text).unwrap());
        let mut last = Place::default();
        for (i, (line, printed)) in rendered.trace.iter().zip(rendered.text.lines()).enumerate() {
            let at = format!("{}: line {}, `{printed}`", folder.display(), i + 1);
            assert_eq!(line.line, i as u64 + 1, "{at}");
            if let Some(job) = &job {
                let path = line.place.path();
                assert!(item(job, &path).is_some(), "{at}: the job has no {path}");
                items.insert((folder.clone(), path));
                // blocks follow the order of the job; subprograms are placed by the form; start and end belong to no
                // item
                if job.get("subprograms").is_none() && line.place.operation > 0 {
                    assert!(!before(line.place, last), "{at}: {} after {last}", line.place);
                    last = line.place;
                }
            }
            // every letter of a block is in its line of the form
            if let Some(span) = line.form {
                let words = checked.files[span.file as usize].slice(span).to_ascii_uppercase();
                assert!(!words.is_empty() && !words.contains('\n'), "{at}: `{words}`");
                // text in backquotes may contain texts of the job
                if words.contains('`') {
                    continue;
                }
                let strange = letters(printed).find(|&letter| letter != 'N' && !words.contains(letter));
                assert_eq!(strange, None, "{at}, of `{words}`");
                of_forms += 1;
            }
        }
    }
    assert!(items.len() > 250 && of_forms > 500, "{} items, {of_forms} lines of forms", items.len());
}

/// The value in a job at a path such as `operations[0].path[3].cycle.points[2]`.
fn item<'a>(job: &'a Value, path: &str) -> Option<&'a Value> {
    let steps = path.split(['.', '[', ']']).filter(|step| !step.is_empty());
    steps.into_iter().try_fold(job, |value, step| match step.parse::<usize>() {
        Ok(index) => value.get(index),
        Err(_) => value.get(step),
    })
}

/// Whether a location is before another location in the job. The end of a cycle has the location of its item, and comes
/// after all points.
fn before(place: Place, other: Place) -> bool {
    let item = |place: Place| (place.operation, place.item);
    item(place) < item(other) || item(place) == item(other) && place.point > 0 && place.point < other.point
}

/// The letters of a block's words, without comments.
fn letters(block: &str) -> impl Iterator<Item = char> {
    let words = block.split(['(', ';']).next().unwrap_or_default();
    words.chars().filter(|letter| letter.is_ascii_uppercase())
}

/// Grbl refuses some blocks that other controls accept: an arc without an axis word of its plane, mist, two motions in
/// one block. Grbl also acts on some characters immediately, even in comments.
#[test]
fn the_grbl_post_prints_what_grbl_reads() {
    let form = root().join("postforms/grbl.pf");
    let mut programs = 0;
    for folder in samples() {
        let options = Options { program: Some(1), ..Options::default() };
        let Ok(rendered) = render_sample_with(&folder, &form, options) else { continue };
        programs += 1;
        for line in rendered.text.lines() {
            assert!(!line.contains(['%', '!', '~', '?']), "{}: {line}", folder.display());
            let block = line.split('(').next().unwrap();
            let words: Vec<&str> = block.split(' ').collect();
            let has = |letters: &[char]| words.iter().any(|word| word.starts_with(letters));
            let motions = words.iter().filter(|word| ["G0", "G1", "G2", "G3", "G80"].contains(word)).count();
            assert!(motions < 2 && !words.contains(&"M7"), "{}: {line}", folder.display());
            for (centre, axes) in [(['I', 'J'], ['X', 'Y']), (['I', 'K'], ['X', 'Z']), (['J', 'K'], ['Y', 'Z'])] {
                let arc = centre.iter().all(|&letter| has(&[letter]));
                assert!(!arc || has(&axes), "{}: {line}", folder.display());
            }
        }
    }
    assert!(programs > 30, "{programs}");
}
