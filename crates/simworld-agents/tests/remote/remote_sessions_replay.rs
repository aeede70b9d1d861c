//! A session of several clients at once is recorded, and the recording goes through the same states again.
#![cfg(feature = "remote")]

use std::thread;
use std::time::Duration;

use crate::remote_common::{Unreal, replay, serve};
use simworld_agents::remote::{Client, Pace, ServerConfig};
use simworld_core::action::Action;
use simworld_core::command::Command;
use simworld_core::geometry::{Point3, pose_facing};
use simworld_core::record::Recording;
use simworld_core::scene::{EntityDesc, EntityKind, Shape};

/// Two clients act at their own pace while the world goes on in real time, twenty times as fast.
fn session() -> Recording {
    let server = serve(ServerConfig { pace: Pace::RealTime(20.0), ..ServerConfig::on_free_ports() });
    let (text, typed) = (server.unrealcv, server.typed);
    let one = thread::spawn(move || {
        let mut client = Unreal::connect(text);
        for index in 0..12 {
            let name = format!("Walker_{index}");
            client.ask(&format!("vset /objects/spawn Base_Pedestrian {name}"));
            client.ask(&format!("vset /object/{name}/location {} {} 0", index * 150, index * -40));
            client.ask(&format!("vbp {name} TurnAround 1 {} 1", index * 30));
            client.ask(&format!("vbp {name} SetPath 0,0;500,{};900,900", index * 90));
            client.ask(&format!("vbp {name} {}", if index % 2 == 0 { "FollowPath" } else { "MoveForward" }));
            client.ask(&format!("vset /object/{name}/scale 1 1 {}", 1.0 + 0.05 * f64::from(index)));
            client.ask(&format!("vset /object/{name}/{}", if index % 3 == 0 { "hide" } else { "show" }));
            client.ask(&format!("vset /object/{name}/collision {}", index % 4 != 0));
            thread::sleep(Duration::from_millis(7));
        }
        client.ask("vset /object/Walker_3/name Renamed");
        client.ask("vset /object/Renamed/destroy");
    });
    let two = thread::spawn(move || {
        let mut client = Client::connect(typed, None).expect("it lets us in");
        for index in 0..40 {
            let shape = Shape::Capsule { radius: 0.25, height: 1.8 };
            let at = pose_facing(Point3::new(f64::from(index), 30.0, 0.0), 0.1 * f64::from(index));
            let person = EntityDesc::new(EntityKind::Person, at, shape);
            let who =
                client.command(Command::Spawn(Box::new(person))).expect("there is room").expect("somebody");
            client
                .command(Command::Actuate { who, action: Action::MoveForward { speed: 1.0 } })
                .expect("it walks");
            if index % 3 == 0 {
                client.command(Command::Remove { id: who }).expect("it lives");
            }
            thread::sleep(Duration::from_millis(3));
        }
        client.tick(20).expect("twenty more steps pass");
    });
    one.join().expect("the first client is content");
    two.join().expect("the second client is content");
    server.stop().1
}

#[test]
fn what_clients_did_at_once_replays_to_the_same_digests() {
    let recording = session();
    assert!(recording.commands.len() > 120, "{} commands", recording.commands.len());
    assert!(recording.trail.len() > 20, "{} steps", recording.trail.len());
    let mut ticks: Vec<u64> = recording.commands.iter().map(|stamped| stamped.tick.0).collect();
    assert!(ticks.is_sorted(), "commands are in the order of their steps");
    ticks.dedup();
    assert!(ticks.len() > 10, "they came in many steps: {}", ticks.len());
    // Through a file, as a log is.
    let bytes = postcard::to_stdvec(&recording).expect("a recording is data");
    let again: Recording = postcard::from_bytes(&bytes).expect("it reads back");
    assert_eq!(replay(&again).trail, recording.trail);
}

#[test]
fn another_session_leads_elsewhere() {
    let mut recording = session();
    // Of the typed client's people the one before the last is not taken away, and walks on while twenty steps pass.
    let mut walks: Vec<&mut f64> = recording
        .commands
        .iter_mut()
        .filter_map(|stamped| match &mut stamped.command {
            Command::Actuate { action: Action::MoveForward { speed }, .. } => Some(speed),
            _ => None,
        })
        .filter(|speed| **speed == 1.0)
        .collect();
    let before_last = walks.len() - 2;
    *walks[before_last] += 0.25;
    let parted = std::panic::catch_unwind(|| replay(&recording));
    assert!(parted.is_err(), "a changed command gives other digests");
}
