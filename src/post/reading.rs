//! Prepares the events of a job for a form.

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
