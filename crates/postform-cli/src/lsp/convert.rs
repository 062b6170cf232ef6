//! Converts locations, findings and edits to and from the protocol.

use std::collections::HashMap;

use gen_lsp_types as lsp;
use postform::Source;
use postform::Span;
use postform::diag::{Diag, Severity};
use postform::internals::ide::utf16;

/// A position in the protocol.
pub fn position(place: utf16::Place) -> lsp::Position {
    lsp::Position { line: place.line, character: place.character }
}

/// The byte offset of a position.
pub fn offset(source: &Source, position: lsp::Position) -> u32 {
    utf16::offset(source, utf16::Place { line: position.line, character: position.character })
}

/// A span of a text.
pub fn range(source: &Source, span: Span) -> lsp::Range {
    let (start, end) = utf16::range(source, span);
    lsp::Range { start: position(start), end: position(end) }
}

/// A span from a range of the protocol.
pub fn span(source: &Source, file: u32, range: lsp::Range) -> Span {
    Span { file, start: offset(source, range.start), end: offset(source, range.end) }
}

/// A whole line, from 0.
pub fn line(number: u32) -> lsp::Range {
    let at = |line| lsp::Position { line, character: 0 };
    lsp::Range { start: at(number), end: at(number + 1) }
}

/// A finding at a range.
pub fn diagnostic(diag: &Diag, range: lsp::Range, source: &str) -> lsp::Diagnostic {
    let message = match &diag.help {
        Some(help) => format!("{}\n{help}", diag.message),
        None => diag.message.clone(),
    };
    lsp::Diagnostic {
        range,
        severity: Some(match diag.severity {
            Severity::Error => lsp::DiagnosticSeverity::Error,
            Severity::Warning => lsp::DiagnosticSeverity::Warning,
            Severity::Note => lsp::DiagnosticSeverity::Information,
        }),
        code: Some(lsp::Code::String(diag.code.name().to_owned())),
        source: Some(source.to_owned()),
        message: lsp::Message::String(message),
        ..lsp::Diagnostic::default()
    }
}

/// A message without a code.
pub fn trouble(message: &str, range: lsp::Range) -> lsp::Diagnostic {
    lsp::Diagnostic {
        range,
        severity: Some(lsp::DiagnosticSeverity::Error),
        source: Some("postform".to_owned()),
        message: lsp::Message::String(message.trim_start_matches("error: ").to_owned()),
        ..lsp::Diagnostic::default()
    }
}

/// Text in Markdown.
pub fn markdown(text: String) -> lsp::MarkupContent {
    lsp::MarkupContent { kind: lsp::MarkupKind::Markdown, value: text }
}

/// Edits of files, each with the URI of its file.
pub fn edit(edits: impl IntoIterator<Item = (lsp::Uri, lsp::TextEdit)>) -> lsp::WorkspaceEdit {
    let mut changes: HashMap<lsp::Uri, Vec<lsp::TextEdit>> = HashMap::new();
    for (uri, edit) in edits {
        changes.entry(uri).or_default().push(edit);
    }
    lsp::WorkspaceEdit { changes: Some(changes), ..lsp::WorkspaceEdit::default() }
}
