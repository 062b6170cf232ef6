//! PF304: a lower-case letter is printed in lower case, unless `Rename` changes it.

use crate::diag::{Code, Diag};
use crate::lint::view::View;
use crate::span::Span;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    if view.traits().small_letters {
        return; // the control accepts lower case too
    }
    for word in view.words() {
        let Some(letter) = word.letter().filter(u8::is_ascii_lowercase) else { continue };
        if view.letters[letter].printed != letter || view.letters[letter].dummy {
            continue;
        }
        let (small, capital) = (char::from(letter), char::from(letter.to_ascii_uppercase()));
        let first = Span { end: word.span.start + 1, ..word.span };
        let diag = Diag::new(Code::PF304, format!("`{small}` is printed as a small letter"))
            .at(word.span, "the control may refuse a small letter");
        diags.push(match view.format_letter(word) == Some(letter) {
            // the lower-case letter has its own format; the capital letter would use another format
            true => diag.help(format!("add `Rename {small} {capital}`")),
            false => diag.help(format!("write `{capital}`")).fix(
                "write the capital",
                false,
                vec![(first, capital.to_string())],
            ),
        });
    }
}
