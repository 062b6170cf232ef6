//! Findings for people: the line of the form with what is wrong under it.

use std::fmt;

use miette::{
    Diagnostic, GraphicalReportHandler, GraphicalTheme, LabeledSpan, NamedSource, Severity as Level, SourceCode,
};

use postform::diag::{Diag, Severity};
use postform::source::Source;

/// A finding with the text it is about.
struct Shown<'a> {
    diag: &'a Diag,
    source: Option<NamedSource<String>>,
    file: u32,
}

impl fmt::Debug for Shown<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.diag.message)
    }
}

impl fmt::Display for Shown<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.diag.message)?;
        match &self.diag.place {
            Some(place) => write!(f, " ({place})"),
            None => Ok(()),
        }
    }
}

impl std::error::Error for Shown<'_> {}

impl Diagnostic for Shown<'_> {
    fn code<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        Some(Box::new(self.diag.code.name()))
    }

    fn severity(&self) -> Option<Level> {
        Some(match self.diag.severity {
            Severity::Error => Level::Error,
            Severity::Warning => Level::Warning,
            Severity::Note => Level::Advice,
        })
    }

    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.diag.help.as_ref().map(|help| Box::new(help) as Box<dyn fmt::Display>)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.source.as_ref().map(|source| source as &dyn SourceCode)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let labels = self.diag.labels.iter().filter(|label| label.span.file == self.file);
        Some(Box::new(labels.enumerate().map(|(i, label)| {
            let range = label.span.range();
            let text = Some(label.text.clone());
            let span = (range.start, range.len());
            if i == 0 { LabeledSpan::new_primary_with_span(text, span) } else { LabeledSpan::new_with_span(text, span) }
        })))
    }
}

/// Shows findings on standard error or, for lint, standard output.
pub struct Reporter {
    handler: GraphicalReportHandler,
}

impl Reporter {
    /// With or without colour.
    pub fn new(colour: bool) -> Reporter {
        let theme = if colour { GraphicalTheme::unicode() } else { GraphicalTheme::unicode_nocolor() };
        Reporter { handler: GraphicalReportHandler::new_themed(theme).with_width(110).with_links(false) }
    }

    /// One finding as text; `files` are those of its form.
    pub fn text(&self, diag: &Diag, files: &[Source]) -> String {
        let file = diag.labels.first().map_or(0, |label| label.span.file);
        let source = match (diag.labels.first(), files.get(file as usize)) {
            (Some(_), Some(source)) => Some(NamedSource::new(source.name.clone(), shown(&source.text))),
            _ => None,
        };
        let mut text = String::new();
        match self.handler.render_report(&mut text, &Shown { diag, source, file }) {
            Ok(()) => text,
            // a place that can't be drawn must not hide what was found
            Err(fmt::Error) => format!("{} {}\n", diag.code.name(), diag.message),
        }
    }
}

/// Form text safe for a terminal: a control character becomes a blank of the same length, so that places stay right.
fn shown(text: &str) -> String {
    let safe = |c: char| !c.is_control() || c == '\n' || c == '\t';
    if text.chars().all(safe) {
        return text.to_owned();
    }
    text.chars().map(|c| if safe(c) || c.len_utf8() > 1 { c } else { ' ' }).collect()
}
