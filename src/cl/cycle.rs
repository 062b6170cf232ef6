//! CYCLE statements and their points.

use super::coded::{Coded, over};
use super::cycle_words::{Opt, in_gener_words};
use super::dialect::Dialect;
use super::reader::{Done, Reader, fault};
use super::words::Word;
use crate::cycle::check;
use crate::diag::Code;
use crate::toolpath::{Axes, CycleSpec, Event, Hole, LastDwell};

/// CYCLE/RETURN: what sets the return plane of the cycles that follow.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum ReturnMode {
    #[default]
    AsCoded,
    AtStart,
    Above(f64),
    Off,
}

/// The cycle in force, and what is remembered from one to the next.
#[derive(Debug, Default)]
pub(super) struct CycleState {
    active: Option<CycleSpec>,
    /// The sink is in the cycle.
    open: bool,
    last: Option<Coded>,
    pub(super) clear: Option<f64>,
    pub(super) dwell: LastDwell,
    pub(super) emulate: bool,
    /// The line of the tool change that ended a cycle, until a feed or a cycle says how points are cut.
    pub(super) cut_off: Option<u64>,
    return_mode: ReturnMode,
    /// RETURN as the statement said it: above the first point; `None` within: as high as the clearance.
    coded_return: Option<Option<f64>>,
    /// The return plane, once its first point is known: as a height of the file.
    plane: Option<Option<f64>>,
}

impl CycleState {
    #[inline]
    pub(super) fn is_active(&self) -> bool {
        self.active.is_some()
    }
}

