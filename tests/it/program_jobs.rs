//! NC programs that are read as jobs and printed by the Haas post: the output, the warnings, the refusals.

use crate::support::control;
use std::io::Cursor;

use crate::support::folder::{Folder, err, out};
use crate::support::{check, job_options, mill, plain_post, root};
use postform::internals::compile::compile;
use postform::internals::nc::{JobOptions, RunSettings, read_program};
use postform::internals::render::{Options, Renderer};
use postform::toolpath::ReadError;
use postform::{Job, NoFiles, Options as PostOptions, Post, Source, Verdict};

const HEAD: &str = "G20 G17 G90\nT1 M6\nG54 G0 X0. Y0. S1000 M3\nG43 H1 Z1. M8\n";

/// Coolant through the spindle stays coolant through the spindle. A form without a code for it refuses the job.
#[test]
fn coolant_through_the_spindle_is_not_flood() {
    let folder = Folder::new("through-job");
    let program =
        "G20 G17 G90\nT1 M6\nG54 G0 X0. Y0. S1000 M3\nG43 H1 Z1. M494\nG1 Z-.1 F5.\nM8\nG1 X1.\nG0 Z1.\nM9\nM30\n";
    folder.write("old.nc", program);
    let render = |form: &str| {
        let form = root().join("postforms").join(form).display().to_string();
        folder.run(&["render", "old.nc", "--form", &form, "--job-control", "brother", "--program", "1"])
    };
    let brother = render("brother.pf");
    let text = out(&brother);
    let codes: Vec<_> = text.split_whitespace().filter(|word| ["M494", "M8"].contains(word)).collect();
    assert_eq!(codes, ["M494", "M8"], "{text}");
    assert!(err(&brother).contains("identical"), "{}", err(&brother));
    let fanuc = err(&render("fanuc.pf"));
    assert!(fanuc.contains("PR054") && fanuc.contains("no coolant `through`"), "{fanuc}");
}

/// The new program with its warnings, or the error code of the refusal.
fn printed(program: &str) -> Result<(String, Vec<String>), String> {
    printed_by(&plain_post("haas.pf"), program)
}

/// The new program of another form with its warnings, or the error code of the refusal.
fn printed_by(form: &str, program: &str) -> Result<(String, Vec<String>), String> {
    let checked = check(form);
    let form = compile(&checked.form);
    let mut renderer = Renderer::new(&form, Options { program: Some(1), ..Options::default() });
    let options = job_options(RunSettings::new(control("fanuc")));
    let mut warnings = Vec::new();
    match read_program(Cursor::new(program), &options, &mut warnings, &mut renderer) {
        Ok(()) => {
            let text = String::from_utf8(std::mem::take(renderer.text())).unwrap();
            Ok((text, warnings.into_iter().map(|diag| diag.message).collect()))
        }
        Err(ReadError::Job(diag)) => Err(diag.code.name().into()),
        Err(other) => panic!("{other:?}"),
    }
}

/// The blocks of the path, without block numbers.
fn path(blocks: &str) -> Vec<String> {
    let (text, _) = printed(&format!("{HEAD}{blocks}\nM30\n")).unwrap_or_else(|code| panic!("{blocks}: {code}"));
    let lines = text.lines().map(|line| line.split_once(' ').map_or(line, |(_, rest)| rest).to_owned());
    let lines: Vec<String> = lines.skip_while(|line| !line.starts_with("G43")).skip(1).collect();
    let end = lines.iter().rposition(|line| line == "M9").unwrap_or(lines.len());
    lines[..end].to_vec()
}

/// G43 stays active after a tool change. If a tool cuts with the length offset of another tool, the new program keeps
/// this offset, and there is a warning.
#[test]
fn a_tool_keeps_the_length_offset_that_it_cuts_with() {
    let second = "G1 Z-.1 F5.\nG0 Z1.\nT2 M6\nS500 M3\nG0 X1. Y1.\n";
    let (text, warnings) = printed(&format!("{HEAD}{second}Z.5\nG1 Z-.2 F6.\nM30\n")).unwrap();
    assert!(text.contains("T2 M6") && text.contains("G43 H1 Z.5") && !text.contains("H2"), "{text}");
    assert_eq!(warnings, ["a tool cuts with length offset H1, which an earlier tool turned on"]);
    let (text, warnings) = printed(&format!("{HEAD}{second}G43 H2 Z.5\nG1 Z-.2 F6.\nM30\n")).unwrap();
    assert!(text.contains("G43 H2 Z.5") && warnings.is_empty(), "{warnings:?}\n{text}");
}

