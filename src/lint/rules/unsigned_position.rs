//! PF305: the format of a position has no sign, but positions may be negative.

use crate::diag::{Code, Diag};
use crate::lang::VarId;
use crate::lint::view::View;
use crate::number::Sign;
use crate::sema::{ArcCentre, Word};

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    use VarId as V;
    let signed = [
        V::H,
        V::V,
        V::D,
        V::H2,
        V::V2,
        V::Hdist,
        V::Vdist,
        V::Ddist,
        V::Lasth,
        V::Lastv,
        V::Lastd,
        V::Ival,
        V::Jval,
        V::Kval,
        V::Rplane,
        V::Vclear,
        V::Rotangle,
        V::Lastrotangle,
    ];
    let turns = view.printed().has(V::Rotangle);
    for (&letter, (format, span)) in &view.form.formats {
        let centre = matches!(&view.settings.centre, ArcCentre::Letters(letters) if letters.contains(&letter));
        let generated = view.settings.axes.contains(&letter) || centre || (turns && view.is_rotary(letter));
        let prints = |word: &Word| {
            view.format_letter(word) == Some(letter) && word.printed_var().is_some_and(|var| signed.contains(&var))
        };
        if format.sign != Sign::Unsigned || !(generated || view.words().any(prints)) {
            continue;
        }
        let name = char::from(letter);
        let digits = format.to_string();
        let digits = digits.trim_start();
        let better = format!("{name}-{digits}");
        // if the format has an exact number of digits, also suggest a format with a maximum number of digits
        let wider = if digits.contains('>') {
            String::new()
        } else {
            format!("; `{name}->4.>4` has up to four digits before the point, and four after it")
        };
        diags.push(
            Diag::new(Code::PF305, format!("{name} prints positions, but its format has no sign"))
                .at(*span, "a negative position would be an error")
                .help(format!("write `{better}`{wider}"))
                .fix("let the format print a minus", false, vec![(*span, better)]),
        );
    }
}
