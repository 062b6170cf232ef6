//! The events of a toolpath (render.md section 1).

use super::kind::CycleKind;

/// Coordinates h v d and rotary a b c; those not given keep the tool's last position.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Axes {
    /// Values in the job's units, and degrees.
    pub values: [f64; 6],
    /// Bit i: axis i is given.
    pub given: u8,
}

impl Axes {
    /// The first axes, all given.
    pub fn new(values: &[f64]) -> Axes {
        let mut axes = Axes::default();
        for (i, &value) in values.iter().take(6).enumerate() {
            axes.set(i, value);
        }
        axes
    }

    /// One axis, if given.
    #[inline]
    pub fn get(&self, axis: usize) -> Option<f64> {
        (self.given & 1 << axis != 0).then(|| self.values[axis])
    }

    /// Gives one axis.
    #[inline]
    pub fn set(&mut self, axis: usize, value: f64) {
        self.values[axis] = value;
        self.given |= 1 << axis;
    }
}

/// Units of lengths.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Units {
    /// Inches.
    Inch,
    /// Millimetres.
    Mm,
}

impl Units {
    /// As jobs and options write it.
    pub fn name(self) -> &'static str {
        match self {
            Units::Inch => "inch",
            Units::Mm => "mm",
        }
    }
}

/// The head of a job.
#[derive(Clone, Debug)]
pub struct Start {
    /// Program number.
    pub program: Option<f64>,
    /// The job's name.
    pub name: Option<String>,
    /// Units of the job's numbers.
    pub units: Units,
    /// What it is for.
    pub machine: crate::lang::Machine,
    /// Values for variables, by name.
    pub set: Vec<(String, f64)>,
    /// The tools in order of use, where the job tells.
    pub tool_order: Option<Vec<f64>>,
}

impl Start {
    /// The head of a mill's job that says nothing else.
    pub fn new(units: Units) -> Start {
        Start { program: None, name: None, units, machine: Default::default(), set: Vec::new(), tool_order: None }
    }
}

/// A tool.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tool {
    /// Its number, which the program calls it by.
    pub number: f64,
    /// In the job's units.
    pub diameter: Option<f64>,
    /// In the job's units.
    pub corner_radius: Option<f64>,
    /// Register of its length.
    pub length_offset: Option<f64>,
    /// Register of its diameter, for cutter compensation.
    pub diameter_offset: Option<f64>,
    /// Its place in the turret, where that is not its number.
    pub turret: Option<f64>,
    /// What the program says of it.
    pub comment: Option<String>,
}

/// Which way the spindle turns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpindleTurn {
    /// Clockwise, seen from the spindle: M3.
    Cw,
    /// Counterclockwise: M4.
    Ccw,
    /// It stands: M5.
    Off,
}

/// The spindle; what is not given stays.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Spindle {
    /// Revolutions per minute, or surface speed.
    pub speed: Option<f64>,
    /// Which way.
    pub turn: Option<SpindleTurn>,
    /// Constant surface speed.
    pub css: Option<bool>,
    /// Highest revolutions at constant surface speed.
    pub max: Option<f64>,
}

/// Coolant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coolant {
    /// Flood: M8.
    On,
    /// Mist: M7.
    Mist,
    /// None: M9.
    Off,
}

/// What a feed counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FeedMode {
    /// Length a minute: G94, on lathes G98.
    PerMinute,
    /// Length a turn of the spindle: G95, on lathes G99.
    PerRev,
    /// Moves a minute: G93.
    InverseTime,
}

/// How an operation's path begins: readers look ahead for it, because a tool change may print the position.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum First {
    /// With a rapid to here.
    Rapid(Axes),
    /// With the first hole of a cycle.
    Hole(Box<CycleSpec>, Hole),
    /// With a move that cuts: its target is no place to rapid to.
    Cut,
    /// With no move at all.
    #[default]
    Nothing,
}

/// The beginning of an operation: the tool changes where its number does.
#[derive(Clone, Debug, Default)]
pub struct ToolChange {
    /// The operation's name.
    pub name: Option<String>,
    /// Its tool; machines without tools have none.
    pub tool: Option<Tool>,
    /// Spindle, where given.
    pub spindle: Option<Spindle>,
    /// Coolant, where given.
    pub coolant: Option<Coolant>,
    /// Work offset: a fixture number below 50, else the code.
    pub work: Option<f64>,
    /// Feed of its moves until one names another.
    pub feed: Option<f64>,
    /// Feed of its plunges.
    pub plunge: Option<f64>,
    /// What its feeds count.
    pub feed_mode: Option<FeedMode>,
    /// A comment to print.
    pub comment: Option<String>,
    /// Values for variables, by name: those of the operation, and those set before its first move.
    pub set: Vec<(String, f64)>,
    /// Its first move.
    pub first: First,
}

/// Planes of arcs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Plane {
    /// First and second axis: G17.
    #[default]
    Xy,
    /// Depth and first axis: G18.
    Xz,
    /// Second and depth axis: G19.
    Yz,
}

