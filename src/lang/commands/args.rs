//! Arguments of commands.

/// Kind and number of a command's arguments.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Args {
    /// The rest of the line.
    Text,
    /// `Y` or `N`.
    Switch,
    /// Codes such as `G54`, `M19` or plain numbers. The letter is that of plain numbers; the numbers are the least and
    /// greatest count.
    Codes(char, u8, u8),
    /// Codes, least and greatest count. The first one moves the tool, so it must be a G code.
    Motion(u8, u8),
    /// Letters, least and greatest count. They may be separate or together.
    Letters(u8, u8),
    /// Whole numbers, least and greatest count.
    Whole(u8, u8),
    /// A number.
    Number,
    /// A length or time that is not negative.
    Length,
    /// A length above zero.
    LengthAboveZero,
    /// One of these words.
    Choice(&'static [&'static str]),
    /// Words that the command reads itself, least and greatest count, with a description.
    Words(u8, u8, &'static str),
}

impl Args {
    /// The least and greatest number of arguments. `None`: any number.
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
