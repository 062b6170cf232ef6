//! Boxes that no rapid may enter, such as clamps and vices.

/// A box whose position is given in a work offset.
#[derive(Clone, Debug, PartialEq)]
pub struct Fixture {
    /// Name of the box in the shop.
    pub name: Option<String>,
    /// Number of the work offset in which the box is.
    pub work: usize,
    /// The least X, Y and Z of the box, in millimetres.
    pub least: [f64; 3],
    /// The greatest X, Y and Z of the box, in millimetres.
    pub greatest: [f64; 3],
}

/// A tool that moves along a straight path. The tool is a cylinder above its tip.
#[derive(Clone, Copy, Debug)]
pub struct Sweep {
    /// Position of the tip at the start of the path.
    pub from: [f64; 3],
    /// Position of the tip at the end of the path.
    pub to: [f64; 3],
    /// Radius of the tool, in millimetres.
    pub radius: f64,
    /// Length of the tool above its tip. An unknown length counts as infinite, because the spindle is above the tool.
    pub length: f64,
}

impl Fixture {
    /// Whether a tool on a straight path enters the box. A tool that only touches the box does not enter it.
    pub fn is_entered(&self, sweep: &Sweep) -> bool {
        let Some([begin, end]) = self.at_its_height(sweep) else { return false };
        let at = |part: f64| {
            std::array::from_fn::<f64, 2, _>(|axis| sweep.from[axis] + part * (sweep.to[axis] - sweep.from[axis]))
        };
        self.distance(at(begin), at(end)) < sweep.radius.max(TOUCH)
    }

    /// The part of the path on which the cylinder is at the height of the box. The part is given as two fractions of
    /// the path.
    fn at_its_height(&self, sweep: &Sweep) -> Option<[f64; 2]> {
        let (mut begin, mut end) = (0.0f64, 1.0f64);
        let rise = sweep.to[2] - sweep.from[2];
        // the tip must be below the top of the box, and the upper end of the tool above its bottom
        for (above, sign) in [
            (self.greatest[2] - TOUCH - sweep.from[2], 1.0),
            (sweep.from[2] + sweep.length - self.least[2] - TOUCH, -1.0),
        ] {
            let slope = sign * rise;
            // the condition is: slope * part < above
            if slope == 0.0 || !above.is_finite() {
                if above <= 0.0 {
                    return None;
                }
            } else if slope > 0.0 {
                end = end.min(above / slope);
            } else {
                begin = begin.max(above / slope);
            }
        }
        (begin <= end).then_some([begin, end])
    }

    /// The least distance between a straight path and the box in X and Y. The distance is 0 if the path enters the box.
    fn distance(&self, from: [f64; 2], to: [f64; 2]) -> f64 {
        let (least, greatest) = (&self.least, &self.greatest);
        if crosses(from, to, [least[0], least[1]], [greatest[0], greatest[1]]) {
            return 0.0;
        }
        let corners =
            [[least[0], least[1]], [least[0], greatest[1]], [greatest[0], least[1]], [greatest[0], greatest[1]]];
        let to_box = |at: [f64; 2]| {
            let apart = |axis: usize| (least[axis] - at[axis]).max(at[axis] - greatest[axis]).max(0.0);
            apart(0).hypot(apart(1))
        };
        let ends = to_box(from).min(to_box(to));
        corners.into_iter().map(|corner| to_way(corner, from, to)).fold(ends, f64::min)
    }
}

/// Tolerance for touching, in millimetres.
const TOUCH: f64 = 1e-6;

/// Whether a part of the path is inside the box. The result is calculated from the fractions at which the path enters
/// and leaves each pair of sides.
fn crosses(from: [f64; 2], to: [f64; 2], least: [f64; 2], greatest: [f64; 2]) -> bool {
    let (mut begin, mut end) = (0.0f64, 1.0f64);
    for axis in 0..2 {
        let step = to[axis] - from[axis];
        if step == 0.0 {
            if from[axis] <= least[axis] + TOUCH || from[axis] >= greatest[axis] - TOUCH {
                return false;
            }
            continue;
        }
        let (first, second) = ((least[axis] + TOUCH - from[axis]) / step, (greatest[axis] - TOUCH - from[axis]) / step);
        begin = begin.max(first.min(second));
        end = end.min(first.max(second));
    }
    begin <= end
}

/// The distance between a point and a path.
fn to_way(point: [f64; 2], from: [f64; 2], to: [f64; 2]) -> f64 {
    let step = [to[0] - from[0], to[1] - from[1]];
    let length = step[0] * step[0] + step[1] * step[1];
    let along = (point[0] - from[0]) * step[0] + (point[1] - from[1]) * step[1];
    let part = if length == 0.0 { 0.0 } else { (along / length).clamp(0.0, 1.0) };
    (from[0] + part * step[0] - point[0]).hypot(from[1] + part * step[1] - point[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn enters(from: [f64; 3], to: [f64; 3], radius: f64, length: f64) -> bool {
        let fixture = Fixture { name: None, work: 1, least: [0.0, 0.0, -10.0], greatest: [20.0, 10.0, 5.0] };
        fixture.is_entered(&Sweep { from, to, radius, length })
    }

    #[test]
    fn a_tool_is_a_cylinder_over_its_tip() {
        let over = 1e9;
        assert!(enters([-50.0, 5.0, 0.0], [50.0, 5.0, 0.0], 0.0, over));
        assert!(!enters([-50.0, 5.0, 5.0], [50.0, 5.0, 5.0], 3.0, over), "on its top face");
        assert!(!enters([-50.0, 15.0, 0.0], [50.0, 15.0, 0.0], 5.0, over), "touches with the side of the tool");
        assert!(enters([-50.0, 14.9, 0.0], [50.0, 14.9, 0.0], 5.0, over));
        // past a corner, at a distance of 5 (3, 4, 5)
        assert!(!enters([23.0, 14.0, 0.0], [23.0, 14.0, -5.0], 4.99, over));
        assert!(enters([23.0, 14.0, 0.0], [23.0, 14.0, -5.0], 5.01, over));
        // down beside the box; then into the box from above, where the tool is high at first
        assert!(!enters([10.0, 5.0, 20.0], [50.0, 5.0, -20.0], 1.0, over));
        assert!(enters([10.0, 5.0, 20.0], [20.0, 5.0, 0.0], 1.0, over));
        // a short tool far below the box passes under it
        assert!(!enters([-50.0, 5.0, -100.0], [50.0, 5.0, -100.0], 1.0, 50.0));
        assert!(enters([-50.0, 5.0, -100.0], [50.0, 5.0, -100.0], 1.0, over));
    }
}
