//! Backquoted text and texts of the job: output, omissions, errors.

use crate::support::{check, mill, program, render, render_checked};
use postform::internals::render::{Clock, Options};

/// A form whose tool change prints these lines.
fn form(head: &str, lines: &str) -> String {
    mill(head, "").replacen("1stToolChange\n", &format!("1stToolChange\n{lines}\n"), 1)
}

/// A job with these keys in its head, its tool and its operation.
fn job(head: &str, tool: &str, operation: &str) -> String {
    format!(
        "{{\"postform\":1,\"units\":\"inch\",{head} \"tools\":[{{\"number\":1{tool}}}],\"operations\":[{{\"tool\":1,\"work\":54,\
         \"spindle\":{{\"speed\":1000,\"direction\":\"cw\"}},\"feed\":10{operation},\"path\":[{{\"rapid\":[0,0,1]}}]}}]}}"
    )
}

/// The output of these lines in a tool change.
fn lines(head: &str, lines: &str, job: &str) -> Vec<String> {
    let mut printed = program(&form(head, lines), job);
    if printed.len() > 1 {
        let change = |line: &String| ["T1 M6", "T1M6", "T1 M6;", "N110 T1 M6"].contains(&line.as_str());
        let end = printed.iter().position(change).unwrap_or_else(|| panic!("{printed:?}"));
        printed = printed[1..end].to_vec();
    }
    printed
}

fn codes(form: &str) -> Vec<&'static str> {
    check(form).diags.iter().filter(|diag| diag.is_error()).map(|diag| diag.code.name()).collect()
}

const PLAIN: &str = "\"name\":\"Flange\",";

#[test]
fn backquoted_text_prints_as_it_stands() {
    let table = [
        ("`#500=1`", "#500=1"),
        ("`IF [#1 GT 2] GOTO 5`", "IF [#1 GT 2] GOTO 5"),
        ("`two  blanks # and no comment`", "two  blanks # and no comment"),
        ("`END PGM`", "END PGM"),
        ("`a``b`", "a`b"),
        ("````", "`"),
        ("`a` `b`", "a b"),
        ("`R1=`[speed]`; (x`", "R1=1000; (x"),
        ("G4`X`[speed]", "G4X1000"),
        ("(`a  b` [speed])", "(a  b 1000)"),
        ("`End`", "End"),
    ];
    for (line, printed) in table {
        assert_eq!(lines("", line, &job(PLAIN, "", "")), [printed], "{line}");
    }
}

#[test]
fn replace_changes_what_stands_around_backquotes() {
    let head = "Sequence#s N 100 10\nReplace A BB\nReplace BB C\nReplace C CC";
    assert_eq!(lines(head, "A `AB`A A`A` `C`", &job(PLAIN, "", ""))[0], "N100 CC ABCC CCA C");
}

#[test]
fn spaces_and_letters_leave_backquotes_alone() {
    assert_eq!(lines("Spaces? N\nRename X Y", "M1 `X 1` M2", &job(PLAIN, "", "")), ["M1X 1M2"]);
    assert_eq!(lines("EOB ;", "`X 1`", &job(PLAIN, "", "")), ["X 1;"]);
}

#[test]
fn texts_have_widths() {
    let job = job(PLAIN, ",\"name\":\"drill 8\"", "");
    let table = [
        ("([toolname:10]|)", "(DRILL 8   |)"),
        ("([toolname:-10]|)", "(   DRILL 8|)"),
        ("([toolname:3]|)", "(DRI|)"),
        ("([TOOLNAME:-3])", "(DRI)"),
        ("`<`[toolname]`>`", "<drill_8>"),
        ("_[toolname]", "_drill_8"),
        ("`M`[progname].MPF", "MFlange.MPF"),
    ];
    for (line, printed) in table {
        assert_eq!(lines("", line, &job), [printed], "{line}");
    }
}

