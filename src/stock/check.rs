//! Checks a program against its stock.

use std::collections::{BTreeMap, BTreeSet};
use std::io::{self, Read, Seek};

use super::centre::{Centre, Piece};
use super::field::{Field, cell_of};
use super::size::Stock;
use super::sweep::Shape;
use crate::diag::Code;
use crate::nc::{Action, Item, Position, Rotation, RunError, RunSettings, Simulator, Turn};
use crate::picture::round;
use crate::preflight::JobTool;
use crate::toolpath::{Side, Units};
use crate::verify::Finding;

/// Maximum number of findings. Further rapids through the stock are only counted.
const MOST_FINDINGS: usize = 100;
/// Greatest distance of a piece from the arc that it approximates, in millimetres.
const ERROR: f64 = 0.02;

/// The result of a check.
#[derive(Clone, Debug, Default)]
pub struct StockCheck {
    /// Rapids through the stock: one finding for each block, at most one hundred.
    pub findings: Vec<Finding>,
    /// Number of blocks with a rapid through the stock.
    pub blocks: usize,
    /// What was not checked, one sentence for each reason. Empty: every move was checked.
    pub not_checked: Vec<String>,
    /// Whether the program uses cutter compensation. The check assumes that the control compensates the whole radius of
    /// the tool.
    pub compensates: bool,
}

impl StockCheck {
    /// Whether every move was checked and no rapid goes through the stock.
    pub fn is_clean(&self) -> bool {
        self.blocks == 0 && self.not_checked.is_empty()
    }
}

/// Runs a program and finds rapids through the stock. `block` is the stock in millimetres, `tools` are the tools of the
/// job, `units` are the units of the messages.
///
/// # Errors
/// The program can't be read.
pub fn check_stock(
    program: impl Read + Seek,
    settings: RunSettings,
    block: &Stock,
    tools: &[JobTool],
    units: Units,
) -> io::Result<StockCheck> {
    let mut check = Check::new(block, tools, units);
    if settings.control.is_lathe() || settings.control.is_wire() {
        check.checked.not_checked.push("the stock: it is checked only on mills with three axes".into());
        return Ok(check.checked);
    }
    let mut run = Simulator::new(program, RunSettings { places_unknown: true, ..settings });
    for tool in tools {
        if let Some(name) = &tool.name {
            run.know_tool(name, f64::from(tool.number));
        }
    }
    check.work = run.state().work_number();
    let mut items = Vec::new();
    loop {
        items.clear();
        check.from = *run.state().position();
        let step = run.step(&mut items);
        check.block(&items, &run);
        match step {
            Ok(true) => {}
            Ok(false) => break,
            Err(RunError::Refused(diag, line)) => {
                check.missing(Missing::After(line, diag.message.clone()), line);
                break;
            }
            Err(RunError::Io(error)) => return Err(error),
        }
    }
    Ok(check.finish())
}

/// The reason why a move is not checked.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Missing {
    /// The tool with this number has no diameter.
    Diameter(u32),
    /// The tool with this number is thinner than the cells of the stock.
    Thin(u32),
    /// The tool in the spindle is unknown.
    Tool,
    /// A position below the top of the stock is unknown.
    Position,
    /// A rotary axis is not at zero.
    Rotary,
    /// The spindle is stopped at an angle: a boring bar may be moved away from the wall of its hole.
    Oriented,
    /// The control refuses a block, so the moves after the block are not checked: the line of the block, and the
    /// reason.
    After(u64, String),
}

/// The state of the check while the program runs. Lengths are in millimetres.
struct Check<'a> {
    stock: &'a Stock,
    tools: &'a [JobTool],
    units: Units,
    /// The stock in each work offset. The stock of an offset is added at the first move below the top of the stock.
    fields: BTreeMap<usize, Field>,
    /// Position of the tip in its work offset; NaN if unknown.
    at: [f64; 3],
    /// Position of the tip in program coordinates and the program's units.
    from: Position,
    tool: Option<u32>,
    side: Option<Side>,
    is_oriented: bool,
    /// Whether the tool may be below the top of the stock at an unknown height. The value is true after a change of the
    /// work offset while the tool is below the top.
    may_be_low: bool,
    centre: Centre,
    /// Number of the active work offset.
    work: usize,
    checked: StockCheck,
    /// What was not checked: the line of the first such move, and the number of moves.
    missing: BTreeMap<Missing, (u64, u64)>,
    /// Lines of the blocks with a finding.
    lines: BTreeSet<u64>,
}

/// The kind of a move.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Rapid,
    Cut,
}

