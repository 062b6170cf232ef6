//! Feeds: a number and its unit.

const INCH: f64 = 25.4;

/// The feed in millimetres per minute. `word` is one of the words of "Cutting Feed" in the CYCLE chapter. `None` for
/// another word, or for a feed per revolution with the spindle stopped.
pub fn per_minute(word: &str, value: f64, file_unit: f64, revolutions: f64) -> Option<f64> {
    let (length, per_turn) = match word {
        "IPM" => (INCH, false),
        "IPR" => (INCH, true),
        "MMPM" => (1.0, false),
        "MMPR" => (1.0, true),
        "PERMIN" => (file_unit, false),
        "PERREV" => (file_unit, true),
        "TPI" => return (revolutions > 0.0).then(|| INCH / value * revolutions),
        _ => return None,
    };
    match per_turn {
        false => Some(value * length),
        true => (revolutions > 0.0).then_some(value * length * revolutions),
    }
}

/// Whether the word is the name of a feed unit.
pub fn is_feed(word: &str) -> bool {
    ["IPM", "IPR", "MMPM", "MMPR", "PERMIN", "PERREV", "TPI"].contains(&word)
}
