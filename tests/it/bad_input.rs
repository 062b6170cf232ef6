//! Wrong input of every kind gives a code, a location and exit status 1. It causes no panic and leaves no output file.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use crate::support::folder::{self, err, out};
use crate::support::{job, mill, root};

struct Folder(std::path::PathBuf);

impl Folder {
    fn new(name: &str) -> Folder {
        let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
        _ = fs::remove_dir_all(&path);
        fs::create_dir_all(&path).unwrap();
        Folder(path)
    }

    fn write(&self, name: &str, bytes: impl AsRef<[u8]>) -> std::path::PathBuf {
        let path = self.0.join(name);
        fs::write(&path, bytes).unwrap();
        path
    }
}

fn render(folder: &Folder, job: &Path, form: &Path) -> Output {
    render_with(folder, job, form, &[])
}

fn render_with(folder: &Folder, job: &Path, form: &Path, options: &[&str]) -> Output {
    let out = folder.0.join("out.nc");
    let output = Command::new(env!("CARGO_BIN_EXE_postform"))
        .args(["render", "--form"])
        .arg(form)
        .arg(job)
        .arg("-o")
        .arg(&out)
        .args(options)
        .output()
        .unwrap();
    assert!(!out.exists() || output.status.success(), "an output file beside an error");
    let others: Vec<_> = fs::read_dir(&folder.0)
        .unwrap()
        .map(|e| e.unwrap().file_name().into_string().unwrap())
        .filter(|n| n.starts_with(".postform"))
        .collect();
    assert!(others.is_empty(), "left behind: {others:?}");
    _ = fs::remove_file(out);
    output
}

/// Checks the exit status, and that the message contains all texts in `wanted`.
fn expect(what: &str, output: &Output, status: i32, wanted: &[&str]) {
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(status), "{what}: {message}");
    assert!(!message.contains("panicked"), "{what}: {message}");
    for text in wanted {
        assert!(message.contains(text), "{what}: no `{text}` in\n{message}");
    }
    assert!(message.len() < 200_000, "{what}: a message of {} bytes", message.len());
}

