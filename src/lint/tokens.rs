//! Tests whether text looks like words of an NC program.

/// Whether the text looks like NC output, as `X[h]`, `<work>`, `M6` or `G0`, and not like a comment.
pub fn looks_like_a_word(token: &str) -> bool {
    if (token.contains('[') && token.contains(']')) || (token.contains('<') && token.contains('>')) {
        return true;
    }
    looks_like_a_code(token)
}

/// Whether the text is a capital letter (or `%`) and a number, as `M6` or `X-1.5`.
pub fn looks_like_a_code(token: &str) -> bool {
    let Some(number) = token.strip_prefix(|c: char| c.is_ascii_uppercase() || c == '%') else { return false };
    number.bytes().all(|b| b.is_ascii_digit() || b"+-.".contains(&b)) && number.bytes().any(|b| b.is_ascii_digit())
}
