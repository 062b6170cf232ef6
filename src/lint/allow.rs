//! Suppression comments in a form. `# postform: allow PF103` at the end of a line, above a line or above a sequence
//! applies to that line or sequence. `# postform: allow-file PF103` above the form's first line applies to the whole
//! file.

use std::collections::BTreeMap;

use crate::diag::{CODES, Code, Diag, Severity};
use crate::sema::Checked;
use crate::source::Source;
use crate::span::Span;
use crate::suggest::did_you_mean;
use crate::syntax::{Head, Line, Tail};

use super::places::{Cover, Places};
use super::{Levels, stops_printing};

/// One code of a suppression comment, with the range in which its findings are allowed.
struct Allow {
    code: Code,
    /// The location of the code in the comment.
    word: Span,
    /// The range in which findings of this code are allowed.
    range: Span,
}

/// Removes the findings that comments allow, and adds findings about the comments themselves, for example about an unknown
/// code. Returns the number of removed findings.
pub fn take_allowed(checked: &Checked, levels: &Levels, diags: &mut Vec<Diag>) -> usize {
    let mut allows = Vec::new();
    let mut wrong = Vec::new();
    for (tree, source) in checked.trees.iter().zip(&checked.files) {
        let head = head(&tree.items);
        for (comment, range) in comments(&tree.items) {
            let whole = head.is_none_or(|first| comment.end <= first.start);
            let whole = whole.then(|| Span::new(comment.file, 0, source.text.len()));
            read(source, comment, Ranges { here: range, whole }, &mut allows, &mut wrong);
        }
    }
    let before = diags.len();
    for (code, allows) in by_code(&allows) {
        // findings that are errors of the form itself can't be allowed
        let place = |diag: &Diag| {
            diag.labels.first().map(|label| label.span).filter(|_| diag.code == code && !stops_printing(diag))
        };
        let found: Places = diags.iter().filter_map(place).collect();
        let allowed: Cover = allows.iter().map(|allow| allow.range).collect();
        diags.retain(|diag| !place(diag).is_some_and(|at| allowed.holds(at)));
        if levels.shows(Code::PF108) && levels.shows(code) {
            wrong.extend(allows.iter().filter(|allow| !found.any_in(allow.range)).map(|allow| unused(allow)));
        }
    }
    let taken = before - diags.len();
    wrong.retain_mut(|diag| levels.apply(diag));
    diags.extend(wrong);
    taken
}

fn by_code(allows: &[Allow]) -> BTreeMap<Code, Vec<&Allow>> {
    let mut by_code = BTreeMap::<Code, Vec<&Allow>>::new();
    allows.iter().for_each(|allow| by_code.entry(allow.code).or_default().push(allow));
    by_code
}

fn unused(allow: &Allow) -> Diag {
    // a code that is an error by default can't be allowed, because it always prevents printing
    let help = match allow.code.row().severity {
        Severity::Error => "an error can't be allowed: fix the error",
        _ => "remove the code from the comment, so that it does not hide a later finding",
    };
    Diag::new(Code::PF108, format!("`{}` allows nothing here", allow.code.name()))
        .at(allow.word, "no such finding")
        .help(help)
}

/// The ranges to which a comment may apply.
#[derive(Clone, Copy)]
struct Ranges {
    /// The line or sequence at which the comment is.
    here: Span,
    /// The whole file, if the comment is above the form's first line.
    whole: Option<Span>,
}

/// The form's first line that is neither blank nor a comment. The comments above this line are the head of the form.
fn head(items: &[Head]) -> Option<Span> {
    items.iter().find_map(|item| match item {
        Head::Blank(_) => None,
        Head::Format { line, .. } | Head::StrayEnd(line) => Some(line.span),
        Head::Statement(statement) => Some(statement.line.span),
        Head::Sequence(node) => Some(node.span()),
    })
}

