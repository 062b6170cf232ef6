//! Assigns messages to functions.

use gen_lsp_types as lsp;
use lsp_server::ErrorCode;
use serde::de::DeserializeOwned;
use serde_json::Value;

use postform::Format;

use super::server::{Client, Server, Settings};
use super::{actions, convert, margin, places, programs, reading, structure, uri};

/// The reason why a request fails.
#[derive(Debug)]
pub struct Failure {
    /// The protocol's error code.
    pub code: ErrorCode,
    /// The text for people.
    pub message: String,
}

impl Failure {
    /// A failure with this message.
    pub fn new(code: ErrorCode, message: impl Into<String>) -> Failure {
        Failure { code, message: message.into() }
    }
}

/// The parameters of a message.
///
/// # Errors
/// The parameters do not fit the message.
pub fn parse<P: DeserializeOwned>(method: &str, params: Value) -> Result<P, Failure> {
    serde_json::from_value(params)
        .map_err(|error| Failure::new(ErrorCode::InvalidParams, format!("`{method}` can't be read: {error}")))
}

/// A result as JSON.
fn done(result: impl serde::Serialize) -> Result<Value, Failure> {
    serde_json::to_value(result).map_err(|error| Failure::new(ErrorCode::InternalError, error.to_string()))
}

/// `initialize`: exchanges the capabilities of editor and server.
pub fn initialize(server: &mut Server, params: Value) -> Result<Value, Failure> {
    let has = |path: &str| params.pointer(path).and_then(Value::as_bool) == Some(true);
    server.client = Client {
        snippets: has("/capabilities/textDocument/completion/completionItem/snippetSupport"),
        annotations: !params["capabilities"]["workspace"]["workspaceEdit"]["changeAnnotationSupport"].is_null()
            && has("/capabilities/workspace/workspaceEdit/documentChanges"),
        shows: has("/capabilities/window/showDocument/support"),
        virtual_programs: has("/initializationOptions/virtualPrograms"),
        watches: has("/capabilities/workspace/didChangeWatchedFiles/dynamicRegistration"),
        refreshes_hints: has("/capabilities/workspace/inlayHint/refreshSupport"),
        refreshes_lenses: has("/capabilities/workspace/codeLens/refreshSupport"),
    };
    server.settings = settings(&params["initializationOptions"]).unwrap_or_default();
    let folders = params["workspaceFolders"].as_array().into_iter().flatten().map(|folder| &folder["uri"]);
    let named = folders.chain([&params["rootUri"]]).filter_map(|name| uri::path(&lsp::Uri::from(name.as_str()?)));
    server.folders = named.collect();
    server.folders.dedup();
    done(lsp::InitializeResult {
        capabilities: capabilities(),
        server_info: Some(lsp::ServerInfo { name: "postform".into(), version: Some(env!("CARGO_PKG_VERSION").into()) }),
    })
}

/// The settings of postform in the editor's data: at the top, or under `postform`.
fn settings(said: &Value) -> Option<Settings> {
    let own = said.get("postform").unwrap_or(said);
    serde_json::from_value(own.clone()).ok()
}

