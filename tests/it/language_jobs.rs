//! Programs of Siemens and Heidenhain controls that are read as jobs: a cycle whose moves the job's cycle does not make is
//! refused, and the message names the argument.

use std::io::Cursor;

use crate::support::{check, control, job_options, plain_post};
use postform::internals::compile::compile;
use postform::internals::nc::{RunSettings, read_program};
use postform::internals::render::{Options, Renderer};
use postform::toolpath::ReadError;

/// The program that the Fanuc post prints of another program, or the message of the refusal.
fn printed(program: &str, name: &str) -> Result<String, String> {
    let checked = check(&plain_post("fanuc.pf"));
    let form = compile(&checked.form);
    let mut renderer = Renderer::new(&form, Options { program: Some(1), ..Options::default() });
    let options = job_options(RunSettings::new(control(name)));
    match read_program(Cursor::new(program), &options, &mut Vec::new(), &mut renderer) {
        Ok(()) => Ok(String::from_utf8(std::mem::take(renderer.text())).unwrap()),
        Err(ReadError::Job(diag)) => Err(format!("{} {}", diag.code.name(), diag.message)),
        Err(other) => panic!("{other:?}"),
    }
}

fn siemens(cycle: &str) -> Result<String, String> {
    let program = format!(
        "G17 G710 G90 G94 G54\nT1\nM6\nD1 S1000 M3\nG0 X0 Y0\nZ50\nF200\nMCALL {cycle}\nX10\nX20\nMCALL\nG0 Z50\nM30\n"
    );
    printed(&program, "siemens")
}

fn klartext(cycle: &str) -> Result<String, String> {
    let program = format!(
        "0 BEGIN PGM T MM\n1 TOOL CALL 1 Z S1000\nCYCL DEF 247 Q339=1\nL X+0 Y+0 R0 FMAX M3\nL Z+50 R0 FMAX\n{cycle}\n\
         L X+10 FMAX M99\nL X+20 FMAX M99\nL Z+60 R0 FMAX\nM30\nEND PGM T MM\n"
    );
    printed(&program, "heidenhain")
}

#[track_caller]
fn refused(printed: Result<String, String>, arguments: &str) {
    match printed {
        Ok(text) => panic!("the cycle with another {arguments} is printed:\n{text}"),
        Err(said) => assert!(said.starts_with("PN036") && said.contains(&format!("({arguments})")), "{said}"),
    }
}

/// A job has no words for path control. Each word is named once.
#[test]
fn words_that_a_job_leaves_out_are_named() {
    let program = "G17 G710 G90 G94 G54 CFC SOFT\nT1\nM6\nD1 S1000 M3\nG0 X0 Y0\nZ50\nCYCLE832(0.05,1,1)\nG1 Z-1 F200 CFC\nG0 Z50\nM30\n";
    let checked = check(&plain_post("fanuc.pf"));
    let form = compile(&checked.form);
    let mut renderer = Renderer::new(&form, Options { program: Some(1), ..Options::default() });
    let options = job_options(RunSettings::new(control("siemens")));
    let mut warnings = Vec::new();
    read_program(Cursor::new(program), &options, &mut warnings, &mut renderer).unwrap();
    let left_out =
        warnings.iter().filter_map(|warning| warning.message.strip_suffix(" is left out: a job can't contain it"));
    assert_eq!(left_out.collect::<Vec<_>>(), ["CFC, 2 times", "CYCLE832(0.05,1,1)", "SOFT"]);
}

/// The pitch of a tap was its feed at SST divided by the active speed.
#[test]
fn a_tap_keeps_its_pitch() {
    let text = siemens("CYCLE84(50,0,2,-10,,0,3,,1,0,1000,1000)").unwrap();
    assert!(text.contains("M29 S1000") && text.contains("F1000."), "{text}");
    refused(siemens("CYCLE84(50,0,2,-10,,0,3,,1,0,500,500)"), "SST");
    refused(siemens("CYCLE84(50,0,2,-10,,0,3,,1,0,1000,2000)"), "SST1");
}

