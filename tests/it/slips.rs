//! Slips that people make, each with what they are told to type instead.

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

/// What a command line says, and its exit status.
fn said(folder: &Path, arguments: &[&str]) -> (Option<i32>, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_postform")).current_dir(folder).args(arguments).output().unwrap();
    let text = [output.stdout, output.stderr].concat();
    // messages are broken into lines, with a bar before each
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
        (changed("X->3.>4", "X=->4.>4"), ["PF301", "`X->3.>4`"]),
        (
            changed("\nStartCode", "\nAsk fixture \"Fixture\" 2\n\nStartCode"),
            ["PF302", "`Property fixture number 0 ..`"],
        ),
        (changed("\nEndCode", "\nUpon [coolant]\nM[cool]\nEnd\n\nEndCode"), ["PF202", "it is called `cool`"]),
        (changed("X->3.>4", "X 1.4"), ["PF305", "`X->4.>4` has up to four digits before the point"]),
        (changed("End Cancel", "End; Cancel"), ["PF002", "write `End Cancel`"]),
        (changed("Control haas", "Control mazak"), ["PF302", "much like `fanuc`"]),
        (changed("M6\n", "M6 ; change\n"), ["PF110", "begins with ` #`"]),
        (changed("M[cool]\n", "M cool\n"), ["PF112", "write `M[cool]`"]),
        (changed("M[cool]\n", "[frate*0.5]\n"), ["PF112", "write the letter before it"]),
    ];
    let folder = folder("slips-forms");
    for (text, wanted) in table {
        fs::write(folder.join("form.pf"), &text).unwrap();
        let (status, said) = said(&folder, &["lint", "form.pf"]);
        assert_eq!(status, Some(1), "{said}");
        wanted.iter().for_each(|wanted| assert!(said.contains(wanted), "no {wanted} in {said}"));
    }
}

#[test]
fn slips_in_jobs() {
    let good = job("{\"line\":[1,0,0]}");
    let table = [
        (good.replacen("\"units\":\"inch\",", "\"units\":\"inch\"\n", 1), "a comma is missing before it"),
        (good.replacen("[1,0,0]", "[1,0,0],", 1), "take out the comma before it"),
        (good.replace('"', "'"), "double quotes"),
        (format!("// a job\n{good}"), "JSON has no comments"),
        (good.replacen("\"inch\"", "\"metric\"", 1), "write \"mm\""),
        (good.replacen("\"cw\"", "\"CW\"", 1), "write \"cw\""),
        (good.replacen("\"work\":54", "\"work\":\"G54\"", 1), "write 54, without quotes"),
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
    let table: [(&[&str], &str); 4] = [
        (&["lint", "job.json"], "job.json is a job, no form"),
        (&["check", "haas.pf"], "`postform lint haas.pf` looks at forms"),
        (&["render", "job.json", "--form", "has.pf"], "the forms there: haas.pf"),
        (&["render", "haas.pf", "--form", "job.json"], "the job comes first"),
    ];
    for (arguments, wanted) in table {
        let (status, said) = said(&folder, arguments);
        assert!(status == Some(2) && said.contains(wanted), "{arguments:?}: {said}");
    }
}
