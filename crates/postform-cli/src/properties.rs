//! `postform properties`: the settings that a form offers to the shop, for a CAM system's dialog.

use std::io::Write;
use std::path::Path;

use postform::Post;
use postform::internals::sema::{PropertyKind, PropertyValue};
use postform::internals::terminal::escaped;
use serde_json::{Value, json};

use super::Ending;
use super::args::{PropertiesArgs, PropertiesFormat};
use super::config::Config;
use super::forms::FormFile;
use super::output::{json, shown};
use super::report::Reporter;
use super::say::say;

/// Lists the properties of a form.
pub fn run(args: &PropertiesArgs, colour: bool) -> Result<Ending, String> {
    let config = Config::near(&args.form)?;
    let limits = config.limits.unwrap_or_default();
    let file = FormFile::read(&args.form, limits)?.of_post(args.post.as_deref())?;
    let post = match Post::compile_with(file.source(), &file, limits, &config.levels) {
        Ok(post) => post,
        Err(error) => {
            let found = error.into_findings();
            say(&Reporter::new(colour).text(&found.diags, &found.files));
            return Ok(Ending::Findings);
        }
    };
    config.check_properties(&args.form, post.properties())?;
    let text = match args.format {
        PropertiesFormat::Text => text(&post),
        PropertiesFormat::Json => document(&post, &args.form),
    };
    shown(|out| out.write_all(text.as_bytes()))
}

fn text(post: &Post) -> String {
    let mut text = String::new();
    for property in post.properties() {
        let [default, takes] = [property.default.to_string(), property.kind.takes().to_string()];
        text += &escaped(&format!("{} = {default}", property.name));
        text += "\n  ";
        text += &escaped(&format!("{takes}: {}", property.text));
        text += "\n";
    }
    if text.is_empty() { "the form has no properties\n".into() } else { text }
}

fn document(post: &Post, form: &Path) -> String {
    let value = |value: &PropertyValue| match value {
        PropertyValue::Number(number) => json!(number),
        PropertyValue::YesNo(yes) => json!(yes),
        PropertyValue::Text(text) => json!(text),
    };
    let rows: Vec<Value> = post
        .properties()
        .iter()
        .map(|property| {
            let choices = if let PropertyKind::Choice(words) = &property.kind { Some(words) } else { None };
            json!({
                "name": property.name,
                "kind": property.kind.name(),
                "choices": choices,
                "default": value(&property.default),
                "text": property.text,
            })
        })
        .collect();
    let name = form.to_string_lossy();
    json(&json!({ "version": 1, "form": name, "properties": rows }))
}
