//! PF310: a command sets a code that its letter's format can't print.

use crate::diag::{Code, Diag};
use crate::lint::view::View;
use crate::number::Point;
use crate::sema::WordKind;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for word in view.words() {
        let WordKind::Var(letter, var) = word.kind else { continue };
        let format = view.letters[letter].format;
        let bad = view.settings.codes_of(var).into_iter().find(|code| {
            let whole = code.trunc();
            let too_long = whole >= 10f64.powi(i32::from(format.int.count));
            too_long || (code.fract() != 0.0 && (format.dec.count == 0 || format.point == Point::Implied))
        });
        if let Some(code) = bad {
            diags.push(
                Diag::new(Code::PF310, format!("{} can't print {code}", char::from(letter)))
                    .at(word.span, format!("[{}] may be {code}", var.name()))
                    .help("give the letter a format with more digits, as `G >3~>1`"),
            );
        }
    }
}
