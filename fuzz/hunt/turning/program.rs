//! Random programs for lathes. Lengths are whole increments of 0.001 mm or 0.0001 inch, X as a radius.

use std::fmt::Write;

use crate::random::Random;

use super::profile::Profile;

/// Writes a program.
pub struct Writer {
    pub(super) random: Random,
    pub(super) haas: bool,
    pub(super) inch: bool,
    /// Whether some lengths have no decimal point.
    pointless: bool,
    pub(super) text: String,
    /// The subprograms, which follow the end of the main program.
    subs: String,
    /// The next block number.
    pub(super) number: u32,
    programs: u32,
    /// Radius and Z.
    pub(super) at: [i64; 2],
    /// The features that the program contains.
    pub kinds: Vec<&'static str>,
}

/// A random program, whether it is in inches, and the features in it.
pub fn program(seed: u64, haas: bool) -> (String, bool, Vec<&'static str>) {
    let mut random = Random::new(seed);
    let (inch, pointless) = (random.once_in(3), random.once_in(6));
    let mut writer = Writer {
        random,
        haas,
        inch,
        pointless,
        text: String::new(),
        subs: String::new(),
        number: 10,
        programs: 1000,
        at: [0, 0],
        kinds: Vec::new(),
    };
    writer.whole();
    (writer.text, inch, writer.kinds)
}

impl Writer {
    pub(super) fn line(&mut self, line: &str) {
        self.text.push_str(line);
        self.text.push('\n');
    }

    pub(super) fn once_in(&mut self, n: usize) -> bool {
        self.random.once_in(n)
    }

    /// A random multiple of `step`, from `low` to `high` steps.
    pub(super) fn steps(&mut self, low: i64, high: i64, step: i64) -> i64 {
        (low + self.random.below((high - low + 1) as usize) as i64) * step
    }

    /// A length as text, without its letter.
    pub(super) fn length(&mut self, value: i64) -> String {
        if self.pointless && self.once_in(3) {
            return value.to_string();
        }
        let digits = if self.inch { 4 } else { 3 };
        let scale = 10i64.pow(digits);
        let sign = if value < 0 { "-" } else { "" };
        let fraction = format!("{:0width$}", value.abs() % scale, width = digits as usize);
        let whole = value.abs() / scale;
        let whole = if whole == 0 && self.once_in(3) && value != 0 { String::new() } else { whole.to_string() };
        let fraction = if self.once_in(5) { &fraction } else { fraction.trim_end_matches('0') };
        format!("{sign}{whole}.{fraction}")
    }

    /// Words from one position to another, absolute or incremental; the word of an unchanged axis may be left out.
    pub(super) fn words_to(&mut self, from: [i64; 2], to: [i64; 2]) -> String {
        let mut words = String::new();
        for axis in [0, 1] {
            let moves = from[axis] != to[axis];
            if !moves && !self.once_in(6) {
                continue;
            }
            let by = if axis == 0 { 2 } else { 1 };
            let absolute = !self.once_in(4);
            let (letter, value) = match (axis, absolute) {
                (0, true) => ('X', to[0] * by),
                (0, false) => ('U', (to[0] - from[0]) * by),
                (_, true) => ('Z', to[1]),
                _ => ('W', to[1] - from[1]),
            };
            let value = self.length(value);
            _ = write!(words, "{letter}{value}");
        }
        words
    }

    /// The words of both axes, none left out.
    fn both(&mut self, from: [i64; 2], to: [i64; 2]) -> String {
        let x = if self.once_in(4) { ('U', (to[0] - from[0]) * 2) } else { ('X', to[0] * 2) };
        let z = if self.once_in(4) { ('W', to[1] - from[1]) } else { ('Z', to[1]) };
        format!("{}{}{}{}", x.0, self.length(x.1), z.0, self.length(z.1))
    }

    pub(super) fn feed(&mut self) -> String {
        self.random.pick(&["F.2", "F0.15", "F.05", "F0.3", "F120.", "F0.25"]).to_owned()
    }

    pub(super) fn rapid(&mut self, to: [i64; 2]) {
        let words = format!("X{}Z{}", self.length(to[0] * 2), self.length(to[1]));
        put!(self, "G0{words}");
        self.at = to;
    }

