//! A comparison as JSON for other programs, version 1. Lines are counted from 1.

use serde_json::{Value, json};

use postform::internals::diff::{Comparison, Edit, Options, Summary, changed_spans};
use postform::internals::source::text_of;
use postform::internals::verify::Motions;

use super::sides::Side;

/// The whole comparison.
pub fn document(old: &Side, new: &Side, comparison: &Comparison, summary: &Summary, options: &Options) -> Value {
    let text = |side: &Side, line: usize| text_of(side.program.text(line)).into_owned();
    let edit = |edit: &Edit| -> Value {
        match *edit {
            Edit::Removed(line) => json!({ "kind": "removed", "old": line + 1, "old_text": text(old, line) }),
            Edit::Added(line) => json!({ "kind": "added", "new": line + 1, "new_text": text(new, line) }),
            Edit::Moved(a, b) => json!({ "kind": "moved", "old": a + 1, "new": b + 1, "old_text": text(old, a) }),
            Edit::Changed(a, b) => {
                let [gone, come] = changed_spans(old.program.text(a), new.program.text(b), &options.ignore);
                let words = |side: &Side, line: usize, spans: Vec<std::ops::Range<usize>>| -> Vec<String> {
                    let bytes = side.program.text(line);
                    spans.into_iter().map(|span| String::from_utf8_lossy(&bytes[span]).into_owned()).collect()
                };
                json!({
                    "kind": "changed", "old": a + 1, "new": b + 1, "old_text": text(old, a), "new_text": text(new, b),
                    "old_words": words(old, a, gone), "new_words": words(new, b, come),
                })
            }
        }
    };
    let hunks: Vec<Value> = comparison
        .hunks
        .iter()
        .map(|hunk| {
            let edits: Vec<Value> = hunk.edits.iter().map(edit).collect();
            json!({
                "old": [hunk.old.start + 1, hunk.old.len()], "new": [hunk.new.start + 1, hunk.new.len()],
                "printed_by": hunk.new.clone().next().and_then(|line| new.origin(line)), "edits": edits,
            })
        })
        .collect();
    json!({
        "postform_diff": 1, "same": comparison.is_same(), "old": old.name, "new": new.name,
        "summary": {
            "changed": summary.changed, "added": summary.added, "removed": summary.removed, "moved": summary.moved,
            "letters": summary.letters, "more": summary.more, "less": summary.less,
        },
        "hunks": hunks,
    })
}

/// The first difference between the motions, if there is one, and the counts of everything that was not compared.
pub fn motion(old: &Side, new: &Side, found: &Motions) -> Value {
    let first = found.difference.as_ref().map(|difference| {
        let [(a, before), (b, after)] = &difference.blocks;
        json!({ "message": difference.message, "old": a, "old_text": before, "new": b, "new_text": after })
    });
    json!({
        "postform_diff": 1, "same": first.is_none(), "old": old.name, "new": new.name, "motion": first,
        "cuts": found.cuts, "other_pecks": found.pecks, "more_retracts": found.retracts, "rounded_feeds": found.feeds,
        "left_out": { "ways": found.ways, "codes": found.codes },
    })
}
