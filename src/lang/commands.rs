//! The table of commands.

use super::Standing::{self, Doc, Ours};

/// What a command takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Args {
    /// The rest of the line.
    Text,
    /// `Y` or `N`.
    Switch,
    /// From so many to so many codes, `G0`, `M19` or plain numbers.
    Codes(u8, u8),
    /// From so many to so many letters.
    Letters(u8, u8),
    /// From so many to so many numbers.
    Numbers(u8, u8),
    /// One of these words.
    Choice(&'static [&'static str]),
    /// Words that the command reads itself, as described.
    Words(&'static str),
}

/// One row of the table.
#[derive(Debug)]
pub struct Command {
    /// Which.
    pub id: CommandId,
    /// As forms write it.
    pub name: &'static str,
    /// What it takes.
    pub args: Args,
    /// May it stand more than once?
    pub repeats: bool,
    /// What holds without it.
    pub default: &'static str,
    /// Where its meaning comes from.
    pub standing: Standing,
    /// What it does.
    pub meaning: &'static str,
}

macro_rules! commands {
    ($($id:ident $name:literal ($args:expr) $times:ident $default:literal $standing:ident $meaning:literal)*) => {
        /// A command.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[repr(u8)]
        pub enum CommandId { $(#[doc = $meaning] $id),* }

        /// All commands.
        pub const COMMANDS: &[Command] = &[$(Command {
            id: CommandId::$id,
            name: $name,
            args: $args,
            repeats: commands!(@$times),
            default: $default,
            standing: $standing,
            meaning: $meaning,
        }),*];
    };
    (@once) => { false };
    (@many) => { true };
}

use Args::{Choice, Codes, Letters, Numbers, Switch, Text, Words};

#[rustfmt::skip]
commands! {
    Name             "Name"             (Text)              once "" Ours "the post's name"
    Machine          "Machine"          (Choice(&["Mill", "Lathe", "EDM"])) once "Mill" Ours "what the form is for; decides which sequences and variables it may use"
    Units            "Units"            (Choice(&["inch", "mm", "both"])) once "inch" Ours "units of the form's own lengths; a job in other units needs a printed [unitmode]"
    Control          "Control"          (Choice(&["fanuc", "haas", "fadal", "linuxcnc", "emc2", "grbl"])) once "fanuc" Ours "the control that the programs are checked for"
    Rapid            "Rapid"            (Codes(1, 1))       once "G0" Doc "motion word of generated rapids"
    Feed             "Feed"             (Codes(1, 1))       once "G1" Doc "motion word of generated feed moves"
    CW               "CW"               (Codes(1, 2))       once "G2" Ours "motion word of generated clockwise arcs; an M code behind it is [direct]'s"
    CCW              "CCW"              (Codes(1, 2))       once "G3" Ours "motion word of generated counter-clockwise arcs; an M code behind it is [direct]'s"
    FeedCode         "FeedCode"         (Letters(1, 1))     once "F" Doc "letter of generated feed words"
    SpeedCode        "SpeedCode"        (Letters(1, 1))     once "S" Doc "letter of generated speed words"
    FeedType         "FeedType"         (Codes(2, 3))       once "94 95 93; lathe 98 99" Ours "values of [feedtype]: per minute, per revolution, inverse time"
    SpeedType        "SpeedType"        (Codes(2, 2))       once "96 97" Ours "values of [speedtype]: constant surface speed, revolutions"
    Spindle          "Spindle"          (Codes(3, 3))       once "3 4 5" Ours "values of [direct]: clockwise, counter-clockwise, off"
    Coolant          "Coolant"          (Codes(2, 3))       once "8 9 7" Doc "values of [cool] and [coolantoff]: on, off, mist"
    Flush            "Flush"            (Codes(2, 3))       once "8 9 7" Ours "values of [flush]: on, off, mist"
    CDC              "CDC"              (Codes(3, 3))       once "41 42 40" Ours "values of [side]: left, right, off"
    CDCCode          "CDCCode"          (Letters(1, 1))     once "D" Ours "offset letter of generated compensation moves"
    Dwell            "Dwell"            (Words("code letter unit, as `G4 P s` or `G4 P ms`")) once "G4 P s" Ours "generated dwell block, and the unit of [dwell]: seconds or milliseconds"
    Orient           "Orient"           (Words("code and letter, as `M19 R`")) once "M19 R" Ours "spindle orientation"
    StopCode         "StopCode"         (Codes(2, 2))       once "0 1" Ours "values of [stop]: program stop, optional stop"
    LComp            "LComp"            (Numbers(1, 1))     once "0" Ours "[lcomp] is the tool's own register, else tool number + this"
    DComp            "DComp"            (Numbers(1, 1))     once "0" Ours "[dcomp] is the tool's own register, else tool number + this"
    Work             "Work"             (Codes(1, 1))       once "54" Ours "[work] of fixture 1; later fixtures count up from it"
    WorkDefault      "WorkDefault"      (Codes(1, 1))       once "54" Ours "[work] when a job names none"
    IncAbs           "Inc/Abs"          (Codes(2, 2))       once "91 90" Ours "values of [incmode]"
    InchMm           "Inch/MM"          (Codes(2, 2))       once "20 21" Ours "values of [unitmode]"
    ReturnPlane      "ReturnPlane"      (Codes(2, 2))       once "99 98" Ours "values of [retplane]: R level, initial level"
    HCode            "HCode"            (Letters(1, 1))     once "X; lathe Z" Ours "letter of the first axis in generated moves"
    VCode            "VCode"            (Letters(1, 1))     once "Y; lathe X" Ours "letter of the second axis in generated moves"
    DCode            "DCode"            (Letters(1, 1))     once "Z" Ours "letter of the depth axis in generated moves"
    HCode2           "HCode2"           (Letters(1, 1))     once "U" Ours "letter of the upper guide's first axis"
    VCode2           "VCode2"           (Letters(1, 1))     once "V" Ours "letter of the upper guide's second axis"
    DCode2           "DCode2"           (Letters(1, 1))     once "W" Ours "letter of the second depth axis"
    ByDiameter       "ByDiameter?"      (Switch)            once "N; lathe Y" Ours "X as a diameter"
    RevSigns         "RevSigns"         (Letters(1, 15))    many "" Ours "letters printed with the sign reversed"
    Incremental      "Incremental?"     (Switch)            once "N" Ours "generated moves in increments"
    CtrCode          "CtrCode"          (Words("letters, `I J K` or `R`")) once "I J K" Ours "arc centre words"
    CtrCode180       "CtrCode>180"      (Words("letters, `I J K` or `R`")) once "" Ours "centre words of arcs over 180 degrees; `R` prints the radius negative"
    CtrCode360       "CtrCode360"       (Words("letters, `I J K`")) once "" Ours "centre words of full circles"
    CtrIncremental   "CtrIncremental?"  (Switch)            once "Y" Ours "arc centres relative to the start, else absolute"
    ByQuadrants      "ByQuadrants?"     (Switch)            once "N" Doc "split arcs at the quadrant lines"
    ArcPlane         "ArcPlane"         (Codes(1, 3))       once "17 18 19" Ours "plane words; an arc outside the planes given is linearised"
    Helical          "Helical?"         (Switch)            once "Y" Ours "arcs may move along the tool axis, else they are linearised"
    MinRad           "MinRad"           (Numbers(1, 1))     once "0.0005; mm 0.01" Ours "smaller arcs are linearised"
    MaxRad           "MaxRad"           (Numbers(1, 1))     once "999; mm 25000" Ours "larger arcs are linearised"
    Tolerance        "Tolerance"        (Numbers(1, 1))     once "0.0005; mm 0.01" Ours "how far lines may leave a linearised arc"
    ArcWithLine      "ArcWithLine?"     (Switch)            once "Y" Ours "an arc after a line need not restate its motion code"
    ArcWithSame      "ArcWithSame?"     (Switch)            once "Y" Ours "an arc after a like arc need not restate its motion code"
    CircDir          "CircDir"          (Words("two words, clockwise and counter-clockwise, as `DR- DR+`")) once "" Ours "direction word at the end of an arc block"
    SecondCircle     "2ndCircleCode"    (Words("one word, as `M99`")) once "" Doc "word that opens a second arc line, which holds the centre"
    Modality         "Modality?"        (Switch)            once "Y" Ours "drop words that change nothing"
    ModalLetters     "ModalLetters"     (Letters(1, 26))    once "axes F S" Ours "letters that may be dropped"
    ModalGs          "ModalGs"          (Codes(1, 15))      once "0 1 2 3 17 18 19" Ours "codes that may be dropped"
    Force            "Force"            (Letters(1, 15))    once "" Ours "letters printed again after every tool change and every change from rapid to feed"
    SequenceNumbers  "Sequence#s"       (Words("letter start step, as `N 10 10`, or `None`")) once "None" Ours "block numbers"
    First            "First#?"          (Switch)            once "Y" Ours "number the first block"
    Last             "Last#?"           (Switch)            once "Y" Ours "number the last block"
    SpacesSwitch     "Spaces?"          (Switch)            once "Y" Ours "a blank between words"
    Spaces           "Spaces"           (Numbers(1, 15))    once "" Ours "fixed columns: one width for all, or the column of each word"
    LeadingZeros     "Leading0s?"       (Switch)            once "N" Ours "0.5 for .5"
    Eob              "EOB"              (Text)              once "" Ours "text at the end of every block"
    Comment          "Comment"          (Words("opening mark and, unless empty, closing mark")) once "( )" Ours "comment marks"
    UpperComments    "UpperCaseComments?" (Switch)          once "Y" Ours "comments of the job in capitals"
    Replace          "Replace"          (Words("old and new text, in quotes where they hold blanks")) many "" Ours "text replacement in every output block"
    Rename           "Rename"           (Letters(2, 2))     many "" Ours "prints the first letter as the second"
    Dummy            "Dummy"            (Letters(1, 15))    many "" Ours "prints the value of these letters without the letter"
    Mod              "Mod"              (Text)              many "" Ours "text printed once at the start (kept for old files)"
    Each             "Each"             (Words("variable, prompt in quotes, default")) many "" Ours "a prompted variable"
    Ask              "Ask"              (Words("variable, prompt in quotes, default")) many "" Ours "a prompted variable"
    Call             "Call"             (Text)              many "" Ours "includes another form of the same folder"
    CallMe           "CallMe"           (Text)              many "" Ours "includes another form of the same folder"
    SubsFirst        "Subs1st?"         (Switch)            once "N; with a Between Y" Ours "subprograms before the main program"
    RenumSubs        "RenumSubs?"       (Switch)            once "Y" Ours "number subprograms from 1"
    VRapid           "VRapid"           (Codes(1, 1))       once "" Ours "motion word of the depth part of a rapid, which is then split"
    ZRestart         "ZRestart?"        (Switch)            once "N" Ours "the move after a tool change prints the depth again"
    RevTurret2       "RevTurret2?"      (Switch)            once "N" Ours "X reversed while [turret] is 2"
    Tools            "Tools"            (Text)              many "" Ours "of the original desktop product: without effect"
    Drive            "Drive"            (Text)              many "" Ours "of the original desktop product: without effect"
    WindowSize       "WindowSize"       (Text)              many "" Ours "of the original desktop product: without effect"
    Limits           "Limits"           (Words("axis letter, least and greatest position, as `X -20 20`")) many "" Ours "travel of an axis; a rotary one's drives Unwind"
    Thread           "Thread"           (Codes(1, 1))       once "" Doc "print each threading pass with this code"
    ThreadPasses     "ThreadPasses"     (Choice(&["x", "full"])) once "x" Ours "later passes print X alone, or approach, cut, clear and return"
    CycleClear       "CycleClear"       (Numbers(1, 1))     once "0.1; mm 3" Ours "clearance of a cycle that names none"
    CycleStep        "CycleStep"        (Numbers(1, 1))     once "" Ours "peck of a cycle that names none"
    CycleMinStep     "CycleMinStep"     (Numbers(1, 1))     once "0" Ours "least peck"
    CycleBack        "CycleBack"        (Words("`deep`, `chipbreak` or `thru`, then a length")) many "0.05; mm 1" Ours "secondary clearance of a cycle that names none"
    CycleDwell       "CycleDwell"       (Numbers(1, 1))     once "0.5" Ours "dwell in seconds of a facing cycle that names none"
    CycleDwellAt     "CycleDwellAt"     (Words("`steps`, `retracts` or both")) once "" Ours "where else than at the bottom a peck cycle dwells"
    CycleOrient      "CycleOrient"      (Numbers(1, 1))     once "0" Ours "spindle angle for boring, degrees"
    CycleJog         "CycleJog"         (Numbers(1, 1))     once "0.02; mm 0.5" Ours "jog of a boring tool off the wall"
    CycleSinkClear   "CycleSinkClear"   (Numbers(1, 1))     once "the clearance" Ours "clearance above the cone of a countersink"
    RigidTap         "RigidTap?"        (Switch)            once "N" Ours "the Tap sequences are rigid"
}

impl CommandId {
    /// Its row of the table.
    pub fn row(self) -> &'static Command {
        &COMMANDS[self as usize]
    }

    /// As forms write it.
    pub fn name(self) -> &'static str {
        self.row().name
    }

    /// Finds a name in any case; the question mark of a switch may be left out where no other command has that name.
    pub fn parse(name: &str) -> Option<CommandId> {
        let find = |same: &dyn Fn(&str) -> bool| COMMANDS.iter().find(|c| same(c.name)).map(|c| c.id);
        find(&|own| own.eq_ignore_ascii_case(name))
            .or_else(|| find(&|own| own.strip_suffix('?').is_some_and(|own| own.eq_ignore_ascii_case(name))))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_is_found_and_unique() {
        for command in COMMANDS {
            assert_eq!(CommandId::parse(&command.name.to_lowercase()), Some(command.id));
        }
        assert_eq!(CommandId::parse("modality"), Some(CommandId::Modality));
        assert_eq!(CommandId::parse("Spaces"), Some(CommandId::Spaces));
    }
}
