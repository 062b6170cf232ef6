//! A program that is proven while it is printed, on a thread of its own.

use std::io;
use std::panic::resume_unwind;
use std::sync::mpsc::{Sender, channel, sync_channel};
use std::thread;

use postform::internals::post::Part;
use postform::internals::verify::Batch;
use postform::{Error, Job, Options, Post, Proof, Proven, Rendered};

/// How many batches wait for the proof, each of some 64 KB of program: the printer then waits, too.
const WAITING: usize = 4;

/// A batch that goes back when it is compared, so that its memory is used again.
struct Lent {
    batch: Batch,
    back: Sender<Batch>,
}

impl AsRef<Batch> for Lent {
    fn as_ref(&self) -> &Batch {
        &self.batch
    }
}

impl Drop for Lent {
    fn drop(&mut self) {
        // the printer has more to do than the proof
        self.batch.events.clear();
        // it wants none when it is done
        _ = self.back.send(std::mem::take(&mut self.batch));
    }
}

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
    let (back, used) = channel();
    thread::scope(|scope| {
        let proving =
            thread::Builder::new().spawn_scoped(scope, move || post.prove(receiver.into_iter(), options, proof));
        let proving = proving.map_err(|error| {
            format!("error: no thread can be started for the proof: {error}\n  help: --no-verify prints without one")
        })?;
        let rendered = post.render_beside(job, options, take, &mut |batch| {
            sender.send(Lent { batch, back: back.clone() }).ok()?;
            Some(used.try_recv().unwrap_or_default())
        });
        drop(sender);
        let proven = proving.join().unwrap_or_else(|fault| resume_unwind(fault));
        Ok(Printed { rendered, proven })
    })
}
