//! The values that a form supplies for values missing in the job, and the values that the form itself defines.

use super::cooled;
use super::form_values::{Own, by, printed_by};
use super::tables::{CHORDS, INCREMENTS};
use super::wire_codes::{self, Coded, Codes};
use crate::compile::{Op, Program, WorkWords};
use crate::control::{Code, Control, Meaning};
use crate::cycle::Defaults;
use crate::lang::{Beam, Machine, SEQUENCES, TextId, UnitChoice, VarId, work_code};
use crate::nc::RunSettings;
use crate::render::cycle_defaults;
use crate::sema::{PropertyValue, Settings};
use crate::toolpath::{EdmAction, Units};

/// The values of the form that are needed to compare job and program.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Expectation {
    /// Cycle defaults in inches and in millimetres.
    pub defaults: [Defaults; 2],
    /// How far short lines may deviate from the arc that they replace, in inches and in millimetres.
    pub chord: [f64; 2],
    /// The smallest step that the form can print along a hole, in inches and in millimetres.
    pub increment: [f64; 2],
    /// Number of the first work offset: 54 for G54, or 1 on a control that numbers its offsets.
    pub first_work: f64,
    /// Work offset that is active until the job selects a work offset.
    pub work: Option<f64>,
    /// How the form prints work offsets, and the control that defines their codes.
    pub(super) work_words: Option<(WorkWords, &'static Control)>,
    /// Numbers that are added to a tool's number to get its length register and its diameter register, if the job names
    /// no register.
    pub registers: Option<[f64; 2]>,
    /// Whether the machine loads tools (M6) and has length offsets.
    pub tools: bool,
    /// Whether a length offset must be on before the tool goes down. The value has an effect only on machines with
    /// length offsets.
    pub lengths_due: bool,
    /// Whether the program must set the units itself.
    pub units_due: bool,
    /// For each of the job's axes X Y Z A B C, the axis in the program (the form's `Rename`).
    pub axes: [u8; 6],
    /// Codes of each kind of coolant.
    pub(super) coolant: cooled::Codes,
    /// Whether taps are rigid if the job does not define whether they are; `None`: the form does not define it either.
    pub rigid_tap: Option<bool>,
    /// Whether the form prints the code (M29) that makes the following taps rigid. Without this code the taps are not
    /// rigid.
    pub announces_taps: bool,
    /// Whether X of a lathe is a diameter.
    pub by_diameter: bool,
    /// Whether subprograms come before the main program.
    pub subs_first: bool,
    /// The torch or laser that the machine switches on and off for cuts.
    pub beam: Option<Beam>,
    /// Whether the form prints no depth axis (Z).
    pub is_flat: bool,
    /// The form's codes for threading and cutting a wire; `None` if there is no form.
    pub(super) wire: Option<Codes>,
    /// The widths in characters to which the form shortens the names of tools in words.
    pub name_widths: Vec<usize>,
    /// Feeds that the form itself prints or calculates.
    pub feeds: Own,
    /// Speeds that the form itself prints or calculates.
    pub speeds: Own,
}

impl Default for Expectation {
    /// The values if there is no form: the job gets no defaults.
    fn default() -> Self {
        let defaults = Defaults { rigid: true, ..Defaults::default() };
        Expectation {
            defaults: [defaults; 2],
            chord: CHORDS,
            increment: INCREMENTS,
            first_work: 54.0,
            work: None,
            work_words: None,
            registers: None,
            tools: true,
            lengths_due: true,
            units_due: true,
            axes: [0, 1, 2, 3, 4, 5],
            coolant: cooled::Codes::usual(),
            rigid_tap: None,
            announces_taps: false,
            by_diameter: true,
            subs_first: false,
            beam: None,
            is_flat: false,
            wire: None,
            name_widths: Vec::new(),
            feeds: Own::default(),
            speeds: Own::default(),
        }
    }
}

impl Expectation {
    /// The defaults of a control, for a job without a form. The pecks of the job retract as those of the control.
    pub fn of_control(settings: &RunSettings) -> Expectation {
        let usual = Expectation::default();
        let defaults = [Units::Inch, Units::Mm].map(|units| {
            let back = settings.back_off_in(units);
            Defaults { back_deep: back, back_chipbreak: back, ..usual.defaults[0] }
        });
        let first_work = if settings.control.counts_work() { 1.0 } else { usual.first_work };
        Expectation { tools: loads_tools(settings.control), defaults, first_work, ..usual }
    }

    /// The defaults of a form.
    pub fn of_form(settings: &Settings, sink_as_printed: bool) -> Expectation {
        let defaults = [Units::Inch, Units::Mm]
            .map(|units| Defaults { rigid: true, ..cycle_defaults(settings, units, units, sink_as_printed) });
        let chord = settings.tolerance * if settings.units == UnitChoice::Mm { 1.0 / 25.4 } else { 1.0 };
        Expectation {
            defaults,
            chord: [chord.max(CHORDS[0]), (chord * 25.4).max(CHORDS[1])],
            first_work: settings.work,
            work: Some(settings.work_default),
            registers: Some([settings.lcomp, settings.dcomp]),
            tools: settings.machine != Machine::Edm && settings.beam.is_none() && loads_tools(settings.control()),
            units_due: settings.units == UnitChoice::Both,
            axes: rotary_axes(&settings.rename),
            coolant: cooled::Codes::of_form(settings),
            rigid_tap: settings.rigid_tap.then_some(true),
            by_diameter: settings.by_diameter,
            subs_first: settings.subs_first,
            beam: settings.beam,
            is_flat: settings.is_flat,
            ..Expectation::default()
        }
    }

