//! What is asked of a model.

use std::sync::Arc;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::key::RequestKey;
use super::reply::ToolCall;

/// One question to a model, with everything that shapes its answer.
///
/// Fields that are not set are left to the model and absent from the JSON, so that keys of recordings stay what they
/// were when fields are added.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ChatRequest {
    /// The model's name; that of the backend's configuration if none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub model: Option<String>,
    /// The conversation so far, oldest first.
    pub messages: Vec<Message>,
    /// What the answer's text must conform to, as JSON.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub schema: Option<Schema>,
    /// What the model may call.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub tools: Vec<Tool>,
    /// Whether it may, must or must not call; without tools it says nothing.
    #[serde(skip_serializing_if = "ToolChoice::is_auto")]
    pub tool_choice: ToolChoice,
    /// The most tokens of the answer.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max_tokens: Option<u32>,
    /// Randomness of the choice of words, 0 (the likeliest word) to 2.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub temperature: Option<f64>,
    /// The seed of that randomness; servers keep it as well as they can. JSON numbers hold 63 bits.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub seed: Option<i64>,
    /// Texts at which the answer ends; they are not part of it.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub stop: Vec<String>,
}

impl ChatRequest {
    /// A request with these messages, everything else left to the model.
    pub fn new(messages: impl IntoIterator<Item = Message>) -> Self {
        Self { messages: messages.into_iter().collect(), ..Self::default() }
    }

    /// The same request, answered in JSON that conforms to a schema.
    #[must_use]
    pub fn with_schema(mut self, name: impl Into<String>, json: Value) -> Self {
        self.schema = Some(Schema { name: name.into(), json });
        self
    }

    /// The hash by which recordings find the answer; equal requests have equal keys on every machine.
    pub fn key(&self) -> RequestKey {
        RequestKey::of(self)
    }

    /// The hash of the messages alone: the prompt, whatever model, schema or seed it is asked with.
    pub fn prompt_key(&self) -> RequestKey {
        RequestKey::of(&self.messages)
    }
}

/// Who speaks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Role {
    /// Whoever set the agent up: its instructions.
    System,
    /// Whoever asks: the situation, and data from the scene.
    User,
    /// The model itself, earlier.
    Assistant,
    /// A tool that the model called.
    Tool,
}

/// One turn of a conversation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Message {
    /// Who speaks.
    pub role: Role,
    /// What is said and shown, in order.
    pub content: Vec<Part>,
}

impl Message {
    /// A message of one role and one text.
    pub fn text(role: Role, text: impl Into<String>) -> Self {
        Self { role, content: vec![Part::Text(text.into())] }
    }

    /// Instructions.
    pub fn system(text: impl Into<String>) -> Self {
        Self::text(Role::System, text)
    }

    /// A question or a situation.
    pub fn user(text: impl Into<String>) -> Self {
        Self::text(Role::User, text)
    }

    /// What the model said earlier.
    pub fn assistant(text: impl Into<String>) -> Self {
        Self::text(Role::Assistant, text)
    }

    /// What a tool answered to the call of this id.
    pub fn tool_result(call: impl Into<String>, text: impl Into<String>) -> Self {
        Self { role: Role::Tool, content: vec![Part::ToolResult { call: call.into(), text: text.into() }] }
    }

    /// The same message with a picture behind it.
    #[must_use]
    pub fn with_image(mut self, image: Image) -> Self {
        self.content.push(Part::Image(image));
        self
    }
}

/// A piece of a message.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Part {
    /// Words.
    Text(String),
    /// A picture.
    Image(Image),
    /// A call that the model made; in messages of [`Role::Assistant`].
    ToolCall(ToolCall),
    /// What came of a call; in messages of [`Role::Tool`].
    ToolResult {
        /// The id of the call.
        call: String,
        /// The answer, as the model shall read it.
        text: String,
    },
}

/// An encoded picture. It is shared, not copied, when a request is cloned; JSON holds it as base64.
#[derive(Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Image {
    /// `image/png`, `image/jpeg`, ...
    pub media_type: String,
    /// The file.
    #[serde(serialize_with = "to_base64", deserialize_with = "from_base64")]
    pub bytes: Arc<[u8]>,
}

impl Image {
    /// A PNG file.
    pub fn png(bytes: impl Into<Arc<[u8]>>) -> Self {
        Self { media_type: "image/png".into(), bytes: bytes.into() }
    }
}

impl std::fmt::Debug for Image {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Image({}, {} B)", self.media_type, self.bytes.len())
    }
}

/// A JSON schema that the answer must conform to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Schema {
    /// Its name: letters, digits, `_` and `-`, at most 64.
    pub name: String,
    /// The schema.
    pub json: Value,
}

/// Something the model may call.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Tool {
    /// Its name: letters, digits, `_` and `-`, at most 64.
    pub name: String,
    /// What it does, for the model to read.
    pub description: String,
    /// The JSON schema of its arguments, an object.
    pub parameters: Value,
}

/// Whether the model calls tools.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ToolChoice {
    /// As it likes.
    #[default]
    Auto,
    /// At least one.
    Required,
    /// None: it only knows that they are there.
    None,
}

impl ToolChoice {
    // serde's `skip_serializing_if` hands over a reference
    #[allow(clippy::trivially_copy_pass_by_ref)]
    fn is_auto(&self) -> bool {
        *self == Self::Auto
    }
}

fn to_base64<S: serde::Serializer>(bytes: &Arc<[u8]>, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(&STANDARD.encode(bytes))
}

fn from_base64<'de, D: serde::Deserializer<'de>>(deserializer: D) -> Result<Arc<[u8]>, D::Error> {
    let text = String::deserialize(deserializer)?;
    STANDARD.decode(text).map(Into::into).map_err(serde::de::Error::custom)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_request_reads_back_as_it_was() {
        let mut request = ChatRequest::new([
            Message::system("You walk."),
            Message::user("What is this?").with_image(Image::png(vec![0, 255, 7])),
            Message { role: Role::Assistant, content: vec![Part::ToolCall(call())] },
            Message::tool_result("c1", "a bench"),
        ])
        .with_schema("step", serde_json::json!({"type": "object"}));
        request.seed = Some(i64::MIN);
        request.tool_choice = ToolChoice::Required;
        let text = serde_json::to_string(&request).unwrap();
        assert_eq!(serde_json::from_str::<ChatRequest>(&text).unwrap(), request);
        assert!(serde_json::from_str::<ChatRequest>(&text.replace("AP8H", "A=P8")).is_err());
    }

    #[test]
    fn what_is_not_set_is_not_written() {
        let text = serde_json::to_string(&ChatRequest::new([])).unwrap();
        assert_eq!(text, r#"{"messages":[]}"#);
    }

    fn call() -> ToolCall {
        ToolCall { id: "c1".into(), name: "look".into(), arguments: serde_json::json!({"at": 4}) }
    }
}
