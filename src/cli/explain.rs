//! `postform explain`.

use std::io::Write as _;

use postform::diag::escaped;
use postform::explain;

use super::args::ExplainArgs;
use super::{Ending, output};

/// Prints what something means, and what to write instead.
pub fn run(args: &ExplainArgs) -> Ending {
    if args.list {
        return output::shown(|out| out.write_all(explain::list().as_bytes()));
    }
    // names may have blanks, as `Upon [work]`; several names are explained one after the other
    let whole = args.what.join(" ");
    let asked = if explain::explain(&whole).is_ok() { vec![whole] } else { args.what.clone() };
    let mut texts = Vec::new();
    for what in asked {
        match explain::explain(&what) {
            Ok(text) => texts.push(text),
            Err(help) => {
                eprintln!("error: there is no `{}` to explain\n  help: {help}", escaped(&what));
                return Ending::Failed;
            }
        }
    }
    let text = texts.join("\n");
    output::shown(|out| out.write_all(text.as_bytes()))
}
