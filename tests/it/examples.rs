//! Tests for users of the library: the examples print the expected output, and the public interface keeps its
//! guarantees.

use std::error::Error as _;
use std::io::{self, Cursor};
use std::path::Path;
use std::process::Command;

use postform::diag::Severity;
use postform::{Error, ErrorKind, Format, Job, NoFiles, Options, Post, Source, UnprovenKind, Verdict};

use crate::support::root;

const FORM: &str = include_str!("../../postforms/fanuc.pf");
const JOB: &str = include_str!("../../samples/bracket/job.json");
const EXPECTED: &str = include_str!("../../samples/bracket/expected.fanuc.nc");

fn post() -> Post {
    Post::compile(Source::from_text("fanuc.pf", FORM), &NoFiles).unwrap()
}

/// Standard output of an example. `cargo test` has built the example; if only the tests were built, cargo builds it
/// here.
fn printed(example: &str) -> String {
    let built = Path::new(env!("CARGO_BIN_EXE_postform")).with_file_name("examples").join(example);
    let mut command = if built.exists() {
        Command::new(built)
    } else {
        let mut cargo = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
        cargo.args(["run", "--quiet", "--offline", "--locked", "--profile", "test", "--example", example]);
        cargo
    };
    let out = command.current_dir(root()).output().unwrap();
    assert!(out.status.success(), "{example}: {}", String::from_utf8_lossy(&out.stderr));
    String::from_utf8(out.stdout).unwrap()
}

#[test]
fn the_examples_print() {
    assert_eq!(printed("embed"), include_str!("../../samples/bracket/expected.haas.nc"));
    let holes = printed("reader");
    assert!(holes.contains("G81 X10. Y20. Z-8. R2. F150.\nN80 X30.\nN90 Y45. Z-12.5\n"), "{holes}");
    assert_eq!(printed("threads"), "bracket: 119 lines\nholes: 18 lines\nsections: 21 lines\n");
    assert!(printed("lint_build").starts_with("cargo::rerun-if-changed="));
}

#[test]
fn a_post_is_shared_by_threads_and_its_error_is_an_error() {
    fn shared<T: Send + Sync + 'static>(_: &T) {}
    fn error<T: std::error::Error>() {}
    shared(&post());
    error::<Error>();
}

#[test]
fn a_form_with_errors_makes_no_post() {
    let broken = FORM.replace("EndCode\nM9", "EndCode\nX[hh]");
    let error = Post::compile(Source::from_text("fanuc.pf", broken), &NoFiles).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Form);
    let text = error.to_string();
    assert!(text.starts_with("fanuc.pf:") && text.contains("`hh`"), "{text}");
    let diag = error.findings().diags.iter().find(|diag| diag.is_error()).unwrap();
    assert_eq!(error.findings().files[0].slice(diag.labels[0].span), "hh");
}

#[test]
fn an_error_shows_the_line_that_it_is_about() {
    let broken = FORM.replace("EndCode\nM9", "EndCode\nX[hh]");
    let line = broken.lines().position(|line| line == "X[hh]").unwrap() + 1;
    let error = Post::compile(Source::from_text("fanuc.pf", broken), &NoFiles).unwrap_err();
    let (first, marked) = (error.to_string(), format!("{error:#}"));
    let margin = " ".repeat(line.to_string().len());
    assert_eq!(marked, format!("{first}\n{line} | X[hh]\n{margin} |   ^^"));
    // the message about an error in a job contains no line of the form
    let error = post().render(Job::json("{}").named("part.json"), &Options::default()).unwrap_err();
    assert_eq!(format!("{error:#}"), error.to_string());
}

#[test]
fn findings_of_a_job_have_its_name() {
    let (cut, options) = (&JOB[..JOB.len() / 2], Options::default());
    let file = |error: Error| error.into_findings().diags.pop().unwrap().place.unwrap().file;
    let name = Some("bracket.json".to_owned());
    assert_eq!(file(post().render(Job::json(cut).named("bracket.json"), &options).unwrap_err()), name);
    assert_eq!(file(post().render(Job::open("bracket.json", cut).unwrap(), &options).unwrap_err()), name);
    assert_eq!(file(post().verify(Job::json(cut).named("bracket.json"), EXPECTED).unwrap_err()), name);
    assert_eq!(file(post().render(Job::json(cut), &options).unwrap_err()), None);
}

#[test]
fn a_post_has_its_notes_and_a_verdict_its_kind() {
    let form = FORM.replacen("Control fanuc\n", "", 1).replace("EndCode\nM9", "EndCode\nM9\t");
    let unnamed = Post::compile(Source::from_text("fanuc.pf", form), &NoFiles).unwrap();
    let codes: Vec<_> = unnamed.findings().diags.iter().map(|diag| (diag.severity, diag.code.name())).collect();
    assert!(codes.iter().any(|(severity, _)| *severity == Severity::Note), "{codes:?}");
    let kind = |verdict: &Verdict| match verdict {
        Verdict::NotProven(unproven) => unproven.kind,
        other => panic!("{other}"),
    };
    let program = unnamed.render(Job::json(JOB), &Options::default()).unwrap();
    assert_eq!(kind(program.verdict()), UnprovenKind::ControlAssumed);
    let mut options = Options::default();
    options.proof = None;
    assert_eq!(kind(post().render(Job::json(JOB), &options).unwrap().verdict()), UnprovenKind::NotAsked);
    let unknown = EXPECTED.replacen("G43", "G201", 1);
    assert_eq!(kind(&post().verify(Job::json(JOB), unknown).unwrap()), UnprovenKind::Unknown);
}

