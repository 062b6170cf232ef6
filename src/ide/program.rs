//! Checks NC programs by the rules of a control, and explains their codes.

use std::io::Cursor;

use super::complete::{Completion, codes};
use super::hover::{Hover, about_code};
use crate::control::{Code, Control};
use crate::diag::{Code as FindingCode, Diag, Location, Severity};
use crate::nc::{Kind, RunError, RunSettings, Simulator, Unpointed, tokens};
use crate::source::Source;
use crate::span::Span;

/// What a control would report about a program.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Checked {
    /// Warnings and errors of the control.
    pub diags: Vec<Diag>,
    /// Number of blocks that were simulated.
    pub blocks: u64,
    /// Number of blocks with errors. Blocks without errors are simulated.
    pub refused: u64,
    /// Whether the simulation stopped before the end of the program, because a longer simulation would delay the
    /// editor.
    pub cut: bool,
}

/// Maximum number of machine actions. The simulation ends after this number of actions.
const MOST_ACTIONS: usize = 3_000_000;
/// Maximum number of findings. If a fault occurs in each block, more findings would not help.
const MOST_FINDINGS: usize = 200;

/// Simulates a program by the rules of a control. On some controls, a setting decides what a length without a decimal
/// point means. A length without a decimal point is reported once, and the program is then simulated with lengths in
/// whole units.
pub fn check(text: &str, control: &'static Control) -> Checked {
    let mut checked = run(text, RunSettings::new(control));
    let unpointed = |diag: &Diag| diag.code == FindingCode::PN017;
    if let Some(at) = checked.diags.iter().position(unpointed) {
        let mut told = checked.diags.swap_remove(at);
        told.severity = Severity::Warning;
        told.help = Some(
            "write X1. for whole units; postform reads all later numbers of the program as if they had a point".into(),
        );
        checked = run(text, RunSettings { unpointed: Unpointed::Whole, ..RunSettings::new(control) });
        checked.diags.insert(0, told);
    }
    checked
}

fn run(text: &str, settings: RunSettings) -> Checked {
    let mut simulator = Simulator::new(Cursor::new(text.as_bytes()), settings);
    let mut checked = Checked::default();
    let (mut items, mut actions) = (Vec::new(), 0);
    loop {
        items.clear();
        let step = simulator.step(&mut items);
        actions += items.len().max(1);
        checked.diags.extend(simulator.take_warnings());
        match step {
            Ok(true) if actions > MOST_ACTIONS || checked.diags.len() > MOST_FINDINGS => {
                checked.cut = true;
                break;
            }
            Ok(true) => {}
            Ok(false) | Err(RunError::Io(_)) => break,
            Err(RunError::Refused(diag, _)) => {
                checked.diags.push(*diag);
                checked.refused += 1;
                if checked.diags.len() > MOST_FINDINGS || !simulator.pass_over() {
                    break;
                }
            }
        }
    }
    checked.blocks = simulator.blocks();
    checked
}

/// The span of a finding in a program: the word with the fault, or otherwise the line.
pub fn place(source: &Source, location: &Location) -> Span {
    let line = location.line.unwrap_or(1).saturating_sub(1) as usize;
    let Some(&start) = source.line_starts().get(line) else { return Span::default() };
    let text = source.text[start as usize..].lines().next().unwrap_or("");
    let column = location.column.map_or(0, |column| column.saturating_sub(1) as usize);
    let word = tokens(text.as_bytes()).find(|token| token.start <= column && column < token.end);
    let whole = || (text.len() - text.trim_start().len(), text.trim_end().len());
    let (from, to) = match word.filter(|_| column > 0) {
        Some(token) => (token.start, token.start + text[token.start..token.end].trim_end().len()),
        None => whole(),
    };
    Span::new(0, start as usize + from, start as usize + to.max(from))
}

/// The control that a comment in the first twenty lines of a program names, such as `(postform: control haas)` or `;
/// postform: control haas`.
pub fn named_control(text: &str) -> Option<&str> {
    text.lines().take(20).find_map(|line| {
        let at = line.to_ascii_lowercase().find("postform:")?;
        if !line.get(..at)?.contains(['(', ';', '#', '%']) {
            return None;
        }
        let rest = line.get(at + 9..)?.trim_start();
        let head = rest.get(..8).filter(|head| head.eq_ignore_ascii_case("control "))?;
        rest[head.len()..].trim().split([' ', ')', '\t']).next().filter(|name| !name.is_empty())
    })
}

