//! Writes the motions of a program block by block, without cycles.

use std::fmt::Write;

use super::executor::{Kind, Move, Point};

/// The program of these motions. `inch`: the motions are in inches; `to_inch`: the program is in inches, else in
/// millimetres.
pub fn unrolled(moves: &[Move], inch: bool, to_inch: bool) -> String {
    let moves: Vec<Move> = moves.iter().map(|one| if inch && !to_inch { in_mm(one) } else { *one }).collect();
    let mut text = format!("%\nO0001\n{}G18G40G99\n", if to_inch { "G20" } else { "G21" });
    let mut now = Move { feed: f64::NAN, per_rev: true, ..Move::BEGIN };
    for one in &moves {
        // postform counts a cut of zero length, but not in a cycle
        if !matches!(one.kind, Kind::Dwell(_)) && one.from.iter().zip(&one.to).all(|(a, b)| (a - b).abs() < 1e-5) {
            continue;
        }
        state(&mut text, &mut now, one);
        let [x, z] = [one.to[0] * 2.0, one.to[1]];
        let feed = format!("F{}", point(one.feed));
        if one.kind == Kind::Rapid && x.is_nan() && z.is_nan() {
            // a tool change follows, after which the spindle must be set again
            (now.tool, now.spindle) = (0.0, 0.0);
        }
        _ = match one.kind {
            Kind::Rapid => {
                let home = |letter: &str, to: f64| if to.is_nan() { format!("G28{letter}0\n") } else { String::new() };
                let homes = home("U", x) + &home("W", z);
                let word =
                    |letter: char, to: f64| if to.is_nan() { String::new() } else { format!("{letter}{}", point(to)) };
                match homes.is_empty() {
                    true => writeln!(text, "G0{}{}", word('X', x), word('Z', z)),
                    // an axis that is at its home position does not move
                    false if x.is_nan() && z.is_nan() => writeln!(text, "G28U0W0"),
                    false => write!(text, "{homes}"),
                }
            }
            Kind::Feed => writeln!(text, "G1X{}Z{}{feed}", point(x), point(z)),
            Kind::Thread => {
                let angle = if one.angle == 0.0 { String::new() } else { format!("Q{}", one.angle) };
                writeln!(text, "G32X{}Z{}{angle}{feed}", point(x), point(z))
            }
            Kind::Arc(center, ccw) => {
                let (i, k) = (center[0] - one.from[0], center[1] - one.from[1]);
                let code = if ccw { "G3" } else { "G2" };
                writeln!(text, "{code}X{}Z{}I{}K{}{feed}", point(x), point(z), point(i), point(k))
            }
            Kind::Dwell(stop) if stop < 0.0 => writeln!(text, "M{}", -1.0 - stop),
            Kind::Dwell(seconds) => writeln!(text, "G4U{}", point(seconds)),
        };
    }
    text + "M5\nM30\n%\n"
}

fn point(value: f64) -> String {
    let text = format!("{value:.9}");
    let text = text.trim_end_matches('0');
    if text == "-0." { "0.".to_owned() } else { text.to_owned() }
}

/// Converts a motion from inches to millimetres.
fn in_mm(one: &Move) -> Move {
    let mm = |at: Point| at.map(|length| length * 25.4);
    let kind = match one.kind {
        Kind::Arc(center, ccw) => Kind::Arc(mm(center), ccw),
        other => other,
    };
    // the surface speed is then in metres per minute
    let speed = (if one.speed.1 { one.speed.0 * 0.3048 } else { one.speed.0 }, one.speed.1);
    Move { kind, from: mm(one.from), to: mm(one.to), feed: one.feed * 25.4, speed, ..*one }
}

/// Writes the parts of the state that the motion changes.
fn state(text: &mut String, now: &mut Move, one: &Move) {
    if one.tool != now.tool {
        _ = writeln!(text, "T{:04}", one.tool);
    }
    if one.limit != now.limit {
        _ = writeln!(text, "G50S{}", one.limit);
    }
    if (one.speed, one.spindle) != (now.speed, now.spindle) {
        let code = if one.speed.1 { 96 } else { 97 };
        _ = writeln!(text, "G{code}S{}M{}", point(one.speed.0).trim_end_matches('.'), one.spindle);
    }
    if one.per_rev != now.per_rev {
        _ = writeln!(text, "{}", if one.per_rev { "G99" } else { "G98" });
    }
    if one.work != now.work {
        _ = writeln!(text, "G{}", one.work);
    }
    if one.coolant != now.coolant {
        _ = writeln!(text, "M{}", one.coolant);
    }
    if one.side != now.side {
        _ = writeln!(text, "G{}", one.side);
    }
    *now = *one;
}
