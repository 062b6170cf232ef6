//! Corrections of misspelt names. The corrections are taken from the help text of a finding.

use super::{Diag, Fix};
use crate::source::Source;
use crate::span::Span;

/// The change that the help text `did you mean` proposes. An editor shows the change before the user accepts it.
/// `None`: the help text proposes no name, or the misspelt name is not found exactly once at the first label.
pub fn suggestion(diag: &Diag, files: &[Source]) -> Option<Fix> {
    let new = diag.help.as_deref()?.strip_prefix("did you mean `")?.split_once("`?")?.0;
    let old = diag.message.split('`').nth(1).filter(|old| !old.is_empty())?;
    let at = diag.labels.first()?.span;
    let text = files.get(at.file as usize)?.slice(at);
    let mut found = text.match_indices(old);
    let (start, _) = found.next()?;
    if found.next().is_some() {
        return None;
    }
    let start = at.start as usize + start;
    let edits = vec![(Span::new(at.file, start, start + old.len()), new.to_owned())];
    Some(Fix { title: format!("write `{new}`"), safe: false, edits })
}
