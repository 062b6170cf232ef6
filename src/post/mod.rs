//! The main API: compiles a form, prints jobs with it, and verifies the programs.

mod ahead;
mod follow;
mod growth;
mod naming;
mod options;
mod origin;
mod program;
pub mod reading;
mod render;
mod sample;
mod setup;
pub mod shipped;
mod verify;

pub use follow::{Followed, Seen};
pub use options::{Options, Proof};
pub use program::{Part, Program, Rendered};
pub use sample::{sample_job, sample_program};
pub use verify::Proven;

use std::sync::Arc;

use crate::compile;
use crate::control::Control;
use crate::diag::{Diag, Findings};
use crate::error::Error;
use crate::lang::{TextId, VarId};
use crate::lint::{Levels, ready};
use crate::sema::{Limits, Property, analyse};
use crate::source::Source;

/// Supplies the forms that a form includes with `Call`.
pub trait Files {
    /// Returns the form with this name. The name is the one in `Call`, relative to the calling form.
    ///
    /// # Errors
    /// The form can't be read. The error text continues a sentence that begins with the name of the form, such as
    /// `can't be found`.
    fn read(&self, name: &str) -> Result<Source, String>;
}

/// Supplies no forms: every `Call` is an error.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoFiles;

impl Files for NoFiles {
    fn read(&self, _: &str) -> Result<Source, String> {
        Err("can't be found: only one form was given".into())
    }
}

impl<F: Fn(&str) -> Result<Source, String>> Files for F {
    fn read(&self, name: &str) -> Result<Source, String> {
        self(name)
    }
}

/// A prompt of a form: a question to the user.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Prompt<'a> {
    /// The variable that the answer sets.
    pub variable: &'static str,
    /// Text of the prompt.
    pub text: &'a str,
    /// The value if there is no answer.
    pub default: Option<f64>,
}

/// A compiled form, which prints programs. A post is checked and immutable. Clones share the same data, also between
/// threads.
#[derive(Clone, Debug)]
pub struct Post(Arc<Compiled>);

#[derive(Debug)]
struct Compiled {
    program: compile::Program,
    findings: Findings,
}

impl Post {
    /// Checks and compiles a form with the default limits and levels.
    ///
    /// # Errors
    /// The form has errors. The returned error contains the errors and warnings of the form.
    pub fn compile(form: Source, files: &dyn Files) -> Result<Post, Error> {
        Post::compile_with(form, files, Limits::default(), &Levels::default())
    }

    /// Checks and compiles a form with limits and levels that a shop sets.
    ///
    /// # Errors
    /// The form has errors, or findings that these levels make errors.
    pub fn compile_with(form: Source, files: &dyn Files, limits: Limits, levels: &Levels) -> Result<Post, Error> {
        let checked = analyse(form, limits, &mut |name| files.read(name));
        let found = ready(&checked, levels);
        match found {
            Ok(ready) => Ok(Post::of(ready.program, ready.findings, &checked.files)),
            Err(diags) => Err(Error::form(Findings { diags, files: checked.files, suppressed: 0 })),
        }
    }

    /// Creates a post from a compiled form and the warnings and notes about it.
    pub(crate) fn of(program: compile::Program, diags: Vec<Diag>, files: &[Source]) -> Post {
        let program = program.identified(files);
        let findings = Findings { diags, files: files.to_vec(), suppressed: 0 };
        Post(Arc::new(Compiled { program, findings }))
    }

    /// The control named in the form.
    pub fn control(&self) -> Option<&'static Control> {
        self.0.program.settings.control
    }

    /// The machine file that the form names, relative to the form's folder.
    pub fn machine_file(&self) -> Option<&str> {
        self.0.program.settings.machine_file.as_deref()
    }

    /// The prompts of the form. The answers to the prompts go into [`Options::set`].
    pub fn prompts(&self) -> impl Iterator<Item = Prompt<'_>> {
        let prompts = self.0.program.settings.prompts.iter();
        prompts.map(|prompt| Prompt { variable: prompt.var.row().name, text: &prompt.text, default: prompt.default })
    }

    /// The properties of the form. The values of properties go into [`Options::properties`].
    pub fn properties(&self) -> &[Property] {
        let all = &self.0.program.settings.properties;
        // the fields of tools come first; their values come from the job
        &all[all.iter().take_while(|property| property.of_tool().is_some()).count()..]
    }

    /// Whether the form prints the date or time of printing. If the form prints one of them, set [`Options::clock`].
    pub fn says_time(&self) -> bool {
        let texts = self.0.program.texts_printed;
        texts.has(TextId::Date) || texts.has(TextId::Time)
    }

    /// Whether the form prints the program number of the job.
    pub fn prints_program_number(&self) -> bool {
        self.0.program.printed.has(VarId::Program)
    }

    /// The form's warnings and notes, with its text. The list contains no errors, because a form with errors is never
    /// compiled.
    pub fn findings(&self) -> &Findings {
        &self.0.findings
    }

    /// The files of the form: the main file first, then those that it calls. The file numbers in spans are indices of this list.
    pub fn files(&self) -> &[Source] {
        &self.0.findings.files
    }
}
