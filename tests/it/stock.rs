//! Rapids through the stock, `verify --stock`: examples, and random programs with a judge that moves the tool in small
//! steps.

use std::fmt::Write as _;
use std::io::Cursor;

use crate::support::control;
use crate::support::folder::Folder;
use crate::support::root;
use postform::internals::nc::{RunSettings, Unpointed};
use postform::internals::preflight::{JobTool, Stock, StockCheck, check_stock};
use postform::toolpath::Units;
use proptest::prelude::*;

const HEAD: &str = "G21 G90 G94 G17 G40\nT1 M6\nG54 G0 X-20 Y0 S1000 M3\nG43 H1 Z50\n";

fn tools() -> Vec<JobTool> {
    let tool = |number, diameter, corner_radius| JobTool { number, name: None, diameter, corner_radius };
    vec![
        tool(1, Some(10.0), None),
        tool(2, Some(6.0), Some(3.0)),
        tool(3, None, None),
        tool(4, Some(0.4), None),
        tool(5, Some(10.0), Some(2.0)),
        tool(6, Some(0.55), None),
        tool(7, Some(2.1), None),
    ]
}

fn checked(program: &str, stock: &str) -> StockCheck {
    let settings = RunSettings { unpointed: Unpointed::Whole, ..RunSettings::new(control("haas")) };
    let block: Stock = stock.parse().unwrap();
    check_stock(Cursor::new(program), settings, &block, &tools(), Units::Mm).unwrap()
}

/// The findings of a program as `LINE MESSAGE`, then everything that is not checked. The program follows the usual
/// head, so its first line is line 5.
fn found(program: &str, stock: &str) -> Vec<String> {
    let checked = checked(&format!("{HEAD}{program}\nM30\n"), stock);
    let found = checked.findings.iter().map(|found| format!("{} {}", found.line, found.message));
    found.chain(checked.not_checked).collect()
}

const STOCK: &str = "X0..100 Y0..60 Z-20..0";

#[test]
fn a_rapid_is_a_finding_where_nothing_was_cut() {
    let at_depth = found("G0 Z-5\nX120", STOCK);
    assert_eq!(at_depth, ["6 T1 goes through the stock at rapid: 5 mm below its surface at X0.125 Y0.125"]);
    // over the top of the block, beside it, and under it
    let nothing: [&str; 0] = [];
    assert_eq!(found("G0 Z0.1\nX120", STOCK), nothing);
    assert_eq!(found("G0 Y-10 Z-5\nX120", STOCK), nothing);
    assert_eq!(found("G0 Z-15 X-20\nY30 Z-5\nG1 X120 F500\nG0 X-20", STOCK), nothing);
    // through the slot, and beside it
    assert_eq!(
        found("G0 Y30 Z-5\nG1 X120 F500\nG0 Y31\nX-20", STOCK),
        ["8 T1 goes through the stock at rapid: 5 mm below its surface at X0.125 Y35.125"]
    );
    // deeper than the slot
    let deeper = found("G0 Y30 Z-5\nG1 X120 F500\nG0 Z-6\nX-20", STOCK);
    assert_eq!(deeper, ["8 T1 goes through the stock at rapid: 1 mm below its surface at X0.125 Y25.375"]);
    // down into the block, from an unknown height
    let down = found("G28 G91 Z0\nG90 G0 X50 Y30\nZ-2", STOCK);
    assert_eq!(down.len(), 1, "{down:?}");
    assert!(down[0].starts_with("7 T1 goes through the stock at rapid: 2 mm"), "{down:?}");
}

#[test]
fn cycles_and_arcs_cut() {
    let nothing: [&str; 0] = [];
    assert_eq!(found("G0 X50 Y30 Z5\nG81 Z-20 R2 F100\nG80\nG0 Z-19\nZ5", STOCK), nothing);
    let ring = "G0 X-20 Y30\nZ-5\nG1 X30 F500\nG2 X30 Y30 I20 J0\nG0 X-20\n";
    assert_eq!(found(ring, STOCK), nothing);
    let across = found(&format!("{ring}G1 X30\nG0 X70"), STOCK);
    assert_eq!(across.len(), 1, "{across:?}");
}