/// A tool must not cut both with and without its length offset, because these are two frames.
#[test]
fn a_tool_has_its_length_or_none() {
    assert_eq!(printed(&format!("{HEAD}G1 Z-.1 F5.\nG49\nG1 Z-.2\nM30\n")).unwrap_err(), "PN036");
    assert!(printed(&format!("{HEAD}G1 Z-.1 F5.\nG0 Z1.\nG49\nM30\n")).is_ok());
    let late = HEAD.replace("G43 H1 Z1.", "Z1.");
    assert_eq!(printed(&format!("{late}G1 Z-.1 F5.\nG43 H1 G1 Z-.2\nM30\n")).unwrap_err(), "PN036");
}

/// A tool whose length is turned off (G43 H0, or G49 after its tool change) has register 0 in the job. A program that
/// turns a length on is another program, and on a machine with tool lengths a tool without its length is a hazard. A
/// program without any code for lengths may be for a machine without tool lengths, so the form may print them.
#[test]
fn a_length_that_is_off_stays_off() {
    const IS_ON: &str = "with H1, but the length is off in the job";
    const IS_OFF: &str = "without its length offset";
    let cases = [
        ("G43 H0 Z1.", "haas.pf", IS_OFF),
        ("G49 Z1.", "haas.pf", IS_OFF),
        ("G43 H1\nG49 Z1.", "haas.pf", "PN036"),
        ("G43 H0 Z1.", "okuma.pf", IS_OFF),
        // H0 is the tool in the spindle
        ("G43 H0 Z1.", "linuxcnc.pf", IS_ON),
        // .. but on Mach3 it is no length
        ("G43 H0 Z1.", "mach3.pf", IS_OFF),
        // the length belongs to the tool, and the form turns it on
        ("G43 H0 Z1.", "siemens.pf", IS_ON),
        ("G43 H0 Z1.", "heidenhain.pf", IS_ON),
        // the control has no tool lengths
        ("G43 H0 Z1.", "grbl.pf", ""),
        ("G43 H1 Z1.", "haas.pf", ""),
        ("Z1.", "haas.pf", ""),
    ];
    for (codes, form, expected) in cases {
        let job = format!("%\nO1\n{}G1 Z-.1 F5.\nX1.\nG0 Z1.\nM30\n%\n", HEAD.replace("G43 H1 Z1. M8", codes));
        let post = Post::compile(Source::from_text(form, plain_post(form)), &NoFiles).unwrap();
        let found = match post.render(Job::nc(&job), &PostOptions::default()).map(|program| program.verdict().clone()) {
            Ok(Verdict::Different(found)) => found.into_iter().map(|one| one.message + "\n").collect(),
            Ok(_) => String::new(),
            Err(error) => error.to_string(),
        };
        assert_eq!(found.is_empty(), expected.is_empty(), "{codes} {form}: {found}");
        assert!(found.contains(expected), "{codes} {form}: {found}");
    }
}

/// However many cuts a tool makes without its length, the warning is there once.
#[test]
fn a_length_that_is_off_is_reported_once() {
    let cuts = "X1.\nX2.\n".repeat(500);
    for codes in ["G49 Z1.", "G43 H0 Z1.", "Z1."] {
        let (_, warnings) =
            printed(&format!("{}G1 Z-.1 F5.\n{cuts}M30\n", HEAD.replace("G43 H1 Z1. M8", codes))).unwrap();
        assert_eq!(warnings.len(), 1, "{codes}: {warnings:?}");
    }
}

/// G53 moves straight at rapid. No control has an arc to a machine position.
#[test]
fn an_arc_in_machine_coordinates_is_refused() {
    assert_eq!(printed(&format!("{HEAD}G1 Z-.1 F5.\nG53 G2 I1.\nM30\n")).unwrap_err(), "PN006");
}

