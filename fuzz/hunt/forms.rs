//! The forms that print the jobs: the forms that ship, and unusual ones.

use std::fs;
use std::path::Path;

use crate::prove::Form;
use crate::random::Random;

/// All forms, by name.
///
/// # Panics
/// A form can't be read; the list of forms is then wrong.
pub fn forms() -> Vec<Form> {
    let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."));
    let mut paths: Vec<_> = ["postforms", "tests/data/forms"]
        .iter()
        .flat_map(|folder| fs::read_dir(root.join(folder)).into_iter().flatten().flatten())
        .map(|entry| entry.path())
        .collect();
    paths.sort();
    let read = |path: &std::path::PathBuf| {
        let name = path.file_stem().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        let text = fs::read_to_string(path).unwrap_or_default();
        Form::read(&name, &text).unwrap_or_else(|error| panic!("{error}"))
    };
    paths.iter().map(read).collect()
}

/// A form with one typical mistake: a line or word is missing, doubled or misplaced, or a variable, digit or letter is
/// wrong. `None` if the form has nothing to which the chosen mistake applies.
pub fn changed(text: &str, random: &mut Random) -> Option<String> {
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    let is_code = |line: &String| !line.trim().is_empty() && !line.trim_start().starts_with('#');
    let at = (0..20).map(|_| random.below(lines.len())).find(|&at| is_code(&lines[at]))?;
    match random.below(8) {
        0 => _ = lines.remove(at),
        1 => lines.insert(at, lines[at].clone()),
        2 => {
            let next = (at + 1..lines.len()).find(|&next| is_code(&lines[next]))?;
            lines.swap(at, next);
        }
        3 => {
            let words: Vec<&str> = lines[at].split(' ').collect();
            let drop = random.below(words.len());
            let kept = words.iter().enumerate().filter(|(number, _)| *number != drop).map(|(_, word)| *word);
            lines[at] = kept.collect::<Vec<_>>().join(" ");
        }
        // replaces a variable by another one
        4 => {
            let names = variables(text);
            let own = variables(&lines[at]);
            let from = own.get(random.below(own.len()))?;
            lines[at] = lines[at].replacen(from.as_str(), &names[random.below(names.len())], 1);
        }
        // changes a digit
        5 => {
            let digits: Vec<usize> =
                lines[at].char_indices().filter(|(_, c)| c.is_ascii_digit()).map(|(place, _)| place).collect();
            let place = *digits.get(random.below(digits.len()))?;
            let digit = random.below(10).to_string();
            lines[at].replace_range(place..=place, &digit);
        }
        // changes the letter of a word
        6 => {
            let letters: Vec<usize> =
                lines[at].char_indices().filter(|(_, c)| c.is_ascii_uppercase()).map(|(place, _)| place).collect();
            let place = *letters.get(random.below(letters.len()))?;
            let letter = random.pick(&["X", "Y", "Z", "F", "S", "R", "Q", "P", "G", "M", "T", "H", "I", "J", "A"]);
            lines[at].replace_range(place..=place, letter);
        }
        // changes a sign of a format or an expression
        _ => {
            let signs: Vec<usize> =
                lines[at].char_indices().filter(|(_, c)| "*-+.<>".contains(*c)).map(|(place, _)| place).collect();
            let place = *signs.get(random.below(signs.len()))?;
            lines[at].remove(place);
        }
    }
    let other = lines.join("\n") + "\n";
    (other != text).then_some(other)
}

/// All names in brackets in a text, such as `[name]`.
fn variables(text: &str) -> Vec<String> {
    let mut names: Vec<String> =
        text.split('[').skip(1).filter_map(|rest| rest.split_once(']')).map(|(name, _)| format!("[{name}]")).collect();
    names.sort();
    names.dedup();
    names
}