fn capabilities() -> lsp::ServerCapabilities {
    let strings = |all: &[&str]| Some(all.iter().map(|one| (*one).to_owned()).collect::<Vec<_>>());
    lsp::ServerCapabilities {
        position_encoding: Some(lsp::PositionEncodingKind::UTF16),
        text_document_sync: Some(lsp::TextDocumentSync::Options(lsp::TextDocumentSyncOptions {
            open_close: Some(true),
            change: Some(lsp::TextDocumentSyncKind::Full),
            save: Some(lsp::Save::Bool(true)),
            ..lsp::TextDocumentSyncOptions::default()
        })),
        completion_provider: Some(lsp::CompletionOptions {
            trigger_characters: strings(&["[", "<", "G", "M", " "]),
            resolve_provider: Some(true),
            ..lsp::CompletionOptions::default()
        }),
        hover_provider: Some(true.into()),
        signature_help_provider: Some(lsp::SignatureHelpOptions {
            trigger_characters: strings(&[" "]),
            ..lsp::SignatureHelpOptions::default()
        }),
        definition_provider: Some(true.into()),
        implementation_provider: Some(true.into()),
        references_provider: Some(true.into()),
        document_highlight_provider: Some(true.into()),
        document_symbol_provider: Some(true.into()),
        workspace_symbol_provider: Some(true.into()),
        code_action_provider: Some(lsp::CodeActionProvider::CodeActionOptions(lsp::CodeActionOptions {
            code_action_kinds: Some(actions::kinds()),
            ..lsp::CodeActionOptions::default()
        })),
        code_lens_provider: Some(lsp::CodeLensOptions::default()),
        document_formatting_provider: Some(true.into()),
        document_range_formatting_provider: Some(true.into()),
        rename_provider: Some(lsp::RenameProvider::RenameOptions(lsp::RenameOptions {
            prepare_provider: Some(true),
            ..lsp::RenameOptions::default()
        })),
        folding_range_provider: Some(true.into()),
        execute_command_provider: Some(lsp::ExecuteCommandOptions {
            commands: vec![margin::OPEN_PROGRAM.to_owned()],
            ..lsp::ExecuteCommandOptions::default()
        }),
        semantic_tokens_provider: Some(lsp::SemanticTokensProvider::SemanticTokensOptions(
            lsp::SemanticTokensOptions {
                legend: lsp::SemanticTokensLegend {
                    token_types: structure::TOKEN_TYPES.map(str::to_owned).to_vec(),
                    token_modifiers: structure::TOKEN_MODIFIERS.map(str::to_owned).to_vec(),
                },
                full: Some(true.into()),
                range: Some(true.into()),
                ..lsp::SemanticTokensOptions::default()
            },
        )),
        inlay_hint_provider: Some(true.into()),
        ..lsp::ServerCapabilities::default()
    }
}

/// The files to watch for changes on the disk: forms, jobs, and the TOML files of settings, controls and machines.
pub fn watched() -> Value {
    let jobs: Vec<&str> = Format::ALL.iter().flat_map(|format| format.extensions()).copied().collect();
    let globs = ["**/*.pf".to_owned(), "**/*.toml".to_owned(), format!("**/*.{{{}}}", jobs.join(","))];
    let watchers = globs.map(|glob| serde_json::json!({ "globPattern": glob }));
    let options = serde_json::json!({ "watchers": watchers });
    let method = "workspace/didChangeWatchedFiles";
    serde_json::json!({ "registrations": [{ "id": "files", "method": method, "registerOptions": options }] })
}

/// A location in a text: part of the parameters of most requests.
fn place(method: &str, params: Value) -> Result<lsp::TextDocumentPositionParams, Failure> {
    parse(method, params)
}

/// The text in the parameters.
fn text(method: &str, params: &Value) -> Result<lsp::Uri, Failure> {
    let document: lsp::TextDocumentIdentifier = parse(method, params["textDocument"].clone())?;
    Ok(document.uri)
}

