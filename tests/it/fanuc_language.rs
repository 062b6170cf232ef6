//! What Fanuc and Haas controls read otherwise than LinuxCNC: macros, numbers without a point, calls, M codes, text.

use crate::support::control;
use crate::support::folder::{Folder, err};
use postform::internals::nc::{Action, Item, RunError, RunSettings, Simulator, Unpointed};
use std::io::Cursor;

/// The moves, dwells and starts of the spindle of a whole program, or the code and message of its refusal.
fn steps(settings: RunSettings, program: &str) -> Result<Vec<String>, String> {
    let mut simulator = Simulator::new(Cursor::new(program.as_bytes()), settings);
    let (mut items, mut more) = (Vec::new(), true);
    while more {
        more = simulator.step(&mut items).map_err(|why| match why {
            RunError::Refused(diag, _) => format!("{} {}", diag.code.name(), diag.message),
            RunError::Io(why) => why.to_string(),
        })?;
    }
    let round = |value: f64| (value * 1e4).round() / 1e4 + 0.0;
    let shown = |item: &Item| match &item.action {
        Action::Rapid { to, .. } | Action::Feed { to, .. } => {
            Some(format!("{} {} {}", round(to[0]), round(to[1]), round(to[2])))
        }
        Action::Dwell(seconds) => Some(format!("dwell {seconds}")),
        Action::Spindle(rotation, _) => Some(rotation.name().to_owned()),
        _ => None,
    };
    Ok(items.iter().filter_map(shown).collect())
}

/// The steps of these blocks.
fn run_with(settings: RunSettings, blocks: &str) -> Result<Vec<String>, String> {
    let program = format!("G21 G17 G90 G94\nS500 M3\nG0 X0. Y0. Z0.\n{blocks}\nM30\n");
    Ok(steps(settings, &program)?.split_off(2))
}

fn run(name: &str, blocks: &str) -> Result<Vec<String>, String> {
    run_with(RunSettings::new(control(name)), blocks)
}

/// The X to which a program moves with this value.
fn x(name: &str, assignments: &str, value: &str) -> Result<String, String> {
    let moves = run(name, &format!("{assignments}\nX{value}"))?;
    Ok(moves.last().and_then(|at| at.split(' ').next()).unwrap_or_default().to_owned())
}

#[test]
fn expressions_have_the_values_of_their_control() {
    for (name, assignments, value, result) in [
        // in a word, ROUND rounds to the least increment of the word
        ("fanuc", "", "[ROUND[9.4]]", "9.4"),
        ("haas", "", "[ROUND[1.00333]+ROUND[1.00333]]", "2.006"),
        ("fanuc", "#1=ROUND[9.4]", "#1", "9"),
        ("linuxcnc", "", "[ROUND[9.4]]", "9"),
        // the operators of bits
        ("fanuc", "#1=1\n#2=2\n#3=#1 OR #2", "#3", "3"),
        ("haas", "#3=6AND3", "#3", "2"),
        ("fanuc", "", "[6 XOR 3]", "5"),
        ("linuxcnc", "", "[1 OR 2]", "1"),
        // towards 0, and away from 0
        ("fanuc", "#1=FIX[-2.5]", "#1", "-2"),
        ("fanuc", "#1=FUP[-2.1]", "#1", "-3"),
        ("haas", "#1=FIX[3.54]", "#1", "3"),
        ("linuxcnc", "", "[FIX[-2.5]]", "-3"),
        ("haas", "#1=27 MOD 20", "#1", "7"),
        ("haas", "", "[1.0 LT 5.0]", "1"),
        // an expression after = needs no brackets
        ("fanuc", "#101=1.\n#101=#101+20.", "#101", "21"),
        ("haas", "#1=2\n#2=#1*3-SQRT[16]/2", "#2", "4"),
        ("fanuc", "#1=ATAN[1]/[1]", "#1", "45"),
        ("haas", "#1=ATAN[1]", "#1", "45"),
        ("fanuc", "#1=5.\n#2=1", "#[#2]", "5"),
    ] {
        assert_eq!(x(name, assignments, value).as_deref(), Ok(result), "{name} {assignments} X{value}");
    }
}

