//! The table of all codes. The meaning of a code never changes. The code of a removed row is never used again.

use super::Severity::{self, Error, Note, Warning};

/// A row of the table: a code, its severity and its title.
#[derive(Debug)]
pub struct CodeRow {
    /// The code of the row.
    pub code: Code,
    /// The code as printed, `PF101`.
    pub name: &'static str,
    /// Severity of the finding, before relaxed limits or a shop's levels change the severity.
    pub severity: Severity,
    /// The finding in a few words.
    pub title: &'static str,
}

macro_rules! codes {
    ($($name:ident $severity:ident $title:literal)*) => {
        /// A code of a finding: `PF` form, `PJ` job, `PI` NCI file, `PL` CL file, `PD` FreeCAD document, `PC` canned
        /// cycle, `PR` rendering, `PN` NC program, `PV` verify, `PM` machine, `PX` postform itself.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[repr(u16)]
        pub enum Code { $(#[doc = $title] $name),* }

        /// All codes in order.
        pub const CODES: &[CodeRow] =
            &[$(CodeRow { code: Code::$name, name: stringify!($name), severity: $severity, title: $title }),*];
    };
}

codes! {
    // PF0: structure
    PF001 Error "a line or word that can't be read"
    PF002 Error "a sequence without End"
    PF003 Warning "a command or letter format after the first sequence, or out of order"
    PF004 Error "a sequence that is defined twice"
    PF005 Error "a standard sequence is missing"
    PF006 Error "a command or letter format that is given twice"
    PF007 Error "End outside a sequence"
    PF008 Warning "the file is not UTF-8"
    PF009 Error "a called form that can't be included"
    PF010 Warning "a sequence that is never printed"
    PF011 Note "a command that changes nothing"
    PF012 Warning "a sequence without lines"
    PF013 Warning "StartCode moves an axis"
    PF014 Warning "EndCode without the end of the program"
    PF015 Warning "words after the end of the program"
    PF016 Note "one tape mark instead of two"
    PF017 Warning "a subprogram that does not return"
    PF018 Warning "a subprogram without its number"
    PF019 Error "a control's file that can't be read"
    PF020 Error "a command inside a sequence"
    PF021 Error "a machine's file that can't be read"
    // PF1: spaces and comments
    PF101 Warning "words lost after two spaces or a tab"
    PF102 Warning "a missing space between two words"
    PF103 Note "a tab"
    PF104 Warning "words lost in an open comment"
    PF105 Warning "a comment without its closing mark"
    PF106 Warning "a # that does not begin a comment"
    PF107 Note "a comment too close to a name"
    PF108 Warning "an `allow` comment that allows nothing"
    PF109 Warning "an `allow` comment that can't be read"
    PF110 Warning "a comment in marks that the control does not have"
    PF111 Warning "a comment inside a comment"
    PF112 Warning "a malformed word"
    // PF2: names
    PF201 Error "an unknown command or sequence"
    PF202 Error "an unknown variable"
    PF203 Note "a command without effect"
    PF204 Note "an older spelling"
    PF205 Warning "a variable without its brackets"
    PF206 Warning "a letter where a digit belongs"
    PF207 Warning "a Custom cycle for an unknown kind"
    PF208 Warning "a Custom cycle for a kind that has its own sequence"
    PF209 Warning "a prompt whose answer is not printed"
    PF210 Warning "an Upon for a variable that is not used"
    PF211 Warning "codes of a command in the wrong order"
    // PF3: numbers and letter formats
    PF301 Error "a bad letter format"
    PF302 Error "a bad command argument"
    PF303 Note "a letter without a format"
    PF304 Warning "a small letter in the program"
    PF305 Warning "a position without a sign"
    PF306 Warning "a format that cuts digits"
    PF307 Warning "an implied decimal point for numbers of several kinds"
    PF308 Warning "arc centres coarser than positions"
    PF309 Warning "a length written without a decimal point"
    PF310 Warning "a code that its format can't print"
    PF311 Warning "a dwell in the unit of another control"
    PF312 Warning "a replacement that can change numbers"
    PF313 Warning "a feed or speed letter that prints another value"
    PF314 Warning "a position under another axis's letter"
    PF315 Warning "a unit code that contradicts the form"
    PF316 Warning "a program without its unit code"
    PF317 Warning "an implied decimal point that is wrong for metric jobs"
    PF318 Warning "a whole number with a decimal point"
    // PF4: sequences and cycles
    PF401 Error "a count that is larger than the number of lines of the cycle"
    PF402 Error "End Cancel without a Cancel sequence"
    PF403 Warning "End Cancel on an emulated cycle"
    PF404 Warning "a sequence of several lines that starts a cycle of the control, but has no count"
    PF405 Error "a count or Cancel on a sequence that is not a canned cycle"
    PF406 Warning "a canned cycle that does not print the position"
    PF407 Warning "a canned cycle that does not print the depth"
    PF408 Warning "a count that leaves out the position of later holes"
    PF409 Warning "a machine cycle without Cancel"
    PF410 Warning "a Cancel without the code that ends the cycle"
    PF411 Warning "a machine cycle without its R plane"
    PF412 Warning "a machine cycle without its feed"
    PF413 Warning "a peck cycle without its peck"
    PF414 Warning "a cycle code of another cycle"
    PF415 Warning "a rapid to the bottom of the hole"
    PF416 Warning "a rapid to depth before the position"
    PF417 Warning "a cycle that ends in the hole"
    PF418 Warning "a feed move without a feed"
    PF419 Warning "a tap that feeds out without reversing the spindle"
    PF420 Warning "a rotary move without a retract"
    PF421 Warning "an Unwind that goes down before it positions"
    PF422 Warning "a reference return through a point of the part"
    PF423 Warning "a position printed while G91 is on"
    PF424 Warning "a sequence that leaves G91 on"
    PF425 Warning "G43 without H"
    PF426 Warning "H without G43"
    PF427 Warning "the spindle on before the tool change"
    PF428 Warning "coolant on too early"
    PF429 Warning "a tool change that changes no tool"
    PF430 Warning "a fixed work offset"
    PF431 Warning "an arc without its centre"
    PF432 Warning "an arc that turns in the opposite direction"
    PF433 Warning "a motion sequence that leaves out an axis"
    PF434 Warning "cutter compensation without its words"
    PF435 Warning "a rapid sequence that feeds"
    PF436 Warning "a cut without its motion code"
    PF437 Warning "a tool without its length"
    PF438 Warning "a position without a motion code"
    PF439 Warning "a distance among positions"
    PF440 Warning "a retract to the zero of the part"
    PF441 Warning "a tool that moves across before it retracts"
    PF442 Warning "a thread whose passes do not return"
    PF443 Warning "the program ends too early"
    PF444 Warning "a sequence that ends the tool length"
    PF445 Warning "a tool change without a retract"
    PF446 Warning "a rigid tap without its code"
    // PF5: modality
    PF501 Warning "a letter that is not modal, named as modal"
    PF502 Warning "a one-shot code, named as modal"
    PF503 Warning "a modal word that hides a changing depth"
    PF504 Warning "absolute positions among increments"
    PF505 Warning "two codes of one group in a block"
    PF506 Warning "a letter twice in a block"
    PF507 Warning "positions before G90"
    // PF6: limits and machine type
    PF601 Error "too many words on a line"
    PF602 Error "too many sequence lines"
    PF603 Error "a sequence that this type of machine does not have"
    PF604 Error "a variable that this type of machine does not have"
    PF605 Note "almost too many words on a line"
    PF606 Note "almost too many sequence lines"
    PF607 Warning "a code that the control does not have"
    PF608 Note "a code that is not described for the control"
    PF609 Warning "two M codes in a block, where the control takes one"
    // PF7: texts and conditions
    PF701 Error "a text of the job where no text is allowed"
    PF702 Error "an invalid width"
    PF703 Error "an expression that can't be read"
    PF704 Error "a value of the wrong kind"
    PF705 Error "a division by zero"
    PF706 Error "an unknown name of a value"
    PF707 Error "a directive in the wrong place"
    PF708 Warning "a condition that never changes"
    PF709 Error "a branch that does not fit its sequence"
    PF710 Warning "a property that does nothing"
    PF711 Warning "a list that prints nothing about its items"
    PF712 Warning "a kind of coolant that no sequence prints"
    PF713 Warning "a directive without its `@`"
    PF714 Warning "a pattern that is compared as plain text"
    PF715 Warning "a CommentLine that does not print the comment"
    PF716 Warning "a variable in backquotes"
    PF717 Warning "a number beside a length, in a form for both units"
    PF718 Note "a list that leaves out items without a text"
    PF719 Warning "a kind of coolant that no sequence turns off"
    // PJ: the job
    PJ001 Error "the job is not well-formed"
    PJ002 Error "an unknown key"
    PJ003 Error "a value of the wrong type or out of range"
    PJ004 Error "a key is missing"
    PJ005 Error "keys in a wrong order or combination"
    PJ006 Error "a tool that the job does not have"
    PJ007 Error "the job is incomplete"
    PJ008 Error "something after the end of the job"
    PJ009 Error "the job has no operations"
    PJ010 Error "a number that is given twice"
    PJ011 Error "a part of the job without its beginning or its end"
    PJ012 Error "tools in another order than `tool_order`"
    PJ013 Error "too many items before an operation's first move"
    PJ014 Error "jobs that can't be joined"
    // PD: the FreeCAD document
    PD001 Error "a file that is not a FreeCAD document"
    PD002 Error "a document without the requested job"
    PD003 Error "a path command that a job can't contain"
    PD004 Error "a document without data that a program needs"
    PD005 Warning "a part of a document that is left out"
    // PI: the NCI file
    PI001 Error "a line of an NCI file that can't be read"
    PI002 Error "an NCI file without data that a program needs"
    PI003 Error "a record of an NCI file that a job can't contain"
    PI004 Error "an NCI file that is incomplete"
    PI005 Warning "a text of an NCI file that is printed as it is"
    PI006 Warning "a value of an NCI file that is ignored"
    // PL: the CL file
    PL001 Error "a statement that can't be read"
    PL002 Error "an unknown minor word"
    PL003 Warning "an unknown major word"
    PL004 Error "a statement that postform does not support"
    PL005 Error "the file does not give its units"
    PL006 Error "a dialect that must be named"
    PL007 Error "the file is incomplete"
    PL008 Warning "a statement that is printed differently or left out"
    PL009 Error "a value that is missing in the file and in the options"
    // PC: canned cycles; each title begins with the name of the problem, which docs/cycles.md also uses
    PC001 Error "cycle.type.unknown: no such cycle"
    PC002 Error "cycle.depth.missing: the cycle has no depth"
    PC003 Error "cycle.depth.above_clear: the bottom is above the clearance plane"
    PC004 Error "cycle.depth.order: an absolute peck that is not deeper than the one before"
    PC005 Error "cycle.feed.missing: the cycle has no feed"
    PC006 Error "cycle.feed.nonpositive: a feed that is not above zero"
    PC007 Error "cycle.feed.multiple: two feeds, but the cycle takes one"
    PC008 Error "cycle.feed.tpi_only_tap: threads per inch in a cycle that is not a tap"
    PC009 Error "cycle.feed.no_spindle: a value per revolution, but the spindle does not turn"
    PC010 Error "cycle.clear2.not_allowed: a second clearance that the cycle does not have"
    PC011 Error "cycle.clear2.twice: the second clearance is given twice"
    PC012 Error "cycle.rapto.required: a back bore without the start of its upward cut"
    PC013 Error "cycle.rapto.beyond_depth: a rapid past the depth"
    PC014 Error "cycle.back.depth_below_rapto: a back bore that ends below its beginning"
    PC015 Error "cycle.bore.jog_without_orient: a jog at an unknown spindle angle"
    PC016 Error "cycle.option.exclusive: two options that exclude each other"
    PC017 Error "cycle.option.not_allowed: an option that this cycle does not have"
    PC018 Error "cycle.option.unknown: no such option"
    PC019 Error "cycle.option.duplicate: an option that is given twice"
    PC020 Error "cycle.multrd.rigid_only: several starts with a floating tap"
    PC021 Error "cycle.rigid.unavailable: a tap that only a cycle of the control can make"
    PC022 Error "cycle.thru.pairs: an even number of web depths, with a missing start or end"
    PC023 Error "cycle.thru.order: a web that is not deeper than the one before"
    PC024 Error "cycle.csink.diamet_missing: a countersink without diameter"
    PC025 Error "cycle.csink.tlangl_missing: a countersink without angle"
    PC026 Error "cycle.csink.angle_range: an angle that is not between 0 and 180 degrees"
    PC027 Error "cycle.csink.holdia: a hole not smaller than its countersink"
    PC028 Error "cycle.step.nonpositive: a step that is not above zero"
    PC029 Error "cycle.decr.exhausted: steps that become zero"
    PC030 Error "cycle.decr.absolute: shrinking steps without a step"
    PC031 Error "cycle.format.mixed: absolute pecks and steps in one cycle"
    PC032 Error "cycle.format.positional: numbers without their words"
    PC033 Error "cycle.value.missing: a word without its number"
    PC034 Error "cycle.value.count: too many numbers after a word"
    PC035 Error "cycle.value.sign: a number that can't be negative"
    PC036 Error "cycle.value.integer: a number that must be whole"
    PC037 Error "cycle.value.unexpected: a number that belongs to no word"
    PC038 Error "cycle.on.no_previous: CYCLE/ON without an earlier cycle"
    PC039 Error "cycle.auto.syntax: CYCLE/AUTO is ON or OFF"
    PC040 Error "cycle.return.syntax: a return plane that can't be read"
    PC041 Error "cycle.compensation: a cycle under cutter compensation"
    PC042 Error "cycle.arc: an arc inside a cycle"
    PC043 Error "cycle.tool_change: points of a cycle that a tool change ended"
    PC051 Warning "cycle.off_inactive: the end of a cycle that has not begun"
    PC052 Warning "cycle.fedrat_ignored: a feed inside a cycle"
    PC053 Warning "cycle.return.below_clear: a return plane below the clearance"
    PC054 Warning "cycle.tap.direction: a tap whose direction is opposite to the spindle's"
    PC055 Warning "cycle.minstp.unused: a least step without shrinking steps"
    PC056 Warning "cycle.null_parameter: two commas with no value between them"
    PC057 Warning "cycle.ratio.unused: a retract feed for a tap that does not feed out"
    PC058 Warning "cycle.from_inside: FROM inside a cycle"
    PC059 Warning "cycle.csink.printed: the countersink formula of the manual cuts too deep here"
    PC060 Warning "cycle.step.missing: pecks without a step"
    PC061 Warning "cycle.step.unused: a step for a tap that does not peck"
    // PR: rendering
    PR001 Error "a variable without a value"
    PR002 Error "a value that does not fit its letter's format"
    PR003 Error "a negative value for a letter without a sign"
    PR004 Error "a number that is not finite"
    PR005 Error "an arc whose positions, centre or radius are missing or do not fit"
    PR006 Error "a canned cycle that can't be made"
    PR007 Error "beyond a travel limit"
    PR008 Error "an item of the job that the machine or the form does not support"
    PR010 Error "units of job and form differ"
    PR011 Error "a move without a feed"
    PR012 Error "a path that begins with a cut"
    PR013 Warning "the return plane is not reached"
    PR014 Note "a cycle printed as single moves"
    PR015 Error "a prompted variable without an answer"
    PR016 Error "a setting that can't be used"
    PR017 Error "a change that the form can't print"
    PR021 Note "a value that the control takes from its own settings"
    PR022 Note "a rapid printed by a sequence that may feed"
    PR023 Warning "cutter compensation at the end"
    PR024 Note "an arc printed as lines"
    PR025 Warning "a feed or speed that its format rounds by more than 1 % (of a tap, by more than 0.25 %)"
    PR026 Note "a comment in several blocks"
    PR027 Error "a block that the control can't read"
    PR028 Error "a program that is far longer than its job"
    PR029 Warning "a thread at constant surface speed"
    PR030 Error "a move that is not allowed under cutter compensation"
    PR031 Error "a thread that can't be cut"
    PR032 Error "a spindle that does not turn"
    PR033 Error "a subprogram that can't be called here"
    PR034 Error "a call of a missing subprogram"
    PR035 Error "text that the control would act on"
    PR036 Error "a reversed axis that reverses arcs or offsets"
    PR037 Error "a work offset that has no code"
    PR038 Error "a limit of the spindle that is not printed"
    PR039 Error "an offset register that can't be used"
    PR040 Error "positions among increments, or increments among positions"
    PR041 Error "a code that changes how the control reads lengths"
    PR050 Note "a text of the job that is shortened, or printed with other characters"
    PR051 Error "a division by zero"
    PR052 Error "a value from later in the job is unknown"
    PR053 Error "a value that a property does not take"
    PR054 Error "a kind of coolant that the form does not have"
    PR055 Warning "a cut with the spindle off"
    PR056 Warning "a word of the form that the job overrides"
    PR057 Error "two tools with the same name for the control"
    PR058 Error "a path that a torch or a laser can't cut"
    PR059 Note "an axis that the form ignores"
    PR060 Error "an operation that can't be printed alone"
    PR061 Error "an operation that can't be put into one part of a job"
    // PN: NC programs
    PN001 Error "text that the control can't read"
    PN002 Error "a word that is given twice"
    PN003 Error "an unknown code"
    PN004 Error "two codes that exclude each other"
    PN005 Error "a word that no code in its block uses"
    PN006 Error "axis words without a motion, or a motion without axis words"
    PN007 Error "a word that is missing"
    PN008 Error "a feed move without a feed"
    PN009 Error "an arc whose positions, centre or radius are missing or do not fit"
    PN010 Error "a program without its end"
    PN011 Error "an R plane on the wrong side of the bottom"
    PN012 Error "a cycle with the wrong spindle direction"
    PN013 Error "a code that is not allowed while another code is active"
    PN014 Error "an expression or parameter without a value"
    PN015 Error "a subprogram or loop without an end or a beginning"
    PN016 Error "something that is not simulated"
    PN017 Error "a number without a point"
    PN018 Error "a value that makes no sense"
    PN030 Warning "R or depth of a cycle, written before a change of units, plane, or G90 and G91"
    PN031 Warning "a rapid that moves up and across at once"
    PN032 Warning "a peck shorter than the back-off"
    PN033 Warning "one P for two codes"
    PN034 Warning "a cycle that leaves the tool in the hole"
    PN035 Warning "a part of a program that the job changes or leaves out"
    PN036 Error "something that a job can't contain"
    PN037 Warning "a program without its end while the spindle turns"
    PN038 Warning "blocks with a slash"
    // PV: findings of verify
    PV001 Error "another motion"
    PV002 Error "a hole that is not drilled"
    PV003 Error "a hole that is drilled twice"
    PV004 Error "another bottom"
    PV005 Error "another clearance plane"
    PV006 Error "another feed"
    PV007 Error "a cut at rapid"
    PV008 Error "a rapid at feed"
    PV009 Error "a rapid too low"
    PV010 Error "another dwell"
    PV011 Error "another spindle"
    PV012 Error "another tool or work offset"
    PV013 Error "a canned cycle that is still active"
    PV014 Error "a tool without its length offset"
    PV015 Error "a program that its control refuses"
    PV016 Error "a cut that the job does not have"
    PV017 Error "a cut that is missing"
    PV018 Error "other cutter compensation"
    PV019 Error "a stop that is missing, or in the cut"
    PV020 Error "motions that can't be proven"
    PV021 Error "a moved coordinate frame"
    PV022 Error "units that are not given"
    PV023 Error "other pecks"
    PV024 Error "other coolant"
    PV025 Error "a code for the wire or the tank that differs from the job"
    PV026 Error "a cut with the torch or laser off"
    PV027 Error "a rapid with the torch or laser on"
    PV028 Error "a rapid at the height of the cuts"
    // PM: the machine
    PM001 Error "an axis beyond its travel"
    PM002 Error "a rapid through a fixture"
    PM003 Error "a rapid through the stock"
    PM010 Warning "a feed or speed that the machine does not have"
    PM011 Warning "a tool that the machine's table does not have"
    PM012 Warning "more tools than places in the magazine"
    PM013 Warning "a coolant that the machine does not have"
    PM014 Warning "a program that the control does not store"
    PM015 Warning "an offset or length that the machine's file does not contain"
    // PX: postform itself
    PX001 Error "an event that is impossible at this point"
}

impl Code {
    /// The row of the code in the table.
    pub fn row(self) -> &'static CodeRow {
        &CODES[self as usize]
    }

    /// The code as printed, `PF101`.
    pub fn name(self) -> &'static str {
        self.row().name
    }

    /// The name of a canned cycle's problem, such as `cycle.depth.missing`; empty for codes that don't begin with `PC`.
    pub fn key(self) -> &'static str {
        self.row().title.split_once(": ").map_or("", |(key, _)| key)
    }

    /// The code at the beginning of a message: `PF101`, `PC002 (cycle.depth.missing)`.
    pub fn title(self) -> String {
        if self.key().is_empty() { self.name().to_owned() } else { format!("{} ({})", self.name(), self.key()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_code_finds_its_own_row() {
        for (i, row) in CODES.iter().enumerate() {
            assert_eq!(row.code as usize, i);
            assert_eq!(row.code.row().name, row.name);
        }
    }
}
