//! The kinds of holes that canned cycles make.

macro_rules! holes {
    ($($name:ident $text:literal $about:literal;)*) => {
        /// A kind of hole that a canned cycle makes. Control files select the kind of hole with the key `makes`.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Hole { $(#[doc = $about] $name),* }

        impl Hole {
            /// All holes.
            pub const ALL: &[Hole] = &[$(Hole::$name),*];

            /// The name in control files.
            pub const fn name(self) -> &'static str {
                match self { $(Hole::$name => $text),* }
            }

            /// A description of the hole.
            pub const fn about(self) -> &'static str {
                match self { $(Hole::$name => $about),* }
            }
        }
    };
}

holes! {
    Drill     "drill"     "Drilled in one stroke.";
    Peck      "peck"      "Drilled in pecks; the tool comes out between them.";
    Chipbreak "chipbreak" "Drilled in pecks; the tool stays in the hole.";
    Tap       "tap"       "A right-hand thread, tapped.";
    LeftTap   "left-tap"  "A left-hand thread, tapped.";
    Bore      "bore"      "Bored.";
    Back      "back"      "Bored from below.";
    Ream      "ream"      "Reamed.";
}

impl Hole {
    /// The hole with this name in control files.
    pub fn parse(name: &str) -> Option<Hole> {
        Hole::ALL.iter().copied().find(|hole| hole.name() == name)
    }
}
