//! The renderer: state, and which event does what.

use super::codes::Shift;
use super::cycles::ActiveCycle;
use super::fault::Done;
use super::output::{Layout, Output, TooLong, TraceLine};
use super::registers::Registers;
use super::vars::Vars;
use crate::compile::{LetterTable, Program};
use crate::cycle::{Defaults, Steps};
use crate::diag::{Code, Diag};
use crate::lang::VarId;
use crate::number::LetterFormat;
use crate::toolpath::{Axes, Event, FeedMode, Order, Place, Section, Sink, Units};

/// Where canned cycles come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Cycles {
    /// The form's sequences; moves where it has none.
    #[default]
    Form,
    /// Always moves.
    Emulated,
}

/// What a caller may choose.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Where cycles come from.
    pub cycles: Cycles,
    /// Units of the program; else those of the job.
    pub units: Option<Units>,
    /// The program's number; else that of the job.
    pub program: Option<u32>,
    /// Answers to prompts and values of variables; they go before the job's.
    pub set: Vec<(VarId, f64)>,
    /// Countersink depths by the formula that GENER's manual prints, which is right at 90 degrees only.
    pub sink_as_printed: bool,
    /// Keep a source map.
    pub trace: bool,
}

/// What kind of move printed last.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum LastMove {
    None,
    Rapid,
    Line,
    Cw,
    Ccw,
}

/// Prints the blocks of one program. Push the events of a job, and take the text as it comes.
pub struct Renderer<'p> {
    pub(super) program: &'p Program,
    pub(super) options: Options,
    pub(super) letters: &'p LetterTable,
    pub(super) layout: Layout,
    pub(super) out: Output,
    pub(super) registers: Registers,
    pub(super) vars: Vars,
    pub(super) place: Place,
    /// Where the stream of events stands.
    order: Order,
    /// The form line and word being printed.
    pub(super) form: Option<usize>,
    /// In which frame the axis words of this body stand.
    pub(super) shifted: Shift,
    /// The open block changed the frame of the depth axis.
    pub(super) depth_moved: bool,
    /// Where the tool is, in program units; axes not given are unknown.
    pub(super) position: Axes,
    /// Letters of h v d a b c.
    pub(super) axes: [u8; 6],
    /// What a position is multiplied with to be printed: 2 for an X that counts diameters.
    pub(super) axis_scale: [f64; 6],
    /// How many linear axes there are: four on a wire EDM machine.
    pub(super) linear: usize,
    /// Along which axis the tool goes into a hole: Z, the first axis of a lathe.
    pub(super) depth_axis: usize,
    pub(super) angles: super::rotary::Angles,
    /// Axes whose position variable was printed since this was last cleared, and no literal word after it.
    pub(super) placed: u8,
    /// The plane that the control is in: what was printed last, also before a tool change.
    pub(super) plane: f64,
    /// The distance code that the control is in, in tenths: what was printed last, also before a tool change.
    pub(super) distance: Option<i64>,
    /// Cutter compensation is on.
    pub(super) compensated: bool,
    pub(super) last_move: LastMove,
    /// The motion that the control is in, in tenths of its code: also where the next move says it again.
    pub(super) in_motion: Option<i64>,
    /// The item that is printed cuts.
    pub(super) cutting: bool,
    /// The height at which the subprogram called last left the tool, while nothing else tells one.
    pub(super) left_at: Option<f64>,
    /// Factor from the job's lengths to the program's.
    pub(super) scale: f64,
    /// Factor from the form's lengths to the program's.
    pub(super) form_scale: f64,
    pub(super) units: Units,
    pub(super) feed: Option<f64>,
    /// The same in units of its letter.
    pub(super) feed_units: Option<i64>,
    pub(super) feed_mode: FeedMode,
    pub(super) tool: Option<f64>,
    pub(super) tool_order: Option<Vec<f64>>,
    pub(super) tool_changes: usize,
    /// Since its change the tool has made no cut by a line: the first one must have a beginning.
    pub(super) fresh_tool: bool,
    /// The spindle's limit that a prompt gave.
    pub(super) most_rpm: Option<f64>,
    pub(super) served: super::changes::Served,
    pub(super) upon_used: Vec<Option<f64>>,
    /// A sequence printed a code or value that switches something.
    pub(super) switched: bool,
    /// The sequence that took the tool away from its place by numbers of its own; a rapid brings it back.
    pub(super) moved_by: Option<crate::span::Span>,
    /// Where the control left a cycle, and the other height at which the job did: a cut begins there.
    pub(super) left: Option<(Axes, f64)>,
    /// Something must be done before the next move: close a cycle, print a change, look at an Upon.
    pub(super) attention: bool,
    pub(super) watches_moves: bool,
    pub(super) measures: bool,
    pub(super) tracks: bool,
    pub(super) cycle: Option<ActiveCycle>,
    pub(super) defaults: Defaults,
    pub(super) steps: Steps,
    pub(super) sections: Vec<Section>,
    pub(super) subs: super::subprograms::Subprograms,
    /// Parts of an arc; kept so that an arc allocates nothing.
    pub(super) parts: Vec<f64>,
    notes: Vec<Diag>,
}

