//! Words that select a work offset: a code with a word, a word alone, or a code alone. `MoreWork` defines the words of further
//! fixtures.

use super::cx::Writer;
use super::fault::Done;
use super::words::{code_word, letter_word, value_code};
use crate::compile::WorkWord;
use crate::control::Code;
use crate::sema;

/// Prints the words of `G[work]` for a fixture of `MoreWork`. Returns false if the form has no `MoreWork` for the
/// fixture.
pub fn more_work_words(work: f64, writer: &mut Writer<'_>) -> Done<bool> {
    match writer.shape.program.work.more(work) {
        Some((&WorkWord { code, letter: Some(letter), is_code, .. }, value)) => {
            work_words(code, letter, is_code, value, writer)?;
            Ok(true)
        }
        _ => Ok(false),
    }
}

/// Prints a code with a word, a word alone, or a code alone.
pub fn work_words(code: Option<Code>, letter: u8, is_code: bool, value: f64, writer: &mut Writer<'_>) -> Done {
    let shape = writer.shape;
    if let Some(code) = code {
        code_word(&sema::Code::plain(code), writer)?;
    }
    if is_code {
        return value_code(letter, value, writer);
    }
    // the number of an offset has no decimal point, even if other values of its letter have one
    let info = &shape.letters[letter];
    if code.is_some() && value.fract() == 0.0 {
        writer.out.text(&format!("{}{value}", char::from(info.printed)), false);
        writer.said.forget(info);
    } else {
        letter_word(letter, value, shape, writer.said, writer.out)?;
    }
    writer.said.forget_axes(shape);
    Ok(())
}
