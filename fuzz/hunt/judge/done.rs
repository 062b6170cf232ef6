//! A program as a job: converts the acts of the judge's machine to the list with which another program is compared.

use super::wants::{Want, Wanted};
use super::{Act, What};

/// The list for these acts. `None`: the acts contain a cycle that jogs, or another act that is not supported here.
pub fn wants(acts: &[Act]) -> Option<Vec<Wanted>> {
    let mut list: Vec<Wanted> = Vec::new();
    let mut low = f64::INFINITY;
    let mut side = 40.0;
    // spindle direction at the last tap; after the tap the direction is unknown until the program sets it
    let mut tapped = None;
    for act in acts {
        // a job turns compensation on and off only in feed moves
        let turned = std::mem::replace(&mut side, act.state.side.0) != act.state.side.0;
        if act.what == What::Rapid && turned {
            return None;
        }
        // a height or position is unknown if a length register was turned off or the frame was moved
        if act.cuts() && act.to.iter().any(|place| place.is_nan()) {
            return None;
        }
        let want = match act.what {
            What::Rapid => {
                // a rapid in X or Y from an unknown height
                if act.from[2].is_nan() && act.to[2].is_nan() {
                    low = f64::NEG_INFINITY;
                }
                low = low.min(act.from[2]).min(act.to[2]);
                continue;
            }
            What::Tool => {
                low = f64::INFINITY;
                continue;
            }
            What::Orient(_) | What::End => continue,
            What::Hole { .. } if !act.cuts() => continue,
            What::Feed => Want::Line,
            What::Arc { plane, center, ccw, turns } => {
                let plane = match plane {
                    18.0 => "xz",
                    19.0 => "yz",
                    _ => "xy",
                };
                Want::Arc { plane, center, ccw, turns }
            }
            What::Hole { code, r, z, out, .. } => {
                let kind = match code {
                    81.0 => "drill",
                    82.0 => "face",
                    83.0 => "deep",
                    73.0 => "chipbreak",
                    84.0 => "tap",
                    74.0 => "ltap",
                    85.0 | 89.0 => "ream",
                    86.0 => "bore",
                    _ => return None,
                };
                Want::Hole { kind: kind.into(), clear: r, bottom: z, out }
            }
            What::Dwell(seconds) => Want::Dwell(seconds),
            What::Stop(kind) => Want::Stop(kind),
            What::Thread(_) => return None,
        };
        let state = &act.state;
        tapped = tapped.filter(|direction| *direction == state.direction);
        let direction = if tapped.is_some() { f64::NAN } else { state.direction };
        if matches!(act.what, What::Hole { code: 84.0 | 74.0, .. }) {
            tapped = Some(state.direction);
        }
        list.push(Wanted {
            want,
            from: act.from,
            to: act.to,
            tool: state.tool,
            length: state.length.unwrap_or(f64::NAN),
            work: if state.work < 50.0 { state.work + 53.0 } else { state.work },
            spindle: (direction, state.speed),
            feed: state.feed,
            low: low.min(act.from[2]).min(act.to[2]),
            side: state.side.0,
            // a job requests only one kind of coolant
            coolant: Some(state.coolant).filter(|coolant| *coolant != 3),
        });
        low = f64::INFINITY;
    }
    Some(list)
}
