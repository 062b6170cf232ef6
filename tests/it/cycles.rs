//! Worked examples of CYCLE statements: if a CL file is printed as single moves, the program must make the expected
//! motions. Coordinates must agree to the last printed decimal. A rapid may be printed in two parts, up first or down
//! last.

use crate::support;
use std::fs;

use postform::internals::cl::{Options as ClOptions, Report, read_cl};
use postform::internals::compile::compile;
use postform::internals::render::{Cycles, Options, Renderer};
use postform::toolpath::{ReadError, Units};
use serde_json::Value;

/// A form that prints numbers with six decimals, and each code of a cycle in a separate block.
fn form(config: &Value, units: Units) -> String {
    let number = |name: &str, metric: f64, inch: f64| {
        config.get(name).and_then(Value::as_f64).unwrap_or(if units == Units::Mm { metric } else { inch })
    };
    let second = |name: &str, metric: f64| {
        config.get("clear2").and_then(|c| c.get(name)).and_then(Value::as_f64).unwrap_or(metric)
    };
    format!(
        "Units {}\nX->5.6\nY->5.6\nZ->5.6\nF >6.6\nP >5.6\nR->4.6\nCycleClear {}\nCycleStep {}\nCycleBack deep {}\nCycleBack chipbreak {}\nCycleBack thru {}\n\
         CycleDwell 0.5\nCycleJog 0.5\nStartCode\n%0\nG[unitmode]\nEnd\n1stToolChange\nT[tool] M6\nS[speed] M[direct]\nEnd\n\
         ToolChange\nT[tool] M6\nEnd\nEndCode\nM30\nEnd\n",
        if units == Units::Mm { "mm" } else { "inch" },
        number("clear", 3.0, 0.1),
        number("step", 5.0, 0.2),
        second("DEEP", 1.0),
        second("BRKCHP", 0.5),
        second("THRU", 1.0),
    )
}

/// An action of a program, read from its blocks.
#[derive(Clone, Debug, PartialEq)]
enum Motion {
    Rapid([f64; 3]),
    Feed([f64; 3], f64),
    Dwell(f64),
    Code(String),
}

fn motions(program: &str, start: [f64; 3], inches: bool) -> Vec<Motion> {
    let (mut at, mut feed, mut rapid) = (start, 0.0, true);
    let mut list = Vec::new();
    let mut begun = false;
    for line in program.lines() {
        let words: Vec<(char, f64)> =
            line.split_whitespace().filter_map(|word| Some((word.chars().next()?, word[1..].parse().ok()?))).collect();
        let has = |letter: char, value: f64| words.contains(&(letter, value));
        if has('G', 4.0) {
            list.push(Motion::Dwell(words.iter().find(|w| w.0 == 'P').unwrap().1));
            continue;
        }
        if let Some((_, code)) = words.iter().find(|w| w.0 == 'M') {
            match code {
                3.0 if !begun => begun = true,
                0.0 => list.push(Motion::Code("stop".into())),
                3.0 => list.push(Motion::Code("CLW".into())),
                4.0 => list.push(Motion::Code("CCLW".into())),
                5.0 => list.push(Motion::Code("STOP".into())),
                19.0 => list.push(Motion::Code(format!("orient {}", words.last().unwrap().1))),
                _ => {}
            }
            continue;
        }
        if has('G', 0.0) || has('G', 1.0) {
            rapid = has('G', 0.0);
        }
        let moves = words.iter().any(|w| "XYZ".contains(w.0));
        for (letter, value) in &words {
            match letter {
                'X' => at[0] = *value,
                'Y' => at[1] = *value,
                'Z' => at[2] = *value,
                'F' => feed = *value * if inches { 25.4 } else { 1.0 },
                _ => {}
            }
        }
        if moves {
            list.push(if rapid { Motion::Rapid(at) } else { Motion::Feed(at, feed) });
        }
    }
    list
}

fn expected(list: &Value) -> Vec<Motion> {
    let number = |v: &Value, i: usize| v[i].as_f64().unwrap();
    let point = |v: &Value| [number(v, 1), number(v, 2), number(v, 3)];
    list.as_array()
        .unwrap()
        .iter()
        .map(|motion| match motion[0].as_str().unwrap() {
            "rapid" => Motion::Rapid(point(motion)),
            "feed" => Motion::Feed(point(motion), number(motion, 4)),
            "dwell" => Motion::Dwell(number(motion, 1)),
            "spindle" => Motion::Code(motion[1].as_str().unwrap().into()),
            "orient" => Motion::Code(format!("orient {}", number(motion, 1))),
            "stop" => Motion::Code("stop".into()),
            other => panic!("{other}"),
        })
        .collect()
}

