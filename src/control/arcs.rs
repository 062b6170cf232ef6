//! Tolerances for the words of an arc.

use serde::Deserialize;

/// The allowed deviations of the numbers of an arc from one circle.
#[derive(Clone, Copy, Debug, PartialEq, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Tolerance {
    /// If the end is at most this distance from the circle through the start, the arc is accepted. A length.
    pub least: f64,
    /// Allowed distance of the end from the circle, as a fraction of the radius.
    pub part: f64,
    /// If the end is farther from the circle than this distance, the arc is refused. A length.
    pub most: f64,
    /// Half the distance between start and end may exceed the radius R by this length.
    pub chord: f64,
}

impl Tolerance {
    /// Whether all values are finite and not negative, and `least` is at most `most`.
    pub fn is_possible(&self) -> bool {
        let Tolerance { least, part, most, chord } = *self;
        [least, part, most, chord].iter().all(|length| length.is_finite() && *length >= 0.0) && least <= most
    }

    /// Whether an arc with these radii at its start and at its end is refused.
    pub fn refuses(&self, start: f64, end: f64) -> bool {
        let off = (start - end).abs();
        off > self.most || (off > self.least && off > self.part * start)
    }
}

/// The tolerances of a control for programs in millimetres and in inches.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Arcs {
    /// The tolerance for programs in millimetres.
    pub mm: Tolerance,
    /// The tolerance for programs in inches; `None`: the same lengths as in millimetres.
    pub inch: Option<Tolerance>,
}

impl Arcs {
    /// The tolerance for a program in inches or in millimetres.
    pub fn tolerance(&self, inch: bool) -> Tolerance {
        let Tolerance { least, part, most, chord } = self.mm;
        match self.inch {
            _ if !inch => self.mm,
            Some(inch) => inch,
            None => Tolerance { least: least / 25.4, part, most: most / 25.4, chord: chord / 25.4 },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_arc_is_refused_by_its_length_and_by_its_radius() {
        let mm = Tolerance { least: 0.005, part: 0.001, most: 0.5, chord: 0.0 };
        let arcs = Arcs { mm, inch: None };
        let refuses = |start: f64, end: f64| arcs.tolerance(false).refuses(start, end);
        assert!(!refuses(1.0, 1.004) && refuses(1.0, 1.006));
        assert!(!refuses(100.0, 100.09) && refuses(100.0, 100.11));
        assert!(!refuses(1000.0, 1000.49) && refuses(1000.0, 1000.6));
        assert!(arcs.tolerance(true).refuses(1.0, 1.002));
        assert!(!Arcs { mm, inch: Some(mm) }.tolerance(true).refuses(1.0, 1.002));
    }
}