#[test]
fn forms() {
    let folder = Folder::new("bad_forms");
    let good_job = folder.write("job.json", job("{\"line\":[1,1,0]}"));
    let good = mill("", "");
    let replaced = |from: &str, to: &str| {
        assert!(good.contains(from));
        good.replacen(from, to, 1)
    };
    let long_body = format!("Drill\n{}\nEnd", "G1 X[h]\n".repeat(160));
    let many_lines = format!("{good}{}", "# a comment\n".repeat(40_000));
    let many_bad = "Wrong thing\n".repeat(2_000);
    let table: Vec<(&str, Vec<u8>, i32, Vec<&str>)> = vec![
        ("empty", b"".into(), 1, vec!["PF005", "StartCode"]),
        ("only blanks", b"\n \n\t\n".into(), 1, vec!["PF005"]),
        ("binary", (0..=255u8).cycle().take(5000).collect(), 1, vec!["PF"]),
        (
            "NUL bytes",
            replaced("T[tool] M6", "T[tool]\0 M6").into(),
            1,
            vec!["PF001", "control character", "form.pf:6"],
        ),
        (
            "cut in the middle",
            good[..good.find("ToolChange\nT").unwrap() + 5].into(),
            1,
            vec!["PF201", "PF005", "EndCode"],
        ),
        (
            "cut inside a word",
            good[..good.find("[tool]").unwrap() + 3].into(),
            1,
            vec!["PF001", "an unmatched bracket"],
        ),
        (
            "no End",
            replaced("End\n1stToolChange", "1stToolChange").into(),
            1,
            vec!["PF002", "StartCode has no End", "form.pf:2"],
        ),
        ("End twice", replaced("End\n1stToolChange", "End\nEnd\n1stToolChange").into(), 1, vec!["PF007", "form.pf:5"]),
        ("no EndCode", replaced("EndCode\nM30\nEnd", "").into(), 1, vec!["PF005", "the form has no EndCode"]),
        ("unknown sequence", format!("{good}Dril\nG81 X[h]\nEnd\n").into(), 1, vec!["PF201", "did you mean `Drill`?"]),
        ("unknown command", mill("Rapids G0", "").into(), 1, vec!["PF201", "did you mean `Rapid`?", "form.pf:1:1"]),
        ("unknown variable", replaced("X[h]", "X[hh]").into(), 1, vec!["PF202", "`hh` is not a variable"]),
        ("misspelt variable", mill("", "Drill\nR[vlcear]\nEnd").into(), 1, vec!["PF202", "did you mean `vclear`?"]),
        ("variable of a lathe", replaced("X[h]", "X[taper]").into(), 1, vec!["PF604", "`taper` is for lathe"]),
        (
            "sequence of a lathe",
            mill("", "AutoThread\nG76 X[v]\nEnd").into(),
            1,
            vec!["PF603", "AutoThread is for lathe"],
        ),
        (
            "sequence twice",
            mill("", "Drill\nG81\nEnd\ndrill\nG82\nEnd").into(),
            1,
            vec!["PF004", "first here", "again here"],
        ),
        ("Upon twice", mill("", "Upon [work]\nG4\nEnd\nUpon <work>\nG4\nEnd").into(), 1, vec!["PF004", "Upon [work]"]),
        ("command twice", mill("Rapid G0\nRapid G00", "").into(), 1, vec!["PF006", "form.pf:2"]),
        (
            "a library of posts",
            format!("Name Post A\n{0}\nName Post B\n{0}", good.trim_start()).into(),
            1,
            vec!["PF006", "the file contains 2 posts: `Post A`, `Post B`", "1 error, nothing was printed"],
        ),
        ("letter format twice", mill("X->3.>4\nX->4.>3", "").into(), 1, vec!["PF006", "X has two formats"]),
        ("bad letter format", mill("X->3..>4", "").into(), 1, vec!["PF301"]),
        ("format without digits", mill("X->", "").into(), 1, vec!["PF301"]),
        ("format that loses its point", mill("P >3>4", "").into(), 1, vec!["PF301", "without a point"]),
        ("bad argument", mill("Helical? maybe", "").into(), 1, vec!["PF302", "Helical? is Y or N"]),
        ("no argument", mill("Rapid", "").into(), 1, vec!["PF302", "Rapid needs a code"]),
        ("argument lost", mill("Rapid  G0", "").into(), 1, vec!["PF302", "two spaces"]),
        ("too many arguments", mill("FeedCode F G H", "").into(), 1, vec!["PF302", "FeedCode takes 1 letter"]),
        ("an arc that is an M code", mill("CW M3", "").into(), 1, vec!["PF302", "`M3` is not a G code", "form.pf:1:"]),
        ("a feed that is an M code", mill("Feed M8", "").into(), 1, vec!["PF302", "`M8` is not a G code"]),
        ("Machine of no kind", mill("Machine Router", "").into(), 1, vec!["PF302", "Mill, Lathe, EDM"]),
        (
            "count too large",
            mill("", "Drill 3\nG81 X[h]\nEnd").into(),
            1,
            vec!["PF401", "is 3, but the number of lines in its body is 1"],
        ),
        ("count of zero", mill("", "Drill 0\nG81 X[h]\nEnd").into(), 1, vec!["PF401"]),
        ("count on no cycle", mill("", "Index 1\nG0\nEnd").into(), 1, vec!["PF405", "Index is not a canned cycle"]),
        ("no Cancel", replaced("Cancel\nG80\nEnd", "Drill\nG81 X[h]\nEnd Cancel").into(), 1, vec!["PF402"]),
        ("a word after End", mill("", "Drill\nG81\nEnd Cancle").into(), 1, vec!["PF001", "`Cancle` after End"]),
        (
            "16 words",
            mill("", "Drill\nG1 G2 G3 G4 G5 G6 G7 G8 G9 G10 G11 G12 G13 G14 G15 G16\nEnd").into(),
            1,
            vec!["PF601", "16 words on a line"],
        ),
        ("too many lines", mill("", &long_body).into(), 1, vec!["PF602", "the limit is 150"]),
        ("words outside a sequence", format!("{good}G0 X[h]\n").into(), 1, vec!["PF001", "outside a sequence"]),
        ("stray point", mill("", "Drill\nX[h] Y[v].\nEnd").into(), 1, vec!["PF001", "is directly after a word"]),
        ("sign before a variable", mill("", "Drill\nX-[h]\nEnd").into(), 1, vec!["PF001", "RevSigns"]),
        ("a call of nothing", mill("Call other.pf", "").into(), 1, vec!["PF009", "can't be found"]),
        ("a call of itself", mill("Call form.pf", "").into(), 1, vec!["PF"]),
        ("a call outside", mill("Call ../form.pf", "").into(), 1, vec!["PF009", "outside the form's folder"]),
        ("a line of 400 KB", format!("Name {}\n{good}X", "A".repeat(400 << 10)).into(), 1, vec!["PF"]),
        ("a word of 400 KB", mill("", &format!("Drill\n{}\nEnd", "[".repeat(400 << 10))).into(), 1, vec!["PF001"]),
        ("2000 wrong lines", many_bad.into(), 1, vec!["PF201", "2000"]),
        ("40,000 lines", many_lines.into(), 0, vec![]),
        ("CRLF", good.replace('\n', "\r\n").into(), 0, vec![]),
        ("byte order mark", format!("\u{feff}{good}").into(), 0, vec![]),
        ("Latin-1", [b"Name Fr\xe4se\n".as_slice(), good.as_bytes()].concat(), 0, vec!["PF008", "Windows-1252"]),
        ("tabs", replaced("T[tool] M6", "T[tool]\tM6").into(), 0, vec![]),
        (
            "control characters in printed text",
            format!("Mod (A\u{1b})\n{good}").into(),
            1,
            vec!["PF001", "U+001B", "form.pf:1"],
        ),
        ("older spelling", good.replace('[', "<").replace(']', ">").into(), 0, vec![]),
    ];
    assert!(table.len() >= 25);
    for (what, bytes, status, wanted) in table {
        let form = folder.write("form.pf", bytes);
        let output = render(&folder, &good_job, &form);
        let wanted: Vec<&str> = wanted.into_iter().filter(|w| *w != "2000").collect();
        if what == "2000 wrong lines" {
            let message = String::from_utf8_lossy(&output.stderr);
            assert_eq!(message.matches("PF201").count(), 1000);
            assert!(message.contains(" more findings: fix the findings above first"), "{message}");
            continue;
        }
        expect(what, &output, status, &wanted);
    }
}

