//! The major words of statements, and how each is handled.

use super::arcs::circle;
use super::dialect::{Dialect, Sense};
use super::fault::{Done, fault};
use super::feed::{delay, fedrat};
use super::ignored::{ignore, ignore_rest, ignore_statement};
use super::job::{Job, Waiting};
use super::load::{load, tool_path};
use super::machine::{coolnt, cutcom, spindl, units};
use super::motion::{from, godlta, gohome, goto_words, multax, rapid, tlaxis, trans};
use super::setup::Setups;
use super::setups::{csys, mcs, msys, one_work_offset};
use super::state::State;
use super::tlon::{indirv, tlon};
use super::words::Word;
use crate::diag::Code;
use crate::suggest::did_you_mean;
use crate::toolpath::{Event, StopKind};

/// The kind of a major word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Major {
    None,
    Goto,
    Godlta,
    From,
    Rapid,
    Gohome,
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
    Multax,
    Set,
    Auxfun,
    Prefun,
    Data,
    Fini,
    EndOfPath,
    ToolPath,
    Msys,
    Csys,
    Mcs,
    /// Selects a work offset.
    Offset,
    Machin,
    Turret,
    /// Selects an offset register of the tool.
    Register,
    /// Sets a parameter of CAMplete for the tool path.
    Parameter,
    /// Clamps an axis.
    Clamp,
    /// Known words that have no effect on motions.
    Ignored,
    Nurbs,
    Thread,
    /// Known words that move or shift the part. These words are not supported, so they are errors.
    Refused,
    Unknown,
}

impl Major {
    /// Whether a number of the statement may have blanks inside, because no value of the program comes from the numbers of
    /// the statement.
    pub fn takes_no_number(self) -> bool {
        use Major::{Clamp, EndOfPath, Ignored, Machin, Multax, None, Parameter, Set, ToolPath, Unknown};
        matches!(self, Ignored | Unknown | None | EndOfPath | ToolPath | Machin | Multax | Parameter | Set | Clamp)
    }

    /// Whether a statement may end with a comma, because no value of the program comes from its last words. Some systems
    /// continue such statements without `$`.
    pub fn may_end_with_comma(self) -> bool {
        use Major::{Cutter, Data, Ignored, Machin, Multax, None, Parameter, Unknown};
        matches!(self, Ignored | Unknown | Cutter | Data | Machin | Multax | Parameter | None)
    }
}

