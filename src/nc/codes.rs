//! What a control's codes are to the simulator: their groups, the words they use.

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

/// Groups of G codes in a block, as NIST numbered them; on a Fanuc the cycles are one of their own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
#[repr(u8)]
pub enum Group {
    Once,
    Motion,
    Plane,
    Distance,
    ArcDistance,
    FeedMode,
    Units,
    Compensation,
    Length,
    Return,
    Work,
    Path,
    SpindleMode,
    Diameter,
    /// Cycles of a Fanuc.
    Cycle,
    /// Codes that change nothing that is simulated.
    Other,
}

/// The group of a row of G codes.
pub fn group(row: &Row, rules: Rules) -> Group {
    use Meaning as M;
    match row.meaning {
        M::Cycle | M::CycleEnd if rules == Rules::Fanuc => Group::Cycle,
        M::Dwell | M::ExactStop => Group::Once,
        meaning => match meaning.group() {
            Some(crate::control::Group::Motion) => Group::Motion,
            Some(crate::control::Group::Plane) => Group::Plane,
            Some(crate::control::Group::Distance) => Group::Distance,
            Some(crate::control::Group::ArcDistance) => Group::ArcDistance,
            Some(crate::control::Group::FeedMode) => Group::FeedMode,
            Some(crate::control::Group::Units) => Group::Units,
            Some(crate::control::Group::Compensation) => Group::Compensation,
            Some(crate::control::Group::Length) => Group::Length,
            Some(crate::control::Group::Return) => Group::Return,
            Some(crate::control::Group::Work) => Group::Work,
            Some(crate::control::Group::Path) => Group::Path,
            Some(crate::control::Group::SpeedMode) => Group::SpindleMode,
            Some(crate::control::Group::Diameter) => Group::Diameter,
            _ if meaning == M::Harmless => Group::Other,
            _ => Group::Once,
        },
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
    control.row(Code { letter: b'G', tenths: code }).filter(|row| row.meaning != Meaning::NotRun)
}

/// Why a G code that this control has is not run.
pub fn why_not_run(control: &Control, code: u16) -> Option<&str> {
    let row = control.row(Code { letter: b'G', tenths: code })?;
    (row.meaning == Meaning::NotRun).then_some(row.text.as_str())
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
        meaning => match meaning.group() {
            Some(G::Stop) => 4,
            Some(G::Spindle) => 7,
            Some(G::Coolant) => 8,
            _ => 0,
        },
    }
}
