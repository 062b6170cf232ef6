//! The options that a caller can set.

use crate::control::Control;
use crate::error::Error;
use crate::lang::{Origin, VARIABLES, VarId};
use crate::nc::Unpointed;
use crate::render::{self, Clock, Cycles};
use crate::sema::{Property, PropertyValue, Settings};
use crate::suggest::did_you_mean;
use crate::times::Rates;
use crate::toolpath::Units;

/// Options for printing a job. Each option has a default.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Options {
    /// Number of the program; default: the number in the job.
    pub program: Option<u32>,
    /// Units of the program; default: the units of the job.
    pub units: Option<Units>,
    /// How canned cycles are printed: by the sequences of the form, or as single moves.
    pub cycles: Cycles,
    /// Values of variables and answers to prompts, by the name of the variable (such as `val1`). These values have
    /// priority over values in the job.
    pub set: Vec<(String, f64)>,
    /// Values of the form's properties by name, as a user writes them. These values have priority over all other
    /// values.
    pub properties: Vec<(String, String)>,
    /// Values of properties that a shop sets for all its forms. These values have priority only over the defaults of
    /// the forms. Names of properties that a form does not have are ignored.
    pub shop_properties: Vec<(String, String)>,
    /// Whether the depth of a countersink is calculated from diameter and angle by the formula in GENER's manual, which is
    /// correct only at 90 degrees. Default: the depth is calculated by geometry.
    pub sink_as_printed: bool,
    /// Whether to accept a program of more than 100 MB that is more than 1,000 times as long as its job.
    pub huge: bool,
    /// Date and time of printing, for forms that print them. See [`Post::says_time`](super::Post::says_time).
    pub clock: Option<Clock>,
    /// Name of the job's file, for forms that print this name.
    pub job_file: Option<String>,
    /// Whether to read the job only once. With this option, a form that needs values from the rest of the job is an
    /// error. When the job is read only once, `[nexttool]` has a value only if the job gives its `tool_order`.
    pub one_pass: bool,
    /// Whether to record the form line and the job item that printed each line of the program.
    pub trace: bool,
    /// Speeds and accelerations of the machine's axes. If the speeds and accelerations are set, `[cuttime]` includes
    /// accelerations. Only the command line sets these values, because it reads machine files.
    #[doc(hidden)]
    pub rates: Option<Rates>,
    /// How [`Post::render`](super::Post::render) verifies the program. `None`: the program is not verified.
    pub proof: Option<Proof>,
}

impl Default for Options {
    /// All values come from the form and the job, and the program is verified.
    fn default() -> Options {
        Options {
            program: None,
            units: None,
            cycles: Cycles::default(),
            set: Vec::new(),
            properties: Vec::new(),
            shop_properties: Vec::new(),
            sink_as_printed: false,
            huge: false,
            clock: None,
            job_file: None,
            one_pass: false,
            trace: false,
            rates: None,
            proof: Some(Proof::default()),
        }
    }
}

impl Options {
    /// Sets a variable or answers a prompt. `name` is the name of the variable, as `val1` or `[val1]`.
    ///
    /// # Errors
    /// There is no such variable, or its value is calculated from the toolpath.
    pub fn set_value(&mut self, name: &str, value: f64) -> Result<(), Error> {
        let var = variable(name).map_err(Error::usage)?;
        self.set.push((var.row().name.to_owned(), value));
        Ok(())
    }

    /// The properties that the caller sets, by row. Nothing else changes their values.
    pub(super) fn fixed_properties(&self, settings: &Settings) -> Result<Vec<(u16, PropertyValue)>, Error> {
        properties(&self.properties, settings, true)
    }

    /// The values of properties that do not come from the job, by row. If a row occurs several times, the last value applies.
    pub(super) fn given_properties(&self, settings: &Settings) -> Result<Vec<(u16, PropertyValue)>, Error> {
        let mut given = properties(&self.shop_properties, settings, false)?;
        given.extend(self.fixed_properties(settings)?);
        Ok(given)
    }

    /// Converts the options for the renderer.
    pub(super) fn for_renderer(&self, settings: &Settings) -> Result<render::Options, Error> {
        let set = self.set.iter().map(|(name, value)| Ok((variable(name).map_err(Error::usage)?, *value)));
        Ok(render::Options {
            cycles: self.cycles,
            units: self.units,
            program: self.program,
            set: set.collect::<Result<_, Error>>()?,
            properties: self.fixed_properties(settings)?,
            shop: properties(&self.shop_properties, settings, false)?,
            sink_as_printed: self.sink_as_printed,
            clock: self.clock.clone(),
            job_file: self.job_file.clone(),
            survey: None,
            trace: self.trace,
            words: false,
        })
    }
}

/// The values of properties, by row. `must`: an unknown name is an error.
fn properties(given: &[(String, String)], settings: &Settings, must: bool) -> Result<Vec<(u16, PropertyValue)>, Error> {
    let mut values = Vec::new();
    for (name, value) in given {
        let own = |property: &Property| property.name.eq_ignore_ascii_case(name);
        match settings.properties.iter().position(own) {
            Some(row) => {
                let read = settings.properties[row].kind.read(value);
                values.push((row as u16, read.map_err(|why| Error::usage(format!("the property {name}: {why}")))?));
            }
            None if must => return Err(Error::usage(format!("the form has no property `{name}`"))),
            None => {}
        }
    }
    Ok(values)
}

/// Finds a variable that can be set. The name of the variable may be in brackets.
fn variable(name: &str) -> Result<VarId, String> {
    let name = name.trim().trim_matches(['[', ']']);
    let Some(var) = VarId::parse(name) else {
        let names = VARIABLES.iter().filter(|v| v.origin == Origin::Job).map(|v| v.name);
        let hint = did_you_mean(name, names).unwrap_or_else(|| "use val1 to val10".into());
        return Err(format!("`{name}` is not a variable; {hint}"));
    };
    match var.row().origin {
        Origin::Computed => Err(format!("[{name}] comes from the toolpath and can't be set")),
        _ => Ok(var),
    }
}

/// Options for verifying a program. Each option has a default.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct Proof {
    /// The control whose rules apply. `None`: the control that the form names, or otherwise `default_control`.
    pub control: Option<&'static Control>,
    /// The control if neither `control` nor the form names one. Default: Fanuc, and a program of a form is then not proven.
    pub default_control: Option<&'static Control>,
    /// Whether to skip blocks that begin with a slash.
    pub block_delete: bool,
    /// The retract distance of G73, and the distance above the last depth in G83, in the program's units. Default: the values
    /// of the control.
    pub back_off: Option<f64>,
    /// What a length without a decimal point means on a Fanuc.
    pub unpointed: Unpointed,
    /// Tolerance of positions in the job's units. Default: 0.0001 inch or 0.002 mm.
    pub tolerance: Option<f64>,
    /// Units of a program before its first unit code, if no form printed it. `None`: the program must contain a unit code.
    pub units: Option<Units>,
    /// Whether a program that is not proven is an error.
    pub required: bool,
}
