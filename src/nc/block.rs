//! One block: its words with their values, its codes, and whether they go together.

use super::call::{Call, Pattern};
use super::codes::{AXES, CHECKED, Group, bit};
use super::fault::{Done, refuse};
use super::flow::Flow;
use super::parameters::Target;
use crate::control::{GROUPS, Meaning, Row};
use crate::diag::Code;
use crate::toolpath::Plane;

/// Most G codes and M codes of a block that are kept.
pub(super) const MOST: usize = 16;

/// A block.
#[derive(Debug, Default)]
pub struct Block {
    /// Values of the block's words, by letter.
    pub(super) values: [f64; 26],
    /// Bit i: letter i is there.
    pub given: u32,
    /// Bit i: its value was written as a number without a point.
    pub whole: u32,
    /// G codes by group.
    pub(super) g: [Option<&'static Row>; GROUPS],
    /// A G code is there.
    pub(super) has_g: bool,
    /// One besides motions and cycles is.
    pub(super) has_modes: bool,
    /// One that uses axis words without being a motion is.
    pub(super) takes_axes: bool,
    /// M codes in order: the number, and what the control has of it.
    m: [Option<(u16, &'static Row)>; MOST],
    m_count: usize,
    /// Polar radius `@` and angle `^`.
    pub polar: [Option<f64>; 2],
    /// `$` is there.
    pub(super) spindle: bool,
    /// The block begins with a slash.
    pub deleted: bool,
    /// The block is a `%`.
    pub percent: bool,
    /// The first comment, without its marks.
    pub comment: Option<(usize, usize)>,
    /// Axes whose words are positions, whatever is in force, as bits.
    pub(super) absolute: u8,
    /// Axes whose words are increments, whatever is in force, as bits.
    pub(super) incremental: u8,
    /// The tool that comes after the one that the block changes to.
    pub(super) next_tool: Option<f64>,
    /// The number of the work offset that a word beside the codes selects.
    pub(super) work: Option<f64>,
    /// Full turns of its arc before the end.
    pub(super) turns: u32,
    /// A cycle that is called where its motion ends.
    pub(super) call: Option<Call>,
    /// Holes of a cycle that the block makes.
    pub(super) pattern: Option<Box<Pattern>>,
    /// Flow of the program: subprograms, loops.
    pub flow: Option<Flow>,
    pub(super) settings: Vec<(Target, f64)>,
    pub(super) is_empty: bool,
    /// A comment may go on to the end of its line.
    pub(super) open_comments: bool,
    /// The line without what its control drops before it reads it.
    pub text: Vec<u8>,
}

impl Block {
    /// A word's value.
    #[inline]
    pub fn get(&self, letter: u8) -> Option<f64> {
        (self.given & bit(letter) != 0).then(|| self.values[usize::from(letter - b'A')])
    }

    /// Gives a word that is there another value.
    pub fn set(&mut self, letter: u8, value: f64) {
        self.values[usize::from(letter - b'A')] = value;
    }

    /// Has the block one of these words?
    #[inline]
    pub fn has(&self, words: u32) -> bool {
        self.given & words != 0
    }

    /// What the control has of the G code of a group.
    #[inline]
    pub fn row(&self, group: Group) -> Option<&'static Row> {
        if self.has_g { self.g[group as usize] } else { None }
    }

    /// What the G code of a group means.
    #[inline]
    pub fn g_meaning(&self, group: Group) -> Option<Meaning> {
        self.row(group).map(|row| row.meaning)
    }

    /// The plane that the block says.
    pub fn plane(&self) -> Option<Plane> {
        Some(match self.g_meaning(Group::Plane)? {
            Meaning::PlaneXz => Plane::Xz,
            Meaning::PlaneYz => Plane::Yz,
            _ => Plane::Xy,
        })
    }

    /// Has the block G codes besides motions and cycles?
    #[inline]
    pub fn has_modes(&self) -> bool {
        self.has_modes
    }

    /// The M codes: their numbers, and what the control has of them.
    #[inline]
    pub fn m(&self) -> impl Iterator<Item = (u16, &'static Row)> {
        self.m[..self.m_count].iter().flatten().copied()
    }

    /// Has it M codes?
    #[inline]
    pub fn has_m(&self) -> bool {
        self.m_count > 0
    }

    /// Has it an M code of this meaning?
    pub fn means(&self, meaning: Meaning) -> bool {
        self.m().any(|(_, row)| row.meaning == meaning)
    }

    /// Is another tool in the spindle after it?
    pub fn changes_tool(&self) -> bool {
        self.m().any(|(_, row)| row.meaning.changes_tool())
    }

    /// Has the block words or polar coordinates of axes?
    #[inline]
    pub fn has_axes(&self) -> bool {
        self.given & AXES != 0 || self.polar != [None; 2]
    }

    /// Does a code that is no motion take the axis words?
    #[inline]
    pub fn axes_are_taken(&self) -> bool {
        self.takes_axes
    }

    /// Has the block nothing but blanks, comments and a number?
    pub fn is_empty(&self) -> bool {
        self.is_empty
    }

    /// Empties the block, to read the next line.
    #[inline]
    pub fn clear(&mut self) {
        self.given = 0;
        self.whole = 0;
        self.m_count = 0;
        self.is_empty = true;
        if self.has_g {
            self.g = [None; GROUPS];
            (self.has_g, self.has_modes, self.takes_axes) = (false, false, false);
        }
        self.polar = [None; 2];
        self.spindle = false;
        self.deleted = false;
        self.percent = false;
        self.comment = None;
        self.flow = None;
        (self.absolute, self.incremental, self.turns) = (0, 0, 0);
        (self.work, self.call, self.pattern, self.next_tool) = (None, None, None, None);
    }

    /// Puts a word in.
    pub fn put(&mut self, letter: u8, value: f64) {
        self.is_empty &= letter == b'N';
        self.given |= bit(letter);
        self.values[usize::from(letter - b'A')] = value;
    }

    /// Puts a G code in; is it the first of its group?
    pub fn put_g(&mut self, row: &'static Row, its_group: Group, takes_axes: bool) -> bool {
        self.is_empty = false;
        self.has_g = true;
        self.takes_axes |= takes_axes;
        self.has_modes |= !matches!(its_group, Group::Motion | Group::Cycle);
        self.g[its_group as usize].replace(row).is_none()
    }

    /// Puts an M code in; has the block room for it?
    pub fn put_m(&mut self, number: u16, row: &'static Row) -> bool {
        self.is_empty = false;
        let place = self.m.get_mut(self.m_count);
        self.m_count += usize::from(place.is_some());
        place.map(|place| *place = Some((number, row))).is_some()
    }

    /// Are all words used, where this is the code of its motion? `free`: the letters that need no code, as bits.
    ///
    /// # Errors
    /// A word that nothing uses.
    #[inline]
    pub fn check_words(&self, motion: Option<&Row>, free: u32) -> Done {
        if self.given & CHECKED == 0 && !self.spindle {
            return Ok(());
        }
        self.check_used(motion, free)
    }

    fn check_used(&self, motion: Option<&Row>, free: u32) -> Done {
        let mut used = motion.map_or(0, |row| row.words.bits());
        if self.has_g {
            used |= self.g.iter().flatten().fold(0, |words, row| words | row.words.bits());
        }
        used |= self.m().fold(0, |words, (_, row)| words | row.words.bits());
        used |= free;
        let unused = self.given & CHECKED & !used;
        if unused != 0 {
            let letter = char::from(b'A' + unused.trailing_zeros() as u8);
            let message = format!("{letter} is there, and no code that uses it");
            let help = match letter {
                'H' => "write G43 with it, or name the control: `--control`, for a job `--job-control`".to_owned(),
                _ => format!("take the {letter} out, or write its code in this block"),
            };
            return refuse(Code::PN005, message, help);
        }
        let spindle =
            self.m().any(|(_, row)| row.meaning == Meaning::Orient || row.meaning.group() == Some(Group::Spindle))
                || self.g_meaning(Group::SpeedMode).is_some()
                || self.g_meaning(Group::FeedMode) == Some(Meaning::PerRev)
                || matches!(
                    self.g_meaning(Group::Motion),
                    Some(Meaning::Thread | Meaning::RigidTap | Meaning::ThreadCycle | Meaning::ThreadPass)
                );
        if self.spindle && !spindle {
            return refuse(Code::PN005, "$ is there, and no code that uses it", "take it out");
        }
        Ok(())
    }
}
