//! Who is slow, silent, too many or too curious is held back or dropped, and delays nobody.
#![cfg(feature = "remote")]

use std::cell::RefCell;
use std::io::{Read, Write};
use std::net::TcpStream;
use std::thread;
use std::time::Duration;

use crate::remote_common::{Unreal, becomes, connect, impatient, now, serve};
use simworld_agents::remote::typed::{Parting, Query, Request};
use simworld_agents::remote::{Client, ClientError, Framing, Limits, Pace, ServerConfig, Token};
use simworld_core::alteration::Alteration;
use simworld_core::command::Command;
use simworld_core::geometry::{Aabb, Point2, Pose};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityDesc, EntityKind, Shape};

#[test]
fn who_does_not_read_is_dropped_and_delays_nobody() {
    let limits = Limits { queued_bytes: 1 << 20, ..impatient() };
    let config = ServerConfig { limits, pace: Pace::RealTime(1.0), ..ServerConfig::on_free_ports() };
    let server = serve(config);
    // Three who ask for a lot and read nothing.
    let deaf: Vec<TcpStream> = (0..3).map(|_| connect(server.unrealcv).expect("it listens")).collect();
    for mut socket in &deaf {
        let flood = Framing::UnrealCv.frame(b"1:vget /unrealcv/help").repeat(2000);
        let _ = socket.write_all(&flood);
    }
    // One who watches is told of every step meanwhile, and is answered at once.
    let mut client = Client::connect(server.typed, None).expect("it lets us in");
    client.watch(Query::of(Aabb::column_around(Point2::origin(), 100.0)), 1).expect("it lets us watch");
    let first = client.observation().expect("steps go on").tick.0;
    for index in 1..=10 {
        let observation = client.observation().expect("steps go on");
        assert_eq!((observation.tick.0, observation.missed), (first + index, 0), "no step is late");
    }
    let asked = now();
    for _ in 0..50 {
        client.describe().expect("it answers");
    }
    assert!(asked.elapsed() < Duration::from_secs(5), "fifty answers took {:?}", asked.elapsed());
    becomes("the deaf are dropped", || {
        deaf.iter().all(|socket| {
            let mut socket = socket;
            // What was sent is read to its end: then the connection is over.
            let mut rest = Vec::new();
            socket.read_to_end(&mut rest).is_ok() || socket.write(&[0]).is_err()
        })
    });
    let (report, _) = server.stop();
    assert_eq!(report.partings.get(&Parting::Slow), Some(&3), "{report:?}");
}

#[test]
fn who_drips_or_sleeps_is_dropped_and_the_rate_is_kept() {
    let limits = Limits { idle_seconds: 0.4, requests_per_second: 100.0, ..impatient() };
    let server = serve(ServerConfig { limits, ..ServerConfig::on_free_ports() });
    let mut dripping = connect(server.unrealcv).expect("it listens");
    dripping.write_all(&Framing::UnrealCv.frame(b"1:vget /objects")[..9]).expect("it reads");
    let sleeping = connect(server.unrealcv).expect("it listens");
    let silent = connect(server.typed).expect("it listens");
    // A hundred at once, and then a hundred a second.
    let mut client = Client::connect(server.typed, None).expect("it lets us in");
    let start = now();
    for _ in 0..140 {
        client.describe().expect("it answers");
    }
    assert!(start.elapsed() > Duration::from_millis(300), "140 requests took {:?}", start.elapsed());
    drop(client);
    thread::sleep(Duration::from_millis(800));
    drop((dripping, sleeping, silent));
    let (report, _) = server.stop();
    for parting in [Parting::Dripping, Parting::Idle, Parting::Stranger, Parting::Left] {
        assert_eq!(report.partings.get(&parting), Some(&1), "{parting:?} of {report:?}");
    }
}

#[test]
fn who_comes_too_many_or_guesses_is_turned_away() {
    let token = Token::new("the-right-token-of-today").ok();
    let limits = Limits { clients: 2, ..impatient() };
    let server = serve(ServerConfig { limits, token: token.clone(), ..ServerConfig::on_free_ports() });
    let kept: Vec<Client> =
        (0..2).map(|_| Client::connect(server.typed, token.clone()).expect("there is room")).collect();
    let error = Client::connect(server.typed, token).err().expect("there is none left");
    assert!(matches!(&error, ClientError::Hello(_)), "{error}");
    assert!(error.to_string().contains("2 clients already"), "{error}");
    drop(kept);
    becomes("there is room again", || {
        connect(server.unrealcv).is_some_and(|mut socket| {
            let mut greeting = [0; 20];
            socket.read_exact(&mut greeting).is_ok() && greeting[8..].starts_with(b"connected")
        })
    });
    thread::sleep(Duration::from_millis(100));
    let mut guesser = Unreal::connect(server.unrealcv);
    for _ in 0..3 {
        assert_eq!(guesser.ask("vset /unrealcv/auth guess"), "error Authentication failed");
    }
    let (report, _) = server.stop();
    assert_eq!(report.partings.get(&Parting::Refused), Some(&1), "{report:?}");
    assert!(report.partings.contains_key(&Parting::Crowded), "{report:?}");
    assert_eq!(report.requests, 0, "nobody asked anything of the world");
}

