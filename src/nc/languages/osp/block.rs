//! A block of words: `G81 X10 Y=VC1*2 Z-10 R2 F100 M53`.

use std::sync::Arc;

use super::super::cursor::{Cursor, capitals};
use super::super::formula::{OSP, Rules, formula};
use super::Osp;
use super::cycles::{Back, Cycle};
use crate::control::{Code as Name, Meaning, Motions};
use crate::diag::Code;
use crate::nc::block::Block;
use crate::nc::codes::{Group, bit, group, letters, takes_axes};
use crate::nc::fault::{Done, Fault, refuse, twice};
use crate::nc::state::State;

/// Reads the words of a block.
pub struct Words<'s> {
    pub own: &'s mut Osp,
    pub state: &'s State,
    pub block: &'s mut Block,
    /// Words of the block for cycles and offsets.
    pub said: Said,
}

/// Words of a block that the type `Block` can't store.
#[derive(Default)]
pub struct Said {
    /// The code of a cycle.
    pub cycle: Option<Name>,
    /// Whether the block ends the cycle, by G80 or by a motion.
    pub ends: bool,
    /// Whether the block makes no hole: NCYL.
    pub no_hole: bool,
    /// Whether the block moves no axis: NOEX.
    pub no_move: bool,
    /// The feed out of the hole: FA.
    pub feed_out: Option<f64>,
    /// G15 selects a work offset until the next G15. G16 selects a work offset only for this block.
    pub offset: Option<Meaning>,
    /// Whether the block sets the level to which cycles return: G71.
    pub level: bool,
    /// Whether the block sets the return level: M52, M53 or M54.
    pub back: bool,
}

