//! The parts of blocks that move: numbers, axis words, feeds, polar positions, arcs, `CC`, `RND`, `CHF`, `CYCL CALL`.

use std::sync::Arc;

use super::super::cursor::Cursor;
use super::super::formula::{GENERAL, Rules, formula};
use super::corner::Corner;
use super::cycles::{Cycle, per_minute};
use super::{Klartext, Path, is_parameter};
use crate::control::Meaning;
use crate::diag::Code;
use crate::nc::block::Block;
use crate::nc::codes::{Group, bit, group, takes_axes};
use crate::nc::fault::{Done, Fault, once, refuse};
use crate::nc::state::State;

const FEED_WANTED: &str = "write F or FMAX in the block; the feed after a cycle is unknown";

/// Reads the words of a block.
pub struct Words<'s> {
    pub own: &'s mut Klartext,
    pub state: &'s State,
    pub block: &'s mut Block,
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

    pub(super) fn goes_to(&mut self, to: [f64; 2]) {
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
    pub(super) fn polar(&mut self, at: [f64; 6], words: [Option<(f64, bool)>; 2], keeps: bool) -> Done<[f64; 2]> {
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
    pub(super) fn arc(
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
        self.own.feed = Some(self.number(cursor)?);
        Ok(false)
    }

    /// The feed of a move, in the program's units per minute. `written`: the feed as the program contains it.
    pub(super) fn feed_of_move(&self, written: Option<f64>) -> Done<f64> {
        match written {
            Some(written) => Ok(per_minute(written, self.own.inch)),
            None => refuse(Code::PN008, "a feed move without a feed", FEED_WANTED),
        }
    }

    fn defined_cycle(&self) -> Done<Cycle> {
        match self.own.current_cycle() {
            Some(cycle) => Ok(cycle),
            None => refuse(Code::PN006, "no cycle is defined for this call", "write CYCL DEF before the call"),
        }
    }

    /// Calls the defined cycle at the end of the block.
    pub(super) fn call(&mut self) -> Done {
        let cycle = self.defined_cycle()?;
        self.call_cycle(cycle)
    }

    fn call_cycle(&mut self, cycle: Cycle) -> Done {
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
            self.own.calls_always = false;
            self.path(Path::Line, cursor)?;
            return self.call_at_position();
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

    /// Runs `CYCL CALL POS X+10 Y+10 Z+5 FMAX`: the tool moves to X and Y at its height, and the cycle is called. Z is
    /// no target of the tool, but shifts all heights of the cycle.
    fn call_at_position(&mut self) -> Done {
        let height = self.block.get(b'Z').filter(|_| self.block.incremental & 0b100 == 0);
        let (Some(height), Some(_), Some(_)) = (height, self.block.get(b'X'), self.block.get(b'Y')) else {
            let help = "write X, Y and Z, and Z without I: Z shifts the heights of the cycle";
            return refuse(Code::PN007, "CYCL CALL POS without X, Y and the height Z", help);
        };
        if self.block.call.is_some() || self.block.g_meaning(Group::Once).is_some() {
            return refuse(
                Code::PN016,
                "CYCL CALL POS with M89, M91, M92 or M99",
                "write the block without the M code",
            );
        }
        let mut cycle = self.defined_cycle()?;
        let surface = cycle.lifted(height);
        if self.state.at_machine() & 0b100 == 0 && self.state.position()[2] < surface {
            let message = format!("CYCL CALL POS while the tool is below the surface of the hole, Z{surface}");
            return refuse(Code::PN016, message, "move the tool above the surface in a block with L before the call");
        }
        self.block.given &= !bit(b'Z');
        self.call_cycle(cycle)
    }

    /// If a rounding or chamfer follows, shortens the line, so that it ends at the start of the corner.
    pub(super) fn corner_ahead(&mut self, at: [f64; 6]) -> Done {
        let Some([rounding, next]) = self.own.ahead.take() else { return Ok(()) };
        if rounding.contains(&b'/') || next.contains(&b'/') || self.block.g_meaning(Group::Once).is_some() {
            let message = "a rounding or chamfer next to a block with `/` or a machine position is not supported";
            return refuse(Code::PN016, message, "program the corner as moves");
        }
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
        self.own.nominal = Some(corner);
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
        let held = self.own.feed;
        if cursor.takes(b"F") && self.feed(cursor)? {
            return refuse(Code::PN006, "a rounding or chamfer at FMAX", "write its feed");
        }
        // the feed of this block is active only in the corner
        let feed = std::mem::replace(&mut self.own.feed, held);
        if !cursor.is_over() {
            return Err(cursor.unreadable());
        }
        let feed = self.feed_of_move(feed)?;
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

    /// Changes increments after a rounding or chamfer into positions: they begin at the corner that the program
    /// contains, and not at the end of the rounding.
    pub(super) fn after_corner(&mut self, corner: [f64; 2]) -> Done {
        if self.block.g_meaning(Group::Once).is_some() {
            let message = "a machine position after a rounding or chamfer is not supported";
            return refuse(Code::PN016, message, "program the corner as moves");
        }
        for (axis, letter) in [b'X', b'Y'].into_iter().enumerate() {
            let by = self.block.get(letter).filter(|_| self.block.incremental & 1 << axis != 0);
            if let Some(by) = by {
                self.block.set(letter, corner[axis] + by);
                self.block.incremental &= !(1 << axis);
                self.block.absolute |= 1 << axis;
            }
        }
        Ok(())
    }

    /// Reads `CC X+10 Y+20`. `CC` without words sets the centre to the position of the tool.
    pub fn circle_center(&mut self, cursor: &mut Cursor<'_>) -> Done {
        let at = self.state.place.position;
        let mut center = if cursor.is_over() { [at[0], at[1]] } else { self.own.center.unwrap_or([at[0], at[1]]) };
        let mut given = [None; 2];
        while !cursor.is_over() {
            let begin = cursor.at();
            match self.axis(cursor)? {
                Some((axis @ (0 | 1), value, by)) => {
                    center[axis] = if by { at[axis] + value } else { value };
                    once(&mut given[axis], (), ["X", "Y"][axis], begin)?;
                }
                _ => return Err(cursor.unreadable()),
            }
        }
        self.own.center = Some(center);
        self.own.radius = None;
        Ok(())
    }
}
