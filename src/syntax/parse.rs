//! Parses the lines of a form with the grammar. Only this file and `expression.rs` use the crate pest.

use pest::Parser;
use pest::iterators::Pair;

use super::ast::*;
use super::directive::directive;
use super::expression::{expression, is_too_deep};
use super::grammar::{FormGrammar, Rule};
use crate::lang::{CommandId, SequenceId, SequenceName, TextVar};
use crate::source::Source;
use crate::span::Span;

/// Minimum of free stack in bytes. If less than 64 KB of stack are left, pest refuses its input.
const LEAST_STACK: usize = 128 << 10;
/// Size of the new stack that is allocated if less than the minimum is free.
const STACK: usize = 1 << 20;

/// Parses a file. `file`: its number. Each byte of the text belongs to a line of the result.
pub fn parse(source: &Source, file: u32) -> Form {
    stacker::maybe_grow(LEAST_STACK, STACK, || lines(source, file))
}

fn lines(source: &Source, file: u32) -> Form {
    let lines: Vec<(usize, &str)> = source.lines().collect();
    let mut around = Around { lines: &lines, marks: vec![None; lines.len()], has_sequence: false };
    let mut form = Form::default();
    let mut open: Option<SequenceNode> = None;
    // number of directives in the current sequence that are not yet closed by `@end`
    let mut depth = 0_usize;
    for (index, &(start, text)) in lines.iter().enumerate() {
        let at = At { file, start };
        if let Some(sequence) = &mut open {
            // between a directive and its `@end`, a line with leading spaces is not a comment
            let inner = if depth > 0 { text.trim_start_matches([' ', '\t']) } else { text };
            let inner_start = start + text.len() - inner.len();
            match body_line(At { file, start: inner_start }, inner) {
                Ok(mut body) if !begins_sequence(&body, inner, inner_start) => {
                    body.line.span.start = start as u32;
                    match body.directive.as_ref().map(|directive| &directive.kind) {
                        Some(kind) if kind.opens() => depth += 1,
                        Some(DirectiveKind::End) => depth = depth.saturating_sub(1),
                        _ => {}
                    }
                    sequence.body.push(body);
                }
                Ok(_) => {
                    depth = 0;
                    // the name of a sequence on a line of its own: the `End` of the previous sequence is missing
                    form.items.extend(open.take().map(boxed));
                    open = head(at, text, index, &mut around, &mut form);
                }
                Err(end) => {
                    depth = 0;
                    sequence.end = Some(end);
                    form.items.extend(open.take().map(boxed));
                }
            }
        } else {
            open = head(at, text, index, &mut around, &mut form);
        }
    }
    form.items.extend(open.map(boxed));
    form
}

/// Adds a sequence as an item. The sequence is boxed, because most items are lines and much smaller.
fn boxed(mut node: SequenceNode) -> Head {
    node.body.shrink_to_fit();
    Head::Sequence(Box::new(node))
}

/// Where a line is in its file.
#[derive(Clone, Copy)]
struct At {
    file: u32,
    start: usize,
}

impl At {
    fn span(self, pair: &Pair<Rule>) -> Span {
        let inner = pair.as_span();
        Span::new(self.file, self.start + inner.start(), self.start + inner.end())
    }

    fn spanned(self, pair: &Pair<Rule>) -> Spanned {
        Spanned { text: pair.as_str().to_owned(), span: self.span(pair) }
    }

    fn line(self, text: &str) -> Line {
        Line { span: Span::new(self.file, self.start, self.start + text.len()), tail: Tail::None }
    }
}

/// The pairs of one line. The grammar accepts every line. If the grammar fails because of a bug (property tests look
/// for such bugs), the line counts as empty.
fn pairs(rule: Rule, text: &str) -> impl Iterator<Item = Pair<'_, Rule>> {
    FormGrammar::parse(rule, text).into_iter().flatten().flat_map(Pair::into_inner)
}

