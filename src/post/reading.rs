//! A job as a form takes it.

use crate::sema::Settings;
use crate::toolpath::{Cuts, Sink};

/// Lets `read` push the events of a job to a sink. Of a torch or a laser the sink is told where cuts begin and end.
pub fn taken<R>(settings: Option<&Settings>, sink: &mut dyn Sink, read: impl FnOnce(&mut dyn Sink) -> R) -> R {
    match settings.filter(|settings| settings.beam.is_some()) {
        Some(settings) => read(&mut Cuts::new(sink, settings.is_flat)),
        None => read(sink),
    }
}
