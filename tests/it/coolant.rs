//! Kinds of coolant: their codes, the codes that turn them off, and kinds that a form lacks.

use crate::support::folder::{Folder, err, out};
use crate::support::{check, mill, plain_post, program, render};

const KINDS: &str = "CoolantKind through M88 M89\nCoolantKind air M12";

/// A job of these operations: tool, coolant, path after the first rapid.
fn job(operations: &[(u32, &str, &str)]) -> String {
    let operations = operations.iter().map(|(tool, coolant, path)| {
        format!(
            "{{\"tool\":{tool},\"work\":54,\"spindle\":{{\"speed\":1000,\"direction\":\"cw\"}},\"coolant\":\"{coolant}\",\
             \"feed\":10,\"path\":[{{\"rapid\":[0,0,1]}},{path}]}}"
        )
    });
    format!(
        "{{\"postform\":1,\"units\":\"inch\",\"tools\":[{{\"number\":1}},{{\"number\":2}}],\"operations\":[{}]}}",
        operations.collect::<Vec<_>>().join(",")
    )
}

const LINE: &str = "{\"line\":[1,0,0]}";

/// The M codes of a program, without those of tool change, spindle and program end.
fn codes(form: &str, job: &str) -> Vec<String> {
    let printed = program(form, job);
    if printed.len() == 1 {
        return printed;
    }
    let words = printed.iter().flat_map(|line| line.split(' '));
    words.filter(|word| word.starts_with('M') && !["M6", "M3", "M30"].contains(word)).map(str::to_owned).collect()
}

/// A form whose tool changes print these lines.
fn form(head: &str, lines: &str) -> String {
    mill(head, "").replace("T[tool] M6\n", &format!("T[tool] M6\n{lines}\n"))
}

#[test]
fn each_kind_has_its_code() {
    let print = |coolant: &str| codes(&form(KINDS, "M[cool]"), &job(&[(1, coolant, LINE)]));
    for (coolant, code) in
        [("through", "M88"), ("air", "M12"), ("on", "M8"), ("flood", "M8"), ("mist", "M7"), ("off", "M9")]
    {
        assert_eq!(print(coolant), [code], "{coolant}");
    }
    assert_eq!(print("high"), ["PR054 the form has no coolant `high`"]);
    assert!(print("foam")[0].starts_with("PJ003"));
}

/// `[coolantoff]` turns off the kind of coolant that is on, not an earlier kind.
#[test]
fn each_kind_is_ended_by_its_own_code() {
    let ends = mill(KINDS, "").replace("ToolChange\nT[tool] M6\n", "ToolChange\nM[coolantoff]\nT[tool] M6\nM[cool]\n");
    let text = ends.replace("1stToolChange\nM[coolantoff]\n", "1stToolChange\n");
    let tools = job(&[(1, "through", LINE), (2, "on", LINE), (1, "on", LINE), (2, "through", LINE)]);
    assert_eq!(codes(&text, &tools), ["M88", "M89", "M8", "M9", "M8", "M9", "M88"]);
    // the coolant is changed during an operation, and turned off before a stop
    let stops = form(KINDS, "M[cool]").replace("EndCode\n", "Stop\nM[coolantoff]\nM0\nEnd\n\nEndCode\n");
    let changed =
        "{\"coolant\":\"through\"},{\"line\":[1,0,0]},{\"coolant\":\"on\"},{\"line\":[0,0,0]},{\"stop\":\"program\"}";
    let printed = codes(&stops, &job(&[(1, "off", changed)]));
    assert_eq!(printed[printed.len() - 2..], ["M9", "M0"], "{printed:?}");
}

