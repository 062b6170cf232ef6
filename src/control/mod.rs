//! What a control is, written once: a file of `controls/`, or a shop's own.
//!
//! A file says which codes the control has and what they mean, by the names of [`Meaning`]; what the meanings do is the
//! program's. What a file does not say is as in the control that it is `like`.

mod arcs;
mod code;
mod file;
mod file_text;
mod hole;
mod key;
mod meaning;
mod runs;
mod traits;
mod words;

use std::collections::BTreeMap;
use std::sync::{LazyLock, Mutex, PoisonError};

pub use arcs::Tolerance;
pub use code::Code;
pub use file::Wrong;
pub use hole::Hole;
pub use meaning::{AxisWords, Frame, GROUPS, Group, Meaning};
pub use runs::{Motions, Pitch, PitchUnit, Runs, WorkOffset};
pub use traits::{Centres, DwellUnit, Kept, Rules, ToolLength, Traits, Turns, WithoutPoint};
pub use words::Words;

/// A control.
#[derive(Clone, Debug)]
pub struct Control {
    /// Name of the control, then the names of those that it is like.
    chain: Vec<String>,
    /// Title of the control.
    title: String,
    /// What nothing public says of it, in sentences.
    unknown: Vec<String>,
    traits: Traits,
    rows: Rows,
}

/// What a control has of one code.
#[derive(Clone, Debug)]
pub struct Row {
    /// The code; of a row for many, the first.
    pub code: Code,
    /// What the code means.
    pub meaning: Meaning,
    /// The words that it takes besides axes, F, S and T.
    pub words: Words,
    /// The holes that it makes; none: it is no canned cycle.
    pub makes: Vec<Hole>,
    /// The words that say the pitch of a tap; none: the feed says it.
    pub pitch: Vec<Pitch>,
    /// More about it.
    pub text: String,
    /// Why it can't be run, though its meaning is known.
    pub not_run: Option<String>,
    /// The words, with their values, beside one of which it has this meaning; none: beside any.
    pub only: Vec<(u8, f64)>,
    /// The control stops the spindle before it runs the code: coolant through the spindle of a Haas.
    pub stops_spindle: bool,
    /// What it says for the simulator alone.
    pub runs: Runs,
}

/// The rows of a control, found by code.
#[derive(Clone, Debug, Default)]
struct Rows {
    /// In the order of their codes.
    one: Vec<Row>,
    /// Where each G code is in `one`, by its tenths; past its end for those that have no row.
    index: Vec<u16>,
    /// For all codes of a number.
    numbers: Vec<Row>,
    /// For all others of a letter.
    others: Vec<Row>,
}

impl Rows {
    fn put(&mut self, row: Row) {
        match self.one.binary_search_by_key(&row.code, |row| row.code) {
            Ok(at) => self.one[at] = row,
            Err(at) => self.one.insert(at, row),
        }
    }

    /// All rows are there.
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

macro_rules! shipped {
    ($($name:literal)*) => {
        /// Files that come with the program.
        const FILES: [(&str, &str); [$($name),*].len()] =
            [$(($name, include_str!(concat!("../../controls/", $name, ".toml")))),*];

        /// Controls of the files, read when they are asked for; a test reads them all.
        static CONTROLS: [LazyLock<Control>; FILES.len()] = [$(LazyLock::new(|| {
            let text = include_str!(concat!("../../controls/", $name, ".toml"));
            Control::read($name, text).unwrap_or_else(|_| Control::empty())
        })),*];
    };
}

shipped! { "fanuc" "fanuc-lathe" "fanuc-wire" "haas" "haas-lathe" "fadal" "mazak" "brother" "centroid" "mitsubishi" "siemens" "siemens-iso" "heidenhain" "okuma" "linuxcnc" "emc2" "grbl" "grblhal" "fluidnc" "pathpilot" "mach3" }

/// Does a control's name mean a file that describes it?
pub fn is_file(name: &str) -> bool {
    name.len() > 5 && name.is_char_boundary(name.len() - 5) && name[name.len() - 5..].eq_ignore_ascii_case(".toml")
}

/// The names of the controls that come with the program.
pub fn names() -> impl Iterator<Item = &'static str> {
    FILES.iter().map(|(name, _)| *name)
}

fn nearest(name: &str, names: impl Iterator<Item = &'static str>) -> String {
    let names: Vec<&str> = names.collect();
    let near = names.iter().map(|&other| (strsim::damerau_levenshtein(name, other), other)).min();
    match near.filter(|(distance, _)| *distance <= 2 && name.len() < 64) {
        Some((_, near)) => format!("did you mean `{near}`?"),
        None => format!("one of {}", names.join(", ")),
    }
}

