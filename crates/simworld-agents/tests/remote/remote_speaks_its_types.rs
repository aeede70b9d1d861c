//! The typed protocol: commands, steps, queries, observations, pictures and digests over a real connection.
#![cfg(feature = "remote")]

use std::io::{Read, Write};
use std::net::TcpStream;

use crate::remote_common::{replay, serve};
use simworld_agents::remote::typed::{
    Answer, ClientConfig, Done, HelloError, Query, Refusal, Request, SIGNATURE, VERSION, read_welcome,
};
use simworld_agents::remote::{
    CameraPlace, Client, ClientError, Decoder, Framing, Mount, PictureKind, ServerConfig, Token,
};
use simworld_core::action::Action;
use simworld_core::alteration::Alteration;
use simworld_core::clock::Tick;
use simworld_core::command::Command;
use simworld_core::geometry::{Aabb, Point2, Point3, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityDesc, EntityKind, Shape, Solidity, Visibility};
use simworld_core::traffic::TrafficOrder;

fn person(x: f64) -> Command {
    let shape = Shape::Capsule { radius: 0.25, height: 1.8 };
    Command::Spawn(Box::new(EntityDesc::new(
        EntityKind::Person,
        pose_facing(Point3::new(x, 0.0, 0.0), 0.0),
        shape,
    )))
}

fn everywhere() -> Query {
    Query::of(Aabb::column_around(Point2::origin(), 1000.0))
}

#[test]
fn commands_take_effect_are_recorded_and_replay() {
    let server = serve(ServerConfig::on_free_ports());
    let mut client = Client::connect(server.typed, None).expect("it lets us in");
    let description = client.describe().expect("it says what it is");
    assert_eq!((description.name.as_str(), description.tick), ("simworld", Tick(0)));
    assert!((description.dt - 0.1).abs() < 1e-12);
    let walker = client.command(person(20.0)).expect("there is room").expect("somebody came");
    client.tick(1).expect("it steps");
    client
        .command(Command::Actuate { who: walker, action: Action::MoveForward { speed: 1.5 } })
        .expect("it walks");
    assert_eq!(client.tick(10).expect("it steps"), Tick(11));
    let seen = client.entity(walker).expect("it answers").expect("it lives");
    assert!(
        (seen.pose.translation.x - 21.5).abs() < 1e-9,
        "a second at 1.5 m/s: {}",
        seen.pose.translation.x
    );
    let kinds = vec![EntityKind::Person];
    let found = client.query(Query { kinds, ..everywhere() }).expect("it answers");
    assert_eq!((found.seen.len(), found.more), (2, 0));
    assert_eq!(client.query(Query { most: 1, ..everywhere() }).expect("it answers").more, 3);
    let digest = client.digest().expect("it answers");
    let (report, recording) = server.stop();
    assert_eq!(digest, recording.trail.last().copied());
    assert_eq!((recording.commands.len(), recording.trail.len(), report.steps), (2, 11, 11));
    assert_eq!(replay(&recording), recording);
}

#[test]
fn things_are_altered_and_what_the_traffic_refuses_is_told() {
    let server = serve(ServerConfig::on_free_ports());
    let mut client = Client::connect(server.typed, None).expect("it lets us in");
    let (bench, car) = (EntityId::new(0, 0), EntityId::new(1, 0));
    let shape = Shape::cuboid(1.2, 3.6, 0.85);
    let alterations = [
        Alteration::Shape(shape),
        Alteration::Color(Some([0.1, 0.2, 0.3])),
        Alteration::Name(Some("Long Bench".to_owned())),
        Alteration::Visibility(Visibility::Hidden),
        Alteration::Solidity(Solidity::Hollow),
    ];
    for alteration in alterations {
        client.command(Command::Alter { id: bench, alteration }).expect("it can be so");
    }
    let info = client.entity(bench).expect("it answers").expect("it lives").info;
    assert_eq!(
        (info.shape, info.color, info.name.as_deref()),
        (shape, Some([0.1, 0.2, 0.3]), Some("Long Bench"))
    );
    assert_eq!((info.visibility, info.solidity), (Visibility::Hidden, Solidity::Hollow));
    let alteration = Alteration::Color(Some([2.0, 0.0, 0.0]));
    let error = client.command(Command::Alter { id: bench, alteration }).unwrap_err();
    assert!(error.to_string().contains("2 is no share of a primary colour"), "{error}");
    client.watch(everywhere(), 1).expect("it lets us watch");
    let order = TrafficOrder::TurnRound { who: car };
    client.command(Command::Traffic(order.clone())).expect("it is passed on");
    client.tick(1).expect("it steps");
    let events = client.observation().expect("it comes").events;
    assert!(
        events.iter().any(|event| event.kind == order.refused("this world has no traffic")),
        "{events:?}"
    );
    let (_, recording) = server.stop();
    assert_eq!(recording.commands.len(), 6);
    assert_eq!(replay(&recording), recording);
}

