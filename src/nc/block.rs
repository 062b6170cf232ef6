//! A block: its words with their values, its codes, and the check that these words and codes may be used together.

use std::cell::Cell;

use super::call::{Call, Pattern};
use super::codes::{AXES, CHECKED, Group, bit};
use super::fault::{Done, refuse};
use super::flow::Flow;
use super::parameters::Target;
use crate::control::{GROUPS, Meaning, Row};
use crate::diag::Code;
use crate::toolpath::Plane;

/// The maximum number of M codes that are stored for a block.
pub(super) const MOST: usize = 16;

/// A block.
#[derive(Debug, Default)]
pub struct Block {
    /// Values of the block's words, by letter.
    pub(super) values: [f64; 26],
    /// Bit i: the block has a word with letter i.
    pub given: u32,
    /// Bit i: the value of letter i is a number without a decimal point.
    pub whole: u32,
    /// Bit i: the control has read the word with letter i.
    read: Cell<u32>,
    /// G codes by group.
    pub(super) g: [Option<&'static Row>; GROUPS],
    /// Whether the block has a G code at all.
    pub(super) has_g: bool,
    /// Whether the block has a G code other than motions and cycles.
    pub(super) has_modes: bool,
    /// Whether the block has a G code that uses the axis words but is not a motion.
    pub(super) takes_axes: bool,
    /// The last harmless G code that may use axis words itself.
    pub(super) harmless: Option<&'static Row>,
    /// The M codes in their order: number, and the control's row for this number.
    m: [Option<(u16, &'static Row)>; MOST],
    m_count: usize,
    /// The polar radius (word `@`) and the polar angle (word `^`).
    pub polar: [Option<f64>; 2],
    /// Whether the block has a `$` word.
    pub(super) spindle: bool,
    /// Whether the block begins with a slash.
    pub deleted: bool,
    /// Whether the block is a `%` line.
    pub percent: bool,
    /// Columns of the first comment, without its delimiters.
    pub comment: Option<(usize, usize)>,
    /// As bits, the axes whose words are absolute positions in every distance mode.
    pub(super) absolute: u8,
    /// As bits, the axes whose words are increments in every distance mode.
    pub(super) incremental: u8,
    /// The tool that is preselected after the tool change of this block.
    pub(super) next_tool: Option<f64>,
    /// The number of the work offset, if a word that is not a G code selects the work offset.
    pub(super) work: Option<f64>,
    /// Whether the machine positions of the block are measured from a point that only the machine has.
    pub(super) hidden: bool,
    /// Number of full turns that the arc of the block makes before its end.
    pub(super) turns: u32,
    /// The call of a cycle at the end of the block's motion.
    pub(super) call: Option<Call>,
    /// The holes of a cycle that this block makes.
    pub(super) pattern: Option<Box<Pattern>>,
    /// The effect of the block on the program flow: subprograms and loops.
    pub flow: Option<Flow>,
    pub(super) settings: Vec<(Target, f64)>,
    pub(super) is_empty: bool,
    /// Whether the block has the simple form that `plain.rs` runs.
    pub(super) plain: bool,
    /// Whether a comment may end at the end of its line, without a closing bracket.
    pub(super) open_comments: bool,
    /// The text of the line, without characters that the control drops before it reads the line.
    pub text: Vec<u8>,
}

impl Block {
    /// The value of a word; `None`: the block does not have the word.
    #[inline]
    pub fn get(&self, letter: u8) -> Option<f64> {
        self.read.set(self.read.get() | bit(letter));
        (self.given & bit(letter) != 0).then(|| self.values[usize::from(letter - b'A')])
    }

    /// Records words as read that the simulator does not use, because another part of postform does.
    pub(super) fn takes(&self, words: u32) {
        self.read.set(self.read.get() | words);
    }

    /// Checks that the value of every word was read while the block ran. `free`: as bits, the letters that need no code.
    ///
    /// # Errors
    /// A word was not read.
    #[inline]
    pub fn check_read(&self, free: u32) -> Done {
        let unread = self.given & !(self.read.get() | free);
        if unread == 0 { Ok(()) } else { self.check_unread(unread) }
    }

    /// A harmless code may use its own words, which the simulator does not read. All other words that were not read are
    /// an error.
    #[cold]
    fn check_unread(&self, unread: u32) -> Done {
        let harmless = self.rows().filter(|row| row.meaning == Meaning::Harmless);
        no_code_uses(harmless.fold(unread, |left, row| left & !row.words.bits()))
    }

    /// The value of a word that the block has. The word does not count as read.
    pub(super) fn peek(&self, letter: u8) -> f64 {
        self.values[usize::from(letter - b'A')]
    }

    /// Changes the value of a word. The block must have the word.
    pub fn set(&mut self, letter: u8, value: f64) {
        self.values[usize::from(letter - b'A')] = value;
    }

    /// Whether the block has at least one of these words.
    #[inline]
    pub fn has(&self, words: u32) -> bool {
        self.given & words != 0
    }

    /// The control's row for the G code of a group.
    #[inline]
    pub fn row(&self, group: Group) -> Option<&'static Row> {
        if self.has_g { self.g[group as usize] } else { None }
    }

    /// The meaning of the G code of a group.
    #[inline]
    pub fn g_meaning(&self, group: Group) -> Option<Meaning> {
        self.row(group).map(|row| row.meaning)
    }

    /// The plane that the block selects.
    pub fn plane(&self) -> Option<Plane> {
        Some(match self.g_meaning(Group::Plane)? {
            Meaning::PlaneXz => Plane::Xz,
            Meaning::PlaneYz => Plane::Yz,
            _ => Plane::Xy,
        })
    }

    /// Whether the block has G codes other than motions and cycles.
    #[inline]
    pub fn has_modes(&self) -> bool {
        self.has_modes
    }

    /// The M codes in their order: number, and the control's row for this number.
    #[inline]
    pub fn m(&self) -> impl Iterator<Item = (u16, &'static Row)> {
        self.m[..self.m_count].iter().flatten().copied()
    }

    /// The control's rows for all codes of the block.
    pub fn rows(&self) -> impl Iterator<Item = &'static Row> {
        let g = self.g.iter().filter(|_| self.has_g).flatten().copied();
        g.chain(self.m().map(|(_, row)| row))
    }

    /// Whether the block has M codes.
    #[inline]
    pub fn has_m(&self) -> bool {
        self.m_count > 0
    }

    /// Whether the block has an M code of this meaning.
    pub fn means(&self, meaning: Meaning) -> bool {
        self.m().any(|(_, row)| row.meaning == meaning)
    }

    /// Whether the block changes the tool in the spindle.
    pub fn changes_tool(&self) -> bool {
        self.m().any(|(_, row)| row.meaning.changes_tool())
    }

    /// Whether the block has axis words or polar coordinates.
    #[inline]
    pub fn has_axes(&self) -> bool {
        self.given & AXES != 0 || self.polar != [None; 2]
    }

    /// Whether the axis words belong to a code that is not a motion.
    #[inline]
    pub fn axes_are_taken(&self) -> bool {
        self.takes_axes
    }

    /// Records a G code that may use axis words itself: it is harmless, but its meaning beside axis words is unknown.
    #[inline]
    pub fn note_harmless(&mut self, row: &'static Row) {
        if row.meaning == Meaning::Harmless && !row.runs.beside_moves {
            self.harmless = Some(row);
        }
    }

    /// Whether the block contains nothing but spaces, comments and a block number.
    pub fn is_empty(&self) -> bool {
        self.is_empty
    }

    /// Clears the block before the next line is read.
    #[inline]
    pub fn clear(&mut self) {
        self.given = 0;
        self.whole = 0;
        self.read.set(0);
        self.m_count = 0;
        self.is_empty = true;
        self.plain = false;
        if self.has_g {
            self.g = [None; GROUPS];
            (self.has_g, self.has_modes, self.takes_axes) = (false, false, false);
            self.harmless = None;
        }
        self.polar = [None; 2];
        self.spindle = false;
        self.deleted = false;
        self.percent = false;
        self.comment = None;
        self.flow = None;
        (self.absolute, self.incremental, self.turns) = (0, 0, 0);
        self.hidden = false;
        (self.work, self.call, self.pattern, self.next_tool) = (None, None, None, None);
    }

    /// Adds a word.
    pub fn put(&mut self, letter: u8, value: f64) {
        self.is_empty &= letter == b'N';
        self.given |= bit(letter);
        self.values[usize::from(letter - b'A')] = value;
    }

    /// Adds a G code. Returns whether the code is the first code of its group in the block.
    pub fn put_g(&mut self, row: &'static Row, its_group: Group, takes_axes: bool) -> bool {
        self.is_empty = false;
        self.has_g = true;
        self.takes_axes |= takes_axes;
        self.has_modes |= !matches!(its_group, Group::Motion | Group::Cycle);
        self.g[its_group as usize].replace(row).is_none()
    }

    /// Adds an M code. Returns `false` if the block already has the maximum number.
    pub fn put_m(&mut self, number: u16, row: &'static Row) -> bool {
        self.is_empty = false;
        let place = self.m.get_mut(self.m_count);
        self.m_count += usize::from(place.is_some());
        place.map(|place| *place = Some((number, row))).is_some()
    }

    /// Checks that every word of the block is used by a code. `motion` is the code of the motion. `free`: as bits, the
    /// letters that need no code.
    ///
    /// # Errors
    /// A word is not used by any code.
    #[inline]
    pub fn check_words(&self, motion: Option<&Row>, free: u32) -> Done {
        if self.given & CHECKED == 0 && !self.spindle {
            return Ok(());
        }
        self.check_used(motion, free)
    }

    fn check_used(&self, motion: Option<&Row>, free: u32) -> Done {
        let of_motion = motion.map_or(0, |row| row.words.bits());
        let used = self.rows().fold(of_motion | free, |words, row| words | row.words.bits());
        no_code_uses(self.given & CHECKED & !used)?;
        let spindle =
            self.m().any(|(_, row)| row.meaning == Meaning::Orient || row.meaning.group() == Some(Group::Spindle))
                || self.g_meaning(Group::SpeedMode).is_some()
                || self.g_meaning(Group::FeedMode) == Some(Meaning::PerRev)
                || matches!(
                    self.g_meaning(Group::Motion),
                    Some(Meaning::Thread | Meaning::RigidTap | Meaning::ThreadCycle | Meaning::ThreadPass)
                );
        if self.spindle && !spindle {
            return refuse(Code::PN005, "the block has $, but no code that uses $", "take it out");
        }
        Ok(())
    }
}

/// Refuses the first of these letters: no code of the block uses its word.
fn no_code_uses(words: u32) -> Done {
    if words == 0 {
        return Ok(());
    }
    let letter = char::from(b'A' + words.trailing_zeros() as u8);
    let message = format!("the block has {letter}, but no code that uses {letter}");
    let help = match letter {
        'H' => "write G43 in this block, or name the control: `--control`, for a job `--job-control`".to_owned(),
        _ => format!("remove the {letter}, or write its code in this block"),
    };
    refuse(Code::PN005, message, help)
}
