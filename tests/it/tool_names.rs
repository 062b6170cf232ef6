//! Programs that call tools by their names: which tool of the job, of the machine or of another program is meant.

use std::io::Cursor;

use crate::support::folder::{Folder, err, out};
use crate::support::{control, root};
use postform::internals::machine;
use postform::internals::nc::RunSettings;
use postform::internals::preflight::{Known, preflight};
use postform::internals::verify::{Verdict, compare_motions};
use postform::toolpath::Units;
use postform::{Job, NoFiles, Options, Post, Source};

const PROGRAM: &str = "G17 G40 G710 G90\nT=\"DRILL_8\"\nM6\nG54 D1 S1200 M3\nG0 X10 Y0\nZ20 M8\nG1 Z-1 F400\nG0 Z20\n\
    G0 SUPA Z0 D0\nT1\nM6\nG54 D1 S3000 M3\nG0 X10 Y10\nZ5 M8\nG1 Z-2 F200\nG0 Z5\nM30\n";

/// The machine's tool table contains the name. The named tool must not be taken for T1, which the program also loads.
#[test]
fn a_machine_finds_a_tool_by_its_name() {
    let fits = |name: &str| {
        let file = format!(
            "control = \"siemens\"\n[axes.X]\ntravel = [-500, 500]\n[axes.Y]\ntravel = [-500, 500]\n[axes.Z]\ntravel = [-500, 0]\n\
             [offsets]\nG54 = [0, 0, -240]\n[tools.1]\nlength = 50\n[tools.7]\nlength = 230\nname = \"{name}\"\n"
        );
        let machine = machine::read("m.toml", &file, &|_| Err(String::new())).unwrap_or_else(|wrong| panic!("{wrong}"));
        let fitted =
            preflight(Cursor::new(PROGRAM), RunSettings::new(control("siemens")), &machine, &Known::default()).unwrap();
        fitted.findings.iter().map(|found| format!("{} {}", found.code.name(), found.message)).collect::<Vec<_>>()
    };
    // tool 7 is too long for Z20, tool 1 is not
    let found = fits("drill_8");
    assert!(found.len() == 1 && found[0].starts_with("PM001 T7 needs Z10 in machine coordinates"), "{found:#?}");
    let found = fits("DRILL_9");
    assert_eq!(found, ["PM011 the machine's table has no tool \"DRILL_8\""]);
}

const FORM: &str = "Name S\nControl siemens\nMachine Mill\nUnits mm\nX->4.>3\nY->4.>3\nZ->4.>3\nInch/MM 700 710\nSequence#s None\n\
    StartCode\nG17 G[unitmode] G40 G90 G94\nEnd\n1stToolChange\n`T=\"`[toolname]`\"`\nM6\nG[work] D1 S[speed] M[direct]\nG0 X[h] Y[v]\nZ[d] M[cool]\nEnd\n\
    ToolChange\nM[coolantoff]\nG0 SUPA D0 Z0\nM5\n`T=\"`[toolname]`\"`\nM6\nG[work] D1 S[speed] M[direct]\nG0 X[h] Y[v]\nZ[d] M[cool]\nEnd\n\
    EndCode\nM[coolantoff]\nG0 SUPA D0 Z0\nM5\nM30\nEnd\n";

/// Numbers in another order than the calls, and a name that is printed with another character.
const JOB: &str = r#"{"postform":1,"units":"mm","tools":[{"number":7,"name":"DRILL;8"},{"number":1,"name":"Mill 10"},{"number":3}],"operations":[
    {"tool":7,"work":54,"spindle":{"speed":1200,"direction":"cw"},"coolant":"flood","feed":400,"path":[{"rapid":[10,0,20]},{"line":[10,0,-1]},{"rapid":[10,0,20]}]},
    {"tool":1,"work":54,"spindle":{"speed":3000,"direction":"cw"},"coolant":"flood","feed":200,"path":[{"rapid":[10,10,5]},{"line":[10,10,-2]},{"rapid":[10,10,5]}]}]}"#;

