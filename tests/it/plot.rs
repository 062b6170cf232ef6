//! `postform plot`: pictures of correct and of malicious programs, and the exit status.

use std::fs;
use std::io::Cursor;
use std::process::{Command, Output};

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use postform::internals::nc::RunSettings;
use postform::internals::picture::{Kind, Picture, Register, Sheet, View, draw, svg};
use postform::toolpath::Units;
use postform::{Job, NoFiles, Options, Post, Proof, Source};

use crate::support::folder::Folder;
use crate::support::{control, root};

fn picture(program: impl AsRef<[u8]>) -> Picture {
    draw(Cursor::new(program.as_ref()), RunSettings::new(control("linuxcnc"))).unwrap()
}

fn drawn(program: impl AsRef<[u8]>) -> String {
    svg(&picture(program), &Sheet { title: "part.nc".into(), view: View::Iso, width: 960.0 })
}

fn plot(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_postform")).arg("plot").args(arguments).current_dir(root()).output().unwrap()
}

/// The picture in the README. `SAMPLES=overwrite cargo test plot::` draws it again; check the new picture.
#[test]
fn the_bracket_is_drawn_as_in_the_readme() {
    let output = plot(&["samples/bracket/job.json", "--form", "postforms/fanuc.pf", "--quiet"]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let path = root().join("docs/images/bracket.svg");
    if std::env::var("SAMPLES").as_deref() == Ok("overwrite") {
        fs::write(&path, &output.stdout).unwrap();
    }
    assert!(fs::read(&path).unwrap() == output.stdout, "docs/images/bracket.svg is another picture");
}

/// For the programs of all samples in all views, every point is on the sheet, and every coordinate is a number.
#[test]
fn what_is_drawn_is_on_the_sheet() {
    let mut programs = 0;
    for folder in crate::support::samples() {
        let files = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
        for path in files.filter(|path| path.extension().is_some_and(|end| end == "nc")) {
            let control = control(if path.to_string_lossy().contains("linuxcnc") { "linuxcnc" } else { "fanuc" });
            let program = draw(Cursor::new(fs::read(&path).unwrap()), RunSettings::new(control)).unwrap();
            programs += usize::from(program.moves.len() > 4);
            for (view, _) in View::ALL {
                let text = svg(&program, &Sheet { title: "a".into(), view, width: 640.0 });
                on_the_sheet(&text, 640.0, &path.to_string_lossy());
            }
        }
    }
    assert!(programs > 40, "{programs} programs with moves");
}

fn on_the_sheet(text: &str, width: f64, what: &str) {
    let height: f64 = text.split("height=\"").nth(1).unwrap().split('"').next().unwrap().parse().unwrap();
    for path in text.split(" d=\"").skip(1) {
        let path = path.split('"').next().unwrap();
        if path.contains('h') {
            continue; // a line of the legend
        }
        for point in path.split(['M', 'L', 'Z']).filter(|point| !point.is_empty()) {
            let (x, y) = point.split_once(' ').unwrap();
            let (x, y): (f64, f64) = (x.parse().unwrap(), y.parse().unwrap());
            assert!((0.0..=width).contains(&x) && (0.0..=height).contains(&y), "{what}: {x} {y}");
        }
    }
}

/// An arc is drawn on its circle, a helix on its cylinder, and both end at the right points.
#[test]
fn arcs_are_round() {
    let found = picture("G21 G90 G0 X10 Y0 Z5\nG1 Z0 F100\nG3 X10 Y0 I-10 J0 Z-2 F100\nG2 X-10 Y0 R10\nM2\n");
    let strips = found.strips();
    let on_arc = strips.pieces.iter().filter(|piece| found.moves[piece.of as usize].kind == Kind::Arc);
    let mut count = 0;
    for piece in on_arc {
        let [x, y, z] = piece.to;
        assert!((x.hypot(y) - 10.0).abs() < 1e-9 && (-2.0..=0.0).contains(&z), "{x} {y} {z}");
        count += 1;
    }
    assert!(count > 60, "{count} pieces for a turn and a half");
    assert_eq!(strips.pieces.last().unwrap().to.map(|value| (value * 1e6).round()), [-1e7, 0.0, -2e6]);
    assert_eq!(strips.extents[0].map(f64::round), [-10.0, -10.0, -2.0], "with what the arc passes");
}

/// The position after a move to a machine position is unknown, so the move is drawn upwards, above everything else.
#[test]
fn a_way_home_goes_over_everything() {
    let found = picture("G21 G90 G54 G0 X0 Y0\nG43 H1 Z50.\nG1 Z-5 F100\nG1 X100\nG0 G53 Z0\nX50 Y50\nM2\n");
    let last = found.moves.last().unwrap();
    assert!(last.to[2].is_nan() && last.to[0] == 50.0, "{last:?}");
    let strips = found.strips();
    assert!(strips.ceiling > 50.0);
    assert_eq!(strips.pieces.last().unwrap().to, [50.0, 50.0, strips.ceiling]);
    assert_eq!(strips.extents[1][2], 50.0, "what is not known is not measured");
}

#[test]
fn a_program_that_only_says_how_far_is_drawn_from_zero() {
    let found = picture("G21 G91 G1 X10 F100\nY10\nM2\n");
    assert_eq!(found.strips().pieces.last().unwrap().to, [10.0, 10.0, 0.0]);
}

#[test]
fn a_program_in_both_units_is_drawn_in_the_first() {
    let found = picture("G20 G90 G0 X1 Y0 Z0\nG21\nG0 X50.8\nM2\n");
    let to = found.moves.last().unwrap().to;
    assert!((to[0] - 2.0).abs() < 1e-9, "{to:?}");
}

/// The modal state after a block, and the block that set each value.
#[test]
fn every_part_of_the_state_has_its_block() {
    let found = picture(
        "G20 G17 G90\nT2 M6\nG54 G0 X0 Y0 S2500 M3\nG43 H2 Z1 M8\nG98 G82 X1 Y1 Z-.1 R.1 P.25 F6\nX2\nG80\nM2\n",
    );
    let at = |line: u32, register: Register| {
        let mut before = found.changes.iter().filter(|change| change.line <= line && change.register == register);
        before.next_back().map(|change| (change.value, change.line)).unwrap_or_default()
    };
    assert_eq!(at(6, Register::Tool), (2.0, 2));
    assert_eq!(at(6, Register::H), (2.0, 4));
    assert_eq!(at(6, Register::Speed), (2500.0, 3));
    assert_eq!(at(6, Register::Coolant), (8.0, 4));
    assert_eq!(at(6, Register::Feed), (6.0, 5));
    assert_eq!(at(6, Register::Cycle), (82.0, 5));
    assert_eq!(at(6, Register::R), (0.1, 5));
    assert_eq!(at(6, Register::Work), (54.0, 3));
    assert!(at(7, Register::Cycle).0.is_nan(), "G80 ends it");
    assert_eq!(found.holes.len(), 2);
    assert_eq!((found.holes[1].line, found.holes[1].bottom), (6, [2.0, 1.0, -0.1]));
}

/// U and V of a wire machine are the position of the upper guide. Its height is unknown, so the picture shows the guide
/// as a second line above the part.
#[test]
fn a_wire_has_two_guides() {
    let program = "G21 G90\nG0 X0 Y0 U0 V0\nG1 X10. Y0 U11. V1. F3.\nG3 X10. Y10. I0 J5. U11. V11.\nM2\n";
    let found = draw(Cursor::new(program), RunSettings::new(control("fanuc-wire"))).unwrap();
    let cuts: Vec<_> = found.moves.iter().filter(|found| matches!(found.kind, Kind::Feed | Kind::Arc)).collect();
    let ends: Vec<[f64; 2]> = cuts.iter().map(|found| [found.to[0], found.to[1]]).collect();
    assert_eq!(ends, [[10.0, 0.0], [11.0, 1.0], [10.0, 10.0], [11.0, 11.0]]);
    let heights: Vec<bool> = cuts.iter().map(|found| found.to[2].is_nan()).collect();
    assert_eq!(heights, [false, true, false, true]);
    // the arc of the upper guide is next to that of the lower one
    assert_eq!(
        found.arcs.iter().map(|arc| [arc.center[0], arc.center[1]]).collect::<Vec<_>>(),
        [[10.0, 5.0], [11.0, 6.0]]
    );
    let strips = found.strips();
    let upper = strips.pieces.iter().filter(|piece| found.moves[piece.of as usize].to[2].is_nan());
    assert!(upper.clone().count() > 10 && upper.into_iter().all(|piece| piece.to[2] == strips.ceiling));
    let held = |register| found.changes.iter().rev().find(|change| change.register == register).unwrap().value;
    assert_eq!((held(Register::U), held(Register::V)), (11.0, 11.0));
}

/// By the right-hand rule, a positive angle turns the tool about the part: a hole that is drilled from above at A90 is
/// on the -Y side.
#[test]
fn rotary_axes_turn_the_points_about_them() {
    let found = picture("G21 G90 G94 F100\nG0 X0 Y0 Z10\nA90\nG1 Z5\nA450 X20\nM2\n");
    let strips = found.strips();
    let near = |at: [f64; 3], expected: [f64; 3]| {
        assert!(at.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-9), "{at:?} {expected:?}");
    };
    let end = |line: u32| strips.pieces.iter().rfind(|piece| found.moves[piece.of as usize].line == line).unwrap().to;
    near(end(3), [0.0, -10.0, 0.0]);
    near(end(4), [0.0, -5.0, 0.0]);
    near(end(5), [20.0, -5.0, 0.0]);
    // a full turn is a helix: all its points are equally far from the axis, and neighbouring points are close
    let turn: Vec<_> = strips.pieces.iter().filter(|piece| found.moves[piece.of as usize].line == 5).collect();
    assert!(turn.len() >= 120, "{}", turn.len());
    assert!(turn.iter().all(|piece| (piece.to[1].hypot(piece.to[2]) - 5.0).abs() < 1e-9));
    near([strips.extents[0][2], strips.extents[1][2], strips.extents[1][0]], [-5.0, 10.0, 20.0]);
    let angle = found.changes.iter().rfind(|change| change.register == Register::A).unwrap();
    assert_eq!((angle.value, angle.line), (450.0, 5));
}

