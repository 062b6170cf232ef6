//! Prints a work offset that no sequence prints, in a separate block.

use super::cx::Writer;
use super::fault::{Done, fault};
use super::upon::upons_are_printed;
use super::values::Now;
use super::want::is_no_work;
use super::words::value_code;
use super::work_words::work_words;
use crate::compile::WorkWord;
use crate::diag::Code;
use crate::lang::VarId;

/// Prints the work offset before a position, if the block with the position does not print it.
pub fn work_before(writer: &mut Writer<'_>) -> Done {
    let shape = writer.shape;
    match writer.want.get(VarId::Work) {
        Some(work) if writer.said.conditions.get(VarId::Work) != Some(work) => {
            work_block(work, writer)?;
            upons_are_printed(VarId::Work, work, shape, writer.said);
            Ok(())
        }
        _ => Ok(()),
    }
}

/// Prints the work offset in a separate block, in the form's own words.
pub fn work_block(work: f64, writer: &mut Writer<'_>) -> Done {
    let shape = writer.shape;
    let words = &shape.program.work;
    let now = Now { shape, want: writer.want, said: writer.said, letter: b' ', block: None, set: &writer.said.kept };
    match words.way(&now, shape.program.settings.codes()) {
        Some((&WorkWord { code, letter: Some(letter), is_code, .. }, value)) => {
            work_words(code, letter, is_code, value, writer)?;
        }
        None if words.ways.is_empty() && !is_no_work(work, shape) => value_code(b'G', work, writer)?,
        Some(_) => {
            let message = format!("the work offset changes to {work}, but the form prints it as text");
            return fault(Code::PR017, message, "add the sequence `WorkChange` with this text");
        }
        None => {
            let message = format!("the work offset changes to {work}, but the form does not print [work]");
            return fault(
                Code::PR017,
                message,
                "print `G[work]` in the tool changes, or add the sequence `Upon [work]`",
            );
        }
    }
    writer.out.end_block();
    writer.said.conditions.put(VarId::Work, Some(work));
    Ok(())
}
