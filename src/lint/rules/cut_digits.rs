//! PF306: a letter format rounds away digits that the machine can use.

use crate::diag::{Code, Diag};
use crate::lang::{Machine, SequenceId, Unit, VarId};
use crate::lint::view::View;
use crate::number::{Digits, LetterFormat, Point};
use crate::sema::Word;

use super::dwell_unit::wrong_unit;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    // PF311 reports a dwell in the unit of another control; in milliseconds, the dwell needs no decimals
    let seconds = !view.settings.dwell.milliseconds && wrong_unit(view).is_none();
    for (&letter, (format, span)) in &view.form.formats {
        let printed =
            view.words().filter(|word| view.format_letter(word) == Some(letter)).filter_map(Word::printed_var);
        let wanted = printed.map(|var| (needed(view, var, seconds), var)).max_by_key(|(decimals, _)| *decimals);
        let (wanted, what) = match wanted {
            Some((decimals, var)) => (decimals, format!("[{}]", var.name())),
            None => (0, String::new()),
        };
        let axis = view.settings.axes.contains(&letter) && view.settings.machine != Machine::Edm;
        let (wanted, what) = match axis && wanted < length(view) {
            true => (length(view), "a position".to_owned()),
            false => (wanted, what),
        };
        // a generated dwell block uses the letter of the command `Dwell`; DwellBlock replaces this block
        let dwell = &view.settings.dwell;
        let generated = view.body(SequenceId::DwellBlock).is_none();
        let dwells = letter == dwell.letter && seconds && generated && wanted < 2;
        let (wanted, what) = if dwells { (2, "a dwell in seconds".to_owned()) } else { (wanted, what) };
        if format.dec.count >= wanted {
            continue;
        }
        let name = char::from(letter);
        let decimals = format.dec.count;
        // a format without decimals had no decimal point, so its setting for the point is not kept
        let point = if decimals == 0 { Point::Always } else { format.point };
        let fixed = decimals > 0 && format.dec.fixed;
        let better = LetterFormat { dec: Digits { count: wanted, fixed }, point, ..*format };
        let counts = counts(view, letter);
        let digits = format.int.count;
        let help = match (counts, name.to_ascii_lowercase()) {
            // the command `Dwell` determines the letter of dwells, so the other words must use another letter
            (true, small) if small != name && dwells => {
                format!(
                    "write `{name}{better}`; print whole numbers as `{small}`, with the lines `{small} >{digits}` \
                     and `Rename {small} {name}`"
                )
            }
            (true, small) if small != name => {
                format!(
                    "print it as `{small}`, with `{small}{better}` and `Rename {small} {name}`: whole numbers stay as they are"
                )
            }
            _ => format!("write `{name}{better}`"),
        };
        diags.push(
            Diag::new(Code::PF306, format!("{name} has {decimals} decimals, but {what} needs {wanted}"))
                .at(*span, "the other decimals are lost")
                .help(help),
        );
    }
    built_in(view, seconds, diags);
}

/// Whether the letter also prints counts or codes. A format with decimals would print counts and codes with a point
/// too.
fn counts(view: &View, letter: u8) -> bool {
    let whole = |word: &Word| word.printed_var().is_some_and(|var| matches!(var.row().unit, Unit::Count | Unit::Code));
    letter == view.settings.cdc_code || view.words().filter(|word| view.format_letter(word) == Some(letter)).any(whole)
}

/// Checks letters without a format. The built-in formats of letters that print counts have no decimals.
fn built_in(view: &View, seconds: bool, diags: &mut Vec<Diag>) {
    let mut told = Vec::new();
    for word in view.words() {
        let (Some(letter), Some(var)) = (word.letter(), word.printed_var()) else { continue };
        let (row, wanted) = (view.letters[letter], needed(view, var, seconds));
        let decimals = row.format.dec.count;
        if row.has_format || decimals >= wanted || told.contains(&letter) {
            continue;
        }
        told.push(letter);
        let name = char::from(letter);
        let better = LetterFormat { dec: Digits { count: wanted, fixed: false }, point: Point::Always, ..row.format };
        let what = if decimals == 0 { "whole numbers".to_owned() } else { format!("{decimals} decimals") };
        let message = format!("{name} has no format and prints {what}, but [{}] needs {wanted} decimals", var.name());
        diags.push(
            Diag::new(Code::PF306, message)
                .at(word.span, "the other decimals are lost")
                .help(match (counts(view, letter), name.to_ascii_lowercase()) {
                    (true, small) if small != name => format!(
                        "print it as `{small}`, with `{small}{better}` and `Rename {small} {name}`, or without a letter: `[{}]`; whole \
                         numbers stay as they are",
                        var.name()
                    ),
                    _ => format!("add the line `{name}{better}`"),
                }),
        );
    }
}

/// Number of decimals of a length: four in inches, three in millimetres.
fn length(view: &View) -> u8 {
    if view.is_metric() { 3 } else { 4 }
}

/// Number of decimals that a variable needs. `seconds`: the form prints dwells in seconds.
fn needed(view: &View, var: VarId, seconds: bool) -> u8 {
    match var.row().unit {
        Unit::Length => length(view),
        // all controls use whole numbers for tip angles
        Unit::Angle if var == VarId::Tipang => 0,
        Unit::Angle => 2,
        // a feed per revolution is a chip thickness, so it needs as many decimals as a length
        Unit::Feed if view.settings.machine == Machine::Lathe => length(view),
        Unit::Feed if !view.is_metric() => 1,
        Unit::Time if seconds => 2,
        _ => 0,
    }
}
