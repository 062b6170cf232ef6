//! The subprograms of a job, and the effects of a call on the operations after it.
//!
//! A definition has no effect on the operations after it, because a subprogram runs only when it is called. After a call,
//! the renderer restores the state of the caller. Only positions and the effect of text remain.

use std::collections::{BTreeSet, HashMap};

use crate::toolpath::{Event, key};

/// The effects of a subprogram that remain after a call.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Effect {
    /// Axes that the subprogram moves, as bits.
    pub axes: u8,
    /// Whether the subprogram contains text.
    pub has_text: bool,
}

#[derive(Default)]
struct Sub {
    own: Effect,
    calls: BTreeSet<u64>,
}

/// The subprograms of a job.
#[derive(Default)]
pub(super) struct Subs {
    open: Option<u64>,
    subs: HashMap<u64, Sub>,
}

impl Subs {
    /// Whether an event belongs to the definition of a subprogram. `counts`: whether a text has an effect.
    pub fn define(&mut self, event: &Event<'_>, counts: impl FnOnce(&str) -> bool) -> bool {
        if let Event::SubStart(number) = event {
            self.open = Some(key(*number));
        }
        let Some(open) = self.open else { return false };
        let sub = self.subs.entry(open).or_default();
        sub.own.axes |= event.target().map_or(0, |to| to.given);
        match event {
            Event::SubCall(call) => {
                sub.own.axes |= call.at.given;
                sub.calls.insert(key(call.sub));
            }
            Event::Text(text) => sub.own.has_text |= counts(text),
            Event::SubEnd => self.open = None,
            _ => {}
        }
        true
    }

    /// The effects of a call, including the calls inside the subprogram.
    pub fn effect(&self, number: f64) -> Effect {
        let mut effect = Effect::default();
        let (mut seen, mut waiting) = (BTreeSet::new(), vec![key(number)]);
        while let Some(number) = waiting.pop() {
            if let Some(sub) = self.subs.get(&number).filter(|_| seen.insert(number)) {
                effect.axes |= sub.own.axes;
                effect.has_text |= sub.own.has_text;
                waiting.extend(&sub.calls);
            }
        }
        effect
    }
}
