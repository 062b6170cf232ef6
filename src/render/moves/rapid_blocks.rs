//! Rapids as blocks: in one, or up first and down last.

use super::measure::measure;
use crate::lang::SequenceId;
use crate::render::body::{Mode, run};
use crate::render::fault::Done;
use crate::render::prelude::{check_prints, motion_block};
use crate::render::printer::Printer;
use crate::render::said::{LastMove, Said};
use crate::render::shape::Shape;
use crate::render::targets::set_targets;
use crate::render::upon::upons;
use crate::render::want::Want;
use crate::render::words::move_block;
use crate::sema;
use crate::toolpath::Axes;

/// A rapid to a target in program units, as one block or, under VRapid, split.
pub fn rapid_to(target: &Axes, shape: &Shape, want: &mut Want, said: &mut Said, out: &mut Printer) -> Done {
    if shape.program.settings.depth_rapid.is_some() && shape.linear == 3 && changes_depth_and_plane(target, shape, said)
    {
        return split_rapid(target, shape, want, said, out);
    }
    rapid_block(target, None, shape, want, said, out)
}

/// A rapid that goes up first or down last: between holes, and under VRapid.
pub fn split_rapid(target: &Axes, shape: &Shape, want: &mut Want, said: &mut Said, out: &mut Printer) -> Done {
    let code = shape.program.settings.depth_rapid.clone();
    if !changes_depth_and_plane(target, shape, said) {
        let depth_only = target.given & shape.depth_bit() != 0 && said.differs_from(target, shape.depth_bit(), shape);
        return rapid_block(target, code.filter(|_| depth_only), shape, want, said, out);
    }
    // only the axes of each part: the others stay where they are, printed or not
    let depth = shape.depth_bit();
    let part = |axes: u8| Axes { given: target.given & axes, ..*target };
    if is_below(target, shape, said) {
        rapid_block(&part(depth), code, shape, want, said, out)?;
        rapid_block(target, None, shape, want, said, out)
    } else {
        rapid_block(&part(!depth), None, shape, want, said, out)?;
        rapid_block(target, code, shape, want, said, out)
    }
}

/// Is the tool below a target, by what the job said last? From an unknown height it comes from above.
pub fn is_below(target: &Axes, shape: &Shape, said: &Said) -> bool {
    let from = said.stand.position.get(shape.depth).or(said.stand.left_at);
    from.is_some_and(|from| target.values[shape.depth] > from)
}

fn changes_depth_and_plane(target: &Axes, shape: &Shape, said: &Said) -> bool {
    said.differs_from(target, shape.depth_bit(), shape) && said.differs_from(target, 0x3f & !shape.depth_bit(), shape)
}

pub fn rapid_block(
    target: &Axes,
    code: Option<sema::Code>,
    shape: &Shape,
    want: &mut Want,
    said: &mut Said,
    out: &mut Printer,
) -> Done {
    let program = shape.program;
    // the depth part under VRapid has its own code, which the sequence can't print
    match program.routine(SequenceId::RapidCode).filter(|_| code.is_none()) {
        Some(routine) if said.differs_from(target, 0x3f, shape) => {
            let mut whole = said.stand.position;
            for axis in (0..6).filter(|axis| target.given & 1 << axis != 0) {
                whole.set(axis, target.values[axis]);
            }
            set_targets(&whole, shape, want, said)?;
            measure(target, false, want, said);
            let routine = shape.way(routine, want, said);
            check_prints(routine, target, shape, said)?;
            upons(routine.vars, shape, want, said, out)?;
            motion_block(&program.settings.rapid, routine, shape, want, said, out)?;
            run(routine, Mode::Motion, shape, want, said, out)?;
        }
        Some(_) => {}
        None => {
            match &code {
                Some(code) => move_block(target, code, false, shape, want, said, out)?,
                None => move_block(target, &program.settings.rapid, false, shape, want, said, out)?,
            };
        }
    }
    said.stand.move_to(target);
    said.last_move = LastMove::Rapid;
    Ok(())
}

pub fn raise(target: &Axes, shape: &Shape, want: &mut Want, said: &mut Said, out: &mut Printer) -> Done {
    let above = Axes { given: shape.depth_bit(), ..*target };
    set_targets(&above, shape, want, said)?;
    split_rapid(&above, shape, want, said, out)?;
    set_targets(target, shape, want, said)
}
