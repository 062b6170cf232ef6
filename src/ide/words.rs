//! Converts explanations of `explain` to Markdown for editors.

/// Converts an explanation: its heading becomes bold, its first line becomes a paragraph, labels of other lines become
/// italic, and its example becomes code.
pub fn markdown(page: &str) -> String {
    let mut lines = page.lines();
    let mut out = lines.next().map(|head| format!("**{}**", head.trim())).unwrap_or_default();
    let mut facts = Vec::new();
    let mut example: Option<String> = None;
    for line in lines {
        match &mut example {
            Some(code) if line.starts_with("  ") || line.is_empty() => *code += &format!("{}\n", line.trim_start()),
            _ if line.starts_with("Example, ") => {
                out += &said(&mut facts);
                out += &format!("\n\n{}\n", escape(line));
                example = Some(String::new());
            }
            _ => match line.split_once(' ') {
                Some(("is" | "does", value)) => out += &format!("\n\n{}", escape(value.trim())),
                Some((key, value)) if !line.starts_with(' ') && line.len() > 10 && line.is_char_boundary(10) => {
                    let split = line.get(..9).filter(|key| key.trim_end().len() < 9 || line[9..].starts_with(' '));
                    let (key, value) = split.map_or((key, value), |key| (key.trim_end(), &line[9..]));
                    facts.push(format!("*{key}* {}", escape(value.trim())));
                }
                _ if line.trim().is_empty() => {}
                _ => facts.push(escape(line.trim())),
            },
        }
    }
    out += &said(&mut facts);
    if let Some(code) = example {
        out += &format!("```postform\n{}\n```", code.trim_end());
    }
    out
}

fn said(facts: &mut Vec<String>) -> String {
    if facts.is_empty() { String::new() } else { format!("\n\n{}", std::mem::take(facts).join("  \n")) }
}

/// Escapes a text so that Markdown shows it unchanged.
pub fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        if matches!(c, '\\' | '`' | '*' | '_' | '<' | '>' | '[' | ']' | '#' | '|') {
            out.push('\\');
        }
        out.push(c);
    }
    out
}

/// Blocks of a program as Markdown code.
pub fn blocks<'a>(lines: impl IntoIterator<Item = &'a str>) -> String {
    let lines: Vec<String> = lines.into_iter().map(|line| line.replace("```", "` ` `")).collect();
    format!("```nc\n{}\n```", lines.join("\n"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::explain;
    use crate::lang::{CommandId, VarId};

    #[test]
    fn pages_become_markdown() {
        let text = markdown(&explain::variable(VarId::Vclear));
        assert!(text.starts_with("**[vclear] (variable)**\n\nclearance plane (R plane)"), "{text}");
        assert!(text.contains("*counts* length  \n*set by* postform"), "{text}");
        assert!(text.contains("```postform\nG[retplane] G81"), "{text}");
        let text = markdown(&explain::command(CommandId::Coolant));
        assert!(text.contains("values of \\[cool\\]") && text.contains("*takes* 2 to 3 codes"), "{text}");
    }
}
