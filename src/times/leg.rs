//! A piece of path in one direction.

/// A leg of the path. Speeds are stored as squares, because a leg of length `s` at acceleration `a` changes the square by `2 a s`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Leg {
    /// Length in millimetres, or in degrees if only rotary axes move.
    pub length: f64,
    /// Square of the speed that the leg would have without the adjacent legs.
    pub speed: f64,
    pub acceleration: f64,
    /// Square of the greatest speed at the beginning of the leg. The corner at the beginning limits this speed.
    pub most_entry: f64,
    /// Square of the speed at the beginning of the leg, as planned so far.
    pub entry: f64,
    pub is_cut: bool,
    /// The row of the leg in the times of blocks.
    pub row: usize,
}

impl Leg {
    /// The square of the speed that the leg reaches at one end if the square is `speed` at the other end.
    pub fn reached_from(&self, speed: f64) -> f64 {
        2.0f64.mul_add(self.acceleration * self.length, speed)
    }

    /// The time of the leg in seconds, if `exit` is the square of the speed at its end.
    pub fn seconds(&self, exit: f64) -> f64 {
        let (entry, exit) = (self.entry.min(self.speed), exit.min(self.speed));
        if self.acceleration.is_infinite() {
            return self.length / self.speed.sqrt();
        }
        let change = 2.0 * self.acceleration;
        // without a speed limit, the leg would accelerate up to its middle
        let peak = ((change * self.length + entry + exit) / 2.0).min(self.speed).max(entry).max(exit);
        let ramps = (2.0 * peak - entry - exit) / change;
        let steady = (self.length - ramps).max(0.0);
        let speed = peak.sqrt();
        let turning = (2.0 * speed - entry.sqrt() - exit.sqrt()) / self.acceleration;
        turning + if steady > 0.0 { steady / speed } else { 0.0 }
    }
}
