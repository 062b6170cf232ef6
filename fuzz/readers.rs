//! Random mutations of jobs in all formats, by the million: FreeCAD documents, CL files of all dialects, NC programs, JSON.
//! Each mutated job is read to its end or to an error.
//!
//! Run `readers COUNT SEED`. After a panic, the seed of the mutation is printed. `readers 1 SEED` makes this mutation
//! again.

use std::fs;
use std::io::{Cursor, Read, Write};
use std::path::{Path, PathBuf};
use std::time::Instant;

use postform::toolpath::{Event, Flow, Place, Sink, Stop, Units};
use postform::{Format, Job};
use postform_fuzz::random::Random;

/// Pieces that also have a meaning at a wrong position, by format.
const CL: &[&str] = &[
    "\n",
    "\r\n",
    "$",
    "$$",
    "$$*",
    "~",
    "/",
    ",",
    "GOTO/",
    "GODLTA/1,2,3",
    "RAPID\n",
    "CYCLE/DRILL,DEPTH,5,MMPM,100,CLEAR,2\n",
    "CYCLE/OFF\n",
    "CYCLE/DEEP,5,1,100,MMPM\n",
    "CIRCLE/0,0,0,0,0,1,5\n",
    "TIMES,1000",
    "MOVARC/0,0,0,0,0,1,5,ANGLE,90\n",
    "LOADTL/2\n",
    "LOAD/TOOL,3\n",
    "TLON,GOFWD/(CIRCLE/0,0,0,5)\n",
    "INDIRV/1,0,0\n",
    "SPINDL/1000,RPM,CLW\n",
    "FEDRAT/1e308,MMPM\n",
    "CUTCOM/LEFT\n",
    "CUTCOM/OFF\n",
    "TRANS/1e300,0,0\n",
    "UNITS/MM\n",
    "UNITS/INCHES\n",
    "FINI\n",
    "END\n",
    "TLAXIS/0,1,0\n",
    "CSYS/1,0,0,0,0,1,0,0,0,0,1,0\n",
    "MSYS/0,0,0,1,0,0,0,1,0\n",
    "-",
    "1e999",
    "nan",
    ".",
    "\u{0}",
    "é",
    "999999999999999999999",
];
const NC: &[&str] = &[
    "\n",
    "\r\n",
    "%\n",
    "(",
    ")",
    "/",
    "G0",
    "G1",
    "G2",
    "G3",
    "G17",
    "G18",
    "G20",
    "G21",
    "G28",
    "G40",
    "G41",
    "G43H1",
    "G52X1",
    "G53",
    "G54",
    "G80",
    "G81X1Y1Z-1R1F9",
    "G83Q.1",
    "G84",
    "G90",
    "G91",
    "G98",
    "G99",
    "M0",
    "M6T2",
    "M98P1",
    "M99",
    "M30\n",
    "I1",
    "R-1",
    "K9",
    "#1=",
    "[",
    "]",
    "O1",
    "X1e9",
    "Z-.0001",
    "F0",
    "S1",
    "L999999",
    "-",
    ".",
    "99999999999999999999",
    "\u{0}",
    "é",
];
const XML: &[&str] = &[
    "<",
    ">",
    "/>",
    "&",
    "&amp;",
    "&#x0;",
    "\"",
    "<![CDATA[",
    "<!--",
    "<!DOCTYPE a [<!ENTITY b \"c\">]>",
    "&b;",
    "<Object name=\"Job\">",
    "</Object>",
    "<Property name=\"Group\">",
    "</Property>",
    "<Link value=\"Job\"/>",
    "<Bool value=\"false\"/>",
    "<Float value=\"nan\"/>",
    "<Float value=\"1e999\"/>",
    "<Integer value=\"-1\" CustomEnum=\"true\"/>",
    "<Path file=\"Document.xml\"/>",
    "ObjectJob",
    "Base",
];
const PATH: &[&str] = &[
    "\n",
    "G0 Z5\n",
    "G1 X1 F1\n",
    "G2 I1 F1\n",
    "G81 X1 Y1 Z-1 R2 F1\n",
    "G84 X1 Y1 Z-1 R2 F1 S1\n",
    "G80\n",
    "G98\n",
    "G99\n",
    "(a)\n",
    "M0\n",
    "G4 P1\n",
    "G41 D1\n",
    "G40\n",
    "M3 S1\n",
    "1e999",
    "nan",
    "-",
    "X",
    " ; RetractMode:'G98'\n",
    "é",
    "\u{0}",
];
const JSON: &[&str] = &[
    "{",
    "}",
    "[",
    "]",
    ",",
    ":",
    "null",
    "true",
    "1e999",
    "-",
    "\"",
    "\"rapid\":[1,2,3]",
    "{\"line\":[1,2,3]},",
    "\"operations\":[",
    "\\ud800",
    "é",
    "{\"end\":true}\n",
    "\n",
    "\"path\":[",
    "\"points\":[[1,1,0]]",
    "\"kind\":\"deep\",",
    "\"step\":1e-300,",
];

