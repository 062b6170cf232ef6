//! FreeCAD documents, made with FreeCAD 0.20.2 and 1.1.3. The reader must give the job that FreeCAD's own Python gives.
//! The dumps next to the documents were made inside FreeCAD from the reopened documents.
#![allow(clippy::unwrap_used, clippy::panic)]

use std::io::{Cursor, Write as _};
use std::path::PathBuf;

use postform::internals::freecad::{Options, Report, read_freecad};
use postform::toolpath::{Axes, Coolant, CycleSpec, Event, Flow, Place, ReadError, Sink, SpindleTurn, StopKind};
use serde_json::Value;

use crate::support;
use crate::support::folder::{Folder, err, out};
use crate::support::nc::Call;

const DOCUMENTS: [&str; 5] = ["bracket-0.20", "by-tool-0.20", "inch-names-0.20", "holes-1.1", "dressups-1.1"];

fn data(file: &str) -> PathBuf {
    support::root().join("tests/data/freecad").join(file)
}

/// The steps of a path as text. The reader's events and FreeCAD's commands must give the same steps.
#[derive(Default)]
struct Steps {
    said: Vec<String>,
    at: [f64; 3],
    feed: f64,
    cycle: Option<CycleSpec>,
    /// Rapids that count only if no hole of the same operation follows.
    rapids: Vec<String>,
    drilled: bool,
}

impl Steps {
    fn say(&mut self, text: String) {
        self.said.append(&mut self.rapids);
        self.drilled = false;
        self.said.push(text);
    }

    fn rapid(&mut self, to: [Option<f64>; 3]) {
        self.go(to);
        let [x, y, z] = self.at;
        self.rapids.push(format!("rapid {x:.6} {y:.6} {z:.6}"));
    }

    fn go(&mut self, to: [Option<f64>; 3]) {
        for (at, to) in self.at.iter_mut().zip(to) {
            *at = to.unwrap_or(*at);
        }
    }

    fn line(&mut self, to: [Option<f64>; 3], feed: f64) {
        self.go(to);
        let [x, y, z] = self.at;
        self.say(format!("line {x:.6} {y:.6} {z:.6} F{feed:.4}"));
    }

    fn arc(&mut self, to: [Option<f64>; 3], centre: [f64; 2], clockwise: bool, feed: f64) {
        self.go(to);
        let ([x, y, z], [i, j]) = (self.at, centre);
        let way = if clockwise { "cw" } else { "ccw" };
        self.say(format!("arc {way} {x:.6} {y:.6} {z:.6} about {i:.6} {j:.6} F{feed:.4}"));
    }

    fn hole(&mut self, hole: String, level: f64) {
        if self.drilled {
            self.rapids.clear(); // they only lead from one hole to the next
        }
        self.say(hole);
        self.at[2] = level;
        self.drilled = true;
    }
}

fn three(axes: &Axes) -> [Option<f64>; 3] {
    [axes.get(0), axes.get(1), axes.get(2)]
}

impl Sink for Steps {
    fn event(&mut self, event: Event<'_>, _: Place) -> Flow {
        match event {
            Event::ToolChange(change) => {
                let tool = change.tool.as_ref().unwrap();
                let spindle = change.spindle.unwrap();
                let turn = match spindle.turn.unwrap() {
                    SpindleTurn::Cw => "Forward",
                    SpindleTurn::Ccw => "Reverse",
                    SpindleTurn::Off => "None",
                };
                let coolant = match change.coolant.unwrap() {
                    Coolant::FLOOD => "Flood",
                    Coolant::MIST => "Mist",
                    Coolant::OFF => "None",
                    other => panic!("{other:?}"),
                };
                let (name, speed) = (change.name.as_ref().unwrap(), spindle.speed.unwrap());
                let (diameter, work) = (tool.diameter.unwrap(), change.work.unwrap());
                self.say(format!("{name}: T{} {diameter:.9} S{speed:.9} {turn} {coolant} G{work}", tool.number));
            }
            Event::Rapid(to) => self.rapid(three(&to)),
            Event::Line { to, feed } => self.line(three(&to), feed.unwrap()),
            Event::Arc { arc, feed } => {
                let centre = arc.center.unwrap();
                let clockwise = arc.direction == postform::toolpath::Direction::Cw;
                self.arc(three(&arc.to), [centre.values[0], centre.values[1]], clockwise, feed.unwrap());
            }
            Event::CycleBegin(spec) => self.cycle = Some(spec.clone()),
            Event::Hole(hole) => {
                let spec = self.cycle.clone().unwrap();
                let [x, y, top] = [0, 1, 2].map(|axis| hole.at.values[axis]);
                let [clear, depth] = [spec.clear, hole.depth.or(spec.depth)].map(Option::unwrap);
                let (r, bottom, level) = (top + clear, top - depth, top + spec.return_height.unwrap());
                let [peck, dwell] = [spec.step, spec.dwell].map(Option::unwrap_or_default);
                self.go([Some(x), Some(y), None]);
                let (kind, feed) = (spec.kind.name(), spec.feed.unwrap());
                let hole =
                    format!("{kind} {x:.6} {y:.6} Z{bottom:.6} R{r:.6} to {level:.6} Q{peck} P{dwell} F{feed:.4}");
                self.hole(hole, level);
            }
            Event::Stop(kind) => self.say(if kind == StopKind::Optional { "M1".into() } else { "M0".into() }),
            Event::Finish => self.say("end".into()),
            _ => {}
        }
        Flow::Continue(())
    }
}

