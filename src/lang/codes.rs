//! What the renderer must know of the codes of controls: modal groups, and codes that move the frame.

/// A modal group: its codes cancel each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[repr(u8)]
pub enum Group {
    /// G0 G1 G2 G3, threads and canned cycles.
    Motion,
    /// G17 G18 G19.
    Plane,
    /// G90 G91.
    Distance,
    /// G93 G94 G95.
    FeedMode,
    /// G20 G21, G70 G71.
    Units,
    /// G40 G41 G42.
    CutterCompensation,
    /// G43 G44 G49.
    LengthOffset,
    /// G54 to G59.
    Work,
    /// G98 G99.
    ReturnPlane,
    /// G96 G97.
    SpeedMode,
    /// G61 G64.
    PathMode,
    /// M3 M4 M5.
    Spindle,
    /// M7 M8 M9.
    Coolant,
}

/// How many groups there are.
pub const GROUPS: usize = 13;

/// What a code does to the meaning of axis words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Frame {
    /// Axis words of its block stand in another frame, and the axes go where they say: reference points, machine
    /// coordinates. Without axis words all axes go.
    Block,
    /// Axis words after it are increments, until G90.
    Increments,
    /// Axis words after it in the same body may stand in another frame.
    Shifts,
    /// From here on axis positions mean another place.
    Moves,
    /// The depth position means another place.
    MovesDepth,
}

/// Codes by letter, code times ten (`G59.1` is 591), group. Mill readings; FeedMode also has the lathe's G98 G99,
/// which forms name by FeedType.
#[rustfmt::skip]
pub const NC_CODES: &[(u8, u16, u16, Group)] = &[
    (b'G',    0,   30, Group::Motion),
    (b'G',  320,  339, Group::Motion),
    (b'G',  380,  389, Group::Motion),
    (b'G',  730,  740, Group::Motion),
    (b'G',  760,  760, Group::Motion),
    (b'G',  800,  890, Group::Motion),
    (b'G',  170,  199, Group::Plane),
    (b'G',  900,  900, Group::Distance),
    (b'G',  910,  910, Group::Distance),
    (b'G',  930,  950, Group::FeedMode),
    (b'G',  200,  210, Group::Units),
    (b'G',  700,  710, Group::Units),
    (b'G',  400,  429, Group::CutterCompensation),
    (b'G',  430,  449, Group::LengthOffset),
    (b'G',  490,  490, Group::LengthOffset),
    (b'G',  540,  599, Group::Work),
    (b'G',  980,  990, Group::ReturnPlane),
    (b'G',  960,  970, Group::SpeedMode),
    (b'G',  610,  649, Group::PathMode),
    (b'M',   30,   50, Group::Spindle),
    (b'M',   70,   90, Group::Coolant),
];

/// The modal group of a code, given in tenths.
pub fn group_of(letter: u8, tenths: i64) -> Option<Group> {
    NC_CODES
        .iter()
        .find(|&&(l, from, to, _)| l == letter && (i64::from(from)..=i64::from(to)).contains(&tenths))
        .map(|row| row.3)
}

/// Does this M code, given in tenths, stop the program (M0) or may it (M1)? On many controls the spindle and the
/// coolant stop with it.
pub fn is_stop(tenths: i64) -> bool {
    matches!(tenths, 0 | 10)
}

/// Does this M code, given in tenths, change the tool? The changer moves the axes.
pub fn changes_tool(tenths: i64) -> bool {
    tenths == 60
}

/// What a G code, given in tenths, does to axis positions.
pub fn frame_of(tenths: i64) -> Option<Frame> {
    match tenths {
        280 | 300 | 530 => Some(Frame::Block),
        910 => Some(Frame::Increments),
        920 => Some(Frame::Shifts),
        100 | 121 | 131 | 160 | 500 | 501 | 510 | 511 | 520 | 531 | 540..=599 | 680..=692 | 921..=923 | 1540 => {
            Some(Frame::Moves)
        }
        430..=449 | 490 => Some(Frame::MovesDepth),
        _ => None,
    }
}

/// A job's work offset as a form counts it, whose first one is `first`: a number below 50 counts fixtures from 1, from 50
/// on it is the code itself. A form that counts from a small number (`G15 H1`, `E1`) takes 54 to 59 for its first six;
/// other codes it does not have.
pub fn work_code(first: f64, work: f64) -> Option<f64> {
    const CODES: std::ops::RangeInclusive<f64> = 54.0..=59.0;
    match work {
        _ if (1.0..50.0).contains(&work) => Some(first + work - 1.0),
        _ if first >= 50.0 || work < 1.0 => Some(work),
        _ if CODES.contains(&work) && work.fract() == 0.0 => Some(first + work - CODES.start()),
        _ => None,
    }
}

/// The machine-cycle codes of controls: G73, G74, G76 and G81 to G89.
pub fn is_cycle_code(code: f64) -> bool {
    [73.0, 74.0, 76.0].contains(&code) || (81.0..90.0).contains(&code)
}

/// Does the control move by itself after this G code: a cycle, a thread (it feeds by its pitch), a macro, or a code
/// above G100, which is the machine builder's own?
pub fn moves_by_itself(code: f64) -> bool {
    is_cycle_code(code) || [32.0, 33.0, 33.1, 63.0].contains(&code) || is_called(code)
}

/// The codes of macro calls, and those above G100.
pub fn is_called(code: f64) -> bool {
    [65.0, 66.0].contains(&code) || code >= 100.0
}

/// Does a G code end what the control does by itself: a motion of another kind, G80, or G67 after a macro?
pub fn ends_cycle(code: f64) -> bool {
    (0.0..4.0).contains(&code) || [67.0, 80.0].contains(&code)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_know_their_groups() {
        assert_eq!(group_of(b'G', 20), Some(Group::Motion));
        assert_eq!(group_of(b'G', 591), Some(Group::Work));
        assert_eq!(group_of(b'G', 901), None);
        assert_eq!(group_of(b'G', 3060), None);
        assert_eq!(group_of(b'M', 80), Some(Group::Coolant));
        assert_eq!(group_of(b'M', 60), None);
    }
}
