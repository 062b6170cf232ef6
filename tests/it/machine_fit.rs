//! Checks of programs on machines: travels, fixtures, feeds, tools; and errors in machine files.

use std::fmt::Write as _;
use std::io::Cursor;

use crate::support::control;
use crate::support::folder::{Folder, err, out};
use postform::internals::machine::{Machine, read};
use postform::internals::nc::{RunSettings, Unpointed};
use postform::internals::preflight::{Fitted, Known, preflight};
use proptest::prelude::*;

const VF2: &str = "name = \"VF-2\"\ncontrol = \"haas\"\n[axes.X]\ntravel = [-762, 0]\nfeed = 16500\n[axes.Y]\ntravel = [-406, 0]\n[axes.Z]\ntravel = [-508, 0]\n";
const KNOWN: &str = "[tools.5]\nlength = 120\ndiameter = 10\n[offsets]\nG54 = [-400, -200, -380]\n";
const HEAD: &str = "G21 G90 G94 G17\nT5 M6\nG54 G0 X0 Y0 S1000 M3\nG43 H5 Z50.\n";

fn machine(text: &str) -> Machine {
    read("vf2.toml", text, &|name| Err(format!("no {name}"))).unwrap_or_else(|wrong| panic!("{wrong}\n{text}"))
}

fn fitted(program: &str, machine: &Machine) -> Fitted {
    let mut settings = RunSettings::new(machine.control.unwrap_or_else(|| control("haas")));
    settings.unpointed = Unpointed::Whole;
    preflight(Cursor::new(program), settings, machine, &Known::default()).unwrap()
}

/// The findings: code, line, message.
fn found(program: &str, file: &str) -> Vec<String> {
    let findings = fitted(program, &machine(file)).findings;
    findings.iter().map(|found| format!("{} {} {}", found.code.name(), found.line, found.message)).collect()
}

#[track_caller]
fn finds(program: &str, more: &str, expected: &[&str]) {
    let found = found(&format!("{HEAD}{program}\nM30\n"), &format!("{VF2}{KNOWN}{more}"));
    assert_eq!(found.len(), expected.len(), "{program}: {found:#?}");
    for (found, part) in found.iter().zip(expected) {
        assert!(found.contains(part), "{program}: {found} has no {part}");
    }
}

