//! A run with a model replays exactly without it.
// what fails in a helper fails the test
#![allow(clippy::unwrap_used)]

use std::sync::Arc;

use proptest::prelude::*;
use simworld_agents::model::*;

fn request(prompt: &str) -> ChatRequest {
    ChatRequest::new([Message::user(prompt)])
}

/// A model that never gives the same answer twice, and fails every fifth time.
fn whimsical() -> Scripted {
    let mut count = 0u64;
    Scripted::rule(move |_| {
        count += 1;
        if count.is_multiple_of(5) {
            return Err(ModelError::Server { status: 500, retry_after: None, body: format!("{count}") });
        }
        Ok(ChatReply {
            text: format!("answer {count} \u{1f415}"),
            tool_calls: vec![ToolCall {
                id: format!("c{count}"),
                name: "go".into(),
                arguments: serde_json::json!({"to": 0.1 + count as f64, "and": null}),
            }],
            usage: Usage { prompt: count, completion: u64::MAX },
            finish: Finish::ToolCalls,
        })
    })
}

fn ask(model: &mut impl ChatModel, prompts: &[&str]) -> Vec<Result<ChatReply, ModelError>> {
    prompts.iter().map(|prompt| model.chat(&request(prompt))).collect()
}

const PROMPTS: [&str; 9] = ["a", "b", "a", "a", "c", "b", "a", "a", "d"];

#[test]
fn identical_requests_keep_their_order() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("tape.jsonl");
    let tape = Arc::new(Tape::record(&path).unwrap());
    let recorded = ask(&mut Recorded::new(whimsical(), "ann", tape), &PROMPTS);
    assert_ne!(recorded[0], recorded[2]);

    let tape = Arc::new(Tape::replay(&path).unwrap());
    let replayed = ask(&mut Recorded::new(NoModel, "ann", tape), &PROMPTS);
    assert_eq!(serde_json::to_vec(&replayed).unwrap(), serde_json::to_vec(&recorded).unwrap());

    // in another order: each question has its own answers
    let tape = Arc::new(Tape::replay(&path).unwrap());
    let mut model = Recorded::new(NoModel, "ann", tape);
    assert_eq!(ask(&mut model, &["d", "a", "b", "a"]), [8, 0, 1, 2].map(|index| recorded[index].clone()));
}

#[test]
fn what_was_not_recorded_is_named_and_not_asked() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("tape.jsonl");
    ask(&mut Recorded::new(whimsical(), "ann", Arc::new(Tape::record(&path).unwrap())), &["a", "a"]);
    let tape = Arc::new(Tape::replay(&path).unwrap());
    for (agent, prompt, nth) in [("ann", "b", 0), ("bob", "a", 0)] {
        let mut model = Recorded::new(whimsical(), agent, tape.clone());
        let key = request(prompt).key();
        let expected = ModelError::NotRecorded { agent: agent.into(), key, nth };
        assert_eq!(model.chat(&request(prompt)), Err(expected.clone()));
        assert!(expected.to_string().contains(&key.to_string()));
    }
    let answers = ask(&mut Recorded::new(whimsical(), "ann", tape), &["a", "a", "a"]);
    assert!(answers[0].is_ok() && answers[1].is_ok());
    assert!(matches!(answers[2], Err(ModelError::NotRecorded { nth: 2, .. })));
}

#[test]
fn a_recording_is_continued_and_never_overwritten() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("tape.jsonl");
    let first =
        ask(&mut Recorded::new(whimsical(), "ann", Arc::new(Tape::record(&path).unwrap())), &["a", "b"]);
    assert!(matches!(Tape::record(&path), Err(ModelError::Store { .. })));

    let tape = Arc::new(Tape::replay_or_record(&path).unwrap());
    let model = Scripted::texts(["new a", "new c"]);
    let mut model = Recorded::new(model, "ann", tape);
    let second = ask(&mut model, &["a", "b", "a", "c"]);
    assert_eq!(second[..2], first);
    assert_eq!(second[2].as_ref().unwrap().text, "new a");

    let tape = Arc::new(Tape::replay(&path).unwrap());
    assert_eq!(ask(&mut Recorded::new(NoModel, "ann", tape), &["a", "b", "a", "c"]), second);
}

