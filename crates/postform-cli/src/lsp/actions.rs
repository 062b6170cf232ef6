//! Actions for findings: fixes, with the effect of unsafe fixes on the program; comments that allow findings; sorting
//! of formats.

use std::collections::HashMap;

use gen_lsp_types as lsp;
use postform::Span;
use postform::internals::ide::{Action, ActionKind};
use postform::internals::lint::fix;

use super::convert::{diagnostic, range, span};
use super::server::Server;
use super::view::View;

/// All safe fixes at once: editors apply them when a form is saved.
const FIX_ALL: &str = "source.fixAll.postform";
/// Puts the letter formats in order.
const ORGANISE: &str = "source.organizeFormats";

/// Maximum number of programs that are printed for one answer: one program without a fix, and one program for each of
/// the first fixes.
const MOST_PROGRAMS: usize = 17;
/// Maximum number of actions in one answer, for example if the whole form is selected.
const MOST_ACTIONS: usize = 300;

/// The kinds of actions.
pub fn kinds() -> Vec<lsp::CodeActionKind> {
    vec![lsp::CodeActionKind::QuickFix, FIX_ALL.to_owned().into(), ORGANISE.to_owned().into()]
}

/// The actions for a range.
pub fn actions(server: &Server, params: &lsp::CodeActionParams) -> Vec<lsp::CodeActionResponse> {
    let Some(view) = server.view(&params.text_document.uri) else { return Vec::new() };
    let only = params.context.only.as_deref();
    let asked = |kind: &str| {
        let begins = |asked: &lsp::CodeActionKind| {
            let asked = asked.to_string();
            kind == asked || kind.strip_prefix(&asked).is_some_and(|rest| rest.starts_with('.'))
        };
        only.is_none_or(|kinds| kinds.iter().any(begins))
    };
    let within = span(view.source(), view.file, params.range);
    let mut found = Vec::new();
    if asked("quickfix") {
        let mut left = MOST_PROGRAMS;
        let all = view.document.actions(within, &mut |changed| {
            left = left.checked_sub(1)?;
            view.program(changed)
        });
        found.extend(all.into_iter().take(MOST_ACTIONS).filter_map(|action| quick(server, &view, action)));
    }
    // actions for the whole form belong to no line, so editors request these actions by kind
    if only.is_some() && asked(FIX_ALL) {
        found.extend(fix_all(server, &view));
    }
    if asked(ORGANISE)
        && (only.is_some() || view.document.has_format(within))
        && let Some(action) = view.document.organised_formats(view.file)
    {
        let edit = edit_of(server, &view, &action.edits);
        found.push(lsp::CodeAction {
            title: action.title,
            kind: Some(ORGANISE.to_owned().into()),
            edit: Some(edit),
            ..lsp::CodeAction::default()
        });
    }
    found.into_iter().map(lsp::CodeActionResponse::CodeAction).collect()
}

fn quick(server: &Server, view: &View, action: Action) -> Option<lsp::CodeAction> {
    let finding = view.document.findings().get(action.finding?)?;
    let place = finding.labels.first().filter(|label| label.span.file == view.file)?;
    let about = diagnostic(finding, range(view.source(), place.span), "postform");
    let mut edit = edit_of(server, view, &action.edits);
    if let (ActionKind::Unsafe, true) = (action.kind, server.client.annotations) {
        let text = match &action.preview {
            Some(preview) if preview.blocks == 0 => "The program of the current job stays the same.".to_owned(),
            Some(preview) => format!("In the program of the current job:\n{}", preview.text),
            None => "The effect on the program is unknown.".to_owned(),
        };
        edit = confirmed(edit, &action.title, text);
    }
    Some(lsp::CodeAction {
        title: action.title,
        kind: Some(lsp::CodeActionKind::QuickFix),
        diagnostics: Some(vec![about]),
        is_preferred: Some(action.kind == ActionKind::Safe),
        edit: Some(edit),
        ..lsp::CodeAction::default()
    })
}

/// An edit that the editor shows for confirmation.
fn confirmed(edit: lsp::WorkspaceEdit, label: &str, description: String) -> lsp::WorkspaceEdit {
    const ID: &str = "program";
    let changes = edit.changes.unwrap_or_default().into_iter().map(|(uri, edits)| {
        let annotated = |text_edit| lsp::AnnotatedTextEdit { annotation_id: ID.to_owned(), text_edit };
        lsp::DocumentChange::TextDocumentEdit(lsp::TextDocumentEdit {
            text_document: lsp::OptionalVersionedTextDocumentIdentifier {
                version: None,
                text_document_identifier: lsp::TextDocumentIdentifier { uri },
            },
            edits: edits.into_iter().map(|edit| lsp::Edit::AnnotatedTextEdit(annotated(edit))).collect(),
        })
    });
    let annotation = lsp::ChangeAnnotation {
        label: label.to_owned(),
        needs_confirmation: Some(true),
        description: Some(description),
    };
    lsp::WorkspaceEdit {
        changes: None,
        document_changes: Some(changes.collect()),
        change_annotations: Some(HashMap::from([(ID.to_owned(), annotation)])),
    }
}

/// Edits of spans; an emptied line is removed with its line end, as in `lint --fix`.
fn edit_of(server: &Server, view: &View, edits: &[(Span, String)]) -> lsp::WorkspaceEdit {
    super::convert::edit(edits.iter().filter_map(|(place, text)| {
        let source = view.document.files().get(place.file as usize)?;
        let mut place = *place;
        let before = &source.text[..place.start as usize];
        if text.is_empty() && place.start < place.end && (before.is_empty() || before.ends_with('\n')) {
            let rest = &source.text[place.end as usize..];
            let end = if rest.starts_with("\r\n") { 2 } else { u32::from(rest.starts_with('\n')) };
            place.end += end;
        }
        let edit = lsp::TextEdit { range: range(source, place), new_text: text.clone() };
        Some((view.uri(place.file, &server.texts)?, edit))
    }))
}

/// All safe fixes, as in `lint --fix`.
fn fix_all(server: &Server, view: &View) -> Option<lsp::CodeAction> {
    let fixed = fix(&view.config.levels, false, &mut |changed| view.analyse(changed));
    let files = view.document.files();
    let edits = files.iter().enumerate().filter_map(|(file, source)| {
        let text = fixed.changed.get(&source.name)?;
        Some((Span::new(file as u32, 0, source.text.len()), text.clone()))
    });
    let edits: Vec<(Span, String)> = edits.collect();
    (!edits.is_empty()).then(|| lsp::CodeAction {
        title: "Fix all findings whose fixes do not change a program".to_owned(),
        kind: Some(FIX_ALL.to_owned().into()),
        edit: Some(edit_of(server, view, &edits)),
        ..lsp::CodeAction::default()
    })
}