/// The steps of FreeCAD's own commands.
fn dumped(dump: &Value) -> Vec<String> {
    let job = &dump["jobs"][0];
    let find = |list: &str, name: &Value| {
        job[list].as_array().unwrap().iter().find(|item| &item["name"] == name).cloned().unwrap()
    };
    let (mut steps, mut work) = (Steps::default(), String::new());
    let old = dump["freecad"].as_str().unwrap().starts_with("0.");
    let mut bare = job["operations"].as_array().unwrap().iter().peekable();
    for item in job["post_list"].as_array().unwrap().iter().flat_map(|part| part["items"].as_array().unwrap()) {
        if item["kind"] == "fixture" {
            work = item["commands"][0][0].as_str().unwrap().to_owned();
        }
        if item["kind"] != "operation" {
            continue;
        }
        // FreeCAD 0.20 leaves comments and stops out of its own list, so the test takes them from the list of
        // operations
        while old && bare.peek().is_some_and(|next| next["controller"].is_null()) {
            stops(&mut steps, &bare.next().unwrap()["commands"]);
        }
        if bare.peek().is_some_and(|next| next["name"] == item["name"]) {
            bare.next();
        }
        let operation = find("operations", &item["name"]);
        if operation["active"] == false {
            continue;
        }
        if operation["controller"].is_null() {
            stops(&mut steps, &operation["commands"]);
            continue;
        }
        let controller = find("tools", &operation["controller"]);
        let number = |value: &Value| value.as_f64().unwrap();
        steps.say(format!(
            "{}: T{} {:.9} S{:.9} {} {} {work}",
            operation["label"].as_str().unwrap(),
            controller["tool_number"],
            number(&controller["bit"]["diameter"]),
            number(&controller["spindle_speed"]),
            controller["spindle_dir"].as_str().unwrap(),
            operation["coolant"].as_str().unwrap(),
        ));
        let feeds = ["horiz_feed", "vert_feed"].map(|name| number(&controller[name]));
        path(&mut steps, &operation["commands"], &feeds);
    }
    while old && bare.peek().is_some_and(|next| next["controller"].is_null()) {
        stops(&mut steps, &bare.next().unwrap()["commands"]);
    }
    steps.say("end".into());
    steps.said
}

fn stops(steps: &mut Steps, commands: &Value) {
    for command in commands.as_array().unwrap().iter().map(|command| command[0].as_str().unwrap()) {
        if command.starts_with('M') {
            steps.say(command.to_owned());
        }
    }
}

