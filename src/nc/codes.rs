//! G and M codes in tables: their modal groups, the words they use, the controls that have them.

use super::control::Control;

/// Letters as bits.
pub const fn letters(text: &str) -> u32 {
    let bytes = text.as_bytes();
    let (mut bits, mut i) = (0, 0);
    while i < bytes.len() {
        bits |= bit(bytes[i]);
        i += 1;
    }
    bits
}

/// The bit of an upper-case letter.
pub const fn bit(letter: u8) -> u32 {
    1 << (letter - b'A')
}

/// Words that some code must use; all others may stand in any block.
pub const CHECKED: u32 = letters("DEHIJKLPQR");
/// Words of axes.
pub const AXES: u32 = letters("XYZABCUVW");

/// Modal groups of G codes, as NIST numbered them; on a Fanuc the cycles are one of their own.
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

/// A G code.
#[derive(Debug)]
pub struct GCode {
    /// Ten times its number.
    pub code: u16,
    /// Its group.
    pub group: Group,
    /// Words it uses besides axes, F, S, T.
    pub words: u32,
    /// It uses axis words without being a motion.
    pub takes_axes: bool,
}

const fn g(code: u16, group: Group, words: &str) -> GCode {
    GCode { code, group, words: letters(words), takes_axes: false }
}

const fn axes(code: u16, words: &str) -> GCode {
    GCode { code, group: Group::Once, words: letters(words), takes_axes: true }
}

/// Codes that LinuxCNC has, in the order of their numbers.
const LINUXCNC: &[GCode] = &[
    g(0, Group::Motion, ""),
    g(10, Group::Motion, ""),
    g(20, Group::Motion, "IJKPR"),
    g(30, Group::Motion, "IJKPR"),
    g(40, Group::Once, "P"),
    g(70, Group::Diameter, ""),
    g(80, Group::Diameter, ""),
    axes(100, "IJLPQR"),
    g(170, Group::Plane, ""),
    g(180, Group::Plane, ""),
    g(190, Group::Plane, ""),
    g(200, Group::Units, ""),
    g(210, Group::Units, ""),
    axes(280, ""),
    g(281, Group::Once, ""),
    axes(300, ""),
    g(301, Group::Once, ""),
    g(330, Group::Motion, "K"),
    g(331, Group::Motion, "IK"),
    g(400, Group::Compensation, ""),
    g(410, Group::Compensation, "D"),
    g(411, Group::Compensation, "DL"),
    g(420, Group::Compensation, "D"),
    g(421, Group::Compensation, "DL"),
    g(430, Group::Length, "H"),
    GCode { code: 431, group: Group::Length, words: 0, takes_axes: true },
    g(432, Group::Length, "H"),
    g(490, Group::Length, ""),
    axes(520, ""),
    g(530, Group::Once, ""),
    g(540, Group::Work, ""),
    g(550, Group::Work, ""),
    g(560, Group::Work, ""),
    g(570, Group::Work, ""),
    g(580, Group::Work, ""),
    g(590, Group::Work, ""),
    g(591, Group::Work, ""),
    g(592, Group::Work, ""),
    g(593, Group::Work, ""),
    g(610, Group::Path, ""),
    g(611, Group::Path, ""),
    g(640, Group::Path, "PQ"),
    g(730, Group::Motion, "LQR"),
    g(740, Group::Motion, "PR"),
    g(760, Group::Motion, "EHIJKLPQR"),
    g(800, Group::Motion, ""),
    g(810, Group::Motion, "LR"),
    g(820, Group::Motion, "LPR"),
    g(830, Group::Motion, "LQR"),
    g(840, Group::Motion, "LPR"),
    g(850, Group::Motion, "LR"),
    g(860, Group::Motion, "LPR"),
    g(870, Group::Motion, "IJKLR"),
    g(880, Group::Motion, "LPR"),
    g(890, Group::Motion, "LPR"),
    g(900, Group::Distance, ""),
    g(901, Group::ArcDistance, ""),
    g(910, Group::Distance, ""),
    g(911, Group::ArcDistance, ""),
    axes(920, ""),
    g(921, Group::Once, ""),
    g(922, Group::Once, ""),
    g(923, Group::Once, ""),
    g(930, Group::FeedMode, ""),
    g(940, Group::FeedMode, ""),
    g(950, Group::FeedMode, ""),
    g(960, Group::SpindleMode, "D"),
    g(970, Group::SpindleMode, ""),
    g(980, Group::Return, ""),
    g(990, Group::Return, ""),
];

