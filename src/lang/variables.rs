//! The table of variables.

use super::machine::Machines;

/// The unit of a variable's value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// Inches or millimetres, in the program's units.
    Length,
    /// Degrees.
    Angle,
    /// Length per minute, or length per revolution.
    Feed,
    /// Revolutions per minute, or a surface speed.
    Speed,
    /// Seconds. The value of a dwell has the unit that the Dwell command sets.
    Time,
    /// The number of a G or M code that a command of the form defines.
    Code,
    /// A whole number.
    Count,
    /// Any number.
    Number,
}

/// Where the value of a variable comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// The renderer calculates the value from the toolpath. A job can't set the value.
    Computed,
    /// The job sets the value with `set`, or the value is the answer to a prompt.
    Job,
    /// The renderer takes the value from the job. If the job has no value, the value comes from a prompt or from
    /// `--set`.
    Asked,
}

/// One row of the table of variables.
#[derive(Debug)]
pub struct Variable {
    /// Identifier of the variable.
    pub id: VarId,
    /// Name of the variable as it is written between brackets, in lower case.
    pub name: &'static str,
    /// The group of the variable in the reference.
    pub group: &'static str,
    /// The unit of the variable's value.
    pub unit: Unit,
    /// The source of the variable's value.
    pub origin: Origin,
    /// The machines that have the variable.
    pub machines: Machines,
    /// A description in one line.
    pub meaning: &'static str,
}

