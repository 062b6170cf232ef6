//! The commands of forms: their arguments, defaults and effects. The rows of the commands are in `table.rs`.

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

/// The forms in which a command has an effect.
#[derive(Clone, Copy, Debug)]
pub enum Used {
    /// In every form.
    Always,
    /// In forms that print this variable.
    Printed(V),
    /// In forms that print this variable, or that have a canned cycle that needs this variable.
    Cycles(V),
    /// In forms with one of these sequences.
    With(&'static [S]),
    /// In forms with none of these sequences. The text gives the reason why the command has no effect in other forms.
    Unless(&'static [S], &'static str),
    /// In forms that generate arcs.
    Arcs,
    /// In forms that number blocks.
    Numbered,
    /// In forms that drop unchanged words.
    Modal,
    /// In forms with the command Thread.
    Threads,
    /// In forms that print the letters that the command names.
    Letter,
}

/// One row of the table of commands.
#[derive(Debug)]
pub struct Command {
    /// Identifier of the command.
    pub id: CommandId,
    /// Name of the command in forms.
    pub name: &'static str,
    /// Arguments of the command.
    pub args: Args,
    /// Whether the command may occur more than once.
    pub repeats: bool,
    /// The default if the form does not have the command.
    pub without: Without,
    /// The source of the command's meaning.
    pub standing: Standing,
    /// The forms in which the command has an effect.
    pub used: Used,
    /// An example of the command, if no form in the repository contains the command.
    pub example: Option<&'static str>,
    /// Effect of the command.
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

    /// Name of the command in forms.
    pub fn name(self) -> &'static str {
        self.row().name
    }

    /// Finds a command by its name; upper and lower case are equal. The question mark of a switch may be left out if
    /// the name without the question mark is not another command.
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
