//! A shop's own control needs only a control file. `lint`, `render`, `simulate` and `verify` all use this file.

use std::fs;

use crate::support::folder::{Folder, err, out};
use crate::support::{mill, root};

/// A Haas with coolant through the spindle and two codes of the machine's builder.
const VF2: &str = r#"name = "vf2"
title = "Our VF-2"
like = "haas"

[codes]
"M88" = { is = "through", stops_spindle = true, text = "coolant through the spindle" }
"G201" = { is = "harmless", words = "P", text = "smoothing by the builder" }
"G187" = { is = "harmless", words = "PE" }
"#;

/// The Haas post for another control, with M88 for coolant, and G201 and G187 at the start.
fn form(control: &str) -> String {
    let text = fs::read_to_string(root().join("postforms/haas.pf")).unwrap();
    let text = text.replacen("Control haas", &format!("Control {control}\nCoolant 88 9 7"), 1);
    let mut lines = Vec::new();
    for line in text.lines() {
        lines.push(line);
        if line == "G[unitmode] G17 G40 G49 G80 G90" {
            lines.extend(["G187 P2 E0.1", "G201 P1"]);
        }
    }
    lines.join("\n") + "\n"
}

fn folder(name: &str) -> Folder {
    let folder = Folder::new(name);
    folder.write("vf2.toml", VF2);
    folder.write("own.pf", form("vf2.toml"));
    folder.write("haas.pf", form("haas"));
    folder.write("job.json", fs::read(root().join("samples/bracket/job.json")).unwrap());
    folder
}

#[test]
fn every_command_goes_by_the_file() {
    let folder = folder("own_control");
    let lint = folder.run(&["lint", "own.pf"]);
    assert_eq!(out(&lint), "0 errors, 0 warnings, 0 notes\n", "{}", err(&lint));
    let lint = out(&folder.run(&["lint", "haas.pf", "--format", "github"]));
    assert!(lint.contains("title=PF608::G201 is unknown for haas"), "{lint}");

    let render = folder.run(&["render", "job.json", "--form", "own.pf", "-o", "own.nc"]);
    assert_eq!(render.status.code(), Some(0), "{}", err(&render));
    let program = folder.read("own.nc");
    assert!(program.contains("G201 P1") && program.contains("M88"), "{program}");

    let simulate = folder.run(&["simulate", "own.nc", "--control", "vf2.toml"]);
    assert_eq!(simulate.status.code(), Some(0), "{}", err(&simulate));
    let refused = folder.run(&["simulate", "own.nc", "--control", "haas"]);
    assert!(refused.status.code() == Some(1) && err(&refused).contains("G201"), "{}", err(&refused));

    let verify = folder.run(&["verify", "job.json", "--form", "own.pf"]);
    assert_eq!(verify.status.code(), Some(0), "{}{}", out(&verify), err(&verify));
    for configuration in ["control = \"vf2.toml\"\n", "[control]\nfile = \"vf2.toml\"\n"] {
        folder.write("postform.toml", configuration);
        assert_eq!(folder.run(&["simulate", "own.nc"]).status.code(), Some(0), "{configuration}");
    }
}

