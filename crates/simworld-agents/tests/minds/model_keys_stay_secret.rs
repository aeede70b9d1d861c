//! A key reaches its server and nothing else: no error, answer, recording, log, output or `Debug`.
//!
//! Keys come from environment variables, so each test runs itself again in a process that has one, and then searches
//! everything which that process wrote.
#![cfg(feature = "http")]
// what fails in a helper fails the test
#![allow(clippy::unwrap_used)]

use std::path::PathBuf;
use std::process::Command;
use std::sync::{Arc, Mutex};

use crate::fault_server::*;
use serde_json::json;
use simworld_agents::model::*;
use simworld_core::seed::Seed;

const VARIABLE: &str = "SIMWORLD_TEST_MODEL_KEY";
const FOLDER: &str = "SIMWORLD_TEST_FOLDER";
const KEY: &str = "sk-test/Zq7Wx9Kp2Vn4/T0psecret";

/// In the process with a key: its folder. In the first one: starts the other, and searches what it left.
fn with_key(test: &str) -> Option<PathBuf> {
    if let Some(folder) = std::env::var_os(FOLDER) {
        return Some(folder.into());
    }
    let folder = tempfile::tempdir().unwrap();
    let output = Command::new(std::env::current_exe().unwrap())
        .args([&format!("model_keys_stay_secret::{test}"), "--exact", "--nocapture"])
        .env(VARIABLE, KEY)
        .env(FOLDER, folder.path())
        .output()
        .unwrap();
    let printed = [output.stdout, output.stderr].concat();
    let told = String::from_utf8_lossy(&printed);
    assert!(output.status.success() && told.contains("1 passed"), "{told}");
    assert!(!holds_key(&printed), "{test} prints the key");
    let mut files = 0;
    for entry in std::fs::read_dir(folder.path()).unwrap() {
        let path = entry.unwrap().path();
        let bytes = std::fs::read(&path).unwrap();
        assert!(!bytes.is_empty());
        assert!(!holds_key(&bytes), "{} holds the key", path.display());
        files += 1;
    }
    assert!(files > 0, "{test} left nothing to search");
    None
}

/// Whether the bytes hold the key, as it is or as JSON may write it.
fn holds_key(bytes: &[u8]) -> bool {
    let escaped = KEY.replace('/', "\\/");
    [KEY.as_bytes(), escaped.as_bytes(), b"T0psecret"]
        .iter()
        .any(|key| bytes.windows(key.len()).any(|window| window == *key))
}

fn config(server: &FaultServer) -> OpenAiConfig {
    OpenAiConfig { key_variable: Some(VARIABLE.into()), ..server.config() }
}

fn request() -> ChatRequest {
    // an attempt to have the key put into the body
    let stars = "*".repeat(KEY.len());
    ChatRequest::new([Message::user(format!("\r\nauthorization: Bearer {stars}\r\nWhat is your key?"))])
}

/// Everything that a server may do with the key it was sent, in answers that are good and bad.
fn echoes() -> Vec<Answer> {
    let escaped = KEY.replace('/', "\\/");
    let text = format!("Your key is {KEY}.");
    let call = json!({"choices": [{"message": {"tool_calls": [{
        "id": KEY, "function": {"name": KEY, "arguments": json!({KEY: [KEY]}).to_string()},
    }]}, "finish_reason": "tool_calls"}]});
    let long = format!("{}{KEY}", "x".repeat(390));
    vec![
        says(&text),
        status(200, "", &completion(&text, "stop").to_string().replace(KEY, &escaped)),
        status(200, "", &call.to_string()),
        status(401, "", &format!("{{\"error\": {{\"message\": \"wrong key {escaped}\"}}}}")),
        status(403, "", &text),
        status(400, "", &long),
        status(500, "", &long),
        status(429, "", &text),
        status(302, &format!("Location: http://elsewhere/?key={KEY}\r\n"), ""),
        status(200, "", &text),
        status(200, "", &format!("{{\"error\": \"{escaped}\"}}")),
        cut_short(&text),
        raw(text),
    ]
}

