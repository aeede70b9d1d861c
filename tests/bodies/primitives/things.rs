//! Rows of the table: what is taken, sat on and opened.

use simworld_core::action::{Action, StepDirection};
use simworld_core::geometry::Vector3;
use simworld_core::id::EntityId;
use simworld_core::scene::{Role, Scene};

use super::stage::{Stage, within};

/// To one side of a thing, looking at it.
fn beside(stage: &mut Stage, who: EntityId, thing: EntityId) {
    let at = stage.at(thing);
    stage.stand(who, at.x - 0.8, at.y, 0.0);
}

/// A load goes where its carrier walks.
fn comes_along(stage: &mut Stage, load: EntityId) {
    let (me, from) = (stage.me, stage.at(load));
    stage.does(me, Action::Rotate { angle: 2.0 });
    stage.wait(1.0);
    stage.does(me, Action::MoveForward { speed: 1.3 });
    stage.wait(4.0);
    stage.does(me, Action::Stop);
    within((stage.at(load) - stage.at(me)).norm(), 0.0..=0.8);
    within((stage.at(load) - from).norm(), 4.0..=7.0);
}

pub(crate) fn pick_up(stage: &mut Stage) {
    let (me, parcel) = (stage.me, stage.parcel);
    stage.refuses(me, Action::PickUp { item: parcel }, "the reach is 2 m");
    beside(stage, me, stage.crate_);
    stage.refuses(me, Action::PickUp { item: stage.crate_ }, "a prop cannot be used to pick up");
    beside(stage, me, parcel);
    stage.does(me, Action::PickUp { item: parcel });
    assert_eq!(stage.sees(parcel).bond, Some((me, Role::Held)));
    comes_along(stage, parcel);
    let here = stage.at(me);
    stage.stand(stage.other, here.x + 1.0, here.y, 3.1);
    stage.refuses(stage.other, Action::PickUp { item: parcel }, &format!("parcel {parcel} is taken by {me}"));
}

pub(crate) fn drop_off(stage: &mut Stage) {
    let (me, parcel) = (stage.me, stage.parcel);
    stage.refuses(me, Action::DropOff, "holding nothing");
    beside(stage, me, parcel);
    stage.does(me, Action::PickUp { item: parcel });
    stage.does(me, Action::DropOff);
    let lies = stage.at(parcel);
    assert_eq!(stage.sees(parcel).bond, None);
    within(stage.world().entity(parcel).expect("it is there").position().z, 0.0..=1e-9);
    stage.does(me, Action::MoveForward { speed: 1.3 });
    stage.wait(3.0);
    assert_eq!(stage.at(parcel), lies);
}

pub(crate) fn carry_heavy(stage: &mut Stage) {
    let (me, load, safe) = (stage.me, stage.crate_, stage.safe);
    beside(stage, me, safe);
    stage.refuses(me, Action::CarryHeavy { item: safe }, "weighs 80 kg and 25 kg is what one can carry");
    beside(stage, me, load);
    stage.does(me, Action::CarryHeavy { item: load });
    assert_eq!(stage.sees(load).bond, Some((me, Role::Carried)));
    comes_along(stage, load);
    // Both arms are full.
    beside(stage, me, stage.parcel);
    stage.refuses(me, Action::PickUp { item: stage.parcel }, "with both arms");
    beside(stage, me, stage.door);
    stage.refuses(me, Action::OpenDoor { door: stage.door }, "with both arms");
}

pub(crate) fn put_down_heavy(stage: &mut Stage) {
    let (me, load) = (stage.me, stage.crate_);
    stage.refuses(me, Action::PutDownHeavy, "carrying nothing");
    beside(stage, me, load);
    stage.does(me, Action::CarryHeavy { item: load });
    stage.stand(me, 0.0, 0.0, 0.0);
    stage.does(me, Action::PutDownHeavy);
    assert_eq!(stage.sees(load).bond, None);
    within((stage.at(load) - stage.at(me)).norm(), 0.5..=1.0);
    // It stands there and stops who walks into it.
    stage.does(me, Action::MoveForward { speed: 1.3 });
    stage.wait(1.0);
    within(stage.sees(me).speed, 0.0..=0.01);
}

