//! What the control holds now, by what the program printed: letters, modal groups, conditions, the frame of axis words, and
//! where the tool stands. Everything that may have changed the machine behind our back makes it unknown here.

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
