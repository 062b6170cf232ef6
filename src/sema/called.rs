//! Reads the files that a form names in the commands `Call`, `Control` and `MachineFile`.

use super::check::Analysis;
use super::limits::MOST_TEXT;
use crate::control::{self, Control, Wrong as WrongFile};
use crate::diag::{Code, Diag};
use crate::lang::CommandId;
use crate::machine;
use crate::source::Source;
use crate::span::Span;
use crate::syntax::{self, Head, Spanned, Statement};

/// Maximum nesting depth of files that call each other.
const MOST_CALLS: usize = 8;

/// Maximum size of a file that describes a control, in bytes.
const LARGEST_CONTROL: usize = 1 << 20;

/// Whether a file name leads out of the form's folder.
fn is_outside(name: &str) -> bool {
    name.starts_with(['/', '\\']) || name.contains(':') || name.split(['/', '\\']).any(|part| part == "..")
}

impl Analysis {
    /// Parses a file. At each `Call`, also parses the file that the `Call` names.
    pub(super) fn add_file(
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
        let file = number as usize;
        self.size += source.text.len();
        self.trees.push(syntax::parse(&source, number));
        self.files.push(source);
        for at in 0..self.trees[file].items.len() {
            self.order.push((number, at as u32));
            let Head::Statement(statement) = &self.trees[file].items[at] else { continue };
            match CommandId::parse(&statement.name.text) {
                Some(CommandId::Call | CommandId::CallMe) => {
                    let statement = statement.clone();
                    self.call(&statement, open, load);
                }
                Some(CommandId::Control) => {
                    let statement = statement.clone();
                    self.control_file(&statement, load);
                }
                Some(CommandId::MachineFile) => {
                    let statement = statement.clone();
                    self.machine_file(&statement, load);
                }
                _ => {}
            }
        }
    }

    /// Reads the file of a control, as in `Control my.toml`.
    fn control_file(&mut self, statement: &Statement, load: &mut dyn FnMut(&str) -> Result<Source, String>) {
        let [arg] = &statement.args[..] else { return };
        if !control::is_file(&arg.text) {
            return;
        }
        let Some(source) = self.beside(arg, Code::PF019, "a control's file", load) else { return };
        match Control::own(&source.name, &source.text) {
            Ok(control) => self.control = Some(control),
            Err(wrong) => self.wrong_file(Code::PF019, source, wrong, (arg, "the control of this form")),
        }
    }

    /// Reads the file of a machine, as in `MachineFile vf2.toml`, and the files that this file names.
    fn machine_file(&mut self, statement: &Statement, load: &mut dyn FnMut(&str) -> Result<Source, String>) {
        let [arg] = &statement.args[..] else { return };
        let Some(source) = self.beside(arg, Code::PF021, "a machine's file", load) else { return };
        let load = std::cell::RefCell::new(load);
        let further = |name: &str| match is_outside(name) {
            true => Err(format!("`{name}` is outside the form's folder")),
            false => (load.borrow_mut())(name).map(|source| source.text).map_err(|why| format!("`{name}` {why}")),
        };
        if let Err(wrong) = machine::read(&source.name, &source.text, &further) {
            self.wrong_file(Code::PF021, source, wrong, (arg, "the machine of this form"));
        }
    }

    /// The text of a file in the form's folder. Reports an error if the file can't be read.
    fn beside(
        &mut self,
        arg: &Spanned,
        code: Code,
        what: &str,
        load: &mut dyn FnMut(&str) -> Result<Source, String>,
    ) -> Option<Source> {
        let loaded = if is_outside(&arg.text) { Err("is outside the form's folder".into()) } else { load(&arg.text) };
        match loaded {
            Ok(source) if source.text.len() <= LARGEST_CONTROL => Some(source),
            loaded => {
                let why = loaded.err().unwrap_or_else(|| format!("is larger than {} KB", LARGEST_CONTROL >> 10));
                let help = format!("put {what} into the form's folder, as `my-vf2.toml`");
                self.report(Diag::new(code, format!("`{}` {why}", arg.text)).at(arg.span, "named here").help(help));
                None
            }
        }
    }

    /// Reports an error inside a file that the form names.
    fn wrong_file(&mut self, code: Code, source: Source, wrong: WrongFile, (arg, of): (&Spanned, &str)) {
        let number = self.files.len() as u32;
        let rest = source.text.get(wrong.start..).unwrap_or_default();
        let end = rest.find(['\n', ' ', '}']).map_or(source.text.len(), |at| wrong.start + at);
        let mut diag = Diag::new(code, wrong.message).at(Span::new(number, wrong.start, end), "here").at(arg.span, of);
        if !wrong.help.is_empty() {
            diag = diag.help(wrong.help);
        }
        self.trees.push(syntax::Form::default());
        self.files.push(source);
        self.report(diag);
    }

    fn call(
        &mut self,
        statement: &Statement,
        open: &mut Vec<String>,
        load: &mut dyn FnMut(&str) -> Result<Source, String>,
    ) {
        let name = statement.argument();
        let problem = if name.is_empty() {
            return; // another finding reports a missing argument
        } else if is_outside(&name) {
            Some("is outside the form's folder".to_owned())
        } else if open.contains(&name) || self.called.contains(&name) {
            Some(
                "was called before: a form can be called only once, and it can't call itself through other forms"
                    .to_owned(),
            )
        } else if open.len() >= MOST_CALLS {
            Some(format!("is called at a depth of {MOST_CALLS} calls"))
        } else {
            match load(&name) {
                Ok(source) if self.size + source.text.len() > MOST_TEXT => {
                    Some(format!("makes the form larger than {} KB", MOST_TEXT >> 10))
                }
                Ok(source) => {
                    self.called.insert(name.clone());
                    open.push(name.clone());
                    self.calls.push((statement.line.span, self.files.len() as u32));
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
}
