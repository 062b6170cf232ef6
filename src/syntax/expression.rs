//! Expressions: text in brackets that is more than a name, and conditions of directives.

use std::sync::LazyLock;

use pest::Parser;
use pest::error::InputLocation;
use pest::iterators::{Pair, Pairs};
use pest::pratt_parser::{Assoc, Op, PrattParser};

use super::ast::Spanned;
use super::grammar::{FormGrammar, Rule};
use super::operator::{Arithmetic, Comparison, Operator};
use crate::span::Span;

/// Maximum nesting depth of brackets.
pub const DEEPEST: usize = 32;
/// Maximum length of an expression in bytes. A longer expression is hard to read.
pub const LONGEST: usize = 500;

/// An expression.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Expr {
    /// Location.
    pub span: Span,
    /// Kind.
    pub kind: ExprKind,
}

/// The kinds of expressions.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ExprKind {
    /// A number as written.
    Number(String),
    /// Text between quotes.
    Text(String),
    /// A name in brackets, which is a variable.
    Variable(String),
    /// A name outside brackets, which is the name of a value, such as `through`.
    Word(String),
    /// A function with its arguments, such as `max(h, 0)`.
    Call(Spanned, Vec<Expr>),
    /// An operator with one operand, such as `-h` or `not [lasthole]`.
    Unary(Operator, Box<Expr>),
    /// An operator with two operands, such as `h+1` or `[cool] = through`.
    Binary(Operator, Box<[Expr; 2]>),
}

impl Expr {
    /// Calls `take` with the name and the location of each variable.
    pub fn variables(&self, take: &mut dyn FnMut(&str, Span)) {
        match &self.kind {
            ExprKind::Variable(name) => take(name, self.span),
            ExprKind::Call(_, parts) => parts.iter().for_each(|part| part.variables(take)),
            ExprKind::Unary(_, of) => of.variables(take),
            ExprKind::Binary(_, sides) => sides.iter().for_each(|side| side.variables(take)),
            ExprKind::Number(_) | ExprKind::Text(_) | ExprKind::Word(_) => {}
        }
    }
}

/// An error in an expression.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unread {
    /// The location where reading stopped.
    pub span: Span,
    /// The reason.
    pub why: String,
    /// How to correct the error, if known.
    pub help: Option<String>,
}

/// The operators in the order of their precedence, lowest first.
static OPERATORS: LazyLock<PrattParser<Rule>> = LazyLock::new(|| {
    let infix = |rule| Op::infix(rule, Assoc::Left);
    PrattParser::new()
        .op(infix(Rule::or))
        .op(infix(Rule::and))
        .op(Op::prefix(Rule::not))
        .op(infix(Rule::equal)
            | infix(Rule::unequal)
            | infix(Rule::less)
            | infix(Rule::at_most)
            | infix(Rule::greater)
            | infix(Rule::at_least)
            | infix(Rule::like))
        .op(infix(Rule::add) | infix(Rule::subtract))
        .op(infix(Rule::multiply) | infix(Rule::divide))
        .op(Op::prefix(Rule::negative))
});

/// Whether the brackets in the line are nested too deeply for an expression. The parser calls itself for each level of brackets.
pub fn is_too_deep(line: &str) -> bool {
    let mut depth = 0_usize;
    line.bytes().any(|c| {
        match c {
            b'[' => depth += 1,
            b'(' if depth > 0 => depth += 1,
            b')' | b']' => depth = depth.saturating_sub(1),
            _ => {}
        }
        depth > 2 * DEEPEST
    })
}

/// Parses an expression whose text is at `span`. `in_brackets`: names are variables.
///
/// # Errors
/// The expression has an error. The error has its location and reason.
pub fn expression(text: &str, span: Span, in_brackets: bool) -> Result<Expr, Unread> {
    if text.len() > LONGEST {
        return Err(Unread { span, why: format!("it has more than {LONGEST} characters"), help: None });
    }
    let mut depth = 0_usize;
    for (at, c) in text.char_indices() {
        match c {
            '(' | '[' => depth += 1,
            ')' | ']' => depth = depth.saturating_sub(1),
            _ => {}
        }
        if depth > DEEPEST {
            let here = Span { start: span.start + at as u32, end: span.start + at as u32 + 1, ..span };
            return Err(Unread {
                span: here,
                why: format!("its brackets are nested more than {DEEPEST} deep"),
                help: None,
            });
        }
    }
    let read = Reading { start: span.start, file: span.file };
    match FormGrammar::parse(Rule::expression, text) {
        Ok(mut pairs) => {
            let terms = pairs.next().and_then(|pair| pair.into_inner().find(|pair| pair.as_rule() == Rule::terms));
            terms.map(|terms| read.terms(terms.into_inner(), in_brackets)).ok_or_else(|| unread(text, 0, span))
        }
        Err(error) => {
            let at = match error.location {
                InputLocation::Pos(at) | InputLocation::Span((at, _)) => at,
            };
            Err(unread(text, at, span))
        }
    }
}

