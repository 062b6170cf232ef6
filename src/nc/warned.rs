//! The warnings of a run.

use super::fault::Fault;
use super::simulator::Simulator;
use crate::diag::{Code, Diag};

impl Simulator<'_> {
    /// Returns the warnings since the last call as findings.
    pub fn take_warnings(&mut self) -> Vec<Diag> {
        let list = self.state.take_warnings();
        let slash = self.slash.take();
        let (line, text) = (self.at.line, self.text());
        let list = list.into_iter().map(|(code, message)| Fault::new(code, message, code.row().title).diag(line, text));
        let slash = slash.map(|(line, text)| {
            let (does, help) = match self.state.settings.block_delete {
                true => ("skipped", "leave --block-delete out for the program with these blocks"),
                false => ("run", "give --block-delete for the program without these blocks"),
            };
            let message = format!("blocks with a slash are {does}: the result is for one position of the switch");
            Fault::new(Code::PN038, message, help).diag(line, &text)
        });
        list.chain(slash).collect()
    }
}
