//! Splits a line of an NC program into tokens. Every byte is part of a token; nothing is guessed.
//!
//! Spaces inside numbers, missing spaces between words, lower case and both comment styles are read as controls read
//! them. The scanner does not depend on the meaning of codes. A byte that no control can read becomes [`Kind::Unread`].

use super::digits::{Number, is_blank, signed, skip_blanks, unsigned};

/// One token of a line: bytes `start..end`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Token {
    /// Kind of the token.
    pub kind: Kind,
    /// First byte in the line.
    pub start: usize,
    /// The byte after the last byte of the token.
    pub end: usize,
}

/// Kinds of tokens. Letters are in upper case.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// Spaces and tabs.
    Blank,
    /// CR, LF or both.
    LineEnd,
    /// A word: a letter and its number, with the sign and the spaces between.
    Word(u8, Number),
    /// A letter whose value is the expression or parameter in the next tokens.
    Letter(u8),
    /// A number in an expression, without sign.
    Number(Number),
    /// Two or more letters, or any letters in an expression: `sub`, `SIN`, `GOTO`.
    Name,
    /// A name in angle brackets, `<name>`.
    Quoted,
    /// One of `# [ ] = + - * , ` and `/` in an expression; also `**`.
    Symbol(u8),
    /// A comment in brackets, `(...)`, with its closing bracket.
    Comment,
    /// A comment in brackets whose closing bracket is missing.
    OpenComment,
    /// A comment that begins with `;`, up to the end of the line.
    Remark,
    /// A `/` before a block, and the digit that may follow the `/`.
    Delete,
    /// A `%`, with the text after it.
    Percent,
    /// A byte that does not belong to any other token.
    Unread,
}

/// The tokens of one line. The line may include its line end.
#[derive(Clone, Debug)]
pub struct Tokens<'a> {
    line: &'a [u8],
    at: usize,
    /// Number of open square brackets.
    depth: u32,
    /// Whether a value must be next: true after `#`, `=` and operators.
    value: bool,
    /// Whether only spaces and a block delete have been read so far.
    fresh: bool,
}

/// The tokens of a line.
#[inline]
pub fn tokens(line: &[u8]) -> Tokens<'_> {
    Tokens { line, at: 0, depth: 0, value: false, fresh: true }
}

/// The tokens of a line from the byte `at` on, after a word.
pub(super) fn tokens_from(line: &[u8], at: usize) -> Tokens<'_> {
    Tokens { line, at, depth: 0, value: false, fresh: false }
}

impl Iterator for Tokens<'_> {
    type Item = Token;

    #[inline(always)]
    fn next(&mut self) -> Option<Token> {
        let start = self.at;
        let &byte = self.line.get(start)?;
        let kind = match byte {
            b'A'..=b'Z' | b'a'..=b'z' => self.letter(byte.to_ascii_uppercase()),
            b' ' | b'\t' => {
                self.at = start + 1;
                while self.line.get(self.at).is_some_and(|&b| is_blank(b)) {
                    self.at += 1;
                }
                return Some(Token { kind: Kind::Blank, start, end: self.at });
            }
            b'\n' => {
                self.at = start + 1;
                return Some(Token { kind: Kind::LineEnd, start, end: self.at });
            }
            _ => self.other(byte),
        };
        self.fresh = self.fresh && kind == Kind::Delete;
        Some(Token { kind, start, end: self.at })
    }
}

