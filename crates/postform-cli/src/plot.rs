//! `postform plot`.

use std::fs::File;
use std::io::{Read, Seek};
use std::path::Path;

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD as BASE64;
use postform::internals::nc::{RunSettings, settings_for};
use postform::internals::picture::{self, Picture, Sheet};
use postform::internals::scene::{PLOT_PAGE, of_program};
use postform::toolpath::Units;
use postform::{Format, Job, Proof};

use super::Ending;
use super::args::{ControlArgs, PlotArgs};
use super::config::Config;
use super::files::{self, io_message};
use super::job_format::format_of_name;
use super::output::{self, Target};
use super::prepare::prepare;
use super::rendered::rendered;
use super::report::{Reporter, place_in};
use super::say::say;

/// Draws a program.
pub fn run(args: &PlotArgs, colour: bool) -> Result<Ending, String> {
    let reporter = Reporter::new(colour);
    let is_page = has_extension(&args.output, "html");
    if !is_page && args.output != Path::new("-") && !has_extension(&args.output, "svg") {
        let name = files::output_name(&args.output);
        return Err(format!("error: the format of {name} is unknown\n  help: end the name in .svg or .html"));
    }
    let Some((mut picture, mut program)) = picture(args, &reporter)? else { return Ok(Ending::Findings) };
    let name = files::name(&args.file);
    if !args.options.quiet {
        picture.warnings.iter_mut().for_each(|diag| place_in(&name, diag));
        say(&reporter.text(&picture.warnings, &[]));
    }
    let title = [Some(&args.file), args.form.as_ref()];
    let title: Vec<_> = title.iter().flatten().filter_map(|path| Some(path.file_name()?.to_string_lossy())).collect();
    let title = title.join(" · ");
    let text = if is_page {
        let mut text = Vec::new();
        let fail = |error| io_message("read", &args.file, &error);
        program.rewind().and_then(|()| program.read_to_end(&mut text)).map_err(fail)?;
        page(&of_program(&title, &text, &picture).into_bytes())
    } else {
        still(&picture, title, args)
    };
    output::whole(Target::open(&args.output, false)?, &args.output, text.as_bytes())?;
    // the picture up to the refused block is still useful
    let Some((mut diag, _)) = picture.refused.take() else { return Ok(Ending::Clean) };
    place_in(&name, &mut diag);
    say(&reporter.text(&[*diag], &[]));
    Ok(Ending::Findings)
}

fn still(picture: &Picture, title: String, args: &PlotArgs) -> String {
    let view = args.view.map_or_else(|| picture.usual_view(), |view| view.view());
    picture::svg(picture, &Sheet { title, view, width: f64::from(args.width) })
}

/// A self-contained page with a scene in it.
fn page(scene: &[u8]) -> String {
    PLOT_PAGE.replacen(">SCENE<", &format!(">{}<", BASE64.encode(scene)), 1)
}

fn has_extension(path: &Path, wanted: &str) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case(wanted))
}

/// The requested program, its picture and its text. `None`: there is no program, and the reason has been shown.
fn picture(args: &PlotArgs, reporter: &Reporter) -> Result<Option<(Picture, File)>, String> {
    let config = Config::near(&args.file)?;
    let is_program = args.form.is_none() && args.read.from.is_none_or(|from| from == Format::Nc) && {
        args.read.from.is_some() || format_of_name(&args.file) == Some(Format::Nc)
    };
    if is_program {
        let control = ControlArgs { control: args.control.control.or(config.control), ..args.control.clone() };
        let units = args.options.units.map_or(Units::Mm, |units| units.units());
        let settings = control.settings(None, units);
        let mut program = files::open_program(&args.file)?;
        let settings =
            settings_for(&mut program, &args.file, settings).map_err(|error| io_message("read", &args.file, &error))?;
        return drawn(program, settings, &args.file).map(Some);
    }
    files::check_format(&args.file, &args.read)?;
    let Some(form) = args.form.clone().or(config.form) else {
        let help = "give --form, or name one in a postform.toml: form = \"fanuc.pf\"";
        return Err(format!(
            "error: {} is a job, and no form is given to print it\n  help: {help}",
            files::name(&args.file)
        ));
    };
    let Some(prepared) = prepare(&form, &args.options, &args.file, reporter)? else { return Ok(None) };
    let mut job = files::job(&args.file, &args.read, true)?;
    let Ok((program, _)) = rendered(&mut job, &[&args.file], &prepared, false, reporter)? else { return Ok(None) };
    let units = match args.options.units {
        Some(units) => units.units(),
        None => units_of(&mut job, &args.file)?,
    };
    let proof: Proof = args.control.proof(None, prepared.config.control);
    let settings = prepared.post.run_settings(&proof, units);
    drawn(program, settings, Path::new("the program")).map(Some)
}

fn drawn(mut input: File, settings: RunSettings, path: &Path) -> Result<(Picture, File), String> {
    let picture = picture::draw(&mut input, settings).map_err(|error| io_message("read", path, &error))?;
    Ok((picture, input))
}

/// The units of a job.
fn units_of(job: &mut Job<'_>, path: &Path) -> Result<Units, String> {
    let units = job.units().map_err(|error| match error.io() {
        Some(error) => io_message("read", path, error),
        None => format!("error: {error}"),
    })?;
    Ok(units.unwrap_or(Units::Mm))
}