/// M0, M1 and M6 stop the spindle and the coolant by the file of the control. An unknown effect of M0 counts as a stop.
#[test]
fn the_file_decides_what_a_stop_and_a_tool_change_end() {
    let folder = folder("own_control_stops");
    let operation = |tool: u8, stop: &str| {
        format!(
            r#"{{"tool":{tool},"work":54,"spindle":{{"speed":1000,"direction":"cw"}},"coolant":"flood","feed":100,"path":[
            {{"rapid":[0,0,50]}},{{"line":[0,0,-3]}},{{"rapid":[0,0,50]}}{stop},{{"rapid":[5,0,50]}},{{"line":[5,0,-3]}},
            {{"rapid":[5,0,50]}}]}}"#
        )
    };
    let job = |operations: &str| {
        format!(
            r#"{{"postform":1,"program":1,"units":"mm","tools":[{{"number":1}},{{"number":2}}],"operations":[{operations}]}}"#
        )
    };
    let stop = |kind: &str| job(&operation(1, &format!(r#",{{"stop":"{kind}"}}"#)));
    folder.write("M0.json", stop("program"));
    folder.write("M1.json", stop("optional"));
    folder.write("M6.json", job(&format!("{},{}", operation(1, ""), operation(2, ""))));
    // each row: the control, its file, the code, and whether the program is right without M3 or M8 after this code
    let rows = [
        ("haas", "", "M0", false),
        ("haas", "", "M1", false),
        ("haas", "", "M6", false),
        ("haas", "[stops]\nspindle = \"unknown\"", "M0", false),
        ("haas", "[stops]\nspindle = \"unknown\"", "M1", true),
        ("haas", "[stops]\nspindle = \"kept\"", "M0", true),
        ("haas", "[tool]\ncoolant = \"unknown\"", "M6", true),
        ("fanuc", "", "M0", false),
        ("fanuc", "", "M1", true),
        ("fanuc", "", "M6", true),
        ("fanuc", "[stops]\nspindle = \"kept\"", "M0", true),
        ("fanuc", "[tool]\ncoolant = \"lost\"", "M6", false),
        ("mach3", "", "M0", false),
        ("mach3", "[stops]\nspindle = \"lost\"", "M1", false),
        ("mach3", "[stops]\nspindle = \"kept\"", "M0", true),
        ("linuxcnc", "", "M0", true),
        ("linuxcnc", "[stops]\nspindle = \"lost\"", "M0", false),
    ];
    for (control, own, code, is_right) in rows {
        let row = format!("{control} {own} {code}");
        folder.write("own.toml", format!("name = \"own\"\nlike = \"{control}\"\n{own}\n"));
        let form = fs::read_to_string(root().join(format!("postforms/{control}.pf"))).unwrap();
        let form = form.replacen(&format!("Control {control}"), "Control own.toml", 1);
        folder.write("form.pf", form);
        let job = format!("{code}.json");
        let render = folder.run(&["render", &job, "--form", "form.pf", "-o", "whole.nc"]);
        assert_eq!(render.status.code(), Some(0), "{row}: {}", err(&render));
        let whole = folder.read("whole.nc");
        // the M3 and M8 after the last M0, M1 or M6 are removed
        let at = whole.rfind(&format!("{code}\n")).unwrap_or_else(|| panic!("{row}: {whole}"));
        let (head, tail) = whole.split_at(at);
        // the form turns the coolant off before a tool change
        let head = if code == "M6" { head.replace(" M9\n", "\n") } else { head.to_owned() };
        let tail = if code == "M6" { tail.to_owned() } else { tail.replacen(" M3", "", 1).replacen("M3\n", "\n", 1) };
        folder.write("less.nc", format!("{head}{}", tail.replacen(" M8", "", 1).replacen("M8\n", "\n", 1)));
        let verify = |program: &str| folder.run(&["verify", &job, "--nc", program, "--form", "form.pf"]);
        assert_eq!(verify("whole.nc").status.code(), Some(0), "{row}");
        let less = verify("less.nc");
        assert_eq!(less.status.code(), Some(i32::from(!is_right)), "{row}: {tail}{}{}", out(&less), err(&less));
    }
}

/// The file that `new` writes is valid. The rows in its comments are valid, too.
#[test]
fn a_new_file_is_right_as_it_is_and_with_its_rows() {
    let folder = folder("own_control_new");
    let new = folder.run(&["new", "--control-file", "haas", "-o", "new.toml"]);
    assert_eq!(new.status.code(), Some(0), "{}", err(&new));
    folder.write("vf2.toml", folder.read("new.toml"));
    assert_eq!(folder.run(&["lint", "own.pf"]).status.code(), Some(0));
    let rows = folder.read("new.toml").replace("# \"", "\"");
    assert_eq!(rows.matches("\n\"").count(), 9, "{rows}");
    // the tables other than codes, with their comment marks removed
    let (head, rest) = rows.split_once("where your control differs.\n").unwrap();
    let (tables, codes) = rest.split_once("\n# The codes").unwrap();
    let tables: String = tables.lines().map(|line| format!("{}\n", line.strip_prefix("# ").unwrap())).collect();
    assert_eq!(tables.matches(" = ").count(), 15, "{tables}");
    let rows = format!("{head}where your control differs.\n{tables}\n# The codes{codes}");
    folder.write("vf2.toml", rows);
    let lint = folder.run(&["lint", "own.pf"]);
    assert_eq!(out(&lint), "0 errors, 0 warnings, 0 notes\n", "{}", err(&lint));
    let controls = out(&folder.run(&["controls"]));
    assert!(
        controls.contains("haas") && controls.contains("linuxcnc") && !controls.contains("of-no-name"),
        "{controls}"
    );
    let explained = out(&folder.run(&["explain", "haas"]));
    assert!(
        explained.contains("G154") && explained.contains("longest block") && explained.contains("not known"),
        "{explained}"
    );
}

/// A control file may have `rules = "none"`, for a language that postform can't read. Forms print programs in this
/// language, but no word is taken for a code, and nothing is proven.
#[test]
fn a_control_whose_language_is_not_read_is_printed_and_not_proven() {
    let folder = folder("own_control_none");
    folder.write("vf2.toml", "name = \"tnc\"\ntitle = \"Heidenhain TNC\"\nrules = \"none\"\n");
    folder.write(
        "own.pf",
        "Name TNC\nMachine Mill\nControl vf2.toml\nUnits mm\nX+>4~>3\nY+>4~>3\nZ+>4~>3\nF >5\nS >5\nT >2\nM >3\nSequence#s - 0 1\n\n\
         StartCode\n`BEGIN PGM A MM`\nEnd\n\n\
         1stToolChange\n`TOOL CALL `[tool]` Z` S[speed]\n`CYCL DEF 247 Q339=`[work-53]\nM[direct]\n\
         L X[h] Y[v] `R0 FMAX`\nL Z[d] `R0 FMAX`\nEnd\n\n\
         ToolChange\n`TOOL CALL `[tool]` Z` S[speed]\nM[direct]\nL X[h] Y[v] Z[d] `R0 FMAX`\nEnd\n\n\
         SpindleChange\n`TOOL CALL S`[speed]\nEnd\n\n\
         RapidCode\nL X[h] Y[v] Z[d] `R0 FMAX`\nEnd\n\nLineCode\nL X[h] Y[v] Z[d] F[frate]\nEnd\n\n\
         EndCode\n`L Z+100 R0 FMAX`\n`END PGM A MM`\nEnd\n",
    );
    folder.write(
        "job.json",
        "{\"postform\":1,\"units\":\"mm\",\"tools\":[{\"number\":3}],\"operations\":[\
         {\"tool\":3,\"work\":60,\"spindle\":{\"speed\":900,\"direction\":\"cw\"},\"feed\":100,\
         \"path\":[{\"rapid\":[1,2,50]},{\"line\":[1,2,0]}]},\
         {\"tool\":3,\"work\":60,\"spindle\":{\"speed\":800,\"direction\":\"cw\"},\"feed\":100,\
         \"path\":[{\"line\":[5,2,0]},{\"rapid\":[5,2,50]}]}]}",
    );
    let lint = folder.run(&["lint", "own.pf"]);
    assert_eq!(lint.status.code(), Some(0), "{}{}", out(&lint), err(&lint));
    assert!(!out(&lint).contains("PF4") && !out(&lint).contains("PF5"), "{}", out(&lint));
    let render = folder.run(&["render", "job.json", "--form", "own.pf"]);
    assert_eq!(render.status.code(), Some(0), "{}", err(&render));
    assert_eq!(
        out(&render).lines().collect::<Vec<_>>(),
        [
            "0 BEGIN PGM A MM",
            "1 TOOL CALL 3 Z S900",
            "2 CYCL DEF 247 Q339=7",
            "3 M3",
            "4 L X+1 Y+2 R0 FMAX",
            "5 L Z+50 R0 FMAX",
            "6 L Z0 F100",
            "7 TOOL CALL S800",
            "8 L X+5 Y+2 Z0 F100",
            "9 L Z+50 R0 FMAX",
            "10 L Z+100 R0 FMAX",
            "11 END PGM A MM",
        ]
    );
    assert!(err(&render).contains("not proven") && err(&render).contains("does not read"), "{}", err(&render));
    folder.write("own.nc", "X1 Y2\n");
    let simulate = folder.run(&["simulate", "own.nc", "--control", "vf2.toml"]);
    assert!(err(&simulate).contains("does not read the language of tnc"), "{}", err(&simulate));
}

#[test]
fn what_is_wrong_in_the_file_is_said_with_line_and_column() {
    let folder = folder("own_control_wrong");
    let table = [
        ("name = \"vf2\"\nlike = \"haas\"\nsize = 3\n", "3:1", "unknown field `size`"),
        ("name = \"vf2\"\nlike = \"haas\"\n[codes]\nG201 = { is = \"harmles\" }\n", "4:15", "did you mean `harmless`?"),
        ("name = \"vf2\"\nlike = \"vf2\"\n", "2:8", "there is no control `vf2`"),
        ("name = \"vf2\"\nlike = \"haas\"\n[codes]\nG201 = { is = \"work\" }\nG201 = { is = \"work\" }\n", "5:1", ""),
        ("name = \"vf2\"\nlike = \"haas\"\n[text]\nline = \"long\"\n", "4:8", "invalid type"),
        ("name = \"vf2\"\nlike = \"haas\"\n[codes]\n\"G1.25\" = { is = \"work\" }\n", "4:1", ""),
        (
            "name = \"vf2\"\nlike = \"haas\"\n[arcs]\nmm = { least = nan, part = 0, most = 1, chord = 0 }\n",
            "4:6",
            "0 or more",
        ),
        ("name = \"vf2\"\nlike = \"haas\"\n[codes]\nG81 = { is = \"cycle\" }\n", "4:14", "makes = \"drill\""),
        ("name = \"vf2\"\n", "1:8", "like = \"fanuc\""),
    ];
    for (text, place, message) in table {
        folder.write("vf2.toml", text);
        let lint = folder.run(&["lint", "own.pf", "--format", "github"]);
        let said = out(&lint) + &err(&lint);
        let (line, column) = place.split_once(':').unwrap();
        assert_eq!(lint.status.code(), Some(1), "{text}{said}");
        let at = said.lines().find(|line| line.contains("title=PF019")).unwrap_or_default();
        assert!(at.contains(&format!("file=vf2.toml,line={line},")), "{text}{said}");
        assert!(at.contains(&format!(",col={column},")), "{text}{said}");
        assert!(said.contains(message), "{text}{said}");
        let option = folder.run(&["simulate", "job.json", "--control", "vf2.toml"]);
        assert!(option.status.code() == Some(2), "{}", err(&option));
        assert!(err(&option).contains(&format!("vf2.toml:{place}")), "{}", err(&option));
    }
    for (name, why) in [("../vf2.toml", "outside the form's folder"), ("none.toml", "can't be found")] {
        folder.write("own.pf", form(name));
        let lint = folder.run(&["lint", "own.pf"]);
        assert!(out(&lint).contains(why) || err(&lint).contains(why), "{}{}", out(&lint), err(&lint));
    }
}

/// The effect of a code depends on its meaning in the control file, not on its number. A program with other numbers
/// makes the same motions.
#[test]
fn codes_of_other_numbers_do_what_their_meaning_says() {
    let folder = Folder::new("own_control_numbers");
    let rows = [
        ("G20", "G670", "is = \"inch\""),
        ("G21", "G671", "is = \"mm\""),
        ("G18", "G618", "is = \"plane-xz\""),
        ("G17", "G617", "is = \"plane-xy\""),
        ("G90", "G690", "is = \"absolute\""),
        ("G91", "G691", "is = \"increments\""),
        ("G0", "G600", "is = \"rapid\""),
        ("G1", "G601", "is = \"line\""),
        ("G2", "G602", "is = \"arc-cw\", words = \"IJKR\""),
        ("G3", "G603", "is = \"arc-ccw\", words = \"IJKR\""),
        ("G28", "G628", "is = \"reference\", point = 1"),
        ("G30", "G630", "is = \"reference\", point = 2"),
        ("G44", "G644", "is = \"length-minus\", words = \"H\""),
        ("G43", "G643", "is = \"length-on\", words = \"H\""),
        ("G49", "G649", "is = \"length-off\""),
        ("G52", "G652", "is = \"frame\""),
        ("G92", "G692", "is = \"preset\""),
        ("G10", "G610", "is = \"set-offsets\", words = \"LPR\""),
        ("G55", "G655", "is = \"work\", work = \"G55\""),
        ("G154 P7", "G674", "is = \"work\", work = \"G54.1 P7\""),
        ("G154 P", "G654 P", "is = \"work\", words = \"P\", work = \"P\""),
        ("G80", "G680", "is = \"cycle-end\""),
        ("G73", "G773", "is = \"cycle\", words = \"LPQR\", makes = \"chipbreak\""),
        ("G74", "G774", "is = \"cycle\", words = \"LPQR\", makes = \"left-tap\""),
        ("G76", "G776", "is = \"cycle\", words = \"IJLPQR\", makes = \"bore\", motions = \"shift-out\""),
        ("G81", "G781", "is = \"cycle\", words = \"LR\", makes = \"drill\""),
        ("G82", "G782", "is = \"cycle\", words = \"LPR\", makes = \"drill\""),
        ("G83", "G783", "is = \"cycle\", words = \"LPQR\", makes = \"peck chipbreak\", motions = \"peck\""),
        ("G84", "G784", "is = \"cycle\", words = \"LPQR\", makes = \"tap\""),
        ("G85", "G785", "is = \"cycle\", words = \"LR\", makes = \"bore ream\", motions = \"feed-out\""),
        ("G86", "G786", "is = \"cycle\", words = \"LPR\", makes = \"bore\", motions = \"stop-out\""),
        ("G87", "G787", "is = \"cycle\", words = \"IJLPQR\", makes = \"back\""),
        ("G88", "G788", "is = \"cycle\", words = \"LPR\", makes = \"bore\", motions = \"by-hand\""),
        ("G89", "G789", "is = \"cycle\", words = \"LPR\", makes = \"bore ream\", motions = \"feed-out\""),
    ];
    let usual = "%
G21 G90 G94
T1 M6
G55
G0 G43 H1 Z50.
G0 X10. Y0 Z5. S900 M3
G1 Z-1. F100.
G91 G1 X5.
G90
G18 G2 X20. Z-1. I2.5 K0
G3 X15. Z-1. R2.5
G17
G0 Z5.
G44 H1
G43 H1
G73 X1. Y1. Z-9. R2. Q2. P200 F90.
G74 X2. Y1. Z-9. R2. F90.
G76 X3. Y1. Z-9. R2. Q0.3 P200 F90.
G81 X4. Y1. Z-9. R2. F90.
G82 X5. Y1. Z-9. R2. P200 F90.
G83 X6. Y1. Z-9. R2. Q2. F90.
G84 X7. Y1. Z-9. R2. F90.
G85 X8. Y1. Z-9. R2. F90.
G86 X9. Y1. Z-9. R2. P200 F90.
G88 X9. Y3. Z-9. R2. P200 F90.
G89 X9. Y2. Z-9. R2. P200 F90.
G80
G87 X9. Y4. Z-3. R-9. Q0.3 F90.
G80
G154 P7
G0 X1. Y1.
G154 P8
G0 X2. Y1.
G52 X1.
G0 X3.
G10 L2 P1 X1.
G92 X7.
G0 X3.
G20
G49
G91 G28 Z0
G30 X0 Y0
G90
M30
%
";
    let other = usual.lines().map(|line| {
        let longest = |at: &str| {
            rows.iter().filter(|row| at.starts_with(row.0)).max_by_key(|row| row.0.len()).map(|row| (row.0, row.1))
        };
        let (mut text, mut rest) = (String::new(), line);
        while !rest.is_empty() {
            // the longest matching code is replaced: G2 is not the start of G20
            let found = longest(rest).filter(|(own, _)| {
                !rest[own.len()..].starts_with(|next: char| next.is_ascii_digit()) || own.ends_with('P')
            });
            let (new, length) = found.map_or((&rest[..1], 1), |(own, new)| (new, own.len()));
            text += new;
            rest = &rest[length..];
        }
        text + "\n"
    });
    let other: String = other.collect();
    let absent = rows
        .iter()
        .filter(|row| !row.0.contains(' '))
        .map(|(usual, ..)| format!("\"{usual}\" = {{ is = \"absent\" }}\n"));
    let own = rows.iter().map(|(_, code, row)| format!("\"{}\" = {{ {row} }}\n", code.trim_end_matches(" P")));
    let codes: String = absent.chain(own).collect();
    folder.write("usual.toml", "name = \"usual\"\nlike = \"fanuc\"\n[codes]\n\"G154\" = { is = \"work\", words = \"P\", work = \"P\" }\n\"G73\" = { is = \"cycle\", words = \"LPQR\", makes = \"chipbreak\" }\n");
    folder.write(
        "own.toml",
        format!("name = \"own\"\nlike = \"usual.toml\"\n[codes]\n{codes}").replace("usual.toml", "fanuc"),
    );
    folder.write("usual.nc", usual);
    folder.write("other.nc", &other);
    assert!(!other.contains("G81") && other.contains("G781") && other.contains("G654 P8"), "{other}");
    let [own, usual] = [("other.nc", "own.toml"), ("usual.nc", "usual.toml")].map(|(program, control)| {
        let run = folder.run(&["simulate", program, "--control", control, "--format", "json"]);
        assert_eq!(run.status.code(), Some(0), "{other}{}", err(&run));
        out(&run).replace(program, "PROGRAM").replace(control, "CONTROL").replace("\"own\"", "\"usual\"")
    });
    assert_eq!(own, usual);
    assert!(own.len() > 1000, "{own}");
}

/// A form that prints the codes of such a control is proven like any other form.
#[test]
fn a_form_of_other_numbers_is_proven() {
    let folder = Folder::new("own_control_form");
    let fanuc = fs::read_to_string(root().join("postforms/fanuc.pf")).unwrap();
    let form = fanuc
        .replace("Control fanuc", "Control own.toml")
        .replace("G81 ", "G781 ")
        .replace("G83 ", "G783 ")
        .replace("G28 ", "G728 ");
    folder.write("own.pf", &form);
    let rows = [
        "\"G81\" = { is = \"absent\" }",
        "\"G83\" = { is = \"absent\" }",
        "\"G28\" = { is = \"absent\" }",
        "\"G781\" = { is = \"cycle\", words = \"KLR\", makes = \"drill\" }",
        "\"G783\" = { is = \"cycle\", words = \"KLPQR\", makes = \"peck\" }",
        "\"G728\" = { is = \"reference\", point = 1 }",
    ];
    folder.write("own.toml", format!("name = \"own\"\nlike = \"fanuc\"\n[codes]\n{}\n", rows.join("\n")));
    let job = root().join("samples/bracket/job.json");
    let job = job.to_str().unwrap();
    let run = folder.run(&["render", job, "--form", "own.pf", "-o", "own.nc"]);
    assert_eq!(run.status.code(), Some(0), "{}", err(&run));
    assert!(err(&run).starts_with("equivalent: ") && err(&run).contains("20 holes"), "{}", err(&run));
    let program = folder.read("own.nc");
    assert!(["G98 G781 X", "G98 G783 X", "G91 G728 Z0"].iter().all(|block| program.contains(block)), "{program}");
    // without the motions of its peck cycle in the file, nothing is proven, and the message names the missing entry
    folder.write(
        "own.toml",
        format!(
            "name = \"own\"\nlike = \"fanuc\"\n[codes]\n{}\n",
            rows.join("\n").replace("makes = \"peck\"", "makes = \"peck chipbreak\"")
        ),
    );
    let run = folder.run(&["render", job, "--form", "own.pf", "-o", "own.nc"]);
    assert!(
        err(&run)
            .contains("G783 is not supported: the control file of own does not give its motions: `motions = \"peck\"`"),
        "{}",
        err(&run)
    );
}

/// If the file lacks a property of a code, the error names the property. postform never guesses the property from the
/// number of the code.
#[test]
fn a_row_that_lacks_something_is_not_run_and_says_what() {
    let folder = Folder::new("own_control_lacks");
    let rows = [
        ("G185", "is = \"cycle\", words = \"R\", makes = \"bore\"", "its motions: `motions = \"peck\"`"),
        ("G505", "is = \"work\"", "its work offset: `work = \"G54\"`"),
        ("G54", "is = \"work\"", "its work offset: `work = \"G54\"`"),
        ("G128", "is = \"reference\"", "its reference point: `point = 1`"),
        ("G110-G129", "is = \"work\", work = \"G54.1 P90\"", "its work offset"),
    ];
    for (code, row, lacks) in rows {
        folder.write("own.toml", format!("name = \"own\"\nlike = \"haas\"\n[codes]\n\"{code}\" = {{ {row} }}\n"));
        let code = code.split('-').next_back().unwrap_or(code);
        folder.write("moves.nc", format!("%\nG21 G90 G94\nG0 X0 Y0 Z5.\n{code} X1. Y1. Z-1. R1. F100.\nM30\n%\n"));
        let run = folder.run(&["simulate", "moves.nc", "--control", "own.toml"]);
        let said = err(&run);
        assert!(run.status.code() == Some(1) && said.contains("PN016") && said.contains(code), "{code}: {said}");
        assert!(said.contains(lacks) && said.contains("the control file of own"), "{code}: {said}");
    }
    for (row, at, why) in [
        (
            "\"G185\" = { is = \"cycle\", makes = \"bore\", motions = \"feed\" }",
            "\"feed\"",
            "`feed` is not a kind of cycle motions",
        ),
        (
            "\"G77\" = { is = \"cycle\", makes = \"tap\", pitch = { I = \"inch\" } }",
            "{ I",
            "not a letter, and not letters",
        ),
        ("\"G77\" = { is = \"cycle\", makes = \"tap\", pitch = \"IJ\" }", "\"IJ\"", "not a letter, and not letters"),
        ("\"G54\" = { is = \"work\", work = \"G53\" }", "\"G53\"", "`G53` is not a work offset"),
        ("\"G28\" = { is = \"reference\", point = 3 }", "3 }", "there are two reference points"),
        ("\"G28\" = { is = \"rapid\", point = 1 }", "1 }", "`point` is only for reference points"),
    ] {
        folder.write("own.toml", format!("name = \"own\"\nlike = \"haas\"\n[codes]\n{row}\n"));
        let at = row.find(at).unwrap() + 1;
        let run = folder.run(&["simulate", "moves.nc", "--control", "own.toml"]);
        let said = err(&run);
        assert!(
            run.status.code() == Some(2) && said.contains(&format!("own.toml:4:{at}:")) && said.contains(why),
            "{said}"
        );
    }
}

/// A code with a meaning from the file is run, or refused by name. This applies to every number, as a G code and as an M code.
#[test]
fn no_meaning_is_passed_over() {
    use postform::internals::control::{Code, Control, Meaning};
    use postform::internals::nc::{Action, RunError, RunSettings, Simulator};
    use std::io::Cursor;

    // these codes are reported as left out. They have no effect in the simulator, except that a pallet change stops the
    // program; the proof uses the first two
    use Meaning as M;
    let nothing = [
        M::RigidAhead,
        M::SetOffsets,
        M::Pallet,
        M::Harmless,
        M::TransformOff,
        M::MacroOff,
        M::Path,
        M::TapMode,
        M::ExactStop,
        M::Output,
        M::Override,
    ];
    let mut run = Vec::new();
    for &meaning in Meaning::ALL {
        let makes = match meaning {
            Meaning::Cycle => ", makes = \"drill\"",
            Meaning::Work => ", work = \"G54.1 P3\"",
            Meaning::Reference | Meaning::SetReference => ", point = 1",
            Meaning::ToolNumber => ", tool = 3",
            _ => "",
        };
        for code in ["G777", "M777"] {
            let row = format!("\"{code}\" = {{ is = \"{}\"{makes} }}", meaning.name());
            let text = format!("name = \"shop\"\nlike = \"haas\"\n[codes]\n{row}\n");
            let control: &'static Control = Box::leak(Box::new(Control::read("shop", &text).unwrap()));
            let program = format!("G0 X1. Y1. Z1.\nT1\nS100\n{code} (HERE)\nM30\n");
            let mut simulator = Simulator::new(Cursor::new(program), RunSettings::new(control));
            let mut items = Vec::new();
            let ended = loop {
                match simulator.step(&mut items) {
                    Ok(true) => {}
                    Ok(false) => break Ok(()),
                    Err(error) => break Err(error),
                }
            };
            let here = items.iter().filter(|item| item.line == 4).map(|item| &item.action);
            match ended {
                Err(RunError::Refused(diag, 4)) if diag.code.name() == "PN016" => {
                    assert!(diag.message.contains(code), "{row}: {}", diag.message);
                }
                ended => {
                    let passed_over = here.clone().any(|action| matches!(action, Action::LeftOut(..)));
                    // a dwell without a time is refused as a dwell, and a tool length without H is refused as a tool
                    // length
                    let lacks_word = matches!(&ended, Err(RunError::Refused(diag, 4)) if ["PN006", "PN007"].contains(&diag.code.name()));
                    assert!(ended.is_ok() || lacks_word, "{row}: {ended:?}");
                    assert!(!passed_over || nothing.contains(&meaning), "{row} is passed over");
                    run.push(format!("{} {code}", meaning.name()));
                }
            }
            assert!(code.parse::<Code>().is_ok());
        }
    }
    assert!(run.contains(&"spindle-cw M777".to_owned()) && run.contains(&"inch G777".to_owned()), "{run:?}");
    assert!(!run.contains(&"to-r M777".to_owned()) && !run.contains(&"tool-change G777".to_owned()), "{run:?}");
}

/// The unit of dwells in a control's file also applies to dwells in cycles.
#[test]
fn dwells_of_cycles_count_as_the_file_says() {
    use postform::internals::control::Control;
    use postform::internals::nc::{Action, RunSettings, Simulator};
    use std::io::Cursor;

    let dwell = |unit: &str| {
        let text = format!("name = \"shop\"\nlike = \"fanuc\"\n[dwell]\nP = \"{unit}\"\n");
        let control: &'static Control = Box::leak(Box::new(Control::read("shop", &text).unwrap()));
        let program = "G21 G90\nM3 S100\nG99 G82 X1. Z-3. R2. P2 F50.\nG80\nM30\n";
        let mut simulator = Simulator::new(Cursor::new(program), RunSettings::new(control));
        let mut items = Vec::new();
        while simulator.step(&mut items).unwrap() {}
        items.iter().find_map(|item| if let Action::Dwell(seconds) = item.action { Some(seconds) } else { None })
    };
    assert_eq!([dwell("s"), dwell("ms")], [Some(2.0), Some(0.002)]);
}

/// The control file defines how a program turns on tool lengths.
#[test]
fn lengths_of_tools_are_those_of_the_file() {
    let folder = folder("own_lengths");
    let job = fs::read(root().join("samples/drill-machine/job.json")).unwrap();
    folder.write("drill.json", job);
    let plain = fs::read_to_string(root().join("postforms/fanuc.pf")).unwrap();
    for (length, words) in [("none", ""), ("H", "H[lcomp] "), ("G43", "G43 "), ("G43 H", "G43 H[lcomp] ")] {
        folder.write(
            "own.toml",
            format!("name = \"own\"\ntitle = \"Own\"\nlike = \"fanuc\"\n[tool]\nlength = \"{length}\"\n"),
        );
        let form = plain.replace("Control fanuc", "Control own.toml").replace("G43 H[lcomp] ", words);
        folder.write("length.pf", form);
        let render = folder.run(&["render", "drill.json", "--form", "length.pf", "--program", "1"]);
        assert_eq!(render.status.code(), Some(0), "{length}: {}", err(&render));
        assert!(
            err(&render).contains("identical") || err(&render).contains("equivalent"),
            "{length}: {}",
            err(&render)
        );
    }
}

/// An arc may have an address of another language, such as `I=AC(5)`. The address belongs to the arc, so no words are
/// printed again after the arc.
#[test]
fn an_address_with_its_value_is_part_of_its_move() {
    let folder = folder("own_arcs");
    let plain = fs::read_to_string(root().join("postforms/fanuc.pf")).unwrap();
    let arc = "CwCode\nG2 X[h] Y[v] Z[d] `I=AC(`[hctr]`)` `J=AC(`[vctr]`)` F[frate]\nEnd\n\nEndCode\n";
    folder.write("arcs.pf", plain.replacen("EndCode\n", arc, 1));
    folder.write(
        "job.json",
        r#"{"postform":1,"program":1,"units":"mm","tools":[{"number":1}],"operations":[{"tool":1,"work":54,
        "spindle":{"speed":1000,"direction":"cw"},"feed":100,"path":[{"rapid":[0,0,5]},{"line":[0,0,-1]},
        {"arc":{"to":[10,10],"center":[10,0],"direction":"cw"}},{"line":[90,10]},{"rapid":[90,10,5]}]}]}"#,
    );
    let render = folder.run(&["render", "job.json", "--form", "arcs.pf"]);
    let program = out(&render);
    let after = program.lines().skip_while(|line| !line.contains("I=AC(10) J=AC(0)")).nth(1).unwrap_or_default();
    assert!(after.ends_with("G1 X90."), "{program}\n{}", err(&render));
    assert!(err(&render).contains("in the language of Siemens controls"), "{}", err(&render));
}

