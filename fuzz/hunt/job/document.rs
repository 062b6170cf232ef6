//! FreeCAD documents: a document of the repository, with random commands in the paths of its operations.

use std::io::{Cursor, Read, Write};
use std::sync::OnceLock;

use serde_json::{Value, json};

use crate::random::Random;
use crate::text::list;

/// The operations of the document in the order of its job: name, tool and speed of the controller, and coolant.
const OPERATIONS: [(&str, u32, u32, &str); 5] = [
    ("Face_top.nc", 1, 5000, "M8"),
    ("LeadInOutDressup.nc", 1, 5000, "M8"),
    ("Pocket.nc", 1, 5000, "M7"),
    ("Helix_bore.nc", 2, 8000, "M8"),
    ("Inside_finish.nc", 2, 8000, "M9"),
];

/// Random commands for each operation. Lengths are in millimetres, feeds in millimetres per second.
pub fn commands(random: &mut Random) -> Value {
    let mut list = Vec::new();
    for (name, ..) in OPERATIONS {
        let mut path = Path { random, lines: Vec::new(), at: [0.0, 0.0, 16.0] };
        path.lines.push("G0 Z16.000000".into());
        let (x, y) = path.across();
        path.lines.push(format!("G0 X{x:.6} Y{y:.6}"));
        (path.at[0], path.at[1]) = (x, y);
        for _ in 0..1 + path.random.below(3) {
            match path.random.below(3) {
                0 => path.holes(),
                _ => path.contour(),
            }
        }
        path.lines.push("G0 Z16.000000".into());
        list.push(json!({ "name": name, "lines": path.lines }));
    }
    json!({ "units": "mm", "operations": list })
}

struct Path<'r> {
    random: &'r mut Random,
    lines: Vec<String>,
    at: [f64; 3],
}

impl Path<'_> {
    fn number(&mut self, low: f64, high: f64) -> f64 {
        let value = self.random.between(low, high);
        let by = self.random.pick(&[1.0, 10.0, 1e3, 1e6]);
        (value * by).round() / by + 0.0
    }

    fn across(&mut self) -> (f64, f64) {
        (self.number(-60.0, 60.0), self.number(-60.0, 60.0))
    }

    fn feed(&mut self) -> String {
        format!("F{:.6}", self.number(0.5, 20.0).max(0.1))
    }

    fn contour(&mut self) {
        let (x, y) = self.across();
        self.lines.push("G0 Z16.000000".into());
        self.lines.push(format!("G0 X{x:.6} Y{y:.6}"));
        let low = self.number(5.0, 14.0);
        self.lines.push(format!("G0 Z{low:.6}"));
        let depth = self.number(-5.0, 4.0);
        let feed = self.feed();
        self.lines.push(format!("G1 {feed} Z{depth:.6}"));
        self.at = [x, y, depth];
        for _ in 0..1 + self.random.below(4) {
            let feed = self.feed();
            match self.random.below(6) {
                0 | 1 => self.arc(&feed),
                2 => {
                    let (x, y) = self.across();
                    let z = self.number(-5.0, 4.0);
                    self.lines.push(format!("G1 {feed} X{x:.6} Y{y:.6} Z{z:.6}"));
                    self.at = [x, y, z];
                }
                3 => self.lines.push(self.random.pick(&["(a remark)", "M1", "M0"]).to_owned()),
                _ => {
                    let (x, y) = self.across();
                    self.lines.push(format!("G1 {feed} X{x:.6} Y{y:.6}"));
                    (self.at[0], self.at[1]) = (x, y);
                }
            }
        }
        self.lines.push("G0 Z16.000000".into());
        self.at[2] = 16.0;
    }

    fn arc(&mut self, feed: &str) {
        let (i, j) = (self.number(-20.0, 20.0), self.number(-20.0, 20.0));
        let [x, y, z] = self.at;
        let (cx, cy) = (x + i, y + j);
        let (x, y) = match self.random.below(4) {
            0 => (cx + j, cy - i),
            1 => (cx + i, cy + j),
            2 => (cx - j, cy + i),
            _ => (x, y),
        };
        let z = if self.random.once_in(4) { self.number(-5.0, 4.0) } else { z };
        let code = self.random.pick(&["G2", "G3"]);
        self.lines.push(format!("{code} {feed} I{i:.6} J{j:.6} K0.000000 X{x:.6} Y{y:.6} Z{z:.6}"));
        self.at = [x, y, z];
    }

    fn holes(&mut self) {
        self.lines.push("G0 Z16.000000".into());
        self.lines.push("G90".into());
        self.lines.push(self.random.pick(&["G98", "G99"]).to_owned());
        let r = self.number(3.0, 8.0);
        let z = self.number(-20.0, 2.0);
        let cycle = self.random.pick(&["G81", "G82", "G83", "G73"]);
        let more = match cycle {
            "G82" => format!(" P{:.6}", self.number(0.2, 2.0)),
            "G83" | "G73" => format!(" Q{:.6}", self.number(1.0, 6.0).max(0.5)),
            _ => String::new(),
        };
        let feed = self.feed();
        for _ in 0..1 + self.random.below(4) {
            let (x, y) = self.across();
            self.lines.push(format!("{cycle} {feed}{more} R{r:.6} X{x:.6} Y{y:.6} Z{z:.6}"));
        }
        self.lines.push("G80".into());
        self.lines.push("G0 Z16.000000".into());
    }
}

