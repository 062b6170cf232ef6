//! Settings in `postform.toml`, which apply to a whole shop. The caller finds and reads the file.

use std::collections::BTreeMap;

use serde::Deserialize;

use crate::control::{self, Control};
use crate::error::Error;
use crate::lint::{Level, Levels};
use crate::sema::Limits;
use crate::terminal::escaped;

/// Settings for the files of a folder and its subfolders. Paths are kept as written, relative to the folder of `postform.toml`.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct Config {
    /// The form of `render` and `verify`.
    pub form: Option<String>,
    /// The control that is simulated when postform runs programs.
    pub control: Option<ControlName>,
    /// Limits of forms.
    pub limits: Option<Limits>,
    /// The machine's file. [`render`](crate::Post::render) does not use this file; the command line does.
    pub machine: Option<String>,
    /// Jobs that the language server and `watch` print with the forms of the folder.
    pub jobs: Vec<String>,
    /// Whether a program that is not proven is an error and is not printed.
    pub require_proof: bool,
    /// Severities of rules.
    pub levels: Levels,
    /// Values of properties of forms, by their names, as [`Options::shop_properties`](crate::Options::shop_properties) takes them.
    pub properties: Vec<(String, String)>,
    /// Settings of `postform test`; no other command uses them.
    pub test: Tests,
}

/// `[test]`: cases of forms.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
#[non_exhaustive]
pub struct Tests {
    /// The forms that print the jobs, or folders of forms.
    pub forms: Vec<String>,
    /// The post to use from a form that contains several.
    pub post: Option<String>,
    /// Differences to ignore: names of [`crate::internals::diff::Ignore`], such as `numbers`.
    pub ignore: Vec<String>,
    /// Largest difference at which two numbers still count as equal, in the unit in which the numbers are written.
    pub tolerance: f64,
    /// The date with which programs are printed, such as `2026-03-31`.
    pub date: Option<String>,
}

/// A control that is built into postform, or a shop's own control.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum ControlName {
    /// A built-in control.
    Known(&'static Control),
    /// The path of a file that describes the control: see [`Control::own`].
    File(String),
}

/// The keys that the file may contain.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    form: Option<String>,
    control: Option<WrittenControl>,
    limits: Option<String>,
    machine: Option<String>,
    #[serde(default, rename = "require-proof")]
    require_proof: bool,
    #[serde(default)]
    jobs: Vec<String>,
    #[serde(default)]
    rules: BTreeMap<String, String>,
    #[serde(default)]
    properties: BTreeMap<String, WrittenValue>,
    #[serde(default)]
    test: Tests,
}

/// `through = "high"`, `header = false`.
#[derive(Deserialize)]
#[serde(untagged)]
enum WrittenValue {
    YesNo(bool),
    Whole(i64),
    Number(f64),
    Text(String),
}

impl WrittenValue {
    /// The value as a user would type it.
    fn typed(self) -> String {
        match self {
            WrittenValue::YesNo(yes) => if yes { "yes" } else { "no" }.into(),
            WrittenValue::Whole(number) => number.to_string(),
            WrittenValue::Number(number) => number.to_string(),
            WrittenValue::Text(text) => text,
        }
    }
}

/// The value of `control`: a name such as `"haas"`, or the path of a file that describes a control.
#[derive(Deserialize)]
#[serde(untagged)]
enum WrittenControl {
    Name(String),
    File { file: String },
}

impl Config {
    /// Reads the text of the file.
    ///
    /// # Errors
    /// The text is not TOML, contains an unknown key, or contains a value that makes no sense.
    pub fn parse(text: &str) -> Result<Config, Error> {
        let written: Written = toml::from_str(text).map_err(|error| {
            let known =
                "the keys are form, control, machine, limits, jobs and require-proof; [rules] takes codes, as PF303 \
                 = \"off\"; [properties] takes values, as header = false; [test] takes forms, post, ignore, \
                 tolerance and date";
            Error::usage(format!("{}\n  help: {known}", error.to_string().trim_end()))
        })?;
        let mut levels = Levels::default();
        // family names first, so that the level of a single code overrides its family in any order
        let mut rules: Vec<_> = written.rules.iter().collect();
        rules.sort_by_key(|(code, _)| code.len());
        for (code, level) in rules {
            let Some(parsed) = Level::parse(level) else {
                let levels = "off, note, warning or error";
                return Err(Error::usage(format!("{} = {level:?}: the level of a rule is {levels}", escaped(code))));
            };
            levels.set(code, parsed).map_err(|why| Error::usage(format!("{} {why}", escaped(code))))?;
        }
        let one_of = |key: &str, value: &str, known: &[&str]| {
            Error::usage(format!("{key} = {value:?}: it is one of {}", known.join(", ")))
        };
        let control = match written.control {
            Some(WrittenControl::File { file }) => Some(ControlName::File(file)),
            Some(WrittenControl::Name(name)) if control::is_file(&name) => Some(ControlName::File(name)),
            Some(WrittenControl::Name(name)) => {
                let control = Control::named(&name.to_ascii_lowercase());
                let known: Vec<&str> = control::names().collect();
                Some(ControlName::Known(control.ok_or_else(|| one_of("control", &name, &known))?))
            }
            None => None,
        };
        let names: Vec<&String> = written.properties.keys().collect();
        for (at, name) in names.iter().enumerate() {
            if let Some(other) = names[..at].iter().find(|other| other.eq_ignore_ascii_case(name)) {
                let (name, other) = (escaped(name), escaped(other));
                let help = "upper and lower case are equal in names of properties: remove one of the lines";
                return Err(Error::usage(format!(
                    "`{other}` and `{name}` under [properties] are the same property\n  help: {help}"
                )));
            }
        }
        let limits =
            written.limits.map(|name| Limits::parse(&name).ok_or_else(|| one_of("limits", &name, &Limits::NAMES)));
        Ok(Config {
            form: written.form,
            control,
            limits: limits.transpose()?,
            machine: written.machine,
            jobs: written.jobs,
            require_proof: written.require_proof,
            levels,
            properties: written.properties.into_iter().map(|(name, value)| (name, value.typed())).collect(),
            test: written.test,
        })
    }
}