/// The actions of a program on a control, or the refusal.
fn simulated(folder: &Folder, control: &str, program: &str) -> Result<String, String> {
    folder.write("program.nc", program);
    let run = folder.run(&["simulate", "program.nc", "--control", control, "--format", "json"]);
    if run.status.success() { Ok(out(&run)) } else { Err(err(&run)) }
}

/// G77 of a Brother: I is the pitch in a metric program, J is threads per inch in an inch program. L is a speed, not a number of repeats.
#[test]
fn a_brother_taps_by_its_pitch() {
    let folder = Folder::new("own_control_brother");
    let mm =
        "%\nG21 G90 G94\nT1 M6\nG0 G43 H1 Z50.\nG0 X0 Y0 S800 M3\nG98 G77 X1. Y1. Z-9. R2. I1.25 L3000\nG80\nM30\n%\n";
    let tap = simulated(&folder, "brother", mm).unwrap();
    // 800 revolutions per minute with a pitch of 1.25 mm, and 3000 on the way out
    let fanuc = mm.replace("G77", "G84").replace("I1.25 L3000", "F1000.");
    assert!(tap.contains("\"feed\":[1,1,-9,0,0,0],\"f\":1000}"), "{tap}");
    assert!(tap.contains("\"ccw\",\"s\":3000}\n{\"line\":6,\"feed\":[1,1,2,0,0,0],\"f\":3750}"), "{tap}");
    let even = simulated(&folder, "brother", &mm.replace(" L3000", "")).unwrap();
    assert_eq!(even, simulated(&folder, "fanuc", &fanuc).unwrap());
    // 16 threads per inch at 400 revolutions per minute: 25 inches per minute
    let inch = mm.replace("G21", "G20").replace("S800", "S400").replace("I1.25", "J16.");
    let tap = simulated(&folder, "brother", &inch).unwrap();
    assert!(tap.contains("\"feed\":[1,1,-9,0,0,0],\"f\":25}"), "{tap}");
    for (wrong, said) in [
        (mm.replace("I1.25", "J20."), "G77 takes J only in programs in inches"),
        (inch.replace("J16.", "I1.25"), "G77 takes I only in programs in millimetres"),
        (mm.replace("I1.25 ", ""), "a canned cycle without a feed"),
        (mm.replace("L3000", "K2"), "the block has K, but no code that uses K"),
        (mm.replace("L3000", "L3000 Q3."), "G77 with pecks and a speed out of the hole is not simulated"),
    ] {
        let refused = simulated(&folder, "brother", &wrong).unwrap_err();
        assert!(refused.contains(said), "{wrong}{refused}");
    }
}