/// The table of major words. TLRGT and similar words are refused, because with these words the tool cuts beside a line
/// and not on the line.
#[rustfmt::skip]
const MAJORS: &[(&str, Major)] = &[
    ("GOTO", Major::Goto), ("GODLTA", Major::Godlta), ("FROM", Major::From), ("RAPID", Major::Rapid),
    ("CIRCLE", Major::Circle), ("MOVARC", Major::Movarc), ("INDIRV", Major::Indirv), ("TLON", Major::Tlon),
    ("FEDRAT", Major::Fedrat), ("SPINDL", Major::Spindl), ("COOLNT", Major::Coolnt),
    ("LOADTL", Major::Load), ("LOAD", Major::Load), ("TOOLNO", Major::Load),
    ("CUTTER", Major::Cutter), ("TLDATA", Major::Cutter), ("CUTCOM", Major::Cutcom), ("CYCLE", Major::Cycle),
    ("GOHOME", Major::Gohome), ("UNITS", Major::Units), ("UNIT", Major::Units), ("DELAY", Major::Delay),
    ("STOP", Major::Stop), ("OPSTOP", Major::Opstop), ("TRANS", Major::Trans), ("ORIGIN", Major::Origin),
    ("TLAXIS", Major::Tlaxis), ("SET", Major::Set), ("AUXFUN", Major::Auxfun), ("PREFUN", Major::Prefun),
    ("$DATA", Major::Data), ("FINI", Major::Fini), ("END", Major::Fini), ("END-OF-PATH", Major::EndOfPath),
    ("TOOLPATH", Major::ToolPath), ("MSYS", Major::Msys), ("CSYS", Major::Csys), ("MCS", Major::Mcs), ("MACHIN", Major::Machin), ("SYN", Major::Ignored),
    ("MULTAX", Major::Multax), ("SELECT", Major::Ignored), ("SELCTL", Major::Ignored), ("PAINT", Major::Ignored),
    ("INTOL", Major::Ignored), ("OUTTOL", Major::Ignored), ("TOLER", Major::Ignored), ("AUTOPS", Major::Ignored),
    ("MODE", Major::Set), ("ARCSLP", Major::Ignored), ("CLEARP", Major::Ignored), ("SEQNO", Major::Ignored),
    ("SETUP", Major::Ignored), ("TRNTYP", Major::Ignored), ("CLAMP", Major::Clamp), ("CSI_SET_PATH_PARAM", Major::Parameter),
    ("OFSETNO", Major::Register), ("OSETNO", Major::Register), ("LINTOL", Major::Ignored), ("CLRSRF", Major::Ignored),
    ("TRACUT", Major::Refused), ("COPY", Major::Refused), ("INDEX", Major::Refused), ("BLOCK", Major::Refused),
    ("CALSUB", Major::Refused), ("DEFSUB", Major::Refused), ("ENDSUB", Major::Refused), ("MACRO", Major::Refused),
    ("CALL", Major::Refused), ("ROTABL", Major::Refused), ("ROTATE", Major::Refused), ("RETRCT", Major::Refused),
    ("OPSKIP", Major::Refused), ("ORIANT", Major::Refused), ("ORIENT", Major::Refused),
    ("TLRGT", Major::Refused), ("TLLFT", Major::Refused), ("GOFWD", Major::Refused), ("GOLFT", Major::Refused),
    ("GORGT", Major::Refused), ("GOBACK", Major::Refused), ("SPLINE", Major::Nurbs), ("NURBS", Major::Nurbs),
    ("ZERO", Major::Offset), ("POSTN", Major::Offset), ("DATUM", Major::Offset), ("FIXTUR", Major::Offset),
    ("FIXTURE", Major::Offset), ("WCS", Major::Offset),
    ("THREAD", Major::Thread), ("TURRET", Major::Turret), ("MIRROR", Major::Refused), ("ROTHED", Major::Refused), ("SCALE", Major::Refused), ("MATRIX", Major::Refused), ("REFSYS", Major::Refused),
];

/// Words that must not be lost in an unknown statement.
const MOTIONS: [&str; 5] = ["GOTO", "GODLTA", "CYCLE", "CIRCLE", "LOADTL"];

/// The kind of a major word.
pub(super) fn major(name: &str) -> Major {
    match MAJORS.iter().find(|(word, _)| *word == name) {
        Some((_, major)) => *major,
        None if name.starts_with("CSI_") => Major::Ignored,
        None => Major::Unknown,
    }
}

