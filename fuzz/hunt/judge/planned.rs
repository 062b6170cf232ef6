//! The requests of a CL file according to the second planner, as the list with which programs are compared.

use super::{Place, Want, Wanted};
use crate::planner::{Does, Kind, Move, Point, Turn, plan};

/// The list for a CL file.
///
/// # Errors
/// A statement that the second planner can't read.
pub fn wants(text: &str) -> Result<Vec<Wanted>, String> {
    let mut list = Vec::new();
    let mut at: Point = [f64::NAN; 3];
    let mut low = f64::INFINITY;
    let mut loaded = 0;
    // after a jog, the tool moves down or out beside the hole without cutting
    let mut jogged = false;
    for step in plan(text)? {
        if step.tool.1 != loaded {
            loaded = step.tool.1;
            (at, low) = ([f64::NAN; 3], f64::INFINITY);
        }
        let mut cut = (step.feed, 94.0);
        let mut goes_aside = false;
        let (want, to) = match step.does {
            Does::Rapid(to) => {
                low = low.min(at[2]).min(to[2]);
                at = to;
                continue;
            }
            Does::Line(to) => (Want::Line, to),
            Does::Arc(to, center, axis) => {
                let third = (0..3).find(|&third| axis[third] != 0.0).ok_or("an arc without an axis")?;
                let plane = ["yz", "xz", "xy"][third];
                let [first, second] = super::wants::axes(plane);
                let want =
                    Want::Arc { plane, center: [center[first], center[second]], ccw: axis[third] > 0.0, turns: 0.0 };
                (want, to)
            }
            Does::Dwell(seconds) => (Want::Dwell(seconds), at),
            Does::Stop(kind) => (Want::Stop(kind), at),
            Does::Hole(hole) => {
                let jogs = hole.moves.iter().any(|part| matches!(part, Move::Orient(_)));
                low = if jogged || hole.kind == Kind::BoreBack {
                    f64::NEG_INFINITY
                } else {
                    low.min(at[2]).min(hole.plane)
                };
                goes_aside = jogs;
                cut.0 = hole.feed;
                let to = [hole.over[0], hole.over[1], hole.plane];
                (Want::Planned(Box::new(hole)), to)
            }
        };
        let place = |[x, y, z]: Point| -> Place { [x, y, z, 0.0, 0.0, 0.0] };
        let direction = match step.spindle.0 {
            Turn::Clockwise => 3.0,
            Turn::Counterclockwise => 4.0,
            Turn::Off => 5.0,
        };
        list.push(Wanted {
            want,
            from: place(at),
            to: place(to),
            tool: step.tool.0,
            length: step.tool.0,
            work: f64::NAN,
            spindle: (direction, step.spindle.1),
            feed: cut,
            low: if jogged { f64::NEG_INFINITY } else { low.min(at[2]).min(to[2]) },
            side: 40.0,
            coolant: None,
        });
        (at, low, jogged) = (to, f64::INFINITY, goes_aside);
    }
    Ok(list)
}
