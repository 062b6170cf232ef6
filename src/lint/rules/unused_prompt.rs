//! PF209: the answer to a prompt is never printed.

use crate::diag::{Code, Diag};
use crate::lang::VarId;
use crate::lint::view::{Purpose, View};

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    let used = |var: VarId| {
        let watched = view.bodies.iter().any(|body| matches!(body.purpose, Purpose::Upon(own, _) if own == var));
        watched || view.tells(var)
    };
    for prompt in view.settings.prompts.iter().filter(|prompt| !used(prompt.var)) {
        diags.push(
            Diag::new(
                Code::PF209,
                format!("the prompt asks for [{}], but the form does not print it", prompt.var.name()),
            )
            .at(prompt.span, "the answer is lost")
            .help(format!("print `[{}]`, or remove the question", prompt.var.name())),
        );
    }
}