#[test]
fn what_the_job_does_not_say_is_left_out_with_its_comment() {
    let none = job("", "", "");
    assert!(lines("", "(TOOL [toolname] [tooltext])", &none).is_empty());
    assert_eq!(lines("", "M1 (TOOL [toolname]) M2", &none), ["M1 M2"]);
    assert_eq!(lines("", "(ANY [speed])", &none), ["(ANY 1000)"]);
    assert_eq!(lines("Comment ;", "; TOOL [toolname]", &none), [""; 0]);
    assert_eq!(lines("", "`MSG(\"`[opname]`\")`", &none), ["MSG(\"\")"]);
    let some = job("", ",\"comment\":\"carbide\"", "");
    assert_eq!(lines("", "(TOOL [toolname] [tooltext])", &some), ["(TOOL  CARBIDE)"]);
}

#[test]
fn a_comment_fits_its_control() {
    let long = format!("\"name\":\"{}\",", "a (b) % \\u00e9".repeat(30));
    let printed = lines("Control linuxcnc", "(NAME [progname] END)", &job(&long, "", ""));
    assert_eq!(printed.len(), 1);
    assert!(printed[0].starts_with("(NAME A [B] _ EA [B] _ E") && printed[0].ends_with(" END)"));
    assert!(printed[0].len() <= 252, "{}", printed[0].len());
    let notes = render(&form("Control linuxcnc", "(NAME [progname] END)"), &job(&long, "", "")).unwrap().notes;
    assert!(notes.iter().any(|note| note.code.name() == "PR050" && note.message.contains("is cut to")));
}

#[test]
fn a_tool_change_that_says_the_comment_says_it_alone() {
    let job = job("", "", ",\"comment\":\"deburr\"");
    assert_eq!(lines("", "(OP [optext])", &job), ["(OP DEBURR)"]);
    assert_eq!(lines("", "(OP [opname])", &job), ["(DEBURR)"]);
}

#[test]
fn clock_file_and_form_are_the_callers() {
    let form = check(&form("Name Mill 3\nControl haas", "([date] [time] [jobfile] [formname] [control] [version])"));
    let clock = Some(Clock { date: "2026-03-31".into(), time: "14:05".into() });
    let options = Options { clock, job_file: Some("a.json".into()), ..Options::default() };
    let text = render_checked(&form, job("", "", "").as_bytes(), false, options).unwrap().text;
    let version = env!("CARGO_PKG_VERSION");
    assert!(text.contains(&format!("(2026-03-31 14:05 A.JSON MILL 3 HAAS {version})")), "{text}");
}

#[test]
fn wrong_texts_are_refused() {
    let table = [
        ("[toolname]", "PF701"),
        ("[toolname] M6", "PF701"),
        ("[toolname][progname]", "PF701"),
        ("T[toolname]", "PF701"),
        ("X[h][toolname]`a`", "PF701"),
        ("`a`[toolname]M6", "PF701"),
        ("``[toolname]", "PF701"),
        ("([toolname:0])", "PF702"),
        ("([toolname:])", "PF702"),
        ("`a`[toolname:1000]", "PF702"),
        ("([tool:5])", "PF202"),
        ("([toolnam])", "PF202"),
        ("`a", "PF001"),
        ("a` `b` c", "PF001"),
        ("`a\u{200b}b`", "PF001"),
    ];
    for (line, code) in table {
        let mut found = codes(&form("", line));
        found.dedup();
        assert_eq!(found, [code], "{line}");
    }
}

/// A closing bracket in a text would end the comment, and the control would execute the rest. postform replaces the
/// bracket, whatever comment marks the form has.
#[test]
fn a_text_stays_in_its_brackets() {
    let job = job("", ",\"name\":\"X)G0 Z-5(;\"", "");
    for head in ["Control linuxcnc\nComment ;", "Control grbl\nComment ;", "", "Comment ;"] {
        assert_eq!(lines(head, "(TOOL [toolname])", &job), ["(TOOL X]G0 Z-5[;)"], "{head}");
    }
    assert_eq!(lines("Comment ;", "; TOOL [toolname]", &job), ["; TOOL X)G0 Z-5(;"]);
}

