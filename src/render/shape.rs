//! The form, adapted to one job: its letters, its axes, its factors to the program's units, and the values that its
//! output needs. The head of the job completes the shape. A turret on the other side reverses one axis.

use super::defaults::{cycle_defaults, factor, form_units, no_defaults};
use super::fault::{Done, fault};
use super::options::Options;
use super::taken_branches::Ways;
use super::vars::{LAST_VARS, MEASURES, MOVE_VARS};
use crate::compile::{LetterKind, LetterTable, Program};
use crate::control::{Code, Group, Meaning, Row};
use crate::cycle::Defaults;
use crate::diag;
use crate::lang::{Machine, SequenceId, VarId};
use crate::number::POWERS;
use crate::toolpath::Units;

/// The rotary axes among the six, on machines with three linear axes.
pub const ROTARY: std::ops::Range<usize> = 3..6;

/// The rotary axes, as a set of axes.
pub const ROTARY_BITS: u8 = 0b111_000;

/// Values that do not change during a program, apart from the head of the job and a change of turret.
pub(super) struct Shape<'p> {
    pub program: &'p Program,
    pub options: Options,
    pub letters: &'p LetterTable,
    /// Letters of the axes h, v, d, a, b, c.
    pub axes: [u8; 6],
    /// Factor of a printed position: 2 for an X that counts diameters.
    pub scales: [f64; 6],
    /// Number of linear axes: four on a wire EDM machine.
    pub linear: usize,
    /// The axis along which the tool goes into a hole: Z, the first axis of a lathe.
    pub depth: usize,
    /// Factor from the job's lengths to the program's lengths.
    pub scale: f64,
    /// Factor from the form's lengths to the program's lengths.
    pub form_scale: f64,
    /// Units of the program.
    pub units: Units,
    /// Defaults of cycles, in program units.
    pub defaults: Defaults,
    /// Whether an Upon depends on the targets of moves.
    pub watches_moves: bool,
    /// Whether the form prints lengths or times of moves.
    pub measures: bool,
    /// Whether every move must set the position variables; otherwise they are set only before a sequence prints.
    pub sets_targets: bool,
    /// Factors of straight cuts that are printed in one pass; `None`: no cuts are printed in one pass.
    pub plain_factors: Option<[f64; 3]>,
    /// Routines for the branch combinations that were taken so far.
    pub ways: Ways,
}

/// Letter of a depth axis that the form ignores.
const NO_LETTER: u8 = 0;

impl<'p> Shape<'p> {
    /// The shape of a form, before the units of the job are known.
    pub fn new(program: &'p Program, options: Options) -> Self {
        let settings = &program.settings;
        let ([h, v, d], [h2, v2, _]) = (settings.axes, settings.axes2);
        let edm = settings.machine == Machine::Edm;
        let diameter = if settings.by_diameter { 2.0 } else { 1.0 };
        Shape {
            program,
            options,
            letters: &program.letters[0],
            axes: match edm {
                true => [h, v, h2, v2, b'A', b'B'],
                false => [h, v, if settings.is_flat { NO_LETTER } else { d }, b'A', b'B', b'C'],
            },
            scales: [1.0, diameter, 1.0, 1.0, 1.0, 1.0],
            linear: if edm { 4 } else { 3 },
            depth: if settings.machine == Machine::Lathe { 0 } else { 2 },
            scale: 1.0,
            form_scale: 1.0,
            units: Units::Inch,
            defaults: no_defaults(),
            watches_moves: program.upon_vars.meets(MOVE_VARS),
            measures: program.printed.with(program.asked).with(program.upon_vars).meets(MEASURES),
            sets_targets: sets_targets(program),
            plain_factors: None,
            ways: Ways::default(),
        }
    }

