//! Answers as the server writes them: any bytes give a reply or an error.

use serde::Deserialize;
use serde_json::Value;

use super::super::error::shortened;
use super::super::reckon::{reckoned_prompt, reckoned_tokens};
use super::super::{ChatReply, ChatRequest, Finish, ModelError, ToolCall, Usage};

#[derive(Deserialize)]
struct Completion {
    #[serde(default)]
    choices: Vec<Choice>,
    #[serde(default)]
    usage: Option<WireUsage>,
    #[serde(default)]
    error: Option<Value>,
}

#[derive(Deserialize)]
struct Choice {
    message: WireMessage,
    #[serde(default)]
    finish_reason: Option<String>,
}

#[derive(Deserialize)]
struct WireMessage {
    #[serde(default)]
    content: Option<String>,
    #[serde(default)]
    refusal: Option<String>,
    #[serde(default)]
    tool_calls: Option<Vec<WireCall>>,
}

#[derive(Deserialize)]
struct WireCall {
    #[serde(default)]
    id: Option<String>,
    function: WireFunction,
}

#[derive(Deserialize)]
struct WireFunction {
    name: String,
    #[serde(default)]
    arguments: Value,
}

/// Tokens as the server counts them.
#[derive(Clone, Copy, Debug, Deserialize)]
pub(super) struct WireUsage {
    #[serde(default)]
    prompt_tokens: u64,
    #[serde(default)]
    completion_tokens: u64,
}

/// Reads a whole answer.
pub(super) fn read(bytes: &[u8], request: &ChatRequest) -> Result<ChatReply, ModelError> {
    let bad =
        |reason: String| ModelError::BadReply { reason, body: shortened(&String::from_utf8_lossy(bytes)) };
    let completion: Completion = serde_json::from_slice(bytes).map_err(|error| bad(error.to_string()))?;
    if let Some(error) = completion.error {
        return Err(bad(format!("the server reports a failure: {}", said(&error))));
    }
    let choice = completion.choices.into_iter().next().ok_or_else(|| bad("it has no choices".into()))?;
    let mut finish = finish_of(choice.finish_reason.as_deref());
    let mut text = choice.message.content.unwrap_or_default();
    if let Some(refusal) = choice.message.refusal.filter(|_| text.is_empty()) {
        text = refusal;
        finish = Finish::Filter;
    }
    let mut tool_calls = Vec::new();
    for (index, call) in choice.message.tool_calls.unwrap_or_default().into_iter().enumerate() {
        let id = call.id.unwrap_or_default();
        tool_calls
            .push(tool_call(index, id, call.function.name, call.function.arguments, finish).map_err(bad)?);
    }
    let usage = usage_of(completion.usage, request, &text, &tool_calls);
    Ok(ChatReply { text, tool_calls, usage, finish })
}

/// A call as servers write it: arguments as text that holds JSON, with some as JSON itself.
pub(super) fn tool_call(
    index: usize,
    id: String,
    name: String,
    arguments: Value,
    finish: Finish,
) -> Result<ToolCall, String> {
    let arguments = match arguments {
        Value::String(text) if text.trim().is_empty() => Value::Object(serde_json::Map::new()),
        Value::String(text) => serde_json::from_str(&text).map_err(|error| {
            let cut = if finish == Finish::Length { " (the answer reached its limit of tokens)" } else { "" };
            format!("the arguments of the call of {name} are no JSON{cut}: {error}")
        })?,
        Value::Null => Value::Object(serde_json::Map::new()),
        value => value,
    };
    let id = if id.is_empty() { format!("call-{index}") } else { id };
    Ok(ToolCall { id, name, arguments })
}

pub(super) fn finish_of(reason: Option<&str>) -> Finish {
    match reason {
        Some("stop") => Finish::Stop,
        Some("length") => Finish::Length,
        Some("tool_calls" | "function_call") => Finish::ToolCalls,
        Some("content_filter") => Finish::Filter,
        Some(_) | None => Finish::Other,
    }
}

/// What the server counted, or a reckoning where it did not.
pub(super) fn usage_of(
    counted: Option<WireUsage>,
    request: &ChatRequest,
    text: &str,
    calls: &[ToolCall],
) -> Usage {
    let said =
        counted.map(|usage| Usage { prompt: usage.prompt_tokens, completion: usage.completion_tokens });
    said.filter(|usage| *usage != Usage::default()).unwrap_or_else(|| {
        let called: usize = calls.iter().map(|call| call.name.len() + call.arguments.to_string().len()).sum();
        Usage { prompt: reckoned_prompt(request), completion: reckoned_tokens(text.len() + called) }
    })
}

/// The message within what a server reports, or all of it.
pub(super) fn said(error: &Value) -> String {
    let message = error.get("message").unwrap_or(error);
    shortened(&message.as_str().map_or_else(|| message.to_string(), str::to_owned))
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::super::super::Message;
    use super::*;

    fn read_json(answer: &Value) -> Result<ChatReply, ModelError> {
        read(answer.to_string().as_bytes(), &ChatRequest::new([Message::user("123456")]))
    }

    #[test]
    fn text_calls_usage_and_finish_are_read() {
        let reply = read_json(&json!({
            "choices": [{"message": {"content": null, "tool_calls": [
                {"id": "a", "function": {"name": "go", "arguments": "{\"to\": 3}"}},
                {"function": {"name": "stop", "arguments": ""}},
                {"function": {"name": "see", "arguments": {"what": 1}}},
            ]}, "finish_reason": "tool_calls"}],
            "usage": {"prompt_tokens": 7, "completion_tokens": 2, "total_tokens": 9},
        }))
        .unwrap();
        assert_eq!(reply.finish, Finish::ToolCalls);
        assert_eq!(reply.usage, Usage { prompt: 7, completion: 2 });
        let calls: Vec<_> =
            reply.tool_calls.iter().map(|c| (c.id.as_str(), c.arguments.to_string())).collect();
        assert_eq!(
            calls,
            [("a", "{\"to\":3}".into()), ("call-1", "{}".into()), ("call-2", "{\"what\":1}".to_string())]
        );
    }

    #[test]
    fn usage_that_is_not_said_is_reckoned() {
        let reply = read_json(&json!({"choices": [{"message": {"content": "1234"}}]})).unwrap();
        assert_eq!(reply.finish, Finish::Other);
        assert_eq!(reply.usage.completion, 2);
        assert!(reply.usage.prompt >= 2);
    }

    #[test]
    fn what_is_no_answer_is_a_typed_error() {
        for wrong in [
            json!({}),
            json!([]),
            json!({"choices": []}),
            json!({"choices": [{}]}),
            json!({"choices": [{"message": {"content": 5}}]}),
            json!({"choices": [{"message": {"tool_calls": [{"function": {"name": "go", "arguments": "{"}}]}}]}),
            json!({"error": {"message": "out of memory"}}),
        ] {
            let error = read_json(&wrong).unwrap_err();
            assert!(matches!(error, ModelError::BadReply { .. }), "{wrong}: {error}");
        }
    }

    #[test]
    fn a_refusal_is_no_plain_answer() {
        let reply =
            read_json(&json!({"choices": [{"message": {"refusal": "No."}, "finish_reason": "stop"}]}))
                .unwrap();
        assert_eq!((reply.text.as_str(), reply.finish), ("No.", Finish::Filter));
    }
}
