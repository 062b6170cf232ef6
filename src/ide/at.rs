//! Finds the element at a location of a form.

use super::Document;
use crate::control::Code;
use crate::lang::{CommandId, SequenceId, SequenceName, TextId, TextVar, VarId};
use crate::sema::Property;
use crate::span::Span;
use crate::syntax::{Body, DirectiveKind, End, Expr, Head, Piece, PieceKind, SequenceNode, Spanned, Statement, Unread};

/// An element of a form and its location.
#[derive(Clone, Debug, PartialEq)]
pub struct At {
    /// The span of the whole element.
    pub span: Span,
    /// Kind of the element.
    pub what: What,
}

/// Kinds of elements in forms.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum What {
    /// The name of a command.
    Command(CommandId),
    /// An argument of a command, and its index from 0.
    Argument(CommandId, usize),
    /// A letter format, and its letter.
    Format(u8),
    /// The name of a sequence.
    Sequence(SequenceId),
    /// `Upon` or `Upon Every`.
    Upon,
    /// `End`.
    End,
    /// `Cancel` after `End`.
    Cancel,
    /// The word `None` as the body of a sequence.
    Nothing,
    /// A variable, and the letter that prints it.
    Variable(VarId, Option<u8>),
    /// A text of the job, with or without a width.
    Text(TextId),
    /// A property of the form, and its index.
    Property(u16),
    /// Text in backquotes.
    Quote,
    /// A code that is written in the form, such as `G43`.
    Code(Code),
    /// Any other word that is written in the form, and its letter.
    Word(u8),
}

impl Document {
    /// The element at a byte of a file. If one element ends and another begins at this byte, the result is the element
    /// that begins.
    pub fn at(&self, file: u32, offset: u32) -> Option<At> {
        let mut ends = None;
        let mut hit = None;
        self.each(file, |at| {
            if at.span.start <= offset && offset < at.span.end {
                hit = Some(at);
            } else if at.span.end == offset {
                ends = Some(at);
            }
        });
        hit.or(ends)
    }

    /// Calls `found` for each element of a file, in their order.
    pub(super) fn each(&self, file: u32, mut found: impl FnMut(At)) {
        let names = Names(&self.checked.form.settings.properties);
        for item in self.items(file) {
            match item {
                Head::Blank(_) | Head::StrayEnd(_) => {}
                Head::Format { letter, spec, .. } => {
                    let byte = letter.text.bytes().next().unwrap_or(b' ');
                    found(At { span: letter.span.to(spec.span), what: What::Format(byte) });
                }
                Head::Statement(statement) => command(statement, names, &mut found),
                Head::Sequence(node) => sequence(node, names, &mut found),
            }
        }
    }
}

/// Resolves names of variables and of the form's properties.
#[derive(Clone, Copy)]
struct Names<'a>(&'a [Property]);

impl Names<'_> {
    /// The variable or property with this name. `letter`: the letter that prints the variable or property.
    fn what(self, name: &str, letter: Option<u8>) -> Option<What> {
        let property = || self.0.iter().position(|property| property.name.eq_ignore_ascii_case(name));
        match VarId::parse(name) {
            Some(var) => Some(What::Variable(var, letter)),
            None => property().map(|row| What::Property(row as u16)),
        }
    }
}

fn command(statement: &Statement, names: Names<'_>, found: &mut dyn FnMut(At)) {
    let Some(id) = CommandId::parse(&statement.name.text) else { return };
    found(At { span: statement.name.span, what: What::Command(id) });
    for (i, arg) in statement.args.iter().enumerate() {
        let asks = i == 0 && matches!(id, CommandId::Ask | CommandId::Each);
        let what = match id {
            CommandId::Property if i == 0 => names.what(&arg.text, None),
            _ => variable(arg).filter(|_| asks).map(|var| What::Variable(var, None)),
        };
        let what = what.unwrap_or(What::Argument(id, i));
        found(At { span: arg.span, what });
    }
}

/// The variable that an argument names, with or without brackets.
fn variable(arg: &Spanned) -> Option<VarId> {
    VarId::parse(arg.text.trim_matches(['[', ']', '<', '>']))
}

fn sequence(node: &SequenceNode, names: Names<'_>, found: &mut dyn FnMut(At)) {
    let name = &node.name;
    let mut words = vec![name.name.text.as_str()];
    words.extend(name.args.iter().map(|arg| arg.text.as_str()));
    match SequenceName::parse(&words) {
        Some(SequenceName::Plain(id, _)) => {
            let spelt = if words[0].eq_ignore_ascii_case(id.name()) { name.name.span } else { name.line.span };
            let whole = name.args.first().filter(|_| spelt == name.line.span);
            let span = whole.map_or(name.name.span, |second| name.name.span.to(second.span));
            found(At { span, what: What::Sequence(id) });
        }
        Some(SequenceName::Upon(_) | SequenceName::UponEvery(_)) => {
            let every = name.args.first().filter(|arg| arg.text.eq_ignore_ascii_case("Every"));
            let span = every.map_or(name.name.span, |every| name.name.span.to(every.span));
            found(At { span, what: What::Upon });
            for arg in &name.args {
                if let Some(var) = variable(arg) {
                    found(At { span: arg.span, what: What::Variable(var, None) });
                }
            }
        }
        None => {}
    }
    node.body.iter().for_each(|line| body(line, names, found));
    if let Some(End { word, args, .. }) = &node.end {
        found(At { span: *word, what: What::End });
        for arg in args.iter().filter(|arg| arg.text.eq_ignore_ascii_case("Cancel")) {
            found(At { span: arg.span, what: What::Cancel });
        }
    }
}

