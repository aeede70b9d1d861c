//! Every embodiment comes through the obstacle course of the example `bodies` on its own feet or wheels.

use simworld_examples::bodies::{Course, Embodiment, SECTIONS};

#[test]
fn everybody_comes_through_the_course_and_touches_no_post() {
    let mut course = Course::new(&Embodiment::ALL).expect("the bodies are sound");
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
