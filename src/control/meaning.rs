//! The meanings of codes: the vocabulary of control files, and the effect of each meaning on modes and axis words.

/// The role of the axis words in the block of a code.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AxisWords {
    /// The target of the tool.
    Target,
    /// An intermediate position, or a machine position.
    Waypoint,
    /// Data of the code itself.
    Data,
    /// The code does not use the axis words in its block: these words belong to the motion in force.
    Free,
}

/// The effect of a code on the frame of axis words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Frame {
    /// Axis words in the code's block are positions in another frame, to which the axes move: reference points, machine
    /// coordinates. If the block has no axis words, all axes move.
    Block,
    /// Axis words after the code are increments, until a code for absolute positions.
    Increments,
    /// Axis words after the code, up to the end of the sequence, may be in another frame.
    Shifts,
    /// After the code, positions of the axes are in another frame.
    Moves,
    /// After the code, positions of the depth axis are in another frame.
    MovesDepth,
}

/// Groups of codes. A block may contain only one code of a modal group, and only one code of the group is in force.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(u8)]
pub enum Group {
    /// G0 to G3, threads, and canned cycles if they have no group of their own.
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
    /// Canned cycles and G80, on controls that read blocks as Fanuc does. A block with a canned cycle may also contain
    /// a motion code.
    Cycle,
    /// Codes that take effect in their block only. These codes are not a modal group.
    Once,
    /// Codes whose effects postform never compares. These codes are not a modal group.
    Other,
}

/// Number of groups.
pub const GROUPS: usize = Group::Other as usize + 1;

