//! The directives of a sequence, such as `@if`, which select the lines that print.

use super::expression::{condition, number, says_text, text, yes_or_no};
use super::formula::{Formula, NoValues};
use super::names::{Context, property};
use super::property::{PropertyKind, Target};
use super::step::{Arm, Step};
use crate::diag::{Code, Diag};
use crate::lang::{DIRECTIVES, Each, Origin, Unit, VarId, directive_meant};
use crate::span::Span;
use crate::suggest::did_you_mean;
use crate::syntax::{Directive, DirectiveKind, Spanned};

/// Maximum nesting depth of directives.
pub const DEEPEST: usize = 8;
/// Maximum number of branches in a sequence. Each branch needs one bit.
pub const MOST_ARMS: usize = 128;

/// Combines the lines of a sequence with its directives.
#[derive(Default)]
pub struct Flow {
    /// The open levels of directives, each with its finished steps.
    levels: Vec<Level>,
    /// Number of directives beyond the maximum depth that are not yet closed by `@end`. A directive beyond the maximum
    /// depth opens no level, which limits the depth of the tree.
    too_deep: usize,
    /// Steps of the outermost level.
    steps: Vec<Step>,
    arms: usize,
    /// Whether the sequence has a directive.
    any: bool,
}

/// An `@if` or `@for` that is not yet closed by `@end`.
struct Level {
    /// The directive.
    span: Span,
    kind: Kind,
}

enum Kind {
    If { arms: Vec<Arm>, has_else: bool },
    For(Each, Vec<Step>),
}

impl Flow {
    fn steps(&mut self) -> &mut Vec<Step> {
        let open = match self.levels.last_mut().map(|level| &mut level.kind) {
            Some(Kind::For(_, steps)) => Some(steps),
            Some(Kind::If { arms, .. }) => arms.last_mut().map(|arm| &mut arm.steps),
            None => None,
        };
        open.unwrap_or(&mut self.steps)
    }

    /// Adds a line that prints.
    pub fn line(&mut self, index: usize) {
        match self.steps().last_mut() {
            Some(Step::Lines(lines)) => lines.end = index + 1,
            _ => self.steps().push(Step::Lines(index..index + 1)),
        }
    }

    /// Adds a directive.
    pub fn directive(&mut self, directive: &Directive, context: &Context, diags: &mut Vec<Diag>) {
        self.any = true;
        if self.lies_too_deep(directive, diags) {
            return;
        }
        let at = directive.name.span;
        let name = &directive.name.text;
        let mut wrong = |message: String, label: &str, help: &str| {
            diags.push(Diag::new(Code::PF707, message).at(at, label).help(help));
        };
        match &directive.kind {
            DirectiveKind::If(asked) => {
                let condition = self.condition(asked, directive, context, diags);
                let arm = Arm { span: at.to(directive.rest.span), condition, steps: Vec::new() };
                self.levels.push(Level { span: at, kind: Kind::If { arms: vec![arm], has_else: false } });
                self.count_arm(at, diags);
            }
            DirectiveKind::End if self.levels.is_empty() => {
                wrong(format!("{name} without its @if"), "no @if is open here", "remove it, or write `@if` above it");
            }
            DirectiveKind::Elif(_) | DirectiveKind::Else if !self.in_condition() => {
                wrong(format!("{name} without its @if"), "no @if is open here", "remove it, or write `@if` above it");
            }
            DirectiveKind::Elif(asked) => {
                self.no_more_behind_else(name, at, diags);
                let condition = self.condition(asked, directive, context, diags);
                self.arm(Arm { span: at.to(directive.rest.span), condition, steps: Vec::new() }, diags);
            }
            DirectiveKind::Else => {
                self.nothing_behind(directive, diags);
                self.no_more_behind_else(name, at, diags);
                self.arm(Arm { span: at, condition: None, steps: Vec::new() }, diags);
                if let Some(Kind::If { has_else, .. }) = self.levels.last_mut().map(|level| &mut level.kind) {
                    *has_else = true;
                }
            }
            DirectiveKind::For => {
                let each = self.list(directive, diags);
                self.levels.push(Level { span: at.to(directive.rest.span), kind: Kind::For(each, Vec::new()) });
            }
            DirectiveKind::End => {
                self.nothing_behind(directive, diags);
                self.close();
            }
            DirectiveKind::Set(target, value) => {
                let target = settable(target, context, diags);
                let kind = |row: u16| &context.settings.properties[usize::from(row)].kind;
                let value = match target {
                    Some(Target::Property(row)) if *kind(row) == PropertyKind::YesNo => {
                        yes_or_no(value, context, diags)
                    }
                    Some(Target::Property(row)) if kind(row).is_text() => text(value, row, context, diags),
                    Some(Target::Var(var)) if says_text(value) => {
                        diags.push(
                            Diag::new(Code::PF704, format!("{} is a number, but this is a text", var.name()))
                                .at(directive.rest.span, "a free variable")
                                .help(
                                    "use a property for a text: `Property note text - What it is`, `@set note = \
                                    \"..\"`",
                                ),
                        );
                        None
                    }
                    Some(_) => number(value, context, diags),
                    None => None,
                };
                if let (Some(target), Some(value)) = (target, value) {
                    self.steps().push(Step::Set(target, value, directive.rest.span));
                }
            }
            DirectiveKind::Unknown => {
                let meant = directive_meant(name);
                let help = match meant {
                    Some(meant) => format!("did you mean `{meant}`?"),
                    None => {
                        let names: Vec<_> = DIRECTIVES.iter().map(|row| row.name).collect();
                        format!("the directives are {}; put other text with @ in backquotes", names.join(", "))
                    }
                };
                wrong(format!("`{name}` is not a directive"), "unknown", &help);
                // treat the line as the intended directive, to avoid errors that are only consequences of this error
                match meant {
                    Some("@if" | "@for") if self.levels.len() == DEEPEST => self.too_deep += 1,
                    Some("@if") => {
                        let arm = Arm { span: at, condition: None, steps: Vec::new() };
                        self.levels.push(Level { span: at, kind: Kind::If { arms: vec![arm], has_else: false } });
                    }
                    Some("@for") => self.levels.push(Level { span: at, kind: Kind::For(Each::Tool, Vec::new()) }),
                    Some("@end") => self.close(),
                    _ => {}
                }
            }
        }
    }

