//! Arcs and canned cycles of the machine.

use super::{Block, INCH, Machine, What};
use crate::judge::Place;

impl Machine {
    pub(super) fn arc(&mut self, block: &Block<'_>, to: Place, line: usize) -> Result<(), String> {
        let ccw = self.motion == 3.0;
        let [first, second] = match self.plane {
            18.0 => [2, 0],
            19.0 => [1, 2],
            _ => [0, 1],
        };
        let from = [self.at[first], self.at[second]];
        let end = [to[first], to[second]];
        let center = match block.get(b'R') {
            Some(radius) => by_radius(from, end, radius * self.scale, ccw).ok_or("no such arc")?,
            None => {
                let word = |axis: usize| block.get(b"IJK"[axis]).map(|number| number * self.scale);
                let base = if self.centres_absolute { [0.0; 2] } else { from };
                let said = [word(first), word(second)];
                if said == [None; 2] {
                    return Err("an arc without a centre".into());
                }
                [base[0] + said[0].unwrap_or(0.0), base[1] + said[1].unwrap_or(0.0)]
            }
        };
        let radii = [from, end].map(|place| (place[0] - center[0]).hypot(place[1] - center[1]));
        if (radii[0] - radii[1]).abs() > 0.03 {
            return Err("the ends of the arc lie on no circle".into());
        }
        let turns = block.get(b'P').unwrap_or(1.0) - 1.0;
        self.act(line, What::Arc { plane: self.plane, center, ccw, turns }, to);
        Ok(())
    }

    /// G33.1 of LinuxCNC: down in step with the spindle, and back up to the start; K is the lead.
    pub(super) fn rigid_tap(&mut self, block: &Block<'_>, line: usize) -> Result<(), String> {
        let pitch = block.get(b'K').ok_or("G33.1 without K")? * self.scale;
        if self.state.direction == 5.0 || self.state.speed <= 0.0 {
            return Err("G33.1 with the spindle off".into());
        }
        let (from, feed) = (self.at, self.state.feed);
        let to = self.target(block, false);
        self.state.feed = (pitch * self.state.speed, 94.0);
        self.act(line, What::Feed, to);
        self.act(line, What::Feed, from);
        self.state.feed = feed;
        Ok(())
    }

    pub(super) fn hole(&mut self, block: &Block<'_>, line: usize) -> Result<(), String> {
        let (scale, absolute, here) = (self.scale, self.absolute, self.at);
        let to = self.target(block, false);
        let (to_r, high) = (self.to_r, self.shift[2]);
        let Some(cycle) = &mut self.cycle else { return Ok(()) };
        if let Some(r) = block.get(b'R') {
            cycle.r = Some(if absolute { r * scale + high } else { cycle.initial + r * scale });
        }
        if let Some(z) = block.get(b'Z') {
            let base = if absolute { high } else { cycle.r.unwrap_or(f64::NAN) };
            cycle.z = Some(base + z * scale);
        }
        if let Some(q) = block.get(b'Q') {
            cycle.q = q * scale;
        }
        if let Some(p) = block.get(b'P') {
            cycle.p = p;
        }
        let by_pitch = self.control == "brother" && matches!(cycle.code, 84.0 | 74.0);
        if by_pitch {
            let threads = block.get(b'J').map(|threads| INCH / threads);
            cycle.pitch = block.get(b'I').or(threads).or(cycle.pitch);
        }
        for (axis, letter) in b"IJ".iter().enumerate().filter(|_| !by_pitch) {
            if let Some(number) = block.get(*letter) {
                cycle.jog[axis] = number * scale;
            }
        }
        let (Some(r), Some(z)) = (cycle.r, cycle.z) else { return Err("a cycle without R or Z".into()) };
        let out = if to_r { r } else { cycle.initial.max(r) };
        let out = if cycle.initial.is_nan() && !to_r { f64::NAN } else { out };
        let seconds = self.family.dwell(&self.control, cycle.p);
        let code = cycle.code;
        let p = if matches!(code, 82.0 | 86.0 | 88.0 | 89.0 | 84.0 | 74.0 | 76.0 | 87.0) { seconds } else { 0.0 };
        let feed = self.state.feed;
        if let Some(pitch) = cycle.pitch {
            let turns = if feed.1 == 95.0 { 1.0 } else { self.state.speed };
            self.state.feed.0 = pitch * turns;
        }
        let what = What::Hole { code, r, z, out, q: cycle.q, p, jog: cycle.jog };
        if self.state.feed.0.is_nan() {
            return Err("no feed".into());
        }
        // the tool moves up to R if it is lower, then across, then down
        let mut over = to;
        over[2] = if here[2] < r { r } else { here[2] };
        if here[2] < r {
            let mut up = here;
            up[2] = r;
            self.act(line, What::Rapid, up);
        }
        self.act(line, What::Rapid, over);
        let mut end = over;
        end[2] = out;
        self.act(line, what, end);
        self.state.feed = feed;
        // a tap starts a stopped spindle
        match code {
            84.0 if self.state.direction == 5.0 => self.state.direction = 3.0,
            74.0 if self.state.direction == 5.0 => self.state.direction = 4.0,
            _ => {}
        }
        Ok(())
    }
}

/// The centre of an arc from its radius; a negative radius means the longer arc.
pub(in crate::judge) fn by_radius(from: [f64; 2], end: [f64; 2], radius: f64, ccw: bool) -> Option<[f64; 2]> {
    let (dx, dy) = (end[0] - from[0], end[1] - from[1]);
    let chord = dx.hypot(dy);
    let square = radius * radius - chord * chord / 4.0;
    if chord == 0.0 || square < -0.02 * radius.abs() {
        return None;
    }
    let height = square.max(0.0).sqrt();
    // the centre of a short counter-clockwise arc is to the left of the chord
    let side = if ccw == (radius > 0.0) { 1.0 } else { -1.0 };
    let middle = [(from[0] + end[0]) / 2.0, (from[1] + end[1]) / 2.0];
    Some([middle[0] - side * height * dy / chord, middle[1] + side * height * dx / chord])
}
