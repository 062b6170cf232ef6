//! Changes programs in one place.

use crate::random::Random;

/// A program with one change, the kind of the change, and the changed lines.
pub fn change(text: &str, random: &mut Random) -> Option<(String, (&'static str, String))> {
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    let end = lines.iter().position(|line| line.contains("M30"))?;
    let at = 3 + random.below(end.checked_sub(3)?);
    let before = lines[at].clone();
    let letters: Vec<usize> =
        before.char_indices().filter(|(_, c)| c.is_ascii_uppercase()).map(|(position, _)| position).collect();
    if before.starts_with('(') || letters.is_empty() {
        return None;
    }
    let position = letters[random.below(letters.len())];
    let next = letters.iter().copied().find(|&other| other > position).unwrap_or(before.len());
    let (letter, number) = (&before[position..=position], &before[position + 1..next]);
    let swap = |with: &str| format!("{}{with}{}", &before[..position], &before[next..]);
    let kind = match random.below(8) {
        0 => {
            lines.remove(at);
            return Some((lines.join("\n") + "\n", ("a block less", before)));
        }
        1 => {
            lines.insert(at, before.clone());
            return Some((lines.join("\n") + "\n", ("a block twice", before)));
        }
        2 => {
            lines[at] = swap("");
            "a word less"
        }
        3 => {
            let other = match letter {
                "X" => "U",
                "U" => "X",
                "Z" => "W",
                "W" => "Z",
                "I" => "K",
                "K" => "I",
                "R" if random.once_in(2) => "I",
                "R" => "K",
                "P" => "Q",
                "Q" => "P",
                _ => return None,
            };
            lines[at] = swap(&format!("{other}{number}"));
            "another letter"
        }
        4 => {
            let other = match number.strip_prefix('-') {
                Some(rest) => format!("{letter}{rest}"),
                None => format!("{letter}-{number}"),
            };
            lines[at] = swap(&other);
            "another sign"
        }
        5 if letter == "G" => {
            let codes = [
                "G0", "G1", "G2", "G3", "G32", "G90", "G92", "G94", "G96", "G97", "G98", "G99", "G71", "G72", "G40",
                "G41", "G42", "G54", "G55",
            ];
            lines[at] = swap(random.pick(&codes));
            "another code"
        }
        _ => {
            let mut digits: Vec<char> = number.chars().collect();
            let digits_at: Vec<usize> = (0..digits.len()).filter(|&n| digits[n].is_ascii_digit()).collect();
            let digit = *digits_at.get(random.below(digits_at.len()))?;
            digits[digit] = random.pick(&['0', '1', '2', '3', '4', '5', '6', '7', '8', '9']);
            lines[at] = swap(&format!("{letter}{}", digits.into_iter().collect::<String>()));
            "another digit"
        }
    };
    if lines[at] == before {
        return None;
    }
    let what = format!("{before} -> {}", lines[at]);
    Some((lines.join("\n") + "\n", (kind, what)))
}