#[test]
fn jobs() {
    let folder = Folder::new("bad_jobs");
    let form = folder.write("form.pf", mill("", "Drill\nG81 X[h] Y[v] Z[d] R[vclear] F[frate]\nEnd Cancel"));
    let good = job("{\"line\":[1,1,0]}");
    let with = |path: &str| job(path).into_bytes();
    let head = |text: &str| good.replacen("\"postform\":1,", text, 1).into_bytes();
    let bomb = "[".repeat(100_000);
    let table: Vec<(&str, Vec<u8>, i32, Vec<&str>)> = vec![
        ("empty", b"".into(), 1, vec!["PJ007", "the job is empty"]),
        ("only blanks", b" \n\n".into(), 1, vec!["PJ007"]),
        ("binary", (0..=255u8).cycle().take(5000).collect(), 1, vec!["PJ001"]),
        ("a list", b"[1,2]".into(), 1, vec!["PJ003", "expected a job"]),
        ("cut in the middle", good.as_bytes()[..good.len() / 2].into(), 1, vec!["PJ007"]),
        ("cut before the last brace", good.as_bytes()[..good.len() - 1].into(), 1, vec!["PJ007"]),
        ("trailing text", format!("{good} {{}}").into(), 1, vec!["PJ008"]),
        ("trailing comma", good.replace("]}]}", "],}]}").into(), 1, vec!["PJ001"]),
        ("unknown key", head("\"postfrom\":1,"), 1, vec!["PJ002", "did you mean `postform`?"]),
        (
            "unknown key of an item",
            with("{\"lin\":[1,2]}"),
            1,
            vec!["PJ002", "did you mean `line`?", "operations[0].path[1]"],
        ),
        ("another version", head("\"postform\":2,"), 1, vec!["PJ003", "postform"]),
        ("wrong type", head("\"program\":\"x\","), 1, vec!["PJ003", "expected a number", ", program"]),
        ("null for a number", head("\"program\":null,"), 1, vec!["PJ003"]),
        ("NaN", with("{\"line\":[NaN,1]}"), 1, vec!["PJ001"]),
        ("infinite", with("{\"line\":[1e400,1]}"), 1, vec!["PJ003", "too large"]),
        ("a number as text", with("{\"line\":[\"1\",1]}"), 1, vec!["PJ003", "operations[0].path[1].line"]),
        ("seven coordinates", with("{\"line\":[1,2,3,4,5,6,7]}"), 1, vec!["PJ003"]),
        ("nesting bomb", bomb.clone().into(), 1, vec!["PJ003"]),
        ("nesting bomb in a position", with(&format!("{{\"line\":{bomb}")), 1, vec!["PJ003"]),
        ("key twice", head("\"program\":1,\"program\":2,"), 1, vec!["PJ010", "given twice"]),
        (
            "two tools with one number",
            good.replace("{\"number\":2}", "{\"number\":1}").into(),
            1,
            vec!["PJ010", "two tools"],
        ),
        ("tool without a number", good.replace("{\"number\":2}", "{\"diameter\":1}").into(), 1, vec!["PJ004"]),
        ("missing tool", good.replace("\"tool\":1", "\"tool\":7").into(), 1, vec!["PJ006", "tool 7"]),
        ("no tool", good.replace("\"tool\":1,", "").into(), 1, vec!["PJ006", "has no tool"]),
        ("no units", b"{\"postform\":1,\"operations\":[]}".into(), 1, vec!["PJ004", "write \"units\": \"mm\""]),
        ("no operations", b"{\"postform\":1,\"units\":\"inch\",\"operations\":[]}".into(), 1, vec!["PJ009"]),
        (
            "operations not last, and none",
            b"{\"operations\":[],\"postform\":1,\"units\":\"inch\"}".into(),
            1,
            vec!["PJ009"],
        ),
        ("path not last", good.replacen("\"tool\":1,", "\"path\":[],\"tool\":1,", 1).into(), 1, vec!["PJ"]),
        (
            "operation without path",
            b"{\"tools\":[{\"number\":1}],\"operations\":[{\"tool\":1}]}".into(),
            1,
            vec!["PJ004"],
        ),
        ("a cut to no position", with("{\"line\":[]}"), 1, vec!["PJ003", "`line` gives no axis", "path[1]"]),
        ("a rapid to no position", with("{\"rapid\":[null,null]}"), 1, vec!["PJ003", "`rapid` gives no axis"]),
        (
            "an infeed to no position",
            with("{\"infeed\":[null,null],\"side\":\"left\"}"),
            1,
            vec!["PJ003", "`infeed` gives no axis"],
        ),
        ("an outfeed to no position", with("{\"outfeed\":[]}"), 1, vec!["PJ003", "`outfeed` gives no axis"]),
        (
            "a hole at no position",
            with("{\"cycle\":{\"kind\":\"drill\",\"depth\":1,\"feed\":5,\"points\":[[1,1,0],[null]]}}"),
            1,
            vec!["PJ003", "a point gives no axis"],
        ),
        ("empty item", with("{}"), 1, vec!["PJ004", "is empty"]),
        ("two things in an item", with("{\"line\":[1,2],\"rapid\":[1,2]}"), 1, vec!["PJ005", "more than one action"]),
        (
            "negative speed",
            good.replace("\"speed\":1000", "\"speed\":-1").into(),
            1,
            vec!["PJ003", "can't be negative"],
        ),
        ("zero feed", with("{\"line\":[1,2],\"feed\":0}"), 1, vec!["PJ003", "above zero"]),
        ("negative dwell", with("{\"dwell\":-1}"), 1, vec!["PJ003"]),
        ("a word that is none", with("{\"begin\":\"leedin\"}"), 1, vec!["PJ003", "leedin"]),
        ("section not closed", with("{\"begin\":\"leadin\"}"), 1, vec!["PJ011", "still open"]),
        ("sections crossed", with("{\"begin\":\"leadin\"},{\"begin\":\"row\"},{\"end\":\"leadin\"}"), 1, vec!["PJ011"]),
        (
            "pecks without end",
            with(&format!("{{\"cycle\":{{\"kind\":\"deep\",\"pecks\":[{}]}}}}", ["{\"to\":1}"; 10_001].join(","))),
            1,
            vec!["PJ003", "a list of more than 10000", "operations[0].path[1].cycle.pecks[10000]"],
        ),
        ("an arc without a centre", with("{\"arc\":{\"to\":[1,1],\"direction\":\"cw\"}}"), 1, vec!["PJ005"]),
        (
            "an arc with unequal radii",
            with("{\"arc\":{\"to\":[1,1],\"center\":[0.2,0],\"direction\":\"cw\"}}"),
            1,
            vec!["PR005", "0.2"],
        ),
        (
            "an arc too small for its ends",
            with("{\"arc\":{\"to\":[9,0],\"radius\":1,\"direction\":\"cw\"}}"),
            1,
            vec!["PR005"],
        ),
        ("an unknown cycle", with("{\"cycle\":{\"kind\":\"dril\",\"points\":[[1,1,0]]}}"), 1, vec!["PJ003", "dril"]),
        (
            "a cycle without depth",
            with("{\"cycle\":{\"kind\":\"drill\",\"feed\":5,\"points\":[[1,1,0]]}}"),
            1,
            vec!["PC002 (cycle.depth.missing)"],
        ),
        (
            "a cycle without points",
            with("{\"cycle\":{\"kind\":\"drill\",\"depth\":1,\"feed\":5}}"),
            1,
            vec!["PJ004", "no points"],
        ),
        (
            "a point without height",
            with("{\"cycle\":{\"kind\":\"drill\",\"depth\":1,\"feed\":5,\"points\":[[1,1]]}}"),
            1,
            vec!["PR006", "no height"],
        ),
        ("a number too long for its letter", with("{\"line\":[12345678,0]}"), 1, vec!["PR002", "X is 12345678"]),
        ("a variable that can't be set", head("\"set\":{\"h\":1},"), 1, vec!["PR016"]),
        ("a variable that is none", head("\"set\":{\"vall\":1},"), 1, vec!["PR016", "val1"]),
        ("metric job, inch form", good.replace("\"inch\"", "\"mm\"").into(), 1, vec!["PR010", "25.4"]),
        ("job for another machine", head("\"machine\":\"lathe\","), 1, vec!["PR008"]),
        ("more than one line of text", with("{\"text\":\"M0\\nM1\"}"), 1, vec!["PJ003"]),
        ("text that steers", with("{\"text\":\"A\\u001b\"},{\"line\":[1,1,0]}"), 1, vec!["PR035", "U+001B"]),
        ("text that ends the program", with("{\"text\":\" % \"},{\"line\":[1,1,0]}"), 1, vec!["PR035", "single"]),
        ("a number of 309 digits", with("{\"line\":[1e308,0]}"), 1, vec!["…"]),
        ("a name of 2 MB", head(&format!("\"name\":\"{}\",", "A".repeat(2 << 20))), 1, vec!["PJ003", "1 MB", "name"]),
        ("2 MB of quotes", head(&format!("\"name\":\"{}\",", "\\\"".repeat(1 << 20))), 1, vec!["PJ003", "1 MB"]),
        ("a name of a million letters", head(&format!("\"name\":\"{}\",", "A".repeat(1_000_000))), 0, vec![]),
        ("not UTF-8 in a text", [b"{\"name\":\"".as_slice(), b"\xff\"}"].concat(), 1, vec!["PJ001", "not UTF-8"]),
        ("UTF-16", good.encode_utf16().flat_map(u16::to_le_bytes).collect(), 1, vec!["PJ001", "UTF-16"]),
        (
            "UTF-16 with its mark",
            format!("\u{feff}{good}").encode_utf16().flat_map(u16::to_le_bytes).collect(),
            1,
            vec!["PJ001", "UTF-16"],
        ),
        ("byte order mark", format!("\u{feff}{good}").into(), 0, vec![]),
        ("CRLF", good.replace(',', ",\r\n").into(), 0, vec![]),
    ];
    assert!(table.len() >= 25);
    for (what, bytes, status, wanted) in table {
        let path = folder.write("job.json", bytes);
        let output = render(&folder, &path, &form);
        expect(what, &output, status, &wanted);
        if status == 1 {
            let message = String::from_utf8_lossy(&output.stderr);
            let place = if what.starts_with("empty") && wanted[0] == "PJ007" { "job.json" } else { "job.json:" };
            assert!(message.contains(place), "{what}: no place in\n{message}");
        }
    }
    _ = root();
}

