//! A real llama.cpp answers, with a model of random weights: every answer type-checks or is a typed error.
//!
//! Nonsense within a grammar proves transport, schemas, streams, tools, limits and accounts, and nothing about planning.
//! `ci/model-server` installs what this needs.
#![cfg(feature = "http")]

use std::sync::Arc;

use crate::model_server::ModelServer;
use serde::Deserialize;
use serde_json::json;
use simworld_agents::model::*;
use simworld_core::seed::Seed;

/// What the schema below describes; anything else is refused.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct Step {
    action: Action,
    decimetres: i32,
    target: Target,
}

#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Action {
    Go,
    Wait,
    SitDown,
}

#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
enum Target {
    #[serde(rename = "E4")]
    Four,
    #[serde(rename = "E17")]
    Seventeen,
}

fn schema() -> serde_json::Value {
    json!({
        "type": "object",
        "properties": {
            "action": {"enum": ["go", "wait", "sit_down"]},
            "decimetres": {"enum": [0, 5, 10, 50, 200]},
            "target": {"enum": ["E4", "E17"]},
        },
        "required": ["action", "decimetres", "target"],
        "additionalProperties": false,
    })
}

fn request(prompt: &str, seed: i64) -> ChatRequest {
    let mut request = ChatRequest::new([Message::system("You walk."), Message::user(prompt)]);
    request.temperature = Some(1.0);
    request.seed = Some(seed);
    request.max_tokens = Some(60);
    request
}

fn step_request(seed: i64, max_tokens: u32) -> ChatRequest {
    let mut request = request("What next?", seed).with_schema("step", schema());
    request.max_tokens = Some(max_tokens);
    request
}

#[test]
fn every_answer_type_checks_or_is_a_typed_error() {
    let Some(server) = ModelServer::start() else { return };
    let mut model = OpenAiChat::new(server.config()).unwrap();

    words_are_counted_and_the_same_for_the_same_seed(&mut model);
    steps_conform_to_their_schema(&mut model);
    streams_are_the_same_in_pieces(&mut model);
    tools_are_called_with_their_arguments(&mut model);
    what_the_server_does_not_know_is_refused(&mut model);
    a_late_answer_is_given_up_and_the_next_one_comes(&server);
    a_run_replays_without_the_server(server);
}

fn words_are_counted_and_the_same_for_the_same_seed(model: &mut OpenAiChat) {
    let reply = model.chat(&request("Where is the bench?", 3)).unwrap();
    assert!(!reply.text.is_empty());
    assert!(reply.usage.prompt > 20 && (1..=60).contains(&reply.usage.completion), "{:?}", reply.usage);
    assert!(matches!(reply.finish, Finish::Length | Finish::Stop));
    assert_eq!(model.chat(&request("Where is the bench?", 3)).unwrap(), reply);
    assert_ne!(model.chat(&request("Where is the bench?", 4)).unwrap().text, reply.text);
}

fn steps_conform_to_their_schema(model: &mut OpenAiChat) {
    let mut steps = Vec::new();
    let mut cut = 0;
    for seed in 0..40 {
        // too few tokens for some, enough for others
        let reply = model.chat(&step_request(seed, 10 + 3 * seed as u32)).unwrap();
        match reply.json::<Step>() {
            Ok(step) => steps.push(step),
            Err(ModelError::Truncated { got }) => {
                assert_eq!((reply.finish, got), (Finish::Length, reply.text.len()));
                cut += 1;
            }
            Err(other) => panic!("{other}"),
        }
    }
    assert!(steps.len() > 10 && cut > 0, "{} steps, {cut} cut", steps.len());
    assert!(steps.iter().any(|step| *step != steps[0]), "a random model says different things");

    // a schema whose numbers have no bounds: what fits no type of ours is an error, not a guess
    let (mut fit, mut others) = (0, 0);
    for seed in 0..20 {
        let reply =
            model.chat(&request("How far?", seed).with_schema("far", json!({"type": "integer"}))).unwrap();
        match reply.json::<i16>() {
            Ok(_) => fit += 1,
            Err(ModelError::Truncated { .. } | ModelError::BadReply { .. }) => others += 1,
            Err(other) => panic!("{other}"),
        }
    }
    assert!(fit > 0 && others > 0, "{fit} fit, {others} do not");
}

fn streams_are_the_same_in_pieces(model: &mut OpenAiChat) {
    for request in [request("Tell me more", 5), step_request(6, 200)] {
        let whole = model.chat(&request).unwrap();
        let mut pieces = Vec::new();
        let streamed = model.chat_streamed(&request, &mut |piece| pieces.push(piece.to_owned())).unwrap();
        assert_eq!(pieces.concat(), streamed.text);
        assert!(pieces.len() > 1, "{pieces:?}");
        assert_eq!(streamed.text.trim_end(), whole.text.trim_end());
        assert_eq!((streamed.usage, streamed.finish), (whole.usage, whole.finish));
    }
}

