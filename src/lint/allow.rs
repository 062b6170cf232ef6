//! Suppression in the form: `# postform: allow PF103`, at the end of a line, above a line, or above a sequence.

use crate::diag::{CODES, Code, Diag, Severity};
use crate::lang::did_you_mean;
use crate::sema::Checked;
use crate::source::Source;
use crate::span::Span;
use crate::syntax::{Head, Line, Tail};

use super::{Levels, stops_printing};

/// A comment that allows findings.
struct Allow {
    /// Each code with its place.
    codes: Vec<(Code, Span, bool)>,
    /// Where findings are allowed.
    range: Span,
}

/// Takes out the findings that comments allow, and adds what is wrong with the comments. Returns how many were taken.
pub fn take_allowed(checked: &Checked, levels: &Levels, diags: &mut Vec<Diag>) -> usize {
    let mut allows = Vec::new();
    let mut wrong = Vec::new();
    for (tree, source) in checked.trees.iter().zip(&checked.files) {
        for (comment, range) in comments(&tree.items) {
            read(source, comment, range, &mut allows, &mut wrong);
        }
    }
    let before = diags.len();
    diags.retain(|diag| {
        let Some(at) = diag.labels.first().map(|label| label.span) else { return true };
        // what can't be printed can't be allowed, whatever a comment says
        if stops_printing(diag) {
            return true;
        }
        let mut allowed = false;
        for allow in &mut allows {
            let here = allow.range.file == at.file && (allow.range.start..=allow.range.end).contains(&at.start);
            for (_, _, used) in allow.codes.iter_mut().filter(|(code, ..)| here && *code == diag.code) {
                (*used, allowed) = (true, true);
            }
        }
        !allowed
    });
    let taken = before - diags.len();
    if levels.shows(Code::PF108) {
        let unused =
            allows.iter().flat_map(|allow| &allow.codes).filter(|(code, _, used)| !used && levels.shows(*code));
        wrong.extend(unused.map(|(code, span, _)| {
            let help = if is_error(*code) {
                "an error can't be allowed: mend it"
            } else {
                "take it out, so that it does not hide the next one"
            };
            Diag::new(Code::PF108, format!("nothing here is allowed by `{}`", code.name()))
                .at(*span, "no such finding")
                .help(help)
        }));
    }
    wrong.retain_mut(|diag| levels.apply(diag));
    diags.extend(wrong);
    taken
}

/// Does the form not print while this is found?
fn is_error(code: Code) -> bool {
    code.row().severity == Severity::Error
}

/// All comments that begin with `#`, each with the place that it speaks of: its own line, else what comes after it.
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
    // an indented line is a comment that may look like words, and have a finding
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

/// Reads one comment, if it is for postform.
fn read(source: &Source, comment: Span, range: Span, allows: &mut Vec<Allow>, wrong: &mut Vec<Diag>) {
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
    let mut codes = Vec::new();
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
    match words.split_first() {
        Some(((verb, _), rest)) if verb.eq_ignore_ascii_case("allow") && !rest.is_empty() => {
            // behind the codes a reason may stand
            let is_code = |word: &str| word.get(..2).is_some_and(|head| head.eq_ignore_ascii_case("PF"));
            let told = rest.iter().position(|(word, _)| !is_code(word)).unwrap_or(rest.len()).max(1);
            for (word, span) in &rest[..told] {
                let forms = || CODES.iter().filter(|row| row.name.starts_with("PF"));
                match forms().find(|row| row.name.eq_ignore_ascii_case(word)) {
                    Some(row) => codes.push((row.code, *span, false)),
                    None => {
                        // a family can be turned off in postform.toml only
                        let family = word.len() < 5
                            && word.get(2..).is_some_and(|rest| rest.bytes().all(|b| b.is_ascii_digit()));
                        let full = || Some("name each code in full, as PF414".to_owned());
                        let near = || did_you_mean(word, forms().map(|row| row.name));
                        let help = if family { full() } else { near() };
                        bad(*span, format!("`{word}` is no code of a form's findings"), help);
                    }
                }
            }
        }
        Some(((verb, span), _)) if !verb.eq_ignore_ascii_case("allow") => {
            bad(*span, format!("`{verb}` is nothing that a comment can ask for"), None);
        }
        _ => bad(comment, "the comment does not say what it allows".into(), None),
    }
    allows.push(Allow { codes, range });
}
