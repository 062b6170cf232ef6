//! What the file of a program is called: `ProgramName O[program#]`, `Extension mpf`.

use super::args::{Arguments, Read, bad};
use super::store::Setting;
use crate::lang::{TextId, TextVar, VarId};

/// How long an extension may be.
const LONGEST_EXTENSION: usize = 8;

/// A part of the name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NamePart {
    /// As typed.
    Typed(String),
    /// The program's number.
    Number,
    /// A text of the job's head.
    Text(TextId),
}

/// What a program's file is called, without its extension; empty: as the job's file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ProgramName(pub Vec<NamePart>);

/// What the name of a program's file ends with.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Extension(pub String);

/// May a character stand in the name of a program's file? Controls, networks and memory cards know no others.
pub fn is_of_file_names(c: char) -> bool {
    c.is_ascii_alphanumeric() || "_-.".contains(c)
}

impl Setting for ProgramName {
    fn set(&mut self, args: &Arguments) -> Read<()> {
        const TEXTS: [TextId; 4] = [TextId::Progname, TextId::Partname, TextId::Jobfile, TextId::Date];
        let Some(arg) = args.all.first() else { return bad(None, "ProgramName needs a name") };
        let (mut parts, mut rest) = (Vec::new(), arg.text.as_str());
        while !rest.is_empty() {
            let (typed, variable) = rest.split_once('[').map_or((rest, None), |(typed, rest)| (typed, Some(rest)));
            if let Some(c) = typed.chars().find(|&c| !is_of_file_names(c)) {
                return bad(Some(arg), format!("`{c}` stands in no name of a program: letters, digits and _ - . do"));
            }
            if !typed.is_empty() {
                parts.push(NamePart::Typed(typed.to_owned()));
            }
            let Some(variable) = variable else { break };
            let Some((name, behind)) = variable.split_once(']') else {
                return bad(Some(arg), "a bracket without its partner");
            };
            parts.push(match (VarId::parse(name), TextVar::parse(name)) {
                (Some(VarId::Program), _) => NamePart::Number,
                (_, Some(text)) if TEXTS.contains(&text.id) && text.width == 0 => NamePart::Text(text.id),
                _ => {
                    let message = format!("[{name}] is not known when a file gets its name");
                    return bad(
                        Some(arg),
                        format!("{message}: [program#], [progname], [partname], [jobfile] and [date] are"),
                    );
                }
            });
            rest = behind;
        }
        self.0 = parts;
        Ok(())
    }
}

impl Setting for Extension {
    fn set(&mut self, args: &Arguments) -> Read<()> {
        let text = args.text();
        let extension = text.strip_prefix('.').unwrap_or(&text);
        let fits =
            (1..=LONGEST_EXTENSION).contains(&extension.len()) && extension.bytes().all(|c| c.is_ascii_alphanumeric());
        if !fits {
            let message = format!("`{text}` is no extension: up to {LONGEST_EXTENSION} letters and digits, as `mpf`");
            return bad(args.all.first(), message);
        }
        self.0 = extension.to_owned();
        Ok(())
    }
}
