//! Searches for jump targets, by language.

use crate::control::Rules;
use crate::nc::simulator::{RunError, Simulator};
use crate::nc::way::Search;

impl Simulator<'_> {
    /// Searches for the target of a jump, and jumps there.
    pub(in crate::nc) fn search(&mut self, search: Search) -> Result<(), RunError> {
        match self.state.settings.control.rules() {
            Rules::Klartext => self.search_klartext(search),
            Rules::Osp => self.search_osp(search),
            _ => self.search_siemens(search),
        }
    }
}
