//! Prints the parts of a line that are not words with letters: text, values inside text, and comments.

use super::Body;
use crate::lang::VarId;
use crate::render::fault::Done;
use crate::render::texts;
use crate::render::values::property_text;

impl Body<'_> {
    /// Whether all texts of the comment at the index `at` of the compiled operations are empty in this job.
    pub(super) fn comment_is_empty(&self, at: usize, words: usize) -> bool {
        texts::are_empty(&self.writer.shape.program.ops[at + 1..][..words], &self.writer.want.texts, &|row| {
            property_text(row, self.writer.want, self.writer.said).is_empty()
        })
    }

    /// Analyses the text that was printed since the last word.
    pub(super) fn read_text(&mut self) {
        if !self.text.is_empty() {
            self.writer.said.text(&self.text, self.line(), self.writer.want, self.writer.shape);
            self.text.clear();
        }
    }

    /// Prints a value that has no letter and that the control reads.
    pub(super) fn bare_word(&mut self, var: VarId, glued: bool) -> Done {
        let Some(value) = self.value_of(var, b' ')? else { return Ok(()) };
        self.counts_from(b' ', var, value);
        self.writer.out.bare(value, &self.writer.shape.letters.bare, glued)?;
        if var == VarId::Block {
            self.writer.out.prints_number();
        }
        self.condition_word(b' ', var, value);
        Ok(())
    }
}
