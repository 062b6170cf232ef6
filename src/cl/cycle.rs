//! CYCLE statements and their points.

use super::cycle_words::{OPTIONS, Opt, TYPES, in_gener_words};
use super::dialect::Dialect;
use super::machine::Feed;
use super::reader::{Done, Reader, fault};
use super::words::Word;
use crate::cycle::{Problem, check, stepped_pecks};
use crate::diag::{Code, Diag};
use crate::lang::did_you_mean;
use crate::toolpath::{Axes, CycleKind, CycleSpec, Event, Hole, Peck, SpindleTurn};

/// Depths, steps and the feed that goes with them.
#[derive(Clone, Debug, Default)]
struct Group {
    depths: Vec<f64>,
    steps: Vec<f64>,
    feed: Option<(String, f64)>,
}

/// What a CYCLE statement said, before it is a cycle: CYCLE/ON brings it back.
#[derive(Clone, Debug, Default)]
struct Coded {
    kind: Option<CycleKind>,
    mode: Option<CycleKind>,
    groups: Vec<Group>,
    /// Options without DEPTH, STEP and feeds, with their numbers.
    options: Vec<(Opt, Vec<f64>)>,
}

impl Coded {
    fn numbers(&self, option: Opt) -> Option<&[f64]> {
        self.options.iter().find(|(found, _)| *found == option).map(|(_, numbers)| numbers.as_slice())
    }

    fn has(&self, option: Opt) -> bool {
        self.numbers(option).is_some()
    }

