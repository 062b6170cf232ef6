//! Calculates the lowest height of a moving tool over a point.

/// The shape of a rotating tool with a vertical axis: its bottom is flat, with a rounded corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shape {
    /// Radius of the tool in millimetres.
    pub radius: f64,
    /// Corner radius of the tool in millimetres. If the corner radius equals the radius of the tool, the tool is a ball
    /// end mill.
    pub corner: f64,
}

impl Shape {
    /// Height of the tool's surface above its tip at a distance from the axis. The distance is at most the radius of the tool.
    fn rise(self, away: f64) -> f64 {
        let beyond = away - (self.radius - self.corner);
        if beyond <= 0.0 { 0.0 } else { self.corner - (self.corner * self.corner - beyond * beyond).max(0.0).sqrt() }
    }

    /// The lowest height of the tool over a point while its tip moves straight by `way` from the height `from`. `None`:
    /// the tool is never over the point. `x` and `y` are the position of the point relative to the start of the tip.
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
        // the part of the move during which the tool is over the point
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
        // as a function of the part of the move, the height is convex: it is the sum of a line and a rounded corner
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

/// Each step of the search makes the interval a third shorter: after 20 steps, a 3000th of the move over the point is
/// left.
const NARROWINGS: u32 = 20;
