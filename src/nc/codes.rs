//! The codes of a control as the simulator uses them: their groups and the words they use.

use std::borrow::Cow;

pub use crate::control::Group;
use crate::control::{AxisWords, Code, Control, Meaning, Row, Rules};

/// The bits of the letters in a text.
pub const fn letters(text: &str) -> u32 {
    crate::control::Words::of(text).bits()
}

/// The bit of an upper-case letter.
pub const fn bit(letter: u8) -> u32 {
    1 << (letter - b'A')
}

/// Words that are an error if no code of the block uses them. All other words may be in any block.
pub const CHECKED: u32 = letters("DEHIJKLPQR");
/// The bits of the axis words.
pub const AXES: u32 = letters("XYZABCUVW");

/// The group under which a block stores the G code of a row.
pub fn group(row: &Row, rules: Rules) -> Group {
    use Meaning as M;
    match row.meaning {
        M::Cycle | M::CycleEnd if !rules.is_nist() => Group::Cycle,
        M::Harmless | M::RigidAhead | M::TransformOff | M::MacroOff => Group::Other,
        meaning => meaning.group().unwrap_or(Group::Once),
    }
}

/// Whether the code of a row uses the axis words although it is not a motion. In a dwell of a Fanuc, for example, X is the time.
pub fn takes_axes(row: &Row, rules: Rules) -> bool {
    match row.meaning {
        Meaning::Reference => true,
        Meaning::Dwell => rules == Rules::Fanuc,
        meaning => meaning.axes() == AxisWords::Data,
    }
}

/// The row for a G code, given in tenths; `None`: the control does not have the code, or the simulator does not run it.
#[inline]
pub fn g_code(control: &'static Control, code: u16) -> Option<&'static Row> {
    control.row(Code { letter: b'G', tenths: code }).filter(|row| is_run(row, b'G'))
}

/// The row for an M code; `None`: the control does not have the code, or the simulator does not run it.
pub fn m_code(control: &'static Control, code: u16) -> Option<&'static Row> {
    let tenths = code.checked_mul(10)?;
    control.row(Code { letter: b'M', tenths }).filter(|row| is_run(row, b'M'))
}

/// Whether the simulator runs the code of a row if the code has this letter.
#[inline]
fn is_run(row: &Row, letter: u8) -> bool {
    row.not_run.is_none() && is_run_by(row.meaning, letter) && row.lacks().is_none()
}

/// The reason why the simulator does not run a code of the control; `None`: the control does not have the code.
pub fn why_not_run(control: &Control, code: Code) -> Option<Cow<'_, str>> {
    let row = control.row(code)?;
    if let Some(why) = &row.not_run {
        return Some(why.into());
    }
    let meaning = row.meaning.name();
    let letter = char::from(code.letter);
    Some(match row.lacks().filter(|_| is_run_by(row.meaning, code.letter)) {
        None => format!("`{meaning}` is not supported for {} {letter} code", article(letter)).into(),
        Some(what) => format!("the control file of {} does not give {what}", control.name()).into(),
    })
}

fn article(letter: char) -> &'static str {
    if letter == 'M' { "an" } else { "a" }
}

/// Whether the simulator runs codes with this meaning and this letter. The simulator refuses other codes with this
/// meaning and names them.
#[inline]
const fn is_run_by(meaning: Meaning, letter: u8) -> bool {
    use Meaning as M;
    match meaning {
        M::StopProgram
        | M::StopOptional
        | M::End
        | M::Pallet
        | M::SpindleCw
        | M::SpindleCcw
        | M::SpindleOff
        | M::SpindleCwCoolant
        | M::SpindleCcwCoolant
        | M::Orient
        | M::Flood
        | M::Mist
        | M::Through
        | M::CoolantOff
        | M::ToolChange
        | M::ToolNumber
        | M::Call
        | M::Return
        | M::Output
        | M::Override => letter == b'M',
        M::Harmless | M::RigidAhead => true,
        // only the reader of the control's own language runs these
        M::ToLevel | M::ToTop | M::ReturnLevel => false,
        // their effect is defined outside of the program, or is known only at the machine
        M::Macro | M::MacroOn | M::Data | M::Transform | M::Unsaid => false,
        _ => letter == b'G',
    }
}

/// The group of an M code: a block may have only one code of a group. Codes of group 0 have no effect in the simulator.
pub fn m_group(row: &Row) -> u8 {
    use crate::control::Group as G;
    match row.meaning {
        Meaning::Call | Meaning::Return => 5,
        Meaning::ToolChange | Meaning::ToolNumber => 6,
        Meaning::Override => 9,
        Meaning::Orient => 7,
        meaning => match meaning.group() {
            Some(G::Stop) => 4,
            Some(G::Spindle) => 7,
            Some(G::Coolant) => 8,
            _ => 0,
        },
    }
}

/// The row of the active motion code; `None`: no motion is active.
pub type Motion = Option<&'static Row>;

/// Whether a motion has one of these meanings.
#[inline]
pub fn is_one_of(motion: Motion, meanings: &[Meaning]) -> bool {
    motion.is_some_and(|row| meanings.contains(&row.meaning))
}

/// The meanings of rapids and straight cuts.
pub const STRAIGHT: [Meaning; 2] = [Meaning::Rapid, Meaning::Line];
/// The meanings of arcs.
pub const ARCS: [Meaning; 2] = [Meaning::ArcCw, Meaning::ArcCcw];
