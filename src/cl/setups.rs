//! Setups: where the positions of a file count from, and which way its tool points.

use super::fault::{Done, fault};
use super::job::Job;
use super::setup::Setups;
use super::state::Motion;
use super::words::{Word, numbers};
use crate::diag::Code;

/// Components of unit vectors that differ by less are one.
const SAME: f64 = 1e-3;

/// MSYS: where positions count from. One work offset can't stand for two.
pub(super) fn msys(words: &[Word], job: &mut Job<'_>) -> Done {
    match &job.setup {
        None => job.setup = Some((words.to_vec(), job.notes.place.line)),
        Some((before, _)) if before.as_slice() == words => {}
        Some((_, line)) => {
            let message = format!("this MSYS is not that of line {line}: its positions count from another place");
            let help = "let NX write the operations of each MSYS into a file of their own: each is a setup";
            return fault(Code::PL004, message, help);
        }
    }
    Ok(())
}

/// CSYS of SolidWorks CAM: three rows of a rotation, each with a distance behind it.
pub(super) fn csys(words: &[Word], motion: &mut Motion, setups: &mut Option<Setups>, job: &mut Job<'_>) {
    if let Some(setups) = setups {
        if let (Some(rows), 12) = (numbers(words), words.len()) {
            setups.csys([rows[0], rows[4], rows[8]], [rows[2], rows[6], rows[10]]);
        }
        return;
    }
    if let Some(Word::Number(up)) = words.get(10).filter(|_| words.len() == 12) {
        motion.frame = Some((*up, job.notes.place.line));
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
pub(super) fn must_agree((up, line): (f64, u64), axis: [f64; 3]) -> Done {
    if (up - axis[2]).abs() < SAME {
        return Ok(());
    }
    let message = format!("the CSYS of line {line} has its z axis elsewhere than this tool: it is another setup");
    let help = "let the CAM system write the operations of each setup into a file of their own";
    fault(Code::PL004, message, help)
}
