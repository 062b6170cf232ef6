//! Descriptions of controls. The descriptions come from the files in `controls/` or from a shop's own file.
//!
//! A file lists the codes of the control and their meanings, by the names of [`Meaning`]. The effect of each meaning is
//! defined in postform's source code. A value that is missing in a file is inherited from the control that the file
//! names with `like`.

mod arcs;
mod code;
mod file;
mod file_text;
mod hole;
mod key;
mod meaning;
mod runs;
mod shipped;
mod traits;
mod words;

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

pub use arcs::Tolerance;
pub use code::Code;
pub use file::Wrong;
pub use hole::Hole;
use key::Key;
pub use meaning::{AxisWords, Frame, GROUPS, Group, Meaning};
pub use runs::{Motions, Pitch, PitchUnit, Runs, StopsRotary, WorkOffset};
pub use shipped::names;
pub use traits::{
    Basic, Centres, DwellUnit, FeedWithoutPoint, Kept, Macros, Rules, ToolLength, Traits, Turns, WithoutPoint,
};
pub use words::Words;

/// The description of a control.
#[derive(Clone, Debug)]
pub struct Control {
    /// Name of the control, followed by the names of the controls that it inherits from.
    chain: Vec<String>,
    /// Title of the control.
    title: String,
    /// Facts about the control that are not public, one sentence each.
    unknown: Vec<String>,
    traits: Traits,
    rows: Rows,
}

/// The description of one code of a control.
#[derive(Clone, Debug)]
pub struct Row {
    /// The code; for a row with several codes, the first one.
    pub code: Code,
    /// Meaning of the code.
    pub meaning: Meaning,
    /// The letters of the words of the code, besides axes, F, S and T.
    pub words: Words,
    /// The kinds of holes that the code makes; empty if the code is not a canned cycle.
    pub makes: Vec<Hole>,
    /// The words for the pitch of a tap; empty: the pitch comes from the feed.
    pub pitch: Vec<Pitch>,
    /// A further description of the code.
    pub text: String,
    /// The reason why postform does not run the code although the meaning of the code is known.
    pub not_run: Option<String>,
    /// The words and values with which the code has this meaning; empty: the code has this meaning with any values.
    pub only: Vec<(u8, f64)>,
    /// Whether the control stops the spindle before it runs the code, as a Haas does for through-spindle coolant.
    pub stops_spindle: bool,
    /// Values that only the simulator uses.
    pub runs: Runs,
}

/// The rows of a control, found by code.
#[derive(Clone, Debug, Default)]
struct Rows {
    /// Rows of single codes, in the order of the codes.
    one: Vec<Row>,
    /// For each G code, by its number in tenths: the index of its row in `one`. Codes without a row have an index past the end.
    index: Vec<u16>,
    /// Rows for all codes with the same whole number.
    numbers: Vec<Row>,
    /// Rows for all other codes of a letter.
    others: Vec<Row>,
    /// The codes that the control does not have. The rows of `others` do not apply to these codes.
    absent: Vec<Key>,
}

impl Rows {
    fn put(&mut self, row: Row) {
        match self.one.binary_search_by_key(&row.code, |row| row.code) {
            Ok(at) => self.one[at] = row,
            Err(at) => self.one.insert(at, row),
        }
    }

    /// Builds `index`. Call this function after the last row is added.
    fn finish(&mut self) {
        let highest =
            self.one.iter().rfind(|row| row.code.letter == b'G').map_or(0, |row| usize::from(row.code.tenths) + 1);
        self.index = vec![u16::MAX; highest];
        for (at, row) in self.one.iter().enumerate().filter(|(_, row)| row.code.letter == b'G') {
            self.index[usize::from(row.code.tenths)] = at as u16;
        }
    }

    #[inline]
    fn own(&self, code: Code) -> Option<&Row> {
        match code.letter {
            b'G' => self.one.get(usize::from(*self.index.get(usize::from(code.tenths))?)),
            _ => self.one.binary_search_by_key(&code, |row| row.code).ok().map(|at| &self.one[at]),
        }
    }