/// An axis without a position in the block continues from its current position, regardless of the offsets that were
/// active when it moved there. Each case was found by comparison with LinuxCNC's interpreter. The expected positions
/// are those of the interpreter.
#[test]
fn what_a_block_does_not_say_stays_or_moves_on() {
    let file = "control = \"linuxcnc\"\n[axes.X]\ntravel = [-1000, 1000]\n[axes.Y]\ntravel = [-1000, 1000]\n[axes.Z]\ntravel = [-1000, 1000]\n[axes.A]\ntravel = [10, 100]\n[reference]\nG28 = [-1, -2, -3]\n[offsets]\nG54 = [-100, -100, -100]\nG55 = [-200, -200, -200]\n[tools]\nfile = \"tool.tbl\"\n";
    let table = "T1 Z10\nT2 Z50\nT3 Z66.5 Y-14.5\n";
    let machine = read("m.toml", file, &|_| Ok(table.to_owned())).unwrap_or_else(|wrong| panic!("{wrong}"));
    // the blocks, an axis, and the last reported extent of this axis (from, to)
    let cases = [
        ("G55\nG91 G0 X5", 'X', [-99.0, -94.0]),
        ("F100 G55\nG91 G2 X5 Y0 I2.5 J0", 'X', [-99.0, -94.0]),
        ("G43 H1\nG0 X5", 'Z', [-97.0, -97.0]),
        ("G43 H1\nG0 Z5\nG49\nG91 G0 Z2", 'Z', [-85.0, -83.0]),
        ("G91 G0 Z2\nG43 H1", 'Z', [-97.0, -95.0]),
        ("G43 H3\nG0 X1 Y1 Z1", 'Y', [-113.5, -98.0]),
        ("G10 L20 P2 X5\nG55\nG0 X1", 'X', [-103.0, -103.0]),
        ("G10 L2 P1 R30\nG10 L20 P1 X5 Y7\nG0 X1 Y1 Z1", 'Y', [-105.196, -98.0]),
    ];
    for (blocks, axis, [from, to]) in cases {
        let program = format!("G21 G90 G17 G94 G54\nG0 X1 Y2 Z3\n{blocks}\nM2\n");
        let fitted = fitted(&program, &machine);
        assert!(fitted.findings.is_empty(), "{blocks}: {:?}", fitted.findings);
        let json = fitted.fit.json(&machine, control("linuxcnc"));
        let rows = json["extents"].as_array().unwrap();
        let row = rows.iter().rev().find(|row| row["axis"] == axis.to_string()).unwrap();
        let near = |value: &serde_json::Value, own: f64| (value.as_f64().unwrap() - own).abs() < 1e-3;
        assert!(near(&row["from"], from) && near(&row["to"], to), "{blocks}: {row}");
    }
    let far = fitted("G21 G90 G54\nG0 X1 Y2 Z3\nG53 G0 X-20 Y-20 Z-20\nG91 G0 X2000\nM2\n", &machine);
    assert!(far.findings[0].message.contains("needs X1980"), "{:?}", far.findings);
    for blocks in ["T1 M6\nG91 G0 Z2", "G43 H1\nG43.2 H2\nG0 Z1\nG91 Z1"] {
        let fitted = fitted(&format!("G21 G90 G54\nG0 X1 Y2 Z3\n{blocks}\nM2\n"), &machine);
        let said = fitted.fit.not_checked.join("; ");
        assert!(said.contains("increments from an unknown machine position"), "{blocks}: {said}");
    }
    // a helix in G19 with a rotated frame: the machine's X has its minimum inside the helix, at -6.3332 inch in
    // LinuxCNC
    let inch = "control = \"linuxcnc\"\nunits = \"inch\"\n[axes.X]\ntravel = [-100, 100]\n[offsets]\nG55 = [-4.12, -8.782, -3.94]\n";
    let program = "G20 G90 G94 F9\nG10 L2 P2 R45\nG55 G0 X0 Y0 Z0\nG19\nG1 Y-0.23 Z-0.8892 X-1.5596\nG3 Y-0.3534165 Z-0.1860424 X-1.5196 J0.8381818 K0.5095253\nM2\n";
    let turned = fitted(program, &read("m.toml", inch, &|_| Err(String::new())).unwrap());
    let json = turned.fit.json(&read("m.toml", inch, &|_| Err(String::new())).unwrap(), control("linuxcnc"));
    let least = json["extents"].as_array().unwrap().iter().find(|row| row["axis"] == "X").unwrap()["from"].as_f64();
    assert!((least.unwrap() + 6.3332).abs() < 1e-3, "{json}");
}

#[test]
fn an_axis_ends() {
    finds("G1 Z-10 F100", "", &[]);
    // -380 + 120 + z >= -508
    finds("G1 Z-248 F100", "", &[]);
    finds(
        "G1 Z-250.5 F100",
        "",
        &["PM001 5 T5 needs Z-510.5 in machine coordinates, but the travel ends at Z-508: 2.5 mm too short; it \
             fits with a tool 2.5 longer, or with G54 Z 2.5 higher"],
    );
    finds(
        "X400.\nX401.\nX405.",
        "",
        &["PM001 7 T5 needs X5 in machine coordinates, but the travel ends at X0: 5 mm too short; it fits with G54 \
             X 5 lower; beyond the travel from line 6 on"],
    );
    // the middle of an arc from Y-20 to Y20, with the centre X390 Y0 and the radius 20
    finds("X390 Y-20 Z1\nG1 Z-1 F100\nG3 X390 Y20 J20", "", &["PM001 7 T5 needs X10 "]);
    finds("X370 Y0 Z1\nG1 Z-1 F100\nG3 X370 Y0 I10", "", &[]);
    // a cycle and its return height
    finds("G98 G81 X1 Y1 Z-251 R2 F100\nG80", "", &["PM001 5 T5 needs Z-511 "]);
    // machine coordinates do not contain the work offset and the tool length
    finds("G53 G0 Z0\nG53 X-762 Y-406", "", &[]);
    finds("G53 G0 Z0\nG53 X-763", "", &["PM001 6 T5 needs X-763 "]);
    finds("G53 G0 Z10", "", &["PM001 5 T5 needs Z10 "]);
    // the intermediate position of G28, and the reference point itself
    finds("G28 Z300", "[reference]\nG28 = [0, 0, -10]\n", &["PM001 5 T5 needs Z40 "]);
    finds("G91 G28 Z0\nG90", "[reference]\nG28 = [0, 0, -10]\n", &[]);
    // a shift of the frame, and a cancelled tool length
    finds("G52 X300.\nG0 X150", "", &["PM001 6 T5 needs X50 "]);
    finds("G49\nG0 Z-128\nZ-129", "", &["PM001 7 T5 needs Z-509 "]);
    finds("G44 H5 Z0", "", &[]);
    finds("G44 H5 Z-10", "", &["PM001 5 T5 needs Z-510 "]);
}

