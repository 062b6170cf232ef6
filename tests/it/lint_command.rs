//! `postform lint` as a command: reports that match their schemas, configuration, fixes in files, wrong input.

use crate::support;
use std::fs;
use std::process::Command;

use crate::support::folder::{Folder, err, out};
use crate::support::{mill, root};
use serde_json::Value;

/// A line with a warning, a safe fix, an unsafe fix and a note.
const SEQUENCES: &str = "LineCode\nGl X<h> Y[v] Z[d]F[frate]\nEnd";

fn schema(path: &str) -> jsonschema::Validator {
    let text = fs::read_to_string(root().join(path)).unwrap();
    let mut schema: Value = serde_json::from_str(&text).unwrap();
    // strict validators refuse the pattern for languages in the published SARIF schema; the reports of postform contain
    // no language
    for holder in ["run", "toolComponent"] {
        if let Some(language) = schema.pointer_mut(&format!("/definitions/{holder}/properties/language")) {
            language.as_object_mut().unwrap().remove("pattern");
        }
    }
    jsonschema::validator_for(&schema).unwrap()
}

fn valid(schema: &jsonschema::Validator, value: &Value) {
    let errors: Vec<String> =
        schema.iter_errors(value).map(|error| format!("{}: {error}", error.instance_path())).collect();
    assert!(errors.is_empty(), "{}", errors.join("\n"));
}

/// Forms with findings of all kinds. Some file names need escaping. Some findings have locations in two files, others
/// have no location.
fn many() -> Folder {
    let folder = Folder::new("many");
    folder.write("b.pf", mill("Call common, 1%.inc", SEQUENCES));
    folder.write("common, 1%.inc", "Upon [work]\nG91\nEnd\n");
    folder.write("a/x.pf", mill("", "Drill\nG81 X[h]\nEnd\nDrill\nG82 \"%\nEnd"));
    folder.write("a/ä.pf", b"Name Fr\xe4se\n");
    folder
}

#[test]
fn reports_are_valid_and_ordered() {
    let folder = many();
    let json = folder.run(&["lint", ".", "--format", "json"]);
    assert_eq!(json.status.code(), Some(1));
    let json: Value = serde_json::from_str(&out(&json)).unwrap();
    valid(&schema("docs/lint.schema.json"), &json);
    let places: Vec<(String, u64)> = json["findings"]
        .as_array()
        .unwrap()
        .iter()
        .map(|finding| (finding["at"]["file"].as_str().unwrap().to_owned(), finding["at"]["start"].as_u64().unwrap()))
        .collect();
    let files: Vec<&str> = places.iter().map(|(file, _)| file.as_str()).collect();
    assert!(files.is_sorted_by_key(|file| {
        ["./a/x.pf", "./a/ä.pf", "./b.pf", "./common, 1%.inc"].iter().position(|f| f == file)
    }));
    assert!(places.windows(2).all(|pair| pair[0].0 != pair[1].0 || pair[0].1 <= pair[1].1), "{places:?}");

    let sarif: Value = serde_json::from_str(&out(&folder.run(&["lint", ".", "--format", "sarif"]))).unwrap();
    valid(&schema("tests/data/sarif-2.1.0.json"), &sarif);
    let results = sarif["runs"][0]["results"].as_array().unwrap();
    assert_eq!(results.len(), places.len());
    for result in results {
        let rule = result["ruleIndex"].as_u64().unwrap() as usize;
        assert_eq!(sarif["runs"][0]["tool"]["driver"]["rules"][rule]["id"], result["ruleId"]);
    }
    assert!(results.iter().any(|result| {
        result["locations"][0]["physicalLocation"]["artifactLocation"]["uri"] == "./common%2C%201%25.inc"
    }));

    let github = out(&folder.run(&["lint", ".", "--format", "github"]));
    assert_eq!(github.lines().count(), places.len());
    assert!(
        github.contains("::warning file=./common%2C 1%25.inc,line=2,endLine=2,col=1,endColumn=4,title=PF424::"),
        "{github}"
    );
    assert!(
        github.lines().all(|line| ["::error ", "::warning ", "::notice "].iter().any(|kind| line.starts_with(kind)))
    );
    // the output is the same in every run, although forms are checked in parallel
    for _ in 0..3 {
        assert_eq!(out(&folder.run(&["lint", ".", "--format", "github"])), github);
    }
}

