//! Compares two programs that should have the same effect, and classifies the differences.

use std::f64::consts::TAU;

use super::wants::axes;
use super::{Act, Place, What, near, same, turned};

/// The kind of a difference between two programs, most serious first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Class {
    /// Position of a cut.
    Cut,
    /// Tool of a cut.
    Tool,
    /// Length register.
    Length,
    /// Work offset.
    Work,
    /// Direction or speed of the spindle at a cut.
    Spindle,
    /// Angle of the oriented spindle.
    Orientation,
    /// Feed, or its mode.
    Feed,
    /// Side of the compensation, or its register.
    Side,
    /// Stops of the program.
    Stop,
    /// Dwells.
    Dwell,
    /// Pecks.
    Pecks,
    /// Coolant at a cut.
    Coolant,
    /// A rapid in X or Y at a lower height.
    Low,
    /// A cut that differs by less than 0.03 mm.
    Near,
    /// Cuts and rapids that are too short to be compared.
    Short,
    /// Rapids with other positions.
    Way,
    /// Acts after the last cut.
    Tail,
}

impl Class {
    /// Whether the part stays correct in spite of this difference.
    pub fn is_harmless(self) -> bool {
        matches!(self, Class::Way | Class::Pecks | Class::Tail | Class::Near | Class::Short)
    }
}

/// The acts, with straight cuts of at most 0.0001 inch converted to rapids.
pub fn without_short(acts: &[Act]) -> Vec<Act> {
    let straight = |what: What| matches!(what, What::Feed | What::Thread(_));
    let short = |act: &Act| straight(act.what) && same(&act.from, &act.to, 0.0026);
    let kept = acts.iter().map(|act| if short(act) { Act { what: What::Rapid, ..*act } } else { *act });
    kept.collect()
}

/// The most serious difference between a correct program and a changed one; `None`: both have the same effect.
/// `crests`: radii of the job's threads; `within`: tolerance in millimetres.
pub fn difference(right: &[Act], changed: &[Act], crests: &[f64], within: f64) -> Option<(Class, String)> {
    let mut found: Option<(Class, String)> = None;
    let mut say = |class: Class, what: String| {
        if found.as_ref().is_none_or(|(other, _)| class < *other) {
            found = Some((class, what));
        }
    };
    let (a, b) = (plunges(right), plunges(changed));
    for (left, other) in a.iter().zip(&b) {
        if let Some((class, what)) = plunge(left, other, crests, within) {
            let grave = class == Class::Cut;
            say(class, format!("line {}: {what}", other.cuts[0].line));
            if grave {
                break;
            }
        }
    }
    if a.len() != b.len() {
        say(Class::Cut, format!("{} cuts, not {}", b.len(), a.len()));
    }
    others(right, changed, &mut say);
    ways(right, changed, within, &mut say);
    found
}

/// A cut, or all vertical cuts at one position if only vertical moves are between these cuts, or all passes of a
/// thread.
struct Plunge {
    cuts: Vec<Act>,
}

fn plunges(acts: &[Act]) -> Vec<Plunge> {
    let mut list: Vec<Plunge> = Vec::new();
    // only vertical moves since the last cut
    let mut straight = false;
    for act in acts {
        if !act.cuts() {
            straight &= act.what != What::Rapid || act.plunges();
            continue;
        }
        let goes_on = straight && act.what == What::Feed && act.plunges();
        match list.last_mut() {
            Some(last) if goes_on && last.cuts[0].what == What::Feed => last.cuts.push(*act),
            Some(last) if is_pass(&last.cuts[0], act) => last.cuts.push(*act),
            _ => list.push(Plunge { cuts: vec![*act] }),
        }
        straight = act.what == What::Feed && act.plunges();
    }
    list
}

/// Whether two cuts are passes of the same thread.
fn is_pass(one: &Act, two: &Act) -> bool {
    let (What::Thread(lead), What::Thread(other)) = (one.what, two.what) else { return false };
    near(lead, other, 0.003 * lead) && near(one.from[2], two.from[2], 0.01) && near(one.to[2], two.to[2], 0.01)
}

