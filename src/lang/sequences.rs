//! The table of sequences and canned cycles.

use super::Standing::{self, Doc, Ours};
use super::machine::Machines;

/// One row of the table.
#[derive(Debug)]
pub struct Sequence {
    /// Which.
    pub id: SequenceId,
    /// As forms write it.
    pub name: &'static str,
    /// A canned cycle may carry a line count and `End Cancel`.
    pub is_cycle: bool,
    /// The machines that have it; of the manual unless marked.
    pub machines: Machines,
    /// Machines whose forms must have it.
    pub required: Machines,
    /// When it is printed.
    pub meaning: &'static str,
    /// Where that comes from.
    pub standing: Standing,
}

macro_rules! sequences {
    ($($id:ident $name:literal $kind:ident $machines:literal $required:literal $standing:ident $meaning:literal)*) => {
        /// A sequence; `Upon [var]` is one for each variable.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[repr(u8)]
        pub enum SequenceId { $(#[doc = $meaning] $id),* }

        /// All sequences.
        pub const SEQUENCES: &[Sequence] = &[$(Sequence {
            id: SequenceId::$id,
            name: $name,
            is_cycle: sequences!(@$kind),
            machines: Machines::of($machines),
            required: Machines::of($required),
            meaning: $meaning,
            standing: $standing,
        }),*];
    };
    (@cycle) => { true };
    (@plain) => { false };
}

#[rustfmt::skip]
sequences! {
    StartCode         "StartCode"         plain "MLE" "MLE" Doc "the beginning of the program"
    EndCode           "EndCode"           plain "MLE" "MLE" Doc "the end of the program (on EDM by our decision)"
    FirstToolChange   "1stToolChange"     plain "ML"  "ML"  Doc "the program's first tool change"
    ToolChange        "ToolChange"        plain "ML"  "ML"  Doc "every later tool change"
    RapidCode         "RapidCode"         plain "MLE" ""    Doc "a rapid move, instead of the generated block"
    LineCode          "LineCode"          plain "ML"  ""    Doc "a feed move, instead of the generated block"
    CwCode            "CwCode"            plain "MLE" ""    Doc "a clockwise arc, instead of the generated block"
    CcwCode           "CcwCode"           plain "MLE" ""    Doc "a counter-clockwise arc, instead of the generated block"
    InFeed            "InFeed"            plain "MLE" ""    Doc "the move into the part that turns cutter compensation on"
    OutFeed           "OutFeed"           plain "MLE" ""    Doc "the move away from the part that turns cutter compensation off"
    BeginLeadin       "BeginLeadin"       plain "MLE" ""    Doc "before the lead-in moves"
    EndLeadin         "EndLeadin"         plain "MLE" ""    Doc "after the lead-in moves"
    BeginLeadout      "BeginLeadout"      plain "MLE" ""    Doc "before the lead-out moves"
    EndLeadout        "EndLeadout"        plain "MLE" ""    Doc "after the lead-out moves"
    BeginPlunge       "BeginPlunge"       plain "MLE" ""    Doc "before the plunge moves"
    EndPlunge         "EndPlunge"         plain "MLE" ""    Doc "after the plunge moves"
    BeginRetract      "BeginRetract"      plain "MLE" ""    Doc "before the retract moves"
    EndRetract        "EndRetract"        plain "MLE" ""    Doc "after the retract moves"
    BeginSideStep     "BeginSideStep"     plain "MLE" ""    Doc "before the side step moves"
    EndSideStep       "EndSideStep"       plain "MLE" ""    Doc "after the side step moves"
    BeginZLevel       "BeginZLevel"       plain "MLE" ""    Doc "before the moves of one Z level"
    EndZLevel         "EndZLevel"         plain "MLE" ""    Doc "after the moves of one Z level"
    BeginRow          "BeginRow"          plain "M"   ""    Doc "before each pass of a pocket or surface cut"
    EndRow            "EndRow"            plain "M"   ""    Doc "after each pass of a pocket or surface cut"
    Index             "Index"             plain "M"   ""    Doc "instead of a rapid to another rotary view"
    Unwind            "Unwind"            plain "M"   ""    Doc "when a rotary axis would leave its travel"
    SubStart          "SubStart"          plain "M"   ""    Doc "the beginning of a subprogram"
    SubEnd            "SubEnd"            plain "M"   ""    Doc "the end of a subprogram"
    SubCall           "SubCall"           plain "M"   ""    Doc "the call of a subprogram"
    Between           "Between"           plain "M"   ""    Doc "after the last subprogram, before the main program"
    EdmCut            "EdmCut"            plain "E"   ""    Doc "cuts the wire"
    EdmThread         "EdmThread"         plain "E"   ""    Doc "threads the wire"
    EdmPreDrillThread "EdmPreDrillThread" plain "E"   ""    Doc "predrills a thread point"
    SubmergeTank      "SubmergeTank"      plain "E"   ""    Doc "fills the tank"
    Stop              "Stop"              plain "E"   ""    Doc "a program stop"
    AutoThread        "AutoThread"        cycle "L"   ""    Doc "the control's own threading cycle"
    CanThread         "CanThread"         cycle "L"   ""    Doc "a threading cycle of one pass each, instead of AutoThread"
    Back              "Back"              cycle "M"   ""    Doc "back boring"
    Bore              "Bore"              cycle "ML"  ""    Doc "boring: feed down, rapid out"
    Cancel            "Cancel"            cycle "ML"  ""    Doc "ends a machine cycle"
    Chipbreak         "Chipbreak"         cycle "ML"  ""    Doc "pecking that only breaks the chip"
    Custom1           "Custom1"           cycle "ML"  ""    Doc "a cycle of the machine that the others do not cover"
    Custom2           "Custom2"           cycle "ML"  ""    Doc "a cycle of the machine that the others do not cover"
    Custom3           "Custom3"           cycle "ML"  ""    Doc "a cycle of the machine that the others do not cover"
    Drill             "Drill"             cycle "ML"  ""    Doc "straight drilling"
    LTap              "LTap"              cycle "M"   ""    Doc "left-hand tapping"
    Peck              "Peck"              cycle "ML"  ""    Doc "deep drilling with full retracts; `None` generates the moves"
    Ream              "Ream"              cycle "ML"  ""    Doc "reaming: feed down, feed out"
    Tap               "Tap"               cycle "ML"  ""    Ours "tapping; the manual lists it, its page is not public"
}

impl SequenceId {
    /// Its row of the table.
    pub fn row(self) -> &'static Sequence {
        &SEQUENCES[self as usize]
    }

    /// As forms write it.
    pub fn name(self) -> &'static str {
        self.row().name
    }

    /// Finds a name in any case; `Chip Break` is Chipbreak.
    pub fn parse(name: &str) -> Option<SequenceId> {
        if name.eq_ignore_ascii_case("Chip Break") {
            return Some(SequenceId::Chipbreak);
        }
        SEQUENCES.iter().find(|s| s.name.eq_ignore_ascii_case(name)).map(|s| s.id)
    }
}

