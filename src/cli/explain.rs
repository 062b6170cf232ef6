//! `postform explain`.

use std::io::Write as _;

use postform::diag::escaped;
use postform::explain;

use super::args::ExplainArgs;
use super::{Ending, output};

/// Prints what something means, and what to write instead.
pub fn run(args: &ExplainArgs) -> Ending {
    let what = args.what.join(" ");
    let text = match args.list {
        true => explain::list(),
        false => match explain::explain(&what) {
            Ok(text) => text,
            Err(help) => {
                eprintln!("error: there is no `{}` to explain\n  help: {help}", escaped(&what));
                return Ending::Failed;
            }
        },
    };
    output::shown(|out| out.write_all(text.as_bytes()))
}
