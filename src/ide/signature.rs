//! Shows the arguments of a command while the user writes it.

use super::Document;
use crate::explain;
use crate::lang::{Args, CommandId};

/// The arguments of a command.
#[derive(Clone, Debug, PartialEq)]
pub struct Signature {
    /// The command with its arguments, such as `Coolant on off mist`.
    pub label: String,
    /// The arguments in their order, as byte ranges of `label`.
    pub words: Vec<(usize, usize)>,
    /// Index of the argument that the user is writing, from 0.
    pub active: usize,
    /// Description of the command.
    pub meaning: String,
}

impl Document {
    /// The command on the line at a byte, and the argument that the user is writing. `None`: the line is not a command, or
    /// the user is still writing its name.
    pub fn signature(&self, file: u32, offset: u32) -> Option<Signature> {
        let (start, before) = self.line_before(file, offset)?;
        let inside = self.sequence_at(file, start).filter(|node| node.name.line.span.start < start);
        if inside.is_some_and(|node| node.end.as_ref().is_none_or(|end| end.line.span.end >= offset)) {
            return None;
        }
        let words: Vec<&str> = before.split([' ', '\t']).filter(|word| !word.is_empty()).collect();
        let (name, given) = words.split_first()?;
        let id = CommandId::parse(name)?;
        let fresh = before.ends_with([' ', '\t']);
        if given.is_empty() && !fresh {
            return None;
        }
        let row = id.row();
        let takes = explain::takes(row.args);
        let names = names(row.args, row.meaning, &takes);
        let active = given.len() - usize::from(!fresh);
        let mut label = row.name.to_owned();
        let mut places = Vec::new();
        for name in &names {
            label.push(' ');
            places.push((label.len(), label.len() + name.len()));
            label += name;
        }
        let meaning = format!("{}; takes {takes}", row.meaning);
        Some(Signature { label, active: active.min(places.len().saturating_sub(1)), words: places, meaning })
    }
}

/// The names of a command's arguments. The names come from the command's description, or otherwise from the text about
/// its arguments.
fn names(args: Args, meaning: &str, takes: &str) -> Vec<String> {
    let most = args.count().map_or(1, |(_, most)| most);
    let list = |text: &str, by: &str| text.split(by).map(|name| name.trim().to_owned()).collect::<Vec<_>>();
    let named = meaning.rsplit_once(": ").map(|(_, names)| list(names, ", "));
    let worded = || match args {
        Args::Words(..) => {
            let head = takes.split(", as ").next().unwrap_or(takes);
            [", ", " "].into_iter().map(|by| list(head, by)).find(|names| names.len() == most)
        }
        _ => None,
    };
    let numbered = || match (args, most) {
        (_, 1) => vec![takes.to_owned()],
        (Args::Codes(..) | Args::Motion(..), most) => (1..=most).map(|i| format!("code{i}")).collect(),
        (_, most) => (1..=most).map(|i| format!("word{i}")).collect(),
    };
    named.filter(|names| names.len() == most).or_else(worded).unwrap_or_else(numbered)
}

#[cfg(test)]
mod tests {
    use super::super::document::tests::haas;

    fn told(line: &str) -> Option<(String, String)> {
        let (document, offset) = haas("Dwell G4 P s", line);
        let signature = document.signature(0, offset)?;
        let (from, to) = signature.words[signature.active];
        Some((signature.label.clone(), signature.label[from..to].to_owned()))
    }

    #[test]
    fn the_word_that_is_written_is_named() {
        let is = |label: &str, word: &str| Some((label.to_owned(), word.to_owned()));
        assert_eq!(told("Coolant M8 |"), is("Coolant on off mist", "off"));
        assert_eq!(told("Coolant M8 M9 M|"), is("Coolant on off mist", "mist"));
        assert_eq!(told("Spindle |"), is("Spindle clockwise counter-clockwise off", "clockwise"));
        assert_eq!(told("Dwell G4 |"), is("Dwell code letter unit", "letter"));
        assert_eq!(told("ArcPlane G17 G|"), is("ArcPlane code1 code2 code3", "code2"));
        assert_eq!(
            told("Machine |"),
            is("Machine one of Mill, Lathe, EDM, Torch, Laser", "one of Mill, Lathe, EDM, Torch, Laser")
        );
        assert_eq!((told("Dwel|"), told("# Dwell |"), told("X->3.>4 |")), (None, None, None));
    }
}
