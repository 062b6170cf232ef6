//! Where a program can be begun: the last safe place before the one that is asked for.

use super::{Asked, Refused, refuse};
use crate::control::Meaning;
use crate::nc::{Action, Cooling, Kind, Rotation, RunError, RunSettings, Simulator, Standing, tokens};
use crate::terminal::escaped;
use crate::toolpath::{FeedMode, StopKind};

/// What is asked for.
#[derive(Clone, Debug)]
pub enum Target {
    /// The change to a tool, the first time.
    Tool(u32),
    /// The block with this number.
    Block(u64),
    /// A line of the program, from 1.
    Line(u64),
    /// The first comment that has this text.
    Operation(String),
}

/// A place where a program can be begun.
#[derive(Clone, Debug)]
pub struct Entry {
    /// Its line: the first block that is run.
    pub line: u64,
    /// What is in force before it.
    pub standing: Standing,
    /// What is on besides.
    pub switches: Switches,
    pub said: Said,
    /// The height from which the tool comes down; `None`: it comes from where tools are changed.
    pub height: Option<f64>,
    /// Where it goes down to from there at feed: into a cut that goes on.
    pub depth: Option<f64>,
}

/// What a run of a program has switched on, besides what its state says.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Switches {
    /// Coolant: flood, through the spindle, mist.
    pub flood: bool,
    pub mist: bool,
    pub through: bool,
    /// The register of the length that is on; negative where it is taken off.
    pub length: Option<f64>,
    /// Surface speed, with its limit.
    pub surface: Option<f64>,
    pub limit: Option<f64>,
    /// A work offset was named.
    pub work: bool,
}

/// What the program has said, be it what held before.
#[derive(Clone, Copy, Debug, Default)]
pub struct Said {
    pub units: bool,
    pub feed_mode: bool,
}

impl Switches {
    /// Follows what a block does.
    pub fn follow(&mut self, action: &Action, run: &Simulator<'_>) {
        match action {
            Action::Coolant(Cooling::Off) => (self.flood, self.mist, self.through) = (false, false, false),
            Action::Coolant(Cooling::Mist) => self.mist = true,
            Action::Coolant(Cooling::Flood) if run.cools_through() => self.through = true,
            Action::Coolant(Cooling::Flood) => self.flood = true,
            Action::Length(register) => self.length = *register,
            Action::SurfaceSpeed(limit) => self.surface = *limit,
            Action::SpeedLimit(limit) => self.limit = Some(*limit),
            Action::Work(_) => self.work = true,
            _ => {}
        }
    }
}

/// What was found of a program.
#[derive(Debug)]
pub struct Found {
    pub entry: Entry,
    /// The line that was asked for.
    pub asked: u64,
    /// The head: lines before the first one that moves or changes a tool.
    pub head: u64,
    /// Codes between head and entry that no state keeps: with their lines.
    pub codes: Vec<(u64, String)>,
}

/// Finds the entry for a target.
pub fn find(text: &[u8], settings: RunSettings, asked: &Asked) -> Result<Found, Refused> {
    let first = search(text, settings, asked, true);
    match asked.target {
        // that of the first operation may stand in the head
        Target::Operation(_) => first.or_else(|_| search(text, settings, asked, false)),
        _ => first,
    }
}

fn search(text: &[u8], settings: RunSettings, asked: &Asked, past_head: bool) -> Result<Found, Refused> {
    let mut search = Search::new(asked, past_head);
    let mut run = super::run(text, settings);
    let mut items = Vec::new();
    let mut standing = run.state().standing();
    let mut depth = 0;
    loop {
        items.clear();
        let more = match run.step(&mut items) {
            Ok(more) => more,
            Err(RunError::Io(error)) => return Err(error.into()),
            Err(RunError::Refused(diag, line)) => {
                return refuse(format!("line {line} is refused: {}", diag.message), diag.help.unwrap_or_default());
            }
        };
        search.block(&standing, depth, &items, &run);
        standing = run.state().standing();
        depth = run.depth();
        if !more || search.is_done() {
            break;
        }
    }
    search.finish()
}

struct Search<'t> {
    target: &'t Target,
    exactly: bool,
    said: Said,
    /// Only what comes after the head is an operation.
    past_head: bool,
    switches: Switches,
    /// The last place where the program can be begun, up to what is asked for.
    entry: Option<Entry>,
    /// The first after it.
    next: Option<u64>,
    asked: Option<u64>,
    head: Option<u64>,
    codes: Vec<(u64, String)>,
    /// Codes up to the entry.
    kept: usize,
    /// Why no place after the head can be one.
    never: Option<String>,
    /// The last block moved.
    moved: bool,
    /// The highest way across since the tool was changed.
    way: Option<f64>,
    /// The last move was a rapid.
    came_at_rapid: bool,
    /// Another length of a tool is on than that by which the height was said: where the tool is depends on both.
    height_by_other: bool,
    /// The line with the T word of a change that is not made yet, where the tool stands free.
    tool_line: Option<Entry>,
}

