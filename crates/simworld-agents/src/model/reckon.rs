//! What a request will take, before a server has counted it.

use super::{ChatRequest, Part};

/// Tokens of a picture, where nobody has counted: what OpenAI's guide to vision gives for one of 2048 by 4096 pixels (765
/// for one of 1024 by 1024).
const PICTURE: u64 = 1105;

/// Tokens that a chat template puts around a message; the templates in use take from 3 to 12.
const AROUND: u64 = 16;

/// About how many tokens that many bytes of text are: one for every three bytes begun, where English has one for four.
pub(super) fn reckoned_tokens(bytes: usize) -> u64 {
    (bytes as u64).div_ceil(3)
}

/// About how many tokens a request's prompt is.
pub(super) fn reckoned_prompt(request: &ChatRequest) -> u64 {
    let (bytes, pictures) = contents(request);
    reckoned_tokens(bytes) + pictures * PICTURE
}

/// More tokens than a request's prompt can be: no tokenizer in use makes more than one token of a byte.
pub(super) fn most_prompt(request: &ChatRequest) -> u64 {
    let (bytes, pictures) = contents(request);
    let messages = request.messages.len() as u64 + 1;
    (bytes as u64).saturating_add(pictures * 2 * PICTURE).saturating_add(messages * AROUND)
}

/// Bytes of text, and the number of pictures.
fn contents(request: &ChatRequest) -> (usize, u64) {
    let mut bytes = 0;
    let mut pictures = 0;
    for part in request.messages.iter().flat_map(|message| &message.content) {
        match part {
            Part::Text(text) => bytes += text.len(),
            Part::Image(_) => pictures += 1,
            Part::ToolCall(call) => bytes += call.name.len() + call.arguments.to_string().len(),
            Part::ToolResult { call, text } => bytes += call.len() + text.len(),
        }
    }
    for tool in &request.tools {
        bytes += tool.name.len() + tool.description.len() + tool.parameters.to_string().len();
    }
    bytes += request.schema.as_ref().map_or(0, |schema| schema.name.len() + schema.json.to_string().len());
    (bytes, pictures)
}
