//! Explanations of commands, variables, sequences and kinds of cycles.

use super::examples::{self, Example};
use crate::lang::{
    Args, Command, CommandId, DirectiveRow, Machine, Machines, Origin, SequenceId, Standing, TextId, Unit, UnitChoice,
    VarId,
};
use crate::toolpath::CycleKind;

/// A kind of cycle, as jobs name it.
pub struct CycleRow {
    /// Name of the kind in jobs.
    pub name: &'static str,
    /// The motion of the tool.
    pub meaning: &'static str,
}

macro_rules! cycles {
    ($($name:literal $meaning:literal)*) => {
        /// All kinds of cycles.
        pub const CYCLES: &[CycleRow] = &[$(CycleRow { name: $name, meaning: $meaning }),*];
    };
}

#[rustfmt::skip]
cycles! {
    "drill"     "feed to the bottom, rapid out"
    "face"      "feed to the bottom, dwell, rapid out"
    "tap"       "feed to the bottom, reverse the spindle, feed out"
    "ltap"      "as tap, with a left-hand thread"
    "bore"      "feed to the bottom, stop the spindle, rapid out"
    "back"      "down off the axis of the hole with the spindle oriented, across to the axis, feed up"
    "ream"      "feed in, feed out"
    "deep"      "pecks, with a full retract after each peck"
    "chipbreak" "pecks, with a short retract after each peck"
    "thru"      "feed through several webs, one after the other"
    "csink"     "feed to the depth that follows from a diameter and an angle"
    "manual"    "stop above the point, for work by hand"
    "custom1"   "the moves of the form's Custom1"
    "custom2"   "the moves of the form's Custom2"
    "custom3"   "the moves of the form's Custom3"
}

/// The source of a meaning, in words.
pub fn standing(standing: Standing) -> &'static str {
    match standing {
        Standing::Doc => "stated in the manual",
        Standing::Ex => "the only interpretation that reproduces the manual's examples",
        Standing::Ours => "our decision, because no public source defines it",
    }
}

/// The source of a meaning in one word, for tables.
pub fn source(standing: Standing) -> &'static str {
    match standing {
        Standing::Doc => "manual",
        Standing::Ex => "example",
        Standing::Ours => "ours",
    }
}

/// The arguments of a command, in words.
pub fn takes(args: Args) -> String {
    let range = |least: u8, most: u8, one: &str, many: &str| match (least, most) {
        (1, 1) => format!("one {one}"),
        (least, most) if least == most => format!("{least} {many}"),
        (least, most) => format!("{least} to {most} {many}"),
    };
    match args {
        Args::Text => "text, to the end of the line".into(),
        Args::Switch => "Y or N".into(),
        Args::Codes(_, least, most) | Args::Motion(least, most) => range(least, most, "code", "codes"),
        Args::Letters(least, most) => range(least, most, "letter", "letters"),
        Args::Whole(least, most) => range(least, most, "whole number", "whole numbers"),
        Args::Number => "one number".into(),
        Args::Length => "one number, not negative".into(),
        Args::LengthAboveZero => "one number above zero".into(),
        Args::Choice(words) => format!("one of {}", words.join(", ")),
        Args::Words(_, _, what) => what.to_owned(),
    }
}

/// The unit of a value, in words.
pub fn unit(unit: Unit) -> &'static str {
    match unit {
        Unit::Length => "length",
        Unit::Angle => "degrees",
        Unit::Feed => "feed",
        Unit::Speed => "speed",
        Unit::Time => "time",
        Unit::Code => "code",
        Unit::Count => "whole number",
        Unit::Number => "number",
    }
}

/// Where a value comes from, in words.
pub fn origin(origin: Origin) -> &'static str {
    match origin {
        Origin::Computed => "postform, from the toolpath",
        Origin::Job => "the job's `set`, --set or a prompt",
        Origin::Asked => "postform, from the job; without a value in the job, --set or a prompt",
    }
}

/// Formats an explanation: a heading, lines with labels, and an example.
fn page(head: &str, lines: &[(&str, String)], example: Option<Example>) -> String {
    let mut text = format!("{head}\n\n");
    for (name, value) in lines.iter().filter(|(_, value)| !value.is_empty()) {
        text += &format!("{name:<9} {value}\n");
    }
    if let Some(Example { text: example, form }) = example {
        text += &format!("\nExample, {form}:\n");
        example.lines().for_each(|line| text += &format!("  {line}\n"));
    }
    text
}

/// The explanation of a command, as `explain` prints it.
pub fn command(id: CommandId) -> String {
    let row = id.row();
    let without = if row.without.is_nothing() { "nothing".to_owned() } else { row.without.to_string() };
    let times = if row.repeats { "as often as needed" } else { "once" };
    let lines = [
        ("does", row.meaning.to_owned()),
        ("takes", takes(row.args)),
        ("without", without),
        ("stands", format!("before the first sequence, {times}")),
        ("standing", standing(row.standing).to_owned()),
    ];
    page(&format!("{} (command)", row.name), &lines, examples::command(row.name).or_else(|| as_it_would_be(row)))
}

/// An example for a command that no form contains, made from the command's default or arguments.
fn as_it_would_be(row: &Command) -> Option<Example> {
    let default = Some(row.without.arguments(Machine::Mill, UnitChoice::Inch)).filter(|default| !default.is_empty());
    let value = row.example.or(match row.args {
        Args::Switch => Some(if default == Some("Y") { "N" } else { "Y" }),
        Args::Text => Some("text"),
        Args::Choice(words) => words.last().copied(),
        Args::Words(_, _, what) => what.rsplit('`').nth(1),
        _ => default,
    })?;
    Some(Example { text: format!("{} {value}", row.name), form: "in a form" })
}

