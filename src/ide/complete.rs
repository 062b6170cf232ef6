//! Completions for the text at a location.

use super::words::markdown;
use super::{Current, Document};
use crate::control::{self, Code, Control};
use crate::diag::CODES;
use crate::explain;
use crate::lang::{
    Args, COMMANDS, CommandId, DIRECTIVES, Each, Machine, Origin, SEQUENCES, SequenceId, TEXTS, TextId, UnitChoice,
    VARIABLES, VarId,
};
use crate::span::Span;

/// A completion.
#[derive(Clone, Debug, PartialEq)]
pub struct Completion {
    /// Text of the completion in the list.
    pub label: String,
    /// Kind of the completion.
    pub kind: Kind,
    /// Short description.
    pub detail: String,
    /// Span of the text that is replaced.
    pub replaces: Span,
    /// Text that is inserted.
    pub text: String,
    /// The completion as a snippet of the Language Server Protocol, if the user can fill in parts of it.
    pub snippet: Option<String>,
}

/// Kinds of completions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A command of the form.
    Command,
    /// A value that a command takes.
    Value,
    /// A sequence.
    Sequence,
    /// `End`, `None`, `Cancel`.
    Keyword,
    /// A variable, or a text of the job.
    Variable,
    /// A G or M code.
    Code,
    /// The code of a finding.
    Finding,
}

/// The documentation of a completion, as Markdown. The documentation is created only for the selected completion,
/// because it needs a search for an example. Values have no documentation.
pub fn about(kind: Kind, label: &str, control: &Control) -> Option<String> {
    let page = match kind {
        Kind::Command => explain::command(CommandId::parse(label)?),
        Kind::Sequence if label == "Upon" => explain::upon(),
        Kind::Sequence => explain::sequence(SequenceId::parse(label)?),
        Kind::Variable => match VarId::parse(label) {
            Some(var) => explain::variable(var),
            None => explain::text(TextId::parse(label)?),
        },
        Kind::Keyword if label == "None" => explain::none(),
        Kind::Keyword if label.starts_with('@') => explain::explain(label).ok()?,
        Kind::Keyword if Each::parse(label).is_some() => explain::explain("@for").ok()?,
        Kind::Keyword => explain::end(),
        Kind::Code => return Some(super::hover::about_code(label.parse().ok()?, control)),
        Kind::Finding => explain::explain(label).ok()?,
        Kind::Value => return None,
    };
    Some(markdown(&page))
}

impl Kind {
    /// All kinds.
    pub const ALL: [Kind; 7] =
        [Kind::Command, Kind::Value, Kind::Sequence, Kind::Keyword, Kind::Variable, Kind::Code, Kind::Finding];
}

impl Document {
    /// The completions at a byte of a file. The completions depend on the text before this byte.
    pub fn complete(&self, file: u32, offset: u32, current: Option<&Current>) -> Vec<Completion> {
        let Some((start, before)) = self.line_before(file, offset) else { return Vec::new() };
        let span = |length: usize| Span::new(file, offset as usize - length, offset as usize);
        if let Some(list) = self.allowances(before, &span) {
            return list;
        }
        if before.contains('#') && !before.contains("Sequence#") && !before.contains("[program#") {
            return Vec::new(); // inside a comment
        }
        let node = self.sequence_at(file, start).filter(|node| node.name.line.span.start < start);
        let open = node.is_some_and(|node| node.end.as_ref().is_none_or(|end| end.line.span.end >= offset));
        if let Some(at) = before.rfind(['[', '<'])
            && !before[at..].contains([']', '>'])
        {
            let line = self.line_of(file, offset).unwrap_or_default();
            // in an expression, the user is writing the last name
            let name = before[at + 1..].rsplit(|c: char| !(c.is_alphanumeric() || c == '_' || c == '#')).next();
            // the letter of the word shows which variables are likely here
            let letter = before[..at].bytes().last().filter(u8::is_ascii_alphabetic);
            return self.variables(span(name.map_or(0, str::len)), before.as_bytes()[at], letter, line, current);
        }
        let word = before.rsplit([' ', '\t']).next().unwrap_or("");
        let first = before.trim_start_matches([' ', '\t']);
        match open {
            true => self.in_sequence(first, word, &span, node.map(|node| node.name.name.text.as_str())),
            false => self.outside(first, word, &span),
        }
    }

