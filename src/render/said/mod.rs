//! The state of the control, as known from the printed program: letters, modal groups, conditions, the frame of axis
//! words, and the tool's position. Anything else that may have changed the machine makes the state unknown.

mod angles;
mod codes;
mod conditions;
mod due;
mod form_values;
mod lacks;
mod line;
mod more_coolants;
mod position;
mod registers;
mod state;
mod text;

pub use angles::Angles;
pub use conditions::{CONDITIONS, Conditions};
pub use form_values::Own;
pub use line::Line;
pub use more_coolants::Beside;
pub use state::{LastMove, Said, Spins};
pub use text::{TextWord, words_of};