/// A request of a running session.
pub fn request(server: &Server, method: &str, params: Value) -> Result<Value, Failure> {
    let refused = |message: String| Failure::new(ErrorCode::RequestFailed, message);
    match method {
        "textDocument/hover" => done(reading::hover(server, &place(method, params)?)),
        "textDocument/completion" => done(reading::completion(server, &place(method, params)?)),
        "completionItem/resolve" => done(reading::resolved(server, parse(method, params)?)),
        "textDocument/signatureHelp" => done(reading::signature(server, &place(method, params)?)),
        "textDocument/definition" => done(places::definition(server, &place(method, params)?)),
        "textDocument/implementation" => done(places::implementation(server, &place(method, params)?)),
        "textDocument/references" => done(places::references(server, &place(method, params)?)),
        "textDocument/documentHighlight" => done(places::highlights(server, &place(method, params)?)),
        "textDocument/prepareRename" => done(places::renameable(server, &place(method, params)?).map_err(refused)?),
        "textDocument/rename" => {
            let params: lsp::RenameParams = parse(method, params)?;
            let at = &params.text_document_position_params;
            done(places::rename(server, at, &params.new_name).map_err(refused)?)
        }
        "textDocument/documentSymbol" => {
            done(server.view(&text(method, &params)?).map(|view| structure::outline(&view)).unwrap_or_default())
        }
        "workspace/symbol" => {
            let params: lsp::WorkspaceSymbolParams = parse(method, params)?;
            done(structure::everywhere(server, &params.query))
        }
        "textDocument/foldingRange" => {
            done(server.view(&text(method, &params)?).map(|view| structure::folding(&view)).unwrap_or_default())
        }
        "textDocument/semanticTokens/full" => {
            done(server.view(&text(method, &params)?).map(|view| structure::tokens(&view, None)))
        }
        "textDocument/semanticTokens/range" => {
            let params: lsp::SemanticTokensRangeParams = parse(method, params)?;
            let view = server.view(&params.text_document.uri);
            done(view.map(|view| {
                let within = convert::span(view.source(), view.file, params.range);
                structure::tokens(&view, Some(within))
            }))
        }
        "textDocument/formatting" => done(structure::format(server, &text(method, &params)?)),
        "textDocument/rangeFormatting" => {
            let params: lsp::DocumentRangeFormattingParams = parse(method, params)?;
            done(structure::format_range(server, &params.text_document.uri, params.range))
        }
        "textDocument/codeAction" => done(actions::actions(server, &parse(method, params)?)),
        "textDocument/codeLens" => done(margin::lenses(server, &text(method, &params)?)),
        "textDocument/inlayHint" => {
            let params: lsp::InlayHintParams = parse(method, params)?;
            let view = server.view(&params.text_document.uri);
            done(view.map(|view| margin::hints(server, &view, params.range)).unwrap_or_default())
        }
        "postform/jobs" => done(programs::jobs(server, &text(method, &params)?)),
        "postform/program" => done(programs::program(server, &parse(method, params)?)),
        _ => Err(Failure::new(ErrorCode::MethodNotFound, format!("`{method}` is not supported"))),
    }
}

/// A notification in a running session. An invalid notification has no effect and gets no answer.
pub fn notice(server: &mut Server, method: &str, params: Value) {
    match method {
        "textDocument/didOpen" => {
            let Ok(params) = parse::<lsp::DidOpenTextDocumentParams>(method, params) else { return };
            let item = params.text_document;
            server.texts.open(item.uri, &item.language_id.to_string(), item.version, item.text);
            server.forget();
        }
        "textDocument/didChange" => {
            // the last of several whole texts is used
            let Ok(id) = parse::<lsp::VersionedTextDocumentIdentifier>(method, params["textDocument"].clone()) else {
                return;
            };
            let changes = params["contentChanges"].as_array();
            let Some(text) = changes.and_then(|all| all.last()?["text"].as_str()) else { return };
            let uri = id.text_document_identifier.uri;
            if server.texts.change(&uri, id.version, text.to_owned()) {
                server.changed(&uri);
            }
        }
        "textDocument/didSave" | "workspace/didChangeWatchedFiles" => server.forget(),
        "workspace/didChangeConfiguration" => {
            if let Some(said) = settings(&params["settings"]) {
                server.settings.take(said);
                server.forget();
            }
        }
        "workspace/didChangeWorkspaceFolders" => {
            let named = |list: &Value| -> Vec<_> {
                let names = list.as_array().into_iter().flatten().filter_map(|folder| folder["uri"].as_str());
                names.filter_map(|name| uri::path(&lsp::Uri::from(name))).collect()
            };
            let gone = named(&params["event"]["removed"]);
            server.folders.retain(|folder| !gone.contains(folder));
            server.folders.extend(named(&params["event"]["added"]));
            server.forget();
        }
        _ => {}
    }
}

/// The text that was closed.
pub fn closed(server: &mut Server, params: Value) -> Option<lsp::Uri> {
    let params: lsp::DidCloseTextDocumentParams = parse("textDocument/didClose", params).ok()?;
    let uri = params.text_document.uri;
    server.texts.close(&uri);
    server.stale.remove(uri.as_ref());
    server.forget();
    Some(uri)
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn settings_are_read_by_themselves_and_under_postform() {
        let by = |said: Value| settings(&said).and_then(|settings| settings.control);
        assert_eq!(by(json!({ "control": "haas" })).as_deref(), Some("haas"));
        assert_eq!(by(json!({ "postform": { "control": "grbl" } })).as_deref(), Some("grbl"));
        assert_eq!(by(json!({ "other": {} })), None);
        assert!(settings(&Value::Null).is_none());
    }
}
