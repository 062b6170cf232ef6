//! An editor for tests of `postform lsp`: it exchanges messages over the server's standard input and output.

use std::io::{BufRead, BufReader, Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, Command, ExitStatus, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::thread;
use std::time::Duration;

use serde_json::{Value, json};

/// Longer than any answer takes, even on a busy machine.
const PATIENCE: Duration = Duration::from_secs(120);

/// A session with the server.
pub struct Editor {
    child: Child,
    input: Option<ChildStdin>,
    messages: Receiver<Value>,
    /// Messages that came while the editor waited for another one.
    pub others: Vec<Value>,
    next: i32,
    folder: PathBuf,
}

/// The capabilities of a current editor.
pub fn able() -> Value {
    json!({
        "textDocument": { "completion": { "completionItem": { "snippetSupport": true } } },
        "workspace": { "didChangeWatchedFiles": { "dynamicRegistration": true }, "workspaceEdit": { "documentChanges": true, "changeAnnotationSupport": {} } },
        "window": { "showDocument": { "support": true } },
    })
}

impl Editor {
    /// Starts the server in a folder, before `initialize`.
    pub fn start(folder: &Path) -> Editor {
        let mut command = Command::new(env!("CARGO_BIN_EXE_postform"));
        command.arg("lsp").current_dir(folder);
        let mut child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        let output = child.stdout.take().unwrap();
        let (send, messages) = channel();
        thread::spawn(move || {
            let mut output = BufReader::new(output);
            while let Some(message) = message(&mut output) {
                if send.send(message).is_err() {
                    break;
                }
            }
        });
        let input = child.stdin.take();
        Editor { child, input, messages, others: Vec::new(), next: 0, folder: folder.to_path_buf() }
    }

    /// Starts the server in a folder for an editor with these capabilities, and initializes it.
    pub fn open(folder: &Path, capabilities: &Value, options: &Value) -> Editor {
        let mut editor = Editor::start(folder);
        let root = uri(folder);
        let params = json!({
            "processId": null, "rootUri": root, "capabilities": capabilities, "initializationOptions": options,
            "workspaceFolders": [{ "uri": root, "name": "posts" }],
        });
        editor.ask("initialize", &params);
        editor.tell("initialized", &json!({}));
        editor
    }

    /// Sends bytes unchanged.
    pub fn send(&mut self, bytes: &[u8]) {
        self.input.as_mut().unwrap().write_all(bytes).unwrap();
    }

    fn post(&mut self, message: &Value) {
        let text = message.to_string();
        self.send(format!("Content-Length: {}\r\n\r\n{text}", text.len()).as_bytes());
    }

    /// Sends a notification.
    pub fn tell(&mut self, method: &str, params: &Value) {
        self.post(&json!({ "jsonrpc": "2.0", "method": method, "params": params }));
    }

    /// Receives the next message.
    pub fn next(&mut self) -> Value {
        self.messages.recv_timeout(PATIENCE).expect("an answer of the server")
    }

    /// Sends a request. Returns the whole message with the answer.
    pub fn answer(&mut self, method: &str, params: &Value) -> Value {
        self.next += 1;
        let id = self.next;
        self.post(&json!({ "jsonrpc": "2.0", "id": id, "method": method, "params": params }));
        loop {
            let message = self.next();
            if message["id"] == id && message["method"].is_null() {
                return message;
            }
            self.others.push(message);
        }
    }

    /// Sends a request. Returns its result.
    pub fn ask(&mut self, method: &str, params: &Value) -> Value {
        let mut message = self.answer(method, params);
        assert!(message["error"].is_null(), "{method}: {message}");
        message["result"].take()
    }

    /// The URI of a file in the folder.
    pub fn uri(&self, name: &str) -> String {
        uri(&self.folder.join(name))
    }

    /// Opens a file of the folder with this text. Returns its findings.
    pub fn show(&mut self, name: &str, language: &str, text: &str) -> Vec<Value> {
        let uri = self.uri(name);
        let item = json!({ "uri": uri, "languageId": language, "version": 1, "text": text });
        self.tell("textDocument/didOpen", &json!({ "textDocument": item }));
        self.findings(&uri)
    }

    /// Changes an open text. Returns its findings.
    pub fn change(&mut self, name: &str, text: &str) -> Vec<Value> {
        let uri = self.uri(name);
        let params = json!({ "textDocument": { "uri": uri, "version": 2 }, "contentChanges": [{ "text": text }] });
        self.tell("textDocument/didChange", &params);
        self.findings(&uri)
    }

    /// Waits for the next findings of a text.
    pub fn findings(&mut self, uri: &str) -> Vec<Value> {
        loop {
            let message = self.next();
            if message["method"] == "textDocument/publishDiagnostics" && message["params"]["uri"] == uri {
                return message["params"]["diagnostics"].as_array().unwrap().clone();
            }
            self.others.push(message);
        }
    }

    /// Closes the server's input.
    pub fn hang_up(&mut self) {
        self.input = None;
    }

    /// Waits for the end. Returns the exit status, and the text on standard error.
    pub fn end(mut self) -> (ExitStatus, String) {
        self.input = None;
        let mut said = String::new();
        self.child.stderr.take().unwrap().read_to_string(&mut said).unwrap();
        (self.child.wait().unwrap(), said)
    }

    /// Sends `shutdown` and `exit`, as every editor does. The server must end without an error.
    pub fn quit(mut self) {
        self.ask("shutdown", &Value::Null);
        self.tell("exit", &Value::Null);
        let (status, said) = self.end();
        assert!(status.success() && said.is_empty(), "{status}: {said}");
    }
}

/// The URI of a file.
pub fn uri(path: &Path) -> String {
    format!("file://{}", path.display())
}

fn message(input: &mut impl BufRead) -> Option<Value> {
    let mut length = 0;
    loop {
        let mut line = String::new();
        if input.read_line(&mut line).ok()? == 0 {
            return None;
        }
        match line.trim().split_once(": ") {
            Some((_, number)) => length = number.parse().ok()?,
            None => break,
        }
    }
    let mut body = vec![0; length];
    input.read_exact(&mut body).ok()?;
    serde_json::from_slice(&body).ok()
}

/// The protocol's position of a byte in a text that is only ASCII.
pub fn place(text: &str, at: usize) -> Value {
    let before = &text[..at];
    let line = before.matches('\n').count();
    json!({ "line": line, "character": at - before.rfind('\n').map_or(0, |end| end + 1) })
}
