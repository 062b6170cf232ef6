//! Warnings about blocks that the control runs, but that the user should check.

use super::action::{Action, Item};
use super::fault::Fault;
use super::simulator::Simulator;
use crate::diag::{Code, Diag};

impl Simulator<'_> {
    /// Returns the warnings since the last call as findings. If several blocks cause the same warning, the finding has
    /// the first of these blocks.
    pub fn take_warnings(&mut self) -> Vec<Diag> {
        self.place_warnings();
        if self.warnings.is_empty() && self.slash.is_none() {
            return Vec::new();
        }
        let slash = self.slash.take().map(|(line, text)| {
            let (does, help) = match self.state.settings.block_delete {
                true => ("skipped", "leave --block-delete out for the program with these blocks"),
                false => ("run", "give --block-delete for the program without these blocks"),
            };
            let message = format!("blocks with a slash are {does}: the result is for one position of the switch");
            Fault::new(Code::PN038, message, help).diag(line, &text)
        });
        std::mem::take(&mut self.warnings).into_iter().map(|(_, diag)| diag).chain(slash).collect()
    }

    /// Whether the program has had a block with a slash.
    pub fn has_slash(&self) -> bool {
        self.has_slash
    }

    /// Runs the slash of the current block. Returns whether the block is skipped. The first block with a slash causes a
    /// warning.
    pub(super) fn deletes(&mut self, items: &mut Vec<Item>) -> bool {
        if !std::mem::replace(&mut self.has_slash, true) {
            self.slash = Some((self.at.line, self.line.clone()));
        }
        if !self.state.settings.block_delete {
            items.push(Item { line: self.at.line, by_cycle: false, action: Action::BlockDelete });
        }
        self.state.settings.block_delete
    }

    /// Gives the warnings of the current block their location.
    #[inline]
    pub(super) fn place_warnings(&mut self) {
        if !self.state.warnings.is_empty() {
            self.place_each();
        }
    }

    #[cold]
    fn place_each(&mut self) {
        for (code, message, help) in std::mem::take(&mut self.state.warnings) {
            if !self.warnings.iter().any(|(known, _)| *known == (code, message)) {
                let diag = Fault::new(code, message, help).diag(self.at.line, self.text());
                self.warnings.push(((code, message), diag));
            }
        }
    }
}
