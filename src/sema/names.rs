//! Finds variables and properties of a form by their names.

use super::property::Property;
use super::settings::Settings;
use crate::diag::{Code, Diag};
use crate::lang::{TEXTS, VARIABLES, VarId};
use crate::suggest::did_you_mean;
use crate::syntax::Spanned;

/// The data that all words and conditions of a form need.
pub struct Context<'a> {
    /// The marks around comments. The second mark is empty if comments extend to the end of the block.
    pub comment: &'a [String; 2],
    /// Settings from the form's commands.
    pub settings: &'a Settings,
}

/// Names of variables in other systems, each with the name of the same variable in postform.
const OTHERS: [(&str, &str); 12] = [
    ("coolant", "cool"),
    ("feed", "frate"),
    ("feedrate", "frate"),
    ("spindle", "speed"),
    ("rpm", "speed"),
    ("x", "h"),
    ("y", "v"),
    ("z", "d"),
    ("diameter", "toold"),
    ("toolnumber", "tool"),
    ("programname", "progname"),
    ("partno", "partname"),
];

/// Finds a property of the form by its name.
pub fn property<'a>(name: &str, context: &Context<'a>) -> Option<(u16, &'a Property)> {
    let row = context.settings.properties.iter().position(|property| property.name.eq_ignore_ascii_case(name))?;
    Some((row as u16, &context.settings.properties[row]))
}

/// Finds a variable by its name. Reports a name that is unknown or not available on this machine.
pub fn variable(name: &Spanned, settings: &Settings, diags: &mut Vec<Diag>) -> Option<VarId> {
    let machine = settings.machine;
    let Some(var) = VarId::parse(&name.text) else {
        let known = VARIABLES.iter().filter(|v| v.machines.has(machine)).map(|v| v.name);
        let known = known.chain(TEXTS.iter().map(|text| text.name));
        let known = known.chain(settings.properties.iter().map(|property| property.name.as_str()));
        let of_number = |base: &str| VarId::parse(base).is_some();
        let help = if name.text.split_once(':').is_some_and(|(name, _)| of_number(name)) {
            "only texts have a width: the width of a number comes from the format of its letter".into()
        } else if let Some(base) = name.text.strip_suffix("^2").filter(|base| of_number(base)) {
            format!("write a power as a product: `[{base}*{base}]`")
        } else if name.text.starts_with('#') {
            format!("put a variable of the control in backquotes with its letter: `` `X{}` ``", name.text)
        } else if let Some((_, own)) = OTHERS.iter().find(|(other, _)| name.text.eq_ignore_ascii_case(other)) {
            format!("the variable is called `{own}`")
        } else {
            did_you_mean(&name.text, known).unwrap_or_else(|| no_name(&name.text))
        };
        let message = format!("`{}` is not a variable", name.text);
        diags.push(Diag::new(Code::PF202, message).at(name.span, "unknown").help(help));
        return None;
    };
    let machines = var.row().machines;
    if !machines.has(machine) {
        diags.push(
            Diag::new(
                Code::PF604,
                format!("`{}` is for {machines}, but this form is for {}", var.name(), machine.name()),
            )
            .at(name.span, format!("not on a {}", machine.name()))
            .help("use another variable, or set the type of machine with `Machine`"),
        );
    }
    Some(var)
}

/// Advice for a name that is not similar to any known name.
fn no_name(text: &str) -> String {
    let names = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
    let help = match text.find(|c: char| !c.is_ascii_alphanumeric()).map(|at| &text[at..]) {
        Some(rest) if rest.starts_with('^') => "write a power as a product: `[d*d]`",
        Some(rest) if rest.starts_with(['<', '>', '=']) => "write a comparison after `@if`, on a separate line",
        Some(rest) if rest.starts_with(',') => {
            "write decimals with a point; several numbers are possible only in `min(..)` and `max(..)`"
        }
        None if text.starts_with(|c: char| c.is_ascii_digit()) && !text.bytes().all(|c| c.is_ascii_digit()) => {
            "write a number times a variable as `[2*d]`"
        }
        None if text.starts_with(|c: char| c.is_ascii_lowercase()) && text.chars().all(names) => {
            return format!(
                "docs/variables.md lists all variables; for a value of your own write a property: `Property {text} \
                 number 0 What it is`"
            );
        }
        _ => "docs/variables.md lists all variables; put text of the control with brackets in backquotes",
    };
    help.to_owned()
}
