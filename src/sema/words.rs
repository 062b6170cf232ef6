//! Analyses the words of a line: resolves variables, joins texts and reports errors.

use super::expression::number;
use super::formula::Formula;
use super::messages::in_backquotes;
use super::model::{Line, Word, WordKind};
use super::names::{Context, property, variable};
use super::property::{Property, PropertyKind};
use crate::diag::{Code, Diag};
use crate::lang::{TextVar, VarId, WIDEST};
use crate::span::Span;
use crate::syntax::{self, Body, Piece, PieceKind, Spanned};
use crate::terminal::is_invisible;

/// Analyses the words of one line of a sequence.
pub fn resolve(body: &Body, context: &Context, diags: &mut Vec<Diag>) -> Line {
    let (codes, remark) = body.words.split_at(before_remark(&body.words, context.comment));
    let mut words = Vec::new();
    if let Some(span) = statement(codes) {
        let diag = Diag::new(Code::PF001, "a statement in the control's own language, with brackets");
        diags.push(in_backquotes(diag.at(span, "these brackets are not variables"), span));
        words.push(Word { span, glued: false, kind: WordKind::Quote(String::new()) });
        return Line { span: body.line.span, words };
    }
    if let Some((span, word)) = misspelt_variable(codes) {
        let diag = Diag::new(Code::PF001, "a variable with a space in its name, or without its second bracket");
        diags.push(diag.at(span, "not a word").help(format!("write `{word}`")));
        words.push(Word { span, glued: false, kind: WordKind::Quote(String::new()) });
        return Line { span: body.line.span, words };
    }
    for word in codes {
        check_texts(&word.pieces, context, diags);
        for (i, piece) in word.pieces.iter().enumerate() {
            let previous = i.checked_sub(1).map(|before| &word.pieces[before]);
            push(piece, previous, context, &mut words, diags);
        }
    }
    if let [first, .., last] | [first @ last] = remark {
        let span = Span { end: last.span.end, ..first.span };
        let mut note = Note::new(span, false, &mut words);
        for (i, word) in remark.iter().enumerate() {
            note.text.push_str(if i > 0 { " " } else { "" });
            note.pieces(&word.pieces, context, diags);
        }
        note.finish();
    }
    words.shrink_to_fit();
    Line { span: body.line.span, words }
}

/// Finds a statement in the control's own language, such as `IF [#1 GT 2] GOTO 5` or `WHILE [#1 LT 5] DO1`.
fn statement(words: &[syntax::Word]) -> Option<Span> {
    let text = |word: &syntax::Word| match word.pieces.first() {
        Some(Piece { kind: PieceKind::Stray(text), .. }) => text.to_ascii_uppercase(),
        _ => String::new(),
    };
    let [first, second, .., last] = words else { return None };
    let asks = matches!(text(first).as_str(), "IF" | "WHILE") && text(second).starts_with('[');
    asks.then(|| first.span.to(last.span))
}

/// The number of words before a comment that extends to the end of the block. The words after the comment mark are text
/// of the comment, as in round brackets. Words in a comment set no values and print whenever the block prints.
pub fn before_remark(words: &[syntax::Word], comment: &[String; 2]) -> usize {
    let [open, close] = comment;
    let opens = |word: &syntax::Word| matches!(word.pieces.first(), Some(Piece { kind: PieceKind::Stray(text), .. }) if text.starts_with(open.as_str()));
    let at = if close.is_empty() { words.iter().position(opens) } else { None };
    at.unwrap_or(words.len())
}