    /// Completes `# postform: allow PF` with the codes of the form's findings.
    fn allowances(&self, before: &str, span: &dyn Fn(usize) -> Span) -> Option<Vec<Completion>> {
        let comment = before.rsplit_once('#')?.1.trim_start();
        let rest = comment.strip_prefix("postform:")?.trim_start();
        let word = rest.rsplit(' ').next().unwrap_or("");
        let new = |label: &str, detail: &str, kind| Completion {
            label: label.to_owned(),
            kind,
            detail: detail.to_owned(),
            replaces: span(word.len()),
            text: label.to_owned(),
            snippet: None,
        };
        if !rest.contains(' ') {
            let verbs =
                [("allow", "in this line, the next line, or the sequence below"), ("allow-file", "in the whole file")];
            return Some(verbs.map(|(verb, detail)| new(verb, detail, Kind::Keyword)).into());
        }
        let found = |name: &str| self.findings().iter().any(|diag| diag.code.name() == name);
        let rows = CODES.iter().filter(|row| row.name.starts_with("PF") && found(row.name));
        Some(rows.map(|row| new(row.name, row.title, Kind::Finding)).collect())
    }

    /// The variables of this machine with their values in the current job, and the texts of jobs.
    fn variables(
        &self,
        replaces: Span,
        bracket: u8,
        letter: Option<u8>,
        line: Span,
        current: Option<&Current>,
    ) -> Vec<Completion> {
        let machine = self.checked.form.settings.machine;
        let close = if bracket == b'[' { "]" } else { ">" };
        let source = &self.files()[replaces.file as usize].text;
        let close = if source[replaces.end as usize..].starts_with(close) { "" } else { close };
        let one = |name: &str, detail: String| Completion {
            label: name.to_owned(),
            kind: Kind::Variable,
            detail,
            replaces,
            text: format!("{name}{close}"),
            snippet: None,
        };
        let likely = letter.map_or(&[][..], |letter| likely(letter.to_ascii_uppercase(), machine));
        let mut rows: Vec<_> = VARIABLES.iter().filter(|row| row.machines.has(machine)).collect();
        rows.sort_by_key(|row| likely.iter().position(|var| *var == row.id).unwrap_or(likely.len()));
        let numbers = rows.into_iter().map(|row| {
            let value = current.and_then(|current| Some((&current.name, self.value(line, row.id, current)?)));
            let held = value.map(|(job, value)| format!(" = {value} in {job}")).unwrap_or_default();
            one(row.name, format!("{}{held}: {}", explain::unit(row.unit), row.meaning))
        });
        let texts = TEXTS.iter().map(|row| one(row.name, format!("text: {}", row.meaning)));
        let properties = self.checked.form.settings.properties.iter();
        let properties =
            properties.map(|property| one(&property.name, format!("{}: {}", property.kind.name(), property.text)));
        numbers.chain(texts).chain(properties).collect()
    }

    fn in_sequence(
        &self,
        first: &str,
        word: &str,
        span: &dyn Fn(usize) -> Span,
        name: Option<&str>,
    ) -> Vec<Completion> {
        let keyword = |label: &str, detail: &str| Completion {
            label: label.to_owned(),
            kind: Kind::Keyword,
            detail: detail.to_owned(),
            replaces: span(word.len()),
            text: label.to_owned(),
            snippet: None,
        };
        if first.starts_with('@') {
            return match first.split_once([' ', '\t']) {
                None => DIRECTIVES.iter().map(|row| keyword(row.name, row.meaning)).collect(),
                Some((for_, rest)) if for_.eq_ignore_ascii_case("@for") && rest.trim_start().len() == word.len() => {
                    Each::ALL
                        .iter()
                        .map(|(name, _)| keyword(name, "repeats the lines up to @end for each item of the job"))
                        .collect()
                }
                Some(_) => Vec::new(),
            };
        }
        let is_cycle = name.and_then(SequenceId::parse).is_some_and(|id| id.row().is_cycle && id != SequenceId::Cancel);
        if let Some(rest) = first.get(..4).filter(|head| head.eq_ignore_ascii_case("End ")).map(|_| &first[4..]) {
            let cancel = keyword("Cancel", "print Cancel after the last hole");
            return if is_cycle && !rest.contains(' ') { vec![cancel] } else { Vec::new() };
        }
        let mut list = Vec::new();
        if first.len() == word.len() {
            list.push(keyword("End", "ends the sequence"));
            if is_cycle {
                list.push(keyword("End Cancel", "ends the sequence and cancels the cycle"));
            }
            list.push(keyword("None", "as the whole body of a sequence: prints nothing"));
        }
        let letter = word.bytes().next().map(|byte| byte.to_ascii_uppercase());
        match letter {
            Some(letter @ (b'G' | b'M')) if word[1..].bytes().all(|b| b.is_ascii_digit() || b == b'.') => {
                codes(self.control(), Some(letter), span(word.len()))
            }
            None => {
                list.extend(codes(self.control(), None, span(0)));
                list
            }
            _ => list,
        }
    }

