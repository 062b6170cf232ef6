//! `simulate` and `verify` as commands: exit status, streams, and files that are not programs.

use std::fs;
use std::io::Write;
use std::process::{Command, Output, Stdio};

use crate::support::{job, mill, root};

pub fn postform(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_postform")).args(arguments).current_dir(root()).output().unwrap()
}

pub fn fed(arguments: &[&str], input: &[u8]) -> Output {
    let mut child = Command::new(env!("CARGO_BIN_EXE_postform"))
        .args(arguments)
        .current_dir(root())
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    child.stdin.take().unwrap().write_all(input).unwrap();
    child.wait_with_output().unwrap()
}

pub fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

#[test]
fn a_program_for_a_lathe_asks_which_one() {
    let program = b"G21\nT0101\nG97 S800 M3\nG0 X50. Z2.\nG1 Z-20. R2. F.2\nX60.\nM30\n";
    let refused = fed(&["simulate", "-"], program);
    assert_eq!(refused.status.code(), Some(1));
    let message = text(&refused.stderr);
    assert!(message.contains("the program is for a lathe, but no lathe control is named"), "{message}");
    assert!(message.contains("`--control fanuc-lathe` or `haas-lathe`"), "{message}");
    // X is shown as in the program: a diameter
    let run = fed(&["simulate", "-", "--control", "fanuc-lathe"], program);
    let shown = "     1  units   mm\n     2  tool    1\n     3  spindle cw S800\n     4  rapid   X50 Z2\n     5  feed    X50 Z-18 F0.2\n\
        \u{20}    5  cw      X54 Z-20 F0.2  centre X54 Z-18 in zx\n     6  feed    X60 Z-20 F0.2\n     7  end\n";
    assert_eq!((text(&run.stdout), run.status.code()), (shown.to_owned(), Some(0)));
}

#[test]
fn the_name_of_a_program_says_its_control() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("PART.MPF");
    fs::write(&file, "G0 X=10 Y=5\nM30\n").unwrap();
    let file = file.to_str().unwrap();
    for arguments in [
        &["simulate", file][..],
        &["diff", "--motion", file, file],
        &["fit", file, "--machine", "tests/data/machines/vf2.toml"],
    ] {
        let output = postform(arguments);
        assert!(!text(&output.stderr).contains("PN0"), "{arguments:?}: {}", text(&output.stderr));
    }
    assert_eq!(postform(&["simulate", file, "--control", "fanuc"]).status.code(), Some(1));
}

#[test]
fn exit_status_and_streams_of_simulate() {
    let program = b"%\nG21 G90 G0 X1. Y2.\nM30\n%\n";
    let clean = fed(&["simulate", "-"], program);
    assert_eq!(clean.status.code(), Some(0));
    assert_eq!(text(&clean.stdout), "     2  units   mm\n     2  rapid   X1 Y2 Z0\n     3  end\n");
    assert!(clean.stderr.is_empty());
    // the actions before the refusal are printed, and the refusal is the last object
    let refused = fed(&["simulate", "-", "--format", "json"], b"G21\nG0 X1.\nG0 X#7\nM30\n");
    assert_eq!(refused.status.code(), Some(1));
    let lines: Vec<serde_json::Value> =
        text(&refused.stdout).lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert_eq!(lines[1]["rapid"], serde_json::json!([1, 0, 0, 0, 0, 0]));
    assert_eq!((&lines[2]["line"], &lines[2]["error"]), (&serde_json::json!(3), &serde_json::json!("PN016")));
    assert!(text(&refused.stderr).contains("standard input:3:"), "{}", text(&refused.stderr));
    for (arguments, status) in [
        (&["simulate", "no-such-file.nc"][..], 2),
        (&["simulate", "samples"], 2),
        (&["simulate", "samples/bracket/expected.fanuc.nc", "--control", "hurco"], 2),
        (&["simulate", "samples/bracket/expected.fanuc.nc", "--back-off", "-1"], 2),
        (&["simulate"], 2),
        (&["verify", "samples/bracket/job.json"], 2),
        (&["verify", "-", "--nc", "-"], 2),
        (&["verify", "no.json", "--form", "postforms/haas.pf"], 2),
        (&["verify", "samples/bracket/job.json", "--nc", "no.nc"], 2),
        (&["render", "samples/bracket/job.json", "--form", "postforms/haas.pf", "--verify", "--stream"], 2),
        (&["render", "samples/bracket/job.json", "--form", "postforms/haas.pf", "--job-control", "fanuc"], 2),
    ] {
        let output = postform(arguments);
        assert_eq!(output.status.code(), Some(status), "{arguments:?}: {}", text(&output.stderr));
        assert!(!output.stderr.is_empty() && output.stdout.is_empty(), "{arguments:?}");
    }
    let empty = fed(&["simulate", "-"], b"");
    assert_eq!(empty.status.code(), Some(1));
    assert!(text(&empty.stderr).contains("incomplete"));
}

