//! Words of statements that postform ignores. If a word has an effect on the machine, the reader warns that the effect is
//! lost.

use std::iter::Peekable;
use std::slice::Iter;

use super::report::Notes;
use super::words::Word;
use crate::diag::Code;

/// A word that is ignored.
struct Ignored {
    /// The major word of its statement.
    of: &'static str,
    word: &'static str,
    /// The effect that the program does not have; `None`: the word has no effect on the program.
    lost: Option<&'static str>,
}

const fn without_effect(of: &'static str, word: &'static str) -> Ignored {
    Ignored { of, word, lost: None }
}

const fn lost(of: &'static str, word: &'static str, lost: &'static str) -> Ignored {
    Ignored { of, word, lost: Some(lost) }
}

/// A gear range, which forms can't print.
const RANGE: &str = "the program does not select a gear range";

/// The ignored words. The words of LOADTL also apply to LOAD, TOOLNO and TURRET.
#[rustfmt::skip]
const IGNORED: &[Ignored] = &[
    lost("SPINDL", "RANGE", RANGE), lost("SPINDL", "LOW", RANGE),
    lost("SPINDL", "MEDIUM", RANGE), lost("SPINDL", "HIGH", RANGE),
    // the length, the gauge length of the spindle and the pocket belong to the tool table of the machine
    without_effect("LOADTL", "LENGTH"), without_effect("LOADTL", "SPINDL"), without_effect("LOADTL", "IN"),
    without_effect("LOADTL", "MILL"), without_effect("LOADTL", "DRILL"), without_effect("LOADTL", "TURN"),
    without_effect("LOADTL", "AUTO"),
    lost("LOADTL", "MANUAL", "the program does not stop for a tool change by hand"),
    lost("CSI_SET_PATH_PARAM", "TOOL_BREAK=ON", "the program does not check the tool for breakage"),
    without_effect("CUTCOM", "XYPLAN"), without_effect("CUTCOM", "OSETNO"), without_effect("CUTCOM", "OFSETNO"),
    without_effect("CUTCOM", "NORMDS"),
    without_effect("SET", "MODE"), without_effect("SET", "ABSOL"), without_effect("SET", "MILL"),
    without_effect("MODE", "ABSOL"), without_effect("MODE", "MILL"), without_effect("MODE", "CIRCUL"),
];

/// The row of a word.
fn row(of: &str, word: &str) -> Option<&'static Ignored> {
    IGNORED.iter().find(|row| row.of == of && row.word == word)
}

/// Ignores a word, with a warning if an effect is lost. `false`: the word is not in the table.
pub(super) fn ignore(of: &str, word: &str, notes: &mut Notes<'_>) -> bool {
    let Some(row) = row(of, word) else { return false };
    if let Some(effect) = row.lost {
        warn(format!("{word} of {of} is ignored: {effect}"), notes);
    }
    true
}

/// Like [`ignore`], for a word that may have a number after it.
pub(super) fn ignore_with_number(
    of: &str,
    word: &str,
    words: &mut Peekable<Iter<'_, Word>>,
    notes: &mut Notes<'_>,
) -> bool {
    let is_ignored = ignore(of, word, notes);
    if is_ignored {
        words.next_if(|word| word.number().is_some());
    }
    is_ignored
}

/// Ignores a whole statement. Unless its names are words without effect, the reader warns. `why` is a part of the warning.
pub(super) fn ignore_statement(of: &str, words: &[Word], why: &str, notes: &mut Notes<'_>) {
    let has_no_effect = |name: &str| row(of, name).is_some_and(|row| row.lost.is_none());
    let mut names = words.iter().filter_map(Word::name).peekable();
    if names.peek().is_some() && names.all(has_no_effect) {
        return;
    }
    warn(format!("{} is ignored: {why}", statement(of, words)), notes);
}

/// Warns of words after a statement that takes no words.
pub(super) fn ignore_rest(of: &str, words: &[Word], notes: &mut Notes<'_>) {
    if !words.is_empty() {
        warn(format!("{} is printed as {of}: {of} takes no other words", statement(of, words)), notes);
    }
}

/// A statement as text: `STOP/5`.
fn statement(name: &str, words: &[Word]) -> String {
    let words: Vec<_> = words.iter().map(ToString::to_string).collect();
    if words.is_empty() { name.to_owned() } else { format!("{name}/{}", words.join(",")) }
}

fn warn(message: String, notes: &mut Notes<'_>) {
    notes.warn(Code::PL008, message, "if the machine must do something here, write AUXFUN/code or PREFUN/code");
}
