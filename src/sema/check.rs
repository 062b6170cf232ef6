//! The whole form: every item once, every finding of the file in one run.

use indexmap::map::Entry;

use super::args::choice_of;
use super::messages::{bad_format, duplicate_format, duplicate_sequence, is_word, no_name_line, unknown_name};
use super::model::{Form, Sequence, Upon};
use super::settings::{Settings, UnitChoice};
use super::words::{Context, resolve, variable};
use crate::diag::{Code, Diag, Severity};
use crate::lang::{CommandId, Machine, Machines, SEQUENCES, SequenceId, SequenceName};
use crate::number::LetterFormat;
use crate::source::Source;
use crate::span::Span;
use crate::syntax::{self, Body, End, Head, Piece, PieceKind, SequenceNode, Spanned, Statement, Tail};

/// How strictly the classic limits hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Limits {
    /// 15 words a line, 150 lines: over it is an error.
    #[default]
    Classic,
    /// The same as warnings.
    Extended,
}

/// Most words on a sequence line, as the manual says.
pub const MOST_WORDS: usize = 15;
/// Most sequence lines in a form, as the manual says.
pub const MOST_LINES: usize = 150;
/// Deepest nesting of `Call`.
const MOST_CALLS: usize = 8;

/// A form that was analysed.
#[derive(Debug)]
pub struct Checked {
    /// The files: the form itself first, then those that it calls.
    pub files: Vec<Source>,
    /// Their trees.
    pub trees: Vec<syntax::Form>,
    /// What they mean together.
    pub form: Form,
    /// Everything found so far, in no order.
    pub diags: Vec<Diag>,
}

impl Checked {
    /// Can it be rendered?
    pub fn has_errors(&self) -> bool {
        self.diags.iter().any(Diag::is_error)
    }
}

/// Analyses a form. `load` brings the files that `Call` names, relative to the form's folder, or says why not.
pub fn analyse(main: Source, limits: Limits, load: &mut dyn FnMut(&str) -> Result<Source, String>) -> Checked {
    let mut analysis = Analysis { limits, ..Analysis::default() };
    analysis.add_file(main, &mut vec![], load);
    let items = std::mem::take(&mut analysis.items);
    analysis.settings(&items);
    for item in &items {
        analysis.item(item);
    }
    analysis.whole();
    Checked { files: analysis.files, trees: analysis.trees, form: analysis.form, diags: analysis.diags }
}

#[derive(Default)]
struct Analysis {
    limits: Limits,
    files: Vec<Source>,
    /// The forms that were called, by the names they were called by.
    called: Vec<String>,
    trees: Vec<syntax::Form>,
    items: Vec<Head>,
    form: Form,
    diags: Vec<Diag>,
    commands_seen: Vec<(CommandId, Span)>,
    first_sequence: Option<Span>,
    line_count: usize,
    over_lines: Option<Span>,
}

impl Analysis {
    fn report(&mut self, diag: Diag) {
        self.diags.push(diag);
    }

    /// Parses a file and, in place of each `Call`, the file it names.
    fn add_file(
        &mut self,
        source: Source,
        open: &mut Vec<String>,
        load: &mut dyn FnMut(&str) -> Result<Source, String>,
    ) {
        let number = self.files.len() as u32;
        if source.was_windows_1252 {
            self.report(
                Diag::new(Code::PF008, "the file is not UTF-8 and was read as Windows-1252")
                    .at(Span::new(number, 0, 0), "from here")
                    .help("save it as UTF-8"),
            );
        }
        let tree = syntax::parse(&source, number);
        self.files.push(source);
        self.trees.push(tree.clone());
        for item in tree.items {
            self.items.push(item.clone());
            if let Head::Statement(statement) = &item
                && matches!(CommandId::parse(&statement.name.text), Some(CommandId::Call | CommandId::CallMe))
            {
                self.call(statement, open, load);
            }
        }
    }

