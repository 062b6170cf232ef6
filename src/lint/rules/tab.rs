//! PF103: a tab looks like a space but acts like two spaces: the text after it is a comment.

use crate::diag::{Code, Diag};
use crate::lint::view::View;
use crate::span::Span;
use crate::syntax::{PieceKind, Tail};

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for (tree, source) in view.checked.trees.iter().zip(&view.checked.files) {
        if !source.text.contains('\t') {
            continue;
        }
        let args = tree.statements().flat_map(|s| &s.args).map(|arg| arg.span);
        let pieces = tree.words().flat_map(|word| &word.pieces);
        let quotes = pieces.filter(|piece| matches!(piece.kind, PieceKind::Quote(_))).map(|piece| piece.span);
        let mut texts: Vec<Span> = args.chain(quotes).collect();
        texts.sort_by_key(|text| text.start);
        for line in tree.lines() {
            let end = match &line.tail {
                Tail::None => line.span.end,
                Tail::Comment(comment) => comment.start,
                Tail::Lost(lost) => lost.span.start,
            };
            let words = &source.text[line.span.start as usize..end as usize];
            for (at, _) in words.match_indices('\t') {
                let at = line.span.start as usize + at;
                let span = Span::new(line.span.file, at, at + 1);
                let text = texts.partition_point(|text| text.end <= span.start);
                if texts.get(text).is_some_and(|text| text.start <= span.start) {
                    continue; // inside quotes
                }
                diags.push(
                    Diag::new(Code::PF103, "a tab ends the words of its line")
                        .at(span, "here")
                        .help("write spaces: one between words, three before a comment")
                        .fix("replace the tab by three spaces", true, vec![(span, "   ".into())]),
                );
            }
        }
    }
}