/// The explanation of a variable, as `explain` prints it.
pub fn variable(id: VarId) -> String {
    let row = id.row();
    let lines = [
        ("is", row.meaning.to_owned()),
        ("counts", unit(row.unit).to_owned()),
        ("set by", origin(row.origin).to_owned()),
        ("group", row.group.to_owned()),
        ("on", row.machines.to_string()),
    ];
    page(&format!("[{}] (variable)", row.name), &lines, examples::variable(id).or_else(|| in_a_comment(id)))
}

/// An example for a variable that no form prints. Every variable may be printed in a comment.
fn in_a_comment(id: VarId) -> Option<Example> {
    let text = format!("({} [{}])", id.name().to_uppercase(), id.name());
    Some(Example { text, form: "in a comment of the program" })
}

/// The explanation of a text variable, as `explain` prints it.
pub fn text(id: TextId) -> String {
    let row = id.row();
    let lines = [
        ("is", row.meaning.to_owned()),
        ("counts", "text".to_owned()),
        ("set by", row.from.to_owned()),
        ("width", format!("[{0}:12] for 12 characters, [{0}:-12] for 12 characters aligned right", row.name)),
        ("standing", standing(Standing::Ours).to_owned()),
        ("sample", "samples/texts".to_owned()),
    ];
    let example =
        Example { text: format!("({} [{}])", row.name.to_uppercase(), row.name), form: "in a comment of the program" };
    page(&format!("[{}] (text)", row.name), &lines, Some(example))
}

/// The explanation of a directive, as `explain` prints it.
pub fn directive(row: &DirectiveRow) -> String {
    let lines = [
        ("does", row.meaning.to_owned()),
        ("takes", row.takes.replace('`', "")),
        ("stands", "at the beginning of a line inside a sequence".to_owned()),
        ("standing", standing(Standing::Ours).to_owned()),
        ("sample", "samples/conditions".to_owned()),
    ];
    let text = match row.name {
        "@set" => "@set val1 = [val1]+1",
        _ => "@if [cool] = mist\n  M7\n@elif [cool] = on and [speed] > 2000\n  M88\n@else\n  M9\n@end",
    };
    let example = Example { text: text.to_owned(), form: "inside a sequence" };
    page(&format!("{} (directive)", row.name), &lines, Some(example))
}

/// The explanation of a sequence, as `explain` prints it.
pub fn sequence(id: SequenceId) -> String {
    let row = id.row();
    let kind = if row.is_cycle { "canned cycle" } else { "sequence" };
    let required = if row.required == Machines::of("") { String::new() } else { row.required.to_string() };
    let lines = [
        ("is", row.meaning.to_owned()),
        ("prints at", row.event.replace('`', "")),
        ("on", row.machines.to_string()),
        ("needed on", required),
        ("standing", standing(row.standing).to_owned()),
        ("sample", format!("samples/{}", row.sample)),
    ];
    page(&format!("{} ({kind})", row.name), &lines, examples::sequence(id))
}

/// The explanation of `Upon [var]`, as `explain` prints it.
pub fn upon() -> String {
    let lines = [
        ("is", "a sequence that is printed when a variable changes, before the next use of this variable".to_owned()),
        ("every", "Upon Every [var] is printed at every use".to_owned()),
        ("on", "mill".to_owned()),
        ("standing", standing(Standing::Doc).to_owned()),
        ("sample", "samples/upon-work, samples/upon-every-tool".to_owned()),
    ];
    let text = "Upon [work]\nG91 G28 Z0\nG90\nG[work] G0 X[h] Y[v]\nEnd".to_owned();
    page("Upon [var] (sequence)", &lines, Some(Example { text, form: "postforms/fanuc.pf" }))
}

/// The explanation of `End`, which closes a sequence.
pub fn end() -> String {
    let lines = [
        ("is", "the end of a sequence, alone on a line".to_owned()),
        (
            "Cancel",
            "End Cancel prints the sequence Cancel after the last hole; only canned cycles have End Cancel".to_owned(),
        ),
        ("standing", standing(Standing::Doc).to_owned()),
        ("sample", "samples/cancel-with".to_owned()),
    ];
    page("End (of a sequence)", &lines, examples::sequence(SequenceId::Drill))
}

/// The explanation of `None`, which replaces the lines of a sequence.
pub fn none() -> String {
    let lines = [
        ("is", "the only word in the body of a sequence that prints no block".to_owned()),
        ("in cycles", "a canned cycle with the body None is printed as single moves".to_owned()),
        ("standing", standing(Standing::Doc).to_owned()),
    ];
    let text = "Peck\nNone\nEnd".to_owned();
    page("None (body of a sequence)", &lines, Some(Example { text, form: "in a form" }))
}

/// The explanation of a kind of cycle. The sequence that prints the cycle has a separate explanation.
pub fn cycle(name: &str) -> Option<String> {
    let row = CYCLES.iter().find(|row| row.name.eq_ignore_ascii_case(name))?;
    let kind = CycleKind::parse(name)?;
    let served_by = match kind.sequence() {
        Some(id) => format!("{}, or a Custom sequence with the comment {}", id.name(), row.name),
        None if kind == CycleKind::Face => {
            "a Custom sequence with the comment face, or a Drill that prints [dwell]".to_owned()
        }
        None => format!("a Custom sequence with the comment {}", row.name),
    };
    let lines = [
        ("is", row.meaning.to_owned()),
        ("served by", served_by),
        ("else", "moves generated by postform; a rigid tap is then an error".to_owned()),
        ("in a job", format!("{{\"cycle\": {{\"kind\": \"{}\", ..}}}} (docs/cycles.md)", row.name)),
    ];
    Some(page(&format!("{} (cycle of a job)", row.name), &lines, None))
}