pub(crate) fn give(stage: &mut Stage) {
    let (me, other, parcel) = (stage.me, stage.other, stage.parcel);
    stage.refuses(me, Action::Give { to: other }, "holding nothing");
    beside(stage, me, parcel);
    stage.does(me, Action::PickUp { item: parcel });
    stage.refuses(me, Action::Give { to: other }, "the reach is 2 m");
    beside(stage, other, parcel);
    stage.stand(other, stage.at(me).x, stage.at(me).y + 1.0, 0.0);
    stage.does(me, Action::Give { to: other });
    assert_eq!(stage.sees(parcel).bond, Some((other, Role::Held)));
}

pub(crate) fn throw(stage: &mut Stage) {
    let (me, parcel) = (stage.me, stage.parcel);
    let throw = |speed: f64| Action::Throw { velocity: Vector3::new(0.0, -speed, 0.0) };
    stage.refuses(me, throw(6.0), "holding nothing");
    beside(stage, me, parcel);
    stage.does(me, Action::PickUp { item: parcel });
    // Half (2 kg + 0.64 kg) v² is 200 J.
    stage.refuses(me, throw(12.4), "the arm gives 12.3 m/s");
    let from = stage.at(me);
    stage.does(me, throw(6.0));
    assert_eq!(stage.sees(parcel).bond, None);
    within(stage.speed(parcel), 5.5..=6.5);
    stage.wait(3.0);
    within(from.y - stage.at(parcel).y, 2.0..=6.0);
    within(stage.sees(parcel).speed, 0.0..=0.05);
}

pub(crate) fn throw_to(stage: &mut Stage) {
    let (me, other, parcel) = (stage.me, stage.other, stage.parcel);
    stage.refuses(me, Action::ThrowTo { to: other }, "holding nothing");
    beside(stage, me, parcel);
    stage.does(me, Action::PickUp { item: parcel });
    stage.refuses(me, Action::ThrowTo { to: parcel }, "by who is on it");
    stage.stand(other, stage.at(me).x, stage.at(me).y - 6.0, 1.57);
    stage.does(me, Action::ThrowTo { to: other });
    stage.wait(3.0);
    assert_eq!(stage.sees(parcel).bond, None);
    within((stage.at(parcel) - stage.at(other)).norm(), 0.2..=2.0);
}

pub(crate) fn grasp(stage: &mut Stage) {
    let (me, parcel) = (stage.me, stage.parcel);
    let grasp = |thing| Action::Grasp { thing, both_hands: true };
    stage.refuses(me, grasp(stage.other), "the reach is 2 m");
    beside(stage, me, parcel);
    // What has no body of its own stands fixed.
    stage.refuses(me, grasp(parcel), "has no body");
    stage.does(me, Action::PickUp { item: parcel });
    stage.does(me, Action::Throw { velocity: Vector3::new(0.0, 0.5, 0.0) });
    stage.wait(2.0);
    let at = stage.at(parcel);
    stage.stand(me, at.x - 0.6, at.y, 0.0);
    stage.does(me, grasp(parcel));
    stage.refuses(me, grasp(parcel), "let go first");
    stage.does(me, Action::Step { direction: StepDirection::Backward, distance: 1.0 });
    stage.wait(2.0);
    within(at.x - stage.at(parcel).x, 0.7..=1.3);
}

pub(crate) fn let_go(stage: &mut Stage) {
    stage.refuses(stage.me, Action::LetGo, "has hold of nothing");
    grasp(stage);
    let (me, parcel) = (stage.me, stage.parcel);
    let lies = stage.at(parcel);
    stage.does(me, Action::LetGo);
    stage.does(me, Action::Step { direction: StepDirection::Backward, distance: 1.0 });
    stage.wait(2.0);
    within((stage.at(parcel) - lies).norm(), 0.0..=0.2);
}

