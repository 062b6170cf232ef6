//! PF718: a comment in a list is left out for items that do not have its text, so these items are missing from the list.

use crate::diag::{Code, Diag};
use crate::lint::view::View;
use crate::sema::{Line, Step, WordKind};

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for body in &view.bodies {
        body.each_list(&mut |each, steps, _| {
            let own = steps.iter().filter_map(|step| match step {
                Step::Lines(lines) => Some(&body.lines[lines.clone()]),
                _ => None,
            });
            own.flatten().for_each(|line| comment(line, each.name(), diags));
        });
    }
}

/// Reports a line whose only words are a comment with values and texts. The comment is left out without the texts.
fn comment(line: &Line, each: &str, diags: &mut Vec<Diag>) {
    let Some(WordKind::Comment(words)) = line.words.first().map(|word| &word.kind) else { return };
    let has_values =
        line.words.iter().any(|word| matches!(word.kind, WordKind::Remark(_) | WordKind::RemarkFormula(_)));
    let mut texts = line.words.iter().filter_map(|word| match &word.kind {
        WordKind::RemarkText(text) => Some((word.span, text.id.row().name)),
        _ => None,
    });
    let (Some((span, name)), true, true) = (texts.next(), has_values, line.words.len() == words + 1) else { return };
    diags.push(
        Diag::new(Code::PF718, format!("the list leaves out each {each} without a text"))
            .at(span, "if the texts of a comment are empty, the comment is not printed")
            .help(format!(
                "print a second line without the text: `@if [{name}]` before this line, and `@else` after it"
            )),
    );
}
