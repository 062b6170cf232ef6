//! The settings of a form, made by its commands. A row of the table in `lang` defines the field and the default of each command.

use super::args::{Arguments, Read};
use super::code::Code;
use super::file_name::{Extension, ProgramName};
use super::property::Property;
use super::store::Setting;
use crate::control::{self, Control};
use crate::lang::{Beam, COMMANDS, CommandId, Coolant, Machine, UnitChoice, VarId, command_rows};
use crate::span::Span;
use crate::syntax::Spanned;

/// How the centre of an arc is printed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ArcCentre {
    /// One letter for each axis, in the order of the axes. With only two letters, arcs are possible in fewer planes.
    Letters(Vec<u8>),
    /// The radius, with this letter, instead of the centre. The radius is negative for arcs over 180 degrees.
    Radius(u8),
}

/// The dwell block that postform generates.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DwellWord {
    /// The code of a dwell, such as `G4`.
    pub code: Code,
    /// The letter of the time.
    pub letter: u8,
    /// Whether the time is in milliseconds.
    pub milliseconds: bool,
}

/// The settings of block numbers.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct SequenceNumbers {
    /// The letter of block numbers; a space for numbers without a letter. If `None`, only lines that print `[block]`
    /// have numbers.
    pub letter: Option<u8>,
    /// The first number.
    pub start: i64,
    /// Increment from one number to the next.
    pub step: i64,
}

impl SequenceNumbers {
    /// The value of `letter` for numbers without a letter.
    pub const BARE: u8 = b' ';
}

impl Default for ArcCentre {
    fn default() -> Self {
        ArcCentre::Letters(Vec::new())
    }
}

/// A kind of coolant with its codes, as in `CoolantKind through M88 M89`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoolantKind {
    /// Kind of coolant.
    pub kind: Coolant,
    /// Code that turns the coolant on.
    pub on: f64,
    /// Code that turns the coolant off. `None`: the code for flood coolant is used.
    pub off: Option<f64>,
}

/// Work offsets beyond the first ones, as in `MoreWork 7 G54.1 P1`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MoreWork {
    /// The first work offset to which the command applies, counted from 1.
    pub first: u16,
    /// The code before the word that selects the offset, such as `G54.1`.
    pub code: Option<control::Code>,
    /// The letter of the word that selects the offset.
    pub letter: u8,
    /// The number that selects the first of these offsets.
    pub number: f64,
    /// The number that selects the last offset that the control has. `None`: no limit is known.
    pub last: Option<f64>,
}

/// The characters at the end of a line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LineEnd {
    /// A line feed.
    #[default]
    Lf,
    /// A carriage return and a line feed.
    CrLf,
}

/// A variable whose value the user enters at a prompt.
#[derive(Clone, Debug, PartialEq)]
pub struct Prompt {
    /// The variable that the answer sets.
    pub var: VarId,
    /// Text of the question.
    pub text: String,
    /// The value if the user gives no answer.
    pub default: Option<f64>,
    /// Location of the command.
    pub span: Span,
}

/// The travel of an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TravelLimit {
    /// Letter of the axis.
    pub letter: u8,
    /// Minimum position, in the form's units or in degrees.
    pub least: f64,
    /// Maximum position.
    pub greatest: f64,
    /// Location of the command.
    pub span: Span,
}

/// A replacement of text in the program, as in `Replace old new`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Replacement {
    /// The text to be replaced.
    pub old: String,
    /// The replacement.
    pub new: String,
    /// Location of the command.
    pub span: Span,
}