macro_rules! meanings {
    ($($name:ident $text:literal $group:expr, $axes:ident, $about:literal;)*) => {
        /// The meaning of a code. Control files select the meaning with the key `is`.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum Meaning { $(#[doc = $about] $name),* }

        impl Meaning {
            /// All meanings, in the order of the reference page.
            pub const ALL: &[Meaning] = &[$(Meaning::$name),*];

            /// The name in control files.
            pub const fn name(self) -> &'static str {
                match self { $(Meaning::$name => $text),* }
            }

            /// A description of the meaning.
            pub const fn about(self) -> &'static str {
                match self { $(Meaning::$name => $about),* }
            }

            /// The modal group of a code with this meaning; `None`: the code takes effect once, or has no modal effect.
            pub const fn group(self) -> Option<Group> {
                match self { $(Meaning::$name => $group),* }
            }

            /// The role of the axis words in a block with a code of this meaning.
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
    Thread           "thread"            Some(G::Motion), Target, "cuts in a straight line synchronized with the spindle";
    RigidTap         "rigid-tap"         Some(G::Motion), Target, "taps rigidly: feeds in with the spindle, reverses the spindle, feeds out";
    ThreadCycle      "thread-cycle"      Some(G::Motion), Target, "cuts a thread in passes";
    ThreadPass       "thread-pass"       Some(G::Motion), Target,"cuts one pass of a thread and returns";
    TurnPass         "turn-pass"         Some(G::Motion), Target, "cuts along Z, retracts across and returns to its start";
    FacePass         "face-pass"         Some(G::Motion), Target, "cuts along X, retracts along Z and returns to its start";
    Probe            "probe"             Some(G::Motion), Target, "moves until a probe touches";
    Cycle            "cycle"             Some(G::Motion), Target, "makes a hole at each position";
    CycleEnd         "cycle-end"         Some(G::Motion), Free,   "ends a cycle";
    Dwell            "dwell"             None,            Free,   "waits";
    PlaneXy          "plane-xy"          Some(G::Plane), Free,    "arcs are in the XY plane";
    PlaneXz          "plane-xz"          Some(G::Plane), Free,    "arcs are in the ZX plane";
    PlaneYz          "plane-yz"          Some(G::Plane), Free,    "arcs are in the YZ plane";
    Inch             "inch"              Some(G::Units), Free,    "lengths are inches";
    Mm               "mm"                Some(G::Units), Free,    "lengths are millimetres";
    Absolute         "absolute"          Some(G::Distance), Free, "axis words are positions";
    Increments       "increments"        Some(G::Distance), Free, "axis words are increments";
    CentresAbsolute  "centres-absolute"  Some(G::ArcDistance), Free, "I, J and K are positions";
    CentresIncremental "centres-incremental" Some(G::ArcDistance), Free, "I, J and K are distances from the start of the arc";
    InverseTime      "inverse-time"      Some(G::FeedMode), Free, "feeds are inverse time: 1 divided by the minutes of the block";
    PerMinute        "per-minute"        Some(G::FeedMode), Free, "feeds are per minute";
    PerRev           "per-rev"           Some(G::FeedMode), Free, "feeds are per revolution";
    SurfaceSpeed     "surface-speed"     Some(G::SpeedMode), Free, "S is a surface speed";
    Revolutions      "revolutions"       Some(G::SpeedMode), Free, "S is revolutions per minute";
    SpeedLimit       "speed-limit"       None,            Data,   "S is the speed limit of the spindle";
    Work             "work"              Some(G::Work), Free,     "selects a work offset";
    ToInitial        "to-initial"        Some(G::Return), Free,   "cycles return to the initial level";
    ToR              "to-r"              Some(G::Return), Free,   "cycles return to the R plane";
    ToLevel          "to-level"          Some(G::Return), Free,   "cycles return to the level that another code sets";
    ToTop            "to-top"            Some(G::Return), Free,   "cycles return to the upper end of the axis";
    ReturnLevel      "return-level"      None,            Data,   "sets the level to which cycles return";
    LengthOn         "length-on"         Some(G::Length), Free,   "tool length offset on";
    LengthMinus      "length-minus"      Some(G::Length), Free,   "tool length offset on, subtracted";
    LengthAdd        "length-add"        Some(G::Length), Free,   "adds another length to the tool length offset";
    LengthData       "length-data"       Some(G::Length), Data,   "its axis words are the tool length offset";
    LengthOff        "length-off"        Some(G::Length), Free,   "tool length offset off";
    SideLeft         "side-left"         Some(G::Compensation), Free, "the tool is left of its path";
    SideRight        "side-right"        Some(G::Compensation), Free, "the tool is right of its path";
    SideOff          "side-off"          Some(G::Compensation), Free, "the tool's centre is on its path";
    Path             "path"              Some(G::Path), Free,     "sets how exactly corners are followed";
    TapMode          "tap-mode"          Some(G::Path), Free,     "moves keep their programmed feed, as for tapping";
    ExactStop        "exact-stop"        None, Free,              "the axes stop at the end of the block";
    Diameter         "diameter"          Some(G::Diameter), Free, "X words are diameters";
    Radius           "radius"            Some(G::Diameter), Free, "X words are radii";
    Machine          "machine"           None, Waypoint,          "axis words of its block are machine coordinates";
    Reference        "reference"         None, Waypoint,          "moves through the position of its axis words to a reference point";
    SetReference     "set-reference"     None, Free,              "the position becomes a reference point";
    Frame            "frame"             None, Data,              "shifts the origin of the positions from here on";
    Preset           "preset"            None, Data,              "its axis words become the position of the tool";
    Transform        "transform"         None, Data,              "turns, scales, mirrors or tilts the frame, or makes positions polar";
    TransformOff     "transform-off"     None, Free,              "ends a rotation, a scale or a mirror image";
    FrameOff         "frame-off"         None, Free,              "ends a frame";
    FrameSuspend     "frame-suspend"     None, Free,              "suspends a frame, which can be restored";
    FrameRestore     "frame-restore"     None, Free,              "restores a frame";
    Data             "data"              None, Data,              "its words are data, for example of an offset table";
    SetOffsets       "set-offsets"       None, Data,              "sets work offsets or tool data, selected by L and P";
    StopProgram      "stop"              Some(G::Stop), Free,     "stops the program until the operator starts it again";
    StopOptional     "optional-stop"     Some(G::Stop), Free,     "stops the program if optional stop is on";
    End              "end"               Some(G::Stop), Free,     "ends the program";
    Pallet           "pallet"            Some(G::Stop), Free,     "changes the pallet and stops";
    SpindleCw        "spindle-cw"        Some(G::Spindle), Free,  "turns the spindle clockwise";
    SpindleCcw       "spindle-ccw"       Some(G::Spindle), Free,  "turns the spindle counter-clockwise";
    SpindleOff       "spindle-off"       Some(G::Spindle), Free,  "stops the spindle";
    SpindleCwCoolant "spindle-cw-coolant" None, Free,             "turns the spindle clockwise, with coolant";
    SpindleCcwCoolant "spindle-ccw-coolant" None, Free,           "turns the spindle counter-clockwise, with coolant";
    Orient           "orient"            None, Free,              "orients the spindle";
    Flood            "flood"             Some(G::Coolant), Free,  "flood coolant on";
    Mist             "mist"              Some(G::Coolant), Free,  "mist coolant on";
    Through          "through"           Some(G::Coolant), Free,  "coolant through the spindle on";
    CoolantOff       "coolant-off"       Some(G::Coolant), Free,  "coolant off";
    ToolChange       "tool-change"       None, Free,              "changes the tool";
    ToolNumber       "tool-number"       None, Free,              "declares another tool to be in the spindle";
    Macro            "macro"             None, Data,              "calls a macro";
    MacroOn          "macro-on"          None, Data,              "calls a macro at each position";
    MacroOff         "macro-off"         None, Free,              "ends calls of a macro";
    Call             "call"              None, Free,              "calls a subprogram";
    Return           "return"            None, Free,              "returns from a subprogram";
    Output           "output"            None, Free,              "sets an output of the machine";
    Override         "override"          None, Free,              "overrides of feed and speed on or off";
    Harmless         "harmless"          None, Free,              "changes nothing that a proof compares";
    RoughTurn        "rough-turn"        None, Data,              "roughs a profile by cuts along Z";
    RoughFace        "rough-face"        None, Data,              "roughs a profile by cuts along X";
    RoughPattern     "rough-pattern"     None, Data,              "roughs by passes parallel to a profile";
    Finish           "finish"            None, Data,              "finishes a profile in one pass";
    FacePecks        "face-pecks"        None, Data,              "cuts along Z in pecks, at several positions along X";
    GroovePecks      "groove-pecks"      None, Data,              "cuts along X in pecks, at several positions along Z";
    RigidAhead       "rigid-ahead"       None, Free,              "taps after it are rigid";
    Unsaid           "unsaid"            None, Free,              "has an effect that none of the other meanings describe";
}

