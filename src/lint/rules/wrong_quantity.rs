//! PF313: a feed letter that prints a speed, a speed letter that prints a feed: `F[speed]`.

use crate::diag::{Code, Diag};
use crate::lang::{Unit, VarId};
use crate::lint::view::View;
use crate::sema::WordKind;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    let settings = view.settings;
    for word in view.words() {
        let WordKind::Var(letter, var) = word.kind else { continue };
        let unit = var.row().unit;
        let wrong = match letter {
            _ if letter == settings.feed_code => {
                let pitch = matches!(var, VarId::Pitch | VarId::Wirefeed);
                !pitch
                    && matches!(unit, Unit::Speed | Unit::Count | Unit::Code | Unit::Time | Unit::Angle | Unit::Length)
            }
            _ if letter == settings.speed_code => {
                matches!(unit, Unit::Feed | Unit::Length | Unit::Angle | Unit::Time | Unit::Count)
            }
            _ => false,
        };
        if wrong {
            let (what, right) = if letter == settings.feed_code { ("feed", "[frate]") } else { ("speed", "[speed]") };
            diags.push(
                Diag::new(Code::PF313, format!("{} is the {what}, [{}] is none", char::from(letter), var.name()))
                    .at(word.span, "another value than the control expects")
                    .help(format!("write `{}{right}`", char::from(letter))),
            );
        }
    }
}
