//! An independent judge: a small machine that runs programs, and the list of cuts that a job requests. It shares no
//! code with postform's readers, planner and comparison.

pub mod beam;
pub mod done;
pub mod languages;
pub mod lathe;
mod machine;
mod modes;
pub mod planned;
mod scan;
mod wants;
pub mod wire;

pub mod against;
pub mod pair;
pub mod rs274;

pub use machine::{Act, MAIN, State, What, run};
pub use wants::{Want, Wanted, wants};

/// A position: X, Y, Z and three angles. NaN: only the machine has the value.
pub type Place = [f64; 6];

/// Millimetres in an inch.
pub const INCH: f64 = 25.4;

/// Whether two values are equal within this number of millimetres. Two unknown values count as equal.
pub fn near(a: f64, b: f64, within: f64) -> bool {
    (a.is_nan() && b.is_nan()) || (a - b).abs() <= within
}

/// Whether two positions are equal. Whole turns of a rotary axis are ignored.
pub fn same(a: &Place, b: &Place, within: f64) -> bool {
    (0..3).all(|axis| near(a[axis], b[axis], within)) && turned(a, b)
}

/// Whether the angles of two positions are equal, apart from whole turns.
pub fn turned(a: &Place, b: &Place) -> bool {
    (3..6).all(|axis| {
        let apart = (a[axis] - b[axis]).rem_euclid(360.0);
        near(a[axis], b[axis], 0.01) || !(0.01..=359.99).contains(&apart)
    })
}
