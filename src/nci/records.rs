//! The records of an NCI file. Each record is one line with a number and one line with values, which may be empty.

use std::io::{BufRead as _, BufReader, Read};

use super::wrong;
use crate::diag::{Code, Diag};
use crate::toolpath::ReadError;

/// Maximum length of a line, in bytes.
const LONGEST: u64 = 1 << 20;

/// A record.
pub struct Record {
    /// The line of the record's number, from 1.
    pub line: u64,
    /// The number of the record.
    pub code: u32,
    /// The text line with the values of the record.
    pub text: String,
}

impl Record {
    /// The values of the record. There must be at least `least` values.
    ///
    /// # Errors
    /// A value is not a number, or there are too few values.
    pub fn values(&self, least: usize) -> Result<Vec<f64>, Box<Diag>> {
        self.numbers(self.text.split_whitespace(), least)
    }

    /// The first `count` values. Any words may follow these values.
    ///
    /// # Errors
    /// The same as for [`Record::values`].
    pub fn first_values(&self, count: usize) -> Result<Vec<f64>, Box<Diag>> {
        self.numbers(self.text.split_whitespace().take(count), count)
    }

    fn numbers<'t>(&self, words: impl Iterator<Item = &'t str>, least: usize) -> Result<Vec<f64>, Box<Diag>> {
        let values: Option<Vec<f64>> =
            words.map(|word| word.parse().ok().filter(|value: &f64| value.is_finite())).collect();
        let message = match values {
            Some(values) if values.len() >= least => return Ok(values),
            Some(values) => format!("record {} has {} values, but needs {least}", self.code, values.len()),
            None => format!("record {} has a value that is not a number", self.code),
        };
        Err(wrong(Code::PI001, message, "let Mastercam write the file again", self.line + 1))
    }
}

/// Reads the records one after the other.
pub struct Records<R> {
    input: BufReader<R>,
    line: u64,
}

impl<R: Read> Records<R> {
    pub fn new(input: R) -> Records<R> {
        Records { input: BufReader::with_capacity(128 << 10, input), line: 0 }
    }

    /// The last line that was read, from 1.
    pub fn line(&self) -> u64 {
        self.line
    }

    /// The next record; `None` at the end of the file.
    ///
    /// # Errors
    /// The input can't be read, ends inside a record, or has a record whose first line is not a number.
    pub fn next(&mut self) -> Result<Option<Record>, ReadError> {
        let Some(number) = self.next_line()? else { return Ok(None) };
        let line = self.line;
        // after the last record, only empty lines are allowed
        if number.trim().is_empty() {
            while let Some(text) = self.next_line()? {
                if !text.trim().is_empty() {
                    let help = "a record is a line with its number and a line with its values";
                    return Err(wrong(Code::PI001, "an empty line in place of the number of a record", help, line));
                }
            }
            return Ok(None);
        }
        let Ok(code) = number.trim().parse() else {
            let shown: String = number.trim().chars().take(40).collect();
            let message = format!("`{shown}` is not a record number");
            let help = if line == 1 { "an NCI file begins with 1050" } else { "let Mastercam write the file again" };
            return Err(wrong(Code::PI001, message, help, line));
        };
        if line == 1 && code != 1050 {
            return Err(wrong(
                Code::PI001,
                "the file does not begin with record 1050",
                "check that it is an NCI file in text form",
                line,
            ));
        }
        match self.next_line()? {
            Some(text) => Ok(Some(Record { line, code, text })),
            None => Err(wrong(Code::PI004, "the file is cut off after the number of a record", "write it again", line)),
        }
    }

    /// The next line without its line end. Bytes that are not UTF-8 are read as Latin-1.
    fn next_line(&mut self) -> Result<Option<String>, ReadError> {
        let mut bytes = Vec::new();
        if (&mut self.input).take(LONGEST).read_until(b'\n', &mut bytes)? == 0 {
            return Ok(None);
        }
        self.line += 1;
        if bytes.len() as u64 == LONGEST {
            return Err(wrong(
                Code::PI001,
                "a line of more than 1 MB",
                "check that it is an NCI file in text form",
                self.line,
            ));
        }
        while bytes.last().is_some_and(|byte| matches!(byte, b'\n' | b'\r')) {
            bytes.pop();
        }
        Ok(Some(
            String::from_utf8(bytes)
                .unwrap_or_else(|error| error.as_bytes().iter().map(|&byte| char::from(byte)).collect()),
        ))
    }
}