#[test]
fn what_is_not_known_is_an_interval() {
    let sentences = |program: &str, more: &str| {
        let machine = machine(&format!("{VF2}{more}"));
        let fitted = fitted(&format!("{HEAD}{program}\nM30\n"), &machine);
        let codes: Vec<&str> = fitted.findings.iter().map(|found| found.code.name()).collect();
        (fitted.fit.sentences(&machine, control("haas")).join("\n"), codes.join(" "))
    };
    let (all, codes) = sentences("G1 X100 Y-20 Z-30 F100", "");
    assert_eq!(
        all,
        "this program fits if G54 X lies between -762 and -100\n\
         this program fits if G54 Y lies between -386 and 0\n\
         this program fits if G54 Z and the length H5 together lie between -478 and -50"
    );
    assert_eq!(codes, "");
    let (all, codes) = sentences("", "[tools.5]\nlength = 100\n[offsets]\nG55 = [0, 0, 0]\n");
    assert!(all.contains("this program fits if G54 Z lies between -658 and -150"), "{all}");
    assert_eq!(codes, "PM015");
    let (all, codes) = sentences("", "[tools.6]\nlength = 100\n[offsets]\nG54 = [-400, -200, -380]\n");
    assert_eq!(all, "this program fits if the length H5 lies between -178 and 330");
    assert_eq!(codes, "PM011");
    // the path is longer than the travel, so no work offset would fit
    let (all, codes) = sentences("X800", "");
    assert!(codes == "PM001" && !all.contains("G54 X"), "{codes}\n{all}");
    // the program sets its own work offset
    let (all, codes) = sentences("G10 L2 P1 X-400. Y-200. Z-380.\nG54 X10 Y10 Z10", "[tools.5]\nlength = 100\n");
    assert_eq!((all.lines().count(), codes.as_str()), (3, ""), "{all}");
}

#[test]
fn a_rapid_goes_through_a_clamp() {
    let clamp = "[[fixtures]]\nname = \"the clamp\"\nwork = \"G54\"\nbox = [[20, -10, -40], [40, 10, 15]]\n";
    finds("X60", clamp, &[]);
    finds("Z10\nX60", clamp, &["PM002 6 T5 goes through the clamp at rapid"]);
    finds("Y16 Z10\nX60", clamp, &[]);
    finds("Y14.9 Z10\nX60", clamp, &["PM002 6"]);
    finds("Z10\nG1 X60 F100", clamp, &[]);
    // a rapid in another work offset; the values of both offsets are known
    let other = format!("G55 = [-380, -200, -380]\n{clamp}");
    finds("G55\nX-20 Y0 Z10\nX40", &other, &["PM002 7"]);
    // down onto the clamp in machine coordinates, with the tool's length
    finds("G53 G0 Z0\nX30\nG53 Z-250\n", clamp, &["PM002 7"]);
}

#[test]
fn feeds_speeds_tools_coolant_and_memory() {
    finds("G1 X10 F17000", "", &["PM010 5 X would feed at 17000 mm/min, but its maximum is 16500"]);
    finds("G1 X10 Y10 F17000", "", &[]);
    finds(
        "S9000 M3",
        "[spindle]\nspeed = [30, 8100]\n",
        &["PM010 5 the spindle's speed is S9000, but the range of the machine is 30 to 8100"],
    );
    finds(
        "M8\nM7",
        "[coolant]\nkinds = [\"flood\"]\n",
        &["PM013 6 the program turns on the coolant `mist`, but the machine's file lists only flood"],
    );
    let tools = format!("{VF2}[tools]\nplaces = 1\n");
    let program = "O12345\nT1 M6\nT2 M6\nM30\n";
    assert_eq!(found(program, &tools), ["PM012 3 the program uses more tools than the magazine has places: 1"]);
    let memory = format!("{VF2}[memory]\nbytes = 10\nnumbers = [1, 9999]\n");
    let both = found(program, &memory);
    assert!(both[0].contains("23 bytes") && both[1].contains("12345"), "{both:?}");
}

