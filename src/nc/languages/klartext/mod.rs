//! Klartext, the language of Heidenhain TNC controls.
//!
//! Sources: the manuals of TNC 320, iTNC 530 and TNC 640 (Klartext programming), and what public programs show.

mod block;
mod corner;
mod cycles;
mod define;
mod flow;

use std::collections::HashMap;

use crate::nc::call::Call;
use crate::nc::way::Spot;

/// What a program keeps besides the state of the machine.
#[derive(Debug, Default)]
pub struct Klartext {
    /// Q, QL and QR parameters by their names.
    values: HashMap<String, f64>,
    /// The drilling cycle that was defined last.
    cycle: Option<Call>,
    /// M89: it is called after every positioning block.
    calls_always: bool,
    /// The circle centre of `CC`.
    center: Option<[f64; 2]>,
    /// The radius of a polar position.
    radius: Option<f64>,
    /// The feed in force, in the program's units a minute.
    feed: Option<f64>,
    /// The feed of `TOOL CALL`, for `F AUTO`.
    tool_feed: Option<f64>,
    inch: bool,
    /// `BEGIN PGM` was read.
    begun: bool,
    /// Before the block that is read.
    begin: Spot,
    /// A rounding or chamfer that follows the block that is read, and the block after it.
    ahead: Option<[Vec<u8>; 2]>,
    /// The rounding that the block before prepared.
    corner: Option<corner::Corner>,
    /// Names of tools in their order; they count from 1.
    tools: Vec<Vec<u8>>,
    /// Labels with their places.
    labels: Option<HashMap<String, Spot>>,
    /// `CALL LBL 1 REP 3`: the line of the call, and how often it still goes back.
    repeats: Vec<(u64, u32)>,
}

impl Klartext {
    /// What a parameter holds.
    fn value(&self, name: &str) -> Option<f64> {
        self.values.get(name).copied()
    }
}

/// Is it the name of a parameter: `Q5`, `QL1`, `QR2`?
fn is_parameter(name: &str) -> bool {
    let number = ["QL", "QR", "Q"].iter().find_map(|start| name.strip_prefix(start));
    number.is_some_and(|number| !number.is_empty() && number.bytes().all(|byte| byte.is_ascii_digit()))
}
