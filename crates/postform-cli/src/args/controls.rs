//! Options for running a program.

use std::ffi::OsStr;
use std::path::Path;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::error::ErrorKind;
use clap::{Arg, Args, Command, ValueEnum};

use postform::Proof;
use postform::internals::control::{self, Control};
use postform::internals::nc::{RunSettings, Unpointed};
use postform::toolpath::Units;

use super::super::files;

/// Options for simulating a program.
#[derive(Clone, Debug, Args)]
pub struct ControlArgs {
    /// The control: its name, or a file that describes it, such as `my-vf2.toml` [default: the form's Control, else fanuc]
    #[arg(long, value_name = "CONTROL", value_parser = ControlParser)]
    pub control: Option<&'static Control>,
    /// Skip blocks with a slash (block delete)
    #[arg(long)]
    pub block_delete: bool,
    /// Retract distance of G73; in G83, the rapid back into the hole ends at this distance above the last depth [default: that of the control]
    #[arg(long, value_name = "LENGTH", value_parser = length)]
    pub back_off: Option<f64>,
    /// Meaning of a length without a decimal point on a Fanuc [default: it is an error]
    #[arg(long, value_name = "MEANING")]
    pub no_point: Option<NoPoint>,
}

/// Reads a length as the value of an option.
pub fn length(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(length) if length.is_finite() && length >= 0.0 => Ok(length),
        _ => Err("write a length as a number, 0 or more".into()),
    }
}

/// Reads the name of a control, or the file that describes one.
#[derive(Clone)]
pub struct ControlParser;

impl TypedValueParser for ControlParser {
    type Value = &'static Control;

    fn parse_ref(&self, command: &Command, arg: Option<&Arg>, value: &OsStr) -> Result<Self::Value, clap::Error> {
        let named = PossibleValuesParser::new(control::names());
        let path = Path::new(value);
        if path.extension().is_some_and(|end| end.eq_ignore_ascii_case("toml")) {
            return files::control(path).map_err(|why| {
                let why = why.strip_prefix("error: ").unwrap_or(&why);
                clap::Error::raw(ErrorKind::ValueValidation, format!("{why}\n")).with_cmd(command)
            });
        }
        named.try_map(|name| Control::named(&name).ok_or("there is no such control")).parse_ref(command, arg, value)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        Some(Box::new(control::names().map(PossibleValue::new)))
    }
}

/// The meaning of lengths without a decimal point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum NoPoint {
    /// Whole inches or millimetres
    Whole,
    /// Least increments: 0.0001 inch, 0.001 mm
    Increments,
}

impl NoPoint {
    /// Converts the choice to the library's type.
    pub fn unpointed(self) -> Unpointed {
        match self {
            NoPoint::Whole => Unpointed::Whole,
            NoPoint::Increments => Unpointed::Increments,
        }
    }
}

impl ControlArgs {
    /// The settings for a proof. `default`: the control if neither the user nor the form names one.
    pub fn proof(&self, tolerance: Option<f64>, default: Option<&'static Control>) -> Proof {
        let mut proof = Proof::default();
        (proof.control, proof.default_control) = (self.control, default);
        proof.block_delete = self.block_delete;
        proof.back_off = self.back_off;
        proof.unpointed = self.no_point.map_or(Unpointed::Refused, NoPoint::unpointed);
        proof.tolerance = tolerance;
        proof
    }

    /// The settings for a run; `form` is the form's own control.
    pub fn settings(&self, form: Option<&'static Control>, units: Units) -> RunSettings {
        let control = self.control.or(form).unwrap_or_else(Control::usual);
        let unpointed = self.no_point.map_or(Unpointed::Refused, NoPoint::unpointed);
        RunSettings {
            units,
            block_delete: self.block_delete,
            back_off: self.back_off,
            unpointed,
            assumed: self.control.is_none() && form.is_none(),
            ..RunSettings::new(control)
        }
    }
}
