//! `postform test`: cases in folders, kept next to a form as users do.

use std::fs;
use std::process::{Command, Output};

use crate::support::folder::{Folder, err, out};
use crate::support::root;

/// A folder with a shipped form and its standard cases.
fn kept(test: &str, form: &str) -> Folder {
    let folder = Folder::new(&format!("cases-{test}"));
    fs::copy(root().join("postforms").join(form), folder.0.join(form)).unwrap();
    let output = folder.run(&["test", "--new", form]);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    folder
}

fn ends(output: &Output, status: i32, last: &str) {
    let said = out(output);
    assert_eq!(output.status.code(), Some(status), "{said}{}", err(output));
    assert_eq!(said.lines().last(), Some(last), "{said}");
}

fn change(folder: &Folder, file: &str, from: &str, to: &str) {
    let path = folder.0.join(file);
    let text = fs::read_to_string(&path).unwrap();
    assert!(text.contains(from), "{file} has no {from}");
    fs::write(path, text.replace(from, to)).unwrap();
}

#[test]
fn the_standard_cases_see_a_change_of_the_form() {
    let folder = kept("change", "haas.pf");
    ends(&folder.run(&["test"]), 0, "56 cases, 1 form: 56 programs, all as expected");
    change(
        &folder,
        "haas.pf",
        "G[retplane] G81 X[h] Y[v] Z[d] R[vclear] F[frate]",
        "G[retplane] G81 X[h] Y[v] R[vclear] Z[d] F[frate]",
    );
    let output = folder.run(&["test"]);
    let said = out(&output);
    assert_eq!(output.status.code(), Some(1));
    for shown in [
        "--- tests/drill/expected.haas.nc\n+++ the program of haas.pf for tests/drill/job.json\n",
        "-N90 G98 G81 X10. Y10. Z-15. R2. F120.\n",
        "+N90 G98 G81 X10. Y10. R2. Z-15. F120.\n",
        "    printed by haas.pf:",
    ] {
        assert!(said.contains(shown), "{shown}: {said}");
    }
    let last = said.lines().last().unwrap();
    assert!(last.starts_with("56 cases, 1 form: 56 programs, ") && last.ends_with(" differ"), "{last}");
    // a different order of words is ignored if postform.toml lists `order` under `ignore`
    folder.write("tests/postform.toml", "[test]\nforms = [\"../haas.pf\"]\nignore = [\"order\", \"spaces\"]\n");
    ends(&folder.run(&["test"]), 0, "56 cases, 1 form: 56 programs, all as expected");
    folder.write("tests/postform.toml", "[test]\nforms = [\"../haas.pf\"]\n");
    // --update shows the differences, then writes the programs
    let output = folder.run(&["test", "--update"]);
    assert!(out(&output).contains("+N90 G98 G81 X10. Y10. R2. Z-15. F120.\n"));
    assert_eq!(output.status.code(), Some(0));
    ends(&folder.run(&["test"]), 0, "56 cases, 1 form: 56 programs, all as expected");
}

#[test]
fn every_form_that_ships_prints_its_standard_cases() {
    let folder = Folder::new("cases-kit");
    for entry in fs::read_dir(root().join("postforms")).unwrap() {
        let form = entry.unwrap().path();
        let name = form.file_stem().unwrap().to_string_lossy().into_owned();
        let output = folder.run(&["test", "--new", form.to_str().unwrap(), &name]);
        assert_eq!(output.status.code(), Some(0), "{name}: {}", err(&output));
        let said = out(&output);
        let counts: Vec<usize> = said.split(|c: char| !c.is_ascii_digit()).filter_map(|n| n.parse().ok()).collect();
        // a job that needs something which the control lacks is refused with a named code
        assert!(counts[counts.len().min(2) - 1] > 0 && !said.contains("PX001"), "{said}");
    }
    let output = folder.run(&["test", "."]);
    let said = out(&output);
    assert_eq!(output.status.code(), Some(0), "{said}{}", err(&output));
    assert!(said.lines().last().unwrap().contains("21 forms") && said.contains("all as expected"), "{said}");
}

