//! Forms mutated by coverage: `fuzz/run 1800` does it for half an hour (see CONTRIBUTING.md).
#![no_main]

#[path = "../look.rs"]
mod look;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| look::look(bytes, true));
