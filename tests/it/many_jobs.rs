//! Many jobs in one command: `render --out-dir`, `--split`, `--changed`, `verify`, `check` and `diff --forms` over folders.

use std::fs;
use std::io::Write as _;
use std::time::{Duration, SystemTime};

use crate::support::folder::{Folder, err, out};
use crate::support::root;

/// A folder with `haas.pf`, and the jobs of two samples in separate folders.
fn shop(test: &str) -> Folder {
    let folder = Folder::new(&format!("many-{test}"));
    fs::copy(root().join("postforms/haas.pf"), folder.0.join("haas.pf")).unwrap();
    for sample in ["bracket", "plate"] {
        folder.write(
            &format!("jobs/{sample}/job.json"),
            fs::read(root().join("samples").join(sample).join("job.json")).unwrap(),
        );
    }
    folder
}

/// The last line of the messages.
fn last(output: &std::process::Output) -> String {
    err(output).lines().last().unwrap_or_default().to_owned()
}

#[test]
fn each_job_gets_its_program_and_a_broken_one_stops_no_other() {
    let folder = shop("broken");
    folder.write("jobs/broken.json", b"{\"postform\": 1, \"units\": \"mm\", \"operations\": [");
    let output = folder.run(&["render", "jobs", "--form", "haas.pf", "--out-dir", "nc"]);
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(last(&output), "3 programs, 1 failed: jobs/broken.json");
    assert!(err(&output).contains("PJ007 at jobs/broken.json:1:46"), "{}", err(&output));
    let expected = fs::read_to_string(root().join("samples/bracket/expected.haas.nc")).unwrap();
    assert_eq!(folder.read("nc/bracket.nc"), expected);
    assert!(folder.has("nc/plate.nc") && !folder.has("nc/broken.nc"));
    assert_eq!(fs::read_dir(folder.0.join("nc")).unwrap().count(), 2);
}

#[test]
fn programs_are_the_same_however_many_are_printed_at_a_time() {
    let folder = shop("threads");
    let mut said = Vec::new();
    for threads in ["1", "2", "7"] {
        let output = folder.run(&["render", "jobs", "--form", "haas.pf", "--out-dir", threads, "--jobs", threads]);
        assert_eq!(output.status.code(), Some(0), "{}", err(&output));
        said.push(err(&output).replace(&format!(" {threads}/"), " nc/"));
        assert_eq!(folder.read(&format!("{threads}/plate.nc")), folder.read("1/plate.nc"));
    }
    assert_eq!(said[0], said[1]);
    assert_eq!(said[0], said[2]);
}

/// A control that stores programs by their numbers keeps only one of two programs with the same number.
#[test]
fn equal_program_numbers_are_warned_of() {
    let folder = shop("numbers");
    let plate = folder.read("jobs/plate/job.json");
    folder.write("jobs/cover/job.json", &plate);
    let run = |form: &str, more: &[&str]| {
        let arguments = [&["render", "jobs", "--form", form, "--out-dir", "nc", "--jobs", "1"], more].concat();
        let output = folder.run(&arguments);
        assert_eq!(output.status.code(), Some(0), "{}", err(&output));
        err(&output)
    };
    let said = run("haas.pf", &[]);
    let warning = "warning: nc/cover.nc and nc/plate.nc have the same program number";
    assert!(said.contains(warning) && said.contains("number all programs upwards: --program"), "{said}");
    // there is no warning if the numbers differ, or if the form prints no number
    assert!(!run("haas.pf", &["--program", "10"]).contains("same program number"));
    assert!(!run("haas.pf", &["--quiet"]).contains("same program number"));
    fs::copy(root().join("postforms/grbl.pf"), folder.0.join("grbl.pf")).unwrap();
    folder.write("jobs/bracket/job.json", &plate);
    assert!(!run("grbl.pf", &[]).contains("same program number"));
    // the spelling of the variable has no influence, and the text in a comment prints nothing
    let haas = folder.read("haas.pf");
    for (name, from, to, warns) in [
        ("angles.pf", "[program#]", "<program#>", true),
        ("capitals.pf", "[program#]", "[Program#]", true),
        ("remark.pf", "O[program#]", "O1 # not [program#]", false),
    ] {
        folder.write(name, haas.replace(from, to));
        assert_eq!(run(name, &[]).contains("same program number"), warns, "{name}");
    }
}

