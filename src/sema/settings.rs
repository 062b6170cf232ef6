//! What the commands of a form say, with the defaults of language.md section 3.

use crate::control::Control;
use crate::lang::{Machine, VarId};
use crate::span::Span;

/// A code of a command: printed as typed when its letter was typed, else by the letter's format.
#[derive(Clone, Debug, PartialEq)]
pub struct Code {
    /// The letter, given or implied.
    pub letter: u8,
    /// As typed, `G00`.
    pub text: Option<String>,
    /// Its number.
    pub value: f64,
}

impl Code {
    /// A code that nobody typed.
    pub fn plain(letter: u8, value: f64) -> Code {
        Code { letter, text: None, value }
    }
}

/// Which lengths a form is written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UnitChoice {
    /// Inches.
    Inch,
    /// Millimetres.
    Mm,
    /// Serves both; its own lengths are inches.
    Both,
}

/// Centre words of an arc.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ArcCentre {
    /// One letter for each axis, in the order of the axes; fewer cover fewer planes.
    Letters(Vec<u8>),
    /// The radius with this letter; printed negative for arcs over 180 degrees.
    Radius(u8),
}

/// The generated dwell block.
#[derive(Clone, Debug, PartialEq)]
pub struct DwellWord {
    /// Its code, `G4`.
    pub code: Code,
    /// The letter of the time.
    pub letter: u8,
    /// The time is in milliseconds.
    pub milliseconds: bool,
}

/// Block numbers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SequenceNumbers {
    /// The letter; `None` numbers only the lines that print `[block]`.
    pub letter: Option<u8>,
    /// The first number.
    pub start: i64,
    /// From one to the next.
    pub step: i64,
}

/// A prompted variable.
#[derive(Clone, Debug, PartialEq)]
pub struct Prompt {
    /// What is asked for.
    pub var: VarId,
    /// The question.
    pub text: String,
    /// The answer when nobody gives one.
    pub default: Option<f64>,
    /// The command.
    pub span: Span,
}

/// The travel of an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TravelLimit {
    /// Its letter.
    pub letter: u8,
    /// Least position, form units or degrees.
    pub least: f64,
    /// Greatest position.
    pub greatest: f64,
    /// The command.
    pub span: Span,
}

/// `Replace old new`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Replacement {
    /// The text that goes.
    pub old: String,
    /// The text that comes.
    pub new: String,
    /// The command.
    pub span: Span,
}

/// Everything that commands set. Lengths are in the form's units.
#[derive(Clone, Debug)]
#[allow(missing_docs)] // the table of commands says what each does
pub struct Settings {
    pub name: String,
    pub machine: Machine,
    pub units: UnitChoice,
    /// The control that the form names.
    pub control: Option<&'static Control>,
    pub rapid: Code,
    pub feed: Code,
    pub cw: Code,
    pub ccw: Code,
    pub feed_code: u8,
    pub speed_code: u8,
    pub feed_type: [f64; 3],
    pub speed_type: [f64; 2],
    pub spindle: [f64; 3],
    pub coolant: [f64; 3],
    pub flush: [f64; 3],
    pub cdc: [f64; 3],
    pub cdc_code: u8,
    pub dwell: DwellWord,
    pub orient: (Code, u8),
    pub stop_code: [f64; 2],
    pub lcomp: f64,
    pub dcomp: f64,
    pub work: f64,
    pub work_default: f64,
    pub inc_abs: [f64; 2],
    pub inch_mm: [f64; 2],
    pub return_plane: [f64; 2],
    pub axes: [u8; 3],
    pub axes2: [u8; 3],
    pub by_diameter: bool,
    pub rev_signs: Vec<u8>,
    pub incremental: bool,
    pub centre: ArcCentre,
    pub centre_over_180: Option<ArcCentre>,
    pub centre_full: Option<ArcCentre>,
    pub centre_incremental: bool,
    pub by_quadrants: bool,
    pub planes: Vec<Code>,
    pub helical: bool,
    pub min_radius: f64,
    pub max_radius: f64,
    pub tolerance: f64,
    pub arc_with_line: bool,
    pub arc_with_same: bool,
    pub circle_direction: Option<[String; 2]>,
    pub second_circle: Option<String>,
    pub modality: bool,
    pub modal_letters: Option<Vec<u8>>,
    pub modal_codes: Vec<f64>,
    pub force: Vec<u8>,
    pub numbers: SequenceNumbers,
    pub number_first: bool,
    pub number_last: bool,
    pub blanks: bool,
    pub columns: Vec<usize>,
    pub leading_zeros: bool,
    pub eob: String,
    pub comment: [String; 2],
    pub upper_comments: bool,
    pub replace: Vec<Replacement>,
    pub rename: Vec<(u8, u8)>,
    pub dummy: Vec<u8>,
    pub mod_text: Vec<String>,
    pub prompts: Vec<Prompt>,
    pub subs_first: bool,
    pub renumber_subs: bool,
    pub depth_rapid: Option<Code>,
    pub restart_depth: bool,
    pub reverse_turret_2: bool,
    pub limits: Vec<TravelLimit>,
    pub thread: Option<Code>,
    pub thread_full: bool,
    pub cycle_clear: Option<f64>,
    pub cycle_step: Option<f64>,
    pub cycle_min_step: f64,
    pub cycle_back_deep: Option<f64>,
    pub cycle_back_chipbreak: Option<f64>,
    pub cycle_back_thru: Option<f64>,
    pub cycle_dwell: f64,
    pub cycle_dwell_steps: bool,
    pub cycle_dwell_retracts: bool,
    pub cycle_orient: f64,
    pub cycle_jog: Option<f64>,
    pub cycle_sink_clear: Option<f64>,
    pub rigid_tap: bool,
}

