//! The tolerance of each quantity, and the reasons why a job can't be proven: the tables of docs/verify.md.

/// Tolerance of positions, in inches and millimetres. The tolerance is greater than the rounding of the printed digits.
pub(super) const PLACES: [f64; 2] = [1e-4, 2e-3];
/// Deviation that is always allowed if short lines replace an arc, in inches and millimetres. The form's `Tolerance`
/// may allow a greater deviation.
pub(super) const CHORDS: [f64; 2] = [0.001, 0.02];
/// Tolerance of angles, in degrees.
pub(super) const ANGLE: f64 = 0.001;
/// Tolerance of the angle of a stopped spindle, in degrees.
pub(super) const ORIENTED: f64 = 0.01;
/// Tolerance of feeds, speeds and dwells, as a fraction of the value.
pub(super) const ROUNDED: f64 = 0.01;
/// Tolerance of the feed and speed of a tap, as a fraction of the value. Feed and speed of a tap define the pitch of
/// the thread.
pub(super) const PITCH: f64 = 0.0025;
/// Tolerance of dwells in seconds. This tolerance applies if it is greater than the tolerance as a fraction of the
/// dwell.
pub(super) const MOMENT: f64 = 0.001;
/// Longest dwell in a cut, in seconds, after a spindle, torch or laser was started. We chose this limit, because a
/// spindle comes to speed and a torch pierces within this time.
pub(super) const STARTED: f64 = 30.0;
/// Factor by which a peck of the program may be longer than the longest peck of the job.
pub(super) const LONGER: f64 = 1.5;
/// The last peck is a remainder if it is shorter than this fraction of the longest peck. The program may leave out a
/// remainder.
pub(super) const LEFT: f64 = 0.05;

/// The smallest step that programs usually print, in inches and millimetres. This step is used if no form defines the
/// formats of letters.
pub(super) const INCREMENTS: [f64; 2] = [1e-4, 1e-3];
/// Range of a feed or speed that the form itself defines, as factors of the job's value.
pub(super) const OWN: [f64; 2] = [0.2, 2.0];

/// Each quantity with its tolerance as text, as in docs/verify.md.
pub fn tolerances() -> Vec<[String; 2]> {
    let part = |part: f64| format!("{} % of the value", part * 100.0);
    let row = |quantity: &str, near: String| [quantity.to_owned(), near];
    let [inch, mm] = PLACES;
    let [chord, chord_mm] = CHORDS;
    vec![
        row("position", format!("{inch} inch or {mm} mm (`--tolerance`)")),
        row("distance of several moves from the straight cut that they replace", "as for positions".into()),
        row("arc made of lines", format!("{chord} inch or {chord_mm} mm, or the form's `Tolerance`, from the arc")),
        row("arc made of arcs", "5 times the tolerance of positions, because centres are rounded too".into()),
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
                "up to {LONGER} times the job's longest peck; the depth that is cut between two retracts out of the \
                 hole: up to {LONGER} times the greatest such depth in the job; if the job's last peck is shorter than \
                 {} % of its longest peck, the program may leave it out",
                LEFT * 100.0
            ),
        ),
    ]
}

macro_rules! unmodelled {
    ($($name:ident $why:literal;)*) => {
        /// The parts of jobs that can't be proven.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(super) enum Unmodelled { $($name),* }

        impl Unmodelled {
            /// The reason why nothing is proven after this part of the job.
            pub fn why(self) -> &'static str {
                match self { $(Unmodelled::$name => $why),* }
            }
        }

        /// The reasons why jobs are not proven, as in docs/verify.md.
        pub const UNPROVEN: &[&str] = &[$($why),*];
    };
}

unmodelled! {
    Machine "the job is for a wire EDM machine, but postform does not simulate this control on wire EDM machines";
    Wire "the job threads or cuts the wire, but no form gives the codes for these actions";
    SlantedArc "a slanted wire moves along an arc";
    Threads "a thread is cut on a machine that is not a lathe";
    Tilted "the tool axis changes";
    MissingSubprogram "the job calls a subprogram that it does not have";
    LongSubprograms "subprograms of the job call each other endlessly, or are too long";
    Text "text of the job moves the tool, or changes the meaning of moves";
    ArcWithout "an arc has neither centre nor radius";
    HoleWithout "the job does not give the height of a hole";
}
