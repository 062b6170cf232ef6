//! Text from files, made safe for a terminal.

/// Whether a character controls the terminal or the text direction instead of being visible. These characters are C0
/// and C1, the marks of bidirectional text, and the separators of lines and paragraphs.
pub fn steers(c: char) -> bool {
    c.is_control()
        || matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// Whether a character is invisible or looks like a space.
pub fn is_invisible(c: char) -> bool {
    steers(c) || (c.is_whitespace() && c != ' ') || ('\u{200b}'..='\u{200f}').contains(&c) || c == '\u{feff}'
}

/// Makes text from a file safe for a terminal: replaces control characters by escapes.
pub fn escaped(text: &str) -> String {
    with_escapes(text, steers)
}

/// Text from a file in which all characters can be seen: control characters and other invisible characters become escapes.
pub fn visible(text: &str) -> String {
    with_escapes(text, is_invisible)
}

fn with_escapes(text: &str, escapes: impl Fn(char) -> bool) -> String {
    // most text is plain ASCII
    if text.bytes().all(|byte| matches!(byte, b' '..=b'~')) {
        return text.to_owned();
    }
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        if escapes(c) { out.extend(c.escape_default()) } else { out.push(c) }
    }
    out
}

/// Text for HTML, XML or SVG: the characters of markup become entities. Control characters are not changed.
pub fn without_markup(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out += "&amp;",
            '<' => out += "&lt;",
            '>' => out += "&gt;",
            '"' => out += "&quot;",
            c => out.push(c),
        }
    }
    out
}

/// Text of several lines made safe for a terminal; line ends are kept.
pub fn escaped_lines(text: &str) -> String {
    text.split('\n').map(escaped).collect::<Vec<_>>().join("\n")
}
