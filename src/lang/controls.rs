//! What controls take, by the names that forms give them.

/// The longest block in characters, comment included. LinuxCNC stops where it comes to a longer one; senders of Grbl cut.
const LONGEST_BLOCKS: [(&str, usize); 3] = [("linuxcnc", 252), ("emc2", 252), ("grbl", 80)];

/// How long a block may be; `None`: nothing public says.
pub fn longest_block(control: &str) -> Option<usize> {
    LONGEST_BLOCKS.iter().find(|(name, _)| *name == control).map(|(_, longest)| *longest)
}
