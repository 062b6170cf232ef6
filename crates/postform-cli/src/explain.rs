//! `postform explain`.

use std::io::Write as _;

use postform::internals::explain;
use postform::internals::terminal::escaped;

use super::args::ExplainArgs;
use super::{Ending, output};

/// Maximum number of letters of an unknown name in a message.
const MOST_SHOWN: usize = 60;

/// Prints the meaning of names, and proposed corrections.
pub fn run(args: &ExplainArgs) -> Result<Ending, String> {
    if args.list {
        return output::shown(|out| out.write_all(explain::list().as_bytes()));
    }
    // names may contain spaces, such as `Upon [work]`; several names are explained one after the other
    let whole = args.what.join(" ");
    let asked = if explain::explain(&whole).is_ok() { vec![whole] } else { args.what.clone() };
    let none = |what: &str, help| {
        let shown: String = escaped(what).chars().take(MOST_SHOWN).collect();
        format!("error: `{shown}` is unknown\n  help: {help}")
    };
    let texts = asked.iter().map(|what| explain::explain(what).map_err(|help| none(what, help)));
    let texts = texts.collect::<Result<Vec<_>, _>>()?;
    let text = texts.join("\n");
    output::shown(|out| out.write_all(text.as_bytes()))
}
