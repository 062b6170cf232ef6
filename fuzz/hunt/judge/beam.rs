//! A torch or a laser. Checks the cuts in X and Y with the beam on, and that the beam is off elsewhere. Heights are
//! ignored.

use super::{Act, Wanted, What};

/// The acts of a program in X and Y; moves along Z alone are left out.
pub fn flat(acts: Vec<Act>) -> Vec<Act> {
    let mut list: Vec<Act> = Vec::new();
    let mut at = [f64::NAN, f64::NAN, 0.0, 0.0, 0.0, 0.0];
    for mut act in acts {
        let moves = matches!(act.what, What::Rapid | What::Feed | What::Arc { .. });
        act.from = at;
        act.to[2] = 0.0;
        if moves && !matches!(act.what, What::Arc { .. }) && act.to[..2] == at[..2] {
            continue;
        }
        at = act.to;
        list.push(act);
    }
    list
}

/// The requests of a job in X and Y; the form defines tool, spindle and coolant.
pub fn across(mut wants: Vec<Wanted>) -> Vec<Wanted> {
    for wanted in &mut wants {
        (wanted.from[2], wanted.to[2]) = (0.0, 0.0);
        (wanted.tool, wanted.length, wanted.coolant) = (0.0, f64::NAN, None);
        (wanted.spindle, wanted.low) = ((f64::NAN, f64::NAN), f64::NEG_INFINITY);
    }
    wants.retain(|wanted| !matches!(wanted.want, super::Want::Line) || wanted.from[..2] != wanted.to[..2]);
    wants
}

/// The first cut with the beam off, or the first rapid with the beam on. Grbl turns off a laser in rapids by itself.
pub fn switched_wrongly(acts: &[Act], is_laser: bool) -> Option<String> {
    acts.iter().find_map(|act| {
        let on = act.state.direction != 5.0 && (!is_laser || act.state.speed > 0.0);
        match act.what {
            What::Feed | What::Arc { .. } if !on => Some(format!("line {}: off in a cut", act.line)),
            What::Rapid if on && !is_laser => Some(format!("line {}: on in a rapid", act.line)),
            _ => None,
        }
    })
}
