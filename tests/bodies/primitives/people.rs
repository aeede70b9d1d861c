//! Rows of the table: words, gestures and photos.

use simworld_agents::observer::{SceneGraph, SceneGraphObserver};
use simworld_core::action::Action;
use simworld_core::event::EventKind;
use simworld_core::id::EntityId;
use simworld_core::seam::Observer;

use super::stage::Stage;

/// What somebody was told in the last step.
fn told_to(stage: &Stage, who: EntityId) -> Vec<String> {
    let mut graph = SceneGraph::default();
    SceneGraphObserver::new(50.0).observe(stage.world(), who, &mut graph).expect("it is there");
    graph.hear(stage.world().events(), who);
    graph.feedback
}

/// Two who stand three metres apart.
fn meet(stage: &mut Stage) {
    stage.stand(stage.me, 0.0, 0.0, 0.0);
    stage.stand(stage.other, 3.0, 0.0, 3.0);
}

pub(crate) fn converse(stage: &mut Stage) {
    let (me, other) = (stage.me, stage.other);
    let say = |with| Action::Converse { with, words: "the bridge is closed".to_owned() };
    stage.refuses(me, say(other), "a voice carries 10 m");
    stage.refuses(me, say(stage.chair), "a chair cannot be used to talk to");
    meet(stage);
    stage.does(me, say(other));
    let heard = told_to(stage, other);
    assert_eq!(heard, [format!("{me} said to you: \"the bridge is closed\"")]);
    // Who is not spoken to sees that they talk; what they say it does not hear.
    let noticed = stage.notices();
    assert!(noticed.contains(&format!("{me} talks to {other}")), "{noticed:?}");
    assert!(!noticed.iter().any(|line| line.contains("bridge")), "{noticed:?}");
}

pub(crate) fn argue(stage: &mut Stage) {
    let (me, other) = (stage.me, stage.other);
    stage.refuses(me, Action::Argue { with: other }, "a voice carries 10 m");
    meet(stage);
    stage.does(me, Action::Argue { with: other });
    assert_eq!(told_to(stage, other), [format!("{me} does this at you: argue")]);
    assert!(stage.notices().contains(&format!("{me} does this at {other}: argue")), "{:?}", stage.notices());
}

pub(crate) fn wave(stage: &mut Stage) {
    let (me, other) = (stage.me, stage.other);
    let nobody = EntityId::new(5000, 0);
    stage.refuses(me, Action::WaveHand { to: nobody }, "there is no entity");
    stage.does(me, Action::WaveHand { to: other });
    assert_eq!(told_to(stage, other), [format!("{me} does this at you: wave hand")]);
    let noticed = stage.notices();
    assert!(noticed.contains(&format!("{me} does this at {other}: wave hand")), "{noticed:?}");
}

pub(crate) fn point(stage: &mut Stage) {
    let me = stage.me;
    stage.refuses(me, Action::PointDirection { heading: f64::NAN }, "a finite angle");
    stage.does(me, Action::PointDirection { heading: 1.5 });
    let pointed = stage.world().events().iter().any(|event| {
        matches!(event.kind, EventKind::Gesture { who, heading: Some(heading), .. } if who == me && (heading - 1.5).abs() < 1e-9)
    });
    assert!(pointed, "{:?}", stage.world().events());
    assert!(stage.notices().contains(&format!("{me} points to 86°")), "{:?}", stage.notices());
}

pub(crate) fn take_photo(stage: &mut Stage, who: EntityId) {
    stage.refuses(stage.chair, Action::TakePhoto, "a chair cannot take photo");
    stage.does(who, Action::TakePhoto);
    assert!(stage.notices().contains(&format!("{who} does this: take photo")), "{:?}", stage.notices());
}
