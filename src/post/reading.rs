//! Prepares the events of a job for a form.

use crate::control::Control;
use crate::error::Error;
use crate::job::Job;
use crate::sema::Settings;
use crate::toolpath::{Cuts, Sink};

/// Calls `read`, which pushes the events of a job to a sink. If the form is for a torch or a laser, the begin and end of
/// each cut are added to the events.
pub fn taken<R>(settings: Option<&Settings>, sink: &mut dyn Sink, read: impl FnOnce(&mut dyn Sink) -> R) -> R {
    match settings.filter(|settings| settings.beam.is_some()) {
        Some(settings) => read(&mut Cuts::new(sink, settings.is_flat)),
        None => read(sink),
    }
}

/// Reads a job for a form. If operations are left out, the codes in their text have the meanings of the form's control.
pub fn read_for(settings: Option<&Settings>, job: &mut Job<'_>, sink: &mut dyn Sink) -> Result<(), Error> {
    let codes = settings.map_or_else(Control::of_no_name, Settings::codes);
    taken(settings, sink, |sink| job.read_by(codes, sink))
}
