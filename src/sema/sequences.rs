//! Analyses sequences: their names, counts, ends and lines.

use indexmap::map::Entry;

use super::args::Arguments;
use super::check::Analysis;
use super::flow::Flow;
use super::messages::{duplicate_sequence, in_backquotes, is_word, no_name_line, unknown_name};
use super::model::{Line, Sequence, Upon};
use super::names::{Context, variable};
use super::settings::Settings;
use super::step::{Step, first_list, line_counts};
use super::words::resolve;
use crate::diag::{Code, Diag};
use crate::lang::{Args, CommandId, Machines, SequenceId, SequenceName};
use crate::span::Span;
use crate::syntax::{Body, End, Piece, PieceKind, SequenceNode, Spanned, Tail, Word};

impl Analysis {
    pub(super) fn sequence(&mut self, node: &SequenceNode) {
        let span = node.name.line.span;
        if node.end.is_none() && !node.body.iter().any(|body| torn_end(body).is_some()) {
            let is_cycle = SequenceId::parse(&node.name.name.text).is_some_and(|id| id.row().is_cycle);
            self.report(
                Diag::new(Code::PF002, format!("{} has no End", node.name.name.text)).at(span, "this sequence").help(
                    match is_cycle {
                        true => "write `End Cancel` alone on a line after its last line (`End` after single moves)",
                        false => "write `End` alone on a line after its last line",
                    },
                ),
            );
        }
        let mut words = vec![node.name.name.text.as_str()];
        words.extend(node.name.args.iter().map(|arg| arg.text.as_str()));
        for body in &node.body {
            if body.directive.is_some() {
                self.limits_of(body);
            }
            if !body.words.is_empty() {
                self.limits_of(body);
                self.glued_end(body);
                self.command_inside(body);
            }
        }
        let settings = &self.form.settings;
        let context = Context { comment: &settings.comment, settings };
        let (mut lines, mut flow) = (Vec::new(), Flow::default());
        let found = self.diags.len();
        for body in &node.body {
            if let Some(directive) = &body.directive {
                flow.directive(directive, &context, &mut self.diags);
            } else if !body.words.is_empty() {
                flow.line(lines.len());
                lines.push(resolve(body, &context, &mut self.diags));
            }
        }
        let steps = flow.finish(&mut self.diags);
        let torn = self.diags[found..].iter().any(|diag| [Code::PF703, Code::PF707].contains(&diag.code));
        let lines = Lines { lines, steps, torn };
        match SequenceName::parse(&words) {
            None if is_word(&node.name.name.text) => self.report(no_name_line(span)),
            None => self.report(unknown_name(&node.name.name.text, node.name.name.span)),
            Some(SequenceName::Plain(id, count)) => {
                self.on_this_machine(id.name(), id.row().machines, span);
                self.plain_sequence(node, id, count, lines);
            }
            Some(name @ (SequenceName::Upon(var) | SequenceName::UponEvery(var))) => {
                self.on_this_machine("Upon", Machines::of("M"), span);
                self.plain_end(node.end.as_ref());
                let at = node.name.args.last().map_or(span, |arg| arg.span);
                let spanned = Spanned { text: var.trim_matches(['[', ']', '<', '>']).to_owned(), span: at };
                if let Some(var) = variable(&spanned, &self.form.settings, &mut self.diags) {
                    let every = matches!(name, SequenceName::UponEvery(_));
                    if let Some(first) = self.form.upons.iter().find(|u| u.var == var) {
                        let diag = duplicate_sequence(&format!("Upon [{}]", var.name()), span, first.span);
                        self.report(diag);
                        return;
                    }
                    self.form.upons.push(Upon { var, every, span, lines: lines.lines, steps: lines.steps });
                }
            }
        }
    }

