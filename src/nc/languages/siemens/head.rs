//! How a line begins: its number, its label, its first word; and what a word opens or ends.

use super::super::cursor::Cursor;

/// Words that open a part, and what ends it.
pub const PARTS: [(&str, &str); 5] =
    [("IF", "ENDIF"), ("WHILE", "ENDWHILE"), ("FOR", "ENDFOR"), ("LOOP", "ENDLOOP"), ("REPEAT", "UNTIL")];

/// The beginning of a line.
#[derive(Default)]
pub struct Head {
    /// `N100`, as a label.
    pub number: Option<String>,
    pub label: Option<String>,
    /// The first word behind them, in capital letters.
    pub word: String,
    /// Where the statement begins.
    pub start: usize,
}

/// Without its comment, and where that is.
pub fn without_comment(line: &[u8]) -> (&[u8], Option<(usize, usize)>) {
    let mut quoted = false;
    for (at, byte) in line.iter().enumerate() {
        match byte {
            b'"' => quoted = !quoted,
            b';' if !quoted => return (&line[..at], Some((at + 1, line.trim_ascii_end().len()))),
            _ => {}
        }
    }
    (line, None)
}

/// Reads the beginning of a line.
pub fn head(line: &[u8]) -> Head {
    let (line, _) = without_comment(line);
    let mut head = Head::default();
    let mut cursor = Cursor::new(line, 0);
    while cursor.peek() == Some(b'/') {
        cursor.takes(b"/");
        if cursor.peek().is_some_and(|byte| byte.is_ascii_digit()) {
            cursor.unsigned();
        }
    }
    let is_number = |text: &[u8]| text.len() > 1 && matches!(text[0], b'N' | b'n' | b':') && text[1].is_ascii_digit();
    if is_number(cursor.rest()) {
        let begin = cursor.at();
        cursor.takes(&line[begin..=begin]);
        let number = cursor.unsigned().unwrap_or(0.0);
        head.number = Some(format!("N{number}"));
    }
    head.start = cursor.at();
    if let Some(name) = cursor.name() {
        let name = String::from_utf8_lossy(name).to_ascii_uppercase();
        if cursor.peek() == Some(b':') && cursor.rest().get(1) != Some(&b'=') {
            cursor.takes(b":");
            head.label = Some(name);
            head.start = cursor.at();
            head.word =
                cursor.name().map(|word| String::from_utf8_lossy(word).to_ascii_uppercase()).unwrap_or_default();
        } else {
            head.word = name;
        }
    }
    head
}

/// The name of a section that the line begins: `%_N_NAME_SPF`, `PROC NAME`.
pub fn section(line: &[u8]) -> Option<String> {
    let text = line.trim_ascii();
    let name = if let Some(name) = text.strip_prefix(b"%_N_") {
        let name = String::from_utf8_lossy(name).to_ascii_uppercase();
        let name = name.strip_suffix("_SPF").or(name.strip_suffix("_MPF")).unwrap_or(&name).to_owned();
        return Some(name);
    } else {
        let head = head(line);
        if head.word != "PROC" {
            return None;
        }
        let mut cursor = Cursor::new(line, head.start);
        cursor.name();
        cursor.name()?
    };
    Some(String::from_utf8_lossy(name).to_ascii_uppercase())
}

/// Does the line open a part, and which?
pub fn opens(head: &Head, line: &[u8]) -> Option<usize> {
    let at = PARTS.iter().position(|(open, _)| *open == head.word)?;
    let rest = String::from_utf8_lossy(without_comment(line).0).to_ascii_uppercase();
    match head.word.as_str() {
        "IF" if rest.contains("GOTO") => None,
        // `REPEAT LABEL P=3` repeats what stands before it
        "REPEAT" if rest[head.start.min(rest.len())..].trim() != "REPEAT" => None,
        _ => Some(at),
    }
}