#[test]
fn json_lines() {
    let folder = Folder::new("bad_lines");
    let form = folder.write("form.pf", mill("", ""));
    let start = "{\"start\":{\"postform\":1,\"program\":1,\"units\":\"inch\",\"tools\":[{\"number\":1}]}}\n";
    let operation =
        "{\"operation\":{\"tool\":1,\"work\":54,\"spindle\":{\"speed\":9,\"direction\":\"cw\"},\"feed\":5}}\n";
    let moves = "{\"rapid\":[0,0,1]}\n{\"line\":[1,2,3]}\n";
    let end = "{\"end\":true}\n";
    let table: Vec<(&str, String, i32, Vec<&str>)> = vec![
        ("good", format!("{start}{operation}{moves}{end}"), 0, vec![]),
        ("no line end at the end", format!("{start}{operation}{moves}{{\"end\":true}}"), 0, vec![]),
        ("CRLF and empty lines", format!("{start}\n{operation}{moves}\n{end}\n").replace('\n', "\r\n"), 0, vec![]),
        ("empty", String::new(), 1, vec!["PJ007", "the job is empty"]),
        ("without its end", format!("{start}{operation}{moves}"), 1, vec!["PJ007", "has no end"]),
        ("cut inside a line", format!("{start}{operation}{{\"line\":[1,"), 1, vec!["PJ007", "job.jsonl:3:"]),
        ("without a start", format!("{operation}{moves}{end}"), 1, vec!["PJ011", "job.jsonl:1:"]),
        ("two starts", format!("{start}{start}"), 1, vec!["PJ011", "starts twice"]),
        ("something after the end", format!("{start}{operation}{moves}{end}{moves}"), 1, vec!["PJ008"]),
        ("a move before any operation", format!("{start}{moves}{end}"), 1, vec!["PJ006", "job.jsonl:2:"]),
        ("a point outside a cycle", format!("{start}{operation}{{\"point\":[1,1,0]}}\n{end}"), 1, vec!["PJ011"]),
        (
            "a move inside a cycle",
            format!("{start}{operation}{{\"cycle\":{{\"kind\":\"drill\",\"depth\":1,\"feed\":5}}}}\n{moves}"),
            1,
            vec!["PJ011", "inside a cycle"],
        ),
        ("an unknown key", format!("{start}{operation}{{\"lines\":[1]}}\n"), 1, vec!["PJ002", "did you mean `line`?"]),
        (
            "two objects on a line",
            format!("{start}{operation}{{\"rapid\":[0,0,1]}} {{\"rapid\":[0,0,1]}}\n"),
            1,
            vec!["PJ008"],
        ),
        ("no JSON", format!("{start}G0 X0\n"), 1, vec!["PJ001", "job.jsonl:2:"]),
        ("a line of 5 MB", format!("{start}{}", " ".repeat(5 << 20)), 1, vec!["PJ001", "4 MB"]),
        (
            "a name of 2 MB",
            format!("{{\"start\":{{\"name\":\"{}\"}}}}\n", "A".repeat(2 << 20)),
            1,
            vec!["PJ003", "1 MB", "job.jsonl:1:"],
        ),
    ];
    for (what, text, status, wanted) in table {
        let path = folder.write("job.jsonl", text);
        expect(what, &render(&folder, &path, &form), status, &wanted);
    }
    let wide: Vec<u8> = start.encode_utf16().flat_map(u16::to_le_bytes).collect();
    let path = folder.write("job.jsonl", wide);
    expect("UTF-16", &render(&folder, &path, &form), 1, &["PJ001", "UTF-16", "job.jsonl:1"]);
}

