//! What codes mean: the vocabulary of control files, and what each meaning does to modes and to axis words.

/// What the axis words beside a code are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AxisWords {
    /// The place that the tool goes to.
    Target,
    /// A place on the way to another one, or a place of the machine.
    Waypoint,
    /// Numbers of the code itself.
    Data,
    /// Nothing of the code: they belong to the motion in force.
    Free,
}

/// Modal groups: codes of one group exclude each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[allow(missing_docs)]
#[repr(u8)]
pub enum Group {
    Motion,
    Plane,
    Distance,
    ArcDistance,
    FeedMode,
    Units,
    Compensation,
    Length,
    Return,
    Work,
    Path,
    SpeedMode,
    Diameter,
    Spindle,
    Coolant,
    Stop,
}

/// How many groups there are.
pub const GROUPS: usize = Group::Stop as usize + 1;

macro_rules! meanings {
    ($($name:ident $text:literal $group:expr, $axes:ident, $about:literal;)*) => {
        /// What a code means. A control file names it by `is`.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum Meaning { $(#[doc = $about] $name),* }

        impl Meaning {
            /// All of them, in the order of the reference page.
            pub const ALL: &[Meaning] = &[$(Meaning::$name),*];

            /// As control files write it.
            pub const fn name(self) -> &'static str {
                match self { $(Meaning::$name => $text),* }
            }

            /// What it is, in words.
            pub const fn about(self) -> &'static str {
                match self { $(Meaning::$name => $about),* }
            }

            /// The modal group of its codes; `None`: they act once, or switch nothing.
            pub const fn group(self) -> Option<Group> {
                match self { $(Meaning::$name => $group),* }
            }

            /// What the axis words of its block are.
            pub const fn axes(self) -> AxisWords {
                match self { $(Meaning::$name => AxisWords::$axes),* }
            }
        }
    };
}

use Group as G;

