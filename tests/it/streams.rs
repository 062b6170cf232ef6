//! The exit status and the remaining files if standard output or standard error is full, closed or missing, or if a
//! command is killed.
#![cfg(target_os = "linux")]

use std::collections::BTreeSet;
use std::fs;
use std::io::Write;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use crate::support::{job, mill};

fn folder(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("streams").join(name);
    _ = fs::remove_dir_all(&path);
    fs::create_dir_all(&path).unwrap();
    let text = job("{\"line\":[1,1,0]}");
    for (name, text) in [
        ("postform.toml", String::new()),
        ("form.pf", mill("", "")),
        // a form with a warning that is not in the canonical layout
        ("odd.pf", mill("", "Rapid G0\nBeginRow\nEnd")),
        ("wrong.pf", mill("Rapdi G0", "")),
        ("job.json", text.clone()),
        ("wrong.json", text.replace("line", "lien")),
        ("a.nc", "G21\nG0 X1.\nM30\n".into()),
        ("wrong.nc", "G21\nG0 X#7\nM30\n".into()),
    ] {
        fs::write(path.join(name), text).unwrap();
    }
    path
}

fn shell(folder: &Path, line: &str) -> Output {
    let mut shell = Command::new("sh");
    shell.args(["-c", line, env!("CARGO_BIN_EXE_postform")]).current_dir(folder).output().unwrap()
}

/// A job that is longer than the buffer of a pipe.
fn long_job() -> String {
    let lines: String = (0..20_000).map(|i| format!(",{{\"line\":[{},1]}}", i % 1000)).collect();
    job(&lines[1..])
}

/// Commands with output.
const LINES: [&str; 17] = [
    "render job.json --form odd.pf -o out.nc",
    "render job.json --form form.pf --require-proof -o out.nc",
    "render job.json --form wrong.pf -o out.nc",
    "render wrong.json --form form.pf -o out.nc",
    "render no.json --form form.pf",
    "lint no.pf form.pf",
    "lint --fix odd.pf --format json",
    "fmt --check form.pf odd.pf",
    "fmt no.pf odd.pf",
    "check wrong.json",
    "verify job.json --nc a.nc",
    "simulate wrong.nc",
    "diff --motion a.nc wrong.nc",
    "explain nonsense",
    "new --control grbl -o new.pf",
    "completions nonsense",
    "man nonsense",
];

#[test_with::path(/dev/full)]
#[test]
fn standard_error_fails_no_work() {
    for (i, line) in LINES.iter().enumerate() {
        let run = |kind: &str, redirect: &str| {
            let folder = folder(&format!("{i}-{kind}"));
            let output = shell(&folder, &format!("exec \"$0\" {line} {redirect}"));
            let mut files: Vec<(String, Vec<u8>)> = fs::read_dir(&folder)
                .unwrap()
                .map(|entry| entry.unwrap().path())
                .map(|path| (path.file_name().unwrap().to_string_lossy().into_owned(), fs::read(path).unwrap()))
                .collect();
            files.sort();
            (output.status.code(), output.stdout, files)
        };
        let heard = run("heard", "");
        for (kind, redirect) in [("full", "2>/dev/full"), ("closed", "2>&-")] {
            let (status, out, files) = run(kind, redirect);
            assert_eq!(status, heard.0, "{line} {redirect}");
            assert!(out == heard.1 && files == heard.2, "{line} {redirect}");
        }
    }
}

/// A command that is killed during its work leaves only the files that existed before.
#[test]
fn a_kill_leaves_nothing_behind() {
    let folder = folder("killed");
    fs::write(folder.join("out.nc"), "last year\n").unwrap();
    let names = || -> BTreeSet<_> { fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().file_name()).collect() };
    let before = names();
    let mut child = Command::new(env!("CARGO_BIN_EXE_postform"))
        .args(["render", "-", "--from", "json", "--form", "form.pf", "-o", "out.nc", "--trace", "new.map"])
        .current_dir(&folder)
        .stdin(Stdio::piped())
        .spawn()
        .unwrap();
    let text = long_job();
    // the text is longer than the buffer of a pipe, so the command already reads and has created its outputs
    child.stdin.as_mut().unwrap().write_all(&text.as_bytes()[..text.len() - 10]).unwrap();
    child.kill().unwrap();
    child.wait().unwrap();
    assert_eq!(names(), before);
    assert_eq!(fs::read_to_string(folder.join("out.nc")).unwrap(), "last year\n");
}