#[test]
fn motions_feeds_and_switches_stay_what_they_were() {
    assert_eq!(path("G1 Z-.1 F5.\nX1. M5\nG0 Z1."), ["G1 Z-.1 F5.", "X1.", "M5", "G0 Z1."]);
    assert_eq!(path("M5\nS500\nG84 X1. Z-.5 R.1 F25.\nG80")[0], "S500 M3", "the tap starts the spindle");
    assert_eq!(path("G1 Z-.1 F5.\nG4 P500\nM0\nX1."), ["G1 Z-.1 F5.", "G4 P.5", "M0", "S1000 M3", "M8", "X1."]);
    assert_eq!(path("G91 G1 Z-1.1 F5.\nX1.\nX1.\nG90 G0 Z1."), ["G1 Z-.1 F5.", "X1.", "X2.", "G0 Z1."]);
    assert_eq!(
        path("G1 Z-.1 F5.\nM98 P7 L2\nG0 Z1.\nM30\nO7\nG91 X1.\nG90\nM99"),
        ["G1 Z-.1 F5.", "X1.", "X2.", "G0 Z1."]
    );
    assert_eq!(path("D5\nG1 Z-.1 F5.\nG41 X1.\nG40 X2.")[1], "G1 G41 D5 X1. Y0 F5.");
    let (text, _) = printed("G20 G90 F10.\nT1 M6\nG54 G0 X0. Y0. S1000 M3\nG43 H1 Z1.\nG1 Z-.1\nM30\n").unwrap();
    assert!(text.contains("G1 Z-.1 F10."), "F counts in the block's own units\n{text}");
    let (text, _) = printed(&format!(
        "{HEAD}G1 Z-.1 F5.\nG0 Z1.\nG91 G28 Z0\nG90\nT2 M6\nG55 X3. Y3. S500 M4\nG43 H12 Z1.\nG1 Z-.2 F6.\nM30\n"
    ))
    .unwrap();
    for part in ["T2 M6", "G55 X3. Y3.", "S500 M4", "G43 H12 Z1. M8", "G1 Z-.2 F6."] {
        assert!(text.contains(part), "{part}\n{text}");
    }
}

/// Stops are kept, even where a feed mode changes.
#[test]
fn stops_stay() {
    let lines = path("G81 X1. Z-1. R.1 F5.\nG80 G94\nM1\nG81 X2. Z-1. R.1");
    assert!(lines.contains(&"M1".to_owned()), "{lines:?}");
    let (text, _) =
        printed(&format!("{HEAD}G95 G81 X1. Z-1. R.1 F.05\nG80 G94\nM0\nM3\nG81 X2. Z-1. R.1 F5.\nG80\nM30\n"))
            .unwrap();
    assert!(text.contains(" M0\n"), "{text}");
}

/// If the tool goes home before a stop, it also goes home before the stop in the new program: between the moves of a
/// tool, before the next tool, and at the end.
#[test]
fn a_stop_at_home_stays_at_home() {
    let cut = "G0 Z3.\nZ1.\nG1 Z-.1 F5.\nM9\nG91 G28 Z0\n";
    let next = "G90\nT2 M6\nG0 X2. Y2. S500 M3\nG43 H2 Z1.\nG1 Z-.2 F6.\n";
    let go_on = "G90 G0 X4. Y5.\nG43 H1 Z1. M3\nG1 Z-.3 F6.\n";
    let across = "G90 G53 G0 Y0\nM0\nM5\nG90 G0 X4. Y5.\nM1\nG43 H1 Z1. M3\nG1 Z-.3 F6.\n";
    let home = ["M9", "G0 G53 Z0"];
    for (after, lines) in [
        (format!("M1\n{next}"), &["M1", "M9", "G0 G53 Z0 M5", "T2 M6"][..]),
        (format!("G4 P1000\nM1\n{next}"), &["G4 P1.", "M1", "M9", "G0 G53 Z0 M5", "T2 M6"]),
        ("M0\n".to_owned(), &["M0", "M9", "G0 G53 Z0 M5", "G53 Y0", "M30"]),
        // across at the highest Z of the program, and then down
        (format!("M1\n{go_on}"), &["M1", "S1000 M3", "G0 X4. Y5.", "Z3.", "Z1.", "G1 Z-.3 F6."]),
        // between the two stops, the tool moves across at home
        (across.to_owned(), &["M0", "M5", "X4. Y5.", "M1", "S1000 M3", "G0 X4. Y5.", "Z3.", "Z1.", "G1 Z-.3 F6."]),
    ] {
        let (text, warnings) = printed(&format!("{HEAD}{cut}{after}M30\n")).unwrap();
        let all: Vec<&str> = text.lines().map(|line| line.split_once(' ').map_or(line, |(_, rest)| rest)).collect();
        let cut = all.iter().position(|line| *line == "G1 Z-.1 F5.").unwrap();
        assert_eq!(all[cut + 1..][..2 + lines.len()], [&home[..], lines].concat(), "{text}");
        assert!(warnings.iter().any(|warning| warning.contains("becomes the move home of the form")), "{warnings:?}");
    }
    // only the form knows its home position
    let without = printed_by(&mill("", ""), &format!("{HEAD}{cut}M1\n{next}M30\n"));
    assert_eq!(without.unwrap_err(), "PR008");
    // a program that stops above the part is another program
    let old = format!("{HEAD}{cut}M1\n{next}M30\n");
    let swapped = old.replace("G91 G28 Z0\nM1\n", "M1\nG91 G28 Z0\n");
    let verdict = |program: &str| verdict_of("fanuc", Job::nc(old.as_bytes()), program).unwrap();
    assert!(verdict(&old).is_proven(), "{:?}", verdict(&old));
    let Verdict::Different(findings) = verdict(&swapped) else { panic!("{:?}", verdict(&swapped)) };
    assert_eq!(findings[0].code.name(), "PV019");
}

