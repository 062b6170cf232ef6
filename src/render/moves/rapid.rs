//! A rapid of the path.

use super::rapid_blocks::rapid_to;
use super::reach::reach;
use super::rotary::turn_to;
use crate::diag::Code;
use crate::lang::{VarId, VarSet};
use crate::render::fault::{Done, fault};
use crate::render::printer::Printer;
use crate::render::said::Said;
use crate::render::settle::{print_lacking, work_before};
use crate::render::shape::{ROTARY_BITS, Shape};
use crate::render::targets::set_targets;
use crate::render::upon::{index_replaces_work_upon, upon_is_due, upons};
use crate::render::vars::MOVE_VARS;
use crate::render::want::Want;
use crate::toolpath::Axes;

/// A rapid of the path.
pub fn rapid(to: &Axes, shape: &Shape, want: &mut Want, said: &mut Said, out: &mut Printer) -> Done {
    let target = reach(to, true, shape, want, said, out)?;
    if shape.sets_targets || said.is_unsettled(want) || target.given & ROTARY_BITS != 0 {
        set_targets(&target, shape, want, said)?;
    }
    let turns = target.given & ROTARY_BITS != 0 && said.turns(&target, shape);
    if said.is_unsettled(want) {
        if turns && index_replaces_work_upon(shape) {
            work_before(shape, want, said, out)?;
        }
        if turns && upon_is_due(said.lacks(want, shape), true, shape, want, said) {
            let message = "an Upon sequence would move the tool here before the part turns";
            return fault(Code::PR017, message, "put a rapid that keeps the angle before it");
        }
        print_lacking(shape, want, said, out)?;
        said.differs |= said.sub.is_some_and(|sub| sub.stops); // a cut behind it must know its spindle
    }
    said.stand.moved_by = None;
    if turns {
        return turn_to(&target, shape, want, said, out);
    }
    if shape.watches_moves && said.differs_from(&target, 0x3f, shape) {
        upons(MOVE_VARS.without(VarSet::of(&[VarId::Frate])), shape, want, said, out)?;
    }
    rapid_to(&target, shape, want, said, out)
}
