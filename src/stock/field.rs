//! The heights of a stock.

use super::size::Stock;
use super::sweep::Shape;

/// The finest cell in millimetres, and the most cells along a side.
const FINEST: f64 = 0.25;
const MOST_CELLS: f64 = 1000.0;
/// A rapid may be this much below the surface, in millimetres: a cell is no finer.
const TOLERANCE: f64 = 0.2;

/// The deepest point of a rapid in the stock.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Position in X and Y, in millimetres.
    pub at: [f64; 2],
    /// Depth below the surface.
    pub depth: f64,
}

/// A stock as heights of cells.
#[derive(Clone, Debug)]
pub struct Field {
    block: Stock,
    cell: f64,
    wide: usize,
    deep: usize,
    heights: Vec<f32>,
}

/// Size of the cells of a block.
pub fn cell_of(block: &Stock) -> f64 {
    let side = |axis: usize| block.greatest[axis] - block.least[axis];
    FINEST.max(side(0).max(side(1)) / MOST_CELLS)
}

impl Field {
    /// The uncut block, in millimetres.
    pub fn new(block: &Stock) -> Field {
        let cell = cell_of(block);
        let count = |axis: usize| ((block.greatest[axis] - block.least[axis]) / cell).ceil().max(1.0) as usize;
        let (wide, deep) = (count(0), count(1));
        Field { block: *block, cell, wide, deep, heights: vec![block.top as f32; wide * deep] }
    }

    /// Removes what a tool covers on a straight move of its tip.
    pub fn cut(&mut self, shape: Shape, from: [f64; 3], to: [f64; 3]) {
        let way: [f64; 3] = std::array::from_fn(|axis| to[axis] - from[axis]);
        let lowest = from[2].min(to[2]) as f32;
        if f64::from(lowest) >= self.block.top {
            return;
        }
        let [columns, rows] = self.around(from, to, shape.radius);
        for row in rows {
            let y = self.middle(1, row) - from[1];
            for column in columns.clone() {
                let height = &mut self.heights[row * self.wide + column];
                if *height <= lowest {
                    continue;
                }
                let x = self.block.least[0] + (column as f64 + 0.5) * self.cell - from[0];
                if let Some(lowest) = shape.lowest([x, y], from[2], way) {
                    *height = height.min(lowest as f32);
                }
            }
        }
    }

    /// The deepest point at which a tool is below the surface on a straight move of its tip. A cell at the edge of the tool is
    /// not looked at: its surface may be up to a cell farther away.
    pub fn hit(&self, shape: Shape, from: [f64; 3], to: [f64; 3]) -> Option<Hit> {
        if from[2].min(to[2]) >= self.block.top || Field::is_too_thin(shape, self.cell) {
            return None;
        }
        // the cell under the axis is always looked at
        let radius = (shape.radius - self.cell).max(self.cell * std::f64::consts::FRAC_1_SQRT_2);
        let shape = Shape { radius, corner: shape.corner.min(radius) };
        let way: [f64; 3] = std::array::from_fn(|axis| to[axis] - from[axis]);
        let mut deepest: Option<Hit> = None;
        let [columns, rows] = self.around(from, to, radius);
        for row in rows {
            let y = self.middle(1, row);
            for column in columns.clone() {
                let height = f64::from(self.heights[row * self.wide + column]);
                if height <= self.block.bottom || height - TOLERANCE <= from[2].min(to[2]) {
                    continue;
                }
                let x = self.middle(0, column);
                let Some(lowest) = shape.lowest([x - from[0], y - from[1]], from[2], way) else { continue };
                let depth = height - lowest.max(self.block.bottom);
                if depth > TOLERANCE && deepest.is_none_or(|found| found.depth < depth) {
                    deepest = Some(Hit { at: [x, y], depth });
                }
            }
        }
        deepest
    }

    /// Whether a tool is too thin to be checked against cells of this size.
    pub fn is_too_thin(shape: Shape, cell: f64) -> bool {
        shape.radius <= cell
    }

    /// The middle of a column (axis 0) or row (axis 1).
    fn middle(&self, axis: usize, at: usize) -> f64 {
        self.block.least[axis] + (at as f64 + 0.5) * self.cell
    }

    /// The columns and rows that a tool may touch.
    fn around(&self, from: [f64; 3], to: [f64; 3], radius: f64) -> [std::ops::Range<usize>; 2] {
        [(0, self.wide), (1, self.deep)].map(|(axis, cells)| {
            // a conversion to usize is 0 for negative numbers
            let cell = |at: f64| (at - self.block.least[axis]) / self.cell;
            let low = cell(from[axis].min(to[axis]) - radius).floor() as usize;
            let high = (cell(from[axis].max(to[axis]) + radius).ceil() as usize).min(cells);
            low.min(high)..high
        })
    }
}
