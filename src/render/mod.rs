//! Converts toolpath events to NC blocks (docs/rendering.md). The parts are the form (`shape`), the values that the job
//! requests (`want`), the known state of the control (`said`), the output (`printer`), and the functions that connect
//! them.

mod ahead;
mod ascii;
mod body;
mod branches;
mod comment_marks;
mod coolant;
mod cx;
mod cycle;
mod defaults;
mod dwell;
mod fault;
mod file_name;
mod fixtures;
mod form_sets;
mod layout;
mod more_coolants;
mod moves;
mod needs;
mod no_value;
mod numbers;
mod options;
mod prelude;
mod printer;
mod prints;
mod program;
mod properties;
mod said;
mod settle;
mod shape;
mod stopped_spindle;
mod taken_branches;
mod targets;
mod texts;
mod turret;
mod unnumbered;
mod upon;
mod values;
mod vars;
mod want;
mod words;
mod work;
mod work_words;

use crate::compile::Program;
use crate::diag::Diag;
use crate::lang::VarId;
use crate::toolpath::{Event, Flow, Order, Place, Section, Sink, Stop, flow};
use cx::Cx;
use cycle::open::Drilling;
use fault::Done;
use moves::{arc, compensation, line, rapid, rotary, threads};
use printer::Printer;
use program::table::Subprograms;
use program::{calls, comments, finish, home, sections, start, stops, subprograms, text, tools, variables};
use said::Said;
use shape::Shape;
use want::Want;

pub use ahead::survey_terms;
pub(crate) use coolant::{Codes as CoolantCodes, codes as coolant_codes};
pub use defaults::cycle_defaults;
pub use file_name::file_name_of;
pub use options::{Clock, Cycles, Options};
pub use printer::{TraceLine, TraceWord};

/// Prints the blocks of one program. The caller pushes the events of a job and takes the text while it is printed.
pub struct Renderer<'p> {
    shape: Shape<'p>,
    want: Want,
    said: Said,
    out: Printer,
    /// The open cycle.
    drill: Drilling,
    /// The sections of the path that have begun but not ended, in the order in which they began.
    sections: Vec<Section>,
    subs: Subprograms,
    /// State of the event stream, for the check of its order.
    order: Order,
    /// Parts of an arc; reused so that an arc needs no allocation.
    parts: Vec<f64>,
}

impl<'p> Renderer<'p> {
    /// Creates a renderer for this form.
    pub fn new(program: &'p Program, options: Options) -> Self {
        let shape = Shape::new(program, options);
        let want = Want::new(&shape);
        let mut said = Said::new(program.upons.len());
        for var in [VarId::Work, VarId::Cool, VarId::Speedtype, VarId::Feedtype] {
            said.conditions.put(var, want.get(var)); // a control starts in the states that the form assumes
        }
        Renderer {
            out: Printer::new(&program.settings, shape.letters, shape.options.trace, shape.options.words),
            shape,
            want,
            said,
            drill: Drilling::default(),
            sections: Vec::new(),
            subs: Subprograms::default(),
            order: Order::default(),
            parts: Vec::new(),
        }
    }

    /// The text that was printed and not yet taken. The caller takes the text with `drain` or `clear`.
    pub fn text(&mut self) -> &mut Vec<u8> {
        &mut subprograms::main_page(&self.shape, &mut self.out, &mut self.subs).text
    }

    /// The source map of the lines that were not yet taken.
    pub fn trace(&mut self) -> Option<&mut Vec<TraceLine>> {
        subprograms::main_page(&self.shape, &mut self.out, &mut self.subs).trace.as_mut()
    }

    /// The output of each word of the form, for lines that were not yet taken.
    pub fn words(&mut self) -> Option<&mut Vec<TraceWord>> {
        subprograms::main_page(&self.shape, &mut self.out, &mut self.subs).words.as_mut()
    }

    /// The current value of a variable in the program's units; `None` if the variable has no value.
    pub fn value(&self, var: VarId) -> Option<f64> {
        self.want.get(var)
    }

    /// Warnings and notes so far; each kind appears once.
    pub fn notes(&self) -> &[Diag] {
        self.out.notes()
    }

    /// Program lines printed so far.
    pub fn lines(&self) -> u64 {
        self.out.lines()
    }

    /// The file name of the program, as defined by form and job.
    pub fn file_name(&self) -> String {
        file_name::file_name(&self.shape, &self.want)
    }

