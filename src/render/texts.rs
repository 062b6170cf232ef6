//! Names and comments of the job: their values, and their conversion for comments and words.

use super::ascii::plain;
use super::comment_marks::in_comment;
use super::fault::{Done, fault};
use super::layout::LONGEST;
use super::printer::Printer;
use super::shape::Shape;
use std::collections::HashMap;
use std::fmt::Display;

use crate::compile::Op;
use crate::diag::Code;
use crate::lang::{TEXT_COUNT, TextId, in_quotes, in_word};
use crate::toolpath::{Start, ToolChange};

/// Values of text variables, by slot. Texts that the form does not print are not stored.
#[derive(Clone, Debug, Default)]
pub struct Texts([String; TEXT_COUNT]);

impl Texts {
    /// A text of the job; empty if the job does not have the text.
    pub fn get(&self, id: TextId) -> &str {
        &self.0[id as usize]
    }

    fn set(&mut self, id: TextId, text: Option<&str>, shape: &Shape) {
        if shape.program.texts_printed.has(id) {
            let slot = &mut self.0[id as usize];
            slot.clear();
            slot.push_str(text.unwrap_or_default().trim());
        }
    }

    /// Stores the comment that is printed now.
    pub fn say(&mut self, comment: &str) {
        comment.clone_into(&mut self.0[TextId::Text as usize]);
    }

    /// Stores the texts from the head of the job, the form and the caller.
    pub fn start(&mut self, start: &Start, shape: &Shape) {
        let (about, options, program) = (&start.about, &shape.options, shape.program);
        let clock = options.clock.as_ref();
        for (id, text) in [
            (TextId::Progname, start.name.as_deref()),
            (TextId::Partname, about.part.as_deref()),
            (TextId::Material, about.material.as_deref()),
            (TextId::Customer, about.customer.as_deref()),
            (TextId::Author, about.author.as_deref()),
            (TextId::Date, clock.map(|clock| clock.date.as_str())),
            (TextId::Time, clock.map(|clock| clock.time.as_str())),
            (TextId::Jobfile, options.job_file.as_deref()),
            (TextId::Formname, Some(&program.name)),
            (TextId::Formhash, Some(&program.hash)),
            (TextId::Control, program.settings.control.map(|control| control.name())),
            (TextId::Version, Some(env!("CARGO_PKG_VERSION"))),
        ] {
            self.set(id, text, shape);
        }
    }

    /// Stores the texts of an operation and its tool.
    pub fn operation(&mut self, change: &ToolChange, shape: &Shape) {
        let tool = change.tool.as_ref();
        for (id, text) in [
            (TextId::Opname, &change.name),
            (TextId::Optext, &change.comment),
            (TextId::Toolname, &tool.and_then(|tool| tool.name.clone())),
            (TextId::Tooltext, &tool.and_then(|tool| tool.comment.clone())),
        ] {
            self.set(id, text.as_deref(), shape);
        }
    }
}

/// Whether all texts of a comment are empty. `property` returns whether the text of a property is empty.
pub fn are_empty(comment: &[Op], texts: &Texts, property: &dyn Fn(u16) -> bool) -> bool {
    comment.iter().all(|op| match op {
        Op::TextVar { var, .. } => texts.get(var.id).is_empty(),
        Op::PropertyText { row, .. } => property(*row),
        _ => true,
    })
}

/// Tool names that words have printed, with the original name of each tool.
#[derive(Clone, Debug, Default)]
pub struct Names(HashMap<String, String>);

impl Names {
    /// Checks a tool name that is printed as a word. The control selects the tool by its name, so the name must not be
    /// empty, and no other tool may print the same name.
    pub fn tool(&mut self, text: &Text, out: &Printer) -> Done {
        let own = plain_word(text, fits(out));
        if text.text.is_empty() {
            let help = "give the tool a `name` in the job, or test it first: `@if [toolname]`";
            return fault(
                Code::PR001,
                format!("{} has no value here, but the control selects tools by it", text.name),
                help,
            );
        }
        let other = self.0.entry(own.clone()).or_insert_with(|| text.text.to_owned());
        if *other == text.text {
            return Ok(());
        }
        let message = format!("the tools `{other}` and `{}` both print as {own}", text.text);
        fault(Code::PR057, message, "give the tools names with different letters, digits or _ - .")
    }
}