    fn put_number(&mut self, row: Row) {
        let (letter, whole) = (row.code.letter, row.code.tenths / 10);
        self.absent.retain(|key| !key.is_within(letter, whole));
        replace(&mut self.numbers, row, |row| (row.code.letter, row.code.tenths));
    }

    fn put_others(&mut self, row: Row) {
        replace(&mut self.others, row, |row| (row.code.letter, 0));
    }
}

fn replace(rows: &mut Vec<Row>, row: Row, key: impl Fn(&Row) -> (u8, u16)) {
    match rows.iter_mut().find(|other| key(other) == key(&row)) {
        Some(other) => *other = row,
        None => rows.push(row),
    }
}

/// Whether the name of a control is the name of a control file.
pub fn is_file(name: &str) -> bool {
    name.len() > 5 && name.is_char_boundary(name.len() - 5) && name[name.len() - 5..].eq_ignore_ascii_case(".toml")
}

impl Control {
    /// Reads the text of a control file. `name` is used in messages.
    ///
    /// # Errors
    /// The file has an error, with its line and column.
    pub fn read(name: &str, text: &str) -> Result<Control, Wrong> {
        file::read(name, text, &like, 0)
    }

    /// Reads a shop's own control and keeps it until the process ends. Forms and programs use the name of this control
    /// like the names of the controls that come with postform. The same text is read only once.
    ///
    /// # Errors
    /// The file has an error, with its line and column.
    pub fn own(name: &str, text: &str) -> Result<&'static Control, Wrong> {
        static READ: Mutex<BTreeMap<String, &'static Control>> = Mutex::new(BTreeMap::new());
        let mut read = READ.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(control) = read.get(text) {
            return Ok(control);
        }
        let control: &'static Control = Box::leak(Box::new(Control::read(name, text)?));
        read.insert(text.to_owned(), control);
        Ok(control)
    }

    fn empty() -> Control {
        Control {
            chain: Vec::new(),
            title: String::new(),
            unknown: Vec::new(),
            traits: Traits::default(),
            rows: Rows::default(),
        }
    }

    /// The lathe control by the maker of this control, if the lathe control has a control file. Forms for lathes name
    /// the mill control.
    pub fn of_lathe(&'static self) -> &'static Control {
        let lathe = |name: &String| Control::named(&format!("{name}-lathe"));
        if self.is_lathe() { self } else { self.chain.iter().find_map(lathe).unwrap_or(self) }
    }

    /// Whether the control is for lathes.
    #[inline]
    pub fn is_lathe(&self) -> bool {
        self.traits.turns == Turns::Part
    }

    /// The wire EDM control by the maker of this control, if the wire EDM control has a control file. Forms for wire
    /// EDM machines name the mill control.
    pub fn of_wire(&'static self) -> &'static Control {
        let wire = |name: &String| Control::named(&format!("{name}-wire"));
        if self.is_wire() { self } else { self.chain.iter().find_map(wire).unwrap_or(self) }
    }

    /// Whether the control is for wire EDM machines.
    #[inline]
    pub fn is_wire(&self) -> bool {
        self.traits.turns == Turns::Nothing
    }

    /// The letters of the axes, in the order of a position.
    #[inline]
    pub fn axes(&self) -> &'static [u8; 6] {
        if self.is_wire() { b"XYUVAB" } else { b"XYZABC" }
    }

    /// Name of the control, as used in forms and options.
    pub fn name(&self) -> &str {
        self.chain.first().map_or("", String::as_str)
    }

    /// The names of the controls that this control inherits from, the nearest first.
    pub fn like(&self) -> impl Iterator<Item = &str> {
        self.chain.iter().skip(1).map(String::as_str)
    }

    /// Name of the control for use in messages.
    pub fn shown(&self) -> &str {
        if std::ptr::eq(self, Control::of_no_name()) { "most controls" } else { self.name() }
    }

    /// Title of the control, for people.
    pub fn title(&self) -> &str {
        &self.title
    }

    /// Facts about the control that are not public, one sentence each. Programs that depend on a fact are refused.
    pub fn unknown(&self) -> &[String] {
        &self.unknown
    }

    /// Whether the control has this name or inherits from the control with this name.
    pub fn is_like(&self, name: &str) -> bool {
        self.chain.iter().any(|other| other == name)
    }

    /// Properties of the control other than its codes.
    #[doc(hidden)]
    pub fn traits(&self) -> &Traits {
        &self.traits
    }

    /// The rules by which programs of the control are run.
    #[inline]
    #[doc(hidden)]
    pub fn rules(&self) -> Rules {
        self.traits.rules
    }

    /// The allowed deviations of the numbers of an arc from one circle, for programs in inches or in millimetres.
    #[doc(hidden)]
    pub fn arc_tolerance(&self, inch: bool) -> Tolerance {
        self.traits.arcs.tolerance(inch)
    }

    /// Whether the control reads words of this letter. True for all letters if the list of its letters is not public.
    pub fn reads(&self, letter: u8) -> bool {
        self.traits.letters == Words::NONE || self.traits.letters.has(letter)
    }

    /// The letters of the words that the control reads, as bits. All bits, if the list of its letters is not public.
    pub(crate) fn letters(&self) -> u32 {
        if self.traits.letters == Words::NONE { u32::MAX } else { self.traits.letters.bits() }
    }

    /// Whether the control has a code of this meaning.
    #[doc(hidden)]
    pub fn has(&self, meaning: Meaning) -> bool {
        self.rows().any(|row| row.meaning == meaning && self.is_there(row))
    }

    /// The control's first code of this meaning.
    #[doc(hidden)]
    pub fn first(&self, meaning: Meaning) -> Option<&Row> {
        self.rows().find(|row| row.meaning == meaning && self.is_there(row))
    }

    fn is_there(&self, row: &Row) -> bool {
        row.meaning != Meaning::Mist || !self.traits.no_mist
    }

    /// Whether the control runs programs like NIST's interpreter. LinuxCNC, its predecessors and Grbl are based on that
    /// interpreter.
    pub fn is_linuxcnc(&self) -> bool {
        self.traits.rules.is_nist()
    }

    /// Whether postform runs programs of the control. Programs are not run if the control's file has `rules = "none"`.
    pub fn is_run(&self) -> bool {
        self.traits.rules != Rules::None
    }

    /// Whether programs of the control consist of words (a letter and a number) with G codes. The codes of forms for
    /// other languages are not checked.
    pub fn prints_codes(&self) -> bool {
        !matches!(self.traits.rules, Rules::None | Rules::Klartext | Rules::Siemens)
    }

    /// Whether the code selects a work offset without another word, as G54 does. G54.1 needs a P word.
    pub fn selects_work(&self, code: Code) -> bool {
        let by_word = |row: &Row| matches!(row.runs.work, Some(WorkOffset::Word(_) | WorkOffset::Counted(_)));
        self.row(code).is_some_and(|row| row.meaning.group() == Some(Group::Work) && !by_word(row))
    }

    /// Whether the control's file lists all codes that select work offsets.
    pub fn lists_work(&self) -> bool {
        !matches!(self.traits.rules, Rules::None | Rules::Klartext)
    }

    /// The code of the work offset that is active before a program selects a work offset; `None`: the control has no
    /// such work offset, or it is unknown.
    pub fn first_work(&self) -> Option<f64> {
        let codes = matches!(self.traits.rules, Rules::Fanuc | Rules::Linuxcnc | Rules::Emc2 | Rules::Grbl);
        (codes && self.traits.work_letter.is_none()).then_some(54.0)
    }

    /// Whether the control selects work offsets by numbers from 1, not by codes.
    pub fn counts_work(&self) -> bool {
        matches!(self.first(Meaning::Work).and_then(|row| row.runs.work), Some(WorkOffset::Counted(_)))
    }

    /// The control's row for a code. The row of the code itself has priority, then the row of the code's whole number,
    /// then the row of the code's letter. `None`: the code is unknown.
    #[doc(hidden)]
    pub fn row(&self, code: Code) -> Option<&Row> {
        let rows = &self.rows;
        let other = || {
            if rows.absent.iter().any(|key| key.names(code)) {
                return None;
            }
            let is_of_number = |row: &&Row| row.code.letter == code.letter && row.code.tenths / 10 == code.tenths / 10;
            let number = rows.numbers.iter().find(is_of_number);
            number.or_else(|| rows.others.iter().find(|row| row.code.letter == code.letter))
        };
        rows.own(code).or_else(other).filter(|row| self.is_there(row))
    }

    /// Whether the control's file marks a code as absent.
    pub(crate) fn lacks(&self, code: Code) -> bool {
        self.rows.absent.iter().any(|key| key.names(code)) && self.row(code).is_none()
    }

    /// The meaning of a code on this control. `None`: the code is unknown.
    #[inline]
    #[doc(hidden)]
    pub fn meaning(&self, code: Code) -> Option<Meaning> {
        self.row(code).map(|row| row.meaning)
    }

    /// The modal group of a code on this control. `None`: the code has no group, or is unknown.
    #[inline]
    #[doc(hidden)]
    pub fn group(&self, code: Code) -> Option<Group> {
        self.meaning(code)?.group()
    }

    /// Whether a code calls a macro or subprogram. Unknown codes from G100 on count as calls: they may be macros of the
    /// machine builder.
    #[doc(hidden)]
    pub fn calls(&self, code: Code) -> bool {
        match self.meaning(code).filter(|&meaning| meaning != Meaning::Unsaid) {
            Some(meaning) => meaning.is_call(),
            None => code >= Code::g(100) && code.letter == b'G',
        }
    }

    /// Whether the control makes its own moves after a G code: in a cycle, in a thread whose feed follows from the
    /// pitch, or in a call.
    #[doc(hidden)]
    pub fn moves_by_itself(&self, code: Code) -> bool {
        code.letter == b'G' && (self.meaning(code).is_some_and(Meaning::moves_by_itself) || self.calls(code))
    }

    /// Whether the control makes its own moves after these codes: the last code that begins or ends such moves decides.
    #[doc(hidden)]
    pub fn leaves_cycle(&self, codes: impl IntoIterator<Item = Code>) -> bool {
        codes.into_iter().fold(false, |active, code| {
            self.moves_by_itself(code) || active && !self.meaning(code).is_some_and(Meaning::ends_cycle)
        })
    }

    /// Whether the control refuses a code. False if not all codes of the control are known.
    #[doc(hidden)]
    pub fn refuses(&self, code: Code) -> bool {
        self.traits.complete && self.row(code).is_none()
    }

    /// Rows of single codes, in the order of the codes.
    #[doc(hidden)]
    pub fn rows(&self) -> impl Iterator<Item = &Row> {
        self.rows.one.iter()
    }
}

