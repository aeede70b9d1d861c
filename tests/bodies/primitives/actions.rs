//! The paper's table of primitive actions, row by row: for whom, what has to be so before, what it does to the world, what
//! somebody else sees of it, and why it is refused where it is impossible. Every body moves under physics and is told by
//! commands.

use simworld_core::action::{ActionKind, ActionSet};
use simworld_core::id::EntityId;
use simworld_core::scene::Scene;
use simworld_core::testing::sample_action;

use super::stage::Stage;
use super::{moving, people, things, vehicles};

/// A row: who does what, and the check of it.
pub(crate) type Row = (fn(&Stage) -> EntityId, ActionKind, fn(&mut Stage));

const PERSON: fn(&Stage) -> EntityId = |stage| stage.me;
const DOG: fn(&Stage) -> EntityId = |stage| stage.dog;
const CAR: fn(&Stage) -> EntityId = |stage| stage.car;

const ROWS: [Row; 46] = [
    (PERSON, ActionKind::MoveForward, |stage| moving::forward(stage, stage.me)),
    (PERSON, ActionKind::Step, |stage| moving::step(stage, stage.me)),
    (PERSON, ActionKind::Rotate, |stage| moving::rotate(stage, stage.me)),
    (PERSON, ActionKind::ChangeSpeed, |stage| moving::change_speed(stage, stage.me)),
    (PERSON, ActionKind::Stop, |stage| moving::stop(stage, stage.me)),
    (PERSON, ActionKind::LookUp, |stage| moving::look_up(stage, stage.me)),
    (PERSON, ActionKind::LookDown, |stage| moving::look_down(stage, stage.me)),
    (PERSON, ActionKind::Focus, |stage| moving::focus(stage, stage.me)),
    (PERSON, ActionKind::TakePhoto, |stage| people::take_photo(stage, stage.me)),
    (PERSON, ActionKind::PickUp, things::pick_up),
    (PERSON, ActionKind::DropOff, things::drop_off),
    (PERSON, ActionKind::CarryHeavy, things::carry_heavy),
    (PERSON, ActionKind::PutDownHeavy, things::put_down_heavy),
    (PERSON, ActionKind::Give, things::give),
    (PERSON, ActionKind::Throw, things::throw),
    (PERSON, ActionKind::ThrowTo, things::throw_to),
    (PERSON, ActionKind::Grasp, things::grasp),
    (PERSON, ActionKind::LetGo, things::let_go),
    (PERSON, ActionKind::Buy, things::buy),
    (PERSON, ActionKind::SitDown, things::sit_down),
    (PERSON, ActionKind::StandUp, things::stand_up),
    (PERSON, ActionKind::Crouch, |stage| moving::crouch(stage, stage.me)),
    (PERSON, ActionKind::OpenDoor, things::open_door),
    (PERSON, ActionKind::CloseDoor, things::close_door),
    (PERSON, ActionKind::EnterCar, vehicles::enter_car),
    (PERSON, ActionKind::ExitCar, vehicles::exit_car),
    (PERSON, ActionKind::RideScooter, vehicles::ride_scooter),
    (PERSON, ActionKind::GetOffScooter, vehicles::get_off_scooter),
    (PERSON, ActionKind::Converse, people::converse),
    (PERSON, ActionKind::PointDirection, people::point),
    (PERSON, ActionKind::WaveHand, people::wave),
    (PERSON, ActionKind::Argue, people::argue),
    (DOG, ActionKind::MoveForward, |stage| moving::forward(stage, stage.dog)),
    (DOG, ActionKind::Step, |stage| moving::step(stage, stage.dog)),
    (DOG, ActionKind::Rotate, |stage| moving::rotate(stage, stage.dog)),
    (DOG, ActionKind::ChangeSpeed, |stage| moving::change_speed(stage, stage.dog)),
    (DOG, ActionKind::Stop, |stage| moving::stop(stage, stage.dog)),
    (DOG, ActionKind::LookUp, |stage| moving::look_up(stage, stage.dog)),
    (DOG, ActionKind::LookDown, |stage| moving::look_down(stage, stage.dog)),
    (DOG, ActionKind::Focus, |stage| moving::focus(stage, stage.dog)),
    (DOG, ActionKind::TakePhoto, |stage| people::take_photo(stage, stage.dog)),
    (CAR, ActionKind::Throttle, vehicles::throttle),
    (CAR, ActionKind::Brake, vehicles::brake),
    (CAR, ActionKind::Steer, vehicles::steer),
    (CAR, ActionKind::Stop, vehicles::stop),
    (CAR, ActionKind::TakePhoto, |stage| people::take_photo(stage, stage.car)),
];

#[test]
fn every_action_of_every_body_does_what_it_says() {
    for (_, _, check) in ROWS {
        check(&mut Stage::new());
    }
}

#[test]
fn no_action_is_without_a_row_and_what_a_body_never_does_is_refused() {
    for of in [PERSON, DOG, CAR] {
        let stage = Stage::new();
        let who = of(&stage);
        let kind = stage.world().entity(who).expect("it is there").kind;
        let rows: Vec<ActionKind> =
            ROWS.iter().filter(|(by, ..)| by(&stage) == who).map(|(_, action, _)| *action).collect();
        let can = ActionSet::of_body(kind);
        for action in ActionKind::ALL {
            assert_eq!(rows.contains(action), can.contains(*action), "a {kind} and {action}");
            if !can.contains(*action) {
                let mut stage = Stage::new();
                let told = sample_action(*action, stage.other);
                stage.refuses(who, told, &format!("cannot {action}"));
            }
        }
    }
}