macro_rules! variables {
    ($($id:ident $name:literal $group:literal $unit:ident $origin:ident $machines:literal $meaning:literal)*) => {
        /// A variable. The number of a variable is the index of its value during rendering.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[repr(u8)]
        pub enum VarId { $(#[doc = $meaning] $id),* }

        /// All variables.
        pub const VARIABLES: &[Variable] = &[$(Variable {
            id: VarId::$id,
            name: $name,
            group: $group,
            unit: Unit::$unit,
            origin: Origin::$origin,
            machines: Machines::of($machines),
            meaning: $meaning,
        }),*];
    };
}

#[rustfmt::skip]
variables! {
    H             "h"              "Position"           Length  Computed  "MLE"  "position along the first axis: X on mills and EDM, Z on lathes"
    V             "v"              "Position"           Length  Computed  "MLE"  "position along the second axis: Y on mills and EDM, X on lathes"
    D             "d"              "Position"           Length  Computed  "MLE"  "position along the depth axis; in a canned cycle, the bottom of the hole"
    H2            "h2"             "Position"           Length  Computed  "E"    "position of the upper wire guide along the first axis"
    V2            "v2"             "Position"           Length  Computed  "E"    "position of the upper wire guide along the second axis"
    Hdist         "hdist"          "Position"           Length  Computed  "MLE"  "distance of this move along the first axis"
    Vdist         "vdist"          "Position"           Length  Computed  "MLE"  "distance of this move along the second axis"
    Ddist         "ddist"          "Position"           Length  Computed  "MLE"  "distance of this move along the depth axis"
    Lasth         "lasth"          "Position"           Length  Computed  "MLE"  "position along the first axis before this move; in Unwind, the position where Unwind interrupts the path"
    Lastv         "lastv"          "Position"           Length  Computed  "MLE"  "position along the second axis before this move; in Unwind, the position where Unwind interrupts the path"
    Lastd         "lastd"          "Position"           Length  Computed  "MLE"  "position along the depth axis before this move; in Unwind, the position where Unwind interrupts the path"
    Rotangle      "rotangle"       "Position"           Angle   Computed  "M"    "angle of the rotary axis; after an axis letter, the angle of this axis"
    Lastrotangle  "lastrotangle"   "Position"           Angle   Computed  "M"    "rotary angle before this move; in Unwind, the angle without its whole turns"
    Rotaxdir      "rotaxdir"       "Position"           Number  Computed  "M"    "direction of the rotary move: 1 or -1"
    Homeh         "homeh"          "Position"           Length  Job       "MLE"  "home position along the first axis"
    Homev         "homev"          "Position"           Length  Job       "MLE"  "home position along the second axis"
    Endh          "endh"           "Position"           Length  Job       "MLE"  "end position along the first axis: the position of the tool after the program"
    Endv          "endv"           "Position"           Length  Job       "MLE"  "end position along the second axis"
    Hcdc          "hcdc"           "Position"           Length  Job       "MLE"  "cutter compensation along the first axis"
    Vcdc          "vcdc"           "Position"           Length  Job       "MLE"  "cutter compensation along the second axis"
    Hvector       "hvector"        "Position"           Number  Computed  "M"    "first component of the tool axis"
    Vvector       "vvector"        "Position"           Number  Computed  "M"    "second component of the tool axis"
    Ivect         "ivect"          "Position"           Number  Computed  "M"    "first component of the tool axis"
    Jvect         "jvect"          "Position"           Number  Computed  "M"    "second component of the tool axis"
    Kvect         "kvect"          "Position"           Number  Computed  "M"    "third component of the tool axis"
    Ival          "ival"           "Arcs"               Length  Computed  "MLE"  "arc centre along the first axis, from the start or absolute (CtrIncremental?)"
    Jval          "jval"           "Arcs"               Length  Computed  "MLE"  "arc centre along the second axis, from the start or absolute"
    Kval          "kval"           "Arcs"               Length  Computed  "MLE"  "arc centre along the depth axis, from the start or absolute"
    Arcrad        "arcrad"         "Arcs"               Length  Computed  "MLE"  "arc radius"
    Hctr          "hctr"           "Arcs"               Length  Computed  "MLE"  "arc centre along the first axis, absolute"
    Vctr          "vctr"           "Arcs"               Length  Computed  "MLE"  "arc centre along the second axis, absolute"
    Startang      "startang"       "Arcs"               Angle   Computed  "MLE"  "angle of the arc's start seen from its centre; in a thread the infeed angle"
    Endang        "endang"         "Arcs"               Angle   Computed  "MLE"  "angle of the arc's end seen from its centre"
    Sweep         "sweep"          "Arcs"               Angle   Computed  "MLE"  "angle that the arc covers, positive for counter-clockwise arcs"
    Frate         "frate"          "Feeds and speeds"   Feed    Computed  "MLE"  "feed of the move or of the cycle"
    Plunge        "plunge"         "Feeds and speeds"   Feed    Computed  "MLE"  "feed of plunges"
    Speed         "speed"          "Feeds and speeds"   Speed   Computed  "ML"   "spindle speed"
    Feedtype      "feedtype"       "Feeds and speeds"   Code    Computed  "MLE"  "code of the feed mode (FeedType)"
    Speedtype     "speedtype"      "Feeds and speeds"   Code    Computed  "ML"   "code of the spindle mode (SpeedType)"
    Invtime       "invtime"        "Feeds and speeds"   Number  Computed  "M"    "inverse time of the move, 1/min"
    Maxrpm        "maxrpm"         "Feeds and speeds"   Speed   Asked     "ML"   "highest spindle speed at constant surface speed"
    Pitch         "pitch"          "Threads"            Length  Computed  "ML"   "thread pitch"
    Rplane        "rplane"         "Cycles"             Length  Computed  "ML"   "return plane: the height of the tool before and after a hole; the R plane is [vclear]"
    Vclear        "vclear"         "Cycles"             Length  Computed  "ML"   "clearance plane (R plane): the height where the feed begins"
    Depth         "depth"          "Cycles"             Length  Computed  "MLE"  "depth of a hole below its point, as a positive number; in a thread, the height of the thread"
    Inidep        "inidep"         "Cycles"             Length  Computed  "ML"   "depth after the first peck"
    Vbite         "vbite"          "Cycles"             Length  Computed  "ML"   "peck; in a thread the smallest cut"
    Vleave        "vleave"         "Cycles"             Length  Computed  "ML"   "finish allowance of a thread; secondary clearance of a hole"
    Peck1         "peck1"          "Cycles"             Length  Computed  "ML"   "first peck; in a thread the first cut"
    Sbite         "sbite"          "Cycles"             Length  Computed  "ML"   "least peck"
    Sclear        "sclear"         "Cycles"             Length  Computed  "ML"   "secondary clearance"
    Sleave        "sleave"         "Cycles"             Length  Computed  "ML"   "distance that a boring tool moves off the wall"
    Dwell         "dwell"          "Cycles"             Time    Computed  "MLE"  "dwell, in the unit of the Dwell command"
    Retplane      "retplane"       "Cycles"             Code    Computed  "ML"   "code of the return plane (ReturnPlane)"
    Lasthole      "lasthole"       "Cycles"             Count   Computed  "ML"   "1 at the last hole of a cycle, else 0"
    Isfirsthole   "isfirsthole"    "Cycles"             Count   Computed  "ML"   "1 at the first hole of a cycle, else 0"
    Rigid         "rigid"          "Cycles"             Count   Computed  "ML"   "1 for a rigid tap, else 0"
    Pointd        "pointd"         "Cycles"             Length  Computed  "ML"   "position of the cycle's point (the top of the hole) along the depth axis"
    Tool          "tool"           "Tools"              Count   Computed  "ML"   "tool number"
    Tool1         "tool1"          "Tools"              Count   Computed  "ML"   "the program's first tool"
    Isfirsttool   "isfirsttool"    "Tools"              Count   Computed  "ML"   "1 while the program's first tool is in the spindle, else 0"
    Islasttool    "islasttool"     "Tools"              Count   Computed  "ML"   "1 while the program's last tool is in the spindle, else 0"
    Lasttool      "lasttool"       "Tools"              Count   Computed  "ML"   "the tool before the current tool"
    Nexttool      "nexttool"       "Tools"              Count   Computed  "ML"   "the next tool; at the last tool, the first tool"
    Toold         "toold"          "Tools"              Length  Computed  "MLE"  "diameter of the tool or of the wire"
    Toolh         "toolh"          "Tools"              Length  Job       "ML"   "gauge length of the tool along the first axis"
    Toolv         "toolv"          "Tools"              Length  Job       "ML"   "gauge length of the tool along the second axis"
    Lcomp         "lcomp"          "Tools"              Count   Computed  "ML"   "length offset register"
    Dcomp         "dcomp"          "Tools"              Count   Computed  "MLE"  "diameter offset register"
    Comp          "comp"           "Tools"              Count   Job       "MLE"  "offset register; on lathes the T number: tool number x 100 + length register. If the tool number in the job is 100 or more, the T number is the tool number"
    Turret        "turret"         "Tools"              Count   Computed  "L"    "turret of the tool"
    Cool          "cool"           "Tools"              Code    Computed  "MLE"  "coolant code (Coolant)"
    Coolantoff    "coolantoff"     "Tools"              Code    Computed  "MLE"  "code that turns coolant off"
    Direct        "direct"         "Tools"              Code    Computed  "ML"   "code of the spindle direction (Spindle)"
    Side          "side"           "Tools"              Code    Computed  "MLE"  "code of the cutter compensation (CDC)"
    Program       "program#"       "Program"            Count   Asked     "MLE"  "program number"
    Block         "block"          "Program"            Count   Job       "MLE"  "number of this block, as counted by Sequence#s. If the job or --set gives a value, the variable has this value instead"
    Sub           "sub"            "Program"            Count   Computed  "M"    "subprogram number"
    Subline       "subline"        "Program"            Count   Computed  "M"    "block number at which the subprogram starts"
    Times         "times"          "Program"            Count   Computed  "M"    "how many times a call runs its subprogram"
    Work          "work"           "Program"            Code    Computed  "MLE"  "work offset"
    Workd         "workd"          "Program"            Length  Job       "ME"   "position of the work origin along the depth axis"
    Workh         "workh"          "Program"            Length  Job       "MLE"  "position of the work origin along the first axis"
    Workv         "workv"          "Program"            Length  Job       "MLE"  "position of the work origin along the second axis"
    Incmode       "incmode"        "Program"            Code    Computed  "MLE"  "incremental or absolute code (Inc/Abs)"
    Unitmode      "unitmode"       "Program"            Code    Computed  "MLE"  "inch or mm code (Inch/MM)"
    Stop          "stop"           "Program"            Code    Computed  "MLE"  "code of a program stop or an optional stop (StopCode)"
    Movelength    "movelength"     "Program"            Length  Computed  "MLE"  "length of this move"
    Movetime      "movetime"       "Program"            Time    Computed  "MLE"  "time of this move in seconds, at its feed"
    Totalcutdist  "totalcutdist"   "Program"            Length  Computed  "MLE"  "length of all feed moves so far"
    Totalcuttime  "totalcuttime"   "Program"            Time    Computed  "MLE"  "time of all feed moves so far, in seconds"
    Val1          "val1"           "Program"            Number  Job       "MLE"  "free value"
    Val2          "val2"           "Program"            Number  Job       "MLE"  "free value"
    Val3          "val3"           "Program"            Number  Job       "MLE"  "free value"
    Val4          "val4"           "Program"            Number  Job       "MLE"  "free value"
    Val5          "val5"           "Program"            Number  Job       "MLE"  "free value"
    Val6          "val6"           "Program"            Number  Job       "MLE"  "free value"
    Val7          "val7"           "Program"            Number  Job       "MLE"  "free value"
    Val8          "val8"           "Program"            Number  Job       "MLE"  "free value"
    Val9          "val9"           "Program"            Number  Job       "MLE"  "free value"
    Val10         "val10"          "Program"            Number  Job       "MLE"  "free value"
    Hmin          "hmin"           "Values of the whole job"    Length  Computed  "ML"   "least position of the cuts along the first axis"
    Hmax          "hmax"           "Values of the whole job"    Length  Computed  "ML"   "greatest position of the cuts along the first axis"
    Vmin          "vmin"           "Values of the whole job"    Length  Computed  "ML"   "least position of the cuts along the second axis"
    Vmax          "vmax"           "Values of the whole job"    Length  Computed  "ML"   "greatest position of the cuts along the second axis"
    Dmin          "dmin"           "Values of the whole job"    Length  Computed  "M"    "least position of the cuts along the depth axis"
    Dmax          "dmax"           "Values of the whole job"    Length  Computed  "M"    "greatest position of the cuts along the depth axis"
    Rhmin         "rhmin"          "Values of the whole job"    Length  Computed  "ML"   "least position of the cuts and rapids along the first axis"
    Rhmax         "rhmax"          "Values of the whole job"    Length  Computed  "ML"   "greatest position of the cuts and rapids along the first axis"
    Rvmin         "rvmin"          "Values of the whole job"    Length  Computed  "ML"   "least position of the cuts and rapids along the second axis"
    Rvmax         "rvmax"          "Values of the whole job"    Length  Computed  "ML"   "greatest position of the cuts and rapids along the second axis"
    Rdmin         "rdmin"          "Values of the whole job"    Length  Computed  "M"    "least position of the cuts and rapids along the depth axis"
    Rdmax         "rdmax"          "Values of the whole job"    Length  Computed  "M"    "greatest position of the cuts and rapids along the depth axis"
    Toolcount     "toolcount"      "Values of the whole job"    Count   Computed  "ML"   "number of tools"
    Opcount       "opcount"        "Values of the whole job"    Count   Computed  "MLE"  "number of operations"
    Holecount     "holecount"      "Values of the whole job"    Count   Computed  "ML"   "number of holes that cycles make"
    Cuttime       "cuttime"        "Values of the whole job"    Time    Computed  "MLE"  "time of the cuts at their feeds, in seconds; includes accelerations if the machine file gives accelerations"
    Cutlength     "cutlength"      "Values of the whole job"    Length  Computed  "MLE"  "length of the cuts"
    Tparams       "tparams"        "Threads"            Number  Job       "L"    "number of finish passes, chamfer and angle of a thread, packed into one number"
    Passes        "passes"         "Threads"            Count   Computed  "L"    "number of passes of the thread"
    Chams         "chams"          "Threads"            Number  Computed  "L"    "chamfer at the end of a thread"
    Tipang        "tipang"         "Threads"            Angle   Computed  "L"    "angle of the thread"
    Taper         "taper"          "Threads"            Length  Computed  "L"    "radius at the start of the thread minus radius at its end"
    Flood         "flood"          "Wire EDM"           Code    Job       "E"    "flood code"
    Flush         "flush"          "Wire EDM"           Code    Computed  "E"    "flush code (Flush)"
    Power         "power"          "Wire EDM"           Number  Job       "E"    "power setting of the cut"
    Initpower     "initpower"      "Wire EDM"           Number  Job       "E"    "power setting at the start"
    Sparkgap      "sparkgap"       "Wire EDM"           Length  Job       "E"    "spark gap"
    Wirefeed      "wirefeed"       "Wire EDM"           Number  Job       "E"    "wire feed"
    Thickness     "thickness"      "Wire EDM"           Length  Job       "E"    "thickness of the workpiece"
    Gauge         "gauge"          "Wire EDM"           Length  Job       "E"    "gauge height"
    Vgauge        "vgauge"         "Wire EDM"           Length  Job       "E"    "vertical gauge height"
    Upperdist     "upperdist"      "Wire EDM"           Length  Job       "E"    "distance of the upper guide"
    Lowerdist     "lowerdist"      "Wire EDM"           Length  Job       "E"    "distance of the lower guide"
}

/// Other names of variables that occur in the manual's list.
const ALSO: [(&str, VarId); 2] = [("lastrotang", VarId::Lastrotangle), ("etplane", VarId::Retplane)];

impl VarId {
    /// The row of the variable in the table.
    #[doc(hidden)]
    pub fn row(self) -> &'static Variable {
        &VARIABLES[self as usize]
    }

    /// Name of the variable, as it is written between brackets.
    pub fn name(self) -> &'static str {
        self.row().name
    }

    /// Finds a variable by its name; upper and lower case are equal.
    pub fn parse(name: &str) -> Option<VarId> {
        let own = VARIABLES.iter().find(|v| v.name.eq_ignore_ascii_case(name)).map(|v| v.id);
        own.or_else(|| ALSO.iter().find(|(also, _)| also.eq_ignore_ascii_case(name)).map(|(_, id)| *id))
    }
}