impl Meaning {
    /// The effect on the frame of axis words of a code with this meaning; `None`: no effect.
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

    /// Whether the code starts a canned cycle.
    pub const fn is_cycle(self) -> bool {
        matches!(self, Meaning::Cycle | Meaning::ThreadCycle | Meaning::ThreadPass)
    }

    /// Whether the code turns on the tool length offset of a register.
    pub const fn turns_length_on(self) -> bool {
        matches!(self, Meaning::LengthOn | Meaning::LengthMinus | Meaning::LengthAdd)
    }

    /// Whether the code calls a macro or a subprogram.
    pub const fn is_call(self) -> bool {
        matches!(self, Meaning::Macro | Meaning::MacroOn | Meaning::Call)
    }

    /// Whether the control makes its own moves after the code: a cycle, or a thread whose feed follows from the pitch.
    pub const fn moves_by_itself(self) -> bool {
        self.is_cycle() || matches!(self, Meaning::Thread | Meaning::RigidTap | Meaning::TapMode)
    }

    /// Whether the code ends the moves that `moves_by_itself` describes.
    pub const fn ends_cycle(self) -> bool {
        use Meaning as M;
        matches!(self, M::Rapid | M::Line | M::ArcCw | M::ArcCcw | M::CycleEnd | M::MacroOff)
    }

    /// Whether the code starts the spindle.
    pub const fn starts_spindle(self) -> bool {
        use Meaning as M;
        matches!(self, M::SpindleCw | M::SpindleCcw | M::SpindleCwCoolant | M::SpindleCcwCoolant)
    }

    /// Whether the code changes the tool in the spindle.
    pub const fn changes_tool(self) -> bool {
        matches!(self, Meaning::ToolChange | Meaning::ToolNumber)
    }

    /// Whether the code switches coolant.
    pub fn cools(self) -> bool {
        self.group() == Some(Group::Coolant) || matches!(self, Meaning::SpindleCwCoolant | Meaning::SpindleCcwCoolant)
    }

    /// Whether the code starts or stops the spindle.
    pub fn turns_spindle(self) -> bool {
        self.group() == Some(Group::Spindle) || matches!(self, Meaning::SpindleCwCoolant | Meaning::SpindleCcwCoolant)
    }

    /// Whether the code stops the program, always or on a condition.
    pub const fn is_stop(self) -> bool {
        matches!(self, Meaning::StopProgram | Meaning::StopOptional | Meaning::Pallet)
    }

    /// The meaning with this name in control files.
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
