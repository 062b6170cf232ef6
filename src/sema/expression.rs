//! Reads the expressions of a form: resolves names, checks types and reports errors.

use super::formula::{Formula, Function, NoValues};
use super::names::{Context, property, variable};
use super::near;
use super::property::{PropertyKind, PropertyValue};
use super::value_names::names_of;
use crate::diag::{Code, Diag};
use crate::lang::{Coolant, TextVar, VarId, VarSet};
use crate::span::Span;
use crate::suggest::did_you_mean;
use crate::syntax::{Arithmetic, Comparison, Expr, ExprKind, Operator, Spanned, Unread};

/// Variables whose value is 1 or 0. A condition may use a variable of this list without a comparison.
const YES_OR_NO: VarSet =
    VarSet::of(&[VarId::Lasthole, VarId::Isfirsthole, VarId::Rigid, VarId::Isfirsttool, VarId::Islasttool]);

const EQUAL: Operator = Operator::Comparison(Comparison::Equal);
const UNEQUAL: Operator = Operator::Comparison(Comparison::Unequal);

/// Type of an expression.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Number,
    Text,
    YesNo,
}

impl Kind {
    fn name(self) -> &'static str {
        match self {
            Kind::Number => "a number",
            Kind::Text => "a text",
            Kind::YesNo => "yes or no",
        }
    }
}

/// Reads an expression that must be a number, as in the brackets of a word.
pub fn number(expr: &Result<Expr, Unread>, context: &Context, diags: &mut Vec<Diag>) -> Option<Formula> {
    let expr = read(expr, diags)?;
    let (formula, kind) = typed(expr, context, diags)?;
    wants(kind, Kind::Number, expr.span, diags)?;
    Some(formula)
}

/// Reads a condition. A variable without a comparison is true if the variable has a value. A variable that can only be
/// 1 or 0 is true if its value is 1.
pub fn condition(expr: &Result<Expr, Unread>, context: &Context, diags: &mut Vec<Diag>) -> Option<Formula> {
    asked(read(expr, diags)?, context, diags)
}

/// Reads a value for a yes-or-no property: a condition, or one of the words for yes and no.
pub fn yes_or_no(expr: &Result<Expr, Unread>, context: &Context, diags: &mut Vec<Diag>) -> Option<Formula> {
    let expr = read(expr, diags)?;
    if let ExprKind::Word(word) = &expr.kind
        && let Ok(PropertyValue::YesNo(yes)) = PropertyKind::YesNo.read(word)
    {
        return Some(Formula::Yes(yes));
    }
    asked(expr, context, diags)
}

/// Reads a text value for the property with this row.
pub fn text(expr: &Result<Expr, Unread>, row: u16, context: &Context, diags: &mut Vec<Diag>) -> Option<Formula> {
    let expr = read(expr, diags)?;
    let property = &context.settings.properties[usize::from(row)];
    if let ExprKind::Word(word) | ExprKind::Text(word) = &expr.kind {
        return named(word, expr.span, &Formula::PropertyText(row), Kind::Text, context, diags).map(|(text, _)| text);
    }
    let (formula, kind) = typed(expr, context, diags)?;
    wants(kind, Kind::Text, expr.span, diags)?;
    if let PropertyKind::Choice(_) = property.kind {
        diags.push(
            Diag::new(
                Code::PF706,
                format!("[{}] is a choice, but a text of the job may be none of its words", property.name),
            )
            .at(expr.span, "any text of the job")
            .help(format!("test the text with `@if`, and set {}", property.kind.takes())),
        );
        return None;
    }
    Some(formula)
}

/// Whether the expression is a text in quotes.
pub fn says_text(expr: &Result<Expr, Unread>) -> bool {
    matches!(expr, Ok(Expr { kind: ExprKind::Text(_), .. }))
}

fn read<'a>(expr: &'a Result<Expr, Unread>, diags: &mut Vec<Diag>) -> Option<&'a Expr> {
    match expr {
        Ok(expr) => Some(expr),
        Err(unread) => {
            let all = || {
                "write names, numbers, + - * / and brackets, as `[vclear-pointd]`; put text of the control with \
                 brackets in backquotes"
                    .to_owned()
            };
            diags.push(
                Diag::new(Code::PF703, format!("the expression can't be read: {}", unread.why))
                    .at(unread.span, "here")
                    .help(unread.help.clone().unwrap_or_else(all)),
            );
            None
        }
    }
}

