//! Makes wrong programs from correct ones by one change.

use crate::random::Random;

/// The kinds of change, by name.
pub const KINDS: &[&str] = &[
    "digit",
    "sign",
    "point",
    "drop word",
    "double word",
    "drop block",
    "double block",
    "swap blocks",
    "G code",
    "M code",
    "register",
    "drop G80",
    "plane G98 G99",
    "offset",
    "insert M",
    "insert G",
    "value",
    "move block",
];

/// Blocks that have an effect at every position: before the first cut, between cuts, and inside a hole.
const INSERTED: &[&str] = &[
    "G91",
    "G90",
    "G92 X0",
    "G92 Z5.",
    "G92 X1. Y1. Z1.",
    "G52 X1.",
    "G52 X0 Y0 Z0",
    "G4 P500",
    "G4 P5.",
    "M0",
    "M1",
    "M5",
    "M3",
    "M4",
    "M9",
    "M8",
    "M19",
    "G10 L2 P1 X1.",
    "G68 X0 Y0 R10.",
    "G51 X0 Y0 Z0 P2",
    "G28 Z0",
    "G91 G28 Z0",
    "G53 Z0",
    "G0 G53 Z0",
    "G49",
    "G43 H3",
    "G54",
    "G55",
    "G80",
    "G98",
    "G99",
    "G18",
    "G17",
    "G41 D1",
    "G40",
    "G20",
    "G21",
    "G95",
    "G93",
    "S100",
    "F1.",
    "T4",
    "T4 M6",
    "Z1.",
    "X0",
    "G0 Z-1.",
    "G1 Z-1.",
    "#1=5",
    "M98 P9",
    "M30",
];

/// A program with one change.
pub struct Mutant {
    /// The text of the program.
    pub text: String,
    /// The kind of change.
    pub kind: &'static str,
    /// The change in words.
    pub what: String,
}

/// The location and letter of a word in a line.
struct At {
    from: usize,
    to: usize,
    letter: u8,
}

/// Inserts a block into a program at a random position.
pub fn with_block(program: &str, random: &mut Random) -> Option<Mutant> {
    let block = random.pick(INSERTED);
    let mut lines: Vec<&str> = program.lines().collect();
    let at = 1 + random.below(lines.len().saturating_sub(1));
    let before = *lines.get(at)?;
    lines.insert(at, block);
    Some(Mutant {
        text: lines.join("\n") + "\n",
        kind: block,
        what: format!("line {}: {block} before {before}", at + 1),
    })
}

/// Changes a program in one place; `None` if the chosen change can't be applied.
pub fn mutant(program: &str, random: &mut Random) -> Option<Mutant> {
    let kind = random.pick(KINDS);
    let mut lines: Vec<String> = program.lines().map(str::to_owned).collect();
    // in the middle of the program, where most blocks are
    let at = (0..20).map(|_| random.below(lines.len())).find(|&at| !words(&lines[at]).is_empty())?;
    let before = lines[at].clone();
    match kind {
        "drop block" => _ = lines.remove(at),
        "double block" => lines.insert(at, before.clone()),
        "swap blocks" => {
            let next = (at + 1..lines.len()).find(|&next| !words(&lines[next]).is_empty())?;
            lines.swap(at, next);
        }
        "move block" => {
            let line = lines.remove(at);
            let to = (at + 1 + random.below(6)).min(lines.len().saturating_sub(1));
            lines.insert(to, line);
        }
        "insert M" => {
            let code = random.pick(&["M0", "M1", "M3", "M4", "M5", "M8", "M9", "M7", "M30", "M19"]);
            lines.insert(at, code.to_owned());
        }
        "insert G" => {
            let code = random.pick(&[
                "G0", "G1", "G80", "G90", "G91", "G49", "G40", "G55", "G18", "G98", "G99", "G4 P100", "G20", "G21",
                "G95", "G93",
            ]);
            lines.insert(at, code.to_owned());
        }
        "drop G80" => {
            let with: Vec<usize> = (0..lines.len()).filter(|&at| lines[at].contains("G80") && at > 3).collect();
            let at = *with.get(random.below(with.len()))?;
            lines.remove(at);
        }
        _ => lines[at] = in_line(&before, kind, random)?,
    }
    let text = lines.join("\n") + "\n";
    if text == program {
        return None;
    }
    let after = lines.get(at).cloned().unwrap_or_default();
    Some(Mutant { text, kind, what: format!("line {}: {before} -> {after}", at + 1) })
}

