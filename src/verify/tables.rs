//! Tolerances of each quantity, and reasons for no proof: the tables of docs/verify.md.

/// Positions, in inches and millimetres. This is more than the rounding of digits.
pub(super) const PLACES: [f64; 2] = [1e-4, 2e-3];
/// The least tolerance of short lines from their arc, in inches and millimetres. The form's `Tolerance` may be more.
pub(super) const CHORDS: [f64; 2] = [0.001, 0.02];
/// Angles in degrees.
pub(super) const ANGLE: f64 = 0.001;
/// The angle of a stopped spindle, in degrees.
pub(super) const ORIENTED: f64 = 0.01;
/// Feeds, speeds and dwells, as a fraction of their value.
pub(super) const ROUNDED: f64 = 0.01;
/// Feed and speed of a tap, as a fraction of their value. Both define the pitch.
pub(super) const PITCH: f64 = 0.0025;
/// Dwells in seconds, if that is more than the fraction.
pub(super) const MOMENT: f64 = 0.001;
/// Longest dwell in a cut, in seconds, after a spindle, torch or laser was started. This value is our decision: spindles
/// come to speed and torches pierce within this time.
pub(super) const STARTED: f64 = 30.0;
/// Factor by which a peck may be longer than the job's longest peck.
pub(super) const LONGER: f64 = 1.5;
/// A last peck shorter than this fraction of the longest is a rest, which the program may leave out.
pub(super) const LEFT: f64 = 0.05;

/// The smallest digit of usual programs, in inches and millimetres, if no form defines the format of its letters.
pub(super) const INCREMENTS: [f64; 2] = [1e-4, 1e-3];
/// Range of the form's own feed or speed, as factors of the job's value.
pub(super) const OWN: [f64; 2] = [0.2, 2.0];

/// The tolerance of each quantity, as in docs/verify.md.
pub fn tolerances() -> Vec<[String; 2]> {
    let part = |part: f64| format!("{} % of itself", part * 100.0);
    let row = |quantity: &str, near: String| [quantity.to_owned(), near];
    let [inch, mm] = PLACES;
    let [chord, chord_mm] = CHORDS;
    vec![
        row("position", format!("{inch} inch or {mm} mm (`--tolerance`)")),
        row("line of a cut that is made of several moves", "as positions".into()),
        row("arc made of lines", format!("{chord} inch or {chord_mm} mm, or the form's `Tolerance`, from the arc")),
        row("arc made of arcs", "5 times as positions: centres are rounded too".into()),
        row("angle of a rotary axis", format!("{ANGLE} degrees")),
        row("angle of the spindle", format!("{ORIENTED} degrees")),
        row("feed", part(ROUNDED)),
        row("speed", format!("{}, but at least 0.5", part(ROUNDED))),
        row("feed and speed of a tap", part(PITCH)),
        row("feed or speed that the form sets itself", format!("{} to {} times the job's", OWN[0], OWN[1])),
        row("dwell", format!("{}, but at least {MOMENT} s", part(ROUNDED))),
        row(
            "peck",
            format!(
                "up to {LONGER} times the job's longest peck; also for the depth that is cut before the tool \
                 retracts out of the hole; a last peck below {} % of the longest may be left out",
                LEFT * 100.0
            ),
        ),
    ]
}

macro_rules! unmodelled {
    ($($name:ident $why:literal;)*) => {
        /// Parts of jobs that can't be proven.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(super) enum Unmodelled { $($name),* }

        impl Unmodelled {
            /// The reason why nothing is proven from this part on.
            pub fn why(self) -> &'static str {
                match self { $(Unmodelled::$name => $why),* }
            }
        }

        /// The reasons why jobs are not proven, as in docs/verify.md.
        pub const UNPROVEN: &[&str] = &[$($why),*];
    };
}

unmodelled! {
    Machine "the job is for a wire EDM machine, but the control is described only for mills";
    Wire "the job threads or cuts the wire, but the codes for it are unknown without a form";
    SlantedArc "a slanted wire moves along an arc";
    Threads "a thread is cut on a machine that is not a lathe";
    Tilted "the tool axis changes";
    MissingSubprogram "the job calls a subprogram that it does not have";
    LongSubprograms "subprograms of the job call each other endlessly, or are too long";
    Text "text of the job moves the tool, or changes the meaning of moves";
    ArcWithout "an arc has neither centre nor radius";
    HoleWithout "a hole has no height";
}
