//! Klartext, the language of Heidenhain TNC controls.
//!
//! Sources: the manuals of TNC 320, iTNC 530 and TNC 640 (Klartext programming), and public programs.

mod block;
mod corner;
mod cycles;
mod define;
mod flow;

use std::collections::HashMap;

use crate::nc::call::Call;
use crate::nc::way::Spot;

/// State of a program besides the state of the machine.
#[derive(Debug, Default)]
pub struct Klartext {
    /// Q, QL and QR parameters by their names.
    values: HashMap<String, f64>,
    /// The drilling cycle that was defined last.
    cycle: Option<Call>,
    /// M89: the cycle is called after every positioning block.
    calls_always: bool,
    /// The circle centre of `CC`.
    center: Option<[f64; 2]>,
    /// The radius of a polar position.
    radius: Option<f64>,
    /// The feed in force, in the program's units per minute.
    feed: Option<f64>,
    /// The feed of `TOOL CALL`, for `F AUTO`.
    tool_feed: Option<f64>,
    inch: bool,
    /// Whether `BEGIN PGM` was read.
    begun: bool,
    /// Position in the input before the current block.
    begin: Spot,
    /// The rounding or chamfer after the current block, and the block after that.
    ahead: Option<[Vec<u8>; 2]>,
    /// The rounding that the previous block has prepared.
    corner: Option<corner::Corner>,
    /// Tool names in order. They are numbered from 1.
    tools: Vec<Vec<u8>>,
    /// Labels with their positions in the input.
    labels: Option<HashMap<String, Spot>>,
    /// `CALL LBL 1 REP 3`: the line of the call, and the number of repeats left.
    repeats: Vec<(u64, u32)>,
}

impl Klartext {
    /// The value of a parameter.
    fn value(&self, name: &str) -> Option<f64> {
        self.values.get(name).copied()
    }
}

/// Whether the name is a parameter: `Q5`, `QL1`, `QR2`.
fn is_parameter(name: &str) -> bool {
    let number = ["QL", "QR", "Q"].iter().find_map(|start| name.strip_prefix(start));
    number.is_some_and(|number| !number.is_empty() && number.bytes().all(|byte| byte.is_ascii_digit()))
}
