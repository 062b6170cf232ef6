//! The arguments that commands take.

/// Which arguments a command takes, and how many.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Args {
    /// The rest of the line.
    Text,
    /// `Y` or `N`.
    Switch,
    /// Codes such as `G54` or `M19`, or plain numbers. The letter is added to plain numbers. The two values are the
    /// minimum and maximum count of codes.
    Codes(char, u8, u8),
    /// Codes; the two values are the minimum and maximum count of codes. The first code moves the tool, so this code
    /// must be a G code.
    Motion(u8, u8),
    /// Letters; the two values are the minimum and maximum count of letters. The letters may be separate words or one
    /// word.
    Letters(u8, u8),
    /// Whole numbers; the two values are the minimum and maximum count of arguments.
    Whole(u8, u8),
    /// A number.
    Number,
    /// A length or time that is not negative.
    Length,
    /// A length above zero.
    LengthAboveZero,
    /// One word from a list of allowed words.
    Choice(&'static [&'static str]),
    /// Words with a syntax that only this command has. The values are the minimum count of words, the maximum count of
    /// words, and a description.
    Words(u8, u8, &'static str),
}

impl Args {
    /// The least and greatest number of arguments. `None`: any number is allowed.
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
