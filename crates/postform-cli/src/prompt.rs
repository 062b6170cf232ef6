//! Prompted variables and properties: the answers come from the command line, else from a prompt on a terminal.

use std::io::{self, BufRead, IsTerminal};

use postform::internals::lang::did_you_mean;
use postform::internals::terminal::escaped;
use postform::{Options, Post, Property};

use super::say::{message, say};

/// Reads the `NAME=VALUE` options.
pub fn answers(given: &[String], properties: &[Property], options: &mut Options) -> Result<(), String> {
    given.iter().try_for_each(|option| {
        answer(option, properties, options).map_err(|why| format!("error: `--set {}`: {why}", escaped(option)))
    })
}

fn answer(option: &str, properties: &[Property], options: &mut Options) -> Result<(), String> {
    let Some((name, value)) = option.split_once('=') else {
        return Err("write a name and its value, as --set val1=2.5".into());
    };
    let own = name.trim().trim_matches(['[', ']']);
    if let Some(property) = properties.iter().find(|property| property.name.eq_ignore_ascii_case(own)) {
        property.kind.read(value)?;
        options.properties.push((property.name.clone(), value.to_owned()));
        return Ok(());
    }
    let number = value.trim().parse::<f64>().ok().filter(|number| number.is_finite());
    options.set_value(name, number.unwrap_or_default()).map_err(|error| {
        let names: Vec<&str> = properties.iter().map(|property| property.name.as_str()).collect();
        match did_you_mean(own, names.iter().copied()) {
            Some(help) => format!("`{own}` is not a property; {help}"),
            None if names.is_empty() => format!("the form has no property `{own}`, and {error}"),
            None => format!("{error}; the form's properties are {}", names.join(", ")),
        }
    })?;
    number.map(|_| ()).ok_or_else(|| format!("`{value}` is not a number"))
}

/// Prompts for missing answers if input and output are a terminal; `all`: prompts for properties, too. `busy`: the job
/// is read from standard input.
pub fn ask(post: &Post, options: &mut Options, all: bool, busy: bool) -> io::Result<()> {
    if busy || !io::stdin().is_terminal() || !io::stderr().is_terminal() {
        return Ok(());
    }
    for prompt in post.prompts() {
        if options.set.iter().any(|(name, _)| name == prompt.variable) {
            continue;
        }
        let default = prompt.default.map_or(String::new(), |value| value.to_string());
        let read =
            |line: &str| line.parse::<f64>().ok().filter(|value| value.is_finite()).ok_or("write a number".into());
        if let Some(value) = answered(prompt.text, &default, &read)? {
            options.set.push((prompt.variable.to_owned(), value));
        }
    }
    for property in post.properties().iter().filter(|_| all) {
        let said = |given: &[(String, String)]| given.iter().any(|(name, _)| name.eq_ignore_ascii_case(&property.name));
        if said(&options.properties) || said(&options.shop_properties) {
            continue;
        }
        let text = if property.text.is_empty() { &property.name } else { &property.text };
        let question = format!("{text} ({})", property.kind.takes());
        let read = |line: &str| property.kind.read(line).map(|value| value.to_string());
        if let Some(value) = answered(&question, &property.default.to_string(), &read)? {
            options.shop_properties.push((property.name.clone(), value));
        }
    }
    Ok(())
}

/// Prompts until the answer makes sense. `None`: the default, chosen by an empty answer or by the end of input.
fn answered<T>(question: &str, default: &str, read: &dyn Fn(&str) -> Result<T, String>) -> io::Result<Option<T>> {
    loop {
        let shown = if default.is_empty() { String::new() } else { format!(" [{}]", escaped(default)) };
        say(&format!("{}{shown}: ", escaped(question)));
        let mut line = String::new();
        if io::stdin().lock().read_line(&mut line)? == 0 {
            return Ok(None);
        }
        match line.trim() {
            "" if !default.is_empty() => return Ok(None),
            typed => match read(typed) {
                Ok(value) => return Ok(Some(value)),
                Err(why) => message(&why),
            },
        }
    }
}
