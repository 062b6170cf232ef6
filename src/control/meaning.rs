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

/// What a code does to the frame in which axis words stand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Frame {
    /// Axis words of its block stand in another frame, and the axes go where they say: reference points, machine
    /// coordinates. Without axis words all axes go.
    Block,
    /// Axis words after it are increments, until positions are said.
    Increments,
    /// Axis words after it in the same body may stand in another frame.
    Shifts,
    /// From here on axis positions mean another place.
    Moves,
    /// The depth position means another place.
    MovesDepth,
}

/// Groups: codes of one group exclude each other in a block, and modal ones in a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(u8)]
pub enum Group {
    /// G0 to G3, threads, and canned cycles where they are no group of their own.
    Motion,
    /// G17 G18 G19.
    Plane,
    /// G90 G91.
    Distance,
    /// G90.1 G91.1.
    ArcDistance,
    /// G93 G94 G95.
    FeedMode,
    /// G20 G21.
    Units,
    /// G40 G41 G42.
    Compensation,
    /// G43 G44 G49.
    Length,
    /// G98 G99.
    Return,
    /// G54 to G59.
    Work,
    /// G61 G64.
    Path,
    /// G96 G97.
    SpeedMode,
    /// G7 G8.
    Diameter,
    /// M3 M4 M5.
    Spindle,
    /// M7 M8 M9.
    Coolant,
    /// M0 M1 M2 M30.
    Stop,
    /// Canned cycles and G80, where blocks are read as a Fanuc reads them: beside a motion.
    Cycle,
    /// Codes that act in their block alone; no modal group.
    Once,
    /// Codes that change nothing which is compared; no modal group.
    Other,
}

/// How many groups there are.
pub const GROUPS: usize = Group::Other as usize + 1;

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

            /// What a code of this meaning does, in words.
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
    ThreadPass       "thread-pass"       Some(G::Motion), Target,"cuts one pass of a thread and comes back";
    TurnPass         "turn-pass"         Some(G::Motion), Target, "cuts along Z, comes back across and goes to its start";
    FacePass         "face-pass"         Some(G::Motion), Target, "cuts along X, comes back along Z and goes to its start";
    Probe            "probe"             Some(G::Motion), Target, "moves until a probe touches";
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
    SpeedLimit       "speed-limit"       None,            Data,   "S is the highest speed of the spindle";
    Work             "work"              Some(G::Work), Free,     "positions count from another work offset";
    ToInitial        "to-initial"        Some(G::Return), Free,   "cycles return to the initial level";
    ToR              "to-r"              Some(G::Return), Free,   "cycles return to the R plane";
    ToLevel          "to-level"          Some(G::Return), Free,   "cycles return to the level that a code of its own says";
    ToTop            "to-top"            Some(G::Return), Free,   "cycles return to the upper end of the axis";
    ReturnLevel      "return-level"      None,            Data,   "says the level to which cycles return";
    LengthOn         "length-on"         Some(G::Length), Free,   "the tool's length counts";
    LengthMinus      "length-minus"      Some(G::Length), Free,   "the tool's length counts the other way";
    LengthAdd        "length-add"        Some(G::Length), Free,   "another length is added to the tool's";
    LengthData       "length-data"       Some(G::Length), Data,   "the tool's length is what its axis words say";
    LengthOff        "length-off"        Some(G::Length), Free,   "no length of a tool counts";
    SideLeft         "side-left"         Some(G::Compensation), Free, "the tool is left of its path";
    SideRight        "side-right"        Some(G::Compensation), Free, "the tool is right of its path";
    SideOff          "side-off"          Some(G::Compensation), Free, "the tool's centre is on its path";
    Path             "path"              Some(G::Path), Free,     "how exactly corners are followed";
    TapMode          "tap-mode"          Some(G::Path), Free,     "moves keep their feed, as a tap needs it";
    ExactStop        "exact-stop"        None, Free,              "the block ends with a stop of the axes";
    Diameter         "diameter"          Some(G::Diameter), Free, "X words are diameters";
    Radius           "radius"            Some(G::Diameter), Free, "X words are radii";
    Machine          "machine"           None, Waypoint,          "axis words of its block are machine coordinates";
    Reference        "reference"         None, Waypoint,          "goes to a reference point by way of its axis words";
    SetReference     "set-reference"     None, Free,              "the place becomes a reference point";
    Frame            "frame"             None, Data,              "axis positions mean another place from here on";
    Preset           "preset"            None, Data,              "its axis words name the place where the tool is";
    Transform        "transform"         None, Data,              "turns, scales, mirrors or tilts the frame, or reads it as polar";
    TransformOff     "transform-off"     None, Free,              "takes a turn, a scale or a mirror image away";
    FrameOff         "frame-off"         None, Free,              "takes a frame away";
    FrameSuspend     "frame-suspend"     None, Free,              "takes a frame away, to be put back";
    FrameRestore     "frame-restore"     None, Free,              "puts a frame back";
    Data             "data"              None, Data,              "its words are data, as of an offset table";
    SetOffsets       "set-offsets"       None, Data,              "sets work offsets, or data of tools, by L and P";
    StopProgram      "stop"              Some(G::Stop), Free,     "stops the program until it is started again";
    StopOptional     "optional-stop"     Some(G::Stop), Free,     "stops the program where the operator wants it";
    End              "end"               Some(G::Stop), Free,     "ends the program";
    Pallet           "pallet"            Some(G::Stop), Free,     "changes the pallet and stops";
    SpindleCw        "spindle-cw"        Some(G::Spindle), Free,  "turns the spindle clockwise";
    SpindleCcw       "spindle-ccw"       Some(G::Spindle), Free,  "turns the spindle counter-clockwise";
    SpindleOff       "spindle-off"       Some(G::Spindle), Free,  "stops the spindle";
    SpindleCwCoolant "spindle-cw-coolant" None, Free,             "turns the spindle clockwise, with coolant";
    SpindleCcwCoolant "spindle-ccw-coolant" None, Free,           "turns the spindle counter-clockwise, with coolant";
    Orient           "orient"            None, Free,              "stops the spindle at an angle";
    Flood            "flood"             Some(G::Coolant), Free,  "flood coolant on";
    Mist             "mist"              Some(G::Coolant), Free,  "mist coolant on";
    Through          "through"           Some(G::Coolant), Free,  "coolant through the spindle on";
    CoolantOff       "coolant-off"       Some(G::Coolant), Free,  "coolant off";
    ToolChange       "tool-change"       None, Free,              "changes the tool";
    ToolNumber       "tool-number"       None, Free,              "another tool is in the spindle";
    Macro            "macro"             None, Data,              "calls a macro";
    MacroOn          "macro-on"          None, Data,              "calls a macro at each position";
    MacroOff         "macro-off"         None, Free,              "ends calls of a macro";
    Call             "call"              None, Free,              "calls a subprogram";
    Return           "return"            None, Free,              "returns from a subprogram";
    Output           "output"            None, Free,              "sets an output of the machine";
    Override         "override"          None, Free,              "overrides of feed and speed on or off";
    Harmless         "harmless"          None, Free,              "changes nothing that is compared";
    RoughTurn        "rough-turn"        None, Data,              "removes what is outside of a profile, by cuts along Z";
    RoughFace        "rough-face"        None, Data,              "removes what is outside of a profile, by cuts along X";
    RoughPattern     "rough-pattern"     None, Data,              "follows a profile several times, nearer each time";
    Finish           "finish"            None, Data,              "follows a profile once";
    FacePecks        "face-pecks"        None, Data,              "cuts along Z by pecks, at several positions along X";
    GroovePecks      "groove-pecks"      None, Data,              "cuts along X by pecks, at several positions along Z";
    RigidAhead       "rigid-ahead"       None, Free,              "the taps after it follow the spindle";
    Unsaid           "unsaid"            None, Free,              "is known, and does what no meaning says";
}

