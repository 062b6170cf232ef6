//! Random jobs and wrong programs: what the hunt for faults shares.
//!
//! `jobs` renders random jobs and compares each program with its job; `programs` changes right programs in one place and
//! looks whether comparing sees it.

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
