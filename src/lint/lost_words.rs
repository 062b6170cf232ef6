//! PF101: words behind two blanks or a tab are a comment, which looks like output and prints nothing.

use crate::diag::{Code, Diag};
use crate::sema::Checked;
use crate::span::Span;
use crate::syntax::{Head, Line, Tail};

pub fn check(checked: &Checked, diags: &mut Vec<Diag>) {
    for (tree, source) in checked.trees.iter().zip(&checked.files) {
        for item in &tree.items {
            match item {
                Head::Blank(line) | Head::Format { line, .. } => look(line, &source.text, diags),
                Head::Statement(statement) => look(&statement.line, &source.text, diags),
                Head::Sequence(node) => {
                    for body in &node.body {
                        look(&body.line, &source.text, diags);
                    }
                }
                Head::StrayEnd(_) => {}
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

/// `X[h]`, `<work>`, `M6`, `G0`: what NC output is made of. A remark is not.
fn looks_like_a_word(token: &str) -> bool {
    if (token.contains('[') && token.contains(']')) || (token.contains('<') && token.contains('>')) {
        return true;
    }
    let Some(number) = token.strip_prefix(|c: char| c.is_ascii_uppercase()) else { return false };
    number.bytes().all(|b| b.is_ascii_digit() || b"+-.".contains(&b)) && number.bytes().any(|b| b.is_ascii_digit())
}
