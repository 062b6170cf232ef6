//! Holes of a machine cycle for which only the position is printed. The first hole of the cycle is never such a hole.

use super::{Body, Mode};
use crate::compile::{LetterKind, Op, Routine};
use crate::lang::VarId;
use crate::render::cx::Writer;
use crate::render::fault::Done;
use crate::render::numbers::quantised;

/// A position word of a cycle.
#[derive(Clone, Copy, Debug)]
struct Word {
    /// The axis of the word: 0 for `[h]`, 1 for `[v]`.
    axis: usize,
    letter: u8,
    glued: bool,
    /// The operation that prints the word.
    at: usize,
    /// The operation that begins the line of the word.
    line: usize,
}

/// The two position words of a cycle, in the order of the form.
#[derive(Clone, Copy, Debug)]
pub struct PositionWords([Word; 2]);

impl PositionWords {
    /// The position words of this sequence. `None`: the next hole may need other words too. The control does not have
    /// the values of these words yet, or the values depend on the position.
    pub fn of(routine: &Routine, writer: &mut Writer<'_>) -> Option<PositionWords> {
        let shape = writer.shape;
        let settings = &shape.program.settings;
        let mut line = routine.ops.start;
        let mode = Mode::NextHole { position: false };
        let body = Body { writer: writer.lend(), mode, line, at: line, drops: false, text: Vec::new(), comment: 0..0 };
        let mut words = [None, None];
        for at in routine.steps() {
            match shape.program.ops[at] {
                Op::Line { .. } => line = at,
                Op::List { .. } | Op::Set { .. } | Op::Formula { .. } => return None,
                Op::Var { var: VarId::Block | VarId::Tparams | VarId::Work, .. } => return None,
                Op::Var { letter, var: var @ (VarId::H | VarId::V), glued } => {
                    let axis = usize::from(var == VarId::V);
                    let free = words.iter_mut().find(|word| word.is_none())?;
                    *free = Some(Word { axis, letter, glued, at, line });
                }
                Op::Var { letter, var, .. } => {
                    let info = &shape.letters[letter];
                    let Some(value) = body.value_of(var, letter).ok()? else { continue };
                    let units = quantised(info, value).ok()?;
                    if !body.writer.said.holds_value(info, units, value) {
                        return None;
                    }
                }
                _ => {}
            }
        }
        let [Some(first), Some(second)] = words else { return None };
        let is_own = |word: &Word| {
            let info = &shape.letters[word.letter];
            let shares = |at: usize| match shape.program.ops[at] {
                Op::Var { letter, .. } => at != word.at && shape.letters[letter].printed == info.printed,
                _ => false,
            };
            info.kind == LetterKind::Axis
                && word.letter == shape.axes[word.axis]
                && Some(info.printed) != settings.numbers.letter
                && word.letter != settings.speed_code
                && !routine.steps().any(shares)
        };
        let one_block = first.line == second.line && first.axis != second.axis;
        (one_block && is_own(&first) && is_own(&second)).then_some(PositionWords([first, second]))
    }

    /// Prints the block of the next hole: the position words that changed, or both position words if no word changed.
    /// `at`: the values of `[h]` and `[v]`.
    #[inline]
    pub fn print(&self, at: [f64; 2], writer: &mut Writer<'_>) -> Done {
        let Writer { shape, said, out, .. } = writer;
        let spans = &shape.program.spans;
        let units = |word: &Word| {
            quantised(&shape.letters[word.letter], at[word.axis])
                .map_err(|diag| Box::new(diag.at(spans[word.at], "printed from here")))
        };
        let [first, second] = &self.0;
        let units = [units(first)?, units(second)?];
        let holds = |word: &Word, units| said.holds(&shape.letters[word.letter], units);
        let holds = [holds(first, units[0]), holds(second, units[1])];
        let both = holds == [true; 2];
        for ((word, units), holds) in self.0.iter().zip(units).zip(holds) {
            if both || !holds {
                let info = &shape.letters[word.letter];
                out.letter(info, units, word.glued)
                    .map_err(|diag| Box::new(diag.at(spans[word.at], "printed from here")))?;
                said.word(info, units);
                said.stand.placed |= 1 << word.axis;
            }
        }
        out.finish(true, Some(spans[first.line]));
        Ok(())
    }
}
