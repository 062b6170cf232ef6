//! Information about the element under the mouse pointer.

use super::formats::examples;
use super::words::{blocks, escape, markdown};
use super::{At, Current, Document, What};
use crate::control::{Code, Control};
use crate::explain;
use crate::lang::{Unit, VarId};
use crate::number::LetterFormat;
use crate::span::Span;

/// Information about an element.
#[derive(Clone, Debug, PartialEq)]
pub struct Hover {
    /// Span of the element.
    pub span: Span,
    /// The information, as Markdown.
    pub text: String,
}

/// The description of text in backquotes.
const QUOTE: &str = "**text in backquotes**\n\nis printed unchanged, with its spaces, `#` and brackets; two \
    backquotes inside print one. `Replace`, `Rename`, `Spaces` and `UpperCaseComments` do not change it.";

/// Maximum number of blocks that are shown for a line.
const MOST_BLOCKS: usize = 3;

impl Document {
    /// The description of a property: its kind, its default and its question.
    fn property(&self, row: u16) -> String {
        let Some(property) = self.checked.form.settings.properties.get(usize::from(row)) else { return String::new() };
        let [name, kind, default] = [&property.name, &property.kind.takes().to_string(), &property.default.to_string()]
            .map(|text| escape(text));
        format!("**{name}**: {}\n\nA property of this form: {kind}; by default {default}.", escape(&property.text))
    }

    /// Information about the element at a byte of a file: its explanation, the effect of a code, examples of a format, and what
    /// its line prints in the current job.
    pub fn hover(&self, file: u32, offset: u32, current: Option<&Current>) -> Option<Hover> {
        let line = self.line_of(file, offset)?;
        let printed = current.and_then(|current| printed(current, line));
        let Some(At { span, what }) = self.at(file, offset) else {
            return printed.map(|text| Hover { span: line, text });
        };
        let mut text = self.about(&what);
        if let (What::Variable(var, _), Some(current)) = (&what, current)
            && let Some(value) = self.value(line, *var, current)
        {
            text += &format!("\n\nin {}: **{value}**", escape(&current.name));
        }
        if let Some(printed) = printed {
            text += &format!("\n\n---\n{printed}");
        }
        Some(Hover { span, text })
    }

    fn about(&self, what: &What) -> String {
        match what {
            What::Command(id) | What::Argument(id, _) => markdown(&explain::command(*id)),
            What::Sequence(id) => markdown(&explain::sequence(*id)),
            What::Upon => markdown(&explain::upon()),
            What::End | What::Cancel => markdown(&explain::end()),
            What::Nothing => markdown(&explain::none()),
            What::Variable(var, _) => markdown(&explain::variable(*var)),
            What::Text(id) => markdown(&explain::text(*id)),
            What::Property(row) => self.property(*row),
            What::Quote => QUOTE.to_owned(),
            What::Code(code) => about_code(*code, self.control()),
            What::Format(letter) | What::Word(letter) => self.format(*letter),
        }
    }

    /// Examples of numbers in the format of this letter.
    fn format(&self, letter: u8) -> String {
        let shown = char::from(letter);
        let settings = &self.checked.form.settings;
        let Some((format, span)) = self.checked.form.formats.get(&letter) else {
            return format!("**{shown}**\n\nThe form has no format for this letter: the built-in format is used.");
        };
        let spelt = self.slice(*span).trim();
        let head = format!("**{}**\n\n{}", escape(spelt), in_words(format));
        let rows = examples(letter, format, settings.leading_zeros);
        let rows: Vec<String> = rows.iter().map(|(value, text)| format!("{value:<8} → {text}")).collect();
        format!("{head}\n```text\n{}\n```", rows.join("\n"))
    }

    /// The line that contains a byte, without its line end.
    pub fn line_of(&self, file: u32, offset: u32) -> Option<Span> {
        let (start, _) = self.line_before(file, offset)?;
        let text = &self.files()[file as usize].text[start as usize..];
        let length = text.find('\n').unwrap_or(text.len());
        Some(Span::new(file, start as usize, start as usize + text[..length].trim_end().len()))
    }

