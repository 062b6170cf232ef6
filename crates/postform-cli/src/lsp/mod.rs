//! `postform lsp`: a language server for forms and programs, over standard input and output.
//!
//! One thread reads messages, and another thread answers the messages in order. Findings of changed texts are sent when
//! no message waits, so that fast typing does not delay the answers.

mod actions;
mod convert;
mod diagnostics;
mod dispatch;
mod frames;
mod margin;
mod places;
mod programs;
mod reading;
mod server;
mod structure;
mod texts;
mod uri;
mod view;

use std::io::{self, BufReader, IsTerminal};
use std::sync::mpsc::{Receiver, TryRecvError, sync_channel};
use std::thread;

use gen_lsp_types as lsp;
use lsp_server::{ErrorCode, Message, Request};
use serde_json::{Value, json};

use super::Ending;
use super::args::LspArgs;
use super::say::message;
use super::say::no_thread;
use dispatch::Failure;
use frames::Frame;
use server::{Client, Server};

/// Number of messages that wait in memory; further messages wait in the pipe.
const WAITING: usize = 256;

/// The next step after a message is handled.
enum Next {
    /// Continue with the next message.
    Go,
    /// The editor sent `exit`.
    Exit,
}

/// Serves one editor until it sends `exit` or ends the connection.
///
/// # Errors
/// A message: there is no editor at the other end, or the input does not follow the language server protocol.
pub fn run(_: &LspArgs) -> Result<Ending, String> {
    if io::stdin().is_terminal() {
        return Err(
            "error: `postform lsp` is started by an editor, which uses standard input\n  help: see docs/editors.md"
                .into(),
        );
    }
    let (send, frames) = sync_channel(WAITING);
    // the reading thread ends when the input ends, or with the process
    let reader = thread::Builder::new().spawn(move || {
        let mut input = BufReader::new(io::stdin());
        loop {
            let frame = frames::read(&mut input);
            let last = matches!(frame, Ok(Frame::Closed) | Err(_));
            if send.send(frame).is_err() || last {
                break;
            }
        }
    });
    reader.map_err(|error| no_thread(&error))?;
    let mut session = Session { server: Server::default(), state: State::New, next_id: 1 };
    match session.serve(&frames) {
        Ok(ending) => Ok(ending),
        // the editor has closed the pipe
        Err(Stop::Out(error)) if error.kind() == io::ErrorKind::BrokenPipe => Ok(Ending::Findings),
        Err(Stop::Out(error)) => Err(format!("error: can't write standard output: {error}")),
        Err(Stop::In(why)) => Err(format!("error: {why}")),
    }
}

/// The state of the session.
#[derive(Clone, Copy, PartialEq, Eq)]
enum State {
    /// Before `initialize`.
    New,
    /// Between `initialize` and `shutdown`.
    Running,
    /// After `shutdown`.
    Over,
}

/// The reason for an early end of the session.
enum Stop {
    Out(io::Error),
    In(String),
}

impl From<io::Error> for Stop {
    fn from(error: io::Error) -> Stop {
        Stop::Out(error)
    }
}

struct Session {
    server: Server,
    state: State,
    next_id: i32,
}

impl Session {
    fn serve(&mut self, frames: &Receiver<Result<Frame, String>>) -> Result<Ending, Stop> {
        loop {
            let frame = match frames.try_recv() {
                Ok(frame) => frame,
                Err(TryRecvError::Empty) => {
                    self.publish()?;
                    match frames.recv() {
                        Ok(frame) => frame,
                        Err(_) => return Ok(self.ending()),
                    }
                }
                Err(TryRecvError::Disconnected) => return Ok(self.ending()),
            };
            match frame.map_err(Stop::In)? {
                Frame::Closed => {
                    if self.state != State::Over {
                        message("error: the editor closed the connection without `shutdown` and `exit`");
                    }
                    return Ok(self.ending());
                }
                Frame::Malformed(why) => {
                    let error = json!({ "code": ErrorCode::ParseError as i32, "message": why });
                    self.write(&json!({ "jsonrpc": "2.0", "id": null, "error": error }))?;
                }
                Frame::Message(Message::Request(request)) => self.request(request)?,
                Frame::Message(Message::Notification(note)) => {
                    if let Next::Exit = self.notice(&note.method, note.params)? {
                        return Ok(self.ending());
                    }
                }
                // answers of the editor to the server's requests
                Frame::Message(Message::Response(_)) => {}
            }
        }
    }

    /// By the protocol, `exit` without `shutdown` is an error.
    fn ending(&self) -> Ending {
        if self.state == State::Over { Ending::Clean } else { Ending::Findings }
    }

    fn write(&self, body: &Value) -> io::Result<()> {
        frames::write(&mut io::stdout().lock(), body)
    }