#[test]
fn a_line_that_was_cut_off_is_dropped_and_a_broken_one_named() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("tape.jsonl");
    let tape = Arc::new(Tape::record(&path).unwrap());
    let recorded = ask(&mut Recorded::new(whimsical(), "ann", tape), &["a", "b", "c"]);
    let whole = std::fs::read(&path).unwrap();

    std::fs::write(&path, &whole[..whole.len() - 9]).unwrap();
    let tape = Arc::new(Tape::replay_or_record(&path).unwrap());
    let mut model = Recorded::new(Scripted::answers([recorded[2].clone()]), "ann", tape);
    assert_eq!(ask(&mut model, &["a", "b", "c"]), recorded);
    assert_eq!(std::fs::read(&path).unwrap(), whole, "the cut line was replaced");

    let mut broken = whole.clone();
    let second = whole.iter().position(|byte| *byte == b'\n').unwrap() + 5;
    broken[second] = b'!';
    std::fs::write(&path, &broken).unwrap();
    for error in [Tape::replay(&path).err().unwrap(), Tape::replay_or_record(&path).err().unwrap()] {
        assert!(error.to_string().contains("line 2"), "{error}");
    }
    assert_eq!(std::fs::read(&path).unwrap(), broken, "a file that cannot be read is left as it is");

    std::fs::write(&path, [whole.as_slice(), &whole].concat()).unwrap();
    assert!(matches!(Tape::replay(&path), Err(ModelError::Store { .. })));
    assert!(matches!(Tape::replay(&folder.path().join("none")), Err(ModelError::Store { .. })));
}

#[test]
fn agents_on_threads_have_their_own_order() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("tape.jsonl");
    let run = |tape: Tape| {
        let tape = Arc::new(tape);
        std::thread::scope(|scope| {
            let threads: Vec<_> = (0..6)
                .map(|agent| {
                    let mut model = Recorded::new(whimsical(), format!("agent {agent}"), tape.clone());
                    scope.spawn(move || (0..20).flat_map(|_| ask(&mut model, &PROMPTS)).collect::<Vec<_>>())
                })
                .collect();
            threads.into_iter().map(|thread| thread.join().unwrap()).collect::<Vec<_>>()
        })
    };
    let recorded = run(Tape::record(&path).unwrap());
    assert_eq!(run(Tape::replay(&path).unwrap()), recorded);
}

#[test]
fn a_replayed_stream_gives_its_text() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("tape.jsonl");
    for open in [Tape::record, Tape::replay] {
        let mut model = Recorded::new(Scripted::texts(["hello"]), "ann", Arc::new(open(&path).unwrap()));
        let mut heard = String::new();
        let reply = model.chat_streamed(&request("?"), &mut |piece| heard.push_str(piece)).unwrap();
        assert_eq!((reply.text.as_str(), heard.as_str()), ("hello", "hello"));
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    #[test]
    fn any_bytes_are_a_recording_or_refused(
        mut bytes in prop::collection::vec(any::<u8>(), 0..200),
        forged in any::<prop::sample::Index>(),
        byte in any::<u8>(),
    ) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("tape.jsonl");
        ask(&mut Recorded::new(whimsical(), "ann", Arc::new(Tape::record(&path).unwrap())), &["a", "b"]);
        let mut whole = std::fs::read(&path).unwrap();
        let at = forged.index(whole.len());
        whole[at] = byte;
        bytes.push(b'\n');
        for file in [bytes, whole] {
            std::fs::write(&path, file).unwrap();
            if let Ok(tape) = Tape::replay(&path) {
                ask(&mut Recorded::new(NoModel, "ann", Arc::new(tape)), &["a", "b"]);
            }
        }
    }
}
