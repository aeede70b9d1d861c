//! Which server, which model, and how long to wait.

use std::path::PathBuf;

use serde::{Deserialize, Serialize};
use ureq::http::Uri;

use super::super::ModelError;
use crate::http;

/// A server and its model. It holds no key, only the name of the variable that does.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct OpenAiConfig {
    /// The address before `/chat/completions`: `http://127.0.0.1:8080/v1`, `https://api.openai.com/v1`.
    pub base_url: String,
    /// The model's name where a request gives none; servers of a single model take any.
    pub model: String,
    /// The environment variable that holds the key; none: no key is sent.
    pub key_variable: Option<String>,
    /// Whether a key may travel without TLS.
    pub plain_key: PlainKey,
    /// A file of certificates (PEM) that are trusted instead of Mozilla's: a server with an authority of its own. Only for
    /// https.
    pub root_certificates: Option<PathBuf>,
    /// The most time to find the host, and then until the connection stands, s; 0.001 to 86,400.
    pub connect_timeout: f64,
    /// The most time from the request to the last byte of its answer, s; 0.001 to 86,400.
    pub timeout: f64,
    /// The most bytes of an answer.
    pub max_reply: u64,
    /// What the server calls the limit of tokens.
    pub limit_field: LimitField,
    /// How the server is told what the answer must conform to.
    pub schema_mode: SchemaMode,
    /// Whether a stream is asked to end with its usage.
    pub stream_usage: StreamUsage,
}

impl Default for OpenAiConfig {
    fn default() -> Self {
        Self {
            base_url: "http://127.0.0.1:8080/v1".into(),
            model: "default".into(),
            key_variable: None,
            plain_key: PlainKey::LoopbackOnly,
            root_certificates: None,
            connect_timeout: 10.0,
            timeout: 120.0,
            max_reply: 8 * 1024 * 1024,
            limit_field: LimitField::MaxTokens,
            schema_mode: SchemaMode::Strict,
            stream_usage: StreamUsage::Asked,
        }
    }
}

/// Whether a key may travel without TLS.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PlainKey {
    /// Only within this machine.
    #[default]
    LoopbackOnly,
    /// Everywhere: whoever is on the way can read it.
    Allowed,
}

/// What a server calls the limit of tokens.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LimitField {
    /// `max_tokens`: vLLM, Ollama, llama.cpp, older models of OpenAI.
    #[default]
    MaxTokens,
    /// `max_completion_tokens`: newer models of OpenAI.
    MaxCompletionTokens,
}

/// How a server is told what the answer must conform to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SchemaMode {
    /// `response_format` of type `json_schema` with `strict`: the answer conforms.
    #[default]
    Strict,
    /// The same without `strict`, for schemas that a strict server does not take.
    Loose,
    /// `response_format` of type `json_object`, for servers that know no schemas; say in the prompt what is wanted.
    AnyObject,
}

/// Whether a stream is asked to end with its usage (`stream_options`).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum StreamUsage {
    /// It is.
    #[default]
    Asked,
    /// It is not, for servers that refuse the question; usage is reckoned then.
    NotAsked,
}

impl OpenAiConfig {
    /// The address, if everything can work.
    pub(super) fn checked(&self) -> Result<Uri, ModelError> {
        let config = |reason: String| Err(ModelError::Config(reason));
        let uri = http::checked_url(&self.base_url)?;
        for (name, seconds) in [("connect_timeout", self.connect_timeout), ("timeout", self.timeout)] {
            if !(0.001..=86_400.0).contains(&seconds) {
                return config(format!("{name} is {seconds} s: it must be from 0.001 to 86,400"));
            }
        }
        if self.max_reply == 0 {
            return config("max_reply is 0: no answer would be small enough".into());
        }
        Ok(uri)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with(base_url: &str) -> OpenAiConfig {
        OpenAiConfig { base_url: base_url.into(), ..OpenAiConfig::default() }
    }

    #[test]
    fn addresses_are_checked_and_secrets_in_them_not_repeated() {
        for wrong in
            ["", "no address", "ftp://host/v1", "/v1", "http://u:hunter22@host/v1", "http://h/v1?k=hunter22"]
        {
            let error = with(wrong).checked().unwrap_err().to_string();
            assert!(!error.contains("hunter22"), "{error}");
        }
        with("http://[::1]:80/v1").checked().unwrap();
        assert_eq!(with("https://host/v1").checked().is_ok(), cfg!(feature = "https"));
    }

    #[test]
    fn a_key_travels_in_the_open_only_where_that_is_said() {
        let mut config = with("http://10.0.0.7/v1");
        let uri = config.checked().unwrap();
        assert!(http::check_key_is_safe(&uri, config.plain_key).is_err());
        config.plain_key = PlainKey::Allowed;
        http::check_key_is_safe(&uri, config.plain_key).unwrap();
        for near in ["http://127.0.0.1:1/v1", "http://[::1]/v1", "http://LOCALHOST/v1"] {
            let config = with(near);
            http::check_key_is_safe(&config.checked().unwrap(), config.plain_key).unwrap();
        }
        assert!(!http::is_loopback(&"http://127.0.0.1.example.org/".parse().unwrap()));
    }

    #[test]
    fn times_are_checked() {
        for wrong in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e9] {
            let config = OpenAiConfig { timeout: wrong, ..OpenAiConfig::default() };
            assert!(config.checked().is_err(), "{wrong}");
        }
    }
}
