//! Tools that a program calls by their names, as in `T="DRILL_8"` or `TOOL CALL "DRILL_8"`.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use crate::lang::{in_quotes, in_word};
use crate::source::text_of;

/// Smallest number that stands for a name. Tool numbers are smaller, so a name never counts as another tool's number.
pub const FIRST: f64 = 1e9;

/// The tool names of a program.
#[derive(Clone, Debug, Default)]
pub(super) struct ToolNames {
    /// The called names. Programs that are compared share this list, so that equal names have equal words.
    called: Arc<Mutex<Called>>,
    /// The tool numbers that are known from outside of the program, by the name in capital letters. `None`: several
    /// tools have this name.
    numbers: HashMap<String, Option<f64>>,
}

/// Names in the order of their first use. The word of a name is `FIRST` plus its index.
#[derive(Debug, Default)]
struct Called {
    names: Vec<Arc<str>>,
    /// The index of a name, by the name in capital letters.
    indexes: HashMap<String, usize>,
}

impl ToolNames {
    /// The value of a T word with this name. A name that is a number is itself the tool number.
    pub fn word(&self, name: &[u8]) -> f64 {
        let name = text_of(name);
        let name = name.trim();
        if let Ok(number) = name.parse::<u32>()
            && f64::from(number) < FIRST
        {
            return f64::from(number);
        }
        let mut called = self.called();
        let next = called.names.len();
        let index = *called.indexes.entry(name.to_ascii_uppercase()).or_insert(next);
        if index == next {
            called.names.push(name.into());
        }
        FIRST + index as f64
    }

    /// Sets the tool number of a name. A form prints other characters instead of some characters of a name; so the
    /// number is set for each spelling. If a spelling gets two numbers, its number is unknown.
    pub fn know(&mut self, name: &str, number: f64) {
        for fits in [Some, in_quotes, in_word] {
            let spelled: String = name.trim().chars().map(|c| fits(c).unwrap_or('_')).collect();
            let known = self.numbers.entry(spelled.to_ascii_uppercase()).or_insert(Some(number));
            *known = known.filter(|known| *known == number);
        }
    }

    /// Makes the words of names equal to those of another program.
    pub fn share(&mut self, other: &ToolNames) {
        self.called = Arc::clone(&other.called);
    }

    /// The tool number for the value of a T word, or for a register that is computed from it. A name without a known
    /// number keeps its value.
    pub fn number(&self, word: f64) -> f64 {
        let number = self.name(word).and_then(|name| *self.numbers.get(&name.to_ascii_uppercase())?);
        number.map_or(word, |number| number + word.fract())
    }

    /// The name for the value of a T word; `None`: the value is a tool number.
    pub fn name(&self, word: f64) -> Option<Arc<str>> {
        if word < FIRST { None } else { self.called().names.get((word - FIRST) as usize).cloned() }
    }

    /// The called names. The word of a name is `FIRST` plus its index.
    pub fn all(&self) -> Vec<Arc<str>> {
        self.called().names.clone()
    }

    /// Whether the value of a T word is a tool number or stands for a name.
    pub fn is_tool(&self, word: f64) -> bool {
        word >= 0.0 && word.fract() == 0.0 && (word < FIRST || self.name(word).is_some())
    }

    fn called(&self) -> MutexGuard<'_, Called> {
        self.called.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
