//! The first frame each way: versions, the token, and what the server can do. Its layout never changes.

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::remote::frame::Framing;
use crate::remote::link::Link;
use crate::remote::reader::Greeting;
use crate::remote::{ServerConfig, Token};

/// With these bytes every hello begins.
pub const SIGNATURE: [u8; 8] = *b"simworld";

/// The version of the messages. Any change of their layout is a new one.
pub const VERSION: u16 = 2;

/// The server lets the client in.
const WELCOME: u8 = 0;
/// The token is missing or wrong.
const REFUSED: u8 = 1;
/// The versions differ.
const OTHER_VERSION: u8 = 2;
/// The server says no for another reason.
const FAREWELL: u8 = 3;

/// What the server says of itself.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Welcome {
    /// What the client is connected to.
    pub name: String,
    /// What is understood beyond submitting commands and stepping, by name: `query`, `watch`, `cameras`, `pictures`, `digest`,
    /// `pace`.
    pub capabilities: Vec<String>,
    /// Bytes of a request.
    pub frame_bytes: u64,
    /// Steps that one request may ask for.
    pub steps: u32,
}

/// A hello that leads to nothing.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum HelloError {
    /// It does not begin with the signature.
    #[error("the peer does not speak simworld's typed protocol: check the address and the port")]
    Signature,
    /// It ends too early, or its welcome makes no sense.
    #[error("the hello is damaged")]
    Damaged,
    /// The server speaks another version.
    #[error(
        "the server speaks version {server} of the protocol and this client version {VERSION}: use the same release"
    )]
    Version {
        /// The server's.
        server: u16,
    },
    /// The token is missing or wrong.
    #[error("the server refuses the token: {0}")]
    Token(String),
    /// Anything else.
    #[error("the server says: {0}")]
    Farewell(String),
}

/// The hello of a client.
pub(super) fn hello(token: Option<&Token>) -> Vec<u8> {
    let mut hello = SIGNATURE.to_vec();
    hello.extend(VERSION.to_le_bytes());
    hello.extend(token.map(Token::bytes).unwrap_or_default());
    hello
}

/// The version and the token of a client's hello.
///
/// # Errors
/// It is none.
pub fn read_hello(payload: &[u8]) -> Result<(u16, &[u8]), HelloError> {
    let rest = payload.strip_prefix(&SIGNATURE).ok_or(HelloError::Signature)?;
    let (version, token) = rest.split_first_chunk().ok_or(HelloError::Damaged)?;
    Ok((u16::from_le_bytes(*version), token))
}

/// What the server answered to the hello.
///
/// # Errors
/// It does not let the client in, or its answer makes no sense.
pub fn read_welcome(payload: &[u8]) -> Result<Welcome, HelloError> {
    let rest = payload.strip_prefix(&SIGNATURE).ok_or(HelloError::Signature)?;
    let (version, rest) = rest.split_first_chunk().ok_or(HelloError::Damaged)?;
    let (status, rest) = rest.split_first().ok_or(HelloError::Damaged)?;
    let text = || String::from_utf8_lossy(rest).into_owned();
    match *status {
        WELCOME => postcard::from_bytes(rest).map_err(|_| HelloError::Damaged),
        REFUSED => Err(HelloError::Token(text())),
        OTHER_VERSION => Err(HelloError::Version { server: u16::from_le_bytes(*version) }),
        _ => Err(HelloError::Farewell(text())),
    }
}

/// Answers a hello.
pub(in crate::remote) fn greet(payload: &[u8], config: &ServerConfig, link: &Link) -> Greeting {
    let (greeting, status, body) = match read_hello(payload) {
        Err(error) => (Greeting::Refused, FAREWELL, error.to_string().into_bytes()),
        Ok((version, _)) if version != VERSION => (Greeting::Refused, OTHER_VERSION, Vec::new()),
        Ok((_, token)) if config.token.as_ref().is_some_and(|wanted| !wanted.is(token)) => {
            (Greeting::Refused, REFUSED, b"show the one that the server was started with".to_vec())
        }
        // A welcome is text and numbers, which postcard always takes.
        Ok(_) => match postcard::to_stdvec(&welcome(config)) {
            Ok(body) => (Greeting::Welcome, WELCOME, body),
            Err(error) => (Greeting::Refused, FAREWELL, error.to_string().into_bytes()),
        },
    };
    link.send(&reply(status, &body));
    greeting
}

/// What a client is told that is not let in, or whose stream makes no sense.
pub(in crate::remote) fn farewell(reason: &dyn std::fmt::Display) -> Vec<u8> {
    reply(FAREWELL, reason.to_string().as_bytes())
}

fn reply(status: u8, body: &[u8]) -> Vec<u8> {
    let mut reply = SIGNATURE.to_vec();
    reply.extend(VERSION.to_le_bytes());
    reply.push(status);
    reply.extend(body);
    reply
}

fn welcome(config: &ServerConfig) -> Welcome {
    let capabilities = ["query", "watch", "cameras", "pictures", "digest", "pace"];
    Welcome {
        name: config.name.clone(),
        capabilities: capabilities.map(str::to_owned).to_vec(),
        frame_bytes: config.limits.frame_bytes as u64,
        steps: config.limits.steps,
    }
}

/// The framing of this protocol.
pub(super) const FRAMING: Framing = Framing::Typed;

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn hellos_are_read_back() {
        let token = Token::new("sixteen-bytes-or-more").unwrap();
        assert_eq!(read_hello(&hello(Some(&token))), Ok((VERSION, &b"sixteen-bytes-or-more"[..])));
        let told = welcome(&ServerConfig::default());
        let bytes = reply(WELCOME, &postcard::to_stdvec(&told).unwrap());
        assert_eq!(read_welcome(&bytes), Ok(told));
    }

    #[test]
    fn another_version_is_named() {
        let mut bytes = reply(OTHER_VERSION, &[]);
        bytes[8..10].copy_from_slice(&7_u16.to_le_bytes());
        assert_eq!(read_welcome(&bytes), Err(HelloError::Version { server: 7 }));
    }

    proptest! {
        #[test]
        fn any_bytes_are_a_hello_or_an_error(bytes in prop::collection::vec(any::<u8>(), 0..64)) {
            let signed: Vec<u8> = SIGNATURE.iter().chain(&bytes).copied().collect();
            let _ = (read_hello(&bytes), read_welcome(&bytes), read_welcome(&signed));
            prop_assert_eq!(read_hello(&signed).is_ok(), bytes.len() >= 2);
        }
    }
}
