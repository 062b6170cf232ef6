//! Parts of a job (`--split`, `--only` and similar options): a part has the state that the whole program has there.

use crate::support::folder::{Folder, err, out};
use crate::support::root;
use postform::{Job, NoFiles, Options, Post, Selection, Source};
use proptest::prelude::*;

/// A form with subprograms for a mill with a rotary axis, and with the property `slow`.
fn form() -> String {
    let text = std::fs::read_to_string(root().join("postforms/haas-4axis.pf")).unwrap();
    let drill = text.lines().find(|line| line.contains(" G81 ")).unwrap();
    let slow = format!("@if [slow]\n{drill} (SLOW)\n@else\n{drill}\n@end");
    let text =
        text.replacen(drill, &slow, 1).replacen("\nName ", "\nSubs1st? N\nProperty slow yesno no Slow\nName ", 1);
    format!("{text}\nSubStart\nO[sub]\nEnd\n\nSubEnd\nM99\nEnd\n\nSubCall\nM98 P[sub] L[times]\nEnd\n")
}

fn post() -> Post {
    Post::compile(Source::from_text("form.pf", form()), &NoFiles).unwrap()
}

/// Subprogram 8 moves, and changes spindle and coolant. Subprogram 7 turns A. Subprogram 9 calls 7.
const SUBS: &str = r#""subprograms":[{"number":8,"path":[{"rapid":[4,4,10]},{"line":[4,4,9],"feed":77},{"spindle":{"speed":700,"direction":"ccw"}},{"coolant":"off"}]},{"number":7,"path":[{"rapid":[5,5,10,45]},{"line":[5,5,9],"feed":77},{"rapid":[5,5,10]}]},{"number":9,"path":[{"call":{"sub":7}},{"rapid":[5,5,10]}]}],"#;

fn job(operations: &[String]) -> String {
    let tools = r#""tools":[{"number":1,"length_offset":1},{"number":2,"length_offset":2}]"#;
    format!(
        r#"{{"postform":1,"program":100,"units":"mm","machine":"mill",{tools},{SUBS}"operations":[{}]}}"#,
        operations.join(",")
    )
}

