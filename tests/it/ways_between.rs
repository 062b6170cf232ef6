//! Rapids between cuts and after the last cut must not be lower than in the job, and must be in the same work offset as
//! in the job. Earlier versions reported the program of each case as identical or equivalent.

use std::fs;

use postform::{Job, NoFiles, Options, Post, Source, Verdict};

use crate::support::root;

/// A cut in G54, rapids in G55 without a cut, and a cut in G54 again.
const VISIT: &str = r#"{"postform":1,"program":1,"units":"mm","tools":[{"number":1}],"operations":[
{"tool":1,"work":54,"spindle":{"speed":1000,"direction":"cw"},"feed":100,"path":[
{"rapid":[0,0,50]},{"rapid":[null,null,2]},{"line":[null,null,-1]},{"line":[10,0,-1]},{"rapid":[null,null,50]},
{"work":55},{"rapid":[0,0,50]},{"rapid":[null,null,2]},{"rapid":[null,null,50]},{"rapid":[100,100,50]},
{"work":54},{"rapid":[0,0,50]},{"rapid":[null,null,2]},{"line":[null,null,-1]},{"line":[10,0,-1]},{"rapid":[null,null,50]}]}]}"#;

/// A cut that ends with a rapid straight up to Z2.
const END: &str = r#"{"postform":1,"program":1,"units":"mm","tools":[{"number":1}],"operations":[
{"tool":1,"work":54,"spindle":{"speed":1000,"direction":"cw"},"feed":100,"path":[
{"rapid":[0,0,50]},{"rapid":[null,null,2]},{"line":[null,null,-1]},{"line":[10,0,-1]},{"rapid":[null,null,2]}]}]}"#;

/// A second tool begins in another work offset.
const TOOL: &str = r#"{"postform":1,"program":1,"units":"mm","tools":[{"number":1},{"number":2}],"operations":[
{"tool":1,"work":54,"spindle":{"speed":1000,"direction":"cw"},"feed":100,"path":[
{"rapid":[0,0,50]},{"rapid":[null,null,2]},{"line":[null,null,-1]},{"line":[10,0,-1]},{"rapid":[null,null,50]}]},
{"tool":2,"work":55,"spindle":{"speed":1950,"direction":"cw"},"path":[
{"rapid":[40,60,3]},{"cycle":{"kind":"face","clear":3,"depth":16,"feed":700,"points":[[40,60,0]]}}]}]}"#;

fn haas() -> Post {
    let form = fs::read_to_string(root().join("postforms/haas.pf")).unwrap();
    Post::compile(Source::from_text("haas.pf", form), &NoFiles).unwrap()
}

/// The program of a job, without block numbers and header.
fn printed(post: &Post, job: &str) -> String {
    let mut options = Options::default();
    options.properties.push(("header".into(), "off".into()));
    let program = post.render(Job::json(job), &options).unwrap().into_text();
    let bare = |line: &str| match line.split_once(' ') {
        Some((number, rest)) if number.starts_with('N') => rest.to_owned(),
        _ => line.to_owned(),
    };
    program.lines().map(bare).collect::<Vec<_>>().join("\n") + "\n"
}

fn is_wrong(job: &str, from: &str, to: &str, code: &str) {
    let post = haas();
    let right = printed(&post, job);
    assert!(matches!(post.verify(Job::json(job), &right).unwrap(), Verdict::Identical), "{right}");
    assert_eq!(right.matches(from).count(), 1, "{from}\n{right}");
    let wrong = right.replace(from, to);
    match post.verify(Job::json(job), &wrong).unwrap() {
        Verdict::Different(findings) => {
            assert!(findings.iter().any(|finding| finding.code.name() == code), "{findings:?}\n{wrong}");
        }
        other => panic!("{other}\n{wrong}"),
    }
}

#[test]
fn a_visit_without_a_cut_crosses_no_lower_than_the_job() {
    let visit = "Z50.\nZ2.\nZ50.\nX100. Y100.\n";
    is_wrong(VISIT, visit, "Z50.\nZ2.\nX100. Y100.\nZ50.\n", "PV009");
    // down where the job stays up
    is_wrong(VISIT, visit, "Z50.\nX100. Y100.\nZ2.\nX0 Y0\n", "PV009");
}

