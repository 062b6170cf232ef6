//! Finds the entry: the last line at which a program can safely begin, at or before the requested line.

use super::levels::Levels;
use super::{Asked, Refused, refuse};
use crate::control::Meaning;
use crate::nc::{Action, Kind, Rotation, RunError, RunSettings, Simulator, Standing, tokens};
use crate::source::text_of;
use crate::terminal::escaped;
use crate::toolpath::{Coolant, FeedMode, StopKind};

/// The requested location.
#[derive(Clone, Debug)]
pub enum Target {
    /// The first change to this tool.
    Tool(u32),
    /// The block with this number.
    Block(u64),
    /// A line of the program, from 1.
    Line(u64),
    /// The first comment that contains this text.
    Operation(String),
}

/// A line at which a program can begin.
#[derive(Clone, Debug)]
pub struct Entry {
    /// The line of the first block that is run.
    pub line: u64,
    /// The modal state before this line.
    pub standing: Standing,
    /// Further values that are active before this line.
    pub switches: Switches,
    pub said: Said,
    /// The height from which the tool moves down; `None`: the tool moves from the tool change position.
    pub height: Option<f64>,
    /// Rotary axes that the program has moved before this line, as bits.
    pub turned: u8,
    /// The depth to which the tool moves at feed from this height, if the program begins in the middle of a cut.
    pub depth: Option<f64>,
}

/// Values that a program has switched on and that are not part of the modal state.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Switches {
    /// The kinds of coolant that are on.
    pub coolant: Coolant,
    /// The register of the active tool length offset; negative if the length is subtracted.
    pub length: Option<f64>,
    /// The surface speed, and the limit of the spindle speed.
    pub surface: Option<f64>,
    pub limit: Option<f64>,
    /// Whether the program has selected a work offset.
    pub work: bool,
    /// The angle at which the spindle is stopped (M19).
    pub oriented: Option<f64>,
}

/// Whether the program has set these modes. Setting a mode that was already active also counts.
#[derive(Clone, Copy, Debug, Default)]
pub struct Said {
    pub units: bool,
    pub feed_mode: bool,
}

impl Switches {
    /// Updates these values after a block was run.
    pub fn follow(&mut self, action: &Action) {
        match action {
            Action::Coolant(Coolant::OFF) => self.coolant = Coolant::OFF,
            Action::Coolant(kind) => self.coolant = self.coolant.and(*kind),
            Action::Length(register) => self.length = *register,
            Action::SurfaceSpeed(limit) => self.surface = *limit,
            Action::SpeedLimit(limit) => self.limit = Some(*limit),
            Action::Work(_) => self.work = true,
            Action::Orient(angle) => self.oriented = Some(angle.unwrap_or(0.0)),
            Action::Spindle(..) | Action::Tool(_) => self.oriented = None,
            _ => {}
        }
    }
}

/// The result of the search in a program.
#[derive(Debug)]
pub struct Found {
    pub entry: Entry,
    /// The requested line.
    pub asked: u64,
    /// Number of lines in the head of the program. The head ends before the first block that moves an axis, starts the
    /// spindle or coolant, or changes a tool.
    pub head: u64,
    /// Codes between the head and the entry that are not part of the modal state, each with its line.
    pub codes: Vec<(u64, String)>,
}