#[test]
fn a_proof_compares_the_names_of_tools() {
    let verdict = |form: &str, job: &str, change: [&str; 2]| {
        let post = Post::compile(Source::from_text("s.pf", form.to_owned()), &NoFiles).unwrap();
        let printed = post.render(Job::json(job), &Options::default()).unwrap_or_else(|error| panic!("{error}"));
        assert!(printed.verdict().is_proven(), "{:#?}\n{}", printed.verdict(), printed.text());
        let text = printed.text();
        let changed = text.replacen(change[0], change[1], 1);
        assert!(change[0].is_empty() || text != changed, "{text}");
        post.verify(Job::json(job), &changed).unwrap()
    };
    assert!(verdict(FORM, JOB, ["", ""]).is_proven());
    let wrong = |change: [&str; 2], message: &str| match verdict(FORM, JOB, change) {
        Verdict::Different(found) => assert!(found[0].message.contains(message), "{change:?}: {found:#?}"),
        other => panic!("{change:?}: {other:#?}"),
    };
    wrong(["Mill 10", "DRILL_8"], "tool 7 cuts, but the job has tool 1 here");
    // the job has not named tool 1 yet
    wrong(["DRILL_8", "Mill 10"], "before this cut tool \"Mill 10\" is loaded");
    wrong(["DRILL_8", "DRILL_9"], "before this cut tool \"DRILL_9\" is loaded");
    // a form may shorten the names
    let short = FORM.replace("[toolname]", "[toolname:5]");
    assert!(verdict(&short, JOB, ["", ""]).is_proven());
    match verdict(&short, JOB, ["DRILL", "DRIL"]) {
        Verdict::Different(found) => assert!(found[0].message.contains("tool \"DRIL\" is loaded"), "{found:#?}"),
        other => panic!("{other:#?}"),
    }
}

/// A job needs tool numbers. For a program with tool names, an option gives the numbers. Without the option, the
/// program is refused.
#[test]
fn a_program_with_names_is_a_job_with_numbers() {
    let folder = Folder::new("tool-names");
    folder.write("p.mpf", PROGRAM);
    let form = root().join("postforms/linuxcnc.pf");
    let form = form.to_str().unwrap();
    let job = folder.0.join("p.mpf");
    let job = job.to_str().unwrap();
    let refused = folder.run(&["render", job, "--form", form, "--program", "7"]);
    let said = err(&refused);
    assert_eq!(refused.status.code(), Some(1), "{said}");
    assert!(said.contains("PL009") && said.contains("--assume-tool 'DRILL_8=2'"), "{said}");
    let printed = folder.run(&["render", job, "--form", form, "--program", "7", "--assume-tool", "drill_8=9"]);
    let text = out(&printed);
    assert!(text.contains("T9 M6") && text.contains("G43 H9") && text.contains("T1 M6"), "{text}\n{}", err(&printed));
    // `simulate` prints the name, and a tool number that is too large is refused
    let text = out(&folder.run(&["simulate", job]));
    assert!(text.contains("tool    DRILL_8\n") && text.contains("tool    1\n"), "{text}");
    let json = out(&folder.run(&["simulate", job, "--format", "json"]));
    assert!(json.contains("\"tool\":\"DRILL_8\"}") && json.contains("\"tool\":1}"), "{json}");
    folder.write("big.nc", "G21 G90\nT1000000000 M6\nM30\n");
    let said = err(&folder.run(&["simulate", folder.0.join("big.nc").to_str().unwrap()]));
    assert!(said.contains("PN018") && said.contains("T1000000000 is not a tool number"), "{said}");
}

/// Two programs call the same tools if the tool names are equal. Upper and lower case count as equal.
#[test]
fn two_programs_are_compared_by_their_names() {
    let compare = |old: &str, new: &str| {
        let [old, new] = [old, new].map(|text| (Cursor::new(text.to_owned()), RunSettings::new(control("siemens"))));
        compare_motions([old, new], Units::Mm, 1e-6).unwrap().difference.map(|found| found.message)
    };
    assert_eq!(compare(PROGRAM, &PROGRAM.replace("DRILL", "drill")), None);
    let other = compare(PROGRAM, &PROGRAM.replace("DRILL_8", "MILL_9"));
    assert_eq!(other.as_deref(), Some("the tool is \"MILL_9\", but \"DRILL_8\" in the old program"));
}