/// The drills of a bank are selected by M codes instead of T. A form that prints these codes is proven; a program with
/// the code of another drill is not.
#[test]
fn a_code_brings_in_a_tool_of_a_bank() {
    let folder = Folder::new("own_control_bank");
    let bank = "name = \"router\"\nlike = \"fanuc\"\n[codes]\n\"M201-M209\" = { is = \"tool-number\", tool = 101 }\n";
    folder.write("router.toml", bank);
    let change = "T[tool] M6\nS[speed] M[direct]\nG0 G[work] X[h] Y[v] Z[d]";
    let own = "@if [tool] > 100\nM[100+tool]\n@else\nT[tool] M6\n@end\nS[speed] M[direct]\nG0 G[work] X[h] Y[v]\nG43 H[lcomp] Z[d]";
    let head = "Machine Mill\nUnits mm\nControl router.toml\nDwell G4 P ms\nX->4.>3\nY->4.>3\nZ->4.>3\nH >3\nM >3";
    let form =
        mill(head, "").replace(change, own).replace("%0", "G21 G90 G94 G17").replace("M30", "G91 G28 Z0\nG90\nM30");
    folder.write("router.pf", &form);
    let operation = |tool: u16| {
        format!(
            "{{\"tool\":{tool},\"spindle\":{{\"speed\":900,\"direction\":\"cw\"}},\"feed\":100,\"path\":[{{\"rapid\":[{tool},0,5]}},{{\"line\":[{tool},0,-1]}},{{\"rapid\":[{tool},0,5]}}]}}"
        )
    };
    let operations = [2, 103, 104].map(operation).join(",");
    let tools = [2, 103, 104].map(|tool| format!("{{\"number\":{tool}}}")).join(",");
    folder.write("job.json", format!("{{\"units\":\"mm\",\"tools\":[{tools}],\"operations\":[{operations}]}}"));
    let run = folder.run(&["render", "job.json", "--form", "router.pf", "-o", "out.nc"]);
    assert!(run.status.success(), "{}", err(&run));
    let program = folder.read("out.nc");
    assert!(program.contains("\nM203\n") && program.contains("\nM204\n") && program.contains("\nT2 M6\n"), "{program}");
    assert!(err(&run).contains("identical"), "{}", err(&run));
    folder.write("wrong.nc", program.replace("M204", "M205"));
    let run = folder.run(&["verify", "job.json", "--form", "router.pf", "--nc", "wrong.nc"]);
    assert!(!run.status.success() && out(&run).contains("PV012") || err(&run).contains("PV012"), "{}", err(&run));
    // the control file must give the tool of each code with this meaning
    folder.write("router.toml", bank.replace(", tool = 101", ""));
    let run = folder.run(&["simulate", "out.nc", "--control", "router.toml"]);
    assert!(err(&run).contains("the control file of router does not give its tool"), "{}", err(&run));
    folder.write("router.toml", bank.replace("tool-number", "harmless"));
    let run = folder.run(&["simulate", "out.nc", "--control", "router.toml"]);
    assert!(err(&run).contains("`tool` is only for codes with the meaning `tool-number`"), "{}", err(&run));
}

