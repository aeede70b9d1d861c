//! Whatever a server does, a request ends in an answer or a typed error, and nothing is lost.
#![cfg(feature = "http")]
// what fails in a helper fails the test
#![allow(clippy::unwrap_used)]

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use crate::fault_server::*;
use proptest::prelude::*;
use serde::Deserialize;
use simworld_agents::model::*;
use simworld_core::seed::Seed;

fn request(prompt: &str) -> ChatRequest {
    ChatRequest::new([Message::user(prompt)])
}

fn client(server: &FaultServer) -> OpenAiChat {
    OpenAiChat::new(server.config()).unwrap()
}

/// What one answer makes of a whole reply and of a stream.
fn both(answer: impl Fn() -> Answer) -> [Result<ChatReply, ModelError>; 2] {
    let server = FaultServer::answering([answer(), answer()]);
    let mut model = client(&server);
    let whole = model.chat(&request("?"));
    let streamed = model.chat_streamed(&request("?"), &mut |_| {});
    assert_eq!(server.heard().len(), 2, "each request is sent once");
    [whole, streamed]
}

macro_rules! gives {
    ($answer:expr, $error:pat $(if $guard:expr)?) => {
        for (how, answer) in ["whole", "streamed"].into_iter().zip(both(|| $answer)) {
            assert!(matches!(&answer, Err($error) $(if $guard)?), "{} {how}: {answer:?}", stringify!($answer));
        }
    };
}

#[test]
fn statuses_are_typed_errors() {
    gives!(status(429, "Retry-After: 7\r\n", ""), ModelError::RateLimited { retry_after: Some(wait) } if wait.as_secs() == 7);
    gives!(status(429, "", "slow down"), ModelError::RateLimited { retry_after: None });
    gives!(status(500, "", "{\"error\": {\"message\": \"boom\"}}"), ModelError::Server { status: 500, body, .. } if body == "boom");
    gives!(
        status(503, "Retry-After: 2\r\n", ""),
        ModelError::Server { status: 503, retry_after: Some(_), .. }
    );
    gives!(status(401, "", "no"), ModelError::Key { status: 401, variable: None, .. });
    gives!(status(403, "", ""), ModelError::Key { status: 403, .. });
    gives!(status(400, "", "unknown schema"), ModelError::Refused { status: 400, body } if body == "unknown schema");
    gives!(status(404, "", ""), ModelError::Refused { status: 404, .. });
}

#[test]
fn broken_answers_are_typed_errors() {
    let half = &completion("yes", "stop").to_string()[..40];
    gives!(silence(), ModelError::Timeout { .. });
    gives!(drips(&" ".repeat(1000)), ModelError::Timeout { .. });
    gives!(raw(""), ModelError::Transport { .. });
    gives!(raw("HTTP/1.1 200"), ModelError::Transport { .. });
    gives!(raw("SSH-2.0-OpenSSH\r\n\r\n"), ModelError::BadReply { .. });
    gives!(cut_short(half), ModelError::Transport { .. });
    gives!(endless(), ModelError::TooLarge { limit: 65_536 });
    let answer = client(&FaultServer::answering([status(200, "", half)])).chat(&request("?"));
    assert!(matches!(answer, Err(ModelError::BadReply { .. })), "{answer:?}");
}

#[test]
fn connections_that_are_reset_or_refused_are_typed_errors() {
    let reset = ResetServer::new();
    let closed = std::net::TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap();
    for base_url in [reset.url, format!("http://{closed}/v1"), "http://no-such-host.invalid/v1".into()] {
        let mut model = OpenAiChat::new(OpenAiConfig { base_url, ..OpenAiConfig::default() }).unwrap();
        let answer = model.chat(&request(&"long ".repeat(100_000)));
        assert!(matches!(answer, Err(ModelError::Transport { .. })), "{answer:?}");
    }
}

