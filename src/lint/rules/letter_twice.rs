//! PF506: a block has the same letter twice. Most controls stop with an alarm, and the other controls use only one of
//! the two words. T is allowed twice, for the tool and the preselected tool.

use crate::diag::{Code, Diag};
use crate::lint::view::View;
use crate::sema::Word;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for line in view.bodies.iter().flat_map(|body| body.lines) {
        let printed = |word: &Word| {
            let letter = word.letter().map(|letter| view.letters[letter])?;
            (!letter.dummy && letter.printed.is_ascii_alphabetic() && !b"GgMmT".contains(&letter.printed))
                .then_some(letter.printed)
        };
        let mut firsts: [Option<&Word>; 256] = [None; 256];
        for word in &line.words {
            let Some(letter) = printed(word) else { continue };
            let Some(first) = firsts[usize::from(letter)] else {
                firsts[usize::from(letter)] = Some(word);
                continue;
            };
            diags.push(
                Diag::new(Code::PF506, format!("{} is twice in one block", char::from(letter)))
                    .at(word.span, "again here")
                    .at(first.span, "first here")
                    .help("keep one of them, or print two blocks"),
            );
        }
    }
}
