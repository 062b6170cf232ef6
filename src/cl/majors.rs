//! Major words: what is done for each.

use super::reader::{Done, Reader, Waiting, fault};
use super::words::Word;
use crate::diag::Code;
use crate::toolpath::{Event, StopKind};

/// What a major word asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Major {
    None,
    Goto,
    Godlta,
    From,
    Rapid,
    Circle,
    Movarc,
    Indirv,
    Tlon,
    Fedrat,
    Spindl,
    Coolnt,
    Load,
    Cutter,
    Cutcom,
    Cycle,
    Units,
    Delay,
    Stop,
    Opstop,
    Trans,
    Origin,
    Tlaxis,
    Set,
    Auxfun,
    Prefun,
    Data,
    Fini,
    EndOfPath,
    /// Tells something about the file.
    Fact,
    ToolPath,
    Msys,
    /// Known, and of no consequence for the motions.
    Ignored,
    /// Known to move or shift the part, and not supported.
    Refused,
    Unknown,
}

/// The words; TLRGT and its like cut beside a line instead of on it.
#[rustfmt::skip]
const MAJORS: &[(&str, Major)] = &[
    ("GOTO", Major::Goto), ("GODLTA", Major::Godlta), ("FROM", Major::From), ("RAPID", Major::Rapid),
    ("CIRCLE", Major::Circle), ("MOVARC", Major::Movarc), ("INDIRV", Major::Indirv), ("TLON", Major::Tlon),
    ("FEDRAT", Major::Fedrat), ("SPINDL", Major::Spindl), ("COOLNT", Major::Coolnt),
    ("LOADTL", Major::Load), ("LOAD", Major::Load), ("TOOLNO", Major::Load),
    ("CUTTER", Major::Cutter), ("TLDATA", Major::Cutter), ("CUTCOM", Major::Cutcom), ("CYCLE", Major::Cycle),
    ("UNITS", Major::Units), ("UNIT", Major::Units), ("DELAY", Major::Delay),
    ("STOP", Major::Stop), ("OPSTOP", Major::Opstop), ("TRANS", Major::Trans), ("ORIGIN", Major::Origin),
    ("TLAXIS", Major::Tlaxis), ("SET", Major::Set), ("AUXFUN", Major::Auxfun), ("PREFUN", Major::Prefun),
    ("$DATA", Major::Data), ("FINI", Major::Fini), ("END", Major::Fini), ("END-OF-PATH", Major::EndOfPath),
    ("TOOLPATH", Major::ToolPath), ("MSYS", Major::Msys), ("CSYS", Major::Fact), ("MACHIN", Major::Fact), ("SYN", Major::Ignored),
    ("MULTAX", Major::Ignored), ("SELECT", Major::Ignored), ("SELCTL", Major::Ignored), ("PAINT", Major::Ignored),
    ("INTOL", Major::Ignored), ("OUTTOL", Major::Ignored), ("TOLER", Major::Ignored), ("AUTOPS", Major::Ignored),
    ("MODE", Major::Set), ("ARCSLP", Major::Ignored), ("CLEARP", Major::Ignored), ("SEQNO", Major::Ignored),
    ("SETUP", Major::Ignored), ("TRNTYP", Major::Ignored), ("CLAMP", Major::Unknown),
    ("OFSETNO", Major::Ignored), ("OSETNO", Major::Ignored), ("LINTOL", Major::Ignored), ("CLRSRF", Major::Ignored),
    ("TRACUT", Major::Refused), ("COPY", Major::Refused), ("INDEX", Major::Refused), ("BLOCK", Major::Refused),
    ("CALSUB", Major::Refused), ("DEFSUB", Major::Refused), ("ENDSUB", Major::Refused), ("MACRO", Major::Refused),
    ("CALL", Major::Refused), ("ROTABL", Major::Refused), ("ROTATE", Major::Refused), ("RETRCT", Major::Refused),
    ("GOHOME", Major::Refused), ("OPSKIP", Major::Refused), ("ORIANT", Major::Refused), ("ORIENT", Major::Refused),
    ("TLRGT", Major::Refused), ("TLLFT", Major::Refused), ("GOFWD", Major::Refused), ("GOLFT", Major::Refused),
    ("GORGT", Major::Refused), ("GOBACK", Major::Refused), ("SPLINE", Major::Refused), ("NURBS", Major::Refused),
    ("THREAD", Major::Refused), ("TURRET", Major::Refused), ("MIRROR", Major::Refused), ("ROTHED", Major::Refused), ("SCALE", Major::Refused), ("MATRIX", Major::Refused), ("REFSYS", Major::Refused),
];