#[test]
fn expressions_that_a_control_may_read_otherwise_are_refused() {
    for (name, blocks, why) in [
        ("fanuc", "X[2**3]", "or an operator"),
        ("fanuc", "X[2 GT 1]", "or an operator"),
        ("fanuc", "X#<a>", "the number of a parameter"),
        ("fanuc", "#2=1\nX##2", "the number of a parameter"),
        ("fanuc", "X--9.", "a value"),
        ("fanuc", "#1=5 X#1", ""),
        ("fanuc", "#1=5 #2=6", "an assignment beside other words"),
        ("haas", "#1=5 G1", "an assignment beside other words"),
        ("fanuc", "#1=1 OR 2 + 3", "which one is first is not public"),
        ("haas", "X[1 + 2 AND 3]", "which one is first is not public"),
        ("fanuc", "#1=1.5 OR 2", "known only for whole numbers"),
        ("fanuc", "#1=-7 MOD 3", "known only for whole numbers"),
        ("fanuc", "#1=ATAN[-1]/[1]", "a parameter of the control decides"),
        ("fanuc", "#1=ASIN[-.5]", "a parameter of the control decides"),
        ("fanuc", "#1=ATAN[1]", "without its second value"),
        ("haas", "#1=ATAN[1]/[2]", "this may be a division"),
        ("haas", "#1=FUP[1.5]", "there is no function FUP"),
        ("fanuc", "G1 X1. F[ROUND[9.4]]", "whose least increment is not public"),
    ] {
        let said = run(name, blocks).expect_err(blocks);
        assert!(said.contains(why), "{name} {blocks}: {said}");
    }
}

#[test]
fn a_feed_without_a_point_depends_on_the_control() {
    for (name, blocks, is_refused) in [
        ("haas", "G1 X1. F24", true),
        ("haas", "G1 X1. F24.", false),
        ("haas", "G81 Z-1. R1. F24", true),
        ("fanuc", "G1 X1. F24", false),
        ("fanuc", "G20\nG1 X1. F24", true),
        ("fanuc", "G95\nG1 X1. F1", true),
        ("fanuc", "G20\nG1 X1. F24.", false),
        ("linuxcnc", "G20\nG1 X1. F24", false),
    ] {
        let said = run(name, blocks);
        assert_eq!(said.as_ref().is_err_and(|why| why.contains("PN017")), is_refused, "{name} {blocks}: {said:?}");
    }
    let settings = |name, unpointed| RunSettings { unpointed, ..RunSettings::new(control(name)) };
    assert!(run_with(settings("haas", Unpointed::Whole), "G1 X1. F24").is_ok());
    let said = run_with(settings("fanuc", Unpointed::Increments), "G20\nG1 X1. F24").unwrap_err();
    assert!(said.contains("the increment of this feed is not public"), "{said}");
    // the increment of a time is 0.001 seconds, also with inches
    let dwell = run_with(settings("fanuc", Unpointed::Increments), "G20\nG4 X1500").unwrap();
    assert_eq!(dwell, ["dwell 1.5"]);
}

/// P of a dwell on a Fanuc has no decimal point.
#[test]
fn a_dwell_with_a_point_is_refused_where_p_is_milliseconds() {
    assert_eq!(run("fanuc", "G4 P500").unwrap(), ["dwell 0.5"]);
    assert_eq!(run("haas", "G4 P.5").unwrap(), ["dwell 0.5"]);
    for blocks in ["G4 P.5", "G82 Z-1. R1. P.5 F9."] {
        let said = run("fanuc", blocks).unwrap_err();
        assert!(said.contains("P0.5 with a decimal point"), "{blocks}: {said}");
    }
}

