//! The known facts about a control: as text for `explain`, as pages in docs/controls, and as a file to start from.

use indexmap::IndexMap;

use crate::control::{
    Centres, Code, Control, DwellUnit, FeedWithoutPoint, Kept, Macros, Row, Rules, StopsRotary, ToolLength, Traits,
    Turns, WithoutPoint, Words, WorkOffset, names,
};

/// The text for a fact that no public source states.
const UNKNOWN: &str = "not known";

/// The traits of a control, each with its name and its known value.
fn facts(control: &Control) -> Vec<(&'static str, String)> {
    let traits = control.traits();
    let kept = |kept: Kept| match kept {
        Kept::Yes => "stays on",
        Kept::No => "is reset or stops",
        Kept::Unknown => UNKNOWN,
    };
    let rules = match traits.rules {
        Rules::Fanuc => "as a Fanuc runs them",
        Rules::Linuxcnc => "as LinuxCNC runs them",
        Rules::Grbl => "as Grbl runs them",
        Rules::Emc2 => "as EMC2 runs them",
        Rules::Siemens => "as a Siemens 840D runs them",
        Rules::Klartext => "as a Heidenhain TNC runs them",
        Rules::Osp => "as an Okuma OSP runs them",
        Rules::None => "not run: postform does not read their language",
    };
    let line = match (traits.longest_line, traits.stops_at_longer) {
        (None, _) => UNKNOWN.to_owned(),
        (Some(line), true) => format!("{line} characters; the control stops at a longer line"),
        (Some(line), false) => format!("{line} characters; a sender cuts longer lines"),
    };
    let point = match traits.without_point {
        WithoutPoint::Unknown => UNKNOWN,
        WithoutPoint::Units => "inches or millimetres",
        WithoutPoint::LeastIncrement => "the smallest unit: 0.0001 inch, 0.001 mm",
    };
    let dwell = match traits.dwell {
        DwellUnit::Unknown => UNKNOWN,
        DwellUnit::Ms => "milliseconds",
        DwellUnit::S => "seconds",
        DwellUnit::ByPoint => "seconds with a point, milliseconds without one",
    };
    let centres = match traits.centres {
        Centres::Unknown => UNKNOWN,
        Centres::Incremental => "from the start of the arc",
        Centres::Absolute => "from the origin",
    };
    let length = match traits.tool_length {
        ToolLength::CodeAndRegister => "by G43 with H",
        ToolLength::Code if traits.zero_is_tool => {
            "by G43; G43 without H, or with H0, turns on the length of the tool in the spindle"
        }
        ToolLength::Code => "by G43; G43 without H turns on the length of the tool in the spindle, and H0 no length",
        ToolLength::Register => "by H alone",
        ToolLength::Tool => "by calling the tool or one of its edges",
        ToolLength::None => "never: the control has no tool lengths",
    };
    let others = match traits.complete {
        true => "refused",
        false => UNKNOWN,
    };
    let machine = match traits.turns {
        Turns::Tool => "a mill",
        Turns::Part => {
            "a lathe: X is a diameter, U and W are increments, and T changes the tool and its offset register"
        }
        Turns::Nothing => {
            "a wire EDM machine: X and Y are positions of the lower guide, U and V are positions of the upper guide"
        }
    };
    let mut facts = vec![
        ("programs", rules.to_owned()),
        ("type of machine", machine.to_owned()),
        ("longest block", line),
        ("M codes in a block", if traits.one_m { "one" } else { UNKNOWN }.to_owned()),
        ("small letters", if traits.small_letters { "read" } else { "may be refused" }.to_owned()),
        ("unit of a length without a point", point.to_owned()),
        ("unit of P of a dwell", dwell.to_owned()),
        ("I, J and K are measured", centres.to_owned()),
        ("the tool length offset is turned on", length.to_owned()),
        ("G91 that the previous program left on", kept(traits.modes_at_start).to_owned()),
        ("the spindle and the coolant at M0 and M1", kept(traits.spindle_at_stop).to_owned()),
        ("the coolant at a tool change", kept(traits.coolant_at_change).to_owned()),
        ("codes that are not listed", others.to_owned()),
    ];
    if traits.rules == Rules::Fanuc {
        facts.extend(facts_of_fanuc(traits).map(|(name, fact)| (name, fact.to_owned())));
        let no_point = letters(traits.no_point);
        facts.push(("letters that take no decimal point", if no_point.is_empty() { UNKNOWN.into() } else { no_point }));
    }
    facts
}

/// The traits that only controls with the rules of a Fanuc have.
fn facts_of_fanuc(traits: &Traits) -> [(&'static str, &'static str); 4] {
    let feed = match traits.feed_without_point {
        FeedWithoutPoint::Unknown => UNKNOWN,
        FeedWithoutPoint::Units => "the active units",
        FeedWithoutPoint::WholeMm => "mm per minute; with inches or per revolution a setting decides",
        FeedWithoutPoint::LeastIncrement => "the smallest unit, or whole units: a setting decides",
    };
    let expressions = match traits.macros {
        Macros::Fanuc => "those of Fanuc",
        Macros::Haas => "those of Haas",
        Macros::Linuxcnc => "those of LinuxCNC",
    };
    let semicolon = if traits.semicolon_ends_block { "ends the block" } else { "begins a comment" };
    let calls = match traits.repeats_in_p {
        Some(true) => "calls O1000 three times",
        Some(false) => "calls O31000",
        None => UNKNOWN,
    };
    [
        ("unit of a feed without a point", feed),
        ("expressions", expressions),
        ("a semicolon", semicolon),
        ("M98 P31000", calls),
    ]
}

