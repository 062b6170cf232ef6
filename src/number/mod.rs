//! Numbers as a control reads them.
//!
//! A value is converted once to a whole number of units of the last decimal of its letter (quantised). Rounding uses the
//! shortest decimal of the value, and halves are rounded away from zero. The result is used for comparing and for printing.

mod format;
mod quantise;
mod read;
mod write;

pub use format::{Digits, LetterFormat, Point, Sign};
pub(crate) use quantise::nearest;
pub use quantise::{POWERS, quantise};
pub use read::{decimal, short_decimal};
pub use write::{Lead, Printing, Unprintable, write_number};
