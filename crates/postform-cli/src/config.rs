//! `postform.toml`: a shop's settings, searched in the folder of a file and the folders above.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use postform::internals::lang::did_you_mean;
use postform::internals::lint::Changed;
use postform::internals::terminal::escaped;
use postform::{Control, ControlName, Levels, Limits, Property};

use super::files::{self, io_message};
use super::forms::FormFile;

/// The settings for a file.
#[derive(Clone, Debug, Default)]
pub struct Config {
    /// The path of `postform.toml`, if there is one.
    pub path: Option<PathBuf>,
    /// The form of `render` and `verify`.
    pub form: Option<PathBuf>,
    /// The control that is simulated when postform runs programs.
    pub control: Option<&'static Control>,
    /// The machine on which programs run.
    pub machine: Option<PathBuf>,
    /// Limits of forms.
    pub limits: Option<Limits>,
    /// Jobs that the language server and `watch` print with the forms of the folder.
    pub jobs: Vec<PathBuf>,
    /// Whether a program is printed only if it is proven.
    pub require_proof: bool,
    /// Severities of rules.
    pub levels: Levels,
    /// Values of properties of forms, by their names.
    pub properties: Vec<(String, String)>,
    /// The settings of `postform test`.
    pub test: Tests,
}

/// The section `[test]` of the configuration.
#[derive(Clone, Debug, Default)]
pub struct Tests {
    /// The forms, or folders of forms.
    pub forms: Vec<PathBuf>,
    /// The post to use from a form that contains several.
    pub post: Option<String>,
    /// Names of ignored differences, as in `diff --ignore`.
    pub ignore: Vec<String>,
    /// Largest difference at which numbers are equal.
    pub tolerance: f64,
    /// The date with which programs are printed.
    pub date: Option<String>,
}

/// The name of the file.
const NAME: &str = "postform.toml";

impl Config {
    /// The configuration for a file: the first `postform.toml` in its folder or a folder above. For standard input, the
    /// working folder is used.
    ///
    /// # Errors
    /// A message: the file exists but can't be read, or contains a value that makes no sense.
    pub fn near(path: &Path) -> Result<Config, String> {
        let path = if path == Path::new("-") { Path::new("./-") } else { path };
        let Ok(mut folder) = files::folder(path).canonicalize() else { return Ok(Config::default()) };
        loop {
            if is_common(&folder) {
                return Ok(Config::default());
            }
            let candidate = folder.join(NAME);
            match fs::metadata(&candidate) {
                Ok(meta) if meta.is_file() => {
                    return Config::from_text(&candidate, &files::small_text(&candidate, "a configuration")?);
                }
                Ok(_) => {
                    let help = "postform.toml must be a file: remove or replace it";
                    return Err(format!("error: {} is not a file\n  help: {help}", files::name(&candidate)));
                }
                // a broken link counts as an existing file, because a configuration was intended
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

    /// Reads the text of the file.
    ///
    /// # Errors
    /// A message: the text makes no sense.
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

/// Maximum number of files that are searched for forms with a property.
const MOST_FILES: usize = 2000;

impl Config {
    /// Refuses a name under `[properties]` that no form of the folder has; `own` are the properties of the current form.
    ///
    /// # Errors
    /// A message with the intended name.
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
            "`postform properties FORM` lists the properties of a form; remove the line, or fix the name of the \
             property"
                .into()
        });
        let file = files::name(path);
        Err(format!(
            "error: {file}: no form in this folder has the property `{name}` (under [properties])\n  help: {help}"
        ))
    }

    /// Removes from `names` each property of a form in the folder or its subfolders. Returns `false` if there are more
    /// files than the maximum.
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

/// Whether the folder is the root folder, or a folder in which every user may create files, such as /tmp. A
/// postform.toml in such a folder does not belong to the shop.
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

/// A path as people type it: relative to the working folder if the path is inside that folder.
pub fn shortened(path: PathBuf) -> PathBuf {
    let here = std::env::current_dir().and_then(|here| here.canonicalize());
    here.ok().and_then(|here| path.strip_prefix(here).ok().map(Path::to_path_buf)).unwrap_or(path)
}
