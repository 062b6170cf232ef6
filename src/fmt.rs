//! One canonical layout for forms. The formatter changes spaces, case and older spellings, but never the rendered
//! program.

use crate::lang::{CommandId, SequenceName, TextVar, VarId};
use crate::source::Source;
use crate::span::Span;
use crate::syntax::{
    self, Body, Directive, DirectiveKind, End, Head, Line, Piece, PieceKind, SequenceNode, Spanned, Statement, Tail,
};

/// Indentation of the lines of a branch.
const INDENT: &str = "  ";

/// Formats a form in the canonical layout. Lines that the formatter does not understand stay as they are.
pub fn format(source: &Source) -> String {
    let tree = syntax::parse(source, 0);
    let mut page = Page { source, lines: Vec::new() };
    let mut after_sequence = false;
    for item in &tree.items {
        let is_sequence = matches!(item, Head::Sequence(_));
        if is_sequence {
            page.gap_before_comments();
        } else if after_sequence {
            page.gap();
        }
        match item {
            Head::Blank(line) => page.remark(line),
            Head::Format { line, letter, spec } => page.push(format_of(letter, spec), line),
            Head::Statement(statement) => page.push(page.statement(statement), &statement.line),
            Head::StrayEnd(line) => page.push(page.as_written(line), line),
            Head::Sequence(node) => page.sequence(node),
        }
        after_sequence = is_sequence;
    }
    page.text()
}

/// The formatted lines so far; an empty line is a gap.
struct Page<'a> {
    source: &'a Source,
    lines: Vec<String>,
}

