//! docs/sequences.md lists every sequence with its machines and a sample, and the sample prints the sequence.

use std::fs;

use crate::support::{check_file, render_sample, root, sample_form};
use postform::internals::lang::SEQUENCES;

#[test]
fn no_sequence_is_without_a_sample_that_prints_it() {
    let text = fs::read_to_string(root().join("docs/sequences.md")).unwrap();
    for sequence in SEQUENCES {
        let row = text.lines().find(|line| line.starts_with(&format!("| `{}` |", sequence.name)));
        let cells: Vec<&str> =
            row.unwrap_or_else(|| panic!("no row for {}", sequence.name)).split('|').map(str::trim).collect();
        assert_eq!(cells[2], sequence.machines.to_string(), "machines of {}", sequence.name);
        assert_eq!(cells[5], sequence.meaning, "meaning of {}", sequence.name);
        let sample = cells[4].trim_start_matches('[').split(']').next().unwrap();
        assert!(printed(sample, sequence.id), "{sample} does not print {}", sequence.name);
    }
}

/// Whether this sequence prints a line of a sample's program.
fn printed(sample: &str, id: postform::internals::lang::SequenceId) -> bool {
    let folder = root().join("samples").join(sample);
    let own = sample_form(&folder);
    let posts = fs::read_dir(&folder).unwrap().filter_map(|e| {
        let name = e.unwrap().file_name().into_string().unwrap();
        let post = name.strip_prefix("expected.")?.strip_suffix(".nc")?.to_owned();
        Some(root().join(format!("postforms/{post}.pf")))
    });
    own.into_iter().chain(posts).any(|form| {
        let checked = check_file(&form);
        let Some(sequence) = checked.form.sequences.get(&id) else { return false };
        let lines: Vec<_> = sequence.lines.iter().map(|line| line.span).collect();
        let rendered = render_sample(&folder, &form).unwrap();
        rendered.trace.iter().any(|line| line.form.is_some_and(|span| lines.contains(&span)))
    })
}