impl Reader<'_> {
    /// CYCLE/type, ON, OFF, NOMORE, AUTO, RETURN.
    pub(super) fn cycle(&mut self, words: &[Word]) -> Done {
        let Some(first) = words.first().and_then(Word::name) else {
            return fault(Code::PC001, "CYCLE without a type", "write CYCLE/DRILL,DEPTH,10,MMPM,100,CLEAR,2");
        };
        match first {
            "OFF" | "NOMORE" => {
                self.cycle.cut_off = None;
                if !self.cycle.is_active() && self.dialect() != Dialect::SolidWorksCam {
                    self.warn(Code::PC051, format!("CYCLE/{first}, and no cycle is active"), "take it out");
                }
                self.end_cycle()?;
                self.rapid_after_cycle = true;
                Ok(())
            }
            "INIT" | "CLEAR" if self.dialect() == Dialect::SolidWorksCam => Ok(()),
            "AUTO" => self.cycle_auto(&words[1..]),
            "RETURN" => self.cycle_return(&words[1..]),
            "ON" => match self.cycle.last.clone() {
                Some(last) => self.begin_cycle(last, &words[1..], false),
                None => fault(Code::PC038, "CYCLE/ON, and there was no cycle", "write the whole cycle"),
            },
            _ => {
                let words = in_gener_words(words, self.dialect()).or_else(|help| {
                    fault(Code::PC040, "a return plane that postform does not know of this system", help)
                })?;
                let (coded, rest) = self.cycle_type(&words)?;
                self.begin_cycle(coded, rest, true)
            }
        }
    }

    fn cycle_auto(&mut self, words: &[Word]) -> Done {
        match words {
            [word] if word.is("ON") || word.is("OFF") => {
                let emulate = word.is("OFF");
                if emulate != self.cycle.emulate {
                    self.close_holes()?; // acts on the points that follow
                }
                self.cycle.emulate = emulate;
                if let Some(spec) = &mut self.cycle.active {
                    spec.emulate = emulate;
                }
                Ok(())
            }
            _ => fault(Code::PC039, "a CYCLE/AUTO that can't be read", "write CYCLE/AUTO,ON or OFF"),
        }
    }

    fn cycle_return(&mut self, words: &[Word]) -> Done {
        self.cycle.return_mode = match words {
            [word] if word.is("ON") => ReturnMode::AtStart,
            [word] if word.is("OFF") => ReturnMode::Off,
            [word] if word.is("AUTO") => ReturnMode::AsCoded,
            [Word::Number(height)] => ReturnMode::Above(*height),
            _ => {
                let help = "write CYCLE/RETURN,ON, OFF, AUTO or a height";
                return fault(Code::PC040, "a CYCLE/RETURN that can't be read", help);
            }
        };
        Ok(())
    }

    /// A cycle from what is coded already and these words.
    fn begin_cycle(&mut self, coded: Coded, words: &[Word], whole: bool) -> Done {
        self.close_holes()?;
        self.cycle.active = None;
        self.rapid = false; // one that stands before a cycle is dropped
        self.rapid_after_cycle = false;
        self.cycle.cut_off = None;
        if self.compensated {
            return fault(Code::PC041, "a cycle under cutter compensation", "end it with CUTCOM/OFF before");
        }
        let said = self.read_options(&coded, words, whole)?;
        let coded = if whole { said } else { over(coded, said) };
        let spec = self.spec(&coded)?;
        check(&spec)?;
        self.cycle.coded_return = coded.numbers(Opt::Return).map(|numbers| numbers.first().copied());
        self.cycle.plane = None;
        self.cycle.last = Some(coded);
        self.cycle.active = Some(spec);
        Ok(())
    }

    /// A point of the cycle in force.
    pub(super) fn point(&mut self, at: [f64; 3]) -> Done {
        let Some(mut spec) = self.cycle.active.take() else { return Ok(()) };
        let done = self.hole(at, &mut spec);
        self.cycle.active = Some(spec);
        done
    }

    fn hole(&mut self, at: [f64; 3], spec: &mut CycleSpec) -> Done {
        if !self.cycle.open {
            // a sink counts the return plane from the first point that it sees
            let plane = self.return_plane(at, spec)?;
            spec.return_height =
                plane.map(|plane| plane - at[2]).filter(|&height| height > spec.clear.unwrap_or(f64::MIN));
            self.push(Event::CycleBegin(spec))?;
            self.cycle.open = true;
        }
        self.push(Event::Hole(Hole { at: Axes::new(&at), depth: None }))?;
        // where the hole is left is known where its clearance is
        self.position = spec.clear.map(|clear| {
            let plane = self.cycle.plane.flatten().unwrap_or(f64::MIN);
            [at[0], at[1], plane.max(at[2] + clear)]
        });
        self.heading = None;
        Ok(())
    }

    /// The height to which the tool comes back, one for the whole cycle: set at its first point.
    fn return_plane(&mut self, at: [f64; 3], spec: &CycleSpec) -> Done<Option<f64>> {
        if let Some(plane) = self.cycle.plane {
            return Ok(plane);
        }
        let clear = at[2] + spec.clear.unwrap_or(0.0);
        let plane = match (self.cycle.return_mode, self.cycle.coded_return) {
            (ReturnMode::Off, _) | (ReturnMode::AsCoded, None) => None,
            (ReturnMode::AsCoded, Some(above)) => Some(above.map_or(clear, |above| at[2] + above)),
            (ReturnMode::Above(above), _) => Some(at[2] + above),
            (ReturnMode::AtStart, _) => match self.position {
                Some(position) => Some(position[2]),
                None => {
                    let help = "put a GOTO before the cycle, or give CYCLE/RETURN a height";
                    return fault(Code::PC040, "CYCLE/RETURN,ON, and the tool's height is not known", help);
                }
            },
        };
        if plane.is_some_and(|plane| plane >= at[2] && plane < clear) {
            self.warn(
                Code::PC053,
                "the return plane is below the clearance, which is used",
                "give RETURN above CLEAR, or leave it out",
            );
        }
        self.cycle.plane = Some(plane);
        Ok(plane)
    }

    /// Feeds per revolution follow the spindle, also inside a cycle.
    pub(super) fn cycle_feeds(&mut self) -> Done {
        if self.cycle.active.is_some()
            && let Some(coded) = self.cycle.last.clone()
        {
            self.close_holes()?;
            self.cycle.active = Some(self.spec(&coded)?);
        }
        Ok(())
    }

    /// The sink leaves the cycle; it may go on after a motion that is none of its points.
    pub(super) fn close_holes(&mut self) -> Done {
        if std::mem::take(&mut self.cycle.open) { self.push(Event::CycleEnd) } else { Ok(()) }
    }

    /// The cycle ends; the next motion is a rapid.
    pub(super) fn end_cycle(&mut self) -> Done {
        self.close_holes()?;
        if self.cycle.active.take().is_some() {
            self.rapid_after_cycle = true;
        }
        Ok(())
    }
}
