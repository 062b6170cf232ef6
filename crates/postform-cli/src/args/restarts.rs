//! Programs that begin in the middle of another one.

use std::path::PathBuf;

use clap::{ArgGroup, Args};

use super::{ControlArgs, UnitsArg};

/// `postform restart`.
#[derive(Debug, Args)]
#[command(group(ArgGroup::new("where").required(true).args(["tool", "at", "line", "operation"])))]
pub struct RestartArgs {
    /// The NC program, or - for standard input
    pub program: PathBuf,
    /// At the first change to this tool
    #[arg(long, value_name = "NUMBER", value_parser = super::jobs::tool)]
    pub tool: Option<u32>,
    /// At the block with this number, or the last safe one before it
    #[arg(long, value_name = "N", value_parser = block)]
    pub at: Option<u64>,
    /// At this line of the program, or the last safe one before it
    #[arg(long, value_name = "LINE", value_parser = clap::value_parser!(u64).range(1..))]
    pub line: Option<u64>,
    /// At the first comment that has this text
    #[arg(long, value_name = "NAME")]
    pub operation: Option<String>,
    /// Begin with the very block, though it is in a cut: down at feed [default: at the last place before it where the tool is clear]
    #[arg(long)]
    pub exactly: bool,
    /// A height above everything, in the work offset and the program's units, instead of the machine's zero
    #[arg(long, value_name = "HEIGHT", allow_negative_numbers = true)]
    pub clear_z: Option<f64>,
    /// Where the new program goes: a file, or - for standard output
    #[arg(short, long, value_name = "OUT", default_value = "-")]
    pub output: PathBuf,
    /// How it is run
    #[command(flatten)]
    pub control: ControlArgs,
    /// Units before the first G20 or G21
    #[arg(long, value_name = "UNITS", default_value = "mm")]
    pub units: UnitsArg,
}

/// `1230` or `N1230`.
fn block(text: &str) -> Result<u64, String> {
    let digits = text.strip_prefix(['N', 'n']).unwrap_or(text);
    digits.parse().map_err(|_| "a block number is written N1230".into())
}