/// Whether this line of a form prints words. Such a line begins with a letter that is followed by a number or a
/// variable.
fn is_block(line: &str) -> bool {
    let mut letters = line.trim().chars();
    letters.next().is_some_and(|letter| letter.is_ascii_uppercase())
        && letters.next().is_some_and(|next| next == '[' || next.is_ascii_digit())
}

/// Wrong variants of the line: without the last word, without the first word, and with another typed digit.
fn mistakes(line: &str) -> Vec<String> {
    let words: Vec<&str> = line.split_whitespace().collect();
    let mut list = vec![words[..words.len() - 1].join(" "), words[1..].join(" ")];
    let typed = words.iter().position(|word| word[1..].starts_with(|next: char| next.is_ascii_digit()));
    if let Some(at) = typed {
        let digit = words[at].as_bytes()[1];
        let other = if digit == b'9' { '8' } else { char::from(digit + 1) };
        let changed = format!("{}{other}{}", &words[at][..1], &words[at][2..]);
        let all: Vec<&str> = words.iter().enumerate().map(|(i, word)| if i == at { &changed } else { *word }).collect();
        list.push(all.join(" "));
    }
    list.dedup();
    list
}

/// If a line of a form loses a word or has a wrong digit, the cases that print the line fail, or the proof fails.
#[test]
fn the_standard_cases_see_broken_forms() {
    let most: usize = std::env::var("BROKEN").map_or(2, |count| count.parse().unwrap());
    for form in ["haas.pf", "siemens.pf", "fanuc-lathe.pf"] {
        let folder = kept(&format!("broken-{form}"), form);
        let whole = fs::read_to_string(folder.0.join(form)).unwrap();
        let coverage = folder.run(&["test", "--coverage", "--format", "json"]);
        let report: serde_json::Value = serde_json::from_str(&out(&coverage)).unwrap();
        let missing: Vec<usize> = report["coverage"][0]["missing"]
            .as_array()
            .unwrap()
            .iter()
            .map(|line| usize::try_from(line["line"].as_u64().unwrap()).unwrap())
            .collect();
        let lines: Vec<&str> = whole.lines().collect();
        let begins = lines.iter().position(|line| line.trim() == "StartCode").unwrap_or(0);
        let printed = (begins..lines.len()).filter(|at| is_block(lines[*at]) && !missing.contains(&(at + 1)));
        // a selection from all lines, not only the first ones
        let all: Vec<(usize, String)> =
            printed.flat_map(|at| mistakes(lines[at]).into_iter().map(move |broken| (at, broken))).collect();
        let (mut tried, mut unseen) = (0, Vec::new());
        for (at, broken) in all.iter().step_by((all.len() / most).max(1)).take(most) {
            let mut text = lines.clone();
            text[*at] = broken;
            fs::write(folder.0.join(form), text.join("\n") + "\n").unwrap();
            tried += 1;
            // if a tool change does not print the coolant, postform prints it before the first cut, so this mistake has
            // no effect
            let is_said_again = lines[*at].trim() == "M[cool]";
            if folder.run(&["test", "--format", "json"]).status.code() == Some(0) && !is_said_again {
                unseen.push(format!("{form}:{}: `{}` became `{broken}`", at + 1, lines[*at]));
            }
        }
        println!("{form}: {tried} mistakes, {} not seen", unseen.len());
        assert!(tried == most && unseen.is_empty(), "{unseen:#?}");
    }
}

