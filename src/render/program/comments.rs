//! Comments, in the comment marks of the form.

use crate::diag::Code;
use crate::lang::SequenceId;
use crate::render::ascii::plain;
use crate::render::comment_marks::in_comment;
use crate::render::cx::Cx;
use crate::render::fault::Done;
use crate::render::printer::Printer;
use crate::render::shape::Shape;
use crate::render::texts::room;
use crate::render::upon::run_with_upons;

/// Splits a text into lines of at most `most` characters, at spaces where possible.
fn wrapped(text: &str, most: usize) -> impl Iterator<Item = &str> {
    let mut rest = Some(text);
    std::iter::from_fn(move || {
        let text = rest.take()?;
        let Some((end, _)) = text.char_indices().nth(most) else { return Some(text) };
        let blank = if text[end..].starts_with(' ') { Some(end) } else { text[..end].rfind(' ') };
        let (line, later) = text.split_at(blank.filter(|&at| at > 0).unwrap_or(end));
        rest = Some(later.trim_start_matches(' ')).filter(|later| !later.is_empty());
        Some(line)
    })
}

/// Prints a comment, with the CommentLine sequence if the form has one. A comment that exceeds the control's line
/// length is divided into several blocks.
pub fn comment_block(text: &str, cx: &mut Cx<'_>) -> Done {
    let shape = cx.shape;
    let marks: usize = shape.program.settings.comment.iter().map(String::len).sum();
    let room = room(shape).saturating_sub(marks).max(1);
    for (i, line) in wrapped(&plain(text), room).enumerate() {
        if i == 1 {
            let message = "a comment is longer than a line of the control, and continues in the next block";
            cx.out.note(Code::PR026, message.into(), "shorten the comment to keep it in one block");
        }
        match shape.program.routine(SequenceId::CommentLine) {
            Some(routine) => {
                cx.want.texts.say(line);
                let routine = shape.way(routine, cx.want, cx.said);
                run_with_upons(routine, cx)?;
            }
            None => comment_line(line, shape, cx.out),
        }
    }
    Ok(())
}

fn comment_line(text: &str, shape: &Shape, out: &mut Printer) {
    let settings = &shape.program.settings;
    let [open, close] = &settings.comment;
    let block = out.word(false);
    block.extend_from_slice(open.as_bytes());
    for c in text.chars() {
        block.push(in_comment(c, false, settings));
    }
    block.extend_from_slice(close.as_bytes());
    out.end_block();
}
