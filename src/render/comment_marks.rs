//! Characters of comments.

use crate::sema::Settings;

/// Converts a character so that a comment can contain it. `in_brackets`: the comment is in round brackets, even if the form's own
/// comments have other marks.
pub fn in_comment(c: char, in_brackets: bool, settings: &Settings) -> u8 {
    let close = &settings.comment[1];
    let in_brackets = in_brackets || close.contains(')');
    match if settings.upper_comments { c.to_ascii_uppercase() } else { c } {
        // a closing mark inside the comment would end it early, and the control would execute the rest
        '(' if in_brackets => b'[',
        ')' if in_brackets => b']',
        c if close.contains(c) && !c.is_alphanumeric() => b'_',
        '%' => b'_', // `%` ends the program on many controls
        c @ ' '..='~' => c as u8,
        '\t' => b' ',
        _ => b'?',
    }
}
