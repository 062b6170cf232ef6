//! The renderer: state, and which event does what.

use super::codes::Shift;
use super::cycles::ActiveCycle;
use super::fault::Done;
use super::options::Options;
use super::printer::{Printer, TraceLine};
use super::registers::Registers;
use super::shape::Shape;
use super::vars::Vars;
use crate::compile::Program;
use crate::cycle::Steps;
use crate::diag::Diag;
use crate::toolpath::{Axes, Event, FeedMode, Flow, Order, Place, Section, Sink, Stop, flow};

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
    pub(super) shape: Shape<'p>,
    /// The operation being printed.
    pub(super) form: Option<usize>,
    pub(super) out: Printer,
    pub(super) registers: Registers,
    pub(super) vars: Vars,
    /// Where the stream of events stands.
    order: Order,
    /// In which frame the axis words of this body stand.
    pub(super) shifted: Shift,
    /// The open block changed the frame of the depth axis.
    pub(super) depth_moved: bool,
    /// Where the tool is, in program units; axes not given are unknown.
    pub(super) position: Axes,
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
    pub(super) cycle: Option<ActiveCycle>,
    pub(super) steps: Steps,
    pub(super) sections: Vec<Section>,
    pub(super) subs: super::subprograms::Subprograms,
    /// Parts of an arc; kept so that an arc allocates nothing.
    pub(super) parts: Vec<f64>,
}

impl<'p> Renderer<'p> {
    /// Renders with this form.
    pub fn new(program: &'p Program, options: Options) -> Self {
        let shape = Shape::new(program, options);
        let out = Printer::new(&program.settings, shape.letters, shape.options.trace);
        let mut renderer = Renderer {
            shape,
            out,
            registers: Registers::default(),
            vars: Vars::default(),
            order: Order::default(),
            shifted: Shift::None,
            depth_moved: false,
            position: Axes::default(),
            angles: Default::default(),
            placed: 0,
            plane: 17.0,
            distance: None,
            compensated: false,
            last_move: LastMove::None,
            in_motion: None,
            cutting: false,
            left_at: None,
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
            cycle: None,
            steps: Steps::default(),
            sections: Vec::new(),
            subs: Default::default(),
            parts: Vec::new(),
            form: None,
        };
        renderer.form_values();
        renderer
    }

    /// The text printed so far and not yet taken: take it with `drain` or `clear` when it suits.
    pub fn text(&mut self) -> &mut Vec<u8> {
        &mut self.main_page().text
    }

    /// The source map of lines not yet taken.
    pub fn trace(&mut self) -> Option<&mut Vec<TraceLine>> {
        self.main_page().trace.as_mut()
    }

    /// Warnings and notes so far: each kind of remark once.
    pub fn notes(&self) -> &[Diag] {
        self.out.notes()
    }

    /// Program lines printed so far.
    pub fn lines(&self) -> u64 {
        self.out.lines()
    }

    /// Was the end of the job printed?
    pub(crate) fn is_over(&self) -> bool {
        self.order == Order::End
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
    fn event(&mut self, event: Event<'_>, place: Place) -> Flow {
        self.out.place = place;
        let done = self.order.follow(&event).and_then(|()| self.take(event)).and_then(|()| self.out.blocks_fit());
        flow(done.map_err(|diag| Stop::from(diag).placed(|| place.into())))
    }
}