    fn request(&mut self, request: Request) -> Result<(), Stop> {
        let Request { id, method, params } = request;
        let answer = match (self.state, method.as_str()) {
            (State::New, "initialize") => {
                self.state = State::Running;
                dispatch::initialize(&mut self.server, params)
            }
            (State::New, _) => {
                Err(Failure::new(ErrorCode::ServerNotInitialized, "the first request must be `initialize`"))
            }
            (State::Over, _) => Err(Failure::new(ErrorCode::InvalidRequest, "only `exit` may follow `shutdown`")),
            (State::Running, "shutdown") => {
                self.state = State::Over;
                Ok(Value::Null)
            }
            (State::Running, "initialize") => {
                Err(Failure::new(ErrorCode::InvalidRequest, "`initialize` may be sent only once"))
            }
            (State::Running, "workspace/executeCommand") => self.command(params),
            (State::Running, _) => dispatch::request(&self.server, &method, params),
        };
        let body = match answer {
            Ok(result) => json!({ "jsonrpc": "2.0", "id": id, "result": result }),
            Err(Failure { code, message }) => {
                json!({ "jsonrpc": "2.0", "id": id, "error": { "code": code as i32, "message": message } })
            }
        };
        Ok(self.write(&body)?)
    }

    fn notice(&mut self, method: &str, params: Value) -> Result<Next, Stop> {
        match (self.state, method) {
            (_, "exit") => return Ok(Next::Exit),
            (State::Running, "textDocument/didClose") => {
                if let Some(uri) = dispatch::closed(&mut self.server, params) {
                    self.send_findings(&uri, None, Vec::new())?;
                }
            }
            (State::Running, "initialized") if self.server.client.watches => {
                self.ask("client/registerCapability", dispatch::watched())?;
            }
            (State::Running, _) => dispatch::notice(&mut self.server, method, params),
            _ => {}
        }
        Ok(Next::Go)
    }

    /// Sends the findings of all changed texts.
    fn publish(&mut self) -> io::Result<()> {
        if self.server.stale.is_empty() {
            return Ok(());
        }
        for name in std::mem::take(&mut self.server.stale) {
            let Some(text) = self.server.texts.get(&lsp::Uri(name)) else { continue };
            let found = diagnostics::of(text, &self.server);
            self.send_findings(&text.uri, Some(text.version), found)?;
        }
        if std::mem::take(&mut self.server.beside) {
            let Client { refreshes_hints, refreshes_lenses, .. } = self.server.client;
            if refreshes_hints {
                self.ask("workspace/inlayHint/refresh", Value::Null)?;
            }
            if refreshes_lenses {
                self.ask("workspace/codeLens/refresh", Value::Null)?;
            }
        }
        Ok(())
    }

    fn send_findings(&self, uri: &lsp::Uri, version: Option<i32>, found: Vec<lsp::Diagnostic>) -> io::Result<()> {
        let params = lsp::PublishDiagnosticsParams { uri: uri.clone(), version, diagnostics: found };
        self.write(&json!({ "jsonrpc": "2.0", "method": "textDocument/publishDiagnostics", "params": params }))
    }

    /// Sends a request to the editor; its answer is ignored.
    fn ask(&mut self, method: &str, params: Value) -> io::Result<()> {
        let id = format!("postform-{}", self.next_id);
        self.next_id += 1;
        self.write(&json!({ "jsonrpc": "2.0", "id": id, "method": method, "params": params }))
    }

    /// `postform.openProgram`: requests the editor to show the program of a form.
    fn command(&mut self, params: Value) -> Result<Value, Failure> {
        let params: lsp::ExecuteCommandParams = dispatch::parse("workspace/executeCommand", params)?;
        if params.command != margin::OPEN_PROGRAM {
            let message = format!("there is no command `{}`: the command is {}", params.command, margin::OPEN_PROGRAM);
            return Err(Failure::new(ErrorCode::InvalidParams, message));
        }
        let mut arguments = params.arguments.unwrap_or_default().into_iter();
        let uri = arguments.next().and_then(|uri| uri.as_str().map(lsp::Uri::from));
        let job = arguments.next().and_then(|job| job.as_u64()).unwrap_or(0) as usize;
        let uri =
            uri.ok_or_else(|| Failure::new(ErrorCode::InvalidParams, "the first argument must be the name of a form"))?;
        let opened = programs::opened(&self.server, &uri, job);
        let opened = opened.ok_or_else(|| Failure::new(ErrorCode::RequestFailed, "the form prints no program"))?;
        if self.server.client.shows {
            let show = json!({ "uri": opened, "takeFocus": true });
            self.ask("window/showDocument", show)
                .map_err(|error| Failure::new(ErrorCode::InternalError, error.to_string()))?;
        }
        Ok(json!(opened))
    }
}
