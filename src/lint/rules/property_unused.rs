//! PF710: the form declares a property but never uses it, so its value has no effect.

use crate::diag::{Code, Diag};
use crate::lint::view::View;
use crate::sema::{Formula, WordKind, each_formula};

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    let properties = &view.settings.properties;
    if properties.is_empty() {
        return;
    }
    let mut asked = vec![false; properties.len()];
    let mut of = |formula: &Formula| {
        formula.each(&mut |part| {
            if let Formula::Property(row) | Formula::PropertyText(row) | Formula::PropertyHolds(row) = part {
                asked[usize::from(*row)] = true;
            }
        });
    };
    let mut printed = Vec::new();
    for body in &view.bodies {
        each_formula(body.steps.unwrap_or_default(), &mut |formula, _| of(formula));
        for word in body.words() {
            match &word.kind {
                WordKind::Formula(_, formula) | WordKind::RemarkFormula(formula) => of(formula),
                WordKind::PropertyText(row) | WordKind::RemarkProperty(row) => printed.push(usize::from(*row)),
                _ => {}
            }
        }
    }
    printed.into_iter().for_each(|row| asked[row] = true);
    for (property, _) in properties.iter().zip(asked).filter(|(property, asked)| !asked && property.of_tool().is_none())
    {
        diags.push(
            Diag::new(Code::PF710, format!("the property {} does nothing", property.name))
                .at(property.span, "no line uses it")
                .help(format!("use the property, as `@if [{}]`, or remove it", property.name)),
        );
    }
}
