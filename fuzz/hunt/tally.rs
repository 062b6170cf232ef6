//! Counts results by name.

use std::collections::BTreeMap;

/// Counts by group and name.
#[derive(Default)]
pub struct Tally(BTreeMap<&'static str, BTreeMap<String, u64>>);

impl Tally {
    /// Adds one.
    pub fn count(&mut self, group: &'static str, name: impl Into<String>) {
        *self.0.entry(group).or_default().entry(name.into()).or_default() += 1;
    }

    /// The count of a name.
    pub fn get(&self, group: &'static str, name: &str) -> u64 {
        self.0.get(group).and_then(|names| names.get(name)).copied().unwrap_or(0)
    }

    /// The sum of a group.
    pub fn total(&self, group: &'static str) -> u64 {
        self.0.get(group).map_or(0, |names| names.values().sum())
    }

    /// Prints all groups, a line for each name.
    pub fn print(&self) {
        for (group, names) in &self.0 {
            println!("{group}:");
            let mut rows: Vec<_> = names.iter().collect();
            rows.sort_by_key(|(name, count)| (std::cmp::Reverse(**count), (*name).clone()));
            for (name, count) in rows {
                println!("{count:>12}  {name}");
            }
        }
    }
}
