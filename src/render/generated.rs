//! A hole as single moves: the steps of a planned cycle, one block each.

use super::fault::{Done, fault};
use super::holes::Heights;
use super::renderer::Renderer;
use crate::cycle::{Plan, Step, plan};
use crate::diag::Code;
use crate::lang::VarId;
use crate::sema;
use crate::toolpath::Axes;

impl Renderer<'_> {
    /// A hole as single moves.
    pub(super) fn generated_hole(&mut self, target: &Axes, planes: &Plan, heights: Heights) -> Done {
        let Some(cycle) = &self.cycle else { return Ok(()) };
        let top = heights.return_plane - heights.point;
        plan(&cycle.spec, planes, top, &self.shape.defaults, &mut self.steps)?;
        let steps = std::mem::take(&mut self.steps);
        let done = self.make_steps(&steps.list, target, planes, heights);
        self.steps = steps;
        done
    }

    fn make_steps(&mut self, steps: &[Step], target: &Axes, planes: &Plan, heights: Heights) -> Done {
        self.set_targets(target)?;
        if self.attention {
            self.attend()?;
        }
        self.hole_variables(planes, heights);
        self.split_rapid(target)?;
        self.registers.forget(self.shape.letters[self.shape.program.settings.feed_code].printed);
        let direct = self.vars.get(VarId::Direct);
        let mut sped_up = false;
        for step in steps {
            let mut to = *target;
            match *step {
                Step::Rapid(height) => {
                    to.values[self.shape.depth] = heights.point + height;
                    self.set_targets(&to)?;
                    self.split_rapid(&to)?;
                }
                Step::RapidAside(height, x, y) => {
                    to.values[0] += x;
                    to.values[1] += y;
                    to.values[self.shape.depth] = heights.point + height;
                    self.set_targets(&to)?;
                    self.rapid_block(&to, None)?; // off the wall and up in one: up alone would score it
                }
                Step::Feed(height, feed) => {
                    to.values[self.shape.depth] = heights.point + height;
                    self.keep_feed(Some(feed));
                    self.set_targets(&to)?;
                    self.line_to(&to)?;
                }
                Step::Dwell(seconds) => self.dwell_block(seconds)?,
                Step::SpindleStop => self.spindle_block(self.shape.program.settings.spindle[2], None)?,
                Step::SpindleStart => {
                    let speed = std::mem::take(&mut sped_up).then_some(1.0);
                    self.spindle_block(self.turning(direct)?, speed)?;
                }
                Step::SpindleReverse(ratio) => {
                    let [cw, ccw, _] = self.shape.program.settings.spindle;
                    let code = if self.turning(direct)? == cw { ccw } else { cw };
                    sped_up = ratio != 1.0;
                    self.spindle_block(code, sped_up.then_some(ratio))?;
                }
                Step::Orient(_) if self.shape.depth == 0 => {
                    let message = "a turned hole has no wall that the tool could leave at an angle of the spindle";
                    return fault(Code::PR008, message, "leave `orient` and `offset` out");
                }
                Step::Orient(angle) => {
                    let (code, letter) = &self.shape.program.settings.orient;
                    self.code_word(code)?;
                    self.parameter_word(*letter, angle)?;
                    self.out.end_block();
                }
                Step::ProgramStop => {
                    self.code_word(&sema::Code::plain(b'M', self.shape.program.settings.stop_code[0]))?;
                    self.out.end_block();
                }
            }
        }
        let exit = self.position.values[self.shape.depth];
        self.left_hole(target, Some((exit, true)))
    }

    /// A direction, and where the speed changes with the feed, this many times the spindle's speed.
    fn spindle_block(&mut self, code: f64, times: Option<f64>) -> Done {
        if let Some(times) = times {
            let Some(speed) = self.vars.get(VarId::Speed) else {
                let help = "give the operation a spindle speed, or take `ratio` out";
                return fault(
                    Code::PC009,
                    "a tap that comes out faster must turn faster, and its speed is unknown",
                    help,
                );
            };
            self.letter_word(self.shape.program.settings.speed_code, speed * times)?;
        }
        self.code_word(&sema::Code::plain(b'M', code))?;
        self.out.end_block();
        Ok(())
    }

    /// The direction before the cycle, which must be one.
    pub(super) fn turning(&self, direct: Option<f64>) -> Done<f64> {
        match direct {
            Some(code) if code != self.shape.program.settings.spindle[2] => Ok(code),
            _ => fault(Code::PR006, "the spindle does not turn", "give the operation a spindle with a direction"),
        }
    }
}