#[test]
fn a_wrong_file_is_named_by_line_and_column() {
    let table = [
        ("[axes.X]\ntravel = [0, -762]\n", 2, "goes from 0 to -762"),
        ("[axes.X]\ntravel = [0]\n", 2, "two numbers"),
        ("[axes.X]\ntravel = \"endless\"\n", 2, "two numbers"),
        ("[axes.W]\ntravel = [0, 1]\n", 1, "not an axis"),
        ("[axes.X]\nfeed = 0\n", 2, "above 0"),
        ("[axes.X]\nfeed = nan\n", 2, "above 0"),
        ("[axes.X]\ntravle = [0, 1]\n", 2, "unknown field"),
        ("control = \"hass\"\n", 1, "no control `hass`"),
        ("[offsets]\nG99 = [0, 0, 0]\n", 2, "not a work offset"),
        ("[offsets]\nG54 = []\n", 2, "six numbers"),
        ("[tools]\nplaces = -1\n", 2, "places"),
        ("[tools]\nfile = \"t.csv\"\n", 2, "no t.csv"),
        ("[tools.5]\nlenght = 3\n", 1, "unknown field"),
        ("[tools.x]\nlength = 3\n", 1, "no key `x`"),
        ("[spindle]\nspeed = [8100, 30]\n", 2, "ascending order"),
        ("[axes.Z]\ntravel = [-500, 0]\n[reference]\nG28 = [0, 0, 5]\n", 4, "G28 goes to Z5"),
        ("[coolant]\nkinds = [\"oil\"]\n", 2, "unknown variant"),
        ("[[fixtures]]\nwork = \"G54\"\nbox = [[0, 0, 0], [0, 1, 1]]\n", 3, "larger than the first"),
        ("x", 1, ""),
        ("\u{0}", 1, ""),
    ];
    for (text, line, part) in table {
        let wrong = read("vf2.toml", text, &|name| Err(format!("no {name}"))).unwrap_err();
        assert!(wrong.at.0 == line && wrong.message.contains(part), "{text}: {wrong}");
    }
    assert!(read("vf2.toml", "", &|_| Err(String::new())).is_ok(), "a file may say nothing");
}

