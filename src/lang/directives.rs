//! The table of directives: lines of a sequence that say which of its lines print.

/// A directive's row.
#[derive(Debug)]
pub struct DirectiveRow {
    /// As written, `@if`.
    pub name: &'static str,
    /// What stands behind it.
    pub takes: &'static str,
    /// What it does.
    pub meaning: &'static str,
}

/// All directives.
pub const DIRECTIVES: &[DirectiveRow] = &[
    DirectiveRow {
        name: "@if",
        takes: "a condition, as `[cool] = mist and [speed] > 0`",
        meaning: "the lines behind it, up to @elif, @else or @end, print where the condition holds",
    },
    DirectiveRow {
        name: "@elif",
        takes: "a condition",
        meaning: "else the lines behind it print, where this condition holds",
    },
    DirectiveRow { name: "@else", takes: "nothing", meaning: "else the lines behind it print" },
    DirectiveRow { name: "@end", takes: "nothing", meaning: "ends @if" },
    DirectiveRow {
        name: "@set",
        takes: "a variable from val1 to val10, `=` and an expression, as `val1 = [val1]+1`",
        meaning: "the variable has this value to the end of the program",
    },
];
