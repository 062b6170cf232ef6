//! Classifies text by its resemblance to words of NC programs.

/// Does the text look like NC output, as `X[h]`, `<work>`, `M6`, `G0`? A comment does not.
pub fn looks_like_a_word(token: &str) -> bool {
    if (token.contains('[') && token.contains(']')) || (token.contains('<') && token.contains('>')) {
        return true;
    }
    looks_like_a_code(token)
}

/// Is the text a capital letter and a number, as `M6`, `X-1.5`?
pub fn looks_like_a_code(token: &str) -> bool {
    let Some(number) = token.strip_prefix(|c: char| c.is_ascii_uppercase() || c == '%') else { return false };
    number.bytes().all(|b| b.is_ascii_digit() || b"+-.".contains(&b)) && number.bytes().any(|b| b.is_ascii_digit())
}
