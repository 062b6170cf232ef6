//! Reads CYCLE/type and its couplets.

use super::feed::is_feed;
use super::statement::{Minor, Statement};

/// The type of a cycle, which determines its moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// In at feed, out at rapid.
    Drill,
    /// With a dwell at the bottom.
    Face,
    /// In, reverse, out at feed.
    Tap,
    /// In at feed, the spindle stops, out at rapid.
    Bore,
    /// From below the part, up at feed.
    BoreBack,
    /// In and out at feed.
    Ream,
    /// Pecks with full retracts.
    Deep,
    /// Pecks with small retracts.
    Chips,
    /// Several webs.
    Thru,
    /// A chamfer by its diameter.
    Sink,
    /// A rapid over the hole, then a program stop.
    Manual,
}

/// A group of depths or steps, with the feed that follows them.
#[derive(Clone, Debug, Default)]
pub struct Group {
    /// Depths below the point, or steps from the previous depth.
    pub values: Vec<f64>,
    /// The word of the feed, and its number.
    pub feed: Option<(String, f64)>,
}

/// A dwell: its word, and its number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Dwell {
    /// DWELL.
    Seconds(f64),
    /// REV.
    Revolutions(f64),
}

/// The RETURN of a cycle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Return {
    /// RETURN without a number: the clearance of the first point.
    Clearance,
    /// RETURN with a number: this height above the first point.
    Above(f64),
}

/// A cycle as it was coded. Lengths are in units of the file.
#[derive(Clone, Debug)]
pub struct Cycle {
    /// The type of the cycle.
    pub kind: Kind,
    /// DEEP or BRKCHP of a tap.
    pub pecks: Option<Kind>,
    /// DEPTH couplets.
    pub depths: Vec<Group>,
    /// STEP couplets.
    pub steps: Vec<Group>,
    /// The feed that belongs to no group.
    pub feed: Option<(String, f64)>,
    /// First number of CLEAR.
    pub clear: Option<f64>,
    /// Second number of CLEAR.
    pub second: Option<f64>,
    /// BACK.
    pub back: Option<f64>,
    /// OFSETL.
    pub offset: Vec<f64>,
    /// RETURN.
    pub out: Option<Return>,
    /// RAPTO.
    pub rapto: Option<f64>,
    /// DWELL or REV.
    pub dwell: Option<Dwell>,
    /// ORIENT, with its angle.
    pub orient: Option<Option<f64>>,
    /// RATIO.
    pub ratio: Option<f64>,
    /// MULTRD.
    pub starts: Option<f64>,
    /// DECR.
    pub decrement: Option<f64>,
    /// MINSTP.
    pub least: Option<f64>,
    /// TIMES.
    pub times: Option<f64>,
    /// DIAMET, TLANGL, HOLDIA.
    pub sink: [Option<f64>; 3],
    /// INVERS, NOREVR, RAPOUT, RIGID, FLOAT.
    pub flags: Vec<String>,
}

const FLAGS: [&str; 5] = ["INVERS", "NOREVR", "RAPOUT", "RIGID", "FLOAT"];

impl Cycle {
    fn new(kind: Kind) -> Cycle {
        Cycle {
            kind,
            pecks: None,
            depths: Vec::new(),
            steps: Vec::new(),
            feed: None,
            clear: None,
            second: None,
            back: None,
            offset: Vec::new(),
            out: None,
            rapto: None,
            dwell: None,
            orient: None,
            ratio: None,
            starts: None,
            decrement: None,
            least: None,
            times: None,
            sink: [None; 3],
            flags: Vec::new(),
        }
    }

    /// Whether the cycle contains this word, which has no number.
    pub fn is(&self, flag: &str) -> bool {
        self.flags.iter().any(|own| own == flag)
    }

    /// Reads `CYCLE/type,..`; `None` if a word is unknown to this reader.
    pub fn read(statement: &Statement) -> Option<Cycle> {
        let word = |at: usize| match statement.minors.get(at) {
            Some(Minor::Word(word)) => word.as_str(),
            _ => "",
        };
        let number_after = |at: usize| statement.minors.get(at + 1).and_then(Minor::number).is_some();
        let (kind, pecks, from) = match (word(0), word(1)) {
            ("DRILL", "DEEP") => (Kind::Deep, None, 2),
            ("DRILL", "BRKCHP") => (Kind::Chips, None, 2),
            ("TAP", "DEEP") => (Kind::Tap, Some(Kind::Deep), 2),
            ("TAP", "BRKCHP") => (Kind::Tap, Some(Kind::Chips), 2),
            ("BORE", "BACK") if !number_after(1) => (Kind::BoreBack, None, 2),
            ("DRILL", _) => (Kind::Drill, None, 1),
            ("FACE", _) => (Kind::Face, None, 1),
            ("TAP", _) => (Kind::Tap, None, 1),
            ("BORE", _) => (Kind::Bore, None, 1),
            ("REAM", _) => (Kind::Ream, None, 1),
            ("DEEP", _) => (Kind::Deep, None, 1),
            ("BRKCHP", _) => (Kind::Chips, None, 1),
            ("THRU", _) => (Kind::Thru, None, 1),
            ("CSINK", _) => (Kind::Sink, None, 1),
            ("MANUAL", _) => (Kind::Manual, None, 1),
            _ => return None,
        };
        let mut cycle = Cycle::new(kind);
        cycle.pecks = pecks;
        cycle.words(&statement.minors[from..])?;
        Some(cycle)
    }