/// Parses a line outside sequences. If the line begins a sequence, returns this sequence.
fn head(at: At, text: &str, index: usize, around: &mut Around<'_>, form: &mut Form) -> Option<SequenceNode> {
    for pair in pairs(Rule::head_line, text) {
        let mut line = at.line(text);
        match pair.as_rule() {
            Rule::format => {
                let mut parts = pair.into_inner();
                let (Some(letter), Some(spec)) = (parts.next(), parts.next()) else { continue };
                line.tail = parts.next().map_or(Tail::None, |pair| tail(at, &pair));
                // after a sequence, `G80` is a word whose name line is missing, and not a letter format
                if spec.as_str().bytes().all(|b| b.is_ascii_digit()) && around.has_sequence {
                    let span = at.span(&letter).to(at.span(&spec));
                    let name = Spanned { text: format!("{}{}", letter.as_str(), spec.as_str()), span };
                    return opened(Statement { line, name, args: Vec::new() }, index, around, form);
                }
                form.items.push(Head::Format { line, letter: at.spanned(&letter), spec: at.spanned(&spec) });
                return None;
            }
            Rule::statement => {
                let statement = statement(at, line, pair);
                if statement.name.text.eq_ignore_ascii_case("End") {
                    form.items.push(Head::StrayEnd(statement.line));
                    return None;
                }
                return opened(statement, index, around, form);
            }
            Rule::remark => line.tail = remark(at, &pair),
            _ => {}
        }
        form.items.push(Head::Blank(line));
        return None;
    }
    form.items.push(Head::Blank(at.line(text)));
    None
}

/// If the statement begins a sequence, returns this sequence. Adds any other statement to the form.
fn opened(statement: Statement, index: usize, around: &mut Around<'_>, form: &mut Form) -> Option<SequenceNode> {
    if opens_sequence(&statement, index, around) {
        around.has_sequence = true;
        return Some(SequenceNode { name: statement, body: Vec::new(), end: None });
    }
    form.items.push(Head::Statement(statement));
    None
}

/// The tail of a line that is only a comment: a comment that begins with `#`, or an indented line.
fn remark(at: At, pair: &Pair<Rule>) -> Tail {
    let text = pair.as_str();
    let inner = text.trim_start_matches([' ', '\t']);
    let start = at.start + pair.as_span().start() + text.len() - inner.len();
    let span = Span::new(at.file, start, start + inner.len());
    match inner.starts_with('#') {
        true => Tail::Comment(span),
        false => Tail::Lost(Spanned { text: inner.to_owned(), span }),
    }
}

fn statement(at: At, mut line: Line, pair: Pair<Rule>) -> Statement {
    let mut name = Spanned { text: String::new(), span: line.span };
    let mut args = Vec::new();
    for part in pair.into_inner() {
        match part.as_rule() {
            Rule::name => name = at.spanned(&part),
            Rule::quoted => {
                let mut arg = at.spanned(&part);
                arg.text = arg.text[1..arg.text.len() - 1].to_owned();
                args.push(arg);
            }
            Rule::bare => args.push(without_brackets(at.spanned(&part))),
            _ => line.tail = tail(at, &part),
        }
    }
    Statement { line, name, args }
}

/// Maximum number of lines from an unknown name to its `End`, including empty lines and comments. In known forms the
/// number of lines is less than half of this maximum.
const LONGEST_SEQUENCE: usize = 400;

/// The lines around the current one.
struct Around<'a> {
    lines: &'a [(usize, &'a str)],
    /// The kind of each line, determined when it is needed.
    marks: Vec<Option<Mark>>,
    /// Whether there is a sequence above the current line.
    has_sequence: bool,
}

impl Around<'_> {
    fn mark(&mut self, at: usize) -> Mark {
        let text = self.lines[at].1;
        *self.marks[at].get_or_insert_with(|| Mark::of(text))
    }
}

/// The kind of a line. The kind determines whether an unknown name above the line begins a sequence.
#[derive(Clone, Copy)]
enum Mark {
    /// The line is an `End`.
    End,
    /// The line is a known name. An `End` after the known name does not belong to the unknown name above.
    Name,
    /// Any other line.
    Other,
}