    /// Sets the units of the program for a job in these units, and all values that depend on the units.
    pub fn choose_units(&mut self, job: Units) -> Done {
        let settings = &self.program.settings;
        self.units = self.options.units.unwrap_or(job);
        let form = form_units(settings);
        if form.is_some_and(|form| form != self.units)
            && !self.program.printed.with(self.program.asked).has(VarId::Unitmode)
        {
            let (program, form) = (self.units.name(), form.map_or("", Units::name));
            let message =
                format!("the program would be in {program}, but the form is for {form} and does not print [unitmode]");
            let help = format!(
                "render with `--units {form}`, or print `G[unitmode]` in StartCode: without this code all lengths \
                 may be 25.4 times too long or too short"
            );
            return fault(diag::Code::PR010, message, help);
        }
        self.scale = factor(job, self.units);
        self.form_scale = factor(form.unwrap_or(Units::Inch), self.units);
        self.letters = &self.program.letters[usize::from(self.units == Units::Mm)];
        self.defaults = cycle_defaults(settings, job, self.units, self.options.sink_as_printed);
        self.plain_factors = self.factors();
        Ok(())
    }

    /// Reverses the axis for the second turret of a lathe, which works from the other side.
    pub fn choose_turret(&mut self, turret: Option<f64>) {
        let side = if self.program.settings.reverse_turret_2 && turret == Some(2.0) { -1.0 } else { 1.0 };
        self.scales[1] = self.scales[1].abs() * side;
        self.plain_factors = self.factors();
    }

    /// Factors from positions in the program's units to units of the letters h, v, d. `None`: for a straight cut, the
    /// form prints or checks more than positions, the motion code and a feed.
    fn factors(&self) -> Option<[f64; 3]> {
        let (program, settings) = (self.program, &self.program.settings);
        let cuts = settings.feed.code;
        let is_usual = self.linear == 3
            && !(settings.is_flat || settings.incremental || self.measures || self.sets_targets || self.watches_moves)
            && program.routine(SequenceId::LineCode).is_none()
            && settings.modality
            && settings.modal_codes.contains(&cuts)
            && self.group_of(cuts) == Some(Group::Motion);
        let axis = |axis: usize| {
            let letter = &self.letters[self.axes[axis]];
            // the other factors are powers of two and signs, so the product is exact
            let sign = if letter.reversed { -1.0 } else { 1.0 };
            let units = POWERS[usize::from(letter.format.dec.count)] as f64;
            (letter.kind == LetterKind::Axis && letter.modal).then_some(self.scales[axis] * sign * units)
        };
        let [h, v, d] = [axis(0), axis(1), axis(2)];
        is_usual.then_some([h?, v?, d?])
    }

    /// The depth axis, as a set of axes.
    pub fn depth_bit(&self) -> u8 {
        1 << self.depth
    }

    /// The row of a code in the table of the form's control.
    pub fn code_row(&self, code: Code) -> Option<&Row> {
        self.program.settings.codes().row(code)
    }

    /// The meaning of a code on the form's control; `None` if the meaning is unknown.
    pub fn meaning_of(&self, code: Code) -> Option<Meaning> {
        self.code_row(code).map(|row| row.meaning)
    }

    /// The modal group of a code.
    pub fn group_of(&self, code: Code) -> Option<Group> {
        self.meaning_of(code)?.group()
    }

    /// Whether a code starts a cycle of the form's control.
    pub fn is_cycle(&self, code: Code) -> bool {
        self.meaning_of(code).is_some_and(Meaning::is_cycle)
    }

    /// Whether a code selects the plane of arcs.
    pub fn is_plane(&self, code: Code) -> bool {
        self.group_of(code) == Some(Group::Plane)
    }

    /// The rotary axes of this machine.
    pub fn rotary(&self) -> std::ops::Range<usize> {
        if self.linear == ROTARY.start { ROTARY } else { 0..0 }
    }

    /// Whether this is the letter of an axis that the form ignores.
    pub fn is_ignored(&self, letter: u8) -> bool {
        let settings = &self.program.settings;
        settings.is_flat && letter == settings.axes[2]
    }

    /// The axis of a letter, as a set of axes.
    pub fn axis_bit(&self, letter: u8) -> u8 {
        self.axes.iter().position(|&axis| axis == letter).map_or(0, |axis| 1 << axis)
    }
}

/// Whether every move must set the position variables.
fn sets_targets(program: &Program) -> bool {
    let moves = [SequenceId::RapidCode, SequenceId::LineCode, SequenceId::CwCode, SequenceId::CcwCode];
    program.printed.with(program.asked).with(program.upon_vars).meets(LAST_VARS)
        || moves.iter().any(|&id| program.routine(id).is_some())
        || !program.settings.limits.is_empty()
        || program.upon_vars.meets(MOVE_VARS)
}