/// The programs of each post for each sample have a picture, drawn with the form's machine.
#[test]
fn every_post_has_a_picture() {
    let samples = ["bracket", "first", "plate", "lathe-part", "wire", "four-axis", "plasma"];
    for post in fs::read_dir(root().join("postforms")).unwrap() {
        let post = post.unwrap().path();
        let form = Post::compile(Source::from_bytes("form.pf", &fs::read(&post).unwrap()), &NoFiles).unwrap();
        let mut drawn = 0;
        for sample in samples {
            let bytes = fs::read_to_string(root().join(format!("samples/{sample}/job.json"))).unwrap();
            let Ok(program) = form.render(Job::json(&bytes), &Options::default()) else { continue };
            let settings = form.run_settings(&Proof::default(), Units::Mm);
            let found = draw(Cursor::new(program.text()), settings).unwrap();
            // the picture ends at a word whose meaning the control file does not give; the proof ends at the same word
            let refused = found.refused.filter(|(diag, _)| !diag.message.contains("does not give"));
            assert!(refused.is_none(), "{}: {sample}: {refused:?}", post.display());
            assert!(found.moves.len() > 3, "{}: {sample}", post.display());
            drawn += 1;
        }
        assert!(drawn > 0, "{} prints no sample", post.display());
    }
}