fn path(steps: &mut Steps, commands: &Value, feeds: &[f64; 2]) {
    let mut before = false;
    for command in commands.as_array().unwrap() {
        let name = command[0].as_str().unwrap();
        let word = |letter: &str| command[1].get(letter).and_then(Value::as_f64);
        let to = ["X", "Y", "Z"].map(word);
        if let (Some(f), true) = (word("F"), name != "G0") {
            // the feed is that of a tool controller; FreeCAD rounds this feed to six decimals in the file
            steps.feed = 60.0 * feeds.iter().copied().find(|own| (own - f).abs() < 1.5e-6).unwrap_or(f);
        }
        let [x, y, z] = steps.at;
        match name {
            "G98" => before = true,
            "G99" => before = false,
            "G0" => steps.rapid(to),
            "G1" => steps.line(to, steps.feed),
            "G2" | "G3" => {
                let centre = [x + word("I").unwrap_or(0.0), y + word("J").unwrap_or(0.0)];
                steps.arc(to, centre, name == "G2", steps.feed);
            }
            "G73" | "G74" | "G81" | "G82" | "G83" | "G84" | "G85" => {
                let kind = match name {
                    "G73" => "chipbreak",
                    "G74" => "ltap",
                    "G81" => "drill",
                    "G82" => "face",
                    "G83" => "deep",
                    "G84" => "tap",
                    _ => "ream",
                };
                // F of a tap is its pitch
                let feed = if kind.ends_with("tap") { word("F").unwrap() * word("S").unwrap() } else { steps.feed };
                let [x, y, bottom] = to.map(Option::unwrap);
                let r = word("R").unwrap();
                let level = if before { z.max(r) } else { r };
                let [peck, dwell] = ["Q", "P"].map(|letter| word(letter).unwrap_or_default());
                steps.go([Some(x), Some(y), None]);
                let hole =
                    format!("{kind} {x:.6} {y:.6} Z{bottom:.6} R{r:.6} to {level:.6} Q{peck} P{dwell} F{feed:.4}");
                steps.hole(hole, level);
            }
            "G80" | "G90" => {}
            comment if comment.starts_with('(') => {}
            other => panic!("{other}"),
        }
    }
}

#[test]
fn a_document_is_the_job_that_freecad_has() {
    for name in DOCUMENTS {
        let dump: Value = serde_json::from_slice(&std::fs::read(data(&format!("{name}.dump.json"))).unwrap()).unwrap();
        let mut read = Steps::default();
        let file = std::fs::File::open(data(&format!("{name}.FCStd"))).unwrap();
        read_freecad(file, &Options::default(), &mut Report::default(), &mut read).unwrap();
        let wanted = dumped(&dump);
        assert!(wanted.len() > 20, "{name}");
        for (i, (read, wanted)) in read.said.iter().zip(&wanted).enumerate() {
            assert_eq!(read, wanted, "{name}, step {i}");
        }
        assert_eq!(read.said.len(), wanted.len(), "{name}");
    }
}

/// A document with this `Document.xml` and these other members.
fn archive(members: &[(&str, &[u8])]) -> Vec<u8> {
    let mut zip = zip::ZipWriter::new(Cursor::new(Vec::new()));
    for (name, bytes) in members {
        zip.start_file(*name, zip::write::SimpleFileOptions::default()).unwrap();
        zip.write_all(bytes).unwrap();
    }
    zip.finish().unwrap().into_inner()
}

/// Objects as FreeCAD writes them: name, then for each property its type, element and value.
fn document(objects: &[(&str, &[(&str, &str)])]) -> String {
    let mut text =
        String::from("<?xml version='1.0' encoding='utf-8'?>\n<Document ProgramVersion=\"1.1R1\"><ObjectData>");
    for (name, properties) in objects {
        text += &format!("<Object name=\"{name}\"><Properties>");
        for (property, value) in *properties {
            text += &format!("<Property name=\"{property}\">{value}</Property>");
        }
        text += "</Properties></Object>";
    }
    text + "</ObjectData></Document>"
}

const TOOL: &[(&str, &str)] = &[
    ("Label", "<String value=\"TC: 5mm\"/>"),
    ("ToolNumber", "<Integer value=\"3\"/>"),
    ("SpindleSpeed", "<Float value=\"1000\"/>"),
    (
        "SpindleDir",
        "<Integer value=\"0\" CustomEnum=\"true\"/><CustomEnumList><Enum value=\"Forward\"/></CustomEnumList>",
    ),
    ("HorizFeed", "<Float value=\"5\"/>"),
    ("VertFeed", "<Float value=\"2\"/>"),
];

const JOB: &[(&str, &str)] = &[
    ("Label", "<String value=\"Setup &lt;1&gt;\"/>"),
    ("Proxy", "<Python module=\"Path.Main.Job\" class=\"ObjectJob\"/>"),
    ("Operations", "<Link value=\"Operations\"/>"),
    ("Fixtures", "<StringList><String value=\"G54\"/></StringList>"),
];

const OPERATIONS: &[(&str, &str)] = &[("Group", "<LinkList><Link value=\"Op\"/></LinkList>")];

const OPERATION: &[(&str, &str)] = &[
    ("Label", "<String value=\"Holes\"/>"),
    ("ToolController", "<Link value=\"Tool\"/>"),
    ("StartDepth", "<Float value=\"0\"/>"),
    ("Path", "<Path file=\"Op.nc\"/>"),
];

