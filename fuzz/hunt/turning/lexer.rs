//! Splits blocks of a program into words. This lexer reads only the blocks of custom macro B that generated programs
//! contain.

use std::collections::HashMap;

use super::executor::{Stopped, alarm, unsure};

/// A number, a variable, or a sum of two values.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A number.
    Number(f64),
    /// `#1`, with a sign.
    Variable(u32, f64),
    /// `[a+b]`, with the sign of the second value.
    Sum(Box<Value>, f64, Box<Value>),
}

impl Value {
    pub(super) fn of(&self, variables: &HashMap<u32, f64>) -> Result<f64, Stopped> {
        match self {
            Value::Number(number) => Ok(*number),
            Value::Variable(name, sign) => match variables.get(name) {
                Some(value) => Ok(sign * value),
                None => unsure("a variable without a value"),
            },
            Value::Sum(a, sign, b) => Ok(a.of(variables)? + sign * b.of(variables)?),
        }
    }
}

/// The content of a line.
#[derive(Clone, Debug, PartialEq)]
pub enum Block {
    /// Words: letter, value, and whether the number has a decimal point.
    Words(Vec<(char, Value, bool)>),
    /// `O1000`.
    Program(u32),
    /// `#1=2`.
    Set(u32, Value),
    /// `WHILE[a LT b]DO1`.
    While(Value, String, Value, u32),
    /// `END1`.
    End(u32),
}

/// A line of the program.
#[derive(Clone, Debug)]
pub struct Line {
    /// Line number, from 1.
    pub number: usize,
    /// The block number (N) of the line.
    pub sequence: Option<u32>,
    /// The content of the line.
    pub block: Block,
}

impl Line {
    pub(super) fn has_words(&self) -> bool {
        matches!(&self.block, Block::Words(words) if !words.is_empty())
    }
}

pub(super) fn parse(text: &str) -> Result<Vec<Line>, Stopped> {
    let mut lines = Vec::new();
    let mut percents = 0;
    for (number, line) in text.lines().enumerate() {
        let mut bare = String::new();
        let mut comment = false;
        for letter in line.chars().filter(|letter| !letter.is_whitespace()) {
            match letter {
                '(' => comment = true,
                ')' => comment = false,
                letter if !comment => bare.push(letter),
                _ => {}
            }
        }
        if bare == "%" {
            percents += 1;
            if percents == 2 {
                break;
            }
            continue;
        }
        // block skip is off, so the block after the slash is run
        let bare = bare.strip_prefix('/').unwrap_or(&bare);
        let (sequence, block) = line_of(bare)?;
        lines.push(Line { number: number + 1, sequence, block });
    }
    Ok(lines)
}

fn line_of(bare: &str) -> Result<(Option<u32>, Block), Stopped> {
    let mut text = Text { rest: bare };
    let mut sequence = None;
    if let Some(rest) = bare.strip_prefix("WHILE[") {
        text.rest = rest;
        let left = text.term()?;
        let (test, rest) = text.rest.split_at_checked(2).ok_or(Stopped::Unsure("WHILE".into()))?;
        text.rest = rest;
        let right = text.term()?;
        let number = text.rest.strip_prefix("]DO").and_then(|rest| rest.parse().ok());
        let Some(number) = number else { return unsure("WHILE") };
        return Ok((None, Block::While(left, test.to_owned(), right, number)));
    }
    if let Some(number) = bare.strip_prefix("END") {
        let Ok(number) = number.parse() else { return unsure("END") };
        return Ok((None, Block::End(number)));
    }
    if bare.starts_with('#') {
        let Value::Variable(name, _) = text.term()? else { return unsure("a variable") };
        text.rest = text.rest.strip_prefix('=').ok_or(Stopped::Unsure("a variable".into()))?;
        return Ok((None, Block::Set(name, text.sum()?)));
    }
    let mut words = Vec::new();
    while let Some(letter) = text.rest.chars().next() {
        if !letter.is_ascii_uppercase() {
            return alarm("not a word");
        }
        text.rest = &text.rest[1..];
        let before = text.rest;
        let value = text.term()?;
        let read = &before[..before.len() - text.rest.len()];
        match (letter, &value) {
            ('N', Value::Number(number)) => sequence = Some(*number as u32),
            ('O', Value::Number(number)) => return Ok((sequence, Block::Program(*number as u32))),
            _ => words.push((letter, value, read.contains(['.', '#']))),
        }
    }
    Ok((sequence, Block::Words(words)))
}

struct Text<'t> {
    rest: &'t str,
}

impl Text<'_> {
    /// Reads a number, a variable, or a sum in brackets.
    fn term(&mut self) -> Result<Value, Stopped> {
        if let Some(rest) = self.rest.strip_prefix('[') {
            self.rest = rest;
            let sum = self.sum()?;
            self.rest = self.rest.strip_prefix(']').ok_or(Stopped::Alarm("a bracket".into()))?;
            return Ok(sum);
        }
        let (sign, rest) = match self.rest.strip_prefix('-') {
            Some(rest) => (-1.0, rest),
            None => (1.0, self.rest.strip_prefix('+').unwrap_or(self.rest)),
        };
        let variable = rest.strip_prefix('#');
        let digits = variable.unwrap_or(rest);
        let end = digits.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(digits.len());
        let (number, rest) = digits.split_at(end);
        self.rest = rest;
        if variable.is_some() {
            let Ok(name) = number.parse() else { return alarm("a variable") };
            return Ok(Value::Variable(name, sign));
        }
        let Ok(value) = number.parse::<f64>() else { return alarm("a number") };
        Ok(Value::Number(sign * value))
    }

    fn sum(&mut self) -> Result<Value, Stopped> {
        let mut value = self.term()?;
        while self.rest.starts_with(['+', '-']) {
            let sign = if self.rest.starts_with('-') { -1.0 } else { 1.0 };
            self.rest = &self.rest[1..];
            value = Value::Sum(Box::new(value), sign, Box::new(self.term()?));
        }
        Ok(value)
    }
}

/// The words of a block.
#[derive(Debug)]
pub struct Words {
    /// Letters and values, and whether each has a decimal point.
    pub(super) list: Vec<(char, f64, bool)>,
}

impl Words {
    pub(super) fn get(&self, letter: char) -> Option<f64> {
        self.list.iter().rfind(|(other, ..)| *other == letter).map(|(_, value, _)| *value)
    }

    pub(super) fn is(&self, letter: char, value: f64) -> bool {
        self.list.iter().any(|(other, number, _)| *other == letter && *number == value)
    }

    pub(super) fn any(&self, letters: [char; 2]) -> bool {
        letters.iter().any(|&letter| self.get(letter).is_some())
    }

    /// A length. Without a decimal point it is in least increments.
    pub(super) fn length(&self, letter: char, unit: f64) -> Option<f64> {
        let &(_, value, pointed) = self.list.iter().rfind(|(other, ..)| *other == letter)?;
        Some(if pointed { value } else { value * unit })
    }

    /// The words of a line that contains no variables.
    pub(super) fn of(line: &Line) -> Result<Words, Stopped> {
        let Block::Words(words) = &line.block else { return unsure("a profile with other blocks") };
        let none = HashMap::new();
        let list = words
            .iter()
            .map(|(letter, value, pointed)| Ok((*letter, value.of(&none)?, *pointed)))
            .collect::<Result<_, Stopped>>()?;
        Ok(Words { list })
    }
}
