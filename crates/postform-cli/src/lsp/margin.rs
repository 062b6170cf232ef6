//! Texts in the margin: hints after words, and the verdict of each job above the form.

use gen_lsp_types as lsp;
use postform::internals::ide::program;
use serde_json::json;

use super::convert::{line, position, range, span};
use super::server::Server;
use super::texts::{Kind, Text};
use super::view::View;

/// Forms with more lines than this number show hints only with the setting `on`.
const MOST_LINES: usize = 500;

/// The text that the words in a range print in the current job.
pub fn hints(server: &Server, view: &View, within: lsp::Range) -> Vec<lsp::InlayHint> {
    let source = view.source();
    let shown = match server.settings.inlay_hints.as_deref() {
        Some("off") => false,
        Some("on") => true,
        _ => source.line_starts().len() <= MOST_LINES,
    };
    let Some(current) = view.current().filter(|_| shown) else { return Vec::new() };
    let hints = view.document.hints(span(source, view.file, within), current);
    let shown = |hint: postform::internals::ide::Hint| {
        let repeats = hint.text.is_empty();
        let label = if repeats { "→ ·".to_owned() } else { format!("→ {}", hint.text) };
        let tooltip = match repeats {
            true => format!("{}: not printed again, because the word is modal and unchanged", current.name),
            false => format!("{}: the first block that this line prints", current.name),
        };
        lsp::InlayHint {
            position: range(source, hint.span).end,
            label: lsp::Label::String(label),
            kind: None,
            text_edits: None,
            tooltip: Some(lsp::Tooltip::String(tooltip)),
            padding_left: Some(true),
            padding_right: None,
            data: None,
        }
    };
    hints.into_iter().map(shown).collect()
}

/// The command that opens a program.
pub const OPEN_PROGRAM: &str = "postform.openProgram";

/// Above a form, a verdict for each job. Above a program, the control that was used to run the program.
pub fn lenses(server: &Server, uri: &lsp::Uri) -> Vec<lsp::CodeLens> {
    let Some(text) = server.texts.get(uri) else { return Vec::new() };
    match text.kind {
        Kind::Form => server.view(uri).map(|view| of_form(&view, uri)).unwrap_or_default(),
        Kind::Program => vec![of_program(server, text)],
        _ => Vec::new(),
    }
}

fn of_form(view: &View, uri: &lsp::Uri) -> Vec<lsp::CodeLens> {
    let first = first_line(view);
    let lens = |title: String, job: usize| {
        let command = lsp::Command {
            title,
            tooltip: None,
            command: OPEN_PROGRAM.to_owned(),
            arguments: Some(vec![json!(uri), json!(job)]),
        };
        lsp::CodeLens { range: line(first), command: Some(command), data: None }
    };
    if view.document.post().is_none() {
        let errors = view.document.findings().iter().filter(|diag| diag.is_error()).count();
        let count = if errors == 1 { "1 error".to_owned() } else { format!("{errors} errors") };
        return vec![lens(format!("{count}: prints nothing"), 0)];
    }
    let jobs = view.jobs.iter().enumerate().map(|(index, job)| match (&job.bytes, view.printed(index)) {
        (Err(why), _) => lens(format!("{}: {}", job.name, why.trim_start_matches("error: ")), index),
        (Ok(_), Some(current)) => lens(format!("{}: {}", job.name, current.outcome()), index),
        (Ok(_), None) => lens(format!("{}: the format of the job is unknown", job.name), index),
    });
    let jobs: Vec<_> = jobs.collect();
    match (jobs.is_empty(), view.printed(jobs.len())) {
        (true, Some(sample)) => vec![lens(format!("{}: {}", sample.name, sample.outcome()), 0)],
        _ => jobs,
    }
}

/// The first line of a form that is no comment.
fn first_line(view: &View) -> u32 {
    let symbols = view.document.symbols(view.file);
    symbols.first().map_or(0, |symbol| range(view.source(), symbol.span).start.line)
}

fn of_program(server: &Server, text: &Text) -> lsp::CodeLens {
    let title = match server.control_of(text) {
        Ok((control, who)) => {
            let checked = program::check(&text.source.text, control);
            let blocks = if checked.blocks == 1 { "1 block".to_owned() } else { format!("{} blocks", checked.blocks) };
            let end = match (checked.refused, checked.cut) {
                (1, _) => "refuses 1 block".to_owned(),
                (2.., _) => format!("refuses {} blocks", checked.refused),
                (0, true) => format!("runs {blocks}; the rest was not checked"),
                (0, false) => format!("runs {blocks}"),
            };
            format!("{} ({who}) {end}", control.name())
        }
        Err(message) => message,
    };
    let at = position(postform::internals::ide::utf16::Place::default());
    let command = lsp::Command { title, tooltip: None, command: String::new(), arguments: None };
    lsp::CodeLens { range: lsp::Range { start: at, end: at }, command: Some(command), data: None }
}
