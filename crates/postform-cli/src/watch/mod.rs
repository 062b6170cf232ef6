//! `postform watch`: serves the page, to this machine only.

mod ask;
mod growing;
mod guard;
mod http;
mod jobs;
mod kept;
mod session;

use std::io::{self, Write};
use std::net::{Ipv4Addr, Shutdown, TcpListener, TcpStream};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use postform::internals::scene::WATCH_PAGE;
use serde::de::DeserializeOwned;
use serde_json::Value;

use super::Ending;
use super::args::WatchArgs;
use super::output::standard_output;
use super::poll::Watched;
use super::say::message;
use super::say::no_thread;
use ask::{Ask, Save};
use guard::Guard;
use http::{Answer, Asked, LARGEST_BODY, LARGEST_JOB};
use kept::Kept;
use session::{NotSaved, Session};

/// Maximum number of connections at the same time; a page needs two or three.
const MOST_CONNECTIONS: usize = 64;
/// After this time without a message, a page gets a sign that the program still runs.
const SILENCE: Duration = Duration::from_secs(15);

/// Longest time until the connection of a closed page is freed.
const ATTENTION: Duration = Duration::from_millis(250);

/// Data shared by all connections.
struct Shared {
    guard: Guard,
    session: Session,
    /// Number of changes of the files.
    changes: Mutex<u64>,
    changed: Condvar,
    connections: AtomicUsize,
}

/// Serves the page until the user ends the program.
pub fn run(args: WatchArgs) -> Result<Ending, String> {
    let (port, opens) = (args.port, !args.no_open);
    let kept = Kept::of(&args.form);
    let session = Session::open(args)?;
    let before = kept.as_ref().and_then(Kept::read);
    // with the old port, a page that is still open connects again
    let of_before = before.as_ref().filter(|_| port == 0);
    let of_before = of_before.and_then(|(port, _)| TcpListener::bind((Ipv4Addr::LOCALHOST, *port)).ok());
    let listener = of_before.map_or_else(|| TcpListener::bind((Ipv4Addr::LOCALHOST, port)), Ok).map_err(|error| {
        let help = "leave --port out: then a free port is used";
        format!("error: can't listen on port {port} of this machine: {error}\n  help: {help}")
    })?;
    let port = listener.local_addr().map_err(|error| format!("error: can't get the address: {error}"))?.port();
    let guard = match before {
        Some((_, token)) => Guard::with(token, port),
        None => Guard::new(port)?,
    };
    if let Some(kept) = kept {
        kept.write(port, &guard.token);
    }
    let address = format!("http://127.0.0.1:{port}/{}/", guard.token);
    standard_output(|out| writeln!(out, "{address}"))?;
    let shared = Arc::new(Shared {
        guard,
        session,
        changes: Mutex::new(0),
        changed: Condvar::new(),
        connections: AtomicUsize::new(0),
    });
    let watching = Arc::clone(&shared);
    let watches = thread::Builder::new().spawn(move || {
        loop {
            let paths = watching.session.paths();
            if Watched::new(paths.clone()).wait_while(|| watching.session.watches(&paths)) {
                watching.session.forget();
                watching.tell();
            }
        }
    });
    watches.map_err(|error| no_thread(&error))?;
    if opens && let Err(error) = open::that_detached(&address) {
        message(&format!("no browser can be opened ({error}): open {address} yourself"));
    }
    for stream in listener.incoming() {
        let Ok(stream) = stream else { continue }; // the client has already gone
        let shared = Arc::clone(&shared);
        // a client without a thread is dropped
        _ = thread::Builder::new().spawn(move || shared.serve(stream));
    }
    Ok(Ending::Clean)
}

impl Shared {
    /// Notifies all pages that files were changed.
    fn tell(&self) {
        *self.changes.lock().unwrap_or_else(PoisonError::into_inner) += 1;
        self.changed.notify_all();
    }

    fn serve(&self, mut stream: TcpStream) {
        if self.connections.fetch_add(1, Ordering::Relaxed) < MOST_CONNECTIONS {
            if let Err(Some(answer)) = self.answer(&mut stream) {
                http::write(&mut stream, &answer);
            }
        } else {
            http::write(&mut stream, &Answer::no(503, "too many connections"));
        }
        // the rest of a refused request is read, so that the answer arrives
        _ = stream.shutdown(Shutdown::Write);
        _ = stream.set_read_timeout(Some(Duration::from_millis(200)));
        _ = io::copy(&mut io::Read::take(&stream, 1 << 20), &mut io::sink());
        self.connections.fetch_sub(1, Ordering::Relaxed);
    }