/// A document of one operation with this path.
fn with_path(path: &str) -> Vec<u8> {
    let text = document(&[("Job", JOB), ("Operations", OPERATIONS), ("Op", OPERATION), ("Tool", TOOL)]);
    archive(&[("Document.xml", text.as_bytes()), ("Op.nc", path.as_bytes())])
}

/// The document with another value for a property of an object.
fn changed(object: &str, property: &str, value: &str) -> Vec<u8> {
    let objects: Vec<(&str, Vec<(&str, &str)>)> =
        [("Job", JOB), ("Operations", OPERATIONS), ("Op", OPERATION), ("Tool", TOOL)]
            .map(|(name, properties)| {
                let mut properties = properties.to_vec();
                if name == object {
                    properties.retain(|(name, _)| *name != property);
                    properties.push((property, value));
                }
                (name, properties)
            })
            .to_vec();
    let objects: Vec<(&str, &[(&str, &str)])> = objects.iter().map(|(name, list)| (*name, list.as_slice())).collect();
    archive(&[("Document.xml", document(&objects).as_bytes()), ("Op.nc", b"G0 X1 Y1 Z5\nG1 Z-1 F2\n")])
}

/// Code, message and location of the refusal of a document, or `read`.
fn refused(bytes: &[u8], options: &Options) -> String {
    struct Nothing;
    impl Sink for Nothing {
        fn event(&mut self, _: Event<'_>, _: Place) -> Flow {
            Flow::Continue(())
        }
    }
    match read_freecad(Cursor::new(bytes), options, &mut Report::default(), &mut Nothing) {
        Ok(()) | Err(ReadError::Stopped) => "read".into(),
        Err(ReadError::Job(diag)) => {
            assert!(diag.help.is_some(), "{diag:?}");
            format!("{} {} at {}", diag.code.name(), diag.message, diag.place.unwrap_or_default())
        }
        Err(ReadError::Io(error)) => panic!("{error}"),
    }
}

fn events(bytes: &[u8]) -> Vec<String> {
    let mut steps = Steps::default();
    let tool = |said: &str| said.starts_with("Holes: ");
    read_freecad(Cursor::new(bytes), &Options::default(), &mut Report::default(), &mut Lenient(&mut steps)).unwrap();
    steps.said.into_iter().filter(|said| !tool(said)).collect()
}

/// Accepts the tools of these small documents, which have no diameter.
struct Lenient<'a>(&'a mut Steps);

impl Sink for Lenient<'_> {
    fn event(&mut self, event: Event<'_>, place: Place) -> Flow {
        match event {
            Event::ToolChange(_) => Flow::Continue(()),
            event => self.0.event(event, place),
        }
    }
}

/// A document with an operation whose commands the user typed (FreeCAD's Custom).
fn typed(path: &str) -> Vec<u8> {
    let mut operation = OPERATION.to_vec();
    operation.push(("Gcode", "<StringList><String value=\"\"/></StringList>"));
    let text = document(&[("Job", JOB), ("Operations", OPERATIONS), ("Op", &operation), ("Tool", TOOL)]);
    archive(&[("Document.xml", text.as_bytes()), ("Op.nc", path.as_bytes())])
}

/// A command without an equivalent in a job is printed as typed. After an unknown G code, the rest of the operation is
/// printed as typed, too.
#[test]
fn a_custom_operation_prints_what_was_typed() {
    let folder = Folder::new("freecad-custom");
    let form = support::root().join("postforms/linuxcnc.pf");
    let form = form.to_str().unwrap();
    let post = |rest: &str, more: &[&str]| {
        folder.write("job.FCStd", typed(&format!("G0 X1 Y1 Z5\n{rest}\nG0 Z50\n")));
        let output = folder.run(&[&["render", "job.FCStd", "--form", form, "--set", "header=off"], more].concat());
        out(&output) + &err(&output)
    };
    // in the document, feeds are in millimetres per second
    for (rest, printed) in [
        ("M64 P1", "\nM64 P1\nG0 X1. Y1. Z50.\n"),
        ("G38.2 Z-10 F2", "\nG38.2 Z-10 F120\nG0 Z50\n"),
        ("G53 X0", "\nG53 X0\nG0 Z50\n"),
        ("G1 X2 P3 F2", "\nG1 X2 P3 F120\nG0 Z50\n"),
    ] {
        let said = post(rest, &[]);
        assert!(said.contains(printed), "{rest}: {said}");
    }
    assert!(post("M64 P1", &[]).contains("identical"));
    assert!(post("G2 X3 Y3 R2 F2", &[]).contains(" G2 X3. Y3. I2. J0 F120.\n"), "{}", post("G2 X3 Y3 R2 F2", &[]));
    // text is not converted to other units
    let said = post("G53 X5", &["--units", "inch"]);
    assert!(said.contains("PR035") && said.contains("the text has X5 in the units of the job"), "{said}");
    let none = &Options::default();
    for code in ["M6 T2", "M2", "M30"] {
        assert!(refused(&typed(code), none).starts_with("PD003"), "{code}");
    }
    // operations that FreeCAD makes itself never contain this command
    assert!(refused(&with_path("M64 P1"), none).starts_with("PD003 M64: a command that a job can't contain"));
    assert!(refused(&with_path("G91 X1"), none).starts_with("PD003"));
    // a stop with another word is refused, so no word is lost
    assert!(refused(&with_path("M1 P5"), none).starts_with("PD003 M1: a word P that a job can't contain"));
    assert!(post("M1 P5", &[]).contains("M1 P5"), "{}", post("M1 P5", &[]));
    assert!(refused(&typed("G2 X3 Y3 I1 R1"), none).starts_with("PD003 G2: an arc with a radius and a centre"));
}