fn body(line: &Body, names: Names<'_>, found: &mut dyn FnMut(At)) {
    let kind = line.directive.as_ref().map(|directive| &directive.kind);
    if let Some(DirectiveKind::If(asked) | DirectiveKind::Elif(asked) | DirectiveKind::Set(_, asked)) = kind {
        expression(asked, names, found);
    }
    if let Some(DirectiveKind::Set(target, _)) = kind
        && let Some(what @ What::Property(_)) = names.what(&target.text, None)
    {
        found(At { span: target.span, what });
    }
    for word in &line.words {
        let alone = line.words.len() == 1 && word.pieces.len() == 1;
        word.pieces.iter().for_each(|part| piece(part, alone, names, found));
    }
}

/// Finds the variables of an expression.
fn expression(expr: &Result<Expr, Unread>, names: Names<'_>, found: &mut dyn FnMut(At)) {
    let Ok(expr) = expr else { return };
    expr.variables(&mut |name, span| {
        if let Some(what) = names.what(name, None) {
            found(At { span, what });
        }
    });
}

fn piece(part: &Piece, alone: bool, names: Names<'_>, found: &mut dyn FnMut(At)) {
    match &part.kind {
        PieceKind::Variable { letter, name } => {
            if let Some(what) = names.what(&name.text, *letter) {
                found(At { span: part.span, what });
            }
        }
        PieceKind::Literal { letter, number } => {
            let code = number.text.parse().ok().and_then(|value| Code::of(*letter, value));
            found(At { span: part.span, what: code.map_or(What::Word(*letter), What::Code) });
        }
        PieceKind::Stray(text) if alone && text.eq_ignore_ascii_case("None") => {
            found(At { span: part.span, what: What::Nothing });
        }
        PieceKind::Expression { expr, .. } => expression(expr, names, found),
        PieceKind::TextVariable { name, .. } => {
            if let Some(TextVar { id, .. }) = TextVar::parse(&name.text) {
                found(At { span: part.span, what: What::Text(id) });
            }
        }
        PieceKind::Quote(_) => found(At { span: part.span, what: What::Quote }),
        PieceKind::Stray(_) => {}
        PieceKind::Note { parts, .. } => parts.iter().for_each(|part| piece(part, false, names, found)),
    }
}

#[cfg(test)]
mod tests {
    use super::super::document::tests::haas;
    use super::*;

    #[test]
    fn each_kind_is_found() {
        let at = |from: &str, to: &str| {
            let (document, offset) = haas(from, to);
            document.at(0, offset).map(|at| (document.slice(at.span).to_owned(), at.what))
        };
        let found = |text: &str, what: What| Some((text.to_owned(), what));
        assert_eq!(at("ArcPlane", "Arc|Plane"), found("ArcPlane", What::Command(CommandId::ArcPlane)));
        assert_eq!(at("G17 G18 G19", "G17 G|18 G19"), found("G18", What::Argument(CommandId::ArcPlane, 1)));
        assert_eq!(at("Y->4.>4", "Y-|>4.>4"), found("Y->4.>4", What::Format(b'Y')));
        assert_eq!(at("\nCancel", "\nCan|cel"), found("Cancel", What::Sequence(SequenceId::Cancel)));
        assert_eq!(at("Upon [work]", "Up|on [work]"), found("Upon", What::Upon));
        assert_eq!(at("Upon [work]", "Upon [wo|rk]"), found("[work]", What::Variable(VarId::Work, None)));
        assert_eq!(at("End Cancel", "E|nd Cancel"), found("End", What::End));
        assert_eq!(at("End Cancel", "End Ca|ncel"), found("Cancel", What::Cancel));
        assert_eq!(
            at("Z[d] R[vclear]", "Z[d] R[v|clear]"),
            found("R[vclear]", What::Variable(VarId::Vclear, Some(b'R')))
        );
        assert_eq!(at("G81", "G|81"), found("G81", What::Code(Code::g(81))));
        assert_eq!(at("G53 Z0", "G53 Z0|"), found("Z0", What::Word(b'Z')));
        assert_eq!(
            at("G81 X[h]", "(DRILL [tool|name:12]) G81 X[h]"),
            found("[toolname:12]", What::Text(TextId::Toolname))
        );
        assert_eq!(at("G81 X[h]", "`MCALL #|1` G81 X[h]"), found("`MCALL #1`", What::Quote));
        assert_eq!(at("# Haas", "# Ha|as"), None);
    }
}
