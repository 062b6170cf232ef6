//! Common mistakes, each with the correction in the message.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::support::{job, plain_post};

fn folder(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    _ = fs::remove_dir_all(&path);
    fs::create_dir_all(&path).unwrap();
    path
}

/// The message of a command, and its exit status.
fn said(folder: &Path, arguments: &[&str]) -> (Option<i32>, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_postform")).current_dir(folder).args(arguments).output().unwrap();
    let text = [output.stdout, output.stderr].concat();
    // messages are wrapped, with a bar before each line
    let text = String::from_utf8(text).unwrap().replace('│', " ");
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    (output.status.code(), text)
}

#[test]
fn slips_in_forms() {
    let haas = plain_post("haas.pf");
    let changed = |from: &str, to: &str| {
        assert!(haas.contains(from), "{from}");
        haas.replacen(from, to, 1)
    };
    let table = [
        (changed("X->4.>4", "X=->4.>4"), ["PF301", "`X->4.>4`"]),
        (
            changed("\nStartCode", "\nAsk fixture \"Fixture\" 2\n\nStartCode"),
            ["PF302", "`Property fixture number 0 ..`"],
        ),
        (changed("\nEndCode", "\nUpon [coolant]\nM[cool]\nEnd\n\nEndCode"), ["PF202", "the variable is called `cool`"]),
        (changed("X->4.>4", "X 1.4"), ["PF305", "`X->4.>4` has up to four digits before the point"]),
        (changed("End Cancel", "End; Cancel"), ["PF002", "write `End Cancel`"]),
        (changed("Control haas", "Control hurco"), ["PF302", "similar to `fanuc`"]),
        (changed("M6\n", "M6 ; change\n"), ["PF110", "begins with ` #`"]),
        (changed("Z[d] M[cool]\n", "Z[d] M cool\n"), ["PF112", "write `M[cool]`"]),
        (changed("Z[d] M[cool]\n", "Z[d] [frate*0.5]\n"), ["PF112", "write the letter before it"]),
        (changed("Z[d] M[cool]\n", "Z[d] M[cool]\nIF [#1 GT 2] GOTO 5\n"), ["PF001", "in backquotes"]),
        (changed("Z[d] M[cool]\n", "Z[d] M[cool]\n#500=1\n"), ["PF101", "`` `#500=1` ``"]),
        (changed("\nM30\n", "\nM30\nEND PGM part MM\n"), ["PF405", "in backquotes"]),
        (changed("Z[d] M[cool]\n", "Z[d] M[cool]\n@ if [tool] = 1\nM8\n@end\n"), ["PF707", "did you mean `@if`?"]),
        (changed("End Cancel\n", "\n"), ["PF002", "write `End Cancel`"]),
        (changed("\nEndCode", "\nOptionalStop\nM1\nEnd\n\nEndCode"), ["PF201", "did you mean `OptStop`?"]),
        (changed("MoreWork 7 G154 P1", "MoreWork G54.1 P1 48"), ["PF302", "example: `MoreWork 7 G54.1 P1`"]),
        (changed("MoreWork 7 G154 P1", "MoreWork 7 G54.1P1"), ["PF302", "example: `MoreWork 7 G54.1 P1`"]),
        (changed("MoreWork 7 G154 P1", "MoreWork 7 G54.1 P1 P48"), ["PF302", "without a letter, such as `48`"]),
        (changed("MoreWork 7 G154 P1", "MoreWork 7 G54.1 P9 8"), ["PF302", "must be 9 or more"]),
        (changed("CoolantKind through M88", "Coolant through M51"), ["PF302", "write `CoolantKind through M51 M89`"]),
        (changed("M[coolantoff]", "M[coolantoff"), ["PF001", "write `M[coolantoff]`"]),
        (changed("T[tool] M6", "T[tool] M6\nT[next tool]"), ["PF001", "write `T[nexttool]`"]),
        (
            changed("Control haas", "Control Fanuc 0i-MD"),
            ["there is no control `Fanuc 0i-MD`", "write `Control fanuc`"],
        ),
        (changed("Control haas", "Control fanuk"), ["PF302", "write `Control fanuc`"]),
        (changed("\nEndCode", "\nEndCut\nM5\nEnd\n\nEndCode"), ["PF010", "write `Machine Torch` or `Machine Laser`"]),
    ];
    let folder = folder("slips-forms");
    for (text, wanted) in table {
        fs::write(folder.join("form.pf"), &text).unwrap();
        let (status, said) = said(&folder, &["lint", "form.pf"]);
        assert_eq!(status, Some(1), "{wanted:?}: {said}");
        wanted.iter().for_each(|wanted| assert!(said.contains(wanted), "no {wanted} in {said}"));
    }
}

/// An unsafe fix puts statements in the control's own language into backquotes, and shows the program before and after.
#[test]
fn statements_of_the_control_are_put_in_backquotes() {
    let folder = folder("slips-statements");
    let lines = "M[cool]\n#500=1\nIF [#1 GT 2] GOTO 5\nWHILE [#1 LT 5] DO1\n";
    for units in ["both", "mm"] {
        let form = plain_post("haas.pf")
            .replacen("Z[d] M[cool]\n", &format!("Z[d] {lines}"), 1)
            .replace("Units both", &format!("Units {units}"));
        let form = if units == "mm" { form.replace("G[unitmode]", "G21") } else { form };
        fs::write(folder.join("form.pf"), form).unwrap();
        let (_, said) = said(&folder, &["lint", "--fix", "--unsafe-fixes", "form.pf"]);
        assert!(said.contains("3 unsafe fixes made") && said.contains("0 errors"), "{said}");
        let fixed = fs::read_to_string(folder.join("form.pf")).unwrap();
        assert!(fixed.contains("`#500=1`\n`IF [#1 GT 2] GOTO 5`\n`WHILE [#1 LT 5] DO1`\n"), "{fixed}");
    }
}

