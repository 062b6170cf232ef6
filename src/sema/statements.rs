//! Analyses the statements above the sequences: letter formats and commands.

use indexmap::map::Entry;

use super::args::Arguments;
use super::check::Analysis;
use super::messages::{bad_format, duplicate_format, is_word, no_name_line, unknown_name};
use super::words::invisible;
use crate::diag::{Code, Diag};
use crate::lang::CommandId;
use crate::number::LetterFormat;
use crate::span::Span;
use crate::syntax::{Spanned, Statement, Tail};

impl Analysis {
    pub(super) fn format(&mut self, letter: &Spanned, spec: &Spanned) {
        let byte = letter.text.as_bytes()[0];
        let span = letter.span.to(spec.span);
        let digits = spec.text.trim();
        if digits.len() >= 3 && digits.bytes().all(|b| b.is_ascii_digit()) {
            if self.form.packed.insert(byte, digits.to_owned()).is_some() {
                self.report(duplicate_format(byte, span, None));
            }
            return;
        }
        match LetterFormat::parse(&spec.text) {
            Ok(format) => match self.form.formats.entry(byte) {
                Entry::Occupied(first) => {
                    let first = first.get().1;
                    self.report(duplicate_format(byte, span, Some(first)));
                }
                Entry::Vacant(entry) => _ = entry.insert((format, span)),
            },
            Err(why) => self.report(bad_format(span, why)),
        }
    }

    pub(super) fn statement(&mut self, statement: &Statement) {
        let Some(id) = CommandId::parse(&statement.name.text) else {
            return self.no_command(statement);
        };
        if id != CommandId::Thread {
            self.in_order(statement.line.span, "command");
        }
        if id == CommandId::ArcPlane
            && let Some(&(_, centre)) = self.commands_seen.iter().find(|(seen, _)| *seen == CommandId::CtrCode)
        {
            self.report(
                Diag::new(Code::PF003, "ArcPlane is after CtrCode")
                    .at(statement.line.span, "move this up")
                    .at(centre, "before this"),
            );
        }
        if !id.row().repeats {
            if let Some(&(_, first)) = self.commands_seen.iter().find(|(seen, _)| *seen == id) {
                self.report(
                    Diag::new(Code::PF006, format!("{} is given twice", id.name()))
                        .at(statement.line.span, "again here")
                        .at(first, "first here")
                        .help("keep one of them"),
                );
                return;
            }
            self.commands_seen.push((id, statement.line.span));
        }
        if let Some((arg, c)) = printed_control(id, &statement.args) {
            self.report(invisible(c, arg.span));
        }
        let args = Arguments { id, all: &statement.args, span: statement.line.span, typed: true };
        if let Err(bad) = self.form.settings.apply(&args) {
            let at = bad.span.unwrap_or(statement.line.span);
            let mut diag = Diag::new(Code::PF302, bad.message).at(at, "here");
            if let Tail::Lost(lost) = &statement.line.tail {
                diag = diag.at(lost.span, "two spaces before this text make it a comment");
            }
            let without = match id.row().without.to_string() {
                nothing if nothing.is_empty() => nothing,
                without => format!(" (without the command: {without})"),
            };
            let example =
                id.row().example.map(|example| format!("; example: `{} {example}`", id.name())).unwrap_or_default();
            let meaning = || format!("{}: {}{example}{without}", id.name(), id.row().meaning);
            diag.help = Some(bad.help.unwrap_or_else(meaning));
            self.report(diag);
        }
    }

    pub(super) fn in_order(&mut self, span: Span, what: &str) {
        if let Some(first) = self.first_sequence.filter(|first| first.file == span.file) {
            self.report(
                Diag::new(Code::PF003, format!("a {what} after the first sequence"))
                    .at(span, format!("this {what}"))
                    .at(first, "the first sequence")
                    .help("move it above the first sequence"),
            );
        }
    }

    /// Reports a line that does not begin with a command, and proposes the text that the user probably intended.
    fn no_command(&mut self, statement: &Statement) {
        let (name, span) = (&statement.name.text, statement.name.span);
        let whole = statement.args.iter().fold(span, |all, arg| all.to(arg.span));
        let is_variable = |text: &str| text.contains('[') || (text.contains('<') && text.ends_with('>'));
        let prints = is_variable(name) || statement.args.iter().any(|arg| is_variable(&arg.text));
        let diag = if prints {
            let upon = name.get(..4).is_some_and(|head| head.eq_ignore_ascii_case("Upon"));
            let help = match upon {
                true => format!("write `Upon {}`, with a space", &name[4..]),
                false => "put it between a sequence name and its End".into(),
            };
            Diag::new(Code::PF001, "words to print are outside a sequence")
                .at(whole, "this line belongs to no sequence")
                .help(help)
        } else if self.first_sequence.is_some() && is_word(name) {
            no_name_line(whole)
        } else if is_like_a_format(name) {
            bad_format(whole, "can't be read")
        } else {
            unknown_name(name, span)
        };
        self.report(diag);
    }
}

/// Finds a control character in a text that is printed. `Name` is not checked, because this text is not printed. In old
/// forms, the name may contain control characters.
fn printed_control(id: CommandId, args: &[Spanned]) -> Option<(&Spanned, char)> {
    use CommandId::{Comment, Eob, Mod, Replace};
    if !matches!(id, Comment | Eob | Mod | Replace) {
        return None;
    }
    args.iter().find_map(|arg| Some((arg, arg.text.chars().find(|&c| c.is_control() && c != '\t')?)))
}

/// Whether the name looks like a letter format: a letter that is not followed by another letter of a name.
fn is_like_a_format(name: &str) -> bool {
    let mut bytes = name.bytes();
    bytes.next().is_some_and(|b| b.is_ascii_alphabetic())
        && bytes.next().is_none_or(|b| b"->+.~= ".contains(&b) || b.is_ascii_digit())
}
