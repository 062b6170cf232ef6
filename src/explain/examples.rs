//! Examples for `explain`. The examples are lines of forms that are known to work: shipped forms and samples.

use std::sync::OnceLock;

use crate::lang::{SequenceId, VarId};
use crate::source::Source;
use crate::syntax::{Form, parse};

/// The shipped forms, the most common first.
const POSTS: &[(&str, &str)] = &[
    ("postforms/fanuc.pf", include_str!("../../postforms/fanuc.pf")),
    ("postforms/haas-4axis.pf", include_str!("../../postforms/haas-4axis.pf")),
    ("postforms/fadal-subs.pf", include_str!("../../postforms/fadal-subs.pf")),
    ("postforms/fanuc-lathe.pf", include_str!("../../postforms/fanuc-lathe.pf")),
    ("postforms/haas-lathe.pf", include_str!("../../postforms/haas-lathe.pf")),
    ("postforms/plasma.pf", include_str!("../../postforms/plasma.pf")),
    ("postforms/wire-edm.pf", include_str!("../../postforms/wire-edm.pf")),
];

macro_rules! samples {
    ($($name:literal)*) => {
        const SAMPLES: &[(&str, &str)] = &[$((
            concat!("samples/", $name, "/form.pf"),
            include_str!(concat!("../../samples/", $name, "/form.pf")),
        )),*];
    };
}

// one sample for each sequence that no shipped form contains, as in the table of sequences
samples! {
    "back-machine" "begin-row" "between" "bore-machine" "can-thread" "cancel-with" "ccw-code" "chipbreak-machine"
    "custom1-machine" "cw-code" "drill-machine" "end-code" "end-row" "first-tool-change" "index" "infeed"
    "line-code" "ltap-machine" "more-cycles" "outfeed" "peck-machine" "rapid-code" "sections" "start-code"
    "sub-call" "sub-end" "sub-start" "thread-g33" "tool-change-mill" "unwind" "upon-work" "operations" "lists" "properties"
    "coolant-kinds" "conditions" "expressions"
}

/// Lines of a form, and its name.
pub struct Example {
    /// The lines of the example.
    pub text: String,
    /// Name of the form that contains the lines.
    pub form: &'static str,
}

fn forms() -> impl Iterator<Item = &'static (&'static str, &'static str)> {
    POSTS.iter().chain(SAMPLES)
}

/// The forms with their syntax trees. A form is parsed once, when it is reached for the first time.
fn trees() -> impl Iterator<Item = (&'static str, &'static str, &'static Form)> {
    static TREES: [OnceLock<Form>; POSTS.len() + SAMPLES.len()] = [const { OnceLock::new() }; _];
    let tree = |form, text| parse(&Source::from_text(form, text), 0);
    forms().zip(&TREES).map(move |(&(form, text), kept)| (form, text, kept.get_or_init(|| tree(form, text))))
}

/// An example of a sequence, from its name to its End.
pub fn sequence(id: SequenceId) -> Option<Example> {
    trees().find_map(|(form, text, tree)| {
        let node = tree.sequences().find(|node| SequenceId::parse(&node.name.name.text) == Some(id))?;
        let end = node.end.as_ref()?.line.span.end as usize;
        Some(Example { text: text.get(node.name.line.span.start as usize..end)?.to_owned(), form })
    })
}

/// An example of a line that prints a variable.
pub fn variable(var: VarId) -> Option<Example> {
    let word = format!("[{}]", var.name());
    forms().find_map(|(form, text)| {
        let line = text.lines().find(|line| !line.starts_with('#') && line.contains(&word))?;
        Some(Example { text: line.to_owned(), form })
    })
}

/// An example of a command.
pub fn command(name: &str) -> Option<Example> {
    trees().find_map(|(form, text, tree)| {
        let statement = tree.statements().find(|statement| statement.name.text.eq_ignore_ascii_case(name))?;
        Some(Example { text: text.get(statement.line.span.range())?.to_owned(), form })
    })
}