#[test]
fn the_label_and_the_author_of_a_document_are_told() {
    struct Heads(Vec<Option<String>>);
    impl Sink for Heads {
        fn event(&mut self, event: Event<'_>, _: Place) -> Flow {
            if let Event::Start(start) = event {
                self.0.extend([start.name.clone(), start.about.part.clone(), start.about.author.clone()]);
            }
            Flow::Continue(())
        }
    }
    let properties = |author: &str| {
        let said = [("Label", "Bracket &amp; pin"), ("CreatedBy", author), ("Company", "")];
        let said =
            said.map(|(name, value)| format!("<Property name=\"{name}\"><String value=\"{value}\"/></Property>"));
        format!("<Properties>{}</Properties><ObjectData>", said.concat())
    };
    for (author, told) in [("E. Muster", Some("E. Muster".to_owned())), ("", None)] {
        let text = document(&[("Job", JOB), ("Operations", OPERATIONS), ("Op", OPERATION), ("Tool", TOOL)]);
        let text = text.replacen("<ObjectData>", &properties(author), 1);
        let bytes = archive(&[("Document.xml", text.as_bytes()), ("Op.nc", b"G0 X1 Y1 Z5\nG1 Z-1 F2\n")]);
        let mut heads = Heads(Vec::new());
        read_freecad(Cursor::new(bytes), &Options::default(), &mut Report::default(), &mut heads).unwrap();
        assert_eq!(heads.0, [Some("Setup <1>".to_owned()), Some("Bracket & pin".to_owned()), told]);
    }
}

#[test]
fn broken_documents_are_refused() {
    let none = &Options::default();
    let starts = |bytes: &[u8], text: &str| {
        let said = refused(bytes, none);
        assert!(said.starts_with(text), "{said}, not {text}");
    };
    starts(b"", "PD001 the file can't be unpacked");
    // the unpacked document has more than 1,000 times its packed size
    let bomb = with_path(&format!("G0 X0 Y0 Z5\n{}", "\n".repeat(16 << 20)));
    starts(&bomb, "PD001 `Op.nc` can't be unpacked: its unpacked size is too large");
    starts(b"{\"postform\": 1}", "PD001 the file can't be unpacked");
    starts(&with_path("")[..200], "PD001 the file can't be unpacked");
    starts(&archive(&[("a", b"b")]), "PD001 the archive has no `Document.xml`");
    starts(
        &archive(&[("Document.xml", b"")]),
        "PD001 Document.xml can't be read: the file is incomplete or not a FreeCAD document",
    );
    starts(&archive(&[("Document.xml", b"<Document><Object")]), "PD001 Document.xml can't be read");
    starts(&archive(&[("Document.xml", b"\xff\xfe")]), "PD001 `Document.xml` can't be unpacked");
    let entities = b"<!DOCTYPE d [<!ENTITY a \"aaaa\">]><Document ProgramVersion=\"&a;\"/>";
    starts(&archive(&[("Document.xml", entities)]), "PD001 Document.xml can't be read: it declares entities");
    starts(&archive(&[("Document.xml", b"<Document ProgramVersion=\"&a;\"/>")]), "PD001 Document.xml can't be read");
    // 65 MB of blanks, packed to a few kilobytes
    let large = vec![b' '; 65 << 20];
    starts(
        &archive(&[("Document.xml", &large)]),
        "PD001 `Document.xml` can't be unpacked: its unpacked size is too large",
    );
    let text = document(&[("Job", JOB), ("Operations", OPERATIONS), ("Op", OPERATION), ("Tool", TOOL)]);
    starts(&archive(&[("Document.xml", text.as_bytes())]), "PD001 the archive has no `Op.nc`");
    // a checksum detects damaged contents
    let mut bytes = with_path(&"G0 X1 Y1 Z5\n".repeat(500));
    let at = bytes.windows(5).position(|window| window == b"Op.nc").unwrap() + 8;
    bytes[at] ^= 0x55;
    starts(&bytes, "PD001");
}

