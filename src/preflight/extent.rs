//! The range of positions that a program uses on an axis.

/// Least and greatest position, each with the line of the program that moves there.
#[derive(Clone, Copy, Debug)]
pub struct Extent {
    pub least: (f64, u64),
    pub greatest: (f64, u64),
}

impl Extent {
    pub fn of([least, greatest]: [f64; 2], line: u64) -> Extent {
        Extent { least: (least, line), greatest: (greatest, line) }
    }

    #[inline]
    pub fn reach(&mut self, [least, greatest]: [f64; 2], line: u64) {
        if least < self.least.0 {
            self.least = (least, line);
        }
        if greatest > self.greatest.0 {
            self.greatest = (greatest, line);
        }
    }
}
