//! Klartext, the language of Heidenhain TNC controls.
//!
//! Sources: the manuals of TNC 320, iTNC 530 and TNC 640 (Klartext programming), and public programs.

mod block;
mod corner;
mod cycles;
mod define;
mod flow;
mod path;
mod switches;

use std::collections::HashMap;

use crate::nc::way::Spot;
use cycles::Cycle;

/// The state of a Klartext program, in addition to the state of the machine.
#[derive(Debug, Default)]
pub struct Klartext {
    /// The values of the parameters Q, QL and QR, by name.
    values: HashMap<String, f64>,
    /// The drilling cycle that the program has defined last. Its parameters are Q parameters, which the program may
    /// change before the call.
    cycle: Option<Cycle>,
    /// Whether the cycle is called after every positioning block: M89.
    calls_always: bool,
    /// The centre that `CC` sets.
    center: Option<[f64; 2]>,
    /// The radius of the last polar position.
    radius: Option<f64>,
    /// The active feed as written. [`per_minute`](cycles::per_minute) converts it.
    feed: Option<f64>,
    /// The feed of `TOOL CALL` as written, which `F AUTO` uses.
    tool_feed: Option<f64>,
    inch: bool,
    /// Whether `BEGIN PGM` has been read.
    begun: bool,
    /// Position in the input before the current block.
    begin: Spot,
    /// If a rounding or chamfer follows the current block: the text of this block, and of the block after it.
    ahead: Option<[Vec<u8>; 2]>,
    /// The corner that the previous line has calculated.
    corner: Option<corner::Corner>,
    /// The corner itself, at which increments after the rounding or chamfer begin.
    nominal: Option<[f64; 2]>,
    /// Labels with their positions in the input, and whether the label is in the input twice; `None`: the input has not
    /// been searched yet.
    labels: Option<HashMap<String, (Spot, bool)>>,
    /// For each `CALL LBL 1 REP 3`: the line of the call, and the number of repeats that are left.
    repeats: Vec<(u64, u32)>,
    /// The statement of the current block that is not simulated.
    left_out: Option<Box<str>>,
}

impl Klartext {
    /// The value of a parameter.
    fn value(&self, name: &str) -> Option<f64> {
        self.values.get(name).copied()
    }

    /// The defined cycle with the current values of its parameters.
    fn current_cycle(&self) -> Option<Cycle> {
        let mut cycle = self.cycle.clone()?;
        for (number, value) in &mut cycle.words {
            *value = self.value(&format!("Q{number}")).unwrap_or(*value);
        }
        Some(cycle)
    }
}

/// The kind of a path block.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Path {
    Line,
    /// `LP`: a line to a polar position.
    Polar,
    /// `C`: an arc about the centre.
    Arc,
    /// `CR`: an arc by its radius.
    Radius,
    /// `CP`: an arc about the centre, to a polar position.
    PolarArc,
}

/// Whether a name is the name of a parameter: `Q5`, `QL1`, `QR2`.
fn is_parameter(name: &str) -> bool {
    let number = ["QL", "QR", "Q"].iter().find_map(|start| name.strip_prefix(start));
    number.is_some_and(|number| !number.is_empty() && number.bytes().all(|byte| byte.is_ascii_digit()))
}