/// Reads the control that a file names with `like`. The file of that control is read each time: control files are
/// short, and each chain is read only once.
fn like(name: &str, depth: usize) -> Option<Result<Control, Wrong>> {
    let (name, text) = shipped::FILES.iter().find(|(known, _)| *known == name)?;
    Some(file::read(name, text, &like, depth))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_file_that_ships_is_right() {
        for &(name, text) in shipped::FILES {
            let control = Control::read(name, text).unwrap_or_else(|wrong| panic!("{wrong}"));
            assert_eq!((control.name(), Control::named(name).map(Control::name)), (name, Some(name)));
            assert!(!control.title().is_empty() && control.rows().count() > 30);
        }
        assert!(Control::of_no_name().is_like("fanuc"));
    }

    #[test]
    fn a_shops_own_control_adds_to_another() {
        let own = Control::read(
            "vf2.toml",
            "name = \"vf2\"\nlike = \"haas\"\n[codes]\n\"G201\" = { is = \"harmless\", words = \"P\" }\n",
        )
        .unwrap();
        assert!(own.is_like("haas") && own.is_like("fanuc") && !own.is_like("linuxcnc"));
        let row = own.row("G201".parse().unwrap()).unwrap();
        assert_eq!((row.meaning, row.words), (Meaning::Harmless, Words::of("P")));
        assert_eq!(own.row("G81".parse().unwrap()).unwrap().meaning, Meaning::Cycle);
        assert!(own.row("G202".parse().unwrap()).is_none());
    }

    #[test]
    fn codes_that_a_control_has_not_and_many_at_once() {
        let text = "name = \"vf2\"\nlike = \"fanuc\"\n[codes]\n\"G87\" = { is = \"absent\" }\n\"M*\" = { is = \"absent\" }\n\"G110-G112\" = { is = \"work\" }\n";
        let own = Control::read("vf2.toml", text).unwrap();
        let meaning = |code: &str| own.meaning(code.parse().unwrap());
        assert_eq!([meaning("G87"), meaning("M3"), meaning("G109"), meaning("G113")], [None; 4]);
        assert_eq!(["G110", "G111", "G112"].map(meaning), [Some(Meaning::Work); 3]);
        assert_eq!(meaning("G86"), Some(Meaning::Cycle));
        for wrong in ["G112-G110", "G1-M3", "G1.5-G3"] {
            let text = format!("name = \"a\"\n[codes]\n\"{wrong}\" = {{ is = \"work\" }}\n");
            assert!(Control::read("a.toml", &text).unwrap_err().to_string().contains("is not a code"), "{wrong}");
        }
    }

    #[test]
    fn the_row_of_all_other_codes_gives_no_absent_code() {
        let text = "name = \"vf4\"\nlike = \"haas\"\n[codes]\n\"M8\" = { is = \"absent\" }\n\"M40-M42\" = { is = \"absent\" }\n\"M41\" = { is = \"harmless\" }\n";
        let own = Control::read("vf4.toml", text).unwrap();
        let meaning = |code: &str| own.meaning(code.parse().unwrap());
        assert_eq!(["M8", "M40", "M42"].map(meaning), [None; 3]);
        assert_eq!(["M41", "M43", "M199"].map(meaning), [Some(Meaning::Harmless); 3]);
        let text = "name = \"vf5\"\nlike = \"haas\"\n[codes]\n\"G231.*\" = { is = \"harmless\" }\n\"G231.2\" = { is = \"absent\" }\n";
        let own = Control::read("vf5.toml", text).unwrap();
        let meaning = |code: &str| own.meaning(code.parse().unwrap());
        assert_eq!(["G231.1", "G231.2"].map(meaning), [Some(Meaning::Harmless), None]);
    }

    #[test]
    fn a_text_is_read_once() {
        let text = "name = \"vf3\"\nlike = \"haas\"\n";
        let [one, two] = [(); 2].map(|()| Control::own("vf3.toml", text).unwrap());
        assert!(std::ptr::eq(one, two) && is_file("vf3.toml") && !is_file("haas") && !is_file(".toml"));
        assert!(Control::own("vf3.toml", "name = 3").is_err());
    }

    #[test]
    fn what_is_wrong_is_said_with_its_place() {
        let wrong = |text: &str| Control::read("my.toml", text).unwrap_err().to_string();
        assert!(wrong("name = 1").starts_with("my.toml:1:8: invalid type"), "{}", wrong("name = 1"));
        assert!(wrong("name = \"a\"\nlike = \"hass\"").contains("my.toml:2:8: there is no control `hass`"));
        assert!(wrong("name = \"a\"\nsize = 1").contains("my.toml:2:1: unknown field `size`"));
        let codes = |row: &str| wrong(&format!("name = \"a\"\nlike = \"haas\"\n[codes]\n{row}\n"));
        assert!(codes("\"X1\" = { is = \"work\" }").starts_with("my.toml:4:1: `X1` is not a code"));
        assert!(codes("\"G1.25\" = { is = \"work\" }").starts_with("my.toml:4:1: `G1.25` is not a code"));
        let near = codes("\"G154\" = { is = \"works\" }");
        assert!(
            near.starts_with("my.toml:4:17: `works` is not a meaning") && near.ends_with("did you mean `work`?"),
            "{near}"
        );
        assert!(codes("\"G154\" = { is = \"work\", words = \"P,\" }").contains("my.toml:4:33: `,` is not a letter"));
        assert!(
            codes("\"G154\" = { is = \"work\" }\n\"G154\" = { is = \"line\" }").starts_with("my.toml:5:"),
            "a code twice"
        );
    }
}
