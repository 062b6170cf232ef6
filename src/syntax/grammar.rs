//! The grammar of forms. Nothing outside the files of `syntax` knows of pest.
#![allow(missing_docs)]

/// The parser that pest makes of the grammar.
#[derive(pest_derive::Parser)]
#[grammar = "../grammar/postform.pest"]
pub struct FormGrammar;