#[test]
fn a_long_tick_of_one_who_leaves_ends_with_him() {
    /// More steps than the world takes while the test looks on.
    const STEPS: u32 = 100_000_000;
    let limits = Limits { steps: STEPS, ..impatient() };
    let server = serve(ServerConfig { limits, ..ServerConfig::on_free_ports() });
    let other = RefCell::new(Client::connect(server.typed, None).expect("it lets us in"));
    let tick = || other.borrow_mut().describe().expect("others are answered between steps").tick.0;
    let mut leaver = Client::connect(server.typed, None).expect("it lets us in");
    assert_eq!(tick(), 0, "in lockstep nothing moves before somebody asks for it");
    leaver.send(Request::Tick(STEPS)).expect("it is written");
    leaver.flush().expect("it is sent");
    becomes("the world steps", || tick() > 0);
    let before = tick();
    becomes("it goes on while the leaver waits", || tick() > before);
    drop(leaver);
    // It takes a moment until the server sees that nobody is there any more.
    becomes("the steps end with him", || {
        let before = tick();
        thread::sleep(Duration::from_millis(200));
        tick() == before
    });
    let last = tick();
    assert!(last < u64::from(STEPS), "they were broken off, and not taken to their end: {last}");
    // Steps go on for whoever else asks.
    assert_eq!(other.borrow_mut().tick(3).expect("it is there").0, last + 3);
    drop(other);
    let (report, recording) = server.stop();
    assert_eq!((report.steps, recording.trail.len() as u64), (last + 3, last + 3), "nobody else took a step");
    assert!(report.partings.contains_key(&Parting::Left), "{report:?}");
}

#[test]
fn what_clients_leave_in_things_is_bounded() {
    let limits = Limits { kept_bytes: 4096, ..impatient() };
    let server = serve(ServerConfig { limits, ..ServerConfig::on_free_ports() });
    let mut client = Client::connect(server.typed, None).expect("it lets us in");
    let bench = EntityId::new(0, 0);
    let set = |key: &str, length: usize| Command::SetAttribute {
        id: bench,
        key: key.to_owned(),
        value: Some("x".repeat(length).into()),
    };
    let unset = |key: &str| Command::SetAttribute { id: bench, key: key.to_owned(), value: None };
    client.command(set("a", 1900)).expect("there is room");
    client.command(set("b", 1900)).expect("there is room");
    let error = client.command(set("c", 200)).unwrap_err().to_string();
    assert!(error.contains("clients may leave 4096 bytes"), "{error}");
    // What is put in the place of something else takes its place; while that is there, both count.
    client.command(set("a", 10)).expect("it is smaller");
    client.command(set("c", 1500)).expect("there is room again");
    client.command(unset("b")).expect("it was there");
    // Names and recipes count as well, and go with the thing.
    let name = Command::Alter { id: bench, alteration: Alteration::Name(Some("n".repeat(2300))) };
    client.command(name).expect("there is room");
    let shape = Shape::Cylinder { radius: 0.2, height: 0.7 };
    let note = EntityDesc::new(EntityKind::Cone, Pose::identity(), shape).with("note", "x".repeat(900));
    let spawn = || Command::Spawn(Box::new(note.clone()));
    assert!(client.command(spawn()).is_err(), "there is no room for it");
    client.command(Command::Remove { id: bench }).expect("it is there");
    let mut cone = client.command(spawn()).expect("its room is free").expect("a cone");
    for _ in 0..20 {
        client.command(Command::Remove { id: cone }).expect("it is there");
        cone = client.command(spawn()).expect("its room is free").expect("a cone");
    }
    // Of ways too.
    let mut text = Unreal::connect(server.unrealcv);
    let way = |points: usize| format!("vbp Ada SetPath {}", "1,2;".repeat(points));
    assert!(text.ask(&way(400)).starts_with("error clients may leave 4096 bytes"));
    assert_eq!(text.ask(&way(20)), "ok");
    drop(server.stop());
}
