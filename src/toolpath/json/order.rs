//! Allows the keys of a job's objects in any order, as JSON does. The reader needs the lists of an object after all its
//! other keys. If a list comes before another key, the text is read in parts, with the list last.

use std::io::{self, BufReader, Read, Seek, SeekFrom};

/// A part of the text to read next, or a character between two parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// The bytes from `from` to `to` (excluded), with the line and column of the first byte, from 1.
    Text { from: u64, to: u64, line: u64, column: u32 },
    /// One byte of JSON, such as a comma.
    Sign(u8),
}

/// Number of bytes that are examined first: `TAIL` bytes at the end of the text, then `HEAD` bytes at the beginning.
const TAIL: u64 = 512;
const HEAD: u64 = 16 << 10;

/// How the keys of a job are ordered in its text.
#[derive(Debug, PartialEq, Eq)]
pub enum Order {
    /// The text is read from start to end. Either the text has its keys in the usual order, or the text is not a job
    /// document.
    Usual,
    /// Lists come before other keys. The reader reads the parts of the text in the order of this list.
    Late(Vec<Part>),
    /// Lists come before other keys, but the text is not a complete JSON document or has invalid lists.
    Broken,
}

/// Determines the order of the keys in a job.
///
/// # Errors
/// Reading the input fails.
pub fn order(input: &mut (impl Read + Seek)) -> io::Result<Order> {
    let length = input.seek(SeekFrom::End(0))?;
    input.seek(SeekFrom::Start(length.saturating_sub(TAIL)))?;
    let mut tail = Vec::new();
    input.by_ref().take(TAIL).read_to_end(&mut tail)?;
    input.rewind()?;
    if ends_as_usual(&tail) {
        let mut head = Scan::new(input.by_ref().take(HEAD));
        head.job()?;
        if !head.is_late {
            return Ok(Order::Usual);
        }
        input.rewind()?;
    }
    let mut scan = Scan::new(input);
    let parts = scan.job()?;
    Ok(match parts {
        Some(parts) if scan.is_late => Order::Late(parts),
        None if scan.is_late => Order::Broken,
        _ => Order::Usual,
    })
}

/// Whether the text ends like a job in the usual order: `operations` is the last key of the job, and `path` is the last
/// key of the last operation.
fn ends_as_usual(tail: &[u8]) -> bool {
    let mut signs = tail.iter().rev().filter(|byte| !byte.is_ascii_whitespace());
    let mut next = || signs.next().copied();
    if (next(), next()) != (Some(b'}'), Some(b']')) {
        return false;
    }
    match next() {
        Some(b'[') => true, // there is no operation
        Some(b'}') => next() == Some(b']'),
        _ => false,
    }
}

/// Scans the text byte by byte.
struct Scan<R> {
    input: BufReader<R>,
    next: Option<u8>,
    /// Offset, line and column of the next byte.
    at: u64,
    line: u64,
    column: u32,
    /// Whether a list comes before another key of its object.
    is_late: bool,
}

/// The text of a key and its value.
struct Entry {
    /// Index of the list; `None` if the value is not a list that is read as a stream.
    list: Option<usize>,
    parts: Vec<Part>,
}

impl<R: Read> Scan<R> {
    fn new(input: R) -> Scan<R> {
        let input = BufReader::with_capacity(HEAD as usize, input);
        Scan { input, next: None, at: 0, line: 1, column: 1, is_late: false }
    }

    /// The parts of a job; `None`: the text is not a job, or it is not complete.
    fn job(&mut self) -> io::Result<Option<Vec<Part>>> {
        self.begin()?;
        let mut parts = Vec::new();
        let whole = self.object(&mut parts, &["subprograms", "operations"], true)?;
        // the reader checks the text after the job
        let (from, line, column) = self.here();
        parts.push(Part::Text { from, to: u64::MAX, line, column });
        Ok(whole.map(|_| parts))
    }

    fn read(&mut self) -> io::Result<Option<u8>> {
        let mut byte = [0];
        loop {
            match self.input.read(&mut byte) {
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(error) => return Err(error),
                Ok(0) => return Ok(None),
                Ok(_) => return Ok(Some(byte[0])),
            }
        }
    }

    /// Skips the byte order mark of UTF-8, if there is one.
    fn begin(&mut self) -> io::Result<()> {
        self.next = self.read()?;
        if self.next == Some(0xef) {
            for _ in 0..3 {
                self.next = self.read()?;
            }
            self.at = 3;
            self.column = 4;
        }
        Ok(())
    }

    fn pass(&mut self) -> io::Result<()> {
        (self.line, self.column) = match self.next {
            Some(b'\n') => (self.line + 1, 1),
            _ => (self.line, self.column + 1),
        };
        self.at += 1;
        self.next = self.read()?;
        Ok(())
    }

    fn blanks(&mut self) -> io::Result<()> {
        while self.next.is_some_and(|byte| byte.is_ascii_whitespace()) {
            self.pass()?;
        }
        Ok(())
    }