#[test]
fn what_a_program_needs_must_be_there() {
    let none = &Options::default();
    for (object, property, value, said) in [
        ("Job", "Fixtures", "<StringList></StringList>", "PD004 the job Setup <1> has no work offset at "),
        (
            "Job",
            "Fixtures",
            "<StringList><String value=\"H1\"/></StringList>",
            "PD003 a work offset that a job can't contain: H1 at ",
        ),
        ("Job", "Operations", "<Link value=\"\"/>", "PD001 the job Setup <1> has no list of operations at "),
        (
            "Operations",
            "Group",
            "<LinkList><Link value=\"Gone\"/></LinkList>",
            "PD001 the document has no object `Gone` at ",
        ),
        ("Op", "Active", "<Bool value=\"false\"/>", "PD002 the job Setup <1> has no active operation at "),
        ("Op", "ToolController", "<Link value=\"\"/>", "PD004 the operation Holes has no tool controller at "),
        (
            "Op",
            "Placement",
            "<PropertyPlacement Px=\"0\" Py=\"12.5\" Pz=\"0\" Q0=\"0\" Q1=\"0\" Q2=\"0\" Q3=\"1\"/>",
            "PD003 the operation Holes has a Placement (X0 Y12.5 Z0) that moves or turns its path at ",
        ),
        (
            "Op",
            "Placement",
            "<PropertyPlacement Px=\"0\" Py=\"0\" Pz=\"0\" Q0=\"0\" Q1=\"0\" Q2=\"0.5\" Q3=\"0.8\"/>",
            "PD003 the operation Holes has a Placement (X0 Y0 Z0) that moves or turns its path at ",
        ),
        (
            "Op",
            "Placement",
            "<PropertyPlacement Px=\"nan\"/>",
            "PD003 the operation Holes has a Placement (XNaN YNaN ZNaN) that moves or turns its path at ",
        ),
        (
            "Op",
            "Placement",
            "<PropertyPlacement Px=\"0\" Py=\"-0\" Pz=\"0\" Q0=\"0\" Q1=\"0\" Q2=\"0\" Q3=\"-1\"/>",
            "read",
        ),
        ("Tool", "SpindleSpeed", "<Float value=\"0\"/>", "PD004 the tool controller TC: 5mm has no spindle speed at "),
        ("Job", "Proxy", "<Python class=\"Other\"/>", "PD002 the document has no CAM job at "),
    ] {
        assert_eq!(refused(&changed(object, property, value), none), said);
    }
    let asked = Options { job: Some("Other".into()) };
    assert_eq!(refused(&with_path(""), &asked), "PD002 the document has no job `Other` at ");
    assert_eq!(refused(&with_path(""), &Options { job: Some("Setup <1>".into()) }), "read");
    let text =
        document(&[("Job", JOB), ("Job001", JOB), ("Operations", OPERATIONS), ("Op", OPERATION), ("Tool", TOOL)]);
    let two = archive(&[("Document.xml", text.as_bytes()), ("Op.nc", b"")]);
    assert_eq!(refused(&two, none), "PD002 the document has 2 jobs to choose from at ");
    assert_eq!(refused(&two, &Options { job: Some("Job001".into()) }), "read");
}