/// `T3 T7 M6` of a Mazak changes to tool 3 and prepares tool 7. Other controls accept only one T in a block.
#[test]
fn a_second_t_names_the_next_tool() {
    let folder = Folder::new("own_control_twice");
    let program = "%\nG21 G90 G94\nT3 T7 M6\nG0 X1. Y1.\nM6\nX2.\nM30\n%\n";
    let mazak = simulated(&folder, "mazak", program).unwrap();
    let apart = simulated(&folder, "mazak", &program.replace("T3 T7 M6", "T3 M6\nT7")).unwrap();
    let tools = |run: &str| run.matches("\"tool\":").count();
    assert!(mazak.contains("\"tool\":3") && mazak.contains("\"tool\":7"), "{mazak}");
    assert_eq!(tools(&mazak), tools(&apart));
    for (control, program, said) in [
        ("fanuc", program.to_owned(), "T is twice in the block"),
        ("mazak", program.replace("T7 M6", "T7"), "T is twice in a block without a tool change"),
        ("mazak", program.replace("T7 M6", "T7 T8 M6"), "T is twice in the block"),
        ("mazak", program.replace("T7 M6", "T7.5 M6"), "T7.5 is not a tool number"),
    ] {
        let refused = simulated(&folder, control, &program).unwrap_err();
        assert!(refused.contains(said), "{program}{refused}");
    }
}

