//! Settings from the commands of a form. The rows of `lang` define the field of each command and its default.

use super::args::{Arguments, Read};
use super::code::Code;
use super::file_name::{Extension, ProgramName};
use super::property::Property;
use super::store::Setting;
use crate::control::{self, Control};
use crate::lang::{Beam, COMMANDS, CommandId, Coolant, Machine, UnitChoice, VarId, command_rows};
use crate::span::Span;
use crate::syntax::Spanned;

/// Format of an arc's centre.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ArcCentre {
    /// One letter for each axis, in the order of the axes. With fewer letters, fewer planes are possible.
    Letters(Vec<u8>),
    /// The radius with this letter; negative for arcs over 180 degrees.
    Radius(u8),
}

/// The generated dwell block.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DwellWord {
    /// The code of a dwell, `G4`.
    pub code: Code,
    /// The letter of the time.
    pub letter: u8,
    /// The time is in milliseconds.
    pub milliseconds: bool,
}

/// Block numbers.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct SequenceNumbers {
    /// The letter; a space for numbers without a letter. With `None`, only lines that print `[block]` have numbers.
    pub letter: Option<u8>,
    /// The first number.
    pub start: i64,
    /// Increment from one number to the next.
    pub step: i64,
}

impl SequenceNumbers {
    /// Placeholder letter for numbers without a letter.
    pub const BARE: u8 = b' ';
}

impl Default for ArcCentre {
    fn default() -> Self {
        ArcCentre::Letters(Vec::new())
    }
}

/// `CoolantKind through M88 M89`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoolantKind {
    /// Kind of coolant.
    pub kind: Coolant,
    /// Code that turns it on.
    pub on: f64,
    /// Code that turns it off; `None`: the code that turns off flood coolant.
    pub off: Option<f64>,
}

/// `MoreWork 7 G54.1 P1`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MoreWork {
    /// The first fixture, counted from 1.
    pub first: u16,
    /// The code before its word, `G54.1`.
    pub code: Option<control::Code>,
    /// The letter of its word.
    pub letter: u8,
    /// The number in that word for the first fixture.
    pub number: f64,
}

/// What ends a line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LineEnd {
    /// A line feed.
    #[default]
    Lf,
    /// A carriage return and a line feed.
    CrLf,
}

/// A prompted variable.
#[derive(Clone, Debug, PartialEq)]
pub struct Prompt {
    /// The variable that the answer sets.
    pub var: VarId,
    /// Text of the question.
    pub text: String,
    /// Value without an answer.
    pub default: Option<f64>,
    /// The command.
    pub span: Span,
}

/// The travel of an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TravelLimit {
    /// Letter of the axis.
    pub letter: u8,
    /// Minimum position, in form units or degrees.
    pub least: f64,
    /// Maximum position.
    pub greatest: f64,
    /// The command.
    pub span: Span,
}

/// `Replace old new`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Replacement {
    /// The text to be replaced.
    pub old: String,
    /// The replacement.
    pub new: String,
    /// The command.
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
            /// Type of the beam (torch or laser), which the program switches on and off.
            pub beam: Option<Beam>,
            /// The depth axis is neither printed nor compared.
            pub is_flat: bool,
            /// Units of the form's own lengths.
            pub units: UnitChoice,
            /// Motion word of generated clockwise arcs.
            pub cw: Code,
            /// Motion word of generated counter-clockwise arcs.
            pub ccw: Code,
            /// Letters of the three axes in generated moves; the third is the depth's.
            pub axes: [u8; 3],
            /// Letters of the upper guide's axes.
            pub axes2: [u8; 3],
            /// Format of the centre of full circles.
            pub centre_full: Option<ArcCentre>,
            /// Prompts for variables.
            pub prompts: Vec<Prompt>,
            /// Later passes of a thread print approach, cut, clear and return; otherwise only X.
            pub thread_full: bool,
            /// Secondary clearance of deep cycles without their own.
            pub cycle_back_deep: Option<f64>,
            /// Secondary clearance of chip-breaking cycles without their own.
            pub cycle_back_chipbreak: Option<f64>,
            /// Secondary clearance of cycles through webs without their own.
            pub cycle_back_thru: Option<f64>,
            /// A peck cycle dwells after each step.
            pub cycle_dwell_steps: bool,
            /// A peck cycle dwells after each retract.
            pub cycle_dwell_retracts: bool,
        }

        impl Settings {
            /// Empty settings, without the defaults.
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
    /// The defaults of a form for this machine and these units.
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

    /// Checks and stores one command.
    pub(super) fn apply(&mut self, args: &Arguments) -> Read<()> {
        args.check()?;
        self.store(args)
    }

    /// The control of the form. If the form names none, a generic control that resembles a Fanuc.
    pub fn control(&self) -> &'static Control {
        self.control.unwrap_or_else(Control::of_no_name)
    }

    /// The control whose code table applies. Codes of lathes have other meanings, which the form's commands define.
    pub fn codes(&self) -> &'static Control {
        if self.machine == Machine::Mill { self.control() } else { Control::of_no_name() }
    }

    /// Is this G code in a command of the form, so that its effect is known?
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
