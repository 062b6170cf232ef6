//! Speeds in corners by junction deviation, as in Grbl: see `plan_buffer_line` and `plan_compute_profile_parameters` in
//! Grbl's planner.c. Grbl treats the chords of an arc as lines.

use super::leg::Leg;
use super::queue::Queue;
use super::rates::{Rates, Way, size};

/// Limit of the cosine at a corner. Above this value, the directions count as opposite. Below the negative value, the
/// directions count as equal. Grbl uses the same value.
const SAME: f64 = 0.999_999;

/// The state between two legs.
#[derive(Clone, Debug)]
pub(super) struct Deviation {
    /// Greatest distance of the path from a corner, in millimetres.
    deviation: f64,
    /// Direction of the last leg; `None`: the tool is at rest.
    direction: Option<Way>,
}

impl Deviation {
    pub fn new(deviation: f64) -> Deviation {
        Deviation { deviation, direction: None }
    }

    pub fn stop(&mut self) {
        self.direction = None;
    }

    /// Adds a line. `feed` is the feed of a cut in millimetres per second; `None`: a rapid.
    pub fn line(&mut self, way: &Way, feed: Option<f64>, rates: &Rates, queue: &mut Queue) {
        let all = size(way);
        if all == 0.0 {
            return;
        }
        let length = rates.length(way);
        let along = way.map(|part| part / length);
        let speed = rates.speed(&along, feed);
        if !(speed > 0.0 && speed.is_finite()) {
            // the speed of the line is unknown
            self.stop();
            return queue.stop();
        }
        let direction = way.map(|part| part / all);
        let speed = speed * speed;
        let corner = match (&self.direction, queue.last()) {
            (Some(before), Some(last)) => self.corner(rates, before, &direction).min(last.speed),
            _ => 0.0,
        };
        let acceleration = rates.along(&along, |axis| axis.acceleration);
        self.direction = Some(direction);
        queue.push(Leg {
            length,
            speed,
            acceleration,
            most_entry: corner.min(speed),
            entry: 0.0,
            is_cut: feed.is_some(),
            row: queue.row(),
        });
    }

    /// The square of the greatest speed at a corner between two directions; infinite if the directions are the same.
    fn corner(&self, rates: &Rates, before: &Way, after: &Way) -> f64 {
        let cosine: f64 = before.iter().zip(after).map(|(before, after)| -before * after).sum();
        if cosine > SAME {
            // reversal of the direction
            return 0.0;
        }
        if cosine < -SAME {
            return f64::INFINITY;
        }
        let inwards: Way = std::array::from_fn(|axis| after[axis] - before[axis]);
        let inwards = inwards.map(|part| part / size(&inwards));
        let acceleration = rates.along(&inwards, |axis| axis.acceleration);
        let half_sine = (0.5 * (1.0 - cosine)).sqrt();
        acceleration * self.deviation * half_sine / (1.0 - half_sine)
    }
}
