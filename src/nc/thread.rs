//! G76 of LinuxCNC: a thread that is cut in passes.

use super::action::Rotation;
use super::block::Block;
use super::codes::letters;
use super::fault::{Done, refuse};
use super::out::Out;
use super::state::State;
use crate::diag::Code;

/// The maximum number of passes of a thread.
const MOST: f64 = 10_000.0;

struct Thread {
    pitch: f64,
    end: f64,
    peak: f64,
    full: f64,
    tan: f64,
    entry: bool,
    exit: bool,
    taper: f64,
    side: f64,
    start_x: f64,
    start_z: f64,
}

impl State {
    /// Makes all passes of a thread.
    pub(super) fn thread(&mut self, block: &Block, out: &mut Out<'_>) -> Done {
        if self.drive.spindle == Rotation::Stop {
            return refuse(Code::PN012, "G76 with the spindle stopped", "write M3 or M4 before G76");
        }
        let need = |letter: u8| match block.get(letter) {
            Some(value) => Ok(value),
            None => {
                let message = format!("G76 without {}", char::from(letter));
                refuse(Code::PN007, message, "G76 needs P, Z, I, J and K")
            }
        };
        // lengths along X are diameters under G7
        let scale = if self.modes.diameter { 0.5 } else { 1.0 };
        let (pitch, i, j, k) = (need(b'P')?, need(b'I')? * scale, need(b'J')? * scale, need(b'K')? * scale);
        let degression = block.get(b'R').unwrap_or(1.0).max(1.0);
        let checks = [
            (i == 0.0, "I is 0, but it must be the distance of the crest from the drive line"),
            (j <= 0.0, "J, the first cut, must be greater than 0"),
            (k <= j, "K, the full depth, must be greater than J"),
            (block.has(letters("ABC")), "rotary axes do not move in G76"),
            (self.tool.side.is_some(), "G76 under cutter compensation"),
        ];
        if let Some((_, message)) = checks.iter().find(|(wrong, _)| *wrong) {
            return refuse(Code::PN018, *message, "G76 P(pitch) Z(end) I(crest) J(first cut) K(depth)");
        }
        let target = self.target(block)?;
        // L selects the tapered ends; it has an effect only if E, the length of a taper, is greater than zero
        let taper = block.get(b'E').unwrap_or(0.0).max(0.0);
        let ends = block.get(b'L').filter(|_| taper > 0.0).unwrap_or(0.0);
        let mut tan = block.get(b'Q').unwrap_or(0.0).to_radians().tan();
        if target[2] > self.place.position[2] {
            tan = -tan;
        }
        let thread = Thread {
            pitch,
            end: target[2] + k * tan,
            peak: i.abs(),
            full: k,
            tan,
            entry: ends == 1.0 || ends == 3.0,
            exit: ends == 2.0 || ends == 3.0,
            taper: taper.copysign(self.place.position[2] - target[2]),
            side: i.signum(),
            start_x: self.place.position[0],
            start_z: self.place.position[2],
        };
        let full = thread.peak + k;
        let mut pass = 1.0f64;
        loop {
            let depth = thread.peak + j * pass.powf(1.0 / degression);
            if depth >= full {
                break;
            }
            self.pass(&thread, depth, out);
            pass += 1.0;
            if pass > MOST {
                return refuse(Code::PN018, "a thread of more than 10000 passes", "write a larger J");
            }
        }
        let springs = block.get(b'H').unwrap_or(0.0);
        if !(0.0..=100.0).contains(&springs) || springs.fract() != 0.0 {
            return refuse(Code::PN018, format!("H{springs} spring passes"), "write H0 to H100");
        }
        for _ in 0..=springs as u32 {
            self.pass(&thread, full, out);
        }
        let mut to = self.place.position;
        to[0] = thread.start_x;
        to[2] = target[2];
        self.place.rapid_to(to, out);
        Ok(())
    }

    fn pass(&mut self, thread: &Thread, depth: f64, out: &mut Out<'_>) {
        let Thread { pitch, end, peak, full, tan, taper, side, start_x, start_z, .. } = *thread;
        let x = |depth: f64| start_x + side * depth;
        let infeed = (depth - peak) * tan;
        let whole = peak + full;
        let lead_of_taper = pitch * taper.hypot(full) / taper.abs();
        let mut to = self.place.position;
        let start = start_z - infeed;
        (to[0], to[2]) = (x(depth - whole), start);
        self.place.rapid_to(to, out);
        if thread.entry {
            to[0] = x(depth - full);
            self.threaded(to, lead_of_taper, out);
            (to[0], to[2]) = (x(depth), start - taper);
            self.threaded(to, lead_of_taper, out);
        } else {
            to[0] = x(depth);
            self.place.rapid_to(to, out);
        }
        let target = end - infeed;
        to[2] = if thread.exit { target + taper } else { target };
        self.threaded(to, pitch, out);
        if thread.exit {
            (to[0], to[2]) = (x(depth - full), target);
            self.threaded(to, lead_of_taper, out);
        }
        to[0] = x(depth - whole);
        self.place.rapid_to(to, out);
    }

    fn threaded(&mut self, to: [f64; 6], lead: f64, out: &mut Out<'_>) {
        self.place.feed_to(to, self.drive.feed, Some(lead), out);
    }
}