impl<'t> Search<'t> {
    fn new(asked: &'t Asked, past_head: bool) -> Search<'t> {
        Search {
            past_head,
            target: &asked.target,
            exactly: asked.exactly,
            said: Said::default(),
            switches: Switches::default(),
            entry: None,
            next: None,
            asked: None,
            head: None,
            codes: Vec::new(),
            kept: 0,
            never: None,
            way: None,
            moved: false,
            came_at_rapid: false,
            height_by_other: false,
            tool_line: None,
        }
    }

    fn is_done(&self) -> bool {
        self.asked.is_some() && self.next.is_some()
    }

    fn block(&mut self, before: &Standing, depth: usize, items: &[crate::nc::Item], run: &Simulator<'_>) {
        let line = run.line();
        let is_asked = self.asked.is_none() && self.is_target(line, depth, items, run);
        let moves = |action: &Action| matches!(action, Action::Rapid { .. } | Action::Feed { .. } | Action::Arc(_));
        // where no code changes tools the program stops for it, with the tool at the machine's zero
        let by_hand = run.control().first(Meaning::ToolChange).is_none() && !run.control().is_lathe();
        let stops = by_hand && before.said & 0b100 != 0;
        let changes = items.iter().any(|item| match item.action {
            Action::Tool(_) => true,
            Action::Stop(StopKind::Program) => stops,
            _ => false,
        });
        let switches = |action: &Action| match action {
            Action::Spindle(rotation, _) => *rotation != Rotation::Stop,
            Action::Coolant(cooling) => *cooling != Cooling::Off,
            _ => false,
        };
        // what moves or turns is not run again before the tool is out
        let begins = |item: &crate::nc::Item| moves(&item.action) || switches(&item.action);
        if self.head.is_none() && (changes || items.iter().any(begins)) {
            self.head = Some(line - 1);
        }
        // the place before this block
        if self.exactly {
            if is_asked && depth == 0 && self.never.is_none() {
                (self.entry, self.kept) = (self.exact_entry(before, line, changes, run), self.codes.len());
                self.next = Some(line);
            }
        } else if self.head.is_some() && depth == 0 && self.never.is_none() {
            let entry = self.entry_before(before, line, changes, run);
            if let Some(entry) = entry {
                if is_asked || self.asked.is_none_or(|asked| entry.line <= asked && line > asked) {
                    (self.entry, self.kept) = (Some(entry), self.codes.len());
                } else if self.next.is_none() {
                    self.next = Some(entry.line);
                }
            }
        }
        if is_asked {
            self.asked = Some(line);
        }
        if self.head.is_some() && computes(run.text()) {
            self.never
                .get_or_insert(format!("line {line} computes values, which are not known without the blocks before"));
        }
        let [units, feed_mode] = run.says_modes();
        self.said.units |= units;
        self.said.feed_mode |= feed_mode;
        self.moved = items.iter().any(|item| moves(&item.action));
        self.height_by_other |= items.iter().any(|item| matches!(item.action, Action::Length(_)));
        self.height_by_other &= !(self.moved && run.says_positions() & 0b100 != 0);
        for item in items {
            self.switches.follow(&item.action, run);
            match &item.action {
                Action::Rapid { to, .. } => {
                    let across = (0..2).any(|axis| (to[axis] - before.position[axis]).abs() > 1e-9);
                    if across {
                        self.way = Some(self.way.map_or(to[2], |way| way.max(to[2])));
                    }
                    self.came_at_rapid = true;
                }
                Action::Feed { .. } | Action::Arc(_) => self.came_at_rapid = false,
                Action::Tool(_) => self.way = None,
                Action::Stop(StopKind::Program) if stops => self.way = None,
                Action::LeftOut(code, meaning) if self.head.is_some() && *meaning != Meaning::ExactStop => {
                    self.codes.push((line, code.to_string()));
                }
                Action::Frame => {
                    self.never.get_or_insert(format!("line {line} moves the frame of the positions"));
                }
                _ => {}
            }
        }
    }

    fn is_target(&self, line: u64, depth: usize, items: &[crate::nc::Item], run: &Simulator<'_>) -> bool {
        match self.target {
            Target::Tool(number) => {
                // T0303 of a lathe is station 3
                let station = if run.control().is_lathe() && *number > 99 { number / 100 } else { *number };
                items.iter().any(|item| matches!(item.action, Action::Tool(tool) if tool == f64::from(station)))
            }
            // a line of a subprogram is not after those of the main program
            Target::Line(asked) => line == *asked || depth == 0 && line > *asked,
            Target::Block(number) => block_number(run.text()) == Some(*number),
            // the list of operations in a header is none
            Target::Operation(_) if self.past_head && self.head.is_none() => false,
            Target::Operation(name) => items.iter().any(|item| match item.action {
                Action::Comment(start, end) => {
                    let text = run.text().get(start..end).unwrap_or_default();
                    String::from_utf8_lossy(text).to_lowercase().contains(&name.to_lowercase())
                }
                _ => false,
            }),
        }
    }

    /// Can the program be begun with this block? It changes the tool, or the tool stands at the height of its ways.
    fn entry_before(&mut self, before: &Standing, line: u64, changes: bool, run: &Simulator<'_>) -> Option<Entry> {
        let control = run.control();
        let is_free = !before.compensated && !before.has_cycle && !before.is_shifted;
        if self.moved {
            self.tool_line = None;
        }
        let entry = |height: Option<f64>| Entry {
            line,
            standing: *before,
            switches: self.switches.clone(),
            said: self.said,
            height,
            depth: None,
        };
        let names_tool = run.names_tool();
        if changes {
            // from its T word on, where that stands in a block before
            let first = self.tool_line.take().filter(|_| !names_tool);
            return first.or_else(|| is_free.then(|| entry(None)));
        }
        if names_tool && is_free && !control.is_lathe() {
            self.tool_line = Some(entry(None));
        }
        if control.is_lathe() || !is_free || !self.came_at_rapid || self.height_by_other || before.unknown & 0b111 != 0
        {
            return None;
        }
        let height = before.position[2];
        let is_high = self.way.is_none_or(|way| height >= way - 1e-9);
        // a block that moves without its code would do what the old program's last move did
        let goes_on = before.is_rapid || run.names_motion() || !run.has_axes();
        (is_high && goes_on).then(|| entry(Some(height)))
    }

    /// The entry with the very block: down from the height of the ways, and at feed into the cut.
    fn exact_entry(&mut self, before: &Standing, line: u64, changes: bool, run: &Simulator<'_>) -> Option<Entry> {
        if changes {
            return self.entry_before(before, line, changes, run);
        }
        let why = if run.control().is_lathe() {
            "a lathe begins at a change of the turret"
        } else if before.compensated {
            "it is inside of cutter compensation, which begins with a move of its own"
        } else if before.has_cycle {
            "a canned cycle is in force, whose words stand in the blocks before"
        } else if before.is_shifted || self.height_by_other || before.unknown & 0b111 != 0 {
            "where the tool is there only the machine knows"
        } else if before.feed <= 0.0 || before.feed_mode == FeedMode::InverseTime {
            "no feed is in force with which it could go down"
        } else if !(run.names_motion() || before.is_line || !run.has_axes()) {
            "its block moves by the G2, G3 or G0 of a block before"
        } else {
            let depth = before.position[2];
            let height = self.way.filter(|way| *way >= depth).unwrap_or(depth);
            let (standing, switches, said) = (*before, self.switches.clone(), self.said);
            return Some(Entry { line, standing, switches, said, height: Some(height), depth: Some(depth) });
        };
        self.never = Some(why.to_owned());
        None
    }

    fn finish(self) -> Result<Found, Refused> {
        let Some(asked) = self.asked else {
            let what = match self.target {
                Target::Tool(number) => format!("the program never changes to T{number}"),
                Target::Block(number) => format!("the program has no block N{number} that is run"),
                Target::Line(line) => format!("no block is run at line {line} or after it"),
                Target::Operation(name) => format!("no comment of the program has `{}`", escaped(name)),
            };
            return refuse(what, "`postform simulate PROGRAM` shows what is run, with lines");
        };
        let after = self.next.map_or("none after it".to_owned(), |line| format!("line {line} is the next"));
        if self.exactly && self.entry.is_none() {
            let why = self.never.unwrap_or_else(|| "it can't be begun with this very block".into());
            let help = "leave --exactly out: then it begins at the last place before it where the tool is clear";
            return refuse(format!("the program can't be begun exactly at line {asked}: {why}"), help);
        }
        let Some(entry) = self.entry else {
            let why = self.never.unwrap_or_else(|| "the tool is nowhere at the height of its ways before it".into());
            return refuse(format!("the program can't be begun before line {asked}: {why}"), after);
        };
        let mut codes = self.codes;
        codes.truncate(self.kept);
        Ok(Found { entry, asked, head: self.head.unwrap_or(0), codes })
    }
}

/// N of a block.
fn block_number(text: &[u8]) -> Option<u64> {
    let text = std::str::from_utf8(text).ok()?.trim_start();
    let text = text.strip_prefix('/').unwrap_or(text).trim_start();
    let digits = text.strip_prefix(['N', 'n'])?;
    let end = digits.find(|c: char| !c.is_ascii_digit()).unwrap_or(digits.len());
    digits.get(..end)?.parse().ok()
}

/// Does a block give a parameter a value?
fn computes(text: &[u8]) -> bool {
    let mut symbols =
        tokens(text).filter_map(|token| if let Kind::Symbol(symbol) = token.kind { Some(symbol) } else { None });
    symbols.any(|symbol| symbol == b'#') && symbols.any(|symbol| symbol == b'=')
}