/// Compares the passes of a thread: they must be equally deep, and none may miss the material.
fn passes(left: &Plunge, other: &Plunge, crests: &[f64], within: f64) -> Option<(Class, String)> {
    let (first, last) = (&left.cuts[0], &left.cuts[left.cuts.len() - 1]);
    // for an internal thread, the radius increases
    let inwards = if last.to[0] > first.to[0] { 1.0 } else { -1.0 };
    let ends = |plunge: &Plunge| {
        let depths = plunge.cuts.iter().map(|cut| cut.to[0] * inwards);
        depths.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), depth| (low.min(depth), high.max(depth)))
    };
    let (a, b) = (ends(left), ends(other));
    // the first pass must be below the crest of a thread of the job that may be this thread
    let in_part =
        |depth: f64| crests.iter().any(|crest| depth >= crest * inwards - 2.0 * within && crest * inwards <= a.0);
    if !near(a.1, b.1, 2.0 * within) || !in_part(b.0) {
        return Some((Class::Cut, format!("a thread from {:.4} to {:.4}, not {:.4} to {:.4}", b.0, b.1, a.0, a.1)));
    }
    let same_passes = left.cuts.len() == other.cuts.len()
        && left.cuts.iter().zip(&other.cuts).all(|(a, b)| near(a.to[0], b.to[0], 2.0 * within));
    let states = left.cuts.iter().zip(&other.cuts).find_map(|(a, b)| state(a, b));
    states.or((!same_passes).then(|| (Class::Pecks, format!("{} passes, not {}", other.cuts.len(), left.cuts.len()))))
}

fn plunge(left: &Plunge, other: &Plunge, crests: &[f64], within: f64) -> Option<(Class, String)> {
    if is_pass(&left.cuts[0], &other.cuts[0]) {
        return passes(left, other, crests, within);
    }
    if left.cuts.len() == 1 && other.cuts.len() == 1 && !(left.cuts[0].plunges() && other.cuts[0].plunges()) {
        return cut(&left.cuts[0], &other.cuts[0], within);
    }
    let deepest = |plunge: &Plunge| plunge.cuts.iter().fold(f64::INFINITY, |low, cut| low.min(cut.to[2]));
    let (one, two) = (&left.cuts[0], &other.cuts[0]);
    if two.what != What::Feed || one.what != What::Feed {
        return cut(one, two, within);
    }
    if !above(&one.to, &two.to, within) {
        return Some((Class::Cut, format!("at {:.4?}, not {:.4?}", two.to, one.to)));
    }
    if !near(deepest(left), deepest(other), within) {
        return Some((Class::Cut, format!("down to {:.4}, not {:.4}", deepest(other), deepest(left))));
    }
    // a rapid into uncut material is a difference, unless the correct program has the same gap between two webs
    let gaps = |plunge: &Plunge| {
        let mut bottom = plunge.cuts[0].from[2];
        let mut list = Vec::new();
        for cut in &plunge.cuts {
            if cut.from[2] < bottom - within {
                list.push((bottom, cut.from[2]));
            }
            bottom = bottom.min(cut.to[2]);
        }
        list
    };
    let allowed = gaps(left);
    let free = |gap: &&(f64, f64)| !allowed.iter().any(|other| gap.0 <= other.0 + within && gap.1 >= other.1 - within);
    if let Some((bottom, to)) = gaps(other).iter().find(free) {
        return Some((Class::Cut, format!("a rapid to {to:.4}, cut so far to {bottom:.4}")));
    }
    if let (true, Some(found)) =
        (left.cuts.len() == other.cuts.len(), left.cuts.iter().zip(&other.cuts).find_map(|(a, b)| state(a, b)))
    {
        return Some(found);
    }
    let off = |(one, two): (&Act, &Act)| !near(one.to[2], two.to[2], within) || !near(one.from[2], two.from[2], within);
    (left.cuts.len() != other.cuts.len() || left.cuts.iter().zip(&other.cuts).any(off))
        .then(|| (Class::Pecks, format!("{} strokes, not {}", other.cuts.len(), left.cuts.len())))
}

/// The distance between the middles of two arcs.
fn between_arcs(left: &Act, other: &Act) -> Option<f64> {
    let [[a, b], [c, d]] = [arc_middle(left)?, arc_middle(other)?];
    Some((a - c).hypot(b - d))
}

