//! Puts the key into a request behind every layer that could log it.
//!
//! The HTTP library's protocol layer writes the bytes of each header to the log at its finest level. So the request carries
//! stars of the key's length, and this transport replaces them in the buffer that goes to the socket (or to TLS).

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
        self.inner.await_input(timeout)
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

#[cfg(test)]
mod tests {
    use super::*;

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
