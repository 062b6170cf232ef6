//! What a caller may choose.

use crate::control::Control;
use crate::error::Error;
use crate::lang::{Origin, VARIABLES, VarId, did_you_mean};
use crate::nc::Unpointed;
use crate::render::{self, Clock, Cycles};
use crate::sema::{Property, PropertyValue, Settings};
use crate::times::Rates;
use crate::toolpath::Units;

/// How a job is printed. All of it may stay as it is.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Options {
    /// The program's number; else the job's.
    pub program: Option<u32>,
    /// Units of the program; else those of the job.
    pub units: Option<Units>,
    /// Where canned cycles come from: the form's sequences, or single moves.
    pub cycles: Cycles,
    /// Values of variables and answers to the form's questions, by the variable's name (`val1`); they go before the job's.
    pub set: Vec<(String, f64)>,
    /// Values of the form's properties by their names, as somebody types them; they go before all else.
    pub properties: Vec<(String, String)>,
    /// The same, of a shop for all its forms: they go before the forms' defaults only. Names that a form has not are left out.
    pub shop_properties: Vec<(String, String)>,
    /// How deep a countersink of a diameter and an angle is: by the formula that GENER's manual prints, which is right at 90
    /// degrees only; else by geometry.
    pub sink_as_printed: bool,
    /// A program of over 100 MB may be over 1,000 times as long as its job.
    pub huge: bool,
    /// Day and time of printing, for forms that say them: see [`Post::says_time`](super::Post::says_time).
    pub clock: Option<Clock>,
    /// What the job's file is called, for forms that say it.
    pub job_file: Option<String>,
    /// The job is read once only, though the form might say what lies ahead in it: a form that must is an error, and
    /// `[nexttool]` has a value where the job says its `tool_order`.
    pub one_pass: bool,
    /// Keep for each line of the program which form line and which item of the job printed it.
    pub trace: bool,
    /// How fast the machine's axes are: then `[cuttime]` counts their accelerations. For the command line, which reads machines.
    #[doc(hidden)]
    pub rates: Option<Rates>,
    /// How [`Post::render`](super::Post::render) proves the program; `None`: it does not.
    pub proof: Option<Proof>,
}

impl Default for Options {
    /// As the form and the job say, and proven.
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
    /// Sets a variable, or answers a question, by the variable's name: `val1` or `[val1]`.
    ///
    /// # Errors
    /// There is no such variable, or it comes from the toolpath.
    pub fn set_value(&mut self, name: &str, value: f64) -> Result<(), Error> {
        let var = variable(name).map_err(Error::usage)?;
        self.set.push((var.row().name.to_owned(), value));
        Ok(())
    }

    /// The properties that nothing changes any more, by their rows.
    pub(super) fn fixed_properties(&self, settings: &Settings) -> Result<Vec<(u16, PropertyValue)>, Error> {
        properties(&self.properties, settings, true)
    }

    /// The properties that somebody else than the job gives, by their rows; the last of a row counts.
    pub(super) fn given_properties(&self, settings: &Settings) -> Result<Vec<(u16, PropertyValue)>, Error> {
        let mut given = properties(&self.shop_properties, settings, false)?;
        given.extend(self.fixed_properties(settings)?);
        Ok(given)
    }

    /// The options as the renderer takes them.
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

/// Values of properties, by their rows. A name that is none is an error only where it must be one.
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

/// A variable that can be set, by its name, with or without brackets.
fn variable(name: &str) -> Result<VarId, String> {
    let name = name.trim().trim_matches(['[', ']']);
    let Some(var) = VarId::parse(name) else {
        let names = VARIABLES.iter().filter(|v| v.origin == Origin::Job).map(|v| v.name);
        let hint = did_you_mean(name, names).unwrap_or_else(|| "val1 to val10 are free".into());
        return Err(format!("`{name}` is no variable; {hint}"));
    };
    match var.row().origin {
        Origin::Computed => Err(format!("[{name}] comes from the toolpath and can't be set")),
        _ => Ok(var),
    }
}

/// How a program is run to be proven. All of it may stay as it is.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct Proof {
    /// The control by whose rules the program is run; `None`: the form's `Control`, else Fanuc.
    pub control: Option<&'static Control>,
    /// Blocks with a slash are left out.
    pub block_delete: bool,
    /// How far G73 backs off, and how near the last depth G83 goes back, in the program's units; else as the control does.
    pub back_off: Option<f64>,
    /// What a length without a point means on a Fanuc.
    pub unpointed: Unpointed,
    /// How near places must be, in the job's units; else 0.0001 inch or 0.002 mm.
    pub tolerance: Option<f64>,
    /// What a program counts in before its first code of units, where no form printed it; `None`: it must say so.
    pub units: Option<Units>,
    /// A program that is not proven is not printed, either.
    pub required: bool,
}