/// Control characters in a program are never sent to a terminal. A comment may contain any characters.
#[test]
fn programs_are_shown_safely() {
    let output = fed(&["simulate", "-"], b"G21 (\x1b[31mred \xff)\nG0 X1. \x1b[2J\nM30\n");
    assert_eq!(output.status.code(), Some(1));
    assert!(!output.stdout.contains(&0x1b) && !output.stderr.contains(&0x1b), "{}", text(&output.stderr));
}

/// C0, C1, marks of bidirectional text and line separators are shown as escapes, from files of every kind.
#[test]
#[cfg(target_os = "linux")]
fn nothing_from_a_file_steers_the_terminal() {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("steering");
    _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(folder.join("toml")).unwrap();
    let evil = "\u{1b}]0;a\u{7}\u{9b}31m\u{202e}\u{2066}\u{2028}\r\u{7f}";
    let named = job("{\"line\":[1,1,0]}").replacen("\"program\"", "\"name\":\"A\u{202e}\u{9b}B\",\"program\"", 1);
    let odd = format!("{evil}.pf");
    for (name, text) in [
        ("form.pf", mill("", &format!("Drill\nG81 X[h] {evil}Y[v]\nEnd\n"))),
        ("job.json", named),
        (odd.as_str(), mill("Rapdi G0", "")),
        ("a.nc", format!("G21\nG0 X1. ({evil})\nG1 X5. F100. ({evil})\nM30\n")),
        ("b.nc", format!("G21\nG0 X2. ({evil})\nG1 X6. F100. ({evil})\nM30\n")),
        ("toml/postform.toml", "\"a\u{9b}\\u001b\\u202e\" = 1\n".to_owned()),
        ("toml/form.pf", mill("", "")),
        ("postform.toml", String::new()),
    ] {
        fs::write(folder.join(name), text).unwrap();
    }
    let run = |arguments: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_postform"));
        command.args(arguments).current_dir(&folder).output().unwrap()
    };
    for arguments in [
        &["lint", "form.pf"][..],
        &["lint", "form.pf", "--format", "json"],
        &["lint", "form.pf", "--format", "sarif"],
        &["lint", "form.pf", "--format", "github"],
        &["lint", odd.as_str()],
        &["lint", "toml/form.pf"],
        &["check", "job.json"],
        &["diff", "a.nc", "b.nc"],
        &["diff", "a.nc", "b.nc", "--layout", "side"],
        &["diff", "a.nc", "b.nc", "--format", "json"],
        &["diff", "a.nc", "b.nc", "--format", "html"],
        &["diff", "a.nc", "b.nc", "--motion"],
        &["simulate", "a.nc"],
        &["explain", evil],
        &["diff", "a.nc", "b.nc", "--ignore", evil],
        &["render", "job.json", "--form", "toml/form.pf", "--set", evil],
    ] {
        let output = run(arguments);
        for stream in [&output.stdout, &output.stderr] {
            let shown = String::from_utf8(stream.clone()).unwrap();
            let steering = shown.chars().find(|&c| c != '\n' && postform::internals::terminal::steers(c));
            assert_eq!(steering, None, "{arguments:?}: {shown:?}");
        }
        assert!(!output.stdout.is_empty() || !output.stderr.is_empty(), "{arguments:?}");
    }
    // after JSON is parsed, the text is unchanged
    let json = run(&["diff", "a.nc", "b.nc", "--format", "json"]).stdout;
    let json = serde_json::from_slice::<serde_json::Value>(&json).unwrap().to_string();
    assert!(json.contains('\u{202e}') && json.contains('\u{9b}'), "{json}");
    // a line of a form is shown with escapes
    let shown = text(&run(&["lint", "form.pf"]).stdout);
    assert!(shown.contains("\\u{1b}]0;a\\u{7}\\u{9b}31m\\u{202e}"), "{shown}");
}

#[test]
fn a_closed_pipe_is_no_error() {
    let mut program = String::from("G21\n");
    for i in 0..50_000 {
        program += &format!("G0 X{i}.\n");
    }
    program += "M30\n";
    let path = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("long.nc");
    fs::write(&path, program).unwrap();
    let mut child = Command::new(env!("CARGO_BIN_EXE_postform"))
        .arg("simulate")
        .arg(&path)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!((output.status.code(), text(&output.stderr)), (Some(0), String::new()));
}

