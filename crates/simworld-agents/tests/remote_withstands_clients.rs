//! A thousand broken clients: none ends the server, delays the step, or leaves a thread or a socket behind.
#![cfg(all(feature = "remote", target_os = "linux"))]

mod remote_common;

use std::io::{Read, Write};
use std::net::{SocketAddr, TcpStream};
use std::sync::Mutex;
use std::thread;
use std::time::{Duration, Instant};

use remote_common::{Running, Unreal, serve};
use simworld_agents::remote::typed::{Parting, Query, Request, SIGNATURE};
use simworld_agents::remote::{Client, ClientError, Framing, Limits, Pace, ServerConfig, Token};
use simworld_core::geometry::{Aabb, Point2};
use simworld_core::seed::Seed;

/// Threads and sockets are counted for the whole process: one test at a time.
static ALONE: Mutex<()> = Mutex::new(());

fn impatient() -> Limits {
    Limits {
        clients: 8,
        hello_seconds: 0.3,
        frame_seconds: 0.3,
        write_seconds: 0.3,
        idle_seconds: 30.0,
        ..Limits::default()
    }
}

fn count(folder: &str) -> usize {
    std::fs::read_dir(folder).expect("Linux has it").count()
}

/// Waits until something is so, at most ten seconds.
fn becomes(what: &str, is_so: impl Fn() -> bool) {
    let start = now();
    while !is_so() {
        assert!(start.elapsed() < Duration::from_secs(10), "it never came to be that {what}");
        thread::sleep(Duration::from_millis(10));
    }
}

#[expect(clippy::disallowed_methods, reason = "how long clients wait is outside the simulation")]
fn now() -> Instant {
    Instant::now()
}

fn connect(address: SocketAddr) -> Option<TcpStream> {
    let socket = TcpStream::connect(address).ok()?;
    socket.set_write_timeout(Some(Duration::from_millis(200))).ok()?;
    socket.set_read_timeout(Some(Duration::from_millis(200))).ok()?;
    Some(socket)
}

/// One broken client. What it wants to write may fail at any time: the server is free to hang up.
fn misbehave(kind: u64, server: &Running, seed: Seed) {
    let mut rng = seed.stream("client").rng();
    let text = rng.below(2) == 0;
    let (address, framing) =
        if text { (server.unrealcv, Framing::UnrealCv) } else { (server.typed, Framing::Typed) };
    let Some(mut socket) = connect(address) else { return };
    let hello: Vec<u8> = SIGNATURE.iter().copied().chain([1, 0]).collect();
    let says_hello = !matches!(kind, 0 | 5);
    if !text && says_hello && socket.write_all(&framing.frame(&hello)).is_err() {
        return;
    }
    let mut noise = |length: usize| -> Vec<u8> { (0..length).map(|_| rng.below(256) as u8).collect() };
    let done = match kind {
        // Random bytes.
        0 => socket.write_all(&noise(300)),
        // A frame that is cut off.
        1 => socket.write_all(&framing.frame(b"1:vget /objects")[..11]),
        // A frame as long as it gets.
        2 => socket.write_all(&[0xc1, 0x83, 0x2b, 0x9e, 0xff, 0xff, 0xff, 0xff]),
        // Whole frames of nonsense.
        3 => (0..20).try_for_each(|_| socket.write_all(&framing.frame(&noise(40)))),
        // One byte now and then.
        4 => framing.frame(b"1:vget /objects").chunks(1).take(6).try_for_each(|byte| {
            thread::sleep(Duration::from_millis(5));
            socket.write_all(byte)
        }),
        // Nothing at all.
        5 => Ok(()),
        // More than can be answered, and nothing is read.
        6 => {
            let call = if text { b"1:vget /unrealcv/help".to_vec() } else { vec![1, 0] };
            let flood: Vec<u8> = framing.frame(&call).repeat(300);
            (0..40).try_for_each(|_| socket.write_all(&flood))
        }
        // Nonsense behind something sensible.
        _ => {
            let mut bytes = framing.frame(b"1:vset /action/tick");
            bytes.extend(noise(100));
            socket.write_all(&bytes)
        }
    };
    // Some hang up at once, some look at what comes.
    if done.is_ok() && rng.below(2) == 0 {
        let _ = socket.read(&mut [0; 64]);
    }
}

#[test]
fn a_thousand_broken_clients_leave_nothing_behind() {
    let _alone = ALONE.lock();
    let (threads, sockets) = (count("/proc/self/task"), count("/proc/self/fd"));
    let config =
        ServerConfig { limits: impatient(), pace: Pace::RealTime(1.0), ..ServerConfig::on_free_ports() };
    let server = serve(config);
    let next = std::sync::atomic::AtomicU64::new(0);
    thread::scope(|scope| {
        for _ in 0..6 {
            scope.spawn(|| {
                loop {
                    let index = next.fetch_add(1, std::sync::atomic::Ordering::SeqCst);
                    if index >= 1000 {
                        break;
                    }
                    misbehave(index % 8, &server, Seed(index));
                }
            });
        }
    });
    // Nobody of them is left, and whoever behaves is served.
    becomes("one who behaves is let in", || Client::connect(server.typed, None).is_ok());
    becomes("all threads of clients have ended", || count("/proc/self/task") <= threads + 3);
    let mut client = Unreal::connect(server.unrealcv);
    assert_eq!(client.ask("vget /unrealcv/echo well"), "well");
    drop(client);
    let (report, _) = server.stop();
    let ended: u64 = report.partings.values().sum();
    assert!(ended >= 1000, "{report:?}");
    for parting in [Parting::Left, Parting::Malformed, Parting::Stranger] {
        assert!(report.partings.contains_key(&parting), "{parting:?} of {report:?}");
    }
    becomes("every thread has ended", || count("/proc/self/task") == threads);
    becomes("every socket is closed", || count("/proc/self/fd") == sockets);
}

#[test]
fn who_does_not_read_is_dropped_and_delays_nobody() {
    let _alone = ALONE.lock();
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
    let _alone = ALONE.lock();
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
    let _alone = ALONE.lock();
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
    let _alone = ALONE.lock();
    let server = serve(ServerConfig::on_free_ports());
    let mut leaver = Client::connect(server.typed, None).expect("it lets us in");
    leaver.send(Request::Tick(100_000)).expect("it is written");
    leaver.flush().expect("it is sent");
    let mut other = Client::connect(server.typed, None).expect("it lets us in");
    becomes("the world steps", || true);
    other.describe().expect("others are answered between steps");
    drop(leaver);
    thread::sleep(Duration::from_millis(300));
    let before = other.describe().expect("it answers").tick;
    thread::sleep(Duration::from_millis(100));
    assert_eq!(other.describe().expect("it answers").tick, before, "nobody waits for more steps");
    assert!(before.0 < 100_000, "{before}");
    drop(server.stop());
}
