//! Requests as the server reads them.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Map, Value, json};

use super::super::{ChatRequest, Message, ModelError, Part, Role, ToolCall, ToolChoice};
use super::config::{LimitField, OpenAiConfig, SchemaMode, StreamUsage};

/// How the answer shall come.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Delivery {
    Whole,
    Streamed,
}

/// The body of the request.
pub(super) fn body(
    request: &ChatRequest,
    config: &OpenAiConfig,
    delivery: Delivery,
) -> Result<Vec<u8>, ModelError> {
    let mut messages = Vec::new();
    for message in &request.messages {
        push_message(message, &mut messages)?;
    }
    if messages.is_empty() {
        return Err(ModelError::Request("it has no messages".into()));
    }
    let mut body = Map::new();
    body.insert("model".into(), request.model.as_ref().unwrap_or(&config.model).as_str().into());
    body.insert("messages".into(), messages.into());
    push_limits(request, config, &mut body)?;
    if let Some(schema) = &request.schema {
        let format = match config.schema_mode {
            SchemaMode::Strict => json!({"name": schema.name, "schema": schema.json, "strict": true}),
            SchemaMode::Loose => json!({"name": schema.name, "schema": schema.json}),
            SchemaMode::AnyObject => Value::Null,
        };
        let format = match format {
            Value::Null => json!({"type": "json_object"}),
            format => json!({"type": "json_schema", "json_schema": format}),
        };
        body.insert("response_format".into(), format);
    }
    push_tools(request, &mut body);
    if delivery == Delivery::Streamed {
        body.insert("stream".into(), true.into());
        if config.stream_usage == StreamUsage::Asked {
            body.insert("stream_options".into(), json!({"include_usage": true}));
        }
    }
    serde_json::to_vec(&body).map_err(|error| ModelError::Request(error.to_string()))
}

fn push_limits(
    request: &ChatRequest,
    config: &OpenAiConfig,
    body: &mut Map<String, Value>,
) -> Result<(), ModelError> {
    if let Some(limit) = request.max_tokens {
        let name = match config.limit_field {
            LimitField::MaxTokens => "max_tokens",
            LimitField::MaxCompletionTokens => "max_completion_tokens",
        };
        body.insert(name.into(), limit.into());
    }
    if let Some(temperature) = request.temperature {
        if !(0.0..=2.0).contains(&temperature) {
            return Err(ModelError::Request(format!(
                "its temperature is {temperature}: it must be from 0 to 2"
            )));
        }
        body.insert("temperature".into(), temperature.into());
    }
    if let Some(seed) = request.seed {
        body.insert("seed".into(), seed.into());
    }
    if !request.stop.is_empty() {
        body.insert("stop".into(), request.stop.as_slice().into());
    }
    Ok(())
}

fn push_tools(request: &ChatRequest, body: &mut Map<String, Value>) {
    if request.tools.is_empty() {
        return;
    }
    let tools: Vec<Value> = request
        .tools
        .iter()
        .map(|tool| {
            json!({"type": "function", "function": {
                "name": tool.name, "description": tool.description, "parameters": tool.parameters,
            }})
        })
        .collect();
    body.insert("tools".into(), tools.into());
    match request.tool_choice {
        ToolChoice::Auto => {}
        ToolChoice::Required => drop(body.insert("tool_choice".into(), "required".into())),
        ToolChoice::None => drop(body.insert("tool_choice".into(), "none".into())),
    }
}

