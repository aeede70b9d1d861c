//! A server on this machine that answers as it is told, wrongly too.
// each test file uses its part, and what fails here fails the test
#![allow(dead_code, unreachable_pub, clippy::unwrap_used)]

use std::io::{Read, Write};
use std::net::{SocketAddr, TcpListener, TcpStream};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;
use std::time::Duration;

use serde_json::{Value, json};
use simworld_agents::model::OpenAiConfig;

/// A request as it came over the wire.
#[derive(Clone, Debug)]
pub struct Heard {
    pub head: String,
    pub body: Value,
}

impl Heard {
    /// The text of the last message.
    pub fn prompt(&self) -> String {
        let messages = self.body["messages"].as_array().unwrap();
        messages.last().unwrap()["content"].as_str().unwrap_or_default().to_owned()
    }
}

/// What to do with a connection whose request was read; it is closed afterwards.
pub type Answer = Box<dyn FnOnce(&mut TcpStream) + Send>;

/// The server; it ends when it is dropped.
pub struct FaultServer {
    address: SocketAddr,
    heard: Arc<Mutex<Vec<Heard>>>,
    over: Arc<AtomicBool>,
    accepting: Option<JoinHandle<()>>,
}

impl FaultServer {
    /// Answers each request as the rule says.
    pub fn by_rule(rule: impl Fn(&Heard) -> Answer + Send + Sync + 'static) -> Self {
        let listener = TcpListener::bind("127.0.0.1:0").unwrap();
        let address = listener.local_addr().unwrap();
        let heard = Arc::new(Mutex::new(Vec::new()));
        let over = Arc::new(AtomicBool::new(false));
        let (all, stop, rule) = (heard.clone(), over.clone(), Arc::new(rule));
        let accepting = std::thread::spawn(move || {
            for stream in listener.incoming() {
                if stop.load(Ordering::Relaxed) {
                    return;
                }
                let Ok(mut stream) = stream else { continue };
                let (all, rule) = (all.clone(), rule.clone());
                std::thread::spawn(move || {
                    if let Some(request) = read_request(&mut stream) {
                        all.lock().unwrap().push(request.clone());
                        rule(&request)(&mut stream);
                    }
                });
            }
        });
        Self { address, heard, over, accepting: Some(accepting) }
    }

    /// Gives these answers in order; connections after the last are closed.
    pub fn answering(answers: impl IntoIterator<Item = Answer>) -> Self {
        let answers = Mutex::new(answers.into_iter().collect::<std::collections::VecDeque<_>>());
        Self::by_rule(move |_| answers.lock().unwrap().pop_front().unwrap_or_else(|| Box::new(|_| {})))
    }

    /// What came, in the order in which it was read.
    pub fn heard(&self) -> Vec<Heard> {
        self.heard.lock().unwrap().clone()
    }

    pub fn url(&self) -> String {
        format!("http://{}/v1", self.address)
    }

    /// The address without a path.
    pub fn root(&self) -> String {
        format!("http://{}", self.address)
    }

    /// A configuration for this server that waits half a second.
    pub fn config(&self) -> OpenAiConfig {
        OpenAiConfig {
            base_url: self.url(),
            model: "m".into(),
            timeout: 0.5,
            max_reply: 64 * 1024,
            ..OpenAiConfig::default()
        }
    }
}

impl Drop for FaultServer {
    fn drop(&mut self) {
        self.over.store(true, Ordering::Relaxed);
        let _ = TcpStream::connect(self.address); // wakes the loop
        if let Some(accepting) = self.accepting.take() {
            let _ = accepting.join();
        }
    }
}

/// Closes with the request half read, which the client sees as a reset connection.
pub struct ResetServer {
    pub url: String,
}

impl ResetServer {
    pub fn new() -> Self {
        let listener = TcpListener::bind("127.0.0.1:0").unwrap();
        let url = format!("http://{}/v1", listener.local_addr().unwrap());
        std::thread::spawn(move || {
            for mut stream in listener.incoming().flatten() {
                let _ = stream.read(&mut [0; 8]);
            }
        });
        Self { url }
    }
}

