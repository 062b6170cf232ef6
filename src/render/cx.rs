//! The shared state of rendering: the form, the values of the job, the state of the control, and the output.

use super::printer::Printer;
use super::said::Said;
use super::shape::Shape;
use super::want::Want;

/// The state of a renderer, borrowed by the functions that handle an event. These functions may set values for the next
/// block.
pub struct Cx<'a> {
    /// The form for this job.
    pub shape: &'a Shape<'a>,
    /// Values that the job requests now.
    pub want: &'a mut Want,
    /// State of the control, as known from the printed blocks.
    pub said: &'a mut Said,
    /// Output, block by block.
    pub out: &'a mut Printer,
}

impl Cx<'_> {
    /// The state of the renderer, borrowed for printing words and blocks.
    #[inline]
    pub fn writer(&mut self) -> Writer<'_> {
        Writer { shape: self.shape, want: self.want, said: self.said, out: self.out }
    }
}

/// The state of a renderer, borrowed by the functions that print words and blocks. These functions do not change the
/// job's values.
pub struct Writer<'a> {
    /// The form for this job.
    pub shape: &'a Shape<'a>,
    /// Values that the job requests now.
    pub want: &'a Want,
    /// State of the control, as known from the printed blocks.
    pub said: &'a mut Said,
    /// Output, block by block.
    pub out: &'a mut Printer,
}

impl Writer<'_> {
    /// Reborrows the writer for a shorter time.
    #[inline]
    pub fn lend(&mut self) -> Writer<'_> {
        Writer { shape: self.shape, want: self.want, said: self.said, out: self.out }
    }
}