/// Finds the entry for a target.
pub fn find(text: &[u8], settings: RunSettings, asked: &Asked) -> Result<Found, Refused> {
    let first = search(text, settings, asked, true);
    match asked.target {
        // the comment of the first operation may be in the head
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

/// Maximum number of lines in a note.
const MOST_LINES: usize = 10;
/// Maximum number of tools in a message.
const MOST_TOOLS: usize = 10;

struct Search<'t> {
    target: &'t Target,
    exactly: bool,
    said: Said,
    /// Whether comments in the head are ignored in the search for an operation.
    past_head: bool,
    switches: Switches,
    /// The last possible entry found so far that is not after the requested line.
    entry: Option<Entry>,
    /// The first possible entry after the requested line.
    next: Option<u64>,
    asked: Option<u64>,
    head: Option<u64>,
    codes: Vec<(u64, String)>,
    /// Number of codes before the entry.
    kept: usize,
    /// The reason why no entry after the head is possible.
    never: Option<String>,
    /// Rotary axes that the program has moved so far, as bits.
    turned: u8,
    /// Whether the last block was a move.
    moved: bool,
    levels: Levels,
    /// Whether the last move was a rapid.
    came_at_rapid: bool,
    /// Whether the tool length has changed since the last programmed Z position. After such a change, the height of the
    /// tool depends on the old and on the new length.
    height_by_other: bool,
    /// A possible entry at a T word whose tool change has not come yet. At this T word the tool is clear of the part.
    tool_line: Option<Entry>,
    /// The first tools of the program.
    tools: Vec<f64>,
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
            levels: Levels::default(),
            moved: false,
            turned: 0,
            came_at_rapid: false,
            height_by_other: false,
            tool_line: None,
            tools: Vec::new(),
        }
    }

    fn is_done(&self) -> bool {
        self.asked.is_some() && self.next.is_some()
    }

    fn block(&mut self, before: &Standing, depth: usize, items: &[crate::nc::Item], run: &Simulator<'_>) {
        let line = run.line();
        let is_asked = self.asked.is_none() && self.is_target(line, depth, items, run);
        let moves = |action: &Action| matches!(action, Action::Rapid { .. } | Action::Feed { .. } | Action::Arc(_));
        // on a control without a tool change code, the program stops for the change with the tool at machine zero
        let by_hand = run.control().first(Meaning::ToolChange).is_none() && !run.control().is_lathe();
        let stops = by_hand && before.said & 0b100 != 0;
        let changes = items.iter().any(|item| match item.action {
            Action::Tool(_) => true,
            Action::Stop(StopKind::Program) => stops,
            _ => false,
        });
        let switches = |action: &Action| match action {
            Action::Spindle(rotation, _) => *rotation != Rotation::Stop,
            Action::Coolant(kind) => *kind != Coolant::OFF,
            _ => false,
        };
        // the head ends before the first block that moves or starts something: such blocks must not run before the retract
        let begins = |item: &crate::nc::Item| moves(&item.action) || switches(&item.action);
        if self.head.is_none() && (changes || items.iter().any(begins)) {
            self.head = Some(line - 1);
        }
        // checks whether the program can begin before this block
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
            self.never.get_or_insert(format!("line {line} computes values from the blocks before"));
        }
        self.turned |= run.named_rotary();
        let [units, feed_mode] = run.says_modes();
        self.said.units |= units;
        self.said.feed_mode |= feed_mode;
        self.moved = items.iter().any(|item| moves(&item.action));
        let after = run.state().standing();
        if (before.work, before.units) != (after.work, after.units) {
            self.levels = Levels::default();
        }
        self.height_by_other |= items.iter().any(|item| matches!(item.action, Action::Length(_)));
        self.height_by_other &= !(self.moved && run.says_positions() & 0b100 != 0);
        let mut at = before.position;
        for item in items {
            if matches!(item.action, Action::Length(register) if register != self.switches.length) {
                self.levels = Levels::default();
            }
            self.switches.follow(&item.action);
            self.levels.follow(&item.action, &mut at);
            match &item.action {
                Action::Rapid { .. } => self.came_at_rapid = true,
                Action::Feed { .. } | Action::Arc(_) => self.came_at_rapid = false,
                Action::Tool(tool) => {
                    self.levels = Levels::default();
                    if self.tools.len() < MOST_TOOLS && !self.tools.contains(tool) {
                        self.tools.push(*tool);
                    }
                }
                Action::Stop(StopKind::Program) if stops => self.levels = Levels::default(),
                Action::LeftOut(code, meaning) if self.head.is_some() && *meaning != Meaning::ExactStop => {
                    self.codes.push((line, code.to_string()));
                }
                Action::Frame => {
                    self.never.get_or_insert(format!("line {line} moves the coordinate frame"));
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
            // a line of a subprogram may have a higher number, but does not come after the lines of the main program
            Target::Line(asked) => line == *asked || depth == 0 && line > *asked,
            Target::Block(number) => block_number(run.text()) == Some(*number),
            // comments in the header only list the operations
            Target::Operation(_) if self.past_head && self.head.is_none() => false,
            Target::Operation(name) => items.iter().any(|item| match item.action {
                Action::Comment(start, end) => {
                    let text = run.text().get(start..end).unwrap_or_default();
                    has_text(text, name)
                }
                _ => false,
            }),
        }
    }

    /// The entry before this block, if an entry is possible there. The block must change the tool, or the tool must be
    /// at the height of its rapids.
    fn entry_before(&mut self, before: &Standing, line: u64, changes: bool, run: &Simulator<'_>) -> Option<Entry> {
        let control = run.control();
        // the tool change stops the spindle at an angle of its own
        let is_oriented = self.switches.oriented.is_some() && !changes;
        let is_free = !before.compensated && !before.has_cycle && !before.is_shifted && !is_oriented;
        if self.moved {
            self.tool_line = None;
        }
        let entry = |height: Option<f64>| Entry {
            line,
            standing: *before,
            switches: self.switches.clone(),
            said: self.said,
            height,
            turned: self.turned,
            depth: None,
        };
        let names_tool = run.names_tool();
        if changes {
            // the entry is at the T word of the tool change, if this is in an earlier block
            let first = self.tool_line.take().filter(|_| !names_tool);
            return first.or_else(|| is_free.then(|| entry(None)));
        }
        if names_tool && is_free && !control.is_lathe() {
            self.tool_line = Some(entry(None));
        }
        let is_unknown = self.is_unknown(before);
        if control.is_lathe() || !is_free || !self.came_at_rapid || self.height_by_other || is_unknown {
            return None;
        }
        let height = before.position[2];
        let is_high = self.levels.across.is_none_or(|across| height >= across - 1e-9) && self.levels.is_clear(height);
        // without a motion code, a moving block would depend on the last motion of the old program
        let goes_on = before.is_rapid || run.names_motion() || !run.has_axes();
        (is_high && goes_on).then(|| entry(Some(height)))
    }

    /// Whether the position of an axis that the program moves is known only at the machine.
    fn is_unknown(&self, before: &Standing) -> bool {
        before.unknown & (0b111 | self.turned) != 0
    }

    /// The entry at the requested block itself. The tool goes to the height of its last rapid, and from this height at
    /// feed into the cut.
    fn exact_entry(&mut self, before: &Standing, line: u64, changes: bool, run: &Simulator<'_>) -> Option<Entry> {
        // a block at which the tool is clear needs no move down at feed
        let clear = self.entry_before(before, line, changes, run);
        if changes || clear.is_some() {
            return clear;
        }
        let depth = before.position[2];
        let height = self.levels.above(depth);
        let why = if run.control().is_lathe() {
            "on a lathe a restart begins at a turret change"
        } else if before.compensated {
            "cutter compensation is on in the block, but the program must begin before the move that turns it on"
        } else if before.has_cycle {
            "a canned cycle is active, and its words are in the blocks before"
        } else if self.switches.oriented.is_some() {
            "the spindle is stopped at an angle, and the code for this is in the blocks before"
        } else if before.is_shifted || self.height_by_other || self.is_unknown(before) {
            "the position of the tool at this block is unknown"
        } else if before.feed <= 0.0 || before.feed_mode == FeedMode::InverseTime {
            "no feed is active for the move down"
        } else if !(run.names_motion() || before.is_line || !run.has_axes()) {
            "the block depends on the G2, G3 or G0 of an earlier block"
        } else if height.is_none() {
            "the tool has made no rapid at a known height above its cuts, from which it could feed down"
        } else {
            let (standing, switches, said, turned) = (*before, self.switches.clone(), self.said, self.turned);
            return Some(Entry { line, standing, switches, said, height, turned, depth: Some(depth) });
        };
        self.never = Some(why.to_owned());
        None
    }

    fn finish(self) -> Result<Found, Refused> {
        let Some(asked) = self.asked else {
            let what = match self.target {
                Target::Tool(number) if self.tools.is_empty() => {
                    format!("the program has no tool change, so none to T{number}")
                }
                Target::Tool(number) => {
                    let tools: Vec<String> = self.tools.iter().map(|tool| format!("T{tool}")).collect();
                    format!("the program has no tool change to T{number}, only to {}", tools.join(", "))
                }
                Target::Block(number) => format!("the program has no block N{number} that is run"),
                Target::Line(line) => format!("no block is run at line {line} or after it"),
                Target::Operation(name) => format!("no comment of the program has `{}`", escaped(name)),
            };
            return refuse(what, "`postform simulate PROGRAM` shows the blocks that are run, with their lines");
        };
        let after = self.next.map_or("the program can't begin at a later line either".to_owned(), |line| {
            format!("the next possible line is {line}")
        });
        if self.exactly && self.entry.is_none() {
            let why = self.never.unwrap_or_else(|| "a restart can't begin with this block".into());
            let help = "leave --exactly out: then the program begins at the last earlier line where the tool is clear";
            return refuse(format!("the program can't begin exactly at line {asked}: {why}"), help);
        }
        let Some(entry) = self.entry else {
            let why = self.never.unwrap_or_else(|| {
                "before this line the tool is never by rapid at a known height above its cuts".into()
            });
            return refuse(format!("the program can't begin at or before line {asked}: {why}"), after);
        };
        let mut codes = self.codes;
        codes.truncate(self.kept);
        Ok(Found { entry, asked, head: self.head.unwrap_or(0), codes })
    }
}

