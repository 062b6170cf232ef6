//! Kinds of canned cycles, and the sequence for each.

use super::tool::SpindleTurn;
use crate::lang::SequenceId;

/// Kinds of canned cycles (cycles.md section 1.5).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CycleKind {
    /// Feed in, rapid out.
    Drill,
    /// Feed in, dwell, rapid out: spot facing.
    Face,
    /// A right-hand thread.
    Tap,
    /// A left-hand thread.
    LTap,
    /// Feed in, stop the spindle, rapid out.
    Bore,
    /// A bore from below, cut upward.
    Back,
    /// Feed in, feed out.
    Ream,
    /// Pecks with full retracts.
    Deep,
    /// Pecks with short retracts.
    Chipbreak,
    /// Through several webs, rapids between them.
    Thru,
    /// A countersink by its diameter and angle.
    Csink,
    /// A stop for manual work by the operator.
    Manual,
    /// The first custom cycle of the form.
    Custom1,
    /// The second custom cycle of the form.
    Custom2,
    /// The third custom cycle of the form.
    Custom3,
}

impl CycleKind {
    /// All kinds with their names in jobs.
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

    /// Finds a kind by its name, in upper or lower case.
    pub fn parse(name: &str) -> Option<CycleKind> {
        Self::NAMES.iter().find(|(own, _)| own.eq_ignore_ascii_case(name)).map(|(_, kind)| *kind)
    }

    /// The sequence with the name of this kind (render.md section 3). Other kinds are printed only by a Custom sequence
    /// that is labelled with them.
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

    /// The direction in which the spindle turns while a tap goes in.
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
