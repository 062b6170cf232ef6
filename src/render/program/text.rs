//! Text as it stands.

use super::stops::settle_between_moves;
use crate::control::{self, Group};
use crate::diag::Code;
use crate::lang::VarId;
use crate::render::fault::{Done, fault, fault_at};
use crate::render::printer::Printer;
use crate::render::said::{Line, Said};
use crate::render::shape::Shape;
use crate::render::want::Want;
use crate::terminal::steers;

/// Prints a block as it stands: nobody knows what it did.
pub fn verbatim(text: &str, shape: &Shape, want: &mut Want, said: &mut Said, out: &mut Printer) -> Done {
    if let Some(c) = text.chars().find(|&c| steers(c) && c != '\t') {
        let message = format!("the text holds U+{:04X}, which steers instead of being printed", u32::from(c));
        return fault(Code::PR035, message, "take it out");
    }
    if text.trim() == "%" {
        let message = "the text is a lone `%`, at which a control takes the program to be over";
        return fault(Code::PR035, message, "take it out: StartCode and EndCode print it");
    }
    said.stand.fresh_tool = None;
    if text.trim().is_empty() {
        return Ok(()); // an empty block is not printed
    }
    settle_between_moves(shape, want, said, out)?;
    said.forget_words();
    said.displaced(0x3f, shape);
    text_codes(text, shape, want, said)?;
    out.text(text, false);
    out.end_block();
    Ok(())
}

/// The codes of a text outside comments: what they switch is known.
fn text_codes(text: &str, shape: &Shape, want: &mut Want, said: &mut Said) -> Done {
    let bytes = text.as_bytes();
    let (mut at, mut depth) = (0, 0);
    while at < bytes.len() {
        let letter = bytes[at].to_ascii_uppercase();
        at += 1;
        match letter {
            b';' if depth == 0 => break,
            b'(' => depth += 1,
            b')' => depth -= 1,
            b'G' | b'M' | b'S' if depth == 0 => {
                let end = at + bytes[at..].iter().take_while(|b| b.is_ascii_digit() || **b == b'.').count();
                if let Ok(value) = text[at..end].parse::<f64>() {
                    if letter == b'S' {
                        said.conditions.put(VarId::Speed, Some(value));
                        want.set(VarId::Speed, value);
                    } else if changes_units(letter, value, shape, want) {
                        let message = format!("the text changes the units of the program with G{value}");
                        return fault_at(Code::PR035, message, "render with `--units`, and take the code out", None);
                    } else {
                        if let Some(code) = control::Code::of(letter, value) {
                            said.code(code, Line::NONE, want, shape);
                            is_the_jobs(code, shape, want);
                        }
                    }
                }
                at = end;
            }
            _ => {}
        }
    }
    said.forget_words();
    said.differs |= said.is_misread(shape, want) || !said.lacks(want, shape).is_empty();
    Ok(())
}

/// Takes what a text switches as what the job wants from there on; what its feeds count is not.
fn is_the_jobs(code: control::Code, shape: &Shape, want: &mut Want) {
    let var = match shape.group_of(code) {
        Some(Group::Spindle) => VarId::Direct,
        Some(Group::Coolant) => {
            want.coolant = want.coolant.first(); // the text says one kind
            VarId::Cool
        }
        Some(Group::Work) => match &shape.program.work_word {
            None => VarId::Work,
            // G54 is none of the offsets that have a word of their own: nobody knows its number
            Some(word) if word.shares_its_codes => return want.put(VarId::Work, None),
            Some(_) => return,
        },
        Some(Group::SpeedMode) => VarId::Speedtype,
        _ => return,
    };
    want.set(var, code.value());
}

/// Is this a code of other units than the program's?
fn changes_units(letter: u8, value: f64, shape: &Shape, want: &Want) -> bool {
    control::Code::of(letter, value).and_then(|code| shape.group_of(code)) == Some(Group::Units)
        && want.get(VarId::Unitmode) != Some(value)
}