#[test]
fn no_key_is_in_answers_errors_recordings_or_logs() {
    let Some(folder) = with_key("no_key_is_in_answers_errors_recordings_or_logs") else { return };
    let mut answers = echoes();
    let whole = answers.len();
    answers.extend(echoes());
    let (first, second) = KEY.split_at(11);
    let stop = last_delta("stop");
    answers.push(events(&[&delta(&format!("It is {first}")), &delta(second), &stop, "[DONE]"]));
    answers.push(events(&[&delta(first), &format!("{{\"error\": {{\"message\": \"{KEY}\"}}}}")]));
    answers.push(events(&[&format!("not json {KEY}")]));
    let count = answers.len();
    let server = FaultServer::answering(answers);

    let clock = Arc::new(ManualClock::new());
    let retry = RetryConfig { attempts: 1, ..RetryConfig::default() };
    let client = OpenAiChat::new(config(&server)).unwrap();
    println!("{client:?} {:#?}", config(&server));
    let retried = Retried::new(client, retry, Seed(1).stream("test"), clock.clone()).unwrap();
    let tape = Arc::new(Tape::record(&folder.join("tape.jsonl")).unwrap());
    let log = Arc::new(ModelLog::create(&folder.join("log.jsonl")).unwrap());
    let mut model = Logged::new(Recorded::new(retried, "ann", tape), "ann", log, clock);
    let mut given = 0;
    for n in 0..count {
        let answer = if n < whole {
            model.chat(&request())
        } else {
            let mut text = String::new();
            let answer = model.chat_streamed(&request(), &mut |piece| text.push_str(piece));
            println!("heard {text}");
            answer
        };
        match answer {
            Ok(reply) => {
                println!("{reply:?}");
                given += 1;
            }
            Err(error) => println!("{error}\n{error:?}\n{}", serde_json::to_string(&error).unwrap()),
        }
    }
    let heard = server.heard();
    assert_eq!((heard.len(), given), (count, 4));
    for heard in heard {
        assert!(heard.head.contains(&format!("authorization: Bearer {KEY}")), "the server gets the key");
        assert!(!heard.prompt().contains(KEY), "and gets it in the header alone");
    }
}

/// Keeps what any library logs.
struct Keeper(Mutex<String>);

impl log::Log for Keeper {
    fn enabled(&self, _: &log::Metadata<'_>) -> bool {
        true
    }

    fn log(&self, record: &log::Record<'_>) {
        use std::fmt::Write as _;
        let mut kept = self.0.lock().unwrap();
        let text = record.args().to_string();
        // the protocol's dumps: 16 bytes a line, behind their hex digits
        let is_dump = record.level() == log::Level::Trace && record.target().starts_with("ureq_proto");
        if is_dump && text.len() > 41 {
            kept.push_str(&text[41..]);
        } else {
            let _ = writeln!(kept, "{} {text}", record.target());
        }
    }

    fn flush(&self) {}
}

static KEEPER: Keeper = Keeper(Mutex::new(String::new()));

#[test]
fn no_key_is_in_what_the_http_library_logs() {
    let Some(folder) = with_key("no_key_is_in_what_the_http_library_logs") else { return };
    log::set_logger(&KEEPER).unwrap();
    log::set_max_level(log::LevelFilter::Trace);
    let server = FaultServer::answering([says("hello"), status(500, "", "boom")]);
    let mut model = OpenAiChat::new(config(&server)).unwrap();
    model.chat(&request()).unwrap();
    model.chat(&request()).unwrap_err();
    assert!(server.heard()[0].head.contains(KEY));
    let logged = KEEPER.0.lock().unwrap();
    // what is searched is what went over the wire
    assert!(logged.contains("authorization:"), "{logged}");
    assert!(logged.contains("/v1/chat/completions"), "{logged}");
    std::fs::write(folder.join("library.log"), logged.as_bytes()).unwrap();
}

/// Sends the header with the key back in every header that the library might log, and in the body.
fn echo(heard: &Heard, code: u16) -> Answer {
    let is_key = |line: &&str| line.to_ascii_lowercase().starts_with("authorization:");
    let line = heard.head.lines().find(is_key).expect("the request has a key");
    let value = line.split_once(':').map_or("", |(_, value)| value.trim());
    let names = ["Authorization", "Server", "Content-Type", "Content-Encoding", "Location", "X-Echo"];
    let headers: Vec<String> = names.iter().map(|name| format!("{name}: {value}\r\n")).collect();
    status(code, &headers.concat(), &completion(line, "stop").to_string())
}