/// Which way an arc turns, seen from the plane's positive third axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// Clockwise: G2.
    Cw,
    /// Counterclockwise: G3.
    Ccw,
}

/// An arc from the tool's position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arc {
    /// Where it ends.
    pub to: Axes,
    /// Its centre; the third coordinate does not count.
    pub center: Option<Axes>,
    /// Its radius, instead of the centre: negative for the longer way round.
    pub radius: Option<f64>,
    /// Which way.
    pub direction: Direction,
    /// In which plane.
    pub plane: Plane,
    /// Full turns before the end is reached for good.
    pub turns: u32,
}

/// Side of the path on which the tool is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Left of the path: G41.
    Left,
    /// Right of the path: G42.
    Right,
}

/// The move that turns cutter compensation on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Infeed {
    /// Where it ends.
    pub to: Axes,
    /// The side.
    pub side: Side,
    /// As a rapid.
    pub rapid: bool,
}

/// Named parts of a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Section {
    /// Onto the contour.
    Leadin,
    /// Off the contour.
    Leadout,
    /// Down into the material.
    Plunge,
    /// Up out of it.
    Retract,
    /// Across, to the next pass.
    SideStep,
    /// The moves of one Z level.
    ZLevel,
    /// A pass of a pocket or of a surface.
    Row,
}

/// Kinds of stops.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StopKind {
    /// The machine stops: M0.
    Program,
    /// It stops where the operator wants it to: M1.
    Optional,
}

/// One absolute step of a peck cycle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peck {
    /// Depth below the point, positive down.
    pub to: f64,
    /// Its own feed.
    pub feed: Option<f64>,
}

/// At which angle a cycle stops the spindle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Orient {
    /// At the form's (`CycleOrient`).
    ByForm,
    /// At this one, in degrees.
    At(f64),
}

impl Orient {
    /// The angle, where the form's is this one.
    pub fn angle(self, form: f64) -> f64 {
        if let Orient::At(angle) = self { angle } else { form }
    }
}

/// A canned cycle without its points. Heights are distances along the tool axis from each point.
#[derive(Clone, Debug, PartialEq)]
pub struct CycleSpec {
    /// Which cycle.
    pub kind: CycleKind,
    /// How deep the bottom is below the point, positive down.
    pub depth: Option<f64>,
    /// How far above the point the feed begins: the R plane.
    pub clear: Option<f64>,
    /// Return plane above the first point.
    pub return_height: Option<f64>,
    /// Feed into the hole, a length a minute or a turn as the operation says.
    pub feed: Option<f64>,
    /// Feed of its plunges; else `feed`.
    pub plunge: Option<f64>,
    /// Peck: how much deeper each goes, counted from the R plane.
    pub step: Option<f64>,
    /// The first peck.
    pub first_step: Option<f64>,
    /// How far above the last depth the feed begins again; after a chip break, how far the tool lifts.
    pub back: Option<f64>,
    /// Dwell at the bottom, in seconds.
    pub dwell: Option<f64>,
    /// Dwell at the bottom, in turns of the spindle.
    pub revs: Option<f64>,
    /// How far below the R plane the rapid goes on.
    pub rapto: Option<f64>,
    /// Angle at which a boring cycle stops the spindle.
    pub orient: Option<Orient>,
    /// How far a boring cycle moves off the wall, without `offset_y` along the first axis.
    pub offset: Option<f64>,
    /// Feed out of the hole over feed into it.
    pub ratio: Option<f64>,
    /// Starts of a tapped thread.
    pub starts: Option<f64>,
    /// Tapping in step with the spindle; else as the form says.
    pub rigid: Option<bool>,
    /// Chip breaks between full retracts.
    pub times: Option<f64>,
    /// How much each peck is less than the one before.
    pub decr: Option<f64>,
    /// The least peck.
    pub min_step: Option<f64>,
    /// Diameter of a countersink, from which comes its depth.
    pub diameter: Option<f64>,
    /// Full angle of a countersink, in degrees.
    pub angle: Option<f64>,
    /// Diameter of the hole under a countersink.
    pub hole_diameter: Option<f64>,
    /// Depths of a cycle through webs, positive down: end of the first, start and end of the next, and so on.
    pub webs: Vec<f64>,
    /// Absolute steps, instead of `step`.
    pub pecks: Vec<Peck>,
    /// Tapping in pecks: deep or chip breaking.
    pub mode: Option<CycleKind>,
    /// A tap that does not reverse the spindle.
    pub norevr: bool,
    /// A tap that leaves the hole by a rapid.
    pub rapout: bool,
    /// How far a boring cycle lifts while it is off the wall.
    pub jog: Option<f64>,
    /// With `offset` along x, the jog off the wall along y.
    pub offset_y: Option<f64>,
    /// Steps count from the point, as in APT, and not from the clearance plane, as a control's Q does.
    pub steps_from_point: bool,
    /// As single moves, whatever the form has.
    pub emulate: bool,
}

