//! Random programs with their jobs and verdicts. Each program has its own file in `tests/data/proofs`. Each program was
//! kept because a small change of the comparison would change its verdict. A file contains `form NAME`, `units UNITS`
//! (of the program), `verdict WORDS`, the job on one line, and the program.

use std::collections::BTreeSet;
use std::fs;
use std::io::Cursor;
use std::path::Path;

use postform::toolpath::Units;
use postform::{Error, Job, NoFiles, Options, Post, Proof, Proven, Source, Verdict};

use crate::support::root;

/// A shipped form, or one of `tests/data/forms`.
fn post(name: &str) -> Post {
    let folders = ["postforms", "tests/data/forms"].map(|folder| root().join(folder).join(name).with_extension("pf"));
    let path = folders.iter().find(|path| path.exists()).unwrap_or_else(|| panic!("{name} is no form"));
    Post::compile(Source::from_bytes(name, &fs::read(path).unwrap()), &NoFiles).unwrap()
}

/// A verdict in one line, with its counts.
fn shown(proven: Result<Proven, Error>) -> String {
    match proven.map(|proven| proven.verdict) {
        Ok(Verdict::Identical) => "identical".into(),
        Ok(Verdict::Equivalent(allowed)) => {
            let counted: Vec<_> = allowed.named().filter(|(_, count)| *count > 0).collect();
            let counted: Vec<_> = counted.iter().map(|(name, count)| format!("{count} {name}")).collect();
            format!("equivalent: {}", counted.join(", "))
        }
        Ok(Verdict::Different(findings)) => {
            let codes: BTreeSet<&str> = findings.iter().map(|finding| finding.code.name()).collect();
            format!("different: {}", codes.into_iter().collect::<Vec<_>>().join(", "))
        }
        Ok(Verdict::NotProven(unproven)) => format!("not proven: {}", unproven.why),
        Ok(_) => "unknown".into(),
        Err(error) => {
            let code = error.findings().diags.iter().find(|diag| diag.is_error()).map(|diag| diag.code.name());
            format!("error: {}", code.unwrap_or("none"))
        }
    }
}

fn verdicts(path: &Path) -> [String; 2] {
    let text = fs::read_to_string(path).unwrap();
    let mut lines = text.splitn(5, '\n');
    let mut value = |key: &str| lines.next().unwrap().strip_prefix(key).unwrap().to_owned();
    let [form, units, wanted, job] = ["form ", "units ", "verdict ", ""].map(&mut value);
    let mut options = Options::default();
    options.program = Some(7);
    options.units = Some(if units == "inch" { Units::Inch } else { Units::Mm });
    let program = Cursor::new(lines.next().unwrap());
    [wanted, shown(post(&form).verify_with(Job::json(&job), program, &options, &Proof::default()))]
}

#[test]
fn verdicts_stay() {
    let entries = fs::read_dir(root().join("tests/data/proofs")).unwrap();
    let mut paths: Vec<_> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    assert!(paths.len() > 20, "tests/data/proofs");
    let mut others = String::new();
    for path in paths {
        let [wanted, is] = verdicts(&path);
        if wanted != is {
            others += &format!("{}: {is}, and was {wanted}\n", path.display());
        }
    }
    assert!(others.is_empty(), "{others}");
}
