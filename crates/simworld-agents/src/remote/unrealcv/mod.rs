#![doc = include_str!("commands.md")]

mod act;
mod answer;
mod assets;
mod command;
mod convert;
mod desk;
mod errand;
mod image;
mod manage;
mod names;
mod objects;
mod signals;
mod tally;
mod views;

use std::fmt::Display;

pub(super) use desk::Desk;

use super::Token;
use super::link::Link;
use super::reader::Greeting;

/// A line as it comes: its number, as it was written, and the command.
///
/// ```
/// use simworld_agents::remote::unrealcv::read_line;
/// assert_eq!(read_line(b"17:vget /objects"), Ok(("17", "vget /objects")));
/// assert!(read_line(b"vget /objects").is_err());
/// ```
///
/// # Errors
/// It has no number of up to twenty digits before a colon, or is not UTF-8.
pub fn read_line(payload: &[u8]) -> Result<(&str, &str), LineError> {
    let text = std::str::from_utf8(payload).map_err(|_| LineError)?;
    let (number, command) = text.split_once(':').ok_or(LineError)?;
    let is_number = (1..=20).contains(&number.len()) && number.bytes().all(|byte| byte.is_ascii_digit());
    if is_number { Ok((number, command)) } else { Err(LineError) }
}

/// Whether the command is one of the table, with arguments of the right kinds.
///
/// # Errors
/// What is wrong with it, as clients are told.
pub fn check_command(command: &str) -> Result<(), String> {
    command::parse(command).map(|_| ()).map_err(|failed| failed.to_string())
}

/// A payload that is no request.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("Malformat raw message: a request is a number, a colon and a command, in UTF-8")]
pub struct LineError;

/// The first message to a client.
pub(super) fn greeting(name: &str) -> Vec<u8> {
    format!("connected to {name}").into_bytes()
}

/// What a client is told that is not let in, or whose stream makes no sense.
pub(super) fn farewell(reason: &dyn Display) -> Vec<u8> {
    format!("error {reason}").into_bytes()
}

/// Answers a client that has to show the token first.
pub(super) fn greet(payload: &[u8], token: Option<&Token>, link: &Link) -> Greeting {
    let Ok((number, command)) = read_line(payload) else {
        link.send(&farewell(&LineError));
        return Greeting::Refused;
    };
    let shown = command.strip_prefix("vset /unrealcv/auth ").map(str::trim);
    let (greeting, text) = match (shown, token) {
        (Some(shown), Some(token)) if token.is(shown.as_bytes()) => {
            (Greeting::Welcome, "Authentication succeeded")
        }
        (Some(_), _) => (Greeting::Again, "error Authentication failed"),
        (None, _) => (Greeting::Again, "error Authentication required, use: vset /unrealcv/auth <token>"),
    };
    link.send(format!("{number}:{text}").as_bytes());
    greeting
}