/// A program is refused if it depends on a behaviour that no public source defines: repeats of a cycle, numbers without
/// a point, the meaning of a word.
#[test]
fn what_nothing_public_says_is_not_run() {
    let folder = Folder::new("own_control_unsaid");
    let head = "%\nG21 G90 G94\nT1 M6\nG0 G43 H1 Z50.\nS800 M3\n";
    let program = |block: &str| format!("{head}{block}\nG80\nM30\n%\n");
    let drill = program("G98 G83 X1. Y1. Z-9. R2. Q2. F100.");
    for control in ["mazak", "brother", "mitsubishi", "siemens-iso"] {
        let [own, fanuc] = [control, "fanuc"].map(|control| simulated(&folder, control, &drill).unwrap());
        assert_eq!(own.replace(control, "fanuc"), fanuc, "{control}");
    }
    for (control, block, said) in [
        ("mazak", "G98 G83 X1. Y1. Z-9. R2. Q2. F100. K3", "the block has K"),
        ("mazak", "G84.2 X1. Y1. Z-9. R2. F1.25", "G84.2 is not supported"),
        ("mitsubishi", "G81 X1. Y1. Z-9. R2. F100. L2", "the block has L"),
        ("brother", "G81 X1. Y1. Z-9. R2. F100. L2", "the block has L"),
        ("brother", "G100 T2 X1. Y1. G43 Z5. H2", "G100 is not supported"),
        ("siemens-iso", "G290", "G290 is not supported"),
    ] {
        let refused = simulated(&folder, control, &program(block)).unwrap_err();
        assert!(refused.contains(said), "{control} {block}: {refused}");
    }
    // a dwell of a Brother is in seconds
    let dwell = |control: &str| simulated(&folder, control, &program("G4 P2")).unwrap();
    assert!(
        dwell("brother") != dwell("mazak")
            && dwell("mazak").replace("mazak", "") == dwell("fanuc").replace("fanuc", "")
    );
}