/// Variables whose values depend on later parts of the job.
pub const AHEAD: VarSet = VarSet::of(&[
    VarId::Hmin,
    VarId::Hmax,
    VarId::Vmin,
    VarId::Vmax,
    VarId::Dmin,
    VarId::Dmax,
    VarId::Rhmin,
    VarId::Rhmax,
    VarId::Rvmin,
    VarId::Rvmax,
    VarId::Rdmin,
    VarId::Rdmax,
    VarId::Toolcount,
    VarId::Opcount,
    VarId::Holecount,
    VarId::Cuttime,
    VarId::Cutlength,
]);

/// Variables whose values depend on later tools. The head of a job may already contain these values.
pub const TOOLS_AHEAD: VarSet = VarSet::of(&[VarId::Nexttool, VarId::Islasttool]);

/// The largest number of variables.
pub const MOST_VARIABLES: usize = 64 * WORDS;
const WORDS: usize = 3;

/// A set of variables.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct VarSet([u64; WORDS]);

impl VarSet {
    /// The set of these variables.
    pub const fn of(ids: &[VarId]) -> VarSet {
        let (mut bits, mut i) = ([0; WORDS], 0);
        while i < ids.len() {
            bits[ids[i] as usize / 64] |= 1 << (ids[i] as usize % 64);
            i += 1;
        }
        VarSet(bits)
    }