    fn call(
        &mut self,
        statement: &Statement,
        open: &mut Vec<String>,
        load: &mut dyn FnMut(&str) -> Result<Source, String>,
    ) {
        let name = statement.args.iter().map(|a| a.text.as_str()).collect::<Vec<_>>().join(" ");
        let outside = name.starts_with(['/', '\\']) || name.contains(':') || name.split(['/', '\\']).any(|p| p == "..");
        let problem = if name.is_empty() {
            return; // reported as a missing argument
        } else if outside {
            Some("is outside the form's folder".to_owned())
        } else if open.contains(&name) || self.called.contains(&name) {
            Some("was called before: each form once, and no circles".to_owned())
        } else if open.len() >= MOST_CALLS {
            Some(format!("is called {MOST_CALLS} deep"))
        } else {
            match load(&name) {
                Ok(source) => {
                    self.called.push(name.clone());
                    open.push(name.clone());
                    self.add_file(source, open, load);
                    open.pop();
                    None
                }
                Err(why) => Some(why),
            }
        };
        if let Some(why) = problem {
            self.report(
                Diag::new(Code::PF009, format!("`{name}` {why}"))
                    .at(statement.line.span, "called here")
                    .help("call a form of the same folder, as `Call common.pf`"),
            );
        }
    }

    /// Machine and units come first: the defaults of the others depend on them.
    fn settings(&mut self, items: &[Head]) {
        let find = |id: CommandId| {
            items.iter().find_map(|item| match item {
                Head::Statement(s) if CommandId::parse(&s.name.text) == Some(id) => {
                    s.args.first().and_then(|arg| choice_of(id, &arg.text))
                }
                _ => None,
            })
        };
        let machine = find(CommandId::Machine).and_then(Machine::parse).unwrap_or_default();
        let units = match find(CommandId::Units) {
            Some("mm") => UnitChoice::Mm,
            Some("both") => UnitChoice::Both,
            _ => UnitChoice::Inch,
        };
        self.form.settings = Settings::new(machine, units);
    }

    fn item(&mut self, item: &Head) {
        match item {
            Head::Blank(_) => {}
            Head::Format { line, letter, spec } => {
                self.in_order(line.span, "letter format");
                self.format(letter, spec);
            }
            Head::Statement(statement) => self.statement(statement),
            Head::StrayEnd(line) => {
                // `End Code` was meant to be one word
                let text = self.files[line.span.file as usize].slice(line.span);
                let joined: String = text.split_whitespace().take(2).collect();
                let help = match SequenceId::parse(&joined) {
                    Some(id) => format!("write `{}`", id.name()),
                    None => "take it out, or give the lines above it a sequence name".into(),
                };
                self.report(
                    Diag::new(Code::PF007, "End stands outside a sequence")
                        .at(line.span, "no sequence is open here")
                        .help(help),
                );
            }
            Head::Sequence(node) => {
                let span = node.name.line.span;
                if self.first_sequence.is_none_or(|first| first.file != span.file) {
                    self.first_sequence = Some(span);
                }
                self.sequence(node);
            }
        }
    }

    fn in_order(&mut self, span: Span, what: &str) {
        if let Some(first) = self.first_sequence.filter(|first| first.file == span.file) {
            self.report(
                Diag::new(Code::PF003, format!("a {what} after the first sequence"))
                    .at(span, format!("this {what}"))
                    .at(first, "the first sequence")
                    .help("move it above the first sequence"),
            );
        }
    }

