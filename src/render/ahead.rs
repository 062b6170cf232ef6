//! Values that depend on the rest of the job: for the whole program, and for each tool, operation or work offset of a list.

use super::defaults::cycle_defaults;
use super::shape::Shape;
use super::turret::turret_word;
use super::want::Want;
use crate::compile::Program;
use crate::lang::{Each, Machine, VarId, work_code};
use crate::sema::Settings;
use crate::survey::{Survey, Terms, Totals};
use crate::times::Rates;
use crate::toolpath::{Tool, Units};

/// An item of a list: a row of the survey.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Item {
    pub each: Each,
    pub row: usize,
}

/// Variables of the program's extents: minimum and maximum of each axis, first for cuts only, then for all moves.
const REACH: [[(VarId, VarId); 3]; 2] = [
    [(VarId::Hmin, VarId::Hmax), (VarId::Vmin, VarId::Vmax), (VarId::Dmin, VarId::Dmax)],
    [(VarId::Rhmin, VarId::Rhmax), (VarId::Rvmin, VarId::Rvmax), (VarId::Rdmin, VarId::Rdmax)],
];

/// Whether this is a variable of the program's extents.
pub fn is_reach(var: VarId) -> bool {
    REACH.iter().flatten().any(|(least, most)| var == *least || var == *most)
}

/// The settings of a form that a survey needs. `only_order`: the survey records the order of the tools and nothing
/// else.
pub fn survey_terms(program: &Program, sink_as_printed: bool, only_order: bool, rates: Option<Rates>) -> Terms {
    let settings = &program.settings;
    let defaults = [Units::Inch, Units::Mm].map(|units| cycle_defaults(settings, units, units, sink_as_printed));
    Terms { defaults, work: default_work(settings), first_work: settings.work, only_order, rates }
}

/// The work offset of a job that names no work offset. The default code is converted if the form counts its offsets
/// from 1.
pub fn default_work(settings: &Settings) -> f64 {
    let default = settings.work_default;
    if default < 50.0 { default } else { work_code(settings.work, default).unwrap_or(default) }
}

/// Sets the variables that describe the whole program.
pub fn of_program(shape: &Shape, want: &mut Want) {
    let Some(survey) = &shape.options.survey else { return };
    if want.tool_order.is_none() {
        want.tool_order = Some(survey.changes.as_slice().into());
    }
    want.set(VarId::Toolcount, survey.tools.len() as f64);
    totals(&survey.whole, shape, want);
}

/// The rows of a list. A list inside another list has only the rows that belong to the outer item.
pub fn items(each: Each, outer: Option<Item>, survey: &Survey) -> Vec<Item> {
    let rows = match (each, outer) {
        (Each::Operation, Some(Item { each: Each::Tool, row })) => survey.tools[row].operations.clone(),
        (Each::Operation, Some(Item { each: Each::Work, row })) => survey.works[row].operations.clone(),
        (Each::Tool, _) => (0..survey.tools.len()).collect(),
        (Each::Operation, _) => (0..survey.operations.len()).collect(),
        (Each::Work, _) => (0..survey.works.len()).collect(),
    };
    rows.into_iter().map(|row| Item { each, row }).collect()
}

/// The sums of an item, or of the whole program.
pub fn sums(item: Option<Item>, survey: &Survey) -> &Totals {
    match item {
        Some(Item { each: Each::Tool, row }) => &survey.tools[row].totals,
        Some(Item { each: Each::Operation, row }) => &survey.operations[row].totals,
        Some(Item { each: Each::Work, row }) => &survey.works[row].totals,
        None => &survey.whole,
    }
}

