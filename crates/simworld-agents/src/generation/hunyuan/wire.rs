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

/// The most bytes of a shape.
const LARGEST_MESH: usize = 64 << 20;

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
    if config.version == HunyuanVersion::V2_1 {
        fits_newer(prompt)?;
    }
    if prompt.image.is_some() && !prompt.views.is_empty() {
        return Err(HunyuanError::BadImage(
            "is given beside others from its sides: give the one or the others",
        ));
    }
    if let Some(image) = &prompt.image {
        body["image"] = encoded(image)?;
    }
    for (side, image) in prompt.views.iter() {
        body[format!("image_{side}")] = encoded(image)?;
    }
    if prompt.image.is_none() && prompt.views.is_empty() {
        body["text"] = json!(words);
    }
    if let Some(mesh) = &prompt.mesh {
        body["mesh"] = shape(mesh)?;
    }
    Ok(body.to_string().into_bytes())
}

/// What 2.1 has no field for: it takes one picture, and needs it.
fn fits_newer(prompt: &AssetPrompt) -> Result<(), HunyuanError> {
    match prompt {
        _ if !prompt.views.is_empty() => Err(HunyuanError::NotInProtocol("pictures from several sides")),
        _ if prompt.mesh.is_some() => Err(HunyuanError::NotInProtocol("shape to paint")),
        AssetPrompt { image: None, .. } => Err(HunyuanError::NeedsImage),
        _ => Ok(()),
    }
}

/// A picture as it is sent.
fn encoded(image: &[u8]) -> Result<Value, HunyuanError> {
    if image.len() > LARGEST_IMAGE {
        return Err(HunyuanError::BadImage("is larger than 16 MB: give a smaller one"));
    }
    if !(image.starts_with(b"\x89PNG") || image.starts_with(&[0xFF, 0xD8, 0xFF])) {
        return Err(HunyuanError::BadImage("is neither PNG nor JPEG: give one of both"));
    }
    Ok(Value::String(STANDARD.encode(image)))
}

/// A shape as it is sent.
fn shape(mesh: &[u8]) -> Result<Value, HunyuanError> {
    if mesh.len() > LARGEST_MESH {
        return Err(HunyuanError::BadMesh("is larger than 64 MB: give one of fewer triangles"));
    }
    if !mesh.starts_with(b"glTF") {
        return Err(HunyuanError::BadMesh("is no GLB file: give one"));
    }
    Ok(Value::String(STANDARD.encode(mesh)))
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generation::ViewImages;

    const PNG: &[u8] = b"\x89PNG, as far as the client looks";
    const JPEG: &[u8] = &[0xFF, 0xD8, 0xFF, 0xE0];
    const GLB: &[u8] = b"glTF, as far as the client looks";

    fn asked(version: HunyuanVersion, prompt: &AssetPrompt) -> Result<Value, HunyuanError> {
        let config = HunyuanConfig { version, ..HunyuanConfig::default() };
        body(prompt, &prompt.words, &config).map(|body| serde_json::from_slice(&body).unwrap())
    }

    fn of_sides() -> AssetPrompt {
        let views =
            ViewImages { front: Some(PNG.to_vec()), back: Some(JPEG.to_vec()), ..ViewImages::default() };
        AssetPrompt { views, ..AssetPrompt::new("a bench").seeded((1 << 32) + 7) }
    }

    #[test]
    fn pictures_from_the_sides_are_sent_each_by_its_name() {
        let sent = asked(HunyuanVersion::V2_0, &of_sides()).unwrap();
        let wanted = json!({
            "type": "glb", "seed": 7, "octree_resolution": 256, "num_inference_steps": 5, "guidance_scale": 5.0,
            "texture": false, "face_count": 40_000, "image_front": STANDARD.encode(PNG),
            "image_back": STANDARD.encode(JPEG),
        });
        assert_eq!(sent, wanted, "no words, and no side that nobody gave");
        let all = ViewImages { left: Some(PNG.to_vec()), right: Some(PNG.to_vec()), ..of_sides().views };
        let sent = asked(HunyuanVersion::V2_0, &AssetPrompt { views: all, ..of_sides() }).unwrap();
        for side in ["image_front", "image_left", "image_back", "image_right"] {
            assert!(sent.get(side).is_some(), "{side}");
        }
    }

    #[test]
    fn a_shape_is_sent_with_what_is_said_or_shown_of_it() {
        let of_words = AssetPrompt { mesh: Some(GLB.to_vec()), ..AssetPrompt::new("a bench") };
        let sent = asked(HunyuanVersion::V2_0, &of_words).unwrap();
        assert_eq!((&sent["mesh"], &sent["text"]), (&json!(STANDARD.encode(GLB)), &json!("a bench")));
        let shown = AssetPrompt { image: Some(PNG.to_vec()), ..of_words };
        let sent = asked(HunyuanVersion::V2_0, &shown).unwrap();
        assert_eq!((&sent["image"], sent.get("text")), (&json!(STANDARD.encode(PNG)), None));
        assert!(sent.get("mesh").is_some());
    }

    #[test]
    fn what_is_none_or_has_no_field_is_not_sent() {
        let both = AssetPrompt { image: Some(PNG.to_vec()), ..of_sides() };
        assert!(matches!(asked(HunyuanVersion::V2_0, &both), Err(HunyuanError::BadImage(_))));
        let gif = ViewImages { right: Some(b"GIF89a".to_vec()), ..ViewImages::default() };
        let gif = AssetPrompt { views: gif, ..AssetPrompt::new("a bench") };
        assert!(matches!(asked(HunyuanVersion::V2_0, &gif), Err(HunyuanError::BadImage(_))));
        let no_mesh = AssetPrompt { mesh: Some(b"solid".to_vec()), ..AssetPrompt::new("a bench") };
        assert!(matches!(asked(HunyuanVersion::V2_0, &no_mesh), Err(HunyuanError::BadMesh(_))));
        for prompt in [of_sides(), AssetPrompt { image: Some(PNG.to_vec()), ..no_mesh }] {
            let refused = asked(HunyuanVersion::V2_1, &prompt);
            assert!(matches!(refused, Err(HunyuanError::NotInProtocol(_))), "{refused:?}");
        }
        let words = AssetPrompt::new("a bench");
        assert!(matches!(asked(HunyuanVersion::V2_1, &words), Err(HunyuanError::NeedsImage)));
    }
}
