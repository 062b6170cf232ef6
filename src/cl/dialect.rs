//! The CAM systems that write CL files, and the differences between their files.

use super::lines::text_statement;
use crate::suggest::did_you_mean;

/// The CAM system that wrote a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Dialect {
    Gener,
    Catia,
    Creo,
    Nx,
    SolidWorksCam,
    Makino,
    Ncl,
    Autodesk,
    Camplete,
}

/// Direction of a CIRCLE whose axis is positive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Sense {
    /// Clockwise, seen from the end of the axis (left-hand rule).
    LeftHand,
    /// Counter-clockwise.
    RightHand,
}

/// One row of the table of systems.
struct Row {
    dialect: Dialect,
    name: &'static str,
    title: &'static str,
    /// Texts that occur only in files of this system, in capitals and without spaces.
    marks: &'static [&'static str],
    sense: Option<Sense>,
    /// The last statement of the system's files.
    last: Option<&'static str>,
    /// Major words that only this system writes, and that have no effect on the program.
    without_effect: &'static [&'static str],
}

/// How the statement with the program's name begins in files of Autodesk.
const QUOTED_NAME: &str = "PARTNO/'";

/// The systems, with marks and directions taken from real files (docs/cl.md).
#[rustfmt::skip]
const ROWS: [Row; 9] = [
    Row { dialect: Dialect::Gener, name: "gener", title: "ICAM GENER", marks: &[], sense: None, last: Some("FINI"), without_effect: &[] },
    Row { dialect: Dialect::Catia, name: "catia", title: "CATIA", marks: &["$$*CATIA", "CATIAAPTVERSION"], sense: None, last: Some("FINI"), without_effect: &[] },
    Row { dialect: Dialect::Creo, name: "creo", title: "Creo", marks: &["PRO/CLFILE"], sense: None, last: Some("FINI"), without_effect: &[] },
    Row { dialect: Dialect::Nx, name: "nx", title: "Siemens NX", marks: &["TOOLPATH/"], sense: Some(Sense::LeftHand), last: Some("END-OF-PATH"), without_effect: &[] },
    Row { dialect: Dialect::SolidWorksCam, name: "solidworks", title: "SolidWorks CAM", marks: &["CSI_", "TRNTYP"], sense: Some(Sense::RightHand), last: Some("FINI"), without_effect: &[] },
    Row { dialect: Dialect::Makino, name: "makino", title: "Makino APTCL", marks: &["APTCL-SPEC"], sense: Some(Sense::LeftHand), last: None, without_effect: &[] },
    Row { dialect: Dialect::Ncl, name: "ncl", title: "NCL", marks: &["NCLCAM"], sense: None, last: Some("FINI"), without_effect: &[] },
    Row { dialect: Dialect::Autodesk, name: "autodesk", title: "Autodesk HSM", marks: &[], sense: None, last: Some("FINI"), without_effect: &[] },
    // UNDEFINED comes before expanded cycles; the post for MANUSnc writes the other words
    Row { dialect: Dialect::Camplete, name: "camplete", title: "Autodesk for CAMplete", marks: &["PPRINT/'MATRIXDEFINITION'"], sense: Some(Sense::LeftHand), last: Some("FINI"), without_effect: &["UNDEFINED", "START", "OPERATION", "MCS2"] },
];

