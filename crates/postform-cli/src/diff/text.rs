//! A comparison as text: unified, with the changed words marked below their block.

use std::fmt::Write as _;
use std::ops::Range;

use postform::internals::diff::{Comparison, Edit, Hunk, Options, Summary, changed_spans};
use postform::internals::source::text_of;
use postform::internals::terminal::escaped;
use postform::internals::verify::Motions;

use super::super::report::count;
use super::sides::Side;

const RED: &str = "\x1b[31m";
const GREEN: &str = "\x1b[32m";
const CYAN: &str = "\x1b[36m";
const PLAIN: &str = "\x1b[0m";

/// Unified text.
pub fn unified(
    old: &Side,
    new: &Side,
    comparison: &Comparison,
    summary: &Summary,
    context: usize,
    options: &Options,
    colour: bool,
) -> String {
    if comparison.is_same() {
        return String::new();
    }
    let mut page = Page { old, new, options, colour, text: String::new() };
    _ = writeln!(page.text, "--- {}\n+++ {}", old.name, new.name);
    for group in grouped(&comparison.hunks, context) {
        page.group(group, context);
    }
    page.text += &sentence(summary);
    page.text
}

/// A comparison in two columns, old and new side by side; `columns` is the total width in characters.
pub fn side_by_side(
    old: &Side,
    new: &Side,
    comparison: &Comparison,
    summary: &Summary,
    context: usize,
    columns: usize,
    colour: bool,
) -> String {
    if comparison.is_same() {
        return String::new();
    }
    let width = (columns.max(60) - 3) / 2;
    let mut text = String::new();
    let mut row = |left: &str, sign: char, right: &str, shade: &str| {
        let (on, off) = if colour && !shade.is_empty() { (shade, PLAIN) } else { ("", "") };
        let (left, right) = (fitted(left, width), fitted(right, width));
        let line = format!("{left:width$} {sign} {right}");
        _ = writeln!(text, "{on}{}{off}", line.trim_end());
    };
    row(&old.name, ' ', &new.name, "");
    for group in grouped(&comparison.hunks, context) {
        let (Some(first), Some(last)) = (group.first(), group.last()) else { continue };
        let head = format!("line {}", first.old.start.saturating_sub(context) + 1);
        row(&head, '@', &format!("line {}", first.new.start.saturating_sub(context) + 1), CYAN);
        let mut at = first.old.start.saturating_sub(context);
        let mut shift = first.new.start as i64 - first.old.start as i64;
        let same = |row: &mut dyn FnMut(&str, char, &str, &str), lines: Range<usize>, shift: i64| {
            for line in lines {
                let other = usize::try_from(line as i64 + shift).ok().filter(|&other| other < new.program.len());
                let right = other.map_or(String::new(), |other| shown(new.program.text(other)));
                row(&shown(old.program.text(line)), ' ', &right, "");
            }
        };
        for hunk in group {
            same(&mut row, at..hunk.old.start, shift);
            for edit in &hunk.edits {
                match *edit {
                    Edit::Removed(a) => row(&shown(old.program.text(a)), '<', "", RED),
                    Edit::Added(b) => row("", '>', &shown(new.program.text(b)), GREEN),
                    Edit::Changed(a, b) => row(&shown(old.program.text(a)), '|', &shown(new.program.text(b)), CYAN),
                    Edit::Moved(a, b) => row(&shown(old.program.text(a)), '~', &shown(new.program.text(b)), CYAN),
                }
            }
            at = hunk.old.end;
            shift = hunk.new.end as i64 - hunk.old.end as i64;
        }
        same(&mut row, at..(last.old.end + context).min(old.program.len()), shift);
    }
    text + &sentence(summary)
}

/// In hunks with more edits than this, only the lines are printed, without marks for the changed words.
const MOST_MARKED: usize = 1_000;

/// Groups hunks whose unchanged context lines meet.
pub fn grouped(hunks: &[Hunk], context: usize) -> impl Iterator<Item = &[Hunk]> {
    hunks.chunk_by(move |a, b| b.old.start.saturating_sub(a.old.end) <= 2 * context)
}

struct Page<'a> {
    old: &'a Side,
    new: &'a Side,
    options: &'a Options,
    colour: bool,
    text: String,
}

