//! A block of words: `G1 X10 Y=R1+5 Z=IC(-2) CR=5 F200`.

use std::sync::Arc;

use super::super::cursor::{Cursor, capitals};
use super::super::formula::{GENERAL, Rules, formula};
use super::arguments::check_arguments;
use super::cycles::Cycle;
use super::ways::Siemens;
use crate::control::Meaning;
use crate::diag::Code;
use crate::nc::block::Block;
use crate::nc::call::{Call, Pattern};
use crate::nc::codes::{Group, bit, group, takes_axes};
use crate::nc::fault::{Done, Fault, refuse, twice};
use crate::nc::state::State;

/// Numbers are equal in a comparison if they differ by at most this part of their size (Job Planning, section 1.7).
pub const EQUAL: f64 = 1e-12;

/// Words for path control and look-ahead, which are not simulated.
const HARMLESS: [&str; 27] = [
    // these turn off features that are refused when a program turns them on
    "TRAFOOF",
    "FNORM",
    "DIAMOF",
    "SOFT",
    "BRISK",
    "DRIVE",
    "FFWON",
    "FFWOF",
    "COMPOF",
    "COMPON",
    "COMPCURV",
    "COMPCAD",
    "CFTCP",
    "CFC",
    "CFIN",
    "STOPRE",
    "NORM",
    "KONT",
    "DYNNORM",
    "DYNPOS",
    "DYNROUGH",
    "DYNSEMIFIN",
    "DYNFINISH",
    "UPATH",
    "SPATH",
    "RTLION",
    "RTLIOF",
];

/// Words with a value for the smoothing of the path by G641 and G642, which is not simulated.
const SMOOTHING: [&str; 5] = ["ADIS", "ADISPOS", "ATOL", "CTOL", "OTOL"];

/// Words of features that the simulator does not run, each with the name of its feature for messages.
const NOT_RUN: [(&str, &str); 22] = [
    ("TRAORI", "a transformation of five axes"),
    ("TRANSMIT", "polar coordinate interpolation"),
    ("TRACYL", "a transformation about a cylinder"),
    ("TRAANG", "a transformation of an inclined axis"),
    ("ROT", "a turned frame"),
    ("AROT", "a turned frame"),
    ("ROTS", "a turned frame"),
    ("AROTS", "a turned frame"),
    ("SCALE", "a scaled frame"),
    ("ASCALE", "a scaled frame"),
    ("MIRROR", "a mirror image"),
    ("AMIRROR", "a mirror image"),
    ("ASPLINE", "a spline"),
    ("BSPLINE", "a spline"),
    ("CSPLINE", "a spline"),
    ("POLY", "a polynomial"),
    ("DIAMON", "X as a diameter"),
    ("LIMS", "the speed limit of the spindle under G96"),
    ("SPOS", "a stop of the spindle at an angle"),
    ("SPOSA", "a stop of the spindle at an angle"),
    ("SETMS", "another master spindle"),
    ("WHENEVER", "a synchronised action"),
];

/// The name of the feature of a word, if the simulator does not run this feature.
pub(super) fn not_run(name: &str) -> Option<&'static str> {
    NOT_RUN.iter().find(|(word, _)| *word == name).map(|(_, what)| *what)
}

/// Reads the words of a block that contains moves or switches.
pub struct Words<'s> {
    pub own: &'s mut Siemens,
    pub state: &'s State,
    /// The block. Its axis words are marked as absolute (`AC`) or incremental (`IC`).
    pub block: &'s mut Block,
}

