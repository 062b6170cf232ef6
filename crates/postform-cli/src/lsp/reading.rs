//! Help during reading and typing: hover, completion, signatures of commands.

use gen_lsp_types as lsp;
use postform::internals::ide::{Completion, CompletionKind, about, program};
use serde_json::json;

use super::convert::{markdown, offset, range};
use super::server::Server;
use super::texts::{Kind, Text};

/// The help for the word under the pointer.
pub fn hover(server: &Server, at: &lsp::TextDocumentPositionParams) -> Option<lsp::Hover> {
    let text = server.texts.get(&at.text_document.uri)?;
    let place = offset(&text.source, at.position);
    let hover = match text.kind {
        Kind::Form => {
            let view = server.view(&text.uri)?;
            view.document.hover(view.file, place, view.current())?
        }
        Kind::Program => program::hover(&text.source, place, server.control_of(text).ok()?.0)?,
        _ => return None,
    };
    let range = range(&text.source, hover.span);
    Some(lsp::Hover { contents: lsp::Contents::MarkupContent(markdown(hover.text)), range: Some(range) })
}

/// The possible words at a location.
pub fn completion(server: &Server, at: &lsp::TextDocumentPositionParams) -> Vec<lsp::CompletionItem> {
    let Some(text) = server.texts.get(&at.text_document.uri) else { return Vec::new() };
    let place = offset(&text.source, at.position);
    let list = match text.kind {
        Kind::Form => {
            let Some(view) = server.view(&text.uri) else { return Vec::new() };
            // a form with an incomplete word prints nothing, so the values come from the last program of the form
            let last = server.last_view(&text.uri);
            view.document.complete(view.file, place, view.current().or(last.as_ref().and_then(|view| view.current())))
        }
        Kind::Program => match server.control_of(text) {
            Ok((control, _)) => program::complete(&text.source, place, control),
            Err(_) => Vec::new(),
        },
        _ => Vec::new(),
    };
    let width = list.len().to_string().len();
    list.into_iter().enumerate().map(|(i, item)| shown(item, i, width, text, server)).collect()
}

/// The completion that the user has selected, with its documentation.
pub fn resolved(server: &Server, mut item: lsp::CompletionItem) -> lsp::CompletionItem {
    let known = || {
        let data = item.data.as_ref()?;
        let kind = CompletionKind::ALL.get(data.get(0)?.as_u64()? as usize)?;
        let text = server.texts.get(&lsp::Uri::from(data.get(1)?.as_str()?))?;
        let control = match text.kind {
            Kind::Form => server.view(&text.uri)?.document.control(),
            _ => server.control_of(text).ok()?.0,
        };
        about(*kind, &item.label, control)
    };
    item.documentation = known().map(|text| markdown(text).into());
    item
}

fn shown(item: Completion, index: usize, width: usize, text: &Text, server: &Server) -> lsp::CompletionItem {
    let (source, uri) = (&text.source, &text.uri);
    let snippet = item.snippet.filter(|_| server.client.snippets);
    let format = if snippet.is_some() { lsp::InsertTextFormat::Snippet } else { lsp::InsertTextFormat::PlainText };
    let edit = lsp::TextEdit { range: range(source, item.replaces), new_text: snippet.unwrap_or(item.text) };
    lsp::CompletionItem {
        kind: Some(match item.kind {
            CompletionKind::Command => lsp::CompletionItemKind::Property,
            CompletionKind::Value => lsp::CompletionItemKind::EnumMember,
            CompletionKind::Sequence => lsp::CompletionItemKind::Function,
            CompletionKind::Keyword => lsp::CompletionItemKind::Keyword,
            CompletionKind::Variable => lsp::CompletionItemKind::Variable,
            CompletionKind::Code => lsp::CompletionItemKind::Constant,
            CompletionKind::Finding => lsp::CompletionItemKind::Event,
        }),
        detail: Some(item.detail).filter(|detail| !detail.is_empty()),
        // the documentation is computed only when the user selects the item
        data: CompletionKind::ALL.iter().position(|kind| *kind == item.kind).map(|kind| json!([kind, uri])),
        // in the order of the tables, which is the order of the manuals
        sort_text: Some(format!("{index:0width$}")),
        filter_text: Some(item.label.clone()),
        label: item.label,
        insert_text_format: Some(format),
        text_edit: Some(lsp::CompletionItemTextEdit::TextEdit(edit)),
        ..lsp::CompletionItem::default()
    }
}

/// The current argument of a command.
pub fn signature(server: &Server, at: &lsp::TextDocumentPositionParams) -> Option<lsp::SignatureHelp> {
    let view = server.view(&at.text_document.uri)?;
    let signature = view.document.signature(view.file, offset(view.source(), at.position))?;
    let units = |byte: usize| signature.label[..byte].encode_utf16().count() as u32;
    let words = signature.words.iter().map(|&(from, to)| lsp::ParameterInformation {
        label: lsp::ParameterInformationLabel::Tuple((units(from), units(to))),
        documentation: None,
    });
    let words = words.collect();
    let information = lsp::SignatureInformation {
        label: signature.label.clone(),
        documentation: Some(lsp::Documentation::String(signature.meaning)),
        parameters: Some(words),
        active_parameter: None,
    };
    let active_parameter = Some(lsp::ActiveParameter::Int(signature.active as u32));
    Some(lsp::SignatureHelp { signatures: vec![information], active_signature: Some(0), active_parameter })
}