/// If a program does not fit into the machine, the commands do not print the program. The message explains what can be
/// done.
#[test]
fn a_program_that_does_not_fit_is_not_printed() {
    let folder = Folder::new("machine-fit");
    let path = "{\"rapid\":[0,0,2]},{\"line\":[40,0,-1]},{\"rapid\":[null,null,2]}";
    folder.write("job.json", crate::verify::inches("1", path));
    let form = crate::support::plain_post("haas.pf");
    folder.write("form.pf", form.replacen("Control haas", "Control haas\nMachineFile vf2.toml", 1));
    folder.write("vf2.toml", "units = \"inch\"\n[axes.X]\ntravel = [-30, 0]\n[offsets]\nG54 = [-15, 0, 0]\n");
    let render = ["render", "job.json", "--form", "form.pf", "-o", "a.nc"];
    let stopped = folder.run(&render);
    assert_eq!(stopped.status.code(), Some(1), "{}", err(&stopped));
    assert!(err(&stopped).contains("PM001") && err(&stopped).contains("25 inch too short"), "{}", err(&stopped));
    assert!(err(&stopped).contains("operations[0].path[1]"), "{}", err(&stopped));
    assert!(!folder.has("a.nc"));
    let all_the_same = folder.run(&[&render[..], &["--no-verify"]].concat());
    assert_eq!(all_the_same.status.code(), Some(0), "{}", err(&all_the_same));
    let verify = folder.run(&["verify", "job.json", "--form", "form.pf", "--format", "json"]);
    assert_eq!(verify.status.code(), Some(1));
    let document: serde_json::Value = serde_json::from_str(&out(&verify)).unwrap();
    assert_eq!(document["machine"]["findings"][0]["code"], "PM001");
    assert_eq!(document["verdict"], "identical");
    // the option `--machine` overrides the machine of the form
    folder.write("long.toml", "units = \"inch\"\n[axes.X]\ntravel = [-30, 30]\n[offsets]\nG54 = [-15, 0, 0]\n");
    let printed = folder.run(&[&render[..], &["--machine", "long.toml"]].concat());
    assert_eq!(printed.status.code(), Some(0), "{}", err(&printed));
    let fit = folder.run(&["fit", "a.nc", "--machine", "vf2.toml", "--control", "haas"]);
    assert_eq!(fit.status.code(), Some(1));
    assert!(out(&fit).ends_with("a.nc does not fit into vf2.toml: 1 error\n"), "{}", out(&fit));
    assert_eq!(folder.run(&["simulate", "a.nc", "--control", "haas", "--machine", "vf2.toml"]).status.code(), Some(1));
    // an error in the machine's file is reported at its line, and the form can't print
    folder.write("vf2.toml", "[axes.X]\ntravel = [0, -30]\n");
    let wrong = folder.run(&render);
    assert!(wrong.status.code() == Some(1) && err(&wrong).contains("PF021"), "{}", err(&wrong));
    let gone = folder.run(&["fit", "a.nc", "--machine", "none.toml"]);
    assert!(gone.status.code() == Some(2) && err(&gone).contains("none.toml"), "{}", err(&gone));
}

/// A move of a random program: its kind and its target.
#[derive(Clone, Debug)]
enum Step {
    Rapid([f64; 3]),
    Feed([f64; 3]),
    /// An arc about a centre next to the tool, by an angle.
    Arc([f64; 2], f64, bool),
    Work(usize),
    Length(Option<usize>),
    Machine([f64; 3]),
    Shift([f64; 2]),
}

fn step() -> impl Strategy<Value = Step> {
    let at = || prop::array::uniform3(-300i32..300).prop_map(|at| at.map(f64::from));
    prop_oneof![
        3 => at().prop_map(Step::Rapid),
        3 => at().prop_map(Step::Feed),
        3 => ((-80i32..80), (-80i32..80), 1i32..360, any::<bool>())
            .prop_filter("a radius", |(x, y, ..)| *x != 0 || *y != 0)
            .prop_map(|(x, y, angle, left)| Step::Arc([x.into(), y.into()], angle.into(), left)),
        1 => (0..3usize).prop_map(Step::Work),
        1 => prop::option::of(0..3usize).prop_map(Step::Length),
        1 => at().prop_map(|at| Step::Machine(at.map(|value| value * 1.5))),
        1 => prop::array::uniform2(-40i32..40).prop_map(|by| Step::Shift(by.map(f64::from))),
    ]
}

/// Least and greatest machine position of each axis, computed by the test itself: arcs are divided into many small
/// steps.
struct Reach {
    program: String,
    reached: [[f64; 2]; 3],
}

const OFFSETS: [[f64; 3]; 3] = [[-400.0, -200.0, -150.0], [-100.5, -60.25, -200.0], [30.0, 12.0, 0.0]];
const LENGTHS: [f64; 3] = [40.0, 123.456, 0.5];

