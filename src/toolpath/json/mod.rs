//! Reads job files: `job.json` is one document, `.jsonl` has one object on each line. Both kinds of file are read as
//! streams, so the path of the tool is not kept in memory.

mod build;
mod context;
mod convert;
mod document;
mod fast;
mod lines;
mod objects;
mod order;
mod position;
#[cfg(feature = "schema")]
mod schema;
mod strings;
mod values;
mod window;

pub use document::{read_document, read_document_again};
pub use lines::read_lines;
#[cfg(feature = "schema")]
pub use schema::schema;

/// The JSON Schema of job files, as text.
pub const SCHEMA: &str = include_str!("../../../docs/job.schema.json");
