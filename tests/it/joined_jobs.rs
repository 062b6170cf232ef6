//! `render --join`: several jobs as one program.

use crate::support::folder::{Folder, err, out};
use crate::support::root;
use postform::{Job, NoFiles, Options, Post, Source};
use proptest::prelude::*;

/// A job for a mill: the head, and its operations.
fn job(head: &str, operations: &str) -> String {
    format!(
        r#"{{"postform":1,{head}"tools":[{{"number":1,"diameter":10,"length_offset":1}},{{"number":2,"diameter":6,"length_offset":2}}],"operations":[{operations}]}}"#
    )
}

const HEAD: &str = r#""program":7,"name":"PART","units":"mm","machine":"mill","#;
const FIRST: &str = r#"{"tool":1,"work":54,"spindle":{"speed":1000,"direction":"cw"},"coolant":"flood","feed":100,"path":[{"rapid":[0,0,5]},{"line":[0,0,-1]},{"line":[10,0,-1]},{"rapid":[10,0,5]}]}"#;
const SECOND: &str = r#"{"tool":2,"work":55,"spindle":{"speed":2000,"direction":"cw"},"feed":80,"path":[{"rapid":[3,4,5]},{"line":[3,4,-2]},{"rapid":[3,4,5]}]}"#;

fn post(form: &str) -> Post {
    let text = std::fs::read_to_string(root().join("postforms").join(form)).unwrap();
    Post::compile(Source::from_text(form, text), &NoFiles).unwrap()
}

/// Joins jobs named a, b, c.
fn join(texts: &[String]) -> Job<'_> {
    Job::join(texts.iter().zip(["a", "b", "c", "d"]).map(|(text, name)| Job::json(text).named(name)).collect())
}

/// The error of joining two jobs: its location and message.
fn refused(first: &str, second: &str) -> String {
    let texts = [first.to_owned(), second.to_owned()];
    let error = post("haas.pf").render(join(&texts), &Options::default()).unwrap_err();
    let diag = error.findings().diags.iter().find(|diag| diag.is_error()).unwrap().clone();
    format!("{} {} {}", diag.code.name(), diag.place.unwrap(), diag.message)
}

#[test]
fn the_second_job_follows_the_first() {
    let texts = [job(HEAD, FIRST), job(&HEAD.replace("PART", "OTHER"), SECOND)];
    let program = post("haas.pf").render(join(&texts), &Options::default()).unwrap();
    assert!(program.verdict().is_proven());
    let text = program.text();
    assert!(text.contains("(PART)") && !text.contains("(OTHER)"), "{text}");
    assert_eq!(text.matches("M30").count(), 1, "{text}");
    // the flood coolant of the first job is turned off for the second job, which has no coolant
    let second = &text[text.find("G55 X3. Y4.").unwrap()..];
    assert!(!second.contains("M8"), "{text}");
}

