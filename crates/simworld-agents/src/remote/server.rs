//! The server: its listeners, its threads, and its end.

use std::collections::BTreeMap;
use std::io::{ErrorKind, Write};
use std::net::{SocketAddr, TcpListener, TcpStream};
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::thread::JoinHandle;
use std::time::Duration;

use super::clock::span;
use super::engine::Engine;
use super::frame::Framing;
use super::hub::Hub;
use super::link::Link;
pub use super::link::Parting;
use super::reader::serve_client;
use super::{RemoteError, ServerConfig, Stage, typed, unrealcv};

/// So often are new clients looked for.
const KNOCK: Duration = Duration::from_millis(5);

/// Listens for clients, and serves them a world.
pub struct Server {
    config: Arc<ServerConfig>,
    hub: Arc<Hub>,
    doors: Vec<Door>,
}

/// A listener and what is spoken there.
struct Door {
    listener: TcpListener,
    framing: Framing,
    address: SocketAddr,
}

/// Ends a server from any thread.
#[derive(Clone)]
pub struct Stopper(Arc<Hub>);

impl Stopper {
    /// Lets [`Server::run`] come to its end, after the step that it is at.
    pub fn stop(&self) {
        self.0.stop();
    }
}

/// What a server did.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Report {
    /// Requests that were answered.
    pub requests: u64,
    /// Steps that the world took.
    pub steps: u64,
    /// How many clients ended in what way.
    pub partings: BTreeMap<Parting, u64>,
}

impl Server {
    /// Begins to listen. Clients who come wait until the server [runs](Self::run).
    ///
    /// # Errors
    /// A setting out of range, an address that others reach without a token, or one that cannot be listened on.
    pub fn bind(config: ServerConfig) -> Result<Self, RemoteError> {
        config.validate()?;
        let mut doors = Vec::new();
        for (address, framing) in [(config.unrealcv, Framing::UnrealCv), (config.typed, Framing::Typed)] {
            let Some(address) = address else { continue };
            let open = || {
                let listener = TcpListener::bind(address)?;
                listener.set_nonblocking(true)?;
                let address = listener.local_addr()?;
                Ok(Door { listener, framing, address })
            };
            doors.push(open().map_err(|source| RemoteError::Bind { address, source })?);
        }
        let hub = Arc::new(Hub::new(&config.limits));
        Ok(Self { config: Arc::new(config), hub, doors })
    }

    /// Where clients of `UnrealCV` are listened for.
    pub fn unrealcv_address(&self) -> Option<SocketAddr> {
        self.address(Framing::UnrealCv)
    }

    /// Where clients of the typed protocol are listened for.
    pub fn typed_address(&self) -> Option<SocketAddr> {
        self.address(Framing::Typed)
    }

    /// What ends this server.
    pub fn stopper(&self) -> Stopper {
        Stopper(Arc::clone(&self.hub))
    }

    /// Serves the world until it is stopped, in this thread. When it returns, every connection is closed and every thread of
    /// the server has ended.
    ///
    /// # Errors
    /// The world cannot go on, or the thread that accepts clients cannot be started.
    pub fn run(self, stage: &mut dyn Stage) -> Result<Report, RemoteError> {
        let (config, hub, doors) = (self.config, self.hub, self.doors);
        let threads = Threads::start(&config, &hub, doors)?;
        let mut engine = Engine::new(stage, &hub, &config);
        let outcome = engine.run();
        let (requests, steps) = (engine.requests(), engine.steps());
        drop(threads);
        outcome?;
        Ok(Report { requests, steps, partings: hub.partings() })
    }

    fn address(&self, framing: Framing) -> Option<SocketAddr> {
        self.doors.iter().find(|door| door.framing == framing).map(|door| door.address)
    }
}

/// The threads beside the world's; dropped, they have ended.
struct Threads {
    hub: Arc<Hub>,
    porter: Option<JoinHandle<()>>,
}