#[test_with::path(/dev/full)]
#[test]
fn a_full_disk_is_an_error_of_simulate() {
    let path = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("full.nc");
    fs::write(&path, "G21\nG0 X1.\nM30\n").unwrap();
    let full = fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_postform")).arg("simulate").arg(&path).stdout(full).output().unwrap();
    assert_eq!(output.status.code(), Some(2), "{}", text(&output.stderr));
    assert!(text(&output.stderr).contains("can't write"));
}

/// The format of a job from standard input is found by its first bytes, as for a file without a known extension.
#[test]
fn a_job_from_standard_input_may_have_any_format() {
    for (name, form, more) in [
        ("samples/cl-drill/job.cl", "postforms/haas.pf", &["--program", "5"][..]),
        ("samples/bracket/job.json", "postforms/haas.pf", &[]),
        (
            "samples/bracket/expected.haas.nc",
            "postforms/fanuc.pf",
            &["--job-control", "haas", "--assume-units", "inch"],
        ),
    ] {
        let call = |job| [&["render", job, "--form", form, "--quiet"], more].concat();
        let [piped, named] = [fed(&call("-"), &fs::read(root().join(name)).unwrap()), postform(&call(name))];
        assert_eq!(text(&piped.stdout), text(&named.stdout), "{name}: {}", text(&piped.stderr));
        assert!(!piped.stdout.is_empty(), "{name}: {}", text(&piped.stderr));
    }
    let refused = fed(&["check", "-"], b"hello");
    assert!(text(&refused.stderr).contains("the format of standard input is unknown"), "{}", text(&refused.stderr));
    assert!(text(&fed(&["check", "-"], b"").stderr).contains("the job is empty"));
}

/// A program with its job as `--job`: the message shows the correct call.
#[test]
fn verify_shows_the_call_for_a_program_and_its_job() {
    let output = postform(&["verify", "samples/bracket/expected.haas.nc", "--job", "samples/bracket/job.json"]);
    assert_eq!(output.status.code(), Some(2));
    let call = "`postform verify samples/bracket/job.json --nc samples/bracket/expected.haas.nc`";
    assert!(text(&output.stderr).contains(call), "{}", text(&output.stderr));
}

/// The job and the program come through pipes.
#[test]
fn verify_reads_standard_input() {
    let job = fs::read(root().join("samples/plate/job.json")).unwrap();
    let output = fed(&["verify", "-", "--form", "postforms/grbl.pf"], &job);
    assert_eq!((output.status.code(), text(&output.stderr)), (Some(0), String::new()));
    assert!(text(&output.stdout).starts_with("equivalent: "), "{}", text(&output.stdout));
    let program = fs::read(root().join("samples/bracket/expected.fanuc.nc")).unwrap();
    let output = fed(&["verify", "samples/bracket/job.json", "--nc", "-"], &program);
    assert!(text(&output.stdout).starts_with("identical: standard input"), "{}", text(&output.stdout));
    // for a program that calls its own subprograms, postform prints the program again into a file
    let job_of_subs = fs::read(root().join("samples/pattern/job.json")).unwrap();
    let output = fed(&["verify", "-", "--form", "postforms/fadal-subs.pf"], &job_of_subs);
    assert!(text(&output.stdout).starts_with("identical: "), "{}", text(&output.stdout));
    // a truncated job gives an error, not a proof
    let output = fed(&["verify", "-", "--form", "postforms/grbl.pf"], &job[..job.len() / 2]);
    assert_eq!(output.status.code(), Some(1));
    assert!(output.stdout.is_empty() && text(&output.stderr).contains("PJ"), "{}", text(&output.stderr));
}

/// `render` shows lint's warnings about the form once, one per line. Levels and allowances apply.
#[test]
fn render_says_what_lint_knows() {
    let run = |more: &[&str]| {
        let job = "samples/drill-machine/job.json";
        let form = "samples/drill-machine/form.pf";
        postform(&[&["render", job, "--form", form][..], more].concat())
    };
    let told = run(&[]);
    let lines = text(&told.stderr);
    assert!(lines.starts_with("samples/drill-machine/form.pf:13:6: warning PF426: "), "{lines}");
    assert!(!lines.contains("PF303"), "notes are lint's: {lines}");
    assert_eq!(text(&run(&["--quiet"]).stderr), "");
    assert_eq!(run(&["--quiet"]).stdout, told.stdout);
    let denied = run(&["--deny", "warnings"]);
    assert_eq!((denied.status.code(), denied.stdout.len()), (Some(1), 0));
    assert!(text(&denied.stderr).contains("1 warning, nothing was printed"), "{}", text(&denied.stderr));
}

