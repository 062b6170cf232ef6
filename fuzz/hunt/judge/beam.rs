//! A torch or a laser: what is cut across, with the beam on, and that it is off elsewhere. Heights count for nothing.

use super::{Act, Wanted, What};

/// What a program does across X and Y: moves along Z alone are left out.
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

/// What a job wants across: tool, spindle and coolant are the form's own.
pub fn across(mut wants: Vec<Wanted>) -> Vec<Wanted> {
    for wanted in &mut wants {
        (wanted.from[2], wanted.to[2]) = (0.0, 0.0);
        (wanted.tool, wanted.length, wanted.coolant) = (0.0, f64::NAN, None);
        (wanted.spindle, wanted.low) = ((f64::NAN, f64::NAN), f64::NEG_INFINITY);
    }
    wants.retain(|wanted| !matches!(wanted.want, super::Want::Line) || wanted.from[..2] != wanted.to[..2]);
    wants
}

/// Where the beam is off in a cut, or on in a rapid. Grbl turns a laser off in rapids by itself.
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
