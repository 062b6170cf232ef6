//! What a control is besides its codes. What no file says is unknown, and nobody goes by it.

use serde::Deserialize;

use super::arcs::Arcs;
use super::words::Words;

/// By whose rules programs are run: what no table says, as in which order a block acts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Rules {
    /// The usual reading of Fanuc and Haas mills.
    #[default]
    Fanuc,
    /// LinuxCNC 2.9, as its interpreter was observed.
    Linuxcnc,
    /// EMC as its manual of about 2005 describes the cycles; else as LinuxCNC.
    Emc2,
    /// Grbl 1.1, as its own parser answers.
    Grbl,
    /// Siemens 840D and 828D mills in their own language.
    Siemens,
    /// Heidenhain TNC in Klartext.
    Klartext,
    /// Okuma OSP mills.
    Osp,
    /// Not at all: its language is not that of G codes, as Klartext. Forms print it, and no program is run or proven.
    None,
}

impl Rules {
    /// Are programs run as by NIST's interpreter, from which LinuxCNC, its predecessors and Grbl come?
    pub fn is_nist(self) -> bool {
        matches!(self, Rules::Linuxcnc | Rules::Emc2 | Rules::Grbl)
    }
}

/// What a length without a point counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum WithoutPoint {
    /// Nothing public says.
    #[default]
    Unknown,
    /// Inches or millimetres.
    Units,
    /// The smallest unit of the control: 0.0001 inch, 0.001 mm.
    LeastIncrement,
}

/// What P of a dwell counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DwellUnit {
    /// Nothing public says.
    #[default]
    Unknown,
    /// Milliseconds.
    Ms,
    /// Seconds.
    S,
    /// Seconds where it has a point, milliseconds where it has none.
    ByPoint,
}

/// How the length of a tool is turned on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Deserialize)]
pub enum ToolLength {
    /// By a code with its register.
    #[default]
    #[serde(rename = "G43 H")]
    CodeAndRegister,
    /// By the code alone, for the tool in the spindle; a register may stand beside it.
    #[serde(rename = "G43")]
    Code,
    /// By the register alone; a code may stand beside it.
    #[serde(rename = "H")]
    Register,
    /// By calling the tool, or an edge of it: length and radius are the tool's own, and no register is named.
    #[serde(rename = "tool")]
    Tool,
    /// The control has no registers of lengths.
    #[serde(rename = "none")]
    None,
}

/// From where I, J and K of an arc count.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Centres {
    /// Nothing public says.
    #[default]
    Unknown,
    /// From the start of the arc.
    Incremental,
    /// From the origin.
    Absolute,
}

/// What is left as it is, where a control may also put it back.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Kept {
    /// Nothing public says.
    #[default]
    Unknown,
    /// A stop keeps what was on.
    #[serde(rename = "kept")]
    Yes,
    /// A stop puts back or ends what was on.
    #[serde(rename = "lost")]
    No,
}

/// What its spindle turns.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Deserialize)]
pub enum Turns {
    /// The tool, as of a mill.
    #[default]
    #[serde(rename = "mill")]
    Tool,
    /// The part: X is a diameter, U and W are increments, T changes the tool at once.
    #[serde(rename = "lathe")]
    Part,
    /// Nothing: the wire of an EDM machine, with X Y at its lower guide and U V at the upper one.
    #[serde(rename = "wire")]
    Nothing,
}

/// What a control is besides its codes.
#[derive(Clone, Debug, Default)]
pub struct Traits {
    /// By whose rules its programs are run.
    pub rules: Rules,
    /// A block may have one M code.
    pub one_m: bool,
    /// The longest block that the control reads, in characters; `None`: nothing public says.
    pub longest_line: Option<usize>,
    /// The control stops at a longer block. Of others a sender cuts what is too long.
    pub stops_at_longer: bool,
    /// A comment may go on to the end of its line without its closing mark.
    pub open_comments: bool,
    /// The control reads words with small letters.
    pub small_letters: bool,
    /// What a length without a point counts.
    pub without_point: WithoutPoint,
    /// What P of a dwell counts.
    pub dwell: DwellUnit,
    /// From where I, J and K count.
    pub centres: Centres,
    /// The modes that one program leaves on, as G91, at the start of the next one.
    pub modes_at_start: Kept,
    /// The spindle at M0 and M1.
    pub spindle_at_stop: Kept,
    /// How the length of a tool is turned on.
    pub tool_length: ToolLength,
    /// A height is a place of the machine while no length of a tool counts.
    pub height_is_machine: bool,
    /// The words that need no code in their block.
    pub everywhere: Words,
    /// The letter of a word that selects a work offset, beside its codes.
    pub work_letter: Option<u8>,
    /// The highest number of that word.
    pub most_work: Option<u16>,
    /// The letters of all words that it reads; none: nothing public says.
    pub letters: Words,
    /// Blanks and comments do not count for the length of a block.
    pub bare_line: bool,
    /// The control has no mist coolant.
    pub no_mist: bool,
    /// How far an arc's numbers may be from one circle.
    pub arcs: Arcs,
    /// What its spindle turns.
    pub turns: Turns,
    /// A laser is off in rapids, whatever M3 and S said.
    pub beam_off_in_rapids: bool,
    /// G28 and G30 without axis words send all axes home.
    pub all_go_home: bool,
    /// A second T in the block of a tool change names the next tool: `T3 T7 M6`.
    pub next_beside_change: bool,
    /// All its codes are known: it refuses others.
    pub complete: bool,
}