/// An input to mutate.
enum Seed {
    Text(Format, Vec<u8>),
    /// Members of an archive.
    Archive(Vec<(String, Vec<u8>)>),
    /// The bytes of an archive, with its members still packed.
    Packed(Vec<u8>),
}

fn mutate(bytes: &mut Vec<u8>, pieces: &[&str], random: &mut Random) {
    for _ in 0..=random.below(5) {
        let at = random.below(bytes.len() + 1);
        match random.below(8) {
            0 if at < bytes.len() => _ = bytes.remove(at),
            1 => bytes.insert(at, random.number() as u8),
            2 | 3 => _ = bytes.splice(at..at, random.pick(pieces).bytes()),
            4 if at < bytes.len() => bytes[at] = random.number() as u8,
            5 => _ = bytes.drain(at..(at + random.below(60)).min(bytes.len())),
            6 => {
                // copies a part of the input to another position
                let from = random.below(bytes.len());
                let part = bytes[from..(from + random.below(200)).min(bytes.len())].to_vec();
                bytes.splice(at..at, part);
            }
            _ if random.once_in(8) => bytes.truncate(at),
            _ => {}
        }
    }
}

fn mutated(seeds: &[Seed], random: &mut Random) -> (Format, Vec<u8>) {
    match &seeds[random.below(seeds.len())] {
        Seed::Text(format, text) => {
            let pieces = match format {
                Format::Cl => CL,
                Format::Nc => NC,
                _ => JSON,
            };
            let mut text = text.clone();
            mutate(&mut text, pieces, random);
            (*format, text)
        }
        Seed::Packed(bytes) => {
            let mut bytes = bytes.clone();
            mutate(
                &mut bytes,
                &["PK\u{3}\u{4}", "PK\u{1}\u{2}", "PK\u{5}\u{6}", "Document.xml", "\u{0}\u{0}\u{0}\u{0}"],
                random,
            );
            (Format::Freecad, bytes)
        }
        Seed::Archive(members) => {
            let chosen = random.below(members.len());
            let mut zip = zip::ZipWriter::new(Cursor::new(Vec::new()));
            let stored = zip::write::SimpleFileOptions::default().compression_method(zip::CompressionMethod::Stored);
            for (i, (name, bytes)) in members.iter().enumerate() {
                let mut bytes = bytes.clone();
                // the chosen member is changed, and in half of the mutations the list of objects, too
                if i == chosen || i == 0 && random.once_in(2) {
                    mutate(&mut bytes, if i == 0 { XML } else { PATH }, random);
                }
                zip.start_file(name.as_str(), stored).expect("a member");
                zip.write_all(&bytes).expect("memory");
            }
            (Format::Freecad, zip.finish().expect("memory").into_inner())
        }
    }
}

/// Counts events, and stops reading an input that produces too many.
struct Count(u64);

/// Maximum number of events of one input: ten times as many events as the largest seed has.
const MOST: u64 = 200_000;

impl Sink for Count {
    fn event(&mut self, _: Event<'_>, _: Place) -> Flow {
        self.0 += 1;
        if self.0 < MOST { Flow::Continue(()) } else { Flow::Break(Stop::Enough) }
    }
}