#[test]
fn redirects_are_not_followed() {
    let other = FaultServer::answering([says("I am another")]);
    let location = format!("Location: {}/chat/completions\r\n", other.url());
    for code in [301, 302, 303, 307, 308] {
        gives!(status(code, &location, ""), ModelError::Redirected { status: found, .. } if *found == code);
    }
    assert!(other.heard().is_empty());
}

#[test]
fn streams_that_break_are_typed_errors_and_whole_ones_are_replies() {
    let (start, end) = (delta("Hel"), delta("lo"));
    let stop = last_delta("stop");
    for (sent, heard, whole) in [
        (vec![start.as_str(), &end, &stop, "[DONE]"], "Hello", true),
        (vec![&start, &end, &stop], "Hello", true),
        (vec![&start, &end], "Hello", false),
        (vec![&start], "Hel", false),
        (vec![&start, "{\"choices\":"], "Hel", false),
        (vec![&start, "{\"error\": {\"message\": \"out of memory\"}}"], "Hel", false),
        (vec!["[DONE]"], "", true),
        (vec![], "", false),
    ] {
        let server = FaultServer::answering([events(&sent)]);
        let mut text = String::new();
        let answer = client(&server).chat_streamed(&request("?"), &mut |piece| text.push_str(piece));
        assert_eq!((text.as_str(), answer.is_ok()), (heard, whole), "{sent:?}: {answer:?}");
        if let Ok(reply) = answer {
            assert_eq!(reply.text, heard);
        }
    }
}

#[test]
fn answers_of_another_shape_are_typed_errors() {
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Step {
        #[serde(rename = "to")]
        _to: u32,
    }
    let texts =
        ["{\"to\": 3}", "{\"to\": \"there\"}", "{\"to\": 3, \"then\": 4}", "go there", "", "{\"to\": 9E490}"];
    let server = FaultServer::answering(texts.map(says));
    let mut model = client(&server);
    let read = texts.map(|_| model.chat(&request("?")).unwrap().json::<Step>());
    assert!(read[0].is_ok());
    for answer in &read[1..] {
        assert!(matches!(answer, Err(ModelError::BadReply { .. })));
    }
    let long = FaultServer::answering([status(200, "", &completion("{\"to\": 3", "length").to_string())]);
    let cut = client(&long).chat(&request("?")).unwrap();
    assert!(matches!(cut.json::<Step>(), Err(ModelError::Truncated { got: 8 })));
}

#[test]
fn a_connection_that_the_server_closed_meanwhile_costs_no_answer() {
    let keep = |text: &str| {
        let body = completion(text, "stop").to_string();
        raw(format!("HTTP/1.1 200 OK\r\nContent-Length: {}\r\n\r\n{body}", body.len()))
    };
    let server = FaultServer::answering([keep("one"), keep("two"), keep("three"), keep("four")]);
    let stream = Seed(1).stream("test/retry");
    let mut model =
        Retried::new(client(&server), RetryConfig::default(), stream, Arc::new(ManualClock::new())).unwrap();
    assert_eq!(model.chat(&request("1")).unwrap().text, "one");
    assert_eq!(model.chat(&request("2")).unwrap().text, "two");
}

fn models(tape: Tape, log: &Path) -> Models {
    let config = ModelsConfig {
        retry: RetryConfig { attempts: 3, ..RetryConfig::default() },
        requests_per_minute: Some(600),
        tariff: Tariff {
            prices: BTreeMap::from([("m".into(), Price { prompt: 1_000_000, completion: 1_000_000 })]),
            model: "m".into(),
            ..Tariff::default()
        },
        ..ModelsConfig::default()
    };
    let models = Models::new(config, Seed(5), Arc::new(ManualClock::new()));
    models.with_tape(tape).with_log(ModelLog::create(log).unwrap())
}

/// A server that fails two times of three, differently each time, and answers with the question.
fn moody() -> FaultServer {
    let count = std::sync::atomic::AtomicU64::new(0);
    FaultServer::by_rule(move |heard| {
        let prompt = heard.prompt();
        match count.fetch_add(1, std::sync::atomic::Ordering::Relaxed) % 9 {
            0 => status(429, "Retry-After: 5\r\n", ""),
            1 => status(500, "", "boom"),
            2 => raw(""),
            3 => cut_short("{\"choices\""),
            4 => status(200, "", "{\"choices\": [{\"mess"),
            5 => status(400, "", "no"),
            _ => says(&prompt),
        }
    })
}

