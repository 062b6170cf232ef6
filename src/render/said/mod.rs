//! What the control holds now, by what the program printed: letters, modal groups, conditions, the frame of axis words, and
//! where the tool stands. Everything that may have changed the machine behind our back makes it unknown here.

mod angles;
mod beside;
mod codes;
mod conditions;
mod due;
mod lacks;
mod line;
mod own;
mod registers;
mod stand;
mod state;
mod text;

pub use angles::Angles;
pub use beside::Beside;
pub use conditions::{CONDITIONS, Conditions};
pub use line::Line;
pub use own::Own;
pub use state::{LastMove, Said, Spins};
pub use text::{TextWord, words_of};
