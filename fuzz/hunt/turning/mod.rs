//! Programs of lathes: random ones, and a machine that runs them by the manuals of their controls.

/// A line of a program that is written.
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