impl Control {
    /// The control of a name that comes with the program.
    pub fn named(name: &str) -> Option<&'static Control> {
        let at = FILES.iter().position(|(known, _)| *known == name)?;
        Some(&CONTROLS[at])
    }

    /// The control of programs that name none: a Fanuc mill.
    pub fn usual() -> &'static Control {
        &CONTROLS[0]
    }

    /// The control of forms that name none: a Fanuc mill that has the common codes of other controls, too. Programs are
    /// not run by it.
    pub fn of_no_name() -> &'static Control {
        static UNION: LazyLock<Control> = LazyLock::new(|| {
            let text = include_str!("../../controls/of-no-name.toml");
            Control::read("of-no-name", text).unwrap_or_else(|_| Control::empty())
        });
        &UNION
    }

    /// Reads the text of a control file; `name` is what messages call it.
    ///
    /// # Errors
    /// What is wrong, with its line and column.
    pub fn read(name: &str, text: &str) -> Result<Control, Wrong> {
        file::read(name, text, &like, 0)
    }

    /// A shop's own control, which is there until the program ends: forms and programs name it as they name those that
    /// ship. A text that was read before is not read again.
    ///
    /// # Errors
    /// What is wrong, with its line and column.
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

    /// The lathe of the same maker, where a file describes one: forms of lathes name it as they name the mill.
    pub fn of_lathe(&'static self) -> &'static Control {
        let lathe = |name: &String| Control::named(&format!("{name}-lathe"));
        if self.is_lathe() { self } else { self.chain.iter().find_map(lathe).unwrap_or(self) }
    }

    /// Is it a lathe's?
    #[inline]
    pub fn is_lathe(&self) -> bool {
        self.traits.turns == Turns::Part
    }

    /// The wire EDM machine of the same maker, where a file describes one: forms of such machines name it as they name the mill.
    pub fn of_wire(&'static self) -> &'static Control {
        let wire = |name: &String| Control::named(&format!("{name}-wire"));
        if self.is_wire() { self } else { self.chain.iter().find_map(wire).unwrap_or(self) }
    }

    /// Is it a wire EDM machine's?
    #[inline]
    pub fn is_wire(&self) -> bool {
        self.traits.turns == Turns::Nothing
    }

    /// The letters of its axes, in the order of a position.
    #[inline]
    pub fn axes(&self) -> &'static [u8; 6] {
        if self.is_wire() { b"XYUVAB" } else { b"XYZABC" }
    }

    /// Name of the control, as forms and options write it.
    pub fn name(&self) -> &str {
        self.chain.first().map_or("", String::as_str)
    }

    /// The names of those that it is like, the nearest first.
    pub fn like(&self) -> impl Iterator<Item = &str> {
        self.chain.iter().skip(1).map(String::as_str)
    }

    /// As messages name it.
    pub fn shown(&self) -> &str {
        if std::ptr::eq(self, Control::of_no_name()) { "most controls" } else { self.name() }
    }

    /// Title of the control, for people.
    pub fn title(&self) -> &str {
        &self.title
    }

    /// What nothing public says of it, in sentences: a program that depends on it is refused.
    pub fn unknown(&self) -> &[String] {
        &self.unknown
    }

    /// Is it this control, or like it?
    pub fn is_like(&self, name: &str) -> bool {
        self.chain.iter().any(|other| other == name)
    }

    /// What the control is besides its codes.
    #[doc(hidden)]
    pub fn traits(&self) -> &Traits {
        &self.traits
    }

    /// By whose rules its programs are run.
    #[inline]
    #[doc(hidden)]
    pub fn rules(&self) -> Rules {
        self.traits.rules
    }

    /// How far an arc's numbers may be from one circle, in programs in inches or in millimetres.
    #[doc(hidden)]
    pub fn arc_tolerance(&self, inch: bool) -> Tolerance {
        self.traits.arcs.tolerance(inch)
    }

    /// Does it read words of this letter, as far as anything public says?
    pub fn reads(&self, letter: u8) -> bool {
        self.traits.letters == Words::NONE || self.traits.letters.has(letter)
    }

    /// Has it a code of this meaning?
    #[doc(hidden)]
    pub fn has(&self, meaning: Meaning) -> bool {
        self.rows().any(|row| row.meaning == meaning && self.is_there(row))
    }

    /// Its first code of this meaning.
    #[doc(hidden)]
    pub fn first(&self, meaning: Meaning) -> Option<&Row> {
        self.rows().find(|row| row.meaning == meaning && self.is_there(row))
    }

    fn is_there(&self, row: &Row) -> bool {
        row.meaning != Meaning::Mist || !self.traits.no_mist
    }

    /// Does it run programs as NIST's interpreter does, from which LinuxCNC, its predecessors and Grbl come?
    pub fn is_linuxcnc(&self) -> bool {
        self.traits.rules.is_nist()
    }

    /// Are its programs run? Not where its file has `rules = "none"`.
    pub fn is_run(&self) -> bool {
        self.traits.rules != Rules::None
    }

    /// Are its programs words of letters with numbers, G codes among them? Forms of another language print what they say: no
    /// rule of codes looks at them.
    pub fn prints_codes(&self) -> bool {
        !matches!(self.traits.rules, Rules::None | Rules::Klartext | Rules::Siemens)
    }

    /// The work offset before a program says one, by its code; `None`: there is none, or which one is unknown.
    pub fn first_work(&self) -> Option<f64> {
        let codes = matches!(self.traits.rules, Rules::Fanuc | Rules::Linuxcnc | Rules::Emc2 | Rules::Grbl);
        (codes && self.traits.work_letter.is_none()).then_some(54.0)
    }

    /// What the control knows of a code: the code's own row, else the row of its whole number, else the row of its
    /// letter. `None`: nobody knows.
    #[doc(hidden)]
    pub fn row(&self, code: Code) -> Option<&Row> {
        let rows = &self.rows;
        rows.own(code)
            .or_else(|| {
                rows.numbers
                    .iter()
                    .find(|row| row.code.letter == code.letter && row.code.tenths / 10 == code.tenths / 10)
            })
            .or_else(|| rows.others.iter().find(|row| row.code.letter == code.letter))
            .filter(|row| self.is_there(row))
    }

    /// What a code means on it. `None`: nobody knows.
    #[inline]
    #[doc(hidden)]
    pub fn meaning(&self, code: Code) -> Option<Meaning> {
        self.row(code).map(|row| row.meaning)
    }

    /// The modal group of a code on it. `None`: the code is of none, or nobody knows it.
    #[inline]
    #[doc(hidden)]
    pub fn group(&self, code: Code) -> Option<Group> {
        self.meaning(code)?.group()
    }

    /// Does a code call what is written elsewhere? Of those that nobody knows, the machine builder's may: from G100 on.
    #[doc(hidden)]
    pub fn calls(&self, code: Code) -> bool {
        match self.meaning(code).filter(|&meaning| meaning != Meaning::Unsaid) {
            Some(meaning) => meaning.is_call(),
            None => code >= Code::g(100) && code.letter == b'G',
        }
    }

    /// Does it move by itself after a G code: in a cycle, in a thread, which it feeds by its pitch, in what it calls?
    #[doc(hidden)]
    pub fn moves_by_itself(&self, code: Code) -> bool {
        code.letter == b'G' && (self.meaning(code).is_some_and(Meaning::moves_by_itself) || self.calls(code))
    }

    /// Is it known to refuse a code?
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

/// The control that a file is like, read again: files are short, and a chain is read once.
fn like(name: &str, depth: usize) -> Option<Result<Control, Wrong>> {
    let (name, text) = FILES.iter().find(|(known, _)| *known == name)?;
    Some(file::read(name, text, &like, depth))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_file_that_ships_is_right() {
        for (name, text) in FILES {
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
            assert!(Control::read("a.toml", &text).unwrap_err().to_string().contains("is no code"), "{wrong}");
        }
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
        assert!(codes("\"X1\" = { is = \"work\" }").starts_with("my.toml:4:1: `X1` is no code"));
        assert!(codes("\"G1.25\" = { is = \"work\" }").starts_with("my.toml:4:1: `G1.25` is no code"));
        let near = codes("\"G154\" = { is = \"works\" }");
        assert!(
            near.starts_with("my.toml:4:17: `works` is no meaning") && near.ends_with("did you mean `work`?"),
            "{near}"
        );
        assert!(codes("\"G154\" = { is = \"work\", words = \"P,\" }").contains("my.toml:4:33: `,` is no letter"));
        assert!(
            codes("\"G154\" = { is = \"work\" }\n\"G154\" = { is = \"line\" }").starts_with("my.toml:5:"),
            "a code twice"
        );
    }
}
