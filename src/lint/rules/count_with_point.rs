//! PF318: an integer is printed with a decimal point, as `M98 P1.`, `H3.` or `S3000.`. Controls refuse the decimal point
//! or read another number.

use crate::diag::{Code, Diag};
use crate::lang::{Machine, Unit};
use crate::lint::view::View;
use crate::number::Point;
use crate::sema::WordKind;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    formats(view, diags);
    typed(view, diags);
}

/// Whether the form's control takes only numbers without a decimal point after this letter.
fn takes_no_point(view: &View, letter: u8) -> bool {
    let control = match view.settings.machine {
        Machine::Mill => view.settings.control(),
        Machine::Lathe => view.settings.control().of_lathe(),
        Machine::Edm => view.settings.control().of_wire(),
    };
    control.traits().no_point.has(view.letters[letter].printed)
}

/// Words that the form contains with their number, such as `S3000.`.
fn typed(view: &View, diags: &mut Vec<Diag>) {
    for word in view.words() {
        let WordKind::Literal(letter, text, value) = &word.kind else { continue };
        if !text.contains('.') || !takes_no_point(view, *letter) {
            continue;
        }
        let diag = Diag::new(Code::PF318, format!("`{text}` has a decimal point"))
            .at(word.span, format!("the control takes {} only without a point", char::from(*letter)));
        let whole = text.trim_end_matches('0').trim_end_matches('.');
        let help = if value.fract() == 0.0 { format!("write `{whole}`") } else { "write a whole number".to_owned() };
        diags.push(diag.help(help));
    }
}

/// Letters whose format prints a decimal point.
fn formats(view: &View, diags: &mut Vec<Diag>) {
    for (&letter, (format, span)) in &view.form.formats {
        // another rule reports implied points, and PF310 reports G and M codes
        if format.point != Point::Always || format.dec.count == 0 || b"GM".contains(&letter.to_ascii_uppercase()) {
            continue;
        }
        let no_point = takes_no_point(view, letter);
        let count = |var: crate::lang::VarId| no_point || matches!(var.row().unit, Unit::Count);
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