/// FreeCAD saves the tool change of each controller. Its direction and its speed must be those of the controller.
#[test]
fn the_saved_tool_change_agrees_with_its_controller() {
    for (change, said) in [
        ("(TC)\nM6 T3.000000\nM3 S1000.000000\n", "read"),
        ("(TC)\n", "read"),
        (
            "M6 T3.000000\nM4 S1000.000000\n",
            "PD004 the tool controller TC: 5mm has the spindle direction Forward at 1000, but its tool change Reverse at \
             1000 at ",
        ),
        (
            "M6 T3.000000\nM3 S900.000000\n",
            "PD004 the tool controller TC: 5mm has the spindle direction Forward at 1000, but its tool change Forward at \
             900 at ",
        ),
        (
            "M6 T3.000000\n",
            "PD004 the tool controller TC: 5mm has the spindle direction Forward at 1000, but its tool change None at ",
        ),
    ] {
        let mut tool = TOOL.to_vec();
        tool.push(("Path", "<Path file=\"Tool.nc\"/>"));
        let text = document(&[("Job", JOB), ("Operations", OPERATIONS), ("Op", OPERATION), ("Tool", &tool)]);
        let path = b"G0 X1 Y1 Z5\nG1 Z-1 F2\n";
        let bytes = archive(&[("Document.xml", text.as_bytes()), ("Op.nc", path), ("Tool.nc", change.as_bytes())]);
        assert_eq!(refused(&bytes, &Options::default()), said, "{change}");
    }
}

#[test]
fn no_word_of_a_path_is_lost() {
    for (path, said) in [
        ("G1 X1 F0", "PD004 G1: a cut without a feed at line 1"),
        ("G0 X1 Y1 Z5\nG1 X2 Q3", "PD003 G1: a word Q that a job can't contain at line 2"),
        ("G10 L2 P1", "PD003 G10: a command that a job can't contain at line 1"),
        ("M6 T5", "PD003 M6: a command that a job can't contain at line 1"),
        ("hello", "PD003 a line of a path that can't be read: hello at "),
        (
            "G0 X1 Y1 Z5\nG84 X1 Y1 Z-5 R2 F1.25",
            "PD003 G84: a tap without a speed S: its F may be a feed or a pitch at line 2",
        ),
        ("G0 X1 Y1 Z5\nG83 X1 Y1 Z-5 R2 F1.25", "PD003 G83: a peck cycle without its step Q at line 2"),
        ("G98\nG81 X1 Y1 Z-5 R2 F1", "PD003 G81: a cycle with G98, but the height before it is unknown at line 2"),
        ("G0 X1 Y1 Z5\nG81 X1 Y1 Z5 R2 F1", "PD003 G81: a cycle whose bottom Z5 is above its R2 at line 2"),
        ("G2 X1 Y1 I1 F2", "PD003 G2: an arc from an unknown position at line 1"),
        ("G0 X0 Y0 Z0\nG2 X1 Y1 F2", "PD003 G2: an arc whose centre is not in its plane at line 2"),
        ("G0 X0 Y0 Z0\nG41 D1\nG1 X1 F2", "PD003 the operation Holes ends under cutter compensation at "),
        ("M3", "read"),
    ] {
        let refused = refused(&with_path(path), &Options::default());
        let refused = match refused.split_once("operations[0].path[") {
            Some((message, place)) => format!("{message}{}", place.split_once("`Holes`, ").unwrap().1),
            None => refused,
        };
        assert_eq!(refused.replace(" of its path", ""), said, "{path}");
    }
    let long = format!("G1 X{}", "1".repeat(70_000));
    assert!(refused(&with_path(&long), &Options::default()).starts_with("PD003 a line of a path that can't be read"));
}

/// Rapids that only lead from hole to hole belong to the cycle. A rapid over a clamp is kept.
#[test]
fn rapids_between_holes_count_where_they_avoid_something() {
    let hole = |x: i32| format!("G81 X{x} Y0 Z-5 R2 F1\n");
    let plain = format!("G98\nG0 X0 Y0 Z10\n{}G0 X9 Y0\nG0 Z10\n{}G80\nG0 Z20\n", hole(0), hole(9));
    let drilled =
        |x: i32, level: i32| format!("drill {x}.000000 0.000000 Z-5.000000 R2.000000 to {level}.000000 Q0 P0 F60.0000");
    let lifted = |x: i32, z: i32| format!("rapid {x}.000000 0.000000 {z}.000000");
    assert_eq!(
        events(&with_path(&plain)),
        [lifted(0, 10), drilled(0, 10), drilled(9, 10), lifted(9, 20), "end".into()]
    );
    let clamp = format!("G98\nG0 X0 Y0 Z10\n{}G0 Z30\nG0 X9 Y0\nG0 Z10\n{}G80\n", hole(0), hole(9));
    let mut over = Cycles::default();
    read_freecad(Cursor::new(with_path(&clamp)), &Options::default(), &mut Report::default(), &mut over).unwrap();
    assert_eq!(over.0, "R C H E R R R C H E .");
    let mut one = Cycles::default();
    read_freecad(Cursor::new(with_path(&plain)), &Options::default(), &mut Report::default(), &mut one).unwrap();
    assert_eq!(one.0, "R C H H E R .");
}