/// What the words of a sequence name line say.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SequenceName<'a> {
    /// A named sequence, with what follows the name: perhaps a count.
    Plain(SequenceId, Option<&'a str>),
    /// `Upon [var]`, with the variable as written.
    Upon(&'a str),
    /// `Upon Every [var]`.
    UponEvery(&'a str),
}

impl<'a> SequenceName<'a> {
    /// Reads the words of a line; `None` when they name no sequence.
    pub fn parse(words: &[&'a str]) -> Option<SequenceName<'a>> {
        let first = *words.first()?;
        if first.eq_ignore_ascii_case("Upon") {
            return match words.get(1) {
                Some(every) if every.eq_ignore_ascii_case("Every") => {
                    Some(SequenceName::UponEvery(words.get(2).copied().unwrap_or("")))
                }
                second => Some(SequenceName::Upon(second.copied().unwrap_or(""))),
            };
        }
        if first.eq_ignore_ascii_case("Chip") && words.get(1).is_some_and(|w| w.eq_ignore_ascii_case("Break")) {
            return Some(SequenceName::Plain(SequenceId::Chipbreak, words.get(2).copied()));
        }
        SequenceId::parse(first).map(|id| SequenceName::Plain(id, words.get(1).copied()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_is_found() {
        for sequence in SEQUENCES {
            assert_eq!(SequenceId::parse(&sequence.name.to_uppercase()), Some(sequence.id));
        }
        assert_eq!(SequenceId::parse("chip break"), Some(SequenceId::Chipbreak));
    }

    #[test]
    fn name_lines_have_counts_and_variables() {
        assert_eq!(SequenceName::parse(&["Back", "3"]), Some(SequenceName::Plain(SequenceId::Back, Some("3"))));
        assert_eq!(SequenceName::parse(&["Upon", "[work]"]), Some(SequenceName::Upon("[work]")));
        assert_eq!(SequenceName::parse(&["upon", "every", "<tool>"]), Some(SequenceName::UponEvery("<tool>")));
        assert_eq!(SequenceName::parse(&["Dril"]), None);
    }
}
