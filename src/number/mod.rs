//! Numbers as a machine control reads them.
//!
//! A value is quantised once to whole units of the last decimal of its letter, half away from zero of the
//! shortest decimal that denotes the value; it is compared and printed from there.

mod format;
mod quantise;
mod write;

pub use format::{Digits, LetterFormat, Point, Sign};
pub use quantise::{POWERS, quantise};
pub use write::{Unprintable, write_number};
