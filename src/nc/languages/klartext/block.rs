//! Blocks that move or switch: `L X+10 R0 F500 M3`, `CC`, `C`, `CR`, `CP`, `LP`, `RND`, `CHF`, `CYCL CALL`.

use std::sync::Arc;

use super::super::cursor::Cursor;
use super::super::formula::{GENERAL, Rules, formula};
use super::corner::Corner;
use super::{Klartext, is_parameter};
use crate::control::Meaning;
use crate::diag::Code;
use crate::nc::block::Block;
use crate::nc::codes::{group, takes_axes};
use crate::nc::fault::{Done, Fault, refuse};
use crate::nc::state::State;
use crate::toolpath::Side;

const FEED_WANTED: &str = "write F or FMAX in the block; the feed after a cycle is unknown";

/// The words of a polar position: the name, whether the word is the angle, and whether the word is an increment.
const POLAR: [(&[u8], bool, bool); 4] =
    [(b"PR", false, false), (b"PA", true, false), (b"IPR", false, true), (b"IPA", true, true)];

/// The words for the side of compensation.
const SIDES: [(&[u8], Side, Meaning); 2] =
    [(b"RL", Side::Left, Meaning::SideLeft), (b"RR", Side::Right, Meaning::SideRight)];

/// Reads the words of a block.
pub struct Words<'s> {
    pub own: &'s mut Klartext,
    pub state: &'s State,
    pub block: &'s mut Block,
}

/// The kind of a path block.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Path {
    Line,
    /// `LP`: a line to a polar position.
    Polar,
    /// `C`: an arc about the centre.
    Arc,
    /// `CR`: an arc by its radius.
    Radius,
    /// `CP`: an arc about the centre, to a polar position.
    PolarArc,
}