macro_rules! settings {
    ($($id:ident $name:literal ($args:expr) $times:ident ($without:expr) $standing:ident
       { $($field:ident : $type:ty)? $(= $($place:tt)+)? $(=> $method:ident)? }
       $(if ($used:expr))? $(eg $example:literal)? $meaning:literal;)*) => {
        /// All settings of a form. Lengths are in the form's units.
        #[derive(Clone, Debug)]
        #[allow(rustdoc::broken_intra_doc_links)] // names in brackets are variables of forms
        pub struct Settings {
            $($(#[doc = $meaning] pub $field: $type,)?)*
            /// Type of the machine.
            pub machine: Machine,
            /// The torch or laser that the program switches on and off, if any.
            pub beam: Option<Beam>,
            /// Whether the depth axis is neither printed nor compared.
            pub is_flat: bool,
            /// Units of the form's own lengths.
            pub units: UnitChoice,
            /// The code of generated clockwise arcs.
            pub cw: Code,
            /// The code of generated counter-clockwise arcs.
            pub ccw: Code,
            /// Letters of the three axes in generated moves. The third letter is the depth axis.
            pub axes: [u8; 3],
            /// Letters of the axes of the upper wire guide.
            pub axes2: [u8; 3],
            /// How the centre of full circles is printed, if not like the centre of other arcs.
            pub centre_full: Option<ArcCentre>,
            /// Prompts for variables.
            pub prompts: Vec<Prompt>,
            /// Whether postform prints approach, cut, clear and return for every pass of a thread. If false, postform
            /// prints only X for the later passes.
            pub thread_full: bool,
            /// The default secondary clearance of deep cycles.
            pub cycle_back_deep: Option<f64>,
            /// The default secondary clearance of chip-breaking cycles.
            pub cycle_back_chipbreak: Option<f64>,
            /// The default secondary clearance of cycles through webs.
            pub cycle_back_thru: Option<f64>,
            /// Whether a peck cycle dwells after each step.
            pub cycle_dwell_steps: bool,
            /// Whether a peck cycle dwells after each retract.
            pub cycle_dwell_retracts: bool,
        }

        impl Settings {
            /// Empty settings, without the defaults of the commands.
            pub(super) fn blank() -> Self {
                Settings {
                    $($($field: <$type>::default(),)?)*
                    machine: Machine::default(),
                    beam: None,
                    is_flat: false,
                    units: UnitChoice::default(),
                    cw: Code::default(),
                    ccw: Code::default(),
                    axes: Default::default(),
                    axes2: Default::default(),
                    centre_full: None,
                    prompts: Vec::new(),
                    thread_full: false,
                    cycle_back_deep: None,
                    cycle_back_chipbreak: None,
                    cycle_back_thru: None,
                    cycle_dwell_steps: false,
                    cycle_dwell_retracts: false,
                }
            }

            /// Stores the arguments of one command in its field.
            fn store(&mut self, args: &Arguments) -> Read<()> {
                match args.id {
                    $(CommandId::$id => {
                        $(self.$field.set(args)?;)?
                        $(self.$($place)+.set(args)?;)?
                        $(self.$method(args)?;)?
                    })*
                }
                Ok(())
            }
        }
    };
}

command_rows! { settings }

impl Default for Settings {
    fn default() -> Self {
        Settings::new(Machine::default(), UnitChoice::default())
    }
}

impl Settings {
    /// The default settings of a form for this machine and these units.
    pub fn new(machine: Machine, units: UnitChoice) -> Self {
        let mut settings = Settings { machine, units, ..Settings::blank() };
        for row in COMMANDS {
            for said in row.without.arguments(machine, units).split(", ").filter(|said| !said.is_empty()) {
                let spanned = |text: &str| Spanned { text: text.to_owned(), span: Span::default() };
                let all: Vec<Spanned> = said.split(' ').map(spanned).collect();
                let read = settings.apply(&Arguments { id: row.id, all: &all, span: Span::default(), typed: false });
                debug_assert!(read.is_ok(), "{}: {said}", row.name);
            }
        }
        settings
    }

    /// Checks one command and stores its setting.
    pub(super) fn apply(&mut self, args: &Arguments) -> Read<()> {
        args.check()?;
        self.store(args)
    }

    /// The control of the form. If the form names no control, this is a generic control similar to a Fanuc.
    pub fn control(&self) -> &'static Control {
        self.control.unwrap_or_else(Control::of_no_name)
    }

    /// The control whose code table applies. On lathes and wire EDM machines, codes have other meanings, so the code
    /// table of the generic control is used.
    pub fn codes(&self) -> &'static Control {
        if self.machine == Machine::Mill { self.control() } else { Control::of_no_name() }
    }

    /// The codes that a variable may print, as defined by the commands of the form; empty for a variable without codes.
    pub fn codes_of(&self, var: VarId) -> Vec<f64> {
        match var {
            VarId::Work => vec![self.work, self.work_default],
            VarId::Direct => self.spindle.to_vec(),
            VarId::Cool => self.coolant.to_vec(),
            VarId::Coolantoff => vec![self.coolant[1]],
            VarId::Side => self.cdc.to_vec(),
            VarId::Feedtype => self.feed_type.to_vec(),
            VarId::Speedtype => self.speed_type.to_vec(),
            VarId::Retplane => self.return_plane.to_vec(),
            VarId::Unitmode => self.inch_mm.to_vec(),
            VarId::Incmode => self.inc_abs.to_vec(),
            VarId::Stop => self.stop_code.to_vec(),
            _ => Vec::new(),
        }
    }

    /// Whether a command of the form has this G code, so that the effect of the code is known.
    pub fn names_code(&self, asked: control::Code) -> bool {
        let codes = [Some(&self.rapid), Some(&self.feed), Some(&self.cw), Some(&self.ccw), Some(&self.dwell.code)];
        let more = [self.depth_rapid.as_ref(), self.thread.as_ref(), Some(&self.orient.0)];
        let mut codes = codes.into_iter().chain(more).flatten().chain(&self.planes);
        let numbers =
            [&self.feed_type[..], &self.speed_type, &self.cdc, &self.inc_abs, &self.inch_mm, &self.return_plane];
        codes.any(|code| code.code == asked)
            || asked.letter == b'G' && numbers.iter().any(|numbers| numbers.contains(&asked.value()))
    }
}
