//! The canonical layout is idempotent and does not change programs. Tested with all shipped forms and with many
//! variants of their layout.

use crate::support;
use std::fs;
use std::process::{Command, Stdio};

use crate::support::pages::{Page, checked};
use crate::support::{root, sample_form, samples};
use postform::internals::fmt::format;
use postform::internals::lint::Levels;
use postform::internals::render::Options;
use postform::internals::sema::Checked;
use postform::internals::source::Source;
use proptest::prelude::*;

fn laid_out(text: &str) -> String {
    format(&Source::from_text("form.pf", text))
}

/// Posts, sample forms, and the code blocks on the pages of the rules.
fn forms() -> Vec<String> {
    let posts = fs::read_dir(root().join("postforms")).unwrap().map(|e| e.unwrap().path());
    let own = samples().into_iter().filter_map(|folder| sample_form(&folder));
    let mut forms: Vec<String> = posts.chain(own).map(|path| fs::read_to_string(path).unwrap()).collect();
    for row in postform::diag::CODES.iter().filter(|row| row.name.starts_with("PF")) {
        let page = Page::read(row.name);
        forms.extend(["Example", "Better"].map(|part| page.fence(part).checked().files[0].text.clone()));
    }
    forms
}

/// The programs of these samples; for a sample that can't be printed, the error code.
fn programs(form: &Checked, folders: &[std::path::PathBuf]) -> Vec<Result<String, &'static str>> {
    let form = support::ready(form);
    let one = |folder: &std::path::PathBuf| {
        let options = Options { program: Some(1), ..Options::default() };
        let rendered = support::render_ready_sample(folder, &form, options);
        rendered.map(|rendered| rendered.text).map_err(|diag| diag.code.name())
    };
    folders.iter().map(one).collect()
}

#[test]
fn what_ships_renders_the_same_and_stays_as_it_is() {
    let folders = samples();
    let mut changed = 0;
    for text in forms() {
        let once = laid_out(&text);
        if once == text {
            continue;
        }
        changed += 1;
        assert_eq!(laid_out(&once), once, "not idempotent:\n{text}");
        let (before, after) = (checked(text.as_bytes()), checked(once.as_bytes()));
        assert_eq!(programs(&before, &folders), programs(&after, &folders), "{text}\n--- laid out\n{once}");
        // findings stay the same, except those about the layout; findings about lost words always stay
        let layout = ["PF102", "PF103", "PF107", "PF204"];
        let codes = |form: &Checked| {
            let found = postform::internals::lint::lint(form, &Levels::default()).diags;
            found.iter().map(|diag| diag.code.name()).filter(|code| !layout.contains(code)).collect::<Vec<_>>()
        };
        assert_eq!(codes(&before), codes(&after), "{text}\n--- laid out\n{once}");
    }
    assert!(changed > 50, "{changed}");
}

#[test]
fn posts_that_ship_are_laid_out() {
    let output = Command::new(env!("CARGO_BIN_EXE_postform"))
        .args(["fmt", "--check", "postforms"])
        .current_dir(root())
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}

#[test]
fn files_are_laid_out_in_place_and_standard_input_is_a_filter() {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("fmt");
    _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    let path = folder.join("form.pf");
    let text = support::mill("RAPID; g0", "LINECODE\r\nG1 x<h>Y[v]  Z[d]\r\nend");
    fs::write(&path, &text).unwrap();
    let run = |args: &[&str]| Command::new(env!("CARGO_BIN_EXE_postform")).args(args).arg(&path).output().unwrap();
    let check = run(&["fmt", "--check"]);
    assert_eq!(check.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&check.stderr).contains("would be formatted"));
    assert_eq!(fs::read_to_string(&path).unwrap(), text, "--check writes nothing");
    assert_eq!(run(&["fmt"]).status.code(), Some(0));
    let once = fs::read_to_string(&path).unwrap();
    assert!(once.contains("Rapid g0\n") && once.contains("\n\nLineCode\nG1 x[h] Y[v]   Z[d]\nEnd\n"), "{once}");
    assert_eq!(run(&["fmt", "--check"]).status.code(), Some(0));

    let mut filter = Command::new(env!("CARGO_BIN_EXE_postform"));
    let mut child = filter.args(["fmt", "-"]).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().unwrap();
    std::io::Write::write_all(&mut child.stdin.take().unwrap(), text.as_bytes()).unwrap();
    let output = child.wait_with_output().unwrap();
    assert_eq!(String::from_utf8(output.stdout).unwrap(), once);
}

