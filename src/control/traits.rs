//! Properties of a control besides its codes. A property that no file defines is unknown, and nothing depends on it.

use serde::Deserialize;

use super::arcs::Arcs;
use super::words::Words;

/// The rules by which programs are run: everything that no table contains, such as the order of effects in a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Rules {
    /// The usual reading of Fanuc and Haas mills.
    #[default]
    Fanuc,
    /// LinuxCNC 2.9, as observed on its interpreter.
    Linuxcnc,
    /// EMC, with cycles as described in its manual of about 2005; otherwise as LinuxCNC.
    Emc2,
    /// Grbl 1.1, as observed on its own parser.
    Grbl,
    /// Siemens 840D and 828D mills in their own language.
    Siemens,
    /// Heidenhain TNC in Klartext.
    Klartext,
    /// Okuma OSP mills.
    Osp,
    /// Programs are not run: the language does not use G codes, as Klartext. Forms print it, but no program is run or
    /// proven.
    None,
}

impl Rules {
    /// Whether programs are run as by NIST's interpreter. LinuxCNC, its predecessors and Grbl come from that interpreter.
    pub fn is_nist(self) -> bool {
        matches!(self, Rules::Linuxcnc | Rules::Emc2 | Rules::Grbl)
    }
}

/// The unit of a length without a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum WithoutPoint {
    /// Not public.
    #[default]
    Unknown,
    /// Inches or millimetres.
    Units,
    /// The smallest unit of the control: 0.0001 inch, 0.001 mm.
    LeastIncrement,
}

/// The unit of P in a dwell.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DwellUnit {
    /// Not public.
    #[default]
    Unknown,
    /// Milliseconds.
    Ms,
    /// Seconds.
    S,
    /// Seconds with a point, milliseconds without one.
    ByPoint,
}

/// How a tool length offset is turned on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Deserialize)]
pub enum ToolLength {
    /// By a code with a register.
    #[default]
    #[serde(rename = "G43 H")]
    CodeAndRegister,
    /// By the code alone, for the tool in the spindle. A register may be given.
    #[serde(rename = "G43")]
    Code,
    /// By the register alone. A code may be given.
    #[serde(rename = "H")]
    Register,
    /// By calling the tool or one of its edges. Length and radius belong to the tool, and no register is named.
    #[serde(rename = "tool")]
    Tool,
    /// The control has no length registers.
    #[serde(rename = "none")]
    None,
}

/// The origin of I, J and K of an arc.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Centres {
    /// Not public.
    #[default]
    Unknown,
    /// The start of the arc.
    Incremental,
    /// The origin of the coordinates.
    Absolute,
}

/// Whether a state is kept or reset.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Kept {
    /// Not public.
    #[default]
    Unknown,
    /// The state is kept.
    #[serde(rename = "kept")]
    Yes,
    /// The state is reset or ended.
    #[serde(rename = "lost")]
    No,
}

/// What the spindle turns.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Deserialize)]
pub enum Turns {
    /// The tool, as on a mill.
    #[default]
    #[serde(rename = "mill")]
    Tool,
    /// The part, as on a lathe: X is a diameter, U and W are increments, and T changes the tool at once.
    #[serde(rename = "lathe")]
    Part,
    /// Nothing, as on a wire EDM machine: X Y are at the lower guide of the wire and U V at the upper one.
    #[serde(rename = "wire")]
    Nothing,
}

/// Properties of a control besides its codes.
#[derive(Clone, Debug, Default)]
pub struct Traits {
    /// The rules by which its programs are run.
    pub rules: Rules,
    /// Whether a block may have only one M code.
    pub one_m: bool,
    /// The longest block that the control reads, in characters; `None`: not public.
    pub longest_line: Option<usize>,
    /// Whether the control stops at a longer block. For other controls, a sender cuts longer blocks.
    pub stops_at_longer: bool,
    /// Whether a comment may run to the end of its line without a closing bracket.
    pub open_comments: bool,
    /// Whether the control reads words in lower case.
    pub small_letters: bool,
    /// The unit of a length without a point.
    pub without_point: WithoutPoint,
    /// The unit of P in a dwell.
    pub dwell: DwellUnit,
    /// The origin of I, J and K.
    pub centres: Centres,
    /// Whether modes that one program leaves on, such as G91, are kept at the start of the next one.
    pub modes_at_start: Kept,
    /// Whether the spindle keeps turning at M0 and M1.
    pub spindle_at_stop: Kept,
    /// How a tool length offset is turned on.
    pub tool_length: ToolLength,
    /// Whether a height is a machine position while no tool length is in force.
    pub height_is_machine: bool,
    /// The words that need no code in their block.
    pub everywhere: Words,
    /// The letter of a word that selects a work offset, beside its codes.
    pub work_letter: Option<u8>,
    /// The highest number of the `work_letter` word.
    pub most_work: Option<u16>,
    /// The letters of all words that the control reads; empty: not public.
    pub letters: Words,
    /// Whether spaces and comments are left out of the length of a block.
    pub bare_line: bool,
    /// Whether the control has no mist coolant.
    pub no_mist: bool,
    /// How far the numbers of an arc may deviate from one circle.
    pub arcs: Arcs,
    /// What the spindle turns.
    pub turns: Turns,
    /// Whether a laser is off in rapids, independent of M3 and S.
    pub beam_off_in_rapids: bool,
    /// Whether G28 and G30 without axis words send all axes home.
    pub all_go_home: bool,
    /// Whether a second T in the block of a tool change names the next tool: `T3 T7 M6`.
    pub next_beside_change: bool,
    /// Whether all codes of the control are known, so that it refuses all others.
    pub complete: bool,
}
