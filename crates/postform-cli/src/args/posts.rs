//! The names of the shipped forms, for `postform new`.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser, ValueParserFactory};
use postform::internals::post::shipped::{FORMS, Shipped};

/// A shipped form, by its name on the command line.
#[derive(Clone, Copy)]
pub struct NewPost(pub &'static Shipped);

impl std::fmt::Debug for NewPost {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.0.name)
    }
}

impl ValueParserFactory for NewPost {
    type Parser = clap::builder::ValueParser;

    fn value_parser() -> Self::Parser {
        let values = FORMS.iter().map(|form| PossibleValue::new(form.name).help(form.about).aliases(form.also));
        let is = |form: &&Shipped, name: &str| {
            form.name.eq_ignore_ascii_case(name) || form.also.iter().any(|also| also.eq_ignore_ascii_case(name))
        };
        // the parser accepts only these names
        let find = move |name: String| NewPost(FORMS.iter().find(|form| is(form, &name)).unwrap_or(&FORMS[0]));
        PossibleValuesParser::new(values).map(find).into()
    }
}
