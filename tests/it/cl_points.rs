//! Reads CL files with a second reader, which shares no code with `src/cl` and reads only points, holes and heights.
//! The programs for LinuxCNC must cut to the same points and drill the same holes, in the same order.
#![allow(clippy::unwrap_used, clippy::panic)]

use std::fs;
use std::path::{Path, PathBuf};

use postform::internals::cl::{Assumed, AssumedSpeed, Options, Report, read_cl};
use postform::internals::compile::compile;
use postform::internals::render::Renderer;
use postform::toolpath::{ReadError, Units};

use crate::support::{check, plain_post, root};

/// An action of the tool on the part.
#[derive(Clone, Copy, Debug)]
enum Item {
    /// A cut along a line or an arc to this point; true: an arc.
    Cut([f64; 3], bool),
    /// A rapid that turns compensation on or off. Some forms print it as a cut.
    Way([f64; 3]),
    /// A hole: its bottom, and the height at which the feed begins.
    Hole([f64; 3], f64),
}

/// Tolerance of a length: the last digit of the program.
const DIGIT: f64 = 2e-5;

fn same(a: f64, b: f64) -> bool {
    (a - b).abs() < DIGIT
}

fn same_point(a: [f64; 3], b: [f64; 3]) -> bool {
    (0..3).all(|i| same(a[i], b[i]))
}

/// The numbers after a word of a statement.
fn after(words: &[&str], word: &str) -> Option<f64> {
    let at = words.iter().position(|w| *w == word)?;
    words.get(at + 1)?.parse().ok()
}

/// A cycle: its depth below the point, and the height above the point at which the feed begins. For Autodesk's ISO post,
/// both are absolute heights.
#[derive(Clone, Copy)]
enum Cycle {
    Below(f64, f64),
    Bottoms(f64),
}

fn cycle(words: &[&str], autodesk: bool, camplete: bool) -> Cycle {
    let number = |at: usize| words.get(at).and_then(|word| word.parse::<f64>().ok());
    if autodesk {
        let unit = words.iter().position(|w| *w == "MMPM" || *w == "IPM").unwrap();
        return Cycle::Bottoms(number(unit + 2).unwrap() - after(words, "RAPTO").unwrap_or(0.0));
    }
    let depth = after(words, "DEPTH").or(after(words, "FEDTO").map(f64::abs)).or(number(1)).unwrap();
    // CLEAR of CAMplete is a height of the file
    let clear = after(words, "CLEAR").filter(|_| !camplete).or(after(words, "RAPTO")).or(number(2)).unwrap();
    Cycle::Below(depth, clear)
}

/// The actions that a CL file requests.
fn wanted(text: &str) -> Vec<Item> {
    let autodesk = text.starts_with("MODE/");
    let camplete = text.contains("MATRIX DEFINITION");
    // statements, without comments, with continued lines joined
    let mut statements = vec![String::new()];
    for line in text.lines() {
        let line: String = line.split("$$").next().unwrap().chars().filter(|c| !c.is_whitespace()).collect();
        let (part, goes_on) = line.split_once('$').map_or((line.as_str(), false), |(part, _)| (part, true));
        *statements.last_mut().unwrap() += &part.to_ascii_uppercase();
        if !goes_on {
            statements.push(String::new());
        }
    }
    let (mut items, mut at, mut rapid, mut arc, mut active) = (Vec::new(), [f64::NAN; 3], false, false, None);
    let mut turns = false;
    for statement in &statements {
        let words: Vec<&str> = statement.split(['/', ',', '(', ')']).filter(|word| !word.is_empty()).collect();
        let Some(major) = words.first() else { continue };
        let rest = &words[1..];
        let numbers: Vec<f64> = rest.iter().map_while(|word| word.parse().ok()).collect();
        match *major {
            "RAPID" => rapid = true,
            "CUTCOM" => turns = true,
            "FEDRAT" if active.is_none() => rapid = false,
            "CIRCLE" | "MOVARC" => arc = true,
            "CYCLE" if matches!(rest[0], "INIT" | "CLEAR") => {}
            "CYCLE" if rest[0] == "OFF" => (active, rapid) = (None, true),
            "CYCLE" => (active, rapid) = (Some(cycle(rest, autodesk, camplete)), false),
            "GOHOME" => (at, rapid) = ([numbers[0], numbers[1], numbers[2]], false),
            "TLON" => {
                let last: Vec<f64> = rest[rest.len() - 3..].iter().map(|word| word.parse().unwrap()).collect();
                at = [last[0], last[1], last[2]];
                items.push(Item::Cut(at, true));
            }
            "GOTO" => {
                let to = [numbers[0], numbers[1], numbers[2]];
                match active {
                    Some(Cycle::Below(depth, clear)) if !rapid => {
                        items.push(Item::Hole([to[0], to[1], to[2] - depth], to[2] + clear));
                    }
                    Some(Cycle::Bottoms(from)) if !rapid => items.push(Item::Hole(to, from)),
                    _ if !rapid && (arc || !same_point(at, to)) => items.push(Item::Cut(to, arc)),
                    _ if turns => items.push(Item::Way(to)),
                    _ => {}
                }
                turns &= arc || (same(at[0], to[0]) && same(at[1], to[1]));
                (at, rapid, arc) = (to, false, false);
            }
            _ => {}
        }
    }
    items
}