impl Mark {
    fn of(text: &str) -> Mark {
        // empty lines and the separators between words must make no difference
        let all: Vec<&str> = text.split([' ', '\t', ';']).filter(|word| !word.is_empty()).collect();
        let Some(first) = all.first().copied().filter(|word| !word.starts_with('#')) else { return Mark::Other };
        if first.eq_ignore_ascii_case("End") {
            return Mark::End;
        }
        let looks_like_a_name = all.len() == 1 && first.len() > 3 && first.bytes().all(|b| b.is_ascii_alphabetic());
        if looks_like_a_name || CommandId::parse(first).is_some() || SequenceName::parse(&all).is_some() {
            return Mark::Name;
        }
        Mark::Other
    }
}

/// Whether this line begins a sequence. A known name begins a sequence. An unknown name begins a sequence if an `End`
/// follows before the next known name. A misspelt name therefore causes one error, and not an error for each line.
fn opens_sequence(statement: &Statement, index: usize, around: &mut Around<'_>) -> bool {
    if names_sequence(statement) {
        return true;
    }
    let name = &statement.name.text;
    if CommandId::parse(name).is_some() || !name.chars().all(|c| c.is_alphanumeric()) || name.len() < 2 {
        return false;
    }
    let end = around.lines.len().min(index + 1 + LONGEST_SEQUENCE);
    for at in index + 1..end {
        match around.mark(at) {
            Mark::End => return true,
            Mark::Name => return false,
            Mark::Other => {}
        }
    }
    false
}

fn names_sequence(statement: &Statement) -> bool {
    let mut words = vec![statement.name.text.as_str()];
    words.extend(statement.args.iter().map(|arg| arg.text.as_str()));
    // `Thread G33` is a command and has no End
    SequenceName::parse(&words).is_some()
}

/// Whether a line inside a sequence is the name line of the next sequence. A name line contains only a name, or a name
/// and a count.
fn begins_sequence(body: &Body, text: &str, start: usize) -> bool {
    let Some(last) = body.words.last() else { return false };
    let words: Vec<&str> = text[..last.span.end as usize - start].split_whitespace().collect();
    match SequenceName::parse(&words) {
        Some(SequenceName::Plain(SequenceId::Stop, _)) => false, // Stop is also a word of conversational controls
        Some(SequenceName::Plain(_, count)) => count.is_none_or(|c| c.bytes().all(|b| b.is_ascii_digit())),
        Some(SequenceName::Upon(name) | SequenceName::UponEvery(name)) => name.starts_with(['[', '<']),
        None => false,
    }
}

/// Parses a line inside a sequence. `Err`: the line is the end of the sequence.
fn body_line(at: At, text: &str) -> Result<Body, End> {
    let mut body = Body { line: at.line(text), words: Vec::new(), directive: None };
    if is_too_deep(text) {
        let span = body.line.span;
        body.words.push(Word { span, pieces: [Piece { span, kind: PieceKind::Stray(text.to_owned()) }].into() });
        return Ok(body);
    }
    for pair in pairs(Rule::body_line, text) {
        match pair.as_rule() {
            Rule::end => {
                let from = at.span(&pair).start;
                let word = Span { start: from, end: from + 3, ..body.line.span };
                let mut end = End { line: body.line, word, args: Vec::new() };
                for part in pair.into_inner() {
                    match part.as_rule() {
                        Rule::bare => end.args.push(at.spanned(&part)),
                        _ => end.line.tail = tail(at, &part),
                    }
                }
                return Err(end);
            }
            Rule::words => {
                for part in pair.into_inner() {
                    match part.as_rule() {
                        Rule::word => {
                            let span = at.span(&part);
                            let pieces = part.into_inner().map(|piece| self::piece(at, piece)).collect();
                            body.words.push(Word { span, pieces });
                        }
                        _ => body.line.tail = tail(at, &part),
                    }
                }
                body.words.shrink_to_fit(); // `push` has reserved space for four words
            }
            Rule::directive => {
                let (mut name, mut rest) = (None, Spanned { text: String::new(), span: at.span(&pair) });
                for part in pair.into_inner() {
                    match part.as_rule() {
                        Rule::at_name => name = Some(at.spanned(&part)),
                        Rule::asked => rest = at.spanned(&part),
                        _ => body.line.tail = tail(at, &part),
                    }
                }
                body.directive = name.map(|name| Box::new(directive(name, rest)));
            }
            Rule::remark => body.line.tail = remark(at, &pair),
            _ => {}
        }
    }
    Ok(body)
}