impl Dialect {
    fn row(self) -> &'static Row {
        &ROWS[self as usize]
    }

    /// The name of the system for `--dialect`.
    pub fn name(self) -> &'static str {
        self.row().name
    }

    /// The name of the product.
    pub fn title(self) -> &'static str {
        self.row().title
    }

    /// The names of all systems for `--dialect`.
    pub fn names() -> impl Iterator<Item = &'static str> {
        ROWS.iter().map(|row| row.name)
    }

    /// Finds a system by its name.
    ///
    /// # Errors
    /// The name is unknown. The error lists the names that are most similar.
    pub fn parse(name: &str) -> Result<Dialect, String> {
        match ROWS.iter().find(|row| row.name.eq_ignore_ascii_case(name)) {
            Some(row) => Ok(row.dialect),
            None => Err(did_you_mean(name, Self::names())
                .unwrap_or_else(|| format!("the dialect is one of {}", Self::names().collect::<Vec<_>>().join(", ")))),
        }
    }

    /// Whether a post of Autodesk wrote the file. The posts have the same tool changes, spindle words and turning files.
    pub(super) fn is_of_autodesk(self) -> bool {
        matches!(self, Dialect::Autodesk | Dialect::Camplete)
    }

    /// Whether the system writes this major word, but the word has no effect on the program.
    pub(super) fn has_no_effect(self, major: &str) -> bool {
        self.row().without_effect.contains(&major)
    }

    pub(super) fn sense(self) -> Option<Sense> {
        self.row().sense
    }

    pub(super) fn last_statement(self) -> Option<&'static str> {
        self.row().last
    }

    /// Recognises the system from the first lines of a file. Returns the system with the line number and the mark by
    /// which it was recognised. Text statements after the first motion are ignored, because their text comes from the
    /// programmer. The first mark decides, except that a mark of CAMplete comes after marks of other systems.
    pub(super) fn of_head<'l>(lines: impl Iterator<Item = &'l [u8]>) -> Option<(Dialect, usize, &'static str)> {
        let (mut moves, mut has_mode, mut first) = (false, false, None);
        for (line, number) in lines.zip(1..) {
            // only Autodesk's posts begin with MODE and put the program's name in quotes
            if has_mode && line.starts_with(QUOTED_NAME.as_bytes()) {
                first = first.or(Some((Dialect::Autodesk, number, QUOTED_NAME)));
            }
            has_mode |= line.starts_with(b"MODE/MILL") || line.starts_with(b"MODE/TURN");
            moves |= line.trim_ascii_start().get(..4).is_some_and(|word| word.eq_ignore_ascii_case(b"GOTO"));
            if moves && text_statement(line.trim_ascii()).is_some() {
                continue;
            }
            match Self::of_line(line) {
                Some((Dialect::Camplete, mark)) => return Some((Dialect::Camplete, number, mark)),
                Some((dialect, mark)) => first = first.or(Some((dialect, number, mark))),
                None => {}
            }
        }
        first
    }

    /// Recognises the system from one line. Returns the system with the mark by which it was recognised.
    fn of_line(line: &[u8]) -> Option<(Dialect, &'static str)> {
        let plain: Vec<u8> =
            line.iter().filter(|b| !b.is_ascii_whitespace()).take(200).map(u8::to_ascii_uppercase).collect();
        ROWS.iter()
            .flat_map(|row| row.marks.iter().map(move |mark| (row.dialect, *mark)))
            .find(|(_, mark)| memchr::memmem::find(&plain, mark.as_bytes()).is_some())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_stand_at_their_numbers_and_names_are_found() {
        for (i, row) in ROWS.iter().enumerate() {
            assert_eq!(row.dialect as usize, i);
            assert_eq!(Dialect::parse(row.name), Ok(row.dialect));
        }
        assert!(Dialect::parse("catja").unwrap_err().contains("catia"));
    }

    #[test]
    fn files_give_themselves_away() {
        let of = |line: &str| Dialect::of_line(line.as_bytes()).map(|(dialect, _)| dialect);
        assert_eq!(of("$$*          Pro/CLfile  Version 11.0"), Some(Dialect::Creo));
        assert_eq!(of("TOOL PATH/ZLEVEL,TOOL,MILL"), Some(Dialect::Nx));
        assert_eq!(of("GOTO/1,2,3"), None);
        let head = |text: &'static str| {
            Dialect::of_head(text.lines().map(str::as_bytes)).map(|(found, line, _)| (found, line))
        };
        assert_eq!(head("MODE/MILL\nPARTNO/'1'\nTOOL PATH/"), Some((Dialect::Autodesk, 2)));
        assert_eq!(head("PARTNO/'1'\nMODE/MILL"), None);
        let camplete = "CSI_TOOL_PATH/Face\nPPRINT/'MATRIX DEFINITION'";
        assert_eq!(head(camplete), Some((Dialect::Camplete, 2)));
        assert_eq!(head("MODE/MILL\nPARTNO/'1'\nUNITS/MM\nPPRINT/'MATRIX DEFINITION'"), Some((Dialect::Camplete, 4)));
        assert_eq!(head("GOTO/1,2,3\nPPRINT/APTCL-SPEC\nCSI_SET/1"), Some((Dialect::SolidWorksCam, 3)));
    }
}