    fn whole(&mut self) {
        self.line("%");
        self.line("O0001(A PART)");
        let units = if self.inch { "G20" } else { "G21" };
        let mode = self.random.pick(&["G99", "G98", "G99"]);
        put!(self, "{units}G18G40{mode}");
        self.tool();
        for n in 0..1 + self.random.below(3) {
            if n > 0 && self.once_in(3) {
                self.line(self.random_home());
                self.tool();
            }
            if self.once_in(8) {
                let mode = self.random.pick(&["G99", "G98"]);
                self.line(mode);
            }
            self.operation();
        }
        self.line("G28U0W0");
        self.line("M5");
        self.line("M30");
        let subs = std::mem::take(&mut self.subs);
        self.text.push_str(&subs);
        self.line("%");
    }

    fn random_home(&self) -> &'static str {
        if self.number.is_multiple_of(20) { "G28U0W0" } else { "G28U0.\nG28W0." }
    }

    fn tool(&mut self) {
        let tool = self.random.pick(&["T0101", "T0202", "T0303", "T0513"]);
        self.line(tool);
        if self.once_in(2) {
            self.line("G50S2500");
        }
        let spindle = self.random.pick(&["G96S150M3", "G97S800M3", "G97S1200M4", "G96S90M3"]);
        self.line(spindle);
        if self.once_in(3) {
            self.line("M8");
        }
        if self.once_in(6) {
            // afterwards the tool's position is unknown, so the next block has both axes
            let (offset, skip) = (54 + self.random.below(6), if self.once_in(6) { "/" } else { "" });
            put!(self, "{skip}G{offset}");
        }
        if self.once_in(10) {
            let dwell = self.random.pick(&["G4P500", "G4X1.5", "G4U.25", "G4P1200", "/G4U.5", "/M1"]);
            self.line(dwell);
        }
    }

    fn operation(&mut self) {
        if self.once_in(6) {
            self.line("(NEXT)");
        }
        let start = [self.steps(20, 45, 1000), self.steps(1, 6, 1000)];
        match self.random.below(16) {
            0 => self.moves(start),
            12 => self.corners(start),
            13 => self.beside(start, |writer, start| writer.moves(start)),
            14 => self.beside(start, |writer, start| writer.corners(start)),
            1 => self.boxes(start, 90),
            2 => self.boxes(start, 94),
            3 => self.boxes(start, 92),
            4 => self.thread(start),
            5 if !self.haas => self.passes(start),
            6 => self.pecks(start, 74),
            7 => self.pecks(start, 75),
            8 => self.called(start),
            9 if self.once_in(40) => self.looped(start),
            _ => self.profiled(),
        }
    }

    fn moves(&mut self, start: [i64; 2]) {
        self.kinds.push("moves");
        self.rapid(start);
        let feed = self.feed();
        put!(self, "G1{}{feed}", "");
        for _ in 0..2 + self.random.below(4) {
            let by = [self.steps(-40, 40, 100), self.steps(-60, 10, 100)];
            let to = [self.at[0] + by[0], self.at[1] + by[1]];
            let skip = if self.once_in(8) { "/" } else { "" };
            let line = match self.random.below(4) {
                0 if by[0] != 0 || by[1] != 0 => {
                    let code = self.random.pick(&["G2", "G3"]);
                    let radius = ((by[0] as f64).hypot(by[1] as f64) * 0.6).ceil() as i64 + self.steps(0, 50, 100);
                    format!("{code}{}R{}", self.both(self.at, to), self.length(radius))
                }
                1 if by[0] != 0 => self.quarter(by[0]),
                _ => {
                    let (code, words) = (self.random.pick(&["G1", "G0", "G01"]), self.words_to(self.at, to));
                    self.at = to;
                    format!("{code}{words}")
                }
            };
            if line.starts_with("G2") || line.starts_with("G3") {
                self.at = if line.contains('R') { to } else { self.at };
            }
            put!(self, "{skip}{line}");
        }
    }

    /// A quarter circle with I and K.
    fn quarter(&mut self, by: i64) -> String {
        let size = by.abs();
        let (dx, dz) = (self.random.pick(&[size, -size]), self.random.pick(&[size, -size]));
        let to = [self.at[0] + dx, self.at[1] + dz];
        // seen from the start, the centre is along X or along Z
        let along_x = self.once_in(2);
        let (i, k) = if along_x { (dx, 0) } else { (0, dz) };
        // vectors from the centre to start and end, with Z to the right; the sign of their product is the direction
        let (from, end) = ([-i, -k], [dx - i, dz - k]);
        let ccw = from[1] * end[0] - from[0] * end[1] > 0;
        let words = self.both(self.at, to);
        let center = match (i, self.once_in(4)) {
            (0, false) => format!("K{}", self.length(k)),
            (_, false) => format!("I{}", self.length(i)),
            _ => format!("I{}K{}", self.length(i), self.length(k)),
        };
        self.at = to;
        format!("{}{words}{center}", if ccw { "G3" } else { "G2" })
    }

    fn boxes(&mut self, start: [i64; 2], code: u32) {
        self.kinds.push(match code {
            90 => "G90",
            92 => "G92",
            _ => "G94",
        });
        self.rapid(start);
        let inside = self.once_in(5);
        let out = if inside { -1 } else { 1 };
        let mut depth = self.steps(1, 5, 500);
        let length = self.steps(5, 30, 1000);
        let taper = if self.once_in(3) { self.steps(-8, 8, 250) } else { 0 };
        let angle =
            if code == 92 && self.once_in(6) { self.random.pick(&["Q180000", "Q90000", "Q120000"]) } else { "" };
        let feed = if code == 92 { format!("F1.5{angle}") } else { self.feed() };
        let to = [start[0] - out * depth, start[1] - length];
        let words = self.both(start, to);
        let taper = if taper != 0 { format!("R{}", self.length(taper)) } else { String::new() };
        put!(self, "G{code}{words}{taper}{feed}");
        for _ in 0..self.random.below(4) {
            depth += self.steps(1, 6, 250);
            let to = if code == 94 { [to[0], to[1] - depth] } else { [start[0] - out * depth, to[1]] };
            let line = match code {
                94 if self.once_in(3) => format!("W{}", self.length(to[1] - start[1])),
                94 => format!("Z{}", self.length(to[1])),
                _ if self.once_in(3) => format!("U{}", self.length((to[0] - start[0]) * 2)),
                _ => format!("X{}", self.length(to[0] * 2)),
            };
            // sometimes the code of the cycle is repeated, without the other axis
            if self.once_in(3) {
                self.kinds.push("a pass with its code again");
                let taper = if self.once_in(12) { "" } else { &taper };
                put!(self, "G{code}{line}{taper}{angle}");
            } else {
                put!(self, "{line}{angle}");
            }
        }
        let out = self.random.pick(&["G0", "G00"]);
        put!(self, "{out}X{}", self.length(start[0] * 2 + 4000));
        self.at = [start[0] + 2000, start[1]];
    }

    fn thread(&mut self, start: [i64; 2]) {
        self.kinds.push("G32");
        self.rapid(start);
        let length = self.steps(5, 30, 1000);
        let taper = if self.once_in(3) { self.steps(1, 6, 250) } else { 0 };
        for pass in 1..=1 + self.random.below(3) as i64 {
            let top = [start[0] - 500 * pass, start[1]];
            put!(self, "G0X{}", self.length(top[0] * 2));
            let to = [top[0] + taper, top[1] - length];
            let words = self.words_to(top, to);
            let angle = if self.once_in(8) { "Q180000" } else { "" };
            put!(self, "G32{words}F2.{angle}");
            if self.once_in(4) {
                put!(self, "W{}", self.length(-1000));
            }
            put!(self, "G0X{}", self.length(start[0] * 2));
            put!(self, "Z{}", self.length(start[1]));
        }
        self.at = start;
    }

    fn passes(&mut self, start: [i64; 2]) {
        self.kinds.push("G76");
        self.rapid(start);
        let inside = self.once_in(5);
        let height = self.steps(6, 20, 100);
        let cut = self.steps(1, 8, 50);
        let (least, left) = (self.steps(0, 4, 25), self.steps(0, 3, 20));
        let last = 1 + self.random.below(3);
        put!(self, "G76P{last:02}0000Q{least}R{}", self.length(left));
        let out = if inside { -1 } else { 1 };
        let to = [start[0] - out * (height + self.steps(0, 3, 500)), start[1] - self.steps(5, 30, 1000)];
        let words = self.both(start, to);
        let taper = if self.once_in(4) { format!("R{}", self.length(-1000)) } else { String::new() };
        put!(self, "G76{words}{taper}P{height}Q{cut}F1.5");
        self.at = start;
        self.after_cycle();
    }

    /// Writes blocks after a repetitive cycle.
    pub(super) fn after_cycle(&mut self) {
        if self.once_in(2) {
            let to = [self.at[0] + 1000, self.at[1] + 1000];
            let words = self.both(self.at, to);
            put!(self, "G0{words}");
            self.at = to;
        }
    }

    fn pecks(&mut self, start: [i64; 2], code: u32) {
        self.kinds.push(if code == 74 { "G74" } else { "G75" });
        self.rapid(start);
        let (deep, wide) = (self.steps(2, 12, 1000), if self.once_in(3) { 0 } else { self.steps(1, 8, 1000) });
        let peck = if self.once_in(4) { deep } else { self.steps(1, 9, 500) };
        let step = self.steps(1, 6, 500);
        let back = self.steps(1, 4, 100);
        let left = if self.once_in(5) { -1 } else { 1 };
        let (x, z) = if code == 74 { (wide * left, deep) } else { (deep, wide * left) };
        let to = [start[0] - x, start[1] - z];
        let mut words = match (code, wide) {
            (74, 0) if self.once_in(4) => format!("W{}", self.length(-z)),
            (74, 0) => format!("Z{}", self.length(to[1])),
            (_, 0) if self.once_in(4) => format!("U{}", self.length(-x * 2)),
            (_, 0) => format!("X{}", self.length(to[0] * 2)),
            _ => self.both(start, to),
        };
        let (for_x, for_z) = if code == 74 { (step, peck) } else { (peck, step) };
        let (has_x, has_z) = (code == 75 || wide != 0, code == 74 || wide != 0);
        let letters = if self.haas { ['I', 'K'] } else { ['P', 'Q'] };
        for (letter, value, has) in [(letters[0], for_x, has_x), (letters[1], for_z, has_z)] {
            if has {
                let value = if self.haas { self.length(value) } else { value.to_string() };
                _ = write!(words, "{letter}{value}");
            }
        }
        if !self.haas {
            put!(self, "G{code}R{}", self.length(back));
        }
        let feed = self.feed();
        put!(self, "G{code}{words}{feed}");
        self.at = start;
        self.after_cycle();
    }

    /// Writes passes as calls of a subprogram.
    fn called(&mut self, start: [i64; 2]) {
        self.kinds.push("M98");
        self.rapid(start);
        self.programs += 1;
        let times = 1 + self.random.below(3);
        let count = if times > 1 || self.once_in(2) { format!("L{times}") } else { String::new() };
        if !self.haas && self.once_in(2) {
            put!(self, "M98P{times}{}", self.programs);
        } else {
            put!(self, "M98P{}{count}", self.programs);
        }
        let main = std::mem::take(&mut self.text);
        put!(self, "O{}", self.programs);
        self.line("G0U-2.");
        match self.random.below(3) {
            0 => {
                let feed = self.feed();
                put!(self, "G90U-1.W-5.{feed}");
            }
            1 if !self.haas => {
                self.line("G75R.1");
                self.line("G75U-3.P1000F.1");
            }
            _ => {
                let feed = self.feed();
                put!(self, "G1W-4.{feed}");
                self.line("G0W4.");
            }
        }
        self.line("M99");
        let sub = std::mem::replace(&mut self.text, main);
        self.subs.push_str(&sub);
        put!(self, "G0X{}Z{}", self.length(start[0] * 2), self.length(start[1]));
    }

    /// Writes passes in a loop.
    fn looped(&mut self, start: [i64; 2]) {
        self.kinds.push("WHILE");
        self.rapid(start);
        let feed = self.feed();
        self.line("#101=1.");
        self.line("WHILE[#101LT3.5]DO1");
        put!(self, "G90U-#101W-5.{feed}");
        self.line("G0U1.");
        self.line("#101=#101+1.");
        self.line("END1");
        put!(self, "G0X{}Z{}", self.length(start[0] * 2), self.length(start[1]));
    }

    fn profiled(&mut self) {
        Profile::random(self).write(self);
    }
}