/// An operation: tool, further keys, and the path.
fn operation(tool: u32, keys: &str, path: &str) -> String {
    format!(r#"{{"tool":{tool},{keys}"path":[{path}]}}"#)
}

/// The program of operation `number`, or the code and message of its error. `None`: of the whole job.
fn print(post: &Post, text: &str, number: Option<u64>) -> Result<String, String> {
    let mut job = Job::json(text);
    job.reading.select = Selection { operation: number, ..Selection::default() };
    match post.render(job, &Options::default()) {
        Ok(program) => Ok(program.text().to_owned()),
        Err(error) => {
            let diag = error.findings().diags.iter().find(|diag| diag.is_error()).unwrap().clone();
            Err(format!("{} {}", diag.code.name(), diag.message))
        }
    }
}

const TURNS: &str = r#""spindle":{"speed":1000,"direction":"cw"},"feed":100,"#;
const AT_90: &str = r#"{"rapid":[0,0,10,90]},{"line":[0,0,-1]},{"rapid":[0,0,10]}"#;
const CUT: &str = r#"{"rapid":[1,1,10]},{"line":[1,1,-1]},{"rapid":[1,1,10]}"#;

/// The second operation begins at the angle at which the first ends, also after a change of the work offset, after a move
/// home and after the call of a subprogram that does not turn.
#[test]
fn a_part_begins_at_the_angle_of_the_whole_program() {
    let post = post();
    for (end, tool, keys, path, expected) in [
        ("", 2, TURNS, CUT, Ok("A90.")),
        (r#",{"work":55}"#, 2, TURNS, CUT, Ok("A90.")),
        (r#",{"home":true}"#, 2, TURNS, CUT, Ok("A90.")),
        (r#",{"home":true}"#, 1, "\"feed\":100,", CUT, Ok("A90.")),
        (r#",{"call":{"sub":8}}"#, 2, TURNS, CUT, Ok("A90.")),
        (r#",{"call":{"sub":7}},{"rapid":[0,0,10,30]}"#, 2, TURNS, CUT, Ok("A30.")),
        (r#",{"call":{"sub":7}}"#, 2, TURNS, AT_90, Ok("A90.")),
        (r#",{"call":{"sub":7}}"#, 2, TURNS, CUT, Err("does not give A at its first position")),
        (r#",{"call":{"sub":9}}"#, 2, TURNS, CUT, Err("does not give A at its first position")),
        ("", 2, TURNS, r#"{"call":{"sub":8,"at":[4,4,10]}}"#, Ok("A90.")),
        ("", 1, TURNS, r#"{"call":{"sub":8}}"#, Err("does not give A at its first position")),
    ] {
        let first = operation(1, &format!("\"work\":54,{TURNS}"), &format!("{AT_90}{end}"));
        let printed = print(&post, &job(&[first, operation(tool, keys, path)]), Some(2));
        match (printed, expected) {
            (Ok(program), Ok(words)) => {
                let (before, _) = program.split_once("\nN60 ").unwrap();
                assert!(before.contains(words), "{end} {path}: {program}");
            }
            (Err(message), Err(why)) => assert!(message.starts_with("PR060") && message.contains(why), "{message}"),
            (printed, expected) => panic!("{end} {path}: {printed:?}, not {expected:?}"),
        }
    }
}

/// A new tool, or a new work offset, has no last position. The tool change moves to the first position of the operation,
/// even if several rapids give this position.
#[test]
fn a_part_does_not_take_the_position_of_another_tool_or_work_offset() {
    let post = post();
    for (tool, keys) in [(2, "\"work\":55,"), (2, ""), (1, "\"work\":55,")] {
        let first = operation(
            1,
            &format!("\"work\":54,{TURNS}"),
            r#"{"rapid":[500,0,10]},{"line":[500,0,-1]},{"rapid":[500,0,10]}"#,
        );
        let path = r#"{"rapid":[null,null,5]},{"rapid":[20,20]},{"line":[20,20,-1]}"#;
        let part =
            print(&post, &job(&[first.clone(), operation(tool, &format!("{keys}{TURNS}"), path)]), Some(2)).unwrap();
        assert!(part.contains(" X20. Y20.") && !part.contains("X500."), "{tool} {keys}: {part}");
        // a position that the whole program does not have is not invented
        let text = job(&[first, operation(tool, &format!("{keys}{TURNS}"), r#"{"rapid":[20]},{"line":[20,20,-1]}"#)]);
        assert!(print(&post, &text, Some(2)).is_err());
    }
}

/// The tool change of a part comes down to the first position of the part. An operation is refused if it begins at the
/// depth of the last cut before it, or at another height to which the whole program does not come down by a rapid.
#[test]
fn a_part_begins_at_a_height_to_which_the_whole_program_comes_down() {
    let post = post();
    let slot = r#"{"rapid":[0,0,20]},{"rapid":[0,0,2]},{"line":[0,0,-5]},{"line":[90,0,-5]}"#;
    let side = r#"{"rapid":[0,-20,20]},{"rapid":[0,-20,-5]},{"line":[90,-20,-5]}"#;
    let straight = r#"{"rapid":[0,0,20]},{"line":[0,0,-5]},{"line":[90,0,-5]}"#;
    let drilled = r#"{"rapid":[0,0,20]},{"cycle":{"kind":"drill","depth":5,"clear":3,"feed":50,"points":[[1,1,0]]}}"#;
    for (before, first, refused) in [
        (slot, r#"{"rapid":[90,30]}"#, Some("begins at Z-5")),
        (slot, r#"{"rapid":[90,30,-5]}"#, Some("begins at Z-5")),
        (slot, r#"{"rapid":[90,0,-4]},{"rapid":[90,30,-4]}"#, Some("begins at Z-4")),
        (slot, r#"{"rapid":[90,30,-6]}"#, Some("begins at Z-6")),
        // up to the clearance, or directly to a position above it
        (slot, r#"{"rapid":[90,0,2]},{"rapid":[90,30,2]}"#, None),
        (slot, r#"{"rapid":[90,30,5]}"#, None),
        (slot, r#"{"line":[90,0,2]}"#, Some("begins with a cut")),
        // the tool came down to this depth beside the part only
        (side, r#"{"rapid":[90,0]}"#, Some("begins at Z-5")),
        (side, r#"{"rapid":[90,-20,20]}"#, None),
        (straight, r#"{"rapid":[90,0,2]}"#, Some("raise the tool to Z20 or higher")),
        (straight, r#"{"rapid":[90,0,20]}"#, None),
        (drilled, r#"{"rapid":[1,1,3]}"#, None),
    ] {
        for after in ["", r#",{"rapid":[null,null,20]}"#] {
            let text = job(&[
                operation(1, &format!("\"work\":54,{TURNS}"), &format!("{before}{after}")),
                operation(1, TURNS, &format!(r#"{first},{{"line":[90,40,-5]}},{{"rapid":[90,40,20]}}"#)),
            ]);
            print(&post, &text, None).unwrap();
            let mut part = Job::json(&text);
            part.reading.select.operation = Some(2);
            let error = post.render(part, &Options::default()).err().map(|error| error.to_string());
            let is_cut = refused.is_some_and(|why| why.contains("a cut"));
            match refused.filter(|_| after.is_empty() || is_cut) {
                None => assert_eq!(error, None, "{before}{after} {first}"),
                Some(why) => {
                    let error = error.unwrap_or_else(|| panic!("{before} {first}"));
                    assert!(error.contains("PR060") && error.contains(why), "{before} {first}: {error}");
                }
            }
        }
    }
}

/// The rapids of an operation on a lathe stay apart in a part, because both axes at once can go through a shoulder.
#[test]
fn a_part_keeps_the_order_of_the_rapids() {
    let text = std::fs::read_to_string(root().join("postforms/haas-lathe.pf")).unwrap();
    let post = Post::compile(Source::from_text("haas-lathe.pf", text), &NoFiles).unwrap();
    let operation = |tool: u32, path: &str| {
        format!(
            r#"{{"tool":{tool},"work":54,"spindle":{{"speed":800,"direction":"cw"}},"feed":0.2,"feed_mode":"per_rev","path":[{path}]}}"#
        )
    };
    let turn = r#"{"rapid":[2,30]},{"line":[-20,30]},{"rapid":[2,50]}"#;
    let groove = r#"{"rapid":[-40]},{"rapid":[null,41]},{"line":[-40,30]},{"rapid":[-40,50]}"#;
    let text = format!(
        r#"{{"postform":1,"program":1,"units":"mm","machine":"lathe","tools":[{{"number":1,"length_offset":1}},{{"number":2,"length_offset":2}}],"operations":[{},{},{}]}}"#,
        operation(1, turn),
        operation(2, turn),
        operation(1, groove)
    );
    let mut part = Job::json(&text);
    part.reading.select.only = vec![1];
    let part = post.render(part, &Options::default()).unwrap().text().to_owned();
    for program in [print(&post, &text, None).unwrap(), print(&post, &text, Some(3)).unwrap(), part] {
        let words: Vec<&str> = program.lines().filter_map(|line| Some(line.split_once(' ')?.1)).collect();
        assert!(words.windows(2).any(|two| two == ["G0 Z-40.", "X82."]), "{program}");
    }
}

/// A value of a property applies only to its own operation; the value of a variable stays.
#[test]
fn a_property_of_a_left_out_operation_ends_with_it() {
    let post = post();
    let drill = r#"{"rapid":[0,0,10]},{"cycle":{"kind":"drill","depth":5,"clear":2,"feed":50,"points":[[1,1,0]]}}"#;
    let slow = operation(1, &format!("\"work\":54,\"set\":{{\"slow\":true}},{TURNS}"), drill);
    let later = format!(r#"{{"set":{{"slow":true}}}},{drill}"#);
    for (second, expected) in [
        (operation(2, TURNS, drill), 0),
        (operation(2, &format!("\"set\":{{\"slow\":true}},{TURNS}"), drill), 1),
        (operation(2, TURNS, &later), 1),
    ] {
        let part = print(&post, &job(&[slow.clone(), second]), Some(2)).unwrap();
        assert_eq!(part.matches("(SLOW)").count(), expected, "{part}");
    }
}

/// `--split work`: the operation of another work offset is left out between two operations with the same tool. The tool is
/// retracted between them.
#[test]
fn a_tool_is_retracted_where_an_operation_of_another_work_offset_is_left_out() {
    let post = post();
    let below = r#"{"rapid":[1,1,10]},{"line":[1,1,-1]},{"line":[2,2,-1]}"#;
    let keys = format!("\"work\":54,\"coolant\":\"flood\",{TURNS}");
    let text = job(&[
        operation(1, &keys, below),
        operation(1, "\"work\":55,\"feed\":100,", below),
        operation(1, "\"work\":54,\"feed\":100,", CUT),
    ]);
    let mut part = Job::json(&text);
    part.reading.select.work = Some(Some(54.0));
    let part = post.render(part, &Options::default()).unwrap().text().to_owned();
    let (before, after) = part.split_once("X2. Y2.").unwrap().1.split_once("T1 M6").unwrap();
    assert!(before.contains("G53 Z0") || before.contains("G28"), "{part}");
    assert!(after.contains("S1000 M3") && after.contains("M8"), "spindle and coolant stay: {part}");
}

/// The job changes from tool 1 to tool 2 and back. A program without the operation of tool 2 changes from tool 1 to tool 1,
/// with the retract and the approach of the whole program.
#[test]
fn a_tool_that_is_used_again_is_changed_again() {
    let post = post();
    let keys = format!("\"work\":54,\"coolant\":\"flood\",{TURNS}");
    let below = r#"{"rapid":[1,1,10]},{"line":[1,1,-1]},{"line":[2,2,-1]}"#;
    let away = r#"{"rapid":[80,80,10]},{"line":[80,80,-1]},{"rapid":[80,80,10]}"#;
    for last in [operation(1, TURNS, away), operation(1, &format!("\"work\":55,{TURNS}"), away)] {
        let text = job(&[operation(1, &keys, below), operation(2, TURNS, CUT), last]);
        let mut part = Job::json(&text);
        part.reading.select.only = vec![1];
        let part = post.render(part, &Options::default()).unwrap().text().to_owned();
        let whole = print(&post, &text, None).unwrap();
        // without block numbers and the staging of the next tool
        let last_change = |program: &str| {
            let after = program.rsplit_once(" M6\n").unwrap().1;
            let blocks = after.lines().map(|line| line.split_once(' ').map_or(line, |(_, words)| words));
            blocks.map(str::to_owned).collect::<Vec<_>>()
        };
        assert_eq!(last_change(&part), last_change(&whole), "{part}");
        assert_eq!(part.matches("T1 M6").count(), 2, "{part}");
        let between = part.split_once("X2. Y2.").unwrap().1.split_once("T1 M6").unwrap().0;
        assert!(between.contains("G53 Z0") || between.contains("G28"), "the tool is retracted: {part}");
    }
    // the proof finds a program that goes to the last operation without the retract
    let folder = Folder::new("part-without-retract");
    let last = operation(1, TURNS, away);
    folder.write("job.json", job(&[operation(1, &keys, below), operation(2, TURNS, CUT), last.clone()]));
    folder.write("form.pf", form());
    folder.write("direct.nc", print(&post, &job(&[operation(1, &keys, below), last]), None).unwrap());
    let verified = folder.run(&["verify", "job.json", "--form", "form.pf", "--only", "1", "--nc", "direct.nc"]);
    assert_eq!(verified.status.code(), Some(1), "{}", out(&verified));
    assert!(err(&verified).contains("PV009") && err(&verified).contains("a rapid goes from Z-1 to X80 Y80 Z10"));
    // the change stops the spindle, so a speed is missing, as in the whole job
    let text = job(&[operation(1, &keys, CUT), operation(2, TURNS, CUT), operation(1, "\"feed\":100,", CUT)]);
    let mut part = Job::json(&text);
    part.reading.select.only = vec![1];
    let message = post.render(part, &Options::default()).unwrap_err().to_string();
    assert!(message.contains("[speed] has no value here"), "{message}");
    assert!(print(&post, &text, None).unwrap_err().contains("[speed] has no value here"));
}

/// A speed without a mode is in revolutions per minute, also if an operation with surface speed is left out.
#[test]
fn a_part_of_a_lathe_job_has_the_speed_mode_of_the_whole_program() {
    let text = std::fs::read_to_string(root().join("postforms/haas-lathe.pf")).unwrap();
    let post = Post::compile(Source::from_text("haas-lathe.pf", text), &NoFiles).unwrap();
    let turn = r#""feed":0.2,"feed_mode":"per_rev","path":[{"rapid":[2,30]},{"line":[-20,30]},{"rapid":[2,32]}]"#;
    for (spindle, expected) in [
        (r#""spindle":{"speed":800},"#, "G97 S800 M3"),
        (r#""spindle":{"speed":800,"direction":"ccw"},"#, "G97 S800 M4"),
        (r#""spindle":{"direction":"ccw"},"#, "G96 S200 M4"),
        ("", "G96 S200 M3"),
    ] {
        let text = format!(
            r#"{{"postform":1,"program":1,"units":"mm","machine":"lathe","tools":[{{"number":1,"length_offset":1}}],"operations":[
            {{"tool":1,"work":54,"spindle":{{"speed":200,"direction":"cw","mode":"css","max":2000}},{turn}}},{{"tool":1,{spindle}{turn}}}]}}"#
        );
        let part = print(&post, &text, Some(2)).unwrap();
        assert!(part.contains(expected), "{spindle}: {part}");
    }
}

/// The cuts of each operation with the state in which they are made, from the simulator. The feed of a cut is the number of
/// its operation.
fn cuts(folder: &Folder, program: &str, feed: u64) -> Vec<String> {
    folder.write("program.nc", program);
    let simulated = folder.run(&["simulate", "program.nc", "--control", "haas"]);
    assert!(simulated.status.success(), "{}", err(&simulated));
    let own = format!("F{feed}");
    let [mut tool, mut work, mut spindle, mut coolant] = [const { String::new() }; 4];
    let mut found = Vec::new();
    for line in out(&simulated).lines() {
        let words: Vec<&str> = line.split_whitespace().skip(1).collect();
        let rest = words.get(1..).unwrap_or_default().join(" ");
        match words.first().copied() {
            Some("tool") => tool = rest,
            Some("work") => work = rest,
            Some("spindle") => spindle = rest,
            Some("coolant") => coolant = rest,
            Some("feed") if words.last() == Some(&own.as_str()) => {
                // the simulator shows no angle until the first turn
                let rest = if rest.contains(" A") { rest } else { rest.replace(" F", " A0 F") };
                found.push(format!("T{tool} G{work} {spindle} {coolant}: {rest}"));
            }
            _ => {}
        }
    }
    found
}

/// An operation whose feed is its number, counted from 101.
fn random_operation() -> impl Strategy<Value = (u32, String, String)> {
    let spindle = prop::sample::select(vec![
        "",
        r#""spindle":{"speed":500},"#,
        r#""spindle":{"speed":900,"direction":"cw"},"#,
        r#""spindle":{"speed":800,"direction":"ccw"},"#,
    ]);
    let coolant =
        prop::sample::select(vec!["", r#""coolant":"flood","#, r#""coolant":"mist","#, r#""coolant":"off","#]);
    let work = prop::sample::select(vec!["", "\"work\":54,", "\"work\":55,"]);
    let first = prop::sample::select(vec![
        r#"{"rapid":[X,Y,20]}"#,
        r#"{"rapid":[X,Y,20,90]}"#,
        r#"{"rapid":[X,Y,20,0]}"#,
        r#"{"rapid":[null,null,20]},{"rapid":[X,Y]}"#,
        r#"{"rapid":[X]},{"rapid":[null,Y,20]}"#,
        r#"{"rapid":[X,null,20]}"#,
        r#"{"home":true},{"rapid":[X,Y,20]}"#,
        r#"{"call":{"sub":8}},{"rapid":[X,Y,20]}"#,
        r#"{"call":{"sub":7,"at":[3,3,20]}},{"rapid":[X,Y,20]}"#,
    ]);
    let end = prop::sample::select(vec![
        "",
        "",
        r#",{"home":true}"#,
        r#",{"work":56}"#,
        r#",{"call":{"sub":7}}"#,
        r#",{"call":{"sub":8}}"#,
        r#",{"call":{"sub":9}}"#,
        r#",{"spindle":{"speed":333}}"#,
        r#",{"coolant":"off"}"#,
        r#",{"rapid":[1,1,20,45]}"#,
    ]);
    (1..=2u32, spindle, coolant, work, first, end, 1..30i32, 1..30i32).prop_map(
        |(tool, spindle, coolant, work, first, end, x, y)| {
            let first = first.replace('X', &x.to_string()).replace('Y', &y.to_string());
            let keys = format!("{spindle}{coolant}{work}");
            (
                tool,
                keys,
                format!(r#"{first},{{"line":[{x},{y},-1]}},{{"line":[{y},{x},-2]}},{{"rapid":[{y},{x},20]}}{end}"#),
            )
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    /// If a part is printed, its cuts and their state are those of the whole program. A part is refused if the whole
    /// program is refused because of this operation.
    #[test]
    fn the_parts_of_a_job_make_the_cuts_of_the_whole_job(operations in prop::collection::vec(random_operation(), 2..5)) {
        let folder = Folder::new("parts-random");
        let post = post();
        let first = r#""work":54,"spindle":{"speed":1500,"direction":"cw"},"coolant":"flood","#;
        let text = |count: usize| {
            let begins = operation(1, &format!("{first}\"feed\":101,"), AT_90);
            let others = (102..).zip(&operations).map(|(feed, (tool, keys, path))| operation(*tool, &format!("{keys}\"feed\":{feed},"), path));
            job(&std::iter::once(begins).chain(others).take(count).collect::<Vec<_>>())
        };
        for number in 2..=operations.len() + 1 {
            // the job up to this operation
            let text = text(number);
            let Ok(whole) = print(&post, &text, None) else { break };
            let Ok(part) = print(&post, &text, Some(number as u64)) else { continue };
            let feed = 100 + number as u64;
            prop_assert_eq!(cuts(&folder, &part, feed), cuts(&folder, &whole, feed), "{}\n{}\n{}", text, part, whole);
        }
    }
}
