//! Runs simple blocks fast. A simple block is a straight cut with axis words, perhaps with its code and a feed; most
//! blocks of long programs are simple blocks. Checks that can't apply to a simple block are left out. [`State::run`]
//! gives the same result for simple blocks; a test compares both results.

use super::action::{Action, Position};
use super::block::Block;
use super::codes::{AXES, Group, bit, g_code, letters};
use super::out::Out;
use super::state::State;
use crate::control::{Control, Meaning, Row, Turns};
use crate::number::short_decimal;
use crate::toolpath::FeedMode;

/// The words that a simple block may have.
const WORDS: u32 = letters("XYZABCFN");

impl Block {
    /// Reads the line at the beginning of a text, if the line has only axis words, a number, a feed and one G0 or G1,
    /// with short numbers. Returns the length of the line. `None`: the line has anything else, or the text ends before
    /// the line; the general reader must then read the line.
    #[inline]
    pub(super) fn read_plain(&mut self, line: &[u8], control: &'static Control) -> Option<usize> {
        let (mut at, mut given, mut whole, mut code) = (0, 0, 0, None);
        loop {
            let letter = match line.get(at) {
                Some(b' ') => {
                    at += 1;
                    continue;
                }
                Some(letter @ (b'X'..=b'Z' | b'A'..=b'C' | b'F' | b'N')) => *letter,
                Some(b'\n') => break,
                Some(b'\r') if line.get(at + 1) == Some(&b'\n') => {
                    at += 1;
                    break;
                }
                Some(b'G') if code.is_none() => {
                    // `G1`, `G01`
                    let leading = matches!(line.get(at + 1..at + 3), Some([b'0', b'0' | b'1']));
                    at += 1 + usize::from(leading);
                    let (Some(digit @ (b'0' | b'1')), Some(after)) = (line.get(at), line.get(at + 1)) else {
                        return None;
                    };
                    let row = g_code(control, u16::from(digit - b'0') * 10);
                    code = row.filter(|row| matches!(row.meaning, Meaning::Rapid | Meaning::Line));
                    if code.is_none() || after.is_ascii_digit() || *after == b'.' {
                        return None;
                    }
                    at += 1;
                    continue;
                }
                _ => return None,
            };
            let negative = line.get(at + 1) == Some(&b'-');
            let start = at + 1 + usize::from(negative);
            let short = short_decimal(line, start)?;
            at = start + short.length;
            // a number that continues after a blank ends the loop in the next round, because a digit is not a letter
            if given & bit(letter) != 0 || negative && letter == b'F' {
                return None;
            }
            given |= bit(letter);
            whole |= if short.point { 0 } else { bit(letter) };
            let value = short.value();
            self.values[usize::from(letter - b'A')] = if negative { -value } else { value };
        }
        if given & AXES == 0 || given & !control.letters() != 0 {
            return None;
        }
        if let Some(row) = code {
            (self.has_g, self.g[Group::Motion as usize]) = (true, Some(row));
        }
        (self.given, self.whole, self.is_empty, self.plain) = (given, whole, false, true);
        Some(at + 1)
    }

    /// Whether the block that was just read has only axis words, a number, a feed, and the code of a motion.
    #[inline]
    pub(super) fn is_plain(&self) -> bool {
        self.given & !WORDS == 0
            && self.given & AXES != 0
            && !self.has_m()
            && !(self.has_g && (self.has_modes || self.takes_axes || self.g[Group::Cycle as usize].is_some()))
            && self.comment.is_none()
            && self.polar == [None; 2]
            && !(self.spindle || self.deleted || self.percent)
            && self.next_tool.is_none()
    }
}

/// The cut of a simple block.
#[derive(Clone, Copy, Debug)]
pub struct PlainCut {
    /// End of the cut.
    pub to: Position,
    /// The feed, in the feed mode's unit.
    pub feed: f64,
    /// The axes that the block contains, as bits.
    given: u8,
}

impl State {
    /// Makes the cut of a simple block. Returns `false` if `State::run` must run the block.
    #[inline]
    pub(super) fn cuts_plainly(&mut self, block: &Block, out: &mut Out<'_>) -> bool {
        let Some(cut) = self.plain_cut(block) else { return false };
        self.cut_to(&cut);
        let PlainCut { to, feed, .. } = cut;
        out.push(Action::Feed { to, feed, lead: None, machine: self.place.at_machine, home: 0 });
        true
    }

    /// Makes a cut of [`State::plain_cut`], without its action.
    #[inline]
    pub(super) fn cut_to(&mut self, cut: &PlainCut) {
        self.drive.set_feed(cut.feed);
        self.place.are_given(cut.given);
        self.place.reaches(cut.to);
    }

    /// The cut of a simple block; `None`: `State::run` must run the block.
    #[inline]
    pub(super) fn plain_cut(&self, block: &Block) -> Option<PlainCut> {
        let modes = &self.modes;
        let (word, control) = (block.row(Group::Motion), self.control);
        // a straight cut is active already, so a G1 in the block changes nothing
        let is_line = |row: &Row| row.meaning == Meaning::Line;
        let is_usual = modes.motion.is_some_and(is_line)
            && word.is_none_or(is_line)
            && modes.absolute
            && !modes.diameter
            && modes.feed_mode != FeedMode::InverseTime
            && self.holes.cycle.is_none()
            && self.turning.corner.is_none()
            && control.traits().turns == Turns::Tool
            && !control.traits().height_is_machine
            // the meaning of lengths without a decimal point depends on a setting
            && (block.whole & AXES == 0 || control.rules().is_nist())
            && (block.whole & bit(b'F') == 0 || !self.scales_feed(block));
        // after a change of the units, a turn of the part may have another feed
        let active = if self.drive.feed == self.drive.given_feed { self.drive.feed } else { f64::NAN };
        let feed = if block.given & bit(b'F') != 0 { block.peek(b'F') } else { active };
        if !is_usual || feed.is_nan() || feed <= 0.0 {
            return None;
        }
        let mut to = self.place.position;
        let mut given = 0;
        for (axis, letter) in b"XYZABC".iter().enumerate() {
            let is_given = block.given & bit(*letter) != 0;
            given |= u8::from(is_given) << axis;
            to[axis] = if is_given { block.values[usize::from(letter - b'A')] } else { to[axis] };
        }
        Some(PlainCut { to, feed, given })
    }
}
