//! Rows of the table: legs, and where one looks.

use simworld_core::action::{Action, StepDirection};
use simworld_core::id::EntityId;
use simworld_core::scene::Scene;

use super::stage::{Stage, within};

/// To where there is room.
fn on_open_ground(stage: &mut Stage, who: EntityId) {
    stage.stand(who, -60.0, -40.0, 0.5);
}

pub(crate) fn forward(stage: &mut Stage, who: EntityId) {
    on_open_ground(stage, who);
    stage.refuses(who, Action::MoveForward { speed: -1.0 }, "speed = -1");
    stage.does(who, Action::MoveForward { speed: 1.2 });
    let (ahead, left) = stage.way_in(who, 5.0);
    within(ahead, 5.99..=6.01);
    within(left, -0.01..=0.01);
    within(stage.sees(who).speed, 1.19..=1.21);
    // A wall stops it, however long it walks.
    stage.stand(who, -30.0, 10.0, 0.0);
    stage.does(who, Action::MoveForward { speed: 1.2 });
    stage.wait(6.0);
    within(stage.at(who).x, -26.8..=-26.25);
    within(stage.sees(who).speed, 0.0..=0.01);
}

pub(crate) fn step(stage: &mut Stage, who: EntityId) {
    stage.refuses(who, Action::Step { direction: StepDirection::Left, distance: f64::NAN }, "distance = NaN");
    let ways = [
        (StepDirection::Forward, (1.0, 0.0)),
        (StepDirection::Backward, (-1.0, 0.0)),
        (StepDirection::Left, (0.0, 1.0)),
        (StepDirection::Right, (0.0, -1.0)),
    ];
    for (direction, (ahead, left)) in ways {
        on_open_ground(stage, who);
        let (from, heading) = (stage.at(who), stage.heading(who));
        stage.does(who, Action::Step { direction, distance: 0.5 });
        within(stage.sees(who).speed, 0.1..=2.0);
        stage.wait(2.0);
        let way = stage.at(who) - from;
        let along = simworld_core::geometry::direction(heading);
        within(way.dot(&along) - 0.5 * ahead, -0.01..=0.01);
        within(along.perp(&way) - 0.5 * left, -0.01..=0.01);
        within(stage.heading(who) - heading, -1e-6..=1e-6);
    }
}

pub(crate) fn rotate(stage: &mut Stage, who: EntityId) {
    on_open_ground(stage, who);
    stage.refuses(who, Action::Rotate { angle: f64::INFINITY }, "a finite angle");
    stage.does(who, Action::Rotate { angle: 1.0 });
    stage.wait(1.0);
    within(stage.heading(who), 1.499..=1.501);
}

pub(crate) fn change_speed(stage: &mut Stage, who: EntityId) {
    on_open_ground(stage, who);
    stage.refuses(who, Action::ChangeSpeed { speed: -0.5 }, "speed = -0.5");
    stage.does(who, Action::MoveForward { speed: 0.8 });
    stage.wait(0.5);
    stage.does(who, Action::ChangeSpeed { speed: 1.6 });
    stage.wait(0.2);
    within(stage.sees(who).speed, 1.59..=1.61);
    within(stage.heading(who), 0.499..=0.501);
}

pub(crate) fn stop(stage: &mut Stage, who: EntityId) {
    on_open_ground(stage, who);
    stage.does(who, Action::MoveForward { speed: 1.5 });
    stage.wait(1.0);
    within(stage.sees(who).speed, 1.49..=1.51);
    stage.does(who, Action::Stop);
    let (ahead, left) = stage.way_in(who, 2.0);
    within(ahead.abs() + left.abs(), 0.0..=1e-6);
    within(stage.sees(who).speed, 0.0..=1e-6);
}

pub(crate) fn look_up(stage: &mut Stage, who: EntityId) {
    stage.refuses(who, Action::LookUp { angle: f64::NAN }, "a finite angle");
    stage.does(who, Action::LookUp { angle: 0.4 });
    within(stage.sees(who).gaze, 0.4..=0.4);
    stage.does(who, Action::LookUp { angle: 9.0 });
    within(stage.sees(who).gaze, 1.57..=1.571);
}

pub(crate) fn look_down(stage: &mut Stage, who: EntityId) {
    stage.refuses(who, Action::LookDown { angle: f64::NAN }, "a finite angle");
    stage.does(who, Action::LookDown { angle: 0.3 });
    within(stage.sees(who).gaze, -0.3..=-0.3);
    assert!(stage.sees(who).to_string().ends_with(", looking down"), "{}", stage.sees(who));
}

pub(crate) fn focus(stage: &mut Stage, who: EntityId) {
    stage.refuses(who, Action::Focus { horizontal_fov: 4.0 }, "0.01 to 3.1 rad");
    let view = |stage: &Stage| stage.world().entity(who).expect("it is there").field_of_view();
    assert_eq!(view(stage), None, "relaxed");
    stage.does(who, Action::Focus { horizontal_fov: 0.6 });
    assert_eq!(view(stage), Some(0.6));
}

pub(crate) fn crouch(stage: &mut Stage, who: EntityId) {
    on_open_ground(stage, who);
    stage.does(who, Action::Crouch);
    stage.refuses(who, Action::Crouch, "crouching");
    assert!(stage.world().entity(who).expect("it is there").is_crouched(), "others see it");
    stage.does(who, Action::MoveForward { speed: 2.0 });
    let (ahead, _) = stage.way_in(who, 2.0);
    within(ahead, 1.9..=2.01);
    stage.does(who, Action::StandUp);
    stage.wait(0.5);
    assert!(!stage.world().entity(who).expect("it is there").is_crouched());
    let (ahead, _) = stage.way_in(who, 2.0);
    within(ahead, 3.9..=4.01);
    stage.refuses(who, Action::StandUp, "standing");
}