/// Changes the layout of a form's line without changing its meaning.
fn change(line: &str, kind: u8) -> String {
    match kind {
        0 => format!("{line}  "),
        1 => format!("{line} # a note"),
        2 => format!("{line}\t# another"),
        3 => format!("{line}\r"),
        4 => format!("\n{line}"),
        5 => format!("{line}\n\n# on its own"),
        6 => format!("{line}\n   a remark by indenting"),
        // changes the case of sequences, commands and variables, but not of letters
        7 => line.replace("End", "END").replace("StartCode", "STARTCODE").replace("[h]", "[H]"),
        8 => line.replace('[', "<").replace(']', ">"),
        9 => line.replace("] F[", "]F[").replace("] Y[", "]Y["),
        // an argument directly after the semicolon, or a tab in a comment
        11 if line.starts_with("Dwell ") => line.replacen(' ', ";", 1),
        12 if line.starts_with("Custom") => format!("{line}\tfor this mill"),
        13 if line.starts_with("Comment ") || line.starts_with("Control ") => line.replacen(' ', "; ", 1),
        10 if !line.starts_with([' ', '#', '\t']) && !line.is_empty() => format!(" {line}"),
        _ => line.to_owned(),
    }
}

static FORMS: std::sync::LazyLock<Vec<String>> = std::sync::LazyLock::new(forms);

/// A tab in backquotes is printed like any other character, so no fix removes it.
#[test]
fn a_tab_in_backquotes_is_text() {
    let tabs = |line: &str| {
        let form = format!("Drill\n{line}\nG81 X[h] Y[v] Z[d] R[vclear] F[frate]\nEnd\n");
        let checked = support::check(&form);
        let diags = postform::internals::lint::lint(&checked, &Levels::default()).diags;
        diags.iter().filter(|diag| diag.code.name() == "PF103").count()
    };
    assert_eq!(tabs("`MSG(\"A\tB\")`"), 0);
    assert_eq!(tabs("`MSG`\t`(A\tB)`"), 1);
}

/// A name alone in brackets is a variable, even with blanks around it. A calculation keeps its blanks.
#[test]
fn names_with_blanks_around_them_are_names() {
    let text = |word: &str| format!("LineCode\nG1 {word} F[frate]\nEnd\n");
    for (typed, wanted) in
        [("X[H\t]", "X[h]"), ("X[ H ]", "X[h]"), ("`T=`[ToolName ]", "`T=`[toolname]"), ("X[H + 1 ]", "X[H + 1]")]
    {
        let once = laid_out(&text(typed));
        assert_eq!(once, text(wanted), "{typed}");
        assert_eq!(laid_out(&once), once, "{typed}");
        let errors = |form: &str| support::check(form).diags.iter().filter(|diag| diag.is_error()).count();
        assert_eq!(errors(&text(typed)), errors(&once), "{typed}");
    }
}