/// A tool that goes on in another work offset begins at the position of its first rapid there. The position in the work
/// offset before is another position, although the numbers are known: with and without a move home.
#[test]
fn a_tool_goes_on_in_another_work_offset_at_its_own_position() {
    let cut = "G0 Z1.\nG1 Z-.1 F5.\nX4. Y7.\nG0 Z3.\n";
    for home in ["", "G91 G28 Z0\nG90\n", "G0 G53 Z0\n"] {
        for next in ["G55 X1. Y2.\nG43 H1 Z.5\nG1 Z-.2\n", "G55\nX1. Y7.\nG43 H1 Z.5\nG1 Z-.2\n"] {
            let (text, _) = printed(&format!("{HEAD}{cut}{home}{next}M30\n")).unwrap();
            let all: Vec<&str> = text.lines().map(|line| line.split_once(' ').map_or(line, |(_, rest)| rest)).collect();
            let at = all.iter().position(|line| line.starts_with("G55")).unwrap();
            let first = if next.contains("Y2.") { "G55 X1. Y2." } else { "G55 X1. Y7." };
            assert_eq!(all[at..][..4], [first, "Z3.", "Z.5", "G1 Z-.2"], "{home}{next}{text}");
        }
    }
}

#[test]
fn what_no_job_can_say_is_refused() {
    let cases = [
        ("G18 G81 X1. Z1. Y-1. R.1 F5.\nG80 G17", "a cycle along another axis"),
        ("G1 Z-.1 F5.\nG10 L2 P1 X2.\nX1.", "a frame that moves between moves"),
        ("G1 Z-.1 F5.\nG10 L12 P1 R5.\nX1.", "tool data that change between moves"),
        ("G1 Z-.1 F5.\nG91 G28 Z0\nG90 G92 Z5.\nG0 Z6.", "G92 at an unknown machine position"),
        ("G18\nG1 Z-.1 F5.\nG41 D1 X1.\nX2.\nG40 X3.", "compensation in another plane"),
        ("G44 H1 Z2.\nG1 Z-.1 F5.", "an offset that is taken off"),
        ("G41 D1 G1 X1. F5.\nX2.\nD3 X3.\nG40 X4.", "two diameter registers of one tool"),
        ("G43 H2 Z2.\nG1 Z-.1 F5.", "two length registers of one tool"),
        ("G49\nG0 Z2.\nG1 X1. F5.", "a length register and no length of one tool"),
        ("G98 G87 X1. Z-.3 R-.8 Q.1 F5.\nG80", "a back bore"),
        ("G99 G76 X1. Z-.3 R.1 Q.02 F5.\nG80", "a fine bore, whose side only the control knows"),
        ("G54.1 P44\nG1 Z-.1 F5.", "a work offset above 49"),
        ("M19\nG1 Z-.1 F5.", "an orientation"),
        ("G1 Z-.1 F5.\nG21 X10.", "other units"),
        ("G28 G91 Z0\nG90 G1 X1. F5.", "a cut from the reference point"),
    ];
    for (blocks, what) in cases {
        let outcome = printed(&format!("{HEAD}{blocks}\nM30\n"));
        assert_eq!(outcome.as_ref().err().map(String::as_str), Some("PN036"), "{what}: {outcome:?}");
    }
    assert_eq!(printed("G90 T1 M6\nG0 X1. Y1. Z1.\nM30\n").unwrap_err(), "PL005");
    assert_eq!(printed("G20 G90\nG0 X1. Y1. Z1.\nM30\n").unwrap_err(), "PN036");
    assert_eq!(printed(&format!("{HEAD}G1 X1. F5. G4 P2\nM30\n")).unwrap_err(), "PN004");
}