impl<'p> Renderer<'p> {
    /// Renders with this form.
    pub fn new(program: &'p Program, options: Options) -> Self {
        let letters = &program.letters[0];
        let number = program.settings.numbers.letter.map_or(letters[b'N'].format, |letter| letters[letter].format);
        let layout = Layout::new(&program.settings, number.int.count, number.int.fixed);
        let out = Output::new(&layout, options.trace);
        let settings = &program.settings;
        let ([h, v, d], [h2, v2, _]) = (settings.axes, settings.axes2);
        let edm = settings.machine == crate::lang::Machine::Edm;
        let diameter = if settings.by_diameter { 2.0 } else { 1.0 };
        let mut renderer = Renderer {
            program,
            letters,
            layout,
            out,
            options,
            registers: Registers::default(),
            vars: Vars::default(),
            place: Place::default(),
            order: Order::default(),
            form: None,
            shifted: Shift::None,
            depth_moved: false,
            position: Axes::default(),
            axes: if edm { [h, v, h2, v2, b'A', b'B'] } else { [h, v, d, b'A', b'B', b'C'] },
            axis_scale: [1.0, diameter, 1.0, 1.0, 1.0, 1.0],
            linear: if edm { 4 } else { 3 },
            depth_axis: if settings.machine == crate::lang::Machine::Lathe { 0 } else { 2 },
            angles: Default::default(),
            placed: 0,
            plane: 17.0,
            distance: None,
            compensated: false,
            last_move: LastMove::None,
            in_motion: None,
            cutting: false,
            left_at: None,
            scale: 1.0,
            form_scale: 1.0,
            units: Units::Inch,
            feed: None,
            feed_units: None,
            feed_mode: FeedMode::PerMinute,
            tool: None,
            tool_order: None,
            tool_changes: 0,
            fresh_tool: false,
            most_rpm: None,
            served: super::changes::Served::default(),
            upon_used: vec![None; program.upons.len()],
            switched: false,
            moved_by: None,
            left: None,
            attention: true,
            watches_moves: program.upon_vars.meets(super::motion::MOVE_VARS),
            measures: program.printed.with(program.upon_vars).meets(super::measure::MEASURES),
            tracks: super::motion::tracks(program),
            cycle: None,
            defaults: super::start::no_defaults(),
            steps: Steps::default(),
            sections: Vec::new(),
            subs: Default::default(),
            parts: Vec::new(),
            notes: Vec::new(),
        };
        renderer.form_values();
        renderer
    }

