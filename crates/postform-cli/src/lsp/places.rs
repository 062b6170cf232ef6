//! Other locations of a name, and renaming.

use gen_lsp_types as lsp;
use postform::Span;

use super::convert::{edit, offset, range};
use super::programs;
use super::server::Server;
use super::texts::Kind;
use super::view::View;

fn location(server: &Server, view: &View, span: Span) -> Option<lsp::Location> {
    let source = view.document.files().get(span.file as usize)?;
    // a form that was never saved has no file, so the location is in the open text
    let uri = view.uri(span.file, &server.texts)?;
    Some(lsp::Location { uri, range: range(source, span) })
}

/// All locations of the name at a position.
pub fn references(server: &Server, at: &lsp::TextDocumentPositionParams) -> Vec<lsp::Location> {
    let Some(view) = server.view(&at.text_document.uri) else { return Vec::new() };
    let place = offset(view.source(), at.position);
    let spans = view.document.references(view.file, place);
    spans.into_iter().filter_map(|span| location(server, &view, span)).collect()
}

/// All locations of the name within the open text.
pub fn highlights(server: &Server, at: &lsp::TextDocumentPositionParams) -> Vec<lsp::DocumentHighlight> {
    let Some(view) = server.view(&at.text_document.uri) else { return Vec::new() };
    let place = offset(view.source(), at.position);
    let spans = view.document.references(view.file, place).into_iter().filter(|span| span.file == view.file);
    spans.map(|span| lsp::DocumentHighlight { range: range(view.source(), span), kind: None }).collect()
}

/// The definition of the name at a position: a called file, the sequence Cancel, the prompt of a variable, the format of a
/// letter. The definition of a program block is its form line. For a form line without a definition, the result is the
/// blocks that the line printed.
pub fn definition(server: &Server, at: &lsp::TextDocumentPositionParams) -> Vec<lsp::Location> {
    let uri = &at.text_document.uri;
    let Some(text) = server.texts.get(uri) else { return Vec::new() };
    match text.kind {
        Kind::Form => {
            let Some(view) = server.view(uri) else { return Vec::new() };
            let place = offset(&text.source, at.position);
            if let Some(file) = called(&view, place).and_then(|file| Some((view.uri(file, &server.texts)?, file))) {
                return vec![lsp::Location { uri: file.0, range: lsp::Range::default() }];
            }
            let said = view.document.definition(view.file, place).and_then(|span| location(server, &view, span));
            said.map_or_else(|| programs::blocks(server, uri, place), |place| vec![place])
        }
        Kind::Program => {
            programs::origin(server, text, at.position.line).and_then(|origin| origin.form).into_iter().collect()
        }
        _ => Vec::new(),
    }
}

/// The blocks that a form line printed, or the job item of a block.
pub fn implementation(server: &Server, at: &lsp::TextDocumentPositionParams) -> Vec<lsp::Location> {
    let uri = &at.text_document.uri;
    let Some(text) = server.texts.get(uri) else { return Vec::new() };
    match text.kind {
        Kind::Form => programs::blocks(server, uri, offset(&text.source, at.position)),
        Kind::Program => {
            programs::origin(server, text, at.position.line).and_then(|origin| origin.item).into_iter().collect()
        }
        _ => Vec::new(),
    }
}

/// The file that the line at a location calls.
fn called(view: &View, place: u32) -> Option<u32> {
    let is_here = |line: &Span| line.file == view.file && line.start <= place && place <= line.end;
    view.document.checked().calls.iter().find(|(line, _)| is_here(line)).map(|(_, file)| *file)
}

/// The name at a position, if it can be renamed.
pub fn renameable(
    server: &Server,
    at: &lsp::TextDocumentPositionParams,
) -> Result<Option<lsp::PrepareRenameResult>, String> {
    let Some(view) = server.view(&at.text_document.uri) else { return Ok(None) };
    let span = view.document.renameable(view.file, offset(view.source(), at.position))?;
    let placeholder = view.document.slice(span).to_owned();
    let range = range(view.source(), span);
    Ok(Some(lsp::PrepareRenameResult::PrepareRenamePlaceholder(lsp::PrepareRenamePlaceholder { range, placeholder })))
}

/// The edits for a renaming.
pub fn rename(
    server: &Server,
    at: &lsp::TextDocumentPositionParams,
    name: &str,
) -> Result<Option<lsp::WorkspaceEdit>, String> {
    let Some(view) = server.view(&at.text_document.uri) else { return Ok(None) };
    let edits = view.document.rename(view.file, offset(view.source(), at.position), name)?;
    Ok(Some(edit(edits.into_iter().filter_map(|(span, new_text)| {
        let place = location(server, &view, span)?;
        Some((place.uri, lsp::TextEdit { range: place.range, new_text }))
    }))))
}
