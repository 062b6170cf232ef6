//! Text of the job, printed unchanged.

use super::stops::settle_between_moves;
use crate::control::{Code, Group};
use crate::diag;
use crate::lang::{VarId, work_code};
use crate::render::cx::Cx;
use crate::render::fault::{Done, fault, fault_at};
use crate::render::said::{Line, TextWord, words_of};
use crate::render::shape::Shape;
use crate::render::want::Want;
use crate::terminal::steers;

/// Prints a block of text unchanged. The codes in the text become values that the job requests. After the text, the
/// values of letters and the positions are unknown.
pub fn verbatim(text: &str, cx: &mut Cx<'_>) -> Done {
    let shape = cx.shape;
    if let Some(c) = text.chars().find(|&c| steers(c) && c != '\t') {
        let message = format!("the text contains the control character U+{:04X}", u32::from(c));
        return fault(diag::Code::PR035, message, "take it out");
    }
    if text.trim() == "%" {
        let message = "the text is a single `%`, which ends the program on a control";
        return fault(diag::Code::PR035, message, "remove the `%`: the sequences StartCode and EndCode print it");
    }
    let words = words_of(text.as_bytes()).unwrap_or_default();
    let is_length = |word: &&TextWord| b"XYZUVWIJKRQF".contains(&word.letter) && word.value != 0.0;
    if let Some(TextWord { letter, value }) = words.iter().find(is_length).filter(|_| shape.scale != 1.0) {
        let message = format!(
            "the text has {}{value} in the units of the job, but the program has other units",
            char::from(*letter)
        );
        let help = "render with the units of the job (`--units`): text is printed unchanged";
        return fault(diag::Code::PR035, message, help);
    }
    cx.said.stand.fresh_tool = None;
    if text.trim().is_empty() {
        return Ok(()); // an empty block is not printed
    }
    settle_between_moves(cx)?;
    cx.said.text(text.as_bytes(), Line::NONE, cx.want, shape);
    for TextWord { letter, value } in words {
        if letter == b'S' {
            cx.want.set(VarId::Speed, value);
        } else if let Some(code) = Code::of(letter, value) {
            if changes_units(code, shape, cx.want) {
                let message = format!("the text changes the units of the program with {code}");
                let help = "render with `--units`, and remove the code";
                return fault_at(diag::Code::PR035, message, help, None);
            }
            is_the_jobs(code, shape, cx.want);
        }
    }
    cx.said.end_block(cx.want, shape);
    cx.said.forget_words();
    cx.said.lose_start(0x3f, shape);
    cx.said.differs |= cx.said.is_misread(shape, cx.want) || !cx.said.lacks(cx.want, shape).is_empty();
    cx.out.text(text, false);
    cx.out.end_block();
    Ok(())
}

/// Stores a code in the job's text as a value that the job requests. Feed modes are not stored.
fn is_the_jobs(code: Code, shape: &Shape, want: &mut Want) {
    let var = match shape.group_of(code) {
        Some(Group::Spindle) => VarId::Direct,
        Some(Group::Coolant) => {
            // the text switches only one kind of coolant
            (want.coolant, want.coolant_is_said) = (want.coolant.first(), true);
            VarId::Cool
        }
        Some(Group::Work) => match &shape.program.work {
            words if words.by_code() => {
                return want.put(VarId::Work, work_code(shape.program.settings.work, code.value()));
            }
            // the offset selected by G54 has no number among the form's own offset words
            words if words.shares_its_codes => return want.put(VarId::Work, None),
            _ => return,
        },
        Some(Group::SpeedMode) => VarId::Speedtype,
        _ => return,
    };
    want.set(var, code.value());
}

/// Whether the code selects units that differ from the program's units.
fn changes_units(code: Code, shape: &Shape, want: &Want) -> bool {
    shape.group_of(code) == Some(Group::Units) && want.get(VarId::Unitmode) != Some(code.value())
}
