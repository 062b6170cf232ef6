//! G70 to G76, G90, G92 and G94, from the sections "Canned cycle" and "Multiple repetitive cycle" of FANUC's manual (B-64304EN 4.1
//! and 4.2) and the pages of Haas's lathe manual for the same codes.

use super::corner::Corner;
use super::executor::{Kind, Machine, Point, Stopped, Words, alarm, unsure};

const NEAR: f64 = 1e-7;
/// A cut that is shorter than this length does not count as a cut.
const SHORT: f64 = 1e-5;
/// Settings 73 and 22 of a Haas with factory defaults, in inches: the retract of G71 and G72, and of pecks.
const BACK: f64 = 0.05;

/// A block of a profile.
#[derive(Clone, Copy, Debug)]
struct Part {
    kind: Kind,
    from: Point,
    to: Point,
    /// The feed in the block, used for the finish.
    feed: Option<f64>,
    speed: Option<f64>,
}

/// A block of a profile, moved by a finishing allowance.
fn moved(part: &Part, by: Point) -> (Kind, Point) {
    let shift = |at: Point| [at[0] + by[0], at[1] + by[1]];
    let kind = match part.kind {
        Kind::Arc(center, ccw) => Kind::Arc(shift(center), ccw),
        other => other,
    };
    (kind, shift(part.to))
}