impl<'a> Check<'a> {
    fn new(stock: &'a Stock, tools: &'a [JobTool], units: Units) -> Check<'a> {
        Check {
            stock,
            tools,
            units,
            fields: BTreeMap::new(),
            at: [f64::NAN; 3],
            from: Position::default(),
            // a program without tool changes is checked with the only tool of its job
            tool: match tools {
                [tool] => Some(tool.number),
                _ => None,
            },
            side: None,
            is_oriented: false,
            may_be_low: false,
            centre: Centre::default(),
            work: 0,
            checked: StockCheck::default(),
            missing: BTreeMap::new(),
            lines: BTreeSet::new(),
        }
    }

    fn block(&mut self, items: &[Item], run: &Simulator<'_>) {
        for item in items {
            let line = (item.line, run.text());
            match &item.action {
                Action::Rapid { to, machine, placed, .. } => {
                    // G28 and G53 lift the tool; without them, the tool may still be low after a change of the work offset
                    self.may_be_low &= placed & 0b100 == 0;
                    self.goes(Kind::Rapid, to, *machine, None, line, run);
                }
                Action::Feed { to, machine, .. } => self.goes(Kind::Cut, to, *machine, None, line, run),
                Action::Arc(turn) => self.goes(Kind::Cut, &turn.to, turn.machine, Some(turn), line, run),
                Action::Work(_) => {
                    self.may_be_low |= self.at[2] < self.stock.top;
                    self.breaks();
                    self.work = run.state().work_number();
                }
                Action::Tool(number) => {
                    let is_number = run.state().tool_name(*number).is_none();
                    self.tool = Some(*number as u32).filter(|number| *number != 0 && is_number);
                }
                Action::Orient(_) => self.is_oriented = true,
                Action::Spindle(rotation, _) if *rotation != Rotation::Stop => self.is_oriented = false,
                Action::Compensation(on) => {
                    self.side = on.map(|on| on.side);
                    self.checked.compensates |= on.is_some();
                }
                _ => {}
            }
        }
        // a changed frame or tool length changes the coordinates of the tip without a move
        self.at = in_stock(run.state().position(), run.state().at_machine(), run);
    }

    fn goes(
        &mut self,
        kind: Kind,
        to: &Position,
        machine: u8,
        arc: Option<&Turn>,
        line: (u64, &[u8]),
        run: &Simulator<'_>,
    ) {
        let from = std::mem::replace(&mut self.at, in_stock(to, machine, run));
        let program_from = std::mem::replace(&mut self.from, *to);
        let to_stock = self.at;
        // the points of an arc before its end
        let mut points = Vec::new();
        if let Some(turn) = arc {
            let ends = [&program_from, to].map(|at| [at[0], at[1], at[2]]);
            round(ends[0], ends[1], turn, ERROR / run.state().units().in_mm(), &mut |at| {
                points.push(in_stock(&[at[0], at[1], at[2], 0.0, 0.0, 0.0], 0, run));
            });
        }
        if to_stock[2].is_finite() {
            self.may_be_low = false;
        } else if self.may_be_low {
            return self.not_checked(Missing::Position, line.0);
        }
        // an unknown height counts as above the stock, because it is a position of the machine
        let heights = [from[2], to_stock[2]].into_iter().chain(points.iter().map(|at| at[2]));
        let low = heights.filter(|z| z.is_finite()).fold(f64::INFINITY, f64::min);
        if low >= self.stock.top {
            return self.breaks();
        }
        let sideways = from[0] != to_stock[0] || from[1] != to_stock[1];
        let unknown = [from, to_stock].iter().any(|at| !at[0].is_finite() || !at[1].is_finite())
            || !to_stock[2].is_finite() && sideways
            || !from[2].is_finite() && (sideways || kind == Kind::Cut);
        if program_from[3..].iter().chain(&to[3..]).any(|angle| *angle != 0.0) {
            return self.not_checked(Missing::Rotary, line.0);
        }
        if unknown {
            return self.not_checked(Missing::Position, line.0);
        }
        if !to_stock[2].is_finite() {
            return self.breaks();
        }
        let Some(shape) = self.shape(line.0) else { return self.breaks() };
        if self.is_oriented && kind == Kind::Rapid {
            return self.not_checked(Missing::Oriented, line.0);
        }
        // from an unknown height, the tool moves straight down
        let above = if from[2].is_finite() { from[2] } else { to_stock[2].max(self.stock.top) };
        let from = [from[0], from[1], above];
        let side = self.side.filter(|_| kind == Kind::Cut);
        let mut begin = from;
        let mut piece = |check: &mut Check<'_>, to: [f64; 3]| {
            let piece = Piece { from: std::mem::replace(&mut begin, to), to, shape, side };
            let ready = check.centre.takes(piece);
            ready.into_iter().flatten().enumerate().for_each(|(at, piece)| {
                // a piece that was waiting for the next one is a cut
                let kind = if at == 0 && piece.side.is_some() { Kind::Cut } else { kind };
                check.makes(kind, &piece, line);
            });
        };
        points.into_iter().for_each(|at| piece(self, at));
        piece(self, to_stock);
    }

    /// Handles a piece whose path is known: a cut removes material from the stock, a rapid is checked against the stock.
    fn makes(&mut self, kind: Kind, piece: &Piece, (line, block): (u64, &[u8])) {
        let field = self.fields.entry(self.work).or_insert_with(|| Field::new(self.stock));
        if kind == Kind::Cut {
            return field.cut(piece.shape, piece.from, piece.to);
        }
        let Some(hit) = field.hit(piece.shape, piece.from, piece.to) else { return };
        if !self.lines.insert(line) {
            // the block is run again, in a subprogram or in a loop
            if let Some(known) = self.checked.findings.iter_mut().find(|known| known.line == line) {
                known.times += 1;
            }
            return;
        }
        self.checked.blocks += 1;
        if self.checked.findings.len() == MOST_FINDINGS {
            return;
        }
        let tool = self.tool.map_or("the tool".to_owned(), |tool| format!("T{tool}"));
        let shown = |mm: f64| shown(mm, self.units);
        let message = format!(
            "{tool} goes through the stock at rapid: {} {} below its surface at X{} Y{}",
            shown(hit.depth),
            self.units.name(),
            shown(hit.at[0]),
            shown(hit.at[1]),
        );
        self.checked.findings.push(Finding {
            code: Code::PM003,
            message,
            help: "retract the tool above the stock, or move around it; or correct the size of the stock",
            place: None,
            line,
            block: String::from_utf8_lossy(block).trim().to_owned(),
            form: None,
            times: 1,
        });
    }

    /// The shape of the tool in the spindle. If the tool can't be checked, records the reason.
    fn shape(&mut self, line: u64) -> Option<Shape> {
        let Some(number) = self.tool else {
            self.missing(Missing::Tool, line);
            return None;
        };
        let tool = self.tools.iter().find(|tool| tool.number == number);
        let Some(diameter) = tool.and_then(|tool| tool.diameter).filter(|diameter| *diameter > 0.0) else {
            self.missing(Missing::Diameter(number), line);
            return None;
        };
        let radius = diameter / 2.0;
        let corner = tool.and_then(|tool| tool.corner_radius).unwrap_or(0.0).clamp(0.0, radius);
        let shape = Shape { radius, corner };
        if Field::is_too_thin(shape, cell_of(self.stock)) {
            self.missing(Missing::Thin(number), line);
        }
        Some(shape)
    }

    /// Records that a move was not checked.
    fn not_checked(&mut self, what: Missing, line: u64) {
        self.missing(what, line);
        self.breaks();
    }

    fn missing(&mut self, what: Missing, line: u64) {
        self.missing.entry(what).or_insert((line, 0)).1 += 1;
    }

    /// Ends the piece that waits for the next move, and cuts this piece, because the next move does not continue the
    /// path.
    fn breaks(&mut self) {
        if let Some(piece) = self.centre.ends(None) {
            self.makes(Kind::Cut, &piece, (0, b""));
        }
    }

    fn finish(mut self) -> StockCheck {
        for (what, (line, moves)) in std::mem::take(&mut self.missing) {
            let some = if moves == 1 { "1 move".to_owned() } else { format!("{moves} moves") };
            self.checked.not_checked.push(match what {
                Missing::Diameter(tool) => {
                    format!("{some} of T{tool} in the stock, from line {line} on: no operation of the job gives the diameter of this tool")
                }
                Missing::Thin(tool) => {
                    let cell = shown(cell_of(self.stock), self.units);
                    format!("rapids of T{tool}: its radius is not greater than a cell of the stock ({cell} {})", self.units.name())
                }
                Missing::Tool => {
                    format!("{some} in the stock, from line {line} on: the program does not name the tool in the spindle")
                }
                Missing::Position => {
                    format!("{some} at the height of the stock, from line {line} on: a position is known only at the machine")
                }
                Missing::Rotary => {
                    format!("{some} from line {line} on: a rotary axis is not at 0, and the stock is checked only in three axes")
                }
                Missing::Oriented => {
                    format!("{some} with the spindle stopped at an angle, from line {line} on: the tool may have an edge on one side only")
                }
                Missing::After(line, why) => format!("everything from line {line} on: {why}"),
            });
        }
        self.checked
    }
}

/// A position in its work offset, in millimetres. Axes whose position is known only in machine coordinates have the
/// value NaN.
fn in_stock(at: &Position, machine: u8, run: &Simulator<'_>) -> [f64; 3] {
    let scale = run.state().units().in_mm();
    let place = run.state().in_work_offset(at);
    std::array::from_fn(|axis| if machine & 1 << axis == 0 { place[axis] * scale } else { f64::NAN })
}

/// A length for messages.
fn shown(mm: f64, units: Units) -> String {
    let digits = if units == Units::Inch { 1e4 } else { 1e3 };
    format!("{}", (mm / units.in_mm() * digits).round() / digits + 0.0)
}