#[test]
fn nothing_is_lost_and_a_replay_gives_the_same() {
    const AGENTS: [&str; 4] = ["ann", "bob", "cid", "dan"];
    let folder = tempfile::tempdir().unwrap();
    let run = |models: &Models, server: &FaultServer| {
        std::thread::scope(|scope| {
            let threads: Vec<_> = AGENTS
                .map(|agent| {
                    let mut model = models.agent(agent, client(server)).unwrap();
                    // two of three questions are the same ones again
                    scope.spawn(move || {
                        (0..40)
                            .map(|n| model.chat(&request(&format!("{agent} {}", n % 13))))
                            .collect::<Vec<_>>()
                    })
                })
                .into();
            threads.into_iter().map(|thread| thread.join().unwrap()).collect::<Vec<_>>()
        })
    };
    let (tape, log) = (folder.path().join("tape.jsonl"), folder.path().join("log.jsonl"));
    let server = moody();
    let first = models(Tape::record(&tape).unwrap(), &log);
    let answers = run(&first, &server);

    let answered = answers.iter().flatten().filter(|answer| answer.is_ok()).count();
    assert!((40..140).contains(&answered), "both happen: {answered} of 160 were answered");
    for (agent, answers) in AGENTS.iter().zip(&answers) {
        for (n, answer) in answers.iter().enumerate() {
            if let Ok(reply) = answer {
                assert_eq!(reply.text, format!("{agent} {}", n % 13), "each answer is that of its question");
            }
        }
    }
    // every attempt is booked, and what came back is paid for
    let total = first.ledger().total();
    assert_eq!(total.answered, answered as u64);
    assert_eq!(total.answered + total.failed, server.heard().len() as u64);
    assert_eq!(total.cost, 14 * total.answered);
    assert_eq!(total.usage.total(), 14 * total.answered);

    // the log has every request of every agent, in the agent's order
    let lines = ModelLog::read(&log).unwrap();
    for (agent, answers) in AGENTS.iter().zip(&answers) {
        let of_agent: Vec<_> = lines.iter().filter(|line| line.agent == *agent).collect();
        assert!(of_agent.iter().enumerate().all(|(n, line)| line.nth == n as u64));
        assert!(of_agent.iter().map(|line| &line.answer).eq(answers));
    }

    // without a server, bit for bit
    let nobody = FaultServer::answering([]);
    let second = models(Tape::replay(&tape).unwrap(), &folder.path().join("again.jsonl"));
    let again = run(&second, &nobody);
    assert_eq!(second.ledger().total(), Account::default(), "a replay costs nothing");
    assert!(nobody.heard().is_empty());
    assert_eq!(serde_json::to_vec(&answers).unwrap(), serde_json::to_vec(&again).unwrap());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    #[test]
    fn any_bytes_of_an_answer_are_read_or_refused(
        body in prop::collection::vec(any::<u8>(), 0..300),
        json in "[\\[{]?(\"(choices|message|content|delta|usage|error|tool_calls|function)\"|[\\[\\]{}:,0-9 ]|null){0,30}",
    ) {
        for body in [body, json.clone().into_bytes(), format!("data: {json}\n\n").into_bytes()] {
            let mut framed = format!("HTTP/1.1 200 OK\r\nContent-Length: {}\r\n\r\n", body.len()).into_bytes();
            framed.extend_from_slice(&body);
            let server = FaultServer::answering([raw(framed.clone()), raw(framed), raw(body)]);
            let mut model = client(&server);
            let _ = model.chat(&request("?"));
            let _ = model.chat_streamed(&request("?"), &mut |_| {});
            let _ = model.chat(&request("?"));
        }
    }
}
