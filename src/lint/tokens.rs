//! What text looks like to somebody who knows NC programs.

/// `X[h]`, `<work>`, `M6`, `G0`: what NC output is made of. A remark is not.
pub fn looks_like_a_word(token: &str) -> bool {
    if (token.contains('[') && token.contains(']')) || (token.contains('<') && token.contains('>')) {
        return true;
    }
    looks_like_a_code(token)
}

/// A capital letter and a number: `M6`, `X-1.5`.
pub fn looks_like_a_code(token: &str) -> bool {
    let Some(number) = token.strip_prefix(|c: char| c.is_ascii_uppercase() || c == '%') else { return false };
    number.bytes().all(|b| b.is_ascii_digit() || b"+-.".contains(&b)) && number.bytes().any(|b| b.is_ascii_digit())
}
