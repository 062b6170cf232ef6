//! Values that the form sets with `@set`.

use crate::sema::{Target, Value};

/// Values that the form sets with `@set`. These values apply until the end of the program.
#[derive(Clone, Debug, Default)]
pub struct Kept {
    numbers: Vec<(Target, f64)>,
    texts: Vec<(Target, String)>,
}

impl Kept {
    /// The number, if the form set one; yes is 1.
    #[inline]
    pub fn of(&self, target: Target) -> Option<f64> {
        if self.numbers.is_empty() {
            return None;
        }
        self.numbers.iter().find(|(own, _)| *own == target).map(|(_, value)| *value)
    }

    /// The text, if the form set one.
    pub fn text_of(&self, target: Target) -> Option<&str> {
        self.texts.iter().find(|(own, _)| *own == target).map(|(_, text)| text.as_str())
    }

    /// Stores a value.
    pub fn set(&mut self, target: Target, value: Value) {
        match value {
            Value::Number(number) => put(&mut self.numbers, target, number),
            Value::Yes(yes) => put(&mut self.numbers, target, f64::from(u8::from(yes))),
            Value::Text(text) => put(&mut self.texts, target, text.into_owned()),
        }
    }
}

fn put<T>(rows: &mut Vec<(Target, T)>, target: Target, value: T) {
    match rows.iter_mut().find(|(own, _)| *own == target) {
        Some(row) => row.1 = value,
        None => rows.push((target, value)),
    }
}
