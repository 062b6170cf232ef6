//! The arguments of the drilling cycles, and the values that they can have.

use self::Argument::{Only, Unsimulated, Used, Within};
use crate::diag::Code;
use crate::nc::fault::{Done, refuse};

/// An argument of a cycle.
#[derive(Clone, Copy)]
pub enum Argument {
    /// The cycle uses the value.
    Used,
    /// No move depends on the value, so postform does not simulate the argument. The text is its name.
    Unsimulated(&'static str),
    /// The cycle is run only if the argument has one of these values. An argument that is left out is 0.
    Only(&'static str, &'static [f64]),
    /// The cycle uses the value, which is at least the first and at most the second number. The text is its name.
    Within(&'static str, f64, f64),
}

/// The largest value of an argument without an upper limit.
const ANY: f64 = f64::INFINITY;
/// SDIS, the safety clearance, which is written without a sign.
const CLEARANCE: Argument = Within("SDIS", 0.0, ANY);
/// DAM of CYCLE83: by how much each stroke is shorter, or, if it is negative, the factor of the next stroke.
const SHORTER: Argument = Within("DAM", -1.0, ANY);
/// The feed of the first stroke, as a factor.
const FIRST_FEED: Argument = Within("FRF", 0.0, 1.0);

/// AXN, the axis along which the cycle drills: 0 and 3 are the axis perpendicular to the plane.
const AXIS: Argument = Only("AXN", &[0.0, 3.0]);
/// The rotation of the spindle for a bore: M3 or M4.
const TURNS: Argument = Only("SDIR", &[0.0, 3.0, 4.0]);
/// The rotation of the spindle after a tap: M3, M4 or M5.
const AFTER: Argument = Only("SDAC", &[0.0, 3.0, 4.0, 5.0]);
/// The technology of a tap: exact stop, precontrol and spindle control.
const TECHNO: Argument = Unsimulated("TECHNO");

/// The arguments that all cycles have: RTP, RFP, SDIS, DP and DPR.
pub const LEVELS: [Argument; 5] = [Used, Used, CLEARANCE, Used, Used];

/// For each cycle: its number, and its arguments after the ones of `LEVELS`.
const CYCLES: [(u16, &[Argument]); 10] = [
    (81, &[Used]),
    (82, &[Used]),
    // FDEP, FDPR, DAM, DTB, DTS, FRF, VARI, AXN, MDEP, VRT, DTD, DIS1
    (
        83,
        &[
            Used,
            Used,
            SHORTER,
            Used,
            Used,
            FIRST_FEED,
            Only("VARI", &[0.0, 1.0]),
            AXIS,
            Within("MDEP", 0.0, ANY),
            Within("VRT", 0.0, ANY),
            Used,
            Within("DIS1", 0.0, ANY),
        ],
    ),
    // DTB, SDAC, MPIT, PIT, POSS, SST, SST1, AXN, PTAB, TECHNO, VARI, DAM, VRT
    (
        84,
        &[
            Used,
            AFTER,
            Used,
            Used,
            Used,
            Used,
            Within("SST1", 0.0, ANY),
            AXIS,
            Used,
            TECHNO,
            Only("VARI", &[0.0, 1.0, 2.0]),
            Within("DAM", 0.0, ANY),
            Within("VRT", 0.0, ANY),
        ],
    ),
    // DTB, SDR, SDAC, ENC, MPIT, PIT, AXN
    (840, &[Used, Only("SDR", &[0.0, 3.0, 4.0]), AFTER, Only("ENC", &[0.0, 1.0]), Used, Used, AXIS]),
    // DTB, FFR, RFF
    (85, &[Used, Used, Used]),
    // DTB, SDIR, RPA, RPO, RPAP, POSS
    (86, &[Used, TURNS, Used, Used, Used, Used]),
    (87, &[TURNS]),
    (88, &[Used, TURNS]),
    (89, &[Used]),
];

/// The arguments of a cycle after the ones of `LEVELS`. `None`: the cycle is not supported.
pub fn of_cycle(number: u16) -> Option<&'static [Argument]> {
    CYCLES.iter().find(|(own, _)| *own == number).map(|(_, arguments)| *arguments)
}

/// Checks the arguments of a call from the index `first` on. Arguments that are not in `own` are not used by postform.
///
/// # Errors
/// An argument is not used, and has another value than 0, or its value is not among the values that it can have.
pub fn check_arguments(call: &str, arguments: &[Option<f64>], first: usize, own: &[Argument]) -> Done {
    for (at, value) in arguments.iter().enumerate().skip(first) {
        let value = value.unwrap_or(0.0);
        let (name, values) = match own.get(at - first) {
            Some(Used | Unsimulated(_)) => continue,
            Some(Within(_, least, most)) if (*least..=*most).contains(&value) => continue,
            Some(Within(name, least, most)) => {
                let range = if *most == ANY { format!("{least} or more") } else { format!("{least} to {most}") };
                let help = format!("write a value of {range} for {name}");
                return refuse(Code::PN016, format!("{call} with {name} {value} is not supported"), help);
            }
            Some(Only(name, values)) => (format!("{name} {value}"), *values),
            None => (format!("{value} as argument {}", at + 1), &[0.0][..]),
        };
        if !values.contains(&value) {
            let values: Vec<String> = values.iter().map(f64::to_string).collect();
            let help = format!("write {} for this argument, or leave it out", values.join(" or "));
            return refuse(Code::PN016, format!("{call} with {name} is not supported"), help);
        }
    }
    Ok(())
}