/// A text as printed in a word, without the spaces that fill the width of the text.
fn plain_word(text: &Text, fits: fn(char) -> Option<char>) -> String {
    let wide = usize::from(text.width.unsigned_abs());
    let most = if wide == 0 { usize::MAX } else { wide };
    text.text.chars().take(most).map(|c| fits(c).unwrap_or('_')).collect()
}

/// The filter for characters outside comments, depending on the text before them.
fn fits(out: &Printer) -> fn(char) -> Option<char> {
    if out.is_in_quotes() { in_quotes } else { in_word }
}

/// A text with its name and width.
pub struct Text<'a> {
    pub name: &'a dyn Display,
    pub width: i8,
    pub text: &'a str,
}

/// Prints a text of the job. In a comment, the characters of the text are converted for comments, and the text is cut
/// to the control's line length. `behind`: the space that the rest of the block needs; `None` outside comments. Outside
/// comments, only letters, digits and `_ - .` are kept. Between quotation marks, spaces and signs are kept too.
pub fn print(text: &Text, behind: Option<usize>, glued: bool, shape: &Shape, out: &mut Printer) {
    let Text { name, width, text } = *text;
    let settings = &shape.program.settings;
    let spelt = if behind.is_some() { plain(text) } else { text.into() };
    let text = &*spelt;
    let full = text.chars().count();
    let wide = usize::from(width.unsigned_abs());
    let most = if wide == 0 { full } else { wide };
    let room = match behind {
        Some(behind) => room(shape).saturating_sub(out.length() + behind).min(most),
        None => most,
    };
    if room < most.min(full) {
        let message = format!("{name} is cut to {room} characters: the control's line is full");
        out.note(Code::PR050, message, "shorten the text in the job, or print it on a separate line");
    }
    let taken = full.min(room);
    let blanks = room - taken;
    let in_brackets = out.is_in_brackets();
    let fits = fits(out);
    let block = out.word(glued);
    if width < 0 {
        block.extend(std::iter::repeat_n(b' ', blanks));
    }
    let mut changed = false;
    for c in text.chars().take(taken) {
        block.push(match c {
            c if behind.is_some() => in_comment(c, in_brackets, settings),
            c => fits(c).map_or_else(
                || {
                    changed = true;
                    b'_'
                },
                |c| c as u8,
            ),
        });
    }
    if width > 0 {
        block.extend(std::iter::repeat_n(b' ', blanks));
    }
    if changed {
        let message = format!("{name}, `{text}`, has characters that can't be in a word: each is printed as `_`");
        out.note(
            Code::PR050,
            message,
            "use only letters, digits and _ - . in the text, or print it in quotation marks or in a comment",
        );
    }
}

/// Number of characters available in a block, without its number and end.
pub fn room(shape: &Shape) -> usize {
    let settings = &shape.program.settings;
    let number = settings.numbers.letter.map_or(0, |letter| usize::from(shape.letters[letter].format.int.count) + 2);
    let longest = settings.control().traits().longest_line.unwrap_or(LONGEST);
    longest.saturating_sub(number + settings.eob.len())
}

/// Number of typed characters after an operation on its line.
pub fn typed_behind(at: usize, shape: &Shape) -> usize {
    let program = shape.program;
    let line = program.ops[at + 1..].iter().take_while(|op| !matches!(op, Op::Line { .. }));
    let typed = |text: usize, glued: bool| text + usize::from(!glued);
    line.map(|op| match *op {
        Op::Text { index, glued } | Op::Quote { index, glued } => typed(program.texts[index as usize].len(), glued),
        Op::Literal { index, glued } => typed(program.literals[index as usize].text.len(), glued),
        _ => 0,
    })
    .sum()
}
