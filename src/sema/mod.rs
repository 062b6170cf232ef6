//! From the tree to a checked form: names, arguments, formats, limits.

mod args;
mod called;
mod check;
mod code;
mod library;
mod limits;
mod messages;
mod model;
mod sequences;
mod settings;
mod special;
mod statements;
mod store;
mod words;

pub use check::{Checked, analyse};
pub use code::Code;
pub use limits::{Limits, MOST_LINES, MOST_TEXT, MOST_WORDS};
pub use model::{Form, Line, Sequence, Upon, Word, WordKind, kind_of_remark};
pub use settings::{ArcCentre, DwellWord, Prompt, Replacement, SequenceNumbers, Settings, TravelLimit};
pub use words::before_remark;
