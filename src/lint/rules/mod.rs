//! The rules: one a file, one row here.

mod across_before_up;
mod arc_other_way;
mod arc_without_centre;
mod cancel_emulated;
mod cancel_without_code;
mod change_without_tool;
mod coarse_centre;
mod code_format;
mod codes_swapped;
mod comment_line_without_text;
mod compensation_words;
mod condition_as_text;
mod control_without_code;
mod coolant_order;
mod coolant_unprinted;
mod count_swallows_position;
mod count_with_point;
mod custom_kind;
mod custom_twice;
mod cut_at_rapid;
mod cut_digits;
mod cycle_without_cancel;
mod cycle_without_depth;
mod cycle_without_feed;
mod cycle_without_plane;
mod cycle_without_position;
mod depth_before_position;
mod dwell_unit;
mod empty_sequence;
mod ends_in_hole;
mod ends_too_early;
mod feed_line_without_feed;
mod foreign_comment_mark;
mod h_without_length_code;
mod hash_in_word;
mod hidden_depth;
mod implied_metric;
mod implied_point;
mod increment_as_position;
mod increments_left_on;
mod increments_mixed;
mod index_without_retract;
mod length_code_without_h;
mod length_register;
mod letter_for_digit;
mod letter_formats;
mod letter_twice;
mod list_without_use;
mod lost_words;
mod machine_code_without_count;
mod missing_blank;
mod modal_codes;
mod modal_letters;
mod mode_unsaid;
mod motion_without_axis;
mod near_line_limit;
mod near_remark;
mod near_word_limit;
mod nested_comment;
mod no_motion_code;
mod no_program_end;
mod old_spelling;
mod one_group_twice;
mod open_comment;
mod other_axis;
mod other_cycle;
mod part_zero;
mod pattern_compared;
mod peck_without_step;
mod position_in_increments;
mod property_unused;
mod rapid_that_feeds;
mod rapid_to_bottom;
mod replace_number;
mod return_without_g91;
mod second_m_code;
mod small_letter;
mod spindle_before_change;
mod split_word;
mod start_moves;
mod sub_without_number;
mod sub_without_return;
mod swallowed_words;
mod tab;
mod tap_without_reverse;
mod tape_mark;
mod thread_without_return;
mod typed_without_point;
mod typed_work;
mod unbracketed_variable;
mod unit_code;
mod units_unprinted;
mod unknown_code;
mod unsigned_position;
mod unused_command;
mod unused_prompt;
mod unused_sequence;
mod unwind_down_first;
mod upon_unused;
mod without_effect;
mod words_after_end;
mod wrong_quantity;

use super::view::View;
use crate::diag::{Code, Diag};

/// A rule: what its findings are called, and how they are found.
#[derive(Debug)]
pub struct Rule {
    /// The code of the rule's findings.
    pub code: Code,
    /// The file of the rule in `src/lint/rules`.
    pub file: &'static str,
    pub(super) check: fn(&View, &mut Vec<Diag>),
}

macro_rules! rules {
    ($($code:ident $file:ident)*) => {
        /// All rules.
        pub const RULES: &[Rule] =
            &[$(Rule { code: Code::$code, file: stringify!($file), check: $file::check }),*];
    };
}

rules! {
    // structure
    PF010 unused_sequence
    PF011 unused_command
    PF012 empty_sequence
    PF013 start_moves
    PF014 no_program_end
    PF015 words_after_end
    PF016 tape_mark
    PF017 sub_without_return
    PF018 sub_without_number
    // blanks and comments
    PF101 lost_words
    PF102 missing_blank
    PF103 tab
    PF104 swallowed_words
    PF105 open_comment
    PF106 hash_in_word
    PF107 near_remark
    PF110 foreign_comment_mark
    PF111 nested_comment
    PF112 split_word
    // names
    PF203 without_effect
    PF204 old_spelling
    PF205 unbracketed_variable
    PF206 letter_for_digit
    PF207 custom_kind
    PF208 custom_twice
    PF209 unused_prompt
    PF210 upon_unused
    PF211 codes_swapped
    // numbers and letter formats
    PF303 letter_formats
    PF304 small_letter
    PF305 unsigned_position
    PF306 cut_digits
    PF307 implied_point
    PF308 coarse_centre
    PF309 typed_without_point
    PF310 code_format
    PF311 dwell_unit
    PF312 replace_number
    PF313 wrong_quantity
    PF314 other_axis
    PF315 unit_code
    PF316 units_unprinted
    PF317 implied_metric
    PF318 count_with_point
    // sequences and cycles
    PF403 cancel_emulated
    PF404 machine_code_without_count
    PF406 cycle_without_position
    PF407 cycle_without_depth
    PF408 count_swallows_position
    PF409 cycle_without_cancel
    PF410 cancel_without_code
    PF411 cycle_without_plane
    PF412 cycle_without_feed
    PF413 peck_without_step
    PF414 other_cycle
    PF415 rapid_to_bottom
    PF416 depth_before_position
    PF417 ends_in_hole
    PF418 feed_line_without_feed
    PF419 tap_without_reverse
    PF420 index_without_retract
    PF421 unwind_down_first
    PF422 return_without_g91
    PF423 position_in_increments
    PF424 increments_left_on
    PF425 length_code_without_h
    PF426 h_without_length_code
    PF427 spindle_before_change
    PF428 coolant_order
    PF429 change_without_tool
    PF430 typed_work
    PF431 arc_without_centre
    PF432 arc_other_way
    PF433 motion_without_axis
    PF434 compensation_words
    PF435 rapid_that_feeds
    PF436 cut_at_rapid
    PF437 length_register
    PF438 no_motion_code
    PF439 increment_as_position
    PF440 part_zero
    PF441 across_before_up
    PF442 thread_without_return
    PF443 ends_too_early
    // modality
    PF501 modal_letters
    PF502 modal_codes
    PF503 hidden_depth
    PF504 increments_mixed
    PF505 one_group_twice
    PF506 letter_twice
    PF507 mode_unsaid
    // limits and machine type
    PF605 near_word_limit
    PF606 near_line_limit
    PF607 control_without_code
    PF608 unknown_code
    PF609 second_m_code
    // what posts say beyond the manual
    PF710 property_unused
    PF711 list_without_use
    PF712 coolant_unprinted
    PF713 condition_as_text
    PF714 pattern_compared
    PF715 comment_line_without_text
}
