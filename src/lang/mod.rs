//! The vocabulary of POSTFORM as tables. Checks, messages, `explain` and the reference pages use these tables.
// descriptions contain variables of forms as [var], which are not links to items
#![allow(rustdoc::broken_intra_doc_links)]

mod commands;
mod coolant;
mod directives;
mod machine;
mod sequences;
mod texts;
mod variables;
mod work;

pub(crate) use commands::command_rows;
pub use commands::{Args, COMMANDS, Command, CommandId, Used};
pub use coolant::Coolant;
pub use directives::{DIRECTIVES, DirectiveRow, Each, directive_meant};
pub use machine::{Beam, Machine, Machines, UnitChoice};
pub use sequences::{SEQUENCES, SequenceId, SequenceName};
pub use texts::{TEXT_COUNT, TEXTS, TextId, TextSet, TextVar, WIDEST, in_quotes, in_word};
pub use variables::{AHEAD, MOST_VARIABLES, Origin, TOOLS_AHEAD, Unit, VARIABLES, VarId, VarSet, Variable};
pub use work::{additional_work, work_code};

/// The source of a rule. The reference pages show the source of each rule.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// The manual states the rule.
    Doc,
    /// The manual does not state the rule, but the examples in the manual print correctly only with this rule.
    Ex,
    /// We decided the rule, because no public source states it.
    Ours,
}