impl Machine<'_> {
    /// Runs G90, G92 and G94. Their words stay active for later blocks without these words (B-64304EN 4.1).
    pub(super) fn box_cycle(&mut self, words: &Words, to: Point) -> Result<(), Stopped> {
        if words.any(['X', 'U']) {
            self.box_words[0] = Some(to[0]);
        }
        if words.any(['Z', 'W']) {
            self.box_words[1] = Some(to[1]);
        }
        // Haas: in G90 and G92, I is the taper; in G94, K is the taper
        let letter = if self.motion == 94.0 { 'K' } else { 'I' };
        if words.any(['I', 'K']) && (!self.haas || words.get(letter).is_none() || words.get('R').is_some()) {
            return unsure("I or K of a canned cycle");
        }
        if let Some(taper) = words.length('R', self.unit).or(words.length(letter, self.unit)) {
            self.box_words[2] = Some(taper);
        }
        let [Some(x), Some(z), taper] = self.box_words else { return unsure("a canned cycle without both its axes") };
        let (start, taper) = (self.at, taper.unwrap_or(0.0));
        if start.iter().any(|value| value.is_nan()) {
            return unsure("a cycle from where only the machine knows");
        }
        match self.motion {
            // see 4.1.1: 1(R) goes to the cut, 2(F) cuts, 3(F) goes across to the start, 4(R) goes back; the word R is
            // the start radius minus the end radius
            90.0 => {
                self.go(Kind::Rapid, [x + taper, start[1]])?;
                self.go(Kind::Feed, [x, z])?;
                self.go(Kind::Feed, [start[0], z])?;
            }
            // see 4.1.2: F is the lead, and 3(R) goes out of the thread; a parameter defines the chamfer
            92.0 => {
                self.go(Kind::Rapid, [x + taper, start[1]])?;
                // the manual does not define whether the next pass keeps the angle
                if words.get('Q').is_none() && self.thread_turned {
                    return unsure("a thread after one with its angle");
                }
                self.thread_turned = words.get('Q').is_some();
                self.now.angle = words.get('Q').unwrap_or(0.0);
                self.go(Kind::Thread, [x, z])?;
                self.now.angle = 0.0;
                self.go(Kind::Rapid, [start[0], z])?;
            }
            // see 4.1.3: the tool goes along Z at rapid, across the face at feed, and back along Z at feed
            _ => {
                self.go(Kind::Rapid, [start[0], z + taper])?;
                self.go(Kind::Feed, [x, z])?;
                self.go(Kind::Feed, [x, start[1]])?;
            }
        }
        self.go(Kind::Rapid, start)
    }

    /// Runs a repetitive cycle, or reads its first block. Returns the next line to run; `None`: the following line.
    pub(super) fn repetitive(&mut self, code: u32, words: &Words, at: usize) -> Result<Option<usize>, Stopped> {
        let length = |letter| words.length(letter, self.unit);
        let named = words.get('P').is_some() && words.get('Q').is_some();
        match code {
            70..=73 if code == 70 || self.haas || named => {
                if !named {
                    return alarm("a cycle without P and Q");
                }
                self.profiled(code, words, at)
            }
            71..=73 => {
                self.first.insert(code, [length('U'), length('W'), length('R')]);
                Ok(None)
            }
            74 | 75 if !self.haas && !words.any(['X', 'Z']) && !words.any(['U', 'W']) => {
                self.first.insert(code, [None, None, length('R')]);
                Ok(None)
            }
            74 | 75 => self.pecks(code, words).map(|()| None),
            _ if self.haas => unsure("G76 of a Haas"),
            _ if !words.any(['X', 'U']) => {
                let (p, q) = (words.get('P').unwrap_or(f64::NAN), words.get('Q').unwrap_or(f64::NAN));
                let angle = p % 100.0;
                self.thread = Some([(p / 10_000.0).floor(), angle, q * self.unit, length('R').unwrap_or(f64::NAN)]);
                Ok(None)
            }
            _ => self.thread(words).map(|()| None),
        }
    }

    fn back(&self) -> f64 {
        if self.unit == 0.001 { BACK * 25.4 } else { BACK }
    }

    fn profile(&self, first: u32, last: u32, at: usize) -> Result<(Vec<Part>, usize), Stopped> {
        let find = |number: u32| self.lines.iter().position(|line| line.sequence == Some(number));
        let count = |number: u32| self.lines.iter().filter(|line| line.sequence == Some(number)).count();
        if count(first) > 1 || count(last) > 1 {
            return unsure("a number that two blocks have");
        }
        let (Some(begin), Some(end)) = (find(first), find(last)) else { return alarm("no such block") };
        if end < begin || (begin..=end).contains(&at) {
            return alarm("a profile whose end is before its begin");
        }
        let (mut parts, mut here, mut motion): (Vec<Part>, _, _) = (Vec::new(), self.at, f64::NAN);
        let mut corner: Option<Corner> = None;
        for line in &self.lines[begin..=end] {
            let words = Words::of(line)?;
            for code in
                [4.0, 28.0, 32.0, 41.0, 42.0, 70.0, 71.0, 72.0, 73.0, 74.0, 75.0, 76.0, 90.0, 92.0, 94.0, 96.0, 97.0]
            {
                if words.is('G', code) {
                    return unsure("a code in a profile");
                }
            }
            motion = (0..4).map(f64::from).find(|&code| words.is('G', code)).unwrap_or(motion);
            if !line.has_words() && !parts.is_empty() {
                continue;
            }
            let to = self.position_from(&words, corner.map_or(here, |corner| corner.at));
            if let Some(corner) = corner.take() {
                corner.is_left(&words, motion, to)?;
            }
            if motion == 1.0
                && let Some((blocks, next)) = self.cornered(&words, here, to)?
            {
                if parts.is_empty() {
                    return unsure("a corner in the first block of a profile");
                }
                let (mut feed, mut speed) = (words.get('F'), words.get('S'));
                for (kind, to) in blocks {
                    parts.push(Part { kind, from: here, to, feed: feed.take(), speed: speed.take() });
                    here = to;
                }
                corner = Some(next);
                continue;
            }
            let kind = match motion {
                0.0 => Kind::Rapid,
                1.0 => Kind::Feed,
                2.0 | 3.0 if words.any(['X', 'Z']) || words.any(['U', 'W']) => {
                    self.arc(&words, here, to, motion == 3.0)?
                }
                _ => return unsure("a profile that begins without a motion code"),
            };
            if parts.is_empty() && !matches!(kind, Kind::Rapid | Kind::Feed) {
                return alarm("a profile that begins with an arc");
            }
            parts.push(Part { kind, from: here, to, feed: words.get('F'), speed: words.get('S') });
            here = to;
        }
        if corner.is_some() {
            return alarm("a profile that ends in a corner");
        }
        Ok((parts, if begin > at { end + 1 } else { at + 1 }))
    }

    fn profiled(&mut self, code: u32, words: &Words, at: usize) -> Result<Option<usize>, Stopped> {
        let number = |letter| words.get(letter).unwrap_or(-1.0) as u32;
        if self.at.iter().any(|value| value.is_nan()) {
            return unsure("a cycle from where only the machine knows");
        }
        let (parts, next) = self.profile(number('P'), number('Q'), at)?;
        let start = self.at;
        if code == 70 {
            // see 4.2.4: F and S between ns and nf apply; then the tool goes back to the start point at rapid
            for part in &parts {
                self.feed = part.feed.unwrap_or(self.feed);
                self.now.speed.0 = part.speed.unwrap_or(self.now.speed.0);
                self.go(part.kind, part.to)?;
            }
            if parts.iter().any(|part| part.feed.is_some()) {
                self.feed = f64::INFINITY;
            }
            if parts.iter().any(|part| part.speed.is_some()) {
                self.now.speed.0 = f64::NAN;
            }
            self.go(Kind::Rapid, start)?;
            return Ok(Some(next));
        }
        let length = |letter| words.length(letter, self.unit);
        let left = [length('U').unwrap_or(0.0) / 2.0, length('W').unwrap_or(0.0)];
        let first = self.first.get(&code).copied().unwrap_or([None; 3]);
        if code == 73 {
            // Haas, G73: I (a radius) and K are the distance from the first cut to the last, D is the number of cuts
            let (by, times) = match self.haas {
                true => ([length('I').unwrap_or(0.0), length('K').unwrap_or(0.0)], words.get('D')),
                // 4.2.3: R is a number of cuts without a decimal point
                false => {
                    let times = first[2].map(|times| if times < 0.5 { (times / self.unit).round() } else { times });
                    ([first[0].unwrap_or(0.0), first[1].unwrap_or(0.0)], times)
                }
            };
            let Some(times) = times else { return unsure("G73 without its count") };
            self.pattern(&parts, left, by, times)?;
        } else {
            let (level, along) = if code == 71 { (0, 1) } else { (1, 0) };
            let depth = if self.haas { length('D') } else { first[level] };
            let back = if self.haas { length('R').or(Some(self.back())) } else { first[2] };
            let (Some(depth), Some(back)) = (depth, back) else { return unsure("a cycle without its depth") };
            if back < 0.0 {
                return unsure("a return that is negative");
            }
            if parts[0].to[along] != start[along] {
                // see 4.2.1: in type I, block ns does not move along the second axis; in type II, block ns moves along
                // both axes
                return unsure("type II");
            }
            self.rough(&parts, left, depth, back, [level, along])?;
        }
        self.go(Kind::Rapid, start)?;
        Ok(Some(next))
    }

    /// Type I of 4.2.1 and 4.2.2. The cuts begin at point C (point A, moved by the allowances) and end at the moved
    /// profile. After each cut, the tool retracts at 45 degrees. The last cut goes along the moved profile.
    fn rough(&mut self, parts: &[Part], left: Point, depth: f64, back: f64, axes: [usize; 2]) -> Result<(), Stopped> {
        let [level, along] = axes;
        if depth <= 0.0 {
            return alarm("a cycle without a depth");
        }
        let start = [self.at[0] + left[0], self.at[1] + left[1]];
        let bottom = parts[0].to[level] + left[level];
        let toward = (bottom - start[level]).signum();
        let last = parts[parts.len() - 1].to;
        let cutting = (last[along] - parts[0].to[along]).signum();
        for pair in parts[1..].iter() {
            let (up, on) = (pair.to[level] - pair.from[level], pair.to[along] - pair.from[along]);
            if up * toward > NEAR || on * cutting < -NEAR || !is_monotone(pair) {
                return unsure("a profile that goes back on itself");
            }
        }
        let infeed = parts[0].kind;
        self.go(Kind::Rapid, start)?;
        let mut cut = start[level] + toward * depth;
        while toward * (bottom - cut) > NEAR {
            let mut to = start;
            to[level] = cut;
            self.go(infeed, to)?;
            to[along] = crossing(&parts[1..], left, cut, axes, toward).unwrap_or(last[along] + left[along]);
            self.go(Kind::Feed, to)?;
            let length = (to[along] - start[along]).abs();
            // the manuals show no retract if nothing is cut, and no retract that is longer than the cut
            if length > SHORT {
                to[level] -= toward * back;
                to[along] -= cutting * back.min(length);
                self.go(Kind::Rapid, to)?;
            }
            to[along] = start[along];
            self.go(Kind::Rapid, to)?;
            cut += toward * depth;
        }
        // a cut is at the height of a corner if the distance of the corner from the start is a multiple of the depth of
        // cut
        let is_corner = |at: f64| {
            let cuts = (at + left[level] - start[level]) / depth;
            cuts.abs() > 0.5 && (cuts - cuts.round()).abs() < 1e-6
        };
        self.on_corner |= parts.iter().any(|part| is_corner(part.to[level]));
        for part in parts {
            let (kind, to) = moved(part, left);
            self.go(kind, to)?;
        }
        Ok(())
    }

    /// See 4.2.3: in the figure, the first pass is moved by the relief and the allowance, and the last pass by the
    /// allowance alone. R is the number of passes.
    fn pattern(&mut self, parts: &[Part], left: Point, by: Point, times: f64) -> Result<(), Stopped> {
        if times < 1.0 || times.fract() != 0.0 || times > 1000.0 {
            return unsure("a count of G73");
        }
        if times == 1.0 {
            return unsure("G73 once");
        }
        let start = self.at;
        for pass in 0..times as u32 {
            let share = 1.0 - f64::from(pass) / (times - 1.0);
            let shift = [left[0] + by[0] * share, left[1] + by[1] * share];
            self.go(Kind::Rapid, [start[0] + shift[0], start[1] + shift[1]])?;
            for part in parts {
                let (kind, to) = moved(part, shift);
                self.go(kind, to)?;
            }
        }
        Ok(())
    }

    /// See 4.2.5 and 4.2.6: the tool retracts after each peck, steps to the side, and goes back to the start. On a
    /// Haas, I and K are the peck and the step.
    fn pecks(&mut self, code: u32, words: &Words) -> Result<(), Stopped> {
        if self.at.iter().any(|value| value.is_nan()) {
            return unsure("a cycle from where only the machine knows");
        }
        let (deep, side) = if code == 74 { (1, 0) } else { (0, 1) };
        let (start, end) = (self.at, self.position(words));
        let count = |letter: char| match self.haas {
            true => words.length(letter, self.unit),
            // a word without a decimal point is in least increments; X is a radius
            false => words.get(letter).map(|value| value * self.unit),
        };
        let (x, z) = if self.haas { (count('I'), count('K')) } else { (count('P'), count('Q')) };
        let (peck, step) = if code == 74 { (z, x) } else { (x, z) };
        let relief = words.length(if self.haas { 'D' } else { 'R' }, self.unit).unwrap_or(0.0);
        if relief != 0.0 {
            return unsure("a relief at the bottom");
        }
        let back = match self.first.get(&code) {
            Some([.., Some(back)]) => *back,
            // Setting 22
            _ if self.haas => self.back(),
            _ => return unsure("pecks without their return"),
        };
        // the manual requires values above zero (PS0062), but does not mention the retract
        if back < 0.0 {
            return unsure("a return that is negative");
        }
        if peck.is_some_and(|peck| peck < 0.0) || step.is_some_and(|step| step < 0.0) {
            return alarm("a negative step");
        }
        let (total, wide) = (end[deep] - start[deep], end[side] - start[side]);
        if peck.is_some_and(|peck| peck <= 0.0) || step.is_some_and(|step| step <= 0.0) {
            return unsure("steps of nothing");
        }
        if wide != 0.0 && step.is_none() {
            return unsure("a way to the side without steps");
        }
        let peck = peck.unwrap_or(total.abs());
        let mut across = 0.0;
        loop {
            let mut to = start;
            to[side] = start[side] + wide.signum() * across;
            self.go(Kind::Rapid, to)?;
            let mut reached = peck;
            while reached < total.abs() - NEAR {
                to[deep] = start[deep] + total.signum() * reached;
                self.go(Kind::Feed, to)?;
                // a retract longer than the peck is not described; a Haas has a setting
                to[deep] -= total.signum() * back.min(reached);
                self.go(Kind::Rapid, to)?;
                reached += peck;
            }
            to[deep] = end[deep];
            self.go(Kind::Feed, to)?;
            to[deep] = start[deep];
            self.go(Kind::Rapid, to)?;
            if across >= wide.abs() - NEAR {
                break;
            }
            across = (across + step.unwrap_or(0.0)).min(wide.abs());
        }
        self.go(Kind::Rapid, start)
    }

    /// See 4.2.7: the depth of the n-th cut is the depth of the first cut times the square root of n. No cut is less
    /// than the minimum, and the last passes cut the allowance.
    fn thread(&mut self, words: &Words) -> Result<(), Stopped> {
        let Some([last, angle, least, allowance]) = self.thread else { return unsure("G76 of one block") };
        let count = |letter| words.get(letter).map(|value| value * self.unit);
        let (Some(height), Some(cut)) = (count('P'), count('Q')) else { return alarm("G76 without P or Q") };
        if height <= 0.0 || cut <= 0.0 || least > height || ![0.0, 29.0, 30.0, 55.0, 60.0, 80.0].contains(&angle) {
            return alarm("PS0062");
        }
        if !(0.0..height).contains(&allowance) || least.is_nan() || last < 1.0 {
            return unsure("values of G76");
        }
        let taper = words.length('R', self.unit).unwrap_or(0.0);
        let (start, end) = (self.at, self.position(words));
        if start.iter().any(|value| value.is_nan()) {
            return unsure("a cycle from where only the machine knows");
        }
        let outward = if start[0] > end[0] { 1.0 } else { -1.0 };
        let mut depths = Vec::new();
        let (mut depth, mut n) = (0.0f64, 0.0f64);
        while depth < height - allowance - NEAR {
            n += 1.0;
            let wanted = cut * n.sqrt();
            depth = wanted.max(depth + least).min(height - allowance);
            depths.push(depth);
            if depths.len() > 2000 {
                return unsure("thousands of passes");
            }
        }
        let last = if allowance > 0.0 { last } else { last - 1.0 };
        depths.extend((0..last as usize).map(|_| height));
        for depth in depths {
            let radius = end[0] + outward * (height - depth);
            self.go(Kind::Rapid, [radius + taper, start[1]])?;
            self.go(Kind::Thread, [radius, end[1]])?;
            self.go(Kind::Rapid, [start[0], end[1]])?;
            self.go(Kind::Rapid, start)?;
        }
        Ok(())
    }
}