/// The words of a line outside comments; a block number does not count.
fn words(line: &str) -> Vec<At> {
    let bytes = line.as_bytes();
    let mut list = Vec::new();
    let mut at = 0;
    while at < bytes.len() {
        match bytes[at] {
            b'(' => at = line[at..].find(')').map_or(bytes.len(), |end| at + end + 1),
            b';' | b'%' => break,
            letter if letter.is_ascii_alphabetic() => {
                let from = at;
                at += 1;
                while at < bytes.len() && (bytes[at].is_ascii_digit() || b"+-.".contains(&bytes[at])) {
                    at += 1;
                }
                if !b"NO".contains(&letter) && at > from + 1 {
                    list.push(At { from, to: at, letter });
                }
            }
            _ => at += 1,
        }
    }
    list
}

fn in_line(line: &str, kind: &str, random: &mut Random) -> Option<String> {
    let all = words(line);
    let wanted = |letter: u8| match kind {
        "G code" => letter == b'G',
        "M code" => letter == b'M',
        "register" => b"HDTE".contains(&letter),
        "offset" | "plane G98 G99" => letter == b'G',
        "sign" | "point" => !b"GMTHDNE".contains(&letter),
        "value" => !b"GM".contains(&letter),
        _ => true,
    };
    let fits: Vec<&At> = all.iter().filter(|at| wanted(at.letter)).collect();
    let word = fits.get(random.below(fits.len()))?;
    let (before, text, after) = (&line[..word.from], &line[word.from..word.to], &line[word.to..]);
    let number = &text[1..];
    let letter = char::from(word.letter);
    let changed = match kind {
        "digit" => {
            let digits: Vec<usize> = (1..text.len()).filter(|&at| text.as_bytes()[at].is_ascii_digit()).collect();
            let at = *digits.get(random.below(digits.len()))?;
            let mut bytes = text.as_bytes().to_vec();
            bytes[at] = b'0' + (bytes[at] - b'0' + 1 + random.below(9) as u8) % 10;
            String::from_utf8(bytes).ok()?
        }
        "sign" => match number.strip_prefix('-') {
            Some(rest) => format!("{letter}{rest}"),
            None => format!("{letter}-{}", number.trim_start_matches('+')),
        },
        "point" => {
            let point = text.find('.')?;
            let bare = text.replace('.', "");
            match random.below(3) {
                0 => bare,
                1 if point + 1 < text.len() => format!("{}.{}", &bare[..point + 1], &bare[point + 1..]),
                _ if point > 1 && text.as_bytes()[point - 1].is_ascii_digit() => {
                    format!("{}.{}", &bare[..point - 1], &bare[point - 1..])
                }
                _ => bare,
            }
        }
        "drop word" => String::new(),
        "double word" => format!("{text} {text}"),
        "G code" => format!(
            "G{}",
            random.pick(&[
                "0", "1", "2", "3", "17", "18", "19", "20", "21", "40", "41", "42", "43", "44", "49", "54", "55", "73",
                "74", "76", "80", "81", "82", "83", "84", "85", "86", "87", "89", "90", "91", "93", "94", "95", "98",
                "99", "28", "53", "92", "4", "10", "52", "68", "51"
            ])
        ),
        "M code" => format!(
            "M{}",
            random.pick(&["0", "1", "2", "3", "4", "5", "6", "7", "8", "9", "19", "30", "48", "98", "99"])
        ),
        "register" => format!("{letter}{}", random.below(8)),
        "offset" => match number.parse::<f64>() {
            Ok(54.0..60.0) => format!("G{}", 54 + random.below(6)),
            _ => return None,
        },
        "plane G98 G99" => match number {
            "98" => "G99".into(),
            "99" => "G98".into(),
            _ => return None,
        },
        _ => {
            let value: f64 = number.parse().ok()?;
            let other = match random.below(6) {
                0 => value * 10.0,
                1 => value / 10.0,
                2 => value + 1.0,
                3 => -value,
                4 => value * 1.02,
                _ => value + random.between(-0.5, 0.5),
            };
            let whole = !number.contains('.');
            match whole {
                true => format!("{letter}{}", other.round()),
                false => {
                    let text = format!("{:.4}", other);
                    format!("{letter}{}", text.trim_end_matches('0'))
                }
            }
        }
    };
    Some(format!("{before}{changed}{after}"))
}
