//! Converts CYCLE statements of Autodesk's post for CAMplete to the words of GENER.
//!
//! The points of a cycle are the tops of the holes. CLEAR is a height in the file's coordinates, all other values are
//! distances.

use super::fault::{Done, fault};
use super::report::Notes;
use super::state::CodedReturn;
use super::words::Word;
use crate::diag::Code;
use crate::toolpath::SpindleTurn;

/// A cycle in the words of GENER, and its return plane.
#[derive(Debug)]
pub(super) struct Converted {
    pub words: Vec<Word>,
    pub returns: CodedReturn,
}

/// What a number of a CYCLE statement gives.
#[derive(Clone, Copy, PartialEq)]
enum Value {
    /// A value that GENER gives with this word.
    As(&'static str),
    /// The height of the return plane, which may have the distance off the wall of a bore after it.
    Height,
    /// The distance from a point to the return plane. MANUSnc's post repeats the height instead.
    Above,
    /// The angle of a spindle stop, which is always 0: the post has no angle.
    Angle,
}

/// The words with a number.
#[rustfmt::skip]
const VALUES: [(&str, Value); 12] = [
    ("FEDTO", Value::As("DEPTH")), ("DEPTH", Value::As("DEPTH")), ("INCR", Value::As("STEP")),
    ("MMPM", Value::As("MMPM")), ("IPM", Value::As("IPM")), ("PITCH", Value::As("PERREV")),
    ("RAPTO", Value::As("CLEAR")), ("DWELL", Value::As("DWELL")),
    ("CLEAR", Value::Height), ("RTRCTO", Value::Above), ("RETURN", Value::Above), ("ORIENT", Value::Angle),
];

/// The words that GENER has for the types of cycles.
const TYPES: [(&str, &[&str]); 7] = [
    ("DRILL", &["DRILL"]),
    ("DEEP", &["DEEP"]),
    ("BRKCHP", &["BRKCHP"]),
    ("REAM", &["REAM"]),
    ("BORE", &["REAM"]),
    ("TAP", &["TAP"]),
    ("RIGID", &["TAP", "RIGID"]),
];

/// Converts a CYCLE statement. The statement does not give the hand of a tap: it follows from the direction of the
/// spindle.
pub(super) fn camplete(words: &[Word], turn: Option<SpindleTurn>, notes: &mut Notes<'_>) -> Done<Converted> {
    let (kind, mut rest) = match words {
        [drill, deep, rest @ ..] if drill.is("DRILL") && deep.is("DEEP") => ("DEEP", rest),
        [kind, rest @ ..] => (kind.name().unwrap_or(""), rest),
        [] => ("", words),
    };
    let Some((_, types)) = TYPES.iter().find(|(word, _)| *word == kind) else {
        let help = "expand the cycle in the CAM system";
        return fault(
            Code::PC001,
            format!("`{kind}` is a cycle that Autodesk's post for CAMplete does not write"),
            help,
        );
    };
    let (mut values, mut height, mut shift, mut above) = (Vec::new(), None, None, None);
    while let [word, after @ ..] = rest {
        let Some((_, value)) = VALUES.iter().find(|(name, _)| word.is(name)) else {
            let help = "expand the cycle in the CAM system, or write a cycle of GENER and `--dialect gener`";
            return fault(Code::PC018, format!("`{word}` in a cycle of Autodesk's post for CAMplete"), help);
        };
        let [Word::Number(number), after @ ..] = after else {
            return fault(Code::PC033, format!("{word} without its number"), format!("write {word},1"));
        };
        rest = after;
        match value {
            Value::As(word) => values.extend([name(word), Word::Number(*number)]),
            Value::Height => {
                height = Some(*number);
                if let [Word::Number(off_wall), after @ ..] = rest {
                    (shift, rest) = (Some(*off_wall), after);
                }
            }
            Value::Above => above = Some(*number),
            Value::Angle => {}
        }
    }
    let Some(height) = height else {
        return fault(Code::PC040, "a cycle without CLEAR, the height of its return plane", "give CLEAR");
    };
    begins_above(&values)?;
    if kind == "BORE" {
        bore(shift, notes)?;
    }
    let mut out: Vec<Word> = types.iter().copied().map(name).collect();
    if types[0] == "TAP" && turn == Some(SpindleTurn::Ccw) {
        out.push(name("INVERS"));
    }
    out.extend(values);
    // MANUSnc's post repeats the height
    let above = above.filter(|above| *above != height);
    Ok(Converted { words: out, returns: CodedReturn::Height { height, above } })
}

fn name(text: &str) -> Word {
    Word::Name(text.into())
}

/// Checks that the file gives the height where the feed begins. The post leaves RAPTO out if this height is not above
/// the top of the hole.
fn begins_above(values: &[Word]) -> Done {
    if values.iter().any(|word| word.is("CLEAR")) {
        return Ok(());
    }
    let help = "in the CAM system, set the feed height of the operation above the top of the hole";
    fault(Code::PL009, "a cycle without RAPTO: the height where its feed begins is unknown", help)
}

/// Checks a bore. Without a distance off the wall, the cycle is Autodesk's `boring`, which feeds out of the hole; with
/// this distance, it is `fine-boring`, which moves the tool off the wall at an angle that the post does not write.
fn bore(shift: Option<f64>, notes: &mut Notes<'_>) -> Done {
    if shift.is_some() {
        let message =
            "the angle at which a fine bore moves off the wall is unknown: the post writes ORIENT,0 for each angle";
        return fault(Code::PC015, message, "in the CAM system, use a boring or a reaming cycle");
    }
    let message = "CYCLE/BORE of Autodesk's post for CAMplete feeds out of the hole: its ORIENT,0 is ignored";
    notes.warn(Code::PL008, message, "use another CAM output if the spindle must stop in the hole");
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cl::report::Report;
    use crate::cl::words::words;

    /// The words of GENER, the return plane, and the number of warnings; for a refused cycle its code.
    fn converted(cycle: &str, turn: SpindleTurn) -> String {
        let mut report = Report::default();
        let made = camplete(&words(cycle.as_bytes()).unwrap(), Some(turn), &mut Notes::new(&mut report, None));
        match made {
            Ok(Converted { words, returns: CodedReturn::Height { height, above } }) => {
                let words: Vec<_> = words.iter().map(ToString::to_string).collect();
                format!("{} | {height} {above:?} | {}", words.join(","), report.warnings.len())
            }
            other => format!("{other:?}").split('"').next().unwrap_or_default().to_owned(),
        }
    }

    #[test]
    fn cycles_are_converted() {
        use SpindleTurn::{Ccw, Cw};
        for (cycle, turn, expected) in [
            (
                "DRILL, FEDTO, 9., MMPM, 90., CLEAR, 15., RTRCTO, 12., RETURN, 12., RAPTO, 5.",
                Cw,
                "DRILL,DEPTH,9,MMPM,90,CLEAR,5 | 15 Some(12.0) | 0",
            ),
            (
                "DRILL,DEEP, FEDTO, 9., INCR, 2., IPM, 90., CLEAR, 15., RETURN, 15., RAPTO, 5., DWELL, .5",
                Cw,
                "DEEP,DEPTH,9,STEP,2,IPM,90,CLEAR,5,DWELL,0.5 | 15 None | 0",
            ),
            (
                "RIGID, DEPTH, 9., PITCH, 1.25, CLEAR, 15., RETURN, 15., RAPTO, 5.",
                Cw,
                "TAP,RIGID,DEPTH,9,PERREV,1.25,CLEAR,5 | 15 None | 0",
            ),
            (
                "TAP, DEPTH, 9., MMPM, 90., CLEAR, 15., RETURN, 15., RAPTO, 5.",
                Ccw,
                "TAP,INVERS,DEPTH,9,MMPM,90,CLEAR,5 | 15 None | 0",
            ),
            (
                "BORE, FEDTO, 9., MMPM, 90., CLEAR, 15., RAPTO, 5., ORIENT, 0",
                Cw,
                "REAM,DEPTH,9,MMPM,90,CLEAR,5 | 15 None | 1",
            ),
        ] {
            assert_eq!(converted(cycle, turn), expected, "{cycle}");
        }
    }
}
