//! A library: several posts in one file, each begun by its `Name`.

use super::check::Analysis;
use crate::diag::{Code, Diag};
use crate::lang::CommandId;
use crate::syntax::{Head, Statement};

impl Analysis {
    /// Where the second post begins among the items, which is reported; what is behind it is not looked at.
    pub(super) fn second_post(&mut self, items: &[&Head]) -> Option<usize> {
        let begun = items.iter().enumerate().filter_map(|(at, item)| Some((at, named(item)?)));
        let posts: Vec<(usize, &Statement)> = begun.collect();
        let (&(_, first), &(at, second)) = (posts.first()?, posts.get(1)?);
        let has_sequences = |items: &[&Head]| items.iter().any(|item| matches!(item, Head::Sequence(_)));
        if !has_sequences(&items[..at]) || !has_sequences(&items[at..]) {
            return None; // one post that is named twice
        }
        let names: Vec<String> = posts.iter().map(|(_, post)| format!("`{}`", text(post))).collect();
        self.report(
            Diag::new(Code::PF006, format!("the file holds {} posts: {}", names.len(), names.join(", ")))
                .at(second.line.span, "another post begins here")
                .at(first.line.span, "the first one")
                .help("a form is one post: copy the lines of the one that you want into a file of its own"),
        );
        Some(at)
    }
}

/// The `Name` that begins a post.
fn named(item: &Head) -> Option<&Statement> {
    match item {
        Head::Statement(post) if CommandId::parse(&post.name.text) == Some(CommandId::Name) => Some(post),
        _ => None,
    }
}

fn text(statement: &Statement) -> String {
    statement.args.iter().map(|arg| arg.text.as_str()).collect::<Vec<_>>().join(" ")
}
