//! Numbers as a machine control reads them.
//!
//! A value is quantised once to whole units of the last decimal of its letter. Rounding is half away from zero of the shortest
//! decimal that denotes the value. The quantised value is then compared and printed.

mod format;
mod quantise;
mod read;
mod write;

pub use format::{Digits, LetterFormat, Point, Sign};
pub(crate) use quantise::nearest;
pub use quantise::{POWERS, quantise};
pub use read::short_decimal;
pub use write::{Lead, Printing, Unprintable, write_number};
