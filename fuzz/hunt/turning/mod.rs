//! Random programs for lathes, and a machine that runs them according to the manuals of their controls.

/// Adds a line to the program that is being written.
macro_rules! put {
    ($writer:expr, $($text:tt)*) => {{
        let line = format!($($text)*);
        $writer.line(&line);
    }};
}

pub mod against;
pub mod change;
pub mod contour;
mod corner;
pub mod cycles;
pub mod executor;
pub mod lexer;
pub mod profile;
pub mod program;
pub mod unroll;