fn near(a: &[f64; 3], b: &[f64; 3]) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 1.1e-6)
}

/// Compares the motions. A rapid may have two parts. The first part is only in Z, or only in X and Y. A rapid to the
/// current position is not printed.
fn agree(id: &str, mut at: [f64; 3], expected: &[Motion], printed: &[Motion]) {
    // after a stop, the spindle is started again before the tool moves across; the examples leave this to the post
    let stop = printed.iter().position(|motion| *motion == Motion::Code("stop".into())).unwrap_or(printed.len());
    let turns_again = |motion: &Motion| *motion == Motion::Code("CLW".into());
    let mut printed = printed.iter().enumerate().filter(|(i, motion)| *i < stop || !turns_again(motion)).map(|m| m.1);
    for motion in expected {
        if let Motion::Rapid(to) = motion {
            while !near(&at, to) {
                let next = printed.next();
                let Some(Motion::Rapid(part)) = next else {
                    panic!("{id}: {next:?} instead of {motion:?} from {at:?}")
                };
                let lifts = near(&[at[0], at[1], to[2]], part) && to[2] > at[2];
                let crosses = near(&[to[0], to[1], at[2]], part);
                assert!(near(part, to) || lifts || crosses, "{id}: {part:?} on the way from {at:?} to {to:?}");
                at = *part;
            }
            continue;
        }
        let next = printed.next().unwrap_or_else(|| panic!("{id}: {motion:?} is missing"));
        match (motion, next) {
            (Motion::Feed(to, feed), Motion::Feed(found, found_feed)) => {
                assert!(near(to, found) && (feed - found_feed).abs() < 2e-5, "{id}: {next:?} instead of {motion:?}");
                at = *to;
            }
            _ => assert_eq!(motion, next, "{id}"),
        }
    }
    assert_eq!(printed.next(), None, "{id}");
}

#[test]
fn worked_examples_agree() {
    let text = fs::read_to_string(support::root().join("tests/data/cycles.json")).unwrap();
    let examples: Vec<Value> = serde_json::from_str(&text).unwrap();
    assert!(examples.len() >= 52);
    for example in &examples {
        let id = example["id"].as_str().unwrap();
        let setup = &example["setup"];
        if setup["config"].get("rigid_available").is_some() {
            continue; // single moves can't make this cycle; a test in the planner covers it
        }
        let inches = setup["units"] == "IN";
        let units = if inches { Units::Inch } else { Units::Mm };
        let start: Vec<f64> = setup["start"].as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect();
        let mut cl = format!("LOADTL/1\nSPINDL/{},RPM,{}\n", setup["rpm"], setup["spindle"].as_str().unwrap());
        cl += &format!("RAPID\nGOTO/{},{},{}\n", start[0], start[1], start[2]);
        for line in example["cl"].as_array().unwrap() {
            cl += line.as_str().unwrap();
            cl.push('\n');
        }
        cl += "FINI\n";
        let checked = support::check(&form(&setup["config"], units));
        assert!(!checked.has_errors(), "{:?}", checked.diags);
        let program = compile(&checked.form);
        let sink_as_printed = setup["config"].get("csink").is_some();
        let options = Options { cycles: Cycles::Emulated, sink_as_printed, ..Options::default() };
        let mut renderer = Renderer::new(&program, options);
        let mut report = Report::default();
        let read = read_cl(
            cl.as_bytes(),
            &ClOptions { units: Some(units), ..ClOptions::default() },
            &mut report,
            &mut renderer,
        );
        let error = example["motions"].as_array().unwrap().iter().find(|motion| motion[0] == "ERROR");
        match (read, error) {
            (Err(ReadError::Job(diag)), Some(error)) => {
                assert_eq!(diag.code.key(), error[1].as_str().unwrap(), "{id}: {diag:?}");
            }
            (Ok(()), None) => {
                let at = [start[0], start[1], start[2]];
                let printed = motions(std::str::from_utf8(renderer.text()).unwrap(), at, inches);
                assert_eq!(printed[0], Motion::Rapid(at), "{id}");
                agree(id, at, &expected(&example["motions"]), &printed[1..]);
                for message in example["messages"].as_array().unwrap() {
                    let key = message[1].as_str().unwrap();
                    assert!(
                        report.warnings.iter().any(|w| w.code.key() == key),
                        "{id}: no {key} in {:?}",
                        report.warnings
                    );
                }
            }
            (read, error) => panic!("{id}: {read:?}, expected {error:?}\n{cl}"),
        }
    }
}