    fn format(&mut self, letter: &Spanned, spec: &Spanned) {
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

    fn statement(&mut self, statement: &Statement) {
        let (name, span) = (&statement.name.text, statement.name.span);
        let Some(id) = CommandId::parse(name) else {
            let is_variable = |text: &String| text.contains('[') || (text.contains('<') && text.ends_with('>'));
            let whole = statement.args.iter().fold(statement.name.span, |all, arg| all.to(arg.span));
            if is_variable(name) || statement.args.iter().any(|arg| is_variable(&arg.text)) {
                let upon = name.get(..4).is_some_and(|head| head.eq_ignore_ascii_case("Upon"));
                let help = match upon {
                    true => format!("write `Upon {}`, with a blank", &name[4..]),
                    false => "put it between a sequence name and its End".into(),
                };
                self.report(
                    Diag::new(Code::PF001, "words that print stand outside a sequence")
                        .at(whole, "this line belongs to no sequence")
                        .help(help),
                );
                return;
            }
            let mut chars = name.bytes();
            let first_is_letter = chars.next().is_some_and(|b| b.is_ascii_alphabetic());
            if self.first_sequence.is_some() && is_word(name) {
                self.report(no_name_line(whole));
            } else if first_is_letter && chars.next().is_none_or(|b| b"->+.~ ".contains(&b) || b.is_ascii_digit()) {
                self.report(bad_format(whole, "can't be read"));
            } else {
                self.report(unknown_name(name, span));
            }
            return;
        };
        if id != CommandId::Thread {
            self.in_order(statement.line.span, "command");
        }
        if id == CommandId::ArcPlane
            && let Some(&(_, centre)) = self.commands_seen.iter().find(|(seen, _)| *seen == CommandId::CtrCode)
        {
            self.report(
                Diag::new(Code::PF003, "ArcPlane stands after CtrCode")
                    .at(statement.line.span, "move this up")
                    .at(centre, "before this"),
            );
        }
        if !id.row().repeats {
            if let Some(&(_, first)) = self.commands_seen.iter().find(|(seen, _)| *seen == id) {
                self.report(
                    Diag::new(Code::PF006, format!("{} is there twice", id.name()))
                        .at(statement.line.span, "again here")
                        .at(first, "first here")
                        .help("keep one of them"),
                );
                return;
            }
            self.commands_seen.push((id, statement.line.span));
        }
        if let Err(bad) = self.form.settings.apply(id, &statement.args, statement.line.span) {
            let at = bad.span.unwrap_or(statement.line.span);
            let mut diag = Diag::new(Code::PF302, bad.message).at(at, "here");
            if let Tail::Lost(lost) = &statement.line.tail {
                diag = diag.at(lost.span, "two blanks before this make it a comment");
            }
            let default = id.row().default;
            diag.help = Some(if default.is_empty() {
                format!("{}: {}", id.name(), id.row().meaning)
            } else {
                format!("{}: {} (without the command: {default})", id.name(), id.row().meaning)
            });
            self.report(diag);
        }
    }

    fn sequence(&mut self, node: &SequenceNode) {
        let span = node.name.line.span;
        if node.end.is_none() {
            self.report(
                Diag::new(Code::PF002, format!("{} has no End", node.name.name.text))
                    .at(span, "this sequence")
                    .help("write `End` on a line of its own after its last line"),
            );
        }
        let mut words = vec![node.name.name.text.as_str()];
        words.extend(node.name.args.iter().map(|arg| arg.text.as_str()));
        let machine = self.form.settings.machine;
        let comment = self.form.settings.comment.clone();
        let context = Context { machine, comment: &comment };
        let mut lines = Vec::new();
        for body in &node.body {
            if body.words.is_empty() {
                continue;
            }
            self.line_count += 1;
            if self.line_count == MOST_LINES + 1 {
                self.over_lines = Some(body.line.span);
            }
            self.words_limit(body);
            self.glued_end(body);
            lines.push(resolve(body, &context, &mut self.diags));
        }
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
                if let Some(var) = variable(&spanned, machine, &mut self.diags) {
                    let every = matches!(name, SequenceName::UponEvery(_));
                    if let Some(first) = self.form.upons.iter().find(|u| u.var == var) {
                        let diag = duplicate_sequence(&format!("Upon [{}]", var.name()), span, first.span);
                        self.report(diag);
                        return;
                    }
                    self.form.upons.push(Upon { var, every, span, lines });
                }
            }
        }
    }

    fn plain_sequence(&mut self, node: &SequenceNode, id: SequenceId, count: Option<&str>, lines: Vec<super::Line>) {
        let span = node.name.line.span;
        let cancel = if id.row().is_cycle && id != SequenceId::Cancel {
            self.end_cancel(node.end.as_ref())
        } else {
            self.plain_end(node.end.as_ref());
            None
        };
        let is_none = lines.len() == 1 && is_none(&node.body);
        let count = count.and_then(|text| self.count(node, id, text, lines.len()));
        let remark = match &node.name.line.tail {
            Tail::Lost(lost) => Some(lost.text.trim().to_owned()),
            _ => None,
        };
        let lines = if is_none { Vec::new() } else { lines };
        let sequence = Sequence { id, span, count, remark, is_none, cancel, lines };
        match self.form.sequences.entry(id) {
            Entry::Occupied(first) => {
                let diag = duplicate_sequence(id.name(), span, first.get().span);
                self.report(diag);
            }
            Entry::Vacant(entry) => _ = entry.insert(sequence),
        }
    }

    /// The count of an advanced cycle.
    fn count(&mut self, node: &SequenceNode, id: SequenceId, text: &str, lines: usize) -> Option<usize> {
        let at = node.name.args.last().map_or(node.name.line.span, |arg| arg.span);
        if !id.row().is_cycle {
            self.report(
                Diag::new(Code::PF405, format!("{} is no canned cycle", id.name()))
                    .at(at, "only a canned cycle has a count")
                    .help("a remark stands at least three blanks after the name"),
            );
            return None;
        }
        let Ok(count) = text.parse::<usize>() else {
            self.report(
                Diag::new(Code::PF405, format!("`{text}` is no count of lines"))
                    .at(at, "here")
                    .help("a count is a whole number; a remark stands at least three blanks after the name"),
            );
            return None;
        };
        if count == 0 || count > lines {
            self.report(
                Diag::new(Code::PF401, format!("{} counts {count} lines, its body has {lines}", id.name()))
                    .at(at, format!("from 1 to {lines}"))
                    .help("the count says how many of the first lines are printed at the first hole only"),
            );
            return None;
        }
        Some(count)
    }

    /// `End Cancel` of a canned cycle.
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

    /// `End` of a sequence that is no canned cycle.
    fn plain_end(&mut self, end: Option<&End>) {
        if let Some(word) = end.and_then(|end| end.args.first()) {
            self.report(
                Diag::new(Code::PF405, format!("`{}` after the End of a sequence that is no canned cycle", word.text))
                    .at(word.span, "take this out")
                    .help("only a canned cycle is cancelled"),
            );
        }
    }

    fn on_this_machine(&mut self, name: &str, machines: Machines, span: Span) {
        let machine = self.form.settings.machine;
        if !machines.has(machine) {
            self.report(
                Diag::new(Code::PF603, format!("{name} is for {machines}, this form is for {}", machine.name()))
                    .at(span, format!("not on a {}", machine.name()))
                    .help("take it out, or say with `Machine` what the form is for"),
            );
        }
    }

    /// `EndCancel` is a word like any other, and would be printed.
    fn glued_end(&mut self, body: &Body) {
        let [word] = body.words.as_slice() else { return };
        if let [Piece { kind: PieceKind::Stray(text), span }] = word.pieces.as_slice()
            && text.eq_ignore_ascii_case("EndCancel")
        {
            let diag = Diag::new(Code::PF002, format!("`{text}` is no End")).at(*span, "a word of the output");
            self.report(diag.help("write `End Cancel`"));
        }
    }

    fn words_limit(&mut self, body: &Body) {
        let count: usize = body.words.iter().map(|w| w.pieces.len()).sum();
        if count <= MOST_WORDS {
            return;
        }
        let mut pieces = body.words.iter().flat_map(|word| &word.pieces);
        let at = pieces.nth(MOST_WORDS).map_or(body.line.span, |piece| piece.span);
        let mut diag = Diag::new(Code::PF601, format!("{count} words on a line, the limit is {MOST_WORDS}"))
            .at(at, format!("word {}", MOST_WORDS + 1))
            .help("break the line in two; `--limits extended` makes this a warning");
        self.soften(&mut diag);
        self.report(diag);
    }

    fn soften(&self, diag: &mut Diag) {
        if self.limits == Limits::Extended {
            diag.severity = Severity::Warning;
        }
    }

    /// What only the whole form shows.
    fn whole(&mut self) {
        if let Some(at) = self.over_lines {
            let text = format!("{} sequence lines, the limit is {MOST_LINES}", self.line_count);
            let mut diag = Diag::new(Code::PF602, text)
                .at(at, format!("line {}", MOST_LINES + 1))
                .help("take out sequences that are not used; `--limits extended` makes this a warning");
            self.soften(&mut diag);
            self.report(diag);
        }
        let machine = self.form.settings.machine;
        let end = self.files.first().map_or(0, |file| file.text.len());
        for sequence in SEQUENCES.iter().filter(|s| s.required.has(machine)) {
            if !self.form.sequences.contains_key(&sequence.id) {
                let here = Span::new(0, end, end);
                self.report(
                    Diag::new(Code::PF005, format!("the form has no {}", sequence.name))
                        .at(here, "the form ends here")
                        .help(format!("add the sequence: {}", sequence.meaning)),
                );
            }
        }
        let cancels: Vec<_> = self.form.sequences.values().filter_map(|s| s.cancel.map(|span| (s.id, span))).collect();
        if !self.form.sequences.contains_key(&SequenceId::Cancel) {
            for (id, span) in cancels {
                self.report(
                    Diag::new(Code::PF402, format!("{} ends with Cancel, but the form has no Cancel", id.name()))
                        .at(span, "nothing would be printed here")
                        .help("add a sequence `Cancel` with G80"),
                );
            }
        }
    }
}

fn is_none(body: &[Body]) -> bool {
    body.iter().flat_map(|b| &b.words).all(|word| {
        matches!(word.pieces.as_slice(), [syntax::Piece { kind: syntax::PieceKind::Stray(text), .. }] if text.eq_ignore_ascii_case("None"))
    })
}
