//! The origin of a file's positions, its coordinate systems and the tool axis.

use super::fault::{Done, fault};
use super::job::Job;
use super::motion::enter_setup;
use super::setup::{Setups, lies_along};
use super::state::{Motion, State};
use super::words::{Word, numbers};
use crate::diag::Code;

/// Handles MSYS of NX, which gives the origin of positions.
pub(super) fn msys(words: &[Word], job: &mut Job<'_>) -> Done {
    one_origin("MSYS", words, job)
}

/// Handles MCS of Autodesk's post for CAMplete: the x, y and z axes of the frame of the positions, and then its origin.
/// In a file with several setups, each MCS with another frame begins a setup.
pub(super) fn mcs(words: &[Word], state: &mut State<'_>) -> Done {
    let State { job, motion, setups, .. } = state;
    let Some([x, z, origin]) =
        numbers(words).filter(|v| v.len() == 12).map(|v| [0, 6, 9].map(|i| [v[i], v[i + 1], v[i + 2]]))
    else {
        return fault(Code::PL004, "an MCS that can't be read", "write the x, y and z axes, and the origin");
    };
    match setups {
        Some(setups) => {
            job.close_holes()?;
            let begins = setups.mcs(x, z, origin);
            enter_setup(begins, setups, motion, job)?;
            job.drop_change();
        }
        None if lies_along(x, [1.0, 0.0, 0.0]) && lies_along(z, [0.0, 0.0, 1.0]) => one_origin("MCS", words, job)?,
        None => {
            let help = "`check` lists the setups of the file; print each with `--setup`";
            return fault(
                Code::PL004,
                "a turned MCS: the tool paths after it belong to another setup of the part",
                help,
            );
        }
    }
    job.end_heading()
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
            let help = match name {
                "MCS" => "`check` lists the setups of the file; print each with `--setup`".to_owned(),
                _ => format!("let the CAM system write a separate file for each {name}: each file is a setup"),
            };
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