fn reach(steps: &[Step]) -> Reach {
    let mut program = String::from("G21 G90 G94 G17\nS1000 M3\nG54\nG0 X0. Y0. Z0. F500\n");
    let (mut work, mut length, mut shift, mut at) = (0usize, None::<usize>, [0.0; 3], [0.0f64; 3]);
    let mut reached = [[f64::INFINITY, f64::NEG_INFINITY]; 3];
    let mut go = |at: [f64; 3], work: usize, length: Option<usize>, shift: [f64; 3]| {
        for axis in 0..3 {
            let tool = if axis == 2 { length.map_or(0.0, |tool| LENGTHS[tool]) } else { 0.0 };
            let value = at[axis] + shift[axis] + OFFSETS[work][axis] + tool;
            reached[axis] = [reached[axis][0].min(value), reached[axis][1].max(value)];
        }
    };
    go(at, work, length, shift);
    for step in steps {
        match step {
            Step::Rapid(to) | Step::Feed(to) => {
                let code = if matches!(step, Step::Rapid(_)) { 0 } else { 1 };
                _ = writeln!(program, "G{code} X{:.3} Y{:.3} Z{:.3}", to[0], to[1], to[2]);
                at = *to;
                go(at, work, length, shift);
            }
            Step::Arc(centre, angle, left) => {
                let from = [-centre[0], -centre[1]];
                let turned = |part: f64| {
                    let turn = (angle * part).to_radians() * if *left { 1.0 } else { -1.0 };
                    let (sin, cos) = turn.sin_cos();
                    [from[0] * cos - from[1] * sin, from[0] * sin + from[1] * cos]
                };
                let begin = at;
                for part in 0..=4000 {
                    let to = turned(f64::from(part) / 4000.0);
                    at = [begin[0] + centre[0] + to[0], begin[1] + centre[1] + to[1], begin[2]];
                    go(at, work, length, shift);
                }
                let code = if *left { 3 } else { 2 };
                _ = writeln!(program, "G{code} X{:.9} Y{:.9} I{:.3} J{:.3}", at[0], at[1], centre[0], centre[1]);
            }
            // after each change of a frame, the next block contains all axes
            Step::Work(number) => {
                work = *number;
                at = [1.0, 2.0, 3.0];
                _ = writeln!(program, "G{}\nG0 X1. Y2. Z3.", 54 + number);
                go(at, work, length, shift);
            }
            Step::Length(tool) => {
                length = *tool;
                at = [1.0, 2.0, 4.0];
                let code = tool.map_or("G49".to_owned(), |tool| format!("G43 H{}", tool + 1));
                _ = writeln!(program, "{code}\nG0 X1. Y2. Z4.");
                go(at, work, length, shift);
            }
            Step::Machine(to) => {
                _ = writeln!(program, "G53 G0 X{:.3} Y{:.3} Z{:.3}", to[0], to[1], to[2]);
                for (axis, value) in to.iter().enumerate() {
                    reached_at(&mut program, axis, *value);
                }
                at = [0.0; 3];
                _ = writeln!(program, "G0 X0. Y0. Z0.");
                go(at, work, length, shift);
            }
            Step::Shift(by) => {
                shift = [by[0], by[1], 0.0];
                at = [5.0, 6.0, 7.0];
                _ = writeln!(program, "G52 X{:.3} Y{:.3}\nG0 X5. Y6. Z7.", by[0], by[1]);
                go(at, work, length, shift);
            }
        }
    }
    for step in steps {
        if let Step::Machine(to) = step {
            for (axis, value) in to.iter().enumerate() {
                reached[axis] = [reached[axis][0].min(*value), reached[axis][1].max(*value)];
            }
        }
    }
    program.push_str("M30\n");
    Reach { program, reached }
}

/// Writes a machine position into a comment, to explain a failing program.
fn reached_at(program: &mut String, axis: usize, value: f64) {
    _ = writeln!(program, "({} {value})", ["X", "Y", "Z"][axis]);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]
    /// The test computes the extents of a program itself. Travels that end at these extents are long enough, slightly
    /// shorter travels are not.
    #[test]
    fn travels_are_judged_as_by_hand(steps in prop::collection::vec(step(), 1..25), which in 0..6usize, over in prop_oneof![Just(0.0), -0.5..0.5f64]) {
        let Reach { program, reached } = reach(&steps);
        let (axis, above) = (which / 2, which % 2 == 1);
        let limits = |over: f64| {
            let mut limits = reached.map(|[least, greatest]| [least - 1.0, greatest + 1.0]);
            let limit = &mut limits[axis][usize::from(above)];
            *limit = reached[axis][usize::from(above)] + if above { -over } else { over };
            limits
        };
        // the difference must be larger than the error of the arc steps, which is below a thousandth
        prop_assume!(over == 0.0 || over.abs() > 0.002);
        let over = if over == 0.0 { 0.002 } else { over };
        let limits = limits(over);
        prop_assume!(limits.iter().all(|[least, greatest]| least < greatest));
        let mut file = String::from("control = \"haas\"\n");
        for (letter, [least, greatest]) in ["X", "Y", "Z"].iter().zip(limits) {
            _ = writeln!(file, "[axes.{letter}]\ntravel = [{least:.9}, {greatest:.9}]");
        }
        for (at, length) in LENGTHS.iter().enumerate() {
            _ = writeln!(file, "[tools.{}]\nlength = {length}", at + 1);
        }
        file.push_str("[offsets]\n");
        for (at, offset) in OFFSETS.iter().enumerate() {
            _ = writeln!(file, "G{} = {offset:?}", 54 + at);
        }
        let found = fitted(&program, &machine(&file));
        prop_assert!(found.refused.is_none(), "{:?}\n{program}", found.refused);
        let codes: Vec<&str> = found.findings.iter().map(|found| found.code.name()).collect();
        let is_beyond = codes.contains(&"PM001");
        prop_assert_eq!(is_beyond, over > 0.0, "{:?} {:?}\n{}\n{}", found.findings, reached, file, program);
    }
}

