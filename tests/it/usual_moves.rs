//! Consecutive straight cuts are printed, run and compared by separate fast code, which must give the same result as
//! the general code. The tests make the same moves unusual by a change without effect, and compare both results.

use std::fs;
use std::io::Cursor;

use postform::internals::json::{read_document, read_lines};
use postform::internals::nc::{Action, Item, RunSettings, Simulator};
use postform::toolpath::{Event, Flow, Place, Sink};
use postform::{Job, NoFiles, Options, Post, Source};
use proptest::prelude::*;

use crate::support::{control, root};

/// A coordinate as in jobs: few digits, rounding ties, zero.
fn coordinate() -> impl Strategy<Value = String> {
    prop_oneof![
        4 => "-?[0-9]{1,3}\\.[0-9]{1,6}",
        2 => "-?[0-9]{1,2}",
        1 => "-?[0-9]\\.[0-9]{3,4}5",
        1 => Just("0".to_owned()),
    ]
}

/// The lines of a job: some axes, sometimes a feed.
fn moves() -> impl Strategy<Value = Vec<(Vec<String>, Option<u16>)>> {
    let one = (prop::collection::vec(coordinate(), 1..=3), prop::option::weighted(0.2, 1_u16..2000));
    prop::collection::vec(one, 1..40)
}

/// A number as JSON allows it, without unnecessary leading zeros.
fn number(text: &str) -> String {
    let (sign, digits) = text.strip_prefix('-').map_or(("", text), |digits| ("-", digits));
    let digits = digits.trim_start_matches('0');
    format!("{sign}{}{digits}", if digits.is_empty() || digits.starts_with('.') { "0" } else { "" })
}

/// A job of these moves. `fourth`: each position also has the angle 0.
fn job(moves: &[(Vec<String>, Option<u16>)], fourth: bool) -> String {
    let mut text = "{\"start\":{\"postform\":1,\"program\":1,\"units\":\"mm\",\"tools\":[{\"number\":1}]}}\n\
        {\"operation\":{\"tool\":1,\"work\":54,\"spindle\":{\"speed\":9000,\"direction\":\"cw\"},\"feed\":700}}\n"
        .to_owned();
    let angle = if fourth { ",0" } else { "" };
    text += &format!("{{\"rapid\":[0,0,5{angle}]}}\n{{\"line\":[0.5,0.5,-1{angle}]}}\n");
    let mut at = ["0.5".to_owned(), "0.5".into(), "-1".into()];
    for (to, feed) in moves {
        for (axis, value) in to.iter().enumerate() {
            at[axis] = number(value);
        }
        let feed = feed.map_or(String::new(), |feed| format!(",\"feed\":{feed}"));
        text += &format!("{{\"line\":[{}{angle}]{feed}}}\n", at.join(","));
    }
    text + "{\"end\":true}\n"
}

fn printed(form: &str, job: &str) -> Result<String, String> {
    let text = fs::read_to_string(root().join(format!("postforms/{form}.pf"))).unwrap();
    let post = Post::compile(Source::from_text(form, &text), &NoFiles).unwrap();
    let mut options = Options::default();
    options.proof = None;
    let program = post.render(Job::json_lines(job), &options);
    program.map(|program| program.text().to_owned()).map_err(|error| error.to_string())
}

/// The actions of a program without comments, and the refusals. A refused block is skipped.
fn actions(program: &str, name: &str) -> (Vec<Item>, Vec<String>) {
    let mut simulator = Simulator::new(Cursor::new(program.as_bytes()), RunSettings::new(control(name)));
    let (mut items, mut refused) = (Vec::new(), Vec::new());
    loop {
        match simulator.step(&mut items) {
            Ok(true) => {}
            Ok(false) => break,
            Err(error) => {
                refused.push(format!("{error:?}").replace(" (c)", ""));
                if !simulator.pass_over() {
                    break;
                }
            }
        }
    }
    items.retain(|item| !matches!(item.action, Action::Comment(..)));
    (items, refused)
}