    fn plain_sequence(&mut self, node: &SequenceNode, id: SequenceId, count: Option<&str>, lines: Lines) {
        let span = node.name.line.span;
        let cancel = if id.row().is_cycle && id != SequenceId::Cancel {
            self.end_cancel(node.end.as_ref())
        } else {
            self.plain_end(node.end.as_ref());
            None
        };
        let Lines { lines, steps, torn } = lines;
        let is_none = lines.len() == 1 && is_none(&node.body);
        let (least, most) = steps.as_ref().map_or((lines.len(), lines.len()), |steps| line_counts(steps));
        let counted = count.is_some();
        let count = count.and_then(|text| self.count(node, id, text, least));
        if id.row().is_cycle && id != SequenceId::Cancel && !counted && least <= 1 && most > 1 && !torn {
            self.report(
                Diag::new(
                    Code::PF709,
                    format!(
                        "the branches of {} print {least} or {most} lines: these are two kinds of cycles",
                        id.name()
                    ),
                )
                .at(
                    span,
                    "with one line the control repeats the cycle, with several lines postform prints them \
                        at each hole",
                )
                .help(
                    "give all branches one line, or give all branches several lines, or give the sequence a \
                        count",
                ),
            );
        }
        if least == 0 && most > 0 && must_print(id) && !torn {
            self.report(
                Diag::new(Code::PF709, format!("a branch of {} prints nothing", id.name()))
                    .at(span, "if no condition is true, or in a branch without lines")
                    .help("add `@else` with the lines for this case: a move, a hole or a tool change would be lost"),
            );
        }
        let list = steps.as_deref().and_then(first_list).filter(|_| is_often(id));
        if let Some((each, at)) = list {
            self.report(
                Diag::new(Code::PF707, format!("@for {} in {}", each.name(), id.name()))
                    .at(at, "this would print the whole list each time")
                    .help("print lists in StartCode, EndCode or a tool change"),
            );
        }
        let remark = match &node.name.line.tail {
            Tail::Lost(lost) => Some(lost.text.trim().to_owned()),
            _ => None,
        };
        let lines = if is_none { Vec::new() } else { lines };
        let sequence = Sequence { id, span, count, remark, is_none, cancel, lines, steps };
        match self.form.sequences.entry(id) {
            Entry::Occupied(first) => {
                let diag = duplicate_sequence(id.name(), span, first.get().span);
                self.report(diag);
            }
            Entry::Vacant(entry) => _ = entry.insert(sequence),
        }
    }

    /// Reads the count of an advanced cycle: the number of lines that print at the first hole only.
    fn count(&mut self, node: &SequenceNode, id: SequenceId, text: &str, lines: usize) -> Option<usize> {
        let at = node.name.args.last().map_or(node.name.line.span, |arg| arg.span);
        if !id.row().is_cycle {
            self.report(
                Diag::new(Code::PF405, format!("{} is not a canned cycle", id.name()))
                    .at(at, "only a canned cycle can have a count")
                    .help("put at least three spaces between the name and a comment"),
            );
            return None;
        }
        let Ok(count) = text.parse::<usize>() else {
            self.report(
                Diag::new(Code::PF405, format!("`{text}` is not a number of lines"))
                    .at(at, "here")
                    .help("a count is a whole number; put at least three spaces between the name and a comment"),
            );
            return None;
        };
        if count == 0 || count > lines {
            self.report(
                Diag::new(
                    Code::PF401,
                    format!("the count of {} is {count}, but the number of lines in its body is {lines}", id.name()),
                )
                .at(at, format!("from 1 to {lines}"))
                .help("the count is the number of first lines that are printed only at the first hole"),
            );
            return None;
        }
        Some(count)
    }

    /// Reads the `End` of a canned cycle, which may be `End Cancel`.
    fn end_cancel(&mut self, end: Option<&End>) -> Option<Span> {
        let args = &end?.args;
        let cancel = args.first().filter(|word| word.text.eq_ignore_ascii_case("Cancel"));
        if let Some(word) = args.get(usize::from(cancel.is_some())) {
            self.report(
                Diag::new(Code::PF001, format!("`{}` after End", word.text))
                    .at(word.span, "unknown")
                    .help("only `Cancel` may follow End, once"),
            );
        }
        cancel.map(|word| word.span)
    }

    /// Checks the `End` of a sequence that is not a canned cycle.
    fn plain_end(&mut self, end: Option<&End>) {
        let Some((end, word)) = end.and_then(|end| Some((end, end.args.first()?))) else { return };
        let diag =
            Diag::new(Code::PF405, format!("`{}` after the End of a sequence that is not a canned cycle", word.text));
        // `END PGM` is the last line of a program in Klartext (Heidenhain)
        self.report(if word.text.eq_ignore_ascii_case("PGM") {
            let last = end.args.last().map_or(word.span, |last| last.span);
            in_backquotes(diag.at(word.span, "text of the control"), end.word.to(last))
        } else {
            diag.at(word.span, "take this out").help("only a canned cycle can be cancelled")
        });
    }

