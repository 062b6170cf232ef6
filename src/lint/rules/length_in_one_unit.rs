//! PF717: a number is set to a length property, or compared with it, in a form for both units. The default of the
//! property is converted, but the number is in the units of the program.

use crate::diag::{Code, Diag};
use crate::lang::{UnitChoice, VarId};
use crate::lint::view::View;
use crate::sema::{Formula, PropertyKind, Step, Target};
use crate::span::Span;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    if view.settings.units != UnitChoice::Both {
        return;
    }
    let is_length = |row: u16| {
        let property = view.settings.properties.get(usize::from(row)).filter(|own| own.kind == PropertyKind::Length);
        property.map(|property| property.name.as_str())
    };
    for body in &view.bodies {
        find(body.steps.unwrap_or_default(), &is_length, &mut |name, span| {
            let message = format!("a number beside the length [{name}], in a form for both units");
            diags.push(
                Diag::new(Code::PF717, message)
                    .at(span, "the number is in the units of the program, but the default of the length is in inches")
                    .help("write a second length property instead of the number, or test `@if [unitmode] = mm` around the line"),
            );
        });
    }
}

/// Calls `take` with the name of the property and the location of the directive for each number beside a length.
/// Branches that depend on the units are left out.
fn find<'v>(steps: &[Step], is_length: &dyn Fn(u16) -> Option<&'v str>, take: &mut dyn FnMut(&'v str, Span)) {
    for step in steps {
        match step {
            Step::Set(Target::Property(row), value, span) if is_number(value) => {
                is_length(*row).into_iter().for_each(|name| take(name, *span));
            }
            Step::If(arms) => {
                let conditions = || arms.iter().filter_map(|arm| Some((arm.condition.as_ref()?, arm.span)));
                if conditions().any(|(condition, _)| condition.vars().has(VarId::Unitmode)) {
                    continue;
                }
                for (condition, span) in conditions() {
                    condition.each(&mut |part| {
                        compared(part).and_then(is_length).into_iter().for_each(|name| take(name, span));
                    });
                }
                arms.iter().for_each(|arm| find(&arm.steps, is_length, take));
            }
            Step::For(_, steps, _) => find(steps, is_length, take),
            Step::Lines(_) | Step::Set(..) => {}
        }
    }
}

/// The property that a comparison compares with a number.
fn compared(formula: &Formula) -> Option<u16> {
    let Formula::Compare(_, sides) = formula else { return None };
    match &**sides {
        [Formula::Property(row), other] | [other, Formula::Property(row)] if is_number(other) => Some(*row),
        _ => None,
    }
}

/// Whether a formula is a number. Zero is the same in all units.
fn is_number(formula: &Formula) -> bool {
    match formula {
        Formula::Number(number) => *number != 0.0,
        Formula::Negative(of) => is_number(of),
        _ => false,
    }
}
