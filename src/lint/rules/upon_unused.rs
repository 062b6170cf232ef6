//! PF210: an Upon sequence prints only before a use of its variable, but the form never uses this variable.

use crate::diag::{Code, Diag};
use crate::lang::VarId;
use crate::lint::view::{Purpose, View};

/// Variables that generated blocks use too.
const GENERATED: &[VarId] = &[
    VarId::H,
    VarId::V,
    VarId::D,
    VarId::H2,
    VarId::V2,
    VarId::Rotangle,
    VarId::Ival,
    VarId::Jval,
    VarId::Kval,
    VarId::Arcrad,
    VarId::Frate,
    VarId::Plunge,
    VarId::Speed,
    VarId::Direct,
    VarId::Cool,
    VarId::Work,
    VarId::Feedtype,
    VarId::Speedtype,
    VarId::Maxrpm,
    VarId::Side,
    VarId::Dcomp,
    VarId::Dwell,
    VarId::Invtime,
];

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for body in &view.bodies {
        let Purpose::Upon(var, _) = body.purpose else { continue };
        let others = view.bodies.iter().filter(|other| other.purpose != body.purpose);
        if GENERATED.contains(&var) || others.flat_map(|other| other.words()).any(|word| word.printed_vars().has(var)) {
            continue;
        }
        diags.push(
            Diag::new(Code::PF210, format!("nothing uses [{}]", var.name()))
                .at(body.span, "this Upon is never printed")
                .help(format!(
                    "print [{}] in the sequence before which this Upon must be printed, or remove the Upon",
                    var.name()
                )),
        );
    }
}