fn piece(at: At, pair: Pair<Rule>) -> Piece {
    let span = at.span(&pair);
    let kind = match pair.as_rule() {
        Rule::variable | Rule::note_var => {
            let old = pair.as_rule() == Rule::variable && pair.as_str().ends_with('>');
            let (mut letter, mut name) = (None, Spanned { text: String::new(), span });
            for part in pair.into_inner() {
                match part.as_rule() {
                    Rule::letter => letter = part.as_str().bytes().next(),
                    _ => name = at.spanned(&part),
                }
            }
            match letter {
                // in the oldest forms, every number is in brackets
                Some(letter) if old && is_number(&name.text) => PieceKind::Literal { letter, number: name },
                _ if !old && is_calculated(&name.text) => {
                    let expr = Box::new(expression(&name.text, name.span, true));
                    PieceKind::Expression { letter, text: name, expr }
                }
                _ if TextVar::is_text(&name.text) => PieceKind::TextVariable { letter, name },
                _ => PieceKind::Variable { letter, name },
            }
        }
        Rule::literal => {
            let mut parts = pair.clone().into_inner();
            match (parts.next().and_then(|l| l.as_str().bytes().next()), parts.next()) {
                (Some(letter), Some(number)) => PieceKind::Literal { letter, number: at.spanned(&number) },
                _ => PieceKind::Stray(pair.as_str().to_owned()),
            }
        }
        Rule::note => {
            let closed = pair.as_str().ends_with(')');
            PieceKind::Note { parts: pair.into_inner().map(|part| piece(at, part)).collect(), closed }
        }
        Rule::quote => {
            let text = pair.as_str();
            PieceKind::Quote(text[1..text.len() - 1].replace("``", "`"))
        }
        _ => PieceKind::Stray(pair.as_str().to_owned()),
    };
    Piece { span, kind }
}

/// Whether the text between brackets is more than a name. A text variable may have a width.
fn is_calculated(text: &str) -> bool {
    text.contains(['+', '*', '/', '(', ' ', '\t']) || text.contains('-') && !TextVar::is_text(text)
}

/// Whether the text is a number: digits, possibly with a sign and a point.
fn is_number(text: &str) -> bool {
    text.parse::<f64>().is_ok() && text.bytes().all(|b| b.is_ascii_digit() || b"+-.".contains(&b))
}

/// Converts `G<0>` to `G0` in arguments of the oldest forms. The location of the argument stays the same.
fn without_brackets(mut arg: Spanned) -> Spanned {
    let inner = arg.text.strip_suffix('>').and_then(|text| text.split_once('<'));
    if let Some((letter, number)) = inner
        && letter.len() < 2
        && is_number(number)
    {
        arg.text = format!("{letter}{number}");
    }
    arg
}

