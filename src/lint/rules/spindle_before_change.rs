//! PF427: a tool change starts the spindle before the tool changes.

use crate::control::{Kept, Meaning};
use crate::diag::{Code, Diag};
use crate::lang::{SequenceId, VarId};
use crate::lint::blocks::says_tool;
use crate::lint::view::{Body, View};
use crate::sema::{Step, Word};

pub fn check(view: &View, diags: &mut Vec<Diag>) {
    for (body, change) in changes(view) {
        let lines = 0..body.lines.len();
        let whole = [Step::Lines(lines)];
        let walk = Walk { view, body: &body, change };
        let mut so_far = Spindle::default();
        walk.steps(body.steps.unwrap_or(&whole), &mut so_far);
        if let Some(word) = so_far.too_early {
            diags.push(
                Diag::new(Code::PF427, format!("{} starts the spindle before it changes the tool", body.name()))
                    .at(word.span, "the old tool is still in the spindle")
                    .help("print the spindle after the tool change"),
            );
        } else if let Some(word) = so_far.stopped {
            diags.push(
                Diag::new(Code::PF427, format!("{} starts the spindle and then stops it again", body.name()))
                    .at(word.span, "the tool does not turn in the first cut")
                    .help("print the spindle after the stop: `S[speed] M[direct]`"),
            );
        }
    }
}

/// State of the spindle at a line of a tool change. After branches, the states of all branches are combined.
#[derive(Clone, Copy, Default)]
struct Spindle<'a> {
    /// The word that starts the spindle.
    on: Option<&'a Word>,
    /// The word that stops the spindle again.
    stopped: Option<&'a Word>,
    /// The tool has changed.
    changed: bool,
    /// The word that starts the spindle before the tool changes.
    too_early: Option<&'a Word>,
}

/// Follows the spindle through a tool change, line by line.
struct Walk<'v, 'a> {
    view: &'v View<'a>,
    body: &'v Body<'a>,
    /// The line with the tool change.
    change: usize,
}

impl<'a> Walk<'_, 'a> {
    fn steps(&self, steps: &[Step], so_far: &mut Spindle<'a>) {
        for step in steps {
            match step {
                Step::Lines(lines) => lines.clone().for_each(|line| self.line(line, so_far)),
                Step::If(arms) => {
                    let before = *so_far;
                    let after = |steps: &[Step]| {
                        let mut way = before;
                        self.steps(steps, &mut way);
                        way
                    };
                    let otherwise = arms.iter().all(|arm| arm.condition.is_some()).then_some(before);
                    let ways = arms.iter().map(|arm| after(&arm.steps)).chain(otherwise);
                    *so_far = ways.reduce(either).unwrap_or(before);
                }
                Step::For(_, inner, _) => self.steps(inner, so_far),
                Step::Set(..) => {}
            }
        }
    }

    fn line(&self, number: usize, so_far: &mut Spindle<'a>) {
        let Some(line) = self.body.lines.get(number) else { return };
        let find = |is: &dyn Fn(&Word) -> bool| line.words.iter().find(|word| is(word));
        let changes = find(&|word| self.view.meaning(word).is_some_and(Meaning::changes_tool)).is_some();
        if (changes || number == self.change) && !std::mem::replace(&mut so_far.changed, true) {
            so_far.too_early = so_far.too_early.or(so_far.on);
        }
        if let Some(word) = find(&|word| starts_spindle(self.view, word)) {
            (so_far.on, so_far.stopped) = (Some(word), None);
        } else if so_far.on.is_some() {
            so_far.stopped = so_far.stopped.or(find(&|word| stops(self.view, word)));
        }
    }
}

/// Combines the states after two branches. Either of the two branches may have been taken.
fn either<'a>(a: Spindle<'a>, b: Spindle<'a>) -> Spindle<'a> {
    Spindle {
        on: a.on.or(b.on),
        stopped: a.stopped.or(b.stopped),
        changed: a.changed && b.changed,
        too_early: a.too_early.or(b.too_early),
    }
}

/// Whether the word stops the spindle. A program stop counts only if the control stops the spindle at a program stop.
fn stops(view: &View, word: &Word) -> bool {
    let keeps = view.traits().spindle_at_stop == Kept::Yes;
    let own = |meaning: Meaning| meaning == Meaning::SpindleOff || meaning.changes_tool();
    view.meaning(word).is_some_and(|meaning| own(meaning) || !keeps && meaning.is_stop())
}

/// Whether a word starts the spindle.
pub(super) fn starts_spindle(view: &View, word: &Word) -> bool {
    view.meaning(word).is_some_and(Meaning::starts_spindle) || word.printed_vars().has(VarId::Direct)
}

/// The tool change sequences, each with the index of the line in which the tool changes.
pub(super) fn changes<'a>(view: &View<'a>) -> Vec<(Body<'a>, usize)> {
    let line = |body: &Body, is: &dyn Fn(&Word) -> bool| body.lines.iter().position(|line| line.words.iter().any(is));
    let bodies = view.these(&[SequenceId::FirstToolChange, SequenceId::ToolChange]);
    bodies
        .filter_map(|body| {
            let change = line(&body, &|word| view.meaning(word).is_some_and(Meaning::changes_tool));
            Some((body, change.or_else(|| line(&body, &|word| says_tool(word)))?))
        })
        .collect()
}