/// If several processes create the same new form, exactly one succeeds.
#[test]
fn a_new_form_is_written_once() {
    let folder = folder("new");
    for round in 0..10 {
        let name = format!("{round}.pf");
        let start = || {
            let mut command = Command::new(env!("CARGO_BIN_EXE_postform"));
            command.args(["new", "--control", "grbl", "-o", &name]).current_dir(&folder).stderr(Stdio::null());
            command.spawn().unwrap()
        };
        let codes = [(); 4].map(|()| start()).map(|mut child| child.wait().unwrap().code());
        let done = codes.iter().filter(|code| **code == Some(0)).count();
        assert_eq!(done, 1, "round {round}");
    }
    symlink("nowhere", folder.join("link.pf")).unwrap();
    assert_eq!(shell(&folder, "exec \"$0\" new --control grbl -o link.pf").status.code(), Some(2));
    assert!(!folder.join("nowhere").exists());
}

#[test]
fn errors_name_the_folder_for_temporary_files() {
    let folder = folder("tmpdir");
    for (line, what) in [
        ("render job.json --form form.pf", "can't write standard output: a temporary file in /no/such (TMPDIR)"),
        ("simulate - < a.nc", "can't read standard input: a temporary file in /no/such (TMPDIR)"),
        ("check - --from nc < a.nc", "can't read standard input: a temporary file in /no/such (TMPDIR)"),
        ("diff --forms form.pf odd.pf job.json", "can't write the program: a temporary file in /no/such (TMPDIR)"),
    ] {
        let output = shell(&folder, &format!("TMPDIR=/no/such exec \"$0\" {line}"));
        let text = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.code() == Some(2) && text.contains(what), "{line}: {text}");
    }
}

#[test]
fn a_pipe_that_stops_reading_is_no_success() {
    let folder = folder("pipe");
    fs::write(folder.join("job.json"), long_job()).unwrap();
    let reader = "mkfifo pipe; head -c 10 pipe >/dev/null &";
    let line = format!("{reader} \"$0\" render job.json --form form.pf -o pipe; status=$?; wait; exit $status");
    let output = shell(&folder, &line);
    let text = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(
        output.status.code() == Some(1)
            && text.contains("pipe was closed by its reader before the whole program was written"),
        "{text}"
    );
}

/// A full standard output fails every command, also the texts of the options.
#[test_with::path(/dev/full)]
#[test]
fn a_full_standard_output_is_no_success() {
    let folder = folder("full");
    for line in ["--help", "--version", "render --help", "help lint", "controls", "render job.json --form form.pf"] {
        let output = shell(&folder, &format!("exec \"$0\" {line} > /dev/full"));
        let text = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.code() == Some(2) && text.contains("can't write standard output"), "{line}: {text}");
    }
}

/// An output may be a file that a process has open. Such a file may have no name, or may contain other text. So
/// postform writes to the file and does not replace it.
#[test]
fn an_open_file_is_written_and_its_link_stays() {
    let folder = folder("open");
    symlink("/proc/self/fd/1", folder.join("link")).unwrap();
    let render = "\"$0\" render job.json --form form.pf --quiet";
    let program = String::from_utf8(shell(&folder, render).stdout).unwrap();
    let unnamed =
        |out: &str| format!("exec 3<>gone; rm gone; {render} {out} >&3; status=$?; cat /proc/$$/fd/3; exit $status");
    let output = shell(&folder, &unnamed("-o link"));
    assert_eq!((output.status.code(), String::from_utf8(output.stdout).unwrap()), (Some(0), program.clone()));
    assert!(!shell(&folder, &unnamed("-o out.nc --trace link")).stdout.is_empty());
    assert!(folder.join("link").is_symlink());
    shell(&folder, &format!("{{ echo head; {render} -o link; echo tail; }} > all"));
    assert_eq!(fs::read_to_string(folder.join("all")).unwrap(), format!("head\n{program}tail\n"));
}
