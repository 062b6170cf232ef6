//! Findings for people: the line of the form with the error marked below it.

use std::borrow::Cow;
use std::fmt;
use std::path::Path;

use miette::{
    Diagnostic, GraphicalReportHandler, GraphicalTheme, LabeledSpan, MietteError, MietteSpanContents,
    Severity as Level, SourceCode, SourceSpan, SpanContents,
};

use postform::diag::{Diag, Severity};
use postform::internals::source::Source;
use postform::internals::terminal::steers;
use postform::{Error, ErrorKind};

use super::Ending;
use super::files::{io_message, name};
use super::say::say;

/// A form file in the interface of miette. Locations are found with our line index, so that thousands of findings stay fast.
struct Text<'a> {
    source: &'a Source,
    /// The text made safe for a terminal, with the same lines.
    shown: Cow<'a, Source>,
    /// Positions in the file after which the safe text is longer, and the number of additional bytes.
    longer: Vec<(usize, usize)>,
}

impl<'a> Text<'a> {
    fn new(source: &'a Source) -> Text<'a> {
        let escapes = |at: usize, c: char| match c {
            '\n' | '\t' => false,
            '\r' => !source.text[at + 1..].starts_with('\n'), // a lone \r moves the cursor to the start of the line
            c => steers(c),
        };
        let mut longer = Vec::new();
        if !source.text.char_indices().any(|(at, c)| escapes(at, c)) {
            return Text { source, shown: Cow::Borrowed(source), longer };
        }
        let mut text = String::with_capacity(source.text.len());
        for (at, c) in source.text.char_indices() {
            if escapes(at, c) {
                text.extend(c.escape_default());
                let end = at + c.len_utf8();
                longer.push((end, text.len() - end));
            } else {
                text.push(c);
            }
        }
        Text { source, shown: Cow::Owned(Source::from_text(source.name.clone(), text)), longer }
    }

    /// The position in the safe text for a byte of the file.
    fn place(&self, at: usize) -> usize {
        let before = self.longer.partition_point(|(end, _)| *end <= at);
        at + before.checked_sub(1).map_or(0, |last| self.longer[last].1)
    }
}

impl SourceCode for Text<'_> {
    fn read_span<'a>(
        &'a self,
        span: &SourceSpan,
        before: usize,
        after: usize,
    ) -> Result<Box<dyn SpanContents<'a> + 'a>, MietteError> {
        let (start, end) = (span.offset(), span.offset() + span.len());
        let first = self.shown.line(start as u32).saturating_sub(before);
        let last = self.shown.line(end as u32) + after;
        let lines = self.shown.line_starts();
        let from = lines.get(first).copied().ok_or(MietteError::OutOfBounds)? as usize;
        let to = lines.get(last + 1).map_or(self.shown.text.len(), |&next| next as usize);
        let data = self.shown.text.as_bytes().get(from..to).ok_or(MietteError::OutOfBounds)?;
        let span = (from, to - from).into();
        let count = last + 1 - first;
        Ok(Box::new(MietteSpanContents::new_named(self.source.name.clone(), data, span, first, 0, count)))
    }
}

/// A finding with its text.
struct Shown<'a> {
    diag: &'a Diag,
    place: Option<String>,
    source: Option<&'a Text<'a>>,
    file: u32,
}

impl fmt::Debug for Shown<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.diag.message)
    }
}

impl fmt::Display for Shown<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.diag.message)
    }
}

impl std::error::Error for Shown<'_> {}

impl Diagnostic for Shown<'_> {
    fn code<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        // the header line is never wrapped, so a location in the job stays in one piece
        Some(match &self.place {
            Some(place) => Box::new(format!("{} at {place}", self.diag.code.title())),
            None => Box::new(self.diag.code.title()),
        })
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
        self.source.map(|source| source as &dyn SourceCode)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let labels = self.diag.labels.iter().filter(|label| label.span.file == self.file);
        Some(Box::new(labels.enumerate().map(|(i, label)| {
            let range = label.span.range();
            let place = |at: usize| self.source.map_or(at, |text| text.place(at));
            let (start, end) = (place(range.start), place(range.end));
            let text = Some(label.text.clone());
            let span = (start, end - start);
            if i == 0 { LabeledSpan::new_primary_with_span(text, span) } else { LabeledSpan::new_with_span(text, span) }
        })))
    }
}

/// Shows findings on standard error or, for lint, standard output.
pub struct Reporter {
    handler: GraphicalReportHandler,
}

impl Reporter {
    /// A reporter with or without colour.
    pub fn new(colour: bool) -> Reporter {
        let theme = if colour { GraphicalTheme::unicode() } else { GraphicalTheme::unicode_nocolor() };
        Reporter { handler: GraphicalReportHandler::new_themed(theme).with_width(110).with_links(false) }
    }