/// Text that is not a word stays as typed, together with the words that touch it. If `a<0>` were changed alone, it
/// would lose its brackets.
#[test]
fn text_that_is_no_word_stays_as_typed() {
    let form = "Drill\n>a<0>0\nEnd\n";
    assert!(laid_out(form).contains(">a<0>0"), "{}", laid_out(form));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(600))]
    #[test]
    fn other_layouts_come_to_the_same(
        which in any::<prop::sample::Index>(),
        kinds in prop::collection::vec(0..14u8, 60),
        crlf: bool,
    ) {
        let text = which.get(FORMS.as_slice());
        let end = if crlf { "\r\n" } else { "\n" };
        let other: String =
            text.lines().zip(kinds.iter().cycle()).map(|(line, kind)| change(line, *kind) + end).collect();
        let once = laid_out(&other);
        prop_assert_eq!(&laid_out(&once), &once, "not idempotent");
        let folders = ["bracket", "drill-machine", "wire", "lathe-part"].map(|name| root().join("samples").join(name));
        let (before, after) = (checked(other.as_bytes()), checked(once.as_bytes()));
        prop_assert_eq!(programs(&before, &folders), programs(&after, &folders), "{}\n--- laid out\n{}", other, once);
    }

    /// For any text, formatting ends, gives a stable layout, and keeps the findings that prevent printing.
    #[test]
    fn any_text_has_a_layout(text in "(([A-Za-z0-9#;%:()\\[\\]<>.+~ \t\"-]{0,20}|End|Drill|StartCode|X->3.>4|Rapid G0|End Cancel|X\\[h\\] Y\\[v\\])\r?\n){0,30}") {
        // the head of the form is correct, so all errors come from the text
        let text = format!("{text}\n{}", support::mill("", ""));
        let once = laid_out(&text);
        prop_assert_eq!(&laid_out(&once), &once);
        let (before, after) = (checked(text.as_bytes()), checked(once.as_bytes()));
        let errors = |form: &Checked| {
            let errors = form.diags.iter().filter(|diag| diag.is_error());
            errors.map(|diag| diag.code.name()).collect::<Vec<_>>()
        };
        prop_assert_eq!(errors(&before), errors(&after), "{}\n--- laid out\n{}", text, once);
        prop_assert_eq!(before.form.sequences.len(), after.form.sequences.len());
    }
}

/// `fmt` leaves a file unchanged if the file name or a line shows that the file is not a form.
#[test]
fn what_is_no_form_is_left_alone() {
    use crate::support::folder::{Folder, err};
    let folder = Folder::new("no-form");
    let table: [(&str, &[u8]); 5] = [
        ("O12.nc", b"M30\n"),
        ("Makefile", b"all:\n\tgcc x.c\n"),
        ("p.pf", b"%\nO1 (A)\nG0 X1\n%\n"),
        ("elf.pf", b"\x7fELF\x02\x01\0\0\n"),
        ("README.md", b"# A  title\n"),
    ];
    for (name, text) in table {
        folder.write(name, text);
        let output = folder.run(&["fmt", name]);
        assert_eq!((output.status.code(), fs::read(folder.0.join(name)).unwrap()), (Some(1), text.to_vec()), "{name}");
        let subject = if name.ends_with(".pf") { name } else { "it" };
        assert!(err(&output).contains(&format!("{subject} is not changed")), "{}", err(&output));
    }
    folder.run(&["lint", "--fix", "Makefile"]);
    assert_eq!(folder.read("Makefile"), "all:\n\tgcc x.c\n");
    // these inputs are formatted: a file that a form calls, a file with `--force`, and standard input
    folder.write("form.pf", support::mill("Call part.inc", ""));
    folder.write("part.inc", "RapidCode\nG0 X<h> Y[v] Z[d]\nEnd\n");
    assert_eq!(folder.run(&["fmt", "part.inc"]).status.code(), Some(0));
    assert!(folder.read("part.inc").contains("X[h]"));
    assert_eq!(folder.run(&["fmt", "--force", "O12.nc"]).status.code(), Some(0));
    assert_eq!(folder.read("O12.nc"), "M 30\n");
    assert_eq!(folder.feed(&["fmt", "-"], b"M30\n").stdout, b"M 30\n");
}
