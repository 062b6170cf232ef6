//! The errors of Grbl for blocks that it refuses, by number.

use crate::diag::Code;
use crate::nc::fault::Fault;

/// An error: the number that Grbl reports, the code of the finding, the problem, and the correction.
type Row = (u8, Code, &'static str, &'static str);

#[rustfmt::skip]
const ERRORS: [Row; 24] = [
    (1, Code::PN001, "a word must begin with a letter", "take the character out: Grbl has no `%`, no parameters and no expressions"),
    (2, Code::PN001, "a letter without its number", "write a plain number after the letter"),
    (4, Code::PN018, "F, N, P, S and T are not negative", "write the number without the minus"),
    (11, Code::PN001, "more than 79 characters without spaces, slashes and comments", "break the block into several blocks"),
    (20, Code::PN003, "not a code or word of Grbl", "remove the code or word, or print the program for a control that has it"),
    (21, Code::PN004, "two codes of one modal group", "write the codes in two blocks, or take one code out"),
    (22, Code::PN008, "a cut without a feed", "write F in the block; under G93 write F in every block that cuts"),
    (23, Code::PN003, "Grbl does not have this code with a fraction", "write the code without the fraction"),
    (24, Code::PN004, "two codes that both use axis words", "write the two codes in two blocks"),
    (25, Code::PN002, "a word that is twice in the block", "keep one of the two words"),
    (26, Code::PN006, "the code needs axis words and has none", "write the position, as X and Y; a full circle needs its end too"),
    (27, Code::PN018, "a block number over 10000000", "use smaller block numbers, or none"),
    (28, Code::PN007, "a word that the code needs is missing", "write P with G4, and P and L with G10"),
    (29, Code::PN018, "no such work offset", "write P1 for G54 up to P6 for G59, or P0 for the active work offset"),
    (30, Code::PN006, "G53 without G0 or G1", "write G0 with G53"),
    (31, Code::PN006, "axis words while G80 is active", "write G0 or G1 first"),
    (32, Code::PN009, "an arc without an axis word of its plane", "write the end of the arc, even if it is the start"),
    (33, Code::PN009, "the end does not fit the move", "check the end and the centre; a full circle can't be given by R"),
    (34, Code::PN009, "the radius R is too small to reach the end", "R must be at least half the distance to the end"),
    (35, Code::PN009, "an arc without a centre in its plane", "write R, or the centre with the I J K of the plane"),
    (36, Code::PN005, "a word that no code in the block uses", "remove the word, or write the code of the word in this block"),
    (37, Code::PN006, "G43.1 takes Z and no other word", "write G43.1 Z and the length"),
    (38, Code::PN018, "a tool above 255", "tools are T0 to T255"),
    (0, Code::PN016, "a command of Grbl itself is not simulated", "send the command by hand: it can't be in a program"),
];

/// The fault for an error of Grbl. `about`: the text and the column of the wrong part of the block, if known.
#[cold]
pub(super) fn error(number: u8, about: Option<(&str, usize)>) -> Box<Fault> {
    let row = ERRORS.iter().find(|(row, ..)| *row == number);
    let &(number, code, message, help) = row.unwrap_or(&ERRORS[ERRORS.len() - 1]);
    let what = about.map_or(String::new(), |(text, _)| format!("`{text}`: "));
    let answer = if number == 0 { String::new() } else { format!(" (Grbl answers error:{number})") };
    let mut fault = Fault::new(code, format!("{what}{message}{answer}"), help);
    fault.column = about.map(|(_, column)| column);
    fault
}

/// Refuses a block with an error of Grbl.
pub(super) fn refuse<T>(number: u8) -> Result<T, Box<Fault>> {
    Err(error(number, None))
}
