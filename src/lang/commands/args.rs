//! What commands take.

/// What a command takes, and how much of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Args {
    /// The rest of the line.
    Text,
    /// `Y` or `N`.
    Switch,
    /// From so many to so many codes, `G54`, `M19` or plain numbers, which have this letter.
    Codes(char, u8, u8),
    /// From so many to so many codes of which the first moves the tool, and so must be a G code.
    Motion(u8, u8),
    /// From so many to so many letters, apart or together.
    Letters(u8, u8),
    /// From so many to so many whole numbers.
    Whole(u8, u8),
    /// A number.
    Number,
    /// A length or time that is not negative.
    Length,
    /// A length that is not zero either.
    LengthAboveZero,
    /// One of these words.
    Choice(&'static [&'static str]),
    /// From so many to so many words that the command reads itself, as described.
    Words(u8, u8, &'static str),
}

impl Args {
    /// How many arguments there may be, least and most. `None`: as many as there are.
    pub fn count(self) -> Option<(usize, usize)> {
        match self {
            Args::Text | Args::Letters(..) => None,
            Args::Switch | Args::Number | Args::Length | Args::LengthAboveZero | Args::Choice(_) => Some((1, 1)),
            Args::Codes(_, least, most)
            | Args::Motion(least, most)
            | Args::Whole(least, most)
            | Args::Words(least, most, _) => Some((least.into(), most.into())),
        }
    }
}
