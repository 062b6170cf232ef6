//! The controls that come with postform.

use std::sync::{LazyLock, OnceLock};

use super::Control;

macro_rules! shipped {
    ($($name:literal),* $(,)?) => {
        [$(($name, include_str!(concat!("../../controls/", $name, ".toml")))),*]
    };
}

/// The control files that come with postform: name and text. The first one is the usual control.
pub(super) const FILES: &[(&str, &str)] = &shipped![
    "fanuc",
    "fanuc-lathe",
    "fanuc-wire",
    "haas",
    "haas-lathe",
    "fadal",
    "mazak",
    "brother",
    "centroid",
    "mitsubishi",
    "siemens",
    "siemens-iso",
    "heidenhain",
    "okuma",
    "linuxcnc",
    "emc2",
    "grbl",
    "grblhal",
    "fluidnc",
    "pathpilot",
    "mach3",
];

/// The controls that come with postform. A file is read at the first use of its control.
static CONTROLS: [OnceLock<Control>; FILES.len()] = [const { OnceLock::new() }; FILES.len()];

/// The names of the controls that come with postform.
pub fn names() -> impl Iterator<Item = &'static str> + Clone {
    FILES.iter().map(|(name, _)| *name)
}

/// The control with this index in the list of files.
fn shipped(at: usize) -> &'static Control {
    let (name, text) = FILES[at];
    CONTROLS[at].get_or_init(|| Control::read(name, text).unwrap_or_else(|_| Control::empty()))
}

impl Control {
    /// The control with this name, if it comes with postform.
    pub fn named(name: &str) -> Option<&'static Control> {
        names().position(|known| known == name).map(shipped)
    }

    /// The control for programs without a named control: a Fanuc mill.
    pub fn usual() -> &'static Control {
        shipped(0)
    }

    /// The control for forms without a `Control` command: a Fanuc mill with additional common codes of other controls.
    /// This control is not used for running programs.
    pub fn of_no_name() -> &'static Control {
        static UNION: LazyLock<Control> = LazyLock::new(|| {
            let text = include_str!("../../controls/of-no-name.toml");
            Control::read("of-no-name", text).unwrap_or_else(|_| Control::empty())
        });
        &UNION
    }
}
