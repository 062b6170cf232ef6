//! Selects one of the jobs in a document.

use super::document::{Document, Object};
use super::{Report, wrong};
use crate::diag::{Code, Diag};

/// The selected job.
pub(super) struct Job<'d> {
    /// Label of the job in FreeCAD.
    pub label: String,
    /// The object of the job. This object has the job's properties.
    pub object: &'d Object,
}

/// Whether an object is a job. The class of the object shows whether it is a job. FreeCAD 1.1 may have removed the
/// classes from a document of 0.20; then the properties of the object are checked.
fn is_job(object: &Object) -> bool {
    let properties = ["Operations", "Fixtures", "PostProcessor"];
    object
        .class()
        .map_or_else(|| properties.iter().all(|name| object.get(name).is_some()), |class| class == "ObjectJob")
}

/// Finds the job with this name or label. If no name is given, finds the only job of the document.
pub(super) fn job<'d>(document: &'d Document, asked: Option<&str>, report: &mut Report) -> Result<Job<'d>, Box<Diag>> {
    let jobs: Vec<(&str, &str, &Object)> = document
        .objects
        .iter()
        .filter(|(_, object)| is_job(object))
        .map(|(name, object)| (name.as_str(), object.text("Label").unwrap_or(name), object))
        .collect();
    let list: Vec<String> = jobs
        .iter()
        .map(|(name, label, _)| if name == label { format!("`{name}`") } else { format!("`{name}` ({label})") })
        .collect();
    let list = list.join(", ");
    let found: Vec<&(&str, &str, &Object)> = match asked {
        // each name occurs only once, but several jobs may have the same label
        Some(asked) => match jobs.iter().find(|(name, ..)| *name == asked) {
            Some(job) => vec![job],
            None => jobs.iter().filter(|(_, label, _)| *label == asked).collect(),
        },
        None => jobs.iter().collect(),
    };
    let &[&(name, label, object)] = found.as_slice() else {
        return match (asked, found.len()) {
            _ if jobs.is_empty() => {
                let help = "make a job in FreeCAD's CAM (Path) workbench, and save the document";
                wrong(Code::PD002, "the document has no CAM job", help)
            }
            (Some(asked), 0) => {
                wrong(Code::PD002, format!("the document has no job `{asked}`"), format!("the document has {list}"))
            }
            _ => {
                let help = format!("choose a job with `--job NAME`: {list}");
                wrong(Code::PD002, format!("the document has {} jobs to choose from", found.len()), help)
            }
        };
    };
    let version = document.version.split('R').next().unwrap_or_default();
    report.facts.push(format!("saved by FreeCAD {version}"));
    let shown = if name == label { String::new() } else { format!(" ({name})") };
    let others = if jobs.len() > 1 { format!(", of the jobs {list}") } else { String::new() };
    report.facts.push(format!("the job {label}{shown}{others}"));
    Ok(Job { label: label.to_owned(), object })
}