fn push(piece: &Piece, previous: Option<&Piece>, context: &Context, words: &mut Vec<Word>, diags: &mut Vec<Diag>) {
    // two words are printed with a space even if the form has none between them; a text may be joined to a variable without a space
    let glued = previous.is_some_and(|before| !piece.lacks_blank_after(before));
    let kind = match &piece.kind {
        PieceKind::Variable { letter, name } if let Some((row, property)) = property(&name.text, context) => {
            match property_word(*letter, row, property, piece.span, diags) {
                Some(kind) => kind,
                None => return,
            }
        }
        PieceKind::Variable { letter, name } => {
            let Some(var) = variable(name, context.settings, diags) else { return };
            letter.map_or(WordKind::Value(var), |letter| WordKind::Var(letter, var))
        }
        PieceKind::Expression { letter, expr, .. } => match number(expr, context, diags) {
            // a name with spaces or in brackets is also a single variable
            Some(Formula::Var(var)) => letter.map_or(WordKind::Value(var), |letter| WordKind::Var(letter, var)),
            Some(formula) => WordKind::Formula(*letter, Box::new(formula)),
            None => return,
        },
        PieceKind::Literal { letter: b'%', number } if number.text == "0" => WordKind::Text("%".into()),
        PieceKind::Literal { letter, number } => match number.text.parse::<f64>() {
            Ok(value) => WordKind::Literal(*letter, format!("{}{}", char::from(*letter), number.text), value),
            Err(_) => return,
        },
        PieceKind::Stray(text) => {
            check_text(text, piece.span, previous.is_some_and(Piece::is_word), diags);
            WordKind::Text(text.clone())
        }
        PieceKind::Quote(text) => {
            check_quote(text, piece.span, diags);
            WordKind::Quote(text.clone())
        }
        PieceKind::TextVariable { name, .. } => match text_variable(name, diags) {
            Some(var) => WordKind::TextVar(var),
            None => return,
        },
        PieceKind::Note { parts, closed } => {
            let mut note = Note::new(piece.span, glued, words);
            note.brackets(parts, *closed, context, diags);
            note.finish();
            return;
        }
    };
    let is_value =
        matches!(piece.kind, PieceKind::Variable { letter: None, .. } | PieceKind::Expression { letter: None, .. });
    if let (true, Some(Piece { kind: PieceKind::Stray(text), span })) = (is_value, previous)
        && text.ends_with(['-', '+'])
        && !matches!(kind, WordKind::PropertyText(_))
    {
        diags.push(
            Diag::new(Code::PF001, "a sign before a variable")
                .at(*span, "this sign would be printed before the sign of the value")
                .help("remove the sign; `RevSigns` reverses the sign of a letter"),
        );
    }
    if is_value && previous.is_some_and(Piece::is_word) {
        diags.push(
            Diag::new(Code::PF001, "a value directly after a word")
                .at(piece.span, "the value would be printed as a separate word")
                .help("keep one of them; for leading zeros use a format, as `T 2` for T01"),
        );
    }
    words.push(Word { span: piece.span, glued, kind });
}

/// Makes a word that prints a property.
fn property_word(
    letter: Option<u8>,
    row: u16,
    property: &Property,
    span: Span,
    diags: &mut Vec<Diag>,
) -> Option<WordKind> {
    match property.kind {
        PropertyKind::YesNo => {
            diags.push(
                Diag::new(Code::PF704, format!("[{}] is yes or no, and can't be printed", property.name))
                    .at(span, "this is yes or no")
                    .help(format!("test it: `@if [{}]`", property.name)),
            );
            None
        }
        PropertyKind::Text | PropertyKind::Choice(_) => Some(WordKind::PropertyText(row)),
        _ => Some(WordKind::Formula(letter, Box::new(Formula::Property(row)))),
    }
}

/// Reads the name of a text of the job and its width. Reports an invalid width.
fn text_variable(name: &Spanned, diags: &mut Vec<Diag>) -> Option<TextVar> {
    let var = TextVar::parse(&name.text);
    if var.is_none() {
        let text = name.text.split(':').next().unwrap_or_default();
        diags.push(
            Diag::new(Code::PF702, format!("`{}` has an invalid width", name.text))
                .at(name.span, format!("use 1 to {WIDEST}, or -1 to -{WIDEST}"))
                .help(format!("write `[{text}:12]` for 12 characters, `[{text}:-12]` for 12 characters aligned right")),
        );
    }
    var
}

