//! Jobs whose events are kept in memory give the same result as the original job, with the same locations, warnings and
//! options.

use std::fs;

use crate::support::root;
use postform::internals::post::KeptJob;
use postform::{Format, Job, NoFiles, Options, Post, Source};

/// The program of a job or its errors, and the warnings.
fn printed(post: &Post, job: Job<'_>) -> (Result<String, String>, String) {
    match post.render(job, &Options::default()) {
        Ok(program) => (Ok(program.text().to_owned()), format!("{:?}", program.notes())),
        // with kept events, the warnings of the whole job are already known at the first error
        Err(error) => {
            let errors: Vec<_> = error.findings().diags.iter().filter(|diag| diag.is_error()).collect();
            (Err(format!("{errors:?}")), String::new())
        }
    }
}

#[test]
fn every_sample_is_printed_alike() {
    let form = |name: &str| {
        let text = fs::read_to_string(root().join("postforms").join(name)).unwrap();
        Post::compile(Source::from_text(name, text), &NoFiles).unwrap()
    };
    let posts = [form("haas.pf"), form("fanuc-lathe.pf"), form("wire-edm.pf")];
    let (mut programs, mut errors) = (0, 0);
    for entry in fs::read_dir(root().join("samples")).unwrap() {
        for file in fs::read_dir(entry.unwrap().path()).into_iter().flatten() {
            let path = file.unwrap().path();
            let Some(format) = Format::of_name(&path.to_string_lossy()) else { continue };
            let Ok(bytes) = fs::read(&path) else { continue };
            let Some(kept) = KeptJob::of(&mut Job::bytes(format, &bytes), usize::MAX) else { continue };
            for post in &posts {
                let (as_text, again) = (printed(post, Job::bytes(format, &bytes)), printed(post, kept.job()));
                assert_eq!(again, as_text, "{}", path.display());
                if as_text.0.is_ok() { programs += 1 } else { errors += 1 }
            }
        }
    }
    assert!(programs > 60 && errors > 60, "{programs} programs, {errors} errors");
}

#[test]
fn what_is_not_kept() {
    let job = fs::read(root().join("samples/bracket/job.json")).unwrap();
    let kept = |job: &mut Job<'_>, most| KeptJob::of(job, most).is_some();
    assert!(kept(&mut Job::json(&job), 1000));
    assert!(!kept(&mut Job::json(&job), 20), "too many events");
    assert!(!kept(&mut Job::json(&job[..job.len() - 20]), 1000), "cut off");
    assert!(!kept(&mut Job::stream(Format::Json, &job[..]), 1000), "can be read only once");
    // a selection applies to the kept job, too
    let mut part = Job::json(&job);
    part.reading.select.only = vec![1];
    let kept = KeptJob::of(&mut part, 1000).unwrap();
    let form = fs::read_to_string(root().join("postforms/haas.pf")).unwrap();
    let post = Post::compile(Source::from_text("haas.pf", form), &NoFiles).unwrap();
    let program = post.render(kept.job(), &Options::default()).unwrap();
    assert!(!program.text().contains("T2 M6") && program.text().contains("T1 M6"));
}
