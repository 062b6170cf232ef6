//! Where a program can be begun: the last safe place before the one that is asked for.

use super::{Refused, refuse};
use crate::control::Meaning;
use crate::nc::{Action, Cooling, Kind, RunError, RunSettings, Simulator, Standing, tokens};
use crate::terminal::escaped;

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
    /// The height from which the tool comes down; `None`: it comes from where tools are changed.
    pub height: Option<f64>,
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
pub fn find(text: &[u8], settings: RunSettings, target: &Target) -> Result<Found, Refused> {
    let mut search = Search::new(target);
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
    search.finish(target)
}

struct Search<'t> {
    target: &'t Target,
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
    /// The highest way across since the tool was changed.
    way: Option<f64>,
    /// The last move was a rapid.
    came_at_rapid: bool,
    /// The line with the T word of a change that is not made yet, where the tool stands free.
    tool_line: Option<Entry>,
}

impl<'t> Search<'t> {
    fn new(target: &'t Target) -> Search<'t> {
        Search {
            target,
            switches: Switches::default(),
            entry: None,
            next: None,
            asked: None,
            head: None,
            codes: Vec::new(),
            kept: 0,
            never: None,
            way: None,
            came_at_rapid: false,
            tool_line: None,
        }
    }

    fn is_done(&self) -> bool {
        self.asked.is_some() && self.next.is_some()
    }

    fn block(&mut self, before: &Standing, depth: usize, items: &[crate::nc::Item], run: &Simulator<'_>) {
        let line = run.line();
        let is_asked = self.asked.is_none() && self.is_target(line, items, run);
        let moves = |action: &Action| matches!(action, Action::Rapid { .. } | Action::Feed { .. } | Action::Arc(_));
        let changes = items.iter().any(|item| matches!(item.action, Action::Tool(_)));
        if self.head.is_none() && (changes || items.iter().any(|item| moves(&item.action))) {
            self.head = Some(line - 1);
        }
        // the place before this block
        if self.head.is_some() && depth == 0 && self.never.is_none() {
            let entry = self.entry_before(before, line, changes, run);
            if let Some(entry) = entry {
                if self.asked.is_none() || is_asked {
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

    fn is_target(&self, line: u64, items: &[crate::nc::Item], run: &Simulator<'_>) -> bool {
        match self.target {
            Target::Tool(number) => {
                items.iter().any(|item| matches!(item.action, Action::Tool(tool) if tool == f64::from(*number)))
            }
            Target::Line(asked) => line >= *asked,
            Target::Block(number) => block_number(run.text()) == Some(*number),
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
        let entry = |height: Option<f64>| Entry { line, standing: *before, switches: self.switches.clone(), height };
        let names_tool = run.names_tool();
        if changes {
            // from its T word on, where that stands in a block before
            let first = self.tool_line.take().filter(|_| !names_tool);
            return first.or_else(|| is_free.then(|| entry(None)));
        }
        if names_tool && is_free && !control.is_lathe() {
            self.tool_line = Some(entry(None));
        }
        if control.is_lathe() || !is_free || !self.came_at_rapid || before.unknown & 0b111 != 0 {
            return None;
        }
        let height = before.position[2];
        let is_high = self.way.is_none_or(|way| height >= way - 1e-9);
        // a block that moves without its code would do what the old program's last move did
        let goes_on = before.is_rapid || run.names_motion() || !run.has_axes();
        (is_high && goes_on).then(|| entry(Some(height)))
    }

    fn finish(self, target: &Target) -> Result<Found, Refused> {
        let Some(asked) = self.asked else {
            let what = match target {
                Target::Tool(number) => format!("the program never changes to T{number}"),
                Target::Block(number) => format!("the program has no block N{number} that is run"),
                Target::Line(line) => format!("no block is run at line {line} or after it"),
                Target::Operation(name) => format!("no comment of the program has `{}`", escaped(name)),
            };
            return refuse(what, "`postform simulate PROGRAM` shows what is run, with lines");
        };
        let after = self.next.map_or("none after it".to_owned(), |line| format!("line {line} is the next"));
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
