//! Work offsets and their names, such as `G54`, `G59.1`, `G54.1 P3`, `G154 P3`, `G505` or `H2`.

use crate::control::{Code, Control, Meaning, WorkOffset};

/// The names of the first nine offsets, in their order.
const USUAL: [&str; 9] = ["G54", "G55", "G56", "G57", "G58", "G59", "G59.1", "G59.2", "G59.3"];

/// The codes of these offsets that have a number after the point, such as G59.1, in tenths.
const USUAL_PARTS: [u16; 4] = [541, 591, 592, 593];

/// Maximum number of additional offsets.
const ADDITIONAL: usize = WorkOffset::MOST as usize;

/// The number of the offset with this name on this control: G54 is 1, and the first additional offset is 10. If the
/// control numbers its offsets, the number of the control is used. `None`: the control has no such offset.
pub fn number(control: &Control, text: &str) -> Option<usize> {
    let text = text.split_ascii_whitespace().collect::<Vec<_>>().join(" ").to_ascii_uppercase();
    (1..=USUAL.len() + ADDITIONAL).find(|number| names(control, *number).contains(&text))
}

/// The name of an offset in programs for this control.
pub fn name(control: &Control, number: usize) -> String {
    names(control, number).swap_remove(0)
}

/// All names of an offset. The most common name is first.
fn names(control: &Control, number: usize) -> Vec<String> {
    if let Some(letter) = counted(control) {
        return vec![format!("{}{number}", char::from(letter))];
    }
    let additional = number.saturating_sub(USUAL.len());
    let mut names = Vec::new();
    let codes = (0..6000).step_by(10).chain(USUAL_PARTS).map(|tenths| Code { letter: b'G', tenths });
    for row in codes.filter_map(|code| control.row(code).filter(|row| row.meaning == Meaning::Work)) {
        match row.runs.work {
            Some(own @ WorkOffset::Usual(_)) if own.usual() == Some(number) => names.push(row.code.to_string()),
            Some(WorkOffset::Word(letter)) if additional > 0 => {
                names.push(format!("{} {}{additional}", row.code, char::from(letter)));
            }
            Some(WorkOffset::Additional(own)) if usize::from(own) == additional => names.push(row.code.to_string()),
            _ => {}
        }
    }
    // the name on this control comes first, the name on other controls last
    names.sort_by_key(|name| name.starts_with("G54.1 "));
    if names.is_empty() {
        names.push(USUAL.get(number.wrapping_sub(1)).map_or(format!("G54.1 P{additional}"), |name| (*name).to_owned()));
    }
    names
}

/// The letter with which the control selects an offset by its number: E on a FADAL, H on an Okuma. `None`: the control
/// selects offsets by codes.
fn counted(control: &Control) -> Option<u8> {
    let by_code = || {
        control.rows().find_map(|row| match row.runs.work? {
            WorkOffset::Counted(letter) => Some(letter),
            _ => None,
        })
    };
    control.traits().work_letter.or_else(by_code)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_offset_has_the_name_of_its_control() {
        let table = [
            ("fanuc", "G54", 1),
            ("fanuc", "g54.1  p3", 12),
            ("haas", "G154 P3", 12),
            ("haas", "G111", 11),
            ("linuxcnc", "G59.3", 9),
            ("siemens", "G505", 5),
            ("okuma", "H2", 2),
            ("fadal", "E4", 4),
        ];
        for (control, text, expected) in table {
            let control = Control::named(control).unwrap();
            assert_eq!(number(control, text), Some(expected), "{text}");
        }
        let haas = Control::named("haas").unwrap();
        assert_eq!(name(haas, 1), "G54");
        assert_eq!(number(haas, &name(haas, 60)), Some(60));
        assert_eq!(number(haas, "G99"), None);
    }
}
