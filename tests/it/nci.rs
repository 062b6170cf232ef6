//! Mastercam NCI files: the events from their records, and refusals.

use std::fs;

use postform::diag::Code;
use postform::toolpath::{Event, Flow, Place, Sink, Units};
use postform::{Format, Job};

use crate::support::folder::{Folder, err};
use crate::support::root;

/// Events as lines of text.
#[derive(Default)]
struct Lines(Vec<String>);

impl Sink for Lines {
    fn event(&mut self, event: Event<'_>, _: Place) -> Flow {
        self.0.push(match event {
            Event::Start(start) => format!("start {:?} {}", start.program, start.units.name()),
            Event::ToolChange(change) => {
                let tool = change.tool.as_ref().unwrap();
                let spindle = change.spindle.unwrap();
                format!(
                    "tool {} {:?} D{:?} H{:?} {:?} {:?} {:?}",
                    tool.number,
                    tool.diameter,
                    tool.diameter_offset,
                    tool.length_offset,
                    spindle.speed,
                    spindle.turn,
                    change.name
                )
            }
            Event::Rapid(to) => format!("rapid {:?}", &to.values[..3]),
            Event::Line { to, feed } => format!("line {:?} {feed:?}", &to.values[..3]),
            Event::Infeed { infeed, feed } => format!("infeed {:?} {:?} {feed:?}", infeed.side, &infeed.to.values[..3]),
            Event::Outfeed { to, feed, .. } => format!("outfeed {:?} {feed:?}", &to.values[..3]),
            Event::Arc { arc, feed } => {
                format!(
                    "arc {:?} {:?} about {:?} {feed:?}",
                    arc.direction,
                    &arc.to.values[..3],
                    &arc.center.unwrap().values[..2]
                )
            }
            Event::CycleBegin(spec) => format!(
                "cycle {:?} {:?} {:?} {:?} F{:?} Q{:?} first {:?} P{:?}",
                spec.kind,
                spec.clear,
                spec.depth,
                spec.return_height,
                spec.feed,
                spec.step,
                spec.first_step,
                spec.dwell
            ),
            Event::Hole(hole) => format!("hole {:?} {:?}", &hole.at.values[..3], hole.depth),
            other => format!("{other:?}"),
        });
        Flow::Continue(())
    }
}

fn read(text: &str) -> Result<Vec<String>, (Code, Option<u64>, String)> {
    let mut job = Job::bytes(Format::Nci, text);
    job.reading.units = Some(Units::Mm);
    let mut lines = Lines::default();
    match job.read(&mut lines) {
        Ok(()) => Ok(lines.0),
        Err(error) => {
            let diag = &error.findings().diags[0];
            Err((diag.code, diag.place.as_ref().and_then(|place| place.line), diag.message.clone()))
        }
    }
}

fn sample() -> String {
    fs::read_to_string(root().join("tests/data/nci/holes-and-arcs.nci")).unwrap()
}

/// The expected result comes from a second reader, written from the same sources.
#[test]
fn motions_arcs_compensation_and_holes() {
    let lines = read(&sample()).unwrap();
    let expected = [
        "start Some(7.0) mm",
        "tool 1 Some(10.0) DSome(41.0) HSome(1.0) Some(2000.0) Some(Cw) Some(\"CONTOUR\")",
        "rapid [0.0, 0.0, 50.0]",
        "rapid [0.0, 0.0, 2.0]",
        "line [0.0, 0.0, -5.0] Some(150.0)",
        "infeed Left [10.0, 0.0, -5.0] Some(300.0)",
        "arc Ccw [20.0, 10.0, -5.0] about [10.0, 10.0] Some(300.0)",
        "arc Cw [30.0, 20.0, -6.0] about [30.0, 10.0] Some(300.0)",
        "outfeed [30.0, 40.0, -6.0] Some(300.0)",
        "rapid [30.0, 40.0, 50.0]",
        "tool 2 Some(6.0) DSome(42.0) HSome(2.0) Some(1500.0) Some(Ccw) None",
        "rapid [10.0, 10.0, 50.0]",
        "cycle Deep Some(2.0) Some(20.0) Some(50.0) FSome(120.0) QSome(3.0) first Some(5.0) PSome(0.5)",
        "hole [10.0, 10.0, 0.0] Some(20.0)",
        "hole [30.0, 10.0, 0.0] Some(20.0)",
        "CycleEnd",
        "cycle Deep Some(2.0) Some(22.0) Some(50.0) FSome(100.0) QSome(3.0) first Some(5.0) PSome(0.5)",
        "hole [50.0, 10.0, 0.0] Some(22.0)",
        "CycleEnd",
        "Dwell(1.5)",
        "Text(\"M0\")",
        "Finish",
    ];
    assert_eq!(lines, expected, "{lines:#?}");
    // with Windows line ends
    assert_eq!(read(&sample().replace('\n', "\r\n")).unwrap(), expected);
}

