//! Properties: named values that a form declares and that a shop, a job or a user can set.

use std::collections::HashSet;

use super::args::{Arguments, Read, bad};
use super::store::Setting;
use crate::lang::{TextVar, VarId};
use crate::span::Span;
use crate::suggest::did_you_mean;

/// Maximum number of tool fields in a form. A tool field is a text that the job gives for each tool.
const MOST_FIELDS: usize = 24;
/// Prefix of a tool field's name.
const OF_TOOL: &str = "tool.";

impl Property {
    /// The name of the tool field, such as `holder`; `None` if the form itself declares the property.
    pub fn of_tool(&self) -> Option<&str> {
        self.name.strip_prefix(OF_TOOL)
    }
}

/// The tool fields that the texts of a form use, such as `[tool.holder]`. A job can give the values of the tool fields
/// under `data` of each tool.
pub(super) fn fields_of_tools<'t>(texts: impl Iterator<Item = &'t str>) -> Vec<Property> {
    let mut fields: Vec<Property> = Vec::new();
    for text in texts {
        let lower = text.to_ascii_lowercase();
        for (at, _) in lower.match_indices("[tool.") {
            let rest = &lower[at + 1..];
            let in_name = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '.';
            let name = &rest[..rest.find(|c| !in_name(c)).unwrap_or(rest.len())];
            let own = &name[OF_TOOL.len()..];
            let is_name = own.starts_with(|c: char| c.is_ascii_alphabetic()) && !own.contains('.');
            if is_name && fields.len() < MOST_FIELDS && fields.iter().all(|field| field.name != name) {
                fields.push(Property {
                    name: name.to_owned(),
                    kind: PropertyKind::Text,
                    default: PropertyValue::Text(String::new()),
                    text: format!("field `{own}` of the tool, from `data` in the job"),
                    span: Span::default(),
                });
            }
        }
    }
    fields
}

/// Maximum number of properties in a form.
const MOST: usize = 64;
/// Maximum length of a name.
const LONGEST_NAME: usize = 30;
/// Maximum length of a text.
const LONGEST_TEXT: usize = 200;

/// Type of a property.
#[derive(Clone, Debug, PartialEq)]
pub enum PropertyKind {
    /// Any number.
    Number,
    /// A length in the form's units.
    Length,
    /// An angle in degrees.
    Angle,
    /// Yes or no.
    YesNo,
    /// Text.
    Text,
    /// One of a list of words.
    Choice(Vec<String>),
}

/// The value of a property.
#[derive(Clone, Debug, PartialEq)]
pub enum PropertyValue {
    /// A number, length or angle.
    Number(f64),
    /// Yes or no.
    YesNo(bool),
    /// A text, or one word of a choice.
    Text(String),
}

/// A property, as declared by `Property through choice(off,on,high) off Coolant through the spindle`.
#[derive(Clone, Debug, PartialEq)]
pub struct Property {
    /// Name in lower case.
    pub name: String,
    /// Type of the value.
    pub kind: PropertyKind,
    /// Default value.
    pub default: PropertyValue,
    /// Description of the property, as a question to the user.
    pub text: String,
    /// Location of the command.
    pub span: Span,
}

impl PropertyKind {
    fn parse(text: &str) -> Result<PropertyKind, String> {
        Ok(match text.to_ascii_lowercase().as_str() {
            "number" => PropertyKind::Number,
            "length" => PropertyKind::Length,
            "angle" => PropertyKind::Angle,
            "yesno" => PropertyKind::YesNo,
            "text" => PropertyKind::Text,
            other => {
                let words = other.strip_prefix("choice(").and_then(|rest| rest.strip_suffix(')'));
                let Some(_) = words else {
                    let kinds = ["number", "length", "angle", "yesno", "text"];
                    let meant = match other {
                        "bool" | "boolean" | "switch" | "yes/no" => Some("did you mean `yesno`?".to_owned()),
                        _ if other.starts_with("choice(") => {
                            Some("write its words without spaces: `choice(off,on)`".into())
                        }
                        _ => did_you_mean(other, kinds),
                    };
                    let all = || "the kinds are number, length, angle, yesno, text and choice(off,on)".to_owned();
                    return Err(format!("`{text}` is not a kind of property; {}", meant.unwrap_or_else(all)));
                };
                let words: Vec<String> = text["choice(".len()..text.len() - 1].split(',').map(str::to_owned).collect();
                let mut seen = HashSet::new();
                let once = words.iter().all(|word| seen.insert(word.to_ascii_lowercase()));
                if words.len() < 2 || words.iter().any(String::is_empty) || !once {
                    return Err("a choice needs two or more different words, as choice(off,on)".into());
                }
                PropertyKind::Choice(words)
            }
        })
    }

