//! G90 and G94 of system A: one pass along a cylinder or a face, and the return to the start of the pass.

use crate::control::Meaning;
use crate::nc::block::Block;
use crate::nc::fault::Done;
use crate::nc::out::Out;
use crate::nc::state::State;

impl State {
    /// Makes a pass. Each following block with a new position makes another pass.
    pub(in crate::nc) fn turning_pass(&mut self, does: Meaning, block: &Block, out: &mut Out<'_>) -> Done {
        let feed = self.drive.feed_of(block, self.modes.feed_mode)?;
        let (begin, unsaid) = (self.place.position, self.place.at_machine);
        // for a cone (G90), the taper is along X; for a sloping face (G94), it is along Z
        let (end, taper) = self.pass_end(does, block)?;
        let [out_of, along] = if does == Meaning::TurnPass { [0, 2] } else { [2, 0] };
        // if the position of an axis is known only at the machine, it stays unknown until the block contains the position
        let at_end = self.place.at_machine;
        let is_said = |axis: usize| unsaid & !(1 << axis) | at_end & 1 << axis;
        let mut to = begin;
        to[out_of] = end[out_of] + taper;
        self.place.at_machine = is_said(out_of);
        self.place.rapid_to(to, out);
        self.place.at_machine = at_end;
        to[out_of] = end[out_of];
        to[along] = end[along];
        self.place.feed_to(to, feed, None, out);
        to[out_of] = begin[out_of];
        self.place.at_machine = is_said(along);
        self.place.feed_to(to, feed, None, out);
        self.place.at_machine = unsaid;
        self.place.rapid_to(begin, out);
        Ok(())
    }
}