#[test]
fn what_is_refused_has_its_line() {
    let text = sample();
    let change = |from: &str, to: &str| {
        assert_eq!(text.matches(from).count(), 1, "{from}");
        text.replace(from, to)
    };
    let table: Vec<(String, Code, &str)> = vec![
        (String::new(), Code::PI001, "the file is empty"),
        ("G0 X1\n".into(), Code::PI001, "`G0 X1` is not a record number"),
        ("1003\n0. 0. 0.\n".into(), Code::PI001, "does not begin with record 1050"),
        (change("1003\n0. 0. 0.\n", ""), Code::PI004, "ends without its last record"),
        (change("1003\n0. 0. 0.\n", "1003\n"), Code::PI004, "cut off after the number"),
        (text.clone() + "0\n0 0. 0. 0. -2. 0\n", Code::PI001, "a record after the end"),
        (change("0 0. 0. 2. -2. 0", "0 0. 0. NaN -2. 0"), Code::PI001, "a value that is not a number"),
        (change("0 0. 0. 2. -2. 0", "0 0. 0."), Code::PI001, "record 0 has 3 values, but needs 5"),
        (change("0 0. 0. 2. -2. 0", "10000 0. 0. 2. -2. 0"), Code::PI003, "canned text 10"),
        (change("0 0. 0. 2. -2. 0", "0 0. 0. 2. -0.1 0"), Code::PI003, "a feed of -0.1"),
        (
            change("0 0 20. 10. 10. 10. -5. -1. 0 0", "0 0 20. 10. 10. 11. -5. -1. 0 0"),
            Code::PI001,
            "the start of an arc",
        ),
        (
            change("0 0 20. 10. 10. 10. -5. -1. 0 0", "2 0 20. 10. 10. 10. -5. -1. 0 0"),
            Code::PI003,
            "an arc in the XZ plane",
        ),
        (
            change("0 0 20. 10. 10. 10. -5. -1. 0 0", "0 0 10. 0. 10. 10. -5. -1. 0 0"),
            Code::PI001,
            "not clearly a full circle",
        ),
        (change("1 10. 10. -20. 0.5 120.", "7 10. 10. -20. 0.5 120."), Code::PI003, "a cycle of type 7"),
        (
            change("50. 2. 0. 0. 10. 10. 50. 0 0", "50. -2. 0. 0. 10. 10. 50. 0 0"),
            Code::PI001,
            "not in descending order",
        ),
        (change("50. 2. 0. 0. 10. 10. 50. 0 0", "50. 2. 0. 0. 10. 11. 50. 0 0"), Code::PI003, "not along Z"),
        (change("\n80\n\n", "\n1025\n0 1 0 0 0 0 0 0 0 0\n80\n\n"), Code::PI003, "canned text (1025)"),
        (change("\n80\n\n", "\n1018\n\n"), Code::PI003, "record 1018: a subprogram"),
        (change("1 40 30. 40.".trim_start_matches("1 "), "0 30. 40."), Code::PI003, "compensation"),
    ];
    for (text, code, message) in table {
        let (found, line, said) = read(&text).unwrap_err();
        assert_eq!(found, code, "{message}: {said}");
        assert!(said.contains(message), "{message}: {said}");
        assert!(line.is_some(), "{message}");
    }
    let turned = text.replacen("1014\n1. 0. 0. 0. 1. 0. 0. 0. 1.", "1014\n1. 0. 0. 0. 0. 1. 0. -1. 0.", 1);
    assert_eq!(read(&turned).unwrap_err().2, "a tool plane that is turned or moved");
    let moved = text.replacen("0. 0. 1. 0. 0. 0.\n20001", "0. 0. 1. 10. 0. 0.\n20001", 1);
    assert_eq!(read(&moved).unwrap_err().2, "a work coordinate system that is turned or moved");
}