fn wants(kind: Kind, wanted: Kind, span: Span, diags: &mut Vec<Diag>) -> Option<()> {
    if kind == wanted {
        return Some(());
    }
    let help = match (kind, wanted) {
        (Kind::Text, Kind::Number) => "compare a text with `=` or `like`; print it alone: `[toolname]`",
        (Kind::YesNo, Kind::Number) => "test it in a condition: `@if [isfirsttool]`, `@if [header] = yes`",
        (Kind::Number, Kind::Text) => "compare a text with a text: `[toolname] = \"5\"`, `[toolname] like \"DRILL*\"`",
        _ => "compare it: `[speed] > 0`, `[toolname] like \"DRILL*\"`",
    };
    diags.push(
        Diag::new(Code::PF704, format!("{}, but {} is needed", kind.name(), wanted.name()))
            .at(span, format!("this is {}", kind.name()))
            .help(help),
    );
    None
}

/// Reads an expression that is used as a condition.
fn asked(expr: &Expr, context: &Context, diags: &mut Vec<Diag>) -> Option<Formula> {
    let (formula, kind) = typed(expr, context, diags)?;
    match (formula, kind) {
        (Formula::Var(var), _) if YES_OR_NO.has(var) => Some(Formula::True(var)),
        (Formula::Var(var), _) => Some(Formula::Has(var)),
        (Formula::TextVar(id), _) => Some(Formula::HasText(id)),
        (Formula::PropertyText(row), _) => {
            let both = Box::new([Formula::PropertyText(row), Formula::Text(String::new())]);
            Some(Formula::Compare(Comparison::Unequal, both))
        }
        (formula, kind) => wants(kind, Kind::YesNo, expr.span, diags).map(|()| formula),
    }
}

fn typed(expr: &Expr, context: &Context, diags: &mut Vec<Diag>) -> Option<(Formula, Kind)> {
    Some(match &expr.kind {
        ExprKind::Number(text) => (Formula::Number(text.parse().ok()?), Kind::Number),
        ExprKind::Text(text) => (Formula::Text(text.clone()), Kind::Text),
        ExprKind::Variable(name) if let Some((row, property)) = property(name, context) => match &property.kind {
            PropertyKind::YesNo => (Formula::PropertyHolds(row), Kind::YesNo),
            kind if kind.is_text() => (Formula::PropertyText(row), Kind::Text),
            _ => (Formula::Property(row), Kind::Number),
        },
        ExprKind::Variable(name) => match TextVar::parse(name) {
            Some(text) => {
                if text.width != 0 {
                    let alone = name.split(':').next().unwrap_or(name);
                    diags.push(
                        Diag::new(
                            Code::PF702,
                            format!("`{name}` has a width, but only printed texts can have a width"),
                        )
                        .at(expr.span, "compared without a width")
                        .help(format!("write `[{alone}]`; `like \"LID*\"` tests its beginning")),
                    );
                }
                (Formula::TextVar(text.id), Kind::Text)
            }
            None => {
                let name = Spanned { text: name.clone(), span: expr.span };
                (Formula::Var(variable(&name, context.settings, diags)?), Kind::Number)
            }
        },
        ExprKind::Word(word) => {
            let help = match VarId::parse(word) {
                Some(var) => format!("write a variable in brackets: `[{}]`", var.name()),
                None => "compare the name of a value with its variable: `[direct] = cw`; put text in quotes".into(),
            };
            diags.push(
                Diag::new(Code::PF706, format!("`{word}` is not a value")).at(expr.span, "a name alone").help(help),
            );
            return None;
        }
        ExprKind::Call(name, args) => (call(name, args, context, diags)?, Kind::Number),
        ExprKind::Unary(Operator::Not, of) => (Formula::Not(Box::new(asked(of, context, diags)?)), Kind::YesNo),
        ExprKind::Unary(_, of) => {
            let (formula, kind) = typed(of, context, diags)?;
            wants(kind, Kind::Number, of.span, diags)?;
            (Formula::Negative(Box::new(formula)), Kind::Number)
        }
        ExprKind::Binary(operator, sides) => return binary(*operator, sides, context, diags),
    })
}

