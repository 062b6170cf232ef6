//! Reads the size of a stock from text.

use std::str::FromStr;

/// A block of material in a work offset. Lengths are in the unit of the text until [`Stock::scaled`] converts them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stock {
    /// Least X and Y.
    pub least: [f64; 2],
    /// Greatest X and Y.
    pub greatest: [f64; 2],
    /// Z of the bottom; minus infinity if the text does not contain it.
    pub bottom: f64,
    /// Z of the top.
    pub top: f64,
}

impl Stock {
    /// The block with all lengths multiplied by a factor, for another unit.
    #[must_use]
    pub fn scaled(self, factor: f64) -> Stock {
        let Stock { least, greatest, bottom, top } = self;
        Stock {
            least: least.map(|value| value * factor),
            greatest: greatest.map(|value| value * factor),
            bottom: bottom * factor,
            top: top * factor,
        }
    }
}

const SHAPE: &str = "write the lowest and the highest position of each axis: \"X0..100 Y0..60 Z-20..0\"";

impl FromStr for Stock {
    type Err = String;

    /// Reads `X0..100 Y0..60 Z-20..0`, with spaces or commas between the axes. `Z0` sets only the top.
    fn from_str(text: &str) -> Result<Stock, String> {
        let mut ranges: [Option<[f64; 2]>; 3] = [None; 3];
        for part in text.split([' ', ',']).filter(|part| !part.is_empty()) {
            let mut letters = part.chars();
            let letter = letters.next().unwrap_or_default().to_ascii_uppercase();
            let axis = ['X', 'Y', 'Z'].iter().position(|axis| *axis == letter);
            let axis = axis.ok_or_else(|| format!("`{part}` does not begin with X, Y or Z: {SHAPE}"))?;
            let rest = letters.as_str();
            let (low, high) = match rest.split_once("..") {
                Some((low, high)) => (number(low), number(high)),
                None if axis == 2 => (Some(f64::NEG_INFINITY), number(rest)),
                None => (None, None),
            };
            let (Some(low), Some(high)) = (low, high) else {
                return Err(format!("`{part}` is not a range: {SHAPE}"));
            };
            if low >= high {
                return Err(format!("the lowest position in `{part}` is not below the highest: {SHAPE}"));
            }
            if ranges[axis].replace([low, high]).is_some() {
                return Err(format!("{letter} is given twice: {SHAPE}"));
            }
        }
        let [Some(x), Some(y), Some(z)] = ranges else {
            let missing = ['X', 'Y', 'Z'].into_iter().zip(ranges).filter(|(_, range)| range.is_none());
            let missing: Vec<String> = missing.map(|(letter, _)| letter.to_string()).collect();
            let verb = if missing.len() == 1 { "is" } else { "are" };
            return Err(format!("{} {verb} missing: {SHAPE}", missing.join(" and ")));
        };
        Ok(Stock { least: [x[0], y[0]], greatest: [x[1], y[1]], bottom: z[0], top: z[1] })
    }
}

/// A number that is finite and not farther from zero than `FARTHEST`.
fn number(text: &str) -> Option<f64> {
    text.parse::<f64>().ok().filter(|value| value.abs() <= FARTHEST)
}

/// A position farther from zero than this value is a typing error, in any unit.
const FARTHEST: f64 = 1e6;
