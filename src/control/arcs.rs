//! Tolerances for the words of an arc.

use serde::Deserialize;

/// How far the numbers of an arc may deviate from one circle.
#[derive(Clone, Copy, Debug, PartialEq, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Tolerance {
    /// Distance from the circle of the start up to which the end is always accepted, a length.
    pub least: f64,
    /// Allowed distance of the end from the circle, as a fraction of the radius.
    pub part: f64,
    /// Distance of the end from the circle above which the arc is always refused, a length.
    pub most: f64,
    /// Amount by which half the distance of the ends may be greater than R, a length.
    pub chord: f64,
}

impl Tolerance {
    /// Whether all values are valid lengths.
    pub fn is_possible(&self) -> bool {
        let Tolerance { least, part, most, chord } = *self;
        [least, part, most, chord].iter().all(|length| length.is_finite() && *length >= 0.0) && least <= most
    }

    /// Whether an arc with these radii at its start and end is refused.
    pub fn refuses(&self, start: f64, end: f64) -> bool {
        let off = (start - end).abs();
        off > self.most || (off > self.least && off > self.part * start)
    }
}

/// Tolerances by the units of the program.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Arcs {
    /// In millimetres.
    pub mm: Tolerance,
    /// In inches; `None`: the same lengths as in millimetres.
    pub inch: Option<Tolerance>,
}

impl Arcs {
    /// The tolerance of a program in these units.
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
