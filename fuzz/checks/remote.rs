//! What clients send: any bytes are frames or an error, and any frame a hello, a call, a line, or an error.

use simworld_agents::remote::typed::{read_call, read_hello, read_message, read_welcome};
use simworld_agents::remote::unrealcv::{check_command, read_line};
use simworld_agents::remote::{Decoder, Framing};

pub(crate) fn check(data: &[u8]) {
    let (cut, data) = data.split_first().unwrap_or((&0, data));
    for framing in [Framing::UnrealCv, Framing::Typed] {
        let mut decoder = Decoder::new(framing, 1 << 16);
        for piece in data.chunks(usize::from(*cut).max(1)) {
            decoder.feed(piece);
            while let Ok(Some(frame)) = decoder.next_frame() {
                assert!(!frame.is_empty() && frame.len() <= 1 << 16);
                look(&frame);
            }
        }
    }
    // The contents of a frame, without the luck that a frame takes.
    look(data);
}

fn look(payload: &[u8]) {
    if let Ok((_, command)) = read_line(payload) {
        let _ = check_command(command);
    }
    let _ = (read_hello(payload), read_welcome(payload), read_message(payload));
    if let Ok(call) = read_call(payload) {
        // What was understood can be said again.
        let again = postcard::to_stdvec(&call).expect("calls are plain data");
        assert!(read_call(&again).is_ok());
    }
}
