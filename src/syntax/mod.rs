//! Form text to a tree of spans. Parsing cannot fail: what makes no sense is in the tree as such.

mod ast;
mod directive;
mod expression;
mod grammar;
mod parse;

pub use ast::{
    Body, Directive, DirectiveKind, End, Form, Head, Line, Piece, PieceKind, SequenceNode, Spanned, Statement, Tail,
    Word,
};
pub use expression::{Expr, ExprKind, Operator, Unread};
pub use parse::parse;
