//! Reads machine files (TOML). A wrong value is an error with its line and column. The message also names the check that is
//! not made without this value.

use std::collections::BTreeMap;

use toml::{Spanned, Value};

use super::axis::{Axis, Travel};
use super::file_text::{AxisText, Counts, File, FixtureText, RotaryText, ToolText, UnitsText};
use super::fixture::Fixture;
use super::tool_table::{self, Entry, ToolTable};
use super::{Corners, LETTERS, Machine, Rotary, offsets};
use crate::control::{self, Control, Wrong};
use crate::suggest::did_you_mean_one_of;
use crate::toolpath::Units;

/// A function that reads a file which the machine file names. The function returns the text, or the reason why the file
/// can't be read. Names are relative to the folder of the machine file.
pub type Beside<'a> = dyn Fn(&str) -> Result<String, String> + 'a;

/// Reads the text of a machine file.
///
/// # Errors
/// The first error, with its line and column.
pub fn read(name: &str, text: &str, beside: &Beside<'_>) -> Result<Machine, Wrong> {
    let reader = Reader { name, text };
    let file: File = toml::from_str(text).map_err(|error| {
        let at = error.span().map_or(0, |span| span.start);
        reader.wrong(at, error.message().to_owned(), "")
    })?;
    let units = match file.units {
        Some(UnitsText::Inch) => Units::Inch,
        Some(UnitsText::Mm) | None => Units::Mm,
    };
    let scale = units.in_mm();
    let control = file.control.as_ref().map(|control| reader.control(control, beside)).transpose()?;
    let by_diameter = control.is_some_and(Control::is_lathe);
    let lengths = Lengths { reader: &reader, scale, by_diameter };
    let mut machine = Machine {
        name: file.name.clone().unwrap_or_else(|| name.to_owned()),
        control,
        units,
        by_diameter,
        axes: lengths.axes(&file.axes)?,
        rotary: file.rotary.as_ref().map(|rotary| lengths.rotary(rotary)).transpose()?,
        bytes: file.memory.bytes,
        coolant: file.coolant.kinds.clone(),
        ..Machine::default()
    };
    for (point, said) in [&file.reference.first, &file.reference.second].into_iter().enumerate() {
        machine.references[point] = match said {
            Some(said) => Some(lengths.reference(said, &machine.axes, point)?),
            None => None,
        };
    }
    let positive = |value: &Option<Spanned<f64>>, what: &str| reader.positive(value.as_ref(), what);
    if let Some(speed) = &file.spindle.speed {
        let [least, most] = *speed.get_ref();
        if !(least >= 0.0 && least <= most && most.is_finite()) {
            let help = "write the lowest and the highest speed, as [30, 8100]; without speeds nothing is checked";
            return Err(reader.wrong(speed.span().start, "speed needs two numbers from 0 in ascending order", help));
        }
        machine.speeds = Some([least, most]);
    }
    let ahead = file.corners.ahead.as_ref();
    if let Some(zero) = ahead.filter(|blocks| *blocks.get_ref() == 0) {
        let help = "write how many blocks the control plans ahead, as 15";
        return Err(reader.wrong(zero.span().start, "the number of planned blocks must be 1 or more", help));
    }
    machine.corners = Corners {
        deviation: positive(&file.corners.deviation, "the deviation at corners")?.map(|deviation| deviation * scale),
        ahead: ahead.map(|blocks| *blocks.get_ref() as usize),
    };
    machine.spin_up = positive(&file.spindle.acceleration, "the time to the highest speed")?;
    if let Some(numbers) = &file.memory.numbers {
        let [least, most] = *numbers.get_ref();
        if least > most {
            let help = "write the lowest and the highest number, as [1, 9999]; without them nothing is checked";
            return Err(reader.wrong(
                numbers.span().start,
                "numbers needs two program numbers in ascending order",
                help,
            ));
        }
        machine.numbers = Some([least, most]);
    }
    if let Some(tools) = &file.tools {
        lengths.tools(tools, beside, &mut machine)?;
    }
    let control = control.unwrap_or_else(Control::usual);
    if let Some(said) = &file.offsets {
        let mut offsets = BTreeMap::new();
        for (key, at) in said {
            let number = reader.offset(control, key)?;
            offsets.insert(number, lengths.offset(at)?);
        }
        machine.offsets = Some(offsets);
    }
    machine.fixtures =
        file.fixtures.iter().map(|fixture| lengths.fixture(fixture, control)).collect::<Result<_, _>>()?;
    Ok(machine)
}

