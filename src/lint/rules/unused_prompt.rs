//! PF209: a question whose answer is printed nowhere.

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
            Diag::new(Code::PF209, format!("[{}] is asked for and printed nowhere", prompt.var.name()))
                .at(prompt.span, "the answer is lost")
                .help(format!("print `[{}]` where it belongs, or take the question out", prompt.var.name())),
        );
    }
}
