//! Commands for pictures and the page.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use postform::internals::picture::View;

use super::{ControlArgs, MachineArg, ReadArgs, RenderOptions};

/// The view of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ViewArg {
    /// From above
    Top,
    /// From the front, as the operator sees it
    Front,
    /// From the right
    Side,
    /// From the right, front and above
    Iso,
    /// A lathe: Z to the right, X up
    Lathe,
}

impl ViewArg {
    /// Converts the choice to the library's type.
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
    /// A job, printed with --form or with the form in postform.toml; or an NC program
    pub file: PathBuf,
    /// Form that prints the program, if the file is a job
    #[arg(long, value_name = "FORM")]
    pub form: Option<PathBuf>,
    /// Output file of the picture, or - for standard output
    #[arg(short, long, value_name = "OUT", default_value = "-")]
    pub output: PathBuf,
    /// View [default: iso; for lathes: lathe]
    #[arg(long, value_name = "VIEW")]
    pub view: Option<ViewArg>,
    /// Width in pixels
    #[arg(long, value_name = "PIXELS", default_value_t = 960, value_parser = clap::value_parser!(u16).range(240..=8000))]
    pub width: u16,
    /// Options for simulating the program
    #[command(flatten)]
    pub control: ControlArgs,
    /// Options for rendering a job
    #[command(flatten)]
    pub options: RenderOptions,
    /// Options for reading a job
    #[command(flatten)]
    pub read: ReadArgs,
}

/// `postform watch`.
#[derive(Debug, Args)]
#[command(mut_arg("job_name", |job| job.long("document-job")))]
pub struct WatchArgs {
    /// The form
    pub form: PathBuf,
    /// A job to print with the form; may be given several times, for one tab per job [default: those in postform.toml, else a sample job]
    #[arg(long, value_name = "JOB")]
    pub job: Vec<PathBuf>,
    /// An old program of the job, to compare with the new one
    #[arg(long, value_name = "PROGRAM")]
    pub against: Option<PathBuf>,
    /// Machine file: check that the programs fit this machine
    #[command(flatten)]
    pub machine: MachineArg,
    /// Do not open the browser
    #[arg(long)]
    pub no_open: bool,
    /// Port of the server on this computer [default: a free port]
    #[arg(long, value_name = "PORT", default_value_t = 0, hide_default_value = true)]
    pub port: u16,
    /// Options for simulating programs
    #[command(flatten)]
    pub control: ControlArgs,
    /// Options for rendering jobs
    #[command(flatten)]
    pub options: RenderOptions,
    /// Options for reading jobs
    #[command(flatten)]
    pub read: ReadArgs,
}