pub(crate) fn buy(stage: &mut Stage) {
    let (me, kiosk) = (stage.me, stage.kiosk);
    let buy = |goods: &str| Action::Buy { goods: goods.to_owned(), from: kiosk };
    stage.refuses(me, buy("tea"), "the reach is 2 m");
    stage.stand(me, -10.0, 27.5, 1.57);
    stage.refuses(me, buy("piano"), "it sells tea");
    stage.does(me, buy("tea"));
    let tea = stage.world().attached(me, Role::Held).expect("it holds what it bought");
    assert_eq!(stage.sees(tea).label, "tea");
}

pub(crate) fn sit_down(stage: &mut Stage) {
    let (me, other, chair) = (stage.me, stage.other, stage.chair);
    stage.refuses(me, Action::SitDown { seat: chair }, "the reach is 2 m");
    beside(stage, me, chair);
    stage.does(me, Action::SitDown { seat: chair });
    stage.wait(1.0);
    assert_eq!(stage.sees(me).bond, Some((chair, Role::Seated)));
    within((stage.at(me) - stage.at(chair)).norm(), 0.0..=0.05);
    stage.refuses(me, Action::MoveForward { speed: 1.0 }, "stand up first");
    stage.stand(other, 11.0, 10.0, 3.1);
    stage.refuses(other, Action::SitDown { seat: chair }, &format!("chair {chair} is taken by {me}"));
}

pub(crate) fn stand_up(stage: &mut Stage) {
    let (me, chair) = (stage.me, stage.chair);
    stage.refuses(me, Action::StandUp, "standing");
    beside(stage, me, chair);
    stage.does(me, Action::SitDown { seat: chair });
    stage.does(me, Action::StandUp);
    assert_eq!(stage.sees(me).bond, None);
    within((stage.at(me) - stage.at(chair)).norm(), 0.5..=1.2);
    stage.does(me, Action::MoveForward { speed: 1.0 });
    let (ahead, _) = stage.way_in(me, 2.0);
    within(ahead, 1.9..=2.1);
}

/// Walks east at the door in the wall; how far it comes.
fn walks_at_door(stage: &mut Stage) -> f64 {
    let me = stage.me;
    stage.stand(me, 18.5, 30.0, 0.0);
    stage.does(me, Action::MoveForward { speed: 1.3 });
    stage.wait(3.0);
    stage.does(me, Action::Stop);
    stage.at(me).x
}

pub(crate) fn open_door(stage: &mut Stage) {
    let (me, door, locked) = (stage.me, stage.door, stage.locked);
    within(walks_at_door(stage), 19.6..=19.72);
    assert_eq!(stage.sees(door).is_open, Some(false));
    stage.does(me, Action::OpenDoor { door });
    assert_eq!(stage.sees(door).is_open, Some(true));
    within(walks_at_door(stage), 21.5..=23.0);
    stage.refuses(me, Action::OpenDoor { door }, "2.");
    stage.stand(me, 19.0, 30.0, 0.0);
    stage.refuses(me, Action::OpenDoor { door }, &format!("door {door} is open already"));
    stage.stand(me, 39.0, 30.0, 0.0);
    stage.refuses(me, Action::OpenDoor { door: locked }, "is locked");
}

pub(crate) fn close_door(stage: &mut Stage) {
    let (me, other, door) = (stage.me, stage.other, stage.door);
    stage.stand(me, 19.0, 30.0, 0.0);
    stage.refuses(me, Action::CloseDoor { door }, "closed already");
    stage.does(me, Action::OpenDoor { door });
    stage.stand(other, 20.0, 30.0, 0.0);
    stage.refuses(me, Action::CloseDoor { door }, "somebody or something stands in it");
    stage.stand(other, 30.0, 5.0, 0.0);
    stage.does(me, Action::CloseDoor { door });
    assert_eq!(stage.sees(door).is_open, Some(false));
    within(walks_at_door(stage), 19.6..=19.72);
}