/// A form must not print a name of the job as a separate word, not even after a blank, a decimal point or the slash of
/// block delete.
#[test]
fn a_name_alone_is_refused_wherever_it_stands() {
    for word in ["` `[toolname]", "[toolname].", "`/`[toolname]", "[toolname]`_X`", "`/ . `[toolname]"] {
        assert_eq!(codes(&form("", word)), ["PF701"], "{word}");
    }
    for word in ["`\"`[toolname]`\"`", "`T=`[toolname]", "`CALL `[toolname]"] {
        assert_eq!(codes(&form("", word)), [""; 0], "{word}");
    }
}

/// If the line limit of the control is unknown, postform limits blocks to 4096 characters. A longer name is cut, and
/// the program is printed.
#[test]
fn a_long_name_is_cut_where_no_control_says_how_long() {
    let name = format!(",\"name\":\"{}\"", "A".repeat(10_000));
    let printed = lines("Control haas", "(T [toolname] X)", &job("", &name, ""));
    assert_eq!(printed.iter().map(String::len).collect::<Vec<_>>(), [4096]);
    assert!(printed[0].ends_with(" X)"));
}

/// Between quotation marks, a text keeps its blanks and signs, except those that would end the quotation or the block,
/// or begin a comment.
#[test]
fn between_quotation_marks_blanks_stay() {
    let print = |line: &str, name: &str| lines("", line, &job("", "", &format!(",\"name\":\"{name}\"")))[0].clone();
    assert_eq!(print("`MSG(\"`[opname]`\")`", "rough, side 1: [2] + 3"), "MSG(\"rough, side 1: [2] + 3\")");
    assert_eq!(print("`MSG(\"`[opname]`\")`", "a\\\"b;c(d)e%f|g\\u00e9"), "MSG(\"a_b_c_d_e_f_g_\")");
    // after the second quotation mark, the quotation has ended
    assert_eq!(print("`MSG(\"a\")_`[opname]", "b c"), "MSG(\"a\")_b_c");
}

/// A tool name outside a comment selects the tool. So each tool needs a name, and no two names may be equal.
#[test]
fn a_tool_has_a_name_of_its_own() {
    let none = job("", "", "");
    let error = &lines("", "`T=\"`[toolname]`\"`", &none)[0];
    assert!(error.starts_with("PR001 [toolname] has no value here"), "{error}");
    let two = |first: &str, second: &str| {
        format!(
            "{{\"postform\":1,\"units\":\"inch\",\"tools\":[{{\"number\":1,\"name\":\"{first}\"}},{{\"number\":2,\"name\":\"{second}\"}}],\"operations\":[\
             {{\"tool\":1,\"work\":54,\"spindle\":{{\"speed\":9,\"direction\":\"cw\"}},\"path\":[{{\"rapid\":[0,0,1]}}]}},\
             {{\"tool\":2,\"work\":54,\"spindle\":{{\"speed\":9,\"direction\":\"cw\"}},\"path\":[{{\"rapid\":[0,0,1]}}]}}]}}"
        )
    };
    let form = mill("", "").replace("T[tool] M6", "`T=\"`[toolname]`\"`\nM6");
    assert!(
        program(&form, &two("EM;12", "EM_12"))[0]
            .starts_with("PR057 the tools `EM;12` and `EM_12` both print as EM_12")
    );
    assert!(program(&form, &two("EM;12", "EM;12")).contains(&"T=\"EM_12\"".to_owned()));
    // a blank is kept between quotation marks, so these are two different names
    assert!(program(&form, &two("EM 12", "EM_12")).contains(&"T=\"EM 12\"".to_owned()));
}

/// Text in backquotes is one word, together with the text that touches it.
#[test]
fn a_backquoted_line_is_no_sixteen_words() {
    let call = "`MCALL CYCLE84(`[h]`,`[v]`,`[d]`,`[h]`,,0,`[v]`,,`[d]`,0,`[speed]`,`[speed]`)`";
    assert_eq!(codes(&form("", call)), [""; 0]);
    assert_eq!(codes(&form("", &"M1 ".repeat(16))), ["PF601"]);
}