#[test]
fn files_that_are_not_there_are_another_status() {
    let folder = Folder::new("no_files");
    let form = folder.write("form.pf", mill("", ""));
    let job = folder.write("job.json", job("{\"line\":[1,1,0]}"));
    let nothing = folder.0.join("nothing.json");
    expect("no job", &render(&folder, &nothing, &form), 2, &["can't read", "nothing.json"]);
    expect("no form", &render(&folder, &job, &nothing), 2, &["can't read"]);
    expect("a folder as form", &render(&folder, &job, &folder.0), 2, &["can't read"]);
    for name in ["folder.json", "folder.jsonl", "folder.cl", "folder.nc"] {
        let odd = folder.0.join(name);
        fs::create_dir_all(&odd).unwrap();
        expect("a folder as job", &render(&folder, &odd, &form), 2, &["can't read", name]);
    }
    let unnamed = folder.write("job.txt", "");
    expect("a job of unknown kind", &render(&folder, &unnamed, &form), 2, &["--from"]);
    let to_nowhere = Command::new(env!("CARGO_BIN_EXE_postform"))
        .arg("render")
        .arg(&job)
        .arg("--form")
        .arg(&form)
        .args(["-o", "/nowhere/at/all.nc"])
        .output()
        .unwrap();
    expect("an output folder that is not there", &to_nowhere, 2, &["can't write"]);
    let usage = Command::new(env!("CARGO_BIN_EXE_postform")).args(["rendr"]).output().unwrap();
    expect("wrong usage", &usage, 2, &["render"]);
}

