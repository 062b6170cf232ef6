//! The data of a setup sheet for a job.

use super::Post;
use super::options::Options;
use super::reading::read_for;
use crate::control::Control;
use crate::error::Error;
use crate::job::Job;
use crate::setup::{SetupSheet, Stops, of_job};

impl Post {
    /// The data of a setup sheet for a job that this form prints. The caller adds the program's verdict, pictures and hashes.
    ///
    /// # Errors
    /// The job can't be read twice, or contains an error.
    #[doc(hidden)]
    pub fn setup(&self, mut job: Job<'_>, options: &Options) -> Result<SetupSheet, Error> {
        job.hold()?;
        let (read, survey) = self.surveyed(&mut job, options, false);
        read?;
        let mut stops = Stops::default();
        read_for(Some(&self.0.program.settings), &mut job, &mut stops)?;
        // the number of the fixture, or the code
        let name = |work: f64| if work < 50.0 { format!("{work}") } else { format!("G{work}") };
        let mut sheet = of_job(&survey, stops, self.turns(), &name);
        let settings = &self.0.program.settings;
        let control = settings.control.unwrap_or_else(Control::usual);
        let control = if self.turns().is_some() { control.of_lathe() } else { control };
        sheet.control = control.title().to_owned();
        sheet.form = settings.name.clone();
        sheet.program = options.program.or(sheet.program);
        Ok(sheet)
    }
}
