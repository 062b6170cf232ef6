//! The list of all rules. Each rule has its own file and a row here.

mod across_before_up;
mod arc_other_way;
mod arc_without_centre;
mod cancel_emulated;
mod cancel_without_code;
mod change_without_retract;
mod change_without_tool;
mod coarse_centre;
mod code_format;
mod codes_swapped;
mod comment_line_without_text;
mod compensation_words;
mod condition_as_text;
mod control_without_code;
mod coolant_left_on;
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
mod item_without_text;
mod length_code_without_h;
mod length_in_one_unit;
mod length_lost;
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
mod rigid_without_code;
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
mod variable_in_quotes;
mod without_effect;
mod words_after_end;
mod wrong_quantity;

use super::view::View;
use crate::diag::{Code, Diag};

/// A rule: the code of its findings, and its check.
#[derive(Debug)]
pub struct Rule {
    /// The code of the rule's findings.
    pub code: Code,
    /// The file of the rule in `src/lint/rules`.
    pub file: &'static str,
    /// The rule depends on the meaning of codes. The rule is not applied to a control without G codes.
    pub of_codes: bool,
    pub(super) check: fn(&View, &mut Vec<Diag>),
}

macro_rules! rules {
    ($($code:ident $file:ident $(($codes:ident))?)*) => {
        /// All rules. Rules that depend on the meaning of codes are marked `(codes)`.
        pub const RULES: &[Rule] =
            &[$(Rule {
                code: Code::$code,
                file: stringify!($file),
                of_codes: !stringify!($($codes)?).is_empty(),
                check: $file::check,
            }),*];
    };
}

rules! {
    // structure
    PF010 unused_sequence
    PF011 unused_command
    PF012 empty_sequence
    PF013 start_moves (codes)
    PF014 no_program_end (codes)
    PF015 words_after_end (codes)
    PF016 tape_mark (codes)
    PF017 sub_without_return (codes)
    PF018 sub_without_number
    // spaces and comments
    PF101 lost_words
    PF102 missing_blank
    PF103 tab
    PF104 swallowed_words
    PF105 open_comment
    PF106 hash_in_word
    PF107 near_remark
    PF110 foreign_comment_mark (codes)
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
    PF309 typed_without_point (codes)
    PF310 code_format (codes)
    PF311 dwell_unit (codes)
    PF312 replace_number
    PF313 wrong_quantity
    PF314 other_axis (codes)
    PF315 unit_code (codes)
    PF316 units_unprinted (codes)
    PF317 implied_metric
    PF318 count_with_point
    // sequences and cycles
    PF403 cancel_emulated (codes)
    PF404 machine_code_without_count (codes)
    PF406 cycle_without_position (codes)
    PF407 cycle_without_depth (codes)
    PF408 count_swallows_position
    PF409 cycle_without_cancel (codes)
    PF410 cancel_without_code (codes)
    PF411 cycle_without_plane (codes)
    PF412 cycle_without_feed (codes)
    PF413 peck_without_step (codes)
    PF414 other_cycle (codes)
    PF415 rapid_to_bottom (codes)
    PF416 depth_before_position (codes)
    PF417 ends_in_hole (codes)
    PF418 feed_line_without_feed (codes)
    PF419 tap_without_reverse (codes)
    PF420 index_without_retract (codes)
    PF421 unwind_down_first (codes)
    PF422 return_without_g91 (codes)
    PF423 position_in_increments (codes)
    PF424 increments_left_on (codes)
    PF425 length_code_without_h (codes)
    PF426 h_without_length_code (codes)
    PF427 spindle_before_change (codes)
    PF428 coolant_order (codes)
    PF429 change_without_tool (codes)
    PF430 typed_work (codes)
    PF431 arc_without_centre (codes)
    PF432 arc_other_way (codes)
    PF433 motion_without_axis (codes)
    PF434 compensation_words (codes)
    PF435 rapid_that_feeds (codes)
    PF436 cut_at_rapid (codes)
    PF437 length_register (codes)
    PF438 no_motion_code (codes)
    PF439 increment_as_position (codes)
    PF440 part_zero (codes)
    PF441 across_before_up (codes)
    PF442 thread_without_return (codes)
    PF443 ends_too_early (codes)
    PF444 length_lost (codes)
    PF445 change_without_retract (codes)
    PF446 rigid_without_code (codes)
    // modality
    PF501 modal_letters (codes)
    PF502 modal_codes (codes)
    PF503 hidden_depth (codes)
    PF504 increments_mixed (codes)
    PF505 one_group_twice (codes)
    PF506 letter_twice (codes)
    PF507 mode_unsaid (codes)
    // limits and machine type
    PF605 near_word_limit
    PF606 near_line_limit
    PF607 control_without_code
    PF608 unknown_code (codes)
    PF609 second_m_code (codes)
    // extensions beyond the manual
    PF710 property_unused
    PF711 list_without_use
    PF712 coolant_unprinted
    PF713 condition_as_text
    PF714 pattern_compared
    PF715 comment_line_without_text
    PF716 variable_in_quotes
    PF717 length_in_one_unit
    PF718 item_without_text
    PF719 coolant_left_on
}
