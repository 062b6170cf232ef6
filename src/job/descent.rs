//! How the tool of a mill comes to its heights. A part that begins after left-out operations comes down from the tool change
//! to its first position, so it must not begin at a height that the tool reaches only inside a cut.

use crate::toolpath::{CycleSpec, Event};

/// The axis of the height, on a mill.
const HEIGHT: usize = 2;

/// The heights of the tool since the last change of the tool or the work offset.
#[derive(Clone, Copy, Debug)]
pub(super) struct Descent {
    /// The lowest height to which the tool came down by a rapid.
    pub lowest: Option<f64>,
    /// The height of the tool, if known.
    height: Option<f64>,
    /// Whether the tool came to its height by a rapid from above, or was raised to a height to which it had come down.
    pub is_clear: bool,
    /// The clearance of the open cycle above its points.
    clearance: f64,
}

impl Default for Descent {
    /// The heights after a change of the tool or the work offset: the tool comes from above.
    fn default() -> Descent {
        Descent { lowest: None, height: None, is_clear: true, clearance: 0.0 }
    }
}

impl Descent {
    /// Follows an event.
    pub fn follow(&mut self, event: &Event<'_>) {
        let to = event.target().and_then(|to| to.get(HEIGHT));
        match event {
            Event::Rapid(_) => self.rapid(to),
            Event::Infeed { infeed, .. } if infeed.rapid => self.rapid(to),
            Event::Outfeed { rapid: true, .. } => self.rapid(to),
            Event::Line { .. } | Event::Arc { .. } | Event::Infeed { .. } | Event::Outfeed { .. } => self.cut(to),
            Event::CycleBegin(spec) => self.clearance = clearance(spec),
            Event::Hole(_) => self.hole(to),
            Event::Work(_) => *self = Descent::default(),
            // from home, or from the unknown end of a subprogram
            Event::Home | Event::SubCall(_) => *self = Descent { lowest: self.lowest, ..Descent::default() },
            _ => {}
        }
    }

    /// A rapid to this height. `None`: the height stays.
    pub fn rapid(&mut self, to: Option<f64>) {
        let Some(to) = to else { return };
        if self.is_clear {
            self.comes_down(to);
        } else {
            let rises = self.height.is_none_or(|height| to > height);
            self.is_clear = rises && self.lowest.is_some_and(|lowest| to >= lowest);
        }
        self.height = Some(to);
    }

    fn comes_down(&mut self, to: f64) {
        self.lowest = Some(self.lowest.map_or(to, |lowest| lowest.min(to)));
    }

    /// A cut to this height. After a cut, the tool is clear only if the cut ends above the lowest height, or goes up to it.
    fn cut(&mut self, to: Option<f64>) {
        let (from, to) = (self.height, to.or(self.height));
        self.is_clear = match (from, to, self.lowest) {
            (Some(from), Some(to), Some(lowest)) => {
                to > from && to >= lowest || to == from && self.is_clear && to > lowest
            }
            _ => false,
        };
        self.height = to;
    }

    /// A hole with its point at this height: the tool comes down to the clearance, and returns to this height or higher.
    fn hole(&mut self, point: Option<f64>) {
        if let Some(point) = point {
            self.comes_down(point + self.clearance);
        }
        (self.is_clear, self.height) = (true, None);
    }
}

fn clearance(spec: &CycleSpec) -> f64 {
    spec.clear.unwrap_or(0.0).max(0.0)
}