#[rustfmt::skip]
meanings! {
    Rapid            "rapid"             Some(G::Motion), Target, "moves at rapid";
    Line             "line"              Some(G::Motion), Target, "cuts in a straight line";
    ArcCw            "arc-cw"            Some(G::Motion), Target, "cuts an arc clockwise";
    ArcCcw           "arc-ccw"           Some(G::Motion), Target, "cuts an arc counter-clockwise";
    Thread           "thread"            Some(G::Motion), Target, "cuts in a line that follows the spindle";
    RigidTap         "rigid-tap"         Some(G::Motion), Target, "follows the spindle in, turns it back, and follows it out";
    ThreadCycle      "thread-cycle"      Some(G::Motion), Target, "cuts a thread in passes";
    Cycle            "cycle"             Some(G::Motion), Target, "makes a hole at each position";
    CycleEnd         "cycle-end"         Some(G::Motion), Free,   "ends a cycle";
    Dwell            "dwell"             None,            Free,   "waits";
    PlaneXy          "plane-xy"          Some(G::Plane), Free,    "arcs lie in X and Y";
    PlaneXz          "plane-xz"          Some(G::Plane), Free,    "arcs lie in Z and X";
    PlaneYz          "plane-yz"          Some(G::Plane), Free,    "arcs lie in Y and Z";
    Inch             "inch"              Some(G::Units), Free,    "lengths are inches";
    Mm               "mm"                Some(G::Units), Free,    "lengths are millimetres";
    Absolute         "absolute"          Some(G::Distance), Free, "axis words are positions";
    Increments       "increments"        Some(G::Distance), Free, "axis words are increments";
    CentresAbsolute  "centres-absolute"  Some(G::ArcDistance), Free, "I, J and K are positions";
    CentresIncremental "centres-incremental" Some(G::ArcDistance), Free, "I, J and K count from the start of the arc";
    InverseTime      "inverse-time"      Some(G::FeedMode), Free, "a feed is one over the minutes of its block";
    PerMinute        "per-minute"        Some(G::FeedMode), Free, "feeds are per minute";
    PerRev           "per-rev"           Some(G::FeedMode), Free, "feeds are per revolution";
    SurfaceSpeed     "surface-speed"     Some(G::SpeedMode), Free, "S is a surface speed";
    Revolutions      "revolutions"       Some(G::SpeedMode), Free, "S is revolutions per minute";
    Work             "work"              Some(G::Work), Free,     "positions count from another work offset";
    ToInitial        "to-initial"        Some(G::Return), Free,   "cycles return to the initial level";
    ToR              "to-r"              Some(G::Return), Free,   "cycles return to the R plane";
    LengthOn         "length-on"         Some(G::Length), Free,   "the tool's length counts";
    LengthData       "length-data"       Some(G::Length), Data,   "the tool's length is what its axis words say";
    LengthOff        "length-off"        Some(G::Length), Free,   "no length of a tool counts";
    SideLeft         "side-left"         Some(G::Compensation), Free, "the tool is left of its path";
    SideRight        "side-right"        Some(G::Compensation), Free, "the tool is right of its path";
    SideOff          "side-off"          Some(G::Compensation), Free, "the tool's centre is on its path";
    Path             "path"              Some(G::Path), Free,     "how exactly corners are followed";
    ExactStop        "exact-stop"        None, Free,              "the block ends with a stop of the axes";
    Diameter         "diameter"          Some(G::Diameter), Free, "X words are diameters";
    Radius           "radius"            Some(G::Diameter), Free, "X words are radii";
    Machine          "machine"           None, Waypoint,          "axis words of its block are machine coordinates";
    Reference        "reference"         None, Waypoint,          "goes to a reference point by way of its axis words";
    SetReference     "set-reference"     None, Free,              "the place becomes a reference point";
    Frame            "frame"             None, Data,              "axis positions mean another place from here on";
    FrameOff         "frame-off"         None, Free,              "takes a frame away";
    Data             "data"              None, Data,              "its words are data, as of an offset table";
    StopProgram      "stop"              Some(G::Stop), Free,     "stops the program until it is started again";
    StopOptional     "optional-stop"     Some(G::Stop), Free,     "stops the program where the operator wants it";
    End              "end"               Some(G::Stop), Free,     "ends the program";
    Pallet           "pallet"            Some(G::Stop), Free,     "changes the pallet and stops";
    SpindleCw        "spindle-cw"        Some(G::Spindle), Free,  "turns the spindle clockwise";
    SpindleCcw       "spindle-ccw"       Some(G::Spindle), Free,  "turns the spindle counter-clockwise";
    SpindleOff       "spindle-off"       Some(G::Spindle), Free,  "stops the spindle";
    Orient           "orient"            Some(G::Spindle), Free,  "stops the spindle at an angle";
    Flood            "flood"             Some(G::Coolant), Free,  "flood coolant on";
    Mist             "mist"              Some(G::Coolant), Free,  "mist coolant on";
    CoolantOff       "coolant-off"       Some(G::Coolant), Free,  "coolant off";
    ToolChange       "tool-change"       None, Free,              "changes the tool";
    ToolNumber       "tool-number"       None, Free,              "says which tool is in";
    Call             "call"              None, Free,              "calls a subprogram";
    Return           "return"            None, Free,              "returns from a subprogram";
    Override         "override"          None, Free,              "overrides of feed and speed on or off";
    Harmless         "harmless"          None, Free,              "changes nothing that is compared";
    NotRun           "not-run"           None, Data,              "is known, and can't be simulated";
}

impl Meaning {
    /// The meaning that control files name so.
    pub fn parse(name: &str) -> Option<Meaning> {
        Meaning::ALL.iter().copied().find(|meaning| meaning.name() == name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_unique() {
        for (i, meaning) in Meaning::ALL.iter().enumerate() {
            assert_eq!(Meaning::parse(meaning.name()), Some(*meaning));
            assert!(Meaning::ALL[..i].iter().all(|other| other.name() != meaning.name()), "{}", meaning.name());
        }
        assert_eq!(Meaning::parse("rapids"), None);
    }
}
