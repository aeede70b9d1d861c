//! The protocol: bodies that are sent, and answers that are read.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde::Deserialize;
use serde_json::{Value, json};

use super::config::{HunyuanConfig, HunyuanVersion, Texture};
use super::error::HunyuanError;
use crate::generation::AssetPrompt;

/// The most characters of an answer that an error keeps.
const KEPT: usize = 200;

/// The most bytes of an answer that are looked at for an error.
const ERROR_BODY: usize = 64 * 1024;

/// The most bytes of a picture.
const LARGEST_IMAGE: usize = 16 << 20;

/// The body of `/send` and `/generate`.
pub(super) fn body(
    prompt: &AssetPrompt,
    words: &str,
    config: &HunyuanConfig,
) -> Result<Vec<u8>, HunyuanError> {
    let mut body = json!({
        // Their range, and that of the generators of random numbers behind them.
        "seed": prompt.seed % (1 << 32),
        "octree_resolution": config.octree_resolution,
        "num_inference_steps": config.num_inference_steps,
        "guidance_scale": config.guidance_scale,
        "texture": config.texture == Texture::Painted,
        "face_count": config.face_count,
    });
    if config.version == HunyuanVersion::V2_0 {
        body["type"] = json!("glb");
    }
    match &prompt.image {
        Some(image) if image.len() > LARGEST_IMAGE => {
            return Err(HunyuanError::BadImage("is larger than 16 MB: give a smaller one"));
        }
        Some(image) if !(image.starts_with(b"\x89PNG") || image.starts_with(&[0xFF, 0xD8, 0xFF])) => {
            return Err(HunyuanError::BadImage("is neither PNG nor JPEG: give one of both"));
        }
        Some(image) => body["image"] = Value::String(STANDARD.encode(image)),
        None if config.version == HunyuanVersion::V2_1 => return Err(HunyuanError::NeedsImage),
        None => body["text"] = json!(words),
    }
    Ok(body.to_string().into_bytes())
}

/// How far a job is.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum State {
    Working,
    Done(Vec<u8>),
    Failed(String),
}

#[derive(Deserialize)]
struct Sent {
    uid: String,
}

#[derive(Deserialize)]
struct Status {
    #[serde(rename = "status")]
    word: String,
    #[serde(default)]
    model_base64: Option<String>,
    #[serde(default)]
    message: Option<String>,
}

/// Takes secrets out of what a server says, before it is cut.
pub(super) type Clean<'a> = &'a dyn Fn(&str) -> String;

/// The job that `/send` has begun. Its name goes into an address: nothing but letters, digits and dashes.
pub(super) fn uid(answer: &[u8], clean: Clean<'_>) -> Result<String, HunyuanError> {
    let sent: Sent = read(answer, clean)?;
    let is_plain = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
    if sent.uid.is_empty() || sent.uid.len() > 64 || !sent.uid.chars().all(is_plain) {
        return Err(bad("its uid is no name of a job", answer, clean));
    }
    Ok(sent.uid)
}

/// What `/status` says of a job whose model may have so many bytes.
pub(super) fn state(answer: &[u8], most: u64, clean: Clean<'_>) -> Result<State, HunyuanError> {
    let status: Status = read(answer, clean)?;
    match status.word.as_str() {
        "processing" | "texturing" | "queued" => Ok(State::Working),
        "error" => {
            let said = status.message.unwrap_or_else(|| "it does not say why".to_owned());
            Ok(State::Failed(beginning(&clean(&said))))
        }
        "completed" => {
            let text = status
                .model_base64
                .ok_or_else(|| bad("it is completed and has no model_base64", answer, clean))?;
            if text.len() as u64 / 4 * 3 > most + 2 {
                return Err(HunyuanError::TooLarge { limit: most });
            }
            match STANDARD.decode(text.as_bytes()) {
                Ok(model) => Ok(State::Done(model)),
                Err(error) => Err(bad(&format!("model_base64 is damaged: {error}"), answer, clean)),
            }
        }
        _ => Err(bad("its status is none of the protocol", answer, clean)),
    }
}

/// What a server says about a failure: `text` or `message` or `detail` of its JSON, or its bytes.
pub(super) fn said(answer: &[u8], clean: Clean<'_>) -> String {
    let value: Value = serde_json::from_slice(answer).unwrap_or_default();
    let text = ["text", "message", "error", "detail"].into_iter().find_map(|name| value.get(name));
    match text {
        Some(Value::String(text)) => beginning(&clean(text)),
        Some(other) => beginning(&clean(&other.to_string())),
        None => beginning(&clean(&String::from_utf8_lossy(answer))),
    }
}

fn read<'a, T: Deserialize<'a>>(answer: &'a [u8], clean: Clean<'_>) -> Result<T, HunyuanError> {
    serde_json::from_slice(answer).map_err(|error| bad(&error.to_string(), answer, clean))
}

fn bad(reason: &str, answer: &[u8], clean: Clean<'_>) -> HunyuanError {
    // Enough for what is kept, with room for a secret that is taken out of it.
    let some = String::from_utf8_lossy(&answer[..answer.len().min(ERROR_BODY)]);
    HunyuanError::BadAnswer { reason: beginning(&clean(reason)), begin: beginning(&clean(&some)) }
}

fn beginning(text: &str) -> String {
    text.chars().filter(|c| !c.is_control()).take(KEPT).collect()
}
