//! The table of directives: lines of a sequence that say which of its lines print.

use super::suggest::nearest;

/// A directive's row.
#[derive(Debug)]
pub struct DirectiveRow {
    /// As written, `@if`.
    pub name: &'static str,
    /// What stands after it.
    pub takes: &'static str,
    /// What it does.
    pub meaning: &'static str,
}

/// All directives.
pub const DIRECTIVES: &[DirectiveRow] = &[
    DirectiveRow {
        name: "@if",
        takes: "a condition, as `[cool] = mist and [speed] > 0`",
        meaning: "the lines after it, up to @elif, @else or @end, print where the condition holds",
    },
    DirectiveRow {
        name: "@elif",
        takes: "a condition",
        meaning: "else the lines after it print, where this condition holds",
    },
    DirectiveRow { name: "@else", takes: "nothing", meaning: "else the lines after it print" },
    DirectiveRow { name: "@end", takes: "nothing", meaning: "ends @if or @for" },
    DirectiveRow {
        name: "@for",
        takes: "`tool`, `operation` or `work`",
        meaning: "the lines after it, up to @end, print once for each of the job",
    },
    DirectiveRow {
        name: "@set",
        takes: "a variable from val1 to val10, `=` and an expression, as `val1 = [val1]+1`",
        meaning: "the variable has this value to the end of the program",
    },
];

/// What other languages call them.
const OTHERS: &[(&str, &str)] = &[
    ("@elseif", "@elif"),
    ("@elsif", "@elif"),
    ("@endif", "@end"),
    ("@endfor", "@end"),
    ("@done", "@end"),
    ("@next", "@end"),
    ("@foreach", "@for"),
    ("@while", "@for"),
    ("@let", "@set"),
];

/// The directive that somebody means by a name that is none.
pub fn directive_meant(name: &str) -> Option<&'static str> {
    let other = OTHERS.iter().find(|(other, _)| other.eq_ignore_ascii_case(name)).map(|(_, own)| *own);
    let joined: String = name.split([' ', '\t']).collect(); // `@ if`
    other.or_else(|| nearest(&joined, DIRECTIVES.iter().map(|row| row.name)))
}

/// What `@for` goes through.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Each {
    /// Each tool of the job, in the order of use.
    Tool,
    /// Each operation of the job; inside `@for tool` or `@for work` those of it.
    Operation,
    /// Each work offset of the job, in the order of use.
    Work,
}

impl Each {
    /// All of them by their names.
    pub const ALL: [(&'static str, Each); 3] =
        [("tool", Each::Tool), ("operation", Each::Operation), ("work", Each::Work)];

    /// Finds a name in any case.
    pub fn parse(name: &str) -> Option<Each> {
        Each::ALL.iter().find(|(own, _)| own.eq_ignore_ascii_case(name)).map(|(_, each)| *each)
    }

    /// As written after `@for`.
    pub fn name(self) -> &'static str {
        Each::ALL[self as usize].0
    }
}