#[test]
fn hostile_programs_make_pictures() {
    let long = format!("G1 X{} F1\n", "9".repeat(300));
    let programs: [&[u8]; 10] = [
        b"",
        b"%\n%\n",
        b"\n\n\n",
        b"G0 X1e308 Y-1e308\n",
        b"G1 X99999999999 F1\nX-99999999999\nM2\n",
        long.as_bytes(),
        b"\xff\xfe G0 X1\n",
        b"G21 G90 G0 X0 Y0 Z0\r\nG1 X10 F100\r\nM2\r\n",
        b"(<script>alert(1)</script>)\nG0 X1\nM2\n",
        b"G17 G2 X0 Y0 I0 J0 F1\n",
    ];
    for program in programs {
        let text = drawn(program);
        let what = String::from_utf8_lossy(program).into_owned();
        assert!(text.ends_with("</svg>\n") && !text.contains("NaN") && !text.contains("inf,"), "{what}: {text}");
        assert!(!text.contains("<script"), "{what}");
        on_the_sheet(&text, 960.0, &what);
    }
    let title = svg(&picture(""), &Sheet { title: "<b>&\u{202e}".into(), view: View::Top, width: 300.0 });
    assert!(title.contains("&lt;b&gt;&amp;\\u{202e}"), "{title}");
}