    /// Skips spaces and then the byte `sign`. Returns `false` if the byte after the spaces is not `sign`.
    fn takes(&mut self, sign: u8) -> io::Result<bool> {
        self.blanks()?;
        let is_next = self.next == Some(sign);
        if is_next {
            self.pass()?;
        }
        Ok(is_next)
    }

    /// Reads a string, cut to a length that is sufficient for keys. `None`: there is no string.
    fn string(&mut self) -> io::Result<Option<Vec<u8>>> {
        // `subprograms`, with each letter written as an escape of six bytes
        const LONGEST: usize = 6 * "subprograms".len() + 2;
        if !self.takes(b'"')? {
            return Ok(None);
        }
        let (mut text, mut has_escapes) = (vec![b'"'], false);
        loop {
            let Some(byte) = self.next else { return Ok(None) };
            self.pass()?;
            if text.len() < LONGEST {
                text.push(byte);
            }
            match (byte, self.next) {
                (b'"', _) => break,
                (b'\\', None) => return Ok(None),
                (b'\\', Some(escaped)) => {
                    has_escapes = true;
                    self.pass()?;
                    if text.len() < LONGEST {
                        text.push(escaped);
                    }
                }
                _ => {}
            }
        }
        if has_escapes {
            // a string that was cut is not a key of a job
            return Ok(Some(serde_json::from_slice::<String>(&text).unwrap_or_default().into_bytes()));
        }
        text.remove(0);
        text.pop();
        Ok(Some(text))
    }

    /// Skips any value. Returns `false` if the text ends first.
    fn value(&mut self) -> io::Result<bool> {
        self.blanks()?;
        let mut depth = 0u64;
        loop {
            match self.next {
                None => return Ok(false),
                Some(b'"') => {
                    if self.string()?.is_none() {
                        return Ok(false);
                    }
                }
                Some(b'[' | b'{') => {
                    depth += 1;
                    self.pass()?;
                }
                Some(b']' | b'}' | b',') if depth == 0 => return Ok(true),
                Some(b']' | b'}') => {
                    depth -= 1;
                    self.pass()?;
                }
                Some(_) => self.pass()?,
            }
            if depth == 0 && self.next.is_some_and(|byte| byte.is_ascii_whitespace()) {
                return Ok(true);
            }
        }
    }

    fn here(&self) -> (u64, u64, u32) {
        (self.at, self.line, self.column)
    }

    fn text(&self, (from, line, column): (u64, u64, u32)) -> Part {
        Part::Text { from, to: self.at, line, column }
    }

    /// Adds the parts of an object, with its lists last. Returns whether a list comes before another key, in this
    /// object or in an object inside it. `None`: there is no object.
    fn object(&mut self, parts: &mut Vec<Part>, lists: &[&str], is_job: bool) -> io::Result<Option<bool>> {
        let start = {
            self.blanks()?;
            self.here()
        };
        if !self.takes(b'{')? {
            return Ok(None);
        }
        let (mut entries, mut is_late, mut listed) = (Vec::new(), false, false);
        if !self.takes(b'}')? {
            loop {
                self.blanks()?;
                let begin = self.here();
                let Some(key) = self.string()? else { return Ok(None) };
                if !self.takes(b':')? {
                    return Ok(None);
                }
                let list = lists.iter().position(|list| list.as_bytes() == key);
                // the usual order of a job is: other keys, `subprograms`, `operations`
                is_late |=
                    listed && list.is_none() || entries.iter().any(|entry: &Entry| entry.list > list && list.is_some());
                listed |= list.is_some();
                self.is_late |= is_late;
                self.blanks()?;
                let mut own = Vec::new();
                if is_job && list.is_some() && self.next == Some(b'[') {
                    let Some(late) = self.list(begin, &mut own)? else { return Ok(None) };
                    is_late |= late;
                } else {
                    if !self.value()? {
                        return Ok(None);
                    }
                    own.push(self.text(begin));
                }
                entries.push(Entry { list, parts: own });
                if self.takes(b'}')? {
                    break;
                }
                if !self.takes(b',')? {
                    return Ok(None);
                }
            }
        }
        if !is_late {
            parts.push(self.text(start));
            return Ok(Some(false));
        }
        entries.sort_by_key(|entry| entry.list);
        parts.push(Part::Sign(b'{'));
        for (number, entry) in entries.into_iter().enumerate() {
            if number > 0 {
                parts.push(Part::Sign(b','));
            }
            parts.extend(entry.parts);
        }
        parts.push(Part::Sign(b'}'));
        Ok(Some(true))
    }

    /// Adds the parts of a list of objects, including the key of the list.
    fn list(&mut self, begin: (u64, u64, u32), parts: &mut Vec<Part>) -> io::Result<Option<bool>> {
        self.takes(b'[')?;
        parts.push(self.text(begin));
        let mut is_late = false;
        if !self.takes(b']')? {
            loop {
                let Some(late) = self.object(parts, &["path"], false)? else { return Ok(None) };
                is_late |= late;
                if self.takes(b']')? {
                    break;
                }
                if !self.takes(b',')? {
                    return Ok(None);
                }
                parts.push(Part::Sign(b','));
            }
        }
        parts.push(Part::Sign(b']'));
        Ok(Some(is_late))
    }
}

