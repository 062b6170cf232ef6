//! Program names from a pattern: `{job}-{tool}.nc`.

use super::super::args::SplitArg;
use super::split::Part;

/// The allowed fields in the braces of a pattern.
const FIELDS: [&str; 7] = ["job", "part", "tool", "operation", "work", "setup", "number"];

/// A pattern: a sequence of texts and fields.
pub struct Pattern(Vec<Piece>);

enum Piece {
    Text(String),
    /// An index into [`FIELDS`].
    Field(usize),
}

/// The values for the fields of a name.
pub struct Values<'a> {
    /// The job's file without its extension.
    pub job: &'a str,
    /// The part of the job.
    pub part: Option<Part>,
    /// The number of the program.
    pub number: Option<u32>,
    /// The file extension from the form.
    pub extension: &'a str,
}

impl Pattern {
    /// Reads a pattern.
    ///
    /// # Errors
    /// A message: a brace is not closed, a field is unknown, or a character is not allowed in a file name.
    pub fn parse(text: &str) -> Result<Pattern, String> {
        let wrong = |why: String| format!("error: --name {text:?}: {why}");
        let (mut pieces, mut rest) = (Vec::new(), text);
        while !rest.is_empty() {
            let (typed, field) = rest.split_once('{').map_or((rest, None), |(typed, rest)| (typed, Some(rest)));
            if let Some(c) = typed.chars().find(|c| !c.is_ascii_alphanumeric() && !"_-.".contains(*c)) {
                return Err(wrong(format!(
                    "`{}` can't be part of a file name\n  help: use letters, digits and _ - . ",
                    c.escape_debug()
                )));
            }
            if !typed.is_empty() {
                pieces.push(Piece::Text(typed.to_owned()));
            }
            let Some(field) = field else { break };
            let Some((name, after)) = field.split_once('}') else {
                return Err(wrong("a `{` without its `}`".to_owned()));
            };
            let Some(row) = FIELDS.iter().position(|known| *known == name) else {
                return Err(wrong(format!(
                    "there is no field {{{name}}}\n  help: the fields are {{{}}}",
                    FIELDS.join("}, {")
                )));
            };
            pieces.push(Piece::Field(row));
            rest = after;
        }
        if pieces.is_empty() { Err(wrong("the name is empty".to_owned())) } else { Ok(Pattern(pieces)) }
    }

    /// Checks that all fields have values if jobs are split in this way.
    ///
    /// # Errors
    /// A message: a field has no value.
    pub fn fits(&self, split: Option<SplitArg>) -> Result<(), String> {
        let needs = |field: &str| match field {
            "part" => split.is_none(),
            "tool" => split != Some(SplitArg::Tool),
            "operation" => split != Some(SplitArg::Operation),
            "work" => split != Some(SplitArg::Work),
            "setup" => split != Some(SplitArg::Setup),
            _ => false,
        };
        let fields = self.0.iter().filter_map(|piece| match piece {
            Piece::Field(row) => Some(FIELDS[*row]),
            Piece::Text(_) => None,
        });
        match fields.into_iter().find(|field| needs(field)) {
            Some("part") => Err("error: --name: {part} has no value here\n  help: give --split".to_owned()),
            Some(field) => Err(format!("error: --name: {{{field}}} has no value here\n  help: give --split {field}")),
            None => Ok(()),
        }
    }

    /// A name.
    ///
    /// # Errors
    /// A message: a field has no value.
    pub fn name(&self, values: &Values<'_>) -> Result<String, String> {
        let mut name = String::new();
        let mut has_extension = false;
        for piece in &self.0 {
            match piece {
                Piece::Text(text) => {
                    has_extension |= text.contains('.');
                    name.push_str(text);
                }
                Piece::Field(row) => {
                    let field = FIELDS[*row];
                    let value = values.of(field).ok_or_else(|| {
                        let help = match field {
                            "number" => "give --program, or use another field in --name",
                            "part" => "give --split",
                            _ => "the field needs --split with the name of the field",
                        };
                        format!("error: --name: {{{field}}} has no value here\n  help: {help}")
                    })?;
                    name.push_str(&value);
                }
            }
        }
        if !has_extension {
            name = format!("{name}.{}", values.extension);
        }
        Ok(name)
    }
}

impl Values<'_> {
    fn of(&self, field: &str) -> Option<String> {
        let part = match (field, self.part) {
            // only these characters are kept, as in names from a form: controls, networks and memory cards may refuse
            // other characters
            ("job", _) => {
                let spelt = |c: char| if c.is_ascii_alphanumeric() || "_-.".contains(c) { c } else { '_' };
                return Some(self.job.chars().map(spelt).collect());
            }
            ("number", _) => return self.number.map(|number| number.to_string()),
            ("part", part) => part,
            ("tool", part @ Some(Part::Tool(_)))
            | ("operation", part @ Some(Part::Operation(_)))
            | ("work", part @ Some(Part::Work(_)))
            | ("setup", part @ Some(Part::Setup(_))) => part,
            _ => None,
        };
        part.map(Part::name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn name(pattern: &str, part: Option<Part>) -> Result<String, String> {
        Pattern::parse(pattern)?.name(&Values { job: "bracket", part, number: Some(12), extension: "nc" })
    }

    #[test]
    fn fields_are_filled_in() {
        assert_eq!(name("{job}-{tool}", Some(Part::Tool(3))).unwrap(), "bracket-T3.nc");
        assert_eq!(name("O{number}.ngc", Some(Part::Work(None))).unwrap(), "O12.ngc");
        assert_eq!(name("{part}", Some(Part::Operation(4))).unwrap(), "OP04.nc");
    }

    #[test]
    fn a_wrong_pattern_is_an_error() {
        for (pattern, part, why) in [
            ("", None, "the name is empty"),
            ("{job", None, "a `{` without its `}`"),
            ("{tol}", None, "there is no field {tol}"),
            ("../{job}", None, "`/` can't be part of a file name"),
            ("{tool}", Some(Part::Operation(1)), "{tool} has no value here"),
        ] {
            let error = name(pattern, part).unwrap_err();
            assert!(error.contains(why), "{pattern}: {error}");
        }
    }
}