#[test]
fn the_machines_own_positions_are_gone_to_from_above_the_last_height() {
    // G53 Y0 is still in the program, now at Z2
    is_wrong(END, "M9\nG0 G53 Z0 M5\n", "M9\nM5\n", "PV009");
    is_wrong(END, "M9\nG0 G53 Z0 M5\n", "M9\nZ1. M5\n", "PV009");
}

#[test]
fn a_new_tool_goes_down_in_the_offset_of_its_cut() {
    let right = "G0 G90 G55 X40. Y60.\nS1950 M3\nG43 H2 Z3. M9\n";
    is_wrong(TOOL, right, "G0 G90 X40. Y60.\nS1950 M3\nG55 G43 H2 Z3. M9\n", "PV012");
}

/// The message shows the height at which the rapid is too low. This may be the height at the start of the rapid.
#[test]
fn a_rapid_that_begins_too_low_is_shown_with_that_height() {
    let post = haas();
    let right = printed(&post, END);
    assert_eq!(right.matches("X0 Y0\n").count(), 1, "{right}");
    let low = |program: String| match post.verify(Job::json(END), &program).unwrap() {
        Verdict::Different(findings) => findings.iter().map(|finding| finding.message.clone()).collect::<Vec<_>>(),
        other => panic!("{other}\n{program}"),
    };
    let found = low(right.replace("Z50. M9\n", "Z3. M9\nX0.5 Z50.\nX0\n"));
    assert!(
        found.iter().any(|message| message.contains("goes from Z3 to X0.5 Y0 Z50, which is below")),
        "{found:?}\n{right}"
    );
}

/// A height in machine coordinates is not compared with a height of the job.
#[test]
fn a_rapid_to_a_machine_height_is_shown_from_where_it_begins() {
    let job = r#"{"postform":1,"program":1,"units":"mm","tools":[{"number":1}],"operations":[
{"tool":1,"work":54,"spindle":{"speed":900,"direction":"cw"},"feed":300,"path":[
{"rapid":[0,0,50]},{"rapid":[0,0,5]},{"line":[0,0,-5]},{"rapid":[0,0,50]},{"rapid":[40,0,50]},{"line":[40,0,-5]},{"rapid":[40,0,50]}]}]}"#;
    let post = haas();
    let right = printed(&post, job);
    let wrong = right.replacen("G0 Z50.\nX40.\n", "G0 Z40.\nG53 G0 Z0 X40.\nG0 Z50.\nX40.\n", 1);
    assert_ne!(wrong, right);
    let Verdict::Different(findings) = post.verify(Job::json(job), &wrong).unwrap() else { panic!("{wrong}") };
    let found: Vec<&str> = findings.iter().map(|finding| &finding.message[..]).collect();
    assert!(found.iter().any(|message| message.contains("goes from Z40 to ") && !message.contains("Z0")), "{found:?}");
}

/// Two fixtures: the tool is at Z50 when the work offset changes. `STOP` is a stop or a move home before the change.
const FIXTURES: &str = r#"{"postform":1,"program":1,"units":"mm","tools":[{"number":1}],"operations":[
{"tool":1,"work":54,"spindle":{"speed":1000,"direction":"cw"},"feed":100,"path":[
{"rapid":[0,0,50]},{"rapid":[0,0,5]},{"line":[0,0,-3]},{"rapid":[0,0,5]},{"rapid":[0,0,50]}STOP,
{"work":55},{"rapid":[0,0,50]},{"rapid":[0,0,5]},{"line":[0,0,-3]},{"rapid":[0,0,50]}]}]}"#;

/// A program of [`FIXTURES`] in which these blocks are between the two cuts.
fn fixtures(between: &str) -> String {
    format!(
        "%\nO1\nG21 G17 G40 G49 G80 G90\nT1 M6\nG54 G0 X0 Y0 S1000 M3\nG43 H1 Z50.\nZ5.\nG1 Z-3. F100.\n{between}\n\
         G1 Z-3.\nG0 Z50.\nG91 G28 Z0 M5\nG28 X0 Y0\nG90\nM30\n%\n"
    )
}

