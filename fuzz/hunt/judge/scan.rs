//! Splits blocks into words.

/// A word: its letter, and its number.
pub type Word = (u8, f64);

/// The words of a block without its block number; an O word is kept.
///
/// # Errors
/// Text that is no word.
pub fn words(line: &str) -> Result<Vec<Word>, String> {
    let mut list = Vec::new();
    let bytes = line.as_bytes();
    let mut at = 0;
    while at < bytes.len() {
        let byte = bytes[at].to_ascii_uppercase();
        at += 1;
        match byte {
            b'(' => at = line[at..].find(')').map_or(bytes.len(), |end| at + end + 1),
            b';' | b'%' => break,
            b' ' | b'\t' | b'\r' | b'/' => {}
            b'A'..=b'Z' => {
                let from = at;
                while at < bytes.len() && (bytes[at].is_ascii_digit() || b"+-.".contains(&bytes[at])) {
                    at += 1;
                }
                let text = &line[from..at];
                let number = text.parse::<f64>().map_err(|_| format!("the word {}{text}", char::from(byte)))?;
                if byte != b'N' {
                    list.push((byte, number));
                }
            }
            other => return Err(format!("the character {:?}", char::from(other))),
        }
    }
    Ok(list)
}
