//! Findings that several checks share.

use crate::diag::{Code, Diag};
use crate::lang::{COMMANDS, SEQUENCES};
use crate::span::Span;
use crate::suggest::{abbreviates, did_you_mean};

pub(super) fn bad_format(span: Span, why: &str) -> Diag {
    Diag::new(Code::PF301, format!("the letter format {why}"))
        .at(span, "this format")
        .help("write LETTER sign digits point decimals, as `X->3.>4`, `F >3.>6`, `P ->34` or `T 2`")
}

pub(super) fn duplicate_format(letter: u8, span: Span, first: Option<Span>) -> Diag {
    let diag = Diag::new(Code::PF006, format!("{} has two formats", char::from(letter))).at(span, "again here");
    let diag = match first {
        Some(first) => diag.at(first, "first here"),
        None => diag,
    };
    diag.help(
        "keep one of them; if a letter needs two formats, use another letter for the second and print it with \
        `Rename`",
    )
}

pub(super) fn duplicate_sequence(name: &str, span: Span, first: Span) -> Diag {
    Diag::new(Code::PF004, format!("{name} is defined twice"))
        .at(span, "again here")
        .at(first, "first here")
        .help("keep one of them")
}

/// Adds the advice to put a line of text for the control into backquotes.
pub(super) fn in_backquotes(diag: Diag, span: Span) -> Diag {
    let [begin, end] = [span.start, span.end].map(|at| (Span { start: at, end: at, ..span }, "`".to_owned()));
    diag.help("put text of the control in backquotes, from the beginning of the line to its end").fix(
        "put the line in backquotes",
        false,
        vec![begin, end],
    )
}

pub(super) fn unknown_name(name: &str, span: Span) -> Diag {
    let own = || ["Upon", "End"].into_iter();
    let names = || SEQUENCES.iter().map(|s| s.name).chain(COMMANDS.iter().map(|c| c.name)).chain(own());
    let mut diag = Diag::new(Code::PF201, format!("`{}` is not a command or a sequence", name)).at(span, "unknown");
    // the name or the known name may be an abbreviation of the other
    let begins_with = |n: &str| n.get(..name.len()).is_some_and(|head| head.eq_ignore_ascii_case(name));
    let begins =
        || names().find(|n| name.len() > 2 && begins_with(n)).or_else(|| names().find(|n| abbreviates(n, name)));
    // names that are reserved for a later version
    if let Some(kept) = ["PlaneOn", "PlaneOff"].iter().find(|kept| kept.eq_ignore_ascii_case(name)) {
        return diag.help(format!("{kept} is reserved for tilted planes, which postform can't print yet: remove it"));
    }
    diag.help = did_you_mean(name, names())
        .or_else(|| begins().map(|n| format!("did you mean `{n}`?")))
        .or_else(|| Some("a comment begins with `#`".into()));
    diag
}

/// Whether the name is a letter with a number, as `G80`. No valid name is a letter with a number.
pub fn is_word(name: &str) -> bool {
    let number = name.strip_prefix(|c: char| c.is_ascii_alphabetic());
    number.is_some_and(|number| !number.is_empty() && number.bytes().all(|b| b.is_ascii_digit()))
}

/// The error for words of a sequence whose name line is missing.
pub fn no_name_line(span: Span) -> Diag {
    Diag::new(Code::PF001, "words to print are outside a sequence")
        .at(span, "this line belongs to no sequence")
        .help("check the name line of the sequence above it: it is missing or misspelt")
}
