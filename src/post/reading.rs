//! Preparation of a job for a form.

use crate::sema::Settings;
use crate::toolpath::{Cuts, Sink};

/// Runs `read`, which pushes the events of a job to a sink. For a torch or a laser, events for the begin and end of cuts are
/// added.
pub fn taken<R>(settings: Option<&Settings>, sink: &mut dyn Sink, read: impl FnOnce(&mut dyn Sink) -> R) -> R {
    match settings.filter(|settings| settings.beam.is_some()) {
        Some(settings) => read(&mut Cuts::new(sink, settings.is_flat)),
        None => read(sink),
    }
}
