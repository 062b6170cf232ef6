//! The controls whose reading of a program the simulator knows.

/// Whose rules a program is run by.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Control {
    /// LinuxCNC 2.9, as observed.
    Linuxcnc,
    /// EMC as its manual of about 2005 describes the cycles; else as LinuxCNC.
    Emc2,
    /// The usual reading of Fanuc and Haas mills.
    #[default]
    Fanuc,
}

impl Control {
    /// All of them.
    pub const ALL: [Control; 3] = [Control::Linuxcnc, Control::Emc2, Control::Fanuc];

    /// As options write it.
    pub fn name(self) -> &'static str {
        match self {
            Control::Linuxcnc => "linuxcnc",
            Control::Emc2 => "emc2",
            Control::Fanuc => "fanuc",
        }
    }

    /// The rules for the programs of a form with this `Control`: GRBL reads moves as LinuxCNC does, Haas and FADAL as
    /// Fanuc (our decision).
    pub fn of_form(name: &str) -> Control {
        match name {
            "linuxcnc" | "grbl" => Control::Linuxcnc,
            "emc2" => Control::Emc2,
            _ => Control::Fanuc,
        }
    }

    /// Has it the interpreter of LinuxCNC and its predecessors?
    pub fn is_linuxcnc(self) -> bool {
        self != Control::Fanuc
    }
}
