//! The origin of a file's positions, its coordinate systems and the tool axis.

use super::fault::{Done, fault};
use super::job::Job;
use super::setup::{Setups, lies_along};
use super::state::Motion;
use super::words::{Word, numbers};
use crate::diag::Code;

/// Handles MSYS of NX, which gives the origin of positions.
pub(super) fn msys(words: &[Word], job: &mut Job<'_>) -> Done {
    one_origin("MSYS", words, job)
}

/// Handles MCS of CAMplete's post: the three rows of a rotation, and then the origin of positions.
pub(super) fn mcs(words: &[Word], job: &mut Job<'_>) -> Done {
    let upright =
        |v: &[f64]| lies_along([v[0], v[1], v[2]], [1.0, 0.0, 0.0]) && lies_along([v[6], v[7], v[8]], [0.0, 0.0, 1.0]);
    if !numbers(words).is_some_and(|values| values.len() == 12 && upright(&values)) {
        let help = "let the CAM system write a separate file for each setup, with its MCS upright";
        return fault(Code::PL004, "an MCS that is turned, or that can't be read", help);
    }
    one_origin("MCS", words, job)
}

/// Checks that the file has only one origin of positions. One work offset can't represent two origins.
fn one_origin(name: &str, words: &[Word], job: &mut Job<'_>) -> Done {
    match &job.setup {
        None => job.setup = Some((words.to_vec(), job.notes.place.line)),
        Some((before, _)) if before.as_slice() == words => {}
        Some((_, line)) => {
            let message = format!(
                "this {name} differs from the {name} of line {line}: the positions after it have another origin"
            );
            let help = format!("let the CAM system write a separate file for each {name}: each file is a setup");
            return fault(Code::PL004, message, help);
        }
    }
    Ok(())
}

/// Handles CSYS of SolidWorks CAM: the three rows of a rotation, each followed by a distance.
pub(super) fn csys(words: &[Word], motion: &mut Motion, setups: &mut Option<Setups>, job: &mut Job<'_>) {
    if let (Some(rows), 12) = (numbers(words), words.len()) {
        let z = [rows[2], rows[6], rows[10]];
        motion.frame = Some((z, job.notes.place.line));
        if let Some(setups) = setups {
            setups.csys([rows[0], rows[4], rows[8]], z);
        }
    }
    if setups.is_none() {
        one_work_offset(words, job); // else each setup has its own frame
    }
}

/// Warns of a coordinate system that differs from the first one. Both are printed in the same work offset.
pub(super) fn one_work_offset(words: &[Word], job: &mut Job<'_>) {
    match &job.setup {
        None => job.setup = Some((words.to_vec(), job.notes.place.line)),
        Some((before, line)) if before.as_slice() != words => {
            let message =
                format!("this CSYS differs from the CSYS of line {line}, but both are printed in the same work offset");
            let help = "check in the CAM system that both have the same origin; if not, post each setup separately";
            job.notes.warn(Code::PL008, message, help);
        }
        Some(_) => {}
    }
}

/// Checks the first motion in a coordinate system. The tool axis of the motion must be the z axis of the coordinate
/// system.
#[cold]
pub(super) fn must_agree((z, line): ([f64; 3], u64), axis: [f64; 3]) -> Done {
    if lies_along(z, axis) {
        return Ok(());
    }
    let message = format!("the tool axis is not the z axis of the CSYS of line {line}: this is another setup");
    let help = format!(
        "put TLAXIS/{},{},{} after the CSYS if the tool points along it, or let the CAM system write each setup into \
         a separate file",
        z[0], z[1], z[2]
    );
    fault(Code::PL004, message, help)
}