/// Blocks that change the meaning of axis words, or come between two moves.
const MODES: [&str; 38] = [
    "G7",
    "G8",
    "G20",
    "G21",
    "G40",
    "G41 D1",
    "G52 X1. Y2.",
    "G54",
    "G55",
    "G80",
    "G81 X1. Y1. Z-1. R2.",
    "G90",
    "G91",
    "G92 X1.",
    "G93",
    "G94",
    "G95",
    "G17",
    "G18",
    "G0 Z9.",
    "G33 Z1. K1.",
    "G28 X0. Y0.",
    "G2 X1. Y1. R5.",
    "G43 H1",
    "G49",
    "G68 X0. Y0. R30.",
    "G69",
    "G10 L2 P1 X1.",
    "T1 M6",
    "M3 S100",
    "G4 P1.",
    "G96 S100",
    "G73 X1. Z-1. R1. Q1.",
    "G50 S900",
    "G98",
    "G99",
    "/X1.",
    "G53 G0 Z0.",
];

/// A block of axis words in the spellings of people and CAM systems.
fn block() -> impl Strategy<Value = String> {
    let value = prop_oneof![
        "-?[0-9]{1,3}\\.[0-9]{0,4}",
        "-?\\.[0-9]{1,8}",
        "[+-]?[0-9]{1,9}",
        "-?[0-9] [0-9]\\.5",
        "- [0-9]\\. 5",
        Just("0".to_owned()),
        Just(".".to_owned()),
    ];
    let letter = prop_oneof![8 => "[XYZ]", 1 => "[ABCF]", 1 => "[xyzIJKRUVW]"];
    let word = (letter, value).prop_map(|(letter, value)| format!("{letter}{value}"));
    let code = prop_oneof![
        6 => Just(""),
        2 => Just("G1 "),
        1 => Just("G0 "),
        1 => Just("G01 "),
        1 => Just("G1"),
        1 => Just("G91 "),
        1 => Just("G1 0 "),
        1 => Just("N5 "),
    ];
    let words = prop::collection::vec(word, 1..4);
    let moves = (code, words, prop::bool::ANY)
        .prop_map(|(code, words, apart)| format!("{code}{}", words.join(if apart { " " } else { "" })));
    let modes = prop::sample::select(MODES.to_vec()).prop_map(str::to_owned);
    prop_oneof![3 => moves, 1 => modes]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn a_block_with_a_comment_runs_like_one_without(
        blocks in prop::collection::vec(block(), 1..25),
        name in prop::sample::select(vec!["fanuc", "haas", "linuxcnc", "mach3", "fadal", "fanuc-lathe", "grbl"]),
    ) {
        let program = |end: &str| {
            let blocks: Vec<String> = blocks.iter().map(|block| format!("{block}{end}\n")).collect();
            format!("G21 G90 G94 F100.\nS1000 M3\nG1 X0. Y0. Z5.\n{}M30\n", blocks.concat())
        };
        prop_assert_eq!(actions(&program(""), name), actions(&program(" (c)"), name));
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    #[test]
    fn moves_with_a_fourth_axis_that_rests_print_like_those_without(
        moves in moves(),
        form in prop::sample::select(vec!["fanuc", "haas", "linuxcnc", "mach3", "centroid", "fadal"]),
    ) {
        let plain = printed(form, &job(&moves, false));
        let angled = printed(form, &job(&moves, true));
        // the cuts without block numbers
        let cuts = |text: String| -> Vec<String> {
            let words = |line: &str| line.split(' ').filter(|word| !word.starts_with('N')).collect::<Vec<_>>().join(" ");
            text.lines().map(words).skip_while(|line| !line.contains("G1 ")).collect()
        };
        prop_assert_eq!(plain.map(cuts), angled.map(cuts));
    }

    #[test]
    fn a_program_with_comments_is_proven_like_one_without(
        moves in moves(),
        wrong in prop::option::of((0_usize..2000, b'0'..=b'9')),
        between in prop::option::of((0_usize..40, prop::sample::select(MODES.to_vec()))),
    ) {
        let job = job(&moves, false);
        let text = fs::read_to_string(root().join("postforms/linuxcnc.pf")).unwrap();
        let post = Post::compile(Source::from_text("linuxcnc.pf", &text), &NoFiles).unwrap();
        let mut program = printed("linuxcnc", &job).unwrap().into_bytes();
        // changes one digit of a cut
        let cuts = program.windows(3).position(|text| text == b"G1 ").unwrap();
        let digits: Vec<usize> = (cuts..program.len()).filter(|&at| program[at].is_ascii_digit()).collect();
        if let Some((which, digit)) = wrong {
            program[digits[which % digits.len()]] = digit;
        }
        let mut program = String::from_utf8(program).unwrap();
        if let Some((which, block)) = between {
            let lines: Vec<usize> = program[cuts..].match_indices('\n').map(|(at, _)| cuts + at + 1).collect();
            program.insert_str(lines[which % lines.len()], &format!("{block}\n"));
        }
        let commented: String = program.lines().map(|line| match line.starts_with(['X', 'Y', 'Z']) {
            true => format!("{line} (c)\n"),
            false => format!("{line}\n"),
        }).collect();
        let verdict = |program: &str| post.verify(Job::json_lines(&job), program).unwrap();
        let shown = |verdict: postform::Verdict| format!("{verdict:?}").replace(" (c)", "");
        prop_assert_eq!(shown(verdict(&program)), shown(verdict(&commented)));
    }
}

/// The moves that a reader pushed, with their locations; and the end of the job.
#[derive(Default)]
struct Read(Vec<(String, Place)>);

impl Sink for Read {
    fn event(&mut self, event: Event<'_>, place: Place) -> Flow {
        self.0.push((format!("{event:?}"), place));
        Flow::Continue(())
    }
}

/// A document of these items, in one of three layouts.
fn document(items: &[String], layout: u8) -> String {
    let (line, deep) = match layout {
        0 => ("", ""),
        1 => ("\n  ", ""),
        _ => ("\n      ", "\n   "),
    };
    let items: Vec<String> =
        items.iter().map(|item| item.replace('[', &format!("[{deep}")).replace(',', &format!(",{deep}"))).collect();
    let path = items.join(&format!(",{line}"));
    format!(
        "{{\"postform\":1,\"units\":\"mm\",\"tools\":[{{\"number\":1}}],\"operations\":[{{\"tool\":1,\"feed\":7,\
         \"path\":[{line}{path}]}}]}}"
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    #[test]
    fn items_of_a_document_are_read_like_lines(
        moves in moves(),
        layout in 0_u8..3,
        longer in 0_usize..3,
        wrong in prop::option::of((0_usize..40, 0_usize..4)),
    ) {
        // more text than the reader keeps in memory at a time
        let moves: Vec<_> = moves.iter().cycle().take(moves.len() * [1, 20, 150][longer]).collect();
        let mut items: Vec<String> = moves
            .iter()
            .enumerate()
            .map(|(i, (to, feed))| {
                let to: Vec<String> = to.iter().map(|value| number(value)).collect();
                match feed {
                    Some(feed) if i % 5 == 0 => format!("{{\"feed\":{feed},\"line\":[{}]}}", to.join(",")),
                    Some(feed) => format!("{{\"line\":[{}],\"feed\":{feed}}}", to.join(",")),
                    None if i % 7 == 0 => format!("{{\"rapid\":[{}]}}", to.join(",")),
                    None => format!("{{\"line\":[{}]}}", to.join(",")),
                }
            })
            .collect();
        let wrong = wrong.map(|(at, kind)| (at % items.len(), kind));
        if let Some((at, kind)) = wrong {
            items[at] = ["{\"lien\":[1]}", "{\"line\":[1],\"feed\":0}", "{\"line\":[1.]}", "{\"line\":[1]"][kind].to_owned();
        }
        let head = "{\"start\":{\"postform\":1,\"units\":\"mm\",\"tools\":[{\"number\":1}]}}\n{\"operation\":{\"tool\":1,\"feed\":7}}\n";
        let lines = format!("{head}{}\n{{\"end\":true}}\n", items.join("\n"));
        let (mut by_lines, mut by_document) = (Read::default(), Read::default());
        let text = document(&items, layout);
        let read = read_lines(lines.as_bytes(), &mut by_lines);
        let again = read_document(text.as_bytes(), &mut by_document);
        prop_assert_eq!((read.is_err(), again.is_err()), (wrong.is_some(), wrong.is_some()));
        let moves = |read: &Read| -> Vec<(String, u64)> {
            let moves = read.0.iter().filter(|(event, _)| event.starts_with("Line") || event.starts_with("Rapid"));
            moves.map(|(event, place)| (event.clone(), place.item)).collect()
        };
        prop_assert_eq!(moves(&by_lines), moves(&by_document));
        // the location of each item is its beginning
        let at_line: Vec<&str> = text.lines().collect();
        for (event, place) in by_document.0.iter().filter(|(_, place)| place.item > 0) {
            let rest = &at_line[place.line as usize - 1][place.column as usize - 1..];
            prop_assert!(rest.starts_with('{'), "{event} at {place}: {rest}");
        }
        if let (Some((at, _)), Err(error)) = (wrong, again) {
            prop_assert!(format!("{error:?}").contains(&format!("path[{at}]")), "{error:?} for {at}");
        }
    }
}