/// Moves closer than a tenth of a pixel are drawn together, so that the picture stays small.
#[test]
fn a_hundred_thousand_moves_in_one_place_are_a_small_picture() {
    let mut program = "G21 G90 G0 X0 Y0 Z0\nG1 X100 F100\n".to_owned();
    for i in 0..100_000 {
        program += &format!("X{}\n", 100.0 + f64::from(i % 7) * 0.001);
    }
    let text = drawn(program + "M2\n");
    assert!(text.len() < 20_000, "{} bytes", text.len());
}

/// A page is self-contained: it contains its scene and loads nothing.
#[test]
fn a_page_stands_alone() {
    let folder = Folder::new("plot-page");
    let out = folder.0.join("part.html").to_str().unwrap().to_owned();
    let program = "samples/bracket/expected.fanuc.nc";
    let output = plot(&[program, "--units", "inch", "-o", &out]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let page = folder.read("part.html");
    let scene = page.split("id=\"scene\">").nth(1).unwrap().split('<').next().unwrap();
    let bytes = BASE64_STANDARD.decode(scene).unwrap();
    assert!(bytes.starts_with(b"PFS2"));
    let text = fs::read(root().join(program)).unwrap();
    assert!(bytes.windows(text.len()).any(|part| part == text), "the program is in it");
    assert!(page.contains("connect-src 'none'") && page.len() < 100_000, "{} bytes", page.len());
}

#[test]
fn how_plot_ends() {
    let folder = Folder::new("plot");
    let written = |name: &str, text: &str| {
        folder.write(name, text);
        folder.0.join(name).to_str().unwrap().to_owned()
    };
    let program = written("part.nc", "G21 G90 G0 X0 Y0 Z5.\nG1 X10. F100\nM2\n");
    let refused = written("refused.nc", "G21 G90 G0 X0 Y0 Z5.\nG1 X10. F100\nG123\nM2\n");
    let out = folder.0.join("out.svg").to_str().unwrap().to_owned();
    let status = |arguments: &[&str]| {
        let output = plot(arguments);
        (output.status.code().unwrap(), String::from_utf8_lossy(&output.stderr).into_owned())
    };
    assert_eq!(status(&[&program, "-o", &out]), (0, String::new()));
    assert!(fs::read_to_string(&out).unwrap().contains("3 blocks"));
    // refused: the picture shows the program up to the refused block
    let (code, said) = status(&[&refused, "-o", &out, "--control", "linuxcnc"]);
    assert!(code == 1 && said.contains("G123"), "{said}");
    assert!(fs::read_to_string(&out).unwrap().contains("refused at line 3"));
    fs::remove_file(&out).unwrap();
    for (arguments, code, says) in [
        (vec![program.as_str(), "-o", "picture.png"], 2, "end the name in .svg or .html"),
        (vec!["samples/bracket/job.json", "-o", &out], 2, "no form is given to print it"),
        (vec!["no-such.nc", "-o", &out], 2, "can't read no-such.nc"),
        (vec!["tests/cmd/wrong-tool.json", "--form", "postforms/fanuc.pf", "-o", &out], 1, "tool 7"),
        (vec!["samples/bracket/job.json", "--form", "postforms/grbl.pf", "-o", &out], 1, "cutter compensation"),
        (vec![program.as_str(), "--width", "10", "-o", &out], 2, "240"),
    ] {
        let (is, said) = status(&arguments);
        assert!(is == code && said.contains(says), "{arguments:?}: {is} {said}");
        assert!(!fs::exists(&out).unwrap(), "{arguments:?}: nothing is left");
    }
    let own = written("own.svg", "G0 X0\nM2\n");
    let (code, said) = status(&[&own, "--from", "nc", "-o", &own]);
    assert!(code == 2 && said.contains("is an input"), "{said}");
}