impl Page<'_> {
    fn group(&mut self, hunks: &[Hunk], context: usize) {
        let (Some(first), Some(last)) = (hunks.first(), hunks.last()) else { return };
        let from = |range: &Range<usize>| range.start.saturating_sub(context);
        let (start, new_start) = (from(&first.old), from(&first.new));
        let end = (last.old.end + context).min(self.old.program.len());
        let new_end = (last.new.end + context).min(self.new.program.len());
        let head = format!("@@ -{},{} +{},{} @@", start + 1, end - start, new_start + 1, new_end - new_start);
        self.line(CYAN, &head);
        let mut at = start;
        for hunk in hunks {
            self.unchanged(at..hunk.old.start);
            let marks = hunk.edits.len() <= MOST_MARKED;
            for edit in &hunk.edits {
                self.edit(edit, marks);
            }
            self.origin(hunk);
            at = hunk.old.end;
        }
        self.unchanged(at..end);
    }

    fn unchanged(&mut self, lines: Range<usize>) {
        for line in lines {
            self.block("", ' ', self.old.program.text(line));
        }
    }

    fn edit(&mut self, edit: &Edit, marks: bool) {
        let (old, new) = (&self.old.program, &self.new.program);
        match *edit {
            Edit::Removed(line) => self.block(RED, '-', old.text(line)),
            Edit::Added(line) => self.block(GREEN, '+', new.text(line)),
            Edit::Changed(a, b) => {
                let (before, after) = (old.text(a), new.text(b));
                let [gone, come] =
                    if marks { changed_spans(before, after, &self.options.ignore) } else { Default::default() };
                self.block(RED, '-', before);
                self.marks(before, &gone);
                self.block(GREEN, '+', after);
                self.marks(after, &come);
            }
            Edit::Moved(a, b) => {
                let text = shown(old.text(a));
                self.line(CYAN, &format!("~{text}  (line {} of the old program, {} of the new)", a + 1, b + 1));
            }
        }
    }

    /// Marks the changed words, below their line.
    fn marks(&mut self, line: &[u8], spans: &[Range<usize>]) {
        if spans.is_empty() || line.iter().any(|byte| !(b' '..=b'~').contains(byte)) {
            return; // bytes are columns only in ASCII text
        }
        let mut marks = vec![b' '; line.len()];
        spans.iter().for_each(|span| marks[span.clone()].fill(b'^'));
        let text = String::from_utf8_lossy(&marks).trim_end().to_owned();
        self.line(CYAN, &format!("?{text}"));
    }

    /// Prints the origin of the new lines.
    fn origin(&mut self, hunk: &Hunk) {
        let line = hunk.new.clone().find(|_| true).filter(|&line| line < self.new.program.len());
        if let Some(origin) = line.and_then(|line| self.new.origin(line)) {
            self.line(CYAN, &format!("    printed by {}", escaped(&origin)));
        }
        let change = hunk.edits.iter().find_map(|edit| match *edit {
            Edit::Changed(a, b) => Some((self.old.form_line(a)?.to_owned(), self.new.form_line(b)?.to_owned())),
            _ => None,
        });
        if let Some((before, after)) = change.filter(|(before, after)| before != after) {
            self.line(RED, &format!("    form: - {}", escaped(&before)));
            self.line(GREEN, &format!("    form: + {}", escaped(&after)));
        }
    }

    /// Prints a block after its sign.
    fn block(&mut self, colour: &str, sign: char, block: &[u8]) {
        let colour = if self.colour { colour } else { "" };
        self.text.push_str(colour);
        self.text.push(sign);
        self.text.push_str(&shown(block));
        if !colour.is_empty() {
            self.text.push_str(PLAIN);
        }
        self.text.push('\n');
    }

    fn line(&mut self, colour: &str, text: &str) {
        if self.colour {
            _ = writeln!(self.text, "{colour}{text}{PLAIN}");
        } else {
            _ = writeln!(self.text, "{text}");
        }
    }
}

/// Text in a column; text that is too long ends with an ellipsis.
fn fitted(text: &str, width: usize) -> String {
    if text.chars().count() <= width {
        return text.to_owned();
    }
    text.chars().take(width - 1).chain(['…']).collect()
}

fn shown(line: &[u8]) -> String {
    escaped(&text_of(line))
}

/// Maximum number of kinds of changes in the summary.
const MOST_KINDS: usize = 20;

