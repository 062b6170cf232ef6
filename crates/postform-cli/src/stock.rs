//! Rapids through the stock: `verify --stock`.

use std::io::{Read, Seek};
use std::path::Path;

use postform::diag::Diag;
use postform::internals::nc::RunSettings;
use postform::internals::preflight::{JobTool, Stock, StockCheck, check_stock};
use postform::internals::report::finding;
use postform::internals::terminal::escaped;
use postform::toolpath::Units;
use postform::{Job, Options, Post, Proof, Source};

use super::args::ControlArgs;
use super::files::io_message;
use super::machine::diag;
use super::report::{Reporter, count};
use super::say::{message, say};

/// A program and the stock that it cuts.
pub struct Milling<'a> {
    /// The stock, in the units of the job.
    pub block: Stock,
    /// The name of the program.
    pub program: &'a str,
    /// The form that printed the program, and the options of the rendering.
    pub form: Option<(&'a Post, &'a Options)>,
    /// Options for running a program without a form.
    pub control: &'a ControlArgs,
    /// Settings of the proof.
    pub proof: &'a Proof,
}

impl Milling<'_> {
    /// Runs the program in its stock.
    ///
    /// # Errors
    /// The job or the program can't be read.
    pub fn checked(&self, job: &mut Job<'_>, program: impl Read + Seek) -> Result<StockCheck, String> {
        let units = job.units().map_err(|error| format!("error: {error}"))?.unwrap_or(Units::Mm);
        let of_program = self.proof.units.unwrap_or(units);
        let (tools, settings) = match self.form {
            Some((post, _)) => (post.job_tools(job.again()), post.run_settings(self.proof, of_program)),
            None => (self.proof.job_tools(job.again()), self.settings(of_program)),
        };
        let tools: Vec<JobTool> = tools.map_err(|error| format!("error: {error}"))?;
        let block = self.block.scaled(units.in_mm());
        let mut checked = check_stock(program, settings, &block, &tools, units)
            .map_err(|error| io_message("read", Path::new(self.program), &error))?;
        if let Some((post, options)) = self.form {
            // if this fails, the findings stay without locations
            _ = post.locate(&mut checked.findings, job.again(), options);
        }
        Ok(checked)
    }

    fn settings(&self, units: Units) -> RunSettings {
        let settings = self.control.settings(None, units);
        RunSettings { control: self.proof.control.unwrap_or(settings.control), ..settings }
    }

    /// Shows the findings, and everything that is not checked.
    pub fn show(&self, checked: &StockCheck, (job, sources): (&Path, &[Source]), reporter: &Reporter) {
        let diags: Vec<Diag> = checked.findings.iter().map(|finding| diag(finding, self.program, &[job])).collect();
        say(&reporter.text(&diags, sources));
        for what in &checked.not_checked {
            message(&format!("not checked: {}", escaped(what)));
        }
        if checked.compensates {
            message("assumed: G41 and G42 compensate the radius of the tool");
        }
    }

    /// The result in a sentence.
    pub fn sentence(&self, checked: &StockCheck) -> String {
        let program = self.program;
        match checked.blocks {
            0 if checked.not_checked.is_empty() => format!("{program} makes no rapid through the stock\n"),
            0 => format!("{program} makes no rapid through the stock, as far as it was checked\n"),
            blocks => {
                let rest = blocks - checked.findings.len();
                let shown = if rest > 0 { format!("; {rest} of them are not shown") } else { String::new() };
                format!("{program} makes rapids through the stock: {}{shown}\n", count(blocks, "block"))
            }
        }
    }
}

/// The result as JSON; `files` are the files of the form.
pub fn document(checked: &StockCheck, files: &[Source]) -> serde_json::Value {
    serde_json::json!({
        "blocks": checked.blocks, "not_checked": checked.not_checked, "assumes_compensation": checked.compensates,
        "findings": checked.findings.iter().map(|found| finding(found, files)).collect::<Vec<_>>(),
    })
}
