//! Commands of forms: what each takes, what holds without it, what it does. The rows are in `table.rs`.

mod args;
mod table;
mod without;

use super::Standing::{self, Doc, Ours};
use super::sequences::SequenceId as S;
use super::variables::VarId as V;
pub use args::Args;
pub(crate) use table::command_rows;
pub use without::Without;
use without::of;

/// Where a command has something to change.
#[derive(Clone, Copy, Debug)]
pub enum Used {
    /// In every form.
    Always,
    /// Where this variable is printed.
    Printed(V),
    /// Where this variable is printed, or a canned cycle asks for it.
    Cycles(V),
    /// In forms with one of these sequences.
    With(&'static [S]),
    /// In forms with none of these sequences, because of what they do.
    Unless(&'static [S], &'static str),
    /// Where arcs are generated.
    Arcs,
    /// Where blocks are numbered.
    Numbered,
    /// Where words that change nothing are dropped.
    Modal,
    /// With the command Thread.
    Threads,
    /// Where its letters are printed.
    Letter,
}

/// One row of the table.
#[derive(Debug)]
pub struct Command {
    /// Which.
    pub id: CommandId,
    /// As forms write it.
    pub name: &'static str,
    /// What the command takes.
    pub args: Args,
    /// May it stand more than once?
    pub repeats: bool,
    /// What holds without it.
    pub without: Without,
    /// Where its meaning comes from.
    pub standing: Standing,
    /// Where the command has something to change.
    pub used: Used,
    /// An example of the command, where no form that ships gives it.
    pub example: Option<&'static str>,
    /// What the command does.
    pub meaning: &'static str,
}

macro_rules! vocabulary {
    ($($id:ident $name:literal ($args:expr) $times:ident ($without:expr) $standing:ident $field:tt
       $(if ($used:expr))? $(eg $example:literal)? $meaning:literal;)*) => {
        /// A command.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[repr(u8)]
        pub enum CommandId { $(#[doc = $meaning] $id),* }

        /// All commands.
        pub const COMMANDS: &[Command] = &[$(Command {
            id: CommandId::$id,
            name: $name,
            args: { use Args::*; $args },
            repeats: vocabulary!(@$times),
            without: $without,
            standing: $standing,
            used: { use Used::*; vocabulary!(@or Always $($used)?) },
            example: vocabulary!(@example $($example)?),
            meaning: $meaning,
        }),*];
    };
    (@once) => { false };
    (@many) => { true };
    (@or $none:expr) => { $none };
    (@or $none:ident $some:expr) => { $some };
    (@example) => { None };
    (@example $some:literal) => { Some($some) };
}

command_rows! { vocabulary }

impl CommandId {
    /// The row of the command in the table.
    pub fn row(self) -> &'static Command {
        &COMMANDS[self as usize]
    }

    /// As forms write it.
    pub fn name(self) -> &'static str {
        self.row().name
    }

    /// Finds a name in any case; the question mark of a switch may be left out where no other command has that name.
    pub fn parse(name: &str) -> Option<CommandId> {
        let find = |same: &dyn Fn(&str) -> bool| COMMANDS.iter().find(|c| same(c.name)).map(|c| c.id);
        find(&|own| own.eq_ignore_ascii_case(name))
            .or_else(|| find(&|own| own.strip_suffix('?').is_some_and(|own| own.eq_ignore_ascii_case(name))))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_is_found_and_unique() {
        for command in COMMANDS {
            assert_eq!(CommandId::parse(&command.name.to_lowercase()), Some(command.id));
        }
        assert_eq!(CommandId::parse("modality"), Some(CommandId::Modality));
        assert_eq!(CommandId::parse("Spaces"), Some(CommandId::Spaces));
    }
}