fn read_request(stream: &mut TcpStream) -> Option<Heard> {
    let mut bytes = Vec::new();
    let mut buffer = [0; 4096];
    loop {
        if let Some(end) = bytes.windows(4).position(|window| window == b"\r\n\r\n") {
            let head = String::from_utf8_lossy(&bytes[..end]).into_owned();
            let length = head
                .lines()
                .filter_map(|line| line.split_once(':'))
                .find(|(name, _)| name.eq_ignore_ascii_case("content-length"))
                .map_or("0", |(_, length)| length);
            let body = end + 4..end + 4 + length.trim().parse::<usize>().ok()?;
            if bytes.len() >= body.end {
                let body = &bytes[body];
                // What is asked for with GET has no body.
                let body = if body.is_empty() { Value::Null } else { serde_json::from_slice(body).ok()? };
                return Some(Heard { head, body });
            }
        }
        match stream.read(&mut buffer) {
            Ok(0) | Err(_) => return None,
            Ok(count) => bytes.extend_from_slice(&buffer[..count]),
        }
    }
}

/// These bytes, as they are.
pub fn raw(bytes: impl Into<Vec<u8>>) -> Answer {
    let bytes = bytes.into();
    Box::new(move |stream| {
        let _ = stream.write_all(&bytes);
    })
}

/// A status with headers (each ending in CRLF) and a body of the right length.
pub fn status(status: u16, headers: &str, body: &str) -> Answer {
    let length = body.len();
    raw(format!(
        "HTTP/1.1 {status} Status\r\n{headers}Content-Length: {length}\r\nConnection: close\r\n\r\n{body}"
    ))
}

/// A good answer with this text.
pub fn says(text: &str) -> Answer {
    status(200, "", &completion(text, "stop").to_string())
}

pub fn completion(text: &str, finish: &str) -> Value {
    json!({
        "id": "c", "object": "chat.completion", "model": "m",
        "choices": [{"index": 0, "message": {"role": "assistant", "content": text}, "finish_reason": finish}],
        "usage": {"prompt_tokens": 11, "completion_tokens": 3, "total_tokens": 14},
    })
}

/// An answer whose body is shorter than it says.
pub fn cut_short(body: &str) -> Answer {
    raw(format!("HTTP/1.1 200 OK\r\nContent-Length: {}\r\n\r\n{body}", body.len() + 100))
}

/// Says nothing for longer than anybody waits.
pub fn silence() -> Answer {
    Box::new(|_| std::thread::sleep(Duration::from_secs(3)))
}

/// An answer whose bytes come one at a time, more slowly than anybody waits.
pub fn drips(body: &str) -> Answer {
    let body = body.to_owned();
    Box::new(move |stream| {
        let _ = write!(stream, "HTTP/1.1 200 OK\r\nContent-Length: {}\r\n\r\n", body.len());
        for byte in body.as_bytes() {
            if stream.write_all(&[*byte]).is_err() {
                return;
            }
            std::thread::sleep(Duration::from_millis(50));
        }
    })
}

/// An answer that never ends.
pub fn endless() -> Answer {
    Box::new(|stream| {
        let _ = stream.write_all(b"HTTP/1.1 200 OK\r\nConnection: close\r\n\r\n");
        while stream.write_all(&[b' '; 4096]).is_ok() {}
    })
}

/// A stream of these events; then it closes.
pub fn events(events: &[&str]) -> Answer {
    let head = "HTTP/1.1 200 OK\r\nContent-Type: text/event-stream\r\nConnection: close\r\n\r\n".to_owned();
    let events = events.iter().map(|event| format!("data: {event}\n\n"));
    raw(std::iter::once(head).chain(events).collect::<String>())
}

/// An event that adds this text.
pub fn delta(text: &str) -> String {
    json!({"choices": [{"index": 0, "delta": {"content": text}, "finish_reason": null}]}).to_string()
}

/// The event that ends a reply.
pub fn last_delta(reason: &str) -> String {
    json!({"choices": [{"index": 0, "delta": {}, "finish_reason": reason}]}).to_string()
}