/// All comments that begin with `#`. Each comment is listed with its location and the range to which the comment
/// applies.
fn comments(items: &[Head]) -> Vec<(Span, Span)> {
    let mut found = Vec::new();
    let mut waiting: Vec<Span> = Vec::new();
    let mut visit = |line: &Line, whole: Option<Span>, found: &mut Vec<(Span, Span)>| {
        let place = whole.unwrap_or(line.span);
        match (whole, &line.tail) {
            (None, Tail::Comment(comment)) => waiting.push(*comment),
            (None, _) => {}
            (Some(_), tail) => {
                found.extend(waiting.drain(..).map(|comment| (comment, place)));
                if let Tail::Comment(comment) = tail {
                    found.push((*comment, line.span));
                }
            }
        }
    };
    // an indented line is a comment; a comment that looks like words may itself have a finding
    let own = |line: &Line| matches!(line.tail, Tail::Lost(_)).then_some(line.span);
    for item in items {
        match item {
            Head::Blank(line) => visit(line, own(line), &mut found),
            Head::Format { line, .. } | Head::StrayEnd(line) => visit(line, Some(line.span), &mut found),
            Head::Statement(statement) => visit(&statement.line, Some(statement.line.span), &mut found),
            Head::Sequence(node) => {
                let line = &node.name.line;
                visit(line, Some(node.span()), &mut found);
                for body in &node.body {
                    let whole = if body.words.is_empty() { own(&body.line) } else { Some(body.line.span) };
                    visit(&body.line, whole, &mut found);
                }
                if let Some(end) = &node.end {
                    visit(&end.line, Some(end.line.span), &mut found);
                }
            }
        }
    }
    found.extend(waiting.into_iter().map(|comment| (comment, comment)));
    found
}

/// Reads one comment. Comments that are not for postform are ignored.
fn read(source: &Source, comment: Span, ranges: Ranges, allows: &mut Vec<Allow>, wrong: &mut Vec<Diag>) {
    let text = source.slice(comment);
    let body = text.trim_start_matches('#').trim_start();
    let starts = |head: &str| body.get(..head.len()).is_some_and(|start| start.eq_ignore_ascii_case(head));
    if !starts("postform:") {
        if starts("postform allow") {
            let help = "write `# postform: allow PF303`, with a colon";
            wrong.push(Diag::new(Code::PF109, "a colon is missing").at(comment, "allows nothing").help(help));
        }
        return;
    }
    let mut at = comment.start as usize + text.len() - body.len() + 9;
    let mut bad = |span: Span, message: String, help: Option<String>| {
        let help = help.unwrap_or_else(|| "write `# postform: allow PF303`".into());
        wrong.push(Diag::new(Code::PF109, message).at(span, "not understood").help(help));
    };
    let mut words = Vec::new();
    for word in body[9..].split([' ', '\t', ',']) {
        if !word.is_empty() {
            words.push((word, Span::new(comment.file, at, at + word.len())));
        }
        at += word.len() + 1;
    }
    let whole_file = words.first().is_some_and(|(verb, _)| verb.eq_ignore_ascii_case("allow-file"));
    let is_verb = |verb: &str| whole_file || verb.eq_ignore_ascii_case("allow");
    match words.split_first() {
        Some(((_, verb), _)) if whole_file && ranges.whole.is_none() => {
            let help = "move it above the first line of the form, or write `allow` to allow findings only here";
            bad(*verb, "`allow-file` must be above the first line of the form".into(), Some(help.into()));
        }
        Some(((verb, _), rest)) if is_verb(verb) && !rest.is_empty() => {
            let range = ranges.whole.filter(|_| whole_file).unwrap_or(ranges.here);
            // a reason may follow the codes
            let is_code = |word: &str| word.get(..2).is_some_and(|head| head.eq_ignore_ascii_case("PF"));
            let told = rest.iter().position(|(word, _)| !is_code(word)).unwrap_or(rest.len()).max(1);
            for (word, span) in &rest[..told] {
                let forms = || CODES.iter().filter(|row| row.name.starts_with("PF"));
                match forms().find(|row| row.name.eq_ignore_ascii_case(word)) {
                    Some(row) => allows.push(Allow { code: row.code, word: *span, range }),
                    None => {
                        // only postform.toml can turn off a whole family of codes
                        let family = word.len() < 5
                            && word.get(2..).is_some_and(|rest| rest.bytes().all(|b| b.is_ascii_digit()));
                        let full = || Some("name each code in full, as PF414".to_owned());
                        let near = || did_you_mean(word, forms().map(|row| row.name));
                        let help = if family { full() } else { near() };
                        bad(*span, format!("`{word}` is not a code of a finding in forms"), help);
                    }
                }
            }
        }
        Some(((verb, span), _)) if !is_verb(verb) => {
            bad(*span, format!("`{verb}` is unknown: a comment can contain only `allow` and `allow-file`"), None);
        }
        _ => bad(comment, "the comment names no code".into(), None),
    }
}
