//! Prompted variables: answers from the command line, else asked for on a terminal.

use std::io::{self, BufRead, IsTerminal};

use postform::{Options, Post};

use super::say::{message, say};

/// Takes `VAR=VALUE` options.
pub fn answers(given: &[String], options: &mut Options) -> Result<(), String> {
    given.iter().try_for_each(|option| answer(option, options).map_err(|why| format!("error: `--set {option}`: {why}")))
}

fn answer(option: &str, options: &mut Options) -> Result<(), String> {
    let Some((name, value)) = option.split_once('=') else {
        return Err("write a variable and its value, as --set val1=2.5".into());
    };
    let number = value.trim().parse::<f64>().ok().filter(|number| number.is_finite());
    options.set_value(name, number.unwrap_or_default()).map_err(|error| error.to_string())?;
    number.map(|_| ()).ok_or_else(|| format!("`{value}` is no number"))
}

/// Asks for what has no answer yet, when there is someone to ask. `busy`: standard input is the job.
pub fn ask(post: &Post, options: &mut Options, busy: bool) -> io::Result<()> {
    if busy || !io::stdin().is_terminal() || !io::stderr().is_terminal() {
        return Ok(());
    }
    for prompt in post.prompts() {
        if options.set.iter().any(|(name, _)| name == prompt.variable) {
            continue;
        }
        loop {
            let default = prompt.default.map_or(String::new(), |value| format!(" [{value}]"));
            say(&format!("{}{default}: ", postform::diag::escaped(prompt.text)));
            let mut line = String::new();
            if io::stdin().lock().read_line(&mut line)? == 0 {
                break;
            }
            match (line.trim(), line.trim().parse::<f64>()) {
                ("", _) if prompt.default.is_some() => break,
                (_, Ok(value)) if value.is_finite() => {
                    options.set.push((prompt.variable.to_owned(), value));
                    break;
                }
                _ => message("write a number"),
            }
        }
    }
    Ok(())
}
