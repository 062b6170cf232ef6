//! The table of text variables: names and comments of the job, the date, and texts of the form itself.

/// One row of the table of text variables.
#[derive(Debug)]
pub struct Text {
    /// Identifier of the text.
    pub id: TextId,
    /// Name of the text, as it is written between brackets.
    pub name: &'static str,
    /// Description of the text.
    pub meaning: &'static str,
    /// Where the text comes from.
    pub from: &'static str,
}

macro_rules! texts {
    ($($id:ident $name:literal $meaning:literal $from:literal)*) => {
        /// A text variable.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum TextId {
            $(#[doc = $meaning] $id),*
        }

        /// All text variables.
        pub const TEXTS: &[Text] = &[$(Text { id: TextId::$id, name: $name, meaning: $meaning, from: $from }),*];
    };
}

#[rustfmt::skip]
texts! {
    Progname "progname" "the program's name"                     "`name` of the job; PARTNO of a CL file (without PARTNO, a PPRINT before the first operation), the comment after the O number of an NC program, or the label of a FreeCAD job"
    Partname "partname" "the name of the part"                   "`part` of the job, or the label of a FreeCAD document"
    Material "material" "the material of the part"               "`material` of the job"
    Customer "customer" "the customer of the part"                      "`customer` of the job"
    Author   "author"   "the author of the job"                       "`author` of the job; `CreatedBy` of a FreeCAD document. A CL file gives no author"
    Toolname "toolname" "the tool's name"                        "`name` of the tool"
    Tooltext "tooltext" "the job's comment on the tool"          "`comment` of the tool"
    Opname   "opname"   "the operation's name"                   "`name` of the operation"
    Optext   "optext"   "the comment of the operation in the job"     "`comment` of the operation"
    Text     "text"     "in CommentLine: the comment that is printed" "`comment` items"
    Date     "date"     "the date of printing, such as 2026-03-31"     "the clock, --date or SOURCE_DATE_EPOCH"
    Time     "time"     "the time of printing, such as 14:05"         "the clock, --date or SOURCE_DATE_EPOCH"
    Jobfile  "jobfile"  "the job's file, without its folder"     "the command line"
    Formname "formname" "the form's name"                        "`Name` of the form; without `Name`, the file name of the form"
    Formhash "formhash" "the first 12 digits of a SHA-256 hash of the form and the forms that it calls" "the form"
    Control  "control"  "the name of the control in the form"        "`Control` of the form"
    Version  "version"  "postform's version"                     "postform"
}

/// Number of texts.
pub const TEXT_COUNT: usize = TEXTS.len();

/// A set of texts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct TextSet(u32);

impl TextSet {
    /// Adds a text.
    pub fn insert(&mut self, id: TextId) {
        self.0 |= 1 << id as u32;
    }

    /// Whether the text is in the set.
    pub fn has(self, id: TextId) -> bool {
        self.0 & 1 << id as u32 != 0
    }

    /// The texts of both sets.
    #[must_use]
    pub fn with(self, other: TextSet) -> TextSet {
        TextSet(self.0 | other.0)
    }
}

impl TextId {
    /// The row of the text in the table.
    pub fn row(self) -> &'static Text {
        &TEXTS[self as usize]
    }

    /// Finds a text by its name; upper and lower case are equal.
    pub fn parse(name: &str) -> Option<TextId> {
        TEXTS.iter().find(|text| text.name.eq_ignore_ascii_case(name)).map(|text| text.id)
    }
}

/// A text variable with its width, such as `[toolname:12]`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TextVar {
    /// Identifier of the text.
    pub id: TextId,
    /// Number of characters to which the text is padded or cut. If this number is negative, the text is aligned to the
    /// right. If it is 0, the text keeps its length.
    pub width: i8,
}

/// The greatest width.
pub const WIDEST: i8 = 100;

impl TextVar {
    /// Whether the name, with or without a width, is the name of a text.
    pub fn is_text(name: &str) -> bool {
        TextId::parse(name.split(':').next().unwrap_or(name)).is_some()
    }

    /// Reads a name with an optional width. `None`: the name is unknown or the width is invalid.
    pub fn parse(name: &str) -> Option<TextVar> {
        let (name, width) = name.split_once(':').map_or((name, None), |(name, width)| (name, Some(width)));
        let id = TextId::parse(name)?;
        let digits = |text: &str| text.trim_start_matches('-').bytes().all(|b| b.is_ascii_digit());
        let width = match width {
            None => 0,
            Some(text) => {
                let right = |width: &i8| *width != 0 && (-WIDEST..=WIDEST).contains(width);
                text.parse::<i8>().ok().filter(|width| right(width) && digits(text))?
            }
        };
        Some(TextVar { id, width })
    }
}

impl std::fmt::Display for TextVar {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.width {
            0 => write!(f, "[{}]", self.id.row().name),
            width => write!(f, "[{}:{width}]", self.id.row().name),
        }
    }
}

/// Returns the character if a word may contain this character, otherwise `None`.
pub fn in_word(c: char) -> Option<char> {
    Some(c).filter(|c| c.is_ascii_alphanumeric() || "_-.".contains(*c))
}

/// Returns the character if a typed text in quotation marks may contain this character, otherwise `None`. The character
/// must not end the quotation, a block or a comment.
pub fn in_quotes(c: char) -> Option<char> {
    in_word(c).or(Some(c).filter(|c| " ,:/+*=<>&'#[]".contains(*c)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_have_widths() {
        let var = |id, width| Some(TextVar { id, width });
        assert_eq!(TextVar::parse("ToolName"), var(TextId::Toolname, 0));
        assert_eq!(TextVar::parse("toolname:12"), var(TextId::Toolname, 12));
        assert_eq!(TextVar::parse("toolname:-12"), var(TextId::Toolname, -12));
        for wrong in ["toolname:", "toolname:0", "toolname:101", "toolname:+5", "toolname:1.5", "tool:5", "toolnam"] {
            assert_eq!(TextVar::parse(wrong), None, "{wrong}");
        }
        assert!(TextVar::is_text("toolname:x") && !TextVar::is_text("tool"));
    }

    #[test]
    fn no_text_has_the_name_of_a_number() {
        const { assert!(TEXT_COUNT <= 32) }; // a TextSet has 32 bits
        assert!(TEXTS.iter().all(|text| crate::lang::VarId::parse(text.name).is_none()));
    }
}