/// The changes, by kind.
pub fn sentence(summary: &Summary) -> String {
    let blocks = [
        (summary.changed, "changed"),
        (summary.added, "added"),
        (summary.removed, "removed"),
        (summary.moved, "moved"),
    ];
    let blocks: Vec<String> = blocks
        .iter()
        .filter(|(number, _)| *number > 0)
        .map(|(number, what)| format!("{} {what}", count(*number, "block")))
        .collect();
    let mut kinds: Vec<String> =
        summary.letters.iter().map(|(letter, number)| format!("{letter} in {}", count(*number, "block"))).collect();
    kinds.extend(
        summary.more.iter().map(|(word, number)| format!("{} more in {}", escaped(word), count(*number, "block"))),
    );
    kinds.extend(
        summary.less.iter().map(|(word, number)| format!("{} less in {}", escaped(word), count(*number, "block"))),
    );
    let left_out = kinds.len().saturating_sub(MOST_KINDS);
    if left_out > 0 {
        kinds.truncate(MOST_KINDS);
        kinds.push(format!("and {left_out} more kinds of changes"));
    }
    let kinds = if kinds.is_empty() { String::new() } else { format!(": {}", kinds.join(", ")) };
    format!("{}{kinds}\n", blocks.join(", "))
}

/// The kinds of changes as text without numbers, which is equal for all programs that one change of a form affects.
pub fn kind(summary: &Summary) -> String {
    let mut kinds: Vec<String> = Vec::new();
    kinds.extend(summary.letters.keys().map(|letter| format!("other {}", escaped(&letter.to_string()))));
    for (words, how) in [(&summary.more, "more"), (&summary.less, "less")] {
        // the text of comments differs between jobs
        let word = |word: &String| if word.starts_with('(') { "comments".to_owned() } else { escaped(word) };
        kinds.extend(words.keys().map(|name| format!("{} {how}", word(name))));
    }
    for (number, how) in [(summary.added, "added"), (summary.removed, "removed"), (summary.moved, "moved")] {
        kinds.extend((number > 0).then(|| format!("blocks {how}")));
    }
    kinds.dedup();
    let left_out = kinds.len().saturating_sub(MOST_KINDS);
    if left_out > 0 {
        kinds.truncate(MOST_KINDS);
        kinds.push(format!("and {left_out} more kinds of changes"));
    }
    if kinds.is_empty() { "other blocks".to_owned() } else { kinds.join(", ") }
}

/// Counts of differences, in words; a count of 0 is left out.
fn counted(counts: &[(u64, &str, &str)]) -> Vec<String> {
    let seen = counts.iter().filter(|(n, ..)| *n > 0);
    seen.map(|(n, what, how)| format!("{} {how}", count(*n as usize, what))).collect()
}

/// Differences that are not compared further.
fn not_compared(found: &Motions) -> Vec<String> {
    counted(&[
        (found.ways, "path", "between cuts with other rapids, nowhere lower than the old rapids"),
        (found.codes, "cut", "after different codes that are not simulated"),
    ])
}

/// The result of the comparison of motions, in one line.
pub fn verdict(old: &Side, new: &Side, found: &Motions) -> String {
    if found.difference.is_some() {
        return format!("different: the motions of {} differ from those of {}\n", new.name, old.name);
    }
    let cuts = count(found.cuts as usize, "cut");
    let mut list = counted(&[
        (found.pecks, "hole", "with other pecks"),
        (found.retracts, "retract", "out of a hole in place of a chip break"),
        (found.feeds, "feed", "rounded"),
    ]);
    list.extend(not_compared(found));
    match list.is_empty() {
        true => format!("identical: {} makes the motions of {} ({cuts})\n", new.name, old.name),
        false => format!("equivalent: {} makes the cuts of {} ({cuts}): {}\n", new.name, old.name, list.join(", ")),
    }
}

/// The first difference of motions, or everything that was not judged.
pub fn motion(old: &Side, new: &Side, found: &Motions) -> String {
    let Some(difference) = &found.difference else {
        let list = not_compared(found);
        return if list.is_empty() {
            String::new()
        } else {
            format!("the same cuts; not compared: {}\n", list.join(", "))
        };
    };
    let mut text = format!("the motions differ: {}\n", escaped(&difference.message));
    for (sign, side, (line, block)) in [('-', old, &difference.blocks[0]), ('+', new, &difference.blocks[1])] {
        _ = match line {
            0 => writeln!(text, "{sign} {}: the program ends", side.name),
            _ => writeln!(text, "{sign} {}, line {line}: {}", side.name, escaped(block)),
        };
    }
    text
}
