//! The text of a control file as serde reads it: tables and rows.

use std::collections::BTreeMap;

use serde::Deserialize;
use toml::Spanned;

use super::arcs::Tolerance;
use super::runs::StopsRotary;
use super::traits::{
    Basic, Centres, DwellUnit, FeedWithoutPoint, Kept, Macros, Rules, ToolLength, Turns, WithoutPoint,
};

/// A control file as written.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct File {
    pub(super) name: Spanned<String>,
    pub(super) title: Option<String>,
    pub(super) like: Option<Spanned<String>>,
    pub(super) rules: Option<Rules>,
    pub(super) machine: Option<Turns>,
    pub(super) complete: Option<bool>,
    /// Facts that are not public, in sentences for the page of the control.
    pub(super) unknown: Option<Vec<String>>,
    #[serde(default)]
    pub(super) numbers: Numbers,
    #[serde(default)]
    pub(super) text: Text,
    #[serde(default)]
    pub(super) blocks: Blocks,
    #[serde(default)]
    pub(super) words: WordsOf,
    #[serde(default)]
    pub(super) start: Start,
    #[serde(default)]
    pub(super) dwell: Dwell,
    #[serde(default)]
    pub(super) stops: Stops,
    #[serde(default)]
    pub(super) arcs: ArcsText,
    #[serde(default)]
    pub(super) tool: Tool,
    #[serde(default)]
    pub(super) reference: Reference,
    #[serde(default)]
    pub(super) laser: LaserText,
    #[serde(default)]
    pub(super) coolant: CoolantText,
    #[serde(default)]
    pub(super) corners: CornersText,
    #[serde(default)]
    pub(super) macros: MacrosText,
    #[serde(default)]
    pub(super) subprograms: Subprograms,
    #[serde(default)]
    pub(super) codes: BTreeMap<Spanned<String>, RowText>,
}

/// `[text]`: how the control reads text other than words.
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Text {
    pub(super) line: Option<usize>,
    pub(super) comments_count: Option<bool>,
    pub(super) longer: Option<Longer>,
    pub(super) open_comments: Option<bool>,
    pub(super) small_letters: Option<bool>,
    pub(super) semicolon: Option<Semicolon>,
}

/// The meaning of a semicolon.
#[derive(Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Semicolon {
    Comment,
    EndOfBlock,
}

/// `[macros]`: the language of expressions and assignments.
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MacrosText {
    pub(super) language: Option<Macros>,
}

/// `[subprograms]`: how subprograms are called.
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Subprograms {
    pub(super) repeats_in_p: Option<RepeatsInP>,
}

/// Whether P of a call contains the number of calls: true, false or `"unknown"`.
#[derive(Deserialize)]
#[serde(untagged, expecting = "write true, false or \"unknown\"")]
pub(super) enum RepeatsInP {
    Known(bool),
    Unknown(Unknown),
}

impl RepeatsInP {
    pub(super) fn known(&self) -> Option<bool> {
        if let RepeatsInP::Known(repeats) = self { Some(*repeats) } else { None }
    }
}

/// The word for a property that is not public.
#[derive(Deserialize)]
pub(super) enum Unknown {
    #[serde(rename = "unknown")]
    Unknown,
}

/// `[blocks]`: limits of a block.
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Blocks {
    pub(super) one_m: Option<bool>,
}

/// `[numbers]`: the meaning of a length or a feed without a decimal point, and the letters that take no decimal point.
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Numbers {
    pub(super) length_without_point: Option<WithoutPoint>,
    pub(super) feed_without_point: Option<FeedWithoutPoint>,
    pub(super) no_point: Option<Spanned<String>>,
}

/// `[start]`: whether modes that a program leaves active are still active in the next program, and the machine's units.
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Start {
    pub(super) modes: Option<Kept>,
    pub(super) units: Option<Basic>,
}

/// `[dwell]`: the units of the words of a dwell.
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Dwell {
    #[serde(rename = "P")]
    pub(super) p: Option<DwellUnit>,
}

/// `[stops]`: whether the spindle keeps turning, and the coolant stays on, at M0 and M1.
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Stops {
    pub(super) spindle: Option<Kept>,
}

