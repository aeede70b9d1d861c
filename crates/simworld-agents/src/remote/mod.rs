//! Worlds served over TCP: to clients of `UnrealCV` by the released command set, and to programs by a typed protocol.
//!
//! A [`Server`] owns the listeners, and reads and writes in threads of its own; the world stays with the thread that calls
//! [`Server::run`], behind the trait [`Stage`]. Whatever a client changes is a [`Command`](simworld_core::command::Command)
//! that takes effect between two steps and is recorded, so a session replays to the same digests
//! ([`SimulationStage::recording`]).
//!
//! ```
//! use simworld_agents::remote::{Client, Server, ServerConfig, SimulationStage};
//! use simworld_core::command::Command;
//! use simworld_core::geometry::Pose;
//! use simworld_core::scene::{EntityDesc, EntityKind, Shape, World};
//! use simworld_core::simulation::Simulation;
//!
//! let server = Server::bind(ServerConfig::on_free_ports())?;
//! let (address, stopper) = (server.typed_address().unwrap(), server.stopper());
//! let client = std::thread::spawn(move || -> Result<(), simworld_agents::remote::ClientError> {
//!     let mut client = Client::connect(address, None)?;
//!     let cone = EntityDesc::new(EntityKind::Cone, Pose::identity(), Shape::Cylinder { radius: 0.2, height: 0.7 });
//!     client.command(Command::Spawn(Box::new(cone)))?;
//!     assert_eq!(client.tick(3)?.0, 3);
//!     stopper.stop();
//!     Ok(())
//! });
//! let mut stage = SimulationStage::new(Simulation::new(World::new()));
//! server.run(&mut stage)?;
//! client.join().unwrap()?;
//! assert_eq!(stage.recording().commands.len(), 1);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Safety
//!
//! Servers listen on the loopback interface. Any other address needs a [`Token`], which every client has to show first.
//! [`Limits`] bound frames, clients, requests, time and what waits in queues; nobody who is slow, silent or hostile delays
//! the step, or others. Traffic is not encrypted: put a tunnel around it where others may listen.

mod bucket;
mod cameras;
mod clock;
mod config;
mod engine;
mod error;
mod frame;
mod hub;
mod kept;
mod link;
mod reader;
mod server;
mod simulated;
mod stage;
mod token;
pub mod typed;
pub mod unrealcv;
mod watch;

pub use cameras::{CameraPlace, Mount};
pub use config::{Limits, Pace, ServerConfig};
pub use error::{RemoteError, StageError};
pub use frame::{Decoder, FrameError, Framing};
pub use server::{Report, Server, Stopper};
pub use simulated::{Eye, SimulationStage};
pub use stage::{Picture, PictureKind, Stage, View};
pub use token::{Token, TokenError};
pub use typed::{Client, ClientError};