struct Reader<'t> {
    name: &'t str,
    text: &'t str,
}

impl Reader<'_> {
    fn wrong(&self, at: usize, message: impl Into<String>, help: impl Into<String>) -> Wrong {
        Wrong::at(self.name, self.text, at, message, help)
    }

    fn control(&self, said: &Spanned<String>, beside: &Beside<'_>) -> Result<&'static Control, Wrong> {
        let name = said.get_ref();
        if control::is_file(name) {
            let text = beside(name).map_err(|why| self.wrong(said.span().start, why, ""))?;
            return Control::own(name, &text);
        }
        Control::named(&name.to_ascii_lowercase()).ok_or_else(|| {
            let help = did_you_mean_one_of(name, control::names());
            self.wrong(said.span().start, format!("there is no control `{name}`"), format!("{help}, or a control file"))
        })
    }

    fn positive(&self, value: Option<&Spanned<f64>>, what: &str) -> Result<Option<f64>, Wrong> {
        match value {
            Some(value) if !(value.get_ref().is_finite() && *value.get_ref() > 0.0) => {
                let help = format!("write a number above 0; without it {what} is not checked");
                Err(self.wrong(value.span().start, format!("{what} must be a number above 0"), help))
            }
            value => Ok(value.map(|value| *value.get_ref())),
        }
    }

    fn offset(&self, control: &Control, key: &Spanned<String>) -> Result<usize, Wrong> {
        offsets::number(control, key.get_ref()).ok_or_else(|| {
            let message = format!("`{}` is not a work offset of {}", key.get_ref(), control.name());
            let help = format!("write {}, {} and so on", offsets::name(control, 1), offsets::name(control, 10));
            self.wrong(key.span().start, message, help)
        })
    }
}

/// Reads lengths that are in the file's units.
struct Lengths<'r> {
    reader: &'r Reader<'r>,
    scale: f64,
    /// Whether lengths along X are diameters.
    by_diameter: bool,
}

