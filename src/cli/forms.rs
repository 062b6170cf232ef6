//! Forms from files, with those that they call.

use std::path::Path;

use postform::sema::{Checked, Limits, analyse};
use postform::source::Source;

use super::args::LimitsArg;
use super::files;

/// Reads and analyses a form. `Err` is a message: the file can't be read.
pub fn load(path: &Path, limits: LimitsArg) -> Result<Checked, String> {
    let source = Source::from_bytes(files::name(path), &files::read_form(path)?);
    let folder = path.parent().unwrap_or(Path::new("")).to_path_buf();
    let limits = match limits {
        LimitsArg::Classic => Limits::Classic,
        LimitsArg::Extended => Limits::Extended,
    };
    Ok(analyse(source, limits, &mut |name| called(&folder, name)))
}

/// A form that another one calls: in its folder or below, also when links are followed.
fn called(folder: &Path, name: &str) -> Result<Source, String> {
    let base = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let path = base.join(name);
    let (Ok(real), Ok(root)) = (path.canonicalize(), base.canonicalize()) else {
        return Err("can't be found".into());
    };
    if !real.starts_with(root) {
        return Err("is outside the form's folder".into());
    }
    let bytes = files::read_form(&real).map_err(|_| "can't be read".to_owned())?;
    Ok(Source::from_bytes(name, &bytes))
}
