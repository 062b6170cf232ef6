//! PF101: words after two spaces or a tab look like output, but these words are a comment and are not printed.

use crate::diag::{Code, Diag};
use crate::lang::{CommandId, SequenceId, SequenceName};
use crate::lint::tokens::looks_like_a_word;
use crate::lint::view::View;
use crate::span::Span;
use crate::syntax::{Head, Line, PieceKind, SequenceNode, Tail};

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for (tree, source) in view.checked.trees.iter().zip(&view.checked.files) {
        let text = &source.text;
        for item in &tree.items {
            match item {
                Head::Sequence(node) => sequence(node, text, diags),
                // another letter or number is an additional argument
                Head::Statement(statement) => {
                    let is_argument = |token: &str| token.parse::<f64>().is_ok() || is_letter(token);
                    lost(&statement.line, text, &|token| is_argument(token) || looks_like_a_word(token), diags);
                }
                Head::Blank(line) if begins_as_form(line) => lost(line, text, &|_| true, diags),
                Head::Blank(line) | Head::Format { line, .. } | Head::StrayEnd(line) => {
                    lost(line, text, &looks_like_a_word, diags);
                }
            }
        }
    }
}

fn sequence(node: &SequenceNode, text: &str, diags: &mut Vec<Diag>) {
    // a comment may follow a name, but a number alone is the count of a cycle
    let is_cycle = SequenceId::parse(&node.name.name.text).is_some_and(SequenceId::makes_holes);
    if is_cycle && node.name.args.is_empty() && count_is_lost(&node.name.line, text) {
        lost(&node.name.line, text, &|token| token.bytes().all(|b| b.is_ascii_digit()), diags);
    }
    for body in &node.body {
        let last = body.words.last().and_then(|word| word.pieces.last());
        match (&body.line.tail, last.map(|piece| &piece.kind)) {
            (Tail::Comment(comment), Some(PieceKind::Note { closed: false, .. })) => bracketed(*comment, text, diags),
            // if the bracket of a comment is not closed, any lost text may be the rest of that comment
            (_, Some(PieceKind::Note { closed: false, .. })) => lost(&body.line, text, &|_| true, diags),
            (Tail::Comment(comment), _) if body.words.is_empty() => macro_line(*comment, text, diags),
            _ if body.words.is_empty() && begins_as_form(&body.line) => lost(&body.line, text, &|_| true, diags),
            _ => lost(&body.line, text, &looks_like_a_word, diags),
        }
    }
    if let Some(end) = &node.end {
        lost(&end.line, text, &|token| token.eq_ignore_ascii_case("Cancel"), diags);
    }
}

/// Whether the lost text begins with a command, a number format, the name of a sequence or `End`.
fn begins_as_form(line: &Line) -> bool {
    let Tail::Lost(lost) = &line.tail else { return false };
    let words: Vec<&str> = lost.text.split_whitespace().collect();
    let Some(first) = words.first() else { return false };
    let mut chars = lost.text.trim().chars();
    let is_format = chars.next().is_some_and(|c| c.is_ascii_alphabetic())
        && ["->", ">"].iter().any(|mark| chars.as_str().trim_start().starts_with(mark));
    is_format
        || first.eq_ignore_ascii_case("End")
        || CommandId::parse(first).is_some()
        || SequenceName::parse(&words).is_some()
}

/// Whether the lost text is a count. At a location where a comment can begin, only a number alone is a count; at any
/// other location, a number with text after it is a count too.
fn count_is_lost(line: &Line, text: &str) -> bool {
    let Tail::Lost(lost) = &line.tail else { return false };
    let is_number = |token: &str| token.bytes().all(|b| b.is_ascii_digit());
    let before = &text[line.span.start as usize..lost.span.start as usize];
    let mut tokens = lost.text.split_whitespace();
    let near = before.len() - before.trim_end().len() < 3;
    if near { tokens.next().is_some_and(is_number) } else { tokens.all(is_number) }
}

fn is_letter(token: &str) -> bool {
    token.len() == 1 && token.bytes().all(|b| b.is_ascii_uppercase())
}

/// Reports comments like `(P/N #1234)`: the text that begins with `#` is lost, and so is the closing bracket.
fn bracketed(comment: Span, text: &str, diags: &mut Vec<Diag>) {
    let rest = &text[comment.range()];
    if rest.contains(')') {
        diags.push(
            Diag::new(Code::PF101, format!("`{}` is lost from a comment of the program", rest.trim_end()))
                .at(comment, "a `#` begins a comment of the form, also here")
                .help("write something else instead of `#`, as `NO. 1234`"),
        );
    }
}

/// Reports lines like `#101=5`, which are not printed because the `#` begins a comment.
fn macro_line(comment: Span, text: &str, diags: &mut Vec<Diag>) {
    let words = &text[comment.range()];
    let number = words.trim_start_matches('#').split('=').next().unwrap_or("").trim_end();
    if words.contains('=') && !number.is_empty() && number.bytes().all(|b| b.is_ascii_digit()) {
        let words = words.trim_end();
        let whole = Span { end: comment.start + words.len() as u32, ..comment };
        diags.push(
            Diag::new(Code::PF101, format!("`{words}` is lost: the line prints nothing"))
                .at(comment, "a `#` begins a comment")
                .help(format!("put text of the control in backquotes: `` `{words}` ``"))
                .fix("put it in backquotes", false, vec![(whole, format!("`{words}`"))]),
        );
    }
}

fn lost(line: &Line, text: &str, is_word: &dyn Fn(&str) -> bool, diags: &mut Vec<Diag>) {
    let Tail::Lost(lost) = &line.tail else { return };
    let mut tokens = lost.text.split([' ', '\t']).filter(|token| !token.is_empty());
    if !tokens.clone().any(is_word) {
        return;
    }
    let before = text[line.span.start as usize..lost.span.start as usize].trim_end();
    let gap = Span { start: line.span.start + before.len() as u32, end: lost.span.start, ..lost.span };
    let words = lost.text.trim_end();
    let prints = match before.trim() {
        "" => "the line has no effect".to_owned(),
        words => format!("only `{words}` is printed"),
    };
    let joined = [before, words].join(" ").split_whitespace().collect::<Vec<_>>().join(" ");
    let help = match before.trim() {
        "" => {
            format!("begin the line with `{joined}`, without blanks before it; if it is a comment, begin it with `#`")
        }
        _ => format!("write `{joined}`, or begin the comment with `#`"),
    };
    let diag = Diag::new(Code::PF101, format!("`{words}` is lost: {prints}"))
        .at(lost.span, "two spaces or a tab before this text make it a comment")
        .help(help);
    // a sentence is a comment, even if some of its words look like output
    let fix = if before.trim().is_empty() { "" } else { " " };
    diags.push(match tokens.all(is_word) {
        true => diag.fix("join the words by one space", false, vec![(gap, fix.to_owned())]),
        false => diag,
    });
}
