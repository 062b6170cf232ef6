//! PF101: words behind two blanks or a tab are a comment, which looks like output and prints nothing.

use std::collections::HashSet;

use crate::diag::{Code, Diag};
use crate::lint::tokens::looks_like_a_word;
use crate::lint::view::View;
use crate::span::Span;
use crate::syntax::{Line, Tail};

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for (tree, source) in view.checked.trees.iter().zip(&view.checked.files) {
        let remarks: HashSet<Span> = tree.sequences().map(|node| node.name.line.span).collect();
        for line in tree.lines() {
            if !remarks.contains(&line.span) {
                look(line, &source.text, diags);
            }
        }
    }
}

fn look(line: &Line, text: &str, diags: &mut Vec<Diag>) {
    let Tail::Lost(lost) = &line.tail else { return };
    if !lost.text.split([' ', '\t']).any(looks_like_a_word) {
        return;
    }
    let before = text[line.span.start as usize..lost.span.start as usize].trim_end();
    let gap = Span { start: line.span.start + before.len() as u32, end: lost.span.start, ..lost.span };
    let words = lost.text.trim_end();
    let prints = match before.trim() {
        "" => "the line prints nothing".to_owned(),
        words => format!("only `{words}` is output"),
    };
    let joined = format!("{} {}", before.trim(), words);
    let fix = if before.trim().is_empty() { "" } else { " " };
    diags.push(
        Diag::new(Code::PF101, format!("`{words}` is lost: {prints}"))
            .at(lost.span, "two blanks or a tab before this make it a comment")
            .help(format!("write `{}`, or begin the comment with `#`", joined.trim()))
            .fix("join the words by one blank", false, vec![(gap, fix.to_owned())]),
    );
}