    /// Findings as text; `files` are the files of the form.
    pub fn text(&self, diags: &[Diag], files: &[Source]) -> String {
        let texts: Vec<Text> = files.iter().map(Text::new).collect();
        let mut all = String::new();
        for diag in drawn(diags) {
            let file = diag.labels.first().map_or(0, |label| label.span.file);
            let mut place = diag.place.as_ref().map(|place| place.to_string());
            let mut source = diag.labels.first().and_then(|_| texts.get(file as usize));
            if let Some(text) = source.filter(|text| too_long_to_draw(diag, text.source, file)) {
                let (line, column) = text.source.line_column(diag.labels[0].span.start);
                place.get_or_insert_with(|| format!("{}:{line}:{column}", text.source.name));
                source = None;
            }
            let start = all.len();
            if self.handler.render_report(&mut all, &Shown { diag, place, source, file }).is_err() {
                // a location that can't be drawn must not hide the finding
                all.truncate(start);
                all += &format!("{} {}\n", diag.code.title(), diag.message);
            }
        }
        if diags.len() > MOST_DRAWN {
            all += &format!("and {}: fix the findings above first\n", count(diags.len() - MOST_DRAWN, "more finding"));
        }
        all
    }
}

/// Maximum number of findings that are drawn. More findings would be too many to read.
const MOST_DRAWN: usize = 1000;

/// The findings that are drawn, in their order. If there are too many findings, errors are selected first.
fn drawn(diags: &[Diag]) -> impl Iterator<Item = &Diag> {
    let mut errors = diags.iter().filter(|diag| diag.is_error()).count().min(MOST_DRAWN);
    let mut others = MOST_DRAWN - errors;
    diags.iter().filter(move |diag| {
        let left = if diag.is_error() { &mut errors } else { &mut others };
        let is_drawn = *left > 0;
        *left -= usize::from(is_drawn);
        is_drawn
    })
}

/// Longest line that is drawn.
const LONGEST_LINE: usize = 400;

/// Whether a line of a label, or a line directly before or after it, is too long for a terminal.
fn too_long_to_draw(diag: &Diag, source: &Source, file: u32) -> bool {
    let starts = source.line_starts();
    diag.labels.iter().filter(|label| label.span.file == file).any(|label| {
        let first = source.line(label.span.start).saturating_sub(1);
        let last = source.line(label.span.end) + 2;
        let end = |line: usize| starts.get(line + 1).map_or(source.text.len(), |&next| next as usize);
        (first..last.min(starts.len())).any(|line| end(line) - starts[line] as usize > LONGEST_LINE)
    })
}

/// Shows the reason why a job was not read or printed to its end. `files` are those of the form.
///
/// # Errors
/// A message: the job can't be read, or the request makes no sense.
pub fn stopped(error: Error, jobs: &[&Path], reporter: &Reporter, files: &[Source]) -> Result<Ending, String> {
    if let Some(error) = error.io() {
        let [job] = jobs else { return Err(format!("error: can't read {}: {error}", names(jobs))) };
        return Err(io_message("read", job, error));
    }
    let ending = match error.kind() {
        ErrorKind::Usage => return Err(format!("error: {error}")),
        ErrorKind::Fault => Ending::Broken,
        _ => Ending::Findings,
    };
    let mut errors: Vec<Diag> = error.into_findings().diags.into_iter().filter(Diag::is_error).collect();
    errors.iter_mut().for_each(|diag| place_in_jobs(jobs, diag));
    say(&reporter.text(&errors, files));
    Ok(ending)
}

/// Adds the name of the job or program to the location of a finding.
pub fn place_in(file: &str, diag: &mut Diag) {
    diag.place.get_or_insert_default().file = Some(file.to_owned());
}

/// Adds the name of the job to the location of a finding. If jobs are joined, adds the name of the job with the
/// finding.
pub fn place_in_jobs(jobs: &[&Path], diag: &mut Diag) {
    let part = diag.place.as_ref().map_or(0, |place| usize::from(place.part));
    if let Some(job) = jobs.get(part.saturating_sub(1)) {
        place_in(&name(job), diag);
    }
}

/// The names of jobs in a sentence.
pub fn names(jobs: &[&Path]) -> String {
    jobs.iter().map(|job| name(job)).collect::<Vec<String>>().join(" and ")
}

/// Maximum number of a form's findings that a run shows.
const MOST: usize = 10;

/// The first ten findings, one line each; the rest can be shown with `command`.
pub fn brief(diags: &[Diag], files: &[Source], command: &str) -> String {
    let mut text: String = diags.iter().take(MOST).map(|diag| diag.line(files) + "\n").collect();
    if diags.len() > MOST {
        text += &format!("and {} more: {command}\n", diags.len() - MOST);
    }
    text
}

/// `1 error`, `2 errors`.
pub fn count(number: usize, what: &str) -> String {
    format!("{number} {what}{}", if number == 1 { "" } else { "s" })
}