/// Every wrong combination of options has a named error or warning.
#[test]
fn wrong_combinations_have_names() {
    let cases = [
        ("WIGGLE,DEPTH,1,MMPM,5", "type.unknown"),
        ("DRILL,MMPM,5", "depth.missing"),
        ("DRILL,DEPTH,-2,MMPM,5,CLEAR,1", "depth.above_clear"),
        ("DEEP,DEPTH,2,1,MMPM,5", "depth.order"),
        ("DRILL,DEPTH,1", "feed.missing"),
        ("DRILL,DEPTH,1,MMPM,0", "feed.nonpositive"),
        ("TAP,FLOAT,DEPTH,1,MMPM,5,RATIO,0", "feed.nonpositive"),
        ("REAM,DEPTH,1,MMPM,5,RATIO,0", "feed.nonpositive"),
        ("DRILL,DEPTH,1,MMPM,5,MMPM,6", "feed.multiple"),
        ("DRILL,DEPTH,1,TPI,20", "feed.tpi_only_tap"),
        ("DRILL,DEPTH,1,MMPM,5,CLEAR,2,1", "clear2.not_allowed"),
        ("DEEP,DEPTH,1,STEP,.5,MMPM,5,CLEAR,2,1,BACK,1", "clear2.twice"),
        ("BORE,DEPTH,1,MMPM,5,CLEAR,2,1,ORIENT,OFSETL,1", "clear2.twice"),
        ("BORE,BACK,DEPTH,1,MMPM,5", "rapto.required"),
        ("DRILL,DEPTH,1,MMPM,5,CLEAR,1,RAPTO,3", "rapto.beyond_depth"),
        ("DEEP,DEPTH,9,STEP,1,MMPM,5,CLEAR,1,RAPTO,4", "rapto.beyond_depth"),
        ("BORE,BACK,DEPTH,40,MMPM,5,RAPTO,32", "back.depth_below_rapto"),
        ("BORE,DEPTH,1,MMPM,5,OFSETL,.1", "bore.jog_without_orient"),
        ("TAP,FLOAT,DEPTH,1,MMPM,5,NOREVR,RAPOUT", "option.exclusive"),
        ("TAP,FLOAT,RIGID,DEPTH,1,MMPM,5", "option.exclusive"),
        ("FACE,DEPTH,1,MMPM,5,DWELL,1,REV,2", "option.exclusive"),
        ("DRILL,DEPTH,1,MMPM,5,STEP,1", "option.not_allowed"),
        ("MANUAL,DEPTH,1", "option.not_allowed"),
        ("CSINK,DIAMET,1,TLANGL,90,DEPTH,1,MMPM,5", "option.not_allowed"),
        ("DEEP,DEPTH,1,STEP,1,MMPM,5,TIMES,2", "option.not_allowed"),
        ("TAP,DEEP,RIGID,DEPTH,1,STEP,1,MMPM,5,TIMES,2", "option.not_allowed"),
        ("DRILL,DEPHT,1,MMPM,5", "option.unknown"),
        ("DRILL,DEPTH,1,MMPM,5,CLEAR,1,CLEAR,2", "option.duplicate"),
        ("TAP,FLOAT,DEPTH,1,MMPM,5,MULTRD,2", "multrd.rigid_only"),
        ("TAP,RIGID,DEPTH,1,MMPM,5", "rigid.unavailable"),
        ("TAP,DEEP,DEPTH,3,STEP,1,MMPM,5", "rigid.unavailable"),
        ("TAP,DEEP,DEPTH,3,STEP,1,MMPM,5,NOREVR", "option.exclusive"),
        ("THRU,DEPTH,1,2,MMPM,5", "thru.pairs"),
        ("THRU,DEPTH,1,3,2,MMPM,5", "thru.order"),
        ("CSINK,TLANGL,82,MMPM,5", "csink.diamet_missing"),
        ("CSINK,DIAMET,8,MMPM,5", "csink.tlangl_missing"),
        ("CSINK,DIAMET,8,TLANGL,180,MMPM,5", "csink.angle_range"),
        ("CSINK,DIAMET,8,TLANGL,90,HOLDIA,8,MMPM,5", "csink.holdia"),
        ("DEEP,DEPTH,1,STEP,0,MMPM,5", "step.nonpositive"),
        ("DEEP,DEPTH,20,STEP,6,MMPM,5,DECR,2", "decr.exhausted"),
        ("DEEP,DEPTH,1,2,MMPM,5,DECR,.1", "decr.absolute"),
        ("DEEP,DEPTH,20,MMPM,5,DECR,.1", "decr.absolute"),
        ("DEEP,DEPTH,1,2,STEP,1,MMPM,5", "format.mixed"),
        ("DRILL,1,2,5,MMPM", "format.positional"),
        ("DRILL,DEPTH,MMPM,5", "value.missing"),
        ("DRILL,DEPTH,1,2,MMPM,5", "value.count"),
        ("DRILL,DEPTH,1,MMPM,5,RAPTO,1,2", "value.count"),
        ("DRILL,DEPTH,1,MMPM,5,RAPTO,-1", "value.sign"),
        ("BRKCHP,DEPTH,1,STEP,.5,MMPM,5,TIMES,1.5", "value.integer"),
        ("TAP,RIGID,DEPTH,1,MMPM,5,MULTRD,1.5", "value.integer"),
        ("ON", "on.no_previous"),
        ("AUTO", "auto.syntax"),
        ("RETURN,MAYBE", "return.syntax"),
    ];
    let warned = [
        ("DRILL,DEPTH,1,MMPM,5,CLEAR,2,,", "null_parameter"),
        ("CSINK,DIAMET,8,TLANGL,100,MMPM,5", "csink.printed"),
        ("DRILL,DEPTH,1,MMPM,5,CLEAR,2,RETURN,1", "return.below_clear"),
        ("TAP,FLOAT,DEPTH,1,MMPM,5,INVERS", "tap.direction"),
        ("DEEP,DEPTH,1,STEP,1,MMPM,5,MINSTP,1", "minstp.unused"),
        ("TAP,FLOAT,DEPTH,1,MMPM,5,RAPOUT,RATIO,2", "ratio.unused"),
    ];
    let read = |statement: &str| {
        let checked = support::check(&form(&Value::Null, Units::Mm));
        let program = compile(&checked.form);
        let options = Options { cycles: Cycles::Emulated, sink_as_printed: true, ..Options::default() };
        let (mut renderer, mut report) = (Renderer::new(&program, options), Report::default());
        let head = "UNITS/MM\nLOADTL/1\nSPINDL/1000,CLW\nRAPID\nGOTO/0,0,100\n";
        let text = format!("{head}CYCLE/{statement}\nGOTO/0,0,0\nCYCLE/OFF\nFINI\n");
        let read = read_cl(text.as_bytes(), &ClOptions::default(), &mut report, &mut renderer);
        let mut keys: Vec<&str> = report.warnings.iter().chain(renderer.notes()).map(|diag| diag.code.key()).collect();
        if let Err(ReadError::Job(diag)) = &read {
            assert_eq!(diag.place.as_ref().and_then(|place| place.line).map(|line| line == 6 || line == 7), Some(true));
            keys = vec![diag.code.key()];
        }
        (read.is_err(), keys.iter().map(ToString::to_string).collect::<Vec<_>>())
    };
    for (statement, key) in cases {
        assert_eq!(read(statement), (true, vec![format!("cycle.{key}")]), "{statement}");
    }
    for (statement, key) in warned {
        let (failed, keys) = read(statement);
        assert!(!failed && keys.contains(&format!("cycle.{key}")), "{statement}: {keys:?}");
    }
}