    fn outside(&self, first: &str, word: &str, span: &dyn Fn(usize) -> Span) -> Vec<Completion> {
        if first.len() > word.len() {
            let name = first.split([' ', '\t']).next().unwrap_or("");
            let index = first.split([' ', '\t']).filter(|part| !part.is_empty()).count().saturating_sub(1);
            let index = if word.is_empty() { index } else { index - 1 };
            return self.values(name, index, span(word.len()));
        }
        let settings = &self.checked.form.settings;
        let (machine, form) = (settings.machine, &self.checked.form);
        let statements = || self.checked.trees.iter().flat_map(|tree| tree.statements());
        let there = |id: CommandId| statements().any(|statement| CommandId::parse(&statement.name.text) == Some(id));
        let replaces = span(word.len());
        // commands are allowed only before the first sequence
        let any_above =
            self.checked.trees[replaces.file as usize].sequences().any(|node| node.span().start < replaces.start);
        // a completely written name is always listed, even if the form already has it
        let typed = |name: &str| name.eq_ignore_ascii_case(word);
        let commands = COMMANDS.iter().filter(|row| typed(row.name) || !any_above && (row.repeats || !there(row.id)));
        let mut list: Vec<Completion> = commands
            .map(|row| Completion {
                label: row.name.to_owned(),
                kind: Kind::Command,
                detail: row.meaning.to_owned(),
                replaces,
                text: row.name.to_owned(),
                snippet: Some(shape(row.id, machine)),
            })
            .collect();
        let sequences = SEQUENCES
            .iter()
            .filter(|row| row.machines.has(machine) && (typed(row.name) || !form.sequences.contains_key(&row.id)));
        list.extend(sequences.map(|row| Completion {
            label: row.name.to_owned(),
            kind: Kind::Sequence,
            detail: row.meaning.to_owned(),
            replaces,
            text: row.name.to_owned(),
            snippet: Some(body(row.id)),
        }));
        list.push(Completion {
            label: "Upon".to_owned(),
            kind: Kind::Sequence,
            detail: "a sequence that runs when a variable changed, before its next use".to_owned(),
            replaces,
            text: "Upon".to_owned(),
            snippet: Some("Upon [${1:work}]\n$0\nEnd".to_owned()),
        });
        list
    }

    /// The values that a command accepts.
    fn values(&self, name: &str, index: usize, replaces: Span) -> Vec<Completion> {
        let new = |label: &str, detail: &str| Completion {
            label: label.to_owned(),
            kind: Kind::Value,
            detail: detail.to_owned(),
            replaces,
            text: label.to_owned(),
            snippet: None,
        };
        if name.eq_ignore_ascii_case("Upon") && index == 0 {
            return vec![new("Every", "at every use of the variable, not only when it changes")];
        }
        let Some(id) = CommandId::parse(name) else { return Vec::new() };
        match id.row().args {
            Args::Switch if index == 0 => vec![new("Y", "yes"), new("N", "no")],
            Args::Choice(words) if index == 0 => words.iter().map(|word| new(word, "")).collect(),
            Args::Codes(letter, _, most) if index < usize::from(most) => {
                codes(self.control(), Some(letter as u8), replaces)
            }
            Args::Motion(_, most) if index < usize::from(most) => codes(self.control(), Some(b'G'), replaces),
            _ if id == CommandId::Control && index == 0 => {
                let controls = control::names().filter_map(Control::named);
                controls.map(|control| new(control.name(), control.title())).collect()
            }
            _ if matches!(id, CommandId::Ask | CommandId::Each) && index == 0 => {
                let rows = VARIABLES.iter().filter(|row| row.origin != Origin::Computed);
                rows.map(|row| new(&format!("[{}]", row.name), row.meaning)).collect()
            }
            _ => Vec::new(),
        }
    }
}