/// A reader that reads a text in parts.
pub struct InParts<'p, R> {
    input: R,
    parts: std::slice::Iter<'p, Part>,
    /// Number of bytes of the current part that are not read yet.
    left: u64,
}

impl<'p, R: Read + Seek> InParts<'p, R> {
    /// A reader for these parts of the input.
    pub fn new(input: R, parts: &'p [Part]) -> InParts<'p, R> {
        InParts { input, parts: parts.iter(), left: 0 }
    }

    /// Reads bytes, but not beyond the end of a part. At the beginning of a part, also returns the line and column of
    /// the first byte.
    pub fn read_part(&mut self, out: &mut [u8]) -> io::Result<(usize, Option<(u64, u32)>)> {
        let mut begins = None;
        if self.left == 0 {
            match self.parts.next() {
                None => return Ok((0, None)),
                Some(Part::Sign(sign)) => {
                    out[0] = *sign;
                    return Ok((1, None));
                }
                Some(&Part::Text { from, to, line, column }) => {
                    self.input.seek(SeekFrom::Start(from))?;
                    self.left = to - from;
                    begins = Some((line, column));
                }
            }
        }
        let most = usize::try_from(self.left).unwrap_or(usize::MAX).min(out.len());
        let count = self.input.read(&mut out[..most])?;
        // if the file was shortened meanwhile, the text ends inside a value
        self.left = if count == 0 { 0 } else { self.left - count as u64 };
        Ok((count, begins))
    }
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use super::*;

    fn reordered(text: &str) -> Option<String> {
        let mut input = Cursor::new(text);
        let Order::Late(parts) = order(&mut input).unwrap() else { return None };
        let mut whole = Vec::new();
        for part in parts {
            match part {
                Part::Sign(sign) => whole.push(sign),
                Part::Text { from, to, .. } => {
                    whole.extend(
                        &text.as_bytes()[from as usize..text.len().min(usize::try_from(to).unwrap_or(usize::MAX))],
                    );
                }
            }
        }
        Some(String::from_utf8(whole).unwrap())
    }

    #[test]
    fn lists_come_last() {
        assert_eq!(
            reordered(
                r#"{"operations": [{"path": [{"line": [1, 2]}], "tool": 1}, {"tool": 2, "path": []}], "postform": 1}"#
            )
            .unwrap(),
            r#"{"postform": 1,"operations": [{"tool": 1,"path": [{"line": [1, 2]}]},{"tool": 2, "path": []}]}"#
        );
        assert_eq!(
            reordered(r#"{"operations": [], "name": "]}\"", "subprograms": [ ] , "units": "mm" }"#).unwrap(),
            r#"{"name": "]}\"","units": "mm","subprograms": [],"operations": []}"#
        );
        // if only the end of this text were examined, the order would seem usual
        assert_eq!(
            reordered(r#"{"operations": [{"path": [], "tool": 1}], "subprograms": [{"number": 1, "path": []}]}"#)
                .unwrap(),
            r#"{"subprograms": [{"number": 1, "path": []}],"operations": [{"tool": 1,"path": []}]}"#
        );
    }

    /// In JSON, `"p\u0061th"` is the key `path`.
    #[test]
    fn keys_may_have_escapes() {
        let path: String = "path".bytes().map(|byte| format!("\\u00{byte:x}")).collect();
        let last: String = "subprograms".bytes().map(|byte| format!("\\u00{byte:X}")).collect();
        let list = format!(r#""operation\u0073": [{{"{path}": ["\\\"]"], "tool": 1}}]"#);
        assert_eq!(
            reordered(&format!(r#"{{{list}, "{last}": [], "a\\\"": 1}}"#)).unwrap(),
            format!(r#"{{"a\\\"": 1,"{last}": [],"operation\u0073": [{{"tool": 1,"{path}": ["\\\"]"]}}]}}"#)
        );
    }

    #[test]
    fn the_usual_order_and_what_is_no_job_stay() {
        for text in [
            r#"{"postform": 1, "operations": [{"tool": 1, "path": [1]}]}"#,
            r#"{"postform": 1, "operations": [] }"#,
            r#"{"operations": [{"path": [], "tool": 1}], "postform": 1"#,
            r#"{"postform": 1, "operations": [{"path": [], "tool": 1}, {"path": [}]}"#,
            r#"{"postform": 1}"#,
            r#"{"operations": [1], "postform": 1}"#,
            r#"["operations"]"#,
            r#"{"operations": [{"path": [}], "postform": 1}"#,
            "",
            "{",
            "\u{feff}{\"a\": \"",
        ] {
            assert_eq!(reordered(text), None, "{text}");
        }
    }
}
