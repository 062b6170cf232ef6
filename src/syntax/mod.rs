//! Parses form text to a tree of spans. Parsing cannot fail: the tree also contains unreadable parts.

mod ast;
mod directive;
mod expression;
mod grammar;
mod operator;
mod parse;

pub use ast::{
    Body, Directive, DirectiveKind, End, Form, Head, Line, Piece, PieceKind, SequenceNode, Spanned, Statement, Tail,
    Word,
};
pub use expression::{Expr, ExprKind, Unread};
pub use operator::{Arithmetic, Comparison, Operator};
pub use parse::parse;