/// Whether a part of the profile crosses no quadrant line. The result is `true` for a straight part.
fn is_monotone(part: &Part) -> bool {
    let Kind::Arc(center, ccw) = part.kind else { return true };
    let angle = |at: Point| (at[0] - center[0]).atan2(at[1] - center[1]);
    let (from, to) = if ccw { (angle(part.from), angle(part.to)) } else { (angle(part.to), angle(part.from)) };
    let sweep = (to - from).rem_euclid(std::f64::consts::TAU);
    let quarter = std::f64::consts::FRAC_PI_2;
    let next = ((from + 1e-4) / quarter).floor() * quarter + quarter;
    from + sweep <= next + 1e-4
}

/// The position at which a cut first meets the moved profile.
fn crossing(parts: &[Part], left: Point, cut: f64, axes: [usize; 2], toward: f64) -> Option<f64> {
    let [level, along] = axes;
    let cut = cut - left[level];
    let part = parts.iter().find(|part| (part.to[level] - cut) * toward <= NEAR)?;
    let (from, to) = (part.from, part.to);
    let at = match part.kind {
        Kind::Arc(center, _) => {
            let radius = (from[0] - center[0]).hypot(from[1] - center[1]);
            let high = (radius * radius - (cut - center[level]).powi(2)).max(0.0).sqrt();
            let middle = (from[along] + to[along]) / 2.0;
            // the arc is monotone, so it is on one side of its centre
            center[along] + if middle > center[along] { high } else { -high }
        }
        _ if (to[level] - from[level]).abs() < NEAR => to[along],
        _ => from[along] + (to[along] - from[along]) * (cut - from[level]) / (to[level] - from[level]),
    };
    Some(at + left[along])
}
