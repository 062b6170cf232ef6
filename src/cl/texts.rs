//! Text statements: the name of the part, comments, and text for the program.

use super::dialect::Dialect;
use super::fault::Done;
use super::job::{Job, Waiting};
use super::report::Notes;
use crate::diag::Code;
use crate::toolpath::Place;

/// What a text statement prints.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Said<'t> {
    Nothing,
    Comment(&'t str),
    /// Text that is printed unchanged as a block.
    Block(&'t str),
    /// A stop, with a message for the operator.
    Stop(&'t str),
}

/// What a text statement prints in files of this CAM system.
fn said<'t>(dialect: Dialect, word: &str, text: &'t str) -> Said<'t> {
    match (dialect, word) {
        // PPRINT of Makino contains data for Makino's own post processor
        (Dialect::Makino, "PPRINT") => Said::Nothing,
        (_, "CSI_INSERT_CUSTOM_GCODE") => Said::Block(text),
        (_, "CSI_PROGRAM_COMMENT" | "CSI_TOOL_PATH") => Said::Nothing,
        (Dialect::Camplete, "PPRINT") if OF_POST.iter().any(|own| text.starts_with(own)) => Said::Nothing,
        (Dialect::SolidWorksCam, "INSERT") => stop(text).map_or(Said::Comment(text), Said::Stop),
        (_, "INSERT") if !text.starts_with('[') => Said::Block(text),
        _ => Said::Comment(text),
    }
}

/// The texts that Autodesk's post for CAMplete writes before each tool path and before MCS. The text after `Comment:` is
/// also that of CSI_TOOL_PATH.
const OF_POST: [&str; 5] = ["NEW SECTION", "MATRIX DEFINITION", "Output x(", "Output dx", "Comment: "];

/// How the comments begin that posts of Autodesk write instead of a stop, or of another command that they can't write.
const NOT_WRITTEN: &str = "Unsupported ";

/// Warns of a command that the post did not write.
fn not_written(text: &str, notes: &mut Notes<'_>) {
    if notes.dialect().is_of_autodesk() && text.starts_with(NOT_WRITTEN) {
        let help = "if the machine must do something here, write STOP, OPSTOP, AUXFUN/code or PREFUN/code";
        let message = format!("the post did not write a command of the CAM system, but the comment `{text}`");
        notes.warn(Code::PL008, message, help);
    }
}

/// The text after the word STOP; `None` if the text does not begin with STOP.
fn stop(text: &str) -> Option<&str> {
    let (word, message) = text.split_once(char::is_whitespace).unwrap_or((text, ""));
    word.eq_ignore_ascii_case("STOP").then(|| message.trim())
}

/// Whether an INSERT of SolidWorks CAM may be meant for the machine. `false` for holders, stock and stops, which postform knows.
fn may_be_lost(text: &str) -> bool {
    let stock = text.get(..10).is_some_and(|head| head.eq_ignore_ascii_case("STOCK SIZE"));
    !stock && !text.starts_with('[') && stop(text).is_none()
}

/// An INSERT that may describe the tool of the next statement, and its location.
pub(super) type Insert = Option<(String, Place)>;

/// Handles a text statement.
pub(super) fn text(word: &str, text: String, insert: &mut Insert, job: &mut Job<'_>) -> Done {
    lone_insert(insert, &mut job.notes);
    match word {
        "PARTNO" => job.name = Some(text).filter(|text| !text.is_empty()),
        "REMARK" | "LETTER" => {}
        _ if text.is_empty() => {}
        _ => {
            if word == "TPRINT" {
                job.tools.said = Some(text.clone());
            }
            if word == "PPRINT" && job.name.is_none() && !job.has_operation() && job.notes.dialect() != Dialect::Makino
            {
                job.name = Some(text.clone()); // without PARTNO, the first PPRINT is the name of the part
            }
            if word == "CSI_TOOL_PATH" && job.notes.dialect() == Dialect::Camplete {
                job.tools.operation = Some(text.clone());
            }
            if word == "PPRINT" && text == OF_POST[0] && job.notes.dialect() == Dialect::Camplete {
                job.begin_heading();
            }
            not_written(&text, &mut job.notes);
            if word == "INSERT" && may_be_lost(&text) {
                *insert = Some((text.clone(), job.notes.place));
            }
            return say(said(job.notes.dialect(), word, &text), job);
        }
    }
    Ok(())
}

fn say(said: Said<'_>, job: &mut Job<'_>) -> Done {
    match said {
        Said::Nothing => Ok(()),
        Said::Comment(text) => job.wait(Waiting::Comment(text.to_owned())),
        Said::Block(text) => job.wait(Waiting::Text(text.to_owned())),
        Said::Stop(message) => {
            if !message.is_empty() {
                job.wait(Waiting::Comment(message.to_owned()))?;
            }
            job.wait(Waiting::Stop)
        }
    }
}

/// Warns of an INSERT after which no tool follows. The INSERT may be meant for the machine.
pub(super) fn lone_insert(insert: &mut Insert, notes: &mut Notes<'_>) {
    let Some((text, place)) = insert.take().filter(|_| notes.dialect() == Dialect::SolidWorksCam) else { return };
    let help = "if the machine must do something here, write INSERT/STOP, AUXFUN/code or PREFUN/code";
    notes.warn_at(place, Code::PL008, format!("INSERT/{text} is printed as a comment"), help);
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
