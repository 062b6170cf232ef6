//! How exactly the words of an arc must agree.

use serde::Deserialize;

/// How far an arc's numbers may be from one circle.
#[derive(Clone, Copy, Debug, PartialEq, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Tolerance {
    /// The end may always be so far off the circle of the start, a length.
    pub least: f64,
    /// How far off the end may be as a part of the radius.
    pub part: f64,
    /// How far off the end may be whatever the radius, a length.
    pub most: f64,
    /// How much longer than R half the distance of the ends may be, a length.
    pub chord: f64,
}

impl Tolerance {
    /// Are they lengths?
    pub fn is_possible(&self) -> bool {
        let Tolerance { least, part, most, chord } = *self;
        [least, part, most, chord].iter().all(|length| length.is_finite() && *length >= 0.0) && least <= most
    }

    /// Is a circle that begins at one radius and ends at the other no circle?
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
    /// In inches; not said: the same lengths as in millimetres.
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
