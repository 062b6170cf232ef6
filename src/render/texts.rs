//! Names and remarks of the job, for people: their values, and how they fit into a comment or a word.

use super::ascii::plain;
use super::comment_marks::in_comment;
use super::fault::{Done, fault};
use super::printer::{LONGEST, Printer};
use super::shape::Shape;
use std::collections::HashMap;
use std::fmt::Display;

use crate::compile::Op;
use crate::diag::Code;
use crate::lang::{TEXT_COUNT, TextId};
use crate::toolpath::{Start, ToolChange};

/// The values of text variables, by slot. What the form does not print is not kept.
#[derive(Clone, Debug, Default)]
pub struct Texts([String; TEXT_COUNT]);

impl Texts {
    /// A text; empty where the job has none.
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

    /// The comment that is printed now.
    pub fn say(&mut self, comment: &str) {
        comment.clone_into(&mut self.0[TextId::Text as usize]);
    }

    /// What the head of the job, the form and the caller say.
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

    /// What an operation and its tool say.
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

/// Are all texts of a comment empty? Its operations are these; `property`: is the text of a property empty?
pub fn are_empty(comment: &[Op], texts: &Texts, property: &dyn Fn(u16) -> bool) -> bool {
    comment.iter().all(|op| match op {
        Op::TextVar { var, .. } => texts.get(var.id).is_empty(),
        Op::PropertyText { row, .. } => property(*row),
        _ => true,
    })
}

/// The names of tools that words have printed, each with the tool's own.
#[derive(Clone, Debug, Default)]
pub struct Names(HashMap<String, String>);

impl Names {
    /// A word prints the name of a tool, by which the control calls it: it must have one, and be the only one of it.
    pub fn tool(&mut self, text: &Text, out: &Printer) -> Done {
        let own = plain_word(text, fits(out));
        if text.text.is_empty() {
            let help = "give the tool a `name` in the job, or ask before it: `@if [toolname]`";
            return fault(
                Code::PR001,
                format!("{} has no value here, and the control calls its tools by it", text.name),
                help,
            );
        }
        let other = self.0.entry(own.clone()).or_insert_with(|| text.text.to_owned());
        if *other == text.text {
            return Ok(());
        }
        let message = format!("the tools `{other}` and `{}` both print as {own}", text.text);
        fault(Code::PR057, message, "give them names that differ in letters, digits or _ - .")
    }
}

/// A text as a word has it, without the blanks of its width.
fn plain_word(text: &Text, fits: fn(char) -> Option<char>) -> String {
    let wide = usize::from(text.width.unsigned_abs());
    let most = if wide == 0 { usize::MAX } else { wide };
    text.text.chars().take(most).map(|c| fits(c).unwrap_or('_')).collect()
}

/// A character as a part of a word, if it is one.
fn in_word(c: char) -> Option<char> {
    Some(c).filter(|c| c.is_ascii_alphanumeric() || "_-.".contains(*c))
}

/// A character of a text between quotation marks that the form types, if it can't end them, a block or a comment.
fn in_quotes(c: char) -> Option<char> {
    in_word(c).or(Some(c).filter(|c| " ,:/+*=<>&'#[]".contains(*c)))
}

/// What stays of a text outside comments, by what is printed before it.
fn fits(out: &Printer) -> fn(char) -> Option<char> {
    if out.is_in_quotes() { in_quotes } else { in_word }
}

/// A text with its name and width.
pub struct Text<'a> {
    pub name: &'a dyn Display,
    pub width: i8,
    pub text: &'a str,
}

/// Prints a text of the job. In a comment its characters are those of comments, and it is cut where the control's line is
/// full: `behind` is what else the block has room for. Outside, letters, digits and `_ - .` stay; between quotation
/// marks blanks and signs too.
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
        out.note(Code::PR050, message, "shorten it in the job, or give it a line of its own");
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
        let message = format!("{name}, `{text}`, has characters that are no part of a word: `_` stands for each");
        out.note(
            Code::PR050,
            message,
            "use letters, digits and _ - . in it, or print it between quotation marks or in a comment",
        );
    }
}

/// How many characters a block has room for, beside its number and end.
pub fn room(shape: &Shape) -> usize {
    let settings = &shape.program.settings;
    let number = settings.numbers.letter.map_or(0, |letter| usize::from(shape.letters[letter].format.int.count) + 2);
    let longest = settings.control().traits().longest_line.unwrap_or(LONGEST);
    longest.saturating_sub(number + settings.eob.len())
}

/// How many characters stand after an operation on its line, as far as the form types them.
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