#[test]
#[cfg(target_os = "linux")]
fn full_disks_and_closed_pipes() {
    use std::io::Read;
    use std::process::Stdio;
    let folder = Folder::new("full");
    let form = folder.write("form.pf", mill("", ""));
    let lines: String = (0..20_000).map(|i| format!(",{{\"line\":[{},1]}}", i % 1000)).collect();
    let job = folder.write("job.json", job(&lines[1..]).replace("\"units\"", "\"name\":\"n\",\"units\""));
    let run = |out: &str| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_postform"));
        command.arg("render").arg(&job).arg("--form").arg(&form).args(["-o", out]);
        command
    };
    expect("a full device", &run("/dev/full").output().unwrap(), 2, &["can't write /dev/full", "No space left"]);
    assert!(fs::metadata("/dev/full").is_ok_and(|m| !m.is_file()), "the device was replaced by a file");
    let mut child = run("-").arg("--quiet").stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let mut first = [0; 10];
    child.stdout.take().unwrap().read_exact(&mut first).unwrap(); // then close the pipe
    let output = child.wait_with_output().unwrap();
    expect("a closed pipe", &output, 0, &[]);
    assert!(output.stderr.is_empty());
}

#[test]
#[cfg(unix)]
fn outputs_do_not_replace_their_inputs() {
    use std::os::unix::fs::symlink;
    let folder = Folder::new("same_file");
    folder.write("postform.toml", "form = \"form.pf\"\n");
    folder.write("form.pf", mill("Call common.pf", ""));
    folder.write("common.pf", "Drill\nG81 X[h] Y[v]\nEnd\n");
    folder.write("job.json", job("{\"line\":[1,1,0]}"));
    folder.write("c.toml", "name = \"c\"\nlike = \"fanuc\"\n");
    let inputs = ["job.json", "form.pf", "common.pf", "postform.toml", "c.toml"];
    let texts = || inputs.map(|name| fs::read_to_string(folder.0.join(name)).unwrap());
    let before = texts();
    let run = |arguments: &str, redirect: &str| {
        let line = format!("exec \"$0\" render {arguments} {redirect}");
        let mut shell = Command::new("sh");
        shell.args(["-c", &line, env!("CARGO_BIN_EXE_postform")]).current_dir(&folder.0).output().unwrap()
    };
    for input in inputs {
        symlink(input, folder.0.join("link")).unwrap();
        fs::hard_link(folder.0.join(input), folder.0.join("hard")).unwrap();
        for name in [input, "link", "hard"] {
            expect(input, &run(&format!("job.json --control c.toml -o {name}"), ""), 2, &["is an input"]);
            expect(
                input,
                &run(&format!("job.json --control c.toml -o out.nc --trace ./{name}"), ""),
                2,
                &["is an input"],
            );
        }
        expect(input, &run("job.json --control c.toml", &format!(">> {input}")), 2, &["standard output is an input"]);
        fs::remove_file(folder.0.join("link")).unwrap();
        fs::remove_file(folder.0.join("hard")).unwrap();
    }
    for input in inputs {
        symlink(input, folder.0.join("x.svg")).unwrap();
        let line = "exec \"$0\" plot job.json --form form.pf --control c.toml -o x.svg";
        let mut shell = Command::new("sh");
        let output = shell.args(["-c", line, env!("CARGO_BIN_EXE_postform")]).current_dir(&folder.0).output().unwrap();
        expect(input, &output, 2, &["is an input"]);
        fs::remove_file(folder.0.join("x.svg")).unwrap();
    }
    expect("standard input", &run("- --from json -o job.json", "< job.json"), 2, &["is an input"]);
    // program and source map in the same file: by another name, through a link without a target, or by a redirection of
    // the shell
    symlink("new.nc", folder.0.join("link")).unwrap();
    for (arguments, redirect) in
        [("-o new.nc --trace ./new.nc", ""), ("-o link --trace new.nc", ""), ("--trace new.nc", "> new.nc")]
    {
        expect(arguments, &run(&format!("job.json {arguments}"), redirect), 2, &["can't be the same file"]);
        _ = fs::remove_file(folder.0.join("new.nc"));
    }
    assert_eq!(texts(), before);
    // a link without a target is followed, a link to itself is an error, and a file called - is not standard input
    expect("a link to nothing yet", &run("job.json -o link", ""), 0, &[]);
    assert!(folder.0.join("link").is_symlink() && folder.0.join("new.nc").is_file());
    symlink("circle", folder.0.join("circle")).unwrap();
    expect("a circle of links", &run("job.json -o circle", ""), 2, &["can't write circle"]);
    folder.write("-", "");
    expect("a file called -", &run("- --from json", "< job.json"), 0, &[]);
}