/// `[arcs]`: centres and tolerances of arcs.
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ArcsText {
    pub(super) centres: Option<Centres>,
    /// Tolerance in millimetres. The tolerance in inches is given only if it is a different length.
    pub(super) mm: Option<Spanned<Tolerance>>,
    pub(super) inch: Option<Spanned<Tolerance>>,
}

/// The reaction of the control to a block that is too long.
#[derive(Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Longer {
    Stops,
    Cut,
}

/// `[words]`: the letters of all words, and the words that need no code.
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct WordsOf {
    pub(super) letters: Option<Spanned<String>>,
    pub(super) everywhere: Option<Spanned<String>>,
    pub(super) work: Option<Spanned<String>>,
    pub(super) most_work: Option<u16>,
}

/// `[laser]`: settings for machines with a laser.
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct LaserText {
    /// The state of the laser in rapids.
    pub(super) rapids: Option<InRapids>,
}

/// The state of a laser in rapids.
#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum InRapids {
    /// The laser is off, even if M3 and S would turn it on.
    Off,
}

/// `[reference]`: moves to a reference point.
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Reference {
    /// The axes that move if the block has no axis words.
    pub(super) without_axes: Option<WithoutAxes>,
}

/// The axes that move to a reference point if the block has no axis words.
#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum WithoutAxes {
    /// All axes.
    All,
}

/// `[coolant]`: kinds of coolant of the machine.
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CoolantText {
    pub(super) mist: Option<bool>,
}

/// `[corners]`: how the control slows down at the corners between moves.
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CornersText {
    pub(super) junction_deviation: Option<bool>,
}

/// `[tool]`: the tool length offset, the coolant at a tool change, and a second T word in a block.
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Tool {
    pub(super) length: Option<ToolLength>,
    pub(super) without_length: Option<Height>,
    pub(super) zero: Option<ZeroRegister>,
    /// Whether the coolant stays on at a tool change.
    pub(super) coolant: Option<Kept>,
    /// The meaning of a second T word in the block of a tool change.
    pub(super) second: Option<SecondTool>,
}

/// The meaning of a second T word in the block of a tool change.
#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum SecondTool {
    /// The second T word names the tool after the tool that this block loads.
    Next,
}

/// The length that register 0 turns on.
#[derive(Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum ZeroRegister {
    None,
    Tool,
}

/// The meaning of a Z position while no tool length offset is active.
#[derive(Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Height {
    Work,
    Machine,
}

/// The value of `ends_length`.
#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "kebab-case", expecting = "\"along-z\" or \"always\"")]
pub(super) enum EndsLength {
    AlongZ,
    Always,
}

/// A row of `[codes]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "a row, as { is = \"harmless\" }")]
pub(super) struct RowText {
    pub(super) is: Spanned<String>,
    pub(super) words: Option<Spanned<String>>,
    pub(super) makes: Option<Spanned<String>>,
    /// The words for the pitch of a tap: `"Q"`, or `{ I = "mm", J = "per-inch" }`.
    pub(super) pitch: Option<Spanned<toml::Value>>,
    pub(super) text: Option<String>,
    pub(super) not_run: Option<String>,
    pub(super) only: Option<Spanned<String>>,
    pub(super) stops_spindle: Option<bool>,
    pub(super) motions: Option<Spanned<String>>,
    pub(super) work: Option<Spanned<String>>,
    pub(super) point: Option<Spanned<u8>>,
    pub(super) tool: Option<Spanned<u16>>,
    #[serde(default)]
    pub(super) by_diameter: bool,
    pub(super) speed_out: Option<Spanned<String>>,
    pub(super) ends_length: Option<Spanned<EndsLength>>,
    pub(super) beside_moves: Option<Spanned<bool>>,
    pub(super) may_keep_length: Option<Spanned<bool>>,
    pub(super) stops_rotary: Option<StopsRotary>,
    pub(super) ends: Option<Spanned<String>>,
    pub(super) angle: Option<Spanned<String>>,
    pub(super) rigid: Option<Spanned<bool>>,
}
