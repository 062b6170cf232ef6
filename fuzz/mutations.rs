//! Random mutations of the forms that ship, by the million: each mutated form is read and linted, and every eighth is
//! also fixed and formatted.
//!
//! Run `mutations COUNT SEED`. After a panic, the seed of the mutation is printed. `mutations 1 SEED` makes this
//! mutation again.

use std::fs;
use std::time::Instant;

#[path = "look.rs"]
mod look;

use look::look;
use postform_fuzz::random::Random;

/// Pieces of forms that also have a meaning at a wrong position.
const PIECES: &[&str] = &[
    "End",
    "End Cancel",
    "Cancel",
    "Drill",
    "Upon [work]",
    "None",
    "\n",
    "\r\n",
    "  ",
    "\t",
    " ",
    "#",
    "# postform: allow PF101",
    "(",
    ")",
    "[",
    "]",
    "<h>",
    "X[h]",
    "G0",
    "G91",
    "G28",
    "G81",
    "%0",
    "X->3.>4",
    "P->34",
    "Call x.pf",
    ";",
    ";\"a\"",
    "Comment; # #",
    "Custom1   Face\tmill",
    "@if [val1] = 1",
    "@elif not [toolname] like \"M*\"",
    "@else",
    "@end",
    "@for tool",
    "@for work",
    "@set val2 = [h]+2",
    "[max(d, vclear-1)]",
    "[round(h*2)/3]",
    "[toolname]",
    "`FMAX `` `",
    "`",
    "\"",
    "Property p choice(a,b) a Which",
    "CoolantKind through M88 M89",
    "Sequence#s N 10 10",
    "é",
    "\u{0}",
    "\u{feff}",
];

fn mutated(forms: &[Vec<u8>], random: &mut Random) -> Vec<u8> {
    let mut form = forms[random.below(forms.len())].clone();
    for _ in 0..=random.below(6) {
        let at = random.below(form.len() + 1);
        match random.below(7) {
            0 if at < form.len() => _ = form.remove(at),
            1 => form.insert(at, random.number() as u8),
            2 => _ = form.splice(at..at, PIECES[random.below(PIECES.len())].bytes()),
            3 if at < form.len() => form[at] = random.number() as u8,
            4 => _ = form.drain(at..(at + random.below(60)).min(form.len())),
            5 => {
                // inserts a part of another form
                let other = &forms[random.below(forms.len())];
                let from = random.below(other.len());
                form.splice(at..at, other[from..(from + random.below(80)).min(other.len())].iter().copied());
            }
            _ => form.truncate(at.max(form.len() / 2)),
        }
    }
    form
}

fn main() {
    let mut args = std::env::args().skip(1).map(|arg| arg.parse().expect("a number"));
    let (count, first): (u64, u64) = (args.next().unwrap_or(1_000_000), args.next().unwrap_or(0));
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/..");
    let list = |folder: &str| fs::read_dir(format!("{root}/{folder}")).expect(folder).flatten().map(|e| e.path());
    let mut paths: Vec<_> = list("postforms").chain(list("samples").map(|folder| folder.join("form.pf"))).collect();
    paths.sort();
    let forms: Vec<Vec<u8>> = paths.iter().filter_map(|path| fs::read(path).ok()).collect();
    assert!(forms.len() > 40, "the forms that ship");
    let start = Instant::now();
    for seed in first..first + count {
        let bytes = mutated(&forms, &mut Random::new(seed));
        let panicked = std::panic::catch_unwind(|| look(&bytes, seed % 8 == 0)).is_err();
        if panicked {
            eprintln!("mutation {seed}:\n{}", String::from_utf8_lossy(&bytes));
            std::process::exit(1);
        }
        if seed % 500_000 == 499_999 {
            println!("{} mutations, {:.0} s", seed + 1 - first, start.elapsed().as_secs_f64());
        }
    }
    println!("{count} mutations of {} forms, no panic, {:.0} s", forms.len(), start.elapsed().as_secs_f64());
}