/// `postform explain` answers very long names at once.
#[test]
fn long_questions_are_answered() {
    for what in ["a ".repeat(50_000), "a".repeat(100_000)] {
        let output = Command::new(env!("CARGO_BIN_EXE_postform")).args(["explain", &what]).output().unwrap();
        expect("a long question", &output, 2, &["`a"]);
        assert!(output.stderr.len() < 1000, "{} bytes", output.stderr.len());
    }
}

/// A message about a long list of tools names only some of them.
#[test]
fn many_tools() {
    use postform::internals::json::read_document;
    use postform::toolpath::{ReadError, Summary};
    let tools: Vec<String> = (2..=60_000).map(|number| format!("{{\"number\":{number}}}")).collect();
    let text = job("{\"line\":[1,1,0]}").replace("{\"number\":2}", &tools.join(","));
    read_document(text.as_bytes(), &mut Summary::default()).unwrap();
    let missing = text.replace("\"tool\":1,", "\"tool\":70000,");
    let Err(ReadError::Job(diag)) = read_document(missing.as_bytes(), &mut Summary::default()) else { panic!() };
    let help = diag.help.unwrap();
    assert!(help.len() < 300 && help.ends_with(" and others"), "{help}");
}

/// A form and the forms that it calls may have at most 512 KB together.
#[test]
fn forms_have_a_size() {
    let folder = Folder::new("large_forms");
    let job = folder.write("job.json", job("{\"line\":[1,1,0]}"));
    let part = "# a comment\n".repeat(25_000);
    folder.write("a.pf", &part);
    folder.write("b.pf", &part);
    let form = folder.write("form.pf", mill("Call a.pf\nCall b.pf", ""));
    let wanted = ["PF009", "`b.pf` makes the form larger than 512 KB"];
    expect("two large parts", &render(&folder, &job, &form), 1, &wanted);
    let form = folder.write("form.pf", format!("{part}{part}{}", mill("", "")));
    expect("a large form", &render(&folder, &job, &form), 2, &["form.pf is larger than 512 KB"]);
}

