//! The table of sequences and canned cycles.

use super::Standing::{self, Doc, Ours};
use super::machine::Machines;

/// One row of the table of sequences.
#[derive(Debug)]
pub struct Sequence {
    /// Identifier of the sequence.
    pub id: SequenceId,
    /// Name of the sequence in forms.
    pub name: &'static str,
    /// Whether the sequence is a canned cycle. A canned cycle may have a line count and `End Cancel`.
    pub is_cycle: bool,
    /// The machines that have the sequence. The sets of machines are from the manual unless another source is marked.
    pub machines: Machines,
    /// Machines whose forms must contain the sequence.
    pub required: Machines,
    /// When the sequence is printed.
    pub meaning: &'static str,
    /// The source of the sequence's description, such as the manual.
    pub standing: Standing,
    /// The item of a job for which the sequence is printed.
    pub event: &'static str,
    /// The name of the folder in samples/ that contains an example of the sequence.
    pub sample: &'static str,
}

macro_rules! sequences {
    ($($id:ident $name:literal $kind:ident $machines:literal $required:literal $standing:ident $meaning:literal $event:literal $sample:literal)*) => {
        /// A sequence. The table does not list Upon sequences, because an Upon sequence exists for each variable.
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
            event: $event,
            sample: $sample,
        }),*];
    };
    (@cycle) => { true };
    (@plain) => { false };
}