#[test]
fn what_is_left_out_is_warned_of() {
    let cases = [
        ("/G1 X1. F5.", "block delete"),
        ("G61\nG1 X1. F5.", "G61"),
        ("G1 G9 X1. F5.", "G9"),
        ("M88\nG1 X1. F5.", "M88"),
        ("G08 P1\nG1 X1. F5.", "G8"),
        ("M7\nG1 X1. F5.", "flood and mist"),
        ("G1 Z-.1 F5.\nG91 G28 Z0\nG90 G0 X3. Y3. Z1.\nG1 Z-.1", "reference point"),
        ("G1 Z-.1 F5.\nG91 G28 Z0\nG90 G0 X3. Y3. Z1.\nG1 Z-.1", "after G28, G30 or G53 without another G43"),
    ];
    for (blocks, part) in cases {
        let (text, warnings) =
            printed(&format!("{HEAD}{blocks}\nM30\n")).unwrap_or_else(|code| panic!("{blocks}: {code}"));
        assert!(warnings.iter().any(|warning| warning.contains(part)), "{blocks}: {warnings:?}\n{text}");
    }
    let (_, warnings) = printed(&format!("{HEAD}G1 X1. F5.\nM30\n")).unwrap();
    assert_eq!(warnings, Vec::<String>::new());
    let before_moves = HEAD.replace("G90\n", "G90\nG10 L10 P1 R2.\n");
    let (_, warnings) = printed(&format!("{before_moves}G1 X1. F5.\nM30\n")).unwrap();
    assert!(warnings.iter().any(|warning| warning.contains("G10")), "{warnings:?}");
    let (_, warnings) = printed(&format!("{HEAD}G1 X1. F5.\nM99\n")).unwrap();
    assert!(warnings.iter().any(|warning| warning.contains("M99")), "{warnings:?}");
}

/// A code of the machine's builder may have a meaning that a job can contain. The help names the file that gives this
/// meaning, and its line.
#[test]
fn the_help_of_a_builders_code_names_the_control_file() {
    let help = |code: &str| {
        let program = format!("{HEAD}{code}\nG1 X1. F5.\nM30\n");
        let checked = check(&plain_post("haas.pf"));
        let form = compile(&checked.form);
        let mut renderer = Renderer::new(&form, Options { program: Some(1), ..Options::default() });
        let mut warnings = Vec::new();
        let options = job_options(RunSettings::new(control("fanuc")));
        read_program(Cursor::new(program), &options, &mut warnings, &mut renderer).unwrap();
        warnings.into_iter().find_map(|diag| diag.help).unwrap()
    };
    for code in ["M51", "M59"] {
        let (help, line) = (help(code), format!("`\"{code}\" = {{ is = \"through\" }}`"));
        assert!(help.contains(&line) && help.contains("--job-control my-control.toml"), "{help}");
        assert!(help.contains("postform new --control-file fanuc -o my-control.toml"), "{help}");
    }
    assert_eq!(help("G61"), "if the machine needs it, let the form print it");
}

/// The holes of a pattern become one cycle, even if the program ends the cycle after each hole and moves at rapid at
/// the return height.
#[test]
fn a_pattern_of_holes_stays_one_cycle() {
    let each = |x: u32| format!("G81 X{x}. Z-1. R.1 F5.\nG80\n");
    let one = ["G98 G81 X1. Y0 Z-1. R.1 F5.", "X2.", "X3.", "G80"];
    assert_eq!(path(&format!("G0 X1.\n{}G0 X2.\n{}G0 Y0\nX3.\n{}", each(1), each(2), each(3)))[1..], one);
    // a detour, a lift over a clamp, a stop
    for between in ["G0 Y5.\nX2.\nY0", "G0 Z4.\nX2.\nZ1.", "M0\nM3"] {
        let lines = path(&format!("G0 X1.\n{}{between}\n{}", each(1), each(2)));
        assert_eq!(lines.iter().filter(|line| line.contains("G81")).count(), 2, "{between}: {lines:?}");
        let said = between.lines().next().unwrap().rsplit(' ').next().unwrap();
        assert!(lines.iter().any(|line| line.contains(said)), "{between}: {lines:?}");
    }
    // a state that changes between two holes changes at the same position in the new program
    let lines = path(&format!("G0 X1.\n{}G0 X2.\nG55\nZ1.\n{}", each(1), each(2)));
    let [moved, work] = ["X2.", "G55"].map(|word| lines.iter().position(|line| line.contains(word)).unwrap());
    assert!(moved < work, "{lines:?}");
    // a hole with another depth belongs to the pattern, but a hole with another feed does not
    let deeper = path(&format!("G0 X1.\n{}G0 X2.\nG81 X2. Z-2. R.1 F6.\nG80", each(1)));
    assert_eq!(deeper.iter().filter(|line| line.contains("G81")).count(), 2, "{deeper:?}");
    // moves after the last hole are kept
    assert_eq!(path(&format!("G0 X1.\n{}G0 X7.\nG1 Z.5 F9.", each(1))).last().unwrap(), "G1 Z.5 F9.");
    assert!(path(&format!("G0 X1.\n{}G0 X7.\nG1 Z.5 F9.", each(1))).contains(&"G0 X7.".to_owned()));
}