/// ORIENT without an angle uses the angle that the form defines.
#[test]
fn orient_alone_is_the_forms_angle() {
    let text = "UNITS/MM\nLOADTL/1\nSPINDL/800,RPM,CLW\nRAPID\nGOTO/0,0,50\n\
        CYCLE/BORE,DEPTH,8,MMPM,100,CLEAR,3,ORIENT\nGOTO/10,10,0\nCYCLE/OFF\nFINI\n";
    let form = support::mill("Units mm\nCycleOrient 45", "").replace("%0\n", "%0\nG[unitmode]\n");
    let checked = support::check(&form);
    let rendered = support::render_kind(&checked, text.as_bytes(), support::Kind::Cl, Options::default()).unwrap();
    assert!(rendered.text.contains("M19 R45"), "{}", rendered.text);
}

/// F of a tap may be the spindle speed, as in the manual. It is printed unchanged.
#[test]
fn a_tap_that_prints_its_speed_stands() {
    let tap = "LTap\nG74 X[h] Y[v] Z[d] R[vclear] F[speed] Q[vbite]\nEnd Cancel";
    let path = r#"{"spindle":{"direction":"ccw"}},{"cycle":{"kind":"ltap","rigid":false,"depth":0.5,"clear":0.1,"feed":5,"points":[[1,1,0]]}}"#;
    let lines = crate::support::path_lines("", tap, path);
    assert!(lines.iter().any(|line| line.starts_with("G74 X1. Y1. Z-.5 R.1 F1000.")), "{lines:?}");
}
