//! Frames: where one message ends and the next begins in a stream of bytes.
//!
//! `UnrealCV`: the magic number 0x9E2B83C1 and the length of the payload, both 32 bits and little-endian as its Python client
//! packs them, then the payload. The typed protocol: the length alone.

use thiserror::Error;

/// The first four bytes of every `UnrealCV` frame, as a little-endian number.
pub(super) const MAGIC: u32 = 0x9E2B_83C1;

/// Which frames a stream has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Framing {
    /// Magic number and length.
    UnrealCv,
    /// Length alone.
    Typed,
}

/// A stream that cannot be read any further.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum FrameError {
    /// It does not begin with the magic number.
    #[error("a frame begins with {found:#010x} instead of 0x9e2b83c1: the peer does not speak UnrealCV")]
    Magic {
        /// The first four bytes.
        found: u32,
    },
    /// A frame without payload.
    #[error("a frame is empty: every frame carries a message")]
    Empty,
    /// A frame longer than allowed.
    #[error("a frame of {length} bytes is longer than the {limit} allowed here: send less at once")]
    TooLong {
        /// What its header says.
        length: u32,
        /// The most that is taken.
        limit: usize,
    },
}

impl Framing {
    const fn header(self) -> usize {
        match self {
            Self::UnrealCv => 8,
            Self::Typed => 4,
        }
    }

    /// A frame around a payload.
    pub fn frame(self, payload: &[u8]) -> Vec<u8> {
        let mut frame = Vec::with_capacity(self.header() + payload.len());
        self.frame_into(payload, &mut frame);
        frame
    }

    /// Adds the frame around a payload to what is to be sent. Payloads stay below 2³² bytes: what is sent is bounded by
    /// [`Limits`](super::Limits).
    pub fn frame_into(self, payload: &[u8], out: &mut Vec<u8>) {
        if self == Self::UnrealCv {
            out.extend(MAGIC.to_le_bytes());
        }
        out.extend((payload.len() as u32).to_le_bytes());
        out.extend(payload);
    }
}

/// Cuts a stream into payloads, as bytes come in.
///
/// ```
/// use simworld_agents::remote::{Decoder, Framing};
/// let frame = Framing::UnrealCv.frame(b"0:vget /objects");
/// let mut decoder = Decoder::new(Framing::UnrealCv, 1024);
/// decoder.feed(&frame[..10]);
/// assert_eq!(decoder.next_frame(), Ok(None));
/// decoder.feed(&frame[10..]);
/// assert_eq!(decoder.next_frame(), Ok(Some(b"0:vget /objects".to_vec())));
/// ```
#[derive(Clone, Debug)]
pub struct Decoder {
    framing: Framing,
    limit: usize,
    buffer: Vec<u8>,
    /// Bytes of the buffer that were given out.
    taken: usize,
}

impl Decoder {
    /// For such frames, with payloads of at most `limit` bytes.
    pub fn new(framing: Framing, limit: usize) -> Self {
        Self { framing, limit, buffer: Vec::new(), taken: 0 }
    }

    /// Takes other payloads from now on, of at most `limit` bytes.
    pub fn set_limit(&mut self, limit: usize) {
        self.limit = limit;
    }

    /// Takes what came in. Feed what one read gave, then take every frame: nothing is kept but the one that is incomplete.
    pub fn feed(&mut self, bytes: &[u8]) {
        self.buffer.drain(..self.taken);
        self.taken = 0;
        self.buffer.extend_from_slice(bytes);
    }

    /// The next whole payload.
    ///
    /// # Errors
    /// The stream makes no sense from here on; it stays so.
    pub fn next_frame(&mut self) -> Result<Option<Vec<u8>>, FrameError> {
        let rest = &self.buffer[self.taken..];
        let word = |at: usize| rest.get(at..at + 4).and_then(|b| b.try_into().ok()).map(u32::from_le_bytes);
        if self.framing == Framing::UnrealCv
            && let Some(found) = word(0).filter(|found| *found != MAGIC)
        {
            return Err(FrameError::Magic { found });
        }
        let header = self.framing.header();
        let Some(length) = word(header - 4) else { return Ok(None) };
        if length == 0 {
            return Err(FrameError::Empty);
        }
        if length as usize > self.limit {
            return Err(FrameError::TooLong { length, limit: self.limit });
        }
        let Some(payload) = rest.get(header..header + length as usize) else { return Ok(None) };
        let payload = payload.to_vec();
        self.taken += header + length as usize;
        Ok(Some(payload))
    }

    /// Whether a frame has begun that has not ended.
    pub fn is_inside(&self) -> bool {
        self.taken < self.buffer.len()
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn any_cut_gives_the_same_frames(
            payloads in prop::collection::vec(prop::collection::vec(any::<u8>(), 1..40), 0..8),
            cuts in prop::collection::vec(1_usize..30, 1..200),
            unreal in any::<bool>(),
        ) {
            let framing = if unreal { Framing::UnrealCv } else { Framing::Typed };
            let stream: Vec<u8> = payloads.iter().flat_map(|payload| framing.frame(payload)).collect();
            let (mut decoder, mut found, mut rest) = (Decoder::new(framing, 40), Vec::new(), &stream[..]);
            for cut in cuts.iter().cycle() {
                if rest.is_empty() { break; }
                let (now, later) = rest.split_at((*cut).min(rest.len()));
                decoder.feed(now);
                while let Some(frame) = decoder.next_frame().unwrap() { found.push(frame); }
                rest = later;
            }
            prop_assert_eq!(found, payloads);
            prop_assert!(!decoder.is_inside());
        }

        #[test]
        fn any_bytes_are_frames_or_an_error(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
            for framing in [Framing::UnrealCv, Framing::Typed] {
                let mut decoder = Decoder::new(framing, 64);
                decoder.feed(&bytes);
                while let Ok(Some(frame)) = decoder.next_frame() {
                    prop_assert!(!frame.is_empty() && frame.len() <= 64);
                }
            }
        }
    }

    #[test]
    fn what_makes_no_sense_is_said() {
        let mut decoder = Decoder::new(Framing::UnrealCv, 16);
        decoder.feed(b"GET / HTTP/1.1");
        assert_eq!(decoder.next_frame(), Err(FrameError::Magic { found: u32::from_le_bytes(*b"GET ") }));
        let mut decoder = Decoder::new(Framing::Typed, 16);
        decoder.feed(&u32::MAX.to_le_bytes());
        assert_eq!(decoder.next_frame(), Err(FrameError::TooLong { length: u32::MAX, limit: 16 }));
        let mut decoder = Decoder::new(Framing::Typed, 16);
        decoder.feed(&[0; 4]);
        assert_eq!(decoder.next_frame(), Err(FrameError::Empty));
    }
}