    fn number(&self, option: Opt) -> Option<f64> {
        self.numbers(option)?.first().copied()
    }
}

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
    clear: Option<f64>,
    dwell: Option<(Option<f64>, Option<f64>)>,
    emulate: bool,
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

    /// The type, and the word that changes it: DRILL,DEEP, TAP,BRKCHP, BORE,BACK.
    fn cycle_type<'w>(&self, words: &'w [Word]) -> Done<(Coded, &'w [Word])> {
        let name = words.first().and_then(Word::name).unwrap_or("");
        let Some((_, mut kind)) = TYPES.iter().find(|(word, _)| *word == name).copied() else {
            let names = TYPES.iter().map(|(word, _)| *word);
            let help = did_you_mean(name, names).unwrap_or_else(|| {
                "it is one of DRILL, FACE, TAP, BORE, REAM, DEEP, BRKCHP, THRU, CSINK, MANUAL".into()
            });
            return fault(Code::PC001, format!("`{name}` is no cycle that postform knows"), help);
        };
        let mut rest = &words[1..];
        let mut mode = None;
        let next_is_number = rest.get(1).is_some_and(|word| word.number().is_some());
        let second = match (kind, rest.first().and_then(Word::name)) {
            (CycleKind::Drill | CycleKind::Tap, Some("DEEP")) => Some(CycleKind::Deep),
            (CycleKind::Drill | CycleKind::Tap, Some("BRKCHP")) => Some(CycleKind::Chipbreak),
            (CycleKind::Bore, Some("BACK")) if !next_is_number => Some(CycleKind::Back),
            _ => None,
        };
        if let Some(second) = second {
            rest = &rest[1..];
            if kind == CycleKind::Tap { mode = Some(second) } else { kind = second }
        }
        Ok((Coded { kind: Some(kind), mode, ..Coded::default() }, rest))
    }

    /// A cycle from what is coded already and these words.
    fn begin_cycle(&mut self, coded: Coded, words: &[Word], whole: bool) -> Done {
        self.close_holes()?;
        self.cycle.active = None;
        self.rapid = false; // one that stands before a cycle is dropped
        self.rapid_after_cycle = false;
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

    fn read_options(&mut self, before: &Coded, words: &[Word], whole: bool) -> Done<Coded> {
        let kind = before.kind.unwrap_or(CycleKind::Drill);
        let mut coded = Coded { kind: before.kind, mode: before.mode, ..Coded::default() };
        let mut at = 0;
        while at < words.len() {
            let name = match &words[at] {
                Word::Name(name) => name,
                Word::Null => {
                    self.warn(Code::PC056, "an empty place between two commas in CYCLE", "take a comma out");
                    at += 1;
                    continue;
                }
                Word::Number(value) if at == 0 && whole => return self.positional(coded, words, *value),
                Word::Number(value) => {
                    let help = "put its word before it, as DEPTH, STEP or MMPM";
                    return fault(Code::PC037, format!("{value} belongs to no word"), help);
                }
            };
            let Some(row) = OPTIONS.iter().find(|row| row.word == name) else {
                let help = did_you_mean(name, OPTIONS.iter().map(|row| row.word))
                    .unwrap_or_else(|| "take it out, or say who wrote the file with `--dialect`".into());
                return fault(Code::PC018, format!("`{name}` is no option of a cycle"), help);
            };
            let start = at + 1;
            at = start;
            let room = if row.most > 0 { row.most + 1 } else { 1 };
            while at < words.len() && words[at].number().is_some() && at - start < room {
                at += 1;
            }
            let numbers: Vec<f64> = words[start..at].iter().filter_map(Word::number).collect();
            if let (Opt::Dwell, true, Some(next)) = (row.option, numbers.is_empty(), words.get(at)) {
                // CATIA writes DWELL,DWELL,2 and DWELL,REV,2 and DWELL,,
                if next.is("DWELL") || next.is("REV") || *next == Word::Null {
                    continue;
                }
            }
            check_numbers(row.word, &numbers, (row.least, row.most), row.signed)?;
            let allowed = if row.types.is_empty() { kind != CycleKind::Manual } else { row.types.contains(&kind) };
            let pecking_tap =
                before.mode.is_some() && matches!(row.option, Opt::Step | Opt::Back | Opt::Decr | Opt::Minstp);
            if !allowed && !pecking_tap {
                let name = TYPES.iter().find(|(_, k)| *k == kind).map_or("BORE,BACK", |(word, _)| word);
                return fault(Code::PC017, format!("{name} has no {}", row.word), "take it out");
            }
            match row.option {
                Opt::Depth => group_for(&mut coded.groups, |g| !g.depths.is_empty()).depths = numbers,
                Opt::Step => group_for(&mut coded.groups, |g| !g.steps.is_empty()).steps = numbers,
                Opt::Feed => {
                    if name == "TPI" && kind != CycleKind::Tap {
                        return fault(
                            Code::PC008,
                            "threads per inch for something that is no tap",
                            "write IPR or MMPR",
                        );
                    }
                    if numbers[0] <= 0.0 {
                        return fault(Code::PC006, format!("a feed of {}", numbers[0]), "give a feed above zero");
                    }
                    let group = group_for(&mut coded.groups, |g| g.feed.is_some());
                    group.feed = Some((name.clone(), numbers[0]));
                }
                Opt::Side => self.warn(
                    Code::PL008,
                    "SIDE of CYCLE/TAP is not known and nothing is done for it",
                    "compare the tap",
                ),
                option if coded.has(option) => {
                    return fault(Code::PC019, format!("{name} is there twice"), "keep one");
                }
                option => coded.options.push((option, numbers)),
            }
        }
        Ok(coded)
    }

    /// The format of 1978, whose order each system has its own: only where a dialect is named.
    fn positional(&self, mut coded: Coded, words: &[Word], depth: f64) -> Done<Coded> {
        let catia = self.options.dialect == Some(Dialect::Catia);
        match words {
            [_, Word::Number(clear), Word::Number(feed), Word::Name(unit)] if catia => {
                let feed = Some((unit.clone(), *feed));
                coded.groups.push(Group { depths: vec![depth], steps: Vec::new(), feed });
                coded.options.push((Opt::Clear, vec![*clear]));
                Ok(coded)
            }
            _ => {
                let help = "write CYCLE/DRILL,DEPTH,10,MMPM,100,CLEAR,2, or name CATIA with `--dialect catia`";
                fault(Code::PC032, "numbers without their words, which each system orders in its own way", help)
            }
        }
    }

    /// The cycle that is coded, in units of the file a minute.
    fn spec(&mut self, coded: &Coded) -> Done<CycleSpec> {
        let kind = coded.kind.unwrap_or(CycleKind::Drill);
        let both = |a: Opt, b: Opt| coded.has(a) && coded.has(b);
        for (a, b) in [(Opt::Norevr, Opt::Rapout), (Opt::Float, Opt::Rigid), (Opt::Dwell, Opt::Rev)] {
            if both(a, b) {
                return fault(
                    Code::PC016,
                    "two options of which a cycle has one",
                    "keep NOREVR or RAPOUT, FLOAT or RIGID, DWELL or REV",
                );
            }
        }
        let left = coded.has(Opt::Invers);
        let mut spec = CycleSpec::new(if left { CycleKind::LTap } else { kind });
        spec.mode = coded.mode;
        spec.emulate = self.cycle.emulate;
        spec.steps_from_point = true;
        let second = self.clearances(coded, kind, &mut spec)?;
        self.dwells(coded, kind, &mut spec);
        spec.rapto = coded.number(Opt::Rapto);
        spec.decr = coded.number(Opt::Decr);
        spec.min_step = coded.number(Opt::Minstp);
        spec.times = coded.number(Opt::Times);
        if spec.times.is_some_and(|n| n < 1.0 || n.fract() != 0.0) {
            return fault(Code::PC036, "TIMES is no whole number", "write TIMES,2");
        }
        spec.ratio = coded.number(Opt::Ratio);
        spec.starts = coded.number(Opt::Multrd);
        if spec.starts.is_some_and(|n| !(1.0..=100.0).contains(&n) || n.fract() != 0.0) {
            return fault(Code::PC036, "MULTRD is no whole number of starts", "write MULTRD,2");
        }
        spec.rigid = (coded.has(Opt::Rigid) || coded.has(Opt::Float)).then(|| coded.has(Opt::Rigid));
        spec.norevr = coded.has(Opt::Norevr);
        spec.rapout = coded.has(Opt::Rapout);
        spec.orient = coded.numbers(Opt::Orient).map(|n| n.first().copied().unwrap_or(0.0));
        if matches!(kind, CycleKind::Bore | CycleKind::Back) {
            spec.jog = coded.number(Opt::Back);
            match coded.numbers(Opt::Ofsetl) {
                Some([x, y]) => (spec.offset, spec.offset_y) = (Some(*x), Some(*y)),
                offset => spec.offset = offset.and_then(|n| n.first().copied()).or(second),
            }
        } else {
            spec.back = coded.number(Opt::Back).or(second);
        }
        spec.diameter = coded.number(Opt::Diamet);
        spec.angle = coded.number(Opt::Tlangl);
        spec.hole_diameter = coded.number(Opt::Holdia);
        self.depths(coded, kind, &mut spec)?;
        let turns = self.spindle.turn;
        if kind == CycleKind::Tap && turns.is_some_and(|t| (t == SpindleTurn::Ccw) != left && t != SpindleTurn::Off) {
            self.warn(Code::PC054, "a tap against the spindle's direction", "look at INVERS, and at SPINDL");
        }
        Ok(spec)
    }

    /// CLEAR is remembered, its second number is not.
    fn clearances(&mut self, coded: &Coded, kind: CycleKind, spec: &mut CycleSpec) -> Done<Option<f64>> {
        let clear = coded.numbers(Opt::Clear);
        self.cycle.clear = clear.map(|numbers| numbers[0]).or(self.cycle.clear);
        spec.clear = self.cycle.clear;
        let Some(second) = clear.and_then(|numbers| numbers.get(1)).copied() else { return Ok(None) };
        let jogs = matches!(kind, CycleKind::Bore | CycleKind::Back);
        if !jogs && !matches!(kind, CycleKind::Deep | CycleKind::Chipbreak | CycleKind::Thru) && coded.mode.is_none() {
            let help = "keep the first number of CLEAR";
            return fault(Code::PC010, "this cycle has no second clearance", help);
        }
        if coded.has(if jogs { Opt::Ofsetl } else { Opt::Back }) {
            let help = "keep the second number of CLEAR, or BACK or OFSETL";
            return fault(Code::PC011, "the second clearance is there twice", help);
        }
        Ok(Some(second))
    }

    /// A dwell is not remembered, but FACE without one takes the last.
    fn dwells(&mut self, coded: &Coded, kind: CycleKind, spec: &mut CycleSpec) {
        let said = (coded.number(Opt::Dwell), coded.number(Opt::Rev));
        if said != (None, None) {
            self.cycle.dwell = Some(said);
        }
        let takes_last = kind == CycleKind::Face || coded.has(Opt::Norevr);
        (spec.dwell, spec.revs) = match self.cycle.dwell {
            Some(last) if takes_last && said == (None, None) => last,
            _ => said,
        };
    }

    /// Depths, steps and feeds.
    fn depths(&mut self, coded: &Coded, kind: CycleKind, spec: &mut CycleSpec) -> Done {
        let pecks = matches!(kind, CycleKind::Deep | CycleKind::Chipbreak) || coded.mode.is_some();
        let feeds: Vec<_> = coded.groups.iter().filter_map(|group| group.feed.clone()).collect();
        if feeds.len() > 1 && (!pecks || coded.mode.is_some()) {
            return fault(Code::PC007, "two feeds where the cycle has one", "keep one");
        }
        let mut last = None;
        let mut of_groups = Vec::new();
        for group in &coded.groups {
            last = match &group.feed {
                Some((unit, value)) => match self.feed_of(unit, *value) {
                    Some(feed @ Feed::Minute(_)) => Some(self.per_minute(feed)?),
                    Some(feed) => Some(self.per_minute(feed)?),
                    None => None,
                },
                None => last,
            };
            of_groups.push(last);
        }
        spec.feed = of_groups.iter().copied().flatten().next();
        let depths: Vec<f64> = coded.groups.iter().flat_map(|group| group.depths.iter().copied()).collect();
        let steps: Vec<f64> = coded.groups.iter().flat_map(|group| group.steps.iter().copied()).collect();
        if kind == CycleKind::Thru {
            spec.depth = depths.last().copied();
            spec.webs = depths;
            return Ok(());
        }
        if depths.len() > 1 && !pecks {
            return fault(Code::PC034, "more than one depth", "keep one, or drill with DEEP or BRKCHP");
        }
        spec.depth = depths.last().copied();
        if depths.len() > 1 {
            if !steps.is_empty() {
                return fault(
                    Code::PC031,
                    "absolute depths and steps in one cycle",
                    "keep the depths, or one depth and STEP",
                );
            }
            if let Some(pair) = depths.windows(2).find(|pair| pair[1] <= pair[0]) {
                let message = format!("the depth {} comes after {}", pair[1], pair[0]);
                return fault(Code::PC004, message, "give absolute depths deeper one by one");
            }
            let with_feeds = coded.groups.iter().zip(&of_groups);
            spec.pecks =
                with_feeds.flat_map(|(group, feed)| group.depths.iter().map(|&to| Peck { to, feed: *feed })).collect();
            if spec.pecks.iter().any(|peck| peck.feed.is_none()) {
                return fault(Code::PC005, "the cycle has no feed", "give MMPM, IPM or another after its depths");
            }
            return Ok(());
        }
        match (steps.as_slice(), spec.depth) {
            ([], _) if spec.decr.is_some() && pecks => {
                fault(Code::PC030, "DECR without STEP", "give STEP, or take DECR out")
            }
            ([], _) => Ok(()),
            ([step], _) if feeds.len() <= 1 => {
                spec.step = Some(*step);
                if *step <= 0.0 { not_above_zero(*step) } else { Ok(()) }
            }
            (_, None) => fault(Code::PC002, "the cycle has no depth", "give DEPTH"),
            (_, Some(depth)) => {
                let mut list = Vec::new();
                for (group, feed) in coded.groups.iter().zip(&of_groups) {
                    list.extend(group.steps.iter().map(|&step| (step, *feed)));
                }
                spec.pecks = stepped_pecks(depth, &list, spec.decr.take(), spec.min_step.take())?;
                Ok(())
            }
        }
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

/// What CYCLE/ON says replaces what was coded.
fn over(mut last: Coded, said: Coded) -> Coded {
    for (option, numbers) in said.options {
        last.options.retain(|(found, _)| *found != option);
        last.options.push((option, numbers));
    }
    if said.groups.iter().any(|group| !group.depths.is_empty() || !group.steps.is_empty()) {
        let feed = last.groups.first().and_then(|group| group.feed.clone());
        last.groups = said.groups;
        if last.groups.iter().all(|group| group.feed.is_none())
            && let Some(group) = last.groups.first_mut()
        {
            group.feed = feed;
        }
    } else if let (Some(new), Some(group)) = (said.groups.first(), last.groups.first_mut()) {
        group.feed.clone_from(&new.feed);
        last.groups.iter_mut().skip(1).for_each(|group| group.feed = None);
    }
    last
}

/// The group that words go on with: another one once a feed has closed it.
fn group_for(groups: &mut Vec<Group>, taken: impl Fn(&Group) -> bool) -> &mut Group {
    let new = groups.last().is_none_or(|group| taken(group) || (group.feed.is_some() && !group.depths.is_empty()));
    if new {
        groups.push(Group::default());
    }
    let last = groups.len() - 1;
    &mut groups[last]
}

fn check_numbers(word: &str, numbers: &[f64], (least, most): (usize, usize), signed: bool) -> Done {
    if numbers.len() < least {
        return fault(Code::PC033, format!("{word} without its number"), format!("write {word},1"));
    }
    if numbers.len() > most {
        let message = format!("{} numbers after {word}", numbers.len());
        return fault(Code::PC034, message, format!("{word} takes at most {most}"));
    }
    match numbers.iter().find(|number| !signed && **number < 0.0) {
        Some(number) => fault(Code::PC035, format!("{word} of {number}"), "it can't be negative"),
        None => Ok(()),
    }
}

fn not_above_zero(step: f64) -> Done {
    Err(Box::<Diag>::from(Problem::new(Code::PC028, format!("a step of {step}"), "give a step above zero")))
}
