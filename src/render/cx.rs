//! What everything that prints goes through: the form, what the job asks for, what the control holds, and the text.

use super::printer::Printer;
use super::said::Said;
use super::shape::Shape;
use super::want::Want;

/// The state of a renderer, lent to what serves an event: it may give variables the values of the next block.
pub struct Cx<'a> {
    /// The form for this job.
    pub shape: &'a Shape<'a>,
    /// What the job asks for now.
    pub want: &'a mut Want,
    /// What the control holds by what was printed.
    pub said: &'a mut Said,
    /// The text, block by block.
    pub out: &'a mut Printer,
}

impl Cx<'_> {
    /// The same for words and blocks.
    #[inline]
    pub fn writer(&mut self) -> Writer<'_> {
        Writer { shape: self.shape, want: self.want, said: self.said, out: self.out }
    }
}

/// The state of a renderer, lent to what prints words and blocks: what the job asks for stays as it is.
pub struct Writer<'a> {
    /// The form for this job.
    pub shape: &'a Shape<'a>,
    /// What the job asks for now.
    pub want: &'a Want,
    /// What the control holds by what was printed.
    pub said: &'a mut Said,
    /// The text, block by block.
    pub out: &'a mut Printer,
}

impl Writer<'_> {
    /// The same for a while.
    #[inline]
    pub fn lend(&mut self) -> Writer<'_> {
        Writer { shape: self.shape, want: self.want, said: self.said, out: self.out }
    }
}
