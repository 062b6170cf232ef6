//! Generates the reference pages of docs/ from the tables. A test compares the files with this output.

use super::words::{origin, source, takes, unit};
use crate::diag::CODES;
use crate::lang::{COMMANDS, Machines, SEQUENCES, TEXTS, VARIABLES};
use crate::lint::RULES;

/// The beginning of a generated page.
fn head(title: &str, lead: &str) -> String {
    format!("# {title}\n\n<!-- made from the tables of the source: `just overwrite` -->\n\n{lead}\n\n")
}

/// Escapes a text for a cell of a table.
fn cell(text: &str) -> String {
    text.replace('|', "\\|")
}

/// The text of docs/commands.md.
pub fn commands() -> String {
    let mut text = head(
        "Commands of forms",
        "Commands come before the first sequence. `postform explain NAME` shows a command with an example. The last \
         column gives the source of the definition: the POSTFORM manual, an example of this manual, or ours. \"Ours\" \
         means that no public source defines the command, so postform defines it.\n\n\
         Lengths in commands are in the units of the form (`Units`). With `Units both`, these lengths are in \
         inches, and postform converts them to the units of the program. For example, `CycleClear 3` is then 3 \
         inches, which is 76.2 mm. If the form does not contain `CycleClear`, `CycleBack` or `CycleJog`, postform \
         uses the default in the units of the job.",
    );
    text += "| command | takes | default | does | source |\n| --- | --- | --- | --- | --- |\n";
    for row in COMMANDS {
        let default = if row.without.is_nothing() { "-".to_owned() } else { format!("`{}`", row.without) };
        let times = if row.repeats { ", as often as needed" } else { "" };
        text += &format!(
            "| `{}` | {}{times} | {default} | {} | {} |\n",
            row.name,
            cell(&takes(row.args)),
            cell(row.meaning),
            source(row.standing)
        );
    }
    text
}

/// The text of docs/variables.md.
pub fn variables() -> String {
    let mut text = head(
        "Variables of forms",
        "In a form, a variable stands alone, such as `[toold]`, or after a letter, such as `X[h]`. `postform explain NAME` \
         shows a variable with an example.",
    );
    let mut group = "";
    for row in VARIABLES {
        if row.group != group {
            group = row.group;
            let first = if text.ends_with("|\n") { "\n" } else { "" };
            text += &format!(
                "{first}## {group}\n\n| variable | is | value | on | set by |\n| --- | --- | --- | --- | --- |\n"
            );
        }
        let (counts, by) = (unit(row.unit), origin(row.origin));
        text += &format!("| `[{}]` | {} | {counts} | {} | {by} |\n", row.name, cell(row.meaning), row.machines);
    }
    text += "\n## Texts\n\nText variables are for comments and names. Only postform has text variables: the POSTFORM \
             manual does not describe them. `[toolname:12]` has a width: see [language](language.md#texts).\n\n";
    text += "| variable | is | set by |\n| --- | --- | --- |\n";
    for row in TEXTS {
        text += &format!("| `[{}]` | {} | {} |\n", row.name, cell(row.meaning), row.from);
    }
    text
}

/// The text of docs/sequences.md.
pub fn sequences() -> String {
    let mut text = head(
        "Sequences",
        "For each sequence, the table lists the machines that have the sequence, the item of the job that causes \
         postform to print the sequence, and a sample.",
    );
    text += "| sequence | machines | event | sample | printed | required on |\n| --- | --- | --- | --- | --- | --- |\n";
    for row in SEQUENCES {
        let needed = if row.required == Machines::of("") { "-".into() } else { row.required.to_string() };
        text += &format!(
            "| `{}` | {} | {} | [{}](../samples/{}) | {} | {needed} |\n",
            row.name,
            row.machines,
            row.event,
            row.sample,
            row.sample,
            cell(row.meaning)
        );
    }
    text += "| `Upon [var]` | mill | the next use of a variable that changed | [upon-work](../samples/upon-work) | when a variable changes | - |\n";
    text += "| `Upon Every [var]` | mill | every use of a variable | [upon-every-tool](../samples/upon-every-tool) | before every use of a variable | - |\n";
    text += "| `Thread G33` (a command) | lathe | `thread` | [thread-g33](../samples/thread-g33) | each pass, if the \
        form has no threading cycle | - |\n";
    text
}

/// The families of codes for forms.
const FAMILIES: [(&str, &str); 8] = [
    ("PF0", "Structure"),
    ("PF1", "Spaces and comments"),
    ("PF2", "Names"),
    ("PF3", "Numbers and letter formats"),
    ("PF4", "Sequences and cycles"),
    ("PF5", "Modality"),
    ("PF6", "Limits and machine type"),
    ("PF7", "Texts, expressions, conditions"),
];

/// The text of docs/rules/README.md.
pub fn rules() -> String {
    let lead = "This page lists the findings of `postform lint`. postform prints no program for a form with an *error*. A finding \
        marked *rule* can be turned off ([lint](../lint.md)).";
    let mut text = head("Findings in forms", lead);
    for (family, title) in FAMILIES {
        text += &format!("## {title}\n\n| code | finds | severity | |\n| --- | --- | --- | --- |\n");
        for row in CODES.iter().filter(|row| row.name.starts_with(family)) {
            let rule = if RULES.iter().any(|rule| rule.code == row.code) { "rule" } else { "" };
            text +=
                &format!("| [{}]({}.md) | {} | {} | {rule} |\n", row.name, row.name, row.title, row.severity.name());
        }
        text.push('\n');
    }
    text.truncate(text.trim_end().len());
    text.push('\n');
    text
}