/// The name and the diameter of a tool end at the change to another tool, and stay for another operation with the tool.
#[test]
fn a_tool_does_not_get_the_data_of_the_tool_before() {
    let head = "1050\n9 100 1 2 2020 10 0 0 X.MC9\n1013\n0 10. 0. 1 1 0. 0. 0. 2 X\n20001\n10 MILL\n";
    let change = |code: u32, tool: u32| {
        format!("{code}\n7 100 2 {tool} 4{tool} {tool} 0 2000 300. 1 0. 0. 50. 0. 0. 0. 0 0.\n0\n0 0. 0. 50. -2. 0\n")
    };
    let text = format!("{head}{}{}{}1003\n0. 0. 0.\n", change(1001, 1), change(1000, 1), change(1002, 3));
    let lines = read(&text).unwrap();
    let tools: Vec<&str> = lines.iter().filter_map(|line| line.split_once(" DSome")).map(|(tool, _)| tool).collect();
    assert_eq!(tools, ["tool 1 Some(10.0)", "tool 1 Some(10.0)", "tool 3 None"], "{lines:#?}");
}

/// Values of cycles that are not read are reported.
#[test]
fn values_of_pecks_that_are_not_read_are_reported() {
    let warned = |text: &str| {
        let mut job = Job::bytes(Format::Nci, text);
        job.reading.units = Some(Units::Mm);
        job.read(&mut Lines::default()).unwrap();
        let found = job.report().warnings.iter().filter(|warning| warning.code == Code::PI006);
        found.map(|warning| warning.message.clone()).collect::<Vec<_>>()
    };
    let text = sample();
    let peck = "value 9 of record 81, probably the peck clearance, is ignored: it is 1";
    assert_eq!(warned(&text), [peck]);
    let (deep, chip) = ("1 10. 10. -20. 0.5 120. 5. 3. 1. 0. 50.", "2 10. 10. -20. 0.5 120. 5. 3. 1. 0.2 50.");
    assert_eq!(text.matches(deep).count(), 1);
    let retract = "value 10 of record 81, probably the retract after a chip, is ignored: it is 0.2";
    assert_eq!(warned(&text.replace(deep, chip)), [retract]);
    assert!(warned(&text.replace("5. 3. 1. 0. 50.", "5. 3. 0. 0. 50.")).is_empty());
}

#[test]
fn a_file_needs_its_units_and_its_program_is_proven() {
    let folder = Folder::new("nci");
    folder.write("part.nci", sample());
    fs::copy(root().join("postforms/haas.pf"), folder.0.join("haas.pf")).unwrap();
    let output = folder.run(&["check", "part.nci"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(err(&output).contains("PI002 at part.nci:19"), "{}", err(&output));
    let output = folder.run(&["render", "part.nci", "--assume-units", "mm", "--form", "haas.pf", "-o", "part.nc"]);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    let said = err(&output);
    assert!(
        said.contains("identical: the program makes the motions of part.nci") || said.contains("equivalent: "),
        "{said}"
    );
    assert!(folder.read("part.nc").contains("T2 M6"));
}
