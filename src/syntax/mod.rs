//! Form text to a tree of spans. Parsing cannot fail: what makes no sense is in the tree as such.

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