    /// Whether the end of the job has been printed.
    pub(crate) fn is_over(&self) -> bool {
        self.order == Order::End
    }

    /// Handles an event. An open cycle ends before the event, unless the event is a hole, a feed, a tilt or the start
    /// of a subprogram.
    fn take(&mut self, event: Event<'_>) -> Done {
        let goes_on = matches!(event, Event::Hole(_) | Event::Feed(_) | Event::Tilt(_) | Event::SubStart(_));
        let Renderer { shape, want, said, out, drill, sections, subs, parts, .. } = self;
        if drill.open.is_some() && !goes_on {
            cycle::close_cycle(&mut Cx { shape, want, said, out }, drill)?;
        }
        want.cutting = matches!(
            event,
            Event::Line { .. } | Event::Arc { .. } | Event::Infeed { .. } | Event::Outfeed { rapid: false, .. }
        );
        if want.cutting || matches!(event, Event::Hole(_)) {
            stopped_spindle::warn_of_standing(shape, want, out);
        }
        // these two events change the shape of the form: its units, and the turret of the tool
        let event = match event {
            Event::Start(start) => return start::start(start, shape, want, said, out, subs),
            Event::ToolChange(change) => return tools::tool_change(change, shape, want, said, out, subs, sections),
            event => event,
        };
        // a hole has its height only after its own moves
        let gives_height = said.stand.awaits_height()
            && !matches!(event, Event::Hole(_))
            && event.target().is_some_and(|to| to.given & shape.depth_bit() != 0);
        let cx = &mut Cx { shape, want, said, out };
        match event {
            Event::Rapid(to) => rapid::rapid(&to, cx),
            Event::Line { to, feed } => line::line(&to, feed, cx),
            Event::Arc { arc, feed } => arc::arc(arc, feed, cx, parts),
            Event::Infeed { infeed, feed } => compensation::infeed(infeed, feed, cx),
            Event::Outfeed { to, feed, rapid } => compensation::outfeed(&to, feed, rapid, cx),
            Event::Thread(thread) => threads::cut_thread(thread, cx),
            Event::Tilt(axis) => rotary::tilt(axis),
            Event::CycleBegin(spec) => cycle::cycle_begin(spec, cx, drill),
            Event::Hole(hole) => cycle::hole::hole(&hole, cx, drill),
            Event::CycleEnd => Ok(()),
            Event::Feed(feed) => {
                want.set_feed(feed, shape);
                Ok(())
            }
            Event::Work(work) => {
                let before = want.get(VarId::Work);
                want.set_work(work, shape)?;
                said.stand.changes_work(before, want.get(VarId::Work));
                Ok(())
            }
            Event::Spindle(spindle) => want.set_spindle(&spindle, shape),
            Event::Coolant(coolant) => want.set_coolant(coolant, shape),
            Event::Set(name, value) => variables::set_named(name, value, shape, want, out),
            Event::Start(_) | Event::ToolChange(_) => Ok(()),
            Event::Begin(section) => sections::begin_section(section, cx, sections),
            Event::End(section) => sections::end_section(section, cx, sections),
            Event::Edm(action) => sections::edm(action, cx),
            Event::Dwell(seconds) => stops::dwell(seconds, cx),
            Event::Stop(kind) => stops::stop(kind, cx),
            Event::Home => home::home(cx),
            Event::Comment(text) => comments::comment_block(text, cx),
            Event::Text(text) => text::verbatim(text, cx),
            Event::SubStart(number) => subprograms::sub_start(number, cx, subs),
            Event::SubEnd => subprograms::sub_end(cx, subs, sections),
            Event::SubCall(call) => calls::sub_call(call, cx, subs),
            Event::Finish => finish::finish(cx, subs, sections),
        }?;
        if gives_height {
            said.stand.has_height();
        }
        Ok(())
    }
}

impl Sink for Renderer<'_> {
    #[inline]
    fn event(&mut self, event: Event<'_>, place: Place) -> Flow {
        self.out.place = place;
        let done = self
            .order
            .follow(&event)
            .and_then(|()| self.take(event))
            .and_then(|()| self.out.blocks_fit())
            .and_then(|()| self.shape.ways.check());
        flow(done.map_err(|diag| Stop::from(diag).placed(|| place.into())))
    }
}
