//! Every embodiment comes through the obstacle course of the example `bodies` on its own feet or wheels.

use simworld_examples::bodies::{Course, Embodiment, SECTIONS};
use simworld_tests::traffic::is_whole;

#[test]
fn everybody_comes_through_the_course_and_touches_no_post() {
    // A robot dog on its legs costs ten times as much as all the others.
    let takes_part = |one: &Embodiment| is_whole() || *one != Embodiment::Quadruped;
    let embodiments: Vec<Embodiment> = Embodiment::ALL.into_iter().filter(takes_part).collect();
    let mut course = Course::new(&embodiments).expect("the bodies are sound");
    while !course.is_over() {
        course.step().expect("the physics goes on");
    }
    for outcome in course.outcomes() {
        let who = outcome.embodiment.name();
        assert_eq!(outcome.times.len(), SECTIONS.len(), "{who} came no farther: {outcome:?}");
        assert!(outcome.times.is_sorted(), "{who}: {:?}", outcome.times);
        assert_eq!((outcome.falls, outcome.touches), (0, 0), "{who} fell, or touched a post");
        assert!(outcome.highest > 0.95, "{who} went over the ramp, and not beside it: {} m", outcome.highest);
    }
}
