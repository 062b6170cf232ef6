//! PF308: arc centres have fewer decimals than positions, so the start and end of an arc have different radii.

use crate::diag::{Code, Diag};
use crate::lint::view::View;
use crate::sema::ArcCentre;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    let settings = view.settings;
    let letters = match &settings.centre {
        ArcCentre::Letters(letters) => letters.clone(),
        ArcCentre::Radius(letter) => vec![*letter],
    };
    let finest = settings.axes.iter().filter_map(|axis| view.form.formats.get(axis)).map(|row| row.0.dec.count).max();
    for letter in letters {
        let (Some((format, span)), Some(finest)) = (view.form.formats.get(&letter), finest) else { continue };
        if format.dec.count < finest {
            let name = char::from(letter);
            diags.push(
                Diag::new(Code::PF308, format!("{name} has {} decimals, positions have {finest}", format.dec.count))
                    .at(*span, "the control may stop with an alarm at an arc")
                    .help(format!("give {name} {finest} decimals, too")),
            );
        }
    }
}