#[test]
fn calls_are_those_of_the_control() {
    let subs = "M30\nO123\nG91 X1.\nG90\nM99\nO50123\nG91 Y1.\nG90\nM99";
    assert_eq!(run("fanuc", &format!("M98 P50123\n{subs}")).unwrap().last().unwrap(), "5 0 0");
    assert_eq!(run("haas", &format!("M98 P50123\n{subs}")).unwrap().last().unwrap(), "0 1 0");
    assert_eq!(run("haas", &format!("M98 P123 L2\n{subs}")).unwrap().last().unwrap(), "2 0 0");
    assert_eq!(run("mitsubishi", &format!("M98 P50123\n{subs}")).unwrap().last().unwrap(), "0 1 0");
    assert_eq!(run("linuxcnc", "M98 P50123\nM2\nO50123\nG91 Y1.\nG90\nM99").unwrap().last().unwrap(), "0 1 0");
    for (name, blocks, why) in [
        ("mazak", "M98 P50123", "P50123 may be a program, or a program and its number of calls"),
        ("brother", "M98 P50123", "P50123 may be a program, or a program and its number of calls"),
        ("mitsubishi", "M98 P123 H20", "M98 with H: on some controls, H is the block at which"),
        ("fanuc", "M98 P123 L3\nM30\nO123\nG91 X1.\nG90\nM99 L1", "M99 L"),
        ("fanuc", "M98 P123\nM30\nO123\nX1.\nM99\nO123\nX2.\nM99", "has the number of an earlier program"),
    ] {
        let said = run(name, blocks).unwrap_err();
        assert!(said.contains(why), "{blocks}: {said}");
    }
}

/// Words and codes of a wire EDM machine that the comparison of X Y U V does not contain are refused.
#[test]
fn a_wire_has_two_guides_and_no_other_words() {
    let run =
        |block: &str| steps(RunSettings::new(control("fanuc-wire")), &format!("G21 G90\nG0 X0. Y0.\n{block}\nM2\n"));
    assert_eq!(run("G1 X7. U6. F2.\nG50\nX8.").unwrap(), ["0 0 0", "7 0 6", "8 0 6"]);
    for word in ["T2", "A3.", "Z5.", "C90.", "W1.", "H1"] {
        let said = run(&format!("G1 X7. F2. {word}")).expect_err(word);
        assert!(said.contains(&format!("the word {} is not simulated for fanuc-wire", &word[..1])), "{word}: {said}");
    }
    // a mill has other codes of these numbers: scaling and a local frame
    for code in ["G51 T2", "G52 T2", "G52 X7."] {
        let said = run(code).expect_err(code);
        assert!(said.contains("tapers by G51 and G52 are not simulated"), "{code}: {said}");
    }
}

/// Codes of a Haas that another meaning in the Fanuc file must not stand for.
#[test]
fn m_codes_of_a_haas_are_those_of_its_manual() {
    for (name, blocks, why) in [
        ("haas", "M14", "M14 is unknown"),
        ("haas", "M50", "M50 changes the pallet"),
        ("haas", "M60", "M60 is unknown"),
        ("haas", "M96 P300 Q8", "M96 jumps"),
        ("haas", "M109 P501", "M109 waits"),
        ("haas", "M82", "M82 releases"),
        ("haas", "G8 P1", "G8 is not a code"),
        ("haas", "G5.1 Q1", "G5.1 is not a code"),
        ("haas", "G22", "G22 is not a code"),
        ("haas", "G62", "G62 is not a code"),
        ("fanuc", "G103 P1", "G103 is not a code"),
        ("fanuc", "G187 P3", "G187 is not a code"),
        ("fanuc", "G154 P1", "G154 is not a code"),
    ] {
        let said = run(name, blocks).expect_err(blocks);
        assert!(said.contains(why), "{name} {blocks}: {said}");
    }
    for (block, why) in [("M96 P300 Q8", "M96 jumps"), ("M133 P500", "driven tools")] {
        let said = steps(RunSettings::new(control("haas-lathe")), &format!("{block}\nM30\n")).expect_err(block);
        assert!(said.contains(why), "{block}: {said}");
    }
    // M13 releases a brake on a mill, and stops the air jet on a lathe; M16 changes the tool
    for (name, block) in [("haas", "M13"), ("haas-lathe", "M13"), ("haas-lathe", "M14"), ("haas", "T1 M16")] {
        let program = format!("G21\n{block}\nM30\n");
        let steps = steps(RunSettings::new(control(name)), &program);
        assert_eq!(steps, Ok(Vec::new()), "{name} {block}");
    }
}

