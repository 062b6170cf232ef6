//! The table of directives. A directive is a line of a sequence that determines which lines are printed.

use crate::suggest::nearest;

/// One row of the table of directives.
#[derive(Debug)]
pub struct DirectiveRow {
    /// Name as written, such as `@if`.
    pub name: &'static str,
    /// Arguments after the name.
    pub takes: &'static str,
    /// Effect of the directive.
    pub meaning: &'static str,
}

/// All directives.
pub const DIRECTIVES: &[DirectiveRow] = &[
    DirectiveRow {
        name: "@if",
        takes: "a condition, such as `[cool] = mist and [speed] > 0`",
        meaning: "prints the lines up to @elif, @else or @end if the condition is true",
    },
    DirectiveRow {
        name: "@elif",
        takes: "a condition",
        meaning: "prints the lines after it if this condition is true and all earlier conditions are false",
    },
    DirectiveRow {
        name: "@else",
        takes: "nothing",
        meaning: "prints the lines after it if all earlier conditions are false",
    },
    DirectiveRow { name: "@end", takes: "nothing", meaning: "ends @if or @for" },
    DirectiveRow {
        name: "@for",
        takes: "`tool`, `operation` or `work`",
        meaning: "prints the lines up to @end once for each tool, operation or work offset of the job",
    },
    DirectiveRow {
        name: "@set",
        takes: "a variable from val1 to val10, `=` and an expression, such as `val1 = [val1]+1`",
        meaning: "gives the variable a value until the end of the program",
    },
];

/// Names of directives in other languages, each with the name in postform.
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

/// For an unknown name: the directive that the user probably intended.
pub fn directive_meant(name: &str) -> Option<&'static str> {
    let other = OTHERS.iter().find(|(other, _)| other.eq_ignore_ascii_case(name)).map(|(_, own)| *own);
    let joined: String = name.split([' ', '\t']).collect(); // as in `@ if`
    other.or_else(|| nearest(&joined, DIRECTIVES.iter().map(|row| row.name)))
}

/// The kind of item for which an `@for` repeats its lines.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Each {
    /// Each tool of the job, in the order of use.
    Tool,
    /// Each operation of the job. Inside `@for tool` or `@for work`: only the operations of the current tool or work
    /// offset.
    Operation,
    /// Each work offset of the job, in the order of use.
    Work,
}

impl Each {
    /// All kinds, each with its name.
    pub const ALL: [(&'static str, Each); 3] =
        [("tool", Each::Tool), ("operation", Each::Operation), ("work", Each::Work)];

    /// Finds a kind by its name; upper and lower case are equal.
    pub fn parse(name: &str) -> Option<Each> {
        Each::ALL.iter().find(|(own, _)| own.eq_ignore_ascii_case(name)).map(|(_, each)| *each)
    }

    /// The name of the kind, as it is written after `@for`.
    pub fn name(self) -> &'static str {
        Each::ALL[self as usize].0
    }
}