    /// Reads a request and answers it; the answer to a refused request is the error.
    fn answer(&self, stream: &mut TcpStream) -> Result<(), Option<Answer>> {
        let (asked, read) = http::read_head(stream)?;
        let what = self.guard.admit(&asked)?.to_owned();
        let allowed = match what.as_str() {
            "" | "events" => "GET",
            "scene" | "verdict" | "help" | "save" | "add" | "close" => "POST",
            _ => return Err(Some(Answer::no(404, "not found"))),
        };
        if asked.method != allowed {
            let mut answer = Answer::no(405, "this method is not allowed");
            answer.fields.push(("Allow", allowed.to_owned()));
            return Err(Some(answer));
        }
        if what == "events" {
            self.events(stream);
            return Ok(());
        }
        let answer = match what.as_str() {
            "" => page(),
            "save" => self.save(&body(stream, &asked, read)?),
            "verdict" => said(self.session.verdict(&body(stream, &asked, read)?)),
            "add" => self.add(http::read_body(stream, &asked, read, LARGEST_JOB)?),
            "close" => {
                self.session.close(&body(stream, &asked, read)?);
                self.tell();
                Answer::of("text/plain; charset=utf-8", "")
            }
            "help" => said(self.session.help(&body(stream, &asked, read)?)),
            _ => {
                let ask = body(stream, &asked, read)?;
                return self.show(stream, &ask);
            }
        };
        http::write(stream, &answer);
        Ok(())
    }

    /// Sends scenes as they are made; the end of the connection marks the end of the last scene.
    fn show(&self, stream: &mut TcpStream, ask: &Ask) -> Result<(), Option<Answer>> {
        let mut sent = None;
        let shown = self.session.show(ask, &mut |scene| {
            let begun = match sent.take() {
                None => http::begin(stream, "application/octet-stream"),
                Some(before) => before,
            };
            // a client that has gone gets no answer
            sent = Some(begun.and_then(|()| stream.write_all(&scene.into_bytes())));
        });
        let status = if self.session.has_form() { 422 } else { 410 };
        shown.map_err(|why| sent.is_none().then(|| Answer::no(status, &why)))
    }

    fn save(&self, save: &Save) -> Answer {
        match self.session.save(save) {
            Ok(()) => Answer::of("text/plain; charset=utf-8", ""),
            Err(NotSaved::Unknown) => Answer::no(404, "this is not a file of this form"),
            Err(NotSaved::Conflict(why)) => Answer::no(409, &why),
        }
    }

    /// Opens a job: the body is its name as JSON, a line end, and its content.
    fn add(&self, mut body: Vec<u8>) -> Answer {
        let end = body.iter().position(|&byte| byte == b'\n').unwrap_or(0);
        let Ok(name) = serde_json::from_slice::<String>(&body[..end]) else {
            return Answer::no(400, "this request has no name of a job");
        };
        body.drain(..=end);
        match self.session.add(&name, body) {
            Ok((tab, replaced)) => {
                self.tell();
                let added = serde_json::json!({ "tab": tab, "replaced": replaced });
                Answer::of("application/json", added.to_string())
            }
            Err(why) => Answer::no(422, &why),
        }
    }

    /// Notifies a page of changes until the connection ends.
    fn events(&self, stream: &mut TcpStream) {
        let mut seen = *self.changes.lock().unwrap_or_else(PoisonError::into_inner);
        let begun = http::begin(stream, "text/event-stream");
        let mut sent = begun.and_then(|()| stream.write_all(b": here\n\n"));
        let mut silent = Instant::now();
        while sent.is_ok() {
            let changes = self.changes.lock().unwrap_or_else(PoisonError::into_inner);
            let waited = self.changed.wait_timeout_while(changes, ATTENTION, |changes| *changes == seen);
            let now = *waited.unwrap_or_else(PoisonError::into_inner).0;
            if now == seen && silent.elapsed() < SILENCE {
                if is_closed(stream) {
                    return;
                }
                continue;
            }
            let text =
                if now == seen { ": still here\n\n".to_owned() } else { format!("event: changed\ndata: {now}\n\n") };
            (seen, silent) = (now, Instant::now());
            sent = stream.write_all(text.as_bytes());
        }
    }
}

/// Whether the client has closed the connection.
fn is_closed(stream: &TcpStream) -> bool {
    let closed = stream.set_nonblocking(true).is_err() || matches!(stream.peek(&mut [0]), Ok(0));
    stream.set_nonblocking(false).is_err() || closed
}

/// The JSON body of a request.
fn body<T: DeserializeOwned>(stream: &mut TcpStream, asked: &Asked, read: Vec<u8>) -> Result<T, Option<Answer>> {
    let bytes = http::read_body(stream, asked, read, LARGEST_BODY)?;
    serde_json::from_slice(&bytes)
        .map_err(|error| Some(Answer::no(400, &format!("this request can't be read: {error}"))))
}

fn said(value: Result<Value, String>) -> Answer {
    match value {
        Ok(value) => Answer::of("application/json", value.to_string()),
        Err(why) => Answer::no(422, &why),
    }
}

fn page() -> Answer {
    let mut answer = Answer::of("text/html; charset=utf-8", WATCH_PAGE);
    // this adds to the policy in the page itself: no other page may show the page in a frame
    answer.fields.push(("Content-Security-Policy", "frame-ancestors 'none'".to_owned()));
    answer
}
