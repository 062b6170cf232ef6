//! Text statements: the part's name, remarks, and words for the program.

use super::dialect::Dialect;
use super::reader::{Done, Reader, Waiting};
use crate::diag::Code;

/// What a text statement puts into the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Said<'t> {
    Nothing,
    Comment(&'t str),
    /// A block as it stands.
    Block(&'t str),
    /// A stop, and what it tells the operator.
    Stop(&'t str),
}

/// What a text statement means in the files of a system.
pub(super) fn said<'t>(dialect: Dialect, word: &str, text: &'t str) -> Said<'t> {
    match (dialect, word) {
        // Makino's PPRINT carries data for its own post processor
        (Dialect::Makino, "PPRINT") => Said::Nothing,
        (Dialect::SolidWorksCam, "INSERT") => stop(text).map_or(Said::Comment(text), Said::Stop),
        (_, "INSERT") if !text.starts_with('[') => Said::Block(text),
        _ => Said::Comment(text),
    }
}

/// What stands behind STOP.
fn stop(text: &str) -> Option<&str> {
    let (word, message) = text.split_once(char::is_whitespace).unwrap_or((text, ""));
    word.eq_ignore_ascii_case("STOP").then(|| message.trim())
}

/// Holders, stock and stops are known; any other INSERT of SolidWorks CAM describes the tool if CUTTER follows.
fn may_be_lost(text: &str) -> bool {
    let stock = text.get(..10).is_some_and(|head| head.eq_ignore_ascii_case("STOCK SIZE"));
    !stock && !text.starts_with('[') && stop(text).is_none()
}

impl Reader<'_> {
    /// A text statement. What it means is decided when it is printed: the first ones may stand before the line that
    /// says who wrote the file.
    pub(super) fn text(&mut self, word: &'static str, text: String) -> Done {
        self.lone_insert();
        match word {
            "PARTNO" => self.name = Some(text).filter(|text| !text.is_empty()),
            "REMARK" | "LETTER" => {}
            _ if text.is_empty() => {}
            _ => {
                if word == "INSERT" && may_be_lost(&text) {
                    self.insert = Some((text.clone(), self.place));
                }
                return self.wait(Waiting::Words(word, text));
            }
        }
        Ok(())
    }

    /// Text that no tool follows may have been meant for the machine.
    pub(super) fn lone_insert(&mut self) {
        let insert = self.insert.take().filter(|_| self.dialect() == Dialect::SolidWorksCam);
        let Some((text, place)) = insert else { return };
        let here = std::mem::replace(&mut self.place, place);
        let help = "if the machine shall do something there, write INSERT/STOP, AUXFUN/code or PREFUN/code";
        self.warn(Code::PL008, format!("INSERT/{text} is printed as a comment"), help);
        self.place = here;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inserts_mean_what_their_system_means() {
        let swcam = |text| said(Dialect::SolidWorksCam, "INSERT", text);
        assert_eq!(swcam("STOP"), Said::Stop(""));
        assert_eq!(swcam("stop  change fixture"), Said::Stop("change fixture"));
        assert_eq!(swcam("STOPPER 6MM"), Said::Comment("STOPPER 6MM"));
        assert_eq!(said(Dialect::Gener, "INSERT", "STOP"), Said::Block("STOP"));
        assert_eq!(said(Dialect::Makino, "PPRINT", "MOTION"), Said::Nothing);
    }
}