    /// Adds a variable.
    #[inline]
    pub fn insert(&mut self, id: VarId) {
        self.0[id as usize / 64] |= 1 << (id as usize % 64);
    }

    /// Removes a variable.
    #[inline]
    pub fn remove(&mut self, id: VarId) {
        self.0[id as usize / 64] &= !(1 << (id as usize % 64));
    }

    /// Whether the variable is in the set.
    #[inline]
    pub const fn has(self, id: VarId) -> bool {
        self.0[id as usize / 64] & 1 << (id as usize % 64) != 0
    }

    /// Whether the two sets have a variable in common.
    #[inline]
    pub fn meets(self, other: VarSet) -> bool {
        self.0.iter().zip(other.0).any(|(own, other)| own & other != 0)
    }

    /// Whether the set is empty.
    #[inline]
    pub fn is_empty(self) -> bool {
        self == VarSet::default()
    }

    /// The variables of both sets.
    #[must_use]
    pub fn with(self, other: VarSet) -> VarSet {
        VarSet(std::array::from_fn(|word| self.0[word] | other.0[word]))
    }

    /// The variables of this set that are not in `other`.
    #[must_use]
    pub fn without(self, other: VarSet) -> VarSet {
        VarSet(std::array::from_fn(|word| self.0[word] & !other.0[word]))
    }

    /// The variables of this set, one by one.
    pub fn iter(self) -> impl Iterator<Item = VarId> {
        VARIABLES.iter().map(|v| v.id).filter(move |&id| self.has(id))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_unique_and_found_in_any_case() {
        assert!(VARIABLES.len() <= MOST_VARIABLES, "VarSet has a bit for each");
        for variable in VARIABLES {
            assert_eq!(VarId::parse(&variable.name.to_uppercase()), Some(variable.id));
        }
        assert_eq!(VarId::parse("vlcear"), None);
        assert_eq!(VarId::parse("Etplane"), Some(VarId::Retplane));
    }
}