impl Tokens<'_> {
    /// Reads the next token if it is a letter with its number, except the O of a program. Returns the letter, the
    /// number and the first byte. Most tokens are words of this kind.
    #[inline(always)]
    pub(super) fn word(&mut self) -> Option<(u8, Number, usize)> {
        let start = self.at;
        let letter = self.line.get(start)?.to_ascii_uppercase();
        if !letter.is_ascii_uppercase() || letter == b'O' || self.depth > 0 || self.value {
            return None;
        }
        let (number, end) = signed(self.line, start + 1)?;
        (self.at, self.fresh) = (end, false);
        Some((letter, number, start))
    }

    /// Reads a token that begins with a letter: a word, a letter before an expression, or a name.
    #[inline(always)]
    fn letter(&mut self, letter: u8) -> Kind {
        let next = self.at + 1;
        if self.depth == 0 && !self.value {
            if let Some((number, end)) = signed(self.line, next) {
                self.at = end;
                return Kind::Word(letter, number);
            }
            if !self.line.get(next).is_some_and(u8::is_ascii_alphabetic) {
                self.at = next;
                return Kind::Letter(letter);
            }
        }
        let start = self.at;
        self.at = next + self.line[next..].iter().take_while(|b| b.is_ascii_alphabetic()).count();
        // a value follows these operators, also outside brackets
        let name = &self.line[start..self.at];
        self.value = ["AND", "OR", "XOR", "MOD"].iter().any(|own| own.as_bytes().eq_ignore_ascii_case(name));
        Kind::Name
    }

    #[cold]
    fn other(&mut self, byte: u8) -> Kind {
        let rest = &self.line[self.at + 1..];
        let (kind, len) = match byte {
            b'\r' if rest.first() == Some(&b'\n') => (Kind::LineEnd, 2),
            b'\r' => (Kind::LineEnd, 1),
            b'0'..=b'9' | b'.' => match unsigned(self.line, self.at) {
                Some((number, end)) if self.value || self.depth > 0 => {
                    self.value = false;
                    (Kind::Number(number), end - self.at)
                }
                _ => (Kind::Unread, 1),
            },
            b'(' => match memchr::memchr(b')', rest) {
                Some(end) => (Kind::Comment, end + 2),
                None => (Kind::OpenComment, 1 + self.to_line_end()),
            },
            b';' => (Kind::Remark, 1 + self.to_line_end()),
            b'%' if self.fresh => (Kind::Percent, 1 + self.to_line_end()),
            b'/' if self.fresh => (Kind::Delete, 1 + usize::from(rest.first().is_some_and(u8::is_ascii_digit))),
            b'<' => match memchr::memchr(b'>', rest) {
                Some(end) => {
                    self.value = false;
                    (Kind::Quoted, end + 2)
                }
                None => (Kind::Unread, 1),
            },
            b'[' | b']' => {
                self.depth = if byte == b'[' { self.depth + 1 } else { self.depth.saturating_sub(1) };
                self.value = false;
                (Kind::Symbol(byte), 1)
            }
            b'*' if rest.first() == Some(&b'*') => (Kind::Symbol(byte), 2),
            b'#' | b'=' | b'+' | b'-' | b'*' | b'/' | b',' => {
                self.value = true;
                (Kind::Symbol(byte), 1)
            }
            // polar coordinates, a spindle number, and `:`, which may begin a program number
            b'@' | b'^' | b'$' | b':' => match signed(self.line, self.at + 1) {
                Some((number, end)) => (Kind::Word(byte, number), end - self.at),
                None => (Kind::Letter(byte), 1),
            },
            _ => (Kind::Unread, 1),
        };
        self.at += len;
        kind
    }

    /// Skips spaces.
    #[inline]
    pub(super) fn skip_blanks(&mut self) {
        self.at = skip_blanks(self.line, self.at);
    }

    /// Number of bytes between the next byte and the end of the line.
    fn to_line_end(&self) -> usize {
        let rest = &self.line[self.at + 1..];
        rest.iter().position(|&b| b == b'\r' || b == b'\n').unwrap_or(rest.len())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(line: &str) -> String {
        let mut text = String::new();
        let mut at = 0;
        for token in tokens(line.as_bytes()) {
            assert_eq!(token.start, at, "tokens tile the line");
            at = token.end;
            text += &match token.kind {
                Kind::Blank => "_".into(),
                Kind::LineEnd => "|".into(),
                Kind::Word(letter, number) => format!("{}{:?} ", char::from(letter), number.value),
                Kind::Letter(letter) => format!("{}? ", char::from(letter)),
                Kind::Number(number) => format!("{:?} ", number.value),
                Kind::Symbol(symbol) => char::from(symbol).to_string(),
                kind => format!("{kind:?}:{} ", &line[token.start..token.end]),
            };
        }
        assert_eq!(at, line.len());
        text
    }

    #[test]
    fn words_are_read_as_controls_read_them() {
        assert_eq!(shown("N10G1X1.5Y-.25F100\r\n"), "N10.0 G1.0 X1.5 Y-0.25 F100.0 |");
        assert_eq!(shown("g1 x 1 2. 5 y + 3"), "G1.0 _X12.5 _Y3.0 ");
        assert_eq!(shown("/2 G0 X1 (up) Y2 ; rest\n"), "Delete:/2 _G0.0 _X1.0 _Comment:(up) _Y2.0 _Remark:; rest |");
        assert_eq!(shown("%abc"), "Percent:%abc ");
        assert_eq!(shown("X1.2.3"), "X1.2 Unread:. Unread:3 ");
        assert_eq!(shown("X0.1234567890123456789"), "X0.12345678901234568 ");
        assert_eq!(shown("(open X1"), "OpenComment:(open X1 ");
        assert_eq!(shown("X 5 \t Y"), "X5.0 _Y? ");
    }

    #[test]
    fn expressions_and_o_words_are_taken_apart() {
        assert_eq!(shown("#1=3 #2=[#1*2+1]"), "#1.0 =3.0 _#2.0 =[#1.0 *2.0 +1.0 ]");
        assert_eq!(shown("X-[#1+2]Y#<a b>"), "X? -[#1.0 +2.0 ]Y? #Quoted:<a b> ");
        assert_eq!(shown("o100 call [3]"), "O100.0 _Name:call _[3.0 ]");
        assert_eq!(shown("o<hole> sub"), "O? Quoted:<hole> _Name:sub ");
        assert_eq!(shown("X[SIN[30] ** 2]"), "X? [Name:SIN [30.0 ]_*_2.0 ]");
        assert_eq!(shown("@2^[45]"), "@2.0 ^? [45.0 ]");
    }
}