    /// The text printed so far and not yet taken: take it with `drain` or `clear` when it suits.
    pub fn text(&mut self) -> &mut Vec<u8> {
        self.main_text()
    }

    /// The source map of lines not yet taken.
    pub fn trace(&mut self) -> Option<&mut Vec<TraceLine>> {
        self.main_trace()
    }

    /// Warnings and notes so far: each kind of remark once.
    pub fn notes(&self) -> &[Diag] {
        &self.notes
    }

    /// Program lines printed so far.
    pub fn lines(&self) -> u64 {
        self.out.lines
    }

    pub(super) fn note(&mut self, code: Code, message: String, help: &str) {
        if !self.notes.iter().any(|n| n.code == code && n.message == message) && self.notes.len() < 100 {
            let mut diag = Diag::new(code, message).help(help);
            diag.place = Some(self.place.to_string());
            self.notes.push(diag);
        }
    }

    /// Was every block so far short enough for the control?
    #[inline]
    fn blocks_fit(&self) -> Done {
        self.out.too_long.map_or(Ok(()), too_long)
    }

    pub(super) fn bare_format(&self) -> &'p LetterFormat {
        &self.letters.bare
    }

    fn take(&mut self, event: Event<'_>) -> Done {
        self.cutting = matches!(
            event,
            Event::Line { .. } | Event::Arc { .. } | Event::Infeed { .. } | Event::Outfeed { rapid: false, .. }
        );
        match event {
            Event::Rapid(to) => self.rapid(&to),
            Event::Line { to, feed } => self.line(&to, feed),
            Event::Arc { arc, feed } => self.arc(arc, feed),
            Event::Hole(hole) => self.hole(&hole),
            Event::CycleBegin(spec) => self.cycle_begin(spec),
            Event::CycleEnd => self.cycle_end(),
            Event::ToolChange(change) => self.tool_change(change),
            Event::Start(start) => self.start(start),
            Event::Infeed { infeed, feed } => self.infeed(infeed, feed),
            Event::Outfeed { to, feed, rapid } => self.outfeed(&to, feed, rapid),
            Event::Tilt(axis) => self.tilt(axis),
            Event::Begin(section) => self.begin(section),
            Event::End(section) => self.end(section),
            Event::Dwell(seconds) => self.dwell(seconds),
            Event::Stop(kind) => self.stop(kind),
            Event::Comment(text) => self.comment(text),
            Event::Text(text) => self.verbatim(text),
            Event::Feed(feed) => self.change_feed(feed),
            Event::Work(work) => self.change_work(work),
            Event::Spindle(spindle) => self.change_spindle(&spindle),
            Event::Coolant(coolant) => self.change_coolant(coolant),
            Event::Set(name, value) => self.change_variable(name, value),
            Event::Thread(thread) => self.thread(thread),
            Event::Edm(action) => self.edm(action),
            Event::SubStart(number) => self.sub_start(number),
            Event::SubEnd => self.sub_end(),
            Event::SubCall(call) => self.sub_call(call),
            Event::Finish => self.finish(),
        }
    }
}

impl Sink for Renderer<'_> {
    #[inline]
    fn event(&mut self, event: Event<'_>, place: Place) -> Result<(), Box<Diag>> {
        self.place = place;
        let done = self.order.follow(&event).and_then(|()| self.take(event)).and_then(|()| self.blocks_fit());
        done.map_err(|mut diag| {
            diag.place.get_or_insert_with(|| place.to_string());
            diag
        })
    }
}

#[cold]
fn too_long(block: TooLong) -> Done {
    let TooLong { length, most, replaced } = block;
    let diag = Diag::new(Code::PR027, format!("a block of {length} characters, and the control reads {most}"));
    Err(Box::new(match replaced {
        Some(span) => diag
            .at(span, "this makes it too long")
            .help("take this Replace out: what it writes is replaced again by the next"),
        None => diag.help("make several blocks of it, or shorten its comment"),
    }))
}