#[rustfmt::skip]
sequences! {
    StartCode         "StartCode"         plain "MLE" "MLE" Doc "the beginning of the program" "`start`" "start-code"
    EndCode           "EndCode"           plain "MLE" "MLE" Doc "the end of the program" "end of the job" "end-code"
    FirstToolChange   "1stToolChange"     plain "ML"  "ML"  Doc "the program's first tool change" "first operation" "first-tool-change"
    ToolChange        "ToolChange"        plain "ML"  "ML"  Doc "every later tool change" "operation with another `tool`" "tool-change-mill"
    RapidCode         "RapidCode"         plain "MLE" ""    Doc "a rapid move, instead of the generated block" "`rapid`" "rapid-code"
    LineCode          "LineCode"          plain "ML"  ""    Doc "a feed move, instead of the generated block" "`line`" "line-code"
    CwCode            "CwCode"            plain "MLE" ""    Doc "a clockwise arc, instead of the generated block" "`arc` cw" "cw-code"
    CcwCode           "CcwCode"           plain "MLE" ""    Doc "a counter-clockwise arc, instead of the generated block" "`arc` ccw" "ccw-code"
    InFeed            "InFeed"            plain "MLE" ""    Doc "the move into the part; it turns cutter compensation on" "`infeed`" "infeed"
    OutFeed           "OutFeed"           plain "MLE" ""    Doc "the move away from the part; it turns cutter compensation off" "`outfeed`" "outfeed"
    BeginLeadin       "BeginLeadin"       plain "MLE" ""    Doc "before the lead-in moves" "`begin` leadin" "sections"
    EndLeadin         "EndLeadin"         plain "MLE" ""    Doc "after the lead-in moves" "`end` leadin" "sections"
    BeginLeadout      "BeginLeadout"      plain "MLE" ""    Doc "before the lead-out moves" "`begin` leadout" "sections"
    EndLeadout        "EndLeadout"        plain "MLE" ""    Doc "after the lead-out moves" "`end` leadout" "sections"
    BeginPlunge       "BeginPlunge"       plain "MLE" ""    Doc "before the plunge moves" "`begin` plunge" "sections"
    EndPlunge         "EndPlunge"         plain "MLE" ""    Doc "after the plunge moves" "`end` plunge" "sections"
    BeginRetract      "BeginRetract"      plain "MLE" ""    Doc "before the retract moves" "`begin` retract" "sections"
    EndRetract        "EndRetract"        plain "MLE" ""    Doc "after the retract moves" "`end` retract" "sections"
    BeginSideStep     "BeginSideStep"     plain "MLE" ""    Doc "before the side step moves" "`begin` sidestep" "sections"
    EndSideStep       "EndSideStep"       plain "MLE" ""    Doc "after the side step moves" "`end` sidestep" "sections"
    BeginZLevel       "BeginZLevel"       plain "MLE" ""    Doc "before the moves of one Z level" "`begin` zlevel" "sections"
    EndZLevel         "EndZLevel"         plain "MLE" ""    Doc "after the moves of one Z level" "`end` zlevel" "sections"
    BeginRow          "BeginRow"          plain "M"   ""    Doc "before each pass of a pocket or surface cut" "`begin` row" "begin-row"
    EndRow            "EndRow"            plain "M"   ""    Doc "after each pass of a pocket or surface cut" "`end` row" "end-row"
    BeginCut          "BeginCut"          plain "M"   ""    Ours "before a cut: turns the torch or laser on, and pierces" "the first cut after a rapid" "plasma"
    EndCut            "EndCut"            plain "M"   ""    Ours "after a cut: turns the torch or laser off" "the rapid after a cut" "plasma"
    Index             "Index"             plain "M"   ""    Doc "instead of a rapid that turns a rotary axis" "`rapid` to another rotary angle" "index"
    Unwind            "Unwind"            plain "M"   ""    Doc "when a rotary axis would leave its travel" "a rotary angle beyond `Limits`" "unwind"
    SubStart          "SubStart"          plain "M"   ""    Doc "the beginning of a subprogram" "`subprograms`" "sub-start"
    SubEnd            "SubEnd"            plain "M"   ""    Doc "the end of a subprogram" "end of a subprogram" "sub-end"
    SubCall           "SubCall"           plain "M"   ""    Doc "the call of a subprogram" "`call`" "sub-call"
    Between           "Between"           plain "M"   ""    Doc "after the last subprogram, before the main program" "after the subprograms" "between"
    EdmCut            "EdmCut"            plain "E"   ""    Doc "cuts the wire" "`edm` cut" "wire"
    EdmThread         "EdmThread"         plain "E"   ""    Doc "threads the wire" "`edm` thread" "wire"
    EdmPreDrillThread "EdmPreDrillThread" plain "E"   ""    Doc "drills a start hole for the wire" "`edm` predrill" "wire"
    SubmergeTank      "SubmergeTank"      plain "E"   ""    Doc "fills the tank" "`edm` submerge" "wire"
    Stop              "Stop"              plain "MLE" ""    Doc "a program stop; also an optional stop if the form has no OptStop" "`stop`" "wire"
    OptStop           "OptStop"           plain "MLE" ""    Ours "an optional stop" "`stop` optional" "operations"
    DwellBlock        "DwellBlock"        plain "MLE" ""    Ours "a dwell outside cycles, instead of the generated block" "`dwell`" "operations"
    Operation         "Operation"         plain "ML"  ""    Ours "the beginning of an operation: after its tool change, before its first move" "operation" "operations"
    EndOperation      "EndOperation"      plain "ML"  ""    Ours "the end of an operation: after its last move" "end of an operation" "operations"
    CommentLine       "CommentLine"       plain "MLE" ""    Ours "a comment of the job ([text]), instead of the generated comment" "`comment`" "operations"
    MoveHome          "MoveHome"          plain "MLE" ""    Ours "the move to the machine's home position. The job gives no coordinates for this move" "`home`" "operations"
    AfterHome         "AfterHome"         plain "ML"  ""    Ours "the first rapid with a height after `MoveHome`. If the control ends the tool length offset at the machine zero, the sequence turns the offset on again" "the rapid after `home`" "after-home"
    WorkChange        "WorkChange"        plain "MLE" ""    Ours "a change of the work offset that no other sequence prints" "`work`" "operations"
    SpindleChange     "SpindleChange"     plain "ML"  ""    Ours "a change of the spindle speed or direction that no other sequence prints" "`spindle`" "operations"
    CoolantChange     "CoolantChange"     plain "MLE" ""    Ours "a change of the coolant that no other sequence prints" "`coolant`" "operations"
    FeedModeChange    "FeedModeChange"    plain "ML"  ""    Ours "a change of the feed mode that no other sequence prints" "`feed_mode`" "operations"
    AutoThread        "AutoThread"        cycle "L"   ""    Doc "the control's own threading cycle" "`thread`" "lathe-part"
    CanThread         "CanThread"         cycle "L"   ""    Doc "a threading cycle with one block per pass, instead of AutoThread" "`thread`" "can-thread"
    Back              "Back"              cycle "M"   ""    Doc "back boring" "`cycle` back" "back-machine"
    Bore              "Bore"              cycle "ML"  ""    Doc "boring: feed down, rapid out" "`cycle` bore" "bore-machine"
    Cancel            "Cancel"            cycle "ML"  ""    Doc "ends a machine cycle" "end of a cycle with `End Cancel`" "cancel-with"
    Chipbreak         "Chipbreak"         cycle "ML"  ""    Doc "pecking with short retracts that break the chip" "`cycle` chipbreak" "chipbreak-machine"
    Custom1           "Custom1"           cycle "ML"  ""    Doc "a machine cycle that has no sequence of its own" "`cycle` custom1, or the kind written after `Custom1`" "custom1-machine"
    Custom2           "Custom2"           cycle "ML"  ""    Doc "a machine cycle that has no sequence of its own" "`cycle` custom2, or the kind written after `Custom2`" "more-cycles"
    Custom3           "Custom3"           cycle "ML"  ""    Doc "a machine cycle that has no sequence of its own" "`cycle` custom3, or the kind written after `Custom3`" "more-cycles"
    Drill             "Drill"             cycle "ML"  ""    Doc "straight drilling" "`cycle` drill" "drill-machine"
    LTap              "LTap"              cycle "M"   ""    Doc "left-hand tapping" "`cycle` ltap" "ltap-machine"
    Peck              "Peck"              cycle "ML"  ""    Doc "deep drilling with full retracts; if the sequence contains only `None`, postform generates the moves" "`cycle` deep" "peck-machine"
    Ream              "Ream"              cycle "ML"  ""    Doc "reaming: feed down, feed out" "`cycle` ream" "more-cycles"
    Tap               "Tap"               cycle "ML"  ""    Ours "tapping. The manual lists this cycle, but its page about the cycle is not public" "`cycle` tap" "more-cycles"
}

