//! All tests of the library and of the commands, as one program.
#![allow(missing_docs)]

mod allocations;
mod architecture;
mod bad_input;
mod cl;
mod commands;
mod cycles;
mod diff;
mod examples;
mod fmt;
mod golden;
mod guide;
mod increments;
mod lint_command;
mod linuxcnc;
mod linuxcnc_random;
mod machines;
mod nc_golden;
mod numbers;
mod program_commands;
mod program_jobs;
mod properties;
mod real_programs;
mod reference;
mod rotary;
mod rules;
mod safety;
mod samples;
mod sequences;
mod silent;
mod simulate;
mod streams;
mod support;
mod trace;
mod transcripts;
mod verify;