/// The actions of a program for LinuxCNC.
fn made(program: &str) -> Vec<Item> {
    let (mut items, mut at) = (Vec::new(), [f64::NAN; 3]);
    let (mut motion, mut from, mut bottom, mut initial, mut returns_high) = (0, 0.0, 0.0, f64::NAN, true);
    for line in program.lines() {
        let code: String = line.split('(').next().unwrap().chars().filter(|c| !c.is_whitespace()).collect();
        let letters: Vec<usize> = code.match_indices(|c: char| c.is_ascii_alphabetic()).map(|(at, _)| at).collect();
        let ends = letters.iter().skip(1).copied().chain([code.len()]);
        let one = |(start, end): (&usize, usize)| {
            (code.as_bytes()[*start] as char, code[start + 1..end].parse::<f64>().unwrap())
        };
        let words: Vec<(char, f64)> = letters.iter().zip(ends).map(one).collect();
        let word = |letter| words.iter().find(|(l, _)| *l == letter).map(|(_, value)| *value);
        let codes: Vec<i64> = words.iter().filter(|(l, _)| *l == 'G').map(|(_, v)| (v * 10.0).round() as i64).collect();
        if codes.contains(&530) {
            continue; // a move to a machine position
        }
        for code in &codes {
            match code {
                0 | 10 | 20 | 30 | 800 => motion = code / 10,
                730 | 740 | 810..=890 => {
                    if !(73..90).contains(&motion) || motion == 80 {
                        initial = at[2];
                    }
                    motion = code / 10;
                }
                980 | 990 => returns_high = *code == 980,
                _ => {}
            }
        }
        let axes = [word('X'), word('Y'), word('Z')];
        let turns = matches!(motion, 2 | 3) && ['I', 'J', 'K'].into_iter().any(|letter| word(letter).is_some());
        if axes.iter().all(Option::is_none) && !turns {
            continue;
        }
        if matches!(motion, 73 | 74 | 81..=89) {
            (from, bottom) = (word('R').unwrap_or(from), axes[2].unwrap_or(bottom));
            at = [axes[0].unwrap_or(at[0]), axes[1].unwrap_or(at[1]), from];
            items.push(Item::Hole([at[0], at[1], bottom], from));
            at[2] = if returns_high { initial.max(from) } else { from };
            continue;
        }
        for (value, axis) in at.iter_mut().zip(axes) {
            *value = axis.unwrap_or(*value);
        }
        match motion {
            1 => items.push(Item::Cut(at, false)),
            2 | 3 => items.push(Item::Cut(at, true)),
            _ => {}
        }
    }
    items
}

/// Checks that the program makes exactly the requested actions in order. An arc may be printed in parts, and a hole in
/// pecks.
fn assert_made(name: &str, wanted: &[Item], made: &[Item]) {
    let mut next = made.iter().peekable();
    for (n, want) in wanted.iter().enumerate() {
        if let Item::Way(to) = want {
            next.next_if(|made| matches!(made, Item::Cut(at, false) if same_point(*to, *at)));
            continue;
        }
        let found = next.by_ref().find(|made| match (want, made) {
            (Item::Cut(to, _), Item::Cut(at, _)) if same_point(*to, *at) => true,
            (Item::Hole(bottom, from), Item::Hole(at, began)) if same_point(*bottom, *at) && same(*from, *began) => {
                true
            }
            (Item::Hole(bottom, _), Item::Cut(at, _)) if same_point(*bottom, *at) => true,
            // a part of an arc, or a peck of a hole
            (Item::Cut(_, true), Item::Cut(_, true)) => false,
            (Item::Hole(bottom, _), Item::Cut(at, _)) if same(bottom[0], at[0]) && same(bottom[1], at[1]) => false,
            (want, made) => panic!("{name}: item {n} of the file is {want:?}, the program makes {made:?}"),
        });
        assert!(found.is_some(), "{name}: the program ends before item {n}, {want:?}");
    }
    if let Some(more) = next.next() {
        panic!("{name}: the program goes on with {more:?}");
    }
}