impl Words<'_> {
    /// Reads the rest of a block.
    ///
    /// # Errors
    /// A word is unknown.
    pub fn read(&mut self, cursor: &mut Cursor<'_>) -> Done {
        while !cursor.is_over() {
            if cursor.takes(b",") {
                return Err(cursor.unreadable());
            }
            self.word(cursor)?;
        }
        self.settle()
    }

    fn word(&mut self, cursor: &mut Cursor<'_>) -> Done {
        let column = cursor.at();
        if let Some((letter, value)) = cursor.word() {
            return self.put(letter, value, column);
        }
        let Some(letters) = cursor.letters() else { return Err(cursor.unreadable()) };
        let control = self.state.settings.control;
        if let [letter] = letters {
            let letter = letter.to_ascii_uppercase();
            if letter == b'T' && cursor.takes(b"=") {
                let tool = self.tool(cursor)?;
                return self.block.word(b'T', tool, false, column, control);
            }
            if cursor.takes(b"=") {
                return self.assigned(letter, cursor, column);
            }
            let Some(value) = cursor.signed() else { return Err(cursor.unreadable()) };
            if cursor.takes(b"=") {
                // in `M1=3` and `S1=1000`, the first 1 is the number of the spindle
                return match letter {
                    b'M' | b'S' | b'T' if value == 1.0 => self.assigned(letter, cursor, column),
                    b'M' | b'S' | b'T' => {
                        let message = format!("spindle {value} is not simulated");
                        Err(Fault::at(Code::PN016, column, message, "write the words of the first spindle"))
                    }
                    _ => {
                        let message = format!("`{}{value}` is unknown", char::from(letter));
                        Err(Fault::at(Code::PN016, column, message, "run the program without this word"))
                    }
                };
            }
            return self.put(letter, value, column);
        }
        let name = capitals(letters);
        match name.as_ref() {
            "SUPA" => {
                let Some(row) = control.first(Meaning::Machine) else { return Err(cursor.unreadable()) };
                self.block.put_g(row, group(row, control.rules()), takes_axes(row, control.rules()));
                Ok(())
            }
            "CR" if cursor.takes(b"=") => {
                let radius = self.value(cursor)?;
                self.block.word(b'R', radius, false, column, control)
            }
            "TURN" if cursor.takes(b"=") => {
                let turns = self.value(cursor)?;
                if turns.fract() != 0.0 || !(0.0..=999.0).contains(&turns) {
                    return refuse(Code::PN018, format!("TURN={turns} is not a number of turns"), "write 0 to 999");
                }
                if std::mem::replace(&mut self.block.turns, turns as u32) > 0 {
                    return twice("TURN", column);
                }
                Ok(())
            }
            _ if SMOOTHING.contains(&name.as_ref()) && cursor.takes(b"=") => {
                let value = self.value(cursor)?;
                self.own.left_out.push(format!("{name}={value}").into());
                self.block.is_empty = false;
                Ok(())
            }
            _ if is_harmless(&name) => {
                self.own.left_out.push(name.into());
                self.block.is_empty = false;
                Ok(())
            }
            _ => {
                let message = match not_run(&name) {
                    Some(what) => format!("`{name}`, {what}, is not supported"),
                    None => format!("`{name}` is unknown"),
                };
                let help = "run the program without this word, or write moves instead of it";
                Err(Fault::at(Code::PN016, column, message, help))
            }
        }
    }

    /// Reads a tool number, or a tool name as in `T="DRILL"`.
    fn tool(&mut self, cursor: &mut Cursor<'_>) -> Done<f64> {
        if cursor.peek() != Some(b'"') {
            return self.value(cursor);
        }
        let Some(name) = cursor.quoted() else { return Err(cursor.unreadable()) };
        Ok(self.state.tool_names.word(name))
    }

    /// Reads the value after `=`: `X=R1*2`, `X=AC(10)`, `X=IC(-5)`.
    fn assigned(&mut self, letter: u8, cursor: &mut Cursor<'_>, column: usize) -> Done {
        let axis = self.state.control.axes().iter().position(|axis| *axis == letter);
        let center = b"IJK".iter().position(|own| *own == letter);
        for (mark, absolute) in [("AC", true), ("IC", false)] {
            if !cursor.takes_word(mark) {
                continue;
            }
            cursor.needs(b"(")?;
            let value = self.value(cursor)?;
            cursor.needs(b")")?;
            return match (axis, center) {
                (Some(axis), _) => {
                    let marked = if absolute { &mut self.block.absolute } else { &mut self.block.incremental };
                    *marked |= 1 << axis;
                    self.put(letter, value, column)
                }
                (_, Some(axis)) => {
                    let from = if absolute { self.state.place.position[axis] } else { 0.0 };
                    self.put(letter, value - from, column)
                }
                _ => {
                    let message = format!("{} takes no {mark}", char::from(letter));
                    Err(Fault::at(Code::PN001, column, message, "write only its number"))
                }
            };
        }
        if axis.is_some_and(|axis| axis > 2)
            && (cursor.takes_word("DC") || cursor.takes_word("ACP") || cursor.takes_word("ACN"))
        {
            let message = "the direction of a rotary axis is not simulated";
            return Err(Fault::at(Code::PN016, column, message, "write only its angle"));
        }
        let value = self.value(cursor)?;
        self.put(letter, value, column)
    }

    fn put(&mut self, letter: u8, value: f64, column: usize) -> Done {
        let control = self.state.settings.control;
        match letter {
            b'G' => self.block.g_word(value, column, control),
            b'M' if matches!(value, 2.0 | 30.0) && self.own.is_in_subprogram() => {
                let message = format!("M{value} in a subprogram ends the program or only the subprogram");
                Err(Fault::at(Code::PN010, column, message, "write M17 at the end of a subprogram"))
            }
            b'M' => self.block.m_word(value, column, control),
            b'R' | b'L' | b'P' | b'E' | b'O' | b'Q' | b'H' | b'U' | b'V' | b'W' => {
                let message = format!("the word {} is unknown here", char::from(letter));
                Err(Fault::at(Code::PN016, column, message, "run the program without this word"))
            }
            _ => self.block.word(letter, value, false, column, control),
        }
    }

    /// Converts the words of a block to the words of the simulator.
    fn settle(&mut self) -> Done {
        let block = &mut *self.block;
        self.own.select_edge(block, self.state);
        self.own.check_edge(block, self.state)?;
        if block.g_meaning(Group::Once) == Some(Meaning::Dwell) {
            let seconds = match (block.get(b'F'), block.get(b'S')) {
                (Some(seconds), None) => seconds,
                (None, Some(turns)) if self.state.drive.speed > 0.0 => turns * 60.0 / self.state.drive.speed,
                _ => return refuse(Code::PN007, "G4 without its time", "write G4 F2 for two seconds, or S for turns"),
            };
            block.given &= !(bit(b'F') | bit(b'S')); // the active feed and speed do not change
            block.put(b'P', seconds);
        }
        // G96 and G97 turn on feeds per revolution, as G95 does; G961 and G971 would keep feeds per minute
        if block.row(Group::SpeedMode).is_some()
            && block.row(Group::FeedMode).is_none()
            && let Some(row) = self.state.control.first(Meaning::PerRev)
        {
            block.put_g(row, Group::FeedMode, false);
        }
        if let Some(row) = block.row(Group::Units) {
            self.own.units(row)?;
        }
        let has_feed = block.has(bit(b'F')) || block.row(Group::Units).is_some() && self.state.drive.feed > 0.0;
        self.own.check_feed(has_feed, self.state)?;
        self.own.check_increments(block, self.state)?;
        if block.g_meaning(Group::Once) == Some(Meaning::Reference) {
            // the values of the axis words in this block are ignored
            for (axis, letter) in self.state.control.axes().iter().enumerate() {
                if block.get(*letter).is_some() {
                    block.put(*letter, 0.0);
                    block.incremental |= 1 << axis;
                }
            }
        }
        if let Some(call) = &self.own.modal {
            let moves = block.has_axes() && !block.axes_are_taken()
                || block.row(Group::Motion).is_some()
                // S or F alone calls the cycle, too, while G0 or G1 is active
                || block.has(bit(b'F') | bit(b'S'))
                    && self.state.modes.motion.is_some_and(|row| matches!(row.meaning, Meaning::Rapid | Meaning::Line));
            if moves {
                block.call = Some(call.clone());
            }
        }
        Ok(())
    }

    /// Reads a formula and calculates its value.
    pub fn value(&self, cursor: &mut Cursor<'_>) -> Done<f64> {
        formula(cursor, Rules { words: &GENERAL, values: &|name| self.own.value(name), equal: EQUAL })
    }

    /// Reads the arguments of a call. An argument that is left out is `None`.
    pub fn arguments(&self, cursor: &mut Cursor<'_>) -> Done<Vec<Option<f64>>> {
        let mut arguments = Vec::new();
        if !cursor.takes(b"(") {
            return Ok(arguments);
        }
        loop {
            if cursor.takes(b")") {
                return Ok(arguments);
            }
            if cursor.takes(b",") {
                arguments.push(None);
                continue;
            }
            arguments.push(Some(self.value(cursor)?));
            if !cursor.takes(b",") {
                cursor.needs(b")")?;
                return Ok(arguments);
            }
        }
    }

    /// Reads the arguments of a cycle. `None`: the name is not that of a supported drilling cycle.
    pub fn cycle(&mut self, name: &str, cursor: &mut Cursor<'_>) -> Done<Option<Call>> {
        let number = name.strip_prefix("CYCLE").and_then(|number| number.parse::<u16>().ok());
        let Some(number) = number.filter(|number| Cycle::is_known(*number)) else { return Ok(None) };
        // of the drilling cycles, only CYCLE85 has feeds as arguments
        self.own.check_feed(number == 85, self.state)?;
        self.own.needs_edge()?;
        let mut arguments = self.arguments(cursor)?;
        while arguments.last() == Some(&None) {
            arguments.pop();
        }
        let cycle = Cycle::new(number, arguments)?;
        self.own.left_out.extend(cycle.not_simulated().map(Into::into));
        Ok(Some(Arc::new(cycle)))
    }

    /// Reads `HOLES1(..)`, a row of holes, or `HOLES2(..)`, a circle of holes.
    pub fn pattern(&mut self, circle: bool, cursor: &mut Cursor<'_>) -> Done {
        let arguments = self.arguments(cursor)?;
        let name = if circle { "HOLES2" } else { "HOLES1" };
        check_arguments(name, &arguments, 6, &[])?;
        let Some(call) = self.own.modal.clone() else {
            return refuse(
                Code::PN006,
                format!("{name} without a cycle"),
                "write MCALL and the cycle before this block",
            );
        };
        let value = |at: usize| arguments.get(at).copied().flatten().unwrap_or(0.0);
        let count = value(5);
        if count.fract() != 0.0 || !(0.0..=10_000.0).contains(&count) {
            return refuse(Code::PN018, format!("{name} with {count} holes"), "write a whole number from 0 to 10000");
        }
        let holes = 0..count as u32;
        let mut at: std::collections::VecDeque<[f64; 2]> = if circle {
            let step = if value(4) == 0.0 { 360.0 / count } else { value(4) };
            let place = |hole: u32| {
                let (sin, cos) = (value(3) + step * f64::from(hole)).to_radians().sin_cos();
                [value(0) + value(2) * cos, value(1) + value(2) * sin]
            };
            holes.map(place).collect()
        } else {
            let (sin, cos) = value(2).to_radians().sin_cos();
            let place = |hole: u32| {
                let along = value(3) + value(4) * f64::from(hole);
                [value(0) + along * cos, value(1) + along * sin]
            };
            holes.map(place).collect()
        };
        // the row is drilled from the end that is nearer to the tool
        let [x, y, _] = crate::nc::arcs::axes_of(self.state.modes.plane).map(|axis| self.state.place.position[axis]);
        let far = |place: Option<&[f64; 2]>| place.map_or(0.0, |place| (place[0] - x).hypot(place[1] - y));
        if !circle && far(at.back()) < far(at.front()) {
            at.make_contiguous().reverse();
        }
        self.block.is_empty = false;
        self.block.pattern = Some(Box::new(Pattern { call, at }));
        Ok(())
    }

    /// Reads `TRANS`, which sets the shift of the frame, or `ATRANS`, which adds to this shift.
    pub fn translate(&mut self, adds: bool, cursor: &mut Cursor<'_>) -> Done {
        let Some(row) = self.state.control.first(Meaning::Frame) else {
            return refuse(Code::PN016, "a moved frame is not supported", "run the program without the frame");
        };
        self.block.put_g(row, Group::Once, true);
        let mut by = if adds { *self.state.shift() } else { [0.0; 6] };
        let mut given = 0u8;
        while !cursor.is_over() {
            let begin = cursor.at();
            let axis = cursor.letters().filter(|letters| letters.len() == 1);
            let axis = axis.and_then(|letters| {
                self.state.control.axes().iter().position(|axis| axis.eq_ignore_ascii_case(&letters[0]))
            });
            let Some(axis) = axis else {
                return Err(Fault::at(
                    Code::PN001,
                    begin,
                    "a frame can be moved only along its axes",
                    "write TRANS X10 Y20",
                ));
            };
            let value = if cursor.takes(b"=") {
                self.value(cursor)?
            } else {
                cursor.signed().ok_or_else(|| cursor.unreadable())?
            };
            by[axis] = if adds { by[axis] + value } else { value };
            if given & 1 << axis != 0 {
                return twice(char::from(self.state.control.axes()[axis]), begin);
            }
            given |= 1 << axis;
        }
        let shift = self.state.shift();
        for (axis, letter) in self.state.control.axes().iter().enumerate() {
            self.own.shifted |= u8::from(by[axis] != shift[axis]) << axis;
            self.block.put(*letter, by[axis]);
        }
        Ok(())
    }
}

/// Whether a word moves nothing and is not simulated.
pub fn is_harmless(name: &str) -> bool {
    HARMLESS.contains(&name)
}