#[test]
fn stops_before_the_first_move_of_a_tool_stay() {
    let (text, warnings) =
        printed("G20 G90\nT1 M6\nM0 (oil)\nG54 G0 X0. Y0. S1000 M3\nG43 H1 Z1.\nG1 Z-.1 F5.\nM30\n").unwrap();
    let (change, stop, cut) = (text.find("T1 M6").unwrap(), text.find(" M0\n").unwrap(), text.find("Z-.1").unwrap());
    assert!(change < stop && stop < cut, "{text}");
    assert!(warnings.is_empty(), "{warnings:?}");
    let (text, warnings) = printed(&format!("{HEAD}G1 Z-.1 F5.\nG0 Z1.\nG91 G28 Z0\nT2 M6\nM0\nG90\nM30\n")).unwrap();
    assert!(
        !text.contains(" M0\n") && warnings.iter().any(|w| w.contains("without later moves")),
        "{text}{warnings:?}"
    );
}

#[test]
fn a_warning_is_counted() {
    let home = "G91 G28 Z0\nG90\nG0 X1. Y1.\nG43 H1 Z1.\nG1 Z-.1 F5.\nG0 Z1.\n";
    let program = format!("G20 G17 G90\nT1 M6\nG54 S1000 M3\nG0 X0 Y0\nM8\nM7\nM8\nM7\n{home}{home}M30\n");
    let (_, warnings) = printed(&program).unwrap();
    let both: Vec<&String> = warnings.iter().filter(|w| w.contains("flood and mist")).collect();
    assert_eq!(both.len(), 1, "{warnings:?}");
    assert!(both[0].ends_with("(3 times, the first here)"), "{both:?}");
}

/// The verdict of a program for its job, without a form.
fn verdict_of(name: &str, mut job: Job<'_>, program: &str) -> Result<Verdict, postform::Error> {
    let mut proof = postform::Proof::default();
    proof.control = Some(control(name));
    job.reading.control = proof.control;
    proof.verify(job, Cursor::new(program)).map(|proven| proven.verdict)
}

