//! The form lines that the test cases printed.

use std::collections::HashSet;

use postform::internals::source::Source;

use super::case::Tried;
use super::posts::Posts;

/// A form, and its lines that no case printed.
pub struct Covered {
    /// The form's name.
    pub form: String,
    /// The number of the form's lines that can print.
    pub lines: usize,
    /// The lines that no case printed: file, line from 1, text.
    pub missing: Vec<(String, u32, String)>,
}

/// For each tested form, the lines of its sequences; lines under conditions are counted separately.
pub fn of(posts: &Posts, tried: &[Tried]) -> Vec<Covered> {
    let mut all = Vec::new();
    for (at, entry) in posts.all().iter().enumerate() {
        let (Ok(ready), true) = (&entry.ready, posts.first_of(at) == at) else { continue };
        let files = &ready.checked.files;
        let own = tried.iter().filter(|tried| posts.first_of(tried.case.form) == at);
        let line_of = |&(file, at): &(u32, u32)| Some((file, files.get(file as usize)?.line(at)));
        let printed: HashSet<(u32, usize)> = own.flat_map(|tried| &tried.printed).filter_map(line_of).collect();
        let form = &ready.checked.form;
        let of_sequences = form.sequences.values().flat_map(|sequence| &sequence.lines);
        let lines = of_sequences.chain(form.upons.iter().flat_map(|upon| &upon.lines));
        let (mut count, mut missing) = (0, Vec::new());
        for line in lines {
            count += 1;
            let file = line.span.file;
            let source: Option<&Source> = files.get(file as usize);
            if let Some(source) = source.filter(|source| !printed.contains(&(file, source.line(line.span.start)))) {
                let (number, _) = source.line_column(line.span.start);
                missing.push((source.name.clone(), number, source.slice(line.span).trim().to_owned()));
            }
        }
        missing.sort();
        all.push(Covered { form: super::super::files::name(&entry.path), lines: count, missing });
    }
    all
}
