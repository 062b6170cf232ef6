//! What an editor asks about a form that is being written, and about a program: queries, no I/O.
//!
//! A [`Document`] is a form as it stands in the editor, checked; a [`Current`] is a job printed with it. Places are bytes of
//! the text, as [`Span`](crate::span::Span) counts them; [`utf16`] has them as editors do.
// meanings name variables as [var]
#![allow(rustdoc::broken_intra_doc_links)]

mod actions;
mod at;
mod complete;
mod current;
mod document;
mod folding;
mod formats;
mod hints;
mod hover;
pub mod program;
mod references;
mod rename;
mod signature;
mod symbols;
mod tokens;
pub mod utf16;
mod words;

pub use actions::{Action, Kind as ActionKind};
pub use at::{At, What};
pub use complete::{Completion, Kind as CompletionKind, about};
pub use current::Current;
pub use document::Document;
pub use hints::Hint;
pub use symbols::{Kind as SymbolKind, Symbol, symbols_of};
pub use tokens::Kind as TokenKind;