#[test]
fn what_is_impossible_is_said_and_not_recorded() {
    let server = serve(ServerConfig::on_free_ports());
    let mut client = Client::connect(server.typed, None).expect("it lets us in");
    let nobody = EntityId::new(77, 0);
    let done = client.submit(vec![Command::Remove { id: nobody }, person(3.0)]).expect("it answers");
    assert!(matches!(&done[0], Done::Refused(reason) if reason.contains("#77")), "{done:?}");
    assert!(matches!(done[1], Done::Spawned(_)));
    let error = client.command(Command::Remove { id: nobody }).unwrap_err();
    assert!(matches!(error, ClientError::Command(_)), "{error}");
    for request in [Request::Tick(0), Request::Tick(u32::MAX)] {
        let error = client.call(request).unwrap_err();
        assert!(matches!(error, ClientError::Refused(Refusal::Range { .. })), "{error}");
    }
    let mut broken = everywhere();
    broken.region.min.x = f64::NAN;
    assert!(client.query(broken).is_err());
    assert!(client.picture(9, PictureKind::Color).unwrap_err().to_string().contains("no camera 9"));
    assert!(client.describe().is_ok(), "it goes on after all that");
    let (_, recording) = server.stop();
    assert_eq!(recording.commands.len(), 1);
}

#[test]
fn who_watches_is_told_after_every_so_many_steps() {
    let server = serve(ServerConfig::on_free_ports());
    let config = ClientConfig { timeout_seconds: 1.0, ..ClientConfig::default() };
    let mut client = Client::connect_with(server.typed, &config).expect("it lets us in");
    let near = Query::of(Aabb::column_around(Point2::new(4.0, 0.0), 0.5));
    client.watch(near, 2).expect("it lets us watch");
    let ada = EntityId::new(2, 0);
    client
        .command(Command::Actuate { who: ada, action: Action::MoveForward { speed: 3.0 } })
        .expect("she walks");
    for tick in [2, 4, 6] {
        // What is on its way to the client keeps the next observation back: the server's thread has to see that it went.
        std::thread::sleep(std::time::Duration::from_millis(50));
        client.tick(2).expect("it steps");
        let observation = client.observation().expect("it comes");
        assert_eq!(observation.tick, Tick(tick));
        let is_there = observation.found.seen.iter().any(|seen| seen.id == ada);
        assert_eq!(is_there, tick == 2, "she is past 4.75 m after four steps");
    }
    client.unwatch().expect("enough");
    client.tick(2).expect("it steps");
    let nothing = client.observation();
    assert!(matches!(nothing, Err(ClientError::Connection { .. })), "{nothing:?}");
    drop(server.stop());
}