/// A job is refused if its meaning would change because of a state that the previous job leaves active.
#[test]
fn a_job_that_would_change_its_meaning_is_refused() {
    let first = job(HEAD, FIRST);
    let second = |from: &str, to: &str| job(HEAD, &SECOND.replace(from, to));
    let sets = job(HEAD, &FIRST.replace(r#"{"rapid":[10,0,5]}"#, r#"{"rapid":[10,0,5]},{"set":{"depth":3}}"#));
    let text = job(HEAD, &FIRST.replace(r#"{"rapid":[10,0,5]}"#, r#"{"rapid":[10,0,5]},{"text":"G68 R30."}"#));
    let surface = job(HEAD, &FIRST.replace(r#""speed":1000"#, r#""speed":100,"mode":"css","max":3000"#));
    for (first, second, reason) in [
        (&first, job(&HEAD.replace("mm", "inch"), SECOND), "its units are inch, not mm"),
        (&first, job(&HEAD.replace("mill", "lathe"), SECOND), "another type of machine"),
        (
            &first,
            job(&format!(r#"{HEAD}"set":{{"x":1}},"#), SECOND),
            "its `set` for the whole program contains other values",
        ),
        (&first, second(r#""work":55,"#, ""), "does not give its work offset"),
        (&first, second(r#","direction":"cw""#, ""), "does not give its direction of the spindle"),
        (&first, second(r#""speed":2000,"#, ""), "does not give its spindle speed"),
        (&first, second("[3,4,5]},{\"line\"", "[3,4]},{\"line\""), "gives Z"),
        (&first, second(r#"{"rapid":[3,4,5]},{"line""#, r#"{"line""#), "gives X"),
        (&first, job(HEAD, SECOND).replace(r#""diameter":6"#, r#""diameter":8"#), "its tool 2"),
        (&sets, job(HEAD, SECOND), "does not set `depth`"),
        (&text, job(HEAD, SECOND), "contains text for the program"),
        (&surface, second(r#""speed":2000,"#, r#""speed":100,"mode":"css","#), "highest spindle speed"),
    ] {
        // the second job has another tool under a number that the first job also uses
        let first = first.replace(r#""operations":["#, &format!(r#""operations":[{SECOND},"#));
        let found = refused(&first, &second);
        assert!(found.starts_with("PJ014 b:") && found.contains("b can't follow a: "), "{reason}: {found}");
        assert!(found.contains(reason), "{reason}: {found}");
    }
}

/// Each machine names its own axes: a wire has U and V.
#[test]
fn a_joined_wire_job_gives_its_guides() {
    let folder = Folder::new("joined-wire");
    folder.write("job.json", r#"{"postform":1,"program":1,"units":"mm","machine":"edm","tools":[{"number":1}],"operations":[{"tool":1,"work":54,"feed":3,"path":[{"rapid":[0,0]},{"line":[5,10,4.5,10]}]}]}"#);
    let form = root().join("postforms/wire-edm.pf").display().to_string();
    let refused = err(&folder.run(&["render", "job.json", "job.json", "--join", "--form", &form]));
    assert!(refused.contains("PJ014") && refused.contains("that gives U"), "{refused}");
}

/// The extents of a job contain the bottoms of its holes, which lie along Z on a lathe.
#[test]
fn the_extents_of_a_lathe_job_contain_its_holes() {
    let folder = Folder::new("lathe-hole");
    folder.write("job.json", r#"{"postform":1,"units":"mm","machine":"lathe","tools":[{"number":1}],"operations":[{"tool":1,"spindle":{"speed":500,"direction":"cw"},"feed":0.2,"path":[{"rapid":[5,0]},{"cycle":{"kind":"drill","depth":20,"clear":2,"feed":50,"points":[[0,0]]}}]}]}"#);
    let checked = out(&folder.run(&["check", "job.json"]));
    assert!(checked.contains("h           -20 to 5 mm") && checked.contains("v           0 to 0 mm"), "{checked}");
}

/// A subprogram belongs to its own job.
#[test]
fn subprograms_are_not_shared() {
    let text = std::fs::read_to_string(root().join("samples/sub-call/form.pf")).unwrap();
    let post = Post::compile(Source::from_text("form.pf", text), &NoFiles).unwrap();
    let head = HEAD.replace("mm", "inch");
    let with = |numbers: &[u32]| {
        let sub = |number| format!(r#"{{"number":{number},"path":[{{"line":[10,0,-1],"feed":9}}]}}"#);
        format!(r#"{head}"subprograms":[{}],"#, numbers.iter().map(sub).collect::<Vec<_>>().join(","))
    };
    let calls = |operation: &str, number: u32| {
        operation.replacen("},{\"rapid\"", &format!("}},{{\"call\":{{\"sub\":{number}}}}},{{\"rapid\""), 1)
    };
    let render = |texts: &[String]| post.render(join(texts), &Options::default());
    let first = job(&with(&[5]), &calls(FIRST, 5));
    assert!(render(&[first.clone(), job(&with(&[6]), &calls(SECOND, 6))]).is_ok());
    for (second, reason) in [
        (job(&with(&[5]), &calls(SECOND, 5)), "both have a subprogram 5"),
        (job(&with(&[6]), &calls(SECOND, 5)), "it calls subprogram 5, which only an earlier job contains"),
    ] {
        let error = render(&[first.clone(), second]).unwrap_err().to_string();
        assert!(error.contains(reason), "{error}");
    }
}

/// The message names the job that conflicts, which is not always the previous one.
#[test]
fn the_job_that_conflicts_is_named() {
    let third = job(HEAD, FIRST).replace(r#""diameter":10"#, r#""diameter":8"#);
    let texts = [job(HEAD, FIRST), job(HEAD, SECOND), third];
    let error = post("haas.pf").render(join(&texts), &Options::default()).unwrap_err().to_string();
    assert!(error.contains("c can't follow a: its tool 1"), "{error}");
    // the text of a subprogram has an effect if the job calls the subprogram
    let form = std::fs::read_to_string(root().join("samples/sub-call/form.pf")).unwrap();
    let post = Post::compile(Source::from_text("form.pf", form), &NoFiles).unwrap();
    let head = HEAD.replace("mm", "inch");
    let sub = r#""subprograms":[{"number":5,"path":[{"line":[10,0,-1],"feed":9},{"text":"M100"}]}],"#;
    let first = job(&format!("{head}{sub}"), &FIRST.replacen("},{\"rapid\"", "},{\"call\":{\"sub\":5}},{\"rapid\"", 1));
    let error = post.render(join(&[first, job(&head, SECOND)]), &Options::default()).unwrap_err().to_string();
    assert!(error.contains("contains text for the program"), "{error}");
}

/// The definition of a subprogram is not a part of the operations: it changes neither the state that the job before leaves
/// active, nor the state of its own job.
#[test]
fn a_subprogram_has_an_effect_only_where_it_is_called() {
    let form = std::fs::read_to_string(root().join("samples/sub-call/form.pf")).unwrap();
    let form = form + "\nMoveHome\nG28 G91 Z0.\nG90\nEnd\n";
    let post = Post::compile(Source::from_text("form.pf", form), &NoFiles).unwrap();
    let head = HEAD.replace("mm", "inch");
    let with = |path: &str, operations: &str| {
        job(&format!(r#"{head}"subprograms":[{{"number":5,"path":[{{"rapid":[1,1,5]}}{path}]}}],"#), operations)
    };
    let home = FIRST.replace(r#"{"rapid":[10,0,5]}"#, r#"{"rapid":[10,0,5]},{"home":true}"#);
    let call = r#",{"call":{"sub":5}},{"rapid":[10,0,5]}"#;
    let calls = FIRST.replace(r#",{"rapid":[10,0,5]}"#, call);
    let again = SECOND.replace("\"tool\":2", "\"tool\":1");
    let no_turn = again.replace(r#","direction":"cw""#, "");
    for (first, second, refused) in [
        // the move home, the spindle and the coolant of the definition are not those of the job before
        (job(&head, FIRST), with(r#",{"home":true}"#, &again), None),
        (job(&head, &home), with(r#",{"home":true}"#, &again), None),
        (job(&head, &home), with("", &again), None),
        (job(&head, &home), with(r#",{"spindle":{"direction":"off"}}"#, &no_turn), Some("direction of the spindle")),
        (job(&head, FIRST), with(r#",{"text":"M100"}"#, SECOND), None),
        (job(&head, FIRST), with(r#",{"set":{"val1":3}}"#, SECOND), None),
        (job(&head, FIRST), with(r#",{"rapid":[null,null,null,30]}"#, SECOND), None),
        // of the job before, only subprograms that it calls have an effect
        (with(r#",{"text":"M100"}"#, FIRST), job(&head, SECOND), None),
        (with(r#",{"text":"M100"}"#, &calls), job(&head, SECOND), Some("contains text for the program")),
        (with(r#",{"rapid":[null,null,null,30]}"#, &calls), job(&head, SECOND), Some("gives A")),
        // the feed mode is per minute in each operation that gives none
        (job(&head, &FIRST.replace("\"feed\"", "\"feed_mode\":\"per_minute\",\"feed\"")), job(&head, SECOND), None),
    ] {
        let found = post.render(join(&[first, second.clone()]), &Options::default());
        match (found, refused) {
            (Err(error), Some(reason)) => assert!(error.to_string().contains(reason), "{second}: {error}"),
            (Err(error), None) => assert!(!error.to_string().contains("PJ014"), "{second}: {error}"),
            (Ok(program), refused) => assert_eq!(refused, None, "{second}: {}", program.text()),
        }
    }
    // the coolant of the job before is turned off for a job without coolant
    let texts = [job(&head, &home), with(r#",{"coolant":"off"}"#, &again)];
    let program = post.render(join(&texts), &Options::default()).unwrap();
    let (_, second) = program.text().split_once("G90\n").unwrap();
    assert!(second.contains("M9"), "{}", program.text());
}

/// An error has its location in its own job, whether the reader, the renderer or the proof finds it.
#[test]
fn errors_name_their_job() {
    let folder = Folder::new("joined");
    folder.write("a.json", job(HEAD, FIRST));
    folder.write("b.json", job(HEAD, SECOND));
    folder.write("cut.json", &job(HEAD, SECOND)[..200]);
    folder.write("no-feed.json", job(HEAD, &SECOND.replace(r#""feed":80,"#, "")));
    let form = std::fs::read_to_string(root().join("postforms/haas.pf")).unwrap();
    folder.write("my.pf", &form);
    folder.write(
        "bad.pf",
        form + "\nLineCode\n@if [tool] = 2\n  G1 X[h] Y[v] Z[d-1] F[frate]\n@else\n  G1 X[h] Y[v] Z[d] F[frate]\n@end\nEnd\n",
    );
    let run = |second: &str, form: &str| folder.run(&["render", "a.json", second, "--join", "--form", form]);
    assert!(err(&run("cut.json", "my.pf")).contains("PJ007 at cut.json:1:"), "{}", err(&run("cut.json", "my.pf")));
    let no_feed = run("no-feed.json", "my.pf");
    assert!(err(&no_feed).contains(" at no-feed.json:1:"), "{}", err(&no_feed));
    let wrong = err(&run("b.json", "bad.pf"));
    assert!(wrong.contains("PV001 at b.json:1:") && !wrong.contains(" at a.json"), "{wrong}");
    assert!(wrong.contains("different: the program does not make the motions of a.json and b.json"), "{wrong}");
    let missing = run("c.json", "my.pf");
    assert_eq!(missing.status.code(), Some(2));
    assert!(err(&missing).contains("can't read c.json"), "{}", err(&missing));
    // without `--join`, several jobs need an output folder
    let several = folder.run(&["render", "a.json", "b.json", "--form", "my.pf"]);
    assert!(
        several.status.code() == Some(2) && err(&several).contains("or --join to make one program"),
        "{}",
        err(&several)
    );
    // the source map names the files, and standard input may be one of the jobs
    let traced = folder.run(&[
        "render",
        "a.json",
        "b.json",
        "--join",
        "--form",
        "my.pf",
        "--trace",
        "trace.jsonl",
        "-o",
        "part.nc",
    ]);
    assert!(traced.status.success(), "{}", err(&traced));
    let trace = folder.read("trace.jsonl");
    assert!(trace.contains(r#""file":"a.json""#) && trace.contains(r#""file":"b.json""#), "{trace}");
    let fed = folder.feed(&["render", "-", "b.json", "--join", "--form", "my.pf"], job(HEAD, FIRST).as_bytes());
    assert_eq!(out(&fed), folder.read("part.nc"));
}

/// The cuts and holes of a program with their work offsets, from the simulator.
fn cuts(folder: &Folder, program: &str) -> Vec<String> {
    folder.write("program.nc", program);
    let simulated = folder.run(&["simulate", "program.nc", "--control", "haas"]);
    assert!(simulated.status.success(), "{}", err(&simulated));
    let mut work = String::new();
    let mut found = Vec::new();
    for line in out(&simulated).lines() {
        let words: Vec<&str> = line.split_whitespace().skip(1).collect();
        match words.first().copied() {
            Some("work") => work = words[1..].join(" "),
            Some("feed" | "arc" | "hole") => found.push(format!("{work}: {}", words.join(" "))),
            _ => {}
        }
    }
    found
}

fn operations() -> impl Strategy<Value = String> {
    let operation = (1..=2u32, 54..=57u32, -20..20i32, -20..20i32, prop::bool::ANY, prop::bool::ANY).prop_map(|(tool, work, x, y, coolant, drills)| {
        let coolant = if coolant { r#""coolant":"flood","# } else { "" };
        let path = match drills {
            true => format!(r#"{{"cycle":{{"kind":"drill","depth":5,"clear":2,"feed":50,"points":[[{x},{y},0],[{},{y},0]]}}}}"#, x + 5),
            false => format!(r#"{{"rapid":[{x},{y},5]}},{{"line":[{x},{y},-1]}},{{"line":[{y},{x},-2]}},{{"rapid":[{y},{x},5]}}"#),
        };
        format!(r#"{{"tool":{tool},"work":{work},"spindle":{{"speed":{},"direction":"cw"}},{coolant}"feed":100,"path":[{path}]}}"#, 900 + x)
    });
    prop::collection::vec(operation, 1..4).prop_map(|operations| operations.join(","))
}

/// The height at the end of a cycle is not that of the next job.
#[test]
fn a_joined_job_follows_a_cycle_with_the_same_tool() {
    let keys = r#""tool":1,"work":54,"spindle":{"speed":900,"direction":"cw"},"feed":100"#;
    let holes = format!(
        r#"{{{keys},"path":[{{"cycle":{{"kind":"drill","depth":5,"clear":2,"feed":50,"points":[[0,0,0],[5,0,0]]}}}}]}}"#
    );
    let cut = format!(r#"{{{keys},"path":[{{"rapid":[0,0,5]}},{{"line":[0,0,-1]}},{{"rapid":[0,0,5]}}]}}"#);
    let joined = post("haas.pf").render(join(&[job(HEAD, &holes), job(HEAD, &cut)]), &Options::default()).unwrap();
    assert!(joined.verdict().is_proven());
    assert_eq!(joined.text().matches("T1 M6").count(), 2, "{}", joined.text());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// The joined program makes the cuts of the separate programs in order, and is proven. Each job begins with a tool
    /// change, even if two jobs in a row use the same tool.
    #[test]
    fn a_joined_program_makes_the_cuts_of_its_parts(parts in prop::collection::vec(operations(), 2..4), home in prop::bool::weighted(0.7)) {
        let folder = Folder::new("joined-random");
        let post = post("haas.pf");
        let ended = |operations: &String| match home {
            true => format!("{},{{\"home\":true}}]}}", operations.strip_suffix("]}").unwrap()),
            false => operations.clone(),
        };
        let texts: Vec<String> = parts.iter().map(|operations| job(HEAD, &ended(operations))).collect();
        let separate: Vec<String> = texts.iter().flat_map(|text| {
            let program = post.render(Job::json(text), &Options::default()).unwrap();
            cuts(&folder, program.text())
        }).collect();
        prop_assert!(!separate.is_empty());
        let joined = post.render(join(&texts), &Options::default()).unwrap();
        prop_assert!(joined.verdict().is_proven());
        let changes = |program: &str| program.matches(" M6\n").count();
        let alone = |text: &String| changes(post.render(Job::json(text), &Options::default()).unwrap().text());
        prop_assert_eq!(changes(joined.text()), texts.iter().map(alone).sum::<usize>(), "{}", joined.text());
        prop_assert_eq!(cuts(&folder, joined.text()), separate, "{}", joined.text());
    }
}

/// The axes of a lathe are Z and X.
#[test]
fn lathe_jobs_follow_each_other() {
    let path = r#"[{"rapid":[5,30]},{"line":[-10,30],"feed":0.2},{"rapid":[-10,40]}]"#;
    let lathe = |tool: u32| {
        format!(
            r#"{{"postform":1,"program":7,"name":"A","units":"mm","machine":"lathe","tools":[{{"number":{tool}}}],"operations":[{{"tool":{tool},"spindle":{{"speed":500,"direction":"cw"}},"coolant":"off","feed_mode":"per_rev","path":{path}}}]}}"#
        )
    };
    let post = post("haas-lathe.pf");
    let joined = post.render(join(&[lathe(1), lathe(2)]), &Options::default()).unwrap();
    assert!(joined.text().contains("T202") || joined.text().contains("T0202"), "{}", joined.text());
    assert!(!joined.text().contains('Y'), "{}", joined.text());
    let no_x = lathe(2).replace("[5,30]", "[5]");
    let error = post.render(join(&[lathe(1), no_x]), &Options::default()).unwrap_err().to_string();
    assert!(error.contains("gives X"), "{error}");
}