/// Checks that text of the form precedes each text of the job outside comments. Without text of the form, the control
/// could read a name such as M30 as a code. A space, a point or the slash of block delete does not count as text here.
fn check_texts(pieces: &[Piece], context: &Context, diags: &mut Vec<Diag>) {
    let holds = |piece: &Piece| match &piece.kind {
        PieceKind::Stray(text) | PieceKind::Quote(text) => !text.trim_matches([' ', '/', '.']).is_empty(),
        _ => false,
    };
    for (i, piece) in pieces.iter().enumerate() {
        let is_text =
            |name: &Spanned| property(&name.text, context).is_some_and(|(_, property)| property.kind.is_text());
        let (letter, name) = match &piece.kind {
            PieceKind::TextVariable { letter, name } => (letter, name),
            PieceKind::Variable { letter, name } if is_text(name) => (letter, name),
            _ => continue,
        };
        let beside = [i.checked_sub(1), Some(i + 1)].into_iter().flatten().filter_map(|at| pieces.get(at));
        let inner = &name.text;
        let (message, help) = match letter {
            Some(letter) => {
                let letter = char::from(*letter);
                (
                    format!("[{inner}] is a text, but {letter} prints a number"),
                    format!("write `` `{letter}`[{inner}] ``"),
                )
            }
            None if beside.into_iter().any(Piece::is_word) => {
                let message = format!("[{inner}] is a text next to a word");
                (message, "put a space, or text in backquotes, between them".to_owned())
            }
            None if !pieces[..i].iter().any(holds) => {
                let message = format!("[{inner}] is printed alone: a name like M30 would be a code");
                (message, format!("put it into a comment, `([{inner}])`, or after text: `` `\"`[{inner}]`\"` ``"))
            }
            None => continue,
        };
        diags.push(Diag::new(Code::PF701, message).at(piece.span, "a text of the job").help(help));
    }
}

/// Builds a comment of the program from text and values.
struct Note<'a> {
    span: Span,
    glued: bool,
    text: String,
    words: &'a mut Vec<Word>,
    /// Index of the comment's first word.
    begin: usize,
}