#[test]
fn pictures_are_what_the_camera_sees() {
    let server = serve(ServerConfig::on_free_ports());
    let mut client = Client::connect(server.typed, None).expect("it lets us in");
    let ada = EntityId::new(2, 0);
    let eyes = pose_facing(Point3::new(0.0, 0.0, 0.5), 0.0);
    let place = CameraPlace { mount: Mount::Worn(ada, eyes), width: 8, height: 6, ..CameraPlace::default() };
    let camera = client.add_camera(place).expect("there is room");
    assert_eq!(client.cameras().expect("it answers").len(), 2);
    let ids = client.picture(camera, PictureKind::Instances).expect("it is drawn");
    let middle = |index: usize| index == 3 * 8 + 4;
    assert_eq!(ids.words().nth(3 * 8 + 4), Some(1), "the bench, whose index is 0, is before her");
    let depth = client.picture(camera, PictureKind::Depth).expect("it is drawn");
    let depths: Vec<f32> = depth.depths().collect();
    assert!(
        depths.iter().enumerate().any(|(at, depth)| middle(at) && (depth - 0.7).abs() < 1e-6),
        "{depths:?}"
    );
    assert!(depths[0].is_infinite(), "the sky");
    let huge = CameraPlace { width: 16_384, height: 16_384, ..place };
    assert!(client.set_camera(camera, huge).is_err());
    client.command(Command::Remove { id: ada }).expect("she leaves");
    let error = client.picture(camera, PictureKind::Color).unwrap_err();
    assert!(error.to_string().contains("is gone"), "{error}");
    drop(server.stop());
}

#[test]
fn calls_may_be_sent_ahead_and_are_answered_in_order() {
    let server = serve(ServerConfig::on_free_ports());
    let mut client = Client::connect(server.typed, None).expect("it lets us in");
    let mut calls = Vec::new();
    for index in 0..2000 {
        let request = if index % 100 == 99 { Request::Tick(1) } else { Request::Submit(vec![person(0.0)]) };
        calls.push(client.send(request).expect("it is written"));
    }
    client.flush().expect("it is sent");
    let mut ticks = 0;
    for call in calls {
        if let Answer::Ticked(tick) = client.receive(call).expect("it is answered") {
            ticks += 1;
            assert_eq!(tick, Tick(ticks));
        }
    }
    assert_eq!(ticks, 20);
    drop(server.stop());
}

#[test]
fn other_versions_and_unknown_requests_get_typed_errors() {
    let server = serve(ServerConfig::on_free_ports());
    let hello = |version: u16| {
        let mut socket = TcpStream::connect(server.typed).expect("it listens");
        let payload: Vec<u8> = SIGNATURE.iter().copied().chain(version.to_le_bytes()).collect();
        socket.write_all(&Framing::Typed.frame(&payload)).expect("it reads");
        let mut decoder = Decoder::new(Framing::Typed, 1024);
        (decoder_next(&mut socket, &mut decoder), socket)
    };
    let (answer, _) = hello(999);
    assert_eq!(read_welcome(&answer), Err(HelloError::Version { server: VERSION }));
    let (answer, mut socket) = hello(VERSION);
    assert!(read_welcome(&answer).is_ok());
    // Call 5, and a request that no version has.
    socket.write_all(&Framing::Typed.frame(&[5, 240, 9])).expect("it reads");
    let mut decoder = Decoder::new(Framing::Typed, 1024);
    let answer = decoder_next(&mut socket, &mut decoder);
    let message = simworld_agents::remote::typed::read_message(&answer).expect("a message");
    let refused = simworld_agents::remote::typed::Message::Answer(5, Err(Refusal::Malformed));
    assert_eq!(message, refused);
    drop(server.stop());
}

fn decoder_next(socket: &mut TcpStream, decoder: &mut Decoder) -> Vec<u8> {
    let mut chunk = [0; 512];
    loop {
        if let Some(frame) = decoder.next_frame().expect("frames") {
            return frame;
        }
        let count = socket.read(&mut chunk).expect("it answers");
        assert!(count > 0, "it hung up");
        decoder.feed(&chunk[..count]);
    }
}

#[test]
fn the_token_opens_the_door_and_nothing_else_does() {
    let token = |text: &str| Some(Token::new(text).expect("a token"));
    let config = ServerConfig { token: token("the-right-token-of-today"), ..ServerConfig::on_free_ports() };
    let server = serve(config);
    for wrong in [None, token("the-wrong-token-of-today")] {
        let error = Client::connect(server.typed, wrong).err().expect("it stays shut");
        assert!(matches!(error, ClientError::Hello(HelloError::Token(_))), "{error}");
    }
    let mut client = Client::connect(server.typed, token("the-right-token-of-today")).expect("it opens");
    assert!(client.describe().is_ok());
    drop(server.stop());
}
