//! Writes the setup sheet as Markdown.

use super::{SetupSheet, facts, tables, title};

/// The setup sheet as Markdown, without pictures.
pub fn markdown(sheet: &SetupSheet) -> String {
    let mut text = format!("# {}\n\n", cell(&title(sheet)));
    for [what, value] in facts(sheet) {
        let what = if what.is_empty() { String::new() } else { format!("{what}: ") };
        text += &format!("- {what}{}\n", cell(&value));
    }
    for table in tables(sheet) {
        text += &format!("\n## {}\n\n", table.title);
        text += &format!("| {} |\n", table.head.join(" | "));
        text += &format!("|{}\n", " --- |".repeat(table.head.len()));
        for row in &table.rows {
            let cells: Vec<String> = row.iter().map(|text| cell(text)).collect();
            text += &format!("| {} |\n", cells.join(" | "));
        }
    }
    text += "\n## Files\n\n";
    for [name, hash] in &sheet.hashes {
        text += &format!("- {}: `{hash}`\n", cell(name));
    }
    text
}

/// A text for a cell of a table. Its special characters are escaped, so the text can't end the cell and is not read as
/// Markdown.
fn cell(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars() {
        match c {
            '|' | '<' | '>' | '`' | '*' | '_' | '[' | ']' | '\\' | '#' => out.extend(['\\', c]),
            c if c.is_control() => out.push(' '),
            c => out.push(c),
        }
    }
    out
}
