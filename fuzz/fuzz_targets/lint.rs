//! Fuzzing of forms, guided by coverage. `fuzz/run 1800` runs this target for half an hour (see CONTRIBUTING.md).
#![no_main]

#[path = "../look.rs"]
mod look;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| look::look(bytes, true));