/// `None` in a sequence is reported if a block of the job is lost. A branch of MoveHome that prints nothing is an
/// error.
#[test]
fn sequences_that_lose_what_the_job_says() {
    let folder = folder("slips-none");
    let with = |sequence: &str| plain_post("linuxcnc.pf").replacen("\nEndCode", &format!("\n{sequence}\n\nEndCode"), 1);
    let table = [
        (with("OptStop\nNone\nEnd"), 0, "the job's optional stop is lost"),
        (with("WorkChange\nNone\nEnd"), 0, "postform prints the block itself"),
        (
            plain_post("linuxcnc.pf").replacen("MoveHome\n", "MoveHome\nNone\nEnd\n#", 1),
            0,
            "the job's move home is lost",
        ),
        (
            plain_post("linuxcnc.pf").replacen("MoveHome\n", "MoveHome\n@if [tool] = 9\n  G53 G0 Z0\n@end\nEnd\n#", 1),
            1,
            "a branch of MoveHome prints nothing",
        ),
    ];
    for (form, status, wanted) in table {
        fs::write(folder.join("form.pf"), form).unwrap();
        let found = said(&folder, &["lint", "--color", "never", "form.pf"]);
        assert!(found.1.contains(wanted), "no {wanted} in {found:?}");
        if status == 1 {
            assert_eq!(found.0, Some(1), "{found:?}");
        }
    }
}

#[test]
fn slips_in_jobs() {
    let good = job("{\"line\":[1,0,0]}");
    let table = [
        (good.replacen("\"units\":\"inch\",", "\"units\":\"inch\"\n", 1), "a comma is missing here"),
        (good.replacen("[1,0,0]", "[1,0,0],", 1), "take out the comma before this bracket"),
        (good.replace('"', "'"), "double quotes"),
        (format!("// a job\n{good}"), "JSON has no comments"),
        (good.replacen("\"inch\"", "\"metric\"", 1), "write \"mm\""),
        (good.replacen("\"cw\"", "\"CW\"", 1), "write \"cw\""),
        (good.replacen("\"work\":54", "\"work\":\"G54\"", 1), "write 54, without quotes"),
        (good.replacen("\"work\":54", "\"work\":\"G54.1 P1\"", 1), "7 in a form with `MoreWork 7 G54.1 P1`"),
        (good.replacen("\"work\":54", "\"work\":\"G154 P44\"", 1), "103 in a form with `MoreWork 7 G154 P1`"),
        (job("{\"arc\":\"cw\"}"), "`{\"to\": [10, 0], \"center\": [5, 0], \"direction\": \"cw\"}`"),
        (job("{\"cycle\":{\"kind\":\"peck\",\"depth\":1,\"points\":[[1,1,0]]}}"), "write \"deep\""),
        (job("{\"cycle\":{\"kind\":\"dril\",\"depth\":1,\"points\":[[1,1,0]]}}"), "did you mean `drill`?"),
    ];
    let folder = folder("slips-jobs");
    for (text, wanted) in table {
        fs::write(folder.join("job.json"), &text).unwrap();
        let (status, said) = said(&folder, &["check", "job.json"]);
        assert!(status == Some(1) && said.contains(wanted), "no {wanted} in {said}");
    }
}

#[test]
fn slips_on_the_command_line() {
    let folder = folder("slips-line");
    fs::write(folder.join("haas.pf"), plain_post("haas.pf")).unwrap();
    fs::write(folder.join("job.json"), job("{\"line\":[1,0,0]}")).unwrap();
    fs::write(folder.join("part.nc"), "%\nO1\nM30\n%\n").unwrap();
    let table: [(&[&str], &str); 8] = [
        (&["lint", "job.json"], "job.json is a job, not a form"),
        (&["lint", "part.nc"], "part.nc is an NC program, not a form"),
        (&["render", "job.json", "--form", "part.nc"], "`postform simulate part.nc` runs programs"),
        (&["check", "haas.pf"], "`postform lint haas.pf` checks a form"),
        (&["render", "job.json", "--form", "has.pf"], "forms in that folder: haas.pf"),
        (&["render", "haas.pf", "--form", "job.json"], "the job comes first"),
        (&["render", "job.json", "--form", "haas.pf", "--set", "header=off"], "the form has no property `header`"),
        (&["render", "job.json", "haas.pf"], "`postform render JOB --form haas.pf`"),
    ];
    for (arguments, wanted) in table {
        let (status, said) = said(&folder, arguments);
        assert!(status == Some(2) && said.contains(wanted), "{arguments:?}: {said}");
    }
}

/// If neither the program, the command line nor the control gives the units, `simulate --dry` names the assumed units.
#[test]
fn a_summary_names_units_that_it_assumes() {
    let folder = folder("slips-units");
    let note = "note: part.nc has no unit code";
    for (code, options, is_noted) in [
        ("", &["--control", "fanuc"][..], true),
        ("G20 ", &["--control", "fanuc"], false),
        ("", &["--control", "fanuc", "--units", "inch"], false),
        // each program of a Grbl begins in millimetres
        ("", &["--control", "grbl"], false),
    ] {
        fs::write(folder.join("part.nc"), format!("{code}G90 G0 X1.\nG1 X2. F10.\nM30\n")).unwrap();
        let (_, said) = said(&folder, &[&["simulate", "part.nc", "--dry"], options].concat());
        assert_eq!(said.contains(note), is_noted, "{code}{options:?}: {said}");
    }
}
