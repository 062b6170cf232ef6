//! Analyses a whole form. Each item of the form is read once, and all findings are collected in one run.

use std::collections::HashSet;

use super::args::choice_of;
use super::limits::Limits;
use super::model::Form;
use super::property::fields_of_tools;
use super::settings::Settings;
use super::upon_sets;
use crate::control::Control;
use crate::diag::{Code, Diag};
use crate::lang::{CommandId, Machine, SEQUENCES, SequenceId, UnitChoice};
use crate::source::Source;
use crate::span::Span;
use crate::syntax::{self, Head};

/// An analysed form.
#[derive(Debug)]
pub struct Checked {
    /// The files of the form: the main file first, then the files that it calls.
    pub files: Vec<Source>,
    /// The syntax trees of the files.
    pub trees: Vec<syntax::Form>,
    /// The lines that call files, each with the index of the called file.
    pub calls: Vec<(Span, u32)>,
    /// The analysed form, from all files together.
    pub form: Form,
    /// The findings so far, unsorted.
    pub diags: Vec<Diag>,
}

impl Checked {
    /// Whether the form has errors. A form with errors can't be rendered.
    pub fn has_errors(&self) -> bool {
        self.diags.iter().any(Diag::is_error)
    }
}

/// Analyses a form. `load` takes a file name relative to the form's folder, and returns the file or the reason why the
/// file can't be read.
pub fn analyse(main: Source, limits: Limits, load: &mut dyn FnMut(&str) -> Result<Source, String>) -> Checked {
    let mut analysis = Analysis { limits, ..Analysis::default() };
    analysis.add_file(main, &mut vec![], load);
    let trees = std::mem::take(&mut analysis.trees);
    let item_at = |&(file, at): &(u32, u32)| &trees[file as usize].items[at as usize];
    let mut items: Vec<&Head> = analysis.order.iter().map(item_at).collect();
    if let Some(second) = analysis.second_post(&items) {
        items.truncate(second);
    }
    analysis.settings(&items);
    for item in &items {
        analysis.item(item);
    }
    analysis.whole();
    Checked { files: analysis.files, trees, calls: analysis.calls, form: analysis.form, diags: analysis.diags }
}

#[derive(Default)]
pub(super) struct Analysis {
    pub(super) limits: Limits,
    pub(super) files: Vec<Source>,
    /// Names of the files that were called.
    pub(super) called: HashSet<String>,
    /// Total size of all files in bytes.
    pub(super) size: usize,
    pub(super) trees: Vec<syntax::Form>,
    /// The items of all files in reading order: number of the file, and index of the item in its tree.
    pub(super) order: Vec<(u32, u32)>,
    pub(super) calls: Vec<(Span, u32)>,
    /// The control of the form, if a file describes this control.
    pub(super) control: Option<&'static Control>,
    pub(super) form: Form,
    pub(super) diags: Vec<Diag>,
    pub(super) commands_seen: Vec<(CommandId, Span)>,
    pub(super) first_sequence: Option<Span>,
    pub(super) line_count: usize,
    pub(super) over_lines: Option<Span>,
}

impl Analysis {
    pub(super) fn report(&mut self, diag: Diag) {
        self.diags.push(diag);
    }

    /// Reads machine and units before all other commands, because the defaults of other commands depend on machine and
    /// units.
    fn settings(&mut self, items: &[&Head]) {
        let find = |id: CommandId| {
            items.iter().find_map(|item| match item {
                Head::Statement(s) if CommandId::parse(&s.name.text) == Some(id) => {
                    s.args.first().and_then(|arg| choice_of(id, &arg.text))
                }
                _ => None,
            })
        };
        let machine = find(CommandId::Machine).and_then(Machine::parse).unwrap_or_default();
        let units = find(CommandId::Units).and_then(UnitChoice::parse).unwrap_or_default();
        let properties = fields_of_tools(self.files.iter().map(|file| file.text.as_str()));
        self.form.settings = Settings { control: self.control, properties, ..Settings::new(machine, units) };
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
                // words like `End Code` are probably a misspelling of `EndCode`
                let text = self.files[line.span.file as usize].slice(line.span);
                let joined: String = text.split_whitespace().take(2).collect();
                let help = match SequenceId::parse(&joined) {
                    Some(id) => format!("write `{}`", id.name()),
                    None => "remove this End, or give the lines above it a sequence name".into(),
                };
                self.report(
                    Diag::new(Code::PF007, "End is outside a sequence")
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

    /// Makes the checks that need the whole form.
    fn whole(&mut self) {
        self.line_limit();
        // a `Between` sequence without `SubsFirst` implies that subprograms come first
        let says = self.commands_seen.iter().any(|(id, _)| *id == CommandId::SubsFirst);
        if !says && self.form.sequences.contains_key(&SequenceId::Between) {
            self.form.settings.subs_first = true;
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
        upon_sets::check(&self.form, &mut self.diags);
        let cancelled = || self.form.sequences.values().filter_map(|s| s.cancel.map(|span| (s.id.name(), span)));
        if let Some((_, first)) = cancelled().next().filter(|_| !self.form.sequences.contains_key(&SequenceId::Cancel))
        {
            let names: Vec<_> = cancelled().map(|(name, _)| name).collect();
            let verb = if names.len() == 1 { "ends" } else { "end" };
            self.report(
                Diag::new(Code::PF402, format!("{} {verb} with Cancel, but the form has no Cancel", names.join(", ")))
                    .at(first, "nothing would be printed here")
                    .help("add a sequence `Cancel` with G80"),
            );
        }
    }
}
