//! `Call`: the files that a form brings in.

use super::check::Analysis;
use super::limits::MOST_TEXT;
use crate::diag::{Code, Diag};
use crate::lang::CommandId;
use crate::source::Source;
use crate::span::Span;
use crate::syntax::{self, Head, Statement};

/// Deepest nesting of `Call`.
const MOST_CALLS: usize = 8;

impl Analysis {
    /// Parses a file and, in place of each `Call`, the file it names.
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
            if matches!(CommandId::parse(&statement.name.text), Some(CommandId::Call | CommandId::CallMe)) {
                let statement = statement.clone();
                self.call(&statement, open, load);
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
                Ok(source) if self.size + source.text.len() > MOST_TEXT => {
                    Some(format!("makes the form larger than {} KB", MOST_TEXT >> 10))
                }
                Ok(source) => {
                    self.called.insert(name.clone());
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
}