#[test]
fn what_has_a_code_of_its_own_to_end_it_is_ended_by_that() {
    let two = job(&[(1, "through", LINE), (2, "on", LINE)]);
    // a sequence of the form turns the coolant off
    let text = mill(KINDS, "").replace("ToolChange\nT[tool] M6\n", "ToolChange\nM[coolantoff]\nT[tool] M6\nM[cool]\n");
    assert_eq!(codes(&text.replace("1stToolChange\nM[coolantoff]\n", "1stToolChange\n"), &two), ["M88", "M89", "M8"]);
    // if no sequence turns the coolant off, a separate block before the next cut does it
    assert_eq!(codes(&form(KINDS, "M[cool]"), &two), ["M88", "M8", "M89"]);
    let off = job(&[(
        1,
        "through",
        "{\"coolant\":\"off\"},{\"line\":[1,0,0]},{\"coolant\":\"air\"},{\"line\":[0,0,0]},{\"coolant\":\"on\"},{\"line\":[1,0,0]}",
    )]);
    assert_eq!(codes(&form(KINDS, "M[cool]"), &off), ["M88", "M89", "M12", "M8"]);
    // at the end of the program, EndCode turns the coolant off
    let text = form(KINDS, "M[cool]").replace("EndCode\n", "EndCode\nM[coolantoff]\n");
    assert_eq!(codes(&text, &job(&[(1, "through", LINE)])), ["M88", "M89"]);
}

#[test]
fn conditions_ask_for_the_kind() {
    let lines =
        "@if [cool] = through\nM101\n@elif [cool] = mist\nM102\n@elif [cool] <> off\nM103\n@else\nM104\n@end\nM[cool]";
    let print = |jobs: &[(u32, &str, &str)]| codes(&form(KINDS, lines), &job(jobs))[0].clone();
    for (coolant, code) in [("through", "M101"), ("mist", "M102"), ("on", "M103"), ("air", "M103"), ("off", "M104")] {
        assert_eq!(print(&[(1, coolant, LINE)]), code, "{coolant}");
    }
    // `[cool]` counts as `off` even if the previous kind has its own "off" code
    let two = job(&[(1, "through", LINE), (2, "off", LINE)]);
    assert!(codes(&form(KINDS, lines), &two).contains(&"M104".to_owned()));
    let unknown = check(&form("", "@if [cool] = through\nM1\n@end"));
    assert!(unknown.diags.iter().any(|diag| diag.code.name() == "PF706"), "{:?}", unknown.diags);
}

#[test]
fn several_kinds_are_on_at_once() {
    let list = |operations: &[(u32, &str, &str)]| {
        let job = job(operations);
        ["through,air", "air,through", "through,on", "air,on", "through"].iter().fold(job, |job, kinds| {
            let names: Vec<_> = kinds.split(',').map(|kind| format!("\"{kind}\"")).collect();
            job.replace(&format!("\"coolant\":\"{kinds}\""), &format!("\"coolant\":[{}]", names.join(",")))
        })
    };
    let ends = form(KINDS, "M[cool]").replace("EndCode\n", "EndCode\nM[coolantoff]\n");
    let print = |operations: &[(u32, &str, &str)]| codes(&ends, &list(operations));
    // `[cool]` prints the first kind, separate blocks print the others; M9 turns off kinds without their own "off" code
    assert_eq!(print(&[(1, "through,air", LINE)]), ["M88", "M12", "M9", "M89"]);
    assert_eq!(print(&[(1, "air,through", LINE)]), ["M12", "M88", "M89", "M9"]);
    assert_eq!(print(&[(1, "through", LINE)]), ["M88", "M89"]);
    let path = |changes: &str| format!("{LINE},{changes},{{\"line\":[0,0,0]}}");
    let change = |first: &str, next: &str| print(&[(1, first, &path(&format!("{{\"coolant\":{next}}}")))]);
    assert_eq!(change("through", "[\"through\",\"air\"]"), ["M88", "M12", "M9", "M89"]);
    assert_eq!(change("air", "[\"through\",\"air\"]"), ["M12", "M88", "M12", "M9", "M89"]);
    assert_eq!(change("on", "[\"on\",\"through\"]"), ["M8", "M88", "M89", "M9"]);
    assert_eq!(change("through,on", "\"on\""), ["M88", "M8", "M89", "M8", "M9"]);
    assert_eq!(change("air,through", "\"air\""), ["M12", "M88", "M89", "M9"]);
    assert_eq!(change("through,air", "\"through\""), ["M88", "M12", "M9", "M88", "M89"]);
    assert_eq!(change("through,air", "\"off\""), ["M88", "M12", "M9", "M89", "M9"]);
    // an additional kind is a change of coolant, so CoolantChange prints
    let own = format!("{ends}CoolantChange\n(COOLANT)\nM[cool]\nEnd\n");
    let beside = list(&[(1, "through", &path("{\"coolant\":[\"through\",\"air\"]}"))]);
    assert_eq!(program(&own, &beside)[6..9], ["(COOLANT)", "M88", "M12"]);
    // before the next tool change
    assert_eq!(
        print(&[(1, "on", LINE), (2, "air,through", LINE), (1, "off", LINE)]),
        ["M8", "M12", "M88", "M89", "M9", "M9"]
    );
    // after a stop, each kind that was on is turned off, even if the stop turned it off too
    let off = path("{\"stop\":\"program\"},{\"coolant\":\"off\"}");
    assert_eq!(print(&[(1, "air,through", &off)]), ["M12", "M88", "M0", "M89", "M9", "M9"]);
    // after a stop, all kinds are printed again
    let stop = path("{\"stop\":\"program\"}");
    assert_eq!(print(&[(1, "air,through", &stop)]), ["M12", "M88", "M0", "M12", "M88", "M89", "M9"]);
}

