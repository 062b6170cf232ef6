//! The file name of a program.

use super::Options;
use super::ascii::plain;
use super::shape::Shape;
use super::want::Want;
use crate::compile::Program;
use crate::lang::{TextId, VarId};
use crate::number::write_number;
use crate::sema::{NamePart, is_of_file_names};
use crate::toolpath::Start;

/// Maximum length of a file name; every file system accepts this length.
const LONGEST: usize = 100;

/// The file name of a program, with its extension. The name of the job's file is used in two cases: the form defines no
/// name, or the job has none of the values in the name.
pub fn file_name(shape: &Shape, want: &Want) -> String {
    let settings = &shape.program.settings;
    let mut name = String::new();
    for part in &settings.program_name.0 {
        match part {
            NamePart::Typed(text) => name.push_str(text),
            NamePart::Text(TextId::Jobfile) => name.push_str(job_file(shape)),
            NamePart::Text(id) => name.push_str(want.texts.get(*id)),
            NamePart::Number => number(&mut name, shape, want),
        }
    }
    // typed text alone does not identify the program
    let said = settings.program_name.0.iter().any(|part| match part {
        NamePart::Typed(_) => false,
        NamePart::Text(id) => !want.texts.get(*id).is_empty() || *id == TextId::Jobfile,
        NamePart::Number => want.get(VarId::Program).is_some(),
    });
    let name = if said { name.as_str() } else { job_file(shape) };
    let spelt: String = plain(name).chars().map(|c| if is_of_file_names(c) { c } else { '_' }).take(LONGEST).collect();
    let name = spelt.trim_matches(['.', '_']);
    let name = if name.is_empty() { "program" } else { name };
    let mark = if is_device(name) { "_" } else { "" };
    format!("{mark}{name}.{}", settings.extension.0)
}

/// The file name of a program that is not printed yet, from the head of its job.
pub fn file_name_of(program: &Program, options: Options, start: &Start) -> String {
    let mut shape = Shape::new(program, options);
    // with wrong units nothing is printed, so the name does not matter
    _ = shape.choose_units(start.units);
    let mut want = Want::new(&shape);
    want.put(VarId::Program, shape.options.program.map(f64::from).or(start.program));
    want.texts.start(start, &shape);
    file_name(&shape, &want)
}

/// Whether this file name is a device name that Windows reserves. The extension is ignored.
fn is_device(name: &str) -> bool {
    let stem = name.split('.').next().unwrap_or_default().to_ascii_uppercase();
    let port = |begin: &str| stem.strip_prefix(begin).is_some_and(|n| n.len() == 1 && n.as_bytes()[0].is_ascii_digit());
    ["CON", "PRN", "AUX", "NUL"].contains(&stem.as_str()) || port("COM") || port("LPT")
}

/// The name of the job's file, without its extension.
fn job_file<'r>(shape: &'r Shape) -> &'r str {
    let file = shape.options.job_file.as_deref().unwrap_or_default();
    file.rsplit_once('.').map_or(file, |(stem, _)| stem)
}

/// Appends the program's number, in the format of the letter O.
fn number(name: &mut String, shape: &Shape, want: &Want) {
    let Some(number) = want.get(VarId::Program) else { return };
    let mut digits = Vec::new();
    let written = write_number(&mut digits, number as i64, &shape.letters[b'O'].format, false);
    match written.ok().and_then(|()| String::from_utf8(digits).ok()) {
        Some(digits) => name.push_str(&digits),
        None => name.push_str(&number.to_string()),
    }
}

#[cfg(test)]
mod tests {
    use super::is_device;

    #[test]
    fn names_of_devices_are_known() {
        assert!(["con", "NUL.x", "Com1"].into_iter().all(is_device));
        assert!(!["CONE", "COM10", "O1", ""].into_iter().any(is_device));
    }
}