impl Page<'_> {
    /// Adds one empty line, unless the last line or the whole page is empty.
    fn gap(&mut self) {
        if self.lines.last().is_some_and(|line| !line.is_empty()) {
            self.lines.push(String::new());
        }
    }

    /// Adds a gap before the comments directly above the next line, because they belong to that line.
    fn gap_before_comments(&mut self) {
        let comments = self.lines.iter().rev().take_while(|line| line.starts_with('#')).count();
        let at = self.lines.len() - comments;
        if at > 0 && !self.lines[at - 1].is_empty() {
            self.lines.insert(at, String::new());
        }
    }

    /// A line with words and the comment after the words.
    fn push(&mut self, words: String, line: &Line) {
        self.lines.push(words + &self.tail(&line.tail, true));
    }

    /// A line without words.
    fn remark(&mut self, line: &Line) {
        match &line.tail {
            Tail::None => self.gap(),
            tail => self.lines.push(self.tail(tail, false)),
        }
    }

    /// A comment as ` # text`. Text that is ignored stays visible and is not turned into a comment.
    fn tail(&self, tail: &Tail, behind_words: bool) -> String {
        match tail {
            Tail::None => String::new(),
            Tail::Comment(span) => {
                let text = self.source.slice(*span).trim_end_matches([' ', '\t']);
                let inner = &text[1..];
                let blank = if inner.is_empty() || inner.starts_with([' ', '\t', '#', '!']) { "" } else { " " };
                format!("{}#{blank}{inner}", if behind_words { " " } else { "" })
            }
            Tail::Lost(lost) => {
                let gap = if behind_words { "   " } else { "  " };
                format!("{gap}{}", lost.text.trim_end_matches([' ', '\t']))
            }
        }
    }

    /// A command or the name line of a sequence, without the comment after it.
    fn statement(&self, statement: &Statement) -> String {
        let args = statement.args.iter().map(|arg| self.source.slice(arg.span));
        match CommandId::parse(&statement.name.text) {
            Some(id) if !self.is_glued(statement) => [id.name()].into_iter().chain(args).collect::<Vec<_>>().join(" "),
            // unknown command: the line stays as written, because its spelling shows the intended command
            _ => self.as_written(&statement.line),
        }
    }

    /// Whether an argument directly follows the semicolon, as in `Rapid;G0`. Only this argument may begin with any
    /// character.
    fn is_glued(&self, statement: &Statement) -> bool {
        let mut behind = self.source.text[statement.name.span.end as usize..].chars();
        behind.next() == Some(';') && behind.next().is_some_and(|c| !c.is_whitespace())
    }

    /// The words of a line as they are written.
    fn as_written(&self, line: &Line) -> String {
        let end = match &line.tail {
            Tail::None => line.span.end,
            Tail::Comment(comment) => comment.start,
            Tail::Lost(lost) => lost.span.start,
        };
        self.source.slice(Span { end, ..line.span }).trim_matches([' ', '\t']).to_owned()
    }

    fn name_line(&self, statement: &Statement) -> String {
        let mut words = vec![statement.name.text.as_str()];
        words.extend(statement.args.iter().map(|arg| arg.text.as_str()));
        // text that is not a variable stays as it is
        let named = |text: &str| {
            let inner = text.trim_matches(['[', ']', '<', '>']);
            VarId::parse(inner).map_or_else(|| text.to_owned(), |var| format!("[{}]", var.name()))
        };
        let used = match SequenceName::parse(&words) {
            Some(SequenceName::Plain(id, count)) => {
                let spelt = if words[0].eq_ignore_ascii_case(id.name()) { 1 } else { 2 };
                let used = spelt + usize::from(count.is_some());
                Some((format!("{}{}", id.name(), count.map(|c| format!(" {c}")).unwrap_or_default()), used))
            }
            Some(SequenceName::Upon(var)) if !var.is_empty() => Some((format!("Upon {}", named(var)), 2)),
            Some(SequenceName::UponEvery(var)) if !var.is_empty() => Some((format!("Upon Every {}", named(var)), 3)),
            _ => None,
        };
        let quoted = statement.args.iter().any(|arg| self.source.slice(arg.span) != arg.text);
        match used {
            Some((name, used)) if used >= words.len() && !quoted && !self.is_glued(statement) => name,
            // the line has more words than a name, which is an error: the line stays as written
            _ => self.as_written(&statement.line),
        }
    }

    fn sequence(&mut self, node: &SequenceNode) {
        let name = self.name_line(&node.name);
        self.push(name, &node.name.line);
        let first = self.lines.len();
        let mut depth = 0_usize;
        for body in &node.body {
            if let Some(directive) = &body.directive {
                let own = depth.saturating_sub(usize::from(directive.kind.closes()));
                depth = if directive.kind == DirectiveKind::End { own } else { depth };
                depth += usize::from(directive.kind.opens());
                self.push(INDENT.repeat(own) + &self.directive(directive), &body.line);
            } else if !body.words.is_empty() {
                let words = INDENT.repeat(depth) + &self.words(body);
                self.push(words, &body.line);
            } else if self.lines.len() > first || body.line.tail != Tail::None {
                self.remark(&body.line);
            }
        }
        if self.lines.len() > first && self.lines.last().is_some_and(String::is_empty) {
            self.lines.pop();
        }
        if let Some(end) = &node.end {
            let words = self.end(end);
            self.push(words, &end.line);
        }
    }

    /// A directive, such as `@if [cool] = through`. Only the name `@if` changes; the rest stays as written.
    fn directive(&self, directive: &Directive) -> String {
        let name = match directive.kind {
            DirectiveKind::Unknown => directive.name.text.clone(),
            _ => directive.name.text.to_ascii_lowercase(),
        };
        if directive.rest.text.is_empty() { name } else { format!("{name} {}", directive.rest.text) }
    }

    fn end(&self, end: &End) -> String {
        let mut text = "End".to_owned();
        for arg in &end.args {
            let cancel = arg.text.eq_ignore_ascii_case("Cancel");
            text += &format!(" {}", if cancel { "Cancel" } else { &arg.text });
        }
        text
    }

    fn words(&self, body: &Body) -> String {
        let mut text = String::new();
        for (i, word) in body.words.iter().enumerate() {
            if i > 0 {
                text.push(' ');
            }
            // text that is not a word stays as written, because another layout could join this text and its neighbour
            // into one word
            let stray = |piece: &Piece| matches!(piece.kind, PieceKind::Stray(_));
            if word.pieces.iter().any(stray) {
                text.push_str(self.source.slice(word.span));
                continue;
            }
            for (j, piece) in word.pieces.iter().enumerate() {
                if j > 0 && piece.lacks_blank_after(&word.pieces[j - 1]) {
                    text.push(' ');
                }
                self.piece(piece, &mut text);
            }
        }
        text
    }

    fn piece(&self, piece: &Piece, text: &mut String) {
        match &piece.kind {
            PieceKind::Variable { letter, name } => match VarId::parse(&name.text) {
                Some(var) => {
                    text.extend(letter.map(char::from));
                    text.push('[');
                    text.push_str(var.name());
                    text.push(']');
                }
                // an unknown variable stays as written, because the intended variable is unknown
                None => text.push_str(self.source.slice(piece.span)),
            },
            PieceKind::Note { parts, closed } => {
                text.push('(');
                parts.iter().for_each(|part| self.piece(part, text));
                text.push_str(if *closed { ")" } else { "" });
            }
            PieceKind::Literal { letter, number } => {
                text.push(char::from(*letter));
                text.push_str(&number.text); // without the brackets of the oldest forms
            }
            PieceKind::Expression { letter, text: inner, expr } if expr.is_ok() => {
                text.extend(letter.map(char::from));
                text.extend(["[", inner.text.trim_matches([' ', '\t']), "]"]);
            }
            PieceKind::TextVariable { letter: None, name } => match TextVar::parse(&name.text) {
                Some(var) => text.push_str(&var.to_string()),
                None => text.push_str(self.source.slice(piece.span)),
            },
            PieceKind::Expression { .. }
            | PieceKind::TextVariable { .. }
            | PieceKind::Quote(_)
            | PieceKind::Stray(_) => {
                text.push_str(self.source.slice(piece.span));
            }
        }
    }

    fn text(mut self) -> String {
        while self.lines.last().is_some_and(String::is_empty) {
            self.lines.pop();
        }
        self.lines.iter().flat_map(|line| [line.as_str(), "\n"]).collect()
    }
}