/// After a change of the work offset, the unknown height may be in the stock. After G28 or G53, the unknown height is
/// not in the stock.
#[test]
fn an_unknown_height_after_a_work_offset_is_not_clean() {
    let low = found("G0 Y30\nZ-5\nG55\nG0 X120 Y50\nX-20\nZ50\nX0", STOCK);
    assert_eq!(low.len(), 1, "{low:?}");
    assert!(low[0].starts_with("2 moves at the height of the stock, from line 8 on"), "{low:?}");
    let nothing: [&str; 0] = [];
    assert_eq!(found("G0 Y30\nZ-5\nG53 G0 Z0\nG55\nG0 X120 Y50\nX-20\nG43 H1 Z50", STOCK), nothing);
    assert_eq!(found("G0 Y30\nG55\nG0 X120 Y50\nG43 H1 Z50", STOCK), nothing);
}

/// A retract under compensation goes straight up from the path of the centre.
#[test]
fn a_retract_under_compensation_is_no_finding() {
    let nothing: [&str; 0] = [];
    assert_eq!(found("G0 X-20 Y30 Z-5\nG1 G41 D1 X-10 F500\nX50\nG0 Z20\nG40 X0", STOCK), nothing);
}

/// A block that runs several times gives one finding with a count.
#[test]
fn a_block_that_runs_again_is_one_finding() {
    let checked = checked(&format!("{HEAD}M98 P2 L3\nM30\nO2\nG0 X-20 Y30\nZ-5\nX120\nZ50\nM99\n"), STOCK);
    assert_eq!(checked.blocks, 1, "{checked:?}");
    assert_eq!((checked.findings[0].line, checked.findings[0].times), (10, 3));
}

/// An arc in a vertical plane may cut below its ends.
#[test]
fn an_arc_whose_ends_are_above_the_stock_cuts() {
    let nothing: [&str; 0] = [];
    let bowl = "G0 X20 Y30 Z5\nG1 Z0 F500\nG18 G2 X40 Z0 I10 K0\nG17 G0 Z5\nX30\n";
    assert_eq!(found(&format!("{bowl}Z-5\nZ50"), STOCK), nothing);
    assert_eq!(found(&format!("{bowl}Z-12\nZ50"), STOCK).len(), 2);
    // the other way round, the arc is above the stock
    assert_eq!(found(&format!("{}Z-5\nZ50", bowl.replace("G18 G2", "G18 G3")), STOCK).len(), 2);
}

/// For a thin tool, the cell under its axis is checked at every position in the grid.
#[test]
fn thin_tools_are_checked() {
    for (x, cells) in [(50.0, STOCK), (50.1, STOCK), (50.125, STOCK), (50.0, "X-500..500 Y-500..500 Z-20..0")] {
        let (tool, diameter) = if cells == STOCK { (6, 0.55) } else { (7, 2.1) };
        let plunge = found(&format!("T{tool} M6\nG0 X{x} Y30\nG43 H{tool} Z5\nZ-10\nX70\nZ50"), cells);
        assert_eq!(plunge.len(), 3, "{diameter} at {x}: {plunge:?}");
        let cut = found(&format!("T{tool} M6\nG0 X{x} Y30\nG43 H{tool} Z5\nG1 Z-10 F50\nX70\nG0 X{x}\nZ50"), cells);
        assert!(cut.is_empty(), "{diameter} at {x}: {cut:?}");
    }
}

/// An oriented boring bar moves away from the wall. This move is not checked.
#[test]
fn a_fine_bore_is_not_checked_while_its_spindle_is_oriented() {
    let bore = found("G0 X50 Y30 Z5\nG98 G76 Z-10 R1 Q1 F50\nG80\nG0 X70\nZ-2", STOCK);
    assert_eq!(bore.len(), 2, "{bore:?}");
    assert!(
        bore[0].starts_with("9 T1 goes through the stock") && bore[1].contains("with the spindle stopped at an angle"),
        "{bore:?}"
    );
}

