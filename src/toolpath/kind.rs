//! Kinds of canned cycles, and the sequence of the form for each kind.

use super::tool::SpindleTurn;
use crate::lang::SequenceId;

/// Kinds of canned cycles (docs/cycles.md).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CycleKind {
    /// Feed in, rapid out.
    Drill,
    /// Feed in, dwell, rapid out: spot facing.
    Face,
    /// A tap for a right-hand thread.
    Tap,
    /// A tap for a left-hand thread.
    LTap,
    /// The tool feeds in, the spindle stops, and the tool rapids out.
    Bore,
    /// A back bore: the tool cuts upward from below the part.
    Back,
    /// Feed in, feed out.
    Ream,
    /// Pecks with full retracts.
    Deep,
    /// Pecks with short retracts.
    Chipbreak,
    /// A hole through several webs, with rapids between them.
    Thru,
    /// A countersink, given by its diameter and angle.
    Csink,
    /// A stop at which the operator makes the hole by hand.
    Manual,
    /// The first custom cycle of the form.
    Custom1,
    /// The second custom cycle of the form.
    Custom2,
    /// The third custom cycle of the form.
    Custom3,
}

impl CycleKind {
    /// All kinds of cycles, each with its name in jobs.
    pub const NAMES: [(&'static str, CycleKind); 15] = [
        ("drill", CycleKind::Drill),
        ("face", CycleKind::Face),
        ("tap", CycleKind::Tap),
        ("ltap", CycleKind::LTap),
        ("bore", CycleKind::Bore),
        ("back", CycleKind::Back),
        ("ream", CycleKind::Ream),
        ("deep", CycleKind::Deep),
        ("chipbreak", CycleKind::Chipbreak),
        ("thru", CycleKind::Thru),
        ("csink", CycleKind::Csink),
        ("manual", CycleKind::Manual),
        ("custom1", CycleKind::Custom1),
        ("custom2", CycleKind::Custom2),
        ("custom3", CycleKind::Custom3),
    ];

    /// The name of the kind in jobs.
    pub fn name(self) -> &'static str {
        Self::NAMES.iter().find(|(_, kind)| *kind == self).map_or("", |(name, _)| name)
    }

    /// Finds a kind by its name; upper and lower case are equal.
    pub fn parse(name: &str) -> Option<CycleKind> {
        Self::NAMES.iter().find(|(own, _)| own.eq_ignore_ascii_case(name)).map(|(_, kind)| *kind)
    }

    /// The sequence that prints the holes of this kind; it has the name of the kind. If a kind has no sequence with its
    /// name, only a Custom sequence whose comment names the kind prints the holes.
    pub fn sequence(self) -> Option<SequenceId> {
        Some(match self {
            CycleKind::Drill => SequenceId::Drill,
            CycleKind::Tap => SequenceId::Tap,
            CycleKind::LTap => SequenceId::LTap,
            CycleKind::Bore => SequenceId::Bore,
            CycleKind::Back => SequenceId::Back,
            CycleKind::Ream => SequenceId::Ream,
            CycleKind::Deep => SequenceId::Peck,
            CycleKind::Chipbreak => SequenceId::Chipbreak,
            CycleKind::Custom1 => SequenceId::Custom1,
            CycleKind::Custom2 => SequenceId::Custom2,
            CycleKind::Custom3 => SequenceId::Custom3,
            CycleKind::Face | CycleKind::Thru | CycleKind::Csink | CycleKind::Manual => return None,
        })
    }

    /// The direction in which the spindle turns while the tool goes in; `None` if the kind is not a tap.
    pub fn inwards(self) -> Option<SpindleTurn> {
        match self {
            CycleKind::Tap => Some(SpindleTurn::Cw),
            CycleKind::LTap => Some(SpindleTurn::Ccw),
            _ => None,
        }
    }

    /// Whether the kind is a tap.
    pub fn is_tap(self) -> bool {
        matches!(self, CycleKind::Tap | CycleKind::LTap)
    }
}