#[test]
fn alike_names_are_an_error_before_anything_is_written() {
    let folder = shop("alike");
    folder.write("jobs/other/plate.json", folder.read("jobs/plate/job.json"));
    let output = folder.run(&["render", "jobs", "--form", "haas.pf", "--out-dir", "nc"]);
    assert_eq!(output.status.code(), Some(2));
    let said = err(&output);
    assert!(
        said.contains("error: nc/plate.nc is the output file of jobs/other/plate.json and jobs/plate/job.json"),
        "{said}"
    );
    assert!(!folder.has("nc"));
    let output = folder.run(&["render", "jobs/plate", "jobs/plate/job.json", "--form", "haas.pf", "--out-dir", "nc"]);
    assert_eq!(output.status.code(), Some(2));
}

#[test]
fn an_output_never_replaces_a_job() {
    let folder = shop("input");
    folder.write("nc/plate.nc", folder.read("haas.pf"));
    let before = fs::read_to_string(root().join("samples/bracket/expected.haas.nc")).unwrap();
    folder.write("jobs/plate.nc", &before);
    let output = folder.run(&["render", "jobs/plate.nc", "--form", "haas.pf", "--out-dir", "jobs"]);
    assert_eq!(output.status.code(), Some(1), "{}", err(&output));
    assert!(err(&output).contains("error: jobs/plate.nc is an input"), "{}", err(&output));
    assert_eq!(folder.read("jobs/plate.nc"), before);
}

#[test]
fn changed_leaves_out_what_is_newer_than_job_and_form() {
    let folder = shop("changed");
    let run = || folder.run(&["render", "jobs", "--form", "haas.pf", "--out-dir", "nc", "--changed"]);
    let set = |file: &str, seconds: u64| {
        let file = fs::File::options().write(true).open(folder.0.join(file)).unwrap();
        file.set_modified(SystemTime::now() - Duration::from_secs(seconds)).unwrap();
    };
    for file in ["haas.pf", "postform.toml", "jobs/plate/job.json", "jobs/bracket/job.json"] {
        set(file, 100);
    }
    assert_eq!(last(&run()), "2 programs, none failed");
    assert_eq!(last(&run()), "0 programs, none failed");
    set("nc/plate.nc", 50);
    set("jobs/plate/job.json", 20);
    let output = run();
    assert!(err(&output).starts_with("1 of 2 programs is newer than its job and form"), "{}", err(&output));
    assert_eq!(last(&output), "1 program, none failed");
    set("nc/plate.nc", 50);
    set("haas.pf", 20);
    set("nc/bracket.nc", 10);
    assert_eq!(last(&run()), "1 program, none failed");
    // a program with the same time as its form does not count as newer than the form
    let moment = SystemTime::now() - Duration::from_secs(5);
    for file in ["haas.pf", "nc/plate.nc"] {
        fs::File::options().write(true).open(folder.0.join(file)).unwrap().set_modified(moment).unwrap();
    }
    assert_eq!(last(&run()), "2 programs, none failed");
}

/// The programs of a run are of one form. If the form changes during the run, the remaining programs fail, and the next run
/// prints them.
#[test]
fn a_form_that_changes_during_a_run_is_noticed() {
    let folder = shop("form-changes");
    let plate = folder.read("jobs/plate/job.json");
    for number in 0..150 {
        folder.write(&format!("many/{number}.json"), &plate);
    }
    let old = folder.read("haas.pf");
    let arguments = ["render", "many", "--form", "haas.pf", "--out-dir", "nc", "--changed", "--quiet", "--jobs", "1"];
    let program = std::env!("CARGO_BIN_EXE_postform");
    let run = std::process::Command::new(program)
        .args(arguments)
        .current_dir(&folder.0)
        .stderr(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    while !fs::read_dir(folder.0.join("nc")).is_ok_and(|mut programs| programs.next().is_some()) {
        std::thread::sleep(std::time::Duration::from_millis(1));
    }
    folder.write("haas.pf", old.replace("G0 G53 Z0", "G0 G53 Z0 (NEW)"));
    let output = run.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(1), "{}", err(&output));
    assert!(err(&output).contains("has changed since"), "{}", err(&output));
    let output = folder.run(&arguments);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    for number in 0..150 {
        assert!(folder.read(&format!("nc/{number}.nc")).contains("(NEW)"), "{number}");
    }
}

