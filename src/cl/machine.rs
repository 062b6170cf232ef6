//! Tools, spindle, coolant, feeds, units and dwells.

use super::dialect::Dialect;
use super::motion::numbers;
use super::reader::{Done, Reader, fault, no_change};
use super::words::Word;
use crate::diag::Code;
use crate::toolpath::{Coolant, Event, Side, Spindle, SpindleTurn, Tool, ToolChange, Units};

/// Millimetres in an inch.
const MM: f64 = 25.4;
/// Metres in a foot.
const METRES_A_FOOT: f64 = 0.3048;

/// A feed as it was said.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Feed {
    /// Lengths of the file a minute.
    Minute(f64),
    /// Lengths of the file a revolution.
    Revolution(f64),
}

impl Reader<'_> {
    /// UNITS/MM or INCHES.
    pub(super) fn units(&mut self, words: &[Word]) -> Done {
        let units = match words {
            [Word::Name(name)] if name == "MM" => Units::Mm,
            [Word::Name(name)] if matches!(name.as_str(), "INCHES" | "INCH" | "IN") => Units::Inch,
            _ => return fault(Code::PL004, "units that postform does not read", "write UNITS/MM or UNITS/INCHES"),
        };
        if self.units.is_some_and(|before| before != units) {
            return fault(Code::PL004, "the units change inside the file", "let the CAM system write one unit");
        }
        self.units = Some(units);
        Ok(())
    }

    /// The feed that a unit word and a number mean, in lengths of the file. `None`: no such word.
    pub(super) fn feed_of(&self, unit: &str, value: f64) -> Done<Option<Feed>> {
        if matches!(unit, "PERMIN" | "PERREV") {
            return Ok(Some(if unit == "PERMIN" { Feed::Minute(value) } else { Feed::Revolution(value) }));
        }
        let inches = if self.units_so_far()? == Units::Mm { MM } else { 1.0 };
        Ok(Some(match unit {
            "IPM" => Feed::Minute(value * inches),
            "MMPM" => Feed::Minute(value * inches / MM),
            "IPR" => Feed::Revolution(value * inches),
            "MMPR" => Feed::Revolution(value * inches / MM),
            // PostWorks: below 1 it is the lead
            "TPI" if self.dialect() == Dialect::Ncl && value < 1.0 => Feed::Revolution(value),
            "TPI" => Feed::Revolution(inches / value),
            _ => return Ok(None),
        }))
    }

    /// The file's units; what is said in units of its own can't be converted before they are known.
    pub(super) fn units_so_far(&self) -> Done<Units> {
        match self.units.or(self.options.units) {
            Some(units) => Ok(units),
            None => {
                let help = "put UNITS/MM or UNITS/INCHES before it, or say it with `--assume-units`";
                fault(Code::PL005, "the file has not said its units yet", help)
            }
        }
    }

    /// A feed in lengths a minute; per revolution it needs a turning spindle.
    pub(super) fn per_minute(&self, feed: Feed) -> Done<f64> {
        match feed {
            Feed::Minute(value) => Ok(value),
            Feed::Revolution(value) => {
                let turns =
                    self.spindle.turn.is_some_and(|turn| turn != SpindleTurn::Off) && self.spindle.css != Some(true);
                match self.spindle.speed.filter(|&rpm| turns && rpm > 0.0) {
                    Some(rpm) => Ok(value * rpm),
                    None => {
                        let help = "put SPINDL/speed,RPM,CLW before it";
                        fault(Code::PC009, "a feed per revolution, and the spindle does not turn", help)
                    }
                }
            }
        }
    }

    /// FEDRAT: a number and its unit in any order.
    pub(super) fn fedrat(&mut self, words: &[Word]) -> Done {
        if self.cycle.is_active() {
            self.warn(Code::PC052, "FEDRAT inside a cycle is ignored", "say the feed in the CYCLE statement");
            return Ok(());
        }
        let value = words.iter().find_map(Word::number);
        let feed = match (words, value) {
            ([Word::Number(value)], _) => Some(Feed::Minute(*value)),
            ([Word::Name(unit), Word::Number(value)] | [Word::Number(value), Word::Name(unit)], _) => {
                self.feed_of(unit, *value)?.filter(|_| unit != "TPI")
            }
            _ => None,
        };
        let Some(feed) = feed else {
            let help = "write FEDRAT/value,MMPM, or IPM, PERMIN, MMPR, IPR, PERREV";
            return fault(Code::PL002, "a FEDRAT that can't be read", help);
        };
        if value.is_some_and(|value| value <= 0.0) {
            return fault(Code::PL001, "a feed that is not above zero", "give the feed");
        }
        self.feed = Some(feed);
        self.cycle.cut_off = None;
        self.rapid_after_cycle = false;
        Ok(())
    }

    /// A feed that rides on a motion.
    pub(super) fn feed_on_goto(&mut self, value: f64) -> Done {
        if value <= 0.0 {
            return fault(Code::PL001, "a feed that is not above zero", "give the feed");
        }
        self.cycle.cut_off = None;
        self.feed = Some(match self.feed {
            Some(Feed::Revolution(_)) => Feed::Revolution(value),
            _ => Feed::Minute(value),
        });
        Ok(())
    }

    /// The feed of the next motion, where the sink does not have it yet.
    #[inline]
    pub(super) fn feed_to_say(&mut self) -> Done<Option<f64>> {
        if let Some(line) = self.cycle.cut_off {
            let message =
                format!("the tool change in line {line} ended a cycle, and nothing says how this point is cut");
            let help = "put CYCLE/OFF before the tool change, and CYCLE or FEDRAT before this point";
            return fault(Code::PC043, message, help);
        }
        let Some(feed) = self.feed else {
            return fault(Code::PR011, "a feed motion before any feed", "put FEDRAT before it");
        };
        let feed = self.per_minute(feed)?;
        if self.change.is_none() && self.feed_known == Some(feed) {
            return Ok(None);
        }
        // an operation that is about to begin forgets the feed, so it is said with its first motion
        if self.change.is_none() {
            self.feed_known = Some(feed);
        }
        Ok(Some(feed))
    }

    /// SPINDL: speed, what it counts, direction, in any order.
    pub(super) fn spindl(&mut self, words: &[Word]) -> Done {
        let mut said = Spindle::default();
        let mut surface = 1.0;
        let mut words = words.iter().peekable();
        while let Some(word) = words.next() {
            match word {
                Word::Number(speed) if *speed >= 0.0 && said.speed.is_none() => said.speed = Some(*speed),
                Word::Name(name) => match name.as_str() {
                    "RPM" => said.css = Some(false),
                    "SFM" | "SMM" => {
                        said.css = Some(true);
                        // what a surface speed counts goes with the units of the file
                        let metric = self.units_so_far()? == Units::Mm;
                        surface = match (name.as_str(), metric) {
                            ("SFM", true) => METRES_A_FOOT,
                            ("SMM", false) => 1.0 / METRES_A_FOOT,
                            _ => 1.0,
                        };
                    }
                    "CLW" => said.turn = Some(SpindleTurn::Cw),
                    "CCLW" => said.turn = Some(SpindleTurn::Ccw),
                    "OFF" | "STOP" => said.turn = Some(SpindleTurn::Off),
                    "ON" => said.turn = said.turn.or(self.last_turn).or(Some(SpindleTurn::Cw)),
                    "MAXRPM" => said.max = words.next().and_then(Word::number),
                    "RANGE" | "LOW" | "MEDIUM" | "HIGH" => {
                        words.next_if(|word| word.number().is_some());
                    }
                    _ => {
                        return fault(
                            Code::PL002,
                            format!("SPINDL does not know `{name}`"),
                            "write SPINDL/1200,RPM,CLW",
                        );
                    }
                },
                word => return fault(Code::PL001, format!("SPINDL with `{word}`"), "write SPINDL/1200,RPM,CLW"),
            }
        }
        said.speed = said.speed.map(|speed| speed * surface);
        if said.speed.is_some() && said.turn.is_none() && self.spindle.turn.is_none() {
            said.turn = Some(SpindleTurn::Cw); // APT's default
        }
        self.spindle = Spindle {
            speed: said.speed.or(self.spindle.speed),
            turn: said.turn.or(self.spindle.turn),
            css: said.css.or(self.spindle.css),
            max: said.max.or(self.spindle.max),
        };
        self.last_turn = self.spindle.turn.filter(|turn| *turn != SpindleTurn::Off).or(self.last_turn);
        self.spindle_is_new = true;
        self.cycle_feeds()?;
        if said.css == Some(false) {
            said.css = None; // what a form starts with
        }
        if self.change.is_some() || !self.has_operation() {
            return Ok(()); // the tool change says it
        }
        self.close_holes()?;
        self.push(Event::Spindle(Spindle { css: self.spindle.css.filter(|css| *css || said.css.is_some()), ..said }))
    }

    /// COOLNT.
    pub(super) fn coolnt(&mut self, words: &[Word]) -> Done {
        let name = match words {
            [Word::Name(name)] => name.as_str(),
            _ => return fault(Code::PL002, "COOLNT with more than one word", "write ON, FLOOD, MIST or OFF"),
        };
        let coolant = match name {
            "ON" | "FLOOD" => Coolant::On,
            "MIST" => Coolant::Mist,
            "OFF" => Coolant::Off,
            "THRU" | "TAPKUL" | "AIR" | "HIGH" | "LOW" => {
                let message = format!("COOLNT/{name} is printed as flood coolant");
                self.warn(Code::PL008, message, "change the program, or write COOLNT/FLOOD");
                Coolant::On
            }
            _ => return fault(Code::PL002, format!("COOLNT does not know `{name}`"), "write ON, FLOOD, MIST or OFF"),
        };
        self.coolant = Some(coolant);
        if let Some((change, _)) = &mut self.change {
            change.coolant = Some(coolant);
            return Ok(());
        }
        if !self.has_operation() {
            return Ok(());
        }
        self.close_holes()?;
        self.push(Event::Coolant(coolant))
    }

    /// LOADTL/n, LOAD/TOOL,n, TOOLNO/n: a tool change, complete with the next feed motion or spindle.
    pub(super) fn load(&mut self, name: &str, words: &[Word]) -> Done {
        if name == "TOOLNO" && self.dialect() == Dialect::Catia {
            return Ok(()); // describes the tool that LOADTL loads
        }
        let words = match words.first() {
            Some(word) if word.is("TOOL") => &words[1..],
            _ => words,
        };
        let Some(number) = words.first().and_then(Word::number).filter(|n| *n >= 0.0 && n.fract() == 0.0) else {
            return fault(Code::PL001, format!("{name} without a tool number"), format!("write {name}/1"));
        };
        self.greatest_tool = self.greatest_tool.max(number);
        let register = self.length_register(name, &words[1..])?;
        self.another_tool(Some(Tool { number, length_offset: register, ..Tool::default() }))
    }

    /// Another tool: its change is complete with the next feed motion or spindle. `None`: it is only named so far.
    pub(super) fn another_tool(&mut self, tool: Option<Tool>) -> Done {
        self.cycle.cut_off = self.cycle.is_active().then_some(self.place.line).or(self.cycle.cut_off);
        self.end_cycle()?;
        self.complete_change()?;
        let spindle_is_new = self.spindle_is_new;
        self.spindle_is_new &= tool.is_none();
        let change = ToolChange { coolant: self.coolant, ..no_change(tool) };
        self.change = Some((change, self.place));
        self.rapid_after_cycle = false; // what the tool before left
        if !spindle_is_new {
            self.spindle = Spindle::default();
        }
        Ok(())
    }

    /// The words behind a tool's number; those that say its length register.
    fn length_register(&self, name: &str, words: &[Word]) -> Done<Option<f64>> {
        let mut register = None;
        let mut words = words.iter().peekable();
        while let Some(word) = words.next() {
            match word.name() {
                None => {}
                Some("ADJUST" | "OFSETNO" | "OSETNO") => {
                    register = words.next_if(|word| word.number().is_some() || word.is("OFF")).and_then(Word::number);
                }
                Some("LENGTH" | "SPINDL") => {
                    words.next_if(|word| word.number().is_some());
                }
                Some("MILL" | "DRILL" | "TURN" | "AUTO" | "MANUAL" | "IN") => {}
                Some(word) => {
                    return fault(Code::PL002, format!("{name} does not know `{word}`"), format!("write {name}/1"));
                }
            }
        }
        Ok(register)
    }

    /// CUTTER and TLDATA: the first number is the diameter.
    pub(super) fn cutter(&mut self, words: &[Word]) -> Done {
        self.diameter = words.iter().find_map(Word::number);
        Ok(())
    }

    /// CUTCOM/LEFT, RIGHT, OFF: the next motion carries it.
    pub(super) fn cutcom(&mut self, words: &[Word]) -> Done {
        let side = |name: &str| match name {
            "LEFT" => Some(Some(Side::Left)),
            "RIGHT" => Some(Some(Side::Right)),
            "OFF" => Some(None),
            _ => None,
        };
        let known = ["XYPLAN", "OSETNO", "OFSETNO", "NORMDS"];
        let mut asked = None;
        for word in words {
            match word {
                Word::Name(name) if side(name).is_some() => asked = side(name),
                Word::Name(name) if known.contains(&name.as_str()) => {}
                Word::Number(_) => self.warn(
                    Code::PL008,
                    "the offset register of CUTCOM is not printed, but the tool's",
                    "compare the D word of the program",
                ),
                word => {
                    return fault(Code::PL002, format!("CUTCOM does not know `{word}`"), "write LEFT, RIGHT or OFF");
                }
            }
        }
        let Some(asked) = asked else {
            return fault(Code::PL002, "CUTCOM without a side", "write CUTCOM/LEFT, RIGHT or OFF");
        };
        if self.cycle.is_active() && asked.is_some() {
            return fault(Code::PC041, "CUTCOM inside a cycle", "end the cycle before");
        }
        // off, and nothing was on: nothing to turn off
        self.compensation = Some(asked).filter(|_| asked.is_some() || self.compensated);
        self.compensated = asked.is_some();
        Ok(())
    }

    /// DELAY/seconds, or revolutions with REV.
    pub(super) fn delay(&mut self, words: &[Word]) -> Done {
        let seconds = match (numbers(words).as_deref(), words) {
            (Some([seconds]), _) => *seconds,
            (None, [Word::Name(name), Word::Number(n)] | [Word::Number(n), Word::Name(name)]) if name == "REV" => {
                n / self.per_minute(Feed::Revolution(1.0))? * 60.0
            }
            _ => return fault(Code::PL001, "a DELAY that can't be read", "write DELAY/seconds or DELAY/REV,turns"),
        };
        if seconds < 0.0 {
            return fault(Code::PL001, "a DELAY below zero", "write DELAY/seconds");
        }
        self.close_holes()?;
        self.push(Event::Dwell(seconds))
    }
}
