//! How near each quantity must be, and what is not proven: the tables of docs/verify.md.

/// Places, in inches and millimetres: more than what digits are rounded off.
pub(super) const PLACES: [f64; 2] = [1e-4, 2e-3];
/// The least that short lines may leave their arc, in inches and millimetres; more where the form's `Tolerance` is.
pub(super) const CHORDS: [f64; 2] = [0.001, 0.02];
/// Angles in degrees.
pub(super) const ANGLE: f64 = 0.001;
/// The angle at which the spindle stands, in degrees.
pub(super) const ORIENTED: f64 = 0.01;
/// Feeds, speeds and dwells, as a part of themselves.
pub(super) const ROUNDED: f64 = 0.01;
/// Feed and speed of a tap, as a part of themselves: they make its pitch.
pub(super) const PITCH: f64 = 0.0025;
/// Dwells in seconds, where that is more.
pub(super) const MOMENT: f64 = 0.001;
/// How long a program may wait in a cut for a spindle, a torch or a laser that was just started, in seconds. Decided by us: spindles
/// come to speed and torches pierce within it.
pub(super) const STARTED: f64 = 30.0;
/// How much longer than the job's longest peck one may be, as a factor.
pub(super) const LONGER: f64 = 1.5;
/// A last peck shorter than this part of the longest is what was left, and need not be one of its own.
pub(super) const LEFT: f64 = 0.05;

/// One digit of usual programs, in inches and millimetres: where no form gives the format of its letters.
pub(super) const INCREMENTS: [f64; 2] = [1e-4, 1e-3];
/// From what part of the job's feed or speed to how many times it the form's own may be.
pub(super) const OWN: [f64; 2] = [0.2, 2.0];

/// How near each quantity must be, as docs/verify.md says it.
pub fn tolerances() -> Vec<[String; 2]> {
    let part = |part: f64| format!("{} % of itself", part * 100.0);
    let row = |quantity: &str, near: String| [quantity.to_owned(), near];
    let [inch, mm] = PLACES;
    let [chord, chord_mm] = CHORDS;
    vec![
        row("place", format!("{inch} inch or {mm} mm (`--tolerance`)")),
        row("line of a cut that is made of parts", "as places".into()),
        row("arc made of lines", format!("{chord} inch or {chord_mm} mm, or the form's `Tolerance`, from the arc")),
        row("arc made of arcs", "5 times as places: centres are rounded too".into()),
        row("angle of a rotary axis", format!("{ANGLE} degrees")),
        row("angle of the spindle", format!("{ORIENTED} degrees")),
        row("feed", part(ROUNDED)),
        row("speed", format!("{}, and never less than 0.5", part(ROUNDED))),
        row("feed and speed of a tap", part(PITCH)),
        row("feed or speed of the form's own", format!("{} to {} times the job's", OWN[0], OWN[1])),
        row("dwell", format!("{}, and never less than {MOMENT} s", part(ROUNDED))),
        row(
            "peck",
            format!(
                "up to {LONGER} times the job's longest, and what is cut before the tool comes out; a last one under {} % of it may be left out",
                LEFT * 100.0
            ),
        ),
    ]
}

macro_rules! unmodelled {
    ($($name:ident $why:literal;)*) => {
        /// What no proof is made of.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(super) enum Unmodelled { $($name),* }

        impl Unmodelled {
            /// Why nothing is proven from there on.
            pub fn why(self) -> &'static str {
                match self { $(Unmodelled::$name => $why),* }
            }
        }

        /// Why jobs are not proven, as docs/verify.md lists it.
        pub const UNPROVEN: &[&str] = &[$($why),*];
    };
}

unmodelled! {
    Machine "the job is for a wire EDM machine, and its control is described as a mill's alone";
    Wire "the job threads or cuts the wire, and no form says by which codes";
    SlantedArc "a wire that slants goes along an arc";
    Threads "a thread is not cut on a lathe";
    Tilted "the tool axis changes";
    MissingSubprogram "the job calls a subprogram that it does not have";
    LongSubprograms "subprograms of the job call each other without an end, or are longer than is held";
    Text "text of the job moves the tool, or changes what moves mean";
    ArcWithout "an arc has neither centre nor radius";
    HoleWithout "a hole has no height";
}
