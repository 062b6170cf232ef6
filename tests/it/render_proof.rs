//! `render` proves the program that it prints: messages, output and exit status.

use std::fs;

use postform::{ErrorKind, Job, NoFiles, Options, Post, Source, Verdict};

use crate::support::folder::{Folder, err, out};
use crate::support::{job, mill, plain_post, root};

/// Two posts. The drill cycle of `wrong.pf` begins to feed at another height than the job. `right.pf` is correct.
fn posts(folder: &Folder) {
    let right = fs::read_to_string(root().join("postforms/haas.pf")).unwrap();
    folder.write("wrong.pf", right.replace("R[vclear]", "R[rplane]"));
    folder.write("right.pf", right);
    folder.write("job.json", fs::read_to_string(root().join("samples/bracket/job.json")).unwrap());
}

#[test]
fn what_differs_is_not_printed() {
    let folder = Folder::new("proof-different");
    posts(&folder);
    folder.write("out.nc", "the program of last year\n");
    let output = folder.run(&["render", "job.json", "--form", "wrong.pf", "-o", "out.nc"]);
    let said = err(&output);
    assert_eq!(output.status.code(), Some(1), "{said}");
    // the message names the job item, the form line, the program block and the result
    for part in [
        "PV005",
        "operations[2].path[0].cycle.points[0]",
        "[wrong.pf:",
        "R[rplane]",
        "the program, line",
        "different: ",
    ] {
        assert!(said.contains(part), "{part}\n{said}");
    }
    assert!(said.ends_with("nothing was printed\n"), "{said}");
    assert_eq!(folder.read("out.nc"), "the program of last year\n");
    let output = folder.run(&["render", "job.json", "--form", "wrong.pf", "--quiet"]);
    assert!(output.stdout.is_empty() && err(&output).contains("PV005"), "{}", err(&output));
    // with --no-verify, the program is printed without a message
    let output = folder.run(&["render", "job.json", "--form", "wrong.pf", "-o", "out.nc", "--no-verify"]);
    assert_eq!((output.status.code(), err(&output)), (Some(0), String::new()));
    assert!(folder.read("out.nc").starts_with('%'));
}

