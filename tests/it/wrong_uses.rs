//! Wrong uses of features that the manual does not describe: the finding, its location, and the correction.
//! tests/data/wrong-uses.txt contains the messages. `SAMPLES=overwrite cargo test wrong_uses::` writes it again; review
//! it as a machinist would.

use std::fmt::Write as _;
use std::fs;

use postform::diag::Severity;
use postform::internals::lint::lint;

use crate::support::{assert_same, check, plain_post, root};

/// The position of the lines in postforms/haas.pf.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Place {
    /// Before its first sequence.
    Head,
    /// In its first tool change.
    Change,
    /// After its last sequence, in place of the form's own sequence.
    Behind,
}

use Place::{Behind, Change, Head};

const WRONG: &[(Place, &str)] = &[
    (Change, "T[tool] `M6"),
    (Change, "[toolname]"),
    (Change, "M[toolname]"),
    (Change, "T[tolname] M6"),
    (Change, "(TOOL [toolname:x])"),
    (Change, "@if [progname:3] = \"LID\"\n(X)\n@end"),
    (Change, "@ if [tool] = 1\n(X)\n@end"),
    (Change, "IF [#1 GT 2] GOTO 5"),
    (Behind, "EndCut\nM5\nEnd"),
    (Change, "(TOOL [toolname:200])"),
    (Change, "X[h:8]"),
    (Change, "(TOOL [tool:8])"),
    (Change, r#"`T="`[toolnam]`"`"#),
    (Change, "Z[d+]"),
    (Change, "Z[d+2"),
    (Change, "Z[(d+2]"),
    (Change, "Z[d/0]"),
    (Change, "Z[d+toolname]"),
    (Change, "Z[sqrt(d)]"),
    (Change, "Z[abs(d,2)]"),
    (Change, "Z[abs()]"),
    (Change, "Z[d ** 2]"),
    (Change, "Z[d^2]"),
    (Change, "Z[depth^2]"),
    (Change, "X[#500]"),
    (Change, "@if tool = 1\nM8\n@end"),
    (Change, "Z[2d]"),
    (Change, "Z[d,5]"),
    (Change, "Z[d+1,5]"),
    (Change, "Z[dd+1]"),
    (Change, "Z[d>2]"),
    (Change, "Z[d=2]"),
    (Change, "Z[d]+2"),
    (Change, "@if [cool] = throgh\nM88\n@end"),
    (Change, "@if [cool] = high\nM88\n@end"),
    (Change, "@if cool = on\nM88\n@end"),
    (Change, "@if [cool] == on\nM88\n@end"),
    (Change, "@if [cool] != on\nM88\n@end"),
    (Change, "@if [speed] > 0 && [cool] = on\nM88\n@end"),
    (Change, "@if [toolname] = DRILL*\nM88\n@end"),
    (Change, "@if [toolname] = \"DRILL*\"\nM88\n@end"),
    (Change, "@if [toolname] like DRILL*\nM88\n@end"),
    (Change, "@if [toolname] = 'DRILL'\nM88\n@end"),
    (Change, "@if [toolname] > 5\nM88\n@end"),
    (Change, "@if [speed] = \"fast\"\nM88\n@end"),
    (Change, "@if 1 = 1\nM88\n@end"),
    (Change, "@if [speed] and 1 = 2\nM88\n@end"),
    (Change, "@if\nM88\n@end"),
    (Change, "@if [speed] >\nM88\n@end"),
    (Change, "@if [speed] 5\nM88\n@end"),
    (Change, "@if [speed] > 5\nM88"),
    (Change, "M88\n@end"),
    (Change, "@else\nM88\n@end"),
    (Change, "@if [cool] = on\nM88\n@else\nM9\n@elif [cool] = mist\nM7\n@end"),
    (Change, "@if [cool] = on\nM88\n@elseif [cool] = mist\nM7\n@end"),
    (Change, "@if [cool] = on\nM88\n@else if [cool] = mist\nM7\n@end"),
    (Change, "@if [cool] = on\nM88\n@endif"),
    (Change, "@fi [cool] = on\nM88\n@end"),
    (Change, "@if [cool] = on then\nM88\n@end"),
    (Change, "@if ([cool] = on\nM88\n@end"),
    (Change, "if [tool] = 1\nM88\nendif"),
    (Change, "IF [tool] = 1 THEN M88"),
    (Change, "@if [tool] = 1 M88"),
    (Change, "@if [direct] = 3 or cw\nM88\n@end"),
    (Change, "@set val11 = 2"),
    (Change, "@set tool = 2"),
    (Change, "@set val1 2"),
    (Change, "@set val1 = "),
    (Change, "@set val1 := 2"),
    (Change, "@set [val1] = [d]+"),
    (Change, r#"@set val1 = "TEXT""#),
    (Change, "val1 = 2"),
    (Change, "@for tools\n(T[tool])\n@end"),
    (Change, "@for each tool\n(T[tool])\n@end"),
    (Change, "@for tool\n(T[tool])"),
    (Change, "@for tool\n@for work\n(T[tool])\n@end\n@end"),
    (Change, "@for tool\n@end"),
    (Change, "@for tool\nM1\n@else\nM2\n@end"),
    (Change, "@for tool\n(HELLO)\n@end"),
    (Change, "@for\n(HELLO)\n@end"),
    (Head, "Property Through choice(off,on) off Coolant"),
    (Head, "Property speed number 5 Speed"),
    (Head, "Property lift lenght 5 Lift"),
    (Head, "Property lift length five Lift"),
    (Head, "Property lift"),
    (Head, "Property through choice(off, on) off Coolant"),
    (Head, "Property through choice off Coolant"),
    (Head, "Property header bool yes Header"),
    (Head, "Property my-lift length 5 Lift"),
    (Head, "Property a number 1 A\nProperty a number 2 B"),
    (Head, "Property and number 1 A"),
    (Change, "@if [header]\nM1\n@end"),
    (Behind, "Operations\n(A)\nEnd"),
    (Behind, "Comment\n([text])\nEnd"),
    (Behind, "CommentLine\n(A)\nEnd"),
    (Behind, "Drill\n@for tool\nG81 X[h] Y[v] Z[d] R[vclear] F[frate]\n@end\nEnd Cancel"),
    (Behind, "Drill\n@if [dwell]\nG82 X[h] Y[v] Z[d] R[vclear] P[dwell] F[frate]\n@end\nEnd Cancel"),
    (Behind, "RapidCode\n@if [tool] = 1\nG0 X[h] Y[v] Z[d]\n@end\nEnd"),
    (Head, "CoolantKind thru M88"),
    (Head, "CoolantKind through M88\nCoolantKind through M89"),
    (Head, "CoolantKind flood M88"),
    (Head, "CoolantKind through"),
    (Head, "LineEnd windows"),
    (Head, "@if [tool] = 1"),
    (Change, "(X[hmim])"),
    (Change, "@set through = high"),
    (Head, "ProgramName O[tool]"),
    (Head, "ProgramName part one"),
    (Head, "Extension .n/c"),
    (Head, "Extension"),
];

fn form(place: Place, lines: &str) -> String {
    let haas = plain_post("haas.pf");
    match place {
        Head => haas.replacen("StartCode\n", &format!("{lines}\n\nStartCode\n"), 1),
        Change => haas.replacen("1stToolChange\n", &format!("1stToolChange\n{lines}\n"), 1),
        Behind => {
            let name = lines.lines().next().unwrap();
            let own = haas.find(&format!("\n{name}\n")).map(|at| {
                let end = haas[at..].find("\nEnd").unwrap();
                let line = haas[at + end + 1..].find('\n').unwrap();
                at + 1..at + end + 1 + line + 1
            });
            let mut haas = haas;
            own.into_iter().for_each(|own| haas.replace_range(own, ""));
            format!("{haas}\n{lines}\n")
        }
    }
}

#[test]
fn each_is_answered_with_what_to_type() {
    let mut said = String::new();
    for &(place, lines) in WRONG {
        let text = form(place, lines);
        let checked = check(&text);
        let mut found = lint(&checked, &Default::default()).diags;
        found.retain(|diag| diag.severity != Severity::Note);
        found.sort_by_key(|diag| diag.labels.first().map(|label| label.span.start));
        assert!(!found.is_empty(), "nothing is said of\n{lines}");
        let first = text.lines().position(|line| Some(line) == lines.lines().next()).unwrap();
        _ = writeln!(said, "{lines}");
        for diag in found {
            let at = &diag.labels[0].span;
            let (line, column) = checked.files[0].line_column(at.start);
            // counted from the first line of the wrong use
            let line = i64::from(line) - first as i64;
            let help = diag.help.as_deref().unwrap_or_else(|| panic!("no help: {}\n{lines}", diag.message));
            _ = writeln!(said, "    {} {line}:{column} {}\n        {help}", diag.code.name(), diag.message);
        }
        said.push('\n');
    }
    assert!(WRONG.len() >= 60, "{}", WRONG.len());
    let path = root().join("tests/data/wrong-uses.txt");
    if std::env::var("SAMPLES").is_ok_and(|to| to == "overwrite") {
        fs::write(&path, &said).unwrap();
    }
    assert_same("tests/data/wrong-uses.txt", &fs::read_to_string(&path).unwrap_or_default(), &said);
}