#[test]
fn a_job_is_split_by_tool_operation_and_work_offset() {
    let folder = shop("split");
    let split = |arguments: &[&str]| {
        let all = [&["render", "jobs/bracket", "--form", "haas.pf", "--out-dir", "nc"], arguments].concat();
        folder.run(&all)
    };
    let output = split(&["--split", "tool", "--program", "500"]);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    assert_eq!(last(&output), "5 programs, none failed");
    for (tool, number) in [(1, "O00500"), (3, "O00502"), (5, "O00504")] {
        let program = folder.read(&format!("nc/bracket-T{tool}.nc"));
        assert!(program.contains(number) && program.contains(&format!("T{tool} M6")), "{program}");
        assert_eq!(program.matches(" M6\n").count(), 1, "{program}");
        assert!(program.trim_end().ends_with("M30\n%"), "{program}");
    }
    let output = split(&["--split", "operation", "--name", "O{number}-{operation}"]);
    assert_eq!(last(&output), "7 programs, none failed");
    assert!(folder.has("nc/O1001-OP01.nc") && folder.has("nc/O1007-OP07.nc"));
    assert!(!err(&output).contains("only a part"), "{}", err(&output));
    // the operations of a selection are counted from 1
    let output = split(&["--split", "operation", "--only", "3,4", "--name", "only-{operation}"]);
    assert_eq!(last(&output), "2 programs, none failed");
    assert!(folder.read("nc/only-OP01.nc").contains("T3 M6") && folder.read("nc/only-OP02.nc").contains("T4 M6"));
    assert!(err(&output).contains("only a part of jobs/bracket/job.json is printed"), "{}", err(&output));
    let output = split(&["--split", "work"]);
    assert_eq!(last(&output), "2 programs, none failed");
    assert!(folder.read("nc/bracket-W2.nc").contains("G55") && !folder.read("nc/bracket-W1.nc").contains("G55"));
    let output = split(&["--split", "setup"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(err(&output).contains("jobs/bracket/job.json has no setups"), "{}", err(&output));
    let output = split(&["--split", "tool", "--name", "{job}-{operation}"]);
    assert!(err(&output).contains("{operation} has no value here"), "{}", err(&output));
    let output = split(&["--split", "tool", "--name", "{job}"]);
    assert!(err(&output).contains("is the output file of two parts of jobs/bracket/job.json"), "{}", err(&output));
    let output = split(&["--split", "tool", "--name", "{operation}"]);
    assert_eq!(output.status.code(), Some(2));
}

/// The direction of the spindle and the coolant end at the change to another tool, also if the operations before it are left
/// out.
#[test]
fn a_part_begins_without_the_spindle_and_coolant_of_another_tool() {
    let folder = shop("parts");
    let job = |second: &str| {
        format!(
            "{{\"postform\":1,\"program\":1,\"units\":\"mm\",\"machine\":\"mill\",\"tools\":[{{\"number\":1}},{{\"number\":2}}],\
             \"operations\":[{{\"tool\":1,\"work\":54,\"spindle\":{{\"speed\":2000,\"direction\":\"ccw\"}},\
             \"coolant\":\"flood\",\"path\":[{{\"rapid\":[0,0,50]}},{{\"line\":[1,0,-1],\"feed\":100}},\
             {{\"rapid\":[1,0,50]}}]}},{{{second}\"path\":[{{\"rapid\":[0,0,50]}},{{\"line\":[3,3,-1],\"feed\":200}},\
             {{\"rapid\":[3,3,50]}}]}}]}}"
        )
    };
    let run = |second: &str, arguments: &[&str]| {
        folder.write("job.json", job(second));
        folder.run(&[&["render", "job.json", "--form", "haas.pf"], arguments].concat())
    };
    let split = ["--split", "operation", "--out-dir", "nc", "--name", "{operation}-{number}"];
    let no_turn = "\"tool\":2,\"spindle\":{\"speed\":500},";
    for arguments in [&[][..], &split] {
        let output = run(no_turn, arguments);
        assert!(err(&output).contains("PR001"), "{}", err(&output));
        assert_eq!(output.status.code(), Some(1));
    }
    // without coolant, the second tool is dry in the whole program and in its part
    let dry = run("\"tool\":2,\"spindle\":{\"speed\":500,\"direction\":\"cw\"},", &split);
    assert_eq!(dry.status.code(), Some(0), "{}", err(&dry));
    assert!(!folder.read("nc/OP02-2.nc").contains("M8"), "{}", folder.read("nc/OP02-2.nc"));
    // the same tool keeps its spindle and coolant
    let same = run("\"tool\":1,", &split);
    assert_eq!(same.status.code(), Some(0), "{}", err(&same));
    let part = folder.read("nc/OP02-2.nc");
    assert!(part.contains("S2000 M4") && part.contains("M8"), "{part}");
}

/// The program of a part begins with the first rapid of its operation, at the height where the tool is in the whole
/// program. A later, lower rapid is not the first one.
#[test]
fn a_part_begins_with_its_first_rapid() {
    const PARTS: [&str; 6] = ["--split", "operation", "--out-dir", "nc", "--name", "{operation}"];
    let folder = shop("first-rapids");
    let operation = |path: &str| {
        format!(
            r#"{{"tool":1,"work":54,"spindle":{{"speed":900,"direction":"cw"}},"feed":100,"path":[{path},{{"line":[9,9,-1]}},{{"rapid":[9,9,50]}}]}}"#
        )
    };
    for (rapids, first) in [
        (r#"{"rapid":[30,30]},{"rapid":[30,40,2]}"#, ["X30. Y30.", "Z50.", "Y40. Z2."]),
        (r#"{"rapid":[null,null,60]},{"rapid":[30,40,2]}"#, ["X9. Y9.", "Z60.", "X30. Y40. Z2."]),
        (r#"{"rapid":[30,30,60]},{"rapid":[30,30,2]}"#, ["X30. Y30.", "Z60.", "Z2."]),
        (r#"{"comment":"A"},{"rapid":[30,30]},{"dwell":1},{"rapid":[30,30,2]}"#, ["X30. Y30.", "Z50.", "Z2."]),
    ] {
        let operations = [operation(r#"{"rapid":[0,0,50]}"#), operation(rapids)].join(",");
        let head = r#""postform":1,"program":1,"units":"mm","tools":[{"number":1}]"#;
        folder.write("job.json", format!("{{{head},\"operations\":[{operations}]}}"));
        let output = folder.run(&[&["render", "job.json", "--form", "haas.pf"][..], &PARTS].concat());
        assert_eq!(output.status.code(), Some(0), "{rapids}: {}", err(&output));
        let part = folder.read("nc/OP02.nc");
        let body = part.split_once("G90 G54 ").unwrap().1;
        let at = first.map(|words| body.find(words).unwrap_or_else(|| panic!("{rapids}: no {words} in {body}")));
        assert!(at[0] == 0 && at.is_sorted() && body.find('Z') == Some(at[1]), "{rapids}: {body}");
        fs::remove_dir_all(folder.0.join("nc")).unwrap();
    }
}

#[test]
fn an_operation_in_two_work_offsets_is_no_part() {
    let folder = shop("offsets");
    let job = folder.read("jobs/plate/job.json");
    let at = ["{ \"line\"", "{\"line\""].iter().find_map(|item| job.find(item)).unwrap();
    folder.write("two.json", format!("{}{{\"work\": 55}}, {{\"rapid\": [0, 0, 50]}}, {}", &job[..at], &job[at..]));
    let output = folder.run(&["render", "two.json", "--form", "haas.pf", "--out-dir", "nc", "--split", "work"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(err(&output).contains("PR061 at two.json"), "{}", err(&output));
}

#[test]
fn verify_and_check_take_several_jobs() {
    let folder = shop("verify");
    let output = folder.run(&["verify", "jobs", "--form", "haas.pf"]);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    let verdicts = out(&output);
    assert_eq!(verdicts.lines().count(), 2, "{verdicts}");
    assert!(verdicts.contains("jobs/bracket/job.json") && verdicts.contains("jobs/plate/job.json"), "{verdicts}");
    assert_eq!(last(&output), "2 jobs, none failed");
    let output = folder.run(&["verify", "jobs", "--form", "haas.pf", "--format", "json"]);
    for line in out(&output).lines() {
        assert!(serde_json::from_str::<serde_json::Value>(line).is_ok(), "{line}");
    }
    folder.write("jobs/broken.json", b"{\"postform\": 1");
    let output = folder.run(&["check", "jobs"]);
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(out(&output).matches(": in order\n").count(), 2);
    assert_eq!(last(&output), "3 jobs, 1 failed: jobs/broken.json");
    let output = folder.run(&["verify", "jobs", "--nc", "x.nc"]);
    assert_eq!(output.status.code(), Some(2));
    let output = folder.run(&["check", "jobs", "-"]);
    assert!(err(&output).contains("standard input can't be one of several jobs"), "{}", err(&output));
}

/// An option for reading one format applies only to the jobs in this format. If no job has the format, the option is an
/// error.
#[test]
fn options_of_a_format_leave_the_other_jobs_alone() {
    let folder = shop("mixed");
    let cl = fs::read_to_string(root().join("samples/cl-drill/job.cl")).unwrap();
    let bare = cl.lines().filter(|line| !line.starts_with("UNITS")).collect::<Vec<_>>().join("\n");
    folder.write("jobs/bare.cl", bare);
    let run = |command: &str, more: &[&str]| {
        let own = match command {
            "render" => vec!["render", "jobs", "--form", "haas.pf", "--out-dir", "programs", "--program", "5"],
            "verify" => vec!["verify", "jobs", "--form", "haas.pf", "--program", "5"],
            _ => vec!["check", "jobs"],
        };
        folder.run(&[&own[..], more].concat())
    };
    for command in ["render", "verify", "check"] {
        let output = run(command, &[]);
        assert!(err(&output).contains("PL005 at jobs/bare.cl"), "{command}: {}", err(&output));
        let output = run(command, &["--assume-units", "mm"]);
        assert_eq!(output.status.code(), Some(0), "{command}: {}", err(&output));
        assert!(last(&output).ends_with("none failed"), "{command}: {}", err(&output));
        let output = run(command, &["--job-control", "haas"]);
        let message = "--job-control and --job-no-point are for NC programs only: jobs/bare.cl is not an NC program";
        assert!(output.status.code() == Some(2) && err(&output).contains(message), "{command}: {}", err(&output));
    }
    let output = folder.run(&["check", "jobs/bracket/job.json", "--assume-units", "mm"]);
    assert!(output.status.code() == Some(2) && err(&output).contains("not for the format of"), "{}", err(&output));
    // with --quiet, only the verdicts of jobs that fail are printed
    let output = run("verify", &["--assume-units", "mm", "--quiet"]);
    assert_eq!((out(&output), output.status.code()), (String::new(), Some(0)), "{}", err(&output));
}

#[test]
fn a_change_of_a_form_is_shown_by_its_kinds() {
    let folder = shop("archive");
    let form = folder.read("haas.pf");
    folder.write("new.pf", form.replace("G0 G53 Z0", "G0 G53 Z0 M9"));
    assert_ne!(folder.read("new.pf"), form);
    let output = folder.run(&["diff", "--forms", "haas.pf", "new.pf", "jobs"]);
    assert_eq!(output.status.code(), Some(1), "{}", err(&output));
    let said = out(&output);
    assert!(said.starts_with("2 programs: M9 more, blocks added\n  jobs/bracket/job.json\n  jobs/plate/job.json\nas jobs/bracket/job.json:\n"), "{said}");
    assert_eq!(said.lines().last(), Some("2 of 2 programs change, in 1 kind"));
    let output = folder.run(&["diff", "--forms", "haas.pf", "haas.pf", "jobs"]);
    assert_eq!((output.status.code(), out(&output).as_str()), (Some(0), "0 of 2 programs change\n"));
    let output = folder.run(&["diff", "--forms", "haas.pf", "new.pf", "jobs", "--format", "json"]);
    let documents = out(&output);
    assert_eq!(output.status.code(), Some(1));
    assert!(
        documents.lines().all(|line| line.contains("\"job\":\"jobs/") && line.contains("\"same\":false")),
        "{documents}"
    );
}

/// In an archive, each job is printed with its own postform.toml.
#[test]
fn a_change_of_a_form_is_shown_with_the_settings_of_each_job() {
    let folder = shop("archive-settings");
    let form = folder.read("haas.pf");
    let home = "G0 G53 Z0";
    let slow = |more: &str| {
        let form = form.replacen("\nName ", "\nProperty slow yesno no Slow\nName ", 1);
        form.replace(home, &format!("G0 G53 Z0\n@if [slow]\nM9{more}\n@end\n"))
    };
    folder.write("old.pf", slow(""));
    folder.write("new.pf", slow(" (SLOW)"));
    folder.write("jobs/plate/postform.toml", "[properties]\nslow = true\n");
    for jobs in [["jobs/bracket", "jobs/plate"], ["jobs/plate", "jobs/bracket"]] {
        let output = folder.run(&[&["diff", "--forms", "old.pf", "new.pf"][..], &jobs].concat());
        let said = out(&output);
        assert_eq!(output.status.code(), Some(1), "{}", err(&output));
        assert_eq!(said.lines().last(), Some("1 of 2 programs changes, in 1 kind"), "{said}");
        assert!(said.contains("as jobs/plate/job.json"), "{said}");
    }
}

/// `[jobfile]` is the name of the program's own job.
#[test]
fn each_program_names_its_own_job() {
    let folder = shop("own-job");
    let form = folder.read("haas.pf");
    folder.write("named.pf", form.replacen("O[program#]", "O[program#] ([jobfile])", 1));
    let plate = folder.read("jobs/plate/job.json");
    for name in ["alpha", "beta", "gamma"] {
        folder.write(&format!("more/{name}.json"), &plate);
    }
    let output = folder.run(&["render", "more", "--form", "named.pf", "--out-dir", "nc", "--quiet"]);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    for name in ["alpha", "beta", "gamma"] {
        let job = format!("more/{name}.json");
        let alone = out(&folder.run(&["render", &job, "--form", "named.pf", "--quiet"]));
        assert!(alone.contains(&format!("({}.JSON)", name.to_uppercase())), "{alone}");
        assert_eq!(folder.read(&format!("nc/{name}.nc")), alone);
    }
}

/// Each wrong use of the commands is reported by name, and no job is skipped silently.
#[test]
fn wrong_uses_are_named_and_nothing_is_left_out_unseen() {
    let folder = shop("wrong");
    let run = |arguments: &[&str]| folder.run(&[&["render"], arguments].concat());
    for option in [&["--split", "tool"][..], &["--changed"], &["--name", "{job}"], &["--jobs", "2"]] {
        let output = run(&[&["jobs/bracket/job.json", "--form", "haas.pf", "-o", "part.nc"], option].concat());
        assert_eq!(output.status.code(), Some(2), "{option:?}");
        assert!(err(&output).contains("--out-dir"), "{}", err(&output));
        assert!(!folder.has("part.nc"));
    }
    let output = run(&["jobs", "--form", "haas.pf", "--out-dir", "nc", "--name", "{tool}.nc"]);
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(err(&output).matches("{tool} has no value here").count(), 1);
    let output = run(&["jobs", "--form", "haas.pf", "--out-dir", "haas.pf"]);
    assert_eq!((output.status.code(), err(&output).as_str()), (Some(2), "error: haas.pf is not a folder\n"));
    // a folder or a link with the name of a program
    fs::create_dir_all(folder.0.join("nc/plate.nc")).unwrap();
    let output = run(&["jobs", "--form", "haas.pf", "--out-dir", "nc"]);
    assert_eq!(last(&output), "2 programs, 1 failed: jobs/plate/job.json", "{}", err(&output));
    assert_eq!(fs::read_dir(folder.0.join("nc/plate.nc")).unwrap().count(), 0);
    #[cfg(unix)]
    {
        folder.write("target.nc", "mine");
        fs::create_dir_all(folder.0.join("linked")).unwrap();
        std::os::unix::fs::symlink("../target.nc", folder.0.join("linked/plate.nc")).unwrap();
        let output = run(&["jobs/plate", "--form", "haas.pf", "--out-dir", "linked"]);
        assert_eq!(output.status.code(), Some(1), "{}", err(&output));
        assert_eq!(folder.read("target.nc"), "mine");
    }
    // characters in file names are replaced as in names from a form
    folder.write("odd/it's a part.json", folder.read("jobs/plate/job.json"));
    let output = run(&["odd", "--form", "haas.pf", "--out-dir", "odd-nc", "--name", "{job}.nc.gz"]);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    assert!(fs::read(folder.0.join("odd-nc/it_s_a_part.nc.gz")).unwrap().starts_with(b"\x1f\x8b"));
    // a file that does not begin like a job is reported; a compressed job is used
    folder.write("mixed/other.json", "{\"name\": 1}");
    folder.write("mixed/empty.json", "");
    let gz = fs::read(folder.0.join("odd-nc/it_s_a_part.nc.gz")).unwrap();
    folder.write("mixed/job.nc.gz", gz);
    let output = folder.run(&["check", "mixed", "--job-control", "haas"]);
    assert_eq!(out(&output).matches(": in order\n").count(), 1, "{}{}", out(&output), err(&output));
    assert_eq!(err(&output).matches("left out: mixed/").count(), 2, "{}", err(&output));
}

#[test]
fn compressed_jobs_and_programs() {
    let folder = shop("gz");
    let output = folder.run(&["render", "jobs/bracket/job.json", "--form", "haas.pf", "-o", "bracket.nc.gz"]);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    let packed = fs::read(folder.0.join("bracket.nc.gz")).unwrap();
    assert!(packed.starts_with(b"\x1f\x8b") && packed.len() < 3000);
    let output =
        folder.run(&["diff", "bracket.nc.gz", root().join("samples/bracket/expected.haas.nc").to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(0), "{}{}", out(&output), err(&output));
    // a compressed program can be read as a job, and a compressed job can be proven
    let output = folder.run(&["check", "bracket.nc.gz", "--job-control", "haas"]);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    // a compressed program can be plotted without a form, and a compressed CL file becomes a case with a program number
    let output = folder.run(&["plot", "bracket.nc.gz", "-o", "bracket.svg"]);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    let cl = fs::read(root().join("samples/cl-drill/job.cl")).unwrap();
    let mut packer = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
    packer.write_all(&cl).unwrap();
    folder.write("parts/drill.cl.gz", packer.finish().unwrap());
    let output = folder.run(&["test", "parts", "--form", "haas.pf", "--update"]);
    assert_eq!(output.status.code(), Some(0), "{}{}", out(&output), err(&output));
    // the name of the program is that of the job without `.gz`, and of the folder for a file called `job`
    for name in ["left", "right"] {
        let mut packer = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
        packer.write_all(&cl).unwrap();
        folder.write(&format!("packed/{name}/job.cl.gz"), packer.finish().unwrap());
    }
    let output =
        folder.run(&["render", "packed", "parts", "--form", "haas.pf", "--program", "1", "--out-dir", "names"]);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    let output = folder.run(&[
        "render",
        "parts",
        "--form",
        "haas.pf",
        "--program",
        "1",
        "--out-dir",
        "names",
        "--split",
        "tool",
    ]);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    for name in ["left.nc", "right.nc", "drill.nc", "drill-T1.nc"] {
        assert!(folder.has(&format!("names/{name}")), "{name}");
    }
    folder.write("cut.nc.gz", &packed[..packed.len() / 2]);
    let output = folder.run(&["check", "cut.nc.gz"]);
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(
        err(&output),
        "error: can't read cut.nc.gz: the compressed file is cut off, or other bytes follow its end\n"
    );
    folder.write("plain.json.gz", folder.read("jobs/plate/job.json"));
    let output = folder.run(&["check", "plain.json.gz"]);
    assert!(err(&output).contains("the file is not a gzip file"), "{}", err(&output));
}
