//! PF716: text in backquotes contains the name of a variable in brackets, which is printed as text.

use crate::diag::{Code, Diag};
use crate::lang::{TextVar, VarId};
use crate::lint::view::View;
use crate::sema::WordKind;

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for word in view.bodies.iter().flat_map(|body| body.words()) {
        let WordKind::Quote(text) = &word.kind else { continue };
        let Some(name) = names(text).find(|name| is_variable(name, view)) else { continue };
        diags.push(
            Diag::new(Code::PF716, format!("[{name}] in backquotes is printed as text"))
                .at(word.span, "text in backquotes is printed unchanged")
                .help(format!("end the backquotes before it, and begin them again after it: `` `..`[{name}]`..` ``")),
        );
    }
}

/// The texts between brackets.
fn names(text: &str) -> impl Iterator<Item = &str> {
    text.split(['[', '<']).skip(1).filter_map(|rest| rest.split_once([']', '>'])).map(|(name, _)| name.trim())
}

fn is_variable(name: &str, view: &View) -> bool {
    let own = view.settings.properties.iter().any(|property| property.name.eq_ignore_ascii_case(name));
    own || VarId::parse(name).is_some() || TextVar::parse(name).is_some()
}