/// Executes one statement.
pub(super) fn run(major: Major, name: &str, words: &[Word], state: &mut State<'_>) -> Done {
    if state.job.aside && is_aside(major, state) {
        return Ok(());
    }
    let State { job, motion, arcs, cycle, setups, .. } = state;
    match major {
        Major::Goto => goto_words(words, state),
        Major::Godlta => godlta(words, state),
        Major::From => from(words, state),
        Major::Rapid => rapid(words, state),
        Major::Gohome => {
            job.notes.fact(shown(name, words));
            gohome(words, state)
        }
        Major::Circle => circle(words, None, state),
        Major::Movarc => circle(words, Some(Sense::RightHand), state),
        Major::Indirv => indirv(words, arcs, &motion.shift),
        Major::Tlon => tlon(words, state),
        Major::Fedrat => fedrat(words, state),
        Major::Spindl => spindl(words, cycle, job),
        Major::Coolnt => coolnt(words, job),
        Major::Load => load(name, words, state),
        Major::Cutter => cutter(words, job),
        Major::Cutcom => cutcom(words, &mut motion.cutcom, cycle, job),
        Major::Cycle => super::cycle::cycle(words, state),
        Major::Units => units(words, job),
        Major::Delay => delay(words, job),
        Major::Stop | Major::Opstop => {
            ignore_rest(name, words, &mut job.notes);
            let kind = if major == Major::Stop { StopKind::Program } else { StopKind::Optional };
            job.between(Event::Stop(kind))
        }
        Major::Trans => trans(words, &mut motion.shift, false),
        Major::Origin => trans(words, &mut motion.shift, true),
        Major::Tlaxis => tlaxis(words, state),
        Major::Multax => multax(words, state),
        Major::Set => set(name, words, job),
        Major::Auxfun => code('M', name, words, job),
        Major::Prefun => code('G', name, words, job),
        Major::Data => {
            data(words, setups.is_some(), job);
            Ok(())
        }
        Major::Register => {
            let message = format!("{} is ignored: the registers are those of LOADTL", shown(name, words));
            job.notes.warn(Code::PL008, message, "write the length register into LOADTL, as LOADTL/1,ADJUST,5");
            Ok(())
        }
        Major::Machin => {
            if !words.is_empty() {
                job.notes.fact(shown(name, words));
            }
            if words.iter().any(|word| word.is("TURN") || word.is("LATHE")) { job.turning() } else { Ok(()) }
        }
        Major::Csys => {
            job.notes.fact(shown(name, words));
            csys(words, motion, setups, job);
            Ok(())
        }
        Major::Mcs => {
            job.notes.fact(shown(name, words));
            mcs(words, state)
        }
        Major::Offset if job.notes.dialect() == Dialect::Camplete => work_offset(name, words, job),
        Major::Offset => {
            let help = "let the CAM system write a separate file for each work offset: each file is a job";
            fault(
                Code::PL004,
                format!("{name} selects a work offset, but a CL file is printed in a single work offset"),
                help,
            )
        }
        Major::Turret => {
            job.turning()?;
            load(name, words, state)
        }
        Major::ToolPath => {
            job.notes.fact(shown(name, words));
            tool_path(words, state)
        }
        Major::Msys => {
            job.notes.fact(shown(name, words));
            msys(words, job)
        }
        Major::Fini => super::cycle::end(cycle, job),
        Major::EndOfPath | Major::Ignored | Major::None => Ok(()),
        Major::Parameter => {
            for word in words.iter().filter_map(Word::name) {
                job.tools.is_forced |= word == "CSI_FORCE_TOOL_CHANGE=1";
                ignore(name, word, &mut job.notes);
            }
            Ok(())
        }
        Major::Clamp => {
            ignore_statement(name, words, "clamps of axes are not printed", &mut job.notes);
            Ok(())
        }
        Major::Unknown => unknown(name, words, job),
        Major::Thread => {
            let help = "let the CAM system write the passes of the thread, or write the thread into a job by hand";
            fault(Code::PL004, "THREAD: threads of CL files are not read", help)
        }
        Major::Nurbs => {
            let help = "let the CAM system write lines and arcs; in NX, set Motion Output Type of the operation";
            fault(Code::PL004, format!("{name}: a spline, and forms can't print splines"), help)
        }
        Major::Refused => {
            let message = format!("{name} moves, shifts or turns the positions, and postform does not support it");
            fault(Code::PL004, message, "let the CAM system write absolute motions instead")
        }
    }
}

/// Whether the word affects only the setup in which it is. A word for one setup is skipped if the setup is not
/// selected.
fn is_aside(major: Major, state: &State<'_>) -> bool {
    match major {
        Major::Circle | Major::Movarc | Major::Indirv | Major::Tlon | Major::Cutcom | Major::Nurbs | Major::Thread => {
            true
        }
        Major::Stop | Major::Opstop | Major::Delay | Major::Auxfun | Major::Prefun => true,
        // these are skipped too if the setups are only listed
        Major::Cycle | Major::Refused | Major::Offset | Major::Msys => {
            state.setups.as_ref().is_some_and(Setups::are_listed)
        }
        _ => false,
    }
}