/// Codes of Fanuc and Haas mills, in the order of their numbers. Look-ahead codes have P, Q and R of their own.
const FANUC: &[GCode] = &[
    g(0, Group::Motion, ""),
    g(10, Group::Motion, ""),
    g(20, Group::Motion, "IJKRP"),
    g(30, Group::Motion, "IJKRP"),
    axes(40, "P"),
    g(51, Group::Other, "PQR"),
    g(80, Group::Other, "P"),
    g(90, Group::Once, ""),
    axes(100, "LPR"),
    g(110, Group::Other, ""),
    g(150, Group::Other, ""),
    g(170, Group::Plane, ""),
    g(180, Group::Plane, ""),
    g(190, Group::Plane, ""),
    g(200, Group::Units, ""),
    g(210, Group::Units, ""),
    g(220, Group::Other, "IJK"),
    g(230, Group::Other, ""),
    g(250, Group::Other, ""),
    axes(280, ""),
    axes(300, "P"),
    g(400, Group::Compensation, ""),
    g(410, Group::Compensation, "D"),
    g(420, Group::Compensation, "D"),
    g(430, Group::Length, "H"),
    g(440, Group::Length, "H"),
    g(490, Group::Length, ""),
    g(500, Group::Other, ""),
    axes(520, ""),
    g(530, Group::Once, ""),
    g(540, Group::Work, ""),
    g(541, Group::Work, "P"),
    g(550, Group::Work, ""),
    g(560, Group::Work, ""),
    g(570, Group::Work, ""),
    g(580, Group::Work, ""),
    g(590, Group::Work, ""),
    g(610, Group::Path, ""),
    g(640, Group::Path, ""),
    g(670, Group::Other, ""),
    g(690, Group::Other, ""),
    g(730, Group::Cycle, "KLPQR"),
    g(740, Group::Cycle, "KLPQR"),
    g(760, Group::Cycle, "IJKLPQR"),
    g(800, Group::Cycle, ""),
    g(810, Group::Cycle, "KLR"),
    g(820, Group::Cycle, "KLPR"),
    g(830, Group::Cycle, "KLPQR"),
    g(840, Group::Cycle, "KLPQR"),
    g(850, Group::Cycle, "KLR"),
    g(860, Group::Cycle, "KLPR"),
    g(870, Group::Cycle, "IJKLPQR"),
    g(880, Group::Cycle, "KLPR"),
    g(890, Group::Cycle, "KLPR"),
    g(900, Group::Distance, ""),
    g(910, Group::Distance, ""),
    axes(920, ""),
    g(930, Group::FeedMode, ""),
    g(940, Group::FeedMode, ""),
    g(950, Group::FeedMode, ""),
    g(960, Group::SpindleMode, ""),
    g(970, Group::SpindleMode, ""),
    g(980, Group::Return, ""),
    g(990, Group::Return, ""),
    g(1030, Group::Other, "P"),
    g(1540, Group::Work, "P"),
    g(1870, Group::Other, "EP"),
];

/// Codes that a control has and the simulator does not run, and why.
const NOT_RUN: &[(u16, &str)] = &[
    (31, "how far a skip goes is known only at the machine"),
    (38, "where a probe touches is known only at the machine"),
    (5, "splines are not simulated"),
    (7, "cylindrical interpolation is not simulated"),
    (12, "circular pocket cycles are not simulated"),
    (13, "circular pocket cycles are not simulated"),
    (16, "polar coordinates by G16 are not simulated"),
    (33, "threading by G33 and rigid tapping by G33.1 are simulated for LinuxCNC only"),
    (41, "three-dimensional cutter compensation is not simulated: G41 and G42 are"),
    (42, "three-dimensional cutter compensation is not simulated: G41 and G42 are"),
    (43, "tool centre point control is not simulated: G43 and G44 are"),
    (47, "engraving is not simulated"),
    (51, "scaling and mirror images are not simulated"),
    (65, "macro calls are not simulated"),
    (66, "modal macro calls are not simulated"),
    (68, "rotated coordinates by G68 are not simulated"),
    (70, "bolt hole patterns and lathe cycles are not simulated"),
    (71, "bolt hole patterns and lathe cycles are not simulated"),
    (72, "bolt hole patterns and lathe cycles are not simulated"),
    (150, "pocket milling is not simulated"),
];

/// Highest code of the tables.
const HIGHEST: usize = 1870;
/// Rows by code: where in the table, or past its end.
static OF_LINUXCNC: [u8; HIGHEST + 1] = index(LINUXCNC);
static OF_FANUC: [u8; HIGHEST + 1] = index(FANUC);

const fn index(table: &[GCode]) -> [u8; HIGHEST + 1] {
    let mut rows = [u8::MAX; HIGHEST + 1];
    let mut i = 0;
    while i < table.len() {
        rows[table[i].code as usize] = i as u8;
        i += 1;
    }
    rows
}

/// The table row of ten times a G number.
#[inline]
pub fn g_code(control: Control, code: u16) -> Option<&'static GCode> {
    let (table, index) = if control.is_linuxcnc() { (LINUXCNC, &OF_LINUXCNC) } else { (FANUC, &OF_FANUC) };
    table.get(usize::from(*index.get(usize::from(code))?))
}

/// Why a code that some control has is not run.
pub fn why_not_run(code: u16) -> Option<&'static str> {
    NOT_RUN.iter().find(|(number, _)| *number == code / 10).map(|(_, why)| *why)
}

/// Groups of M codes: 0 changes nothing that is simulated.
pub fn m_group(control: Control, code: u16) -> Option<u8> {
    Some(match code {
        0 | 1 | 2 | 30 | 60 => 4,
        98 | 99 => 5,
        6 => 6,
        61 if control.is_linuxcnc() => 6,
        3 | 4 | 5 | 19 => 7,
        7..=9 => 8,
        48 | 49 => 9,
        50..=53 | 62..=65 | 67 | 68 | 70..=73 if control.is_linuxcnc() => 0,
        _ if control.is_linuxcnc() => return None,
        // the machine builder's
        _ => 0,
    })
}

/// Words that an M code uses.
pub fn m_words(control: Control, code: u16) -> u32 {
    match code {
        98 => letters("LP"),
        19 => letters("RPQ"),
        50..=53 => letters("P"),
        62..=65 => letters("P"),
        67 | 68 => letters("EQ"),
        61 => letters("Q"),
        _ if control.is_linuxcnc() => 0,
        // what a builder's code takes, only the builder knows
        97 | 99 => letters("LP"),
        6 | 29 => letters("DH"),
        _ => letters("PQRHLK"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_are_in_order() {
        for table in [LINUXCNC, FANUC] {
            assert!(table.windows(2).all(|pair| pair[0].code < pair[1].code));
        }
    }
}
