//! A comparison as one self-contained HTML page. The page can be mailed, and loads nothing from the network.

use std::fmt::Write as _;
use std::io::Cursor;
use std::ops::Range;

use postform::internals::diff::{Comparison, Edit, Hunk, Options, Program, Summary, changed_spans};
use postform::internals::nc::RunSettings;
use postform::internals::picture::{Sheet, View, draw, svg_over};
use postform::internals::source::text_of;
use postform::internals::terminal::{escaped, without_markup};

use super::sides::Side;
use super::text::{grouped, sentence};

const STYLE: &str = "\
body{font:15px/1.45 system-ui,sans-serif;margin:2rem auto;max-width:80rem;padding:0 1rem;color:#1b1f24;background:#fff}
h1{font-size:1.25rem;margin:0 0 .25rem}p{margin:.25rem 0 1rem}code{font:13px/1.5 ui-monospace,monospace}
table{border-collapse:collapse;width:100%;table-layout:fixed;margin:0 0 1.25rem;border:1px solid #d0d7de}
td{font:13px/1.5 ui-monospace,monospace;white-space:pre-wrap;overflow-wrap:anywhere;padding:0 .5rem;vertical-align:top}
td.n{width:4.5rem;color:#57606a;text-align:right;user-select:none;background:#f6f8fa}
td.old{background:#ffebe9}td.new{background:#dafbe1}td.moved{background:#ddf4ff}
mark{background:#ffc1ba;color:inherit;border-radius:2px}td.new mark{background:#9be9a8}
td.origin{color:#57606a;background:#f6f8fa;text-align:right;font-size:12px}
.path{display:flex;flex-wrap:wrap;gap:1rem}.path svg{flex:1 1 24rem;min-width:0;height:auto;border:1px solid #8884;border-radius:4px}
@media(prefers-color-scheme:dark){body{background:#0d1117;color:#e6edf3}table{border-color:#30363d}td.n,td.origin{background:#161b22;color:#8b949e}
td.old{background:#49202499}td.new{background:#12361f}td.moved{background:#12304d}mark{background:#8e3a36}td.new mark{background:#1f6f35}}
";

/// The tool paths of both programs, with the old path below the new path; empty if there is nothing to draw.
pub fn path(programs: [&Program; 2], settings: [RunSettings; 2]) -> String {
    let [old, new] = [0, 1].map(|side| draw(Cursor::new(programs[side].bytes()), settings[side]).ok());
    let (Some(old), Some(new)) = (old, new) else { return String::new() };
    if old.moves.is_empty() || new.moves.is_empty() {
        return String::new();
    }
    let mut text = "<p class=\"path\">".to_owned();
    let views = match new.usual_view() {
        View::Lathe => vec![View::Lathe],
        view => vec![view, View::Top],
    };
    for view in views {
        text += &svg_over(Some(&old), &new, &Sheet { title: "After over before".into(), view, width: 620.0 });
    }
    text + "</p>\n"
}

/// The page.
pub fn page(
    old: &Side,
    new: &Side,
    comparison: &Comparison,
    summary: &Summary,
    context: usize,
    options: &Options,
    path: &str,
) -> String {
    let mut text = String::new();
    let (a, b) = (safe(old.name.as_bytes()), safe(new.name.as_bytes()));
    let found =
        if comparison.is_same() { "no differences".to_owned() } else { safe(sentence(summary).trim().as_bytes()) };
    _ = write!(
        text,
        "<!doctype html>\n<html lang=\"en\">\n<head><meta charset=\"utf-8\">\
         <meta name=\"viewport\" content=\"width=device-width,initial-scale=1\"><title>{a} and {b}</title>\n\
         <style>{STYLE}</style></head>\n<body>\n<h1>What changed</h1>\n<p><code>{a}</code> before, <code>{b}</code> after: {found}</p>\n"
    );
    text += path;
    for group in grouped(&comparison.hunks, context) {
        table(old, new, group, context, options, &mut text);
    }
    text += "</body>\n</html>\n";
    text
}

fn table(old: &Side, new: &Side, hunks: &[Hunk], context: usize, options: &Options, out: &mut String) {
    let (Some(first), Some(last)) = (hunks.first(), hunks.last()) else { return };
    out.push_str("<table>\n");
    let mut at = (first.old.start.saturating_sub(context), first.new.start.saturating_sub(context));
    for hunk in hunks {
        unchanged(old, new, at.0..hunk.old.start, at.1..hunk.new.start, out);
        hunk.edits.iter().for_each(|edit| row(old, new, edit, options, out));
        // the origin of the new lines
        if let Some(origin) = hunk.new.clone().next().and_then(|line| new.origin(line)) {
            _ = writeln!(
                out,
                "<tr><td colspan=\"4\" class=\"origin\">printed by {}</td></tr>",
                safe(origin.as_bytes())
            );
        }
        at = (hunk.old.end, hunk.new.end);
    }
    let end = ((last.old.end + context).min(old.program.len()), (last.new.end + context).min(new.program.len()));
    unchanged(old, new, at.0..end.0, at.1..end.1, out);
    out.push_str("</table>\n");
}

/// Prints rows of equal lines. If one side has more lines, the first lines of this side are left out.
fn unchanged(old: &Side, new: &Side, before: Range<usize>, after: Range<usize>, out: &mut String) {
    // ignored lines may make one side longer: both sides are aligned at their last lines
    let both = before.len().min(after.len());
    let (a, b) = (before.end - both, after.end - both);
    for i in 0..both {
        cells(
            &cell(Some(a + i), old.program.text(a + i), &[], ""),
            &cell(Some(b + i), new.program.text(b + i), &[], ""),
            out,
        );
    }
}

fn row(old: &Side, new: &Side, edit: &Edit, options: &Options, out: &mut String) {
    let none = cell(None, b"", &[], "");
    match *edit {
        Edit::Removed(line) => cells(&cell(Some(line), old.program.text(line), &[], "old"), &none, out),
        Edit::Added(line) => cells(&none, &cell(Some(line), new.program.text(line), &[], "new"), out),
        Edit::Moved(a, b) => cells(
            &cell(Some(a), old.program.text(a), &[], "moved"),
            &cell(Some(b), new.program.text(b), &[], "moved"),
            out,
        ),
        Edit::Changed(a, b) => {
            let (before, after) = (old.program.text(a), new.program.text(b));
            let [gone, come] = changed_spans(before, after, &options.ignore);
            cells(&cell(Some(a), before, &gone, "old"), &cell(Some(b), after, &come, "new"), out);
        }
    }
}

fn cells(old: &str, new: &str, out: &mut String) {
    _ = writeln!(out, "<tr>{old}{new}</tr>");
}

fn cell(line: Option<usize>, text: &[u8], marked: &[Range<usize>], class: &str) -> String {
    let number = line.map_or(String::new(), |line| (line + 1).to_string());
    let mut body = String::new();
    let mut at = 0;
    for span in marked {
        _ = write!(body, "{}<mark>{}</mark>", safe(&text[at..span.start]), safe(&text[span.clone()]));
        at = span.end;
    }
    body += &safe(&text[at..]);
    format!("<td class=\"n\">{number}</td><td class=\"{class}\">{body}</td>")
}

/// Text of a program in a page, escaped so that it contains no markup.
fn safe(text: &[u8]) -> String {
    without_markup(&escaped(&text_of(text)))
}
