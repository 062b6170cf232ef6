//! The vocabulary of POSTFORM in tables, for checks, messages, `explain` and the reference.
// descriptions contain variables as [var], which are not links
#![allow(rustdoc::broken_intra_doc_links)]

mod commands;
mod coolant;
mod directives;
mod machine;
mod sequences;
mod suggest;
mod texts;
mod variables;
mod work;

pub(crate) use commands::command_rows;
pub use commands::{Args, COMMANDS, Command, CommandId, Used};
pub use coolant::Coolant;
pub use directives::{DIRECTIVES, DirectiveRow, Each, directive_meant};
pub use machine::{Beam, Machine, Machines, UnitChoice};
pub use sequences::{SEQUENCES, SequenceId, SequenceName};
pub use suggest::{LONGEST_NAME, did_you_mean};
pub use texts::{TEXT_COUNT, TEXTS, TextId, TextSet, TextVar, WIDEST};
pub use variables::{AHEAD, MOST_VARIABLES, Origin, TOOLS_AHEAD, Unit, VARIABLES, VarId, VarSet, Variable};
pub use work::{additional_work, work_code};

/// Source of a rule. The reference shows it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// Stated in the manual.
    Doc,
    /// Not stated, but the only reading that prints the manual's examples.
    Ex,
    /// Our decision, because no public source settles it.
    Ours,
}
