//! Servers that speak the chat completions of OpenAI (feature `http`): OpenAI itself, vLLM, Ollama, llama.cpp and the like.
//!
//! `POST {base_url}/chat/completions`, one blocking request at a time, without TLS unless the feature `https` is there.
//! Redirects are not followed, answers have a limit of size and of time, and the key is in no error, log or answer.

mod answer;
mod config;
mod fault;
mod key;
mod sse;
mod wire;

use std::io::Read;
use std::sync::Arc;

use ureq::http::Response;
use ureq::{Agent, Body};

pub use config::{LimitField, OpenAiConfig, PlainKey, SchemaMode, StreamUsage};

use self::key::Scrubber;
use super::{ChatModel, ChatReply, ChatRequest, ModelError};
use crate::http::{self, ApiKey, Connecting};

/// The most bytes that are read of what a server says about a failure.
const ERROR_BODY: u64 = 64 * 1024;

/// A model behind an OpenAI-compatible server. Clones share their connections: give each agent one.
///
/// ```no_run
/// use simworld_agents::model::{ChatModel, ChatRequest, Message, OpenAiChat, OpenAiConfig};
/// let config = OpenAiConfig {
///     base_url: "http://127.0.0.1:8080/v1".into(),
///     model: "llama".into(),
///     ..OpenAiConfig::default()
/// };
/// let reply = OpenAiChat::new(config)?.chat(&ChatRequest::new([Message::user("Where to?")]))?;
/// println!("{}", reply.text);
/// # Ok::<(), simworld_agents::model::ModelError>(())
/// ```
#[derive(Clone)]
pub struct OpenAiChat {
    agent: Agent,
    url: String,
    config: OpenAiConfig,
    key: Option<Arc<ApiKey>>,
}

impl OpenAiChat {
    /// A client for the server of the configuration; nothing is sent yet.
    ///
    /// # Errors
    /// [`ModelError::Config`] if the configuration cannot work, [`ModelError::NoKey`] if the variable it names holds no key,
    /// [`ModelError::Store`] if the file of certificates cannot be read.
    pub fn new(config: OpenAiConfig) -> Result<Self, ModelError> {
        let uri = config.checked()?;
        let key = http::key(config.key_variable.as_deref())?;
        if key.is_some() {
            http::check_key_is_safe(&uri, config.plain_key)?;
        }
        let connecting = Connecting {
            connect_timeout: config.connect_timeout,
            timeout: config.timeout,
            root_certificates: config.root_certificates.as_deref(),
        };
        let agent = http::agent(connecting, &uri, key.clone())?;
        let url = format!("{}/chat/completions", config.base_url.trim_end_matches('/'));
        Ok(Self { agent, url, config, key })
    }

    /// Sends a body; the answer's status is good.
    fn send(&self, body: Vec<u8>) -> Result<Response<Body>, ModelError> {
        let mut post = self.agent.post(&self.url).header("content-type", "application/json");
        if let Some(key) = &self.key {
            post = post.header("authorization", key.stand_in());
        }
        let response = post.send(body).map_err(|error| self.fault(error, None))?;
        if response.status().is_success() {
            return Ok(response);
        }
        let (head, body) = response.into_parts();
        let mut said = Vec::new();
        // What came before the connection broke is still worth reading, and the status says enough without it.
        let _ = body.into_with_config().limit(ERROR_BODY).reader().read_to_end(&mut said);
        Err(fault::of_status(&head, &said, self.key.as_deref(), &self.config))
    }

    fn whole(&self, body: Body) -> Result<Vec<u8>, ModelError> {
        let mut bytes = Vec::new();
        match body.into_with_config().limit(self.config.max_reply).reader().read_to_end(&mut bytes) {
            Ok(_) => Ok(bytes),
            Err(error) => Err(self.fault(error.into(), Some(bytes.len()))),
        }
    }

    fn without_key(&self, answer: Result<ChatReply, ModelError>) -> Result<ChatReply, ModelError> {
        let mut reply = answer.map_err(|error| key::scrub_error(error, self.key.as_deref()))?;
        if let Some(key) = &self.key {
            key::scrub_reply(key, &mut reply);
        }
        Ok(reply)
    }

    fn fault(&self, error: ureq::Error, got: Option<usize>) -> ModelError {
        fault::of_transport(error, got, self.key.as_deref(), &self.config)
    }
}

impl ChatModel for OpenAiChat {
    fn chat(&mut self, request: &ChatRequest) -> Result<ChatReply, ModelError> {
        let body = wire::body(request, &self.config, wire::Delivery::Whole)?;
        let response = self.send(body)?;
        let bytes = self.whole(response.into_body())?;
        self.without_key(answer::read(&bytes, request))
    }

    fn chat_streamed(
        &mut self,
        request: &ChatRequest,
        piece: &mut dyn FnMut(&str),
    ) -> Result<ChatReply, ModelError> {
        let body = wire::body(request, &self.config, wire::Delivery::Streamed)?;
        let mut reader =
            self.send(body)?.into_body().into_with_config().limit(self.config.max_reply).reader();
        let mut scrubber = Scrubber::new(self.key.clone());
        let mut stream = sse::Stream::default();
        let mut buffer = [0; 8 * 1024];
        loop {
            match reader.read(&mut buffer) {
                Ok(0) if stream.is_whole() => break,
                Ok(0) => {
                    return Err(fault::broken(&self.config, stream.received(), "it ended without a reason"));
                }
                Ok(count) => {
                    let state = stream.push(&buffer[..count], &mut |text| scrubber.push(text, piece));
                    match state.map_err(|error| key::scrub_error(error, self.key.as_deref()))? {
                        sse::State::Open => {}
                        sse::State::Done => break,
                    }
                }
                Err(error) => return Err(self.fault(error.into(), Some(stream.received()))),
            }
        }
        scrubber.end(piece);
        self.without_key(stream.into_reply(request))
    }
}

impl std::fmt::Debug for OpenAiChat {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("OpenAiChat")
            .field("url", &self.url)
            .field("config", &self.config)
            .finish_non_exhaustive()
    }
}
