//! The file name of a program if `--output` is a folder, and the choice of a post from a file with several.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use crate::support::{job, mill};

fn folder(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    _ = fs::remove_dir_all(&path);
    fs::create_dir_all(path.join("out")).unwrap();
    path
}

fn render(folder: &Path, form: &str, job: &str, more: &[&str]) -> Output {
    fs::write(folder.join("form.pf"), form).unwrap();
    fs::write(folder.join("part 1.json"), job).unwrap();
    Command::new(env!("CARGO_BIN_EXE_postform"))
        .current_dir(folder)
        .args(["render", "part 1.json", "--form", "form.pf", "--no-verify"])
        .args(more)
        .output()
        .unwrap()
}

/// The files of the folder `out`.
fn written(folder: &Path) -> Vec<String> {
    let names = fs::read_dir(folder.join("out")).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap());
    let mut names: Vec<String> = names.collect();
    names.sort();
    names
}

#[test]
fn form_and_job_name_the_file() {
    let named = job("{\"line\":[1,0,0]}").replace("\"program\":100,", "\"program\":100,\"name\":\"Türband (B)\",");
    let table = [
        ("", "part_1.nc"),
        ("Extension mpf", "part_1.mpf"),
        ("O 4\nProgramName O[program#]", "O0100.nc"),
        ("ProgramName [progname]-[jobfile]\nExtension .H", "Tuerband__B_-part_1.H"),
        ("ProgramName P[partname]", "part_1.nc"),
    ];
    for (i, (head, name)) in table.into_iter().enumerate() {
        let folder = folder(&format!("file-names-{i}"));
        let output = render(&folder, &mill(head, ""), &named, &["-o", "out"]);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!((output.status.code(), written(&folder)), (Some(0), vec![name.to_owned()]), "{head}: {said}");
        assert!(said.contains(&format!("{name} is written")), "{said}");
        // the second run replaces the file
        assert_eq!(render(&folder, &mill(head, ""), &named, &["-o", "out"]).status.code(), Some(0));
        assert_eq!(written(&folder), [name]);
    }
}

#[test]
fn what_is_wrong_leaves_no_file() {
    let folder = folder("file-names-wrong");
    let output = render(&folder, &mill("", ""), &job("{\"arc\":[1,0,0]}"), &["-o", "out"]);
    assert_eq!((output.status.code(), written(&folder)), (Some(1), Vec::new()));
    let gone = render(&folder, &mill("", ""), &job("{\"line\":[1,0,0]}"), &["-o", "gone/"]);
    assert_eq!(gone.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&gone.stderr).contains("there is no folder gone"), "{gone:?}");
}

#[test]
fn a_file_of_several_posts_prints_by_one_of_them() {
    let folder = folder("several-posts");
    let post = |name: &str, code: &str| mill(&format!("Name {name}"), "").replace("M30", code);
    let both = format!("{}\n{}", post("Haas one", "M30"), post("Haas two", "M2"));
    let job = job("{\"line\":[1,0,0]}");
    let last = |output: &Output| String::from_utf8_lossy(&output.stdout).lines().last().map(str::to_owned);
    assert_eq!(last(&render(&folder, &both, &job, &["--post", "Haas one"])).as_deref(), Some("M30"));
    assert_eq!(last(&render(&folder, &both, &job, &["--post", "haas TWO"])).as_deref(), Some("M2"));
    let which = render(&folder, &both, &job, &[]);
    let said = String::from_utf8_lossy(&which.stderr).into_owned();
    assert!(said.contains("PF006") && said.contains("--post \"Haas one\""), "{said}");
    let none = render(&folder, &both, &job, &["--post", "Mazak"]);
    let said = String::from_utf8_lossy(&none.stderr).into_owned();
    assert!(none.status.code() == Some(2) && said.contains("Haas one, Haas two"), "{said}");
    // locations count the lines of the whole file, not of the selected post
    let broken = format!("{}\n{}", post("A", "M30"), post("B", "M30 X["));
    let line = broken.lines().position(|line| line.contains("M30 X[")).unwrap() + 1;
    let said = render(&folder, &broken, &job, &["--post", "B"]);
    assert!(String::from_utf8_lossy(&said.stderr).contains(&format!("form.pf:{line}:")), "{said:?}");
}
