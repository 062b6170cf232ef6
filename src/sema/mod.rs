//! From the tree to a checked form: names, arguments, formats, limits.

mod args;
mod check;
mod messages;
mod model;
mod settings;
mod words;

pub use check::{Checked, Limits, MOST_LINES, MOST_WORDS, analyse};
pub use model::{Form, Line, Sequence, Upon, Word, WordKind, kind_of_remark};
pub use settings::{ArcCentre, Code, DwellWord, Prompt, SequenceNumbers, Settings, TravelLimit, UnitChoice};
pub use words::before_remark;