#[test]
fn conditions_ask_whether_a_list_holds_a_kind() {
    let several = |kinds: &str| job(&[(1, "on", LINE)]).replace("\"coolant\":\"on\"", &format!("\"coolant\":{kinds}"));
    let lines = "M[cool]\n@if [cool] = air\n  M12\n@end\n@if [cool] = through\n  M101\n@end";
    assert_eq!(codes(&form(KINDS, lines), &several("[\"on\",\"air\"]")), ["M8", "M12", "M9"]);
    assert_eq!(codes(&form(KINDS, lines), &several("[\"air\",\"through\"]")), ["M12", "M12", "M101", "M88", "M89"]);
    for (kinds, message) in [
        ("[\"on\",\"high\"]", "PR054 the form has no coolant `high`"),
        (
            "[\"on\",\"off\"]",
            "PJ003 a list of coolants contains only coolants that are on: write \"off\" without a list",
        ),
        ("[\"air\",\"air\"]", "PJ003 air is in the list twice"),
        ("[]", "PJ003 an empty list of coolants: write \"off\""),
        ("[\"foam\"]", "PJ003"),
        ("8", "PJ003"),
    ] {
        let told = codes(&form(KINDS, "M[cool]"), &several(kinds));
        assert!(told[0].starts_with(message), "{kinds}: {told:?}");
    }
}

#[test]
fn wrong_kinds_are_refused() {
    for head in [
        "CoolantKind",
        "CoolantKind through",
        "CoolantKind foam M88",
        "CoolantKind flood M8",
        "CoolantKind off M9",
        "CoolantKind through M88 M89 M90",
        "CoolantKind through on",
        "CoolantKind through M88\nCoolantKind through M89",
    ] {
        let checked = check(&mill(head, ""));
        assert!(
            checked.diags.iter().any(|diag| diag.is_error() && diag.code.name() == "PF302"),
            "{head}: {:?}",
            checked.diags
        );
    }
}

#[test]
fn codes_of_kinds_that_are_typed_are_said() {
    let lines = "@if [cool] = through\n  M88\n@else\n  M[cool]\n@end";
    assert_eq!(codes(&form(KINDS, lines), &job(&[(1, "through", LINE)])), ["M88"]);
    let two = job(&[(1, "through", LINE), (2, "on", LINE)]);
    let lines = "@if [cool] = through\n  M88\n@else\n  M89\n  M8\n@end";
    assert_eq!(codes(&form(KINDS, lines), &two), ["M88", "M89", "M8"]);
}