/// `render` warns about lost words of the form, and prints the program without them.
#[test]
fn render_says_what_a_form_loses() {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR"));
    let (form, job) = (folder.join("lost.pf"), folder.join("lost.json"));
    fs::write(&form, crate::support::mill("", "").replacen("\nT[tool] M6", "\n  T[tool] M6", 1)).unwrap();
    fs::write(&job, crate::support::job("{\"line\":[1,1,0]}")).unwrap();
    let output = postform(&["render", job.to_str().unwrap(), "--form", form.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    assert!(text(&output.stderr).contains("warning PF101: `T[tool] M6` is lost"), "{}", text(&output.stderr));
}

/// On a lathe, the tool change of the manual prints Z in place of X. `render` warns about each of these words.
#[test]
fn render_says_that_lathe_axes_are_the_other_way_round() {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR"));
    let (form, job) = (folder.join("columns.pf"), folder.join("columns.json"));
    let change = "T[tool] M6\nM[direct] S[speed]\nG0 G[work] X[h] Y[v]\nG43 Z[d] H[lcomp]\nEnd";
    let start = "Machine Lathe\nStartCode\n%0\nO[program#]\nG90 G80 G40 G17\nEnd";
    fs::write(&form, format!("{start}\n1stToolChange\n{change}\nToolChange\n{change}\nEndCode\nM5 M9\nM30\n%0\nEnd\n"))
        .unwrap();
    let text_of_job = "{\"postform\":1,\"program\":1234,\"units\":\"inch\",\"machine\":\"lathe\",\"tools\":[{\"number\":1}],\
        \"operations\":[{\"tool\":1,\"work\":54,\"spindle\":{\"speed\":2000,\"direction\":\"cw\"},\"path\":[{\"rapid\":[1,1,0.1]}]}]}";
    fs::write(&job, text_of_job).unwrap();
    let output = postform(&["render", job.to_str().unwrap(), "--form", form.to_str().unwrap()]);
    let told = text(&output.stderr);
    assert_eq!((output.status.code(), told.matches("warning PF314: ").count()), (Some(0), 4), "{told}");
}

/// `--deny warnings` also applies to the renderer's warnings if `verify` or `diff` prints the program.
#[test]
fn verify_hears_what_the_renderer_warns_of() {
    let job = concat!(env!("CARGO_TARGET_TMPDIR"), "/slow.json");
    fs::write(job, crate::support::job("{\"line\":[1,0,0],\"feed\":0.00155}")).unwrap();
    let run = |more: &[&str]| postform(&[&["verify", job, "--form", "postforms/fanuc.pf"][..], more].concat());
    let denied = run(&["--deny", "warnings"]);
    assert!(denied.status.code() == Some(1) && text(&denied.stderr).contains("PR025"), "{}", text(&denied.stderr));
    assert!(!text(&run(&[]).stderr).contains("PR025"), "{}", text(&run(&[]).stderr));
}

/// If nothing shows the control of a program, postform reads it as a Fanuc program, but only if each word is certain.
/// `G56 H1` is not certain, because it may be a tool length.
#[test]
fn an_assumed_control_reads_no_word_of_another() {
    let program = b"G21\nG0 G56 H1 X1.\nM30\n";
    let refused = fed(&["simulate", "-"], program);
    assert!(refused.status.code() == Some(1) && text(&refused.stderr).contains("PN005"), "{}", text(&refused.stderr));
    assert_eq!(fed(&["simulate", "-", "--control", "fanuc"], program).status.code(), Some(0));
    let klartext = b"0  BEGIN PGM T MM\n1  L X+10 R0 FMAX\n2 END PGM T MM\n";
    assert!(text(&fed(&["simulate", "-"], klartext).stdout).contains("X10"), "Klartext is found and read");
    let other = fed(&["simulate", "-", "--control", "fanuc"], klartext);
    assert!(text(&other.stderr).contains("Klartext of a Heidenhain control, but fanuc reads another"));
}

/// A refused block is reported, and the blocks after it are run.
#[test]
fn a_refused_block_is_passed_over() {
    let refused = fed(&["simulate", "-", "--format", "json"], b"G21\nG0 X#7\nG0 X#8\nG0 X1.\nM30\n");
    let rows: Vec<serde_json::Value> =
        text(&refused.stdout).lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let errors: Vec<_> = rows.iter().filter(|row| row.get("error").is_some()).map(|row| row["line"].clone()).collect();
    assert_eq!(errors, [2, 3]);
    assert!(rows.iter().any(|row| row.get("rapid").is_some()) && refused.status.code() == Some(1), "{rows:?}");
    // unknown positions are shown as `?`
    let shown = fed(&["simulate", "-", "--start", "unknown"], b"G21 G90\nG0 X1.\nM30\n");
    assert!(text(&shown.stdout).contains("X1 Y? Z?"), "{}", text(&shown.stdout));
}
