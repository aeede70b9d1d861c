//! The Rust client of the typed protocol.

use std::collections::VecDeque;
use std::io::{ErrorKind, Read, Write};
use std::net::{SocketAddr, TcpStream};

use simworld_core::clock::Tick;
use simworld_core::command::Command;
use simworld_core::hash::StateDigest;
use simworld_core::id::EntityId;
use simworld_core::scene::EntityDesc;
use thiserror::Error;

use super::hello::{FRAMING, HelloError, Welcome, hello, read_welcome};
use super::message::{
    Answer, Call, CameraInfo, Description, Done, Message, MessageError, Refusal, Request, read_message,
};
use crate::remote::clock::span;
use crate::remote::frame::Decoder;
use crate::remote::watch::{Found, Observation, Query};
use crate::remote::{CameraPlace, FrameError, Pace, Picture, PictureKind, RemoteError, Token};

/// Observations that are kept until somebody asks for them; older ones are let go.
const MOST_KEPT: usize = 1024;

/// Why the server could not be asked, or did not do it.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ClientError {
    /// It is not there, it left, or it takes too long.
    #[error("the connection to {address}: {source}")]
    Connection {
        /// Where.
        address: SocketAddr,
        /// What happened.
        source: std::io::Error,
    },
    /// A setting out of range.
    #[error(transparent)]
    Setting(#[from] RemoteError),
    /// It does not let this client in.
    #[error(transparent)]
    Hello(#[from] HelloError),
    /// What it sends are no frames.
    #[error(transparent)]
    Frame(#[from] FrameError),
    /// What it sends are no messages.
    #[error(transparent)]
    Message(#[from] MessageError),
    /// It refused a request.
    #[error(transparent)]
    Refused(#[from] Refusal),
    /// A command was impossible.
    #[error("the command had no effect: {0}")]
    Command(String),
    /// It answered something else.
    #[error("the server answered something else than was asked: it is another version, or damaged")]
    Unexpected,
}

/// Settings of a client.
#[derive(Clone, Debug)]
pub struct ClientConfig {
    /// What the server has to be shown.
    pub token: Option<Token>,
    /// How long an answer may take, 0.001 to 86400 s.
    pub timeout_seconds: f64,
    /// The longest message that is taken, bytes.
    pub frame_bytes: usize,
}

impl Default for ClientConfig {
    /// No token, a minute, 256 MiB.
    fn default() -> Self {
        Self { token: None, timeout_seconds: 60.0, frame_bytes: 256 << 20 }
    }
}

/// A connection to a [`Server`](crate::remote::Server). Calls are answered in their order; what is watched comes in between,
/// and waits for [`observation`](Self::observation).
pub struct Client {
    socket: TcpStream,
    address: SocketAddr,
    decoder: Decoder,
    welcome: Welcome,
    next: u64,
    chunk: Vec<u8>,
    /// Frames that were asked and not sent yet.
    outgoing: Vec<u8>,
    observations: VecDeque<Observation>,
}

impl Client {
    /// Connects with the default settings, and a token if the server wants one.
    ///
    /// # Errors
    /// There is no server, or it does not let this client in.
    pub fn connect(address: SocketAddr, token: Option<Token>) -> Result<Self, ClientError> {
        Self::connect_with(address, &ClientConfig { token, ..ClientConfig::default() })
    }

    /// Connects.
    ///
    /// # Errors
    /// A setting out of range; there is no server, or it does not let this client in.
    pub fn connect_with(address: SocketAddr, config: &ClientConfig) -> Result<Self, ClientError> {
        let value = config.timeout_seconds;
        if !(0.001..=86_400.0).contains(&value) {
            let allowed = "0.001 to 86400 s";
            return Err(RemoteError::Setting { field: "timeout_seconds", value, allowed }.into());
        }
        let timeout = span(value);
        let set_up = || {
            let socket = TcpStream::connect_timeout(&address, timeout)?;
            socket.set_nodelay(true)?;
            socket.set_read_timeout(Some(timeout))?;
            socket.set_write_timeout(Some(timeout))?;
            Ok(socket)
        };
        let mut client = Self {
            socket: set_up().map_err(|source| ClientError::Connection { address, source })?,
            address,
            decoder: Decoder::new(FRAMING, config.frame_bytes),
            welcome: Welcome { name: String::new(), capabilities: Vec::new(), frame_bytes: 0, steps: 0 },
            next: 1,
            chunk: vec![0; 256 << 10],
            outgoing: Vec::new(),
            observations: VecDeque::new(),
        };
        FRAMING.frame_into(&hello(config.token.as_ref()), &mut client.outgoing);
        client.flush()?;
        client.welcome = read_welcome(&client.read_frame()?)?;
        Ok(client)
    }

    /// What the server said of itself.
    pub fn welcome(&self) -> &Welcome {
        &self.welcome
    }

    /// What is served.
    ///
    /// # Errors
    /// As [`call`](Self::call).
    pub fn describe(&mut self) -> Result<Description, ClientError> {
        match self.call(Request::Describe)? {
            Answer::Description(description) => Ok(description),
            _ => Err(ClientError::Unexpected),
        }
    }

    /// Carries out a command before the next step; gives what it brought into the world.
    ///
    /// # Errors
    /// It was impossible, or as [`call`](Self::call).
    pub fn command(&mut self, command: Command) -> Result<Option<EntityId>, ClientError> {
        match self.submit(vec![command])?.pop() {
            Some(Done::Applied) => Ok(None),
            Some(Done::Spawned(id)) => Ok(Some(id)),
            Some(Done::Refused(reason)) => Err(ClientError::Command(reason)),
            None => Err(ClientError::Unexpected),
        }
    }

    /// Carries out commands before the next step, each by itself; says what each did.
    ///
    /// # Errors
    /// As [`call`](Self::call).
    pub fn submit(&mut self, commands: Vec<Command>) -> Result<Vec<Done>, ClientError> {
        let count = commands.len();
        match self.call(Request::Submit(commands))? {
            Answer::Submitted(done) if done.len() == count => Ok(done),
            _ => Err(ClientError::Unexpected),
        }
    }

    /// Lets the world take so many steps; gives the tick after them.
    ///
    /// # Errors
    /// As [`call`](Self::call).
    pub fn tick(&mut self, steps: u32) -> Result<Tick, ClientError> {
        match self.call(Request::Tick(steps))? {
            Answer::Ticked(tick) => Ok(tick),
            _ => Err(ClientError::Unexpected),
        }
    }

    /// Lets the world step so from now on.
    ///
    /// # Errors
    /// As [`call`](Self::call).
    pub fn set_pace(&mut self, pace: Pace) -> Result<(), ClientError> {
        self.expect_ok(Request::SetPace(pace))
    }

    /// What is there.
    ///
    /// # Errors
    /// As [`call`](Self::call).
    pub fn query(&mut self, query: Query) -> Result<Found, ClientError> {
        match self.call(Request::Query(query))? {
            Answer::Found(found) => Ok(found),
            _ => Err(ClientError::Unexpected),
        }
    }

    /// Everything about an entity; none if nobody has that id.
    ///
    /// # Errors
    /// As [`call`](Self::call).
    pub fn entity(&mut self, id: EntityId) -> Result<Option<EntityDesc>, ClientError> {
        match self.call(Request::Entity(id))? {
            Answer::Entity(desc) => Ok(desc.map(|desc| *desc)),
            _ => Err(ClientError::Unexpected),
        }
    }

    /// Has what is there sent after every so many steps.
    ///
    /// # Errors
    /// As [`call`](Self::call).
    pub fn watch(&mut self, query: Query, every: u32) -> Result<(), ClientError> {
        self.expect_ok(Request::Watch { query, every })
    }

    /// Has no more observations sent.
    ///
    /// # Errors
    /// As [`call`](Self::call).
    pub fn unwatch(&mut self) -> Result<(), ClientError> {
        self.expect_ok(Request::Unwatch)
    }

    /// The next observation; waits for it.
    ///
    /// # Errors
    /// None comes within the time allowed, or what comes makes no sense.
    pub fn observation(&mut self) -> Result<Observation, ClientError> {
        if let Some(observation) = self.observations.pop_front() {
            return Ok(observation);
        }
        match self.read_message()? {
            Message::Observation(observation) => Ok(observation),
            Message::Answer(..) => Err(ClientError::Unexpected),
        }
    }

    /// The cameras.
    ///
    /// # Errors
    /// As [`call`](Self::call).
    pub fn cameras(&mut self) -> Result<Vec<CameraInfo>, ClientError> {
        match self.call(Request::Cameras)? {
            Answer::Cameras(cameras) => Ok(cameras),
            _ => Err(ClientError::Unexpected),
        }
    }

    /// Adds a camera; gives its number.
    ///
    /// # Errors
    /// As [`call`](Self::call).
    pub fn add_camera(&mut self, place: CameraPlace) -> Result<u32, ClientError> {
        match self.call(Request::AddCamera(place))? {
            Answer::Camera(number) => Ok(number),
            _ => Err(ClientError::Unexpected),
        }
    }

    /// Changes a camera.
    ///
    /// # Errors
    /// As [`call`](Self::call).
    pub fn set_camera(&mut self, number: u32, place: CameraPlace) -> Result<(), ClientError> {
        self.expect_ok(Request::SetCamera(number, place))
    }

    /// What a camera sees now.
    ///
    /// # Errors
    /// As [`call`](Self::call).
    pub fn picture(&mut self, camera: u32, kind: PictureKind) -> Result<Picture, ClientError> {
        match self.call(Request::Picture(camera, kind))? {
            Answer::Picture(picture) if picture.is_whole() => Ok(picture),
            _ => Err(ClientError::Unexpected),
        }
    }

    /// The last digest of the state, and after which step; none before the first.
    ///
    /// # Errors
    /// As [`call`](Self::call).
    pub fn digest(&mut self) -> Result<Option<(Tick, StateDigest)>, ClientError> {
        match self.call(Request::Digest)? {
            Answer::Digest(digest) => Ok(digest),
            _ => Err(ClientError::Unexpected),
        }
    }

    /// Asks, and waits for the answer.
    ///
    /// # Errors
    /// The request is refused, the connection is lost, or nothing comes within the time allowed.
    pub fn call(&mut self, request: Request) -> Result<Answer, ClientError> {
        let id = self.send(request)?;
        self.flush()?;
        self.receive(id)
    }

    /// Asks without waiting: collect the answers by [`receive`](Self::receive) in the order of asking, after
    /// [`flush`](Self::flush). Gives the number of the call.
    ///
    /// # Errors
    /// The request cannot be written.
    pub fn send(&mut self, request: Request) -> Result<u64, ClientError> {
        let id = self.next;
        self.next += 1;
        let call = postcard::to_stdvec(&Call { id, request }).map_err(|_| MessageError::Call { id })?;
        FRAMING.frame_into(&call, &mut self.outgoing);
        Ok(id)
    }

    /// Sends what was asked.
    ///
    /// # Errors
    /// The connection is lost, or the server takes nothing within the time allowed.
    pub fn flush(&mut self) -> Result<(), ClientError> {
        let written = self.socket.write_all(&self.outgoing);
        self.outgoing.clear();
        written.map_err(|source| self.lost(source))
    }

    /// The answer to the call of that number, which has to be the first that is open.
    ///
    /// # Errors
    /// As [`call`](Self::call).
    pub fn receive(&mut self, id: u64) -> Result<Answer, ClientError> {
        loop {
            match self.read_message()? {
                Message::Answer(found, answer) if found == id => return Ok(answer?),
                Message::Answer(..) => return Err(ClientError::Unexpected),
                Message::Observation(observation) => {
                    if self.observations.len() == MOST_KEPT {
                        self.observations.pop_front();
                    }
                    self.observations.push_back(observation);
                }
            }
        }
    }

    fn expect_ok(&mut self, request: Request) -> Result<(), ClientError> {
        match self.call(request)? {
            Answer::Ok => Ok(()),
            _ => Err(ClientError::Unexpected),
        }
    }

    fn read_message(&mut self) -> Result<Message, ClientError> {
        let frame = self.read_frame()?;
        // In the middle of a conversation the server says only why it ends it.
        read_message(&frame).map_err(|error| match read_welcome(&frame) {
            Err(HelloError::Farewell(reason)) => HelloError::Farewell(reason).into(),
            _ => error.into(),
        })
    }

    fn read_frame(&mut self) -> Result<Vec<u8>, ClientError> {
        loop {
            if let Some(frame) = self.decoder.next_frame()? {
                return Ok(frame);
            }
            match self.socket.read(&mut self.chunk) {
                Ok(0) => return Err(self.lost(ErrorKind::UnexpectedEof.into())),
                Ok(count) => self.decoder.feed(&self.chunk[..count]),
                Err(error) if error.kind() == ErrorKind::Interrupted => {}
                Err(source) => return Err(self.lost(source)),
            }
        }
    }

    fn lost(&self, source: std::io::Error) -> ClientError {
        ClientError::Connection { address: self.address, source }
    }
}
