//! What a control's codes are to the simulator: their groups, the words they use.

use std::fmt;

pub use crate::control::Group;
use crate::control::{AxisWords, Code, Control, Meaning, Row, Rules};

/// Letters as bits.
pub const fn letters(text: &str) -> u32 {
    crate::control::Words::of(text).bits()
}

/// The bit of an upper-case letter.
pub const fn bit(letter: u8) -> u32 {
    1 << (letter - b'A')
}

/// Words that some code must use; all others may stand in any block.
pub const CHECKED: u32 = letters("DEHIJKLPQR");
/// Words of axes.
pub const AXES: u32 = letters("XYZABCUVW");

/// The group of a row of G codes in a block.
pub fn group(row: &Row, rules: Rules) -> Group {
    use Meaning as M;
    match row.meaning {
        M::Cycle | M::CycleEnd if rules == Rules::Fanuc => Group::Cycle,
        M::Harmless | M::TransformOff | M::MacroOff => Group::Other,
        meaning => meaning.group().unwrap_or(Group::Once),
    }
}

/// Does a row's code use the axis words without being a motion? X of a Fanuc's dwell is its time.
pub fn takes_axes(row: &Row, rules: Rules) -> bool {
    match row.meaning {
        Meaning::Reference => true,
        Meaning::Dwell => rules == Rules::Fanuc,
        meaning => meaning.axes() == AxisWords::Data,
    }
}

/// The row of ten times a G number; `None`: the control has no such code, or it is not run.
#[inline]
pub fn g_code(control: &'static Control, code: u16) -> Option<&'static Row> {
    control
        .row(Code { letter: b'G', tenths: code })
        .filter(|row| row.not_run.is_none() && is_simulated(row.meaning, code))
}

/// Why a G code that this control has is not run.
pub fn why_not_run(control: &Control, code: u16) -> Option<&str> {
    let row = control.row(Code { letter: b'G', tenths: code })?;
    let by_number = (!is_simulated(row.meaning, code)).then_some("its meaning is simulated for the usual numbers only");
    row.not_run.as_deref().or(by_number)
}

/// Is a G code of this meaning simulated under this number? A meaning says what a code switches; how exactly a cycle drills,
/// and which work offset or reference point is meant, is known by the number, as LinuxCNC, Fanuc and Haas document it.
#[inline]
fn is_simulated(meaning: Meaning, code: u16) -> bool {
    use Meaning as M;
    match meaning {
        M::Rapid => code == 0,
        M::Line => code == 10,
        M::ArcCw => code == 20,
        M::ArcCcw => code == 30,
        M::Thread => matches!(code, 320 | 330),
        M::RigidTap => code == 331,
        M::ThreadCycle => matches!(code, 760 | 920),
        M::Cycle => matches!(code, 730 | 740 | 760 | 810 | 820 | 830 | 840 | 850 | 860 | 870 | 880 | 890),
        M::CycleEnd => code == 800,
        M::Work => matches!(code, 540 | 541 | 550 | 560 | 570 | 580 | 590..=593 | 1540),
        M::Reference => matches!(code, 280 | 300),
        M::SetReference => matches!(code, 281 | 301),
        M::Frame | M::Preset => matches!(code, 520 | 920 | 500),
        M::FrameOff => matches!(code, 921..=923),
        _ => true,
    }
}

/// The row of an M number.
pub fn m_code(control: &'static Control, code: u16) -> Option<&'static Row> {
    control.row(Code { letter: b'M', tenths: code.checked_mul(10)? })
}

/// Groups of M codes: 0 changes nothing that is simulated.
pub fn m_group(row: &Row) -> u8 {
    use crate::control::Group as G;
    match row.meaning {
        Meaning::Call | Meaning::Return => 5,
        Meaning::ToolChange | Meaning::ToolNumber => 6,
        Meaning::Override => 9,
        Meaning::Orient => 7,
        meaning => match meaning.group() {
            Some(G::Stop) => 4,
            Some(G::Spindle) => 7,
            Some(G::Coolant) => 8,
            _ => 0,
        },
    }
}

/// A G code by ten times its number; it shows as `G91.1` for 911.
#[derive(Clone, Copy, Debug)]
pub struct Name(pub u16);

impl fmt::Display for Name {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (whole, tenth) = (self.0 / 10, self.0 % 10);
        if tenth == 0 { write!(f, "G{whole}") } else { write!(f, "G{whole}.{tenth}") }
    }
}