/// The size of the stock is in the units of the job, whatever the units of the program are.
#[test]
fn the_block_is_in_the_units_of_the_job() {
    let folder = Folder::new("stock-units");
    let path = r#"[{"rapid":[1,1,0.1]},{"rapid":[1,1,-0.2]},{"rapid":[1,1,2]}]"#;
    folder.write("job.json", format!(r#"{{"postform":1,"program":7,"name":"A","units":"inch","machine":"mill","tools":[{{"number":1,"diameter":0.5,"length_offset":1}}],"operations":[{{"tool":1,"work":54,"spindle":{{"speed":1000,"direction":"cw"}},"coolant":"off","feed":9,"path":{path}}}]}}"#));
    let form = root().join("postforms/haas.pf");
    for units in ["inch", "mm"] {
        let verified = folder.run(&[
            "verify",
            "job.json",
            "--form",
            form.to_str().unwrap(),
            "--units",
            units,
            "--stock",
            "X0..4 Y0..3 Z-1..0",
        ]);
        let said = String::from_utf8_lossy(&verified.stdout).into_owned();
        assert!(said.contains("rapids through the stock: 2 blocks"), "{units}: {said}");
        assert!(String::from_utf8_lossy(&verified.stderr).contains("0.2 inch below its surface"), "{units}");
    }
}

#[test]
fn a_compensated_cut_removes_material_beside_its_path() {
    // the tool is to the left of Y30: it cuts from Y30 to Y40
    let slot = "G0 X-20 Y30 Z-5\nG1 G41 D1 X-10 F500\nX120\nG40 X130\n";
    let nothing: [&str; 0] = [];
    assert_eq!(found(&format!("{slot}G0 Y35\nX-20"), STOCK), nothing);
    assert_eq!(found(&format!("{slot}G0 Y30\nX-20"), STOCK).len(), 1);
    assert!(checked(&format!("{HEAD}{slot}M30\n"), STOCK).compensates);
    // around an inner corner and an outer corner, and back on the path of the centre
    let corner = "G0 X-20 Y30 Z-5\nG1 G41 D1 X-10 F500\nX50\nY70\nG40 Y80\n";
    assert_eq!(found(&format!("{corner}G0 X45\nY35\nX-20"), STOCK), nothing);
    let outer = "G0 X-20 Y30 Z-5\nG1 G42 D1 X-10 F500\nX50\nY70\nG40 Y80\n";
    assert_eq!(found(&format!("{outer}G0 X55\nY25\nX-20"), STOCK), nothing);
}

#[test]
fn each_work_offset_has_its_own_stock_and_shifts_move_in_it() {
    let slot = "G0 X-20 Y30\nZ-5\nG1 X120 F500\nG0 X-20\nZ50\n";
    let nothing: [&str; 0] = [];
    assert_eq!(found(&format!("{slot}G55\n{slot}"), STOCK), nothing);
    // nothing has been cut in G55
    let other = found(&format!("{slot}G55\nG0 X-20 Y30\nZ-5\nX120"), STOCK);
    assert_eq!(other.len(), 1, "{other:?}");
    // a shift moves the slot
    let shifted = "G52 Y10\nG0 X-20 Y20\nZ-5\nX120\n";
    assert_eq!(found(&format!("{slot}{shifted}"), STOCK), nothing);
    assert_eq!(found(&format!("{slot}G52 Y0\n{}", &shifted[8..]), STOCK).len(), 1);
}

#[test]
fn what_is_not_checked_is_named() {
    let only = |program: &str, stock: &str| match found(program, stock).as_slice() {
        [one] => one.clone(),
        other => panic!("{other:?}"),
    };
    let no_diameter = only("G0 Z-5 T3 M6\nG1 X120 F500", "X0..100 Y0..60 Z0");
    assert!(
        no_diameter.contains("T3 in the stock") && no_diameter.contains("no operation of the job gives the diameter"),
        "{no_diameter}"
    );
    let thin = only("T4 M6\nG0 X-20 Y0 Z-5\nX120", STOCK);
    assert!(thin.starts_with("rapids of T4: its radius is not greater than a cell"), "{thin}");
    let machine = only("G0 Z-5\nG28 G91 Y0", STOCK);
    assert!(machine.contains("known only at the machine"), "{machine}");
    let rotary = only("G0 A90\nZ-5\nX120", STOCK);
    assert!(rotary.contains("a rotary axis is not at 0"), "{rotary}");
    let refused = only("G0 X50 Y30\nG2 X1", STOCK);
    assert!(refused.starts_with("everything from line 6 on"), "{refused}");
    let settings = RunSettings::new(control("haas-lathe"));
    let lathe = check_stock(Cursor::new("G0 X1\n"), settings, &STOCK.parse().unwrap(), &tools(), Units::Mm).unwrap();
    assert_eq!(lathe.not_checked.len(), 1);
    assert!(!lathe.is_clean());
}

#[test]
fn a_wrong_block_gets_its_reason() {
    for (text, reason) in [
        ("", "X and Y and Z are missing"),
        ("X0..1 Y0..1", "Z is missing"),
        ("X0..1 Y0..1 Z1..0", "the lowest position in `Z1..0` is not below"),
        ("X0..1 Y0..1 Z0 Z1", "Z is given twice"),
        ("X0 Y0..1 Z0", "`X0` is not a range"),
        ("X0..NaN Y0..1 Z0", "`X0..NaN` is not a range"),
        ("X0..1e9 Y0..1 Z0", "is not a range"),
        ("A0..1", "`A0..1` does not begin with X, Y or Z"),
        ("é0..1", "does not begin"),
    ] {
        let why = text.parse::<Stock>().unwrap_err();
        assert!(why.contains(reason), "{text}: {why}");
        assert!(why.contains("X0..100 Y0..60 Z-20..0"), "{text}: {why}");
    }
}

/// Tests the command: findings with their lines, the last sentence, the exit status, JSON, and a job from standard
/// input.
#[test]
fn the_command_says_where() {
    let folder = Folder::new("stock");
    let job = r#"{"postform":1,"program":7,"name":"PART","units":"mm","machine":"mill","tools":[{"number":1,"diameter":10}],"operations":[{"name":"a","tool":1,"work":1,"spindle":{"speed":1000,"direction":"cw"},"coolant":"off","feed":100,"path":[{"rapid":[-10,30,5]},{"rapid":[-10,30,-5]},{"rapid":[110,30,-5]},{"line":[110,40,-5]},{"rapid":[110,40,5]}]}]}"#;
    folder.write("job.json", job);
    let form = concat!(env!("CARGO_MANIFEST_DIR"), "/../../postforms/haas.pf");
    let verify = |stock: &str, more: &[&str]| {
        folder.run(&[&["verify", "job.json", "--form", form, "--stock", stock], more].concat())
    };
    let crash = verify("X0..100 Y0..60 Z-20..0", &[]);
    assert_eq!(crash.status.code(), Some(1));
    let said = String::from_utf8_lossy(&crash.stderr).into_owned();
    assert!(said.contains("PM003 at job.json:1:") && said.contains("goes through the stock at rapid: 5 mm"), "{said}");
    let sentence = String::from_utf8_lossy(&crash.stdout).into_owned();
    assert!(sentence.ends_with("the program makes rapids through the stock: 1 block\n"), "{sentence}");
    let clean = verify("X0..100 Y0..20 Z-20..0", &[]);
    assert_eq!(clean.status.code(), Some(0));
    assert!(String::from_utf8_lossy(&clean.stdout).ends_with("the program makes no rapid through the stock\n"));
    let json = verify("X0..100 Y0..60 Z-20..0", &["--format", "json"]);
    let document: serde_json::Value = serde_json::from_slice(&json.stdout).unwrap();
    assert_eq!(document["stock"]["blocks"], 1);
    assert_eq!(document["stock"]["findings"][0]["code"], "PM003");
    assert_eq!(json.status.code(), Some(1));
    // with an existing program, and no form: tools and units come from the job
    let printed = folder.run(&["render", "job.json", "--form", form, "-o", "part.nc"]);
    assert!(printed.status.success());
    let existing =
        folder.run(&["verify", "job.json", "--nc", "part.nc", "--control", "haas", "--stock", "X0..100 Y0..60 Z0"]);
    assert_eq!(existing.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&existing.stdout).contains("part.nc makes rapids through the stock: 1 block"));
}

/// A move of a random program on a small stock. The program contains the move as words, the judge gets it as data.
#[derive(Clone, Debug)]
struct Cut {
    rapid: bool,
    tool: usize,
    to: [f64; 3],
}

fn cuts() -> impl Strategy<Value = Vec<Cut>> {
    let to = (-6..26i32, -6..26i32, prop_oneof![2 => -6..3i32, 1 => Just(1)]);
    let cut = (prop::bool::weighted(0.4), prop_oneof![4 => Just(9usize), 1 => 0..3usize], to);
    prop::collection::vec(cut, 1..12).prop_map(|moves| {
        let mut tool = 0;
        let mut at = [0.0; 3];
        let moves = moves.into_iter().map(|(rapid, change, (x, y, z))| {
            tool = if change < 3 { change } else { tool };
            let mut to = [f64::from(x), f64::from(y), f64::from(z)];
            // in real programs, many moves are along one axis
            match x.rem_euclid(4) {
                0 => to = [at[0], at[1], to[2]],
                1 => to[2] = at[2],
                _ => {}
            }
            at = to;
            Cut { rapid, tool, to }
        });
        moves.collect()
    })
}

/// The judge moves the tool in steps of 0.02 mm and checks every cell. Returns the depth of each rapid in the stock.
fn judged(moves: &[Cut], side: f64, cell: f64) -> Vec<f64> {
    let shapes = [(5.0, 0.0), (3.0, 3.0), (5.0, 2.0)];
    let count = (side / cell).round() as usize;
    let mut heights = vec![0.0f64; count * count];
    let (mut from, mut tool) = ([-6.0, -6.0, 3.0], 0);
    moves
        .iter()
        .map(|cut| {
            // a new tool starts at the same X and Y, above the stock
            if std::mem::replace(&mut tool, cut.tool) != cut.tool {
                from[2] = 3.0;
            }
            let (radius, corner): (f64, f64) = shapes[cut.tool];
            let way: [f64; 3] = std::array::from_fn(|axis| cut.to[axis] - from[axis]);
            let steps = (way.iter().map(|part| part * part).sum::<f64>().sqrt() / 0.02).ceil().max(1.0);
            let radius_here = if cut.rapid { radius - cell } else { radius };
            let corner = corner.min(radius_here);
            let mut deepest = 0.0f64;
            for step in 0..=steps as usize {
                let at: [f64; 3] = std::array::from_fn(|axis| from[axis] + way[axis] * step as f64 / steps);
                let cells = |axis: usize| {
                    let low = ((at[axis] - radius_here) / cell).max(0.0) as usize;
                    low..(((at[axis] + radius_here) / cell).max(0.0).ceil() as usize).min(count)
                };
                for row in cells(1) {
                    let y = (row as f64 + 0.5) * cell - at[1];
                    for column in cells(0) {
                        let away = ((column as f64 + 0.5) * cell - at[0]).hypot(y);
                        if away > radius_here {
                            continue;
                        }
                        let beyond = (away - (radius_here - corner)).max(0.0);
                        let surface = at[2] + corner - (corner * corner - beyond * beyond).max(0.0).sqrt();
                        let height = &mut heights[row * count + column];
                        if !cut.rapid {
                            *height = height.min(surface);
                        } else if *height > -4.0 {
                            deepest = deepest.max(*height - surface.max(-4.0));
                        }
                    }
                }
            }
            from = cut.to;
            deepest
        })
        .collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(if cfg!(debug_assertions) { 16 } else { 1000 }))]

    /// The findings must be those of a judge that moves the tool in small steps. For a depth near the tolerance, both
    /// results are accepted.
    #[test]
    fn random_rapids_are_judged_alike(moves in cuts()) {
        let numbers = [1, 2, 5];
        let mut program = String::from("G21 G90 G94 G17 G54\nT1 M6\nG0 X-6 Y-6\nG43 H1 Z3\nF500\n");
        let (mut lines, mut line, mut tool, mut at) = (Vec::new(), 6, 0, [-6.0, -6.0, 3.0]);
        for cut in &moves {
            if cut.tool != tool {
                tool = cut.tool;
                let [x, y, _] = at;
                writeln!(program, "T{} M6\nG0 X{x} Y{y}\nG43 H1 Z3", numbers[tool]).unwrap();
                line += 3;
            }
            at = cut.to;
            let [x, y, z] = at;
            writeln!(program, "G{} X{x} Y{y} Z{z}", u8::from(!cut.rapid)).unwrap();
            lines.push(line);
            line += 1;
        }
        program += "M30\n";
        let checked = checked(&program, "X0..20 Y0..20 Z-4..0");
        prop_assert_eq!(&checked.not_checked, &Vec::<String>::new());
        for ((depth, line), cut) in judged(&moves, 20.0, 0.25).into_iter().zip(lines).zip(&moves) {
            let found = checked.findings.iter().any(|finding| finding.line == line);
            prop_assert!(cut.rapid || !found, "{program}: a cut in line {line}");
            if !(0.15..0.25).contains(&depth) {
                prop_assert_eq!(found, depth > 0.2, "{}: {} in line {}", program, depth, line);
            }
        }
    }
}
