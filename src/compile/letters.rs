//! How a form prints words with each letter: the format of the number, the printed letter, the sign, and whether the
//! word may be left out.

use crate::number::{LetterFormat, Printing};
use crate::sema::{Form, Settings};

/// The kind of a letter. The kind determines when a word with this letter may be left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LetterKind {
    /// The position of an axis.
    Axis,
    /// G codes. The last code is remembered for each modal group separately.
    GCode,
    /// M codes. The last code is remembered for each modal group separately.
    MCode,
    /// Any other value.
    Other,
}

/// How one letter is printed.
#[derive(Clone, Copy, Debug)]
pub struct Letter {
    /// The format of numbers after this letter.
    pub format: LetterFormat,
    /// The format of numbers after this letter, prepared for printing.
    pub printing: Printing,
    /// Whether the form defines the format. `false`: the format is a built-in one.
    pub has_format: bool,
    /// The letter in the program, after `Rename`.
    pub printed: u8,
    /// Whether only the value is printed, without the letter (`Dummy`).
    pub dummy: bool,
    /// Whether the sign is reversed (`RevSigns`).
    pub reversed: bool,
    /// Whether motion blocks may leave out the word if its value did not change (`ModalLetters`).
    pub modal: bool,
    /// Kind of the letter.
    pub kind: LetterKind,
}

/// All letters by their ASCII code.
#[derive(Clone, Debug)]
pub struct LetterTable {
    rows: [Letter; 128],
    /// The format of a value without a letter.
    pub bare: LetterFormat,
    /// Packed words by their letters, each with the digits that are printed if `[tparams]` has no value.
    pub packed: Vec<(u8, String)>,
}

impl std::ops::Index<u8> for LetterTable {
    type Output = Letter;
    #[inline]
    fn index(&self, letter: u8) -> &Letter {
        &self.rows[usize::from(letter & 0x7f)]
    }
}

/// The built-in formats (docs/language.md, "Letter formats"): letters, the format in inches, the format in millimetres.
const BUILT_IN: &[(&[u8], &str, &str)] = &[
    (b"XYZUVWIJKRQABC", "->4.>4", "->5.>3"),
    (b"F", ">6.>4", ">6.>4"),
    (b"P", "->4~>4", "->4~>4"),
    (b"E", ">4~>6", ">4~>6"),
    (b"S", ">6", ">6"),
    (b"T", ">4", ">4"),
    (b"GM", ">3~>1", ">3~>1"),
    (b"HDOLN:", ">6", ">6"),
];

/// The format of all other letters, and of values without a letter.
const ANY: (&str, &str) = ("->6~>4", "->6~>4");

/// The format of values after a text, for languages that write values without letters in cycles. Cycles of these
/// languages add and multiply heights and pitches, so more decimals are needed.
const FINE: &str = "->6~>6";

impl LetterTable {
    /// The letters of a form. Letters without a format get a built-in format for inches or millimetres.
    pub fn new(form: &Form, metric: bool) -> LetterTable {
        let settings = &form.settings;
        let bare = LetterFormat::built_in(match settings.control().prints_codes() {
            false => FINE,
            true if metric => ANY.1,
            true => ANY.0,
        });
        let mut rows = [Letter {
            format: bare,
            printing: Printing::new(bare),
            has_format: false,
            printed: 0,
            dummy: false,
            reversed: false,
            modal: false,
            kind: LetterKind::Other,
        }; 128];
        let own = |letter: u8| form.formats.get(&letter).map(|(format, _)| *format);
        for (i, row) in rows.iter_mut().enumerate() {
            let letter = i as u8;
            let capital = letter.to_ascii_uppercase();
            let given = own(letter).or_else(|| own(capital));
            let built_in = BUILT_IN.iter().find(|(letters, ..)| letters.contains(&capital));
            row.has_format = given.is_some();
            row.format = given
                .or_else(|| built_in.map(|(_, inch, mm)| LetterFormat::built_in(if metric { mm } else { inch })))
                .unwrap_or(bare);
            row.printing = Printing::new(row.format);
            row.printed = settings.rename.iter().find(|(from, _)| *from == letter).map_or(letter, |&(_, to)| to);
            row.dummy = settings.dummy.contains(&letter);
            row.reversed = settings.rev_signs.contains(&letter);
            row.kind = kind(settings, row.printed);
            row.modal = settings.modality
                && match &settings.modal_letters {
                    Some(letters) => letters.contains(&letter),
                    None => {
                        row.kind == LetterKind::Axis || letter == settings.feed_code || letter == settings.speed_code
                    }
                };
        }
        let packed = form.packed.iter().map(|(&letter, digits)| (letter, digits.clone())).collect();
        LetterTable { rows, bare, packed }
    }
}

fn kind(settings: &Settings, letter: u8) -> LetterKind {
    match letter {
        b'G' | b'g' => LetterKind::GCode,
        b'M' | b'm' => LetterKind::MCode,
        _ if settings.axes.contains(&letter) || settings.axes2.contains(&letter) => LetterKind::Axis,
        b'X' | b'Y' | b'Z' | b'A' | b'B' | b'C' => LetterKind::Axis,
        _ => LetterKind::Other,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn built_in_formats_read() {
        for (letters, inch, mm) in BUILT_IN {
            assert!(LetterFormat::parse(inch).is_ok() && LetterFormat::parse(mm).is_ok(), "{letters:?}");
        }
        assert!(LetterFormat::parse(ANY.0).is_ok());
    }

    #[test]
    fn a_small_letter_takes_its_capitals_format() {
        let mut form = Form::default();
        form.formats.insert(b'Q', (LetterFormat::parse("->34").unwrap(), Default::default()));
        let table = LetterTable::new(&form, false);
        assert_eq!(table[b'q'].format, table[b'Q'].format);
        assert!(table[b'X'].modal && table[b'F'].modal && !table[b'I'].modal);
    }
}
