//! Numbers without a decimal point, whose unit depends on a setting of the control.

use super::block::Block;
use super::codes::{Group, bit, letters};
use super::fault::{Done, refuse};
use super::settings::Unpointed;
use super::state::State;
use crate::control::{FeedWithoutPoint, Meaning};
use crate::diag::Code;
use crate::toolpath::{FeedMode, Units};

/// The words whose values are lengths or angles.
const LENGTHS: u32 = letters("XYZABCIJKRQ");

/// The words whose values may depend on a decimal point.
pub(super) const SCALED: u32 = LENGTHS | letters("DFUVW");

impl State {
    /// Converts lengths without a decimal point, as the settings require.
    pub(super) fn unpointed(&self, block: &mut Block) -> Done {
        let inch = self.is_inch(block);
        if block.row(Group::Other).is_some() || block.means(Meaning::Orient) {
            return Ok(()); // the words of these codes are not lengths
        }
        // a number of repeats is not a length
        let repeats = self
            .cycle_of(block)
            .is_some_and(|row| row.runs.motions.is_none_or(|motions| !self.k_shifts(motions, block)));
        // not lengths: P and Q of a turning cycle (block numbers or increments), Q of a thread (an angle), R of a
        // pattern cycle (number of passes)
        let motion = block.row(Group::Motion).or(self.modes.motion).map(|row| row.meaning);
        let (more, less) = match (block.g_meaning(Group::Once), motion) {
            (Some(Meaning::RoughPattern), _) => (0, letters("QR")),
            (Some(Meaning::RoughTurn | Meaning::RoughFace), _) => (bit(b'D'), bit(b'Q')),
            (Some(Meaning::Finish | Meaning::FacePecks | Meaning::GroovePecks), _) => (0, bit(b'Q')),
            (None, Some(Meaning::Thread | Meaning::ThreadPass | Meaning::ThreadCycle)) => (0, bit(b'Q')),
            _ => (0, 0),
        };
        let more = more | if self.control.is_lathe() { letters("UVW") } else { 0 };
        let feed = if self.scales_feed(block) { bit(b'F') } else { 0 };
        let whole = block.whole & (LENGTHS & !less | more | feed) & if repeats { !bit(b'K') } else { !0 };
        // the unit of a time without a point is 0.001 seconds, also with inches
        let times = if block.g_meaning(Group::Once) == Some(Meaning::Dwell) { letters("XU") } else { 0 };
        for letter in (b'A'..=b'Z').filter(|&letter| whole & bit(letter) != 0) {
            let value = block.peek(letter);
            if value == 0.0 {
                continue;
            }
            match self.settings.unpointed {
                Unpointed::Whole => {}
                Unpointed::Increments if letter != b'F' || self.is_feed_increment() => {
                    let increment = if inch && (letters("ABC") | times) & bit(letter) == 0 { 1e-4 } else { 1e-3 };
                    block.set(letter, value * increment);
                }
                Unpointed::Increments => {
                    let message = format!("F{value} has no point, and the increment of this feed is not public");
                    return refuse(Code::PN017, message, format!("write F{value}."));
                }
                Unpointed::Refused => {
                    let name = char::from(letter);
                    let message =
                        format!("{name}{value} has no point, and its meaning depends on a setting of the control");
                    let help =
                        format!("write {name}{value}. for whole units, or give `--no-point whole` or `increments`");
                    return refuse(Code::PN017, message, help);
                }
            }
        }
        Ok(())
    }

    /// Whether a feed without a decimal point depends on a setting of the control.
    pub(super) fn scales_feed(&self, block: &Block) -> bool {
        if self.settings.whole_feeds {
            return false;
        }
        let per_minute = match block.g_meaning(Group::FeedMode) {
            Some(meaning) => meaning == Meaning::PerMinute,
            None => self.modes.feed_mode == FeedMode::PerMinute,
        };
        match self.control.traits().feed_without_point {
            FeedWithoutPoint::Unknown | FeedWithoutPoint::Units => false,
            FeedWithoutPoint::WholeMm => self.is_inch(block) || !per_minute,
            FeedWithoutPoint::LeastIncrement => true,
        }
    }

    /// Whether the words of a block are in inches.
    fn is_inch(&self, block: &Block) -> bool {
        let said = block.g_meaning(Group::Units).map(|meaning| meaning == Meaning::Inch);
        said.unwrap_or(self.modes.units == Units::Inch)
    }

    fn is_feed_increment(&self) -> bool {
        self.control.traits().feed_without_point == FeedWithoutPoint::LeastIncrement
    }
}