    /// The value of a variable in the current job at the first output of its line, or otherwise of its sequence.
    pub(super) fn value(&self, line: Span, var: VarId, current: &Current) -> Option<String> {
        let sequence = self.sequence_at(line.file, line.start).map(|node| node.span());
        let value = current.value(line, var).or_else(|| current.value(sequence?, var))?;
        Some(shown(value, var))
    }
}

/// A value with its unit.
fn shown(value: f64, var: VarId) -> String {
    let rounded = (value * 1e6).round() / 1e6;
    match var.row().unit {
        Unit::Angle => format!("{rounded}°"),
        _ => rounded.to_string(),
    }
}

/// The effect of a code on a control, as Markdown.
pub(super) fn about_code(code: Code, control: &Control) -> String {
    match explain::controls::code(control, code) {
        Some(about) => format!("**{code}** on {}\n\n{}", escape(control.shown()), escape(&about)),
        None if control.refuses(code) => format!("**{code}**\n\n{} refuses it", escape(control.shown())),
        None => format!("**{code}**\n\nThe effect of this code on {} is unknown.", escape(control.shown())),
    }
}

fn in_words(format: &LetterFormat) -> String {
    use crate::number::{Point, Sign};
    let sign = match format.sign {
        Sign::Unsigned => "no sign: a negative value is an error",
        Sign::Minus => "a minus if the value is negative",
        Sign::Always => "always a sign",
    };
    let digits = |digits: crate::number::Digits| match digits.fixed {
        true => format!("exactly {}", digits.count),
        false => format!("up to {}", digits.count),
    };
    let point = match (format.point, format.dec.count) {
        (Point::Implied, 0) => String::new(),
        (Point::Implied, _) => format!(", {} decimals without a point", digits(format.dec)),
        (Point::Always, _) => format!(", always a point, {} decimals", digits(format.dec)),
        (Point::BeforeFraction, _) => format!(", a point only before a fraction, {} decimals", digits(format.dec)),
    };
    format!("{sign}; {} digits{point}", digits(format.int))
}

/// The blocks that a line printed, as Markdown.
fn printed(current: &Current, line: Span) -> Option<String> {
    let printed = current.printed(line, MOST_BLOCKS);
    let times = match printed.times {
        0 => return None,
        1 => "prints 1 block".to_owned(),
        times => format!("prints {times} blocks"),
    };
    let more = if printed.times > printed.first.len() { "\n…" } else { "" };
    let first = printed.first.iter().map(|(_, block)| *block);
    let shown = blocks(first.chain(more.strip_prefix('\n')));
    Some(format!("in {} this line {times}\n{shown}", escape(&current.name)))
}

#[cfg(test)]
mod tests {
    use super::super::document::tests::haas;

    fn text(from: &str, to: &str) -> String {
        let (document, offset) = haas(from, to);
        let current = document.print_sample();
        document.hover(0, offset, current.as_ref()).map_or_else(String::new, |hover| hover.text)
    }

    #[test]
    fn each_kind_is_told_of() {
        let variable = text("R[vclear]", "R[vc|lear]");
        assert!(
            variable.starts_with("**[vclear] (variable)**") && variable.contains("in the sample job: **"),
            "{variable}"
        );
        assert!(variable.contains("this line prints ") && variable.contains("```nc\n"), "{variable}");
        let code = text("G40 G49", "G|40 G49");
        assert!(code.starts_with("**G40** on haas\n\n"), "{code}");
        let format = text("Y->4.>4", "Y->|4.>4");
        assert!(
            format.contains("a minus if the value is negative; up to 4 digits, always a point, up to 4 decimals"),
            "{format}"
        );
        assert!(format.contains("12.5     → Y12.5\n-0.25    → Y-.25\n3        → Y3."), "{format}");
        assert!(text("ArcPlane", "Arc|Plane").starts_with("**ArcPlane (command)**"));
        assert!(text("\nCancel", "\nCan|cel").starts_with("**Cancel (canned cycle)**"));
        assert!(text("Upon [work]", "U|pon [work]").starts_with("**Upon"));
        let tool = text("G81 X[h]", "(DRILL [tool|name:12]) G81 X[h]");
        assert!(tool.starts_with("**[toolname] (text)**\n\nthe tool's name"), "{tool}");
        assert!(text("G81 X[h]", "`MCALL #|1` G81 X[h]").starts_with("**text in backquotes**"));
        assert_eq!(text("# Haas", "# H|aas"), "");
    }
}