#[test]
fn a_program_is_whole_or_nothing() {
    let program = post().render(Job::json(JOB), &Options::default()).unwrap();
    assert_eq!(program.text(), EXPECTED);
    let mut cut = Vec::new();
    let error = post().render_to(Job::json(&JOB[..JOB.len() / 2]), &Options::default(), &mut cut).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Job);
    assert_eq!(error.findings().diags.last().unwrap().code.name(), "PJ007");
    // events that end too early give no program
    let error = post().render(Job::events(|_| Ok(())), &Options::default()).unwrap_err();
    assert!(error.to_string().contains("Event::Finish"), "{error}");
}

#[test]
fn inputs_of_all_kinds_are_one_job() {
    let options = Options::default();
    let text = |job: Job<'_>| post().render(job, &options).unwrap().into_text();
    assert_eq!(text(Job::open("bracket.json", JOB).unwrap()), EXPECTED);
    assert_eq!(text(Job::open("what?", JOB).unwrap()), EXPECTED);
    assert_eq!(text(Job::stream(Format::Json, JOB.as_bytes())), EXPECTED);
    let mut file = Job::file(Format::Json, Cursor::new(JOB));
    assert_eq!(text(file.again()), EXPECTED);
    assert_eq!(text(file.again()), EXPECTED, "a file is read as often as it is asked for");
    let mut stream = Job::stream(Format::Json, JOB.as_bytes());
    text(stream.again());
    assert_eq!(post().render(stream.again(), &options).unwrap_err().kind(), ErrorKind::Usage);
    assert_eq!(Job::open("what?", "hello").unwrap_err().kind(), ErrorKind::Usage);
    // a program that is read as a job gives the same cuts
    let again = post().render(Job::nc(EXPECTED), &options).unwrap();
    assert!(!matches!(post().verify(Job::nc(EXPECTED), again.text()).unwrap(), Verdict::Different(_)));
}

#[test]
fn a_wrong_digit_is_a_difference_and_a_cut_job_is_an_error() {
    let post = post();
    assert!(!matches!(post.verify(Job::json(JOB), EXPECTED).unwrap(), Verdict::Different(_)));
    let wrong = EXPECTED.replacen("X2.25", "X2.35", 1);
    let Verdict::Different(findings) = post.verify(Job::json(JOB), wrong).unwrap() else { panic!("a wrong digit") };
    assert!(findings[0].line > 0 && findings[0].block.contains("X2.35"), "{findings:?}");
    assert_eq!(post.verify(Job::json(&JOB[..900]), EXPECTED).unwrap_err().kind(), ErrorKind::Job);
}

#[test]
fn an_output_that_fails_says_why() {
    struct Full;
    impl io::Write for Full {
        fn write(&mut self, _: &[u8]) -> io::Result<usize> {
            Err(io::ErrorKind::StorageFull.into())
        }
        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }
    let error = post().render_to(Job::json(JOB), &Options::default(), &mut Full).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Output);
    let source = error.source().unwrap().downcast_ref::<io::Error>().unwrap();
    assert_eq!(source.kind(), io::ErrorKind::StorageFull);
}

#[test]
fn options_are_checked() {
    let mut options = Options::default();
    options.set.push(("vall".into(), 1.0));
    let error = post().render(Job::json(JOB), &options).unwrap_err();
    assert!(error.to_string().contains("`vall` is not a variable"), "{error}");
}

#[test]
fn lines_of_a_program_have_their_form_line_and_item() {
    let (post, options) = (post(), Options::default());
    let pocket = EXPECTED.lines().position(|line| line.contains("X2.25")).unwrap() as u64 + 1;
    let origins = post.origins(Job::json(JOB), &options, &[pocket, 1, 9999]).unwrap();
    let [Some(cut), Some(start), None] = origins.as_slice() else { panic!("{origins:?}") };
    assert_eq!((cut.line, cut.place.path()), (pocket, "operations[0].path[7]".to_owned()));
    let form = &post.files()[0];
    assert_eq!(form.text.lines().nth(form.line(start.form.unwrap().start)), Some("%0"));
}

#[test]
fn a_place_in_a_job_is_data() {
    let job = JOB.replacen("\"line\"", "\"lime\"", 1);
    let error = post().render(Job::json(&job), &Options::default()).unwrap_err();
    let place = error.findings().diags[0].place.clone().unwrap();
    assert!(place.line.unwrap() > 1 && place.column.unwrap() > 1, "{place:?}");
    assert!(place.step.unwrap().starts_with("operations[0].path["));
}

#[test]
fn questions_of_a_form_are_answered_by_their_variable() {
    const ASKS: &str = include_str!("../../samples/prompted/form.pf");
    let post = Post::compile(Source::from_text("form.pf", ASKS), &NoFiles).unwrap();
    let asked: Vec<_> = post.prompts().map(|prompt| prompt.variable).collect();
    assert!(!asked.is_empty());
    let mut options = Options::default();
    for variable in asked {
        options.set_value(variable, 2.0).unwrap();
    }
    assert_eq!(options.set_value("h", 1.0).unwrap_err().to_string(), "[h] comes from the toolpath and can't be set");
}
