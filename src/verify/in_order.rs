//! Compares paths of lathes and wire EDM machines. There, a rapid can meet the part from every direction. Therefore the
//! tool must go to the same positions in the same order.

use super::cut::{ALL, DEPTH, RADIUS, Rapid, lies_between, same, shown};
use crate::lang::Machine;

/// The coordinates X, Y and Z, as bits.
const XYZ: u8 = 0b111;

/// The rule by which one path must follow another path.
#[derive(Clone, Copy, Debug)]
pub(super) struct InOrder {
    /// The axes of the machine among X, Y and Z, as bits.
    axes: u8,
    /// Whether two rapids may replace a slanted rapid, with the corner at the greater of its two heights.
    may_round: bool,
}

/// The positions of a path whose axes are all known.
#[derive(Clone, Copy, Debug)]
struct Corner {
    at: Rapid,
    /// The position before and the position after this position, if one axis is known only at the machine there. The
    /// other axis then moves first.
    beside: [Option<Rapid>; 2],
}

impl InOrder {
    /// The rule of a machine. `None`: on a mill, another path above the part is allowed.
    pub fn of(machine: Machine) -> Option<InOrder> {
        match machine {
            Machine::Mill => None,
            Machine::Lathe => Some(InOrder { axes: 1 << RADIUS | 1 << DEPTH, may_round: true }),
            Machine::Edm => Some(InOrder { axes: 0b011, may_round: false }),
        }
    }

    /// A corner in a message: its known axes.
    pub fn shown(self, corner: &Rapid) -> String {
        shown(&corner.to, self.axes & !corner.unknown)
    }

    /// Whether this position is known on all axes of the machine.
    pub fn is_known(self, at: &Rapid) -> bool {
        self.unknown(at) == 0
    }

    /// Of this position, the axes that are known only at the machine, as bits. Axes that the machine does not have are
    /// left out.
    fn unknown(self, at: &Rapid) -> u8 {
        at.unknown & (self.axes | !XYZ)
    }

    fn corners(self, path: &[Rapid]) -> Vec<Corner> {
        let is_partly = |at: &&Rapid| {
            let unknown = self.unknown(at);
            unknown != 0 && unknown & !self.axes == 0 && unknown != self.axes
        };
        let partly = |at: Option<usize>| at.and_then(|at| path.get(at)).filter(is_partly).copied();
        let known = path.iter().enumerate().filter(|(_, corner)| self.unknown(corner) == 0);
        known
            .map(|(at, corner)| Corner { at: *corner, beside: [partly(at.checked_sub(1)), partly(Some(at + 1))] })
            .collect()
    }

    /// The first different positions before and after two equal corners. If an axis is known only at the machine there in
    /// the path of `a`, the same axis must be unknown in the path of `b`. Otherwise the axes may move in any order.
    fn other_beside(self, a: &Corner, b: &Corner, tolerance: f64) -> Option<[Option<Rapid>; 2]> {
        let is = |a: &Rapid, b: &Rapid| {
            let unknown = self.unknown(a);
            self.unknown(b) == unknown && same(&a.to, &b.to, ALL & !unknown, tolerance)
        };
        let mut pairs = a.beside.into_iter().zip(b.beside);
        let other = pairs.find(|(a, b)| a.is_some_and(|a| !b.is_some_and(|b| is(&a, &b))));
        other.map(|(own, made)| [own, Some(made.unwrap_or(b.at))])
    }

    /// Checks that the path `other` follows the path `own`. `other` may stop on the path and may go straight on over its
    /// corners. If an axis of `own` is known only at the machine before or after a known position, the axes of `other`
    /// must move in the same order there. Returns the number of slanted rapids that two rapids replace. The error contains
    /// the first different corner of `own` and of `other`.
    pub fn follows(self, own: &[Rapid], other: &[Rapid], tolerance: f64) -> Result<u64, Box<[Option<Rapid>; 2]>> {
        let near = |a: f64, b: f64| (a - b).abs() <= tolerance;
        let is = |a: &Rapid, b: &Rapid| same(&a.to, &b.to, ALL, tolerance);
        let between = |a: &Rapid, b: &Rapid, c: &Rapid| lies_between(&a.to, &b.to, &c.to, tolerance);
        let round = |from: &Rapid, at: &Rapid, to: &Rapid| {
            near(at.to[DEPTH], from.to[DEPTH].max(to.to[DEPTH]))
                && [from, to].iter().any(|end| near(at.to[RADIUS], end.to[RADIUS]))
        };
        let [own, other] = [own, other].map(|path| self.corners(path));
        let (mut own, mut other) = (own.iter().peekable(), other.iter().peekable());
        let (mut here, mut rounds): (Option<Rapid>, u64) = (None, 0);
        loop {
            let corners = [own.peek().copied(), other.peek().copied()];
            // the path to this corner does not begin at the corner before
            here = here.filter(|_| corners[0].is_none_or(|corner| corner.beside[0].is_none()));
            let [a, b] = corners.map(|corner| corner.map(|corner| corner.at));
            let [takes_own, takes_other] = match (a, b, here) {
                (None, None, _) => return Ok(rounds),
                (Some(a), Some(b), _) if is(&a, &b) => {
                    if let Some(others) =
                        corners[0].zip(corners[1]).and_then(|(a, b)| self.other_beside(a, b, tolerance))
                    {
                        return Err(Box::new(others));
                    }
                    [true, true]
                }
                // a move of no length
                (_, Some(b), Some(at)) if is(&at, &b) => [false, true],
                (Some(a), _, Some(at)) if is(&at, &a) => [true, false],
                // the other path goes straight on beyond this corner, or stops before it
                (Some(a), Some(b), Some(at)) if between(&at, &a, &b) => [true, false],
                (Some(a), Some(b), Some(at)) if between(&at, &b, &a) => [false, true],
                (Some(a), Some(b), Some(at)) if self.may_round && round(&at, &b, &a) => {
                    rounds += 1;
                    [false, true]
                }
                _ => return Err(Box::new([a, b])),
            };
            here = if takes_own { own.next().map(|corner| corner.at) } else { b };
            if takes_other {
                other.next();
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::cut::place;
    use super::*;

    fn way(points: &[[f64; 3]]) -> Vec<Rapid> {
        let rapid =
            |&[x, y, z]: &[f64; 3]| Rapid { to: place(&[x, y, z, 0.0, 0.0, 0.0]), unknown: 0, kept: 0, spin: None };
        points.iter().map(rapid).collect()
    }

    #[test]
    fn a_slanted_rapid_may_go_round_its_corner_farther_out() {
        let rule = InOrder::of(Machine::Lathe).unwrap();
        let job = way(&[[1.5, 0.0, 0.4], [0.0, 0.0, 0.2], [0.0, 0.0, 0.1]]);
        let followed = |points: &[[f64; 3]]| rule.follows(&job, &way(points), 1e-4).ok();
        assert_eq!(followed(&[[1.5, 0.0, 0.4], [0.0, 0.0, 0.2], [0.0, 0.0, 0.1]]), Some(0));
        assert_eq!(followed(&[[1.5, 0.0, 0.4], [0.0, 0.0, 0.4], [0.0, 0.0, 0.1]]), Some(1));
        assert_eq!(followed(&[[1.5, 0.0, 0.4], [1.5, 0.0, 0.2], [0.0, 0.0, 0.1]]), None);
        assert_eq!(followed(&[[1.5, 0.0, 0.4], [0.0, 0.0, 0.4], [0.0, 0.0, 0.15]]), None);
        assert_eq!(followed(&[[1.5, 0.0, 0.4]]), None);
    }
}
