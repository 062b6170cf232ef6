//! `postform test --new`: the standard cases for a form, with the programs that it prints.

use std::borrow::Cow;
use std::fs;
use std::io;
use std::path::{Component, Path, PathBuf};

use postform::internals::lang::{Machine, UnitChoice};

use super::super::Ending;
use super::super::config::Config;
use super::super::files::{self, io_message};
use super::super::output::{self, write_new};
use super::case::{Case, may_be_expected};
use super::cases::{BEAM, LATHE, MILL, WIRE};
use super::posts::Ready;

/// Writes the cases into a folder. Each case is a job with the program that the form prints. Existing files stay.
pub fn write(form: &Path, post: Option<&str>, folder: &Path) -> Result<Ending, String> {
    files::check_regular(form)?;
    // a folder without postform.toml gets its own one, which hides those of the folders above
    let config = match folder.join("postform.toml").is_file() {
        true => Config::near(&folder.join("job.json"))?,
        false => Config::default(),
    };
    let post = post.or(config.test.post.as_deref());
    let ready = Ready::of(form, post, &config)?;
    let name = form.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
    let settings = &ready.checked.form.settings;
    let cases = match settings.machine {
        _ if settings.beam.is_some() => BEAM,
        Machine::Mill => MILL,
        Machine::Lathe => LATHE,
        Machine::Edm => WIRE,
    };
    let (mut printed, mut refused, mut wrong, mut others) = (0, Vec::new(), Vec::new(), Vec::new());
    for (case, job) in cases {
        let job = in_units(job, settings.units);
        let place = folder.join(case);
        fs::create_dir_all(&place).map_err(|error| io_message("make", &place, &error))?;
        let text = job;
        let job = place.join("job.json");
        if !new(&job, text.as_bytes())? && !fs::read(&job).is_ok_and(|there| there == text.as_bytes()) {
            others.push(format!("  {case}"));
            continue;
        }
        let expected = place.join(format!("expected.{name}.nc"));
        match Case::new(job, expected.clone()).print(&ready)? {
            Ok(program) => {
                new(&expected, &program.text)?;
                printed += 1;
            }
            Err(why) => {
                let said = why.diags.first().map(|diag| (diag.code.name(), diag.message.as_str()));
                let (code, message) = said.unwrap_or(("an error", &why.message));
                let line = format!("  {case}: {code} {}", message.lines().next().unwrap_or_default());
                if !may_be_expected(code) {
                    wrong.push(line);
                    continue;
                }
                new(&expected.with_extension("refused"), format!("{code}\n").as_bytes())?;
                refused.push(line);
            }
        }
    }
    let config = folder.join("postform.toml");
    let from_there = relative(folder, form)?;
    let said = toml_string(&from_there.to_string_lossy());
    let of_post = post.map_or(String::new(), |post| format!("post = {}\n", toml_string(post)));
    let written = new(&config, format!("[test]\nforms = [{said}]\n{of_post}").as_bytes())?;
    let mut text = format!("{}: {printed} programs of {} jobs\n", files::name(folder), cases.len());
    if !refused.is_empty() {
        text += &format!(
            "{} refuses the other jobs; these refusals are now the expected results:\n{}\n",
            files::name(form),
            refused.join("\n")
        );
    }
    if !others.is_empty() {
        let text_of = others.join("\n");
        text += &format!(
            "other jobs with these names exist and are kept; no expected programs were written for \
             them:\n{text_of}\n  help: give this form a folder of its own\n"
        );
    }
    if !written && !fs::read_to_string(&config).is_ok_and(|there| there.contains(&said)) {
        text += &format!("{} existed already: add {said} to its forms under [test]\n", files::name(&config));
    }
    if !wrong.is_empty() {
        let list = wrong.join("\n");
        text += &format!(
            "{} prints programs of these jobs that are different from the job:\n{list}\n  help: fix the form, then \
             run this again\n",
            files::name(form)
        );
        output::standard_output(|out| io::Write::write_all(out, text.as_bytes()))?;
        return Ok(Ending::Findings);
    }
    text += &format!("check the programs once, then run: postform test {}\n", files::name(folder));
    output::standard_output(|out| io::Write::write_all(out, text.as_bytes()))?;
    Ok(Ending::Clean)
}

/// A job in units that the form prints. The numbers stay the same, so the part becomes smaller or larger.
fn in_units(job: &str, printed: UnitChoice) -> Cow<'_, str> {
    let units = ["\"units\": \"mm\"", "\"units\": \"inch\""];
    let [from, to] = match printed {
        UnitChoice::Both => return job.into(),
        UnitChoice::Inch => units,
        UnitChoice::Mm => [units[1], units[0]],
    };
    job.replacen(from, to, 1).into()
}

/// Writes a file if it does not exist yet. `false`: the file exists and stays unchanged.
fn new(path: &Path, bytes: &[u8]) -> Result<bool, String> {
    match write_new(path, bytes) {
        Ok(()) => Ok(true),
        Err(error) if error.kind() == io::ErrorKind::AlreadyExists => Ok(false),
        Err(error) => Err(io_message("write", path, &error)),
    }
}

/// The path of a file relative to a folder.
fn relative(folder: &Path, file: &Path) -> Result<PathBuf, String> {
    let whole = |path: &Path| path.canonicalize().map_err(|error| io_message("read", path, &error));
    let (folder, file) = (whole(folder)?, whole(file)?);
    let shared = folder.components().zip(file.components()).take_while(|(a, b)| a == b).count();
    let up = folder.components().skip(shared).map(|_| Component::ParentDir);
    Ok(up.chain(file.components().skip(shared)).collect())
}

/// A text as a TOML string.
fn toml_string(text: &str) -> String {
    format!("\"{}\"", text.replace('\\', "/").replace('"', "\\\""))
}
