//! The released command set, as its Python client sends it, byte by byte.
#![cfg(feature = "remote")]

use std::io::{Read, Write};
use std::net::TcpStream;

use crate::remote_common::{Unreal, replay, roads, serve};
use simworld_agents::remote::{CameraPlace, Mount, ServerConfig, Token};
use simworld_core::alteration::Alteration;
use simworld_core::command::Command;
use simworld_core::geometry::{Point3, pose_facing};
use simworld_core::net::SignalGroup;
use simworld_core::scene::Solidity;
use simworld_core::traffic::{SignalTiming, TrafficOrder};

const HUMANOID: &str = "/Game/TrafficSystem/Pedestrian/Base_User_Agent.Base_User_Agent_C";

fn near(found: &[f64], wanted: &[f64]) -> bool {
    found.len() == wanted.len() && found.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 0.01)
}

#[test]
fn the_first_bytes_are_those_of_the_protocol() {
    let server = serve(ServerConfig::on_free_ports());
    let mut socket = TcpStream::connect(server.unrealcv).expect("it listens");
    let mut bytes = [0; 8 + 21];
    socket.read_exact(&mut bytes).expect("it greets");
    assert_eq!(bytes[..8], [0xc1, 0x83, 0x2b, 0x9e, 21, 0, 0, 0]);
    assert_eq!(&bytes[8..], b"connected to simworld");
    socket.write_all(b"\xc1\x83\x2b\x9e\x1b\0\0\x007:vget /unrealcv/echo hello").expect("it reads");
    let mut bytes = [0; 8 + 7];
    socket.read_exact(&mut bytes).expect("it answers");
    assert_eq!(&bytes, b"\xc1\x83\x2b\x9e\x07\0\0\x007:hello");
    drop(server.stop());
}

#[test]
fn what_the_released_client_does_at_its_start_is_answered() {
    let server = serve(ServerConfig::on_free_ports());
    let mut client = Unreal::connect(server.unrealcv);
    let commands = client.ask("vget /unrealcv/commands");
    assert!(commands.lines().any(|line| line == "vget /unrealcv/commands"), "it looks for this line");
    assert_eq!(client.ask("vrun setres 1280x720w"), "ok");
    assert_eq!(client.ask("vget /camera/0/size"), "1280 720");
    assert!(client.ask("vrun Editor.AsyncSkinnedAssetCompilation 2").starts_with("error "));
    let objects = client.ask("vget /objects");
    let names: Vec<&str> = objects.split_whitespace().collect();
    assert_eq!(names, ["Ada", "Bench", "car_1"], "a name of two words is none here");
    drop(server.stop());
}

