//! Explains codes, commands, variables, sequences, cycles and controls. The texts come from the same tables and pages as
//! the reference.
// pages contain variables as [var], which are not links
#![allow(rustdoc::broken_intra_doc_links)]

pub mod controls;
mod examples;
mod pages;
pub mod reference;
mod words;

pub use words::{command, end, none, sequence, takes, text, unit, upon, variable};

use crate::control::{self, Control};
use crate::diag::{CODES, CodeRow};
use crate::lang::{COMMANDS, CommandId, DIRECTIVES, SEQUENCES, SequenceId, TEXTS, TextId, VARIABLES, VarId};
use crate::suggest::{LONGEST_NAME, did_you_mean};

/// The explanation of a code, command, variable, sequence, cycle or control. Upper and lower case are equal.
///
/// # Errors
/// Returns an error if nothing has this name. The error suggests similar names.
pub fn explain(what: &str) -> Result<String, String> {
    let asked = what.trim();
    let upon = asked.get(..5).is_some_and(|head| head.eq_ignore_ascii_case("Upon "));
    // in `X[h]`, the variable is looked up
    let inner = asked.split_once(['[', '<']).filter(|(letter, _)| letter.len() <= 1).map(|(_, name)| name);
    let bare = inner.unwrap_or(asked).trim_matches(['[', ']', '<', '>']);
    let mut texts = Vec::new();
    if let Some(row) = CODES.iter().find(|row| names_of(row).any(|name| name.eq_ignore_ascii_case(asked))) {
        texts.push(code(row));
    }
    // a name in brackets can only be a variable
    if asked == bare {
        texts.extend(SequenceId::parse(asked).map(words::sequence));
        texts.extend(CommandId::parse(asked).map(words::command));
    }
    if upon || asked.eq_ignore_ascii_case("Upon") {
        texts.push(words::upon());
    }
    match asked.to_ascii_lowercase().as_str() {
        "end" => texts.push(words::end()),
        "none" => texts.push(words::none()),
        _ => {}
    }
    texts.extend(DIRECTIVES.iter().find(|row| row.name.eq_ignore_ascii_case(asked)).map(words::directive));
    texts.extend(VarId::parse(bare).map(words::variable));
    texts.extend(TextId::parse(bare.split(':').next().unwrap_or(bare)).map(words::text));
    if asked == bare {
        texts.extend(words::cycle(asked));
    }
    // for a line of a form, such as `Back 3` or `Force X Z`, the first word of the line is looked up
    if let Some((head, _)) = asked.rsplit_once(' ').filter(|_| texts.is_empty() && asked.len() < LONGEST_NAME) {
        texts.extend(explain(head));
    }
    texts.extend(Control::named(&asked.to_ascii_lowercase()).map(controls::text));
    // codes of programs, such as `G81`
    texts.extend(asked.to_ascii_uppercase().parse().ok().and_then(controls::on_each));
    match texts.is_empty() {
        false => Ok(texts.join("\n")),
        true => Err(did_you_mean(bare, all_names()).unwrap_or_else(|| {
            "give a code (PF101, cycle.depth.missing), a code of programs (G81), a command, a variable, a sequence or a \
             kind of cycle; --list shows all of them"
                .into()
        })),
    }
}

/// All names that can be looked up, in groups.
pub fn list() -> String {
    let mut text = String::from("Codes\n");
    for row in CODES {
        let title = row.title.split_once(": ").map_or(row.title, |(_, title)| title);
        text += &format!("  {:<36} {:<7} {title}\n", row.code.title(), row.severity.name());
    }
    text += "\nCommands\n";
    COMMANDS.iter().for_each(|row| text += &format!("  {:<20} {}\n", row.name, row.meaning));
    text += "\nSequences\n";
    let upons = [
        ("Upon [var]", "when a variable changes"),
        ("Upon Every [var]", "before every use of a variable"),
        ("End", "ends a sequence; End Cancel ends a canned cycle and prints the sequence Cancel"),
        ("None", "a body that prints nothing"),
    ];
    let rows = SEQUENCES.iter().map(|row| (row.name, row.meaning)).chain(upons);
    rows.for_each(|(name, meaning)| text += &format!("  {name:<20} {meaning}\n"));
    text += "\nDirectives\n";
    DIRECTIVES.iter().for_each(|row| text += &format!("  {:<20} {}\n", row.name, row.meaning));
    text += "\nCycles of a job\n";
    words::CYCLES.iter().for_each(|row| text += &format!("  {:<20} {}\n", row.name, row.meaning));
    text += "\nControls\n";
    let controls = control::names().filter_map(Control::named);
    controls.for_each(|control| text += &format!("  {:<20} {}\n", control.name(), control.title()));
    text += "\nVariables\n";
    VARIABLES.iter().for_each(|row| text += &format!("  {:<20} {}\n", format!("[{}]", row.name), row.meaning));
    text += "\nTexts\n";
    TEXTS.iter().for_each(|row| text += &format!("  {:<20} {}\n", format!("[{}]", row.name), row.meaning));
    text
}

/// The names with which a code can be looked up.
fn names_of(row: &'static CodeRow) -> impl Iterator<Item = &'static str> {
    [row.name, row.code.key()].into_iter().filter(|name| !name.is_empty())
}

fn all_names() -> impl Iterator<Item = &'static str> {
    let codes = CODES.iter().flat_map(names_of);
    let words = COMMANDS.iter().map(|row| row.name).chain(SEQUENCES.iter().map(|row| row.name));
    codes
        .chain(words)
        .chain(control::names())
        .chain(VARIABLES.iter().map(|row| row.name))
        .chain(TEXTS.iter().map(|row| row.name))
        .chain(words::CYCLES.iter().map(|row| row.name))
}

/// The page of a code, or the section of a page about the code.
fn code(row: &CodeRow) -> String {
    let title = row.title.split_once(": ").map_or(row.title, |(_, title)| title);
    let head = format!("{} ({}): {title}\n", row.code.title(), row.severity.name());
    format!("{head}\n{}\n", plain(&pages::of(row)))
}

/// Converts Markdown to text for a terminal.
fn plain(text: &str) -> String {
    let mut out = String::new();
    for line in text.trim().lines() {
        match line.strip_prefix("## ") {
            Some(heading) => out += heading,
            None if line.starts_with("```") => continue,
            None => out += &line.replace("*Instead:*", "Instead:").replace("*Better:*", "Better:"),
        }
        out.push('\n');
    }
    out.trim_end().to_owned()
}
