//! What each code switches, by the family of the control.

/// The family of a control: what differs between them here.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// Fanuc, Haas and their like.
    Fanuc,
    /// A Fadal: E is the work offset, H alone the length, heights without a length are the machine's.
    Fadal,
    /// LinuxCNC and Grbl.
    Linuxcnc,
}

impl Family {
    /// Of a control.
    pub fn of(control: &str) -> Family {
        match control {
            "fadal" => Family::Fadal,
            "linuxcnc" | "emc2" | "grbl" | "grblhal" | "pathpilot" | "mach3" => Family::Linuxcnc,
            _ => Family::Fanuc,
        }
    }

    /// P of a dwell in seconds: milliseconds where it has no point, which these forms print there.
    pub fn dwell(self, control: &str, number: f64) -> f64 {
        match self {
            Family::Linuxcnc => number,
            _ if matches!(control, "brother" | "centroid") => number,
            // Haas counts seconds where there is a point, and so much has none
            _ if control == "haas" && number < 50.0 => number,
            _ => number / 1000.0,
        }
    }
}

/// G codes without effect on what is cut.
pub fn is_harmless(code: f64) -> bool {
    [5.1, 8.0, 9.0, 11.0, 15.0, 22.0, 23.0, 50.0, 61.0, 64.0, 67.0, 69.0, 91.1, 103.0, 187.0].contains(&code)
}

/// Is it a canned cycle of a mill?
pub fn is_cycle(code: f64) -> bool {
    [73.0, 74.0, 76.0, 77.0, 78.0, 81.0, 82.0, 83.0, 84.0, 85.0, 86.0, 87.0, 88.0, 89.0].contains(&code)
}