/// One message may become several: servers want each tool's result in its own.
fn push_message(message: &Message, out: &mut Vec<Value>) -> Result<(), ModelError> {
    let mut content = Vec::new();
    let mut calls = Vec::new();
    for part in &message.content {
        match (message.role, part) {
            (Role::Tool, Part::ToolResult { call, text }) => {
                out.push(json!({"role": "tool", "tool_call_id": call, "content": text}));
            }
            (Role::Assistant, Part::ToolCall(call)) => calls.push(wire_call(call)),
            (Role::System | Role::User | Role::Assistant, Part::Text(text)) => {
                content.push(json!({"type": "text", "text": text}));
            }
            (Role::User, Part::Image(image)) => {
                let url = format!("data:{};base64,{}", image.media_type, STANDARD.encode(&image.bytes));
                content.push(json!({"type": "image_url", "image_url": {"url": url}}));
            }
            (role, part) => {
                return Err(ModelError::Request(format!("a message of role {role:?} holds {}", name(part))));
            }
        }
    }
    if message.role == Role::Tool {
        return Ok(());
    }
    let mut wire = Map::new();
    wire.insert("role".into(), serde_json::to_value(message.role).unwrap_or_default());
    wire.insert("content".into(), plain_or_parts(content));
    if !calls.is_empty() {
        wire.insert("tool_calls".into(), calls.into());
    }
    out.push(wire.into());
    Ok(())
}

fn wire_call(call: &ToolCall) -> Value {
    json!({"id": call.id, "type": "function", "function": {
        "name": call.name, "arguments": call.arguments.to_string(),
    }})
}

/// A single text goes as a string: some servers know no parts.
fn plain_or_parts(mut parts: Vec<Value>) -> Value {
    if parts.is_empty() {
        return Value::Null;
    }
    match parts.as_mut_slice() {
        [only] if only["type"] == "text" => only["text"].take(),
        _ => parts.into(),
    }
}

fn name(part: &Part) -> &'static str {
    match part {
        Part::Text(_) => "plain text",
        Part::Image(_) => "a picture",
        Part::ToolCall(_) => "a tool call",
        Part::ToolResult { .. } => "a tool's result",
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::{Image, Tool};
    use super::*;

    fn sent(request: &ChatRequest, delivery: Delivery) -> Value {
        serde_json::from_slice(&body(request, &OpenAiConfig::default(), delivery).unwrap()).unwrap()
    }

    #[test]
    fn pictures_schemas_and_tools_are_what_servers_expect() {
        let mut request = ChatRequest::new([
            Message::system("You see."),
            Message::user("What?").with_image(Image::png(vec![1, 2, 3])),
            Message {
                role: Role::Assistant,
                content: vec![Part::ToolCall(ToolCall {
                    id: "c".into(),
                    name: "look".into(),
                    arguments: json!({"at": 1}),
                })],
            },
            Message::tool_result("c", "a dog"),
        ])
        .with_schema("s", json!({"type": "object"}));
        request.max_tokens = Some(9);
        request.tools = vec![Tool {
            name: "look".into(),
            description: "looks".into(),
            parameters: json!({"type": "object"}),
        }];
        request.tool_choice = ToolChoice::Required;
        assert_eq!(
            sent(&request, Delivery::Streamed),
            json!({
                "model": "default",
                "messages": [
                    {"role": "system", "content": "You see."},
                    {"role": "user", "content": [
                        {"type": "text", "text": "What?"},
                        {"type": "image_url", "image_url": {"url": "data:image/png;base64,AQID"}},
                    ]},
                    {"role": "assistant", "content": null, "tool_calls": [
                        {"id": "c", "type": "function", "function": {"name": "look", "arguments": "{\"at\":1}"}},
                    ]},
                    {"role": "tool", "tool_call_id": "c", "content": "a dog"},
                ],
                "max_tokens": 9,
                "response_format": {"type": "json_schema",
                    "json_schema": {"name": "s", "schema": {"type": "object"}, "strict": true}},
                "tools": [{"type": "function", "function":
                    {"name": "look", "description": "looks", "parameters": {"type": "object"}}}],
                "tool_choice": "required",
                "stream": true,
                "stream_options": {"include_usage": true},
            })
        );
    }

    #[test]
    fn what_no_server_takes_is_not_sent() {
        let config = OpenAiConfig::default();
        let mut hot = ChatRequest::new([Message::user("?")]);
        hot.temperature = Some(f64::NAN);
        let picture = Message { role: Role::System, content: vec![Part::Image(Image::png(vec![]))] };
        for wrong in [ChatRequest::new([]), hot, ChatRequest::new([picture])] {
            assert!(
                matches!(body(&wrong, &config, Delivery::Whole), Err(ModelError::Request(_))),
                "{wrong:?}"
            );
        }
    }
}
