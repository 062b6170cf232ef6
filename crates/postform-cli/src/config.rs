//! `postform.toml`: what a shop wants everywhere, found upwards from the file that it is about.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use postform::internals::lang::did_you_mean;
use postform::internals::lint::Changed;
use postform::internals::terminal::escaped;
use postform::{Control, ControlName, Levels, Limits, Property};

use super::files::{self, io_message};
use super::forms::FormFile;

/// What holds for a file.
#[derive(Clone, Debug, Default)]
pub struct Config {
    /// The file itself, where there is one.
    pub path: Option<PathBuf>,
    /// The form of `render` and `verify`.
    pub form: Option<PathBuf>,
    /// Whose rules programs are run by.
    pub control: Option<&'static Control>,
    /// The machine on which programs run.
    pub machine: Option<PathBuf>,
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
    /// What `postform test` does.
    pub test: Tests,
}

/// [test] of the configuration.
#[derive(Clone, Debug, Default)]
pub struct Tests {
    /// The forms, or folders of forms.
    pub forms: Vec<PathBuf>,
    /// The post of a form that holds several.
    pub post: Option<String>,
    /// Names of what is no difference, as `diff --ignore` takes them.
    pub ignore: Vec<String>,
    /// How near numbers must be.
    pub tolerance: f64,
    /// The day on which programs are printed.
    pub date: Option<String>,
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
            if is_common(&folder) {
                return Ok(Config::default());
            }
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
        super::inputs::note(path);
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
            machine: said.machine.as_ref().map(near),
            limits: said.limits,
            jobs: said.jobs.iter().map(near).collect(),
            require_proof: said.require_proof,
            levels: said.levels,
            properties: said.properties,
            test: Tests {
                forms: said.test.forms.iter().map(near).collect(),
                post: said.test.post,
                ignore: said.test.ignore,
                tolerance: said.test.tolerance,
                date: said.test.date,
            },
        })
    }
}

/// Files that are searched for forms with a property.
const MOST_FILES: usize = 2000;

impl Config {
    /// Refuses a name under `[properties]` that no form of the folder has; `own` are those of the form in question.
    ///
    /// # Errors
    /// A message with what was meant.
    pub fn check_properties(&self, own: &[Property]) -> Result<(), String> {
        let Some(path) = &self.path else { return Ok(()) };
        let mut strange: Vec<&str> = self.properties.iter().map(|(name, _)| name.as_str()).collect();
        strange.retain(|name| !has(own, name));
        if strange.is_empty() || !self.others(files::folder(path), &mut strange) {
            return Ok(());
        }
        let Some(name) = strange.first() else { return Ok(()) };
        let names = own.iter().map(|property| property.name.as_str());
        let help = did_you_mean(name, names).unwrap_or_else(|| {
            "`postform properties FORM` lists those of a form; take the line out, or fix its name".into()
        });
        let file = files::name(path);
        Err(format!(
            "error: {file}: `{name}` under [properties] is no property of a form of its folder\n  help: {help}"
        ))
    }

    /// Takes out the names that forms of the folder and below have. `false`: there are more files than are searched.
    fn others(&self, folder: &Path, names: &mut Vec<&str>) -> bool {
        let (mut folders, mut left) = (vec![folder.to_path_buf()], MOST_FILES);
        while let (Some(folder), false) = (folders.pop(), names.is_empty()) {
            for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
                let Some(rest) = left.checked_sub(1) else { return false };
                left = rest;
                let path = entry.path();
                if entry.file_type().is_ok_and(|kind| kind.is_dir()) {
                    folders.push(path);
                } else if files::is_form(&path)
                    && path.is_file()
                    && let Ok(form) = FormFile::read(&path, self.limits.unwrap_or_default())
                {
                    let form = form.analyse(&Changed::new()).form;
                    names.retain(|name| !has(&form.settings.properties, name));
                }
            }
        }
        true
    }
}

fn has(properties: &[Property], name: &str) -> bool {
    properties.iter().any(|property| property.name.eq_ignore_ascii_case(name))
}

/// Is a folder the root, or one in which everybody may make files, as /tmp? A file there is not the shop's.
fn is_common(folder: &Path) -> bool {
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        const STICKY: u32 = 0o1002;
        if fs::metadata(folder).is_ok_and(|meta| meta.permissions().mode() & STICKY == STICKY) {
            return true;
        }
    }
    folder.parent().is_none()
}

/// A path as people would type it: from the working folder where it is below.
pub fn shortened(path: PathBuf) -> PathBuf {
    let here = std::env::current_dir().and_then(|here| here.canonicalize());
    here.ok().and_then(|here| path.strip_prefix(here).ok().map(Path::to_path_buf)).unwrap_or(path)
}
