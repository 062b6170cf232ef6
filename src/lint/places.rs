//! Fast search in lists of locations and ranges, because a form may be large and have thousands of findings.

use crate::span::Span;

/// A list of spans, with a fast test whether one of the spans covers a location.
pub struct Cover(Vec<Span>);

impl FromIterator<Span> for Cover {
    fn from_iter<I: IntoIterator<Item = Span>>(spans: I) -> Cover {
        let mut spans: Vec<Span> = spans.into_iter().collect();
        spans.sort_by_key(|span| (span.file, span.start));
        // extend each span to the greatest end so far; then only the last span that begins before a location must be checked
        for i in 1..spans.len() {
            if spans[i - 1].file == spans[i].file {
                spans[i].end = spans[i].end.max(spans[i - 1].end);
            }
        }
        Cover(spans)
    }
}

impl Cover {
    /// Whether one of the spans covers the start of `at`.
    pub fn holds(&self, at: Span) -> bool {
        let after = self.0.partition_point(|span| (span.file, span.start) <= (at.file, at.start));
        after.checked_sub(1).is_some_and(|last| self.0[last].file == at.file && at.start <= self.0[last].end)
    }
}

/// The starts of spans, with a fast test whether one of the starts is inside a given span.
pub struct Places(Vec<(u32, u32)>);

impl FromIterator<Span> for Places {
    fn from_iter<I: IntoIterator<Item = Span>>(spans: I) -> Places {
        let mut places: Vec<_> = spans.into_iter().map(|span| (span.file, span.start)).collect();
        places.sort_unstable();
        Places(places)
    }
}

impl Places {
    /// Whether one of the starts is inside `whole` or at its end.
    pub fn any_in(&self, whole: Span) -> bool {
        let first = self.0.partition_point(|&place| place < (whole.file, whole.start));
        self.0.get(first).is_some_and(|&(file, start)| file == whole.file && start <= whole.end)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spans_cover_what_lies_in_them_however_they_nest() {
        let cover: Cover =
            [(0, 10, 50), (0, 20, 30), (1, 5, 6)].map(|(f, s, e)| Span::new(f, s, e)).into_iter().collect();
        let holds = |file, at| cover.holds(Span::new(file, at, at));
        assert!(holds(0, 10) && holds(0, 40) && holds(0, 50) && holds(1, 6));
        assert!(!holds(0, 9) && !holds(0, 51) && !holds(1, 4) && !holds(1, 7) && !holds(2, 5));
    }

    #[test]
    fn places_lie_in_a_span_with_its_end() {
        let places: Places = [(1, 7), (0, 30), (0, 10)].map(|(f, s)| Span::new(f, s, s + 1)).into_iter().collect();
        let any_in = |file, start, end| places.any_in(Span::new(file, start, end));
        assert!(any_in(0, 10, 10) && any_in(0, 11, 30) && any_in(1, 0, 9));
        assert!(!any_in(0, 11, 29) && !any_in(0, 31, 99) && !any_in(1, 8, 9) && !any_in(2, 0, 99));
    }
}
