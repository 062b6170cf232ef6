//! Prompted variables: answers from the command line, else asked for on a terminal.

use std::io::{self, BufRead, IsTerminal};

use postform::compile::Program;
use postform::lang::{Origin, VARIABLES, VarId, did_you_mean};

use super::say::{message, say};

/// Reads `VAR=VALUE` options.
pub fn answers(options: &[String]) -> Result<Vec<(VarId, f64)>, String> {
    options.iter().map(|option| answer(option)).collect()
}

fn answer(option: &str) -> Result<(VarId, f64), String> {
    let Some((name, value)) = option.split_once('=') else {
        return Err(format!("error: `--set {option}`: write a variable and its value, as --set val1=2.5"));
    };
    let name = name.trim().trim_matches(['[', ']']);
    let Some(var) = VarId::parse(name) else {
        let names = VARIABLES.iter().filter(|v| v.origin == Origin::Job).map(|v| v.name);
        let hint = did_you_mean(name, names).unwrap_or_else(|| "val1 to val10 are free".into());
        return Err(format!("error: `--set {option}`: `{name}` is no variable; {hint}"));
    };
    if var.row().origin == Origin::Computed {
        return Err(format!("error: `--set {option}`: [{name}] comes from the toolpath and can't be set"));
    }
    match value.trim().parse::<f64>() {
        Ok(number) if number.is_finite() => Ok((var, number)),
        _ => Err(format!("error: `--set {option}`: `{value}` is no number")),
    }
}

/// Asks for what has no answer yet, when there is someone to ask. `busy`: standard input is the job.
pub fn ask(program: &Program, answers: &mut Vec<(VarId, f64)>, busy: bool) -> io::Result<()> {
    if busy || !io::stdin().is_terminal() || !io::stderr().is_terminal() {
        return Ok(());
    }
    for prompt in &program.settings.prompts {
        if answers.iter().any(|(var, _)| *var == prompt.var) {
            continue;
        }
        loop {
            let default = prompt.default.map_or(String::new(), |value| format!(" [{value}]"));
            say(&format!("{}{default}: ", postform::diag::escaped(&prompt.text)));
            let mut line = String::new();
            if io::stdin().lock().read_line(&mut line)? == 0 {
                break;
            }
            match (line.trim(), line.trim().parse::<f64>()) {
                ("", _) if prompt.default.is_some() => break,
                (_, Ok(value)) if value.is_finite() => {
                    answers.push((prompt.var, value));
                    break;
                }
                _ => message("write a number"),
            }
        }
    }
    Ok(())
}
