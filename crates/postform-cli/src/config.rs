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
    /// Values of properties of forms.
    pub properties: Vec<Given>,
    /// The settings of `postform test`.
    pub test: Tests,
}

/// A value of a property.
#[derive(Clone, Debug)]
pub struct Given {
    /// The name of the property.
    pub name: String,
    /// The value, as a user would type it.
    pub value: String,
    /// The `postform.toml` with the value.
    file: PathBuf,
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

    /// The configuration for the program that a form prints for a job: the file for the job and the file for the form.
    ///
    /// # Errors
    /// A message: one of the files can't be read, or contains a value that makes no sense.
    pub fn of_program(job: &Path, form: &Path) -> Result<Config, String> {
        Ok(Config::near(job)?.over(Config::near(form)?))
    }

    /// Adds the settings of another file. If both files have a key, the key of `self` applies; a proof is required if
    /// one of the files requires it.
    pub fn over(self, other: Config) -> Config {
        if self.path == other.path {
            return self;
        }
        let is_own = |given: &Given| self.properties.iter().any(|own| own.name.eq_ignore_ascii_case(&given.name));
        let mut properties = other.properties;
        properties.retain(|given| !is_own(given));
        properties.extend(self.properties);
        let mut levels = other.levels;
        levels.extend(self.levels);
        Config {
            path: self.path.or(other.path),
            form: self.form.or(other.form),
            control: self.control.or(other.control),
            machine: self.machine.or(other.machine),
            limits: self.limits.or(other.limits),
            jobs: if self.jobs.is_empty() { other.jobs } else { self.jobs },
            require_proof: self.require_proof || other.require_proof,
            levels,
            properties,
            test: self.test,
        }
    }

    /// The values of properties, by their names, as [`postform::Options`] takes them.
    pub fn shop_properties(&self) -> Vec<(String, String)> {
        self.properties.iter().map(|given| (given.name.clone(), given.value.clone())).collect()
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
            properties: said
                .properties
                .into_iter()
                .map(|(name, value)| Given { name, value, file: path.to_path_buf() })
                .collect(),
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
    /// Refuses a name under `[properties]` that no form has. The searched forms are those in the folder of the form, in
    /// the folder of the `postform.toml` with the name, and below. `own` are the properties of the form.
    ///
    /// # Errors
    /// A message with the intended name.
    pub fn check_properties(&self, form: &Path, own: &[Property]) -> Result<(), String> {
        let mut strange: Vec<&Given> = self.properties.iter().filter(|given| !has(own, &given.name)).collect();
        let of_files = strange.iter().map(|given| files::folder(&given.file).to_path_buf());
        let of_form = files::folder(form).canonicalize().ok().filter(|_| form != Path::new("-"));
        let mut folders: Vec<PathBuf> = of_files.chain(of_form).collect();
        // a folder in another one is searched with it
        folders.sort();
        folders.dedup_by(|folder, above| folder.starts_with(above));
        let is_one = folders.len() == 1;
        if strange.is_empty() || !self.others(folders, &mut strange) {
            return Ok(());
        }
        let Some(Given { name, file, .. }) = strange.first() else { return Ok(()) };
        let names = own.iter().map(|property| property.name.as_str());
        let help = did_you_mean(name, names).unwrap_or_else(|| {
            "`postform properties FORM` lists the properties of a form; remove the line, or fix the name of the \
             property"
                .into()
        });
        let searched =
            if is_one { "in this folder".into() } else { format!("in this folder or that of {}", files::name(form)) };
        let file = files::name(file);
        Err(format!("error: {file}: no form {searched} has the property `{name}` (under [properties])\n  help: {help}"))
    }

    /// Removes from `names` each property of a form in the folders or their subfolders. Returns `false` if there are
    /// more files than the maximum.
    fn others(&self, mut folders: Vec<PathBuf>, names: &mut Vec<&Given>) -> bool {
        let mut left = MOST_FILES;
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
                    names.retain(|given| !has(&form.settings.properties, &given.name));
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
