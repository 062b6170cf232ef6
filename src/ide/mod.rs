//! Answers an editor's questions about a form that is being written, or about a program. Nothing in this module does I/O.
//!
//! A [`Document`] is a checked form that is open in the editor. A [`Current`] is a job printed with this form. Locations are
//! bytes of the text, as in [`Span`](crate::span::Span); [`utf16`] converts them for editors.
// descriptions contain variables as [var], which are not links
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
