//! Characters of comments.

use crate::sema::Settings;

/// A character as a comment of the form can hold it. `in_brackets`: the comment stands in round brackets, whatever marks the
/// form's own comments have.
pub fn in_comment(c: char, in_brackets: bool, settings: &Settings) -> u8 {
    let close = &settings.comment[1];
    let in_brackets = in_brackets || close.contains(')');
    match if settings.upper_comments { c.to_ascii_uppercase() } else { c } {
        // a mark inside would end the comment early and let the rest move the machine
        '(' if in_brackets => b'[',
        ')' if in_brackets => b']',
        c if close.contains(c) && !c.is_alphanumeric() => b'_',
        '%' => b'_', // ends the program for many controls
        c @ ' '..='~' => c as u8,
        '\t' => b' ',
        _ => b'?',
    }
}
