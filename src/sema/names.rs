//! What words and conditions of a form have in common, and the names of variables in them.

use super::property::Property;
use super::settings::Settings;
use crate::diag::{Code, Diag};
use crate::lang::{TEXTS, VARIABLES, VarId, did_you_mean};
use crate::syntax::Spanned;

/// What the words of a form have in common.
pub struct Context<'a> {
    /// The marks around comments; the second is empty where they run to the end of the block.
    pub comment: &'a [String; 2],
    /// What the form's commands say.
    pub settings: &'a Settings,
}

/// What other systems call variables.
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

/// A property of the form, by its name.
pub fn property<'a>(name: &str, context: &Context<'a>) -> Option<(u16, &'a Property)> {
    let row = context.settings.properties.iter().position(|property| property.name.eq_ignore_ascii_case(name))?;
    Some((row as u16, &context.settings.properties[row]))
}

/// Reads the name of a variable; reports it when there is none, or none on this machine.
pub fn variable(name: &Spanned, settings: &Settings, diags: &mut Vec<Diag>) -> Option<VarId> {
    let machine = settings.machine;
    let Some(var) = VarId::parse(&name.text) else {
        let known = VARIABLES.iter().filter(|v| v.machines.has(machine)).map(|v| v.name);
        let known = known.chain(TEXTS.iter().map(|text| text.name));
        let known = known.chain(settings.properties.iter().map(|property| property.name.as_str()));
        let mut diag = Diag::new(Code::PF202, format!("`{}` is no variable", name.text)).at(name.span, "unknown");
        let other = OTHERS.iter().find(|(other, _)| name.text.eq_ignore_ascii_case(other));
        diag.help = other.map(|(_, own)| format!("it is called `{own}`")).or_else(|| did_you_mean(&name.text, known));
        if name.text.split_once(':').is_some_and(|(name, _)| VarId::parse(name).is_some()) {
            diag.help = Some("only texts have a width: that of a number comes from its letter's format".into());
        } else if let Some(base) = name.text.strip_suffix("^2").filter(|base| VarId::parse(base).is_some()) {
            diag.help = Some(format!("a power is a product: `[{base}*{base}]`"));
        } else if name.text.starts_with('#') {
            diag.help =
                Some(format!("a variable of the control stands in backquotes with its letter: `` `X{}` ``", name.text));
        } else if diag.help.is_none() {
            diag.help = Some(no_name(&name.text));
        }
        diags.push(diag);
        return None;
    };
    let machines = var.row().machines;
    if !machines.has(machine) {
        diags.push(
            Diag::new(Code::PF604, format!("`{}` is for {machines}, this form is for {}", var.name(), machine.name()))
                .at(name.span, format!("not on a {}", machine.name()))
                .help("take another variable, or say with `Machine` what the form is for"),
        );
    }
    Some(var)
}

/// What to write instead of a name that is like none.
fn no_name(text: &str) -> String {
    let names = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
    let help = match text.find(|c: char| !c.is_ascii_alphanumeric()).map(|at| &text[at..]) {
        Some(rest) if rest.starts_with('^') => "a power is a product: `[d*d]`",
        Some(rest) if rest.starts_with(['<', '>', '=']) => "a comparison stands after `@if`, on a line of its own",
        Some(rest) if rest.starts_with(',') => {
            "a decimal has a point; several numbers stand in `min(..)` and `max(..)`"
        }
        None if text.starts_with(|c: char| c.is_ascii_digit()) && !text.bytes().all(|c| c.is_ascii_digit()) => {
            "a number times a variable is written `[2*d]`"
        }
        None if text.starts_with(|c: char| c.is_ascii_lowercase()) && text.chars().all(names) => {
            return format!(
                "docs/variables.md lists all; a value of the form's own is a property: `Property {text} number 0 What it is`"
            );
        }
        _ => "docs/variables.md lists all; text of the control with brackets stands in backquotes",
    };
    help.to_owned()
}