#[test]
fn a_file_that_cant_be_read_hides_no_other() {
    let folder = Folder::new("unread");
    folder.write("form.pf", mill("", SEQUENCES));
    let output = folder.run(&["lint", "missing.pf", "form.pf"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(err(&output).contains("missing.pf") && out(&output).contains("PF206"), "{}", err(&output));
    assert!(out(&output).contains("; 1 form not read"), "{}", out(&output));
    let json: Value = serde_json::from_str(&out(&folder.run(&["lint", "missing.pf", "--format", "json"]))).unwrap();
    assert_eq!(json["summary"]["unread"], 1);
    let sarif: Value = serde_json::from_str(&out(&folder.run(&["lint", "missing.pf", "--format", "sarif"]))).unwrap();
    valid(&schema("tests/data/sarif-2.1.0.json"), &sarif);
    assert_eq!(sarif["runs"][0]["invocations"][0]["executionSuccessful"], false);
    folder.write("wide.pf", b"\xff\xfeN\0a\0");
    let output = folder.run(&["fmt", "wide.pf"]);
    assert_eq!((output.status.code(), err(&output).contains("is UTF-16")), (Some(2), true));
    folder.write("empty/readme.txt", "");
    let output = folder.run(&["lint", "empty"]);
    assert_eq!((output.status.code(), err(&output).contains("no form (.pf) in empty")), (Some(2), true));
}

#[test]
fn configuration_is_found_upwards_and_the_nearest_holds() {
    let folder = Folder::new("config");
    folder.write("postform.toml", "[rules]\nPF1 = \"off\"\nPF102 = \"error\"\n");
    folder.write("mills/form.pf", mill("", SEQUENCES));
    folder.write("other/form.pf", mill("", SEQUENCES));
    folder.write("other/postform.toml", "[rules]\nPF206 = \"off\"\n");
    let codes = |path: &str| {
        let json: Value = serde_json::from_str(&out(&folder.run(&["lint", path, "--format", "json"]))).unwrap();
        let findings = json["findings"].as_array().unwrap();
        let row = |f: &Value| format!("{} {}", f["code"].as_str().unwrap(), f["severity"].as_str().unwrap());
        findings.iter().map(row).filter(|row| row.starts_with("PF1") || row.starts_with("PF206")).collect::<Vec<_>>()
    };
    assert_eq!(codes("mills/form.pf"), ["PF206 warning", "PF102 error"]);
    assert_eq!(codes("other/form.pf"), ["PF102 warning"]);
}

#[test]
fn configuration_gives_the_form_the_control_and_the_limits() {
    let folder = Folder::new("defaults");
    folder.write("postform.toml", "form = \"forms/own.pf\"\ncontrol = \"linuxcnc\"\nlimits = \"extended\"\n");
    folder.write("forms/own.pf", mill("", "BeginRow\nG1 G2 G3 G4 G5 G6 G7 G8 G9 G10 G11 G12 G13 G14 G15 G16\nEnd"));
    folder.write("jobs/job.json", support::job("{\"line\":[1,1,0]}"));
    let output = folder.run(&["render", "jobs/job.json", "--no-verify"]);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    assert!(out(&output).contains("G1 X1. Y1. Z0 F10.") && err(&output).contains("PF601"), "{}", err(&output));
    // an option on the command line overrides postform.toml
    assert_eq!(folder.run(&["render", "jobs/job.json", "--limits", "classic"]).status.code(), Some(1));
    // the form has no `Control`, so each command verifies its program by the rules of the control in postform.toml
    folder.write("cases/one/job.json", support::job("{\"line\":[1,1,0]}"));
    folder.write("cases/postform.toml", "control = \"linuxcnc\"\n[test]\nforms = [\"../forms/own.pf\"]\n");
    folder.write("cases/one/expected.own.nc", "G0\n");
    for arguments in [&["render", "jobs/job.json"][..], &["verify", "jobs/job.json"], &["test", "cases"]] {
        let output = folder.run(arguments);
        let said = out(&output) + &err(&output);
        assert_eq!(output.status.code(), Some(1), "{arguments:?}: {said}");
        assert!(said.contains("PV014") && !said.contains("has no `Control`"), "{arguments:?}: {said}");
    }
    // LinuxCNC accepts numbers without a decimal point, Fanuc does not
    folder.write("program.nc", "G21\nG0 X1\nM2\n");
    assert_eq!(folder.run(&["simulate", "program.nc"]).status.code(), Some(0));
    assert_eq!(folder.run(&["simulate", "program.nc", "--control", "fanuc"]).status.code(), Some(1));
    folder.write("postform.toml", "");
    let output = folder.run(&["render", "jobs/job.json"]);
    assert_eq!((output.status.code(), err(&output).contains("--form")), (Some(2), true));
}

#[test]
fn a_wrong_configuration_is_wrong_usage() {
    let folder = Folder::new("wrong_config");
    folder.write("form.pf", mill("", ""));
    let table = [
        ("[rules]\nPF303 = \"of\"\n", "a rule is off, note, warning or error"),
        ("[rules]\nPF9 = \"off\"\n", "nor a family"),
        ("[rules]\nPF001 = \"off\"\n", "PF001 is an error"),
        ("[rule]\nPF303 = \"off\"\n", "unknown field `rule`"),
        ("control = \"hurco\"\n", "linuxcnc"),
        ("limits = 3\n", "invalid type"),
        ("[rules\n", "line 1"),
    ];
    for (text, message) in table {
        folder.write("postform.toml", text);
        let output = folder.run(&["lint", "form.pf"]);
        assert_eq!(output.status.code(), Some(2), "{text}");
        assert!(err(&output).contains(message) && err(&output).contains("postform.toml"), "{text}: {}", err(&output));
    }
    folder.write("postform.toml", b"\xff\xfe");
    assert_eq!(folder.run(&["lint", "form.pf"]).status.code(), Some(2));
}

#[test]
#[cfg(unix)]
fn a_configuration_is_a_file() {
    use std::os::unix::fs::symlink;
    let folder = Folder::new("config_kinds");
    for name in ["folder", "nothing", "device"] {
        folder.write(&format!("{name}/form.pf"), mill("", ""));
    }
    fs::create_dir_all(folder.0.join("folder/postform.toml")).unwrap();
    symlink("nowhere", folder.0.join("nothing/postform.toml")).unwrap();
    symlink("/dev/null", folder.0.join("device/postform.toml")).unwrap();
    for (name, message) in [("folder", "is not a file"), ("nothing", "can't read"), ("device", "is not a file")] {
        let output = folder.run(&["lint", &format!("{name}/form.pf")]);
        assert_eq!(output.status.code(), Some(2), "{name}: {}", err(&output));
        let place = format!("{name}/postform.toml");
        assert!(err(&output).contains(&place) && err(&output).contains(message), "{name}: {}", err(&output));
    }
}

#[test]
#[cfg(unix)]
fn folders_are_not_left_through_links() {
    use std::os::unix::fs::symlink;
    let folder = Folder::new("links");
    let (text, notes) = (mill("", SEQUENCES), "Name   what the foreman said\n\n\n\nG1\n");
    folder.write("posts/own.pf", &text);
    folder.write("outside/other.pf", &text);
    folder.write("outside/notes.txt", notes);
    folder.write("posts/notes.txt", notes);
    for (name, to) in [
        ("notes.pf", "../outside/notes.txt"),
        ("other.pf", "../outside/other.pf"),
        ("inside.pf", "notes.txt"),
        ("again.pf", "own.pf"),
    ] {
        symlink(to, folder.0.join("posts").join(name)).unwrap();
    }
    let pipe = |name: &str| assert!(Command::new("mkfifo").arg(folder.0.join(name)).status().unwrap().success());
    pipe("posts/pipe.pf");
    for command in [&["lint", "--fix", "posts"][..], &["fmt", "posts"], &["lint", "posts"]] {
        let output = folder.run(command);
        for name in ["notes.pf", "other.pf", "inside.pf", "pipe.pf"] {
            assert!(err(&output).contains(&format!("posts/{name}: ")), "{command:?} {name}: {}", err(&output));
        }
        assert!(!err(&output).contains("again.pf"), "{}", err(&output));
    }
    assert_ne!(folder.read("posts/own.pf"), text);
    assert_eq!(folder.read("outside/other.pf"), text);
    assert_eq!([folder.read("outside/notes.txt"), folder.read("posts/notes.txt")], [notes, notes]);
    // a link that is named on the command line is followed
    folder.run(&["fmt", "posts/other.pf"]);
    assert_ne!(folder.read("outside/other.pf"), text);
    // a form that calls a pipe
    folder.write("calls.pf", mill("Call pipe", ""));
    pipe("pipe");
    assert!(
        out(&folder.run(&["lint", "calls.pf", "--format", "github"])).contains("title=PF009::`pipe` is not a file")
    );
}

#[test]
fn safe_fixes_are_made_in_the_files_and_keep_their_line_ends() {
    let folder = Folder::new("fix");
    let text = mill("Call part.pf", SEQUENCES).replace('\n', "\r\n");
    folder.write("form.pf", &text);
    folder.write("part.pf", "RapidCode\nG0 X<h> Y[v] Z[d]\nEnd\n");
    let before = folder.run(&["render", "job.json", "--form", "form.pf"]);
    let output = folder.run(&["lint", "--fix", "form.pf"]);
    assert_eq!(output.status.code(), Some(1), "the unsafe one is left");
    assert!(out(&output).contains("3 fixed") && out(&output).contains("PF206"), "{}", out(&output));
    assert_eq!(folder.read("form.pf"), text.replace("<h>", "[h]").replace("]F[", "] F["));
    assert_eq!(folder.read("part.pf"), "RapidCode\nG0 X[h] Y[v] Z[d]\nEnd\n");
    assert_eq!(folder.run(&["render", "job.json", "--form", "form.pf"]).stdout, before.stdout);
    let again = folder.run(&["lint", "--fix", "form.pf"]);
    assert!(out(&again).contains("; 0 fixed"));
    let input = folder.run(&["lint", "--fix", "-"]);
    assert_eq!((input.status.code(), err(&input).contains("standard input can't be fixed")), (Some(2), true));
}

#[test]
fn unsafe_fixes_show_the_program_before_and_after() {
    let folder = Folder::new("unsafe");
    let text = mill("", "LineCode\nGl X[h] Y[v] Z[d] F[frate]\nEnd");
    folder.write("form.pf", &text);
    folder.write("job.json", support::job("{\"line\":[1,1,0]}"));
    let shown = folder.run(&["lint", "--unsafe-fixes", "form.pf", "--job", "job.json"]);
    let story = out(&shown);
    for part in [
        "form.pf: 1 unsafe fix (made by --fix --unsafe-fixes):\n",
        "form.pf:22: write the digit (PF206)\n",
        "-G1 F10.\n-Gl X1. Y1. Z0 F10.\n+G1 X1. Y1. Z0 F10.\n",
    ] {
        assert!(story.contains(part), "{part}\n{story}");
    }
    assert_eq!(folder.read("form.pf"), text, "shown, not made");
    let made = folder.run(&["lint", "--fix", "--unsafe-fixes", "form.pf"]);
    assert!(out(&made).contains("the program of the sample job:\n--- before\n+++ after\n"), "{}", out(&made));
    assert_eq!(folder.read("form.pf"), text.replace("Gl", "G1"));
    let json = folder.run(&["lint", "--fix", "--unsafe-fixes", "form.pf", "--format", "json"]);
    serde_json::from_str::<Value>(&out(&json)).unwrap();
}

/// A fix of a called file depends on the comment marks and the control of the form that calls the file.
#[test]
fn parts_are_mended_where_they_are_called() {
    let folder = Folder::new("parts");
    let part = "BeginRow\n(PASS\nM8\nGO\nEnd\n";
    let form = mill("Comment ( ]\nControl linuxcnc\nCall part.pf", "");
    folder.write("posts/form.pf", &form);
    folder.write("posts/part.pf", part);
    for args in [&["lint", "--fix", "posts"][..], &["lint", "--fix", "posts/part.pf", "posts/form.pf"]] {
        folder.run(args);
        assert_eq!((folder.read("posts/form.pf"), folder.read("posts/part.pf")), (form.clone(), part.into()));
    }
    folder.run(&["lint", "--fix", "--unsafe-fixes", "posts"]);
    assert_eq!(folder.read("posts/part.pf"), part.replace("GO", "G0"));
    // two forms that call each other give one finding, and both forms are checked
    folder.write("ring/a.pf", mill("Call b.pf", ""));
    folder.write("ring/b.pf", "Call a.pf\n");
    let output = folder.run(&["lint", "ring", "--format", "github"]);
    assert_eq!((output.status.code(), out(&output).matches("PF009").count()), (Some(1), 1), "{}", out(&output));
}

/// postform applies unsafe fixes only after it has shown their effect on a program.
#[test]
fn unsafe_fixes_that_nobody_can_see_are_not_made() {
    let folder = Folder::new("unseen");
    let text = mill("WindowSize 80", "LineCode\nGl X[h] Y[v] Z[d]F[frate]\nEnd");
    folder.write("form.pf", &text);
    folder.write("broken.json", "{");
    let missing = folder.run(&["lint", "--fix", "--unsafe-fixes", "form.pf", "--job", "missing.json"]);
    assert_eq!((missing.status.code(), folder.read("form.pf")), (Some(2), text.clone()));
    // locations are positions in the file, and safe fixes are not listed as unsafe
    let shown = out(&folder.run(&["lint", "--unsafe-fixes", "form.pf"]));
    assert!(shown.starts_with("form.pf: 1 unsafe fix (made by --fix --unsafe-fixes):\n"), "{shown}");
    let line = text.lines().position(|line| line.starts_with("Gl")).unwrap() + 1;
    assert!(shown.contains(&format!("  form.pf:{line}: write the digit (PF206)\n")), "{shown}");
    let broken = folder.run(&["lint", "--fix", "--unsafe-fixes", "form.pf", "--job", "broken.json"]);
    assert!(out(&broken).contains("1 unsafe fix not made") && out(&broken).contains("broken.json can't be printed"));
    assert_eq!(broken.status.code(), Some(1));
    assert_eq!(folder.read("form.pf"), text.replace("]F[", "] F[").replace("WindowSize 80\n", ""), "the safe ones");
}

#[cfg(unix)]
#[test]
fn a_protected_form_stays_and_others_keep_their_mode() {
    use std::os::unix::fs::PermissionsExt;
    let folder = Folder::new("modes");
    let text = mill("", SEQUENCES);
    folder.write("form.pf", &text);
    let path = folder.0.join("form.pf");
    let set = |mode: u32| fs::set_permissions(&path, fs::Permissions::from_mode(mode)).unwrap();
    set(0o444);
    for command in [["lint", "--fix"], ["fmt", "form.pf"]] {
        let output = folder.run(&[command[0], command[1], "form.pf"]);
        assert_eq!(
            (output.status.code(), err(&output).contains("form.pf: it is read-only")),
            (Some(2), true),
            "{command:?}"
        );
        assert_eq!(folder.read("form.pf"), text);
    }
    set(0o755);
    folder.run(&["lint", "--fix", "form.pf"]);
    assert_ne!(folder.read("form.pf"), text);
    assert_eq!(fs::metadata(&path).unwrap().permissions().mode() & 0o777, 0o755);
    assert_eq!(folder.run(&["fmt", "missing/form.pf"]).status.code(), Some(2));
}

#[test]
fn called_files_are_named_by_their_paths() {
    let folder = Folder::new("called");
    folder.write("posts/form.pf", mill("Call part.inc", ""));
    folder.write("posts/part.inc", "Upon [work]\nG91\nEnd\n");
    let github = out(&folder.run(&["lint", "posts/form.pf", "--format", "github"]));
    assert!(github.contains("file=posts/part.inc,line=2"), "{github}");
    // a called file is checked with the form that calls it, even if the name ends with .pf and is on the command line;
    // only a file that no form calls is checked alone
    folder.write("posts/form.pf", mill("Call part.pf", ""));
    folder.write("posts/part.pf", "Leading0s? Y\n");
    let github = out(&folder.run(&["lint", "posts", "--format", "github"]));
    assert!(!github.contains("file=posts/part.pf") && github.contains("file=posts/form.pf"), "{github}");
    let named =
        out(&folder.run(&["lint", "posts/part.pf", "posts/form.pf", "posts/../posts/form.pf", "--format", "github"]));
    assert_eq!(named, github);
    let github = out(&folder.run(&["lint", "posts/part.pf", "--format", "github"]));
    assert!(github.contains("file=posts/part.pf") && github.contains("PF005"), "{github}");
    // a form that calls itself gives one finding
    folder.write("posts/form.pf", mill("Call form.pf", ""));
    let output = folder.run(&["lint", "posts/form.pf", "--format", "github"]);
    assert!(out(&output).contains("title=PF009::`form.pf` is this form itself"), "{}", out(&output));
    assert!(!out(&output).contains("PF004"), "{}", out(&output));
}

#[test]
fn new_forms_are_clean_laid_out_and_print() {
    let folder = Folder::new("new");
    let jobs = ["bracket", "lathe-part", "wire", "plate", "plasma"]
        .map(|name| root().join("samples").join(name).join("job.json"));
    let shipped = std::fs::read_dir(root().join("postforms")).unwrap();
    let mut shipped: Vec<String> =
        shipped.map(|entry| entry.unwrap().path().file_stem().unwrap().to_str().unwrap().to_owned()).collect();
    shipped.sort();
    let short = ["lathe", "edm"].map(str::to_owned);
    for control in shipped.iter().chain(&short).map(String::as_str) {
        let name = format!("{control}.pf");
        assert_eq!(folder.run(&["new", "--control", control, "-o", &name]).status.code(), Some(0));
        let lint = folder.run(&["lint", &name]);
        assert_eq!(out(&lint), "0 errors, 0 warnings, 0 notes\n", "{control}");
        assert_eq!(folder.run(&["fmt", "--check", &name]).status.code(), Some(0), "{control}");
        let text = folder.read(&name);
        let ships = root().join("postforms").join(&name);
        assert!(short.contains(&control.to_owned()) || text == std::fs::read_to_string(ships).unwrap(), "{control}");
        assert!(text.lines().filter(|line| line.starts_with('#')).count() >= 3, "{control} is not commented");
        let job = match control {
            "lathe" | "fanuc-lathe" | "haas-lathe" => &jobs[1],
            "edm" | "wire-edm" => &jobs[2],
            "grbl" | "grblhal" => &jobs[3],
            "plasma" | "laser" => &jobs[4],
            _ => &jobs[0],
        };
        let output = folder.run(&["render", job.to_str().unwrap(), "--form", &name]);
        assert_eq!(output.status.code(), Some(0), "{control}: {}", err(&output));
        assert!(out(&output).lines().count() > 10);
        // an existing file is not replaced
        let again = folder.run(&["new", "--control", control, "-o", &name]);
        assert_eq!((again.status.code(), err(&again).contains("exists already")), (Some(2), true));
    }
    let printed = folder.run(&["new", "--control", "haas"]);
    assert_eq!(out(&printed), folder.read("haas.pf"));
}

#[test]
fn shells_and_manuals() {
    let folder = Folder::new("shells");
    for (shell, part) in [("bash", "_postform()"), ("zsh", "#compdef postform"), ("fish", "complete -c postform")] {
        let output = folder.run(&["completions", shell]);
        assert!(out(&output).contains(part) && out(&output).contains("unsafe-fixes"), "{shell}");
    }
    let page = out(&folder.run(&["man"]));
    for part in [".TH postform 1", "postform render", "unsafe\\-fixes", "\\-\\-control"] {
        assert!(page.contains(part), "{part}\n{page}");
    }
}

/// If there are thousands of findings, only the first are shown with their lines, but all are counted.
#[test]
fn thousands_of_findings_are_counted() {
    let folder = Folder::new("thousands");
    folder.write("f.pf", "Wrong thing\n".repeat(5_000));
    let output = folder.run(&["lint", "f.pf"]);
    let text = out(&output);
    assert_eq!((output.status.code(), text.matches("PF201").count()), (Some(1), 1000));
    assert!(text.contains("\nand 4004 more findings: fix the findings above first\n5004 errors, 0 warnings"), "{text}");
    let all = out(&folder.run(&["lint", "f.pf", "--format", "github"]));
    assert!(all.matches("PF201").count() >= 5_000);
}

#[test]
fn a_property_that_no_form_has_is_misspelt() {
    let folder = Folder::new("properties");
    folder.write("form.pf", mill("Property lift length 1 Lift", ""));
    fs::create_dir_all(folder.0.join("posts")).unwrap();
    folder.write("posts/other.pf", mill("Property through yesno no Coolant", ""));
    folder.write("job.json", support::job("{\"line\":[1,1,0]}"));
    let run = |line: &str| {
        folder.write("postform.toml", format!("form = \"form.pf\"\n[properties]\n{line}\n"));
        folder.run(&["render", "job.json", "--no-verify"])
    };
    let wrong = run("lfit = 2");
    assert!(wrong.status.code() == Some(2) && err(&wrong).contains("did you mean `lift`?"), "{}", err(&wrong));
    for right in ["LIFT = 2", "through = true"] {
        assert_eq!(run(right).status.code(), Some(0), "{right}");
    }
    let twice = run("Lift = 2\nlift = 3");
    assert_eq!(twice.status.code(), Some(2));
    let message = "`Lift` and `lift` under [properties] are the same property";
    assert!(err(&twice).contains(message), "{}", err(&twice));
}

/// The settings for a program are in two files: one near the job, one near the form. If both have a key, the file near
/// the job applies.
#[test]
fn settings_near_the_job_and_near_the_form_both_apply() {
    let folder = Folder::new("two-settings");
    folder.write(
        "posts/form.pf",
        mill("Property lift length 1 Lift\nProperty feed length 7 Feed", "")
            .replace("\nStartCode\n", "\nStartCode\n(LIFT [lift] FEED [feed])\n"),
    );
    folder.write("posts/other.pf", mill("Property through yesno no Coolant", ""));
    folder.write("jobs/job.json", support::job("{\"line\":[1,1,0]}"));
    let run = |of_posts: &str, of_jobs: &str| {
        folder.write("posts/postform.toml", of_posts);
        folder.write("jobs/postform.toml", format!("form = \"../posts/form.pf\"\n{of_jobs}"));
        folder.run(&["render", "jobs/job.json"])
    };
    for (of_posts, of_jobs, printed) in [
        ("", "", "(LIFT 1 FEED 7)"),
        ("[properties]\nlift = 2\n", "", "(LIFT 2 FEED 7)"),
        ("", "[properties]\nlift = 3\nthrough = true\n", "(LIFT 3 FEED 7)"),
        ("[properties]\nlift = 2\nfeed = 4\n", "[properties]\nLift = 3\n", "(LIFT 3 FEED 4)"),
    ] {
        let output = run(of_posts, of_jobs);
        assert!(out(&output).contains(printed), "{of_posts}{of_jobs}: {}{}", out(&output), err(&output));
    }
    // the form is not proven
    for (of_posts, of_jobs) in [("require-proof = true\n", ""), ("", "require-proof = true\n")] {
        let output = run(of_posts, of_jobs);
        assert_eq!((output.status.code(), out(&output)), (Some(1), String::new()), "{}", err(&output));
    }
    for (of_posts, of_jobs, file) in
        [("[properties]\nlfit = 2\n", "", "posts/"), ("", "[properties]\nlfit = 2\n", "jobs/")]
    {
        let output = run(of_posts, of_jobs);
        assert_eq!(output.status.code(), Some(2));
        let said = err(&output);
        assert!(said.contains(&format!("{file}postform.toml: no form in this folder")), "{said}");
        assert!(said.contains("did you mean `lift`?"), "{said}");
    }
}

/// `--job` belongs to `--unsafe-fixes`. Without it, the message names the commands that read a job.
#[test]
fn a_job_without_fixes_names_the_other_commands() {
    let folder = Folder::new("lint-job");
    let fixes = "`postform lint --unsafe-fixes --job part.json";
    for (arguments, form) in [
        (&["--job", "part.json"][..], "FORM"),
        (&["--job", "part.json", "my.pf"], "my.pf"),
        (&["--job", "part.json", "--unsafe-fixes"], "FORM"),
    ] {
        let done = folder.run(&[&["lint"], arguments].concat());
        let text = err(&done);
        assert_eq!(done.status.code(), Some(2), "{text}");
        let verify = format!("`postform verify part.json --form {form}` prints");
        assert!(
            ["`postform check part.json` checks the job", &verify, fixes].iter().all(|part| text.contains(part)),
            "{text}"
        );
    }
    // without --job, a form is still required
    let done = folder.run(&["lint"]);
    assert!(done.status.code() == Some(2) && err(&done).contains("<FORM>"), "{}", err(&done));
}