/// A program has the pecks and the kind of taps of its job. Full retracts and rigid taps may replace chip breaks and taps
/// with a floating holder, and are counted.
#[test]
fn pecks_and_taps_are_those_of_the_job() {
    let fanuc = |cycle: &str| {
        format!("G90 G21 G17 G94 G54\nT1 M6\nG0 X0 Y0 S500 M3\nG43 H1 Z50.\n{cycle} F500.\nG80\nG0 Z50.\nM30\n")
    };
    let siemens =
        |cycle: &str| format!("G17 G90 G710 G94 G54\nT1 M6\nD1 S500 M3\nG0 X0 Y0 Z50 F500\n{cycle}\nG0 Z50\nM30\n");
    let klartext = |cycle: &str| {
        format!(
            "0 BEGIN PGM T MM\nTOOL CALL 1 Z S500\nL X+0 Y+0 Z+50 R0 FMAX M3\n{cycle} Q200=2 Q201=-18 Q203=0 Q204=50\n\
             CYCL CALL\nL Z+50 FMAX\nM30\nEND PGM T MM\n"
        )
    };
    let okuma = |cycle: &str| {
        format!("G90 G21 G17 G94\nG15 H1\nT1 M6\nG0 X0 Y0 S500 M3\nG56 H1 Z50\nG71 Z50\n{cycle} M53\nG80\nG0 Z50\nM2\n")
    };
    let linuxcnc =
        |blocks: &str| format!("G21 G90 G17 G94\nT1 M6\nG43\nS500 M3\nG0 X0 Y0 Z50\n{blocks}\nG80\nG0 Z50\nM2\n");
    let (clears, breaks, drills) =
        (fanuc("G98 G83 Z-18. R2. Q5."), fanuc("G98 G73 Z-18. R2. Q5."), fanuc("G98 G81 Z-18. R2."));
    let (ahead, alone) = (fanuc("M29 S500\nG98 G84 Z-18. R2."), fanuc("G98 G84 Z-18. R2."));
    let (rigid, floating) =
        (siemens("CYCLE84(50,0,2,-18,,0,3,,1,0,500,500)"), siemens("CYCLE840(50,0,2,-18,,0,0,3,0,,1)"));
    let (rigid_there, floating_there) = (klartext("CYCL DEF 207 T Q239=1"), klartext("CYCL DEF 206 T Q206=500 Q211=0"));
    let (follows, feeds) = (okuma("G284 X0 Y0 Z-18 R2 F500"), okuma("G84 X0 Y0 Z-18 R2 F500"));
    let (pecks, retracts) = ("PV023", "1 hole with full retracts where the job only breaks the chips");
    let (floats, follows_instead) = ("PV011", "2 tapping cuts made rigidly where the job has a floating holder");
    for (name, job, program, expected) in [
        ("fanuc", &breaks, &breaks, "identical"),
        ("fanuc", &breaks, &clears, retracts),
        ("fanuc", &breaks, &drills, pecks),
        ("fanuc", &clears, &breaks, pecks),
        ("fanuc", &clears, &drills, pecks),
        ("fanuc", &drills, &breaks, "1 hole with other pecks"),
        ("fanuc", &ahead, &ahead, "identical"),
        ("fanuc", &ahead, &alone, floats),
        ("fanuc", &alone, &alone, "identical"),
        ("siemens", &rigid, &rigid, "identical"),
        ("siemens", &rigid, &floating, floats),
        ("siemens", &floating, &rigid, follows_instead),
        ("heidenhain", &rigid_there, &floating_there, floats),
        ("heidenhain", &floating_there, &rigid_there, follows_instead),
        ("okuma", &follows, &feeds, floats),
        ("okuma", &feeds, &follows, follows_instead),
        ("linuxcnc", &linuxcnc("G98 G84 Z-18 R2 F500"), &linuxcnc("G98 G84 Z-18 R2 F500"), "equivalent"),
    ] {
        let verdict = verdict_of(name, Job::nc(job), program).unwrap();
        let found = match &verdict {
            Verdict::Different(found) => found.iter().map(|found| found.code.name()).collect::<Vec<_>>().join(" "),
            other => other.to_string(),
        };
        assert!(found.contains(expected), "{name}:\n{job}\n{program}\n{verdict:#?}");
    }
    let json = r#"{"postform":1,"program":1,"units":"mm","machine":"mill","tools":[{"number":1,"length_offset":1}],
        "operations":[{"tool":1,"work":54,"spindle":{"speed":500,"direction":"cw"},"path":[{"rapid":[0,0,50]},
        {"cycle":{"kind":"tap","rigid":true,"depth":18,"clear":2,"return":50,"feed":500,"points":[[0,0,0]]}},{"rapid":[0,0,50]}]}]}"#;
    let verdict = verdict_of("linuxcnc", Job::json(json), &linuxcnc("G98 G84 Z-18 R2 F500")).unwrap();
    assert!(verdict.to_string().contains("the program taps with the cycle for a floating holder"), "{verdict:#?}");
    let angled = siemens("CYCLE84(50,0,2,-18,,0,3,,1,90,500,500)");
    let error = verdict_of("siemens", Job::nc(&angled), &angled).unwrap_err();
    assert!(error.to_string().contains("CYCLE84 with the spindle angle 90 before the thread"), "{error}");
}

