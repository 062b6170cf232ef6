//! PF303: a letter has no format, so its values are printed in a built-in format. Each letter is reported once.

use crate::diag::{Code, Diag};
use crate::lint::view::View;
use crate::sema::WordKind;

/// Letters of codes and counts, which have the same format on all controls. These letters need no format.
const PLAIN: &[u8] = b"GMTNOHDLSP:%";

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    let form = view.form;
    let mut seen = Vec::new();
    for word in view.words() {
        let WordKind::Var(letter, _) = word.kind else { continue };
        let capital = letter.to_ascii_uppercase();
        let has = |l: u8| form.formats.contains_key(&l) || form.packed.contains_key(&l);
        if has(letter) || has(capital) || PLAIN.contains(&capital) || seen.contains(&letter) {
            continue;
        }
        seen.push(letter);
        let letter_name = char::from(letter);
        let format = view.letters[letter].format;
        diags.push(
            Diag::new(Code::PF303, format!("{letter_name} has no format and prints as `{letter_name}{format}`"))
                .at(word.span, "first printed here")
                .help(format!("add the line `{letter_name}{format}` to confirm this format")),
        );
    }
}
