//! Puts the key into a request behind every layer that could log it.
//!
//! The HTTP library's protocol layer writes the bytes of each header to the log at its finest level. So the request carries
//! stars of the key's length, and this transport replaces them in the buffer that goes to the socket (or to TLS).
//!
//! A server may send the key back, in a header that the library logs in plain words, say. So stars take its place again in what comes in,
//! before anything reads it. The head of an answer waits in the buffer until all of it is there, and a key in it is found however it comes. Of a
//! body in pieces, one part of a key may be read and logged, at the finest level, before the next is there.

use std::sync::Arc;

use ureq::Error;
use ureq::unversioned::transport::{Buffers, ConnectionDetails, Connector, NextTimeout, Transport};

use super::key::ApiKey;

/// Wraps every connection of an agent.
#[derive(Debug)]
pub(crate) struct KeyedConnector {
    key: Option<Arc<ApiKey>>,
}

impl KeyedConnector {
    pub(crate) fn new(key: Option<Arc<ApiKey>>) -> Self {
        Self { key }
    }
}

impl<In: Transport> Connector<In> for KeyedConnector {
    type Out = KeyedTransport<In>;

    fn connect(
        &self,
        _details: &ConnectionDetails<'_>,
        chained: Option<In>,
    ) -> Result<Option<Self::Out>, Error> {
        Ok(chained.map(|inner| KeyedTransport { inner, key: self.key.clone() }))
    }
}

/// A connection that fills in the key.
#[derive(Debug)]
pub(crate) struct KeyedTransport<In> {
    inner: In,
    key: Option<Arc<ApiKey>>,
}

impl<In: Transport> Transport for KeyedTransport<In> {
    fn buffers(&mut self) -> &mut dyn Buffers {
        self.inner.buffers()
    }

    fn transmit_output(&mut self, amount: usize, timeout: NextTimeout) -> Result<(), Error> {
        if let Some(key) = &self.key {
            fill_in(&mut self.inner.buffers().output()[..amount], key);
        }
        self.inner.transmit_output(amount, timeout)
    }

    fn await_input(&mut self, timeout: NextTimeout) -> Result<bool, Error> {
        let awaited = self.inner.await_input(timeout);
        if let Some(key) = &self.key {
            take_out(self.inner.buffers(), key);
        }
        awaited
    }

    fn is_open(&mut self) -> bool {
        self.inner.is_open()
    }

    fn is_tls(&self) -> bool {
        self.inner.is_tls()
    }
}

/// Only a whole header line is replaced. A body never holds one: JSON writes no bare line ends, whatever stands in a prompt.
fn fill_in(output: &mut [u8], key: &ApiKey) {
    let line = format!("\r\nauthorization: {}\r\n", key.stand_in());
    let Some(at) = output.windows(line.len()).position(|window| window.eq_ignore_ascii_case(line.as_bytes()))
    else {
        return;
    };
    let end = at + line.len() - "\r\n".len();
    output[end - key.revealed().len()..end].copy_from_slice(key.revealed());
}

/// Puts stars in the place of a key that came in and was not read yet.
fn take_out(buffers: &mut dyn Buffers, key: &ApiKey) {
    let Some(clean) = covered(buffers.input(), key) else { return };
    // A buffer of input is written to at its end only: all that waits in it is taken out and put back, for which it has room.
    buffers.input_consume(clean.len());
    if let Some(room) = buffers.input_append_buf().get_mut(..clean.len()) {
        room.copy_from_slice(&clean);
        buffers.input_appended(clean.len());
    }
}

/// The bytes with stars in the place of the key, as many as it is long, since lengths were told already; none if it is not there.
fn covered(bytes: &[u8], key: &ApiKey) -> Option<Vec<u8>> {
    let mut clean: Option<Vec<u8>> = None;
    for writing in key.writings() {
        let mut from = 0;
        loop {
            let rest = &clean.as_deref().unwrap_or(bytes)[from..];
            let found = rest.windows(writing.len()).position(|window| window == writing.as_bytes());
            let Some(at) = found.map(|at| from + at) else { break };
            from = at + writing.len();
            clean.get_or_insert_with(|| bytes.to_vec())[at..from].fill(b'*');
        }
    }
    clean
}

#[cfg(test)]
mod tests {
    use ureq::unversioned::transport::LazyBuffers;

    use super::*;

    /// What can be read of some bytes that come in two pieces, if nothing is read of the first alone.
    fn received(whole: &[u8], cut: usize, key: &ApiKey) -> Vec<u8> {
        let mut buffers = LazyBuffers::new(1024, 1024);
        for piece in [&whole[..cut], &whole[cut..]] {
            buffers.input_append_buf()[..piece.len()].copy_from_slice(piece);
            buffers.input_appended(piece.len());
            take_out(&mut buffers, key);
            // who makes nothing of the input says so, and waits for more
            buffers.input_consume(0);
        }
        buffers.input().to_vec()
    }

    #[test]
    fn a_key_that_comes_back_is_covered_wherever_it_is_cut() {
        let key = ApiKey::new("sk-ab/secret").unwrap();
        let whole = b"server: sk-ab/secret\r\nx: sk-ab\\/secretsk-ab/secret\r\n\r\nsk-ab/secre";
        let clean = b"server: ************\r\nx: *************************\r\n\r\nsk-ab/secre";
        assert_eq!(whole.len(), clean.len(), "a body is as long as it was said to be");
        for cut in 0..=whole.len() {
            assert_eq!(received(whole, cut, &key), clean, "cut at {cut}");
        }
        let plain = b"HTTP/1.1 200 OK\r\n\r\nnothing of it";
        assert_eq!(received(plain, 9, &key), plain);
    }

    #[test]
    fn the_key_goes_into_the_header_and_nowhere_else() {
        let key = ApiKey::new("sk-secret-key").unwrap();
        let stars = key.stand_in().to_owned();
        let mut head = format!("POST /v1 HTTP/1.1\r\nauthorization: {stars}\r\nhost: h\r\n\r\n").into_bytes();
        fill_in(&mut head, &key);
        assert_eq!(head, b"POST /v1 HTTP/1.1\r\nauthorization: Bearer sk-secret-key\r\nhost: h\r\n\r\n");

        let prompt = format!("\r\nauthorization: {stars}\r\n");
        let body = serde_json::to_vec(&serde_json::json!({"content": prompt})).unwrap();
        let mut sent = body.clone();
        fill_in(&mut sent, &key);
        assert_eq!(sent, body);
    }
}
