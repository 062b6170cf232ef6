//! `postform.toml`: what a shop wants everywhere, found upwards from the file that it is about.

use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use clap::ValueEnum;
use serde::Deserialize;

use postform::diag::escaped;
use postform::internals::lint::{Level, Levels};

use postform::internals::control::{self, Control};

use super::args::LimitsArg;
use super::files::{self, io_message};

/// What the file may say.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    form: Option<PathBuf>,
    control: Option<NamedControl>,
    limits: Option<String>,
    #[serde(default, rename = "require-proof")]
    require_proof: bool,
    #[serde(default)]
    jobs: Vec<PathBuf>,
    #[serde(default)]
    rules: BTreeMap<String, String>,
}

/// `control = "haas"`, or a file that describes one.
#[derive(Debug, Deserialize)]
#[serde(untagged)]
enum NamedControl {
    Name(String),
    File { file: PathBuf },
}

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
    pub limits: Option<LimitsArg>,
    /// What editors print with the forms of the folder.
    pub jobs: Vec<PathBuf>,
    /// Programs that are not proven are not printed.
    pub require_proof: bool,
    /// What rules count as.
    pub levels: Levels,
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
        let written: Written = toml::from_str(text).map_err(|error| {
            let known =
                "it may say form, control, limits, jobs, require-proof, and under [rules] codes as PF303 = \"off\"";
            format!("error: {name}: {}\n  help: {known}", error.to_string().trim_end())
        })?;
        let limits = written.limits.as_deref().map(|value| choice(&name, "limits", value)).transpose()?;
        let control = written.control.as_ref().map(|value| named_control(&name, path, value)).transpose()?;
        let mut levels = Levels::default();
        // a family first, so that its codes can be told apart whatever the order
        let mut rules: Vec<_> = written.rules.iter().collect();
        rules.sort_by_key(|(code, _)| code.len());
        for (code, level) in rules {
            let Some(parsed) = Level::parse(level) else {
                let levels = "off, note, warning or error";
                return Err(format!("error: {name}: {} = {level:?}: a rule is {levels}", escaped(code)));
            };
            levels.set(code, parsed).map_err(|why| format!("error: {name}: {} {why}", escaped(code)))?;
        }
        let folder = path.parent().unwrap_or(Path::new(""));
        let form = written.form.map(|form| shortened(folder.join(form)));
        let jobs = written.jobs.into_iter().map(|job| shortened(folder.join(job))).collect();
        let require_proof = written.require_proof;
        Ok(Config { path: Some(path.to_path_buf()), form, control, limits, jobs, require_proof, levels })
    }
}

/// A path as people would type it: from the working folder where it is below.
fn shortened(path: PathBuf) -> PathBuf {
    let here = std::env::current_dir().and_then(|here| here.canonicalize());
    here.ok().and_then(|here| path.strip_prefix(here).ok().map(Path::to_path_buf)).unwrap_or(path)
}

fn named_control(name: &str, path: &Path, value: &NamedControl) -> Result<&'static Control, String> {
    let value = match value {
        NamedControl::File { file } => return files::control(&shortened(files::folder(path).join(file))),
        NamedControl::Name(value) if control::is_file(value) => {
            return files::control(&shortened(files::folder(path).join(value)));
        }
        NamedControl::Name(value) => value,
    };
    Control::named(&value.to_ascii_lowercase()).ok_or_else(|| {
        let known: Vec<&str> = control::names().collect();
        format!("error: {name}: control = {value:?}: it is one of {}", known.join(", "))
    })
}

fn choice<T: ValueEnum>(name: &str, key: &str, value: &str) -> Result<T, String> {
    T::from_str(value, true).map_err(|_| {
        let known = T::value_variants().iter().filter_map(ValueEnum::to_possible_value);
        let known: Vec<String> = known.map(|value| value.get_name().to_owned()).collect();
        format!("error: {name}: {key} = {value:?}: it is one of {}", known.join(", "))
    })
}