/// The values of the job that apply while the lines of a list print for this item.
pub fn of_item(item: Item, survey: &Survey, shape: &Shape, want: &Want) -> Want {
    let mut want = want.clone();
    want.item = Some(item);
    match item.each {
        Each::Tool => {
            let used = &survey.tools[item.row];
            operation(used.first, survey, shape, &mut want);
            let number = |row: usize| survey.tools.get(row).map(|used| used.tool.number);
            place_in_order(item.row, survey.tools.len(), number, &mut want);
        }
        Each::Operation => {
            operation(item.row, survey, shape, &mut want);
            let number = |row: usize| survey.changes.get(row).copied();
            place_in_order(survey.operations[item.row].change, survey.changes.len(), number, &mut want);
        }
        Each::Work => {
            let used = &survey.works[item.row];
            want.set(VarId::Work, used.work);
        }
    }
    totals(sums(Some(item), survey), shape, &mut want);
    want
}

/// Sets the values of an operation and of its tool.
fn operation(row: usize, survey: &Survey, shape: &Shape, want: &mut Want) {
    let operation = &survey.operations[row];
    let mut begins = operation.begins.clone();
    if let Some(used) = operation.tool.map(|tool| &survey.tools[tool]) {
        tool_variables(&used.tool, shape, want);
        begins.tool = Some(used.tool.clone());
    }
    want.texts.operation(&begins, shape);
    want.clear_spindle(shape);
    want.put_spindle(&operation.spindle, shape);
    want.put(VarId::Frate, begins.feed.map(|feed| feed * shape.scale));
    want.put(VarId::Plunge, begins.plunge.or(begins.feed).map(|feed| feed * shape.scale));
    want.set(VarId::Work, operation.totals.works.first().map_or(operation.work, |work| f64::from_bits(*work)));
}

/// Sets whether the tool is the first or the last tool, and sets the previous and the next tool. After the last tool,
/// the next tool is the first tool.
fn place_in_order(at: usize, count: usize, number: impl Fn(usize) -> Option<f64>, want: &mut Want) {
    want.set(VarId::Isfirsttool, f64::from(u8::from(at == 0)));
    want.set(VarId::Islasttool, f64::from(u8::from(at + 1 == count)));
    want.put(VarId::Nexttool, number(at + 1).or_else(|| number(0)));
    want.put(VarId::Lasttool, at.checked_sub(1).and_then(number));
}

/// Sets the variables of a tool.
pub fn tool_variables(tool: &Tool, shape: &Shape, want: &mut Want) {
    let settings = &shape.program.settings;
    want.set(VarId::Tool, tool.number);
    want.properties.tool(settings, &tool.data);
    want.put(VarId::Toold, tool.diameter.map(|diameter| diameter * shape.scale));
    want.set(VarId::Lcomp, tool.length_offset.unwrap_or(tool.number + settings.lcomp));
    want.set(VarId::Dcomp, tool.diameter_offset.unwrap_or(tool.number + settings.dcomp));
    want.put(VarId::Turret, tool.turret);
    if settings.machine == Machine::Lathe {
        // the tool change reports a T word without a valid value
        want.put(VarId::Comp, turret_word(tool, shape).ok());
    }
}

/// Sets sums and extents. Extents have values only if all positions are in one frame.
fn totals(sums: &Totals, shape: &Shape, want: &mut Want) {
    const SECONDS: f64 = 60.0;
    want.set(VarId::Opcount, sums.operations as f64);
    want.set(VarId::Holecount, sums.holes as f64);
    want.put(VarId::Cuttime, sums.minutes().map(|minutes| minutes * SECONDS));
    want.set(VarId::Cutlength, sums.length * shape.scale);
    for (vars, reach) in REACH.iter().zip([&sums.cuts, &sums.moves]) {
        for (axis, (least, most)) in vars.iter().enumerate() {
            let both = reach.0[axis].filter(|_| sums.in_one_frame()).map(|(from, to)| {
                let scale = shape.scale * shape.scales[axis];
                let (from, to) = (from * scale, to * scale);
                (from.min(to), from.max(to))
            });
            want.put(*least, both.map(|(least, _)| least));
            want.put(*most, both.map(|(_, most)| most));
        }
    }
}