/// A note about later lines with the same block number, or with the same text in a comment. `None`: there are none.
pub fn note_of_others(text: &[u8], target: &Target, asked: u64) -> Option<String> {
    let what = match target {
        Target::Block(number) => format!("N{number}"),
        Target::Operation(name) => format!("`{}`", escaped(name)),
        Target::Tool(_) | Target::Line(_) => return None,
    };
    let has_it = |line: &[u8]| match target {
        Target::Block(number) => block_number(line) == Some(*number),
        Target::Operation(name) => tokens(line).any(|token| {
            matches!(token.kind, Kind::Comment | Kind::Remark) && has_text(&line[token.start..token.end], name)
        }),
        Target::Tool(_) | Target::Line(_) => false,
    };
    let lines = text.split(|byte| *byte == b'\n').zip(1u64..).skip_while(|(_, line)| *line <= asked);
    let others: Vec<String> = lines.filter(|(line, _)| has_it(line)).map(|(_, line)| line.to_string()).collect();
    let (last, first) = others.split_last()?;
    let lines = match first {
        [] => format!("line {last}"),
        [.., _] if first.len() < MOST_LINES => format!("lines {} and {last}", first.join(", ")),
        _ => format!("lines {} and {} more", first[..MOST_LINES].join(", "), others.len() - MOST_LINES),
    };
    Some(format!("{what} of line {asked} is also in {lines}: to begin there, give --line"))
}

/// Whether a comment contains a text, in small or capital letters.
fn has_text(comment: &[u8], text: &str) -> bool {
    text_of(comment).to_lowercase().contains(&text.to_lowercase())
}

/// The N number of a block.
fn block_number(text: &[u8]) -> Option<u64> {
    let text = std::str::from_utf8(text).ok()?.trim_start();
    let text = text.strip_prefix('/').unwrap_or(text).trim_start();
    let digits = text.strip_prefix(['N', 'n'])?;
    let end = digits.find(|c: char| !c.is_ascii_digit()).unwrap_or(digits.len());
    digits.get(..end)?.parse().ok()
}

/// Whether a block assigns a value to a parameter.
fn computes(text: &[u8]) -> bool {
    let mut symbols =
        tokens(text).filter_map(|token| if let Kind::Symbol(symbol) = token.kind { Some(symbol) } else { None });
    symbols.any(|symbol| symbol == b'#') && symbols.any(|symbol| symbol == b'=')
}
