//! The effect of codes, by the family of the control.

/// The family of a control. It covers the differences between controls that matter here.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// Fanuc, Haas and similar controls.
    Fanuc,
    /// A Fadal. E selects the work offset, H alone the length; without a length, heights are machine coordinates.
    Fadal,
    /// LinuxCNC and Grbl.
    Linuxcnc,
}

impl Family {
    /// The family of a control.
    pub fn of(control: &str) -> Family {
        match control {
            "fadal" => Family::Fadal,
            "linuxcnc" | "emc2" | "grbl" | "grblhal" | "pathpilot" | "mach3" => Family::Linuxcnc,
            _ => Family::Fanuc,
        }
    }

    /// Converts P of a dwell to seconds. P without a decimal point is in milliseconds, and these forms print no point.
    pub fn dwell(self, control: &str, number: f64) -> f64 {
        match self {
            Family::Linuxcnc => number,
            _ if matches!(control, "brother" | "centroid") => number,
            // on a Haas, P with a decimal point is in seconds; only such a P is as small as this
            _ if control == "haas" && number < 50.0 => number,
            _ => number / 1000.0,
        }
    }
}

/// Whether a G code has no effect on the cuts.
pub fn is_harmless(code: f64) -> bool {
    [5.1, 8.0, 9.0, 11.0, 15.0, 22.0, 23.0, 50.0, 61.0, 64.0, 67.0, 69.0, 91.1, 103.0, 187.0].contains(&code)
}

/// Whether a G code is a canned cycle of a mill.
pub fn is_cycle(code: f64) -> bool {
    [73.0, 74.0, 76.0, 77.0, 78.0, 81.0, 82.0, 83.0, 84.0, 85.0, 86.0, 87.0, 88.0, 89.0].contains(&code)
}