/// The error at the point where reading stopped.
fn unread(text: &str, at: usize, span: Span) -> Unread {
    let at = if text.is_char_boundary(at) { at } else { text.len() };
    let (read, rest) = text.split_at(at);
    let help = instead(read, rest);
    let here = |at: usize, c: char| {
        let start = span.start + at as u32;
        Span { start, end: start + c.len_utf8() as u32, ..span }
    };
    match rest.trim_start().chars().next() {
        Some(c) => {
            let at = text.len() - rest.trim_start().len();
            Unread { span: here(at, c), why: format!("`{c}` can't be here"), help }
        }
        None => {
            let last = text.trim_end().char_indices().next_back();
            let span = last.map_or(span, |(at, c)| here(at, c));
            Unread { span, why: "something is missing at its end".into(), help }
        }
    }
}

/// The correction that a message shows for an operator of another language.
fn instead(read: &str, rest: &str) -> Option<String> {
    /// Texts at the point where reading stopped, each with its correction.
    const OTHERS: [(&str, &str); 8] = [
        ("!=", "write `<>` for not equal"),
        ("!", "write `not`"),
        ("&", "write `and`"),
        ("|", "write `or`"),
        ("'", "put a text in double quotes: `\"DRILL 8\"`"),
        ("^", "write a power as a product: `[d*d]`"),
        ("then", "remove `then`: write the lines to print below, up to `@end`"),
        ("goto", "put text of the control in backquotes, on a separate line"),
    ];
    let (before, behind) = (read.trim_end(), rest.trim_start());
    let lower = behind.to_ascii_lowercase();
    let known = OTHERS.iter().find(|(other, _)| lower.starts_with(other)).map(|(_, help)| *help);
    let digit = |c: Option<char>| c.is_some_and(|c| c.is_ascii_digit());
    let count = |c: char| read.matches(c).count();
    let help = match behind.chars().next() {
        _ if known.is_some() => known?,
        Some('=') if before.ends_with('=') => "one `=` compares",
        Some('*') if before.ends_with('*') => "write a power as a product: `[d*d]`",
        Some(',') if digit(before.chars().next_back()) && digit(behind.chars().nth(1)) => {
            "write decimals with a point, not a comma"
        }
        Some(c) if c.is_ascii_alphanumeric() || "[\"(".contains(c) => {
            "an operator is missing before it: one of = <> < <= > >= and or like, + - * /"
        }
        None if before.is_empty() => "write a condition, as `@if [cool] = on`, or a value, as `@set val1 = 2`",
        None if count('(') > count(')') => "a closing bracket is missing",
        None if before.ends_with('*') && before.split(['=', ' ']).next_back().is_some_and(|word| word.len() > 1) => {
            "put a pattern in quotes after `like`: `[toolname] like \"DRILL*\"`"
        }
        _ => return None,
    };
    Some(help.to_owned())
}

/// Where the text of an expression is in its file.
#[derive(Clone, Copy)]
struct Reading {
    file: u32,
    start: u32,
}

impl Reading {
    fn span(self, pair: &Pair<Rule>) -> Span {
        let inner = pair.as_span();
        let at = |byte: usize| self.start as usize + byte;
        Span::new(self.file, at(inner.start()), at(inner.end()))
    }

    fn terms(self, pairs: Pairs<Rule>, in_brackets: bool) -> Expr {
        OPERATORS
            .map_primary(|pair| self.primary(pair, in_brackets))
            .map_prefix(|pair, of| {
                let operator = if pair.as_rule() == Rule::not {
                    Operator::Not
                } else {
                    Operator::Arithmetic(Arithmetic::Subtract)
                };
                Expr { span: self.span(&pair).to(of.span), kind: ExprKind::Unary(operator, Box::new(of)) }
            })
            .map_infix(|left, pair, right| {
                let span = left.span.to(right.span);
                Expr { span, kind: ExprKind::Binary(operator(pair.as_rule()), Box::new([left, right])) }
            })
            .parse(pairs)
    }

