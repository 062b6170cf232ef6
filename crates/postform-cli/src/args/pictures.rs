//! What is done with pictures, and the page.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use postform::internals::picture::View;

use super::{ControlArgs, MachineArg, ReadArgs, RenderOptions};

/// From where a picture is looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ViewArg {
    /// From above
    Top,
    /// From the operator's side
    Front,
    /// From the right
    Side,
    /// From the right, front and above
    Iso,
    /// A lathe's: Z to the right, X up
    Lathe,
}

impl ViewArg {
    /// As the library has it.
    pub fn view(self) -> View {
        match self {
            ViewArg::Top => View::Top,
            ViewArg::Front => View::Front,
            ViewArg::Side => View::Side,
            ViewArg::Iso => View::Iso,
            ViewArg::Lathe => View::Lathe,
        }
    }
}

/// `postform plot`.
#[derive(Debug, Args)]
pub struct PlotArgs {
    /// The job, printed with --form or the form of postform.toml; or an NC program
    pub file: PathBuf,
    /// Print the file, a job, with this form
    #[arg(long, value_name = "FORM")]
    pub form: Option<PathBuf>,
    /// Where the picture goes, or - for standard output
    #[arg(short, long, value_name = "OUT", default_value = "-")]
    pub output: PathBuf,
    /// From where it is looked at [default: iso, for lathes lathe]
    #[arg(long, value_name = "VIEW")]
    pub view: Option<ViewArg>,
    /// Its width in pixels
    #[arg(long, value_name = "PIXELS", default_value_t = 960, value_parser = clap::value_parser!(u16).range(240..=8000))]
    pub width: u16,
    /// How the program is run
    #[command(flatten)]
    pub control: ControlArgs,
    /// How a job is rendered
    #[command(flatten)]
    pub options: RenderOptions,
    /// How a job is read
    #[command(flatten)]
    pub read: ReadArgs,
}

/// `postform watch`.
#[derive(Debug, Args)]
#[command(mut_arg("job_name", |job| job.long("document-job")))]
pub struct WatchArgs {
    /// The form
    pub form: PathBuf,
    /// A job that is printed with it; several are tabs [default: those of postform.toml, else a sample job]
    #[arg(long, value_name = "JOB")]
    pub job: Vec<PathBuf>,
    /// A program of the job to compare with
    #[arg(long, value_name = "PROGRAM")]
    pub against: Option<PathBuf>,
    /// The machine into which programs must fit
    #[command(flatten)]
    pub machine: MachineArg,
    /// Open no browser
    #[arg(long)]
    pub no_open: bool,
    /// The port of this machine [default: a free one]
    #[arg(long, value_name = "PORT", default_value_t = 0, hide_default_value = true)]
    pub port: u16,
    /// How programs are run
    #[command(flatten)]
    pub control: ControlArgs,
    /// How jobs are rendered
    #[command(flatten)]
    pub options: RenderOptions,
    /// How jobs are read
    #[command(flatten)]
    pub read: ReadArgs,
}