/// Reads a job; `true`: it was read to its end.
fn read(format: Format, bytes: &[u8], assume: bool) -> bool {
    let mut job = Job::bytes(format, bytes);
    if assume {
        job.reading.units = Some(Units::Mm);
        job.reading.start = Some([0.0, 0.0, 50.0]);
        job.reading.feed = Some(100.0);
        job.reading.end = true;
    }
    match job.read(&mut Count(0)) {
        Ok(()) => true,
        Err(error) => {
            assert!(!error.to_string().is_empty());
            false
        }
    }
}

/// The inputs to mutate: samples and test data of the repository.
fn seeds(root: &Path) -> Vec<Seed> {
    let mut seeds = Vec::new();
    let mut files: Vec<PathBuf> = Vec::new();
    let mut folders: Vec<PathBuf> =
        ["samples", "tests/data/cl", "tests/data/freecad"].map(|folder| root.join(folder)).into();
    folders.push(root.join("tests/data/fusion.jsonl"));
    while let Some(folder) = folders.pop() {
        match fs::read_dir(&folder) {
            Ok(entries) => folders.extend(entries.flatten().map(|entry| entry.path())),
            Err(_) => files.push(folder),
        }
    }
    files.sort();
    for file in files {
        let name = file.to_string_lossy().into_owned();
        let bytes = fs::read(&file).expect("a seed");
        match Format::of_name(&name) {
            Some(Format::Freecad) => {
                seeds.push(Seed::Archive(members(&bytes)));
                seeds.push(Seed::Packed(bytes));
            }
            Some(format) if !name.contains("dump") => seeds.push(Seed::Text(format, bytes)),
            _ => {}
        }
    }
    seeds
}

/// The members: the list of objects first, then the paths. Geometry is left out.
fn members(bytes: &[u8]) -> Vec<(String, Vec<u8>)> {
    let mut zip = zip::ZipArchive::new(Cursor::new(bytes)).expect("an archive");
    let mut names: Vec<String> = zip.file_names().flatten().map(Into::into).collect();
    names.retain(|name| name == "Document.xml" || name.ends_with(".nc"));
    names.sort_by_key(|name| name != "Document.xml");
    let mut read = |name: &str| {
        let mut bytes = Vec::new();
        zip.by_name(name).expect("a member").read_to_end(&mut bytes).expect("its bytes");
        bytes
    };
    names.iter().map(|name| (name.clone(), read(name))).collect()
}

/// The peak memory of this process in megabytes, if the system reports it.
fn most_memory() -> Option<u64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.trim().trim_end_matches("kB").trim().parse::<u64>().ok().map(|kilobytes| kilobytes / 1024)
}

fn main() {
    let mut args = std::env::args().skip(1).map(|arg| arg.parse().expect("a number"));
    let (count, first): (u64, u64) = (args.next().unwrap_or(1_000_000), args.next().unwrap_or(0));
    let seeds = seeds(&Path::new(env!("CARGO_MANIFEST_DIR")).join(".."));
    assert!(seeds.len() > 100, "the seeds: {}", seeds.len());
    let start = Instant::now();
    let mut whole = 0;
    for seed in first..first + count {
        let (format, bytes) = mutated(&seeds, &mut Random::new(seed));
        match std::panic::catch_unwind(|| read(format, &bytes, seed % 2 == 0)) {
            Ok(read) => whole += u64::from(read),
            Err(_) => {
                eprintln!("mutation {seed}, {format:?}:\n{}", String::from_utf8_lossy(&bytes));
                std::process::exit(1);
            }
        }
        if seed % 500_000 == 499_999 {
            println!(
                "{} mutations, {:.0} s, {:?} MB at most",
                seed + 1 - first,
                start.elapsed().as_secs_f64(),
                most_memory()
            );
        }
    }
    let seconds = start.elapsed().as_secs_f64();
    let memory = most_memory().map_or(String::new(), |megabytes| format!(", {megabytes} MB at most"));
    println!("{count} mutations of {} jobs, no panic, {whole} read to their end{memory}, {seconds:.0} s", seeds.len());
}