#[test]
fn text_that_the_control_reads_otherwise_is_refused() {
    for (name, block, is_refused) in [
        ("fanuc", "X9.;Y80.", true),
        ("haas", "X9. ; Y80.", true),
        ("fanuc", "X9.;", false),
        ("fanuc", "X9. ; (to the side)", false),
        ("fanuc", "X9. ; to the side", false),
        ("linuxcnc", "X9. ; Y80.", false),
        ("centroid", "X9. ; Y80.", false),
        ("fanuc", "x9.", true),
        ("linuxcnc", "x9.", false),
    ] {
        let said = run(name, block);
        assert_eq!(said.is_err(), is_refused, "{name} {block}: {said:?}");
        assert!(said.is_err() || said.as_ref().unwrap().last().unwrap() == "9 0 0", "{name} {block}: {said:?}");
    }
}

/// The angle of M19 is compared, and a word that may be an angle is not ignored.
#[test]
fn the_angle_of_the_spindle_is_in_the_words_of_the_control() {
    let folder = Folder::new("fanuc-orient");
    let program = |word: &str| {
        format!("G21 G17 G90 G94\nT1 M6\nG54 G0 X0. Y0.\nG43 H1 Z5.\nM19 {word}\nG1 Z-1. F10.\nG0 Z5.\nM30\n")
    };
    let compared = |control: &str, word: &str, other: &str| {
        folder.write("a.nc", program(word));
        folder.write("b.nc", program(other));
        err(&folder.run(&["diff", "--motion", "--control", control, "a.nc", "b.nc"]))
    };
    assert!(compared("haas", "P270", "R270.").contains("identical"));
    assert!(compared("haas", "P270", "P90").contains("different"));
    assert!(compared("fanuc", "R90.", "R180.").contains("different"));
    for word in ["P180", "S180"] {
        let said = compared("fanuc", word, word);
        assert!(said.contains("not proven"), "{word}: {said}");
    }
}

/// The value that a subprogram of LinuxCNC returns, as its interpreter gives it.
#[test]
fn a_subprogram_returns_its_value() {
    let blocks = "o1 sub\no1 return [7]\no1 endsub\no2 sub\no2 endsub\no3 sub\no3 endsub [#1*2]\n\
                  X#<_value> Y#<_value_returned>\no1 call\nX#<_value> Y#<_value_returned>\no2 call\n\
                  X#<_value> Y#<_value_returned>\no3 call [4]\nX#<_value> Y#<_value_returned>";
    assert_eq!(run("linuxcnc", blocks).unwrap(), ["0 0 0", "7 1 0", "0 0 0", "8 1 0"]);
}

/// Controls may skip a whole block with a slash inside, or only the words after the slash.
#[test]
fn a_slash_inside_a_block_is_refused() {
    let folder = Folder::new("slash-inside");
    folder.write("a.nc", "O1\nG21 G90 G17 G40 G49 G80\nN20 /M8\nM30\n");
    for control in ["fanuc", "haas", "mazak", "linuxcnc"] {
        let said = err(&folder.run(&["simulate", "a.nc", "--control", control]));
        assert!(said.contains("PN016") && said.contains("write the `/` first in the block"), "{control}: {said}");
    }
}

/// The note on blocks with a slash: a verdict is for one position of the switch.
#[test]
fn blocks_with_a_slash_are_noted() {
    let folder = Folder::new("fanuc-slash");
    let program = |slash: &str| {
        format!(
            "G21 G17 G90 G94\nT1 M6\nG54 G0 X0. Y0. S900 M3\nG43 H1 Z5.\nG1 Z-1. F10.\n{slash}X9.\nY9.\nG0 Z5.\nM30\n"
        )
    };
    folder.write("a.nc", program(""));
    folder.write("b.nc", program("/"));
    let motion = folder.run(&["diff", "--motion", "--control", "fanuc", "a.nc", "b.nc"]);
    assert!(err(&motion).contains("blocks with a slash are run"), "{}", err(&motion));
    let verify = ["verify", "a.nc", "--job-control", "fanuc", "--nc", "b.nc", "--control", "fanuc"];
    let said = err(&folder.run(&verify));
    assert!(said.contains("PN038") && said.contains("blocks with a slash are run") && said.contains("/X9."), "{said}");
    let said = err(&folder.run(&[&verify[..], &["--block-delete"]].concat()));
    assert!(said.contains("blocks with a slash are skipped"), "{said}");
    folder.write("b.nc", program(""));
    assert!(!err(&folder.run(&verify)).contains("slash"));
}
