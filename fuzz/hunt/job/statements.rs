//! CL files with every word of the CYCLE chapter: statements inside cycles, CYCLE/ON, AUTO, RETURN, all kinds of feeds,
//! arcs in three planes.

use std::fmt::Write;

use serde_json::{Value, json};

use crate::random::Random;

/// A random job as the lines of its CL file.
pub fn statements(inch: bool, random: &mut Random) -> Value {
    let unit = if inch { 1.0 } else { 25.0 };
    let decimals = if inch { random.pick(&[2, 3, 4]) } else { random.pick(&[0, 1, 2, 3]) };
    let mut file = File {
        random,
        unit,
        decimals,
        lines: Vec::new(),
        at: [0.0; 3],
        cleared: false,
        cycles: 0,
        speed: 0,
        clockwise: true,
        in_hole: false,
    };
    for tool in 1..=1 + file.random.below(3) {
        file.tool(tool);
        for _ in 0..1 + file.random.below(4) {
            match file.random.below(5) {
                0 => file.contour(),
                1 => file.other(),
                _ => file.cycles(),
            }
        }
    }
    let lines = file.lines;
    json!({ "units": if inch { "inch" } else { "mm" }, "lines": lines })
}

struct File<'r> {
    random: &'r mut Random,
    unit: f64,
    decimals: i32,
    lines: Vec<String>,
    at: [f64; 3],
    /// Whether a clearance was coded. A clearance applies to all later cycles.
    cleared: bool,
    cycles: usize,
    speed: usize,
    clockwise: bool,
    /// Whether the last position is a point of a cycle.
    in_hole: bool,
}

const ABSOLUTE: [&str; 3] = ["IPM", "MMPM", "PERMIN"];
const PER_TURN: [&str; 3] = ["IPR", "MMPR", "PERREV"];

