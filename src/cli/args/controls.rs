//! How a program is run.

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueEnum};

use postform::Proof;
use postform::control::{self, Control};
use postform::nc::{RunSettings, Unpointed};
use postform::toolpath::Units;

/// How a program is run.
#[derive(Clone, Debug, Args)]
pub struct ControlArgs {
    /// By whose rules [default: the form's Control, else fanuc]
    #[arg(long, value_name = "CONTROL", value_parser = control_parser())]
    pub control: Option<&'static Control>,
    /// Leave out blocks with a slash
    #[arg(long)]
    pub block_delete: bool,
    /// How far G73 backs off, and how near the last depth G83 goes back [default: as the control]
    #[arg(long, value_name = "LENGTH", value_parser = length)]
    pub back_off: Option<f64>,
    /// What a length without a point means on a Fanuc [default: it is an error]
    #[arg(long, value_name = "MEANING")]
    pub no_point: Option<NoPoint>,
}

/// A length of an option.
pub fn length(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(length) if length.is_finite() && length >= 0.0 => Ok(length),
        _ => Err("a length is a number from 0 on".into()),
    }
}

/// Reads the name of a control.
pub fn control_parser() -> impl TypedValueParser<Value = &'static Control> {
    PossibleValuesParser::new(control::names()).try_map(|name| Control::named(&name).ok_or("there is no such control"))
}

/// Lengths without a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum NoPoint {
    /// Whole inches or millimetres
    Whole,
    /// Least increments: 0.0001 inch, 0.001 mm
    Increments,
}

impl NoPoint {
    /// As the library has it.
    pub fn unpointed(self) -> Unpointed {
        match self {
            NoPoint::Whole => Unpointed::Whole,
            NoPoint::Increments => Unpointed::Increments,
        }
    }
}

impl ControlArgs {
    /// How a program is run to be proven.
    pub fn proof(&self, tolerance: Option<f64>) -> Proof {
        let mut proof = Proof::default();
        proof.control = self.control;
        proof.block_delete = self.block_delete;
        proof.back_off = self.back_off;
        proof.unpointed = self.no_point.map_or(Unpointed::Refused, NoPoint::unpointed);
        proof.tolerance = tolerance;
        proof
    }

    /// As the library has it; `form` is the form's own control.
    pub fn settings(&self, form: Option<&'static Control>, units: Units) -> RunSettings {
        let control = self.control.or(form).unwrap_or_else(Control::usual);
        let unpointed = self.no_point.map_or(Unpointed::Refused, NoPoint::unpointed);
        RunSettings {
            units,
            block_delete: self.block_delete,
            back_off: self.back_off,
            unpointed,
            ..RunSettings::new(control)
        }
    }
}
