//! Turning cycles of the Fanuc kind, in G code system A: G70 to G75 in two blocks on a Fanuc or in one block on a Haas,
//! and G90 and G94.
//!
//! Sources: Fanuc's operator's manuals of the 0i-T and 31i (canned and multiple repetitive cycles), Haas's lathe
//! operator's manual (G70 to G75). Where these manuals refer to parameters and settings of the machine, comments in the
//! code state how postform behaves.

mod corner;
mod passes;
mod pecks;
pub(in crate::nc) mod profile;
mod rough;

use super::block::Block;
use super::codes::{Group, letters};
use super::fault::{Done, refuse};
use super::profiled::{How, Profiled};
use super::state::State;
use crate::control::{Meaning, Row};
use crate::diag::Code;
use crate::toolpath::Units;

/// The maximum number of passes of a cycle.
const MOST: f64 = 10_000.0;

impl State {
    /// Runs a cycle of several passes. A cycle that follows a profile is returned: the caller finds the profile and
    /// then makes the passes.
    pub(super) fn turning_cycle(&mut self, block: &Block, out: &mut super::out::Out<'_>) -> Done<Option<Profiled>> {
        let Some(row) = block.row(Group::Once) else { return Ok(None) };
        match row.meaning {
            Meaning::RoughTurn | Meaning::RoughFace | Meaning::RoughPattern | Meaning::Finish => {
                let [Some(first), Some(last)] = [b'P', b'Q'].map(|letter| block.get(letter)) else {
                    return self.first_of(row, block).map(|()| None);
                };
                if block.get(b'R').is_some_and(|second| second != 0.0) {
                    let message = format!("{} with R, for profiles with pockets, is not simulated", row.code);
                    return refuse(Code::PN016, message, "cut the pocket with a separate cycle, or write its moves");
                }
                self.begins_in_the_program(row.code)?;
                let how = self.how(row, block)?;
                Ok(Some(Profiled { first, last, how }))
            }
            Meaning::FacePecks | Meaning::GroovePecks => self.turning_pecks(row, block, out).map(|()| None),
            _ => Ok(None),
        }
    }

    /// Checks that a cycle of several passes begins at a known position, because its passes are measured from there.
    pub(in crate::nc) fn begins_in_the_program(&self, code: impl std::fmt::Display) -> Done {
        if self.place.at_machine & 0b101 == 0 {
            return Ok(());
        }
        let message = format!("{code} begins at an unknown machine position: the positions of its passes are unknown");
        refuse(Code::PN007, message, "write a rapid with X and Z before the cycle")
    }

    /// Reads the first block of a cycle with two blocks.
    fn first_of(&mut self, row: &Row, block: &Block) -> Done {
        let meaning = row.meaning;
        // on a Haas, the cycle has only one block
        if meaning == Meaning::Finish || row.words.has(b'D') || block.has(letters("PQ")) || !block.has(letters("UWR")) {
            return refuse(
                Code::PN007,
                "a turning cycle without P and Q",
                "write the block numbers of the first and the last block of its profile: G71 P10 Q20",
            );
        }
        let depth = if meaning == Meaning::RoughFace { b'W' } else { b'U' };
        if meaning != Meaning::RoughPattern {
            for letter in [depth, b'R'] {
                self.is_size(block, letter)?;
            }
        }
        match meaning {
            Meaning::RoughTurn => keep(&mut self.turning.turn, [block.get(depth), block.get(b'R')]),
            Meaning::RoughFace => keep(&mut self.turning.face, [block.get(depth), block.get(b'R')]),
            _ => keep(&mut self.turning.pattern, [block.get(b'U'), block.get(b'W'), block.get(b'R')]),
        }
        Ok(())
    }

    /// Checks that a word has no minus sign.
    pub(in crate::nc) fn is_size(&self, block: &Block, letter: u8) -> Done {
        match block.get(letter) {
            Some(size) if size < 0.0 => {
                let letter = char::from(letter);
                refuse(
                    Code::PN018,
                    format!("{letter}{size} is negative, but a size can't be negative"),
                    format!("write {letter} without the minus"),
                )
            }
            _ => Ok(()),
        }
    }

    fn how(&self, row: &Row, block: &Block) -> Done<How> {
        let half = if self.modes.diameter { 0.5 } else { 1.0 };
        let left = [block.get(b'U').unwrap_or(0.0) * half, block.get(b'W').unwrap_or(0.0)];
        Ok(match row.meaning {
            Meaning::Finish => How::Finish,
            Meaning::RoughPattern => {
                let [x, z, count] = self.turning.pattern;
                // on a Haas, these words are in the block of the cycle
                let x = block.get(b'I').or(x).unwrap_or(0.0);
                let z = block.get(b'K').or(z).unwrap_or(0.0);
                let Some(count) = block.get(b'D').or(count).filter(|count| (1.0..=MOST).contains(count)) else {
                    let help =
                        "write G73 U.. W.. R(number of passes) before this block; on a Haas write D in this block";
                    return refuse(Code::PN007, "G73 without its number of passes", help);
                };
                if count == 1.0 && [x, z] != [0.0; 2] {
                    let message = "G73 with one pass and a distance to the first pass: no manual defines the result";
                    return refuse(Code::PN016, message, "write two or more passes, or no distance");
                }
                How::Pattern { outside: [x, z], count: count as u32, left }
            }
            meaning => {
                let across = meaning == Meaning::RoughFace;
                let [depth, back] = if across { self.turning.face } else { self.turning.turn };
                let (code, letter) = if across { ("G72", 'W') } else { ("G71", 'U') };
                self.is_size(block, b'D')?;
                let Some(depth) = block.get(b'D').or(depth).filter(|depth| *depth > 0.0) else {
                    let message =
                        format!("{code} without the depth of a pass: the control takes it from its own parameter");
                    let help =
                        format!("write {code} {letter}2. R1. before this block; on a Haas write D in this block");
                    return refuse(Code::PN007, message, help);
                };
                // on a Haas, the block of the cycle does not contain the retract
                let one_block = row.words.has(b'D');
                let Some(back) = back.or_else(|| one_block.then(|| self.usual_back())) else {
                    let message =
                        format!("{code} without the retract of a pass: the control takes it from its own parameter");
                    return refuse(Code::PN007, message, format!("write {code} {letter}2. R1. before this block"));
                };
                How::Passes { across, depth, back, left }
            }
        })
    }

    /// The retract after a pass if the program does not set one: 0.05 inch, the factory value of settings 22 and 73 of
    /// a Haas.
    fn usual_back(&self) -> f64 {
        if self.modes.units == Units::Inch { 0.05 } else { 1.27 }
    }
}

fn keep<const N: usize>(kept: &mut [Option<f64>; N], said: [Option<f64>; N]) {
    for (kept, said) in kept.iter_mut().zip(said) {
        *kept = said.or(*kept);
    }
}