    fn on_this_machine(&mut self, name: &str, machines: Machines, span: Span) {
        let machine = self.form.settings.machine;
        if !machines.has(machine) {
            self.report(
                Diag::new(Code::PF603, format!("{name} is for {machines}, but this form is for {}", machine.name()))
                    .at(span, format!("not on a {}", machine.name()))
                    .help("remove it, or set the type of machine with `Machine`"),
            );
        }
    }

    /// Reports a line like `EndCancel`, which would be printed as a word.
    fn glued_end(&mut self, body: &Body) {
        if let Some((text, span, meant)) = torn_end(body) {
            let diag = Diag::new(Code::PF002, format!("`{text}` is not an End")).at(span, "words of the output");
            self.report(diag.help(format!("write `{meant}`")));
        }
    }

    /// Reports a command between the name and the End of a sequence, where the command would be printed as words. A
    /// line counts as a command only if its arguments are valid. Commands with text arguments are not checked, because
    /// conversational controls use words such as `CALL` and `NAME` too.
    fn command_inside(&mut self, body: &Body) {
        let Some((first, args)) = body.words.split_first().filter(|(_, args)| !args.is_empty()) else { return };
        let [Piece { kind: PieceKind::Stray(name), .. }] = first.pieces.as_ref() else { return };
        let Some(id) = CommandId::parse(name).filter(|id| !matches!(id.row().args, Args::Text)) else { return };
        let spanned = |word: &Word| {
            let text = self.files[word.span.file as usize].slice(word.span).to_owned();
            Spanned { text, span: word.span }
        };
        let args: Vec<Spanned> = args.iter().map(spanned).collect();
        let span = args.iter().fold(first.span, |all, arg| all.to(arg.span));
        // apply the command to other settings, so that the form's settings do not change
        if Settings::blank().apply(&Arguments { id, all: &args, span, typed: true }).is_ok() {
            let diag = Diag::new(Code::PF020, format!("the command {} is inside a sequence", id.name()));
            let help = "move it above the first sequence; put a word of the control in backquotes";
            self.report(diag.at(span, "this would be printed").help(help));
        }
    }
}

/// Whether an event of the job is lost if the sequence prints nothing.
fn must_print(id: SequenceId) -> bool {
    use SequenceId as S;
    let moves = [S::RapidCode, S::LineCode, S::CwCode, S::CcwCode, S::InFeed, S::OutFeed, S::Index, S::Unwind];
    let changes = [
        S::FirstToolChange,
        S::ToolChange,
        S::SubCall,
        S::SubEnd,
        S::Stop,
        S::OptStop,
        S::MoveHome,
        S::EndCode,
        S::Cancel,
    ];
    id.row().is_cycle || moves.contains(&id) || changes.contains(&id)
}

/// Whether a sequence prints single moves or holes.
fn is_often(id: SequenceId) -> bool {
    use SequenceId as S;
    let moves = [S::RapidCode, S::LineCode, S::CwCode, S::CcwCode, S::InFeed, S::OutFeed];
    id.row().is_cycle || moves.contains(&id)
}

/// Finds a misspelt End, such as `EndCancel`, `End; Cancel` or `End;`. Returns the text, the location and the correct
/// spelling of the `End`.
fn torn_end(body: &Body) -> Option<(String, Span, &'static str)> {
    let texts: Option<Vec<&str>> = body
        .words
        .iter()
        .map(|word| match word.pieces.as_ref() {
            [Piece { kind: PieceKind::Stray(text), .. }] => Some(text.as_str()),
            _ => None,
        })
        .collect();
    let text = texts?.join(" ");
    let meant = match text.to_ascii_lowercase().as_str() {
        "endcancel" | "end; cancel" | "end, cancel" => "End Cancel",
        "end;" => "End",
        _ => return None,
    };
    let span = body.words.first()?.span.to(body.words.last()?.span);
    Some((text, span, meant))
}

/// The lines of a sequence, and the directives that select them.
struct Lines {
    lines: Vec<Line>,
    steps: Option<Vec<Step>>,
    /// Whether a directive is wrong, so that it is unknown which lines print.
    torn: bool,
}

fn is_none(body: &[Body]) -> bool {
    body.iter().flat_map(|b| &b.words).all(|word| {
        matches!(word.pieces.as_ref(), [Piece { kind: PieceKind::Stray(text), .. }] if text.eq_ignore_ascii_case("None"))
    })
}
