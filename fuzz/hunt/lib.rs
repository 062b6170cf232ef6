//! Random jobs and wrong programs: the code that the fuzzing programs share.
//!
//! `jobs` renders random jobs and compares each program with its job. `programs` changes correct programs in one place and
//! checks that the comparison finds the change.

pub mod case;
pub mod cl;
pub mod forms;
pub mod job;
pub mod judge;
pub mod mutate;
pub mod planner;
pub mod prove;
pub mod random;
pub mod shrink;
pub mod tally;
pub mod text;
pub mod turning;