/// `X->3.>4`, `F >3.>6`, `A010360`: the sign has its own column. In a format without a sign, this column is a space.
fn format_of(letter: &Spanned, spec: &Spanned) -> String {
    let digits = spec.text.trim();
    let packed = digits.len() >= 3 && digits.bytes().all(|b| b.is_ascii_digit());
    // after the first sequence, `O 578` is a misplaced format and `O578` is a word, so a space before a number of this
    // length stays
    let glued = if packed { !spec.text.starts_with(' ') } else { digits.starts_with(['-', '+']) };
    let blank = if glued { "" } else { " " };
    format!("{}{blank}{digits}", letter.text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blanks_case_and_older_spellings_become_canonical() {
        let text = "\u{feff}#a note\r\nRAPID;  G0\r\nx ->3.>4\r\nF   >3.>6\r\n\r\n\r\ndrill   remark  here \r\n\r\n G0 X<H>Y[v]  # go\r\n\
                    T[tool]\tM6\r\n\r\nend cancel\r\n# of the next\r\nchip break 1\r\nG73\r\nEND\r\n\r\n";
        let source = Source::from_bytes("f", text.as_bytes());
        assert_eq!(
            format(&source),
            "# a note\nRapid   G0\nx->3.>4\nF   >3.>6\n\nDrill   remark  here\nG0 X[h] Y[v] # go\nT[tool]   M6\nEnd Cancel\n\n\
             # of the next\nChipbreak 1\nG73\nEnd\n"
        );
    }
}