/// Words that must not be lost in a statement that is not known.
const MOTIONS: [&str; 5] = ["GOTO", "GODLTA", "CYCLE", "CIRCLE", "LOADTL"];

/// The major of a word.
pub(super) fn major(name: &str) -> Major {
    match MAJORS.iter().find(|(word, _)| *word == name) {
        Some((_, major)) => *major,
        None if name.starts_with("CSI_") => Major::Ignored,
        None => Major::Unknown,
    }
}

impl Reader<'_> {
    /// Does what a statement asks for.
    pub(super) fn run(&mut self, major: Major, name: &str, words: &[Word]) -> Done {
        if major == Major::Cutter {
            self.insert = None; // the text before it was the tool's
        } else {
            self.lone_insert();
        }
        match major {
            Major::Goto => self.goto_words(words),
            Major::Godlta => self.godlta(words),
            Major::From => self.from(words),
            Major::Rapid => self.rapid(words),
            Major::Circle => self.circle(words, None),
            Major::Movarc => self.circle(words, Some(super::dialect::Sense::RightHand)),
            Major::Indirv => self.indirv(words),
            Major::Tlon => self.tlon(words),
            Major::Fedrat => self.fedrat(words),
            Major::Spindl => self.spindl(words),
            Major::Coolnt => self.coolnt(words),
            Major::Load => self.load(name, words),
            Major::Cutter => self.cutter(words),
            Major::Cutcom => self.cutcom(words),
            Major::Cycle => self.cycle(words),
            Major::Units => self.units(words),
            Major::Delay => self.delay(words),
            Major::Stop => self.stop(StopKind::Program),
            Major::Opstop => self.stop(StopKind::Optional),
            Major::Trans => self.shift(words, false),
            Major::Origin => self.shift(words, true),
            Major::Tlaxis => self.tlaxis(words),
            Major::Set => self.set(name, words),
            Major::Auxfun => self.code('M', name, words),
            Major::Prefun => self.code('G', name, words),
            Major::Data => self.data(words),
            Major::Fini => self.end(),
            Major::Fact | Major::ToolPath | Major::Msys => {
                self.fact(shown(name, words));
                match major {
                    Major::ToolPath => self.tool_path(words),
                    Major::Msys => self.msys(words),
                    _ => Ok(()),
                }
            }
            Major::EndOfPath | Major::Ignored | Major::None => Ok(()),
            Major::Unknown => {
                // a label or number before a motion must not hide it
                if let Some(hidden) = words.iter().filter_map(Word::name).find(|name| MOTIONS.contains(name)) {
                    let message = format!("`{name}` stands before {hidden}");
                    return fault(Code::PL001, message, "take it out, or put it on a line of its own");
                }
                self.note_unknown(name);
                Ok(())
            }
            Major::Refused => {
                let message = format!("{name} moves, shifts or turns something that postform can't follow");
                fault(Code::PL004, message, "let the CAM system write plain motions instead")
            }
        }
    }

    fn stop(&mut self, kind: StopKind) -> Done {
        self.close_holes()?;
        self.push(Event::Stop(kind))
    }

    /// AUXFUN and PREFUN are codes by number.
    fn code(&mut self, letter: char, name: &str, words: &[Word]) -> Done {
        match words {
            [Word::Number(code)] if *code >= 0.0 && code.fract() == 0.0 => {
                self.wait(Waiting::Text(format!("{letter}{code}")))
            }
            _ => fault(Code::PL001, format!("{name} without the number of a code"), format!("write {name}/8")),
        }
    }

    /// MODE and SET: what counts is whether positions stay positions.
    fn set(&mut self, name: &str, words: &[Word]) -> Done {
        if words.iter().any(|word| word.name().is_some_and(|name| name.starts_with("INCR"))) {
            let help = "let the CAM system write absolute positions";
            return fault(Code::PL004, format!("{name} asks for incremental positions"), help);
        }
        Ok(())
    }

    /// What Creo writes behind `$$->`.
    fn data(&mut self, words: &[Word]) -> Done {
        match words {
            [Word::Name(word), Word::Number(diameter)] if word == "CUTTER" => self.diameter = Some(*diameter),
            [Word::Name(word), ..] if word == "CSYS" || word == "MFGNO" => self.fact(shown("", words)),
            _ => {}
        }
        Ok(())
    }
}

/// A statement as it is shown.
fn shown(name: &str, words: &[Word]) -> String {
    let list: Vec<_> = words.iter().map(ToString::to_string).collect();
    if name.is_empty() { list.join(" ") } else { format!("{name} {}", list.join(" ")) }
}
