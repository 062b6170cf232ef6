//! Setups: where the positions of a file count from, and which way its tool points.

use super::fault::{Done, fault};
use super::job::Job;
use super::setup::{Setups, lies_along};
use super::state::Motion;
use super::words::{Word, numbers};
use crate::diag::Code;

/// MSYS of NX: where positions count from.
pub(super) fn msys(words: &[Word], job: &mut Job<'_>) -> Done {
    one_origin("MSYS", words, job)
}

/// MCS of CAMplete's post: three rows of a rotation, then where positions count from.
pub(super) fn mcs(words: &[Word], job: &mut Job<'_>) -> Done {
    let upright =
        |v: &[f64]| lies_along([v[0], v[1], v[2]], [1.0, 0.0, 0.0]) && lies_along([v[6], v[7], v[8]], [0.0, 0.0, 1.0]);
    if !numbers(words).is_some_and(|values| values.len() == 12 && upright(&values)) {
        let help = "let the CAM system write the operations of each setup into a file of their own, upright";
        return fault(Code::PL004, "an MCS that is turned, or that can't be read", help);
    }
    one_origin("MCS", words, job)
}

/// One work offset can't stand for two origins.
fn one_origin(name: &str, words: &[Word], job: &mut Job<'_>) -> Done {
    match &job.setup {
        None => job.setup = Some((words.to_vec(), job.notes.place.line)),
        Some((before, _)) if before.as_slice() == words => {}
        Some((_, line)) => {
            let message = format!("this {name} is not that of line {line}: its positions count from another place");
            let help = format!(
                "let the CAM system write the operations of each {name} into a file of their own: each is a setup"
            );
            return fault(Code::PL004, message, help);
        }
    }
    Ok(())
}

/// CSYS of SolidWorks CAM: three rows of a rotation, each with a distance after it.
pub(super) fn csys(words: &[Word], motion: &mut Motion, setups: &mut Option<Setups>, job: &mut Job<'_>) {
    if let (Some(rows), 12) = (numbers(words), words.len()) {
        let z = [rows[2], rows[6], rows[10]];
        motion.frame = Some((z, job.notes.place.line));
        if let Some(setups) = setups {
            setups.csys([rows[0], rows[4], rows[8]], z);
        }
    }
    if setups.is_some() {
        return; // each setup has a frame of its own
    }
    match &job.setup {
        None => job.setup = Some((words.to_vec(), job.notes.place.line)),
        Some((before, line)) if before.as_slice() != words => {
            let message = format!("this CSYS is not that of line {line}, and one work offset is printed for both");
            let help = "see in the CAM system whether the positions of both count from one place; if not, post each setup by itself";
            job.notes.warn(Code::PL008, message, help);
        }
        Some(_) => {}
    }
}

/// The first motion in a coordinate system: the tool must point along its z axis.
#[cold]
pub(super) fn must_agree((z, line): ([f64; 3], u64), axis: [f64; 3]) -> Done {
    if lies_along(z, axis) {
        return Ok(());
    }
    let message = format!("the CSYS of line {line} has its z axis elsewhere than this tool: it is another setup");
    let help = format!(
        "put TLAXIS/{},{},{} after the CSYS if the tool points along it, or let the CAM system write each setup into a file of its own",
        z[0], z[1], z[2]
    );
    fault(Code::PL004, message, help)
}
