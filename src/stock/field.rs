//! The stock as a grid of heights.

use std::ops::Range;

use super::size::Stock;
use super::sweep::Shape;

/// The smallest size of a cell in millimetres, and the greatest number of cells along a side of the stock.
const FINEST: f64 = 0.25;
const MOST_CELLS: f64 = 1000.0;
/// A rapid that is at most this distance (in millimetres) below the surface is no finding, because the cells are not
/// finer.
const TOLERANCE: f64 = 0.2;

/// The deepest point of a rapid that goes through the stock.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Position in X and Y, in millimetres.
    pub at: [f64; 2],
    /// Depth below the surface, in millimetres.
    pub depth: f64,
}

/// A stock as a grid of cells, each with its height.
#[derive(Clone, Debug)]
pub struct Field {
    block: Stock,
    cell: f64,
    wide: usize,
    deep: usize,
    heights: Vec<f32>,
}

/// Size of the cells of a stock, in millimetres.
pub fn cell_of(block: &Stock) -> f64 {
    let side = |axis: usize| block.greatest[axis] - block.least[axis];
    FINEST.max(side(0).max(side(1)) / MOST_CELLS)
}

impl Field {
    /// The stock before any cut. `block` is in millimetres.
    pub fn new(block: &Stock) -> Field {
        let cell = cell_of(block);
        let count = |axis: usize| ((block.greatest[axis] - block.least[axis]) / cell).ceil().max(1.0) as usize;
        let (wide, deep) = (count(0), count(1));
        Field { block: *block, cell, wide, deep, heights: vec![block.top as f32; wide * deep] }
    }

    /// Removes the material that a tool cuts while its tip moves along a straight line.
    pub fn cut(&mut self, shape: Shape, from: [f64; 3], to: [f64; 3]) {
        let way: [f64; 3] = std::array::from_fn(|axis| to[axis] - from[axis]);
        let lowest = from[2].min(to[2]) as f32;
        if f64::from(lowest) >= self.block.top {
            return;
        }
        for row in self.rows(from, to, shape.radius) {
            let y = self.middle(1, row) - from[1];
            for column in self.columns(row, from, to, shape.radius) {
                let x = self.middle(0, column) - from[0];
                let height = &mut self.heights[row * self.wide + column];
                if *height <= lowest {
                    continue;
                }
                if let Some(lowest) = shape.lowest([x, y], from[2], way) {
                    *height = height.min(lowest as f32);
                }
            }
        }
    }

    /// The deepest point at which a tool is below the surface while its tip moves along a straight line. Cells at the
    /// edge of the tool are left out: their surface may be up to one cell farther away.
    pub fn hit(&self, shape: Shape, from: [f64; 3], to: [f64; 3]) -> Option<Hit> {
        if from[2].min(to[2]) >= self.block.top || Field::is_too_thin(shape, self.cell) {
            return None;
        }
        // the cell under the axis of the tool is always checked
        let radius = (shape.radius - self.cell).max(self.cell * std::f64::consts::FRAC_1_SQRT_2);
        let shape = Shape { radius, corner: shape.corner.min(radius) };
        let way: [f64; 3] = std::array::from_fn(|axis| to[axis] - from[axis]);
        let mut deepest: Option<Hit> = None;
        for row in self.rows(from, to, radius) {
            let y = self.middle(1, row);
            for column in self.columns(row, from, to, radius) {
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

    /// Whether a tool is too thin to be checked with cells of this size.
    pub fn is_too_thin(shape: Shape, cell: f64) -> bool {
        shape.radius <= cell
    }

    /// The coordinate of the middle of a column (axis 0) or of a row (axis 1).
    fn middle(&self, axis: usize, at: usize) -> f64 {
        self.block.least[axis] + (at as f64 + 0.5) * self.cell
    }

    /// The rows that a tool may touch while its tip moves along a straight line.
    fn rows(&self, from: [f64; 3], to: [f64; 3], radius: f64) -> Range<usize> {
        self.cells(1, from[1].min(to[1]) - radius, from[1].max(to[1]) + radius)
    }

    /// The columns of a row that the tool may touch. Only the part of the move near the row is considered.
    fn columns(&self, row: usize, from: [f64; 3], to: [f64; 3], radius: f64) -> Range<usize> {
        let way: [f64; 2] = std::array::from_fn(|axis| to[axis] - from[axis]);
        let beside = [-radius, radius].map(|by| (self.middle(1, row) + by - from[1]) / way[1]);
        let [first, last] = match way[1] == 0.0 {
            true => [0.0, 1.0],
            false => [beside[0].min(beside[1]).max(0.0), beside[0].max(beside[1]).min(1.0)],
        };
        if first > last {
            return 0..0;
        }
        let ends = [first, last].map(|part| from[0] + way[0] * part);
        self.cells(0, ends[0].min(ends[1]) - radius, ends[0].max(ends[1]) + radius)
    }

    /// The columns (axis 0) or rows (axis 1) between two positions.
    fn cells(&self, axis: usize, low: f64, high: f64) -> Range<usize> {
        let count = if axis == 0 { self.wide } else { self.deep };
        // a negative number becomes 0 when it is converted to usize
        let cell = |at: f64| (at - self.block.least[axis]) / self.cell;
        let high = (cell(high).ceil() as usize).min(count);
        (cell(low).floor() as usize).min(high)..high
    }
}
