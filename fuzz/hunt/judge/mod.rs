//! A judge of its own: a small machine that runs programs, and the cuts that a job asks for. Nothing here knows how
//! postform reads, plans or compares.

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

/// A place: x y z, and three angles; not a number where only the machine knows.
pub type Place = [f64; 6];

/// Millimetres in an inch.
pub const INCH: f64 = 25.4;

/// Within so many millimetres; two places that only the machine knows are the same.
pub fn near(a: f64, b: f64, within: f64) -> bool {
    (a.is_nan() && b.is_nan()) || (a - b).abs() <= within
}

/// The same place; whole turns of a rotary axis do not count.
pub fn same(a: &Place, b: &Place, within: f64) -> bool {
    (0..3).all(|axis| near(a[axis], b[axis], within)) && turned(a, b)
}

/// The same angles but for whole turns.
pub fn turned(a: &Place, b: &Place) -> bool {
    (3..6).all(|axis| {
        let apart = (a[axis] - b[axis]).rem_euclid(360.0);
        near(a[axis], b[axis], 0.01) || !(0.01..=359.99).contains(&apart)
    })
}