fn options(text: &str) -> Options {
    Options {
        units: (!text.contains("UNIT")).then_some(Units::Mm),
        tool: Some(Assumed::One(1.0)),
        speed: Some(AssumedSpeed { rpm: 900.0, ccw: false }),
        start: Some([0.0, 0.0, 50.0]),
        ..Options::default()
    }
}

fn program(text: &str, options: &Options) -> Result<String, ReadError> {
    // a form with all kinds of coolant
    let kinds = "CoolantKind through M7\nCoolantKind air M7\nCoolantKind high M8\n";
    let post = plain_post("linuxcnc.pf");
    let checked = check(&(kinds.to_owned() + &post));
    let form = compile(&checked.form);
    let mut renderer =
        Renderer::new(&form, postform::internals::render::Options { program: Some(1), ..Default::default() });
    read_cl(text.as_bytes(), options, &mut Report::default(), &mut renderer)?;
    Ok(String::from_utf8(renderer.text().clone()).unwrap())
}

fn files(folder: &Path) -> Vec<(String, String)> {
    let mut paths: Vec<PathBuf> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    let cl = ["apt", "aptsource", "ncl", "cls", "cldata", "as", "cl"];
    paths.retain(|path| path.extension().is_some_and(|e| cl.contains(&e.to_str().unwrap())));
    paths
        .into_iter()
        .map(|path| {
            let name = path.file_name().unwrap().to_string_lossy().into_owned();
            (name, fs::read_to_string(&path).unwrap())
        })
        .collect()
}

/// One file in the style of each system.
#[test]
fn programs_of_written_files_cut_and_drill_what_the_files_say() {
    let mut count = 0;
    for (name, text) in files(&root().join("tests/data/cl")) {
        if name.contains("turning") {
            continue;
        }
        let tools = Assumed::parse("EM12=1,DRILL_6=2").unwrap();
        let options = Options { tool: Some(tools), ..options(&text) };
        let program = program(&text, &options).unwrap_or_else(|error| panic!("{name}: {error:?}"));
        let wanted = wanted(&text);
        assert!(wanted.len() >= 4, "{name}: {wanted:?}");
        assert_made(&name, &wanted, &made(&program));
        count += 1;
    }
    assert_eq!(count, 8);
}

/// The comparison of this test finds each kind of fault: a wrong point, a wrong depth, a wrong clearance, a missing
/// item, or an additional item.
#[test]
fn the_judge_finds_each_kind_of_fault() {
    let text = fs::read_to_string(root().join("tests/data/cl/solidworks.apt")).unwrap();
    let right = program(&text, &options(&text)).unwrap();
    for (from, to) in
        [("X70.", "X70.001"), ("Z-12.5", "Z-12.6"), ("R3.", "R2."), ("X60.\n", "\n"), ("Y40.\n", "Y40.\nX70.\n")]
    {
        let wrong = right.replacen(from, to, 1);
        assert_ne!(wrong, right, "{from}");
        let judged = std::panic::catch_unwind(|| assert_made("", &wanted(&text), &made(&wrong)));
        assert!(judged.is_err(), "{from} -> {to} is not found");
    }
}

/// Compares the programs of real files with the second reader, if the files are next to the checkout.
#[test_with::path(../shared/data/cl)]
#[test]
fn programs_of_real_files_cut_and_drill_what_the_files_say() {
    let shared = root().join("../shared");
    let mut agree = Vec::new();
    for folder in ["data/cl", "findings/realfiles"] {
        for (name, text) in files(&shared.join(folder)) {
            match program(&text, &options(&text)) {
                Ok(program) => {
                    assert_made(&name, &wanted(&text), &made(&program));
                    agree.push(name);
                }
                Err(ReadError::Job(diag)) => eprintln!("{name}: {} {}", diag.code.name(), diag.message),
                Err(ReadError::Stopped) => panic!("a renderer takes all"),
                Err(ReadError::Io(error)) => panic!("{error}"),
            }
        }
    }
    assert!(agree.len() >= 22, "{agree:?}");
}