type Members = Vec<(String, Vec<u8>)>;

/// The archive members of the document in the repository.
fn template() -> &'static Members {
    static MEMBERS: OnceLock<Members> = OnceLock::new();
    MEMBERS.get_or_init(|| {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/data/freecad/bracket-0.20.FCStd");
        let bytes = std::fs::read(path).unwrap_or_default();
        let mut zip = zip::ZipArchive::new(Cursor::new(bytes)).unwrap_or_else(|error| panic!("{path}: {error}"));
        let mut members = Vec::new();
        for at in 0..zip.len() {
            let Ok(mut file) = zip.by_index(at) else { continue };
            let mut bytes = Vec::new();
            let is_read = file.read_to_end(&mut bytes).is_ok();
            if let (true, Ok(name)) = (is_read, file.name().map(std::borrow::Cow::into_owned)) {
                members.push((name, bytes));
            }
        }
        members
    })
}

/// The document with the commands of a job.
///
/// # Panics
/// Never: an archive in memory can be written.
pub fn archive(job: &Value) -> Vec<u8> {
    let mut zip = zip::ZipWriter::new(Cursor::new(Vec::new()));
    let stored = zip::write::SimpleFileOptions::default().compression_method(zip::CompressionMethod::Stored);
    for (name, bytes) in template() {
        let own = list(job, "operations").iter().find(|operation| operation["name"] == json!(name));
        let is_path = OPERATIONS.iter().any(|(path, ..)| path == name);
        let text = is_path.then(|| own.map_or(Vec::new(), lines).join("\n") + "\n");
        zip.start_file(name.as_str(), stored).expect("a member");
        zip.write_all(text.as_ref().map_or(bytes, |text| text.as_bytes())).expect("memory");
    }
    zip.finish().expect("memory").into_inner()
}

fn lines(operation: &Value) -> Vec<&str> {
    list(operation, "lines").iter().filter_map(Value::as_str).collect()
}

/// The meaning of the commands as a program for LinuxCNC: feeds per minute, and tool changes where the controller
/// changes.
pub fn program(job: &Value) -> String {
    let mut text = "G21 G90 G17 G40 G49 G80 G94\nG54\n".to_owned();
    let mut in_spindle = 0;
    for (name, tool, speed, coolant) in OPERATIONS {
        if tool != in_spindle {
            text += &format!("T{tool} M6\nG43 H{tool}\nS{speed} M3\n");
            in_spindle = tool;
        }
        text += &format!("M9\n{coolant}\n");
        for operation in list(job, "operations").iter().filter(|operation| operation["name"] == json!(name)) {
            for line in lines(operation) {
                let words = line.split(' ').map(|word| match word.strip_prefix('F').map(str::parse::<f64>) {
                    Some(Ok(feed)) => format!("F{:.6}", feed * 60.0),
                    _ => word.to_owned(),
                });
                text += &words.collect::<Vec<_>>().join(" ");
                text.push('\n');
            }
        }
    }
    text + "M2\n"
}
