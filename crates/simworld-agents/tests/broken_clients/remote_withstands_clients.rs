//! A thousand broken clients: none ends the server, or leaves a thread, a socket or memory behind.
//!
//! Threads, sockets and memory are counted for the whole process, so this test has it to itself.
#![cfg(all(feature = "remote", target_os = "linux"))]

use std::io::{Read, Write};
use std::thread;
use std::time::Duration;

use crate::counting::bytes_out;
use crate::remote_common::{Running, Unreal, becomes, connect, impatient, serve};
use simworld_agents::remote::typed::{Parting, SIGNATURE, VERSION};
use simworld_agents::remote::{Client, Framing, Limits, Pace, ServerConfig};
use simworld_core::seed::Seed;

/// What clients may leave on the heap, bytes: the digests of the steps meanwhile, and room in lists that grew. Five hundred that left 9 KiB
/// each would not fit.
const LEFT: usize = 4 << 20;

/// Bytes on the heap when all clients are gone. Their last requests are still being answered then, so the least of a while counts.
///
/// The allocator is asked and not the system: how many pages a process has in use depends on which threads took memory from which arena, and
/// goes up and down by many MiB where nothing is left behind.
fn settled(threads: usize) -> usize {
    becomes("all threads of clients have ended", || count("/proc/self/task") <= threads);
    let readings = (0..20).map(|_| {
        thread::sleep(Duration::from_millis(50));
        bytes_out()
    });
    readings.min().unwrap_or_default()
}

fn count(folder: &str) -> usize {
    std::fs::read_dir(folder).expect("Linux has it").count()
}

/// One broken client. What it wants to write may fail at any time: the server is free to hang up.
fn misbehave(kind: u64, server: &Running, seed: Seed) {
    let mut rng = seed.stream("client").rng();
    let text = rng.below(2) == 0;
    let (address, framing) =
        if text { (server.unrealcv, Framing::UnrealCv) } else { (server.typed, Framing::Typed) };
    let Some(mut socket) = connect(address) else { return };
    let hello: Vec<u8> = SIGNATURE.iter().copied().chain(VERSION.to_le_bytes()).collect();
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
    // Some hang up at once, some look at what comes; who is silent waits to be sent away.
    if done.is_ok() && rng.below(2) == 0 {
        let _ = socket.read(&mut [0; 64]);
    }
    if kind == 5 {
        thread::sleep(Duration::from_millis(250));
    }
}

/// Lets broken clients of these numbers come, six at a time.
fn send(numbers: std::ops::Range<u64>, server: &Running) {
    let next = std::sync::atomic::AtomicU64::new(numbers.start);
    thread::scope(|scope| {
        for _ in 0..6 {
            scope.spawn(|| {
                loop {
                    let index = next.fetch_add(1, std::sync::atomic::Ordering::SeqCst);
                    if index >= numbers.end {
                        break;
                    }
                    misbehave(index % 8, server, Seed(index));
                }
            });
        }
    });
}

#[test]
fn a_thousand_broken_clients_leave_nothing_behind() {
    let (threads, sockets) = (count("/proc/self/task"), count("/proc/self/fd"));
    let limits = Limits { hello_seconds: 0.1, ..impatient() };
    let config = ServerConfig { limits, pace: Pace::RealTime(1.0), ..ServerConfig::on_free_ports() };
    let server = serve(config);
    // The first make everything warm: buffers that are kept, lists that grow to their size. What later ones take must not stay.
    send(0..500, &server);
    let warm = settled(threads + 3);
    for batch in [500..750, 750..1000] {
        send(batch.clone(), &server);
        let more = settled(threads + 3).saturating_sub(warm);
        assert!(more < LEFT, "after the clients {batch:?} there are {more} bytes more than before");
    }
    // Nobody of them is left, and whoever behaves is served.
    becomes("one who behaves is let in", || Client::connect(server.typed, None).is_ok());
    becomes("all threads of clients have ended", || count("/proc/self/task") <= threads + 3);
    becomes("only the listeners are left of the sockets", || count("/proc/self/fd") <= sockets + 2);
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
