//! Programs of several CAM systems; the test runs only if they are next to the checkout. Each program runs on the
//! control `fanuc`, or is refused for a reason that a machinist accepts. If another form prints the program, the
//! motions stay the same.

use crate::support;
use crate::support::control;
use std::fs;
use std::io::Cursor;

use crate::support::{job_options, root};
use postform::internals::compile::compile;
use postform::internals::nc::{JobOptions, RunError, RunSettings, Simulator, Tally, Unpointed, read_program};
use postform::internals::render::{Options, Renderer};
use postform::internals::verify::{Comparer, Expectation, Verdict};
use postform::toolpath::{Sink, Units};

/// Number of holes and of tools, or code and line of a refusal.
type Outcome = Result<(u64, u64), (&'static str, u64)>;

/// A program, its settings, and the expected outcome.
type Program = (&'static str, Vec<u8>, RunSettings, Option<Units>, Outcome);

/// The file; its units, if it has no code for them; the number of holes and tools, or the refusal.
const PROGRAMS: [(&str, Option<Units>, Outcome); 7] = [
    ("gct_CGIP09902-2.NC", Some(Units::Inch), Ok((24, 5))),
    ("gct_CGIP09902.NC", Some(Units::Inch), Ok((633, 4))),
    ("gct_Fusion_360_Gcode.nc", None, Ok((32, 31))),
    // a PathPilot program: a Fanuc has no G91.1
    ("lmhd_Titan1M_1001_NoEdit.nc", None, Err(("PN003", 13))),
    ("nist_827-9999-904_FIXT.NC", None, Ok((18, 7))),
    ("nist_827-9999-904_OP1.NC", None, Ok((22, 11))),
    ("rawdog_1401.nc", None, Ok((24, 15))),
];

/// The programs.
fn programs() -> Vec<Program> {
    let folder = root().join("../shared/data/nc");
    let with = |(name, units, expected): (&'static str, Option<Units>, _)| {
        // two programs end with G53 X12; the meaning of the number without a decimal point depends on the machine
        let unpointed = if units.is_some() { Unpointed::Whole } else { Unpointed::Refused };
        let settings =
            RunSettings { units: units.unwrap_or(Units::Mm), unpointed, ..RunSettings::new(control("fanuc")) };
        (name, fs::read(folder.join(name)).unwrap(), settings, units, expected)
    };
    PROGRAMS.into_iter().map(with).collect()
}

#[test_with::path(../shared/data/nc)]
#[test]
fn real_programs_run_or_are_refused_for_a_reason() {
    for (name, bytes, settings, _, expected) in programs() {
        let mut simulator = Simulator::new(Cursor::new(bytes), settings);
        let mut tally = Tally::new(settings.units);
        let mut items = Vec::new();
        let found = loop {
            items.clear();
            let step = simulator.step(&mut items);
            items.iter().for_each(|item| tally.add(item));
            match step {
                Ok(true) => {}
                Ok(false) => break Ok((tally.holes, tally.tools)),
                Err(RunError::Refused(diag, line)) => break Err((diag.code.name(), line)),
                Err(RunError::Io(error)) => panic!("{error}"),
            }
        };
        assert_eq!(found, expected, "{name}");
    }
}

#[test_with::path(../shared/data/nc)]
#[test]
fn real_programs_printed_by_another_form_make_the_same_motions() {
    let checked = support::check(&support::plain_post("haas.pf"));
    let form = compile(&checked.form);
    for (name, bytes, settings, units, expected) in programs() {
        if expected.is_err() {
            continue;
        }
        let options = JobOptions { units, ..job_options(settings) };
        let read = |sink: &mut dyn Sink| read_program(Cursor::new(&bytes), &options, &mut Vec::new(), sink);
        let mut renderer = Renderer::new(&form, Options { program: Some(1), ..Options::default() });
        if let Err(error) = read(&mut renderer) {
            // a rigid tap with a dwell that the Haas form can't print
            assert!(name == "rawdog_1401.nc" && format!("{error:?}").contains("PC021"), "{name}: {error:?}");
            continue;
        }
        let program = std::mem::take(renderer.text());
        let text = String::from_utf8_lossy(&program).into_owned();
        let expectation = Expectation::of_form(&form.settings, false);
        let mut comparer =
            Comparer::new(Cursor::new(program), RunSettings::new(control("haas")), expectation, None, false);
        let read = read(&mut comparer);
        let verdict = comparer.verdict().unwrap();
        assert!(read.is_ok() && !matches!(verdict, Verdict::Different(_)), "{name}: {verdict:?}\n{text}");
    }
}