impl Meaning {
    /// What a code of this meaning does to the frame of axis words; `None`: nothing.
    pub const fn frame(self) -> Option<Frame> {
        use Meaning as M;
        match self {
            M::Reference | M::Machine => Some(Frame::Block),
            M::Increments => Some(Frame::Increments),
            M::Preset => Some(Frame::Shifts),
            M::Work
            | M::Frame
            | M::FrameOff
            | M::FrameSuspend
            | M::FrameRestore
            | M::Data
            | M::Transform
            | M::TransformOff => Some(Frame::Moves),
            M::LengthOn | M::LengthMinus | M::LengthAdd | M::LengthData | M::LengthOff => Some(Frame::MovesDepth),
            _ => None,
        }
    }

    /// Does it start a canned cycle?
    pub const fn is_cycle(self) -> bool {
        matches!(self, Meaning::Cycle | Meaning::ThreadCycle | Meaning::ThreadPass)
    }

    /// Does a tool's length count from here on, by its register?
    pub const fn turns_length_on(self) -> bool {
        matches!(self, Meaning::LengthOn | Meaning::LengthMinus | Meaning::LengthAdd)
    }

    /// Does it call what is written elsewhere: a macro, a subprogram?
    pub const fn is_call(self) -> bool {
        matches!(self, Meaning::Macro | Meaning::MacroOn | Meaning::Call)
    }

    /// Does the control move by itself after it: a cycle, a thread, which it feeds by its pitch?
    pub const fn moves_by_itself(self) -> bool {
        self.is_cycle() || matches!(self, Meaning::Thread | Meaning::RigidTap | Meaning::TapMode)
    }

    /// Does it end what the control does by itself?
    pub const fn ends_cycle(self) -> bool {
        use Meaning as M;
        matches!(self, M::Rapid | M::Line | M::ArcCw | M::ArcCcw | M::CycleEnd | M::MacroOff)
    }

    /// Does it start the spindle?
    pub const fn starts_spindle(self) -> bool {
        use Meaning as M;
        matches!(self, M::SpindleCw | M::SpindleCcw | M::SpindleCwCoolant | M::SpindleCcwCoolant)
    }

    /// Is another tool in the spindle after it?
    pub const fn changes_tool(self) -> bool {
        matches!(self, Meaning::ToolChange | Meaning::ToolNumber)
    }

    /// Does its code switch coolant?
    pub fn cools(self) -> bool {
        self.group() == Some(Group::Coolant) || matches!(self, Meaning::SpindleCwCoolant | Meaning::SpindleCcwCoolant)
    }

    /// Does its code start the spindle or stop it?
    pub fn turns_spindle(self) -> bool {
        self.group() == Some(Group::Spindle) || matches!(self, Meaning::SpindleCwCoolant | Meaning::SpindleCcwCoolant)
    }

    /// Does it stop the program, or may it?
    pub const fn is_stop(self) -> bool {
        matches!(self, Meaning::StopProgram | Meaning::StopOptional | Meaning::Pallet)
    }

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