/// If the job gives no coolant, the coolant that the form turns on stays on. Coolant from the job ends with its tool.
#[test]
fn the_forms_own_coolant_stands() {
    let silent = |jobs: &[(u32, &str, &str)]| job(jobs).replace("\"coolant\":\"none\",", "");
    let own = form("", "M8");
    assert_eq!(codes(&own, &silent(&[(1, "none", LINE), (2, "none", LINE)])), ["M8", "M8"]);
    // after a stop, the coolant is printed again
    let stop = "{\"line\":[1,0,0]},{\"stop\":\"program\"},{\"line\":[0,0,0]}";
    assert_eq!(codes(&own, &silent(&[(1, "none", stop)])), ["M8", "M0", "M8"]);
    // coolant from the job ends with its tool
    assert_eq!(codes(&form("", "M[cool]"), &silent(&[(1, "on", LINE), (2, "none", LINE)])), ["M8", "M9"]);
    assert_eq!(codes(&form("", ""), &silent(&[(1, "on", LINE), (2, "none", LINE)])), ["M8", "M9"]);
    // if the form and the job both set the coolant, the job's value applies, and there is a warning
    let rendered = render(&own, &job(&[(1, "off", LINE)])).unwrap();
    assert!(rendered.text.contains("M8\n") && rendered.text.contains("\nM9\n"), "{}", rendered.text);
    let told: Vec<_> = rendered.notes.iter().map(|note| (note.code.name(), note.labels.len())).collect();
    assert_eq!(told, [("PR056", 1)]);
    assert_eq!(rendered.notes[0].message, "the form prints M8, but the job requests M9, which is printed after it");
}

/// A kind with its own off code does not turn off flood coolant, so flood coolant is turned off before this kind begins. Off
/// then turns off all coolant.
#[test]
fn coolant_that_another_kind_does_not_end_is_turned_off() {
    let path =
        "{\"line\":[1,0,0]},{\"coolant\":\"through\"},{\"line\":[2,0,0]},{\"coolant\":\"off\"},{\"line\":[3,0,0]}";
    let print = |path: &str| codes(&form(KINDS, "M[cool]"), &job(&[(1, "flood", path)]));
    assert_eq!(print(path), ["M8", "M9", "M88", "M89"]);
    // air has no off code, so it replaces flood; flood as a second kind stays on
    assert_eq!(print(&path.replace("through", "air")), ["M8", "M12", "M9"]);
    // mist with the off code of all coolant is turned off before flood, and flood before mist
    let mist = |kind: &str| {
        let path =
            "{\"line\":[1,0,0]},{\"coolant\":\"flood\"},{\"line\":[2,0,0]},{\"coolant\":\"mist\"},{\"line\":[3,0,0]}";
        codes(&form(kind, "M[cool]"), &job(&[(1, "mist", path)]))
    };
    assert_eq!(mist("CoolantKind mist M7 M9"), ["M7", "M9", "M8", "M9", "M7"]);
    assert_eq!(mist(""), ["M7", "M8", "M7"]);
    let both = path.replace("\"through\"", "[\"through\",\"flood\"]");
    assert_eq!(print(&both), ["M8", "M88", "M8", "M9", "M89"]);
}

/// Codes that postform prints by itself are not words of the form.
#[test]
fn coolant_that_ends_before_a_tool_change_is_no_word_of_the_form() {
    let text = job(&[(1, "off", LINE), (2, "none", LINE)])
        .replace("\"coolant\":\"off\"", "\"coolant\":[\"air\",\"flood\"]")
        .replace("\"coolant\":\"none\",", "")
        .replacen('{', "{\"program\":1,", 1);
    let rendered = render(&plain_post("haas.pf"), &text).unwrap();
    assert!(rendered.notes.iter().all(|note| note.code.name() != "PR056"), "{:?}", rendered.notes);
    let second = rendered.text.split("T2 M6").nth(1).unwrap();
    assert_eq!(second.matches("M84").count(), 1, "{second}");
    assert_eq!(second.matches("M9\n").count(), 1, "{second}");
}