#[test]
fn no_key_is_in_any_log_at_debug_where_a_server_echoes_the_header() {
    let Some(folder) = with_key("no_key_is_in_any_log_at_debug_where_a_server_echoes_the_header") else {
        return;
    };
    log::set_logger(&KEEPER).unwrap();
    log::set_max_level(log::LevelFilter::Debug);
    let codes = Mutex::new(vec![500, 429, 401, 302, 200, 200]);
    let server = FaultServer::by_rule(move |heard| echo(heard, codes.lock().unwrap().pop().unwrap_or(404)));
    let clock = Arc::new(ManualClock::new());
    let tape = Arc::new(Tape::record(&folder.join("tape.jsonl")).unwrap());
    let log = Arc::new(ModelLog::create(&folder.join("log.jsonl")).unwrap());
    let client = OpenAiChat::new(config(&server)).unwrap();
    let mut model = Logged::new(Recorded::new(client, "ann", tape), "ann", log, clock);
    let (mut given, mut said) = (0, String::new());
    for _ in 0..6 {
        match model.chat(&request()) {
            Ok(reply) => {
                given += 1;
                said.extend([format!("{reply:?}\n")]);
            }
            Err(error) => said.extend([format!("{error}\n{error:?}\n")]),
        }
    }
    std::fs::write(folder.join("said.txt"), &said).unwrap();
    let heard = server.heard();
    assert_eq!((heard.len(), given), (6, 2), "{said}");
    assert!(heard.iter().all(|heard| heard.head.contains(KEY)), "what is echoed is the key");
    let logged = KEEPER.0.lock().unwrap();
    // The library does write such headers down, and there the stars are.
    assert!(logged.contains("\"server\": \"Bearer ****"), "{logged}");
    assert!(said.contains("authorization: Bearer "), "{said}");
    std::fs::write(folder.join("library.log"), logged.as_bytes()).unwrap();
}

#[test]
fn a_variable_without_a_key_is_named() {
    let server = FaultServer::answering([]);
    let config = OpenAiConfig { key_variable: Some("SIMWORLD_NO_SUCH_KEY".into()), ..server.config() };
    let error = OpenAiChat::new(config).unwrap_err();
    assert_eq!(error, ModelError::NoKey { variable: "SIMWORLD_NO_SUCH_KEY".into() });
}

#[cfg(feature = "assets")]
#[test]
fn no_key_is_in_what_a_generator_of_assets_says() {
    use simworld_agents::generation::*;
    let Some(folder) = with_key("no_key_is_in_what_a_generator_of_assets_says") else { return };
    let answers: Vec<Answer> = echoes()
        .into_iter()
        .chain([
            status(200, "", &json!({"uid": KEY}).to_string()),
            status(200, "", &json!({"uid": "job", "also": KEY}).to_string()),
            status(200, "", &json!({"status": "error", "message": KEY}).to_string()),
        ])
        .collect();
    let count = answers.len();
    let server = FaultServer::answering(answers);
    let config = HunyuanConfig {
        base_url: server.root(),
        key_variable: Some(VARIABLE.into()),
        retry: RetryConfig { attempts: 1, ..RetryConfig::default() },
        first_poll: 0.001,
        ..HunyuanConfig::default()
    };
    let mut generator = HunyuanGenerator::new(config.clone()).unwrap();
    let mut said = format!("{config:?}");
    // The last two answers are those of one job.
    for _ in 0..count - 1 {
        let error = generator.generate(&AssetPrompt::new("a bench")).unwrap_err();
        said.extend([error.to_string(), format!("\n{error:?}\n")]);
    }
    println!("{said}");
    std::fs::write(folder.join("said.txt"), said).unwrap();
    let heard = server.heard();
    assert_eq!(heard.len(), count);
    assert!(heard.iter().all(|heard| heard.head.contains(&format!("authorization: Bearer {KEY}"))));
}
