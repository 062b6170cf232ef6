//! The grammar of forms. Only the files of `syntax` use the crate pest.
#![allow(missing_docs)]

/// The parser that pest generates from the grammar.
#[derive(pest_derive::Parser)]
#[grammar = "../grammar/postform.pest"]
pub struct FormGrammar;