/// The word at a byte of a program, and its code.
pub fn code_at(source: &Source, offset: u32) -> Option<(Span, Code)> {
    let start = *source.line_starts().get(source.line(offset))?;
    let text = source.text.get(start as usize..)?.lines().next()?;
    let column = (offset - start) as usize;
    tokens(text.as_bytes()).find_map(|token| match token.kind {
        Kind::Word(letter, number) if token.start <= column && column <= token.end => {
            let end = token.start + text.get(token.start..token.end)?.trim_end().len();
            let span = Span::new(0, start as usize + token.start, start as usize + end);
            Some((span, Code::of(letter, number.value)?))
        }
        _ => None,
    })
}

/// Information about the code at a byte of a program.
pub fn hover(source: &Source, offset: u32, control: &Control) -> Option<Hover> {
    let (span, code) = code_at(source, offset)?;
    Some(Hover { span, text: about_code(code, control) })
}

/// Completions for words that begin with G or M: the codes of the control.
pub fn complete(source: &Source, offset: u32, control: &Control) -> Vec<Completion> {
    let Some(&start) = source.line_starts().get(source.line(offset)) else { return Vec::new() };
    let before = source.text.get(start as usize..offset as usize).unwrap_or("");
    if before.contains(';') || before.matches('(').count() > before.matches(')').count() {
        return Vec::new(); // a comment
    }
    let digits = before.len() - before.trim_end_matches(|c: char| c.is_ascii_digit() || c == '.').len();
    let letter = before[..before.len() - digits].bytes().next_back().map(|byte| byte.to_ascii_uppercase());
    match letter {
        Some(letter @ (b'G' | b'M')) => {
            let replaces = Span::new(0, offset as usize - digits - 1, offset as usize);
            codes(control, Some(letter), replaces)
        }
        _ => Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn control(name: &str) -> &'static Control {
        Control::named(name).unwrap()
    }

    #[test]
    fn what_a_control_refuses_is_found_with_its_word() {
        let text = "G21 G90\nG1 X1 F100\nG5 X3\nM30\n";
        let checked = check(text, control("grbl"));
        assert!(checked.refused == 1 && checked.diags.len() == 1, "{checked:?}");
        let source = Source::from_text("p.nc", text);
        let span = place(&source, checked.diags[0].place.as_ref().unwrap());
        assert_eq!(source.line(span.start), 2);
        let right = check("G21 G90\nG1 X1 F100\nM30\n", control("grbl"));
        assert_eq!((right.refused, right.blocks, right.diags.len()), (0, 3, 0));
    }

    #[test]
    fn lengths_without_a_point_are_told_once_and_the_rest_is_read() {
        let checked = check("G21 G90 G54\nG1 X1 F100.\nX2\nG5.9 X1.\nM30\n", control("haas"));
        let told: Vec<_> = checked.diags.iter().map(|diag| (diag.code.name(), diag.severity)).collect();
        assert_eq!((told[0], checked.refused), (("PN017", Severity::Warning), 1), "{told:?}");
        assert_eq!(checked.diags.last().and_then(|diag| diag.place.as_ref()?.line), Some(4));
    }

    #[test]
    fn a_comment_names_the_control() {
        assert_eq!(named_control("%\nO1 (PART)\n(postform: control haas)\nG1\n"), Some("haas"));
        assert_eq!(named_control("; Postform: Control grbl\n"), Some("grbl"));
        assert_eq!(named_control("G1 X1\n"), None);
        assert_eq!(named_control("postform: control haas\n"), None, "no comment");
    }

    #[test]
    fn codes_are_told_and_listed() {
        let source = Source::from_text("p.nc", "G90 G81 X1\nM0\n(G8)\n");
        let told = hover(&source, 5, control("haas")).unwrap();
        assert_eq!(source.slice(told.span), "G81");
        assert!(told.text.starts_with("**G81** on haas"), "{}", told.text);
        assert!(hover(&source, 9, control("haas")).is_none(), "X1 is no code");
        let list = complete(&source, 13, control("haas"));
        assert!(
            list.iter().any(|item| item.label == "M8") && list.iter().all(|item| source.slice(item.replaces) == "M0")
        );
        assert!(complete(&source, 17, control("haas")).is_empty(), "a comment");
    }
}
