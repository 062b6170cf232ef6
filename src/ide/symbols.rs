//! The outline of a form.

use super::Document;
use crate::lang::{CommandId, SequenceId, SequenceName};
use crate::sema::kind_of_remark;
use crate::source::Source;
use crate::span::Span;
use crate::syntax::{Head, SequenceNode, Tail, parse};

/// A part of a form in the outline.
#[derive(Clone, Debug, PartialEq)]
pub struct Symbol {
    /// Name of the part, such as `Drill`, `Upon [work]` or `Coolant`.
    pub name: String,
    /// Description of the part. The description of a command is its arguments.
    pub detail: String,
    /// Kind of the part.
    pub kind: Kind,
    /// Span of the whole part.
    pub span: Span,
    /// Span of the name.
    pub name_span: Span,
}

/// Kinds of parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A command.
    Command,
    /// A letter format.
    Format,
    /// A sequence.
    Sequence,
    /// `Upon [var]`.
    Upon,
}

impl Document {
    /// The commands, formats and sequences of a file, in the order of the file.
    pub fn symbols(&self, file: u32) -> Vec<Symbol> {
        self.items(file).iter().filter_map(symbol).collect()
    }
}

/// The parts of a form that is parsed but not checked.
pub fn symbols_of(form: &Source) -> Vec<Symbol> {
    parse(form, 0).items.iter().filter_map(symbol).collect()
}

fn symbol(item: &Head) -> Option<Symbol> {
    match item {
        Head::Blank(_) | Head::StrayEnd(_) => None,
        Head::Format { line, letter, spec } => Some(Symbol {
            name: letter.text.clone(),
            detail: spec.text.trim().to_owned(),
            kind: Kind::Format,
            span: line.span,
            name_span: letter.span,
        }),
        Head::Statement(statement) => {
            let id = CommandId::parse(&statement.name.text)?;
            let args: Vec<&str> = statement.args.iter().map(|arg| arg.text.as_str()).collect();
            Some(Symbol {
                name: id.name().to_owned(),
                detail: args.join(" "),
                kind: Kind::Command,
                span: statement.line.span,
                name_span: statement.name.span,
            })
        }
        Head::Sequence(node) => Some(sequence(node)),
    }
}

fn sequence(node: &SequenceNode) -> Symbol {
    let mut words = vec![node.name.name.text.as_str()];
    words.extend(node.name.args.iter().map(|arg| arg.text.as_str()));
    let (name, detail, kind) = match SequenceName::parse(&words) {
        Some(SequenceName::Plain(id, _)) => {
            let is_custom = matches!(id, SequenceId::Custom1 | SequenceId::Custom2 | SequenceId::Custom3);
            let serves = match &node.name.line.tail {
                Tail::Lost(remark) if is_custom => kind_of_remark(&remark.text),
                _ => None,
            };
            let name = serves.map_or(id.name().to_owned(), |kind| format!("{} {kind}", id.name()));
            (name, id.row().meaning, Kind::Sequence)
        }
        Some(SequenceName::Upon(var)) => (format!("Upon [{}]", bare(var)), "when it changes", Kind::Upon),
        Some(SequenceName::UponEvery(var)) => (format!("Upon Every [{}]", bare(var)), "at every use", Kind::Upon),
        None => (node.name.name.text.clone(), "no sequence", Kind::Sequence),
    };
    Symbol { name, detail: detail.to_owned(), kind, span: node.span(), name_span: node.name.name.span }
}

fn bare(var: &str) -> &str {
    var.trim_matches(['[', ']', '<', '>'])
}

#[cfg(test)]
mod tests {
    use super::super::document::tests::haas;

    #[test]
    fn the_outline_has_every_part_once() {
        let (document, _) = haas("", "");
        let all = document.symbols(0);
        let named = |name: &str| all.iter().filter(|symbol| symbol.name == name).collect::<Vec<_>>();
        assert_eq!(named("Units")[0].detail, "both");
        assert_eq!(named("X")[0].detail, "->4.>4");
        assert_eq!((named("Upon [work]").len(), named("Custom1 Face").len(), named("Drill").len()), (1, 1, 1));
        let drill = named("Drill")[0];
        let text = document.slice(drill.span);
        assert!(text.starts_with("Drill\nG[retplane] G81") && text.ends_with("End Cancel"), "{text}");
        assert_eq!(document.slice(drill.name_span), "Drill");
    }
}
