//! The rows of all commands. From these rows `lang` generates the vocabulary, and `sema` generates the settings.

/// Passes the rows of the table to the macro `$then`. A row has this form:
///
/// `Id "Name" (arguments) once|many (default) Standing {field of the settings} "meaning";`
///
/// The field is `{name: Type}` for a new field, `{= place}` for a part of an existing field, `{=> method}` for a method
/// of the settings that stores the arguments, or `{}` for no field. After the field, `if (..)` names the forms that use
/// the command. `eg "arguments"` gives an example if no form in the repository contains the command.
macro_rules! command_rows {
    ($then:ident) => {
        $then! {
            // the form and its machine
            Name "Name" (Text) once (of("")) Ours {name: String}
                "the post's name";
            Machine "Machine" (Choice(&["Mill", "Lathe", "EDM", "Torch", "Laser"])) once (of("Mill")) Ours {=> machine_word}
                "the type of machine; it decides which sequences and variables the form may use";
            Units "Units" (Choice(&["inch", "mm", "both"])) once (of("inch")) Ours {=> known_word}
                "units of the lengths in the form; if the job has different units, the form must print [unitmode]";
            Control "Control" (Words(1, 9, "the name of a control, such as `haas`, or a control file, such as `my-vf2.toml`"))
                once (of("").told("similar to fanuc")) Ours {control: Option<&'static Control>}
                "the control for which the programs are checked";
            MachineFile "MachineFile" (Words(1, 1, "a machine file, such as `vf2.toml`"))
                once (of("")) Ours {machine_file: Option<String>} eg "vf2.toml"
                "machine file, relative to the form's folder; the programs must keep the limits of this machine";
            // codes
            Rapid "Rapid" (Motion(1, 1)) once (of("G0")) Doc {rapid: Code}
                "motion word of generated rapids";
            Feed "Feed" (Motion(1, 1)) once (of("G1")) Doc {feed: Code}
                "motion word of generated feed moves";
            CW "CW" (Motion(1, 2)) once (of("G2")) Ours {=> clockwise}
                "motion word of generated clockwise arcs; an optional M code sets [direct] for a clockwise spindle";
            CCW "CCW" (Motion(1, 2)) once (of("G3")) Ours {=> counter_clockwise}
                "motion word of generated counter-clockwise arcs; an optional M code sets [direct] for a counter-clockwise spindle";
            FeedCode "FeedCode" (Letters(1, 1)) once (of("F")) Doc {feed_code: u8}
                "letter of generated feed words";
            SpeedCode "SpeedCode" (Letters(1, 1)) once (of("S")) Doc {speed_code: u8}
                "letter of generated speed words";
            FeedType "FeedType" (Codes('G', 2, 3)) once (of("94 95 93").lathe("98 99 93")) Ours {feed_type: [f64; 3]}
                "values of [feedtype]: per minute, per revolution, inverse time";
            SpeedType "SpeedType" (Codes('G', 2, 2)) once (of("96 97")) Ours {speed_type: [f64; 2]}
                "values of [speedtype]: constant surface speed, revolutions";
            Spindle "Spindle" (Codes('M', 3, 3)) once (of("3 4 5")) Ours {spindle: [f64; 3]}
                "values of [direct]: clockwise, counter-clockwise, off";
            Coolant "Coolant" (Codes('M', 2, 3)) once (of("8 9 7")) Doc {coolant: [f64; 3]}
                "values of [cool] and [coolantoff]: on, off, mist";
            CoolantKind "CoolantKind" (Words(2, 3, "a kind, its code and the code that ends it, as `through M88 M89`"))
                many (of("")) Ours {coolant_kinds: Vec<CoolantKind>} eg "through M88 M89"
                "values of [cool] and [coolantoff] for a further kind of coolant: through, air, mist or high";
            Flush "Flush" (Codes('M', 2, 3)) once (of("8 9 7")) Ours {flush: [f64; 3]} if (Printed(V::Flush))
                "values of [flush]: on, off, mist";
            CDC "CDC" (Codes('G', 3, 3)) once (of("41 42 40")) Ours {cdc: [f64; 3]}
                "values of [side]: left, right, off";
            CDCCode "CDCCode" (Letters(1, 1))
                once (of("D")) Ours {cdc_code: u8} if (Unless(&[S::InFeed], "InFeed prints the compensation"))
                "letter of the offset register, in generated moves that begin cutter compensation";
            Dwell "Dwell" (Words(2, 3, "code, letter, unit, as `G4 P s` or `G4 P ms`"))
                once (of("G4 P s")) Ours {dwell: DwellWord}
                "generated dwell block, and the unit of [dwell]: seconds or milliseconds";
            Orient "Orient" (Words(2, 2, "code and letter, as `M19 R`")) once (of("M19 R")) Ours {orient: (Code, u8)}
                "words of a generated block that orients the spindle";
            StopCode "StopCode" (Codes('M', 2, 2)) once (of("0 1")) Ours {stop_code: [f64; 2]}
                "values of [stop]: program stop, optional stop";
            LComp "LComp" (Number) once (of("0")) Ours {lcomp: f64} if (Printed(V::Lcomp))
                "if the job gives no length register for a tool, [lcomp] is the tool number plus this number";
            DComp "DComp" (Number) once (of("0")) Ours {dcomp: f64}
                "if the job gives no diameter register for a tool, [dcomp] is the tool number plus this number";
            Work "Work" (Codes('G', 1, 1)) once (of("54")) Ours {work: f64}
                "[work] of fixture 1; the next fixtures have the next numbers";
            WorkDefault "WorkDefault" (Codes('G', 1, 1)) once (of("54")) Ours {work_default: f64}
                "[work] of a job without a work offset";
            MoreWork "MoreWork" (Words(2, 4, "the first fixture of the range, the words of that fixture, and optionally a number that ends the range, as `7 G54.1 P1` or `7 G54.1 P1 48`"))
                many (of("")) Ours {more_work: Vec<MoreWork>} if (Printed(V::Work)) eg "7 G54.1 P1"
                "words that `G[work]` prints for the first fixture of the range; the last number of these words increases by 1 for each further fixture";
            IncAbs "Inc/Abs" (Codes('G', 2, 2)) once (of("91 90")) Ours {inc_abs: [f64; 2]}
                "values of [incmode]: incremental, absolute";
            InchMm "Inch/MM" (Codes('G', 2, 2)) once (of("20 21")) Ours {inch_mm: [f64; 2]} if (Printed(V::Unitmode))
                "values of [unitmode]: inch, millimetre";
            ReturnPlane "ReturnPlane" (Codes('G', 2, 2))
                once (of("99 98")) Ours {return_plane: [f64; 2]} if (Cycles(V::Retplane))
                "values of [retplane]: R level, initial level";
            // axes
            HCode "HCode" (Letters(1, 1)) once (of("X").lathe("Z")) Ours {= axes[0]}
                "letter of the first axis in generated moves";
            VCode "VCode" (Letters(1, 1)) once (of("Y").lathe("X")) Ours {= axes[1]}
                "letter of the second axis in generated moves";
            DCode "DCode" (Letters(1, 1)) once (of("Z").lathe("Y")) Ours {= axes[2]}
                "letter of the depth axis in generated moves";
            HCode2 "HCode2" (Letters(1, 1)) once (of("U")) Ours {= axes2[0]}
                "letter of the upper guide's first axis";
            VCode2 "VCode2" (Letters(1, 1)) once (of("V")) Ours {= axes2[1]}
                "letter of the upper guide's second axis";
            DCode2 "DCode2" (Letters(1, 1)) once (of("W")) Ours {= axes2[2]}
                "letter of the second depth axis";
            Ignore "Ignore" (Letters(1, 1)) once (of("")) Ours {=> ignored_axis} eg "Z"
                "axis of a torch or a laser; postform neither prints nor compares positions along this axis";
            ByDiameter "ByDiameter?" (Switch) once (of("N").lathe("Y")) Ours {by_diameter: bool}
                "with `Y`, X words are diameters";
            RevSigns "RevSigns" (Letters(1, 15)) many (of("")) Ours {rev_signs: Vec<u8>} if (Letter) eg "Z"
                "letters whose values are printed with the opposite sign";
            Incremental "Incremental?" (Switch) once (of("N")) Ours {incremental: bool}
                "with `Y`, generated moves are increments";
            // arcs
            CtrCode "CtrCode" (Words(1, 3, "letters, `I J K` or `R`"))
                once (of("I J K").lathe("K I")) Ours {centre: ArcCentre} if (Arcs)
                "words of arc centres";
            CtrCode180 "CtrCode>180" (Words(1, 3, "letters, `I J K` or `R`"))
                once (of("")) Ours {centre_over_180: Option<ArcCentre>} if (Arcs)
                "centre words of arcs over 180 degrees; `R` prints a negative radius";
            CtrCode360 "CtrCode360" (Words(1, 3, "letters, `I J K`"))
                once (of("")) Ours {=> centre_of_circles} if (Arcs)
                "centre words of full circles";
            CtrIncremental "CtrIncremental?" (Switch) once (of("Y")) Ours {centre_incremental: bool} if (Arcs)
                "with `Y`, arc centres are relative to the start of the arc; with `N`, arc centres are absolute";
            ByQuadrants "ByQuadrants?" (Switch) once (of("N")) Doc {by_quadrants: bool}
                "with `Y`, arcs are split at the quadrant lines";
            ArcPlane "ArcPlane" (Motion(1, 3)) once (of("17 18 19")) Ours {planes: Vec<Code>}
                "plane words; an arc in a plane without a word is printed as lines";
            Helical "Helical?" (Switch) once (of("Y")) Ours {helical: bool}
                "with `N`, arcs that also move along the tool axis are printed as lines";
            MinRad "MinRad" (Length) once (of("0.0005").mm("0.01")) Ours {min_radius: f64}
                "arcs with a smaller radius are printed as lines";
            MaxRad "MaxRad" (Length) once (of("999").mm("25000")) Ours {max_radius: f64}
                "arcs with a larger radius are printed as lines";
            Tolerance "Tolerance" (LengthAboveZero) once (of("0.0005").mm("0.01")) Ours {tolerance: f64}
                "largest distance between an arc and the lines that are printed instead of it";
            ArcWithLine "ArcWithLine?" (Switch) once (of("Y")) Ours {arc_with_line: bool}
                "with `Y`, an arc after a line leaves out its motion code if the same code is already active";
            ArcWithSame "ArcWithSame?" (Switch) once (of("Y")) Ours {arc_with_same: bool}
                "with `Y`, an arc after another arc in the same direction leaves out its motion code";
            CircDir "CircDir" (Words(2, 2, "the words for clockwise and counter-clockwise arcs, as `DR- DR+`"))
                once (of("")) Ours {circle_direction: Option<[String; 2]>} if (Arcs) eg "DR- DR+"
                "direction word at the end of an arc block";
            SecondCircle "2ndCircleCode" (Words(1, 9, "one word, as `M99`"))
                once (of("")) Doc {second_circle: Option<String>} if (Arcs)
                "splits an arc into two blocks; this word begins the second block, which contains the centre";
            // leaving out unchanged words
            Modality "Modality?" (Switch) once (of("Y")) Ours {modality: bool}
                "with `Y`, words that change nothing are left out";
            ModalLetters "ModalLetters" (Letters(1, 26))
                once (of("").told("axes, F and S")) Ours {modal_letters: Option<Vec<u8>>} if (Modal) eg "X Y Z F S"
                "modal letters; postform leaves out words with these letters if the words change nothing";
            ModalGs "ModalGs" (Codes('G', 1, 15))
                once (of("0 1 2 3 17 18 19")) Ours {modal_codes: Vec<control::Code>} if (Modal)
                "modal codes; postform leaves out these codes while they are active";
            Force "Force" (Letters(1, 15)) once (of("")) Ours {force: Vec<u8>} if (Modal) eg "X Y Z"
                "letters printed again after every tool change and every change from rapid to feed";
            // blocks and their text
            SequenceNumbers "Sequence#s" (Words(1, 3, "letter, start, step, as `N 10 10`; `-` prints numbers without a letter; `None` prints no block numbers; a missing start or step is 10"))
                once (of("None")) Ours {numbers: SequenceNumbers}
                "block numbers";
            First "First#?" (Switch) once (of("Y")) Ours {number_first: bool} if (Numbered)
                "with `Y`, the first block has a number";
            Last "Last#?" (Switch) once (of("Y")) Ours {number_last: bool} if (Numbered)
                "with `Y`, the last block has a number";
            SpacesSwitch "Spaces?" (Switch) once (of("Y")) Ours {blanks: bool}
                "with `Y`, postform prints a space between words";
            Spaces "Spaces" (Whole(1, 15)) once (of("")) Ours {columns: Vec<usize>} eg "8"
                "words begin at fixed columns; one number is the width of every word, two or more numbers are the columns of the words";
            LeadingZeros "Leading0s?" (Switch) once (of("N")) Ours {leading_zeros: bool}
                "with `Y`, postform prints 0.5 instead of .5";
            Eob "EOB" (Text) once (of("")) Ours {eob: String}
                "text at the end of every block";
            LineEnd "LineEnd" (Choice(&["lf", "crlf"])) once (of("lf")) Ours {line_end: LineEnd}
                "line end of the program";
            ProgramName "ProgramName" (Words(1, 1, "a name with variables, as `O[program#]` or `[progname]`"))
                once (of("")) Ours {program_name: ProgramName} eg "O[program#]"
                "file name of a program, if `--output` is a folder";
            Extension "Extension" (Words(1, 1, "letters and digits, as `mpf`"))
                once (of("nc")) Ours {extension: Extension} eg "mpf"
                "extension of a program's file, if `--output` is a folder";
            Comment "Comment" (Words(1, 2, "the mark that begins a comment and, if necessary, the mark that ends it"))
                once (of("( )")) Ours {comment: [String; 2]}
                "comment marks";
            UpperComments "UpperCaseComments?" (Switch) once (of("Y")) Ours {upper_comments: bool}
                "with `Y`, comments of the job are printed in capitals";
            Replace "Replace" (Words(2, 2, "old and new text, in quotes if they contain spaces"))
                many (of("")) Ours {replace: Vec<Replacement>} eg "\"M8 \" \"M88 \""
                "replaces a text in every printed block";
            Rename "Rename" (Letters(2, 2)) many (of("")) Ours {rename: Vec<(u8, u8)>} if (Letter)
                "prints the second letter instead of the first letter";
            Dummy "Dummy" (Letters(1, 15)) many (of("")) Ours {dummy: Vec<u8>} if (Letter) eg "Q"
                "prints the values of these letters without the letters";
            Mod "Mod" (Text) many (of("")) Ours {mod_text: Vec<String>}
                "text printed once at the start of the program (for old forms)";
            // questions and other forms
            Each "Each" (Words(1, 3, "variable, prompt in quotes, default"))
                many (of("")) Ours {= prompts} eg "val1 \"Height of the vise\" 2.5"
                "a prompted variable";
            Ask "Ask" (Words(1, 3, "variable, prompt in quotes, default"))
                many (of("")) Ours {= prompts} eg "val1 \"Height of the vise\" 2.5"
                "a prompted variable";
            Property "Property" (Words(3, 60, "a name, a kind, a default and a question"))
                many (of("")) Ours {properties: Vec<Property>} eg "through choice(off,on,high) off Coolant through the spindle"
                "a value with a name that the form chooses; postform.toml, the job or `--set` can give this value";
            Call "Call" (Text) many (of("")) Ours {} eg "common.inc"
                "includes another form of the same folder";
            CallMe "CallMe" (Text) many (of("")) Ours {} eg "common.inc"
                "includes another form of the same folder";
            // subprograms, tool changes, limits
            SubsFirst "Subs1st?" (Switch)
                once (of("N").told("Y with a Between sequence")) Ours {subs_first: bool} if (With(&[S::SubStart]))
                "with `Y`, subprograms are printed before the main program";
            RenumSubs "RenumSubs?" (Switch) once (of("Y")) Ours {renumber_subs: bool} if (With(&[S::SubStart]))
                "with `Y`, subprograms are numbered from 1";
            VRapid "VRapid" (Motion(1, 1)) once (of("")) Ours {depth_rapid: Option<Code>} eg "G0"
                "motion word of rapids along the depth axis; postform splits a rapid into a move along this axis and a move along the other axes";
            ZRestart "ZRestart?" (Switch) once (of("N")) Ours {restart_depth: bool}
                "with `Y`, the move after a tool change prints the depth again";
            RevTurret2 "RevTurret2?" (Switch) once (of("N")) Ours {reverse_turret_2: bool}
                "with `Y`, X has the opposite sign while [turret] is 2";
            Tools "Tools" (Text) many (of("")) Ours {}
                "a command of the original desktop product; it has no effect in postform";
            Drive "Drive" (Text) many (of("")) Ours {}
                "a command of the original desktop product; it has no effect in postform";
            WindowSize "WindowSize" (Text) many (of("")) Ours {}
                "a command of the original desktop product; it has no effect in postform";
            Limits "Limits" (Words(3, 3, "axis letter, least and greatest position, as `X -20 20`"))
                many (of("")) Ours {limits: Vec<TravelLimit>}
                "travel of an axis; if a rotary axis would leave its travel, the sequence Unwind is printed";
            // threads and cycles
            Thread "Thread" (Motion(1, 1))
                once (of(""))
                Doc {thread: Option<Code>}
                if (Unless(&[S::AutoThread, S::CanThread], "AutoThread or CanThread prints all threads")) eg "G33"
                "prints each threading pass with this code";
            ThreadPasses "ThreadPasses" (Choice(&["x", "full"])) once (of("x")) Ours {=> thread_passes} if (Threads)
                "with `x`, later passes print only X; with `full`, later passes print approach, cut, clear and return";
            CycleClear "CycleClear" (Length) once (of("").by_units("0.1", "3")) Ours {cycle_clear: Option<f64>}
                "clearance of a cycle, if the job gives no clearance";
            CycleStep "CycleStep" (Length) once (of("")) Ours {cycle_step: Option<f64>} eg "0.1"
                "peck of a cycle, if the job gives no peck";
            CycleMinStep "CycleMinStep" (Length) once (of("0")) Ours {cycle_min_step: f64}
                "smallest peck";
            CycleBack "CycleBack" (Words(2, 2, "`deep`, `chipbreak` or `thru`, then a length"))
                many (of("").by_units("deep 0.05, chipbreak 0.05, thru 0.05", "deep 1, chipbreak 1, thru 1"))
                Ours {=> cycle_back} eg "deep 0.05"
                "secondary clearance of a cycle, if the job gives no secondary clearance";
            CycleDwell "CycleDwell" (Length) once (of("0.5")) Ours {cycle_dwell: f64}
                "dwell of a facing cycle in seconds, if the job gives no dwell";
            CycleDwellAt "CycleDwellAt" (Words(1, 2, "`steps`, `retracts` or both"))
                once (of("")) Ours {=> cycle_dwell_at} eg "steps"
                "points at which a peck cycle dwells, in addition to the bottom";
            CycleOrient "CycleOrient" (Number) once (of("0")) Ours {cycle_orient: f64}
                "spindle angle for boring, in degrees";
            CycleJog "CycleJog" (Length) once (of("").by_units("0.02", "0.5")) Ours {cycle_jog: Option<f64>}
                "distance that a boring tool moves off the wall";
            CycleSinkClear "CycleSinkClear" (Length)
                once (of("").told("the clearance")) Ours {cycle_sink_clear: Option<f64>} eg "0.1"
                "clearance above the cone of a countersink";
            RigidTap "RigidTap?" (Switch) once (of("N")) Ours {rigid_tap: bool} if (With(&[S::Tap, S::LTap]))
                "with `Y`, the sequences Tap and LTap make rigid taps";
        }
    };
}

pub(crate) use command_rows;
