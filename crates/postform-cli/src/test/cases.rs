//! The standard cases: one job for each feature of programs. The files are in `cases/`.

/// A job by its name.
pub type Standard = (&'static str, &'static str);

macro_rules! cases {
    ($folder:literal: $($name:literal)*) => {
        &[$(($name, include_str!(concat!("../../cases/", $folder, "/", $name, ".json")))),*]
    };
}

/// For mills.
pub const MILL: &[Standard] = cases!("mill":
    "arc-in-xz" "arc-in-yz" "arcs" "bore" "bore-back" "chipbreak" "circle" "comments" "compensation-left"
    "compensation-right" "coolant-changes" "coolant-mist" "coolant-off" "coolant-through" "coolant-through-second"
    "countersink" "deep" "drill" "drill-at-heights" "drill-low-return" "drill-with-dwell" "dwell" "feed-per-turn"
    "helix" "home" "inch" "inch-compensation" "inch-compensation-right" "inch-deep" "inch-drill"
    "inch-drill-with-dwell" "inch-ream" "inch-tap" "lines" "long-travel" "many-offsets" "names" "offset-between-tools"
    "one-hole" "ream" "rotary" "small-steps" "speed-changes" "spindle-left" "stops" "subprogram" "tap" "tap-in-pecks"
    "tap-left" "tap-left-in-pecks" "tap-rigid" "tap-rigid-with-two-tools" "tool-again" "two-offsets" "two-operations"
    "two-tools"
);

/// For lathes.
pub const LATHE: &[Standard] = cases!("lathe":
    "arcs" "compensation" "coolant-off" "drill" "drill-in-pecks" "dwell" "face" "feed-per-minute" "home" "inch"
    "names" "revolutions" "spindle-left" "stop" "taper" "thread" "thread-inside" "thread-taper" "turn" "two-tools"
);

/// For wire EDM machines.
pub const WIRE: &[Standard] = cases!("wire":
    "arc" "names" "stop" "straight" "taper"
);

/// For torches and lasers.
pub const BEAM: &[Standard] = cases!("beam":
    "arcs" "feed-changes" "home" "names" "outline" "power" "stop" "two-cuts" "two-offsets" "two-tools"
);