impl SequenceId {
    /// The row of the sequence in the table.
    #[doc(hidden)]
    pub fn row(self) -> &'static Sequence {
        &SEQUENCES[self as usize]
    }

    /// Name of the sequence in forms.
    pub fn name(self) -> &'static str {
        self.row().name
    }

    /// Whether the sequence is a canned cycle for holes. `false` for Cancel and for threads.
    pub fn makes_holes(self) -> bool {
        self.row().is_cycle && !matches!(self, SequenceId::Cancel | SequenceId::AutoThread | SequenceId::CanThread)
    }

    /// Finds a sequence by its name; upper and lower case are equal. `Chip Break` is another name of Chipbreak.
    pub fn parse(name: &str) -> Option<SequenceId> {
        if name.eq_ignore_ascii_case("Chip Break") {
            return Some(SequenceId::Chipbreak);
        }
        SEQUENCES.iter().find(|s| s.name.eq_ignore_ascii_case(name)).map(|s| s.id)
    }
}

/// The name of a sequence on its name line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SequenceName<'a> {
    /// A named sequence, and the text after its name, such as a line count.
    Plain(SequenceId, Option<&'a str>),
    /// `Upon [var]`, with the name of the variable as written.
    Upon(&'a str),
    /// `Upon Every [var]`.
    UponEvery(&'a str),
}

impl<'a> SequenceName<'a> {
    /// Reads the words of a line. `None`: the words are not the name of a sequence.
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
