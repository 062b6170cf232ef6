//! Parses the text of a form to a syntax tree. Parsing never fails, because the tree may also contain text with errors.

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
