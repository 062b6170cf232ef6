//! Converts text to ASCII, because controls have only ASCII characters.

use std::borrow::Cow;

use any_ascii::any_ascii_char;

/// Characters for which a machinist expects another spelling than the ASCII character with the nearest shape.
#[rustfmt::skip]
const OWN: &[(char, &str)] = &[
    ('Ø', "D"), ('ø', "d"), ('⌀', "D"), ('Ä', "Ae"), ('Ö', "Oe"), ('Ü', "Ue"), ('ä', "ae"), ('ö', "oe"), ('ü', "ue"), ('ẞ', "SS"), ('°', " deg"),
    ('±', "+-"), ('×', "x"), ('µ', "u"), ('μ', "u"), ('∅', "D"),
];

/// Replacement for a character without an ASCII spelling.
const NONE: &str = "_";

/// Converts a text to ASCII: accents are removed, letters of other alphabets are spelt out, and no visible character is lost.
pub fn plain(text: &str) -> Cow<'_, str> {
    if text.is_ascii() {
        return Cow::Borrowed(text);
    }
    let mut spelt = String::with_capacity(text.len());
    for c in text.chars() {
        match OWN.iter().find(|(own, _)| *own == c) {
            Some((_, ascii)) => spelt.push_str(ascii),
            None if c.is_ascii() => spelt.push(c),
            None if is_mark(c) => {}
            None => spelt.push_str(Some(any_ascii_char(c)).filter(|ascii| !ascii.is_empty()).unwrap_or(NONE)),
        }
    }
    Cow::Owned(spelt)
}

/// Combining accents and invisible characters.
fn is_mark(c: char) -> bool {
    matches!(c, '\u{300}'..='\u{36f}' | '\u{200b}'..='\u{200f}' | '\u{feff}' | '\u{ad}' | '\u{fe00}'..='\u{fe0f}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_become_those_of_a_control() {
        for (text, ascii) in [
            ("Bohrung Ø5 – Maß ±0,1 90°", "Bohrung D5 - Mass +-0,1 90 deg"),
            ("Größe, ÄÖÜ, naïve, Łódź, Čeština, İstanbul", "Groesse, AeOeUe, naive, Lodz, Cestina, Istanbul"),
            ("e\u{301}t\u{e9} „Zitat“ ½ € 25 µm 6×7", "ete \"Zitat\" 1/2 EUR 25 um 6x7"),
            ("Отверстие 穴", "Otverstie Xue"),
            ("a\u{e000}b", "a_b"),
            ("plain", "plain"),
        ] {
            assert_eq!(plain(text), ascii);
        }
    }
}