fn call(name: &Spanned, args: &[Expr], context: &Context, diags: &mut Vec<Diag>) -> Option<Formula> {
    let names = || Function::ALL.iter().map(|(name, _)| *name);
    let Some(function) = Function::parse(&name.text) else {
        let help = did_you_mean(&name.text, names());
        let all = || format!("there are {}", names().collect::<Vec<_>>().join(", "));
        diags.push(
            Diag::new(Code::PF703, format!("`{}` is not a function", name.text))
                .at(name.span, "unknown")
                .help(help.unwrap_or_else(all)),
        );
        return None;
    };
    if args.len() > 1 && !function.takes_several() {
        diags.push(
            Diag::new(Code::PF703, format!("{} takes one number", name.text))
                .at(args[1].span, "one argument too many")
                .help("remove it; `min` and `max` take several numbers"),
        );
        return None;
    }
    let numbers = args.iter().map(|arg| {
        let (formula, kind) = typed(arg, context, diags)?;
        wants(kind, Kind::Number, arg.span, diags)?;
        Some(formula)
    });
    Some(Formula::Call(function, numbers.collect::<Option<Vec<_>>>()?))
}

fn binary(operator: Operator, sides: &[Expr; 2], context: &Context, diags: &mut Vec<Diag>) -> Option<(Formula, Kind)> {
    let [left, right] = sides;
    let formula = match operator {
        Operator::Arithmetic(arithmetic) => return calculated(arithmetic, left, right, context, diags),
        Operator::And => Formula::And(Box::new([asked(left, context, diags)?, asked(right, context, diags)?])),
        Operator::Or => Formula::Or(Box::new([asked(left, context, diags)?, asked(right, context, diags)?])),
        _ => compared(operator, left, right, context, diags)?,
    };
    Some((formula, Kind::YesNo))
}

fn calculated(
    arithmetic: Arithmetic,
    left: &Expr,
    right: &Expr,
    context: &Context,
    diags: &mut Vec<Diag>,
) -> Option<(Formula, Kind)> {
    let mut number = |side: &Expr| {
        let (formula, kind) = typed(side, context, diags)?;
        wants(kind, Kind::Number, side.span, diags).map(|()| formula)
    };
    let both = Box::new([number(left)?, number(right)?]);
    let zero = || both[1].is_constant() && both[1].number(&NoValues).is_ok_and(near::is_zero);
    if arithmetic == Arithmetic::Divide && zero() {
        diags
            .push(Diag::new(Code::PF705, "a division by zero").at(right.span, "this is 0").help("use another divisor"));
        return None;
    }
    Some((Formula::Arithmetic(arithmetic, both, right.span), Kind::Number))
}

fn compared(
    operator: Operator,
    left: &Expr,
    right: &Expr,
    context: &Context,
    diags: &mut Vec<Diag>,
) -> Option<Formula> {
    if let Some(cools) = cools(operator, left, right, context) {
        return Some(cools);
    }
    let word = |side: &Expr| if let ExprKind::Word(word) = &side.kind { Some(word.clone()) } else { None };
    // the meaning of a name without brackets depends on the other operand
    let both = match (word(left), word(right)) {
        (None, Some(word)) => {
            let (formula, kind) = typed(left, context, diags)?;
            let named = named(&word, right.span, &formula, kind, context, diags)?;
            [(formula, kind), named]
        }
        (Some(word), None) => {
            let (formula, kind) = typed(right, context, diags)?;
            let named = named(&word, left.span, &formula, kind, context, diags)?;
            [named, (formula, kind)]
        }
        _ => [typed(left, context, diags)?, typed(right, context, diags)?],
    };
    let [(left_formula, left_kind), (right_formula, right_kind)] =
        chosen(operator, both, [left, right], context, diags)?;
    if operator == Operator::Like {
        wants(left_kind, Kind::Text, left.span, diags)?;
        let Formula::Text(pattern) = right_formula else {
            diags.push(
                Diag::new(Code::PF704, "`like` compares with a pattern in quotes")
                    .at(right.span, "this is not a pattern")
                    .help("write `[toolname] like \"DRILL*\"`; `*` matches any text, `?` matches one character"),
            );
            return None;
        };
        return Some(Formula::Like(Box::new(left_formula), pattern));
    }
    if left_kind != right_kind {
        wants(right_kind, left_kind, right.span, diags)?;
    }
    let Operator::Comparison(comparison) = operator else { return None };
    Some(Formula::Compare(comparison, Box::new([left_formula, right_formula])))
}