    /// Returns the finished steps; `None` if the sequence has no directives. Reports an `@if` or `@for` without `@end`.
    pub fn finish(mut self, diags: &mut Vec<Diag>) -> Option<Vec<Step>> {
        if let Some(level) = self.levels.last() {
            diags.push(
                Diag::new(
                    Code::PF707,
                    format!("{} without its @end", if matches!(level.kind, Kind::For(..)) { "@for" } else { "@if" }),
                )
                .at(level.span, "open to the end of the sequence")
                .help("write `@end` after its last line"),
            );
        }
        self.too_deep = 0;
        while !self.levels.is_empty() {
            self.close();
        }
        self.any.then_some(self.steps)
    }

    fn close(&mut self) {
        if self.too_deep > 0 {
            self.too_deep -= 1;
            return;
        }
        if let Some(level) = self.levels.pop() {
            let step = match level.kind {
                Kind::If { arms, .. } => Step::If(arms),
                Kind::For(each, steps) => Step::For(each, steps, level.span),
            };
            self.steps().push(step);
        }
    }

    fn arm(&mut self, arm: Arm, diags: &mut Vec<Diag>) {
        self.count_arm(arm.span, diags);
        if let Some(Kind::If { arms, .. }) = self.levels.last_mut().map(|level| &mut level.kind) {
            arms.push(arm);
        }
    }

    fn count_arm(&mut self, at: Span, diags: &mut Vec<Diag>) {
        self.arms += 1;
        if self.arms == MOST_ARMS + 1 {
            diags.push(
                Diag::new(Code::PF707, format!("a sequence with more than {MOST_ARMS} branches"))
                    .at(at, "one branch too many")
                    .help("simplify the conditions: there are too many combinations to check"),
            );
        }
    }

    /// Whether the innermost open directive is an `@if`.
    fn in_condition(&self) -> bool {
        self.levels.last().is_some_and(|level| matches!(level.kind, Kind::If { .. }))
    }

    /// Whether a directive is beyond the maximum depth. The result is also true for the `@elif`, `@else` and `@end` of
    /// a directive beyond the maximum depth. The lines of these directives are added to the level above.
    fn lies_too_deep(&mut self, directive: &Directive, diags: &mut Vec<Diag>) -> bool {
        if directive.kind.opens() && self.levels.len() == DEEPEST {
            if self.too_deep == 0 {
                diags.push(
                    Diag::new(Code::PF707, format!("directives are nested more than {DEEPEST} deep"))
                        .at(directive.name.span, "one level too many")
                        .help("combine conditions with `and`, or use `@elif`"),
                );
            }
            self.too_deep += 1;
            return true;
        }
        let inside = self.too_deep > 0 && directive.kind.closes();
        if inside && matches!(directive.kind, DirectiveKind::End) {
            self.too_deep -= 1;
        }
        inside
    }

