//! Limits from the manual: the number of words on a line, and the number of sequence lines in a form.

use super::check::Analysis;
use crate::diag::{Code, Diag, Severity};
use crate::syntax::Body;

/// How strictly the limits of the manual are applied.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Limits {
    /// More than 15 words on a line or more than 150 lines are an error.
    #[default]
    Classic,
    /// More than 15 words on a line or more than 150 lines are a warning.
    Extended,
}

/// Maximum number of words on a sequence line, from the manual.
pub const MOST_WORDS: usize = 15;
/// Maximum number of sequence lines in a form, from the manual.
pub const MOST_LINES: usize = 150;
/// Maximum size of a form in bytes, with all files that it calls. All known forms are smaller than a tenth of this size.
pub const MOST_TEXT: usize = 512 << 10;

impl Limits {
    /// Names of the limits.
    pub const NAMES: [&'static str; 2] = ["classic", "extended"];

    /// Finds limits by their name; upper and lower case are equal.
    pub fn parse(name: &str) -> Option<Limits> {
        let at = Limits::NAMES.iter().position(|known| known.eq_ignore_ascii_case(name))?;
        Some([Limits::Classic, Limits::Extended][at])
    }
}

impl Analysis {
    /// Counts a line of a sequence and its words, and checks the limits.
    pub(super) fn limits_of(&mut self, body: &Body) {
        self.line_count += 1;
        if self.line_count == MOST_LINES + 1 {
            self.over_lines = Some(body.line.span);
        }
        let count = body.begins().count();
        if count <= MOST_WORDS {
            return;
        }
        let at = body.begins().nth(MOST_WORDS).map_or(body.line.span, |piece| piece.span);
        let mut diag = Diag::new(Code::PF601, format!("{count} words on a line: the limit is {MOST_WORDS}"))
            .at(at, format!("word {}", MOST_WORDS + 1))
            .help("break the line in two; `--limits extended` makes this a warning");
        self.soften(&mut diag);
        self.report(diag);
    }

    /// Checks the number of lines in all sequences together.
    pub(super) fn line_limit(&mut self) {
        if let Some(at) = self.over_lines {
            let text = format!("{} sequence lines: the limit is {MOST_LINES}", self.line_count);
            let mut diag = Diag::new(Code::PF602, text)
                .at(at, format!("line {}", MOST_LINES + 1))
                .help("remove unused sequences; `--limits extended` makes this a warning");
            self.soften(&mut diag);
            self.report(diag);
        }
    }

    fn soften(&self, diag: &mut Diag) {
        if self.limits == Limits::Extended {
            diag.severity = Severity::Warning;
        }
    }
}
