//! What a control's codes are to the simulator: their groups, the words they use.

use std::borrow::Cow;
use std::fmt;

pub use crate::control::Group;
use crate::control::{AxisWords, Code, Control, Meaning, Row, Rules};

/// Letters as bits.
pub const fn letters(text: &str) -> u32 {
    crate::control::Words::of(text).bits()
}

/// The bit of an upper-case letter.
pub const fn bit(letter: u8) -> u32 {
    1 << (letter - b'A')
}

/// Words that some code must use; all others may stand in any block.
pub const CHECKED: u32 = letters("DEHIJKLPQR");
/// Words of axes.
pub const AXES: u32 = letters("XYZABCUVW");

/// The group of a row of G codes in a block.
pub fn group(row: &Row, rules: Rules) -> Group {
    use Meaning as M;
    match row.meaning {
        M::Cycle | M::CycleEnd if rules == Rules::Fanuc => Group::Cycle,
        M::Harmless | M::TransformOff | M::MacroOff => Group::Other,
        meaning => meaning.group().unwrap_or(Group::Once),
    }
}

/// Does a row's code use the axis words without being a motion? X of a Fanuc's dwell is its time.
pub fn takes_axes(row: &Row, rules: Rules) -> bool {
    match row.meaning {
        Meaning::Reference => true,
        Meaning::Dwell => rules == Rules::Fanuc,
        meaning => meaning.axes() == AxisWords::Data,
    }
}

/// The row of ten times a G number; `None`: the control has no such code, or it is not run.
#[inline]
pub fn g_code(control: &'static Control, code: u16) -> Option<&'static Row> {
    runs(control.row(Code { letter: b'G', tenths: code })?, b'G', code)
}

/// The row of an M number; `None`: the control has no such code, or it is not run.
pub fn m_code(control: &'static Control, code: u16) -> Option<&'static Row> {
    let tenths = code.checked_mul(10)?;
    runs(control.row(Code { letter: b'M', tenths })?, b'M', tenths)
}

/// The row, if the simulator runs it under this code.
#[inline]
fn runs(row: &'static Row, letter: u8, tenths: u16) -> Option<&'static Row> {
    (row.not_run.is_none() && is_simulated(row.meaning, Code { letter, tenths })).then_some(row)
}

/// Why a code that this control has is not run; `None`: the control has no such code.
pub fn why_not_run(control: &Control, code: Code) -> Option<Cow<'_, str>> {
    let row = control.row(code)?;
    if let Some(why) = &row.not_run {
        return Some(why.into());
    }
    let meaning = row.meaning.name();
    let letter = char::from(code.letter);
    Some(match is_run_by(row.meaning, code.letter) {
        false => format!("there is no rule for `{meaning}` by {} {letter} code", article(letter)).into(),
        true => format!("`{meaning}` is run under its usual numbers only").into(),
    })
}

fn article(letter: char) -> &'static str {
    if letter == 'M' { "an" } else { "a" }
}

/// Is a code of this meaning run? A meaning says what a code switches; how exactly a cycle drills, and which work
/// offset or reference point is meant, is known by the number, as LinuxCNC, Fanuc and Haas document it.
#[inline]
fn is_simulated(meaning: Meaning, code: Code) -> bool {
    use Meaning as M;
    let number = code.tenths;
    is_run_by(meaning, code.letter)
        && match meaning {
            M::Rapid => number == 0,
            M::Line => number == 10,
            M::ArcCw => number == 20,
            M::ArcCcw => number == 30,
            M::Thread => matches!(number, 320 | 330),
            M::RigidTap => number == 331,
            M::ThreadCycle => matches!(number, 760 | 920),
            M::Cycle => matches!(number, 730 | 740 | 760 | 810 | 820 | 830 | 840 | 850 | 860 | 870 | 880 | 890),
            M::CycleEnd => number == 800,
            M::Work => matches!(number, 540 | 541 | 550 | 560 | 570 | 580 | 590..=593 | 1540),
            M::Reference => matches!(number, 280 | 300),
            M::SetReference => matches!(number, 281 | 301),
            M::Data => number == 100,
            M::Probe => matches!(number, 382..=385),
            M::Frame | M::Preset => matches!(number, 520 | 920 | 500),
            M::FrameOff => matches!(number, 921..=923),
            _ => true,
        }
}

/// By codes of which letter a meaning is run: it is refused by name in all others.
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
        | M::Call
        | M::Return
        | M::Output
        | M::Override => letter == b'M',
        M::Harmless => true,
        // what they do is written elsewhere, or known only at the machine
        M::Macro | M::MacroOn | M::Transform | M::ToolNumber | M::Unsaid => false,
        _ => letter == b'G',
    }
}

/// Groups of M codes: 0 changes nothing that is simulated.
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

/// A G code by ten times its number; it shows as `G91.1` for 911.
#[derive(Clone, Copy, Debug)]
pub struct Name(pub u16);

impl fmt::Display for Name {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (whole, tenth) = (self.0 / 10, self.0 % 10);
        if tenth == 0 { write!(f, "G{whole}") } else { write!(f, "G{whole}.{tenth}") }
    }
}
