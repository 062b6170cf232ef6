//! PF318: an integer is printed with a decimal point, as `M98 P1.` or `H3.`. Controls refuse the decimal point or read
//! another number.

use crate::diag::{Code, Diag};
use crate::lang::Unit;
use crate::lint::view::View;
use crate::number::Point;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for (&letter, (format, span)) in &view.form.formats {
        // another rule reports implied points, and PF310 reports G and M codes
        if format.point != Point::Always || format.dec.count == 0 || b"GM".contains(&letter.to_ascii_uppercase()) {
            continue;
        }
        let count = |var: crate::lang::VarId| matches!(var.row().unit, Unit::Count);
        let mut own = view.words().filter(|word| view.format_letter(word) == Some(letter));
        if let Some(word) = own.find(|word| word.letter().is_some() && word.printed_var().is_some_and(count)) {
            let (name, small) = (char::from(letter), char::from(letter).to_ascii_lowercase());
            let digits = format.int.count.max(2);
            let others = view.words().filter(|word| view.format_letter(word) == Some(letter));
            let others = others.filter_map(|word| word.printed_var()).any(|var| !count(var));
            let dwells = letter == view.settings.dwell.letter && !view.settings.dwell.milliseconds;
            let help = match (others || dwells) && small != name {
                true => format!("print it as `{small}`, with `{small} >{digits}` and `Rename {small} {name}`"),
                false => format!("write `{name} >{digits}`"),
            };
            diags.push(
                Diag::new(Code::PF318, format!("{name} prints 1 as `{name}1.`"))
                    .at(word.span, "a whole number belongs here")
                    .at(*span, "by this format")
                    .help(help),
            );
        }
    }
}