/// A speed that the tool change prints applies until the job changes the speed.
#[test]
fn the_forms_own_speed_stands() {
    let speeds = |form: &str, path: &str| -> Vec<String> {
        let words = program(form, &job(&[(1, "off", path)])).join(" ");
        words.split(' ').filter(|word| word.starts_with('S')).map(str::to_owned).collect()
    };
    let property = mill("Property rpm number 500 Speed of the machine", "").replace("S[speed]", "S[rpm]");
    let typed = mill("", "").replace("S[speed]", "S700");
    assert_eq!([speeds(&property, LINE), speeds(&typed, LINE)], [["S500"], ["S700"]]);
    let later = "{\"line\":[1,0,0]},{\"spindle\":{\"speed\":1200}},{\"line\":[0,0,0]}";
    assert_eq!(speeds(&typed, later), ["S700", "S1200"]);
    let stop = "{\"line\":[1,0,0]},{\"stop\":\"program\"},{\"line\":[0,0,0]}";
    assert_eq!(speeds(&typed, stop), ["S700", "S700"]);
    // if another sequence prints a speed, the job's speed is printed again after the sequence
    let row = mill("", "BeginRow\nS300\nEnd");
    let path = "{\"begin\":\"row\"},{\"line\":[1,0,0]},{\"end\":\"row\"}";
    assert_eq!(speeds(&row, path), ["S1000", "S300", "S1000"]);
    assert_eq!(render(&row, &job(&[(1, "off", path)])).unwrap().notes[0].code.name(), "PR056");
}

/// M88 and M89 of a Haas stop the spindle, so the spindle is started again before the next cut.
#[test]
fn a_code_that_stops_the_spindle_is_followed_by_the_spindle() {
    let on = "{\"line\":[1,0,0]},{\"coolant\":\"through\"},{\"line\":[0,0,0]}";
    let print = |control: &str| {
        let printed = program(&form(&format!("Control {control}\n{KINDS}"), "M[cool]"), &job(&[(1, "off", on)]));
        let words = printed.iter().flat_map(|line| line.split(' ')).filter(|word| word.starts_with(['S', 'M']));
        words.map(str::to_owned).collect::<Vec<_>>().join(" ")
    };
    assert_eq!(print("haas"), "M6 M9 S1000 M3 M88 S1000 M3 M30");
    // for a Fanuc, no public source defines M88; it is a code of the machine's builder
    assert_eq!(print("fanuc"), "M6 M9 S1000 M3 M88 M30");
}

/// The shipped form prints the code for coolant through the spindle before it starts the spindle, so that no code is
/// printed twice.
#[test]
fn the_form_of_a_haas_says_coolant_through_the_spindle_before_the_spindle() {
    let printed = program(
        &plain_post("haas.pf"),
        &job(&[(1, "through", LINE), (2, "on", LINE)]).replacen('{', "{\"program\":1,", 1),
    );
    let at = |word: &str| printed.iter().position(|line| line.split(' ').any(|own| own == word)).unwrap();
    assert!(at("M88") < at("M3") && at("M3") < at("M89") && at("M89") < at("M8"), "{printed:#?}");
    assert_eq!(printed.iter().filter(|line| line.contains("M3")).count(), 3, "{printed:#?}"); // two tools, and M30
}