/// A short job that would print an extremely long program needs the option `--huge`.
#[test]
fn a_program_far_longer_than_its_job_is_asked_about() {
    let folder = Folder::new("huge");
    // the test uses long comments, because long blocks print faster than short blocks with the same number of
    // characters
    let comment = "A".repeat(200);
    let form = folder.write("form.pf", mill("", &format!("LineCode\nG1 X[h] Y[v] Z[d] F[frate] ({comment})\nEnd")));
    let points = vec!["[0,0,0]"; 1_000].join(",");
    let cycle = format!(
        "{{\"cycle\":{{\"kind\":\"deep\",\"depth\":99,\"clear\":1,\"feed\":100,\"step\":0.01,\"emulate\":true,\"points\":[{points}]}}}}"
    );
    let job = folder.write("job.json", job(&cycle));
    // `--no-verify`, because this test does not need a proof of 100 MB
    let output = render_with(&folder, &job, &form, &["--no-verify"]);
    expect("a huge program", &output, 1, &["PR028", "100 MB of program", "--huge", "job.json:"]);
}

/// Names, values and messages from files or arguments never send control characters to the terminal.
#[test]
fn no_file_and_no_argument_steers_the_terminal() {
    let folder = crate::support::folder::Folder::new("steers");
    let bad = "\u{1b}]0;X\u{7}\u{9b}31m\u{202e}";
    folder.write("x.nc", "M30\n");
    folder.write("c.toml", "name = \"c\"\nlike = \"\\u001b]0;X\\u0007\\u009b31m\\u202e\"\n");
    folder.write("f.pf", mill(&format!("Property lift number 1 {bad}"), ""));
    for args in [
        &["simulate", "x.nc", "--control", "c.toml"][..],
        &["properties", "f.pf"],
        &["properties", "f.pf", "--format", "json"],
        &["lint", "f.pf", "--format", bad],
        &[bad],
    ] {
        let output = folder.run(args);
        let text = String::from_utf8([output.stdout, output.stderr].concat()).unwrap();
        assert!(!text.is_empty(), "{args:?}");
        let steers = |c: char| c != '\n' && postform::internals::terminal::steers(c);
        assert!(!text.chars().any(steers), "{args:?}: {text:?}");
    }
}

/// For a folder in place of a job, the message names the option for folders.
#[test]
fn a_folder_is_not_a_job() {
    let folder = folder::Folder::new("folder-not-job");
    let form = root().join("postforms/haas.pf");
    let output = folder.run(&["render", ".", "--form", form.to_str().unwrap()]);
    let said = err(&output);
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.contains("it is a folder") && said.contains("--out-dir OUT"), "{said}");
}

/// A job in place of a program is refused. Earlier versions read the job as codes.
#[test]
fn a_job_is_not_a_program() {
    let job = root().join("samples/bracket/job.json");
    let job = job.to_str().unwrap();
    let machine = root().join("samples/bracket/vf2.toml");
    let folder = folder::Folder::new("job-not-program");
    for arguments in [
        vec!["simulate", job],
        vec!["fit", job, "--machine", machine.to_str().unwrap()],
        vec!["restart", job, "--tool", "2"],
    ] {
        let output = folder.run(&arguments);
        let said = err(&output);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {said}");
        assert!(said.contains("is a job, not an NC program"), "{arguments:?}: {said}");
    }
}

/// Commands show all letters of comments in Windows-1252, as in old programs. Earlier versions lost these letters.
#[test]
fn letters_of_old_programs_are_shown() {
    let folder = folder::Folder::new("old-letters");
    let program = |x: &str| {
        let text = format!(
            "%\nO1\nG21 G90 G17 G40 G49 G80\nT1 M6\n(FR\u{c4}SEN)\nG54 G0 X0 Y0 S500 M3\nG43 H1 Z10.\nG1 Z-1. F100.\nX{x}\n\
             G0 Z50.\nM30\n%\n"
        );
        text.chars().map(|c| c as u8).collect::<Vec<_>>()
    };
    folder.write("old.nc", program("1."));
    folder.write("new.nc", program("1.\nA\u{e4}"));
    folder.write("empty.nc", "%\n");
    for (arguments, shown) in [
        (&["simulate", "old.nc"][..], "comment  FR\u{c4}SEN"),
        (&["simulate", "new.nc"], "`\u{e4}`"),
        (&["diff", "old.nc", "empty.nc"], "FR\u{c4}SEN"),
        (&["diff", "old.nc", "empty.nc", "--format", "json"], "FR\u{c4}SEN"),
        (&["diff", "old.nc", "empty.nc", "--format", "html"], "FR\u{c4}SEN"),
        (&["diff", "old.nc", "new.nc"], "A\u{e4}"),
    ] {
        let output = folder.run(arguments);
        let said = out(&output) + &err(&output);
        assert!(said.contains(shown) && !said.contains('\u{fffd}'), "{arguments:?}: {said}");
    }
    // the comment is found, and its bytes are printed unchanged
    let restart = folder.run(&["restart", "old.nc", "--operation", "fr\u{e4}sen"]);
    assert!(restart.stdout.windows(7).any(|bytes| bytes == b"(FR\xc4SEN"), "{}", err(&restart));
}
