//! Converts CYCLE statements of other CAM systems to the words of GENER.

use super::dialect::Dialect;
use super::fault::{Done, fault};
use super::words::Word;
use crate::diag::Code;

fn name(text: &str) -> Word {
    Word::Name(text.into())
}

/// Converts a CYCLE statement to the words of GENER.
///
/// # Errors
/// GENER has no words for the statement.
pub(super) fn in_gener_words(words: &[Word], dialect: Dialect) -> Done<Vec<Word>> {
    let mut out: Vec<Word> = Vec::with_capacity(words.len() + 2);
    let mut flips = false;
    let mut words = words.iter().peekable();
    let mut first_peck = None;
    while let Some(word) = words.next() {
        let at_type = out.is_empty();
        let other = match (dialect, word.name().unwrap_or("")) {
            (Dialect::Ncl, "FEDTO") if out.first().is_some_and(|word| word.is("CSINK")) => {
                // CSINK of another system gives the diameter and the angle without words
                out.extend([name("DIAMET"), value_of(word, &mut words)?]);
                name("TLANGL")
            }
            (Dialect::SolidWorksCam | Dialect::Nx | Dialect::Ncl, "FEDTO") => {
                flips = dialect == Dialect::Nx; // the depth of NX has a sign; other depths are positive down
                name("DEPTH")
            }
            (Dialect::SolidWorksCam | Dialect::Nx | Dialect::Ncl, "RAPTO") => name("CLEAR"),
            // AUTO: return to the tool's position before the cycle, see `returns_to_start`
            (Dialect::Nx, "RTRCTO") if words.next_if(|word| word.is("AUTO")).is_some() => continue,
            (Dialect::SolidWorksCam | Dialect::Nx | Dialect::Ncl, "RTRCTO") => {
                out.extend([name("RETURN"), value_of(word, &mut words)?]);
                continue;
            }
            // RETURN,0 means that there is no return plane
            (Dialect::Catia, "RETURN") if words.next_if(|word| word.number() == Some(0.0)).is_some() => continue,
            (Dialect::Nx, "BORE") if at_type => {
                out.extend(nx_bore(words.next_if(|word| word.name().is_some_and(|name| NX_BORES.contains(&name))))?);
                continue;
            }
            (Dialect::SolidWorksCam, "DEEP2") if at_type => name("DEEP"),
            (Dialect::SolidWorksCam, "INCR") => name("STEP"),
            (Dialect::SolidWorksCam, "1STPECK") => {
                first_peck = Some(value_of(word, &mut words)?);
                continue;
            }
            (Dialect::SolidWorksCam, "SUBPECK") => {
                out.push(name("STEP"));
                out.extend(first_peck.take());
                value_of(word, &mut words)?
            }
            // in PostWorks, DEEP breaks chips, THRU is the DEEP of GENER, and BORE leaves the hole at feed
            (Dialect::Ncl, "DEEP") if at_type => name("BRKCHP"),
            (Dialect::Ncl, "THRU") if at_type => name("DEEP"),
            (Dialect::Ncl, "BORE") if at_type => name("REAM"),
            (Dialect::Ncl, "REVERS") if at_type => {
                out.push(name("TAP"));
                name("INVERS")
            }
            _ => match word {
                Word::Number(value) if std::mem::take(&mut flips) => Word::Number(-value),
                word => word.clone(),
            },
        };
        out.push(other);
    }
    if let Some(first) = first_peck {
        out.extend([name("STEP"), first]);
    }
    Ok(out)
}

/// The number after a word that needs a number.
fn value_of<'w>(word: &Word, words: &mut impl Iterator<Item = &'w Word>) -> Done<Word> {
    match words.next() {
        Some(number @ Word::Number(_)) => Ok(number.clone()),
        _ => fault(Code::PC033, format!("{word} without its number"), format!("write {word},1")),
    }
}

/// Words that modify BORE in files of NX.
const NX_BORES: [&str; 4] = ["DRAG", "NODRAG", "BACK", "MANUAL"];

