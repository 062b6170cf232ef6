//! Directives: the lines that begin with `@`.

use super::ast::{Directive, DirectiveKind, Spanned};
use super::expression::expression;
use crate::span::Span;

/// The directive with this name and this text after it.
pub fn directive(name: Spanned, rest: Spanned) -> Directive {
    let asked = || expression(&rest.text, rest.span, false);
    let kind = match name.text[1..].to_ascii_lowercase().as_str() {
        "if" => DirectiveKind::If(asked()),
        "elif" => DirectiveKind::Elif(asked()),
        "else" => DirectiveKind::Else,
        "end" => DirectiveKind::End,
        "for" => DirectiveKind::For,
        "set" => {
            let target = rest.text.split('=').next().unwrap_or_default();
            let length = target.len();
            let target = target.trim_matches([' ', '\t', '[', ']']).to_owned();
            let start = rest.span.start + (length + 1).min(rest.text.len()) as u32;
            let value = rest.text.get(length + 1..).unwrap_or_default();
            let value = expression(value, Span { start, ..rest.span }, false);
            let span = Span { end: rest.span.start + length as u32, ..rest.span };
            DirectiveKind::Set(Spanned { text: target, span }, value)
        }
        _ => DirectiveKind::Unknown,
    };
    Directive { name, rest, kind }
}