fn tools_are_called_with_their_arguments(model: &mut OpenAiChat) {
    let tool = |name: &str| Tool { name: name.into(), description: "moves".into(), parameters: schema() };
    for seed in 0..4 {
        let mut request = request("Move", seed);
        request.tools = vec![tool("walk"), tool("run")];
        request.tool_choice = ToolChoice::Required;
        request.max_tokens = Some(300);
        for reply in [model.chat(&request).unwrap(), model.chat_streamed(&request, &mut |_| {}).unwrap()] {
            if reply.finish == Finish::Length {
                continue;
            }
            let [call] = reply.tool_calls.as_slice() else { panic!("{reply:?}") };
            assert!(["walk", "run"].contains(&call.name.as_str()));
            assert!(
                call.arguments["action"].is_string() && call.arguments["decimetres"].is_i64(),
                "{call:?}"
            );
        }
    }
}

fn what_the_server_does_not_know_is_refused(model: &mut OpenAiChat) {
    let strange = request("?", 1).with_schema("strange", json!({"type": "lorry"}));
    let mut elsewhere = request("?", 1);
    elsewhere.model = Some("another".into());
    let mut seeing = request("?", 1);
    seeing.messages.push(Message::user("What is this?").with_image(Image::png(vec![0; 64])));
    for (request, expected, reason) in
        [(strange, 400, "lorry"), (elsewhere, 404, "another"), (seeing, 400, "image_url")]
    {
        for answer in [model.chat(&request), model.chat_streamed(&request, &mut |_| {})] {
            let Err(ModelError::Refused { status, body }) = answer else { panic!("{answer:?}") };
            assert!(status == expected && body.contains(reason), "{status}: {body}");
        }
    }
}

fn a_late_answer_is_given_up_and_the_next_one_comes(server: &ModelServer) {
    let mut hasty = OpenAiChat::new(OpenAiConfig { timeout: 0.05, ..server.config() }).unwrap();
    let mut long = request("Tell me everything", 1);
    long.max_tokens = Some(1900);
    for answer in [hasty.chat(&long), hasty.chat_streamed(&long, &mut |_| {})] {
        assert!(matches!(answer, Err(ModelError::Timeout { .. })), "{answer:?}");
    }
    OpenAiChat::new(server.config()).unwrap().chat(&request("Still there?", 1)).unwrap();
}

fn a_run_replays_without_the_server(server: ModelServer) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("tape.jsonl");
    let requests: Vec<_> = (0..6).map(|n| step_request(n % 4, 100)).chain([request("?", 1)]).collect();
    let run = |tape: Tape| {
        let client = OpenAiChat::new(server.config()).unwrap();
        let retry = RetryConfig { attempts: 2, ..RetryConfig::default() };
        let stream = Seed(1).stream("test/retry");
        let retried = Retried::new(client, retry, stream, Arc::new(ManualClock::new())).unwrap();
        let mut model = Recorded::new(retried, "ann", Arc::new(tape));
        requests.iter().map(|request| model.chat(request)).collect::<Vec<_>>()
    };
    let recorded = run(Tape::record(&path).unwrap());
    assert!(recorded.iter().all(Result::is_ok));
    let config = server.config();
    let replayed = run(Tape::replay(&path).unwrap());
    assert_eq!(serde_json::to_vec(&replayed).unwrap(), serde_json::to_vec(&recorded).unwrap());

    drop(server);
    let answer = OpenAiChat::new(config).unwrap().chat(&requests[0]);
    assert!(matches!(answer, Err(ModelError::Transport { .. })), "{answer:?}");
    let mut nobody = Recorded::new(NoModel, "ann", Arc::new(Tape::replay(&path).unwrap()));
    let replayed: Vec<_> = requests.iter().map(|request| nobody.chat(request)).collect();
    assert_eq!(replayed, recorded);
}

/// The model of random weights as a file, for whoever starts the server by hand: `SIMWORLD_MODEL_FILE` says where.
#[test]
fn the_random_model_is_a_file() {
    let folder = tempfile::tempdir().unwrap();
    let own = folder.path().join("random.gguf");
    let path = std::env::var_os("SIMWORLD_MODEL_FILE").map_or(own, std::path::PathBuf::from);
    crate::model_server::write_model(&path);
    let bytes = std::fs::read(&path).unwrap();
    assert!(bytes.starts_with(b"GGUF") && bytes.len() < 1 << 20, "{} bytes", bytes.len());
}