/// Checks a comparison of a choice property with a text in quotes. The text must be one of the choice's words. Only
/// `=`, `<>` and `like` are allowed, because the words have no order.
fn chosen(
    operator: Operator,
    sides: [(Formula, Kind); 2],
    at: [&Expr; 2],
    context: &Context,
    diags: &mut Vec<Diag>,
) -> Option<[(Formula, Kind); 2]> {
    let choice = |side: &(Formula, Kind)| match side.0 {
        Formula::PropertyText(row) => {
            let property = &context.settings.properties[usize::from(row)];
            matches!(property.kind, PropertyKind::Choice(_)).then_some(property)
        }
        _ => None,
    };
    let [left, right] = sides;
    let Some(property) = choice(&left).or(choice(&right)) else { return Some([left, right]) };
    if !matches!(operator, EQUAL | UNEQUAL | Operator::Like) {
        diags.push(
            Diag::new(Code::PF704, format!("the words of [{}] have no order", property.name))
                .at(at[0].span.to(at[1].span), "compared with greater or less")
                .help("compare with `=` or `<>`"),
        );
        return None;
    }
    match (&left, &right) {
        (of, (Formula::Text(word), _)) if operator != Operator::Like => {
            let word = named(word, at[1].span, &of.0, of.1, context, diags)?;
            Some([left, word])
        }
        ((Formula::Text(word), _), of) if operator != Operator::Like => {
            let word = named(word, at[0].span, &of.0, of.1, context, diags)?;
            Some([word, right])
        }
        _ => Some([left, right]),
    }
}

/// Reads comparisons like `[cool] = through`. Kinds of coolant are compared by name, because each form may have other
/// codes for the kinds.
fn cools(operator: Operator, left: &Expr, right: &Expr, context: &Context) -> Option<Formula> {
    let (ExprKind::Variable(name), ExprKind::Word(word)) = (&left.kind, &right.kind) else { return None };
    let kind = Coolant::parse(word).filter(|_| VarId::parse(name) == Some(VarId::Cool))?;
    let has_code = context.settings.coolant_kinds.iter().any(|own| own.kind == kind);
    if matches!(kind, Coolant::THROUGH | Coolant::AIR | Coolant::HIGH) && !has_code {
        return None;
    }
    match operator {
        EQUAL => Some(Formula::Cools(kind)),
        UNEQUAL => Some(Formula::Not(Box::new(Formula::Cools(kind)))),
        _ => None,
    }
}

/// Resolves a name without brackets. The meaning of the name depends on the other operand.
fn named(
    word: &str,
    span: Span,
    beside: &Formula,
    kind: Kind,
    context: &Context,
    diags: &mut Vec<Diag>,
) -> Option<(Formula, Kind)> {
    match beside {
        Formula::PropertyText(row) => {
            let property = &context.settings.properties[usize::from(*row)];
            return match property.kind.read(word) {
                Ok(value) => Some((Formula::Text(value.text().to_owned()), Kind::Text)),
                Err(_) => {
                    diags.push(
                        Diag::new(Code::PF706, format!("`{word}` is not a value of [{}]", property.name))
                            .at(span, "unknown")
                            .help(format!("it takes {}", property.kind.takes())),
                    );
                    None
                }
            };
        }
        Formula::PropertyHolds(_) => {
            if let Ok(PropertyValue::YesNo(yes)) = PropertyKind::YesNo.read(word) {
                return Some((Formula::Yes(yes), Kind::YesNo));
            }
        }
        _ if kind == Kind::Text => return Some((Formula::Text(word.to_owned()), Kind::Text)),
        _ => {}
    }
    let names = match beside {
        Formula::Var(var) if YES_OR_NO.has(*var) => vec![("yes", 1.0), ("no", 0.0)],
        Formula::Var(var) => names_of(*var, context.settings),
        _ => Vec::new(),
    };
    if let Some((_, value)) = names.iter().find(|(name, _)| name.eq_ignore_ascii_case(word)) {
        return Some((Formula::Number(*value), Kind::Number));
    }
    if VarId::parse(word).is_some() {
        let message = format!("`{word}` is a variable and has no brackets");
        diags.push(Diag::new(Code::PF706, message).at(span, "a word").help(format!("write `[{word}]`")));
        return None;
    }
    let shown = match beside {
        Formula::Var(var) => format!("[{}]", var.name()),
        _ => "the other side".to_owned(),
    };
    let list = || names.iter().map(|(name, _)| *name).collect::<Vec<_>>().join(", ");
    let help = match names.is_empty() {
        _ if Coolant::parse(word).is_some() && matches!(beside, Formula::Var(VarId::Cool)) => {
            format!("define its code at the top of the form: `CoolantKind {word} M88`")
        }
        true => "compare with a number; put a text in quotes".to_owned(),
        false => {
            did_you_mean(word, names.iter().map(|(name, _)| *name)).unwrap_or_else(|| format!("use one of {}", list()))
        }
    };
    diags.push(Diag::new(Code::PF706, format!("`{word}` is not a value of {shown}")).at(span, "unknown").help(help));
    None
}
