//! The words of a CYCLE statement: types, options, and which of them may be combined.

use crate::toolpath::CycleKind;

/// The types of cycles. Some types may be modified by a second word.
pub(super) const TYPES: &[(&str, CycleKind)] = &[
    ("DRILL", CycleKind::Drill),
    ("FACE", CycleKind::Face),
    ("TAP", CycleKind::Tap),
    ("BORE", CycleKind::Bore),
    ("REAM", CycleKind::Ream),
    ("DEEP", CycleKind::Deep),
    ("BRKCHP", CycleKind::Chipbreak),
    ("THRU", CycleKind::Thru),
    ("CSINK", CycleKind::Csink),
    ("MANUAL", CycleKind::Manual),
    // the counterbore of AZpost
    ("CBORE", CycleKind::Face),
];

/// An option of a cycle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Opt {
    Depth,
    Step,
    Clear,
    Return,
    Rapto,
    Dwell,
    Rev,
    Back,
    Decr,
    Minstp,
    Times,
    Ratio,
    Multrd,
    Invers,
    Norevr,
    Rapout,
    Float,
    Rigid,
    Orient,
    Ofsetl,
    Diamet,
    Tlangl,
    Holdia,
    Feed,
    Side,
}

/// A row of the option table: the word, the number of its values, and whether they may be negative.
pub(super) struct OptionRow {
    pub word: &'static str,
    pub option: Opt,
    pub least: usize,
    pub most: usize,
    pub signed: bool,
    /// The types that accept the option. Empty: all types except MANUAL.
    pub types: &'static [CycleKind],
}

use CycleKind as K;
use Opt as O;

const ANY: &[K] = &[];
const PECKS: &[K] = &[K::Deep, K::Chipbreak];
const TAPS: &[K] = &[K::Tap];
const BORES: &[K] = &[K::Bore, K::Back];

#[rustfmt::skip]
pub(super) const OPTIONS: &[OptionRow] = &[
    row("DEPTH",  O::Depth,  1, 64, true,  &[K::Drill, K::Face, K::Tap, K::Bore, K::Back, K::Ream, K::Deep, K::Chipbreak, K::Thru]),
    row("STEP",   O::Step,   1, 64, false, PECKS),
    row("CLEAR",  O::Clear,  1, 2,  true,  &[K::Drill, K::Face, K::Tap, K::Bore, K::Back, K::Ream, K::Deep, K::Chipbreak, K::Thru, K::Csink, K::Manual]),
    row("RETURN", O::Return, 0, 1,  true,  ANY),
    row("RAPTO",  O::Rapto,  1, 1,  false, ANY),
    row("DWELL",  O::Dwell,  0, 1,  false, ANY),
    row("REV",    O::Rev,    1, 1,  false, ANY),
    row("BACK",   O::Back,   1, 1,  false, &[K::Bore, K::Back, K::Deep, K::Chipbreak, K::Thru]),
    row("DECR",   O::Decr,   1, 1,  false, PECKS),
    row("MINSTP", O::Minstp, 1, 1,  false, PECKS),
    row("TIMES",  O::Times,  1, 1,  false, &[K::Chipbreak]),
    row("RATIO",  O::Ratio,  1, 1,  false, &[K::Tap, K::Ream]),
    row("MULTRD", O::Multrd, 1, 1,  false, TAPS),
    row("INVERS", O::Invers, 0, 0,  false, TAPS),
    row("NOREVR", O::Norevr, 0, 0,  false, TAPS),
    row("RAPOUT", O::Rapout, 0, 0,  false, TAPS),
    row("FLOAT",  O::Float,  0, 0,  false, TAPS),
    row("RIGID",  O::Rigid,  0, 0,  false, TAPS),
    row("ORIENT", O::Orient, 0, 1,  true,  &[K::Bore, K::Back, K::Tap]),
    row("OFSETL", O::Ofsetl, 1, 2,  true,  BORES),
    row("DIAMET", O::Diamet, 1, 1,  false, &[K::Csink]),
    row("DIAMTR", O::Diamet, 1, 1,  false, &[K::Csink]),
    row("TLANGL", O::Tlangl, 1, 1,  false, &[K::Csink]),
    row("HOLDIA", O::Holdia, 1, 1,  false, &[K::Csink]),
    row("IPM",    O::Feed,   1, 1,  true,  ANY),
    row("IPR",    O::Feed,   1, 1,  true,  ANY),
    row("MMPM",   O::Feed,   1, 1,  true,  ANY),
    row("MMPR",   O::Feed,   1, 1,  true,  ANY),
    row("PERMIN", O::Feed,   1, 1,  true,  ANY),
    row("PERREV", O::Feed,   1, 1,  true,  ANY),
    row("UPM",    O::Feed,   1, 1,  true,  ANY),
    row("UPR",    O::Feed,   1, 1,  true,  ANY),
    row("TPI",    O::Feed,   1, 1,  true,  ANY),
    row("SIDE",   O::Side,   1, 1,  true,  TAPS),
];

const fn row(
    word: &'static str,
    option: Opt,
    least: usize,
    most: usize,
    signed: bool,
    types: &'static [K],
) -> OptionRow {
    OptionRow { word, option, least, most, signed, types }
}