impl File<'_> {
    fn put(&mut self, line: impl Into<String>) {
        self.lines.push(line.into());
    }

    fn round(&self, value: f64) -> f64 {
        let by = 10f64.powi(self.decimals);
        (value * by).round() / by + 0.0
    }

    fn length(&mut self, low: f64, high: f64) -> f64 {
        let value = self.random.between(low, high) * self.unit;
        self.round(value)
    }

    fn positive(&mut self, low: f64, high: f64) -> f64 {
        let least = 10f64.powi(-self.decimals);
        self.length(low, high).max(least)
    }

    /// A feed: its word and its number.
    fn feed(&mut self) -> String {
        let inches = self.random.between(1.0, 40.0);
        let word = if self.random.once_in(3) { self.random.pick(&PER_TURN) } else { self.random.pick(&ABSOLUTE) };
        let unit = match word {
            "IPM" | "IPR" => 1.0,
            "MMPM" | "MMPR" => 25.0,
            _ => self.unit,
        };
        let turns = if PER_TURN.contains(&word) { self.speed as f64 } else { 1.0 };
        let by = if PER_TURN.contains(&word) { 1e4 } else { 10.0 };
        let value = (inches * unit / turns * by).round().max(1.0) / by;
        format!("{word},{value}")
    }

    fn goto(&mut self, to: [f64; 3]) {
        // the position after a hole is not in the file, so no increment starts from it
        let relative = self.random.once_in(8) && self.lines.len() > 8 && !self.in_hole;
        let by = [0, 1, 2].map(|axis| self.round(to[axis] - self.at[axis]));
        let whole = (0..3).all(|axis| self.round(self.at[axis] + by[axis]) == to[axis]);
        let (word, [x, y, z]) = if relative && whole { ("GODLTA", by) } else { ("GOTO", to) };
        self.put(format!("{word}/{x},{y},{z}"));
        (self.at, self.in_hole) = (to, false);
    }

    fn across(&mut self) -> [f64; 2] {
        [self.length(-4.0, 4.0), self.length(-4.0, 4.0)]
    }

    fn tool(&mut self, number: usize) {
        self.put(format!("LOADTL/{number}"));
        self.speed = 200 + 50 * self.random.below(40);
        self.clockwise = self.random.below(6) > 0;
        let turn = if self.clockwise { "CLW" } else { "CCLW" };
        self.put(format!("SPINDL/{},RPM,{turn}", self.speed));
        if self.random.once_in(2) {
            let coolant = self.random.pick(&["FLOOD", "MIST", "ON", "OFF"]);
            self.put(format!("COOLNT/{coolant}"));
        }
        let [x, y] = self.across();
        let high = self.length(1.0, 2.0);
        let (word, value) = self.fedrat();
        self.put(format!("FEDRAT/{value},{word}"));
        self.put("RAPID");
        self.put(format!("GOTO/{x},{y},{high}"));
        self.at = [x, y, high];
    }

    fn fedrat(&mut self) -> (String, String) {
        let feed = self.feed();
        let (word, value) = feed.split_once(',').unwrap_or(("", ""));
        (word.to_owned(), value.to_owned())
    }

    fn rapid(&mut self, to: [f64; 3]) {
        self.put("RAPID");
        // RAPID applies only to the next motion
        self.goto(to);
    }

    fn contour(&mut self) {
        let [x, y] = self.across();
        let high = self.length(0.4, 1.5);
        let [x0, y0, z0] = self.at;
        self.rapid([x0, y0, z0.max(high)]);
        self.rapid([x, y, z0.max(high)]);
        let depth = self.length(-0.5, 0.2);
        let (word, value) = self.fedrat();
        self.put(format!("FEDRAT/{value},{word}"));
        self.goto([x, y, depth]);
        for _ in 0..1 + self.random.below(4) {
            if self.random.once_in(3) {
                self.arc();
            } else {
                let [x, y] = self.across();
                self.goto([x, y, depth]);
            }
            if self.random.once_in(6) {
                let (word, value) = self.fedrat();
                self.put(format!("FEDRAT/{value},{word}"));
            }
        }
        let [x, y, z] = self.at;
        let high = self.length(0.4, 1.5).max(z);
        self.rapid([x, y, high]);
    }

    /// MOVARC about X, Y or Z by a quarter or half turn, so that the ends of the arc are round numbers.
    fn arc(&mut self) {
        let axis = self.random.pick(&[2, 2, 2, 1, 0]);
        let [first, second] = [(axis + 1) % 3, (axis + 2) % 3];
        let radius = self.positive(0.05, 1.0);
        let mut center = self.at;
        let side = self.random.pick(&[-1.0, 1.0]);
        center[first] = self.round(center[first] + side * radius);
        let from = [self.at[first] - center[first], self.at[second] - center[second]];
        let turned = match self.random.below(3) {
            0 => [-from[1], from[0]],
            1 => [-from[0], -from[1]],
            _ => [from[1], -from[0]],
        };
        let mut to = self.at;
        to[first] = self.round(center[first] + turned[0]);
        to[second] = self.round(center[second] + turned[1]);
        let up = self.random.pick(&[-1, 1]);
        let mut about = [0; 3];
        about[axis] = up;
        let [x, y, z] = center;
        let [i, j, k] = about;
        self.put(format!("MOVARC/{x},{y},{z},{i},{j},{k},{radius}"));
        let [x, y, z] = to;
        self.put(format!("GOTO/{x},{y},{z}"));
        self.at = to;
    }

    /// A statement that is neither a cut nor a hole.
    fn other(&mut self) {
        match self.random.below(6) {
            0 => self.put("STOP"),
            1 => self.put("OPSTOP"),
            2 => {
                let seconds = self.random.pick(&[0.5, 1.0, 2.5]);
                self.put(format!("DELAY/{seconds}"));
            }
            3 => self.put("PPRINT/LOOK HERE"),
            4 => {
                let coolant = self.random.pick(&["FLOOD", "MIST", "OFF"]);
                self.put(format!("COOLNT/{coolant}"));
            }
            _ => {
                self.speed = 200 + 50 * self.random.below(40);
                self.put(format!("SPINDL/{},RPM", self.speed));
            }
        }
    }

    /// One or more cycles, with other statements between and inside them.
    fn cycles(&mut self) {
        if self.random.once_in(4) {
            self.settings();
        }
        for _ in 0..1 + self.random.below(2) {
            let line = if self.cycles > 0 && self.random.once_in(5) { self.again() } else { self.cycle() };
            self.put(line);
            self.cycles += 1;
            self.points();
        }
        let end = self.random.pick(&["CYCLE/OFF", "CYCLE/OFF", "CYCLE/NOMORE"]);
        self.put(end);
        let [x, y, z] = self.at;
        let high = z.max(self.round(self.unit));
        match self.random.below(4) {
            0 => {
                let (word, value) = self.fedrat();
                self.put(format!("FEDRAT/{value},{word}"));
                self.goto([x, y, high]);
            }
            1 => self.rapid([x, y, high]),
            // without RAPID and FEDRAT, the motion after a cycle must not go down: this height is above every cycle
            _ => self.goto([x, y, self.round(50.0 * self.unit)]),
        }
        // the feed of a cycle does not apply to other motions
        let (word, value) = self.fedrat();
        self.put(format!("FEDRAT/{value},{word}"));
    }

    fn settings(&mut self) {
        let line = match self.random.below(6) {
            0 => "CYCLE/AUTO,OFF".into(),
            1 => "CYCLE/AUTO,ON".into(),
            2 => "CYCLE/RETURN,ON".into(),
            3 => "CYCLE/RETURN,OFF".into(),
            4 => "CYCLE/RETURN,AUTO".into(),
            _ => format!("CYCLE/RETURN,{}", self.positive(0.3, 2.0)),
        };
        self.put(line);
    }

    fn points(&mut self) {
        let stepped = self.random.once_in(3);
        let mut top = if self.random.once_in(3) { self.length(-0.5, 0.5) } else { 0.0 };
        let high = self.round(2.5 * self.unit);
        for number in 0..1 + self.random.below(4) {
            if stepped && number > 0 {
                top = self.length(-0.5, 0.5);
            }
            let [x, y] = self.across();
            match self.random.below(12) {
                // a plain rapid to a safe position
                0 => {
                    self.put("RAPID");
                    self.put(format!("GOTO/{x},{y},{high}"));
                    self.at = [x, y, high];
                    continue;
                }
                1 => {
                    let line = self.random.pick(&["CYCLE/AUTO,ON", "CYCLE/AUTO,OFF"]);
                    self.put(line);
                }
                2 => {
                    let (word, value) = self.fedrat();
                    self.put(format!("FEDRAT/{value},{word}"));
                }
                3 => self.put("PPRINT/NEXT HOLE"),
                4 if self.random.once_in(3) => {
                    let line = self.random.pick(&["COOLNT/OFF", "COOLNT/FLOOD", "OPSTOP", "STOP", "DELAY/1.5"]);
                    self.put(line);
                }
                5 if self.random.once_in(3) => {
                    let above = self.positive(0.3, 2.0);
                    self.put(format!("CYCLE/RETURN,{above}"));
                }
                _ => {}
            }
            self.put(format!("GOTO/{x},{y},{top}"));
            (self.at, self.in_hole) = ([x, y, self.round(top + 0.3 * self.unit)], true);
        }
    }

    /// The last cycle with some words replaced.
    fn again(&mut self) -> String {
        let mut line = "CYCLE/ON".to_owned();
        if self.random.once_in(2) {
            _ = write!(line, ",CLEAR,{}", self.positive(0.05, 0.3));
        }
        if self.random.once_in(3) {
            _ = write!(line, ",{}", self.feed());
        }
        if self.random.once_in(4) {
            _ = write!(line, ",RETURN,{}", self.positive(0.3, 1.5));
        }
        line
    }

    fn cycle(&mut self) -> String {
        let kind = self.random.pick(&[
            "DRILL",
            "DRILL",
            "FACE",
            "TAP",
            "TAP",
            "BORE",
            "BORE",
            "BORE,BACK",
            "REAM",
            "DEEP",
            "DRILL,DEEP",
            "BRKCHP",
            "DRILL,BRKCHP",
            "TAP",
            "THRU",
            "CSINK",
            "MANUAL",
        ]);
        // only some controls can peck while they tap
        let kind = if self.random.once_in(25) { self.random.pick(&["TAP,DEEP", "TAP,BRKCHP"]) } else { kind };
        let clear = self.positive(0.05, 0.3);
        if kind == "MANUAL" {
            self.cleared = true;
            return format!("CYCLE/MANUAL,CLEAR,{clear}");
        }
        let depth = self.positive(0.1, 1.2);
        let mut couplets: Vec<String> = Vec::new();
        match kind {
            "DEEP" | "DRILL,DEEP" | "BRKCHP" | "DRILL,BRKCHP" => {
                self.pecks(&mut couplets, depth, kind.ends_with("BRKCHP"))
            }
            "TAP,DEEP" | "TAP,BRKCHP" => {
                let step = self.positive(0.1, 0.4);
                couplets.push(format!("DEPTH,{depth},STEP,{step},{}", self.lead()));
                if !self.clockwise {
                    couplets.push("INVERS".into());
                }
            }
            "THRU" => {
                let mut webs = vec![self.positive(0.1, 0.3)];
                for _ in 0..2 * self.random.below(3) {
                    let next = webs[webs.len() - 1] + self.positive(0.1, 0.4);
                    webs.push(self.round(next));
                }
                couplets.push(format!("DEPTH,{}", list(&webs)));
                couplets.push(self.feed());
            }
            "CSINK" => {
                let diameter = self.positive(0.2, 0.8);
                let angle = self.random.pick(&[60, 82, 90, 100, 120]);
                couplets.push(format!("DIAMET,{diameter},TLANGL,{angle}"));
                if self.random.once_in(3) {
                    let inside = self.round(diameter / 2.0);
                    if inside > 0.0 && inside < diameter {
                        couplets.push(format!("HOLDIA,{inside}"));
                    }
                }
                couplets.push(self.feed());
            }
            "TAP" => {
                couplets.push(format!("DEPTH,{depth}"));
                couplets.push(self.lead());
            }
            _ => {
                couplets.push(format!("DEPTH,{depth}"));
                couplets.push(self.feed());
            }
        }
        let second = self.clearances(&mut couplets, kind, clear);
        self.options(&mut couplets, kind, clear, depth, second);
        // couplets may be in any order, but a feed must follow its depths
        let at = self.random.below(couplets.len() + 1);
        if self.random.once_in(3) && at < couplets.len() && couplets[at].starts_with("CLEAR") {
            let clear = couplets.remove(at);
            couplets.insert(0, clear);
        }
        let mut line = format!("CYCLE/{kind},{}", couplets.join(","));
        // a long statement continues on the next line
        if self.random.once_in(6)
            && let Some(at) = line.find(",CLEAR")
        {
            line.insert_str(at + 1, "$\n   ");
        }
        line
    }

    fn clearances(&mut self, couplets: &mut Vec<String>, kind: &str, clear: f64) -> Option<f64> {
        let takes_second = kind.ends_with("DEEP") || kind.ends_with("BRKCHP") || kind == "THRU";
        let second = (takes_second && self.random.once_in(2)).then(|| self.positive(0.01, 0.08));
        let coded = !self.cleared || self.random.below(4) > 0;
        match second {
            Some(second) if coded && self.random.once_in(2) => couplets.push(format!("CLEAR,{clear},{second}")),
            second => {
                if coded {
                    couplets.push(format!("CLEAR,{clear}"));
                }
                couplets.extend(second.map(|second| format!("BACK,{second}")));
            }
        }
        self.cleared = true;
        second
    }

    /// A feed that is the lead of a thread.
    fn lead(&mut self) -> String {
        match self.random.below(3) {
            0 => format!("TPI,{}", self.random.pick(&[20, 24, 28, 32])),
            1 => format!("MMPR,{}", self.random.pick(&[0.5, 0.7, 1.0, 1.25, 1.5])),
            _ => format!("IPR,{}", self.random.pick(&[0.02, 0.03125, 0.05])),
        }
    }

    fn pecks(&mut self, couplets: &mut Vec<String>, depth: f64, chips: bool) {
        match self.random.below(5) {
            // depths from the point
            0 => {
                let mut to = 0.0;
                let mut group = Vec::new();
                for _ in 0..2 + self.random.below(3) {
                    to += self.positive(0.1, 0.4);
                    to = self.round(to);
                    group.push(to);
                    if self.random.once_in(4) {
                        couplets.push(format!("DEPTH,{},{}", list(&group), self.feed()));
                        group.clear();
                    }
                }
                if !group.is_empty() || couplets.is_empty() {
                    if group.len() + couplets.len() < 2 {
                        to += self.positive(0.1, 0.4);
                        to = self.round(to);
                        group.push(to);
                    }
                    couplets.push(format!("DEPTH,{},{}", list(&group), self.feed()));
                }
            }
            // several steps, some with their own feeds
            1 => {
                couplets.push(format!("DEPTH,{depth}"));
                for _ in 0..1 + self.random.below(2) {
                    let steps: Vec<f64> = (0..1 + self.random.below(3)).map(|_| self.positive(0.1, 0.3)).collect();
                    couplets.push(format!("STEP,{},{}", list(&steps), self.feed()));
                }
            }
            2 => {
                let step = self.positive(0.1, 0.4);
                let less = self.positive(0.01, 0.1);
                let least = self.positive(0.03, 0.06);
                couplets.push(format!("DEPTH,{depth},STEP,{step},{},DECR,{less},MINSTP,{least}", self.feed()));
            }
            _ => {
                let step = self.positive(0.05, 0.5);
                couplets.push(format!("DEPTH,{depth},STEP,{step},{}", self.feed()));
            }
        }
        if chips && self.random.once_in(4) {
            couplets.push(format!("TIMES,{}", 1 + self.random.below(4)));
        }
    }

    fn options(&mut self, couplets: &mut Vec<String>, kind: &str, clear: f64, depth: f64, second: Option<f64>) {
        if self.random.once_in(3) {
            match self.random.below(3) {
                0 => couplets.push("RETURN".into()),
                _ => {
                    let above = self.positive(0.05, 1.5);
                    couplets.push(format!("RETURN,{}", self.round(clear + above)));
                }
            }
        }
        if self.random.once_in(4) {
            match self.random.once_in(4) {
                true => couplets.push(format!("REV,{}", self.random.pick(&[2, 5, 20]))),
                false => couplets.push(format!("DWELL,{}", self.random.pick(&[0.1, 0.25, 0.5, 1.0, 2.0]))),
            }
        }
        let bores = kind.starts_with("BORE");
        if kind != "BORE,BACK" && self.random.once_in(10) {
            couplets.push(format!("RAPTO,{}", self.round(clear * 0.5)));
        }
        match kind {
            "BORE,BACK" => {
                let below = self.positive(0.05, 0.5);
                couplets.push(format!("RAPTO,{}", self.round(depth + below)));
                couplets.push(format!("ORIENT,{}", self.random.pick(&[0, 45, 90, 180])));
                self.offset(couplets);
            }
            "BORE" if self.random.once_in(2) => {
                couplets.push(format!("ORIENT,{}", self.random.pick(&[0, 45, 90, 180, 270])));
                self.offset(couplets);
            }
            "TAP" => {
                match self.random.below(6) {
                    0 => couplets.push("RIGID".into()),
                    _ => couplets.push("FLOAT".into()),
                }
                let more = self.random.below(10);
                match more {
                    0 => couplets.push("NOREVR".into()),
                    1 => couplets.push("RAPOUT".into()),
                    2 => couplets.push("RATIO,1.5".into()),
                    4 => couplets.push("MULTRD,2".into()),
                    _ => {}
                }
                // a thread in the direction of the spindle; postform refuses the opposite direction (PC054)
                if !self.clockwise {
                    couplets.push("INVERS".into());
                }
            }
            "REAM" if self.random.once_in(3) => {
                couplets.push(format!("RATIO,{}", self.random.pick(&[0.5, 1.5, 2.0])));
            }
            _ => {}
        }
        if bores && second.is_none() && self.random.once_in(4) && couplets.iter().any(|c| c.starts_with("ORIENT")) {
            couplets.push(format!("BACK,{}", self.positive(0.005, 0.05)));
        }
    }

    fn offset(&mut self, couplets: &mut Vec<String>) {
        let jog = self.positive(0.01, 0.1);
        match self.random.below(3) {
            0 => couplets.push(format!("OFSETL,{jog},{}", self.positive(0.01, 0.1))),
            1 => couplets.push(format!("OFSETL,{jog}")),
            // the second number of CLEAR
            _ => {
                if let Some(clear) = couplets.iter_mut().find(|couplet| couplet.starts_with("CLEAR")) {
                    _ = write!(clear, ",{jog}");
                } else {
                    couplets.push(format!("OFSETL,{jog}"));
                }
            }
        }
    }
}

fn list(numbers: &[f64]) -> String {
    numbers.iter().map(f64::to_string).collect::<Vec<_>>().join(",")
}
