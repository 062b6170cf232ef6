//! `postform.toml`: what a shop wants everywhere, found upwards from the file that it is about.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use postform::internals::terminal::escaped;
use postform::{Control, ControlName, Levels, Limits};

use super::files::{self, io_message};

/// What holds for a file.
#[derive(Clone, Debug, Default)]
pub struct Config {
    /// The file itself, where there is one.
    pub path: Option<PathBuf>,
    /// The form of `render` and `verify`.
    pub form: Option<PathBuf>,
    /// Whose rules programs are run by.
    pub control: Option<&'static Control>,
    /// Limits of forms.
    pub limits: Option<Limits>,
    /// What editors print with the forms of the folder.
    pub jobs: Vec<PathBuf>,
    /// Programs that are not proven are not printed.
    pub require_proof: bool,
    /// What rules count as.
    pub levels: Levels,
    /// Values of properties of forms, by their names.
    pub properties: Vec<(String, String)>,
}

/// The name of the file.
const NAME: &str = "postform.toml";

/// Largest file that is read: a larger one is no configuration.
const LARGEST: u64 = 1 << 20;

impl Config {
    /// The configuration for a file: the first `postform.toml` in its folder or above. Standard input has that of the
    /// working folder.
    ///
    /// # Errors
    /// A message: the file is there and can't be read, or says something that makes no sense.
    pub fn near(path: &Path) -> Result<Config, String> {
        let path = if path == Path::new("-") { Path::new("./-") } else { path };
        let Ok(mut folder) = files::folder(path).canonicalize() else { return Ok(Config::default()) };
        loop {
            let candidate = folder.join(NAME);
            match fs::metadata(&candidate) {
                Ok(meta) if meta.is_file() => return Config::read(&candidate, meta.len()),
                Ok(_) => {
                    let help = "a configuration is one; take it away, or write the file";
                    return Err(format!("error: {} is no file\n  help: {help}", files::name(&candidate)));
                }
                // a link to nothing is there, and says that somebody wanted a configuration
                Err(error) if error.kind() != io::ErrorKind::NotFound || candidate.is_symlink() => {
                    return Err(io_message("read", &candidate, &error));
                }
                Err(_) => {}
            }
            if !folder.pop() {
                return Ok(Config::default());
            }
        }
    }

    fn read(path: &Path, length: u64) -> Result<Config, String> {
        let name = escaped(&path.to_string_lossy());
        if length > LARGEST {
            return Err(format!("error: {name} is larger than 1 MB: it is no configuration"));
        }
        Config::from_text(path, &fs::read_to_string(path).map_err(|error| io_message("read", path, &error))?)
    }

    /// What the text of the file says.
    ///
    /// # Errors
    /// A message: it makes no sense.
    pub fn from_text(path: &Path, text: &str) -> Result<Config, String> {
        let name = escaped(&path.to_string_lossy());
        let said = postform::Config::parse(text).map_err(|error| format!("error: {name}: {error}"))?;
        let folder = files::folder(path);
        let near = |file: &String| shortened(folder.join(file));
        let control = match &said.control {
            Some(ControlName::File(file)) => Some(files::control(&near(file))?),
            Some(ControlName::Known(control)) => Some(*control),
            _ => None,
        };
        Ok(Config {
            path: Some(path.to_path_buf()),
            form: said.form.as_ref().map(near),
            control,
            limits: said.limits,
            jobs: said.jobs.iter().map(near).collect(),
            require_proof: said.require_proof,
            levels: said.levels,
            properties: said.properties,
        })
    }
}

/// A path as people would type it: from the working folder where it is below.
fn shortened(path: PathBuf) -> PathBuf {
    let here = std::env::current_dir().and_then(|here| here.canonicalize());
    here.ok().and_then(|here| path.strip_prefix(here).ok().map(Path::to_path_buf)).unwrap_or(path)
}