    /// The accepted values in words, for a message.
    pub fn takes(&self) -> String {
        match self {
            PropertyKind::Number => "a number".into(),
            PropertyKind::Length => "a length, in the form's units".into(),
            PropertyKind::Angle => "an angle in degrees".into(),
            PropertyKind::YesNo => "yes or no".into(),
            PropertyKind::Text => format!("a text of at most {LONGEST_TEXT} characters"),
            PropertyKind::Choice(words) => format!("one of {}", words.join(", ")),
        }
    }

    /// The name of the type as it is written in forms.
    pub fn name(&self) -> &'static str {
        match self {
            PropertyKind::Number => "number",
            PropertyKind::Length => "length",
            PropertyKind::Angle => "angle",
            PropertyKind::YesNo => "yesno",
            PropertyKind::Text => "text",
            PropertyKind::Choice(_) => "choice",
        }
    }

    /// Whether values of this type are printed and compared as texts.
    pub fn is_text(&self) -> bool {
        matches!(self, PropertyKind::Text | PropertyKind::Choice(_))
    }

    /// Reads a value as a user writes it.
    ///
    /// # Errors
    /// The text is not a value of this type. The error describes the accepted values.
    pub fn read(&self, text: &str) -> Result<PropertyValue, String> {
        let value = match self {
            PropertyKind::Number | PropertyKind::Length | PropertyKind::Angle => {
                text.trim().parse().ok().filter(|number: &f64| number.is_finite()).map(PropertyValue::Number)
            }
            PropertyKind::YesNo => match text.trim().to_ascii_lowercase().as_str() {
                "yes" | "y" | "on" | "true" => Some(PropertyValue::YesNo(true)),
                "no" | "n" | "off" | "false" => Some(PropertyValue::YesNo(false)),
                _ => None,
            },
            PropertyKind::Text => {
                let fits = text.chars().count() <= LONGEST_TEXT && !text.chars().any(char::is_control);
                fits.then(|| PropertyValue::Text(text.to_owned()))
            }
            PropertyKind::Choice(words) => {
                let word = words.iter().find(|word| word.eq_ignore_ascii_case(text.trim()));
                word.map(|word| PropertyValue::Text(word.clone()))
            }
        };
        const SHOWN: usize = 30;
        value.ok_or_else(|| match text.char_indices().nth(SHOWN) {
            Some((end, _)) => format!("`{}...` is not {}", &text[..end], self.takes()),
            None => format!("`{text}` is not {}", self.takes()),
        })
    }
}

impl PropertyValue {
    /// The value as a number. Yes is 1.
    pub fn number(&self) -> f64 {
        match self {
            PropertyValue::Number(number) => *number,
            PropertyValue::YesNo(yes) => f64::from(u8::from(*yes)),
            PropertyValue::Text(_) => 0.0,
        }
    }

    /// The value as a text; empty if the value is not a text.
    pub fn text(&self) -> &str {
        if let PropertyValue::Text(text) = self { text } else { "" }
    }
}

impl std::fmt::Display for PropertyValue {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        match self {
            PropertyValue::Number(number) => write!(f, "{number}"),
            PropertyValue::YesNo(yes) => f.write_str(if *yes { "yes" } else { "no" }),
            PropertyValue::Text(text) => f.write_str(text),
        }
    }
}

/// Checks whether a new property can have this name.
///
/// # Errors
/// The reason why a property can't have this name.
pub fn check_name(name: &str) -> Result<(), String> {
    let letters = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
    if !name.starts_with(|c: char| c.is_ascii_lowercase()) || !name.chars().all(letters) || name.len() > LONGEST_NAME {
        return Err(format!(
            "`{name}` can't be the name of a property: use lower-case letters, digits and _, at most {LONGEST_NAME}"
        ));
    }
    if VarId::parse(name).is_some() || TextVar::parse(name).is_some() {
        return Err(format!("[{name}] is a variable: use another name for the property"));
    }
    if ["and", "or", "not", "like"].contains(&name) {
        return Err(format!("`{name}` is a word of conditions: use another name"));
    }
    Ok(())
}

impl Setting for Vec<Property> {
    fn set(&mut self, args: &Arguments) -> Read<()> {
        let [name, kind, default, question @ ..] = args.all else {
            return bad(None, "Property takes a name, a kind, a default and a question");
        };
        let own = &name.text;
        check_name(own).or_else(|message| bad(Some(name), message))?;
        if self.iter().any(|other| other.name == *own) {
            return bad(Some(name), format!("the property `{own}` exists already"));
        }
        if self.len() == MOST {
            return bad(Some(name), format!("a form can have at most {MOST} properties"));
        }
        let kind = PropertyKind::parse(&kind.text).or_else(|message| bad(Some(kind), message))?;
        let value = kind.read(&default.text).or_else(|message| bad(Some(default), message))?;
        let text = question.iter().map(|word| word.text.as_str()).collect::<Vec<_>>().join(" ");
        self.push(Property { name: own.clone(), kind, default: value, text, span: args.span });
        Ok(())
    }
}

/// The target of `@set`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// A free variable.
    Var(VarId),
    /// A property, by its row.
    Property(u16),
}
