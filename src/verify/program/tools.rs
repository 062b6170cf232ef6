//! Tools that the program calls by their names.

use super::Program;
use crate::verify::cut::number;

impl Program<'_> {
    /// Sets the number of a tool that the program may call by its name.
    pub fn know_tool(&mut self, name: &str, number: f64) {
        self.simulator.know_tool(name, number);
    }

    /// Makes tools that two programs call by the same name the same tool.
    pub fn share_tool_names(&mut self, other: &Program<'_>) {
        self.simulator.share_tool_names(&other.simulator);
    }

    /// Whether a tool, or its register, is a name whose number is unknown.
    pub fn is_name(&self, tool: f64) -> bool {
        self.simulator.state().tool_name(tool).is_some()
    }

    /// A tool for a message: its name if the program calls it by a name whose number is unknown, else its number.
    pub fn tool_text(&self, tool: f64) -> String {
        self.simulator.state().tool_name(tool).map_or_else(|| number(tool).to_string(), |name| format!("\"{name}\""))
    }
}