/// grblHAL reads programs by the rules of LinuxCNC, but plans its moves as Grbl does. So its times are those of a Grbl
/// with the same accelerations and the same number of blocks ahead, not those of LinuxCNC.
#[test]
fn grblhal_slows_down_at_corners_as_grbl_does() {
    let corners: String = (0..40).map(|i| format!("X{}. Y{}.\n", i, i % 2)).collect();
    let program = format!("G21 G90 G94 G17\nS1000 M3\nG0 X0. Y0. Z1.\nG1 F6000.\n{corners}M30\n");
    let time = |control: &str| {
        let axis = |letter: char| format!("[axes.{letter}]\ntravel = [-100, 100]\nrapid = 9000\nacceleration = 500\n");
        let text = format!(
            "name = \"m\"\ncontrol = \"{control}\"\nunits = \"mm\"\n{}{}{}[corners]\nahead = 20\n",
            axis('X'),
            axis('Y'),
            axis('Z')
        );
        fitted(&program, &machine(&text)).times.unwrap().cutting
    };
    assert_eq!(time("grblhal"), time("grbl"));
    assert!((time("grblhal") - time("linuxcnc")).abs() > 0.1, "{} {}", time("grblhal"), time("linuxcnc"));
}

/// G30 P3 does not move to the position of `G30` in the machine file. A machine file can't contain the position of G30
/// P3.
#[test]
fn other_reference_points_are_unknown() {
    let program = |p: &str| format!("{HEAD}G91 G30{p} X0\nG90\nM30\n");
    let file = format!("{VF2}{KNOWN}[reference]\nG30 = [-100, 0, 0]\n");
    let not_checked = |p: &str| fitted(&program(p), &machine(&file)).fit.not_checked.join("; ");
    for p in ["", " P2"] {
        assert!(!not_checked(p).contains("the position of G30"), "{p}: {}", not_checked(p));
    }
    for p in [" P3", " P4"] {
        assert!(not_checked(p).contains("the position of G30 with P3 or more"), "{p}: {}", not_checked(p));
    }
}