/// The variables that a word with this letter probably prints, most likely first. These variables are taken from the
/// shipped forms.
fn likely(letter: u8, machine: Machine) -> &'static [VarId] {
    use VarId as V;
    match (letter, machine) {
        (b'X', Machine::Lathe) => &[V::V],
        (b'Z', Machine::Lathe) => &[V::H],
        (b'X', _) => &[V::H],
        (b'Y', _) => &[V::V],
        (b'Z', _) => &[V::D, V::Vclear, V::Rplane],
        (b'A' | b'B' | b'C', Machine::Mill) => &[V::Rotangle],
        (b'I', _) => &[V::Ival],
        (b'J', _) => &[V::Jval],
        (b'R', _) => &[V::Vclear, V::Arcrad],
        (b'Q', _) => &[V::Vbite],
        (b'P', _) => &[V::Dwell],
        (b'F', _) => &[V::Frate, V::Plunge],
        (b'S', _) => &[V::Speed],
        (b'T', _) => &[V::Tool, V::Nexttool, V::Comp],
        (b'H', _) => &[V::Lcomp],
        (b'D', _) => &[V::Dcomp],
        (b'G', _) => &[V::Work, V::Unitmode, V::Side],
        (b'M', _) => &[V::Direct, V::Cool, V::Coolantoff],
        (b'O', _) => &[V::Program],
        (b'N', _) => &[V::Block],
        _ => &[],
    }
}

/// The codes of a control as completions.
pub(super) fn codes(control: &Control, letter: Option<u8>, replaces: Span) -> Vec<Completion> {
    let rows = control.rows().filter(|row| letter.is_none_or(|letter| row.code.letter == letter));
    rows.map(|row| {
        let code: Code = row.code;
        let about = explain::controls::code(control, code).unwrap_or_default();
        Completion {
            label: code.to_string(),
            kind: Kind::Code,
            detail: about.clone(),
            replaces,
            text: code.to_string(),
            snippet: None,
        }
    })
    .collect()
}

/// A snippet of a command with its default, which the user can change.
fn shape(id: CommandId, machine: Machine) -> String {
    let row = id.row();
    let default = row.without.arguments(machine, UnitChoice::Inch);
    let filled = match (row.args, default) {
        (Args::Switch, default) => format!("${{1|{}|}}", if default == "Y" { "N,Y" } else { "Y,N" }),
        (Args::Choice(words), _) => format!("${{1|{}|}}", words.join(",")),
        (_, "") => row.example.map_or_else(|| "$0".to_owned(), |example| format!("${{1:{}}}", quoted(example))),
        (_, default) => {
            let parts = default.split(' ').enumerate();
            parts.map(|(i, part)| format!("${{{}:{}}}", i + 1, quoted(part))).collect::<Vec<_>>().join(" ")
        }
    };
    format!("{} {filled}", row.name)
}

/// A snippet of a sequence without lines.
fn body(id: SequenceId) -> String {
    let end = if id.makes_holes() { "End Cancel" } else { "End" };
    format!("{}\n$0\n{end}", id.name())
}

fn quoted(text: &str) -> String {
    text.replace('\\', "\\\\").replace('$', "\\$").replace('}', "\\}")
}

#[cfg(test)]
mod tests {
    use super::super::document::tests::{haas, marked};
    use super::*;

    fn listed(document: &Document, offset: u32) -> Vec<Completion> {
        let current = haas("", "").0.print_sample();
        document.complete(0, offset, current.as_ref())
    }

    fn labels(from: &str, to: &str) -> Vec<String> {
        let (document, offset) = haas(from, to);
        listed(&document, offset).into_iter().map(|item| item.label).collect()
    }

    fn has(labels: &[String], label: &str) -> bool {
        labels.iter().any(|other| other == label)
    }