fn letters(words: Words) -> String {
    (b'A'..=b'Z').filter(|letter| words.bits() & 1 << (letter - b'A') != 0).map(char::from).collect()
}

/// The meaning of a code in words.
fn about(row: &Row) -> String {
    let mut text = row.meaning.about().to_owned();
    if !row.makes.is_empty() {
        text += &format!(" ({})", row.makes.iter().map(|hole| hole.name()).collect::<Vec<_>>().join(", "));
    }
    if !row.text.is_empty() {
        text += &format!(": {}", row.text);
    }
    if let Some(motions) = row.runs.motions {
        let about = motions.about().trim_end_matches('.');
        text += &format!("; {}{}", about[..1].to_lowercase(), &about[1..]);
    }
    match row.runs.work {
        Some(WorkOffset::Additional(number)) => text += &format!("; the same offset as G54.1 P{number}"),
        Some(WorkOffset::Usual(usual)) if row.code.tenths != usual => {
            text += &format!("; the same offset as G{}", f64::from(usual) / 10.0);
        }
        _ => {}
    }
    if row.stops_spindle {
        text += "; the spindle stops";
    }
    text += match row.runs.rigid {
        None => "",
        Some(true) => "; the feed follows the spindle (rigid)",
        Some(false) => "; with a floating holder",
    };
    if row.runs.may_keep_length {
        text += "; a setting decides whether the active tool length counts";
    }
    text += match row.runs.stops_rotary {
        None => "",
        Some(StopsRotary::Moves) => "; not run with later moves of rotary axes",
        Some(StopsRotary::Feeds) => "; not run with later feed moves of rotary axes",
    };
    text += match row.runs.ends_length {
        0 => "",
        0b100 => "; a move along Z ends the tool length offset until the next code or register of a tool length",
        _ => "; ends the tool length offset until the next code or register of a tool length",
    };
    match &row.not_run {
        Some(why) => format!("{text}; not run: {why}"),
        None => text,
    }
}

/// The function of a code on a control, in words. `None`: the function is unknown on this control.
pub fn code(control: &Control, code: Code) -> Option<String> {
    control.row(code).map(about)
}

/// The functions of a code, each with the names of the controls that use the code for this function. `None`: no control
/// has the code.
pub fn on_each(code: Code) -> Option<String> {
    let mut functions: IndexMap<String, Vec<&str>> = IndexMap::new();
    for control in names().filter_map(Control::named).filter(|control| !control.refuses(code)) {
        if let Some(about) = self::code(control, code) {
            functions.entry(about).or_default().push(control.name());
        }
    }
    let rows = functions.iter().map(|(about, names)| format!("  {about}\n    on {}\n", names.join(", ")));
    let rows: String = rows.collect();
    (!rows.is_empty()).then(|| format!("{code} is a code of programs\n\n{rows}"))
}

/// The text that `postform explain haas` prints.
pub fn text(control: &Control) -> String {
    let mut text = format!("{} is the control {}\n\n", control.name(), control.title());
    let like: Vec<&str> = control.like().collect();
    if !like.is_empty() {
        text += &format!("  {:<36} {}\n", "based on", like.join(", "));
    }
    facts(control).iter().for_each(|(name, fact)| text += &format!("  {name:<36} {fact}\n"));
    control.unknown().iter().for_each(|fact| text += &format!("  {:<36} {fact}\n", "not known"));
    text += "\n";
    for row in control.rows() {
        text += &format!("  {:<8} {:<10} {}\n", row.code.to_string(), letters(row.words), about(row));
    }
    text
}

/// The text of docs/controls/NAME.md.
pub fn page(control: &Control) -> String {
    let mut text = format!(
        "# {}\n\n<!-- made from controls/{}.toml: `just overwrite` -->\n\nA form selects this control with the line `Control {1}`. A command selects this control with the option `--control {1}`.\n",
        control.title(),
        control.name()
    );
    text += "\n| | |\n| --- | --- |\n";
    facts(control).iter().for_each(|(name, fact)| text += &format!("| {name} | {fact} |\n"));
    control.unknown().iter().for_each(|fact| text += &format!("| not known | {fact} |\n"));
    text += "\n| code | words | means |\n| --- | --- | --- |\n";
    for row in control.rows() {
        text += &format!("| {} | {} | {} |\n", row.code, letters(row.words), about(row).replace('|', "\\|"));
    }
    text
}

