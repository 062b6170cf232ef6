//! Properties of a control other than its codes. If no file defines a property, it is unknown, and postform does not rely on it.

use serde::Deserialize;

use super::arcs::Arcs;
use super::words::Words;

/// The rules by which programs are run: all behaviour that no table contains, such as the order of effects in a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Rules {
    /// Fanuc and Haas mills.
    #[default]
    Fanuc,
    /// LinuxCNC 2.9, as observed by running its interpreter.
    Linuxcnc,
    /// EMC2. Cycles are run as in its manual of about 2005, and everything else as on LinuxCNC.
    Emc2,
    /// Grbl 1.1, as observed by running its parser.
    Grbl,
    /// Siemens 840D and 828D mills in their own language.
    Siemens,
    /// Heidenhain TNC in Klartext.
    Klartext,
    /// Okuma OSP mills.
    Osp,
    /// Programs are not run, because postform does not read the language. Forms can print Klartext, but programs in
    /// Klartext are not proven.
    None,
}

impl Rules {
    /// Whether programs are run like NIST's interpreter runs them. LinuxCNC, its predecessors and Grbl are based on
    /// that interpreter.
    pub fn is_nist(self) -> bool {
        matches!(self, Rules::Linuxcnc | Rules::Emc2 | Rules::Grbl)
    }
}

/// The unit of a length without a decimal point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum WithoutPoint {
    /// Not public.
    #[default]
    Unknown,
    /// Inches or millimetres, whichever is active.
    Units,
    /// The least input increment of the control: 0.0001 inch, or 0.001 mm.
    LeastIncrement,
}

/// The unit of P in the block of a dwell.
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
    /// Seconds if the number has a decimal point, otherwise milliseconds.
    ByPoint,
}

/// How a tool length offset is turned on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Deserialize)]
pub enum ToolLength {
    /// By a code with a register.
    #[default]
    #[serde(rename = "G43 H")]
    CodeAndRegister,
    /// By the code alone, for the tool in the spindle. The block may also contain a register.
    #[serde(rename = "G43")]
    Code,
    /// By the register alone. The block may also contain a code.
    #[serde(rename = "H")]
    Register,
    /// By calling the tool or one of its cutting edges. Length and radius belong to the tool; the program names no register.
    #[serde(rename = "tool")]
    Tool,
    /// The control has no length registers.
    #[serde(rename = "none")]
    None,
}

/// The point from which I, J and K of an arc are measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Centres {
    /// Not public.
    #[default]
    Unknown,
    /// The start of the arc.
    Incremental,
    /// The program zero.
    Absolute,
}

/// Whether a state is kept or reset, for example at the start of a program.
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

/// The basic units of a machine: the units of everything that the units of a program do not change.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Basic {
    /// Inches.
    Inch,
    /// Millimetres.
    Mm,
}

/// Whether the spindle turns the tool, the workpiece, or nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Deserialize)]
pub enum Turns {
    /// The tool, as on a mill.
    #[default]
    #[serde(rename = "mill")]
    Tool,
    /// The workpiece, as on a lathe: X is a diameter, U and W are increments, and T changes the tool at once.
    #[serde(rename = "lathe")]
    Part,
    /// Nothing, as on a wire EDM machine: X Y is the position of the wire's lower guide, U V is the position of its
    /// upper guide.
    #[serde(rename = "wire")]
    Nothing,
}

/// The macro language of a control.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Macros {
    /// Custom macros of Fanuc (Macro B).
    #[default]
    Fanuc,
    /// The macros of Haas.
    Haas,
    /// The expressions of LinuxCNC.
    Linuxcnc,
}

/// The unit of a feed without a decimal point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum FeedWithoutPoint {
    /// Not public; such feeds are run as whole units.
    #[default]
    Unknown,
    /// The units that are active, per minute or per revolution.
    Units,
    /// Millimetres per minute; with inches or per revolution, a setting of the control decides.
    WholeMm,
    /// As a length without a decimal point, if a setting of the control does not change it.
    LeastIncrement,
}

/// Properties of a control other than its codes.
#[derive(Clone, Debug, Default)]
pub struct Traits {
    /// The rules by which programs of the control are run.
    pub rules: Rules,
    /// Whether a block may contain only one M code.
    pub one_m: bool,
    /// The longest block that the control reads, in characters; `None`: not public.
    pub longest_line: Option<usize>,
    /// Whether the control stops at a block that is too long. On other controls, the program that sends the blocks cuts
    /// off a block that is too long.
    pub stops_at_longer: bool,
    /// Whether a comment may end at the end of its line, without a closing bracket.
    pub open_comments: bool,
    /// Whether the control reads words in lower case.
    pub small_letters: bool,
    /// The unit of a length without a decimal point.
    pub without_point: WithoutPoint,
    /// The unit of a feed without a decimal point.
    pub feed_without_point: FeedWithoutPoint,
    /// The letters whose numbers have no decimal point: the control stops at `M3.`; empty: not public, or none.
    pub no_point: Words,
    /// The macro language.
    pub macros: Macros,
    /// Whether a semicolon ends the block, and is not the begin of a comment.
    pub semicolon_ends_block: bool,
    /// Whether the digits of P above the last four are the number of calls of a subprogram, as in M98 P31000; `None`:
    /// not public.
    pub repeats_in_p: Option<bool>,
    /// The unit of P in the block of a dwell.
    pub dwell: DwellUnit,
    /// The point from which I, J and K of an arc are measured.
    pub centres: Centres,
    /// Whether modes that a program leaves active, such as G91, are still active at the start of the next program.
    pub modes_at_start: Kept,
    /// The basic units of the machine, which the feeds of a Siemens control have after G70 and G71; `None`: unknown.
    pub basic: Option<Basic>,
    /// Whether the spindle keeps turning, and the coolant stays on, at M0 and M1.
    pub spindle_at_stop: Kept,
    /// Whether the coolant stays on at a tool change (M6).
    pub coolant_at_change: Kept,
    /// How a tool length offset is turned on.
    pub tool_length: ToolLength,
    /// Whether length register 0 is the tool in the spindle. If not, register 0 is no length.
    pub zero_is_tool: bool,
    /// Whether a Z position is a machine position while no tool length offset is active.
    pub height_is_machine: bool,
    /// The letters of the words that need no code in their block.
    pub everywhere: Words,
    /// The letter of a word that selects a work offset, in addition to the codes that do.
    pub work_letter: Option<u8>,
    /// The highest number of the `work_letter` word.
    pub most_work: Option<u16>,
    /// The letters of all words that the control reads; empty: not public.
    pub letters: Words,
    /// Whether spaces and comments don't count in the length of a block.
    pub bare_line: bool,
    /// Whether the control lacks mist coolant.
    pub no_mist: bool,
    /// Whether the control calculates the speed at a corner by Grbl's junction deviation, although it follows the rules of
    /// LinuxCNC otherwise.
    pub junction_deviation: bool,
    /// The allowed deviations of the numbers of an arc from one circle.
    pub arcs: Arcs,
    /// Whether the spindle turns the tool, the workpiece, or nothing.
    pub turns: Turns,
    /// Whether the laser is off in rapids, even if M3 and S would turn it on.
    pub beam_off_in_rapids: bool,
    /// Whether G28 and G30 without axis words move all axes to the reference point.
    pub all_go_home: bool,
    /// Whether a second T in the block of a tool change names the next tool, as in `T3 T7 M6`.
    pub next_beside_change: bool,
    /// Whether all codes of the control are known; it then refuses every other code.
    pub complete: bool,
}