/// Compensation that is on only during rapids moves the tool, too. A program has the compensation of its job there.
#[test]
fn the_compensation_of_rapids_is_that_of_the_job() {
    let program = |on: &str| {
        let off = if on.is_empty() { "" } else { "G40 " };
        format!(
            "G90 G21 G17 G94 G54\nT1 M6\nG0 X0 Y0 S500 M3\nG43 H1 Z2.\nG1 Z-1. F100.\nG0 Z2.\n{on}X30. Y20.\nX50.\n\
             {off}X60. Y0.\nG1 Z-1.\nG0 Z50.\nM30\n"
        )
    };
    let sides = ["", "G41 D1 ", "G42 D1 ", "G41 D2 "];
    let texts = ["off", "left D1", "right D1", "left D2"];
    for (job, wanted) in sides.iter().zip(texts) {
        for (new, is) in sides.iter().zip(texts) {
            let verdict = verdict_of("fanuc", Job::nc(&program(job)), &program(new)).unwrap();
            let expected = match job == new {
                true => "identical".to_owned(),
                false => {
                    format!(
                        "different: during the rapids here, the cutter compensation is {is}, but {wanted} in the job"
                    )
                }
            };
            assert_eq!(verdict.to_string(), expected, "{job} {new}");
        }
    }
}

/// A program may begin with a cut, or may cut directly from the machine's Z0. Programs from Fusion's free licence do
/// so. The caller gives the start position.
#[test]
fn a_cut_from_an_unknown_place_begins_where_the_caller_says() {
    let read = |program: &str, start| {
        let checked = check(&plain_post("linuxcnc.pf"));
        let form = compile(&checked.form);
        let mut renderer = Renderer::new(&form, Options::default());
        let settings = RunSettings::new(control("fanuc"));
        let options = JobOptions { start, ..job_options(settings) };
        let mut warnings = Vec::new();
        let read = read_program(Cursor::new(program), &options, &mut warnings, &mut renderer);
        let text = String::from_utf8(std::mem::take(renderer.text())).unwrap();
        read.map(|()| text.lines().map(str::to_owned).collect::<Vec<_>>()).map_err(|error| match error {
            ReadError::Job(diag) => diag.message,
            other => panic!("{other:?}"),
        })
    };
    let program =
        "G21 G17 G90\nG53 G0 Z0\nT1 M6\nG54 S1000 M3\nG43 H1\nG1 X10. Y5. F500.\nX20.\nZ0 F50.\nX30.\nG0 Z5.\nM30\n";
    let refused = read(program, None).unwrap_err();
    assert_eq!(refused, "a cut begins at an unknown machine position");
    let lines = read(program, Some([0.0, 0.0, 40.0])).unwrap();
    let from = lines.iter().position(|line| line.contains("X0 Y0")).unwrap_or_else(|| panic!("{lines:?}"));
    let cuts: Vec<&str> =
        lines[from..].iter().map(String::as_str).filter(|line| line.contains('X') || line.contains('Z')).collect();
    // the caller's height applies until the program sets one
    assert_eq!(cuts[..6], ["G0 G54 X0 Y0", "Z40. M9", "G1 X10. Y5. F500.", "X20.", "Z0 F50.", "X30."], "{lines:?}");
}

/// G52 or G92 may shift the frame between two moves. postform converts the positions, so all positions of the job are
/// in the frame of the first move.
#[test]
fn frames_that_move_between_moves_are_followed() {
    let lines = path(
        "G1 Z-.1 F5.\nG52 X2. Z-1.\nG1 X1.\nG2 X3. I1. J0\nG0 Z2.\nG81 X4. Z.5 R1.1 F6.\nG80\nG52 X0 Z0\nG0 Z2.\nX1.",
    );
    let followed =
        ["G1 Z-.1 F5.", "X3.", "G17 G2 X5. I1. J0", "G0 Z1.", "G98 G81 X6. Y0 Z-.5 R.1 F6.", "G80", "G0 Z2.", "X1."];
    assert_eq!(lines, followed);
    assert_eq!(path("G1 Z-.1 F5.\nG92 X5.\nG1 X6.\nG92 X0\nG1 X2."), ["G1 Z-.1 F5.", "X1.", "X3."]);
}

/// The comment after the O number becomes the name of the program.
#[test]
fn the_comment_of_the_number_is_the_name() {
    let form = mill("", "").replacen("%0\n", "%0\n(NAME [progname])\n", 1);
    for (head, name) in [("O1 (BRACKET)\n", "(NAME BRACKET)"), ("%\nO0001(BRACKET)\n", "(NAME BRACKET)")] {
        let (text, _) = printed_by(&form, &format!("{head}{HEAD}G1 Z-.1 F5.\nM30\n")).unwrap();
        assert!(text.lines().any(|line| line == name), "{head}{text}");
    }
    let (text, _) = printed_by(&form, &format!("O1\n{HEAD}G1 Z-.1 F5.\nM30\n")).unwrap();
    assert!(!text.contains("NAME"), "{text}");
}
