//! Tool changes: LOADTL and similar words, and tools that NX names without loading them.

use super::cycle;
use super::dialect::Dialect;
use super::fault::{Done, fault};
use super::ignored::ignore_with_number;
use super::machine::no_cutcom_waits;
use super::report::Notes;
use super::state::State;
use super::words::{Word, numbers};
use crate::diag::Code;
use crate::toolpath::{Spindle, Tool};

/// Handles LOADTL/n, LOAD/TOOL,n and TOOLNO/n: a tool change. The tool change is complete at the next feed motion or
/// spindle statement.
pub(super) fn load(name: &str, words: &[Word], state: &mut State<'_>) -> Done {
    let dialect = state.job.notes.dialect();
    if name == "TOOLNO" && dialect == Dialect::Catia {
        if !words.iter().any(|word| word.is("TURN")) {
            // in CATIA, TOOLNO only describes the tool that LOADTL loads
            if let Some(Word::Number(diameter)) = words.get(1) {
                state.job.tools.diameter.set(Some(*diameter));
            }
            return Ok(());
        }
        state.job.turning()?;
    }
    let words = match words.first() {
        Some(word) if word.is("TOOL") => &words[1..],
        _ => words,
    };
    let Some(number) = words.first().and_then(Word::number).filter(|n| *n >= 0.0 && n.fract() == 0.0) else {
        return fault(Code::PL001, format!("{name} without a tool number"), format!("write {name}/1"));
    };
    let tools = &mut state.job.tools;
    tools.greatest = tools.greatest.max(number);
    let (length_offset, diameter_offset) = match (dialect, &words[1..]) {
        (Dialect::Autodesk | Dialect::Camplete, words) => autodesk_registers(words, dialect)?,
        // the other words only describe the tool
        (Dialect::Catia, _) if name == "TOOLNO" => (None, None),
        (_, words) => (length_register(name, number, words, &mut state.job.notes)?, None),
    };
    if dialect == Dialect::Camplete {
        state.job.begin_section()?;
    }
    another_tool(Some(Tool { number, length_offset, diameter_offset, ..Tool::default() }), state)
}

/// Handles TOOL PATH/name,TOOL,tool. If the statement names another tool than the current one, the other tool must be
/// loaded or have an assumed number.
pub(super) fn tool_path(words: &[Word], state: &mut State<'_>) -> Done {
    let (operation, tool) = match words {
        [operation, word, tool] if word.is("TOOL") => (operation.to_string(), tool.to_string()),
        _ => {
            let help = "write TOOL PATH/operation,TOOL,tool, with names that contain no comma, slash or parenthesis";
            return fault(Code::PL001, "a TOOL PATH that can't be read, so its tool is unknown", help);
        }
    };
    state.job.tools.operation = Some(operation);
    if state.job.tools.name.get() == Some(&tool) {
        return Ok(());
    }
    state.job.tools.name.set(Some(tool));
    another_tool(None, state)
}

/// Begins the change to another tool. The change is complete at the next feed motion or spindle statement. `None`: the tool
/// is named and not loaded so far.
fn another_tool(tool: Option<Tool>, state: &mut State<'_>) -> Done {
    let State { job, motion, feeds, cycle, .. } = state;
    no_cutcom_waits(&motion.cutcom, "a tool change")?;
    feeds.cut_off = cycle.is_active().then_some(job.notes.place.line).or(feeds.cut_off);
    cycle::end(cycle, job)?;
    let number = tool.as_ref().map(|tool| tool.number);
    job.begin_change(tool)?;
    motion.rapid_after_cycle = false; // the rapid would have belonged to the previous tool
    (motion.has_moved, motion.jump) = (false, None);
    let is_in = number.is_some() && std::mem::replace(&mut job.tools.loaded, number) == number;
    if std::mem::take(&mut job.tools.is_forced) && is_in {
        let message = "CSI_FORCE_TOOL_CHANGE is ignored: the tool is in the spindle, and is not changed again";
        job.notes.warn(Code::PL008, message, "if the machine must change it, write AUXFUN/6 after LOADTL");
    }
    if !is_in {
        job.tools.begin_tool();
        if !job.spindle.is_new {
            job.spindle.now = Spindle::default();
        }
    }
    job.spindle.is_new &= number.is_none();
    Ok(())
}

/// Reads the numbers that Autodesk writes after a tool's number: pocket, length, and the registers of the length and the
/// diameter. Only the post for MANUSnc writes the register of the diameter.
fn autodesk_registers(words: &[Word], dialect: Dialect) -> Done<(Option<f64>, Option<f64>)> {
    match numbers(words).as_deref() {
        Some([]) => Ok((None, None)),
        Some([_, _, length]) => Ok((Some(*length), None)),
        Some([_, _, length, diameter]) if dialect == Dialect::Camplete => {
            Ok((Some(*length), Some(*diameter).filter(|diameter| *diameter > 0.0)))
        }
        _ => {
            let help = "Autodesk writes LOADTL/tool, pocket, length, register";
            fault(Code::PL001, "a LOADTL of Autodesk that can't be read", help)
        }
    }
}

/// Reads the words after a tool's number. Returns the number of the length register.
fn length_register(name: &str, tool: f64, words: &[Word], notes: &mut Notes<'_>) -> Done<Option<f64>> {
    let mut register = None;
    let mut words = words.iter().peekable();
    while let Some(word) = words.next() {
        match (word, word.name()) {
            // the second number of CATIA only describes the tool
            (Word::Number(number), _) if notes.dialect() == Dialect::Catia || *number == tool => {}
            (Word::Number(number), _) => {
                let message = format!("the number {number} of {name} is ignored, because its meaning is unknown");
                notes.warn(Code::PL008, message, "if it is the length register, write ADJUST before it");
            }
            (_, Some(kind @ ("ADJUST" | "OFSETNO" | "OSETNO"))) => match words.next() {
                Some(Word::Number(number)) => register = Some(*number),
                Some(word) if word.is("OFF") => {
                    register = None;
                    let message =
                        format!("{kind},OFF of {name} is ignored: forms print the length register of the tool");
                    notes.warn(Code::PL008, message, "check the H word in the program");
                }
                _ => return fault(Code::PL001, format!("{kind} without its number"), format!("write {kind},1")),
            },
            (_, Some(word)) if ignore_with_number("LOADTL", word, &mut words, notes) => {}
            _ => {
                return fault(Code::PL002, format!("{name} can't take `{word}`"), format!("write {name}/1"));
            }
        }
    }
    Ok(register)
}
