//! The format of a job, found by its file name or else by its first bytes.

/// Formats of jobs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Format {
    /// One JSON document.
    Json,
    /// JSON Lines: one item per line.
    JsonLines,
    /// An APT CL file.
    Cl,
    /// An NC program whose motions are read as a job.
    Nc,
    /// A FreeCAD document.
    Freecad,
    /// A Mastercam NCI file.
    Nci,
}

/// A row of the table of formats: the name on the command line and in the Python package, what a file in the format is,
/// and the file name extensions.
type Row = (Format, &'static str, &'static str, &'static [&'static str]);

const ROWS: [Row; Format::ALL.len()] = [
    (Format::Json, "json", "A JSON document", &["json"]),
    (Format::JsonLines, "jsonl", "JSON Lines", &["jsonl", "ndjson"]),
    (Format::Cl, "cl", "An APT CL file", &["cl", "apt", "aptsource", "ncl", "cls", "cldata", "as"]),
    (Format::Nc, "nc", "An NC program", &["nc", "ngc", "tap", "cnc", "eia", "min", "ssb", "mpf", "spf", "h", "i"]),
    (Format::Freecad, "freecad", "A FreeCAD document", &["fcstd"]),
    (Format::Nci, "nci", "A Mastercam NCI file", &["nci"]),
];

impl Format {
    /// Number of bytes of a job that are examined to recognise its format.
    pub const LOOKED_AT: usize = 4096;

    /// All formats.
    pub const ALL: [Format; 6] =
        [Format::Json, Format::JsonLines, Format::Cl, Format::Nc, Format::Freecad, Format::Nci];

    /// The format with this name, such as `jsonl`.
    pub fn parse(name: &str) -> Option<Format> {
        Self::ALL.into_iter().find(|format| format.name() == name)
    }

    /// The name of the format on the command line and in the Python package.
    pub fn name(self) -> &'static str {
        ROWS[self as usize].1
    }

    /// What a file in the format is, such as `An APT CL file`.
    pub fn about(self) -> &'static str {
        ROWS[self as usize].2
    }

    /// The file name extensions of the format, in small letters.
    pub fn extensions(self) -> &'static [&'static str] {
        ROWS[self as usize].3
    }

    /// The format by the extension of a file name, also if Creo adds a version after it (`op010.ncl.1`).
    pub fn of_name(name: &str) -> Option<Format> {
        let name = name.rsplit(['/', '\\']).next()?;
        let (mut stem, mut extension) = name.rsplit_once('.')?;
        if !extension.is_empty() && extension.bytes().all(|byte| byte.is_ascii_digit()) {
            (stem, extension) = stem.rsplit_once('.')?;
        }
        let is = |known: &str| !stem.is_empty() && extension.eq_ignore_ascii_case(known);
        Self::ALL.into_iter().find(|format| format.extensions().iter().any(|known| is(known)))
    }

    /// The format by the first bytes of a job: a zip archive, a brace, record 1050, a word with a slash, or a block of
    /// an NC program. `None`: the bytes begin with none of these.
    pub fn of_content(bytes: &[u8]) -> Option<Format> {
        let start = bytes.get(..Self::LOOKED_AT).unwrap_or(bytes);
        if start.starts_with(b"PK\x03\x04") {
            return Some(Format::Freecad); // no other job format is a zip archive
        }
        let start = start.strip_prefix(b"\xef\xbb\xbf").unwrap_or(start);
        let mut lines = start.split(|&byte| byte == b'\n').map(<[u8]>::trim_ascii).filter(|line| !line.is_empty());
        let first = lines.clone().next()?;
        if first.starts_with(b"{") {
            // JSON Lines begin with an object on a line of its own
            let head = first[1..].trim_ascii_start().starts_with(b"\"start\"");
            return Some(if head { Format::JsonLines } else { Format::Json });
        }
        if first == b"1050" {
            return Some(Format::Nci); // the first record of every NCI file
        }
        if first.starts_with(b"%PDF-") || first.starts_with(b"%!PS") {
            return None; // a document, which begins with `%` like a program
        }
        // a block in the middle of other text, such as a manual, does not make the text a program
        let is_comment = |line: &[u8]| line.starts_with(b"(") || line.starts_with(b";");
        let mut begins = true;
        lines.find_map(|line| match line {
            _ if is_statement(line) => Some(Format::Cl),
            [b'%', ..] if begins => Some(Format::Nc),
            [letter, digit, ..] if begins && letter.is_ascii_alphabetic() && digit.is_ascii_digit() => Some(Format::Nc),
            _ => {
                begins &= is_comment(line);
                None
            }
        })
    }
}

/// `GOTO/1,2,3`, `TOOL PATH/A`, `PARTNO X`, `$$ a comment`.
fn is_statement(line: &[u8]) -> bool {
    let word = line.split(|byte| !byte.is_ascii_alphabetic() && *byte != b' ').next().unwrap_or_default();
    let after = line.get(word.len());
    line.starts_with(b"$$")
        || line.get(..6).is_some_and(|word| word.eq_ignore_ascii_case(b"PARTNO"))
        || word.len() > 2 && after == Some(&b'/')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_in_the_order_of_the_formats() {
        assert_eq!(ROWS.map(|row| row.0), Format::ALL);
        assert!(Format::ALL.iter().enumerate().all(|(at, format)| *format as usize == at));
    }

    #[test]
    fn names_tell_formats() {
        let of = Format::of_name;
        assert_eq!(of("a/b.json"), Some(Format::Json));
        assert_eq!(of("b.JSONL"), Some(Format::JsonLines));
        assert_eq!(of("op010.ncl.1"), Some(Format::Cl));
        assert_eq!(of("b.tap"), Some(Format::Nc));
        assert_eq!([of("b"), of(".json"), of("a.nc/b"), of("b.txt"), of("json")], [None; 5]);
    }

    #[test]
    fn beginnings_tell_formats() {
        let of = |text: &str| Format::of_content(text.as_bytes());
        assert_eq!(of("\u{feff}\n {\n\"postform\": 1"), Some(Format::Json));
        assert_eq!(of("{ \"start\":{\"postform\":1}}\n"), Some(Format::JsonLines));
        assert_eq!(of("$$* Pro/CLfile\nUNITS/MM"), Some(Format::Cl));
        assert_eq!(of("a remark\nTOOL PATH/A,TOOL,B"), Some(Format::Cl));
        assert_eq!(of("partno x"), Some(Format::Cl));
        assert_eq!(of("(a remark)\r\nO1234\r\n"), Some(Format::Nc));
        assert_eq!(of("%\n"), Some(Format::Nc));
        assert_eq!(of("PK\u{3}\u{4}.."), Some(Format::Freecad));
        assert_eq!(of("1050\r\n9 34 0 0 0 0 0 0 T\r\n"), Some(Format::Nci));
        let texts = [
            "",
            "\n\n",
            "hello, world",
            "[1, 2]",
            "# A manual\n\nG54 is a work offset.\n%\n",
            "%PDF-1.7\n%\n",
            "%!PS-Adobe-3.0\n",
        ];
        assert_eq!(texts.map(of), [None; 7]);
    }
}
