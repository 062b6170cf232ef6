//! `postform explain`.

use std::io::Write as _;

use postform::diag::{CODES, Code};
use postform::lang::did_you_mean;

use super::args::ExplainArgs;
use super::{Ending, output};

/// The pages: a section each, headed by code and name.
const PAGES: [&str; 3] = [
    include_str!("../../docs/cycles.md"),
    include_str!("../../docs/programs.md"),
    include_str!("../../docs/verify.md"),
];

/// Prints what a code means and what to write instead.
pub fn run(args: &ExplainArgs) -> Ending {
    let asked = args.code.trim();
    let Some(row) = CODES.iter().find(|row| names(row.code).any(|name| name.eq_ignore_ascii_case(asked))) else {
        let all = CODES.iter().flat_map(|row| names(row.code));
        let help =
            did_you_mean(asked, all).unwrap_or_else(|| "codes are like PF101, PC003 and cycle.depth.missing".into());
        eprintln!("error: there is no code `{asked}`\n  help: {help}");
        return Ending::Failed;
    };
    let title = row.title.split_once(": ").map_or(row.title, |(_, title)| title);
    let text = format!("{} ({}): {title}\n{}", row.code.title(), row.severity.name(), page(row.name));
    match output::standard_output(|out| out.write_all(text.as_bytes())) {
        Ok(()) => Ending::Clean,
        Err(message) => {
            eprintln!("{message}");
            Ending::Failed
        }
    }
}

/// What a code is called.
fn names(code: Code) -> impl Iterator<Item = &'static str> {
    [code.name(), code.key()].into_iter().filter(|name| !name.is_empty())
}

/// The section of a code; empty where it has none yet.
fn page(name: &str) -> String {
    let head = format!("### {name} ");
    let Some(at) = PAGES.iter().find_map(|page| page.split_once(&head)) else { return String::new() };
    let body = at.1.split_once('\n').map_or("", |(_, body)| body);
    let end = body.find("\n### ").unwrap_or(body.len());
    format!("\n{}\n", body[..end].trim().replace("*Instead:*", "Instead:").replace("*Better:*", "Better:"))
}
