//! Computes a key for each line: lines with equal keys are equal.

use std::hash::{BuildHasher, Hash, Hasher};

use foldhash::quality::{FixedState, FoldHasher};

use super::ignore::Ignore;
use super::targets::Targets;
use crate::nc::{Kind, Token, tokens};

/// A hasher with the same results on every machine.
pub(super) fn hasher() -> FoldHasher<'static> {
    FixedState::with_seed(0).build_hasher()
}

/// The key of a line; `None` if all of the line is ignored.
///
/// The number of a block is compared if another block refers to it.
///
/// Two different lines have the same key with a chance of 1 in 2^64. A program has far fewer than 2^64 lines.
pub(super) fn key(line: &[u8], ignore: &Ignore, targets: &Targets) -> Option<u64> {
    let mut whole = hasher();
    let mut sum = 0u64;
    let (mut counts, mut has_blanks, mut leaves_out) = (false, false, false);
    let mut parts = tokens(line).peekable();
    while let Some(token) = parts.next() {
        let is_target = matches!(token.kind, Kind::Word(b'N', number) if targets.has(number.value));
        if !is_target && !is_seen(&token, ignore) {
            leaves_out |= !is_blank(&token);
            // the spaces after an ignored number are ignored as well
            while matches!(token.kind, Kind::Word(..)) && parts.next_if(|next| next.kind == Kind::Blank).is_some() {}
            continue;
        }
        // spaces before an ignored comment are ignored as well
        if token.kind == Kind::Blank && parts.peek().is_some_and(|next| !is_seen(next, ignore)) {
            continue;
        }
        counts |= !is_blank(&token);
        has_blanks |= is_blank(&token);
        let mut one = hasher();
        hash_token(&token, line, ignore, &mut one);
        // the expression after a letter belongs to the letter
        if matches!(token.kind, Kind::Letter(_)) {
            while let Some(next) = parts.next_if(is_value) {
                if is_seen(&next, ignore) {
                    hash_token(&next, line, ignore, &mut one);
                }
            }
        }
        let one = one.finish();
        if ignore.order { sum = sum.wrapping_add(one) } else { one.hash(&mut whole) }
    }
    // a line with nothing but an ignored comment is ignored, even if spaces are compared; an empty line is not
    (counts || has_blanks && !leaves_out).then(|| if ignore.order { sum } else { whole.finish() })
}

/// Whether a token is compared.
pub(super) fn is_seen(token: &Token, ignore: &Ignore) -> bool {
    match token.kind {
        Kind::Blank | Kind::LineEnd => !ignore.spaces,
        Kind::Comment | Kind::OpenComment | Kind::Remark => !ignore.comments,
        Kind::Word(b'N', _) => !ignore.numbers,
        _ => true,
    }
}

fn is_blank(token: &Token) -> bool {
    matches!(token.kind, Kind::Blank | Kind::LineEnd)
}

/// Whether a token may be part of the expression after a letter.
fn is_value(token: &Token) -> bool {
    matches!(token.kind, Kind::Symbol(_) | Kind::Number(_) | Kind::Name | Kind::Quoted | Kind::Blank)
}

fn hash_token(token: &Token, line: &[u8], ignore: &Ignore, hasher: &mut impl Hasher) {
    let text = &line[token.start..token.end];
    match token.kind {
        Kind::Word(letter, number) if ignore.format => {
            if ignore.case {
                letter.hash(hasher)
            } else {
                text[0].hash(hasher)
            }
            ignore.value(number).hash(hasher);
        }
        // in an expression, 5 and 5. are equal
        Kind::Number(number) if ignore.format => number.value.to_bits().hash(hasher),
        Kind::Comment | Kind::OpenComment | Kind::Remark => text.hash(hasher),
        _ => {
            for &byte in text {
                let is_blank = byte == b' ' || byte == b'\t';
                if is_blank && ignore.spaces {
                    continue;
                }
                if ignore.case { byte.to_ascii_uppercase().hash(hasher) } else { byte.hash(hasher) }
            }
            0xffu8.hash(hasher);
        }
    }
}