#[test]
fn things_are_brought_placed_changed_and_taken_away() {
    let server = serve(ServerConfig::on_free_ports());
    let mut client = Unreal::connect(server.unrealcv);
    assert_eq!(
        client.ask(&format!("vset /objects/spawn_bp_asset {HUMANOID} GEN_BP_Humanoid_0")),
        "GEN_BP_Humanoid_0"
    );
    let twice = client.ask(&format!("vset /objects/spawn_bp_asset {HUMANOID} gen_bp_humanoid_0"));
    assert_eq!(twice, "error Failed to spawn gen_bp_humanoid_0, object exsit.");
    let who = "vset /object/GEN_BP_Humanoid_0";
    for done in [
        "/location 1700 -1000 0",
        "/rotation 0 90 0",
        "/scale 1 1 1",
        "/collision True",
        "/object_mobility True",
    ] {
        assert_eq!(client.ask(&format!("{who}{done}")), "ok", "{done}");
    }
    assert!(near(&client.numbers("vget /object/GEN_BP_Humanoid_0/location"), &[1700.0, -1000.0, 0.0]));
    assert!(near(&client.numbers("vget /object/gen_bp_humanoid_0/rotation"), &[0.0, 90.0, 0.0]));
    assert_eq!(client.ask("vset /objects/spawn bench Crate"), "Crate");
    assert_eq!(client.ask("vset /object/Crate/scale 2 1 3"), "ok");
    assert!(near(&client.numbers("vget /object/Crate/scale"), &[2.0, 1.0, 3.0]));
    assert!(near(&client.numbers("vget /object/Crate/bounds"), &[-60.0, -90.0, 0.0, 60.0, 90.0, 255.0]));
    assert_eq!(client.ask("vset /object/Crate/color 10 200 30"), "ok");
    assert_eq!(client.ask("vget /object/Crate/color"), "(R=10,G=200,B=30,A=255)");
    assert_eq!(client.ask("vset /object/Crate/object_mobility False"), "ok");
    assert!(client.ask("vset /object/Crate/location 0 0 0").starts_with("error it is not movable"));
    assert_eq!(client.ask("vset /object/Crate/name Box"), "ok");
    assert_eq!(client.ask("vget /object/Crate/location"), "error Can not find object: Crate");
    assert!(near(&client.numbers("vget /object/Box/scale"), &[2.0, 1.0, 3.0]));
    assert!(client.ask("vset /object/Box/name Ada").starts_with("error Renaming"));
    assert_eq!(client.ask("vset /object/Box/collision False"), "ok");
    assert_eq!(client.ask("vset /object/Box/hide"), "ok");
    let information = client.ask("vget /objects");
    assert!(information.contains("Box") && !information.contains("Crate"), "{information}");
    assert_eq!(client.ask("vset /object/box/destroy"), "ok");
    assert_eq!(client.ask("vset /object/Box/destroy"), "error Can not find object: Box");
    assert_eq!(client.ask("vset /action/tick"), "ok");
    let (_, recording) = server.stop();
    assert_eq!(recording.trail.len(), 1);
    let hollow = |command: &Command| {
        matches!(command, Command::Alter { alteration: Alteration::Solidity(Solidity::Hollow), .. })
    };
    let hollowed = recording.commands.iter().filter(|stamped| hollow(&stamped.command)).count();
    assert_eq!(hollowed, 1, "the collision of a bench was switched off, that of a person is its own");
    assert_eq!(replay(&recording), recording);
}

#[test]
fn nothing_is_met_with_silence() {
    let server = serve(ServerConfig::on_free_ports());
    let mut client = Unreal::connect(server.unrealcv);
    for (line, answer) in [
        ("vget /nothing", "error Can not find a handler for URI 'vget /nothing'"),
        ("", "error Can not find a handler for URI ''"),
        (
            "vset /object/Ada/location 1 2",
            "error Argument Invalid: give vset /object/[str]/location [float] [float] [float]",
        ),
        (
            "vset /object/Ada/location 1 2 inf",
            "error Argument Invalid: give vset /object/[str]/location [float] [float] [float]",
        ),
        ("vset /objects/spawn Zeppelin Z", "error Can not find a class with name 'Zeppelin'"),
        ("vbp Ada MakeUTurn", "error a U-turn of a person has no counterpart here"),
        (
            "vbp Ada Listening 0",
            "error this has no counterpart here: who listens does nothing that others see",
        ),
        ("vbp Nobody StartSimulation", "error Can not find object: Nobody"),
        ("vget /camera/7/lit png", "error there is no camera 7: ask for the list of cameras"),
        (
            "vget /camera/0/lit out.png",
            "error Argument Invalid: the server writes no files, ask for png or bmp",
        ),
        (
            "vset /object/Ada/scale 0 0 0",
            "error Argument Invalid: a capsule with radius = 0 is no solid: give a finite size from 1 mm to 100 km",
        ),
        (
            "vset /action/tick_intervel 0.01",
            "error Argument Invalid: a tick takes whole steps of 0.100000 s here, from one to 100000",
        ),
        ("vbp Nobody GetInformation", "error Can not find object: Nobody"),
    ] {
        assert_eq!(client.ask(line), answer, "{line}");
    }
    assert!(client.ask("vset /object/Ada/location 1e300 0 0").starts_with("error "));
    assert_eq!(client.ask("vget /unrealcv/echo still_here"), "still_here");
    let (_, recording) = server.stop();
    assert!(recording.commands.is_empty(), "{:?}", recording.commands);
}

