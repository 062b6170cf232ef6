//! PF713: `if [tool] = 1` and `val1 = 2` are printed as text. A directive must begin with `@`.

use crate::diag::{Code, Diag};
use crate::lang::VarId;
use crate::lint::view::View;
use crate::sema::{Line, WordKind};

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for line in view.bodies.iter().flat_map(|body| body.lines) {
        let Some(meant) = meant(line, view) else { continue };
        diags.push(
            Diag::new(Code::PF713, "a directive without its `@` is printed as text")
                .at(line.span, "printed as text")
                .help(format!("write `{meant}`; put text of the control in backquotes")),
        );
    }
}

/// The directive that was probably intended.
fn meant(line: &Line, view: &View) -> Option<String> {
    let text = |at: usize| match &line.words.get(at)?.kind {
        WordKind::Text(text) => Some(text.as_str()),
        _ => None,
    };
    let first = text(0)?.to_ascii_lowercase();
    let asks = |kind: &WordKind| matches!(kind, WordKind::Value(_) | WordKind::Formula(None, _) | WordKind::TextVar(_));
    match first.as_str() {
        "if" | "elif" | "elseif" if line.words.iter().any(|word| asks(&word.kind)) => {
            let name = if first == "if" { "if" } else { "elif" };
            Some(format!("@{name} [..] = .."))
        }
        name if text(1) == Some("=") => {
            let free = VarId::parse(name).is_some_and(|var| var.name().starts_with("val"));
            let own = view.settings.properties.iter().any(|property| property.name == name);
            (free || own).then(|| format!("@set {name} = .."))
        }
        _ => None,
    }
}