impl CycleSpec {
    /// A cycle of this kind that says nothing else.
    pub fn new(kind: CycleKind) -> CycleSpec {
        CycleSpec {
            kind,
            depth: None,
            clear: None,
            return_height: None,
            feed: None,
            plunge: None,
            step: None,
            first_step: None,
            back: None,
            dwell: None,
            revs: None,
            rapto: None,
            orient: None,
            offset: None,
            ratio: None,
            starts: None,
            rigid: None,
            times: None,
            decr: None,
            min_step: None,
            diameter: None,
            angle: None,
            hole_diameter: None,
            webs: Vec::new(),
            pecks: Vec::new(),
            mode: None,
            norevr: false,
            rapout: false,
            jog: None,
            offset_y: None,
            steps_from_point: false,
            emulate: false,
        }
    }

    /// How deep it says its holes are: by `depth`, else by the last of its webs or pecks.
    pub fn deepest(&self) -> Option<f64> {
        self.depth.or_else(|| self.webs.last().copied()).or_else(|| self.pecks.last().map(|peck| peck.to))
    }
}

/// One point of a cycle.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Hole {
    /// The control point: the top of the hole.
    pub at: Axes,
    /// Its own depth, when it differs from the cycle's.
    pub depth: Option<f64>,
}

/// A thread on a lathe. Positions are z and x as a radius.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Thread {
    /// Where it begins: z, and the radius of the crest.
    pub from: Axes,
    /// Where it ends.
    pub to: Axes,
    /// From crest to crest.
    pub pitch: f64,
    /// Height of the thread, on the radius; negative for an inner thread, which is cut outward.
    pub depth: f64,
    /// The first cut, on the radius.
    pub first_depth: Option<f64>,
    /// The least cut.
    pub min_depth: Option<f64>,
    /// Radius at the start less radius at the end.
    pub taper: Option<f64>,
    /// Angle of the tip in degrees.
    pub angle: Option<f64>,
    /// How many passes.
    pub passes: Option<f64>,
    /// Length of the runout, as the control counts it.
    pub chamfer: Option<f64>,
    /// How many starts.
    pub starts: Option<f64>,
}

/// What a wire EDM machine does between moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EdmAction {
    /// The wire is threaded.
    Thread,
    /// The wire is cut.
    Cut,
    /// A thread point is predrilled.
    PreDrill,
    /// The tank is filled.
    Submerge,
}

/// A call of a subprogram.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Call {
    /// The subprogram's number in the job.
    pub sub: f64,
    /// How often it runs.
    pub times: f64,
    /// Where it is called.
    pub at: Axes,
    /// The work offset it is called with.
    pub work: Option<f64>,
}

/// One event.
#[derive(Clone, Debug)]
pub enum Event<'a> {
    /// The head of the job: the first event.
    Start(&'a Start),
    /// An operation begins; the tool changes where its number does.
    ToolChange(&'a ToolChange),
    /// A rapid move there.
    Rapid(Axes),
    /// A straight move at feed.
    Line {
        /// Where it ends.
        to: Axes,
        /// The feed from here on; `None`: as before.
        feed: Option<f64>,
    },
    /// An arc or helix at feed.
    Arc {
        /// Its end and centre.
        arc: &'a Arc,
        /// The feed from here on; `None`: as before.
        feed: Option<f64>,
    },
    /// A straight move that turns cutter compensation on.
    Infeed {
        /// Its end, and the side.
        infeed: &'a Infeed,
        /// The feed from here on; `None`: as before.
        feed: Option<f64>,
    },
    /// A straight move that turns cutter compensation off.
    Outfeed {
        /// Where it ends.
        to: Axes,
        /// The feed from here on; `None`: as before.
        feed: Option<f64>,
        /// As a rapid.
        rapid: bool,
    },
    /// The tool axis from here on, a unit vector; a job begins with 0, 0, 1.
    Tilt([f64; 3]),
    /// A named part of the path begins.
    Begin(Section),
    /// A named part of the path ends.
    End(Section),
    /// A canned cycle begins: holes follow.
    CycleBegin(&'a CycleSpec),
    /// A hole of the cycle.
    Hole(Hole),
    /// The cycle ends.
    CycleEnd,
    /// A dwell, in seconds.
    Dwell(f64),
    /// A stop of the program.
    Stop(StopKind),
    /// A comment to print.
    Comment(&'a str),
    /// Text to print as it stands.
    Text(&'a str),
    /// The feed from here on, in the operation's mode.
    Feed(f64),
    /// The work offset from here on: a fixture number below 50, else the code.
    Work(f64),
    /// The spindle from here on.
    Spindle(Spindle),
    /// The coolant from here on.
    Coolant(Coolant),
    /// A variable of the form from here on, by its name.
    Set(&'a str, f64),
    /// A subprogram of this number begins.
    SubStart(f64),
    /// The subprogram ends.
    SubEnd,
    /// A subprogram is called.
    SubCall(&'a Call),
    /// A thread is cut, on a lathe.
    Thread(&'a Thread),
    /// A wire EDM machine does something.
    Edm(EdmAction),
    /// The job is over: the last event.
    Finish,
}