#[test]
fn people_walk_turn_sit_and_follow_paths() {
    let server = serve(ServerConfig::on_free_ports());
    let mut client = Unreal::connect(server.unrealcv);
    assert_eq!(client.ask("vset /action/game/pause"), "ok");
    let tick = |client: &mut Unreal, count: u32| {
        for _ in 0..count {
            assert_eq!(client.ask("vset /action/tick"), "ok");
        }
    };
    assert_eq!(client.ask("vbp Ada SitDown"), r#"{"Success":"true"}"#, "the bench is a metre away");
    assert!(client.ask("vbp Ada SitDown").starts_with(r#"{"Success":"false""#));
    assert_eq!(client.ask("vbp Ada StandUp"), r#"{"Success":"true"}"#);
    assert_eq!(client.ask("vset /object/Ada/location 0 0 0"), "ok");
    assert_eq!(client.ask("vbp Ada SetMaxSpeed 200"), "ok");
    // To the right, which is south, as the client says it: 90 degrees, clockwise.
    assert_eq!(client.ask("vbp Ada TurnAround 0.1 90 1"), "ok");
    assert_eq!(client.ask("vbp Ada MoveForward"), "ok");
    tick(&mut client, 10);
    assert!(near(&client.numbers("vget /object/Ada/location"), &[0.0, 200.0, 0.0]), "a second at 2 m/s");
    assert_eq!(client.ask("vbp Ada StopAgent"), "ok");
    // And to the left as it says that: -90, and -1.
    assert_eq!(client.ask("vbp Ada TurnAround 0.1 -90 -1"), "ok");
    tick(&mut client, 1);
    assert!(near(&client.numbers("vget /object/Ada/rotation"), &[0.0, 0.0, 0.0]));
    assert!(client.ask("vbp Ada FollowPath").starts_with("error it has no path"));
    assert_eq!(client.ask("vbp Ada SetPath 0,400;300,400"), "ok");
    assert_eq!(client.ask("vbp Ada FollowPath"), "ok");
    tick(&mut client, 60);
    let end = client.numbers("vget /object/Ada/location");
    assert!((end[0] - 300.0).abs() < 45.0 && (end[1] - 400.0).abs() < 45.0, "{end:?}");
    tick(&mut client, 5);
    assert!(near(&client.numbers("vget /object/Ada/location"), &end), "it stands at the end");
    assert_eq!(client.ask("vbp Ada GetCollisionNum").matches(":0").count(), 4);
    let (_, recording) = server.stop();
    assert_eq!(replay(&recording), recording);
}

#[test]
fn dogs_move_for_a_time_and_cars_take_their_pedals() {
    let server = serve(ServerConfig::on_free_ports());
    let mut client = Unreal::connect(server.unrealcv);
    client.ask("vset /objects/spawn_bp_asset /Game/Robot_Dog/Blueprint/BP_SpotRobot.BP_SpotRobot_C Spot");
    client.ask("vset /object/Spot/location 0 -3000 0");
    assert_eq!(client.ask("vbp Spot Move_Speed 100 0.5 0"), "ok");
    client.ask("vset /action/tick_intervel 1.0");
    assert_eq!(client.ask("vset /action/tick"), "ok");
    assert!(near(&client.numbers("vget /object/Spot/location"), &[50.0, -3000.0, 0.0]), "half of the second");
    assert_eq!(client.ask("vbp car_1 SetState 0.5 0 -1"), "ok");
    assert!(client.ask("vbp Ada SetState 0.5 0 -1").starts_with("error "));
    assert_eq!(client.ask("vbp Manager VSetState car_1,0.2,0,0;car_1,0,1,0"), "ok");
    assert!(
        client.ask("vbp Manager VSetState car_1,0.2,0;ghost,0,1,0").contains("ghost: Can not find object")
    );
    assert_eq!(client.ask("vset /action/tick"), "ok");
    let (report, recording) = server.stop();
    assert_eq!(report.steps, 20, "a tick of a second is ten steps");
    assert_eq!(replay(&recording), recording);
}

#[test]
fn cameras_are_worn_and_show_pictures() {
    let first = CameraPlace {
        mount: Mount::Free(pose_facing(Point3::new(0.0, 0.0, 0.5), 0.0)),
        horizontal_fov: 0.6,
        width: 8,
        height: 6,
    };
    let server = serve(ServerConfig { camera: first, ..ServerConfig::on_free_ports() });
    let mut client = Unreal::connect(server.unrealcv);
    assert_eq!(client.ask("vget /cameras"), "camera_0");
    assert!(near(&client.numbers("vget /camera/0/location"), &[0.0, 0.0, 50.0]));
    let png = client.bytes("vget /camera/0/lit png");
    assert!(
        png.starts_with(b"\x89PNG\r\n\x1a\n") && png[16..26] == [0, 0, 0, 8, 0, 0, 0, 6, 8, 6],
        "8 x 6, RGBA"
    );
    let bmp = client.bytes("vget /camera/0/lit bmp");
    assert_eq!((&bmp[..2], bmp.len()), (&b"BM"[..], 54 + 8 * 6 * 4));
    let npy = client.bytes("vget /camera/0/depth npy");
    let values: Vec<f32> =
        npy[128..].chunks_exact(4).map(|bytes| f32::from_le_bytes(bytes.try_into().expect("four"))).collect();
    assert_eq!((npy.len(), values[0]), (128 + 8 * 6 * 4, 65_504.0));
    assert!((values[3 * 8 + 4] - 375.0).abs() < 0.01, "Ada's near side, in cm: {}", values[3 * 8 + 4]);
    let middle = |client: &mut Unreal| {
        let npy = client.bytes("vget /camera/0/depth npy");
        let at = 128 + (3 * 8 + 4) * 4;
        f32::from_le_bytes(npy[at..at + 4].try_into().expect("four"))
    };
    assert_eq!(client.ask("vset /object/Ada/hide"), "ok");
    assert!((middle(&mut client) - 470.0).abs() < 0.01, "the bench behind her: {}", middle(&mut client));
    assert_eq!(client.ask("vset /object/Ada/show"), "ok");
    assert!((middle(&mut client) - 375.0).abs() < 0.01, "and there she is again");
    client.ask("vset /object/Ada/color 1 2 3");
    let mask = client.bytes("vget /camera/0/object_mask bmp");
    let pixel = 54 + ((5 - 3) * 8 + 4) * 4;
    assert_eq!(mask[pixel..pixel + 4], [3, 2, 1, 255], "blue, green, red, alpha");
    // Who is brought and moves wears a camera.
    client.ask(&format!("vset /objects/spawn_bp_asset {HUMANOID} Bob"));
    client.ask("vset /object/Bob/location 1000 0 0");
    assert_eq!(client.ask("vget /cameras"), "camera_0 camera_1");
    assert!(near(&client.numbers("vget /camera/1/location"), &[1000.0, 0.0, 160.0]));
    assert_eq!(client.ask("vset /camera/1/location 1000 0 500"), "ok");
    client.ask("vset /object/Bob/location 2000 0 0");
    assert!(
        near(&client.numbers("vget /camera/1/pose"), &[2000.0, 0.0, 500.0, 0.0, 0.0, 0.0]),
        "it goes along"
    );
    assert_eq!(client.ask("vset /camera/1/fov 60"), "ok");
    assert!(near(&client.numbers("vget /camera/1/fov"), &[60.0]));
    assert!(client.ask("vset /camera/1/size 100000 10").starts_with("error "));
    assert!(client.ask("vset /camera/1/fov 180").starts_with("error "));
    client.ask("vset /object/Bob/destroy");
    assert_eq!(client.ask("vget /cameras"), "camera_0");
    drop(server.stop());
}

#[test]
fn managers_know_the_weather_and_where_everything_is() {
    let server = serve(ServerConfig::on_free_ports());
    let mut client = Unreal::connect(server.unrealcv);
    client.ask("vset /objects/spawn_bp_asset /Game/Weather/BP_WeatherManager.BP_WeatherManager_C Weather");
    assert_eq!(client.ask("vbp Weather SetSunDirection -26 -20"), "ok");
    assert_eq!(
        client.ask("vbp Weather GetSunDirection"),
        r#"{"rotation":"P=-26.000000 Y=-20.000000 R=0.000000"}"#
    );
    assert_eq!(client.ask("vbp Weather SetSunIntensity 75"), "ok");
    assert_eq!(client.ask("vbp Weather GetSunIntensity"), r#"{"SunIntensity":75.0}"#);
    assert_eq!(client.ask("vbp Weather SetFog 4 0 0"), "ok");
    assert!(client.ask("vbp Weather GetFog").contains(r#""FogDensity":4.0"#));
    assert!(client.ask("vbp Weather SetSunDirection -120 0").starts_with("error sun.elevation"));
    assert!(client.ask("vbp Weather GetAtmosphere").starts_with("error "));
    client.ask(&format!("vset /objects/spawn_bp_asset {HUMANOID} GEN_BP_Humanoid_3"));
    client.ask("vset /object/GEN_BP_Humanoid_3/location 123 -45 0");
    let information = client.ask("vbp Weather GetInformation");
    assert!(information.contains("GEN_BP_Humanoid_3X=123.000 Y=-45.000 Z="), "{information}");
    assert!(!information.contains("Ada"), "only what clients brought");
    assert_eq!(client.ask("vset /object/Weather/destroy"), "ok");
    let (_, recording) = server.stop();
    assert_eq!(recording.commands.len(), 5, "a manager is no thing: three of the weather, two of the person");
}

#[test]
fn requests_may_be_sent_ahead() {
    let server = serve(ServerConfig::on_free_ports());
    let mut client = Unreal::connect(server.unrealcv);
    for _ in 0..500 {
        client.send("vget /object/Ada/location");
        client.send("vset /action/tick");
    }
    for number in 0..1000 {
        let answer = client.answer(number);
        assert_eq!(answer.starts_with(b"ok"), number % 2 == 1);
    }
    drop(server.stop());
}

#[test]
fn a_token_is_asked_for_as_in_the_original() {
    let token = Token::new("the-right-token-of-today").ok();
    let server = serve(ServerConfig { token, ..ServerConfig::on_free_ports() });
    let mut client = Unreal::connect(server.unrealcv);
    assert_eq!(
        client.ask("vget /objects"),
        "error Authentication required, use: vset /unrealcv/auth <token>"
    );
    assert_eq!(client.ask("vset /unrealcv/auth wrong"), "error Authentication failed");
    assert_eq!(client.ask("vset /unrealcv/auth the-right-token-of-today"), "Authentication succeeded");
    assert!(client.ask("vget /objects").contains("Ada"));
    drop(server.stop());
}

#[test]
fn cars_turn_round_and_drive_ways() {
    let server = serve(ServerConfig::on_free_ports());
    let mut client = Unreal::connect(server.unrealcv);
    client.ask("vset /objects/spawn_bp_asset /Game/TrafficSystem/Vehicle/BP_Hatchback.BP_Hatchback_C Hatch");
    assert_eq!(client.ask("vset /object/Hatch/location 0 5000 0"), "ok");
    assert_eq!(client.ask("vset /action/tick_interval 0.1"), "ok");
    assert_eq!(client.ask("vbp Hatch MakeUTurn"), "ok");
    for _ in 0..200 {
        client.ask("vset /action/tick");
    }
    let (end, rotation) =
        (client.numbers("vget /object/Hatch/location"), client.numbers("vget /object/Hatch/rotation"));
    assert!(rotation[1].abs() > 170.0, "it looks back: {rotation:?}");
    assert!((3500.0..4400.0).contains(&end[1]), "across the oncoming lane, to its left: {end:?}");
    client.ask("vset /action/tick");
    assert!(near(&client.numbers("vget /object/Hatch/location"), &end), "and stands there");
    // On along a way, to the west and then to the north, which is negative y here.
    assert_eq!(client.ask(&format!("vbp Hatch SetWaypoints -3000,{};-5000,2000", end[1])), "ok");
    assert_eq!(client.ask("vbp Hatch SetMaxSpeed 400"), "ok");
    assert_eq!(client.ask("vbp Hatch FollowPath"), "ok");
    for _ in 0..250 {
        client.ask("vset /action/tick");
    }
    let there = client.numbers("vget /object/Hatch/location");
    assert!((there[0] + 5000.0).abs() + (there[1] - 2000.0).abs() < 600.0, "{there:?}");
    // A car that no client brought is the traffic's to turn round; this world has none, and says so.
    assert_eq!(client.ask("vbp car_1 MakeUTurn"), "ok");
    client.ask("vset /action/tick");
    let (_, recording) = server.stop();
    let order = recording.commands.iter().rev().find_map(|stamped| match &stamped.command {
        Command::Traffic(order) => Some(order.name()),
        _ => None,
    });
    assert_eq!(order, Some("turn_round"));
    assert_eq!(replay(&recording), recording);
}

#[test]
fn lights_are_switched_timed_and_let_go() {
    let network = roads();
    let crossing = &network.crossings[0];
    let walk = crossing.signal.expect("the crossroads has signals");
    let green = network.connections.iter().find_map(|way| {
        (network.lanes[way.from.index()].road == crossing.road).then_some(way.signal).flatten()
    });
    let green = green.expect("vehicles come there too");
    let server = serve(ServerConfig::on_free_ports());
    let mut client = Unreal::connect(server.unrealcv);
    let light = "/Game/city_props/BP/props/street_light/BP_street_light.BP_street_light_C";
    client.ask(&format!("vset /objects/spawn_bp_asset {light} Light"));
    let far = client.ask("vset /object/Light/location 0 4000 0");
    assert_eq!(far, "ok");
    let none = client.ask("vbp Light SwitchVehicleFrontGreen");
    assert_eq!(none, "error Light stands at no junction with signals");
    let (x, y) = (crossing.start.x * 100.0 + 50.0, -crossing.start.y * 100.0);
    assert_eq!(client.ask(&format!("vset /object/Light/location {x} {y} 0")), "ok");
    client.ask("vset /objects/spawn_bp_asset /Game/Traffic/BP_Intersection.BP_Intersection_C Middle");
    for line in [
        "vbp Light SwitchVehicleFrontGreen",
        "vbp Light SetPedestrianWalk",
        "vbp Light SetDuration 30 4 9",
        "vbp Middle AddVehicleSignal Light",
        "vbp Middle AddPedSignal Light",
        "vbp Middle StartSimulation",
    ] {
        assert_eq!(client.ask(line), "ok", "{line}");
    }
    assert_eq!(client.ask("vbp Light AddVehicleSignal Light"), "error Can not find object: Light");
    let (_, recording) = server.stop();
    let orders: Vec<&TrafficOrder> = recording
        .commands
        .iter()
        .filter_map(|stamped| match &stamped.command {
            Command::Traffic(order) => Some(order),
            _ => None,
        })
        .collect();
    let hold = |group: SignalGroup| TrafficOrder::HoldSignal { group, seconds: None };
    let timing = SignalTiming { green: 30.0, yellow: 4.0, walk: 9.0 };
    let wanted = [
        hold(green),
        hold(walk),
        TrafficOrder::TimeSignal { group: green, timing },
        TrafficOrder::FreeSignal { group: green },
    ];
    assert!(orders.into_iter().eq(&wanted), "{:?}", recording.commands);
}