    #[test]
    fn commands_and_sequences_that_are_not_there_yet() {
        let all = labels("\nSequence#s", "\n|\nSequence#s");
        assert!(has(&all, "Coolant") && has(&all, "CycleOrient") && has(&all, "Upon"), "{all:?}");
        assert!(!has(&all, "ArcPlane") && !has(&all, "Drill"), "what is there needs no second one");
        let behind = labels("\nCancel", "\n|\nCancel");
        assert!(!has(&behind, "Coolant") && has(&behind, "EndRow"), "commands stand above sequences: {behind:?}");
        let (document, offset) = haas("\nSequence#s", "\nCoo|\nSequence#s");
        let list = listed(&document, offset);
        let coolant = list.iter().find(|item| item.label == "Coolant").unwrap();
        assert_eq!(coolant.snippet.as_deref(), Some("Coolant ${1:8} ${2:9} ${3:7}"));
        assert_eq!(document.slice(coolant.replaces), "Coo");
    }

    #[test]
    fn variables_behind_a_bracket_with_their_value() {
        let (document, offset) = haas("R[vclear]", "R[vc|lear]");
        let current = haas("", "").0.print_sample();
        let list = document.complete(0, offset, current.as_ref());
        let vclear = list.iter().find(|item| item.label == "vclear").unwrap();
        assert!(
            vclear.detail.starts_with("length = ") && vclear.detail.contains(" in the sample job: clearance"),
            "{vclear:?}"
        );
        assert_eq!((document.slice(vclear.replaces), vclear.text.as_str()), ("vc", "vclear]"));
        assert!(list.iter().all(|item| item.label != "h2"), "a wire's variable on a mill");
        let name = list.iter().find(|item| item.label == "toolname").unwrap();
        assert_eq!((name.detail.as_str(), name.text.as_str()), ("text: the tool's name", "toolname]"));
        let page = about(Kind::Variable, "toolname", document.control()).unwrap();
        assert!(page.starts_with("**[toolname] (text)**"), "{page}");
        let (document, offset) = haas("G81 X[h] Y[v]", "G81 X[| Y[v]");
        assert_eq!(listed(&document, offset).iter().find(|item| item.label == "h").unwrap().text, "h]");
    }

    #[test]
    fn what_is_likely_stands_first_and_what_is_typed_is_listed() {
        let first = |from: &str, to: &str| labels(from, to)[0].clone();
        assert_eq!(first("R[vclear]", "R[|"), "vclear");
        assert_eq!(first("T[tool] M6", "T[|"), "tool");
        assert_eq!(first("S[speed]", "S[|"), "speed");
        assert_eq!(first("X[h] Y[v]", "X[h] Y[|"), "v");
        // a form can have only one Tap, but a completely written name is still listed
        let (document, offset) = haas("\nCancel", "\nTap|\nCancel");
        let list = listed(&document, offset);
        assert!(list.iter().any(|item| item.label == "Tap"), "{list:?}");
    }

    #[test]
    fn codes_of_the_control_behind_a_letter() {
        let g = labels("G53 Z0 M5", "G53 Z0 M5 G|");
        assert!(has(&g, "G187") && !has(&g, "M5"), "{g:?}");
        let m = labels("G53 Z0 M5", "G53 Z0 M|");
        assert!(has(&m, "M8") && !has(&m, "G81"));
        assert!(has(&labels("ArcPlane G17", "ArcPlane G|"), "G17"));
    }

    #[test]
    fn the_end_of_a_cycle_and_what_commands_take() {
        assert_eq!(labels("End Cancel", "End |"), ["Cancel"]);
        assert!(labels("G49 G80 G90\nEnd", "G49 G80 G90\nEnd |").is_empty(), "StartCode is no cycle");
        assert!(has(&labels("End Cancel", "|"), "End Cancel"));
        assert_eq!(labels("Machine Mill", "Machine |"), ["Mill", "Lathe", "EDM", "Torch", "Laser"]);
        assert_eq!(labels("RigidTap? Y", "RigidTap? |"), ["Y", "N"]);
        assert!(has(&labels("Control haas", "Control ha|"), "haas"));
        assert!(labels("# Haas VF", "# Haas G|").is_empty(), "a comment");
    }

    #[test]
    fn allowances_name_what_is_found() {
        let (document, offset) = marked("Machine Mill\nDril\n# postform: allow PF|\n");
        let list = document.complete(0, offset, None);
        assert!(!list.is_empty() && list.iter().all(|item| item.kind == Kind::Finding), "{list:?}");
        let (document, offset) = marked("# postform: |\n");
        assert_eq!(document.complete(0, offset, None)[0].label, "allow");
    }
}
