//! A program that is proven while it is printed, on a thread of its own.

use std::io;
use std::panic::resume_unwind;
use std::sync::mpsc::sync_channel;
use std::thread;

use postform::{Error, Job, Options, Part, Post, Proof, Proven, Rendered};

/// How many batches wait for the proof, each of some 64 KB of program: the printer then waits, too.
const WAITING: usize = 4;

/// What came of a job.
pub struct Printed {
    /// Of printing it.
    pub rendered: Result<Rendered, Error>,
    /// Of its proof, as far as it was printed.
    pub proven: Result<Proven, Error>,
}

/// Prints a job and proves its program, in one pass.
///
/// # Errors
/// A message: there is no thread to be had.
pub fn print(
    post: &Post,
    job: Job<'_>,
    options: &Options,
    proof: &Proof,
    take: &mut dyn FnMut(Part<'_>) -> io::Result<()>,
) -> Result<Printed, String> {
    let (sender, receiver) = sync_channel(WAITING);
    thread::scope(|scope| {
        let proving =
            thread::Builder::new().spawn_scoped(scope, move || post.prove(receiver.into_iter(), options, proof));
        let proving = proving.map_err(|error| {
            format!("error: no thread can be started for the proof: {error}\n  help: --no-verify prints without one")
        })?;
        let rendered = post.render_beside(job, options, take, &mut |batch| sender.send(batch).is_ok());
        drop(sender);
        let proven = proving.join().unwrap_or_else(|fault| resume_unwind(fault));
        Ok(Printed { rendered, proven })
    })
}
