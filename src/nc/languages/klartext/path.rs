//! Path blocks such as `L X+10 R0 F500 M3`, `LP`, `C`, `CR` and `CP`.

use super::super::cursor::Cursor;
use super::Path;
use super::block::Words;
use crate::control::Meaning;
use crate::diag::Code;
use crate::nc::fault::{Done, once, refuse};
use crate::toolpath::Side;

/// The words of a polar position: the name, whether the word is the angle, and whether the word is an increment.
const POLAR: [(&str, bool, bool); 4] =
    [("PR", false, false), ("PA", true, false), ("IPR", false, true), ("IPA", true, true)];

/// The words for the side of compensation.
const SIDES: [(&str, Option<Side>, Meaning); 3] = [
    ("R0", None, Meaning::SideOff),
    ("RL", Some(Side::Left), Meaning::SideLeft),
    ("RR", Some(Side::Right), Meaning::SideRight),
];

/// The words of a path block. `None`: the block does not have the word.
#[derive(Default)]
struct Said {
    /// Whether the block has an axis word.
    moves: bool,
    /// The feed: whether it is FMAX.
    feed: Option<bool>,
    /// The side of compensation: R0, RL or RR.
    side: Option<Option<Side>>,
    /// DR: whether the arc turns left.
    turns_left: Option<bool>,
    /// R of `CR`.
    radius: Option<f64>,
    /// The polar radius and the polar angle, and whether each is an increment.
    polar: [Option<(f64, bool)>; 2],
    /// M140 MB MAX.
    retracts: Option<()>,
    /// Whether an M code calls the cycle.
    calls: bool,
}

impl Words<'_> {
    /// Runs a path block.
    pub fn path(&mut self, path: Path, cursor: &mut Cursor<'_>) -> Done {
        let at = self.state.place.position;
        let nominal = self.own.nominal.take();
        let mut said = Said::default();
        while !cursor.is_over() {
            self.path_word(path, &mut said, cursor)?;
        }
        if is_astray(path, said.polar) {
            return refuse(
                Code::PN007,
                "the words of a polar position are missing",
                "write PR and PA, or PA for an arc",
            );
        }
        if said.retracts.is_some() && (said.moves || path != Path::Line || said.feed == Some(false)) {
            let help = "write L M140 MB MAX in a block of its own: the tool retracts first, and moves then";
            return refuse(Code::PN016, "M140 MB MAX in a block with a move or a feed is not supported", help);
        }
        if let Some(corner) = nominal {
            self.after_corner(corner)?;
        }
        let goes = said.moves || said.retracts.is_some() || matches!(path, Path::Polar | Path::PolarArc | Path::Arc);
        if goes {
            self.move_along(path, at, &said)?;
        }
        // M99 calls the cycle once more, and ends the calls after each block
        if said.calls || goes && self.own.calls_always {
            self.call()?;
        }
        Ok(())
    }

    /// Reads a word of a path block.
    fn path_word(&mut self, path: Path, said: &mut Said, cursor: &mut Cursor<'_>) -> Done {
        let begin = cursor.at();
        let is_polar = matches!(path, Path::Polar | Path::PolarArc);
        if let Some((axis, value, by)) = self.axis(cursor)? {
            said.moves = true;
            let control = self.state.settings.control;
            self.block.word(control.axes()[axis], value, false, begin, control)?;
            let marked = if by { &mut self.block.incremental } else { &mut self.block.absolute };
            *marked |= 1 << axis;
        } else if cursor.is_next(b"DR") {
            *cursor = cursor.from(begin + 2);
            let left = match cursor.peek() {
                Some(b'+') => true,
                Some(b'-') => false,
                _ => return Err(cursor.unreadable()),
            };
            once(&mut said.turns_left, left, "DR", begin)?;
            *cursor = cursor.from(cursor.at() + 1);
        } else if let Some((name, is_angle, by)) =
            POLAR.iter().find(|word| is_polar && cursor.is_next(word.0.as_bytes()))
        {
            *cursor = cursor.from(begin + name.len());
            let value = self.number(cursor)?;
            once(&mut said.polar[usize::from(*is_angle)], (value, *by), name, begin)?;
        } else if cursor.is_next(b"RND") {
            return Err(cursor.unreadable());
        } else if let Some((name, side, meaning)) = SIDES.iter().find(|word| cursor.is_next(word.0.as_bytes())) {
            *cursor = cursor.from(begin + name.len());
            once(&mut said.side, *side, name, begin)?;
            if self.state.tool.side != *side {
                self.code(*meaning)?;
            }
        } else if path == Path::Radius && cursor.is_next(b"R") {
            *cursor = cursor.from(begin + 1);
            once(&mut said.radius, self.number(cursor)?, "R", begin)?;
        } else if cursor.is_next(b"F") {
            *cursor = cursor.from(begin + 1);
            once(&mut said.feed, self.feed(cursor)?, "F", begin)?;
        } else if cursor.is_next(b"M140") {
            *cursor = cursor.from(begin + 4);
            self.back_along_tool(cursor)?;
            once(&mut said.retracts, (), "M140", begin)?;
        } else if cursor.is_next(b"M") {
            said.calls |= self.switch(cursor)?;
        } else {
            return Err(cursor.unreadable());
        }
        Ok(())
    }

    /// Sets the motion of a path block, its target and its feed. The move begins at `at`.
    fn move_along(&mut self, path: Path, at: [f64; 6], said: &Said) -> Done {
        let rapid = said.feed == Some(true) || said.retracts.is_some();
        match path {
            Path::Line => self.code(if rapid { Meaning::Rapid } else { Meaning::Line })?,
            Path::Polar => {
                let to = self.polar(at, said.polar, true)?;
                self.code(if rapid { Meaning::Rapid } else { Meaning::Line })?;
                self.goes_to(to);
            }
            Path::Arc | Path::PolarArc | Path::Radius => {
                if rapid {
                    return refuse(Code::PN006, "an arc at FMAX", "write its feed");
                }
                let Some(left) = said.turns_left else {
                    return refuse(Code::PN007, "an arc without DR", "write DR+ or DR-");
                };
                self.code(if left { Meaning::ArcCcw } else { Meaning::ArcCw })?;
                self.arc(path, at, said.radius, said.polar, left)?;
            }
        }
        if !rapid {
            let feed = self.feed_of_move(self.own.feed)?;
            self.block.put(b'F', feed);
        }
        if path == Path::Line {
            return self.corner_ahead(at);
        }
        if self.own.ahead.is_some() {
            return refuse(
                Code::PN016,
                "a rounding or chamfer next to an arc is not supported",
                "program the corner as moves",
            );
        }
        Ok(())
    }
}

/// Whether a block with a polar path lacks required words.
fn is_astray(path: Path, words: [Option<(f64, bool)>; 2]) -> bool {
    match path {
        Path::Polar => words == [None; 2],
        Path::PolarArc => words[1].is_none(),
        _ => false,
    }
}