    fn primary(self, pair: Pair<Rule>, in_brackets: bool) -> Expr {
        let span = self.span(&pair);
        let text = pair.as_str();
        let kind = match pair.as_rule() {
            Rule::value => ExprKind::Number(text.to_owned()),
            Rule::text => ExprKind::Text(text[1..text.len() - 1].to_owned()),
            Rule::term if in_brackets => ExprKind::Variable(text.to_owned()),
            Rule::call => {
                let mut parts = pair.into_inner();
                let name = parts.next().map_or(Spanned { text: String::new(), span }, |name| Spanned {
                    text: name.as_str().to_owned(),
                    span: self.span(&name),
                });
                ExprKind::Call(name, parts.map(|part| self.terms(part.into_inner(), in_brackets)).collect())
            }
            Rule::bracketed => {
                let inner = pair.into_inner().next().map(|terms| self.terms(terms.into_inner(), true));
                return inner.map_or(Expr { span, kind: ExprKind::Word(String::new()) }, |of| Expr { span, ..of });
            }
            Rule::terms => {
                return Expr { span, ..self.terms(pair.into_inner(), in_brackets) };
            }
            _ => ExprKind::Word(text.to_owned()),
        };
        Expr { span, kind }
    }
}

fn operator(rule: Rule) -> Operator {
    match rule {
        Rule::add => Operator::Arithmetic(Arithmetic::Add),
        Rule::subtract => Operator::Arithmetic(Arithmetic::Subtract),
        Rule::multiply => Operator::Arithmetic(Arithmetic::Multiply),
        Rule::divide => Operator::Arithmetic(Arithmetic::Divide),
        Rule::unequal => Operator::Comparison(Comparison::Unequal),
        Rule::less => Operator::Comparison(Comparison::Less),
        Rule::at_most => Operator::Comparison(Comparison::AtMost),
        Rule::greater => Operator::Comparison(Comparison::Greater),
        Rule::at_least => Operator::Comparison(Comparison::AtLeast),
        Rule::like => Operator::Like,
        Rule::and => Operator::And,
        Rule::or => Operator::Or,
        _ => Operator::Comparison(Comparison::Equal),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The expression as text, with brackets around each part.
    fn shown(text: &str) -> String {
        fn show(expr: &Expr) -> String {
            match &expr.kind {
                ExprKind::Number(text) | ExprKind::Variable(text) => text.clone(),
                ExprKind::Word(text) => format!("'{text}"),
                ExprKind::Text(text) => format!("{text:?}"),
                ExprKind::Call(name, args) => {
                    format!("{}({})", name.text, args.iter().map(show).collect::<Vec<_>>().join(","))
                }
                ExprKind::Unary(operator, of) => format!("({} {})", operator.name(), show(of)),
                ExprKind::Binary(operator, sides) => {
                    format!("({} {} {})", show(&sides[0]), operator.name(), show(&sides[1]))
                }
            }
        }
        match expression(text, Span::new(0, 0, text.len()), false) {
            Ok(expr) => show(&expr),
            Err(unread) => format!("{}: {}", unread.span.start, unread.why),
        }
    }

    #[test]
    fn operators_bind_as_in_arithmetic() {
        let table = [
            ("[h]+[v]*2", "(h + (v * 2))"),
            ("[h+v*2-d]", "((h + (v * 2)) - d)"),
            ("[(h+hmax)/2]", "((h + hmax) / 2)"),
            ("[-h*2]", "((- h) * 2)"),
            ("[h - -v]", "(h - (- v))"),
            ("[max(h, 0, v-1)]", "max(h,0,(v - 1))"),
            ("[cool] = through and [speed] > 0", "((cool = 'through) and (speed > 0))"),
            ("not [a] = 1 or [b] and [c]", "((not (a = 1)) or (b and c))"),
            ("[toolname] like \"DRILL*\"", "(toolname like \"DRILL*\")"),
            ("[a]<>[b]", "(a <> b)"),
            ("[android] = orange", "(android = 'orange)"),
            ("( [a] <= .5 )", "(a <= .5)"),
        ];
        for (text, tree) in table {
            assert_eq!(shown(text), tree, "{text}");
        }
    }

    #[test]
    fn what_can_not_be_read_has_its_place() {
        let table = [
            ("", "0: something is missing at its end"),
            ("[h]+", "3: something is missing at its end"),
            ("[h]+*2", "4: `*` can't be here"),
            ("[h", "1: something is missing at its end"),
            ("[h]]", "3: `]` can't be here"),
            ("[h] [v]", "4: `[` can't be here"),
            ("[h] == 1", "5: `=` can't be here"),
        ];
        for (text, why) in table {
            assert_eq!(shown(text), why, "{text}");
        }
        let deep = |n: usize| format!("{}1{}", "(".repeat(n), ")".repeat(n));
        assert_eq!(shown(&deep(32)), "1");
        assert_eq!(shown(&deep(33)), "32: its brackets are nested more than 32 deep");
        assert_eq!(shown(&"1+".repeat(400)), "0: it has more than 500 characters");
    }
}