    /// Reads the kind of items of an `@for`.
    fn list(&self, directive: &Directive, diags: &mut Vec<Diag>) -> Each {
        let rest = &directive.rest;
        let mut wrong = |message: String, label: &str, help: String| {
            diags.push(Diag::new(Code::PF707, message).at(directive.name.span.to(rest.span), label).help(help));
        };
        let names = || Each::ALL.iter().map(|(name, _)| *name);
        let Some(each) = Each::parse(&rest.text) else {
            let help = did_you_mean(&rest.text, names())
                .unwrap_or_else(|| "write `@for tool`, `@for operation` or `@for work`".into());
            let what = if rest.text.is_empty() { "@for".to_owned() } else { format!("`@for {}`", rest.text) };
            wrong(format!("{what} has no list"), "the list is missing", help);
            return Each::Tool;
        };
        let outer = |level: &Level| if let Kind::For(each, _) = level.kind { Some(each) } else { None };
        match self.levels.iter().rev().find_map(outer) {
            Some(outer) if each != Each::Operation || outer == Each::Operation => wrong(
                format!("@for {} inside @for {}", each.name(), outer.name()),
                "one list inside another",
                "only `@for operation` can be inside another @for: it lists the operations of that tool or work \
                 offset"
                    .into(),
            ),
            _ => {}
        }
        each
    }

    fn no_more_behind_else(&self, name: &str, at: Span, diags: &mut Vec<Diag>) {
        if self.levels.last().is_some_and(|level| matches!(level.kind, Kind::If { has_else: true, .. })) {
            diags.push(
                Diag::new(Code::PF707, format!("{name} after @else"))
                    .at(at, "this would never print")
                    .help("`@else` is the last branch: put it after this one"),
            );
        }
    }

    fn nothing_behind(&self, directive: &Directive, diags: &mut Vec<Diag>) {
        if !directive.rest.text.is_empty() {
            let name = directive.name.text.to_ascii_lowercase();
            let help = if name == "@else" { "write `@elif` for another condition" } else { "take it out" };
            diags.push(
                Diag::new(Code::PF707, format!("words after {name}"))
                    .at(directive.rest.span, "no words are allowed here")
                    .help(help),
            );
        }
    }

    fn condition(
        &self,
        asked: &Result<crate::syntax::Expr, crate::syntax::Unread>,
        directive: &Directive,
        context: &Context,
        diags: &mut Vec<Diag>,
    ) -> Option<Formula> {
        // the value of this placeholder does not matter, because a form with an unreadable condition is never printed
        let formula = condition(asked, context, diags).unwrap_or(Formula::Has(VarId::H));
        if let Some(holds) = formula.decided(&NoValues, &|_| false) {
            let what = if holds { "always true" } else { "never true" };
            let help = if holds { "remove the condition" } else { "remove its lines" };
            diags.push(
                Diag::new(Code::PF708, format!("a condition that is {what}"))
                    .at(directive.rest.span, "it contains no value that changes")
                    .help(format!("{help}, or test a variable: `[speed] > 0`")),
            );
        }
        Some(formula)
    }
}

/// Reads the target of `@set`.
fn settable(target: &Spanned, context: &Context, diags: &mut Vec<Diag>) -> Option<Target> {
    if let Some((row, _)) = property(&target.text, context) {
        return Some(Target::Property(row));
    }
    let free = |var: &VarId| {
        var.row().origin == Origin::Job && var.row().unit == Unit::Number && var.name().starts_with("val")
    };
    let var = VarId::parse(&target.text).filter(free);
    if var.is_none() {
        // as in `@set val1 2` and `@set val1 := 2`
        let name = target.text.split([' ', ':', '+', '-']).next().unwrap_or_default().trim_matches(['[', ']']);
        let known = VarId::parse(name).filter(free).is_some() || property(name, context).is_some();
        let (message, help) = if known && name.len() < target.text.len() {
            ("@set without its `=`".to_owned(), format!("write `@set {name} = ..`"))
        } else {
            let own = context.settings.properties.iter().map(|property| property.name.as_str());
            let help = did_you_mean(name, own)
                .unwrap_or_else(|| "val1 to val10 and the form's properties can be set: `@set val1 = [h]+2`".into());
            (format!("`{}` can't be set by a form", target.text), help)
        };
        diags.push(Diag::new(Code::PF707, message).at(target.span, "not a variable that can be set").help(help));
    }
    var.map(Target::Var)
}
