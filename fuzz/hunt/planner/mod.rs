//! A second planner of cycles, written from the texts that define them: the CYCLE chapter of the GENER manual (words, modal
//! values, the numbered motions of each type), and the canned cycles of EMC (motions that a control adds by itself).
//!
//! The planner reads a CL file and lists the moves that the file requests. The planner shares no code with postform,
//! and the hunt compares the results of both. Lengths are in millimetres, feeds in millimetres per minute, times in
//! seconds.
//!
//! A value that the texts leave to a configuration is `None` or a range here ([`Height`]). It is not guessed.

mod cycle;
mod feed;
mod hole;
mod reader;
mod statement;

pub use cycle::Kind;
pub use hole::{Height, Hole, Move};
pub use reader::{Does, Step, plan};

/// X, Y, Z.
pub type Point = [f64; 3];

/// The direction of the spindle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Turn {
    /// The spindle is stopped.
    Off,
    /// CLW.
    Clockwise,
    /// CCLW.
    Counterclockwise,
}

impl Turn {
    /// The opposite direction.
    pub fn reversed(self) -> Turn {
        match self {
            Turn::Off => Turn::Off,
            Turn::Clockwise => Turn::Counterclockwise,
            Turn::Counterclockwise => Turn::Clockwise,
        }
    }
}

#[cfg(test)]
mod tests {
    use serde_json::Value;

    use super::*;

    /// A motion of a worked example.
    #[derive(Debug)]
    enum Wanted {
        Rapid([f64; 2], Height),
        Feed(Point, f64),
        Other(&'static str, Option<f64>),
    }

    fn motions(steps: &[Step], unit: f64) -> Vec<Wanted> {
        let mut list = Vec::new();
        for step in steps {
            match &step.does {
                Does::Rapid([x, y, z]) => list.push(Wanted::Rapid([*x, *y], Height { from: *z, to: *z })),
                Does::Line(to) => list.push(Wanted::Feed(*to, step.feed)),
                Does::Hole(hole) => {
                    for z in [hole.plane, hole.clear] {
                        list.push(Wanted::Rapid(hole.over, Height { from: z, to: z }));
                    }
                    let [x, y] = hole.over;
                    for part in &hole.moves {
                        list.push(match *part {
                            Move::Rapid(over, height) => Wanted::Rapid(over, height),
                            Move::Feed(z, feed) => Wanted::Feed([x, y, z], feed),
                            Move::Dwell(seconds) => Wanted::Other("dwell", seconds),
                            Move::Orient(angle) => Wanted::Other("orient", angle),
                            Move::Spindle(_) => Wanted::Other("spindle", None),
                            Move::Stop => Wanted::Other("stop", None),
                        });
                    }
                    if hole.kind == Kind::Tap || hole.kind == Kind::Ream {
                        list.push(Wanted::Rapid(hole.over, Height { from: hole.plane, to: hole.plane }));
                    }
                }
                Does::Dwell(seconds) => list.push(Wanted::Other("dwell", Some(*seconds))),
                Does::Stop(_) => list.push(Wanted::Other("stop", None)),
                Does::Arc(..) => list.push(Wanted::Other("arc", None)),
            }
        }
        // in units of the file
        for wanted in &mut list {
            match wanted {
                Wanted::Rapid(over, height) => {
                    over.iter_mut().for_each(|v| *v /= unit);
                    (height.from, height.to) = (height.from / unit, height.to / unit);
                }
                Wanted::Feed(to, _) => to.iter_mut().for_each(|v| *v /= unit),
                Wanted::Other(..) => {}
            }
        }
        list
    }

    /// Whether this motion matches the motion of the example. An angle or time that no word defines matches every
    /// value.
    fn is(wanted: &Wanted, motion: &[Value]) -> bool {
        let number = |at: usize| motion.get(at).and_then(Value::as_f64).unwrap_or(f64::NAN);
        let near = |a: f64, b: f64| a.is_nan() || (a - b).abs() < 1e-4;
        match wanted {
            Wanted::Rapid([x, y], z) => {
                motion[0] == "rapid" && near(*x, number(1)) && near(*y, number(2)) && z.holds(number(3), 1e-4)
            }
            Wanted::Feed([x, y, z], feed) => {
                motion[0] == "feed"
                    && near(*x, number(1))
                    && near(*y, number(2))
                    && near(*z, number(3))
                    && near(*feed, number(4))
            }
            Wanted::Other(name, value) => motion[0] == *name && value.is_none_or(|value| near(value, number(1))),
        }
    }

    #[test]
    fn the_worked_examples_come_out() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/data/cycles.json");
        let examples: Vec<Value> = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
        let mut seen = 0;
        for example in &examples {
            let (id, setup) = (&example["id"], &example["setup"]);
            let wanted: Vec<&[Value]> = example["motions"]
                .as_array()
                .unwrap()
                .iter()
                .map(|motion| motion.as_array().unwrap().as_slice())
                .collect();
            // errors are tested in postform only, and values of a configuration are not in the texts
            if wanted.iter().any(|motion| motion[0] == "ERROR")
                || setup["config"].as_object().is_some_and(|c| !c.is_empty())
            {
                continue;
            }
            let inches = setup["units"] == "IN";
            let start: Vec<String> = setup["start"].as_array().unwrap().iter().map(Value::to_string).collect();
            let lines: Vec<&str> =
                example["cl"].as_array().unwrap().iter().map(|line| line.as_str().unwrap()).collect();
            let turn = setup["spindle"].as_str().unwrap();
            let units = if inches { "INCHES" } else { "MM" };
            let text = format!(
                "UNITS/{units}\nLOADTL/1\nSPINDL/{},RPM,{turn}\nRAPID\nGOTO/{}\n{}\n",
                setup["rpm"],
                start.join(","),
                lines.join("\n")
            );
            let Ok(steps) = plan(&text) else { continue };
            let list = motions(&steps[1..], if inches { 25.4 } else { 1.0 });
            let mut at: Vec<f64> = setup["start"].as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect();
            let mut next = wanted.iter().peekable();
            for motion in &list {
                // a rapid of zero length is not in the examples
                if let Wanted::Rapid([x, y], z) = motion
                    && [*x, *y].iter().zip(&at).all(|(a, b)| (a - b).abs() < 1e-6)
                    && z.holds(at[2], 1e-6)
                {
                    continue;
                }
                let found = next.next().unwrap_or_else(|| panic!("{id}: {motion:?} is too much"));
                assert!(is(motion, found), "{id}: {motion:?}, not {found:?}");
                if found[0] == "rapid" || found[0] == "feed" {
                    at = found[1..4].iter().map(|v| v.as_f64().unwrap()).collect();
                }
            }
            assert!(next.peek().is_none(), "{id}: {next:?} is missing");
            seen += 1;
        }
        assert!(seen >= 25, "{seen} examples");
    }
}