impl Words<'_> {
    pub(super) fn code(&mut self, meaning: Meaning) -> Done {
        let control = self.state.settings.control;
        let Some(row) = control.first(meaning) else {
            return refuse(Code::PN016, format!("`{}` is not run", meaning.name()), "run the program without it");
        };
        let rules = control.rules();
        self.block.put_g(row, group(row, rules), takes_axes(row, rules));
        Ok(())
    }

    /// Reads a number, or a parameter with its sign: `+10`, `-Q5`.
    pub(super) fn number(&self, cursor: &mut Cursor<'_>) -> Done<f64> {
        if let Some(value) = cursor.signed() {
            return Ok(value);
        }
        let sign = if cursor.takes(b"-") {
            -1.0
        } else {
            cursor.takes(b"+");
            1.0
        };
        let begin = cursor.at();
        let name = cursor.name().map(|name| String::from_utf8_lossy(name).to_ascii_uppercase());
        let Some(name) = name.filter(|name| is_parameter(name)) else { return Err(cursor.from(begin).unreadable()) };
        match self.own.value(&name) {
            Some(value) => Ok(sign * value),
            None => {
                let help = "set the parameter earlier in the program: its value in the machine is unknown";
                Err(Fault::at(Code::PN016, begin, format!("the value of `{name}` is unknown"), help))
            }
        }
    }

    /// Reads an operand of a function: a number, or a parameter with its sign.
    pub fn operand(&self, cursor: &mut Cursor<'_>) -> Done<f64> {
        self.number(cursor)
    }

    /// Reads a formula with parameters, and calculates its value.
    pub fn value(&self, cursor: &mut Cursor<'_>) -> Done<f64> {
        formula(cursor, Rules { words: &GENERAL, values: &|name| self.own.value(name), equal: 0.0 })
    }

    /// Reads an axis word such as `X+10` or `IY-5`. Returns the axis, its value, and whether it is an increment.
    pub(super) fn axis(&self, cursor: &mut Cursor<'_>) -> Done<Option<(usize, f64, bool)>> {
        let rest = cursor.rest();
        let by = rest.first().is_some_and(|byte| byte.eq_ignore_ascii_case(&b'I'));
        let Some(letter) = rest.get(usize::from(by)).map(u8::to_ascii_uppercase) else { return Ok(None) };
        let Some(axis) = self.state.control.axes().iter().position(|axis| *axis == letter) else { return Ok(None) };
        let begin = cursor.at();
        *cursor = cursor.from(begin + 1 + usize::from(by));
        Ok(Some((axis, self.number(cursor)?, by)))
    }

    /// Reads the words of a path block.
    pub fn path(&mut self, path: Path, cursor: &mut Cursor<'_>) -> Done {
        let at = self.state.place.position;
        let letters = *self.state.control.axes();
        let mut rapid = false;
        let (mut turns_left, mut radius, mut polar) = (None, None, [None; 2]);
        let (mut moves, mut calls) = (false, false);
        while !cursor.is_over() {
            let begin = cursor.at();
            let is_polar = matches!(path, Path::Polar | Path::PolarArc);
            if let Some((axis, value, by)) = self.axis(cursor)? {
                moves = true;
                let control = self.state.settings.control;
                self.block.word(letters[axis], value, false, begin, control)?;
                let marked = if by { &mut self.block.incremental } else { &mut self.block.absolute };
                *marked |= 1 << axis;
            } else if cursor.is_next(b"DR") {
                *cursor = cursor.from(begin + 2);
                turns_left = Some(match cursor.peek() {
                    Some(b'+') => true,
                    Some(b'-') => false,
                    _ => return Err(cursor.unreadable()),
                });
                *cursor = cursor.from(cursor.at() + 1);
            } else if let Some((name, is_angle, by)) = POLAR.iter().find(|word| is_polar && cursor.is_next(word.0)) {
                *cursor = cursor.from(begin + name.len());
                polar[usize::from(*is_angle)] = Some((self.number(cursor)?, *by));
            } else if cursor.is_next(b"RND") {
                return Err(cursor.unreadable());
            } else if cursor.is_next(b"R0") {
                *cursor = cursor.from(begin + 2);
                if self.state.tool.side.is_some() {
                    self.code(Meaning::SideOff)?;
                }
            } else if let Some((name, side, meaning)) = SIDES.iter().find(|word| cursor.is_next(word.0)) {
                *cursor = cursor.from(begin + name.len());
                if self.state.tool.side != Some(*side) {
                    self.code(*meaning)?;
                }
            } else if path == Path::Radius && cursor.is_next(b"R") {
                *cursor = cursor.from(begin + 1);
                radius = Some(self.number(cursor)?);
            } else if cursor.is_next(b"F") {
                *cursor = cursor.from(begin + 1);
                rapid |= self.feed(cursor)?;
            } else if cursor.is_next(b"M140") {
                *cursor = cursor.from(begin + 4);
                self.back_along_tool(cursor)?;
                (rapid, moves) = (true, true);
            } else if cursor.is_next(b"M") {
                calls |= self.switch(cursor)?;
            } else {
                return Err(cursor.unreadable());
            }
        }
        if is_astray(path, polar) {
            return refuse(
                Code::PN007,
                "the words of a polar position are missing",
                "write PR and PA, or PA for an arc",
            );
        }
        let goes = moves || matches!(path, Path::Polar | Path::PolarArc | Path::Arc);
        if goes {
            match path {
                Path::Line => self.code(if rapid { Meaning::Rapid } else { Meaning::Line })?,
                Path::Polar => {
                    let to = self.polar(at, polar, true)?;
                    self.code(if rapid { Meaning::Rapid } else { Meaning::Line })?;
                    self.goes_to(to);
                }
                Path::Arc | Path::PolarArc | Path::Radius => {
                    if rapid {
                        return refuse(Code::PN006, "an arc at FMAX", "write its feed");
                    }
                    let Some(left) = turns_left else {
                        return refuse(Code::PN007, "an arc without DR", "write DR+ or DR-");
                    };
                    self.code(if left { Meaning::ArcCcw } else { Meaning::ArcCw })?;
                    self.arc(path, at, radius, polar, left)?;
                }
            }
            if !rapid {
                let Some(feed) = self.own.feed else {
                    return refuse(Code::PN008, "a feed move without a feed", FEED_WANTED);
                };
                self.block.put(b'F', feed);
            }
            if path == Path::Line {
                self.corner_ahead(at)?;
            } else if self.own.ahead.is_some() {
                return refuse(
                    Code::PN016,
                    "a rounding or chamfer next to an arc is not supported",
                    "program the corner as moves",
                );
            }
        }
        // M99 calls the cycle once more, and ends the calls after each block
        if calls || goes && self.own.calls_always {
            self.call()?;
        }
        Ok(())
    }

    fn goes_to(&mut self, to: [f64; 2]) {
        self.block.put(b'X', to[0]);
        self.block.put(b'Y', to[1]);
        self.block.absolute |= 0b11;
        self.block.incremental &= !0b11;
    }

    fn center(&self) -> Done<[f64; 2]> {
        match self.own.center {
            Some(center) => Ok(center),
            None => refuse(Code::PN009, "the centre is missing: there is no CC", "write CC X.. Y.. before the block"),
        }
    }

    /// The position that the polar words and the centre define. The angle is measured from +X.
    fn polar(&mut self, at: [f64; 6], words: [Option<(f64, bool)>; 2], keeps: bool) -> Done<[f64; 2]> {
        let center = self.center()?;
        let now = [at[0] - center[0], at[1] - center[1]];
        let (held, heading) = (now[0].hypot(now[1]), now[1].atan2(now[0]).to_degrees());
        let radius = match words[0] {
            Some((by, true)) => held + by,
            Some((radius, false)) => radius,
            None if keeps => self.own.radius.unwrap_or(held),
            None => held,
        };
        if keeps {
            self.own.radius = Some(radius);
        }
        let angle = match words[1] {
            Some((by, true)) => heading + by,
            Some((angle, false)) => angle,
            None => heading,
        };
        let (sin, cos) = angle.to_radians().sin_cos();
        Ok([center[0] + radius * cos, center[1] + radius * sin])
    }

    /// Sets the words of an arc that begins at the position of the tool.
    fn arc(
        &mut self,
        path: Path,
        at: [f64; 6],
        radius: Option<f64>,
        polar: [Option<(f64, bool)>; 2],
        left: bool,
    ) -> Done {
        if path == Path::Radius {
            let Some(radius) = radius.filter(|radius| *radius != 0.0) else {
                return refuse(Code::PN009, "CR without its radius", "write R with it");
            };
            self.block.put(b'R', radius);
            return Ok(());
        }
        let center = self.center()?;
        if path == Path::PolarArc {
            let mut to = self.polar(at, [None, polar[1]], false)?;
            if let Some((by, true)) = polar[1] {
                if (by > 0.0) != left {
                    let message = format!("IPA {by} and DR have opposite directions");
                    return refuse(Code::PN009, message, "give IPA and DR the same sign");
                }
                let turns = by.abs() / 360.0;
                if turns > 1e6 {
                    return refuse(
                        Code::PN018,
                        format!("IPA {by} is more than a million turns"),
                        "write a smaller angle",
                    );
                }
                if by % 360.0 == 0.0 {
                    to = [at[0], at[1]];
                }
                self.block.turns = (turns.ceil() as u32).saturating_sub(1);
            }
            self.goes_to(to);
        }
        self.block.put(b'I', center[0] - at[0]);
        self.block.put(b'J', center[1] - at[1]);
        Ok(())
    }

    /// Reads `F500`, `FMAX` or `F AUTO`. Returns whether the move is a rapid.
    pub(super) fn feed(&mut self, cursor: &mut Cursor<'_>) -> Done<bool> {
        if cursor.takes_word("MAX") {
            return Ok(true);
        }
        if cursor.takes_word("AUTO") {
            self.own.feed = self.own.tool_feed;
            return Ok(false);
        }
        if cursor.peek().is_some_and(|byte| matches!(byte.to_ascii_uppercase(), b'U' | b'Z' | b'N')) {
            let message = "feeds per tooth or per turn are not supported";
            return Err(Fault::at(Code::PN016, cursor.at(), message, "write the feed per minute"));
        }
        let value = self.number(cursor)?;
        // in inch programs, feeds are written in tenths of an inch
        self.own.feed = Some(if self.own.inch { value / 10.0 } else { value });
        Ok(false)
    }

    fn call(&mut self) -> Done {
        let Some(cycle) = self.own.current_cycle() else {
            return refuse(Code::PN006, "no cycle is defined for this call", "write CYCL DEF before the call");
        };
        cycle.check()?;
        self.block.call = Some(Arc::new(cycle));
        self.block.is_empty = false;
        // the manuals do not state which feed is active after the cycle: the feed of the moves, or Q206 of the cycle
        self.own.feed = None;
        Ok(())
    }

    /// Reads `CYCL CALL` and the M codes after it.
    pub fn cycle_call(&mut self, cursor: &mut Cursor<'_>) -> Done {
        if cursor.takes_word("POS") {
            self.path(Path::Line, cursor)?;
            return self.call();
        }
        if cursor.takes_word("PAT") {
            return refuse(
                Code::PN016,
                "patterns of PATTERN DEF are not supported",
                "call the cycle at each position by M99",
            );
        }
        while !cursor.is_over() {
            if cursor.peek().is_none_or(|byte| !byte.eq_ignore_ascii_case(&b'M')) {
                return Err(cursor.unreadable());
            }
            self.switch(cursor)?;
        }
        self.own.calls_always = false;
        self.call()
    }

    /// If a rounding or chamfer follows, shortens the line, so that it ends at the start of the corner.
    fn corner_ahead(&mut self, at: [f64; 6]) -> Done {
        let Some([rounding, next]) = self.own.ahead.take() else { return Ok(()) };
        let target = |words: &Self, from: [f64; 2]| -> Done<[f64; 2]> {
            let mut to = from;
            let mut cursor = Cursor::new(&next, 0);
            super::flow::skip_number(&mut cursor);
            if !cursor.takes_word("L") {
                return refuse(
                    Code::PN016,
                    "a rounding or chamfer next to an arc is not supported",
                    "program the corner as moves",
                );
            }
            while let Some((axis, value, by)) = words.axis(&mut cursor)? {
                match axis {
                    0 | 1 => to[axis] = if by { from[axis] + value } else { value },
                    _ => {
                        return refuse(
                            Code::PN016,
                            "a rounding or chamfer is supported only between lines in X and Y",
                            "program the corner as moves",
                        );
                    }
                }
            }
            Ok(to)
        };
        if [b'Z', b'A', b'B', b'C'].iter().any(|letter| self.block.get(*letter).is_some()) {
            return refuse(
                Code::PN016,
                "a rounding or chamfer is supported only between lines in X and Y",
                "program the corner as moves",
            );
        }
        let mut corner = [at[0], at[1]];
        for (axis, letter) in [(0, b'X'), (1, b'Y')] {
            if let Some(value) = self.block.get(letter) {
                corner[axis] = if self.block.incremental & 1 << axis != 0 { at[axis] + value } else { value };
            }
        }
        let to = target(self, corner)?;
        let mut cursor = Cursor::new(&rounding, 0);
        super::flow::skip_number(&mut cursor);
        let rounds = cursor.takes(b"RND");
        if !rounds {
            cursor.takes(b"CHF");
        }
        cursor.takes(b"R");
        let size = self.number(&mut cursor)?;
        let corner = Corner::new([at[0], at[1]], corner, to, size, rounds)?;
        self.goes_to(corner.start);
        self.own.corner = Some(corner);
        Ok(())
    }

    /// Runs `RND R3 F200` or `CHF 2`. The line before this block has calculated the corner.
    pub fn rounding(&mut self, cursor: &mut Cursor<'_>) -> Done {
        let Some(corner) = self.own.corner.take() else {
            return refuse(
                Code::PN009,
                "a rounding or chamfer without a line before it",
                "write RND or CHF between two lines",
            );
        };
        cursor.takes(b"R");
        self.number(cursor)?;
        let mut feed = self.own.feed;
        if cursor.takes(b"F") {
            // this feed is active only in the corner
            let held = feed;
            self.feed(cursor)?;
            feed = self.own.feed;
            self.own.feed = held;
        }
        if !cursor.is_over() {
            return Err(cursor.unreadable());
        }
        let Some(feed) = feed else { return refuse(Code::PN008, "a feed move without a feed", FEED_WANTED) };
        let at = self.state.place.position;
        match corner.arc {
            Some((center, left)) => {
                self.code(if left { Meaning::ArcCcw } else { Meaning::ArcCw })?;
                self.block.put(b'I', center[0] - at[0]);
                self.block.put(b'J', center[1] - at[1]);
            }
            None => self.code(Meaning::Line)?,
        }
        self.goes_to(corner.end);
        self.block.put(b'F', feed);
        Ok(())
    }

    /// Reads `CC X+10 Y+20`. `CC` without words sets the centre to the position of the tool.
    pub fn circle_center(&mut self, cursor: &mut Cursor<'_>) -> Done {
        let at = self.state.place.position;
        let mut center = if cursor.is_over() { [at[0], at[1]] } else { self.own.center.unwrap_or([at[0], at[1]]) };
        while !cursor.is_over() {
            match self.axis(cursor)? {
                Some((axis @ (0 | 1), value, by)) => center[axis] = if by { at[axis] + value } else { value },
                _ => return Err(cursor.unreadable()),
            }
        }
        self.own.center = Some(center);
        self.own.radius = None;
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