#[test]
fn arguments_that_a_job_has_no_place_for_are_refused() {
    // these make the moves of the job's cycle
    for cycle in [
        "CYCLE81(50,0,2,-10)",
        "CYCLE82(50,0,2,-10,,0.5)",
        "CYCLE83(50,0,2,-20,,,5,0,0,0,1,1)",
        "CYCLE83(50,0,2,-20,,,5,0,0,0,1,0)",
        "CYCLE85(50,0,2,-10,,0.5,100,100)",
        "CYCLE89(50,0,2,-10,,0.5)",
    ] {
        assert!(siemens(cycle).is_ok(), "{cycle}: {:?}", siemens(cycle));
    }
    for (cycle, arguments) in [
        ("CYCLE83(50,0,2,-20,,,5,0,0.5,0,1,0)", "DTB, DTS"),
        ("CYCLE83(50,0,2,-20,,,5,0,0,0.5,1,1)", "DTB, DTS"),
        ("CYCLE83(50,0,2,-20,,,5,0,0,0,0.5,1)", "FRF"),
        ("CYCLE83(50,0,2,-20,,,8,-0.5,0,0,1,1,,1)", "DAM"),
        ("CYCLE84(50,0,2,-10,,0.5,3,,1,0,1000,1000)", "DTB"),
        ("CYCLE84(50,0,2,-10,,0,3,,1,0,1000,1000,,,,1,4,1)", "VARI, DAM"),
        ("CYCLE85(50,0,2,-10,,0,100,300)", "RFF"),
    ] {
        refused(siemens(cycle), arguments);
    }
    let okuma = |cycle: &str| {
        let head = "G15 H1\nT1 M6\nS1000 M3\nG56 H1\nG21\nG0 G90 G17 X0 Y0 Z50\n";
        printed(&format!("{head}NCYL G71 Z50\n{cycle} M53\nX20\nG80\nG0 Z50\nM2\n"), "okuma")
    };
    assert!(okuma("G83 X10 Z-20 R2 Q5 F100").is_ok(), "{:?}", okuma("G83 X10 Z-20 R2 Q5 F100"));
    refused(okuma("G83 X10 Z-20 R2 I2 J4 F100"), "I, J");
    assert!(okuma("G85 X10 Z-20 R2 F100").is_ok());
    refused(okuma("G85 X10 Z-20 R2 F100 FA=300"), "FA");
    let heights = "Q200=2 Q203=0 Q204=50";
    let with = |number: u16, words: &str| klartext(&format!("CYCL DEF {number} {heights} Q201=-20 {words}"));
    for (number, words) in [
        (200, "Q206=100 Q202=5 Q210=0 Q211=0.5"),
        (201, "Q206=100 Q211=0.5 Q208=0"),
        (203, "Q206=100 Q202=5 Q210=0 Q212=0 Q213=0 Q205=5 Q211=0 Q208=MAX Q256=0.2"),
        (203, "Q206=100 Q202=5 Q210=0 Q212=0 Q213=9 Q205=5 Q211=0 Q208=MAX Q256=0.2"),
        (205, "Q206=100 Q202=20 Q257=5 Q256=0.2"),
        (207, "Q239=1"),
    ] {
        assert!(with(number, words).is_ok(), "{number} {words}: {:?}", with(number, words));
    }
    for (number, words, arguments) in [
        (200, "Q206=100 Q202=5 Q210=1 Q211=0", "Q210"),
        (201, "Q206=100 Q211=0 Q208=300", "Q208"),
        (203, "Q206=100 Q202=5 Q210=0 Q212=0 Q213=0 Q205=5 Q211=0 Q208=500 Q256=0.2", "Q208"),
        (203, "Q206=100 Q202=5 Q210=0 Q212=0 Q213=2 Q205=5 Q211=0 Q208=MAX Q256=0.2", "Q213"),
        (203, "Q206=100 Q202=8 Q210=0 Q212=2 Q213=0 Q205=2 Q211=0 Q208=MAX Q256=0.2", "Q212"),
        (205, "Q206=100 Q202=8 Q257=2 Q256=0.2 Q258=0.2", "Q257"),
        (209, "Q239=1 Q257=5 Q256=0", "Q257"),
        (209, "Q239=1 Q257=0 Q256=0 Q403=2", "Q403"),
    ] {
        refused(with(number, words), arguments);
    }
}
