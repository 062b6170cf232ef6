//! The lowest height of a moving tool over a point.

/// A tool that turns about a vertical axis: flat at the bottom, with a rounded corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shape {
    /// Radius of the tool in millimetres.
    pub radius: f64,
    /// Radius of its corner, at most the radius; equal to it: a ball.
    pub corner: f64,
}

impl Shape {
    /// Height of the tool's surface above its tip, at a distance from its axis of at most its radius.
    fn rise(self, away: f64) -> f64 {
        let beyond = away - (self.radius - self.corner);
        if beyond <= 0.0 { 0.0 } else { self.corner - (self.corner * self.corner - beyond * beyond).max(0.0).sqrt() }
    }

    /// The lowest height of the tool over a point, while its tip moves straight by `way` from the height `from`; `None` if it
    /// is never over the point. `x` and `y`: position of the point relative to the start of the tip.
    pub fn lowest(self, [x, y]: [f64; 2], from: f64, [dx, dy, dz]: [f64; 3]) -> Option<f64> {
        let length = dx * dx + dy * dy;
        if length == 0.0 {
            let away = x.hypot(y);
            return (away <= self.radius).then(|| from + dz.min(0.0) + self.rise(away));
        }
        let nearest = (x * dx + y * dy) / length;
        let (aside_x, aside_y) = (x - nearest * dx, y - nearest * dy);
        let room = self.radius * self.radius - aside_x * aside_x - aside_y * aside_y;
        if room < 0.0 {
            return None;
        }
        // the part of the way on which the tool is over the point
        let reach = (room / length).sqrt();
        let (first, last) = ((nearest - reach).max(0.0), (nearest + reach).min(1.0));
        if first > last {
            return None;
        }
        let height = |part: f64| from + dz * part + self.rise((x - part * dx).hypot(y - part * dy).min(self.radius));
        if self.corner <= 0.0 {
            return Some(from + dz * if dz < 0.0 { last } else { first });
        }
        if dz == 0.0 {
            return Some(height(nearest.clamp(first, last)));
        }
        // the height is a convex function of the part: a sum of a line and a rounded corner
        let (mut low, mut high) = (first, last);
        for _ in 0..NARROWINGS {
            let third = (high - low) / 3.0;
            if height(low + third) <= height(high - third) {
                high -= third;
            } else {
                low += third;
            }
        }
        Some(height(f64::midpoint(low, high)).min(height(first)).min(height(last)))
    }
}

/// Each makes the interval a third shorter: 20 leave a 3000th of the way over a point.
const NARROWINGS: u32 = 20;
