//! Libraries: files with several posts. Each post begins with its `Name`.

use super::check::Analysis;
use crate::diag::{Code, Diag};
use crate::lang::CommandId;
use crate::source::Source;
use crate::syntax::{self, Head, Statement};

impl Analysis {
    /// The index of the item at which a second post begins. Reports this post as an error. The items after the start of
    /// the second post are not analysed.
    pub(super) fn second_post(&mut self, items: &[&Head]) -> Option<usize> {
        let begun = items.iter().enumerate().filter_map(|(at, item)| Some((at, named(item)?)));
        let posts: Vec<(usize, &Statement)> = begun.collect();
        let (&(_, first), &(at, second)) = (posts.first()?, posts.get(1)?);
        let has_sequences = |items: &[&Head]| items.iter().any(|item| matches!(item, Head::Sequence(_)));
        if !has_sequences(&items[..at]) || !has_sequences(&items[at..]) {
            return None; // a single post with two names
        }
        let names: Vec<String> = posts.iter().map(|(_, post)| post.argument()).collect();
        let quoted: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
        self.report(
            Diag::new(Code::PF006, format!("the file contains {} posts: {}", names.len(), quoted.join(", ")))
                .at(second.line.span, "another post begins here")
                .at(first.line.span, "the first one")
                .help(format!("choose one with `--post \"{}\"`, or copy its lines into a separate file", names[0])),
        );
        Some(at)
    }
}

/// The `Name` statement that begins a post.
fn named(item: &Head) -> Option<&Statement> {
    match item {
        Head::Statement(post) if CommandId::parse(&post.name.text) == Some(CommandId::Name) => Some(post),
        _ => None,
    }
}

/// Extracts one post of a file by its name; upper and lower case are equal. The lines of the other posts become empty, so line
/// numbers do not change.
///
/// # Errors
/// The file has no post with this name. The error lists the names of the posts in the file.
pub fn one_post(file: Source, name: &str) -> Result<Source, Vec<String>> {
    let tree = syntax::parse(&file, 0);
    let posts: Vec<(String, usize)> = tree
        .items
        .iter()
        .filter_map(|item| named(item))
        .map(|post| (post.argument(), post.line.span.start as usize))
        .collect();
    let Some(row) = posts.iter().position(|(own, _)| own.eq_ignore_ascii_case(name)) else {
        return Err(posts.into_iter().map(|(name, _)| name).collect());
    };
    // text before the first `Name` belongs to the first post
    let begin = if row == 0 { 0 } else { posts[row].1 };
    let end = posts.get(row + 1).map_or(file.text.len(), |(_, start)| *start);
    let kept = |(at, c): (usize, char)| if (begin..end).contains(&at) || c == '\n' { Some(c) } else { None };
    let text: String = file.text.char_indices().filter_map(kept).collect();
    Ok(Source::from_text(file.name, text))
}
