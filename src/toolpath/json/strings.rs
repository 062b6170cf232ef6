//! Limits the length of strings in a job. A string that is too long is refused before it is completely in memory.

use crate::diag::{Code, Diag};

/// The greatest length of a string, in bytes as written in the job.
pub const LONGEST: usize = 1 << 20;

/// Scans a JSON text and measures the length of its strings.
#[derive(Default)]
pub struct Strings {
    /// Number of bytes of the current string so far; `None` outside strings.
    open: Option<usize>,
    /// Whether the previous byte is a backslash.
    escaped: bool,
}

impl Strings {
    /// Processes the next bytes. Returns `false` if a string is too long.
    pub fn take(&mut self, bytes: &[u8]) -> bool {
        let mut from = 0;
        while from < bytes.len() {
            let Some(length) = &mut self.open else {
                let Some(quote) = memchr::memchr(b'"', &bytes[from..]) else { return true };
                self.open = Some(0);
                from += quote + 1;
                continue;
            };
            if std::mem::take(&mut self.escaped) {
                *length += 1;
                from += 1;
                continue;
            }
            let mark = memchr::memchr2(b'"', b'\\', &bytes[from..]);
            *length += mark.unwrap_or(bytes.len() - from);
            if *length > LONGEST {
                return false;
            }
            let Some(mark) = mark else { return true };
            from += mark + 1;
            if bytes[from - 1] == b'\\' {
                *length += 1;
                self.escaped = true;
            } else {
                self.open = None;
            }
        }
        true
    }
}

/// The finding for a string that is too long.
pub fn too_long() -> Diag {
    Diag::new(Code::PJ003, "a string of more than 1 MB")
        .help("shorten the string: names and comments are printed on one line")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strings_are_followed_over_all_borders() {
        // passes the text in chunks of this size
        let taken = |text: &str, parts: usize| {
            text.as_bytes().chunks(parts).all({
                let mut strings = Strings::default();
                move |part| strings.take(part)
            })
        };
        let long = "a".repeat(LONGEST);
        for parts in [1, 2, 3, 1000, usize::MAX] {
            assert!(taken(&format!("{{\"{long}\":[\"{long}\",\"\\\\\"],\"\\\"\":1}}"), parts));
            assert!(!taken(&format!("[\"\\\"\",\"{long}a\"]"), parts));
            assert!(!taken(&format!("\"{}\"", "\\\"".repeat(LONGEST / 2 + 1)), parts));
            // bytes outside of strings are not counted
            assert!(taken(&" ".repeat(2 * LONGEST), parts));
        }
    }
}