#[test]
fn what_can_be_no_case_is_a_problem_and_stops_no_other() {
    let folder = kept("problems", "haas.pf");
    folder.write("tests/drill/expected.mill.nc", "%\n");
    folder.write("tests/alone/job.json", r#"{"postform": 1, "units": "mm", "operations": []}"#);
    folder.write("tests/cut-short/job.json", "{\"postform\": 1, \"units\": \"mm\", ");
    folder.write("tests/cut-short/expected.haas.nc", "%\n");
    folder.write("tests/helix/expected.haas.nc", "\u{0}\u{1b}[2J\n");
    let output = folder.run(&["test"]);
    let said = out(&output);
    assert_eq!(output.status.code(), Some(1), "{said}");
    for shown in [
        "tests/drill/expected.mill.nc: there is no form called mill\n  help: add its file to forms under [test] in \
         tests/postform.toml, or give it with --form",
        "tests/alone/job.json has no expected program in its folder",
        "tests/cut-short/expected.haas.nc by haas.pf:\n",
        "--- tests/helix/expected.haas.nc\n",
    ] {
        assert!(said.contains(shown), "{shown}: {said}");
    }
    assert!(!said.contains('\u{1b}'), "{said}");
    assert!(
        said.lines().last().unwrap().starts_with("57 cases, 1 form: 57 programs, 1 differs, 1 failed; 2 problems"),
        "{said}"
    );
}

#[test]
fn an_error_may_be_what_is_expected() {
    let folder = kept("refused", "haas.pf");
    assert_eq!(fs::read_to_string(folder.0.join("tests/subprogram/expected.haas.refused")).unwrap(), "PR008\n");
    folder.write("tests/subprogram/expected.haas.refused", "PR010 another\n");
    let output = folder.run(&["test", "tests/subprogram"]);
    assert!(out(&output).contains("PR008"), "{}", out(&output));
    ends(&output, 1, "1 case, 1 form: 1 program, 1 failed");
    // an expected program is kept even if the form now refuses the job
    fs::remove_file(folder.0.join("tests/subprogram/expected.haas.refused")).unwrap();
    folder.write("tests/subprogram/expected.haas.nc", "%\n");
    ends(&folder.run(&["test", "tests/subprogram", "--update"]), 1, "1 case, 1 form: 1 program, 1 failed");
    assert_eq!(fs::read_to_string(folder.0.join("tests/subprogram/expected.haas.nc")).unwrap(), "%\n");
    // an expected refusal is replaced by the program that is now printed
    fs::remove_file(folder.0.join("tests/drill/expected.haas.nc")).unwrap();
    folder.write("tests/drill/expected.haas.refused", "PR008\n");
    ends(&folder.run(&["test", "tests/drill"]), 1, "1 case, 1 form: 1 program, 1 failed");
    ends(&folder.run(&["test", "tests/drill", "--update"]), 0, "1 case, 1 form: 1 program, 1 written");
    assert!(!folder.0.join("tests/drill/expected.haas.refused").exists());
    ends(&folder.run(&["test", "tests/drill"]), 0, "1 case, 1 form: 1 program, all as expected");
}

#[test]
fn forms_and_jobs_of_any_kind() {
    let folder = Folder::new("cases-kinds");
    for form in ["fanuc.pf", "linuxcnc.pf"] {
        fs::copy(root().join("postforms").join(form), folder.0.join(form)).unwrap();
    }
    let job = |name: &str| fs::read_to_string(root().join("samples").join(name)).unwrap();
    folder.write("parts/bracket.json", job("bracket/job.json"));
    folder.write("parts/drill.cl", job("cl-drill/job.cl"));
    folder.write("parts/package.json", "{\"name\": \"no job\"}");
    let output = folder.run(&["test", "parts", "--update", "--form", "fanuc.pf", "--form", "linuxcnc.pf"]);
    ends(&output, 0, "2 cases, 2 forms: 4 programs, 4 written");
    assert!(folder.0.join("parts/drill.expected.linuxcnc.nc").is_file());
    folder.write("parts/postform.toml", "[test]\nforms = [\"..\"]\n");
    ends(&folder.run(&["test", "parts", "--jobs", "1"]), 0, "2 cases, 2 forms: 4 programs, all as expected");
    ends(&folder.run(&["test", "parts/drill.cl"]), 0, "1 case, 2 forms: 2 programs, all as expected");
    ends(&folder.run(&["test", "parts", "--form", "fanuc.pf"]), 0, "2 cases, 1 form: 2 programs, all as expected");
    // the cases of a form with an error fail; the cases of other forms do not
    folder.write("fanuc.pf", "Machine Mill\nNonsense\n");
    let output = folder.run(&["test", "parts"]);
    assert!(out(&output).contains("fanuc.pf has errors"), "{}", out(&output));
    ends(&output, 1, "2 cases, 2 forms: 4 programs, 2 failed");
}

#[test]
fn reports_for_programs() {
    let folder = kept("reports", "haas.pf");
    change(&folder, "tests/drill/expected.haas.nc", "Z-15.", "Z-16.");
    let json = folder.run(&["test", "--format", "json"]);
    let report: serde_json::Value = serde_json::from_str(&out(&json)).unwrap();
    let programs = report["programs"].as_array().unwrap();
    assert_eq!((programs.len(), json.status.code()), (56, Some(1)));
    let drill = programs.iter().find(|row| row["expected"] == "tests/drill/expected.haas.nc").unwrap();
    assert_eq!((&drill["result"], &drill["line"]), (&serde_json::json!("differs"), &serde_json::json!(12)));
    assert_eq!(report["summary"], "56 cases, 1 form: 56 programs, 1 differs");
    let junit = out(&folder.run(&["test", "--format", "junit"]));
    assert!(
        junit.starts_with(
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuite name=\"postform\" tests=\"56\" failures=\"1\">"
        ),
        "{junit}"
    );
    assert_eq!(junit.matches("<testcase ").count(), 56);
    assert_eq!(junit.matches("<failure ").count(), 1);
    let marks = out(&folder.run(&["test", "--format", "github"]));
    assert!(marks.starts_with("::error file=tests/drill/expected.haas.nc,line=12::"), "{marks}");
    assert_eq!(marks.lines().count(), 1);
}

/// A form is read more than once, so it can't come from a pipe.
#[cfg(unix)]
#[test]
fn a_form_from_a_pipe_is_refused() {
    let folder = Folder::new("cases-pipe");
    let pipe = folder.0.join("pipe.pf");
    assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    folder.write("postform.toml", "[test]\nforms = [\"pipe.pf\"]\n");
    folder.write("a/job.json", "{}");
    for arguments in [&["test", "--form", "pipe.pf", "a"][..], &["test", "--new", "pipe.pf"], &["test", "a"]] {
        // ends the wait of a reader, so that the test can't wait forever
        let mut writer = Command::new("sh").args(["-c", "echo > \"$0\""]).arg(&pipe).spawn().unwrap();
        let output = folder.run(arguments);
        writer.kill().unwrap();
        writer.wait().unwrap();
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(err(&output).contains("can't read pipe.pf: it is not a regular file"), "{}", err(&output));
    }
}

#[test]
fn a_folder_without_cases_says_what_one_is() {
    let folder = Folder::new("cases-none");
    for arguments in
        [&["test"][..], &["test", "nowhere"], &["test", "--new", "nowhere.pf"], &["test", "--form", "nowhere.pf"]]
    {
        let output = folder.run(arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(out(&output).is_empty() && err(&output).starts_with("error: "), "{arguments:?}: {}", err(&output));
    }
    assert!(err(&folder.run(&["test"])).contains("`postform test --new FORM` writes the standard cases"));
    folder.write("postform.toml", "[test]\nignore = [\"everything\"]\n");
    folder.write("job.json", "{\"postform\": 1}");
    let said = err(&folder.run(&["test", "."]));
    assert!(said.contains("ignore under [test]: --ignore has no value `everything`"), "{said}");
    assert!(!folder.has("tests"));
}

#[test]
fn an_expected_program_without_its_job_is_a_problem() {
    let folder = kept("orphans", "haas.pf");
    fs::remove_file(folder.0.join("tests/drill/job.json")).unwrap();
    folder.write("tests/arcs/job.json", "");
    folder.write("tests/helix/job.json", r#"{"a": 1}"#);
    folder.write("tests/lines/part.expected.haas.nc", "%\n");
    let output = folder.run(&["test"]);
    let said = out(&output);
    assert_eq!(output.status.code(), Some(1), "{said}");
    for shown in [
        "tests/drill/expected.haas.nc has no job: there is no job in its folder",
        "tests/lines/part.expected.haas.nc has no job: there is no part in its folder",
        "tests/arcs/expected.haas.nc by haas.pf:\nPJ007",
        "tests/helix/expected.haas.nc by haas.pf:\nPJ",
    ] {
        assert!(said.contains(shown), "{shown}: {said}");
    }
    assert!(said.lines().last().unwrap().starts_with("55 cases, 1 form: 55 programs, 2 failed; 2 problems"), "{said}");
}

/// A broken job, or a program with other motions than its job, is never written as an expected result.
#[test]
fn what_is_wrong_can_not_be_expected() {
    let folder = Folder::new("cases-wrong");
    let form = fs::read_to_string(root().join("postforms/haas.pf")).unwrap();
    folder.write("lost.pf", form.replace("G43 H[lcomp] Z[d]", "Z[d]"));
    let output = folder.run(&["test", "--new", "lost.pf"]);
    let said = out(&output);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(
        said.contains("lost.pf prints programs of these jobs that are different from the job:\n  arc-in-xz: PV014"),
        "{said}"
    );
    assert!(!folder.has("tests/drill/expected.lost.refused") && !folder.has("tests/drill/expected.lost.nc"));
    folder.write("tests/drill/expected.lost.refused", "PV014\n");
    let output = folder.run(&["test", "tests/drill"]);
    assert!(out(&output).contains("PV014 can't be an expected result"), "{}", out(&output));
    assert_eq!(output.status.code(), Some(1));
    folder.write("haas.pf", form);
    folder.write("cut/job.json", "{\"postform\": 1, ");
    ends(&folder.run(&["test", "cut", "--update", "--form", "haas.pf"]), 1, "1 case, 1 form: 1 program, 1 failed");
    assert!(!folder.has("cut/expected.haas.refused"));
}

/// Only errors that the form or the machine causes are expected results. Errors of the job are not, in any format.
#[test]
fn a_damaged_job_is_no_expected_result() {
    let folder = Folder::new("cases-damaged");
    fs::copy(root().join("postforms/haas.pf"), folder.0.join("haas.pf")).unwrap();
    let begin_of = |file: &str, bytes: usize| fs::read(root().join(file)).unwrap()[..bytes].to_vec();
    for (job, bytes, code) in [
        ("job.cl", begin_of("samples/cl-drill/job.cl", 150), "PL001"),
        ("job.FCStd", begin_of("tests/data/freecad/holes-1.1.FCStd", 3000), "PD001"),
        ("job.nc", b"%\nO1\nG21 G90 G54\nT1 M6\nS1000 M3\nG43 H1 Z5.\nG0 X0 Y0\nG1 Z-1. F100\nG2 X1.\n".to_vec(), "PN"),
        // the units of this file are an option of the command
        ("job.nci", fs::read(root().join("tests/data/nci/holes-and-arcs.nci")).unwrap(), "PI002"),
        (
            "job.json",
            fs::read_to_string(root().join("crates/postform-cli/cases/mill/countersink.json"))
                .unwrap()
                .replace("\"diameter\": 4", "\"diameter\": 8")
                .into_bytes(),
            "the hole has a depth of 2, but its `diameter` and `angle` give 4\n",
        ),
    ] {
        _ = fs::remove_dir_all(folder.0.join("cases"));
        folder.write(&format!("cases/{job}"), bytes);
        let output = folder.run(&["test", "cases", "--update", "--form", "haas.pf"]);
        let said = out(&output);
        assert!(said.contains(code), "{job}: {said}");
        ends(&output, 1, "1 case, 1 form: 1 program, 1 failed");
        assert!(!folder.has("cases/expected.haas.refused"), "{job}");
        // a file written by hand changes nothing
        let reported = said.lines().nth(1).and_then(|line| line.split(' ').next()).unwrap();
        folder.write("cases/expected.haas.refused", reported);
        let output = folder.run(&["test", "cases", "--form", "haas.pf"]);
        let message = format!("{reported} can't be an expected result");
        assert!(out(&output).contains(&message), "{job}: {}", out(&output));
        ends(&output, 1, "1 case, 1 form: 1 program, 1 failed");
    }
}

/// Two forms with one name would have the same expected programs, so that only one of them would be tested.
#[test]
fn two_forms_with_one_name_are_an_error() {
    let folder = Folder::new("cases-names");
    for form in ["one/main.pf", "two/main.pf"] {
        folder.write(form, fs::read_to_string(root().join("postforms/haas.pf")).unwrap());
    }
    folder.write("tests/job.json", fs::read_to_string(root().join("samples/bracket/job.json")).unwrap());
    ends(&folder.run(&["test", "--update", "--form", "one"]), 0, "1 case, 1 form: 1 program, 1 written");
    let both = "error: one/main.pf and two/main.pf would have the same expected programs: expected.main.nc\n";
    folder.write("tests/postform.toml", "[test]\nforms = [\"../one\", \"../two/main.pf\"]\n");
    for arguments in [
        &["test"][..],
        &["test", "--form", "one/main.pf", "--form", "two/main.pf"],
        &["test", "--update", "--form", "one", "--form", "two"],
    ] {
        let output = folder.run(arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {}", out(&output));
        assert!(err(&output).contains(both), "{arguments:?}: {}", err(&output));
    }
    // the same form, named twice, is one form
    folder.write("tests/postform.toml", "[test]\nforms = [\"../one\", \"../one/main.pf\"]\n");
    ends(&folder.run(&["test"]), 0, "1 case, 1 form: 1 program, all as expected");
}

#[test]
fn a_post_of_several_is_named_in_the_file_or_on_the_command_line() {
    let folder = Folder::new("cases-post");
    let dry = fs::read_to_string(root().join("postforms/haas.pf")).unwrap();
    let begin = dry.find("Name ").unwrap();
    let end = dry[begin..].find('\n').unwrap() + begin;
    let named = |name: &str| format!("Name {name}{}", &dry[end..]);
    folder.write("two.pf", named("Mill dry") + &named("Mill wet").replace("M30", "M2"));
    folder.write("cases/job.json", fs::read_to_string(root().join("samples/bracket/job.json")).unwrap());
    let output = folder.run(&["test", "cases", "--update", "--form", "two.pf"]);
    assert!(out(&output).contains("choose one with `--post \"Mill dry\"`"), "{}", out(&output));
    assert_eq!(output.status.code(), Some(1));
    let wet = ["test", "cases", "--update", "--form", "two.pf", "--post", "Mill wet"];
    ends(&folder.run(&wet), 0, "1 case, 1 form: 1 program, 1 written");
    assert!(folder.read("cases/expected.two.nc").contains(" M2\n"));
    folder.write("cases/postform.toml", "[test]\nforms = [\"../two.pf\"]\npost = \"Mill wet\"\n");
    for arguments in [&["test", "cases"][..], &["test", "cases", "--form", "two.pf"]] {
        ends(&folder.run(arguments), 0, "1 case, 1 form: 1 program, all as expected");
    }
    let output = folder.run(&["test", "cases", "--post", "Mill dry"]);
    ends(&output, 1, "1 case, 1 form: 1 program, 1 differs");
    let output = folder.run(&["test", "--new", "two.pf", "--post", "Mill wet"]);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    assert_eq!(folder.read("tests/postform.toml"), "[test]\nforms = [\"../two.pf\"]\npost = \"Mill wet\"\n");
    ends(&folder.run(&["test"]), 0, "56 cases, 1 form: 56 programs, all as expected");
}

/// A FreeCAD document contains no program number, and an NC program may contain none. These jobs get the number 1.
#[test]
fn a_job_without_a_program_number_gets_one() {
    let folder = Folder::new("cases-numbers");
    fs::copy(root().join("postforms/haas.pf"), folder.0.join("haas.pf")).unwrap();
    let program = |number: &str| {
        format!(
            "%\n{number}G21 G17 G90 G54\nT1 M6\nS1000 M3\nG0 X0 Y0\nG43 H1 Z5.\nG1 Z-1. F100.\nG1 X10.\nG0 Z5.\nM30\n%\n"
        )
    };
    let freecad = fs::read(root().join("tests/data/freecad/holes-1.1.FCStd")).unwrap();
    for (job, bytes, number) in [
        ("job.FCStd", freecad, "O00001"),
        ("job.nc", program("").into_bytes(), "O00001"),
        ("job.nc", program("O77\n").into_bytes(), "O00077"),
    ] {
        _ = fs::remove_dir_all(folder.0.join("cases"));
        folder.write(&format!("cases/{job}"), bytes);
        let output = folder.run(&["test", "cases", "--update", "--form", "haas.pf"]);
        ends(&output, 0, "1 case, 1 form: 1 program, 1 written");
        let program = folder.read("cases/expected.haas.nc");
        assert!(program.contains(number), "{job}: {program}");
    }
}

/// As in `render`, a program that does not fit into the machine is refused, whichever file names the machine.
#[test]
fn a_program_must_fit_into_the_machine() {
    let folder = Folder::new("cases-machine");
    let form = fs::read_to_string(root().join("postforms/haas.pf")).unwrap();
    folder.write("posts/short.toml", "name = \"short\"\nunits = \"mm\"\n[axes.X]\ntravel = [-10.0, 0.0]\n");
    folder.write("jobs/job.json", fs::read_to_string(root().join("samples/bracket/job.json")).unwrap());
    let of_form = form.replace("\nControl haas\n", "\nControl haas\nMachineFile short.toml\n");
    for (form, of_posts, of_jobs) in [
        (of_form.as_str(), "", ""),
        (&form, "machine = \"short.toml\"\n", ""),
        (&form, "", "machine = \"../posts/short.toml\"\n"),
    ] {
        folder.write("posts/haas.pf", form);
        folder.write("posts/postform.toml", of_posts);
        folder.write("jobs/postform.toml", of_jobs);
        _ = fs::remove_file(folder.0.join("jobs/expected.haas.refused"));
        let test = ["test", "jobs", "--form", "posts/haas.pf"];
        let output = folder.run(&[&test[..], &["--update"]].concat());
        ends(&output, 0, "1 case, 1 form: 1 program, 1 written");
        assert_eq!(folder.read("jobs/expected.haas.refused"), "PM001\n");
        assert!(out(&output).contains("PM001 at jobs/job.json:48:9, operations[1].path[4]"), "{}", out(&output));
        ends(&folder.run(&test), 0, "1 case, 1 form: 1 program, all as expected");
        let render = folder.run(&["render", "jobs/job.json", "--form", "posts/haas.pf"]);
        assert_eq!((render.status.code(), out(&render)), (Some(1), String::new()));
    }
}

/// The properties of the form come from both postform.toml, as in `render`. Forms of several folders are counted once.
#[test]
fn cases_in_folders_with_settings_of_their_own() {
    let folder = Folder::new("cases-settings");
    fs::copy(root().join("postforms/haas.pf"), folder.0.join("haas.pf")).unwrap();
    for (name, header) in [("plain", ""), ("bare", "[properties]\nheader = false\n")] {
        folder.write(&format!("{name}/job.json"), fs::read_to_string(root().join("samples/bracket/job.json")).unwrap());
        folder.write(&format!("{name}/postform.toml"), format!("{header}[test]\nforms = [\"../haas.pf\"]\n"));
    }
    let output = folder.run(&["test", "plain", "bare", "--update", "--form", "haas.pf"]);
    ends(&output, 0, "2 cases, 1 form: 2 programs, 2 written");
    let lengths = ["plain", "bare"].map(|name| folder.read(&format!("{name}/expected.haas.nc")).len());
    assert!(lengths[1] < lengths[0], "{lengths:?}");
    let output = folder.run(&["test", "plain", "bare", "--coverage"]);
    assert_eq!(out(&output).matches("the cases print").count(), 1, "{}", out(&output));
    ends(&output, 0, "2 cases, 1 form: 2 programs, all as expected");
}

#[test]
fn the_file_of_the_cases_says_day_post_and_proof() {
    let folder = Folder::new("cases-file");
    let form = fs::read_to_string(root().join("postforms/haas.pf")).unwrap();
    folder.write("haas.pf", form.replace("  (MATERIAL [material])", "  (DATE [date] [time])"));
    assert_eq!(folder.run(&["test", "--new", "haas.pf"]).status.code(), Some(0));
    assert!(folder.read("tests/drill/expected.haas.nc").contains("(DATE 2000-01-01 00:00)"));
    folder.write("tests/postform.toml", "[test]\nforms = [\"../haas.pf\"]\ndate = \"2026-03-31\"\n");
    assert!(out(&folder.run(&["test", "tests/drill"])).contains("(DATE 2026-03-31 )"));
    for (line, message) in [
        ("date = \"tomorrow\"", "date = \"tomorrow\" under [test]: write a date"),
        ("tolerance = -1.0", "tolerance = -1 under [test]: it must be 0 or more"),
        ("post = \"Mill wet\"", "Mill wet"),
    ] {
        folder.write("tests/postform.toml", format!("[test]\nforms = [\"../haas.pf\"]\n{line}\n"));
        let output = folder.run(&["test", "tests/drill"]);
        assert_ne!(output.status.code(), Some(0));
        assert!((err(&output) + &out(&output)).contains(message), "{line}: {}{}", err(&output), out(&output));
    }
    folder.write("tests/postform.toml", "[test]\nforms = [\"../none.pf\"]\n");
    let said = err(&folder.run(&["test"]));
    assert!(said.contains("none.pf") && said.contains("tests/postform.toml names this form under [test]"), "{said}");
}

/// A program that calls its own subprograms is proven from a file, as in `render`. A program that is not proven is
/// reported with the reason.
#[test]
fn what_is_not_proven_is_named() {
    let folder = kept("unproven", "siemens.pf");
    let said = out(&folder.run(&["test"]));
    assert_eq!(said, "56 cases, 1 form: 56 programs, all as expected\n");
    change(&folder, "siemens.pf", "Control siemens", "Control siemens-iso");
    let said = out(&folder.run(&["test", "tests/lines"]));
    let why =
        "not proven: tests/lines/expected.siemens.nc by siemens.pf: the program is in the language of Siemens controls";
    assert!(said.contains(why), "{said}");
    // the postform.toml near the form requires a proof
    folder.write("postform.toml", "require-proof = true\n");
    let output = folder.run(&["test", "tests/lines"]);
    assert!(out(&output).contains("postform.toml requires a proof"), "{}", out(&output));
    assert_eq!(output.status.code(), Some(1));
}

#[test]
fn a_second_form_is_added_by_hand() {
    let folder = kept("second", "haas.pf");
    for form in ["siemens.pf", "fanuc-lathe.pf"] {
        fs::copy(root().join("postforms").join(form), folder.0.join(form)).unwrap();
    }
    let said = out(&folder.run(&["test", "--new", "siemens.pf"]));
    assert!(
        said.contains("tests/postform.toml existed already: add \"../siemens.pf\" to its forms under [test]"),
        "{said}"
    );
    folder.write("tests/postform.toml", "[test]\nforms = [\"../haas.pf\", \"../siemens.pf\"]\n");
    ends(&folder.run(&["test"]), 0, "56 cases, 2 forms: 112 programs, all as expected");
    // a lathe has jobs with the same names
    let said = out(&folder.run(&["test", "--new", "fanuc-lathe.pf"]));
    assert!(
        said.contains(
            "other jobs with these names exist and are kept; no expected programs were written for them:\n  arcs\n"
        ),
        "{said}"
    );
    assert!(!folder.has("tests/arcs/expected.fanuc-lathe.refused"));
}

#[test]
fn what_differs_alone_is_said() {
    let folder = kept("alone", "haas.pf");
    let path = folder.0.join("tests/drill/expected.haas.nc");
    let program = fs::read_to_string(&path).unwrap();
    fs::write(&path, program.replace('\n', "\r\n")).unwrap();
    assert!(out(&folder.run(&["test", "tests/drill"])).contains("only spaces or line ends differ\n"));
    // if the form prints an additional block, the changed block numbers after it are not shown as differences
    fs::write(&path, program).unwrap();
    change(&folder, "haas.pf", "G[unitmode] G17 G40 G49 G80 G90\n", "G[unitmode] G17 G40 G49 G80 G90\nG64\n");
    let said = out(&folder.run(&["test", "tests/drill"]));
    assert_eq!(said.lines().filter(|line| line.starts_with('-') || line.starts_with('+')).count(), 3, "{said}");
    // a form with an error is reported once
    folder.write("haas.pf", "Machine Mill\nNonsense\n");
    let said = out(&folder.run(&["test"]));
    assert_eq!(said.matches("haas.pf has errors").count(), 1, "{said}");
    assert!(said.contains("none of the 56 programs of this form is printed\n") && said.contains("Nonsense"), "{said}");
}

/// An expected program that is a pipe or a device may never end, so it is not read.
#[cfg(unix)]
#[test]
fn an_expected_program_is_a_regular_file() {
    let folder = kept("special", "haas.pf");
    let expected = folder.0.join("tests/drill/expected.haas.nc");
    fs::remove_file(&expected).unwrap();
    std::os::unix::fs::symlink("/dev/zero", &expected).unwrap();
    let output = folder.run(&["test"]);
    let shown = out(&output) + &err(&output);
    assert!(shown.contains("expected.haas.nc: it is not a regular file"), "{shown}");
    assert_eq!(output.status.code(), Some(1), "{shown}");
}