impl Lengths<'_> {
    fn factor(&self, axis: usize) -> f64 {
        match axis {
            0 if self.by_diameter => self.scale / 2.0,
            0..3 => self.scale,
            _ => 1.0,
        }
    }

    fn axes(&self, said: &BTreeMap<Spanned<String>, AxisText>) -> Result<[Option<Axis>; 6], Wrong> {
        let mut axes: [Option<Axis>; 6] = Default::default();
        for (name, text) in said {
            let at = LETTERS.iter().position(|letter| name.get_ref().eq_ignore_ascii_case(&letter.to_string()));
            let Some(at) = at else {
                let message = format!("`{}` is not an axis", name.get_ref());
                return Err(self.reader.wrong(name.span().start, message, "an axis is X, Y, Z, A, B or C"));
            };
            axes[at] = Some(self.axis(at, text)?);
        }
        Ok(axes)
    }

    fn axis(&self, at: usize, text: &AxisText) -> Result<Axis, Wrong> {
        let letter = LETTERS[at];
        let positive = |value: &Option<Spanned<f64>>, what: &str| -> Result<Option<f64>, Wrong> {
            let value = self.reader.positive(value.as_ref(), &format!("the {what} of {letter}"))?;
            Ok(value.map(|value| value * self.factor(at)))
        };
        if let Some(turns) = text.turns.as_ref().filter(|_| at < 3) {
            return Err(self.reader.wrong(turns.span().start, format!("{letter} is not a rotary axis"), "take it out"));
        }
        if let Some(about) = text.about.as_ref()
            && !(about.get_ref().iter().all(|value| value.is_finite()) && about.get_ref().iter().any(|v| *v != 0.0))
        {
            let help = "write the direction of the rotary axis, as [0, 0, 1]";
            return Err(self.reader.wrong(about.span().start, "`about` must be a direction", help));
        }
        let said = Axis {
            travel: text.travel.as_ref().map(|travel| self.travel(at, travel)).transpose()?,
            rapid: positive(&text.rapid, "rapid")?,
            feed: positive(&text.feed, "feed")?,
            acceleration: positive(&text.acceleration, "acceleration")?,
            kind: text.turns.as_ref().map(|turns| *turns.get_ref()),
            about: text.about.as_ref().map(|about| *about.get_ref()),
            counts_table: text.counts == Some(Counts::Table),
        };
        if let (Some(rapid), Some(feed), Some(place)) = (said.rapid, said.feed, &text.rapid)
            && rapid < feed
        {
            let message = format!("the rapid of {letter} is slower than its fastest feed");
            return Err(self.reader.wrong(place.span().start, message, "both are per minute: 25 m/min is 25000"));
        }
        Ok(said)
    }

    fn travel(&self, at: usize, said: &Spanned<Value>) -> Result<Travel, Wrong> {
        let letter = LETTERS[at];
        let wrong = |message: String| {
            let form = if at < 3 { "[-762, 0]" } else { "[-120, 30], or \"endless\"" };
            let help = format!(
                "write its limits in machine coordinates, as {form}; without them the travel of {letter} is not \
                 checked"
            );
            self.reader.wrong(said.span().start, message, help)
        };
        match said.get_ref() {
            Value::String(text) if text == "endless" && at >= 3 => Ok(Travel::Endless),
            Value::Array(ends) => {
                let ends: Vec<f64> = ends.iter().filter_map(number).collect();
                match ends.as_slice() {
                    [least, greatest] if least < greatest => {
                        Ok(Travel::Between(least * self.factor(at), greatest * self.factor(at)))
                    }
                    [least, greatest] => Err(wrong(format!("the travel of {letter} goes from {least} to {greatest}"))),
                    _ => Err(wrong(format!("the travel of {letter} must be two numbers"))),
                }
            }
            _ => Err(wrong(format!("the travel of {letter} must be two numbers"))),
        }
    }

    fn rotary(&self, said: &RotaryText) -> Result<Rotary, Wrong> {
        let mut rotary = Rotary { tip_control: said.tip_control, ..Rotary::default() };
        for name in &said.order {
            match name.get_ref().as_str() {
                "A" | "B" | "C" => rotary.order.extend(name.get_ref().chars()),
                other => {
                    let message = format!("`{other}` is not a rotary axis");
                    return Err(self.reader.wrong(name.span().start, message, "a rotary axis is A, B or C"));
                }
            }
        }
        if let Some(centre) = &said.centre {
            rotary.centre = self.finite(centre, |centre| *centre)?.map(|value| value * self.scale);
        }
        Ok(rotary)
    }

    fn finite<T, const N: usize>(&self, said: &Spanned<T>, values: impl Fn(&T) -> [f64; N]) -> Result<[f64; N], Wrong> {
        let values = values(said.get_ref());
        if values.iter().all(|value| value.is_finite()) {
            return Ok(values);
        }
        Err(self.reader.wrong(
            said.span().start,
            "a position must be a list of numbers",
            "write a position as [0, -100, 0]",
        ))
    }

    /// Reads the positions of the axes, in their order. Positions that are not given are unknown.
    fn list(&self, said: &Spanned<Vec<f64>>) -> Result<[Option<f64>; 6], Wrong> {
        let values = said.get_ref();
        if values.is_empty() || values.len() > 6 || values.iter().any(|value| !value.is_finite()) {
            let help = "write X, Y, Z and any of A, B, C: [-400, -210, -350]";
            return Err(self.reader.wrong(said.span().start, "a position has at most six numbers", help));
        }
        Ok(std::array::from_fn(|axis| values.get(axis).map(|value| value * self.factor(axis))))
    }

    fn offset(&self, said: &Spanned<Vec<f64>>) -> Result<[Option<f64>; 6], Wrong> {
        self.list(said)
    }

    fn reference(&self, said: &Spanned<Vec<f64>>, axes: &[Option<Axis>; 6], point: usize) -> Result<[f64; 6], Wrong> {
        let given = self.list(said)?;
        let to = given.map(|value| value.unwrap_or(0.0));
        for (axis, value) in to.iter().enumerate().filter(|(axis, _)| given[*axis].is_some()) {
            let limits = axes[axis].as_ref().and_then(Axis::limits);
            if let Some([least, greatest]) = limits.filter(|[least, greatest]| !(*least..=*greatest).contains(value)) {
                let factor = self.factor(axis);
                let message = format!(
                    "{} goes to {}{}, but the travel is {} to {}",
                    if point == 0 { "G28" } else { "G30" },
                    LETTERS[axis],
                    value / factor,
                    least / factor,
                    greatest / factor,
                );
                let help = "write both in machine coordinates";
                return Err(self.reader.wrong(said.span().start, message, help));
            }
        }
        Ok(to)
    }

    fn tools(
        &self,
        said: &BTreeMap<Spanned<String>, Spanned<Value>>,
        beside: &Beside<'_>,
        machine: &mut Machine,
    ) -> Result<(), Wrong> {
        let (mut table, mut listed) = (ToolTable::default(), false);
        let wrong = |at: usize, message: String, help: &str| self.reader.wrong(at, message, help);
        for (key, value) in said {
            let start = value.span().start;
            match (key.get_ref().as_str(), value.get_ref()) {
                ("places", Value::Integer(count)) if (1..=100_000).contains(count) => {
                    machine.places = Some(*count as u32);
                }
                ("places", _) => {
                    return Err(wrong(
                        start,
                        "places must be the number of tools in the magazine".into(),
                        "write places = 20; without it the number of tools is not checked",
                    ));
                }
                ("change", value) => {
                    machine.change = Some(number(value).filter(|seconds| *seconds >= 0.0).ok_or_else(|| {
                        wrong(start, "change must be the seconds of a tool change".into(), "write change = 4.2")
                    })?);
                }
                ("file", Value::String(name)) => {
                    let text =
                        beside(name).map_err(|why| wrong(start, why, "the path is relative to the machine's file"))?;
                    let read = tool_table::read(&text, self.scale).map_err(|(line, message)| {
                        let message = format!("{name}:{line}: {message}");
                        wrong(start, message, "a table is a tool.tbl of LinuxCNC, a CSV file, or a list of G10 blocks")
                    })?;
                    // values in the machine file have priority over those in the tool table
                    for (number, entry) in read.0 {
                        table.0.entry(number).or_insert(entry);
                    }
                    listed = true;
                }
                (text, value) if text.parse::<u32>().is_ok() => {
                    let number = text.parse::<u32>().unwrap_or_default();
                    let tool: ToolText = value.clone().try_into().map_err(|error: toml::de::Error| {
                        wrong(start, error.message().to_owned(), "a tool has length, diameter and name")
                    })?;
                    let sizes = [tool.length, tool.diameter];
                    if sizes.iter().flatten().any(|size| !size.is_finite()) || tool.diameter.is_some_and(|d| d < 0.0) {
                        return Err(wrong(
                            start,
                            format!("T{number}: this is not a length, a diameter or a name"),
                            "write numbers",
                        ));
                    }
                    let [length, diameter] = sizes.map(|size| size.map(|size| size * self.scale));
                    table.0.insert(number, Entry { length, diameter, name: tool.name, ..Entry::default() });
                    listed = true;
                }
                (other, _) => {
                    let message = format!("[tools] has no key `{}`", other.escape_default());
                    let help = "its keys are places, change and file, and tools by number: [tools.5]";
                    return Err(wrong(key.span().start, message, help));
                }
            }
        }
        machine.tools = listed.then_some(table);
        Ok(())
    }

    fn fixture(&self, said: &FixtureText, control: &Control) -> Result<Fixture, Wrong> {
        let work = self.reader.offset(control, &said.work)?;
        let corners = said.corners.get_ref();
        let [least, greatest] = [0, 1].map(|at| corners[at].map(|value| value * self.scale));
        if !(0..3).all(|axis| least[axis] < greatest[axis] && greatest[axis].is_finite() && least[axis].is_finite()) {
            let help = "write its smallest X, Y, Z, then its largest: [[-20, -20, -40], [0, 120, 15]]";
            return Err(self.reader.wrong(
                said.corners.span().start,
                "the second corner of a box must be larger than the first",
                help,
            ));
        }
        Ok(Fixture { name: said.name.clone(), work, least, greatest })
    }
}

/// Reads a finite number, with or without a decimal point.
fn number(value: &Value) -> Option<f64> {
    match value {
        Value::Integer(number) => Some(*number as f64),
        Value::Float(number) => Some(*number).filter(|number| number.is_finite()),
        _ => None,
    }
}
