//! Measures rendering, and two lower limits of its time: reading the same JSON with serde, and printing with `write!`.
#![allow(missing_docs, clippy::unwrap_used)]

use std::fmt::Write;

use divan::Bencher;
use divan::counter::{BytesCount, ItemsCount};
use postform::internals::compile::compile;
use postform::internals::json::read_lines;
use postform::internals::number::{LetterFormat, quantise, write_number};
use postform::internals::render::{Options, Renderer};
use postform::internals::sema::{Checked, analyse};
use postform::internals::source::Source;

fn main() {
    divan::main();
}

const MOVES: usize = 100_000;

fn form() -> Checked {
    // without the header, the job is read only once, so that only the printing of moves is measured
    let text =
        include_str!("../postforms/linuxcnc.pf").replace("Property header yesno yes", "Property header yesno no");
    analyse(Source::from_text("linuxcnc.pf", text), Default::default(), &mut |_| Err("none".into()))
}

/// Coordinates as a CAM system writes them.
fn moves() -> Vec<[f64; 3]> {
    let mut state = 1u64;
    let mut next = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as f64 / f64::from(1 << 31)
    };
    (0..MOVES).map(|_| [next() * 200.0, next() * 200.0, -next() * 2.0].map(|v| (v * 1e4).round() / 1e4)).collect()
}

fn job() -> String {
    let mut text = String::from(
        "{\"start\":{\"program\":1,\"units\":\"mm\",\"tools\":[{\"number\":1}]}}\n\
         {\"operation\":{\"tool\":1,\"work\":54,\"spindle\":{\"speed\":9000,\"direction\":\"cw\"},\"feed\":1500}}\n{\"rapid\":[0,0,5]}\n",
    );
    for [x, y, z] in moves() {
        _ = writeln!(text, "{{\"line\":[{x},{y},{z}]}}");
    }
    text + "{\"end\":true}\n"
}

#[divan::bench]
fn render_json_lines(bencher: Bencher) {
    let (checked, job) = (form(), job());
    let program = compile(&checked.form);
    bencher.counter(ItemsCount::new(MOVES)).bench_local(|| {
        let mut renderer = Renderer::new(&program, Options::default());
        read_lines(job.as_bytes(), &mut renderer).unwrap();
        renderer.text().len()
    });
}

#[divan::bench]
fn floor_parse_with_serde(bencher: Bencher) {
    #[derive(serde::Deserialize)]
    struct Item {
        line: Option<[f64; 3]>,
    }
    let job = job();
    bencher.counter(ItemsCount::new(MOVES)).bench_local(|| {
        let items = job.lines().filter_map(|line| serde_json::from_str::<Item>(line).ok());
        items.filter_map(|item| item.line).map(|[x, y, z]| x + y + z).sum::<f64>()
    });
}

#[divan::bench]
fn floor_print_with_write(bencher: Bencher) {
    let moves = moves();
    bencher.counter(ItemsCount::new(MOVES)).bench_local(|| {
        let mut text = String::new();
        for [x, y, z] in &moves {
            _ = writeln!(text, "X{x:.4} Y{y:.4} Z{z:.4}");
        }
        text.len()
    });
}

#[divan::bench]
fn numbers(bencher: Bencher) {
    let format = LetterFormat::parse("->4.>4").unwrap();
    let moves = moves();
    bencher.counter(ItemsCount::new(MOVES * 3)).bench_local(|| {
        let mut out = Vec::with_capacity(MOVES * 40);
        for value in moves.iter().flatten() {
            _ = write_number(&mut out, quantise(*value, 4).unwrap_or(0), &format, false);
        }
        out.len()
    });
}

#[divan::bench]
fn read_check_and_compile_a_form(bencher: Bencher) {
    // a form of 300 lines: the maximum of 150 sequence lines, and formats, commands and comments
    let mut text = String::from(include_str!("../postforms/fanuc.pf"));
    let body = "G1 X[h] Y[v] Z[d] F[frate]\n".repeat(60);
    _ = write!(text, "BeginRow\n{body}End\n");
    while text.lines().count() < 300 {
        text += "# a comment as long as comments are in forms that people keep\n";
    }
    bencher.counter(BytesCount::of_str(&text)).bench_local(|| {
        let source = Source::from_text("form.pf", text.as_str());
        let checked = analyse(source, Default::default(), &mut |_| Err("none".into()));
        assert!(!checked.has_errors());
        compile(&checked.form).ops.len()
    });
}

#[divan::bench]
fn scan_a_program(bencher: Bencher) {
    let mut text = String::new();
    for [x, y, z] in moves() {
        _ = writeln!(text, "N10 G1 X{x} Y{y} Z{z} F100. (a comment)");
    }
    bencher.counter(BytesCount::of_str(&text)).bench_local(|| {
        let lines = text.as_bytes().split_inclusive(|&byte| byte == b'\n');
        lines.map(|line| postform::internals::nc::tokens(line).count()).sum::<usize>()
    });
}
