//! `postform sheet`.

use std::fs;
use std::io::{Read as _, Seek as _};
use std::path::{Path, PathBuf};

use postform::internals::picture::{self, Sheet, View};
use postform::internals::setup::{SetupSheet, html, markdown};
use postform::internals::verify::Verdict;
use postform::toolpath::Units;

use super::Ending;
use super::args::{SheetArgs, SheetFormat, UnitsArg};
use super::config::Config;
use super::files::{self, io_message};
use super::output::{self, Target};
use super::prepare::prepare;
use super::rendered::rendered;
use super::report::{Reporter, stopped};
use super::say::{message, say};
use super::verdict::Sides;
use super::{inputs, machine};

/// Width of a picture in pixels.
const WIDTH: f64 = 480.0;

/// Writes the setup sheet of a job.
pub fn run(args: &SheetArgs, colour: bool) -> Result<Ending, String> {
    let reporter = &Reporter::new(colour);
    let extension = args.output.extension().and_then(|extension| extension.to_str()).unwrap_or("html");
    let format = match (args.format, extension.to_ascii_lowercase().as_str()) {
        (Some(format), _) => format,
        (None, "html" | "htm") => SheetFormat::Html,
        (None, "md") => SheetFormat::Md,
        (None, "json") => SheetFormat::Json,
        _ => {
            let name = files::output_name(&args.output);
            return Err(format!("error: the format of {name} is unknown\n  help: end the name in .html, .md or .json"));
        }
    };
    files::check_format(&args.job, &args.read)?;
    let config = Config::near(&args.job)?;
    let Some(form) = args.form.clone().or(config.form) else {
        let help = "give --form, or name one in a postform.toml: form = \"fanuc.pf\"";
        return Err(format!("error: no form is given to print {}\n  help: {help}", files::name(&args.job)));
    };
    let Some(mut prepared) = prepare(&form, &args.options, &args.job, reporter)? else { return Ok(Ending::Findings) };
    let named = machine::of_prepared(&args.machine, &form, &mut prepared)?;
    let mut job = files::job(&args.job, &args.read, true)?;
    let target = Target::open(&args.output, false)?;
    let (post, options) = (&prepared.post, &prepared.options);
    let mut sheet = match post.setup(job.again(), options) {
        Ok(sheet) => sheet,
        Err(error) => return stopped(error, &[&args.job], reporter, post.files()),
    };
    let Ok((mut program, _)) = rendered(&mut job, &[&args.job], &prepared, false, reporter)? else {
        return Ok(Ending::Findings);
    };
    let proof = args.control.proof(None, prepared.config.control);
    let sides = Sides { jobs: &[&args.job], program: "the program", files: post.files() };
    let fail = |error: std::io::Error| io_message("read", Path::new("the program"), &error);
    let copy = program.try_clone().map_err(fail)?;
    let proven = post.verify_with(job.again(), copy, options, &proof);
    let proven = match sides.tried(proven, args.options.quiet, reporter)? {
        Ok(proven) => proven,
        Err(ending) => return Ok(ending),
    };
    sheet.verdict = sides.sentence(&proven).trim().to_owned();
    if let Some(machine) = &named {
        let copy = program.try_clone().map_err(fail)?;
        let made = (&mut job, options);
        let (fitted, fitting) = machine::of_post(post, machine, made, &proof, (copy, "the program"))?;
        // the findings are also in the sheet
        if !args.options.quiet {
            fitting.show(&fitted, (&[&args.job], post.files()), reporter);
        }
        if let Ok(times) = &fitted.times {
            sheet.take_times(times);
        }
        sheet.take_tools(machine);
        let sentences = fitting.sentence(&fitted) + &fitting.sentences(&fitted);
        sheet.machine = sentences.lines().map(str::to_owned).collect();
        let findings = fitted.findings.iter().map(|finding| format!("{}: {}", finding.code.name(), finding.message));
        sheet.machine.extend(findings);
        sheet.machine.extend(fitted.fit.not_checked.iter().map(|what| format!("not checked: {what}")));
    }
    program.rewind().map_err(fail)?;
    let units = args.options.units.map_or(Units::Mm, UnitsArg::units);
    let drawn = picture::draw(&mut program, post.run_settings(&proof, units)).map_err(fail)?;
    let views = if drawn.usual_view() == View::Lathe { &[View::Lathe][..] } else { &[View::Top, View::Iso] };
    for view in views {
        let caption = if *view == View::Iso { "from the right, front and above" } else { "from above" };
        let caption = if *view == View::Lathe { "Z to the right, X up" } else { caption };
        let title = files::name(&args.job);
        sheet.pictures.push([caption.into(), picture::svg(&drawn, &Sheet { title, view: *view, width: WIDTH })]);
    }
    let mut text = Vec::new();
    program.rewind().and_then(|()| program.read_to_end(&mut text)).map_err(fail)?;
    hashes(&mut sheet, args, &form, &text)?;
    let page = match format {
        SheetFormat::Html => html(&sheet),
        SheetFormat::Md => markdown(&sheet),
        SheetFormat::Json => output::json(&serde_json::to_value(&sheet).map_err(|error| format!("error: {error}"))?),
    };
    output::whole(target, &args.output, page.as_bytes())?;
    if let Verdict::Different(findings) = &proven.verdict {
        sides.show(findings, postform::diag::Severity::Error, reporter);
        message("the sheet is written; it reports that the program is different from its job");
        return Ok(Ending::Findings);
    }
    if !args.options.quiet {
        say(&sides.sentence(&proven));
    }
    Ok(Ending::Clean)
}

/// The SHA-256 hashes of the files from which the sheet is made: the job, the form, and all other files that were read. A
/// pipe can't be read again, so it has no hash.
fn hashes(sheet: &mut SetupSheet, args: &SheetArgs, form: &Path, program: &[u8]) -> Result<(), String> {
    let first = [args.job.as_path(), form];
    let mut others = inputs::all();
    others.sort_by_key(|path| path.file_name().map(std::ffi::OsStr::to_owned));
    let others = others.iter().map(PathBuf::as_path).filter(|path| !first.contains(path));
    for path in first.into_iter().chain(others).filter(|path| path.is_file()) {
        let fail = |error: std::io::Error| io_message("read", path, &error);
        sheet.add_file(files::name(path), fs::File::open(path).map_err(fail)?).map_err(fail)?;
    }
    let fail = |error: std::io::Error| io_message("read", Path::new("the program"), &error);
    sheet.add_file("the program".into(), program).map_err(fail)
}