fn tail(at: At, pair: &Pair<Rule>) -> Tail {
    match pair.as_rule() {
        Rule::comment => Tail::Comment(at.span(pair)),
        Rule::lost => Tail::Lost(at.spanned(pair)),
        _ => Tail::None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn parsed(text: &str) -> Form {
        parse(&Source::from_text("f.pf", text), 0)
    }

    fn sequence(form: &Form) -> &SequenceNode {
        form.sequences().next().unwrap()
    }

    fn written(body: &Body, text: &str) -> Vec<String> {
        body.words.iter().map(|w| text[w.span.range()].to_owned()).collect()
    }

    #[test]
    fn words_end_at_a_double_blank() {
        let text = "Drill\nT[tool]  M6\nX[h] Y<v> # note\n\tignored\nEnd Cancel\n";
        let form = parsed(text);
        let drill = sequence(&form);
        assert_eq!(written(&drill.body[0], text), ["T[tool]"]);
        assert!(matches!(&drill.body[0].line.tail, Tail::Lost(lost) if lost.text == "M6"));
        assert_eq!(written(&drill.body[1], text), ["X[h]", "Y<v>"]);
        assert!(matches!(drill.body[1].line.tail, Tail::Comment(_)));
        assert!(drill.body[2].words.is_empty());
        assert_eq!(drill.end.as_ref().unwrap().args[0].text, "Cancel");
    }

    #[test]
    fn a_missing_blank_makes_two_pieces_and_comments_keep_their_blanks() {
        let text = "Drill\nG1 Z[d]F[plunge]\nM6 ( Tool Diam: [toold]\n(T[tool]) M30\nEnd";
        let form = parsed(text);
        let body = &sequence(&form).body;
        assert_eq!(body[0].words[1].pieces.len(), 2);
        assert_eq!(written(&body[1], text), ["M6", "( Tool Diam: [toold]"]);
        assert!(matches!(body[1].words[1].pieces[0].kind, PieceKind::Note { closed: false, .. }));
        assert_eq!(written(&body[2], text), ["(T[tool])", "M30"]);
    }

    #[test]
    fn numbers_may_stand_in_pointed_brackets() {
        let form = parsed("Rapid G<0>\nDrill\nG<90> %<0> X<h> G[90]\nEnd\n");
        let literal = |word: &Word| matches!(word.pieces[0].kind, PieceKind::Literal { .. });
        let kinds: Vec<bool> = sequence(&form).body[0].words.iter().map(literal).collect();
        assert_eq!(kinds, [true, true, false, false]);
        assert_eq!(form.statements().next().unwrap().args[0].text, "G0");
    }

    #[test]
    fn head_lines_are_formats_commands_or_names() {
        let form = parsed("X->3.>4\nP ->34\nA010360\nT 2\nRapid; G0\nReplace \"a b\" \"\"\nFancy 3\nDril\nG81\nEnd\n");
        let kinds: Vec<String> = form
            .items
            .iter()
            .map(|item| match item {
                Head::Format { letter, spec, .. } => format!("{}={}", letter.text, spec.text),
                Head::Statement(s) => {
                    let args: Vec<_> = s.args.iter().map(|a| a.text.as_str()).collect();
                    format!("{}({})", s.name.text, args.join("|"))
                }
                Head::Sequence(s) => format!("{}:{}", s.name.name.text, s.body.len()),
                other => format!("{other:?}"),
            })
            .collect();
        assert_eq!(
            kinds,
            ["X=->3.>4", "P= ->34", "A=010360", "T= 2", "Rapid(G0)", "Replace(a b|)", "Fancy(3)", "Dril:1"]
        );
    }

    #[test]
    fn an_end_far_away_belongs_to_no_unknown_name() {
        let sequences = |empty: usize| parsed(&format!("Dril\nG81\n{}End\n", "\n".repeat(empty))).sequences().count();
        assert_eq!([100, 500].map(sequences), [1, 0]);
    }

    #[test]
    fn a_small_stack_loses_no_line() {
        let count = || parsed("StartCode\n%0\nEnd\n").sequences().count();
        let thread = std::thread::Builder::new().stack_size(80 << 10).spawn(count).unwrap();
        assert_eq!(thread.join().unwrap(), 1);
    }

    #[test]
    fn the_next_name_closes_a_sequence_without_end() {
        let form = parsed("StartCode\n%0\nEndCode\nM30\nEnd\n");
        assert_eq!(form.items.len(), 2);
        assert!(matches!(&form.items[0], Head::Sequence(s) if s.end.is_none() && s.body.len() == 1));
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(4000))]
        /// The grammar accepts every line. The words, the comment and the ignored rest of a line cover everything
        /// except spaces.
        #[test]
        fn every_line_matches(text in "[ \\tA-Za-z0-9#;%:()\\[\\]<>.+~\"/é\u{0}-]{0,24}") {
            for rule in [Rule::head_line, Rule::body_line] {
                prop_assert!(FormGrammar::parse(rule, &text).is_ok(), "{rule:?} {text:?}");
            }
        }
    }
}