#[test]
fn what_is_right_is_printed_with_a_line_that_says_so() {
    let folder = Folder::new("proof-right");
    posts(&folder);
    let expected = fs::read_to_string(root().join("samples/bracket/expected.haas.nc")).unwrap();
    let told = |more: &[&str]| {
        let output = folder.run(&[&["render", "job.json", "--form", "right.pf"][..], more].concat());
        assert_eq!((output.status.code(), out(&output)), (Some(0), expected.clone()));
        err(&output)
    };
    let said = told(&[]);
    assert!(said.starts_with("equivalent: the program makes the cuts of job.json (19 cuts, 20 holes): "), "{said}");
    assert_eq!(said.lines().count(), 1);
    assert_eq!(told(&["--require-proof"]), said);
    assert_eq!(told(&["--quiet"]), "");
    let refused = folder.run(&["render", "job.json", "--form", "right.pf", "--stream"]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(err(&refused).contains("or with --set header=no"), "{}", err(&refused));
    let streamed = folder.run(&["render", "job.json", "--form", "right.pf", "--stream", "--set", "header=off"]);
    assert!(streamed.status.code() == Some(0) && err(&streamed).starts_with("not verified: "), "{}", err(&streamed));
    // a job that can be read only once
    let given = folder.read("job.json");
    let output = folder.feed(&["render", "-", "--form", "right.pf"], given.as_bytes());
    assert_eq!(out(&output), expected);
    assert!(err(&output).starts_with("equivalent: "), "{}", err(&output));
    let output = folder.feed(&["render", "-", "--form", "wrong.pf"], given.as_bytes());
    assert_eq!((output.status.code(), out(&output)), (Some(1), String::new()));
    assert!(err(&output).contains("[wrong.pf:"), "{}", err(&output));
}

/// For a long job, the renderer sends about thirty batches to the proof. Program and source map must be the same as
/// without a proof, and an error at the end must be found.
#[test]
fn a_long_job_is_proven_in_parts() {
    let folder = Folder::new("proof-long");
    let form = plain_post("haas.pf");
    folder.write("wrong.pf", form.replace("R[vclear]", "R[rplane]"));
    folder.write("right.pf", form);
    let lines: Vec<String> = (0..30_000).map(|i| format!("{{\"line\":[{}.5,{},0]}}", i % 7, i % 11)).collect();
    let drill = r#"{"cycle":{"kind":"drill","clear":0.1,"return":1,"feed":8,"depth":0.5,"points":[[4,4,0]]}}"#;
    folder.write("job.json", job(&format!("{},{{\"rapid\":[0,0,1]}},{drill}", lines.join(","))));
    let run = |more: &[&str]| folder.run(&[&["render", "job.json", "--trace", "map.json"][..], more].concat());
    let alone = run(&["--form", "right.pf", "--no-verify"]);
    let map = folder.read("map.json");
    let proven = run(&["--form", "right.pf"]);
    assert!(err(&proven).contains("(30000 cuts, 1 hole)"), "{}", err(&proven));
    assert!(out(&proven).lines().count() > 30_000 && out(&proven) == out(&alone));
    assert!(folder.read("map.json") == map, "the source map is another one");
    let said = err(&run(&["--form", "wrong.pf"]));
    for part in ["PV005", "operations[0].path[30002].cycle.points[0]", "[wrong.pf:", "R[rplane]"] {
        assert!(said.contains(part), "{part}\n{said}");
    }
}

#[test]
fn what_is_not_proven_is_printed_unless_a_proof_is_required() {
    let folder = Folder::new("proof-none");
    folder.write("form.pf", mill("", ""));
    folder.write("job.json", job("{\"line\":[1,1,0]}"));
    let run = |more: &[&str]| folder.run(&[&["render", "job.json", "--form", "form.pf"][..], more].concat());
    let output = run(&[]);
    let said = err(&output);
    assert_eq!(output.status.code(), Some(0), "{said}");
    assert!(said.contains("not proven: the form has no `Control`"), "{said}");
    let program = out(&output);
    assert!(program.contains("M30"), "{program}");
    let output = run(&["--require-proof"]);
    assert_eq!((output.status.code(), out(&output)), (Some(1), String::new()));
    assert!(err(&output).ends_with("nothing was printed\n"), "{}", err(&output));
    assert_eq!(run(&["--require-proof", "--no-verify"]).status.code(), Some(2));
    folder.write("postform.toml", "require-proof = true\n");
    assert_eq!(run(&[]).status.code(), Some(1));
    assert_eq!(out(&run(&["--no-verify"])), program);
    // with `--control`, the control is known, and its rules do not allow this tool change without G43
    let output = run(&["--control", "fanuc"]);
    assert!(err(&output).contains("different: "), "{}", err(&output));
}

/// To run a call of the program's own subprograms, the proof must go back in the program.
#[test]
fn a_program_that_calls_parts_of_itself_is_gone_through_as_a_file() {
    let folder = Folder::new("proof-file");
    let form = plain_post("linuxcnc.pf");
    folder.write("form.pf", form.replace("\nEndCode\n", "\nEndCode\no100 sub\no100 endsub\no100 call\n"));
    folder.write("job.json", job("{\"line\":[1,1,0]},{\"rapid\":[1,1,1]}"));
    let output = folder.run(&["render", "job.json", "--form", "form.pf"]);
    let said = err(&output);
    assert!(said.contains("identical: ") || said.contains("equivalent: "), "{said}");
    let output = folder.feed(&["render", "-", "--form", "form.pf"], folder.read("job.json").as_bytes());
    let said = err(&output);
    assert_eq!(output.status.code(), Some(0), "{said}");
    assert!(said.contains("not proven: the program contains calls or repeats"), "{said}");
}

#[test]
fn a_verdict_is_a_document_for_programs() {
    let folder = Folder::new("proof-json");
    posts(&folder);
    let document = |form: &str| -> serde_json::Value {
        let output = folder.run(&["verify", "job.json", "--form", form, "--format", "json"]);
        serde_json::from_slice(&output.stdout).unwrap()
    };
    let right = document("right.pf");
    assert_eq!((&right["verdict"], &right["compared"]["holes"]), (&"equivalent".into(), &20.into()));
    assert!(right["allowed"]["pecks"].as_u64().unwrap() > 0 && right["findings"].as_array().unwrap().is_empty());
    let wrong = document("wrong.pf");
    assert_eq!(wrong["verdict"], "different");
    let finding = &wrong["findings"][0];
    assert_eq!((&finding["code"], &finding["form"]["file"]), (&"PV005".into(), &"wrong.pf".into()), "{wrong}");
    assert!(finding["program_line"].is_u64() && finding["job"]["line"].is_u64(), "{wrong}");
}

/// The library returns no program that differs from its job.
#[test]
fn the_library_gives_no_program_that_differs() {
    let right = include_str!("../../postforms/haas.pf");
    let bracket = include_str!("../../samples/bracket/job.json");
    let post = |text: String| Post::compile(Source::from_text("haas.pf", text), &NoFiles).unwrap();
    let program = post(right.into()).render(Job::json(bracket), &Options::default()).unwrap();
    assert!(matches!(program.verdict(), Verdict::Equivalent(_)), "{}", program.verdict());
    let wrong = post(right.replace("R[vclear]", "R[rplane]"));
    let error = wrong.render(Job::json(bracket), &Options::default()).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Proof);
    let finding = &error.findings().diags[0];
    assert_eq!(finding.code.name(), "PV005");
    assert!(error.findings().files[0].slice(finding.labels[0].span).contains("R[rplane]"), "{error:?}");
    let mut options = Options::default();
    options.proof = None;
    let program = wrong.render(Job::json(bracket), &options).unwrap();
    assert!(matches!(program.verdict(), Verdict::NotProven(_)) && !program.text().is_empty());
}
