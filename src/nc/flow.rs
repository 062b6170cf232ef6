//! Blocks that control the program flow: subprograms, branches, loops.

use super::expression::Reader;
use super::fault::{Done, Fault};
use super::parameters::Parameters;
use super::scan::{Kind, tokens};
use crate::diag::Code;

/// A block with an O word.
#[derive(Clone, Debug, PartialEq)]
pub struct Flow {
    /// Number or name of the O word.
    pub label: String,
    /// Effect of the O word.
    pub step: Step,
}

/// Effect of an O word.
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs)]
pub enum Step {
    /// The beginning of a program or subprogram, as on a Fanuc.
    Program,
    Sub,
    /// With the value that the subprogram returns, if any.
    EndSub(Option<f64>),
    /// As `EndSub`.
    Return(Option<f64>),
    Call(Vec<f64>),
    If(bool),
    ElseIf(bool),
    Else,
    EndIf,
    While(bool),
    EndWhile,
    Do,
    Continue,
    Break,
    Repeat(f64),
    EndRepeat,
}

/// The words that may follow an O word, each with its step.
const NAMES: [(&str, Step); 15] = [
    ("sub", Step::Sub),
    ("endsub", Step::EndSub(None)),
    ("return", Step::Return(None)),
    ("call", Step::Call(Vec::new())),
    ("if", Step::If(false)),
    ("elseif", Step::ElseIf(false)),
    ("else", Step::Else),
    ("endif", Step::EndIf),
    ("while", Step::While(false)),
    ("endwhile", Step::EndWhile),
    ("do", Step::Do),
    ("continue", Step::Continue),
    ("break", Step::Break),
    ("repeat", Step::Repeat(0.0)),
    ("endrepeat", Step::EndRepeat),
];

fn named(word: &[u8]) -> Option<Step> {
    NAMES.iter().find(|(name, _)| name.as_bytes().eq_ignore_ascii_case(word)).map(|(_, step)| step.clone())
}

impl Flow {
    /// Reads the rest of a block after its O word.
    ///
    /// # Errors
    /// The word is unknown, or the condition after it can't be read.
    pub fn read(label: String, reader: &mut Reader<'_>, parameters: &Parameters) -> Done<Flow> {
        let mut step = Step::Program;
        if let Some(token) = reader.peek().filter(|token| token.kind == Kind::Name) {
            reader.next();
            step = named(reader.text(token)).ok_or_else(|| {
                let word = String::from_utf8_lossy(reader.text(token)).into_owned();
                let help = "an O word can have sub, call, if, while, do, repeat, or one of their ends";
                Fault::at(Code::PN015, token.start, format!("`{word}` after an O word"), help)
            })?;
            let truth = |reader: &mut Reader<'_>| -> Done<bool> { Ok(reader.bracketed(parameters)? != 0.0) };
            match &mut step {
                Step::If(is) | Step::ElseIf(is) | Step::While(is) => *is = truth(reader)?,
                Step::Repeat(times) => *times = reader.bracketed(parameters)?,
                Step::Call(arguments) => {
                    while reader.peek().is_some_and(|token| token.kind == Kind::Symbol(b'[')) {
                        arguments.push(reader.bracketed(parameters)?);
                    }
                }
                Step::EndSub(value) | Step::Return(value)
                    if reader.peek().is_some_and(|t| t.kind == Kind::Symbol(b'[')) =>
                {
                    *value = Some(reader.bracketed(parameters)?);
                }
                _ => {}
            }
        }
        while let Some(token) = reader.next() {
            if !matches!(token.kind, Kind::LineEnd | Kind::Comment | Kind::Remark) {
                let help = "write the words in a separate block";
                return Err(Fault::at(Code::PN015, token.start, "words after an O word", help));
            }
        }
        Ok(Flow { label, step })
    }

    /// Reads the label and the step of a line, but not the values after them. This function is used for lines that are
    /// skipped.
    pub fn head(line: &[u8]) -> Option<(String, Step)> {
        let first = line.iter().find(|b| !b.is_ascii_whitespace())?;
        if !matches!(first, b'o' | b'O' | b':') {
            return None;
        }
        let mut rest = tokens(line).filter(|token| token.kind != Kind::Blank);
        let label = match rest.next()?.kind {
            Kind::Word(_, number) => format!("{}", number.value),
            Kind::Letter(_) => {
                let name = rest.next().filter(|token| token.kind == Kind::Quoted)?;
                String::from_utf8_lossy(&line[name.start..name.end]).to_ascii_lowercase()
            }
            _ => return None,
        };
        let step = match rest.next() {
            Some(token) if token.kind == Kind::Name => named(&line[token.start..token.end])?,
            _ => Step::Program,
        };
        Some((label, step))
    }
}