/// Machine positions and lengths of Siemens and Heidenhain programs. G53 and SUPA with an active D, and M92, depend on
/// settings of the machine; the length of D2 is not in the table; in G18 the length counts along Y.
#[test]
fn machine_positions_of_other_languages() {
    let travels = "[axes.X]\ntravel = [-762, 0]\n[axes.Y]\ntravel = [-406, 0]\n[axes.Z]\ntravel = [-508, 0]\n";
    let file = |name: &str, offsets: &str| {
        format!("control = \"{name}\"\n{travels}[tools.5]\nlength = 120\n[offsets]\n{offsets} = [-400, -200, -380]\n")
    };
    let runs = |name: &str, offsets: &str, program: &str| {
        let fitted = fitted(program, &machine(&file(name, offsets)));
        let found: Vec<String> =
            fitted.findings.iter().map(|found| format!("{} {}", found.code.name(), found.message)).collect();
        (found.join("\n"), fitted.fit.not_checked.join("\n"))
    };
    let siemens = |blocks: &str| {
        let head = "G17 G710 G90 G94 G54\nT5\nM6\nG0 X0 Y0 S1000 M3\nD1 Z50\n";
        runs("siemens", "G54", &format!("{head}{blocks}\nM30\n"))
    };
    for (blocks, findings, open) in [
        ("G0 SUPA D0 Z0", "", ""),
        ("G0 SUPA D0 Z10", "PM001 T5 needs Z10", ""),
        ("G0 SUPA Z0", "", "MD10760"),
        ("G0 G53 Z0", "", "MD10760"),
        ("G0 G153 X0 Z0", "", "MD10760"),
        ("G0 D2 Z60", "PM015 the machine's table has no length of edge D2", ""),
        // -380 + 120 + 20 in Z with the length, -400 without it; -200 + 120 in Y with it
        ("G0 Z-200", "", ""),
        ("G18\nG0 X0 Y100 Z-120", "PM001 T5 needs Y20", ""),
        ("G18\nG0 X0 Y0 Z-130", "PM001 T5 needs Z-510", ""),
    ] {
        let (found, not_checked) = siemens(blocks);
        assert!(found.starts_with(findings) && found.is_empty() == findings.is_empty(), "{blocks}: {found}");
        assert_eq!(not_checked.contains("MD10760"), !open.is_empty(), "{blocks}: {not_checked}");
    }
    let klartext = |block: &str| {
        let head = "0 BEGIN PGM T MM\n1 TOOL CALL 5 Z S1000\nCYCL DEF 247 Q339=1\nL X+0 Y+0 R0 FMAX M3\nL Z+50 FMAX\n";
        runs("heidenhain", "Q1", &format!("{head}{block}\nM30\nEND PGM T MM\n"))
    };
    let (found, not_checked) = klartext("L Z+10 FMAX M91");
    assert!(found.contains("needs Z10") && !not_checked.contains("M92"), "{found}\n{not_checked}");
    let (found, not_checked) = klartext("L Z+10 FMAX M92");
    assert!(found.is_empty() && not_checked.contains("positions with M92"), "{found}\n{not_checked}");
}

/// A length that the program sets by G10 is not the length of the machine's table.
#[test]
fn a_length_that_the_program_sets_is_not_the_one_of_the_table() {
    finds("G0 Z100.", "", &[]);
    for block in ["G10 L10 P5 R400.", "G90 G10 L11 P5 R1."] {
        let program = format!("{block}\nG43 H5 Z100.");
        finds(&program, "", &["PM015 5 G10 sets the length H5"]);
        let machine = machine(&format!("{VF2}{KNOWN}"));
        let said = fitted(&format!("{HEAD}{program}\nM30\n"), &machine).fit.sentences(&machine, control("haas"));
        assert!(said.iter().any(|said| said.contains("the length H5")), "{said:?}");
    }
    // the diameter, and the length of another tool
    finds("G10 L12 P5 R4.\nG43 H5 Z100.", "", &[]);
}

/// The form's own kinds of coolant are compared with the kinds of the machine, and the message gives the name that
/// `kinds` needs. The control's file has no meaning for M83 of a Haas.
#[test]
fn coolant_of_the_form_is_checked() {
    let folder = Folder::new("coolant-of-form");
    let form = crate::support::root().join("postforms/haas.pf").display().to_string();
    folder.write("air.json", AIR);
    for (kinds, found) in [("\"flood\"", true), ("\"flood\", \"air\"", false)] {
        folder.write("vf2.toml", format!("control = \"haas\"\n[coolant]\nkinds = [{kinds}]\n"));
        for command in ["render", "verify"] {
            let done = folder.run(&[command, "air.json", "--form", &form, "--machine", "vf2.toml"]);
            let text = out(&done) + &err(&done);
            assert_eq!(text.contains("PM013"), found, "{text}");
            let parts = ["the program turns on the coolant `air`", "add it to `kinds` under [coolant]"];
            assert!(!found || parts.iter().all(|part| text.contains(part)), "{text}");
            assert!(text.contains("fits into vf2.toml"), "{text}");
        }
    }
}

const AIR: &str = r#"{"postform": 1, "program": 1, "units": "mm", "tools": [{"number": 1, "diameter": 10}],
 "operations": [{"tool": 1, "work": 54, "coolant": "air", "spindle": {"speed": 500, "direction": "cw"},
  "path": [{"rapid": [0, 0, 20]}, {"line": [0, 0, 10], "feed": 100}, {"rapid": [0, 0, 20]}]}]}"#;