/// Rapids, starts and ends of cycles, and holes, as letters.
#[derive(Default)]
struct Cycles(String);

impl Sink for Cycles {
    fn event(&mut self, event: Event<'_>, _: Place) -> Flow {
        self.0 += match event {
            Event::Rapid(_) => "R ",
            Event::CycleBegin(_) => "C ",
            Event::Hole(_) => "H ",
            Event::CycleEnd => "E ",
            Event::Finish => ".",
            _ => "",
        };
        Flow::Continue(())
    }
}

/// The test prints documents with four posts, by the same commands as a user. Each program makes the motions of its
/// document.
#[test]
fn documents_are_posted_and_proven() {
    for name in DOCUMENTS {
        for form in ["linuxcnc", "haas", "fanuc", "grbl"] {
            let (document, form) =
                (data(&format!("{name}.FCStd")), support::root().join(format!("postforms/{form}.pf")));
            let run = |command: &str| {
                std::process::Command::new(env!("CARGO_BIN_EXE_postform"))
                    .args([command, &document.to_string_lossy(), "--form", &form.to_string_lossy(), "--program", "7"])
                    .output()
                    .unwrap()
            };
            let verified = run("verify");
            let said = String::from_utf8_lossy(&verified.stdout).into_owned();
            assert!(verified.status.success(), "{name} {form:?}: {said}{}", String::from_utf8_lossy(&verified.stderr));
            assert!(said.starts_with("identical") || said.starts_with("equivalent"), "{name} {form:?}: {said}");
            assert!(run("render").stdout.len() > 400);
        }
    }
}

/// End points of the cuts in millimetres, from LinuxCNC's interpreter; cuts of zero length are left out.
fn cuts(program: &str, name: &str) -> Vec<[f64; 3]> {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR"));
    let (file, table) = (folder.join(format!("freecad-{name}.ngc")), folder.join("tools.tbl"));
    let tools: String = (1..20).map(|n| format!("T{n} P{n} Z0 D1\n")).collect();
    let arguments = ["-t".as_ref(), table.as_os_str(), "-g".as_ref(), file.as_os_str()];
    let output = support::nc::rs274(&[(&table, &tools), (&file, program)], &arguments);
    let calls = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(calls.contains("PROGRAM_END()"), "{name}: {}\n{program}", String::from_utf8_lossy(&output.stderr));
    let scale = if program.contains("G20") { 25.4 } else { 1.0 };
    let mut ends = Vec::new();
    let mut at = [f64::NAN; 3];
    for call in support::nc::interpreted(&calls) {
        let (to, cuts) = match call {
            Call::Rapid(to) => (to, false),
            Call::Feed(to) | Call::Arc(to, ..) => (to, true),
            _ => continue,
        };
        let to = [0, 1, 2].map(|axis| to[axis] * scale);
        if cuts && to != at {
            ends.push(to);
        }
        at = to;
    }
    ends
}

/// LinuxCNC's interpreter runs FreeCAD's own programs and postform's programs. All cuts must end at the same positions.
#[test_with::executable(rs274)]
#[test]
fn the_interpreter_cuts_what_freecads_own_program_cuts() {
    for name in DOCUMENTS {
        let ours = std::process::Command::new(env!("CARGO_BIN_EXE_postform"))
            .args(["render", &data(&format!("{name}.FCStd")).to_string_lossy(), "--cycles", "emulated", "--form"])
            .arg(support::root().join("postforms/linuxcnc.pf"))
            .output()
            .unwrap();
        let theirs = std::fs::read_to_string(data(&format!("{name}.linuxcnc.ngc"))).unwrap();
        // FreeCAD's comments may contain nested parentheses, which the interpreter refuses
        let theirs: String = theirs.lines().filter(|line| !line.contains('(')).flat_map(|line| [line, "\n"]).collect();
        let ours = cuts(&String::from_utf8_lossy(&ours.stdout), &format!("{name}.ours"));
        let theirs = cuts(&theirs, &format!("{name}.theirs"));
        for (i, (ours, theirs)) in ours.iter().zip(&theirs).enumerate() {
            let near = ours.iter().zip(theirs).all(|(a, b)| (a - b).abs() < 2e-3);
            assert!(near, "{name}, cut {i}: {ours:?}, FreeCAD's program has {theirs:?}");
        }
        assert_eq!(ours.len(), theirs.len(), "{name}");
        assert!(ours.len() > 10, "{name}");
    }
}
