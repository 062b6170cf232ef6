//! Numbers as a control reads them.
//!
//! Each value is converted once to a whole number (quantised). The unit of this whole number is the last decimal in the
//! format of the letter. Rounding uses the shortest decimal number that reads back as the value, and halves are rounded
//! away from zero. The whole number is used for comparing and for printing.

mod format;
mod quantise;
mod read;
mod write;

pub use format::{Digits, LetterFormat, Point, Sign};
pub(crate) use quantise::nearest;
pub use quantise::{POWERS, quantise};
pub use read::{decimal, short_decimal};
pub use write::{Lead, Printing, Unprintable, write_number};