impl Threads {
    fn start(config: &Arc<ServerConfig>, hub: &Arc<Hub>, doors: Vec<Door>) -> Result<Self, RemoteError> {
        let (config, own) = (Arc::clone(config), Arc::clone(hub));
        let porter = std::thread::Builder::new()
            .name("remote-porter".to_owned())
            .spawn(move || Porter { config, hub: own, doors, clients: Vec::new() }.keep())
            .map_err(RemoteError::Thread)?;
        Ok(Self { hub: Arc::clone(hub), porter: Some(porter) })
    }
}

impl Drop for Threads {
    fn drop(&mut self) {
        self.hub.stop();
        self.hub.dismiss();
        if let Some(porter) = self.porter.take() {
            // A thread that panicked has ended too.
            let _ = porter.join();
        }
    }
}

/// Lets clients in.
struct Porter {
    config: Arc<ServerConfig>,
    hub: Arc<Hub>,
    doors: Vec<Door>,
    clients: Vec<JoinHandle<()>>,
}

impl Porter {
    fn keep(mut self) {
        while !self.hub.is_stopping() {
            let mut came = false;
            for index in 0..self.doors.len() {
                let door = &self.doors[index];
                match door.listener.accept() {
                    Ok((socket, _)) => {
                        came = true;
                        let framing = door.framing;
                        self.admit(socket, framing);
                    }
                    Err(error) if error.kind() == ErrorKind::WouldBlock => {}
                    // One who left before it was let in, or no more sockets: the others go on.
                    Err(_) => {}
                }
            }
            self.reap();
            if !came {
                std::thread::sleep(KNOCK);
            }
        }
        for client in self.clients.drain(..) {
            let _ = client.join();
        }
    }

    /// Forgets the threads of clients who left.
    fn reap(&mut self) {
        for index in (0..self.clients.len()).rev() {
            if self.clients[index].is_finished() {
                let _ = self.clients.swap_remove(index).join();
            }
        }
    }

    fn admit(&mut self, socket: TcpStream, framing: Framing) {
        let limits = &self.config.limits;
        if self.hub.present.load(Ordering::SeqCst) >= limits.clients {
            turn_away(&socket, framing, limits.clients);
            self.hub.count(Parting::Crowded);
            return;
        }
        let set_up = socket
            .set_nonblocking(false)
            .and_then(|()| socket.set_nodelay(true))
            .and_then(|()| socket.set_write_timeout(Some(span(limits.write_seconds))));
        if set_up.is_err() {
            return;
        }
        let link = Arc::new(Link::new(socket, framing, limits));
        let (hub, config) = (Arc::clone(&self.hub), Arc::clone(&self.config));
        self.hub.present.fetch_add(1, Ordering::SeqCst);
        let thread = std::thread::Builder::new().name("remote-client".to_owned()).spawn(move || {
            attend(&hub, &link, &config);
            hub.present.fetch_sub(1, Ordering::SeqCst);
        });
        if let Ok(thread) = thread {
            self.clients.push(thread);
        } else {
            self.hub.present.fetch_sub(1, Ordering::SeqCst);
            self.hub.count(Parting::Crowded);
        }
    }
}

/// Reads from a client in this thread while another one writes to it.
fn attend(hub: &Hub, link: &Arc<Link>, config: &ServerConfig) {
    let own = Arc::clone(link);
    let writer = std::thread::Builder::new().name("remote-writer".to_owned()).spawn(move || own.write_out());
    let Ok(writer) = writer else {
        hub.count(Parting::Crowded);
        return;
    };
    serve_client(hub, link, config);
    let _ = writer.join();
}

/// Says why, if that can be said at once.
fn turn_away(socket: &TcpStream, framing: Framing, most: usize) {
    let reason = format!("there are {most} clients already: come back when one has left");
    let payload = match framing {
        Framing::UnrealCv => unrealcv::farewell(&reason),
        Framing::Typed => typed::farewell(&reason),
    };
    if socket.set_nonblocking(true).is_ok() {
        let mut socket = socket;
        let _ = socket.write(&framing.frame(&payload));
    }
}