/// The point in the middle of an arc, in its plane.
fn arc_middle(act: &Act) -> Option<[f64; 2]> {
    let What::Arc { plane, center, ccw, .. } = act.what else { return None };
    let [first, second] = match plane {
        18.0 => axes("xz"),
        19.0 => axes("yz"),
        _ => axes("xy"),
    };
    let from = [act.from[first] - center[0], act.from[second] - center[1]];
    let to = [act.to[first] - center[0], act.to[second] - center[1]];
    let turn = (to[1].atan2(to[0]) - from[1].atan2(from[0])).rem_euclid(TAU);
    let turn = match (turn, ccw) {
        (0.0, true) => TAU,
        (turn, true) => turn,
        (turn, false) => turn - TAU,
    };
    let (sin, cos) = (turn / 2.0).sin_cos();
    Some([center[0] + from[0] * cos - from[1] * sin, center[1] + from[0] * sin + from[1] * cos])
}

/// Whether two positions are equal, apart from their heights.
fn above(a: &Place, b: &Place, within: f64) -> bool {
    (0..2).all(|axis| near(a[axis], b[axis], within)) && turned(a, b)
}

/// Whether two cuts have the same start and end, and turn by the same angle.
fn same_places(a: &Act, b: &Act, within: f64) -> bool {
    let turns = |act: &Act, axis: usize| act.to[axis] - act.from[axis];
    same(&a.from, &b.from, within)
        && same(&a.to, &b.to, within)
        && (3..6).all(|axis| near(turns(a, axis), turns(b, axis), within))
}

fn cut(left: &Act, other: &Act, within: f64) -> Option<(Class, String)> {
    let places = || format!("{:.4?} to {:.4?}, not {:.4?} to {:.4?}", other.from, other.to, left.from, left.to);
    match (left.what, other.what) {
        (What::Feed, What::Feed) => {}
        (What::Thread(lead), What::Thread(is)) if near(lead, is, 0.003 * lead) => {}
        (What::Thread(_), What::Thread(_)) => return Some((Class::Feed, format!("{:?}", other.what))),
        (What::Arc { plane, center, ccw, turns }, What::Arc { plane: p, center: c, ccw: w, turns: t }) => {
            let differs = || format!("{:?}, not {:?}", other.what, left.what);
            if plane != p || ccw != w || turns != t {
                return Some((Class::Cut, differs()));
            }
            if !near(center[0], c[0], 0.01) || !near(center[1], c[1], 0.01) {
                // for a short arc, another centre changes little
                let near =
                    same_places(left, other, within) && between_arcs(left, other).is_some_and(|off| off <= 0.013);
                return Some((if near { Class::Near } else { Class::Cut }, differs()));
            }
        }
        (What::Hole { code, r, z, out, q, p, jog }, What::Hole { code: c, r: s, z: y, out: o, q: u, p: v, jog: k }) => {
            if code != c || !near(r, s, within) || !near(z, y, within) || jog != k {
                return Some((Class::Cut, format!("{:?}, not {:?}", other.what, left.what)));
            }
            if !near(p, v, 0.0011 + 0.01 * p) {
                return Some((Class::Dwell, format!("{v} s, not {p} s")));
            }
            if !near(q, u, within) {
                return Some((Class::Pecks, format!("Q{u}, not {q}")));
            }
            if !near(out, o, within) {
                return Some((Class::Way, format!("out to {o}, not {out}")));
            }
        }
        _ => return Some((Class::Cut, format!("{:?}, not {:?}", other.what, left.what))),
    }
    // the start of a cycle does not count, because the move to the start is a rapid
    let hole = matches!(left.what, What::Hole { .. });
    if !hole && !same_places(left, other, within) {
        // chords of an arc may differ by this distance
        let class = if same_places(left, other, 0.03) { Class::Near } else { Class::Cut };
        return Some((class, places()));
    }
    if hole && !above(&left.to, &other.to, within) {
        return Some((Class::Cut, places()));
    }
    state(left, other)
}