    /// Adds the feeds and speeds that the form's sequences print as numbers or calculate. A cut may have one of these
    /// feeds or speeds instead of the job's value.
    #[must_use]
    pub fn typed(mut self, program: &Program) -> Expectation {
        let settings = &program.settings;
        self.wire = (settings.machine == Machine::Edm).then(|| wire_codes::codes_of(program));
        (self.feeds, self.speeds) = (Own::of(program), Own::of(program));
        let widths = program.ops.iter().filter_map(|op| match op {
            Op::TextVar { var, in_comment: false, .. } if var.id == TextId::Toolname => Some(var.width.unsigned_abs()),
            _ => None,
        });
        self.name_widths = widths.filter(|width| *width != 0).map(usize::from).collect();
        let along = settings.axes[if settings.machine == Machine::Lathe { 0 } else { 2 }];
        self.increment =
            program.letters.each_ref().map(|letters| 10f64.powi(-i32::from(letters[along].format.dec.count)));
        let sequences = SEQUENCES.iter().filter_map(|row| program.routine(row.id).map(|own| (own, printed_by(row.id))));
        let upons = program.upons.iter().map(|upon| (&upon.routine, by::JOB));
        for (routine, by) in sequences.chain(upons) {
            self.types(program, &program.ops[routine.ops.clone()], by);
        }
        self.work_words = Some((program.work.clone(), settings.codes()));
        self.work = self.work.and_then(|work| self.work_of(work));
        self
    }

    /// Collects the feeds and speeds in the lines of a sequence. `by`: the events that print the sequence.
    fn types(&mut self, program: &Program, ops: &[Op], by: u8) {
        let settings = &program.settings;
        for op in ops {
            match *op {
                Op::Literal { index, .. } => match &program.literals[index as usize] {
                    word if word.letter == settings.feed_code => self.feeds.types(word.value, by),
                    word if word.letter == settings.speed_code => self.speeds.types(word.value, by),
                    word => {
                        let meaning = word.code.and_then(|code| settings.codes().meaning(code));
                        self.announces_taps |= meaning == Some(Meaning::RigidAhead);
                    }
                },
                Op::Formula { letter, index, .. } if letter == settings.feed_code => {
                    self.feeds.calculates(&program.formulas[index as usize], &[VarId::Frate, VarId::Plunge], by);
                }
                Op::Formula { letter, index, .. } if letter == settings.speed_code => {
                    self.speeds.calculates(&program.formulas[index as usize], &[VarId::Speed], by);
                }
                _ => {}
            }
        }
    }

    /// The number or code with which the program selects a work offset of the job; `None`: the form has no such offset.
    pub(super) fn work_of(&self, work: f64) -> Option<f64> {
        let counted = work_code(self.first_work, work)?;
        let named = |(words, control): &(WorkWords, &'static Control)| self.feeds.work(counted, words, control);
        Some(self.work_words.as_ref().map_or(counted, named))
    }
}

impl Expectation {
    /// Replaces the form's defaults of properties by given values. The row in the form's table of properties identifies
    /// the property.
    #[must_use]
    pub fn given(mut self, properties: &[(u16, PropertyValue)]) -> Expectation {
        for (row, value) in properties {
            self.feeds.given(*row, value);
            self.speeds.given(*row, value);
        }
        self
    }
}

/// The program's axis for each axis of the job. Only renamed rotary axes are considered, because renaming X, Y or Z would change holes
/// and arcs.
fn rotary_axes(rename: &[(u8, u8)]) -> [u8; 6] {
    let mut axes = [0, 1, 2, 3, 4, 5];
    for (from, to) in rename {
        let index = |letter: &u8| b"ABC".iter().position(|other| other == letter);
        if let (Some(from), Some(to)) = (index(from), index(to)) {
            axes.swap(3 + from, 3 + to);
        }
    }
    axes
}

impl Expectation {
    /// The codes that the form prints for an action of the wire.
    pub(super) fn wire_codes(&self, action: EdmAction) -> impl Iterator<Item = Coded> {
        let row = self.wire.iter().flatten().find(|(own, _)| *own == action);
        row.map(|(_, codes)| codes.clone()).unwrap_or_default().into_iter()
    }
}

/// Whether this control taps rigidly only after a separate code (M29). A Haas and a Fadal tap rigidly by G84 alone.
pub(super) fn taps_ahead(control: &Control) -> bool {
    control.has(Meaning::RigidAhead)
}

/// Whether the control loads tools. A control that refuses M6, such as Grbl, does not load tools.
fn loads_tools(control: &Control) -> bool {
    !control.refuses(Code::m(6))
}
