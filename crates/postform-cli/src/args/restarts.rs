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
    /// Begin at the first change to this tool
    #[arg(long, value_name = "NUMBER", value_parser = super::jobs::tool)]
    pub tool: Option<u32>,
    /// Begin at the block with this number, or at the last possible block before it
    #[arg(long, value_name = "N", value_parser = block)]
    pub at: Option<u64>,
    /// Begin at this line of the program, or at the last possible line before it
    #[arg(long, value_name = "LINE", value_parser = clap::value_parser!(u64).range(1..))]
    pub line: Option<u64>,
    /// Begin at the first comment that contains this text
    #[arg(long, value_name = "NAME")]
    pub operation: Option<String>,
    /// Begin exactly at the block, even inside a contour; the tool then comes down at feed [default: begin before it, with the tool clear]
    #[arg(long)]
    pub exactly: bool,
    /// Retract to this height instead of machine zero; in the work offset and the program's units, above all obstacles
    #[arg(long, value_name = "HEIGHT", allow_negative_numbers = true)]
    pub clear_z: Option<f64>,
    /// Output file of the new program, or - for standard output
    #[arg(short, long, value_name = "OUT", default_value = "-")]
    pub output: PathBuf,
    /// Options for simulating the program
    #[command(flatten)]
    pub control: ControlArgs,
    /// Units before the first G20 or G21
    #[arg(long, value_name = "UNITS", default_value = "mm")]
    pub units: UnitsArg,
}

/// Reads `1230` or `N1230`.
fn block(text: &str) -> Result<u64, String> {
    let digits = text.strip_prefix(['N', 'n']).unwrap_or(text);
    digits.parse().map_err(|_| "write a block number as N1230".into())
}