fn state(left: &Act, other: &Act) -> Option<(Class, String)> {
    let (is, was) = (&other.state, &left.state);
    // a tap controls the spindle itself
    let is_tap = matches!(left.what, What::Hole { code: 84.0 | 74.0, .. });
    let speed_off = (is.speed - was.speed).abs() > 0.01 * was.speed;
    // the lead of a thread is compared separately
    let thread = matches!(left.what, What::Thread(_));
    let feed_off = !thread && (is.feed.1 != was.feed.1 || (is.feed.0 - was.feed.0).abs() > 0.01 * was.feed.0);
    let classes = [
        (Class::Tool, is.tool != was.tool),
        (Class::Length, is.length != was.length),
        (Class::Work, is.work != was.work),
        (Class::Spindle, is.direction != was.direction && !is_tap || speed_off),
        (Class::Feed, feed_off),
        (Class::Side, is.side != was.side),
        (Class::Coolant, is.coolant != was.coolant),
    ];
    let (class, _) = classes.into_iter().find(|(_, off)| *off)?;
    Some((class, format!("{is:?}, not {was:?}")))
}

/// Compares stops, dwells, orientations and ends, each with the number of cuts before it.
fn others(right: &[Act], changed: &[Act], say: &mut impl FnMut(Class, String)) {
    let cuts = |acts: &[Act]| acts.iter().filter(|act| act.cuts()).count();
    let pick = |class: Class, what: &What| match (class, what) {
        (Class::Stop, What::Stop(kind)) => Some(*kind),
        (Class::Dwell, What::Dwell(seconds)) => Some(*seconds),
        (Class::Orientation, What::Orient(angle)) => Some(*angle),
        (Class::Tail, What::End) => Some(0.0),
        _ => None,
    };
    let list = |acts: &[Act], class: Class| {
        let mut cuts = 0;
        let mut list = Vec::new();
        for act in acts {
            if let Some(number) = pick(class, &act.what) {
                list.push((cuts, number, act.line));
            }
            cuts += usize::from(act.cuts());
        }
        list
    };
    let last = cuts(right).min(cuts(changed));
    for class in [Class::Stop, Class::Dwell, Class::Orientation, Class::Tail] {
        let (a, b) = (list(right, class), list(changed, class));
        let alike =
            |a: &(usize, f64, usize), b: &(usize, f64, usize)| a.0 == b.0 && near(a.1, b.1, 0.0011 + 0.01 * a.1.abs());
        let count = |list: &[(usize, f64, usize)]| list.iter().filter(|one| one.0 < last).count();
        let (head_a, head_b) = (&a[..count(&a)], &b[..count(&b)]);
        if head_a.len() != head_b.len() || !head_a.iter().zip(head_b).all(|(a, b)| alike(a, b)) {
            let at =
                head_a.iter().zip(head_b).position(|(a, b)| !alike(a, b)).unwrap_or(head_a.len().min(head_b.len()));
            say(class, format!("(cuts before, value, line) {:?}, not {:?}", head_b.get(at), head_a.get(at)));
        } else if a.len() != b.len() || !a.iter().zip(&b).all(|(a, b)| alike(a, b)) {
            say(Class::Tail, format!("{class:?} after the last cut"));
        }
    }
}

/// Compares the rapids between cuts.
fn ways(right: &[Act], changed: &[Act], within: f64, say: &mut impl FnMut(Class, String)) {
    let split = |acts: &[Act]| {
        let mut gaps: Vec<Vec<Act>> = vec![Vec::new()];
        for act in acts {
            if act.cuts() {
                gaps.push(Vec::new());
            } else if act.what == What::Rapid && !same(&act.from, &act.to, 1e-6) {
                gaps.last_mut().into_iter().for_each(|gap| gap.push(*act));
            }
        }
        gaps
    };
    let crossing = |gap: &[Act]| {
        gap.iter()
            .filter(|act| (0..2).any(|axis| !near(act.from[axis], act.to[axis], within)))
            .fold(f64::INFINITY, |low, act| low.min(act.from[2]).min(act.to[2]))
    };
    let (left, other) = (split(right), split(changed));
    let last = left.len().min(other.len()) - 1;
    for (at, (left, other)) in left.iter().zip(&other).enumerate() {
        let line = other.first().map_or(0, |act| act.line);
        let (low, should) = (crossing(other), crossing(left));
        let begins = other.first().map_or(f64::NAN, |act| act.from[2]);
        if low < should - within && !(at == last && low >= begins - within) {
            say(Class::Low, format!("line {line}: a rapid crosses at {low:.4}, not {should:.4}"));
        } else if left.len() != other.len() || left.iter().zip(other).any(|(a, b)| !same(&a.to, &b.to, within)) {
            say(if at == last { Class::Tail } else { Class::Way }, format!("line {line}: another way"));
        }
    }
}
