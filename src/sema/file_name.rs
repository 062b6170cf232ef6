//! The file name of a program: `ProgramName O[program#]`, `Extension mpf`.

use super::args::{Arguments, Read, bad};
use super::store::Setting;
use crate::lang::{TextId, TextVar, VarId};

/// Maximum length of an extension.
const LONGEST_EXTENSION: usize = 8;

/// A part of the file name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NamePart {
    /// Text as written in the form.
    Typed(String),
    /// The number of the program.
    Number,
    /// A text from the head of the job.
    Text(TextId),
}

/// The file name of a program, without its extension. If the file name is empty, the program has the name of the job's
/// file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ProgramName(pub Vec<NamePart>);

/// The extension of the file name.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Extension(pub String);

/// Whether a file name may contain this character. Some controls, networks and memory cards accept no other characters.
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
                return bad(Some(arg), format!("`{c}` can't be part of a file name: use letters, digits and _ - ."));
            }
            if !typed.is_empty() {
                parts.push(NamePart::Typed(typed.to_owned()));
            }
            let Some(variable) = variable else { break };
            let Some((name, behind)) = variable.split_once(']') else {
                return bad(Some(arg), "an unmatched bracket");
            };
            parts.push(match (VarId::parse(name), TextVar::parse(name)) {
                (Some(VarId::Program), _) => NamePart::Number,
                (_, Some(text)) if TEXTS.contains(&text.id) && text.width == 0 => NamePart::Text(text.id),
                _ => {
                    let message = format!("[{name}] can't be used in a file name");
                    return bad(
                        Some(arg),
                        format!("{message}: use [program#], [progname], [partname], [jobfile] or [date]"),
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
            let message = format!(
                "`{text}` is not an extension: write up to {LONGEST_EXTENSION} letters and digits, such as `mpf`"
            );
            return bad(args.all.first(), message);
        }
        self.0 = extension.to_owned();
        Ok(())
    }
}
