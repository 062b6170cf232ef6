//! Proves a program while it is printed, on a separate thread.

use std::io;
use std::panic::resume_unwind;
use std::sync::mpsc::{Sender, channel, sync_channel};
use std::thread;

use postform::internals::post::Part;
use postform::internals::verify::Batch;
use postform::{Error, Job, Options, Post, Proof, Proven, Rendered};

/// Maximum number of batches that wait for the proof; then the printer waits, too. A batch is about 64 KB of program
/// text.
const WAITING: usize = 4;

/// A batch of events. The proof returns each batch after the comparison, so that the printer can use its memory again.
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
        // the proof clears the batch, because the printer is busier than the proof
        self.batch.events.clear();
        // an error only means that the printer has ended
        _ = self.back.send(std::mem::take(&mut self.batch));
    }
}

/// The results for a job.
pub struct Printed {
    /// The result of printing.
    pub rendered: Result<Rendered, Error>,
    /// The result of the proof, up to the last printed block.
    pub proven: Result<Proven, Error>,
}

/// Prints a job and proves its program, in one pass.
///
/// # Errors
/// A message: no thread is available.
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
            format!(
                "error: can't start a thread for the proof: {error}\n  help: --no-verify prints the program \
                without a proof"
            )
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
