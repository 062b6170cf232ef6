//! Form text to a tree of spans. Parsing cannot fail: what makes no sense is in the tree as such.

mod ast;
mod parse;

pub use ast::{Body, End, Form, Head, Line, Piece, PieceKind, SequenceNode, Spanned, Statement, Tail, Word};
pub use parse::parse;
