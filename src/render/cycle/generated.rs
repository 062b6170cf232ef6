//! Prints a hole as single moves: one block for each step of a planned cycle.

use super::open::{Drilling, left_hole, turning};
use super::planned::{Planned, hole_variables};
use crate::control::Meaning;
use crate::cycle::{Step, plan};
use crate::diag::Code;
use crate::lang::VarId;
use crate::render::cx::{Cx, Writer};
use crate::render::dwell::dwell_here;
use crate::render::fault::{Done, fault};
use crate::render::moves::line::line_to;
use crate::render::moves::rapid_blocks::{rapid_block, split_rapid};
use crate::render::settle::settle;
use crate::render::targets::set_targets;
use crate::render::words::{code_word, parameter_word, speed_word, value_code};

/// Prints one hole as single moves.
pub fn generated_hole(hole: &Planned, cx: &mut Cx<'_>, drill: &mut Drilling) -> Done {
    let shape = cx.shape;
    let Some(cycle) = &drill.open else { return Ok(()) };
    let top = hole.heights.return_plane - hole.heights.point;
    plan(&cycle.spec, &hole.planes, top, &shape.defaults, &mut drill.steps)?;
    let steps = std::mem::take(&mut drill.steps);
    let done = make_steps(&steps.list, hole, cx, drill);
    drill.steps = steps;
    done
}

fn make_steps(steps: &[Step], hole: &Planned, cx: &mut Cx<'_>, drill: &mut Drilling) -> Done {
    let shape = cx.shape;
    set_targets(&hole.target, shape, cx.want, cx.said)?;
    if cx.said.is_unsettled(cx.want) {
        settle(cx)?;
    }
    hole_variables(hole, shape, cx.want, drill);
    split_rapid(&hole.target, cx)?;
    cx.said.forget(&shape.letters[shape.program.settings.feed_code]);
    let direct = cx.want.get(VarId::Direct);
    let mut sped_up = false;
    for step in steps {
        let mut to = hole.target;
        match *step {
            Step::Rapid(height) => {
                to.values[shape.depth] = hole.heights.point + height;
                set_targets(&to, shape, cx.want, cx.said)?;
                split_rapid(&to, cx)?;
            }
            Step::RapidAside(height, x, y) => {
                to.values[0] += x;
                to.values[1] += y;
                to.values[shape.depth] = hole.heights.point + height;
                set_targets(&to, shape, cx.want, cx.said)?;
                rapid_block(&to, None, cx)?; // off the wall and up in one block: straight up would score the wall
            }
            Step::Feed(height, feed) => {
                to.values[shape.depth] = hole.heights.point + height;
                cx.want.keep_feed(Some(feed), shape);
                set_targets(&to, shape, cx.want, cx.said)?;
                line_to(&to, cx)?;
            }
            Step::Dwell(seconds) => dwell_here(seconds, cx)?,
            Step::SpindleStop => spindle_block(shape.program.settings.spindle[2], None, &mut cx.writer())?,
            Step::SpindleStart => {
                let speed = std::mem::take(&mut sped_up).then_some(1.0);
                spindle_block(turning(direct, shape)?, speed, &mut cx.writer())?;
            }
            Step::SpindleReverse(ratio) => {
                let [cw, ccw, _] = shape.program.settings.spindle;
                let code = if turning(direct, shape)? == cw { ccw } else { cw };
                sped_up = ratio != 1.0;
                spindle_block(code, sped_up.then_some(ratio), &mut cx.writer())?;
            }
            Step::Orient(_) if shape.depth == 0 => {
                let message = "in a hole on a lathe the tool can't move off the wall at a spindle angle";
                return fault(Code::PR006, message, "leave `orient` and `offset` out");
            }
            Step::Orient(angle) => {
                shape.needs(Meaning::Orient)?;
                let (code, letter) = &shape.program.settings.orient;
                code_word(code, &mut cx.writer())?;
                parameter_word(*letter, angle, shape, cx.said, cx.out)?;
                cx.out.end_block();
            }
            Step::ProgramStop => {
                value_code(b'M', shape.program.settings.stop_code[0], &mut cx.writer())?;
                cx.out.end_block();
            }
        }
    }
    let exit = cx.said.stand.position.values[shape.depth];
    left_hole(&hole.target, Some((exit, true)), shape, cx.said, drill)
}

/// Prints a spindle direction. If `times` is given, also prints the spindle speed multiplied by `times`.
fn spindle_block(code: f64, times: Option<f64>, writer: &mut Writer<'_>) -> Done {
    if let Some(times) = times {
        let Some(speed) = writer.want.get(VarId::Speed) else {
            let help = "give the operation a spindle speed, or take `ratio` out";
            return fault(Code::PC009, "a tap that retracts faster must turn faster, but its speed is unknown", help);
        };
        speed_word(speed * times, writer)?;
    }
    value_code(b'M', code, writer)?;
    writer.out.end_block();
    Ok(())
}