/// The text of docs/controls/README.md, which lists all controls.
pub fn index() -> String {
    let mut text = String::from(
        "# Controls\n\n<!-- made from controls/*.toml: `just overwrite` -->\n\nEach control has a file. CONTRIBUTING.md \
         explains how to add a control, and `postform new --control-file NAME` prints a template of the file. `rules = \"none\"` is for a control without G codes: postform prints programs for this control, but checks no codes and proves no programs.\n\n| control | \
         title | codes | cycles |\n| --- | --- | --- | --- |\n",
    );
    for control in names().filter_map(Control::named) {
        let (codes, cycles) = counts(control);
        text += &format!("| [{0}]({0}.md) | {1} | {codes} | {cycles} |\n", control.name(), control.title());
    }
    text
}

/// The text that `postform controls` prints.
pub fn list() -> String {
    let mut text = String::new();
    for control in names().filter_map(Control::named) {
        let (codes, cycles) = counts(control);
        text += &format!("{:<10} {:<14} {codes:>3} codes, {cycles:>2} cycles\n", control.name(), control.title());
    }
    text
}

/// The number of codes, and the number of cycles among them, that postform can simulate for a control.
fn counts(control: &Control) -> (usize, usize) {
    let has = |row: &&Row| row.not_run.is_none() && !control.refuses(row.code);
    let cycles = control.rows().filter(has).filter(|row| row.meaning.is_cycle()).count();
    (control.rows().filter(has).count(), cycles)
}

/// A control file with comments, as a start for the file of a control that is similar to this control.
pub fn file(control: &Control) -> String {
    format!(
        "# A control file of your own. Put this file into the form's folder and write `Control my-control.toml` in the form. For simulate and
# verify, give `--control my-control.toml`. Values that are not in this file are those of {name}: `postform explain {name}`.
name = \"my-control\"
title = \"My machine\"
like = \"{name}\"

# For a control whose language postform does not read: postform prints programs, but checks no codes and proves no program.
# rules = \"none\"

# Differences other than codes: remove the first `#` of a line where your control differs.
# [dwell]
# P = \"s\"                          # unit of P of G4: s or ms
# [text]
# line = 80                          # longest block, in characters
# longer = \"stops\"                 # effect of a longer block: stops or cut
# small_letters = true               # the control reads words in small letters
# semicolon = \"comment\"            # `;` begins a comment, or ends the block: end-of-block
# [macros]
# language = \"fanuc\"               # expressions as on a Fanuc, on a Haas or on LinuxCNC: fanuc, haas, linuxcnc
# [subprograms]
# repeats_in_p = true                # M98 P31000 calls O1000 three times, not O31000; or false, or \"unknown\"
# [numbers]
# length_without_point = \"units\"   # units: X10 is 10 mm; least-increment: X10 is 0.01 mm
# feed_without_point = \"units\"     # units: F10 is 10 mm/min; whole-mm: not with inches; least-increment: as lengths
# no_point = \"MST\"                 # letters whose numbers have no decimal point: the control stops at M3.
# [start]
# modes = \"kept\"                   # a G91 or G20 of the previous program is kept or lost
# units = \"mm\"                     # Siemens: the machine's basic units, inch or mm; feeds have them after G70 and G71
# [stops]
# spindle = \"kept\"                 # spindle and coolant at M0 are kept or lost
# [arcs]
# centres = \"incremental\"          # I and J are measured from the start of the arc (incremental) or from zero (absolute)
# [tool]
# length = \"G43 H\"                 # the words that turn the tool length offset on: G43 H, G43, H or none

# The codes that differ. `is` is the meaning of a code; `words` are the letters that the code takes besides axes, F, S and T.
[codes]
# coolant through the spindle
# \"M88\" = {{ is = \"through\", stops_spindle = true }}
# a code of the builder that changes nothing in the program's motions
# \"G201\" = {{ is = \"harmless\", words = \"P\" }}
# also such a code; axis words in its block belong to a move (without beside_moves, postform does not prove such a block)
# \"G202\" = {{ is = \"harmless\", beside_moves = true }}
# a move to the machine zero that ends the tool length offset until the next G43 or H: along-z or always
# \"G28\" = {{ is = \"reference\", point = 1, ends_length = \"along-z\" }}
# a code that changes the moves of rotary axes (moves, or only feeds): such moves are not proven until another code ends it
# \"M126\" = {{ is = \"harmless\", stops_rotary = \"moves\" }}
# \"M127\" = {{ is = \"harmless\", ends = \"M126\" }}
# a code for machine positions with which the active tool length may count: such positions are not checked on a machine
# \"G53\" = {{ is = \"machine\", may_keep_length = true }}
# a code that calls a program of the builder: postform prints all positions again after the code, and does not prove the program
# \"G301\" = {{ is = \"macro\", words = \"PQ\" }}
# the spindles of a drill bank: M201 is tool 101, and each later code is the next tool
# \"M201-M206\" = {{ is = \"tool-number\", tool = 101 }}
# `G310-G319` means all of these codes, `G31.*` all codes with a decimal, `M*` all other M codes; `absent` removes a code of {name}

# The values of `is`:
{meanings}",
        name = control.name(),
        meanings = crate::control::Meaning::ALL
            .iter()
            .map(|meaning| format!("# {:<20} {}\n", meaning.name(), meaning.about()))
            .collect::<String>()
    )
}
