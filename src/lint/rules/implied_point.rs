//! PF307: a letter with an implied point prints 12 as 120000, which is correct for a length, but wrong for a count.

use crate::diag::{Code, Diag};
use crate::lang::Unit;
use crate::lint::view::View;
use crate::sema::Word;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for (&letter, (format, span)) in &view.form.formats {
        if !format.is_implied() {
            continue;
        }
        let own = |word: &&Word| view.format_letter(word) == Some(letter);
        let is_count = |word: &&Word| {
            word.printed_var().is_some_and(|var| matches!(var.row().unit, Unit::Count | Unit::Code | Unit::Time))
        };
        let count = view.words().filter(own).find(is_count);
        let other = view.words().filter(own).find(|word| word.printed_var().is_some() && !is_count(word));
        let (Some(count), Some(other)) = (count, other) else { continue };
        let name = char::from(letter);
        let small = name.to_ascii_lowercase();
        let digits = format!("1{}", "0".repeat(usize::from(format.dec.count)));
        diags.push(
            Diag::new(Code::PF307, format!("{name} prints 1 as {digits}"))
                .at(count.span, "whole numbers belong here")
                .at(other.span, "and lengths here")
                .at(*span, "by one format")
                .help(format!("print one of them as `{small}`, with a format of its own and `Rename {small} {name}`")),
        );
    }
}
