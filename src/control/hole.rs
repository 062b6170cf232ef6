//! What canned cycles make.

macro_rules! holes {
    ($($name:ident $text:literal $about:literal;)*) => {
        /// A hole that a canned cycle of a control makes. A control file names it by `makes`.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Hole { $(#[doc = $about] $name),* }

        impl Hole {
            /// All of them.
            pub const ALL: &[Hole] = &[$(Hole::$name),*];

            /// As control files write it.
            pub const fn name(self) -> &'static str {
                match self { $(Hole::$name => $text),* }
            }

            /// What a cycle with this hole does, in words.
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
    /// The hole that control files name so.
    pub fn parse(name: &str) -> Option<Hole> {
        Hole::ALL.iter().copied().find(|hole| hole.name() == name)
    }
}
