//! The effect of a form's change on many jobs.

use std::collections::hash_map::Entry;
use std::collections::{BTreeMap, HashMap};
use std::fmt::Write as _;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

use super::super::args::{DiffArgs, DiffFormat};
use super::super::colour::Colour;
use super::super::config::Config;
use super::super::prepare;
use super::super::report::{Reporter, count};
use super::super::{Ending, files, many, output};
use super::sides::printed_by;
use super::{Shown, difference};

/// Maximum number of jobs of one kind that are named.
const MOST_NAMED: usize = 20;

/// Programs with changes in the same words.
#[derive(Default)]
struct Kind {
    /// The indices of the jobs of these programs.
    jobs: Vec<usize>,
    /// The first job in `jobs`, and the differences in its program.
    example: Option<(usize, String)>,
}

/// Prints each job with both forms, and shows the different programs, grouped by the kind of their difference.
///
/// # Errors
/// A message: a form or a folder can't be read.
pub fn run(
    forms: [&Path; 2],
    jobs: &[PathBuf],
    args: &DiffArgs,
    colour: Colour,
    reporter: &Reporter,
) -> Result<Ending, String> {
    if args.format == DiffFormat::Html {
        return Err("error: --format html shows one job\n  help: use --format text or json for several jobs".into());
    }
    let jobs = many::jobs(jobs)?;
    files::check_formats(&jobs, &args.read)?;
    let Some(Prepared { rows, pairs }) = prepared(forms, &jobs, args, reporter)? else { return Ok(Ending::Findings) };
    let kinds: Mutex<BTreeMap<String, Kind>> = Mutex::default();
    let (compared, differs) = (AtomicUsize::new(0), AtomicBool::new(false));
    let items: Vec<(usize, &PathBuf)> = jobs.iter().enumerate().collect();
    let ending = many::run(
        None,
        items,
        |(_, job)| files::name(job),
        "job",
        |&(at, job)| {
            let Some([old, new]) = printed_by(&pairs[rows[at]], job, args, reporter)? else {
                return Ok((String::new(), Ending::Findings));
            };
            let difference = match difference(args, &old, &new, colour, reporter)? {
                Ok(difference) => difference,
                Err(ending) => return Ok((String::new(), ending)),
            };
            compared.fetch_add(1, Ordering::Relaxed);
            differs.fetch_or(!difference.is_none(), Ordering::Relaxed);
            let is_none = difference.is_none();
            let text = match difference.shown {
                Shown::Text(text) => text,
                Shown::Document(mut document) => {
                    document["job"] = files::name(job).into();
                    return Ok((output::json_line(&document), Ending::Clean));
                }
            };
            if !is_none {
                let mut kinds = kinds.lock().unwrap_or_else(PoisonError::into_inner);
                let kind = kinds.entry(difference.kind).or_default();
                kind.jobs.push(at);
                if kind.example.as_ref().is_none_or(|(first, _)| at < *first) {
                    kind.example = Some((at, text));
                }
            }
            Ok((String::new(), Ending::Clean))
        },
    )?;
    if args.format != DiffFormat::Json {
        let kinds = kinds.into_inner().unwrap_or_else(PoisonError::into_inner);
        let text = shown(kinds, &jobs, compared.into_inner());
        output::standard_output(|out| out.write_all(text.as_bytes()))?;
    }
    Ok(if ending == Ending::Clean && differs.into_inner() { Ending::Findings } else { ending })
}

/// Both forms, prepared for a job.
type Pair<'a> = [(&'a Path, prepare::Prepared); 2];

/// Both forms, prepared once for each postform.toml of the jobs.
struct Prepared<'a> {
    /// For each job, the index of its pair.
    rows: Vec<usize>,
    pairs: Vec<Pair<'a>>,
}

/// Prepares both forms for all jobs. `None`: a form has errors, which have been shown.
fn prepared<'a>(
    forms: [&'a Path; 2],
    jobs: &[PathBuf],
    args: &DiffArgs,
    reporter: &Reporter,
) -> Result<Option<Prepared<'a>>, String> {
    let mut by_config: HashMap<Option<PathBuf>, usize> = HashMap::new();
    let mut prepared = Prepared { rows: Vec::with_capacity(jobs.len()), pairs: Vec::new() };
    for job in jobs {
        let row = match by_config.entry(Config::near(job)?.path) {
            Entry::Occupied(entry) => *entry.get(),
            Entry::Vacant(entry) => {
                let [old, new] = forms.map(|form| prepare::prepare(form, &args.options, job, reporter));
                let (Some(old), Some(new)) = (old?, new?) else { return Ok(None) };
                prepared.pairs.push([(forms[0], old), (forms[1], new)]);
                *entry.insert(prepared.pairs.len() - 1)
            }
        };
        prepared.rows.push(row);
    }
    Ok(Some(prepared))
}

/// All kinds of differences as text, the most common first, and the share of changed programs among the compared
/// programs.
fn shown(kinds: BTreeMap<String, Kind>, jobs: &[PathBuf], compared: usize) -> String {
    let mut kinds: Vec<(String, Kind)> = kinds.into_iter().collect();
    for (_, kind) in &mut kinds {
        kind.jobs.sort_unstable();
    }
    kinds.sort_by_key(|(_, kind)| (std::cmp::Reverse(kind.jobs.len()), kind.jobs.first().copied()));
    let changed: usize = kinds.iter().map(|(_, kind)| kind.jobs.len()).sum();
    let mut text = String::new();
    for (name, kind) in &kinds {
        _ = writeln!(text, "{}: {name}", count(kind.jobs.len(), "program"));
        for &at in kind.jobs.iter().take(MOST_NAMED) {
            _ = writeln!(text, "  {}", files::name(&jobs[at]));
        }
        if kind.jobs.len() > MOST_NAMED {
            _ = writeln!(text, "  and {} more", kind.jobs.len() - MOST_NAMED);
        }
        if let Some((at, example)) = &kind.example {
            _ = writeln!(text, "as {}:\n{example}", files::name(&jobs[*at]));
        }
    }
    let of = count(compared, "program");
    let in_kinds = if changed == 0 { String::new() } else { format!(", in {}", count(kinds.len(), "kind")) };
    let verb = if changed == 1 { "changes" } else { "change" };
    _ = writeln!(text, "{changed} of {of} {verb}{in_kinds}");
    text
}