/// The codes of the differences; empty if the program is proven.
fn codes(job: &str, between: &str) -> Vec<&'static str> {
    match haas().verify(Job::json(job), fixtures(between)).unwrap() {
        Verdict::Different(findings) => findings.iter().map(|finding| finding.code.name()).collect(),
        Verdict::Identical | Verdict::Equivalent(_) => Vec::new(),
        other => panic!("{other}\n{between}"),
    }
}

/// After a change of the work offset the number of the height is unknown, but the tool is still at the height that it
/// had before. X and Y are unknown, too.
#[test]
fn the_tool_stays_where_it_is_when_the_work_offset_changes() {
    let stop = FIXTURES.replace("STOP", r#",{"stop":"program"}"#);
    let home = FIXTURES.replace("STOP", r#",{"home":true}"#);
    let home_and_stop = FIXTURES.replace("STOP", r#",{"home":true},{"stop":"program"}"#);
    let plain = FIXTURES.replace("STOP", "");
    let depth = plain.replace(r#"{"rapid":[0,0,5]},{"rapid":[0,0,50]},"#, "");
    let feed = plain.replace(r#"{"rapid":[0,0,5]},{"rapid":[0,0,50]},"#, r#"{"line":[0,0,50]},"#);
    let cases: [(&str, &str, &[&str]); 24] = [
        (&plain, "G0 Z50.\nG55 X0 Y0\nZ50.\nZ5.", &[]),
        (&plain, "G0 Z60.\nG55 X0 Y0 Z50.\nZ5.", &[]),
        (&plain, "G0 G53 Z0\nG55 X0 Y0\nG43 H1 Z5.", &[]),
        (&plain, "G55 G0 X0 Y0\nZ5.", &["PV009"]),
        (&plain, "G55 G0 X0 Y0\nZ50.\nZ5.", &["PV009"]),
        (&plain, "G55 G0 X0 Y0 Z5.", &["PV009"]),
        (&plain, "G0 Z5.\nG55 X0 Y0\nZ50.\nZ5.", &["PV009"]),
        (&plain, "G56\nG55\nG0 X0 Y0\nZ5.", &["PV009"]),
        // a plunge at the X and Y of the offset before
        (&plain, "G0 Z50.\nG55", &["PV001"]),
        (&plain, "G0 Z50.\nG55 Z5.", &["PV001"]),
        // the job changes the offset at the depth of the cut, and goes up to its next position
        (&depth, "G0 Z50.\nG55 X0 Y0\nZ50.\nZ5.", &[]),
        (&depth, "G55 G0 X0 Y0 Z50.\nZ5.", &[]),
        (&depth, "G55 G0 X0 Y0\nZ50.\nZ5.", &["PV009"]),
        // the last cut is the retract
        (&feed, "G1 Z50.\nG55 G0 X0 Y0\nZ50.\nZ5.", &[]),
        (&stop, "G0 Z50.\nM0\nS1000 M3\nG55 G0 X0 Y0\nZ50.\nZ5.", &[]),
        (&stop, "G0 Z50.\nG55\nM0\nS1000 M3\nG0 X0 Y0\nZ50.\nZ5.", &[]),
        (&stop, "G55\nM0\nS1000 M3\nG0 Z50.\nX0 Y0\nZ5.", &["PV019"]),
        (&plain, "G55\nM0\nS1000 M3\nG0 Z50.\nX0 Y0\nZ5.", &["PV019"]),
        (&home, "G0 Z50.\nG91 G28 Z0\nG90\nG55 G0 X0 Y0\nG43 H1 Z50.\nZ5.", &[]),
        (&home, "G0 Z50.\nG55 X0 Y0\nZ5.", &["PV001"]),
        (&home, "G55 G0 X0 Y0\nG91 G28 Z0\nG90\nG43 H1 Z5.", &["PV009"]),
        (&home_and_stop, "G0 Z50.\nG91 G28 Z0\nG90\nM0\nS1000 M3\nG55 G0 X0 Y0\nG43 H1 Z50.\nZ5.", &[]),
        (&home_and_stop, "G0 Z50.\nG55 X0 Y0\nM0\nS1000 M3\nG43 H1 Z50.\nZ5.", &["PV019", "PV001"]),
        (&home_and_stop, "G0 Z50.\nG55 X0 Y0\nM0\nS1000 M3\nG91 G28 Z0\nG90\nG43 H1 Z5.", &["PV019"]),
    ];
    let wrong: Vec<_> = cases.iter().filter(|(job, between, wanted)| codes(job, between) != *wanted).collect();
    let is: Vec<_> = wrong.iter().map(|(job, between, wanted)| (between, wanted, codes(job, between))).collect();
    assert!(is.is_empty(), "{is:#?}");
}

/// A groove of a lathe: the first rapids after the tool change go along one axis each.
const GROOVE: &str = r#"{"postform":1,"program":1,"units":"mm","machine":"lathe","tools":[{"number":1}],"operations":[
{"tool":1,"work":54,"spindle":{"speed":1000,"direction":"cw"},"feed":0.1,"path":[
ENTER,{"line":[-40,30]},{"rapid":[-40,50]},{"rapid":[50,50]}LEAVE]}]}"#;

/// On a lathe, the axis that the job moves first after the tool change or after a move home must move first.
#[test]
fn the_axes_of_a_lathe_move_from_home_in_the_order_of_the_job() {
    let post = Post::compile(
        Source::from_text("haas-lathe.pf", fs::read_to_string(root().join("postforms/haas-lathe.pf")).unwrap()),
        &NoFiles,
    )
    .unwrap();
    let verdict = |enter: &str, leave: &str, from: &str, to: &str| {
        let job = GROOVE.replace("ENTER", enter).replace("LEAVE", leave);
        let right = printed(&post, &job);
        assert_eq!(right.matches(from).count(), 1, "{from}\n{right}");
        post.verify(Job::json(&job), right.replacen(from, to, 1)).unwrap()
    };
    let (z_first, x_first) = ("Z-40.\nX82.\n", "X82.\nZ-40.\n");
    let (job_z, job_x) = (r#"{"rapid":[-40]},{"rapid":[null,41]}"#, r#"{"rapid":[null,41]},{"rapid":[-40]}"#);
    let again = |way: &str| format!(r#",{{"home":true}},{way},{{"line":[-40,31]}},{{"rapid":[-40,50]}}"#);
    let [again_z, again_x] = [job_z, job_x].map(again);
    let both = r#"{"rapid":[-40,41]}"#;
    for (enter, leave, from, to, message) in [
        (job_z, "", z_first, z_first, None),
        (job_z, "", z_first, "Z-40. X82.\n", Some("a rapid goes to X41 Z-40, but the job's rapid goes to Z-40")),
        (job_z, "", z_first, x_first, Some("a rapid goes to X41, but the job's rapid goes to Z-40")),
        (job_x, "", x_first, x_first, None),
        (job_x, "", x_first, z_first, Some("a rapid goes to Z-40, but the job's rapid goes to X41")),
        (both, "", "Z-40. X82.\n", z_first, None),
        (both, "", "Z-40. X82.\n", x_first, None),
        (both, &again_z, z_first, x_first, Some("a rapid goes to X41, but the job's rapid goes to Z-40")),
        (both, &again_x, x_first, z_first, Some("a rapid goes to Z-40, but the job's rapid goes to X41")),
    ] {
        let found = match verdict(enter, leave, from, to) {
            Verdict::Different(findings) => Some(format!("{} {}", findings[0].code.name(), findings[0].message)),
            _ => None,
        };
        assert_eq!(found, message.map(|message| format!("PV001 {message}")), "{enter} {leave}: {to}");
    }
}

/// A tool in a slot at Z-2: a rapid in the slot before the stop, and the rapid AFTER after it.
const SLOT: &str = r#"{"postform":1,"program":1,"units":"mm","tools":[{"number":1},{"number":2}],"operations":[
{"tool":1,"work":54,"spindle":{"speed":2000,"direction":"cw"},"feed":100,"path":[
{"rapid":[10,0,20]},{"line":[10,0,-2]},{"line":[50,0,-2]}BEFORE,{"rapid":[10,0]},{"stop":"program"},{"rapid":[10,20]}AFTER]}"#;

/// A form that goes to a machine position in X and Y at a stop. From and to this position, no rapid may be at the depth of
/// the last cut, except a rapid of the job.
#[test]
fn a_machine_position_is_left_and_reached_above_the_last_cut() {
    let form = fs::read_to_string(root().join("postforms/haas.pf")).unwrap();
    let cut = r#",{"line":[10,30]}]}"#;
    let tool = r#"]},{"tool":2,"work":54,"spindle":{"speed":2000,"direction":"cw"},"feed":100,"path":[{"rapid":[0,0,20]},{"line":[0,0,-1]},{"rapid":[0,0,20]}]}"#;
    let up = r#",{"rapid":[null,null,5]}"#;
    for (stop, before, found) in [
        ("M0", "", None),
        (
            "G0 G53 Z0\nG53 X0 Y0\nM0",
            "",
            Some([
                "PV009: a rapid goes down to X10 Y20 Z-2, but the job goes down at another X or Y here",
                "PV009: after the last cut a rapid goes to X10 Y20 Z-2, not above Z-2",
            ]),
        ),
        ("G0 G53 Z0\nG53 X0 Y0\nM0", up, None),
        (
            "G0 G53 X0 Y0\nM0",
            "",
            Some([
                "PV009: a rapid goes to a machine position in X or Y at Z-2, but the job stays over the part here",
                "PV009: after the last cut a rapid goes to X0 Y0 Z-2, not above Z-2",
            ]),
        ),
        ("G0 G53 X0 Y0\nM0", up, None),
    ] {
        let form = format!("{form}\nStop\n{stop}\nEnd\n");
        let post = Post::compile(Source::from_text("haas.pf", form), &NoFiles).unwrap();
        for (index, after) in [cut, tool].into_iter().enumerate() {
            let job = SLOT.replace("BEFORE", before).replace("AFTER", after);
            // a program that differs from its job is not printed
            let refused = post.render(Job::json(&job), &Options::default()).err().map(|error| error.to_string());
            match found.map(|found| found[index]) {
                None => assert_eq!(refused, None, "{stop} {before} {after}"),
                Some(found) => assert!(refused.as_ref().is_some_and(|text| text.contains(found)), "{refused:?} {stop}"),
            }
        }
    }
}

/// Several rapids give the first position of a tool, and a height comes before X or Y. The tool change goes to the combined
/// position. A program that goes down at another position, or lower, is still found.
#[test]
fn the_first_position_of_a_tool_may_come_in_parts() {
    let post = haas();
    for (path, blocks, wrong) in [
        ("[20,null,5] [5] [5,5,20]", "X20. Y5.\nS1000 M3\nG43 H1 Z5. M9\nG0 X5.\nZ20.\n", "X5.\n=>X5. Z4.\n"),
        (
            "[null,null,20] [null,10] [null,null,2] [20,20]",
            "X20. Y10.\nS1000 M3\nG43 H1 Z20. M9\nG0 Z2.\nY20.\n",
            "Z2.\n=>Y15.\nZ2.\n",
        ),
        ("[null,null,2] [null,20,2] [5,0,20]", "X5. Y20.\nS1000 M3\nG43 H1 Z2. M9\nG0 Y0 Z20.\n", "Z2.=>Z1."),
        // the second rapid replaces the first one, but X stays that of the first one
        ("[10,0] [null,10,2]", "X10. Y10.\nS1000 M3\nG43 H1 Z2. M9\n", "Z2.=>Z1.\nZ2."),
    ] {
        let rapids: Vec<String> = path.split(' ').map(|to| format!(r#"{{"rapid":{to}}}"#)).collect();
        let end = r#"{"line":[9,9,-1]},{"rapid":[9,9,20]}"#;
        let job = format!(
            r#"{{"postform":1,"program":1,"units":"mm","tools":[{{"number":1}}],"operations":[{{"tool":1,"work":54,"spindle":{{"speed":1000,"direction":"cw"}},"feed":100,"path":[{},{end}]}}]}}"#,
            rapids.join(",")
        );
        let program = printed(&post, &job);
        assert!(program.contains(blocks), "{path}: {program}");
        let (from, to) = wrong.split_once("=>").unwrap();
        let low = program.replace(blocks, &blocks.replacen(from, to, 1));
        assert_ne!(low, program);
        let verdict = post.verify(Job::json(&job), &low).unwrap();
        assert!(matches!(verdict, Verdict::Different(_)), "{path}: {verdict}\n{low}");
    }
}

/// A tool comes to its first cut at the depth of this cut. The tool change may be at any machine position, so the program
/// must be over the first position before it goes down. A cut that goes down begins at a clearance height, where a rapid may
/// move across.
#[test]
fn a_tool_comes_down_over_a_cut_that_begins_at_its_depth() {
    let post = haas();
    let right = "G0 G90 G54 X10. Y20.\nS1000 M3\nG43 H2 Z-2. M9\n";
    for (cut, found) in [
        (r#"{"line":[30,20,-2]}"#, Some("PV009 a rapid across goes to X10 Y20 Z-2, at the depth of the next cut")),
        (r#"{"line":[30,20,-3]}"#, None),
    ] {
        let job = format!(
            r#"{{"postform":1,"program":1,"units":"mm","tools":[{{"number":1}},{{"number":2}}],"operations":[
{{"tool":1,"work":54,"spindle":{{"speed":1000,"direction":"cw"}},"feed":100,"path":[{{"rapid":[0,0,20]}},{{"line":[0,0,-5]}},{{"rapid":[0,0,20]}}]}},
{{"tool":2,"work":54,"spindle":{{"speed":1000,"direction":"cw"}},"feed":100,"path":[{{"rapid":[10,20,-2]}},{cut},{{"rapid":[30,20,20]}}]}}]}}"#
        );
        let program = printed(&post, &job);
        assert!(program.contains(right), "{program}");
        for between in [
            "S1000 M3\nG0 G90 G53 X0 Y0\nG43 H2 Z50. M9\nX10. Y20. Z-2.\n",
            "S1000 M3\nG0 G90 G53 X0 Y0\nG43 H2 Z-2. M9\nX10. Y20.\n",
            "S1000 M3\nG0 G90 X0 Y0\nG43 H2 Z50. M9\nX10. Y20. Z-2.\n",
        ] {
            let slanted = program.replacen(right, between, 1);
            let message = match post.verify(Job::json(&job), &slanted).unwrap() {
                Verdict::Different(findings) => findings.first().map(|at| format!("{} {}", at.code.name(), at.message)),
                _ => None,
            };
            assert_eq!(message.as_deref(), found, "{between}");
        }
    }
}

/// A rapid straight down may give the angle of a rotary axis again, for example after a change of the work offset.
#[test]
fn an_angle_may_be_given_again_on_the_way_down_to_a_cut() {
    let form = fs::read_to_string(root().join("postforms/haas-4axis.pf")).unwrap();
    let post = Post::compile(Source::from_text("haas-4axis.pf", form), &NoFiles).unwrap();
    let job = r#"{"postform":1,"program":1,"units":"mm","tools":[{"number":1}],"operations":[
{"tool":1,"work":54,"spindle":{"speed":2200,"direction":"cw"},"feed":964,"path":[{"rapid":[0,0,20,-265]},{"work":56},{"rapid":[-60,50,30]},{"line":[-90,50,30]}]}]}"#;
    let program = printed(&post, job);
    let right = ["G56 A-265.\n", "Z30.\n"];
    assert!(right.iter().all(|block| program.contains(block)), "{program}");
    let later = program.replacen(right[0], "G56\n", 1).replacen(right[1], "Z30. A-265.\n", 1);
    let verdict = post.verify(Job::json(job), &later).unwrap();
    assert!(matches!(verdict, Verdict::Equivalent(_) | Verdict::Identical), "{verdict:?}");
}