/// A dry cut is found for each kind of coolant, and flood, mist and coolant through the spindle in place of each other.
#[test]
fn a_dry_cut_is_found_for_each_kind() {
    let folder = Folder::new("dry");
    let fanuc = plain_post("fanuc.pf");
    folder.write("form.pf", fanuc.replacen("Units both\n", &format!("Units both\n{KINDS}\n"), 1));
    folder.write("through.toml", "name = \"through\"\nlike = \"fanuc\"\n\n[codes]\n\"M88\" = { is = \"through\" }\n");
    let own = ["--form", "form.pf"];
    let control = ["--control", "through.toml"];
    for (coolant, printed, replaced, rules, finding) in [
        ("\"through\"", "M88", "M88", own, ""),
        ("\"through\"", "M88", "", own, "the coolant is off, but through in the job"),
        ("\"through\"", "M88", "M8", own, "the coolant is flood, but through in the job"),
        ("\"through\"", "M88", "M7", own, "the coolant is mist, but through in the job"),
        ("\"through\"", "M88", "M12", own, "the coolant is air, but through in the job"),
        ("\"through\"", "M88", "M88\nM89", own, "the coolant is off, but through in the job"),
        ("\"through\"", "M88", "M88\nM8\nM89", own, "the coolant is flood, but through in the job"),
        ("\"through\"", "M88", "M8\nM88", own, ""),
        ("\"through\"", "M88", "", control, "the coolant is off, but through in the job"),
        ("\"flood\"", "M8", "M88", own, "the coolant is through, but flood in the job"),
        ("\"flood\"", "M8", "M12", own, "the coolant is air, but flood in the job"),
        ("\"mist\"", "M7", "M88", own, "the coolant is through, but mist in the job"),
        // of flood and mist at once, only a cut without both is found
        ("[\"flood\",\"mist\"]", "M8", "M8", own, ""),
        ("[\"flood\",\"mist\"]", "M8\nN50 M7", "M88", own, "the coolant is through, but flood and mist in the job"),
        ("\"air\"", "M12", "M12", own, ""),
        ("\"air\"", "M12", "", own, "the coolant is off, but air in the job"),
        ("[\"through\",\"air\"]", "M12", "M12", own, ""),
        ("[\"through\",\"air\"]", "M88\nN50 M12", "", own, "the coolant is off, but through and air in the job"),
        (
            "[\"through\",\"air\"]",
            "M88\nN50 M12",
            "\nN50 M12",
            own,
            "the coolant is air, but through and air in the job",
        ),
        // without a form, the code of air is unknown
        ("\"air\"", "M12", "", control, ""),
    ] {
        folder.write("job.json", job(&[(1, "KIND", LINE)]).replace("\"KIND\"", coolant));
        let program = out(&folder.run(&["render", "job.json", "--form", "form.pf", "--program", "1"]));
        assert_eq!(program.matches(printed).count(), 1, "{coolant}: {program}");
        folder.write("program.nc", program.replacen(printed, replaced, 1));
        let output = folder.run(&[&["verify", "job.json", "--nc", "program.nc"], &rules[..]].concat());
        let told = err(&output);
        assert_eq!(output.status.success(), finding.is_empty(), "{coolant}, {replaced}: {told}");
        assert!(told.contains(finding), "{coolant}, {replaced}: {told}");
    }
}

/// The proof compares mist by the code that the form prints for mist. A code that turns coolant off is no mist.
#[test]
fn mist_is_compared_by_the_forms_code() {
    let folder = Folder::new("mist");
    let fanuc = plain_post("fanuc.pf");
    for (line, coolant, result) in [
        ("Coolant 8 9 7", "mist", "M7"),
        ("Coolant 8 9 8", "mist", "M8"),
        ("CoolantKind mist M50 M51", "mist", "M50"),
        ("Coolant 8 9\nCoolantKind mist M50 M51", "mist", "M50"),
        ("Coolant 50 9 7", "flood", "M50"),
        ("Coolant 8 9 9", "mist", "PV024"),
        ("Coolant 9 8 7", "flood", "PV024"),
        ("CoolantKind mist M9", "mist", "PV024"),
    ] {
        folder.write("form.pf", fanuc.replacen("Units both\n", &format!("Units both\n{line}\n"), 1));
        folder.write("job.json", job(&[(1, coolant, LINE)]));
        let output = folder.run(&["render", "job.json", "--form", "form.pf", "--program", "1"]);
        let printed = out(&output) + &err(&output);
        assert!(printed.contains(result), "{line}: {printed}");
        assert_eq!(output.status.success(), result != "PV024", "{line}: {printed}");
    }
}
