//! Writes the setup sheet as a self-contained HTML page for A4 and Letter paper: light or dark on the screen, black on paper.

use super::{SetupSheet, facts, tables, title};
use crate::terminal::without_markup;

const STYLE: &str = "
:root { color-scheme: light dark; --line: #bbb; --quiet: #555; }
@media (prefers-color-scheme: dark) { :root { --line: #555; --quiet: #aaa; } }
body { font: 13px/1.45 system-ui, sans-serif; margin: 2em auto; max-width: 60em; padding: 0 1em; }
h1 { font-size: 1.6em; margin: 0 0 .4em; } h2 { font-size: 1.1em; margin: 1.4em 0 .3em; }
dl { display: grid; grid-template-columns: max-content 1fr; gap: .1em 1em; margin: 0; }
dt { color: var(--quiet); } dd { margin: 0; }
table { border-collapse: collapse; width: 100%; }
th, td { text-align: left; padding: .25em .6em .25em 0; border-bottom: 1px solid var(--line); vertical-align: top; }
th { font-weight: 600; } td { font-variant-numeric: tabular-nums; overflow-wrap: anywhere; }
figure { margin: 0; } figcaption { color: var(--quiet); }
.pictures { display: grid; grid-template-columns: 1fr 1fr; gap: 1em; background: #fff; color: #000; padding: .5em; }
.pictures svg { width: 100%; height: auto; } .files { color: var(--quiet); font-size: .85em; overflow-wrap: anywhere; }
@page { margin: 12mm; }
@media print {
  :root { color-scheme: light; --line: #999; --quiet: #333; }
  body { margin: 0; max-width: none; padding: 0; font-size: 10px; color: #000; background: #fff; }
  .pictures svg { max-height: 62mm; }
  h2, tr, figure { break-inside: avoid; } h2 { break-after: avoid; } thead { display: table-header-group; }
}
";

/// The setup sheet as HTML. The page loads nothing from other sites, and never executes text of the job.
pub fn html(sheet: &SetupSheet) -> String {
    let mut page = format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" content=\"width=device-width\">\n<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'\">\n<title>{0}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n<h1>{0}</h1>\n<dl>\n",
        escaped(&title(sheet))
    );
    for [what, value] in facts(sheet) {
        page += &format!("<dt>{}</dt><dd>{}</dd>\n", escaped(&what), escaped(&value));
    }
    page += "</dl>\n";
    if !sheet.pictures.is_empty() {
        page += "<h2>The path</h2>\n<div class=\"pictures\">\n";
        for [caption, svg] in &sheet.pictures {
            page += &format!("<figure>{svg}<figcaption>{}</figcaption></figure>\n", escaped(caption));
        }
        page += "</div>\n";
    }
    for table in tables(sheet) {
        page += &format!("<h2>{}</h2>\n<table>\n<thead><tr>", table.title);
        table.head.iter().for_each(|cell| page += &format!("<th scope=\"col\">{cell}</th>"));
        page += "</tr></thead>\n<tbody>\n";
        for row in &table.rows {
            page += "<tr>";
            row.iter().for_each(|cell| page += &format!("<td>{}</td>", escaped(cell)));
            page += "</tr>\n";
        }
        page += "</tbody>\n</table>\n";
    }
    page += "<h2>Files</h2>\n<div class=\"files\">\n";
    for [name, hash] in &sheet.hashes {
        page += &format!("<div>{}: {hash}</div>\n", escaped(name));
    }
    page + "</div>\n</body>\n</html>\n"
}

/// Text for the page. A control character becomes a space.
fn escaped(text: &str) -> String {
    without_markup(&text.replace(char::is_control, " "))
}
