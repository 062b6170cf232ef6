//! Characters of comments.

use crate::sema::Settings;

/// A character as a comment of the form can hold it.
pub fn in_comment(c: char, settings: &Settings) -> u8 {
    let close = &settings.comment[1];
    match if settings.upper_comments { c.to_ascii_uppercase() } else { c } {
        // a mark inside would end the comment early and let the rest move the machine
        '(' if close.contains(')') => b'[',
        ')' if close.contains(')') => b']',
        c if close.contains(c) && !c.is_alphanumeric() => b'_',
        '%' => b'_', // ends the program for many controls
        c @ ' '..='~' => c as u8,
        '\t' => b' ',
        _ => b'?',
    }
}
