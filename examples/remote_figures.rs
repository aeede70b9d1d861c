//! How fast a served world answers: commands a second, and how long a picture takes to its client.
//!
//! ```sh
//! cargo run --release --example remote_figures
//! ```

use std::io::{Read, Write};
use std::net::{SocketAddr, TcpStream};
use std::process::ExitCode;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use clap::Parser;
use simworld_agents::remote::typed::Request;
use simworld_agents::remote::{
    Client, Decoder, Eye, Framing, Limits, Picture, PictureKind, Server, ServerConfig, SimulationStage,
    StageError, View,
};
use simworld_core::command::Command;
use simworld_core::geometry::{Point3, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::scene::Scene;
use simworld_examples::served::{CitySettings, RenderEye, simulation};
use simworld_examples::{Outcome, exit_code};

/// Measures the remote interface, each figure beside its bar.
#[derive(Parser)]
struct Arguments {
    /// Commands of each kind.
    #[arg(long, default_value_t = 20_000)]
    commands: u32,
    /// Pictures of each kind; 0 leaves them out.
    #[arg(long, default_value_t = 40)]
    pictures: u32,
}

/// When the last picture had been drawn.
type Drawn = Arc<Mutex<Option<Instant>>>;

fn main() -> ExitCode {
    exit_code(job(&Arguments::parse()))
}

#[expect(clippy::disallowed_methods, reason = "measuring is what this example is for")]
fn now() -> Instant {
    Instant::now()
}

/// Notes when a picture has been drawn.
struct TimedEye {
    inner: RenderEye,
    drawn: Drawn,
}

impl Eye for TimedEye {
    fn picture(&mut self, scene: &dyn Scene, view: &View, kind: PictureKind) -> Result<Picture, StageError> {
        let picture = self.inner.picture(scene, view, kind)?;
        *self.drawn.lock().unwrap_or_else(PoisonError::into_inner) = Some(now());
        Ok(picture)
    }
}

fn job(arguments: &Arguments) -> Outcome<()> {
    let settings = CitySettings {
        seed: 7,
        roads: 40,
        scene: None,
        vehicles: 40,
        pedestrians: 80,
        step_microseconds: 50_000,
    };
    let limits = Limits { requests_per_second: 1e7, ..Limits::default() };
    let server = Server::bind(ServerConfig { limits, ..ServerConfig::on_free_ports() })?;
    let addresses =
        server.unrealcv_address().zip(server.typed_address()).ok_or("it listens on both ports")?;
    let stopper = server.stopper();
    let drawn = Drawn::default();
    let own = Arc::clone(&drawn);
    let thread = std::thread::spawn(move || -> Result<(), String> {
        let mut stage = SimulationStage::new(simulation(&settings).map_err(|error| error.to_string())?);
        match RenderEye::new() {
            Ok(inner) => {
                println!(
                    "a city of {} entities, drawn on {}",
                    stage.simulation().world().len(),
                    inner.adapter()
                );
                stage = stage.seen_by(Box::new(TimedEye { inner, drawn: own }));
            }
            Err(error) => println!("without pictures: {error}"),
        }
        server.run(&mut stage).map(|_| ()).map_err(|error| error.to_string())
    });
    let measured = measure(arguments, addresses, &drawn);
    stopper.stop();
    thread.join().map_err(|_| "the server's thread ended badly")??;
    measured
}

fn measure(arguments: &Arguments, (text, typed): (SocketAddr, SocketAddr), drawn: &Drawn) -> Outcome<()> {
    let mut client = Client::connect(typed, None)?;
    let mut unreal = Unreal::connect(text)?;
    unreal.ask("vset /objects/spawn cone Marker")?;
    let marker = unreal.ask("vget /object/Marker/location").map(|_| marker(&mut client))??;
    let count = arguments.commands;
    let step = |index: u32| Command::Move {
        id: marker,
        pose: pose_facing(Point3::new(f64::from(index % 100), 0.0, 0.0), 0.0),
    };
    rate("typed commands, one after the other", count, || {
        (0..count).try_for_each(|index| client.command(step(index)).map(|_| ()).map_err(Into::into))
    })?;
    rate("typed commands, sent ahead by a hundred", count, || {
        for start in (0..count).step_by(100) {
            let calls: Vec<u64> = (start..(start + 100).min(count))
                .map(|index| client.send(Request::Submit(vec![step(index)])))
                .collect::<Result<_, _>>()?;
            client.flush()?;
            for call in calls {
                client.receive(call)?;
            }
        }
        Ok(())
    })?;
    let line = |index: u32| format!("vset /object/Marker/location {} 0 0", index % 100);
    rate("UnrealCV commands, one after the other", count, || {
        (0..count).try_for_each(|index| unreal.ask(&line(index)).map(|_| ()))
    })?;
    rate("UnrealCV commands, sent ahead by a hundred", count, || {
        for start in (0..count).step_by(100) {
            let lines: Vec<String> = (start..(start + 100).min(count)).map(line).collect();
            unreal.ask_all(&lines)?;
        }
        Ok(())
    })?;
    if arguments.pictures > 0 && client.picture(0, PictureKind::Color).is_ok() {
        pictures(arguments.pictures, &mut client, &mut unreal, drawn)?;
    }
    Ok(())
}

/// The id of what was brought last.
fn marker(client: &mut Client) -> Outcome<EntityId> {
    use simworld_agents::remote::typed::Query;
    use simworld_core::geometry::{Aabb, Point2};
    let query = Query::of(Aabb::column_around(Point2::origin(), 0.01));
    let found = client.query(query)?;
    Ok(found.seen.iter().map(|seen| seen.id).max().ok_or("the marker is not there")?)
}

fn rate(what: &str, count: u32, work: impl FnOnce() -> Outcome<()>) -> Outcome<()> {
    let start = now();
    work()?;
    let seconds = start.elapsed().as_secs_f64();
    println!("{what}: {:.0} a second; bar: 10000", f64::from(count) / seconds);
    Ok(())
}

fn pictures(count: u32, client: &mut Client, unreal: &mut Unreal, drawn: &Drawn) -> Outcome<()> {
    let since = |drawn: &Drawn| drawn.lock().unwrap_or_else(PoisonError::into_inner).map(|at| at.elapsed());
    let mut waits: [Vec<Duration>; 4] = Default::default();
    for _ in 0..count {
        client.picture(0, PictureKind::Color)?;
        waits[0].extend(since(drawn));
        unreal.bytes("vget /camera/0/lit bmp")?;
        waits[1].extend(since(drawn));
        unreal.bytes("vget /camera/0/lit png")?;
        waits[2].extend(since(drawn));
        unreal.bytes("vget /camera/0/depth npy")?;
        waits[3].extend(since(drawn));
    }
    let names = ["typed, RGB", "UnrealCV, bmp", "UnrealCV, png", "UnrealCV, depth as npy"];
    for (name, waits) in names.iter().zip(&mut waits) {
        waits.sort_unstable();
        let (Some(median), Some(most)) = (waits.get(waits.len() / 2), waits.last()) else { continue };
        println!("640 x 480 after it was drawn ({name}): {median:.2?}, at most {most:.2?}; bar: 5 ms");
    }
    Ok(())
}

/// A client of `UnrealCV`.
struct Unreal {
    socket: TcpStream,
    decoder: Decoder,
    chunk: Vec<u8>,
}

impl Unreal {
    fn connect(address: SocketAddr) -> Outcome<Self> {
        let socket = TcpStream::connect(address)?;
        socket.set_nodelay(true)?;
        let decoder = Decoder::new(Framing::UnrealCv, 64 << 20);
        let mut client = Self { socket, decoder, chunk: vec![0; 256 << 10] };
        client.frame()?;
        Ok(client)
    }

    fn ask(&mut self, line: &str) -> Outcome<String> {
        Ok(String::from_utf8(self.bytes(line)?)?)
    }

    fn bytes(&mut self, line: &str) -> Outcome<Vec<u8>> {
        self.socket.write_all(&Framing::UnrealCv.frame(format!("0:{line}").as_bytes()))?;
        let answer = self.frame()?;
        if answer.starts_with(b"0:error") {
            return Err(String::from_utf8_lossy(&answer).into_owned().into());
        }
        Ok(answer)
    }

    fn ask_all(&mut self, lines: &[String]) -> Outcome<()> {
        let mut out = Vec::new();
        for line in lines {
            Framing::UnrealCv.frame_into(format!("0:{line}").as_bytes(), &mut out);
        }
        self.socket.write_all(&out)?;
        for _ in lines {
            self.frame()?;
        }
        Ok(())
    }

    fn frame(&mut self) -> Outcome<Vec<u8>> {
        loop {
            if let Some(frame) = self.decoder.next_frame()? {
                return Ok(frame);
            }
            match self.socket.read(&mut self.chunk)? {
                0 => return Err("the server hung up".into()),
                count => self.decoder.feed(&self.chunk[..count]),
            }
        }
    }
}