/// A code that the control file marks as absent is unknown, even if the form uses the code for coolant.
#[test]
fn coolant_that_the_control_does_not_have_is_not_proven() {
    let folder = Folder::new("own_control_absent");
    folder.write("vf5.toml", "name = \"vf5\"\nlike = \"haas\"\n\n[codes]\n\"M8\" = { is = \"absent\" }\n");
    let form = fs::read_to_string(root().join("postforms/haas.pf")).unwrap();
    folder.write("own.pf", form.replacen("Control haas", "Control vf5.toml", 1));
    folder.write("job.json", fs::read(root().join("samples/bracket/job.json")).unwrap());
    let lint = out(&folder.run(&["lint", "own.pf", "--format", "github"]));
    assert!(lint.contains("title=PF608::[cool] may print M8, which vf5 does not have"), "{lint}");
    let render = folder.run(&["render", "job.json", "--form", "own.pf", "-o", "own.nc"]);
    assert!(folder.read("own.nc").contains(" M8\n"), "{}", err(&render));
    let why = "not proven from N200: M8 is unknown for vf5: its control file marks the code as absent";
    assert!(err(&render).contains(why), "{}", err(&render));
    let simulate = folder.run(&["simulate", "own.nc", "--control", "vf5.toml"]);
    assert!(
        simulate.status.code() == Some(1) && err(&simulate).contains("M8 is unknown, in `N200 G43 H1 Z1. M8`"),
        "{}",
        err(&simulate)
    );
}