/// Converts BORE of NX. Without a second word, the tool leaves the hole at feed. With DRAG the spindle stops and the tool leaves
/// at rapid; with NODRAG the tool also moves off the wall first.
fn nx_bore(kind: Option<&Word>) -> Done<Vec<Word>> {
    Ok(match kind.and_then(Word::name) {
        None => vec![name("REAM")],
        Some("DRAG") => vec![name("BORE")],
        Some("NODRAG") => vec![name("BORE"), name("ORIENT")],
        Some("BACK") => vec![name("BORE"), name("BACK")],
        Some(_) => {
            let help = "use BORE, DRAG or NODRAG in NX";
            return fault(Code::PC001, "a bore with a manual retract", help);
        }
    })
}

/// Whether the cycle returns to the position that the tool had before the cycle (only in files of NX).
pub(super) fn returns_to_start(words: &[Word], dialect: Dialect) -> bool {
    dialect == Dialect::Nx && words.windows(2).any(|pair| pair[0].is("RTRCTO") && pair[1].is("AUTO"))
}

/// The heights in a cycle of Autodesk, in the file's coordinates. The points of a cycle of Autodesk are the bottoms of
/// the holes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Heights {
    /// Distance from the top of a hole to its bottom.
    pub depth: f64,
    /// Height of the moves between holes.
    pub clearance: f64,
    /// Height where the rapid into a hole ends and its feed begins.
    pub retract: f64,
}

/// Converts CYCLE/type,depth[,INCR,step],unit,feed,clearance[,RAPTO,down][,DWELL,seconds] of Autodesk's ISO 4343 post to the
/// words of GENER. The result has no clearance, because the clearance follows from the heights.
pub(super) fn autodesk(words: &[Word]) -> Done<(Vec<Word>, Heights)> {
    let (Some(kind), Some(Word::Number(depth))) = (words.first().and_then(Word::name), words.get(1)) else {
        let help = "Autodesk writes CYCLE/DRILL, depth, MMPM, feed, clearance";
        return fault(Code::PC037, "a cycle of Autodesk without its depth", help);
    };
    if !matches!(kind, "DRILL" | "REAM" | "DEEP" | "BRKCHP" | "TAP") {
        let message = format!("Autodesk writes CYCLE/{kind} for cycles with different retracts");
        return fault(Code::PC001, message, "expand the cycle in the CAM system, or use a reaming cycle");
    }
    let mut out = vec![name(kind), name("DEPTH"), Word::Number(*depth)];
    let (mut clearance, mut down) = (None, 0.0);
    let mut rest = &words[2..];
    loop {
        rest = match rest {
            [] => break,
            [word, step @ Word::Number(_), after @ ..] if word.is("INCR") => {
                out.extend([name("STEP"), step.clone()]);
                after
            }
            [unit, feed @ Word::Number(_), Word::Number(height), after @ ..] if unit.is("MMPM") || unit.is("IPM") => {
                out.extend([unit.clone(), feed.clone()]);
                clearance = Some(*height);
                after
            }
            [word, Word::Number(by), after @ ..] if word.is("RAPTO") => {
                down = *by;
                after
            }
            [word, time @ Word::Number(_), after @ ..] if word.is("DWELL") => {
                out.extend([word.clone(), time.clone()]);
                after
            }
            [word, ..] => {
                let help =
                    "postform reads CYCLE/type, depth, INCR, step, MMPM, feed, clearance, RAPTO, down, DWELL, seconds";
                return fault(Code::PC018, format!("`{word}` in a cycle of Autodesk"), help);
            }
        };
    }
    let Some(clearance) = clearance.filter(|_| *depth > 0.0 && down >= 0.0) else {
        let help = "Autodesk writes CYCLE/DRILL, depth, MMPM, feed, clearance";
        return fault(Code::PC037, "a cycle of Autodesk without its depth, feed and clearance", help);
    };
    Ok((out, Heights { depth: *depth, clearance, retract: clearance - down }))
}