    /// The same cycle, with the words of CYCLE/ON in place of the cycle's own words.
    pub fn again(&self, statement: &Statement) -> Option<Cycle> {
        let mut own = Cycle::new(self.kind);
        own.words(&statement.minors[1..])?;
        let mut cycle = self.clone();
        if !own.depths.is_empty() {
            cycle.depths = own.depths;
        }
        if !own.steps.is_empty() {
            cycle.steps = own.steps;
        }
        if own.feed.is_some() {
            cycle.depths.iter_mut().chain(&mut cycle.steps).for_each(|group| group.feed = None);
            cycle.feed = own.feed;
        }
        cycle.clear = own.clear.or(cycle.clear);
        // the numbers of a couplet are replaced together
        cycle.second = if own.clear.is_some() { own.second } else { cycle.second };
        cycle.back = own.back.or(cycle.back);
        if !own.offset.is_empty() {
            cycle.offset = own.offset;
        }
        cycle.out = own.out.or(cycle.out);
        cycle.rapto = own.rapto.or(cycle.rapto);
        cycle.dwell = own.dwell.or(cycle.dwell);
        cycle.orient = own.orient.or(cycle.orient);
        cycle.ratio = own.ratio.or(cycle.ratio);
        cycle.starts = own.starts.or(cycle.starts);
        cycle.decrement = own.decrement.or(cycle.decrement);
        cycle.least = own.least.or(cycle.least);
        cycle.times = own.times.or(cycle.times);
        for (place, number) in cycle.sink.iter_mut().zip(own.sink) {
            *place = number.or(*place);
        }
        cycle.flags.extend(own.flags);
        Some(cycle)
    }

    /// The feed of a depth or step by its index, from 0: "the feed rate specification applies to all of the depths or
    /// step amounts that precede it". The feed of the last group also applies after the last group.
    pub fn feed_of(&self, number: usize) -> Option<(String, f64)> {
        let groups = if self.steps.is_empty() { &self.depths } else { &self.steps };
        let mut before = 0;
        for group in groups {
            before += group.values.len();
            if number < before && group.feed.is_some() {
                return group.feed.clone();
            }
        }
        let last = groups.iter().rev().find_map(|group| group.feed.clone());
        let of_depth = || self.depths.iter().find_map(|group| group.feed.clone());
        last.or_else(|| self.feed.clone()).or_else(of_depth)
    }

    fn words(&mut self, minors: &[Minor]) -> Option<()> {
        let mut at = 0;
        // the DEPTH or STEP group without a feed so far
        let mut open: Option<bool> = None;
        while let Some(minor) = minors.get(at) {
            let Minor::Word(word) = minor else { return None };
            at += 1;
            let numbers: Vec<f64> = minors[at..].iter().map_while(Minor::number).collect();
            at += numbers.len();
            let first = numbers.first().copied();
            match word.as_str() {
                "DEPTH" => {
                    self.depths.push(Group { values: numbers, feed: None });
                    open = Some(false);
                }
                "STEP" => {
                    self.steps.push(Group { values: numbers, feed: None });
                    open = Some(true);
                }
                feed if is_feed(feed) => {
                    let said = (feed.to_owned(), first?);
                    let group = match open.take() {
                        Some(true) => self.steps.last_mut(),
                        Some(false) => self.depths.last_mut(),
                        None => None,
                    };
                    match group {
                        Some(group) => group.feed = Some(said),
                        None => self.feed = Some(said),
                    }
                }
                "CLEAR" => {
                    self.clear = first;
                    self.second = numbers.get(1).copied();
                }
                "BACK" => self.back = first,
                "OFSETL" => self.offset = numbers,
                "RETURN" => self.out = Some(first.map_or(Return::Clearance, Return::Above)),
                "RAPTO" => self.rapto = first,
                "DWELL" => self.dwell = Some(Dwell::Seconds(first?)),
                "REV" => self.dwell = Some(Dwell::Revolutions(first?)),
                "ORIENT" => self.orient = Some(first),
                "RATIO" => self.ratio = first,
                "MULTRD" => self.starts = first,
                "DECR" => self.decrement = first,
                "MINSTP" => self.least = first,
                "TIMES" => self.times = first,
                "DIAMET" => self.sink[0] = first,
                "TLANGL" => self.sink[1] = first,
                "HOLDIA" => self.sink[2] = first,
                flag if FLAGS.contains(&flag) && numbers.is_empty() => self.flags.push(flag.to_owned()),
                _ => return None,
            }
        }
        Some(())
    }
}
