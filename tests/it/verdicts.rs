//! docs/verdicts.md: the verdict of each shipped post for the job of each sample. `SAMPLES=overwrite cargo test
//! verdicts::` writes the page again.

use std::fmt::Write as _;
use std::fs;

use postform::{ErrorKind, Format, Job, NoFiles, Options, Post, Source, Verdict};

use crate::support::{Kind, root, sample_job, samples};

/// The reasons below the table, each once and with a number.
#[derive(Default)]
struct Reasons(Vec<String>);

impl Reasons {
    fn number(&mut self, why: &str) -> usize {
        let known = self.0.iter().position(|other| other == why);
        known.unwrap_or_else(|| {
            self.0.push(why.to_owned());
            self.0.len() - 1
        }) + 1
    }
}

/// A cell of the table, for a post and a job.
fn cell(post: &Post, format: Format, job: &[u8], reasons: &mut Reasons) -> String {
    let mut options = Options::default();
    options.program = Some(1);
    options.set = post.prompts().map(|ask| (ask.variable.to_owned(), ask.default.unwrap_or(1.0))).collect();
    match post.render(Job::bytes(format, job), &options) {
        Ok(program) => match program.verdict() {
            Verdict::Identical => "=".into(),
            Verdict::Equivalent(_) => "≈".into(),
            Verdict::NotProven(unproven) => format!("? {}", reasons.number(&unproven.why)),
            other => panic!("{other}"),
        },
        Err(error) if error.kind() == ErrorKind::Job => "–".into(),
        Err(error) if error.kind() == ErrorKind::Proof => {
            let errors = error.findings().diags.iter().filter(|diag| diag.is_error());
            let said = errors.map(|diag| diag.message.lines().next().unwrap_or_default().to_owned());
            format!("≠ {}", reasons.number(&said.collect::<Vec<_>>().join("; ")))
        }
        Err(error) => panic!("{error:?}"),
    }
}

#[test]
fn every_post_that_ships_has_a_verdict_on_every_sample() {
    let mut posts: Vec<_> =
        fs::read_dir(root().join("postforms")).unwrap().map(|entry| entry.unwrap().path()).collect();
    posts.sort();
    let posts = posts.iter().map(|path| {
        let source = Source::from_bytes(path.to_string_lossy(), &fs::read(path).unwrap());
        (path.file_stem().unwrap().to_string_lossy().into_owned(), Post::compile(source, &NoFiles).unwrap())
    });
    let posts: Vec<(String, Post)> = posts.collect();
    let mut reasons = Reasons::default();
    let mut page = "# Verdicts on what ships\n\n\
        A test prints the job of each sample ([samples/](../samples)) with each shipped post ([postforms/](../postforms)). \
        The table shows the verdicts: `=` identical, `≈` equivalent, `?` not proven, `≠` different. The number after \
        a verdict refers to a reason below the table. `–` means that the post can't print the job. Such a job is for \
        a different type of machine, or needs a sequence that the post does not have. \
        [What the verdicts mean](verify.md)\n\n| job |"
        .to_owned();
    posts.iter().for_each(|(name, _)| page += &format!(" {name} |"));
    page += "\n| --- |";
    posts.iter().for_each(|_| page += " --- |");
    for folder in samples() {
        let (path, kind) = sample_job(&folder);
        let format = match kind {
            Kind::Document => Format::Json,
            Kind::Lines => Format::JsonLines,
            Kind::Cl => Format::Cl,
        };
        let job = fs::read(path).unwrap();
        _ = write!(page, "\n| {} |", folder.file_name().unwrap().to_string_lossy());
        for (_, post) in &posts {
            _ = write!(page, " {} |", cell(post, format, &job, &mut reasons));
        }
    }
    page += "\n\nReasons why programs are different or not proven:\n\n";
    for (number, why) in reasons.0.iter().enumerate() {
        _ = writeln!(page, "{}. {why}", number + 1);
    }
    let path = root().join("docs/verdicts.md");
    if std::env::var("SAMPLES").is_ok_and(|v| v == "overwrite") {
        fs::write(&path, &page).unwrap();
    }
    let written = fs::read_to_string(&path).unwrap_or_default();
    crate::support::assert_same("docs/verdicts.md", &written, &page);
}
