//! Makes jobs of any size, and measures lower limits for the time of rendering them. `benches/throughput` and
//! `benches/compare` use this program.
//!
//! `floor make moves|holes N` writes a JSON Lines job to standard output. `floor make cl N` writes the same moves as a
//! CL file. `floor make nc N` and `floor make nc-holes N` write programs for LinuxCNC. `floor serde FILE` parses a job
//! with serde and discards the result. `floor naive FILE` prints the cuts of a job as a simple post does.
#![allow(clippy::unwrap_used)]

use std::fmt::Write as _;
use std::fs::File;
use std::io::{BufRead, BufReader, BufWriter, Result, Write, stdout};

fn main() -> Result<()> {
    let arguments: Vec<String> = std::env::args().collect();
    let words: Vec<&str> = arguments.iter().skip(1).map(String::as_str).collect();
    match words.as_slice() {
        ["make", kind, count] => make(kind, count.parse().unwrap()),
        ["serde", file] => serde(file),
        ["naive", file] => naive(file),
        _ => {
            eprintln!("floor make moves|holes|cl|nc|nc-holes N, floor serde FILE, floor naive FILE");
            std::process::exit(2);
        }
    }
}

fn make(kind: &str, count: u64) -> Result<()> {
    let mut out = BufWriter::new(stdout().lock());
    match kind {
        "cl" => return make_cl(count, &mut out),
        "nc" | "nc-holes" => return make_nc(kind == "nc-holes", count, &mut out),
        _ => {}
    }
    writeln!(out, "{{\"start\":{{\"postform\":1,\"program\":1,\"units\":\"mm\",\"tools\":[{{\"number\":1}}]}}}}")?;
    writeln!(
        out,
        "{{\"operation\":{{\"tool\":1,\"work\":54,\"spindle\":{{\"speed\":9000,\"direction\":\"cw\"}},\"feed\":1500}}}}"
    )?;
    let mut next = numbers();
    if kind == "holes" {
        writeln!(out, "{{\"cycle\":{{\"kind\":\"drill\",\"depth\":5,\"clear\":2,\"feed\":200}}}}")?;
        for _ in 0..count {
            writeln!(out, "{{\"point\":[{},{},0]}}", next(200.0), next(200.0))?;
        }
        writeln!(out, "{{\"cycle_end\":true}}")?;
    } else {
        writeln!(out, "{{\"rapid\":[0,0,5]}}")?;
        for i in 0..count {
            let (x, y, z) = (next(200.0), next(200.0), -next(2.0));
            let feed = if i % 50 == 0 { format!(",\"feed\":{}", 500 + i % 2000) } else { String::new() };
            writeln!(out, "{{\"line\":[{x},{y},{z}]{feed}}}")?;
        }
    }
    writeln!(out, "{{\"end\":true}}")
}

/// A program of straight cuts, or of holes of one G81.
fn make_nc(holes: bool, count: u64, out: &mut impl Write) -> Result<()> {
    let mut next = numbers();
    writeln!(out, "G21 G17 G90 G94 F1500\nS9000 M3\nG0 X0 Y0 Z5")?;
    if holes {
        writeln!(out, "G99 G81 X0 Y0 Z-5 R2 F200")?;
    }
    for _ in 0..count {
        match holes {
            true => writeln!(out, "X{} Y{}", next(200.0), next(200.0))?,
            false => writeln!(out, "G1 X{} Y{} Z{}", next(200.0), next(200.0), -next(2.0))?,
        }
    }
    writeln!(out, "G80\nM2")
}

/// Random numbers from 0 to a range; they are the same in every run.
fn numbers() -> impl FnMut(f64) -> f64 {
    let mut state = 1u64;
    move |range| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((state >> 33) as f64 / f64::from(1u32 << 31) * range * 1e4).round() / 1e4
    }
}

/// Writes the moves of `make moves` as a CL file.
fn make_cl(count: u64, out: &mut impl Write) -> Result<()> {
    writeln!(out, "UNITS/MM\nLOADTL/1\nSPINDL/9000,RPM,CLW\nRAPID\nGOTO/0,0,5\nFEDRAT/1500,MMPM")?;
    let mut next = numbers();
    for i in 0..count {
        let (x, y, z) = (next(200.0), next(200.0), -next(2.0));
        if i % 50 == 0 {
            writeln!(out, "FEDRAT/{},MMPM", 500 + i % 2000)?;
        }
        writeln!(out, "GOTO/{x:.4},{y:.4},{z:.4}")?;
    }
    writeln!(out, "FINI")
}

#[derive(serde::Deserialize)]
struct Item {
    line: Option<[f64; 3]>,
    point: Option<[f64; 3]>,
    feed: Option<f64>,
}

fn serde(file: &str) -> Result<()> {
    let mut sum = 0.0;
    each_line(file, |line| {
        if let Ok(item) = serde_json::from_slice::<Item>(line) {
            let [x, y, z] = item.line.or(item.point).unwrap_or_default();
            sum += x + y + z + item.feed.unwrap_or(0.0);
        }
        Ok(())
    })?;
    println!("{sum}");
    Ok(())
}

/// A simple post. The standard library parses and prints the numbers. A word is left out if its letter already has this
/// number.
fn naive(file: &str) -> Result<()> {
    let mut out = BufWriter::with_capacity(64 * 1024, stdout().lock());
    let (mut last, mut text) = ([f64::NAN; 4], String::new());
    let (mut feed, mut begin) = (1500.0, "G1");
    each_line(file, |line| {
        let Some(rest) = std::str::from_utf8(line).unwrap().strip_prefix("{\"line\":[") else { return Ok(()) };
        let (to, rest) = rest.split_once(']').unwrap();
        if let Some(text) = rest.strip_prefix(",\"feed\":") {
            feed = text.trim_end().trim_end_matches('}').parse().unwrap();
        }
        let values = to.split(',').map(|value| value.parse::<f64>().unwrap()).chain([feed]);
        let mut blank = std::mem::take(&mut begin);
        for ((letter, last), value) in "XYZF".chars().zip(&mut last).zip(values) {
            if *last == value {
                continue;
            }
            *last = value;
            text.clear();
            write!(text, "{}", (value * 1e4).round() / 1e4).unwrap();
            let (sign, digits) = text.strip_prefix('-').map_or(("", text.as_str()), |digits| ("-", digits));
            let digits = digits.strip_prefix("0").filter(|rest| !rest.is_empty()).unwrap_or(digits);
            let sign = if digits == "0" { "" } else { sign };
            let point = if digits.contains('.') || digits == "0" { "" } else { "." };
            let space = if blank == "G1" { " " } else { "" };
            write!(out, "{blank}{space}{letter}{sign}{digits}{point}")?;
            blank = " ";
        }
        writeln!(out)
    })
}

fn each_line(file: &str, mut f: impl FnMut(&[u8]) -> Result<()>) -> Result<()> {
    let mut input = BufReader::with_capacity(256 * 1024, File::open(file)?);
    let mut line = Vec::new();
    while input.read_until(b'\n', &mut line)? > 0 {
        f(&line)?;
        line.clear();
    }
    Ok(())
}