impl<'a> Note<'a> {
    fn new(span: Span, glued: bool, words: &'a mut Vec<Word>) -> Note<'a> {
        Note { span, glued, text: String::new(), begin: words.len(), words }
    }

    /// Adds a word of the comment that is not literal text.
    fn push(&mut self, span: Span, kind: WordKind) {
        self.end();
        self.words.push(Word { span, glued: self.glued, kind });
        self.glued = true;
    }

    fn pieces(&mut self, pieces: &[Piece], context: &Context, diags: &mut Vec<Diag>) {
        for (i, piece) in pieces.iter().enumerate() {
            if i > 0 && piece.lacks_blank_after(&pieces[i - 1]) {
                self.text.push(' ');
            }
            match &piece.kind {
                PieceKind::Variable { letter, name } if let Some((row, property)) = property(&name.text, context) => {
                    self.text.extend(letter.map(char::from));
                    match property_word(None, row, property, piece.span, diags) {
                        Some(WordKind::PropertyText(row)) => self.push(piece.span, WordKind::RemarkProperty(row)),
                        Some(WordKind::Formula(_, formula)) => self.push(piece.span, WordKind::RemarkFormula(formula)),
                        _ => {}
                    }
                }
                PieceKind::Variable { letter, name } => {
                    self.text.extend(letter.map(char::from));
                    if let Some(var) = variable(name, context.settings, diags) {
                        self.push(piece.span, WordKind::Remark(var));
                    }
                }
                PieceKind::Expression { letter, expr, .. } => {
                    self.text.extend(letter.map(char::from));
                    if let Some(formula) = number(expr, context, diags) {
                        self.push(piece.span, WordKind::RemarkFormula(Box::new(formula)));
                    }
                }
                PieceKind::TextVariable { letter, name } => {
                    self.text.extend(letter.map(char::from));
                    if let Some(var) = text_variable(name, diags) {
                        self.push(piece.span, WordKind::RemarkText(var));
                    }
                }
                PieceKind::Quote(text) => {
                    check_quote(text, piece.span, diags);
                    self.push(piece.span, WordKind::Quote(text.clone()));
                }
                PieceKind::Stray(text) => {
                    if let Some(c) = text.chars().find(|&c| is_invisible(c)) {
                        diags.push(invisible(c, self.span));
                    }
                    self.text.push_str(text);
                }
                PieceKind::Literal { letter, number } => {
                    self.text.push(char::from(*letter));
                    self.text.push_str(&number.text);
                }
                PieceKind::Note { parts, closed } => self.brackets(parts, *closed, context, diags),
            }
        }
    }

    /// Adds a comment in round brackets. A comment that is not closed in the form ends with the form's closing mark.
    fn brackets(&mut self, parts: &[Piece], closed: bool, context: &Context, diags: &mut Vec<Diag>) {
        self.text.push('(');
        self.pieces(parts, context, diags);
        self.text.push_str(if closed { ")" } else { &context.comment[1] });
    }

    /// Ends the comment.
    fn finish(mut self) {
        self.end();
        let words = &self.words[self.begin..];
        if words.iter().any(|word| matches!(word.kind, WordKind::RemarkText(_) | WordKind::RemarkProperty(_))) {
            let comment = Word { span: self.span, glued: words[0].glued, kind: WordKind::Comment(words.len()) };
            self.words.insert(self.begin, comment);
        }
    }

    /// Converts the text collected so far to a word.
    fn end(&mut self) {
        if !self.text.is_empty() {
            let text = WordKind::Note(std::mem::take(&mut self.text));
            self.words.push(Word { span: self.span, glued: self.glued, kind: text });
            self.glued = true;
        }
    }
}

/// Finds a variable with a space in its name, such as `T[next tool]`, or without its second bracket, such as `M[cool`.
/// Returns its location and the correct word.
fn misspelt_variable(words: &[syntax::Word]) -> Option<(Span, String)> {
    let text = |word: &syntax::Word| match word.pieces.as_ref() {
        [Piece { kind: PieceKind::Stray(text), .. }] => text.clone(),
        _ => String::new(),
    };
    let opens = words.iter().position(|word| text(word).contains('['))?;
    let closes = words.iter().rposition(|word| text(word).contains(']')).unwrap_or(opens);
    let all: String = words.get(opens..=closes)?.iter().map(text).collect();
    let (letter, name) = all.split_once('[')?;
    let name = name.strip_suffix(']').unwrap_or(name);
    let is_variable = letter.len() <= 1 && (VarId::parse(name).is_some() || TextVar::is_text(name));
    is_variable.then(|| (words[opens].span.to(words[closes].span), format!("{letter}[{name}]")))
}

/// Checks a text that is printed as written. Reports a text that is certainly a mistake.
fn check_text(text: &str, span: Span, after_word: bool, diags: &mut Vec<Diag>) {
    if text.contains(['[', ']', '<', '>']) {
        diags.push(
            Diag::new(Code::PF001, format!("`{}` is not a word", text))
                .at(span, "an unmatched bracket")
                .help("write variables as `X[h]`, expressions as `X[h+1]`; put text with brackets in backquotes"),
        );
    } else if text.contains('`') {
        diags.push(
            Diag::new(Code::PF001, "an unmatched backquote")
                .at(span, "text in backquotes must end on the same line")
                .help("write a second backquote after the text; write a backquote inside the text twice"),
        );
    } else if let Some(c) = text.chars().find(|&c| is_invisible(c)) {
        diags.push(invisible(c, span));
    } else if after_word {
        diags.push(
            Diag::new(Code::PF001, format!("`{}` is directly after a word", text))
                .at(span, "this text would be printed after the value")
                .help("remove the text, or put a space before it"),
        );
    }
}

/// Checks text in backquotes. Only invisible characters are errors.
fn check_quote(text: &str, span: Span, diags: &mut Vec<Diag>) {
    if let Some(c) = text.chars().find(|&c| is_invisible(c)) {
        diags.push(invisible(c, span));
    }
}

/// The finding for an invisible character.
pub(super) fn invisible(c: char, span: Span) -> Diag {
    let what = match c {
        '\u{a0}' => "a no-break space, which looks like a space".to_owned(),
        c if c.is_control() => format!("the control character U+{:04X}", u32::from(c)),
        c => format!("the character U+{:04X}, which is invisible", u32::from(c)),
    };
    Diag::new(Code::PF001, format!("the line contains {what}"))
        .at(span, "in this word")
        .help("remove it, or replace it by a space")
}
