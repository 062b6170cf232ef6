//! Random programs in the simulator and in LinuxCNC's interpreter, if it is installed: both must make the same motions,
//! or refuse the same block.

use crate::support::control;
use std::path::Path;

use crate::support::nc::{self, difference, interpreted, simulated};
use postform::internals::nc::RunSettings;

/// A random generator with a seed, so that a failing program can be made again from its number.
struct Random(u64);

impl Random {
    fn below(&mut self, limit: u64) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % limit
    }

    fn length(&mut self) -> String {
        format!("{:.3}", self.below(40_000) as f64 / 1000.0 - 20.0)
    }

    fn pick<'a>(&mut self, list: &[&'a str]) -> &'a str {
        list[self.below(list.len() as u64) as usize]
    }
}

fn program(number: u64) -> String {
    let mut random = Random(number * 7919 + 13);
    let mut text = String::from("G21 G17 G90 G40 G49 G80 F200 S1000\nG0 X1 Y2 Z3\n");
    // the interpreter has faults if a program has a shift and a rotation, or a change of units and a dynamic tool
    // offset
    let (shifts, units) = (random.below(2) == 0, random.below(2) == 0);
    for line in 0..random.below(14) + 3 {
        let mut words: Vec<String> = Vec::new();
        match random.below(20) {
            0 => words.push(random.pick(&["G91", "G90"]).into()),
            1 => words.push(random.pick(&["G17", "G18", "G19"]).into()),
            2 if !units => words.push("G91".into()),
            5 if shifts => words.push(format!("G10 L2 P1 X{}", random.length())),
            3 | 6 if !shifts => words.push("G4 P1".into()),
            9 if units => words.push("G49".into()),
            2 => words.push(random.pick(&["G20", "G21"]).into()),
            3 => words.push(format!("G92 X{} Z{}", random.length(), random.length())),
            4 => words.push(random.pick(&["G92.1", "G92.2", "G92.3", "G54", "G55", "G59.1"]).into()),
            5 => words.push(format!("G10 L2 P{} X{} R{}", random.below(3) + 1, random.length(), random.below(90))),
            6 => words.push(format!("G52 X{} Y{}", random.length(), random.length())),
            7 => words.push(format!("G53 G0 X{} Z{}", random.length(), random.length())),
            8 => words.push(random.pick(&["G28", "G28 Z1", "G30 X0 Y1", "G28.1", "G30.1"]).into()),
            9 => words.push(format!("G43.1 Z{}", random.length())),
            10 => words
                .push(random.pick(&["G49", "G7", "G8", "G93", "G94 F100", "G95 F2", "M3", "M4", "M5", "G80"]).into()),
            11 => words.push(format!("#{} = [{} * 2 + 1]", random.below(3) + 1, random.length())),
            12 => words.push(format!("G1 X#1 Y[#2 / 4] F{}", random.below(300) + 1)),
            13 => words.push(format!("@{} ^{}", random.below(20), random.below(360))),
            14 => words.push(format!(
                "o{line} repeat [{}]\nG1 Z[{} / 10]\no{line} endrepeat",
                random.below(4),
                random.length()
            )),
            15 => words.push(format!(
                "o{line} if [#1 {} {}]\nG0 X{}\no{line} else\nG1 Y{}\no{line} endif",
                random.pick(&["GT", "LT", "EQ", "NE", "GE", "LE"]),
                random.below(10),
                random.length(),
                random.length()
            )),
            16 => {
                let radius = random.below(9000) as f64 / 1000.0 + 0.5;
                let sign = random.pick(&["", "-"]);
                words.push(format!(
                    "{} X{} Y{} R{sign}{radius}",
                    random.pick(&["G2", "G3"]),
                    random.length(),
                    random.length()
                ));
            }
            17 => {
                // half circles and full circles; the centre of a half circle is in the plane, so that the radii agree
                let (i, j) = (random.below(9) + 1, random.below(9));
                let word = random.pick(&["G2", "G3"]);
                let end = random.pick(&["", "X[#5420 + 2 * I] ", "P2 "]).replace('I', &i.to_string());
                words
                    .push(format!("{word} {end}I{i} {}", if end.is_empty() { format!("J{j}") } else { String::new() }));
            }
            _ => {
                words.push(random.pick(&["G0", "G1", "", "G1", "G0"]).into());
                for axis in ["X", "Y", "Z", "A"] {
                    if random.below(3) == 0 {
                        words.push(format!("{axis}{}", random.length()));
                    }
                }
            }
        }
        text += words.join(" ").trim();
        text.push('\n');
    }
    text + "M2\n"
}

#[test_with::executable(rs274)]
#[test]
fn random_programs_run_as_in_the_interpreter() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let count = std::env::var("RANDOM_PROGRAMS").ok().and_then(|n| n.parse().ok()).unwrap_or(150);
    let (mut refused, mut run, mut wrong) = (0, 0, Vec::new());
    for number in 0..count {
        let text = program(number);
        let path = folder.join("random.ngc");
        // the parameters are reset, so that values of earlier programs have no effect
        let parameters = folder.join("random.var");
        let arguments = ["-v".as_ref(), parameters.as_os_str(), "-g".as_ref(), path.as_os_str()];
        let output = nc::rs274(&[(&path, &text), (&parameters, PARAMETERS)], &arguments);
        let canon = String::from_utf8_lossy(&output.stdout).into_owned();
        let (calls, ended, _) = simulated(text.as_bytes(), RunSettings::new(control("linuxcnc")));
        let theirs = interpreted(&canon);
        let ended_well = canon.contains("PROGRAM_END");
        if ended_well != ended.is_ok() {
            let error = String::from_utf8_lossy(&output.stderr).into_owned();
            wrong.push(format!("{number}: ours ended {ended:?}, theirs: {error}\n{text}"));
        } else if let Some(difference) = difference(&calls, &theirs) {
            wrong.push(format!("{number}: {difference}\n{text}"));
        }
        if ended_well { run += 1 } else { refused += 1 }
    }
    assert!(wrong.is_empty(), "{} of {count}\n{}", wrong.len(), wrong.join("\n"));
    assert!(run > 0 && refused > 0, "{run} programs run, {refused} refused");
}

/// Parameters that the interpreter requires in its file, all zero.
const PARAMETERS: &str = "5161 0\n5162 0\n5163 0\n5164 0\n5165 0\n5166 0\n5181 0\n5182 0\n5183 0\n5184 0\n5185 0\n5186 0\n\
5210 0\n5211 0\n5212 0\n5213 0\n5214 0\n5215 0\n5216 0\n5220 1\n5221 0\n5222 0\n5223 0\n5224 0\n5225 0\n5226 0\n5230 0\n\
5241 0\n5242 0\n5243 0\n5244 0\n5245 0\n5246 0\n5250 0\n5261 0\n5262 0\n5263 0\n5264 0\n5265 0\n5266 0\n5270 0\n\
5281 0\n5282 0\n5283 0\n5284 0\n5285 0\n5286 0\n5290 0\n5301 0\n5302 0\n5303 0\n5304 0\n5305 0\n5306 0\n5310 0\n\
5321 0\n5322 0\n5323 0\n5324 0\n5325 0\n5326 0\n5330 0\n5341 0\n5342 0\n5343 0\n5344 0\n5345 0\n5346 0\n5350 0\n\
5361 0\n5362 0\n5363 0\n5364 0\n5365 0\n5366 0\n5370 0\n5381 0\n5382 0\n5383 0\n5384 0\n5385 0\n5386 0\n5390 0\n";