/// Handles an unknown major word. The word is reported and ignored, but it is an error if a motion follows in the same
/// statement.
fn unknown(name: &str, words: &[Word], job: &mut Job<'_>) -> Done {
    if let Some(hidden) = words.iter().filter_map(Word::name).find(|name| MOTIONS.contains(name)) {
        let message = format!("the unknown word `{name}` is in front of {hidden}");
        return fault(Code::PL001, message, "remove the word, or put it on a separate line");
    }
    if job.notes.dialect().has_no_effect(name) {
        return Ok(());
    }
    // a statement without a slash, and a number: RAPID120 is read from `RAPID   120`
    let bare = name.trim_end_matches(|c: char| c.is_ascii_digit());
    if words.is_empty() && bare != name && !major(bare).takes_no_number() {
        let help =
            format!("write {bare}/.., or remove the number; if it is the number of a punched card, remove all of them");
        return fault(Code::PL001, format!("a number directly after {bare}"), help);
    }
    job.notes.unknown(name, || did_you_mean(name, MAJORS.iter().map(|(word, _)| *word)));
    Ok(())
}

/// Handles ZERO of CAMplete, which selects a work offset for the tool change before it.
fn work_offset(name: &str, words: &[Word], job: &mut Job<'_>) -> Done {
    match words {
        [Word::Number(number)] if *number >= 1.0 && number.fract() == 0.0 => job.work_offset(*number),
        _ => fault(Code::PL001, format!("{name} without the number of a work offset"), format!("write {name}/1")),
    }
}

/// Handles AUXFUN and PREFUN, which give the number of an M or G code.
fn code(letter: char, name: &str, words: &[Word], job: &mut Job<'_>) -> Done {
    match words {
        [Word::Number(code)] if *code >= 0.0 && code.fract() == 0.0 => {
            job.wait(Waiting::Text(format!("{letter}{code}")))
        }
        _ => fault(Code::PL001, format!("{name} without the number of a code"), format!("write {name}/8")),
    }
}

/// Handles MODE and SET. MODE/TURN selects a lathe. Incremental positions are refused.
fn set(name: &str, words: &[Word], job: &mut Job<'_>) -> Done {
    if name == "MODE" && words.first().is_some_and(|word| word.is("TURN")) {
        if job.notes.dialect().is_of_autodesk() {
            let help = "let the CAM system write JSON Lines, or an NC program, for a lathe";
            return fault(
                Code::PL004,
                "a turning file by Autodesk's APT post, which confuses spindle speeds and surface speeds",
                help,
            );
        }
        return job.turning();
    }
    if words.iter().any(|word| word.name().is_some_and(|name| name.starts_with("INCR"))) {
        let help = "let the CAM system write absolute positions";
        return fault(Code::PL004, format!("{name} switches to incremental positions"), help);
    }
    ignore_statement(name, words, "its effect is unknown", &mut job.notes);
    Ok(())
}

/// Handles CUTTER and TLDATA. The first number is the tool's diameter. Turning tools have no diameter.
fn cutter(words: &[Word], job: &mut Job<'_>) -> Done {
    if words.first().and_then(Word::name).is_some_and(|name| matches!(name, "TURN" | "GROOVE" | "THREAD")) {
        job.tools.diameter.set(None);
        return job.turning();
    }
    job.tools.diameter.set(words.iter().find_map(Word::number).filter(|diameter| *diameter > 0.0));
    Ok(())
}

/// Handles the data that Creo writes after `$$->`. `has_setups`: whether the file is read as several setups.
fn data(words: &[Word], has_setups: bool, job: &mut Job<'_>) {
    match words {
        [Word::Name(word), Word::Number(diameter)] if word == "CUTTER" => job.tools.diameter.set(Some(*diameter)),
        [Word::Name(word), system @ ..] if word == "CSYS" => {
            job.notes.fact(shown("", words));
            if !has_setups {
                one_work_offset(system, job);
            }
        }
        [Word::Name(word), ..] if word == "MFGNO" => job.notes.fact(shown("", words)),
        _ => {}
    }
}

/// The text of a statement, for messages.
fn shown(name: &str, words: &[Word]) -> String {
    let list: Vec<_> = words.iter().map(ToString::to_string).collect();
    if name.is_empty() { list.join(" ") } else { format!("{name} {}", list.join(" ")) }
}