impl Words<'_> {
    /// Reads the words of a block.
    ///
    /// # Errors
    /// A word is unknown.
    pub fn read(&mut self, cursor: &mut Cursor<'_>) -> Done {
        while !cursor.is_over() {
            self.word(cursor)?;
        }
        self.settle()
    }

    /// Reads a formula and calculates its value.
    pub fn value(&self, cursor: &mut Cursor<'_>) -> Done<f64> {
        formula(cursor, Rules { words: &OSP, values: &|name| self.own.value(name), equal: 0.0 })
    }

    fn word(&mut self, cursor: &mut Cursor<'_>) -> Done {
        let column = cursor.at();
        if let Some((letter, value)) = cursor.word() {
            return self.put(letter, value, column);
        }
        let Some(letters) = cursor.letters() else { return Err(cursor.unreadable()) };
        let name = capitals(letters);
        let control = self.state.settings.control;
        let [letter] = name.as_bytes() else {
            match name.as_ref() {
                "NCYL" => self.said.no_hole = true,
                "NOEX" => self.said.no_move = true,
                "HA" => self.block.word(b'H', self.state.tool.loaded.unwrap_or(0.0), false, column, control)?,
                "FA" => {
                    cursor.takes(b"=");
                    let feed = self.value(cursor)?;
                    if self.said.feed_out.replace(feed).is_some() {
                        return twice("FA", column);
                    }
                }
                _ => {
                    let message = format!("`{name}` is unknown");
                    return Err(Fault::at(
                        Code::PN016,
                        column,
                        message,
                        "run the program without this word, or write its moves",
                    ));
                }
            }
            self.block.is_empty = false;
            return Ok(());
        };
        let value = match cursor.takes(b"=") {
            true => self.value(cursor)?,
            false => cursor.signed().ok_or_else(|| cursor.unreadable())?,
        };
        self.put(*letter, value, column)
    }

    fn put(&mut self, letter: u8, value: f64, column: usize) -> Done {
        match letter {
            b'G' => self.g_word(value, column),
            b'M' => self.m_word(value, column),
            _ => self.block.word(letter, value, false, column, self.state.settings.control),
        }
    }

    fn g_word(&mut self, value: f64, column: usize) -> Done {
        let control = self.state.settings.control;
        let row = Name::of(b'G', value).and_then(|code| control.row(code)).filter(|row| row.not_run.is_none());
        let meaning = row.map(|row| row.meaning);
        match meaning {
            Some(Meaning::Work | Meaning::Machine) => {
                self.block.is_empty = false;
                if self.said.offset.replace(row.map_or(Meaning::Work, |row| row.meaning)).is_some() {
                    return twice("G15 or G16", column);
                }
                Ok(())
            }
            Some(Meaning::ReturnLevel) => {
                self.block.is_empty = false;
                self.said.level = true;
                Ok(())
            }
            Some(Meaning::Cycle) => {
                self.block.is_empty = false;
                if self.said.cycle.replace(row.map_or(Name::default(), |row| row.code)).is_some() {
                    let message = "two cycles in one block";
                    return Err(Fault::at(Code::PN004, column, message, "write the cycles in two blocks"));
                }
                Ok(())
            }
            meaning => {
                self.said.ends |= meaning.is_some_and(Meaning::ends_cycle);
                self.block.g_word(value, column, control)
            }
        }
    }

    fn m_word(&mut self, value: f64, column: usize) -> Done {
        let control = self.state.settings.control;
        match Name::of(b'M', value).and_then(|code| control.meaning(code)) {
            Some(Meaning::ToTop) => self.own.back = Some(Back::Top),
            Some(Meaning::ToR) => self.own.back = Some(Back::R),
            Some(Meaning::ToLevel) => {
                let Some(level) = self.own.level else {
                    let message = "a return to the level of G71, but G71 is missing";
                    return Err(Fault::at(
                        Code::PN007,
                        column,
                        message,
                        "write G71 Z and its height before this block",
                    ));
                };
                self.own.back = Some(Back::Level(level));
            }
            _ => return self.block.m_word(value, column, control),
        }
        if std::mem::replace(&mut self.said.back, true) {
            return twice("M52, M53 or M54", column);
        }
        self.block.is_empty = false;
        Ok(())
    }

    /// Converts the words of a block to the words of the simulator.
    fn settle(&mut self) -> Done {
        if let Some(meaning) = self.said.offset {
            self.offset(meaning)?;
        }
        if self.said.level {
            let Some(level) = self.block.get(b'Z') else {
                return refuse(Code::PN007, "G71, the return level of cycles, without its Z", "write G71 Z50");
            };
            self.own.level = Some(level);
            self.block.given &= !bit(b'Z');
            // cycles that return to this level use the new value from now on
            if let Some(Back::Level(_)) = self.own.back {
                self.own.back = Some(Back::Level(level));
            }
        }
        if self.block.g_meaning(Group::Once) == Some(Meaning::Dwell) {
            let Some(seconds) = self.block.get(b'F').or(self.block.get(b'P')) else {
                return refuse(Code::PN007, "G4 without its time", "write G4 F2 for two seconds");
            };
            self.block.given &= !bit(b'F'); // the active feed does not change
            self.block.put(b'P', seconds);
        }
        self.cycle()
    }

    /// Handles G15 H1, which selects an offset, and G16 H0, which means machine positions in this block.
    fn offset(&mut self, meaning: Meaning) -> Done {
        let said = self.block.get(b'H').filter(|number| number.fract() == 0.0 && (0.0..=105.0).contains(number));
        let Some(number) = said else {
            return refuse(Code::PN007, "a work offset without its number", "write H1 in this block");
        };
        self.block.given &= !bit(b'H');
        match (meaning, number == 0.0) {
            (Meaning::Work, false) => self.block.work = Some(number),
            (Meaning::Machine, true) => {
                let control = self.state.settings.control;
                let Some(row) = control.first(Meaning::Machine) else { return Ok(()) };
                self.block.put_g(row, group(row, control.rules()), takes_axes(row, control.rules()));
            }
            _ => {
                let message = format!("this code with H{number} is not simulated");
                return refuse(Code::PN016, message, "write G15 with an offset from H1 on");
            }
        }
        Ok(())
    }

    /// Refuses words of cycles in a block whose cycle does not use them, or that runs no cycle.
    fn check_cycle_words(&self) -> Done {
        let control = self.state.settings.control;
        let code = self.said.cycle.or(self.own.cycle.map(|cycle| cycle.code)).filter(|_| !self.said.ends);
        let row = code.and_then(|code| control.row(code));
        if self.said.feed_out.is_some() && row.is_none_or(|row| row.runs.motions != Some(Motions::FeedOut)) {
            return refuse(
                Code::PN005,
                "the block has FA, but no cycle that uses FA",
                "remove FA, or write G85 or G89",
            );
        }
        match row {
            Some(row) => self.block.check_words(Some(row), control.traits().everywhere.bits()),
            None if self.said.no_move && self.block.has_axes() => {
                refuse(Code::PN016, "NOEX without a cycle is not simulated", "remove NOEX, or the axis words")
            }
            None => Ok(()),
        }
    }

    /// Ends the active cycle, because the block has G80. A motion while a cycle is active is refused.
    fn end_cycle(&mut self) -> Done {
        if self.said.cycle.is_some() {
            let help = "write the code and the cycle in two blocks";
            return refuse(Code::PN004, "a motion code and a cycle in one block", help);
        }
        let cancels = self.block.g_meaning(Group::Cycle) == Some(Meaning::CycleEnd);
        if let Some(cycle) = self.own.cycle.filter(|_| !cancels) {
            let message = format!("a motion code while {} is active: whether it ends the cycle is unknown", cycle.code);
            return refuse(Code::PN016, message, "write G80 in a block before this block");
        }
        self.own.cycle = None;
        if cancels {
            self.own.back = None;
        }
        Ok(())
    }

    /// Sets the active cycle, and the hole that the block makes.
    fn cycle(&mut self) -> Done {
        if self.said.ends {
            self.end_cycle()?;
            return self.check_cycle_words();
        }
        let begins = self.said.cycle.is_some();
        if let Some(code) = self.said.cycle {
            let runs = self.state.settings.control.row(code).map(|row| &row.runs);
            let Some((motions, rigid)) = runs.and_then(|runs| Some((runs.motions?, runs.rigid))) else {
                return refuse(Code::PN016, format!("{code} is not supported"), "program the moves of the cycle");
            };
            let back = self.own.back;
            let (depth, r, step) = (None, None, None);
            self.own.cycle =
                Some(Cycle { code, motions, rigid, depth, r, step, parts: [None; 2], feed_out: None, back });
        }
        let Some(mut cycle) = self.own.cycle else {
            return self.check_cycle_words();
        };
        let block = &mut *self.block;
        if !self.state.modes.absolute || block.g_meaning(Group::Distance) == Some(Meaning::Increments) {
            let help = "write G90 and positions: the meaning of R and Z under G91 is unknown";
            return refuse(Code::PN016, format!("{} under G91 is not supported", cycle.code), help);
        }
        if let Some(dwell) = block.get(b'P').filter(|dwell| *dwell != 0.0) {
            let message = format!("P{dwell} of {}: its unit is unknown, seconds or milliseconds", cycle.code);
            return refuse(Code::PN016, message, "write P0, and write the dwell in a separate block");
        }
        if block.has(letters("EK")) {
            return refuse(Code::PN016, format!("E and K of {} are not supported", cycle.code), "leave them out");
        }
        self.check_cycle_words()?;
        let block = &mut *self.block;
        cycle.depth = block.get(b'Z').or(cycle.depth);
        cycle.r = block.get(b'R').or(cycle.r);
        cycle.step = block.get(b'Q').or(cycle.step);
        cycle.parts[0] = block.get(b'I').or(cycle.parts[0]);
        cycle.parts[1] = block.get(b'J').or(cycle.parts[1]);
        cycle.feed_out = self.said.feed_out.or(cycle.feed_out);
        cycle.back = self.own.back;
        self.own.cycle = Some(cycle);
        let makes = begins || block.has(letters("XYZR"));
        block.given &= !letters("ZRQIJP");
        if self.said.no_move {
            block.given &= !letters("XY");
            return Ok(());
        }
        if block.has(letters("XY")) {
            // the block moves to the hole by a rapid
            let control = self.state.settings.control;
            if let Some(row) = control.first(Meaning::Rapid) {
                block.put_g(row, group(row, control.rules()), takes_axes(row, control.rules()));
            }
        }
        if makes && !self.said.no_hole {
            block.call = Some(Arc::new(cycle));
        }
        Ok(())
    }
}