impl Default for Settings {
    fn default() -> Self {
        Settings::new(Machine::Mill, UnitChoice::Inch)
    }
}

impl Settings {
    /// The control that the form is for; that of forms that name none is much like a Fanuc.
    pub fn control(&self) -> &'static Control {
        self.control.unwrap_or_else(Control::of_no_name)
    }

    /// The control whose codes the form has. Codes of lathes have other meanings, which are told by the form's commands.
    pub fn codes(&self) -> &'static Control {
        if self.machine == Machine::Mill { self.control() } else { Control::of_no_name() }
    }

    /// Do the form's commands name this G code, so that what it does is known?
    pub fn names_code(&self, value: f64) -> bool {
        let codes = [Some(&self.rapid), Some(&self.feed), Some(&self.cw), Some(&self.ccw), Some(&self.dwell.code)];
        let more = [self.depth_rapid.as_ref(), self.thread.as_ref(), Some(&self.orient.0)];
        let mut codes = codes.into_iter().chain(more).flatten().chain(&self.planes);
        let numbers =
            [&self.feed_type[..], &self.speed_type, &self.cdc, &self.inc_abs, &self.inch_mm, &self.return_plane];
        codes.any(|code| code.value == value) || numbers.iter().any(|numbers| numbers.contains(&value))
    }

    /// The defaults for a type of machine and the form's units.
    pub fn new(machine: Machine, units: UnitChoice) -> Self {
        let lathe = machine == Machine::Lathe;
        let length = |inch: f64, mm: f64| if units == UnitChoice::Mm { mm } else { inch };
        let letters = |text: &str| ArcCentre::Letters(text.bytes().collect());
        Settings {
            name: String::new(),
            machine,
            units,
            control: None,
            rapid: Code::plain(b'G', 0.0),
            feed: Code::plain(b'G', 1.0),
            cw: Code::plain(b'G', 2.0),
            ccw: Code::plain(b'G', 3.0),
            feed_code: b'F',
            speed_code: b'S',
            feed_type: if lathe { [98.0, 99.0, 93.0] } else { [94.0, 95.0, 93.0] },
            speed_type: [96.0, 97.0],
            spindle: [3.0, 4.0, 5.0],
            coolant: [8.0, 9.0, 7.0],
            flush: [8.0, 9.0, 7.0],
            cdc: [41.0, 42.0, 40.0],
            cdc_code: b'D',
            dwell: DwellWord { code: Code::plain(b'G', 4.0), letter: b'P', milliseconds: false },
            orient: (Code::plain(b'M', 19.0), b'R'),
            stop_code: [0.0, 1.0],
            lcomp: 0.0,
            dcomp: 0.0,
            work: 54.0,
            work_default: 54.0,
            inc_abs: [91.0, 90.0],
            inch_mm: [20.0, 21.0],
            return_plane: [99.0, 98.0],
            axes: if lathe { *b"ZXY" } else { *b"XYZ" },
            axes2: *b"UVW",
            by_diameter: lathe,
            rev_signs: Vec::new(),
            incremental: false,
            centre: letters(if lathe { "KI" } else { "IJK" }),
            centre_over_180: None,
            centre_full: None,
            centre_incremental: true,
            by_quadrants: false,
            planes: [17.0, 18.0, 19.0].map(|value| Code::plain(b'G', value)).into(),
            helical: true,
            min_radius: length(0.0005, 0.01),
            max_radius: length(999.0, 25_000.0),
            tolerance: length(0.0005, 0.01),
            arc_with_line: true,
            arc_with_same: true,
            circle_direction: None,
            second_circle: None,
            modality: true,
            modal_letters: None,
            modal_codes: vec![0.0, 1.0, 2.0, 3.0, 17.0, 18.0, 19.0],
            force: Vec::new(),
            numbers: SequenceNumbers { letter: None, start: 10, step: 10 },
            number_first: true,
            number_last: true,
            blanks: true,
            columns: Vec::new(),
            leading_zeros: false,
            eob: String::new(),
            comment: ["(".into(), ")".into()],
            upper_comments: true,
            replace: Vec::new(),
            rename: Vec::new(),
            dummy: Vec::new(),
            mod_text: Vec::new(),
            prompts: Vec::new(),
            subs_first: false,
            renumber_subs: true,
            depth_rapid: None,
            restart_depth: false,
            reverse_turret_2: false,
            limits: Vec::new(),
            thread: None,
            thread_full: false,
            cycle_clear: None,
            cycle_step: None,
            cycle_min_step: 0.0,
            cycle_back_deep: None,
            cycle_back_chipbreak: None,
            cycle_back_thru: None,
            cycle_dwell: 0.5,
            cycle_dwell_steps: false,
            cycle_dwell_retracts: false,
            cycle_orient: 0.0,
            cycle_jog: None,
            cycle_sink_clear: None,
            rigid_tap: false,
        }
    }
}
