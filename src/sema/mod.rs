//! Converts the syntax tree of a form to a checked form: resolves names, reads arguments and formats, and checks limits.

mod args;
mod called;
mod check;
mod code;
mod expression;
mod file_name;
mod flow;
mod formula;
mod library;
mod limits;
mod messages;
mod model;
mod names;
mod near;
mod property;
mod sequences;
mod settings;
mod special;
mod statements;
mod step;
mod store;
mod upon_sets;
mod value_names;
mod words;

pub use check::{Checked, analyse};
pub use code::Code;
pub use file_name::{NamePart, is_of_file_names};
pub use formula::{Formula, Value, Values, Without};
pub use library::one_post;
pub use limits::{Limits, MOST_LINES, MOST_TEXT, MOST_WORDS};
pub use model::{Form, Line, Sequence, Word, WordKind, kind_of_remark};
pub use property::{Property, PropertyKind, PropertyValue, Target, check_name};
pub use settings::{ArcCentre, LineEnd, Replacement, SequenceNumbers, Settings};
pub use step::{Step, each_formula, each_step, line_counts};
pub use words::before_remark;
