//! What a picture is told of robots is where their bodies are: links, and the legs of dogs that are led over the ground.
#![allow(clippy::unwrap_used)]

use std::sync::Arc;

use crate::common::{Stage, at};
use simworld_core::action::Action;
use simworld_core::geometry::{Point3, Pose, Vector3, pose_facing};
use simworld_core::hash::{StateHash, StateHasher};
use simworld_core::id::EntityId;
use simworld_core::limbs::{JointAngles, Side};
use simworld_core::ops;
use simworld_core::scene::{EntityKind, Scene, Shape};
use simworld_physics::robot::{
    Base, Form, JointDescription, JointKind, LinkDescription, LinkVisual, RobotDescription, Surface,
    VisualForm,
};
use simworld_physics::{JointCommand, Material, QuadrupedModel, Robot, RobotConfig};

/// A mast with an arm that turns about its top, a pad of points at its end, and a ball fixed on that.
fn boom() -> RobotDescription {
    let unit = Pose::identity();
    let pad = [(0.0, 0.0, 0.0), (0.2, 0.0, 0.0), (0.0, 0.1, 0.0), (0.0, 0.0, 0.3), (0.2, 0.1, 0.3)];
    let points = pad.map(|(x, y, z)| Vector3::new(x, y, z)).to_vec();
    let mast = Form::Cylinder { radius: 0.1, length: 2.0 };
    RobotDescription {
        name: "boom".to_owned(),
        base: Base::Fixed,
        links: vec![
            LinkDescription::new("mast").with_solid(mast, Pose::translation(0.0, 0.0, 1.0), Material::Metal),
            LinkDescription::new("arm")
                .with_mass(5.0, Vector3::new(0.75, 0.0, 0.0), [0.02, 1.0, 1.0])
                .with_solid(
                    Form::Box { size: Vector3::new(1.5, 0.1, 0.1) },
                    Pose::translation(0.75, 0.0, 0.0),
                    Material::Metal,
                )
                .with_solid(Form::Convex { points }, Pose::translation(1.5, 0.0, 0.0), Material::Metal),
            LinkDescription::new("lamp").with_mass(0.2, Vector3::zeros(), [1e-4; 3]).with_solid(
                Form::Sphere { radius: 0.05 },
                unit,
                Material::Metal,
            ),
        ],
        joints: vec![
            JointDescription::new("turn", JointKind::Continuous, ["mast", "arm"])
                .at(Vector3::new(0.0, 0.0, 2.0))
                .about(Vector3::z())
                .with_motor(200.0, 0.1),
            JointDescription::new("foot of the lamp", JointKind::Fixed, ["arm", "lamp"])
                .at(Vector3::new(1.4, 0.0, 0.1)),
        ],
        ..RobotDescription::default()
    }
}

fn put(stage: &mut Stage) -> EntityId {
    let place = pose_facing(Point3::new(3.0, -2.0, 0.0), 0.7);
    let id = stage.spawn(EntityKind::Robot, place, Shape::cuboid(0.3, 0.3, 2.0));
    stage.physics.add_robot(&stage.world, id, RobotConfig::from(boom())).unwrap();
    let body: &mut Robot = stage.physics.body_as_mut(id).unwrap();
    body.command(0, JointCommand { speed: 1.5, damping: 40.0, ..JointCommand::default() }).unwrap();
    id
}

/// World from each link, as a picture is told.
fn told(stage: &Stage, id: EntityId) -> Vec<(Shape, Pose)> {
    let pose = *stage.world.entity(id).unwrap().pose;
    stage.world.links(id).unwrap().iter().map(|(form, link)| (form.shape, pose * link)).collect()
}

#[test]
fn links_are_where_the_robot_has_them() {
    let mut stage = Stage::new();
    let id = put(&mut stage);
    assert!(stage.world.links(id).is_none(), "before the first step nobody has said anything");
    let mut tips = Vec::new();
    for step in 0..20 {
        stage.run(1);
        let robot: &Robot = stage.physics.body_as(id).unwrap();
        let middles = [
            ("mast", Vector3::new(0.0, 0.0, 1.0)),
            ("arm", Vector3::new(0.75, 0.0, 0.0)),
            ("arm", Vector3::new(1.6, 0.05, 0.15)),
            ("lamp", Vector3::zeros()),
        ];
        let told = told(&stage, id);
        assert_eq!(told.len(), middles.len());
        for ((shape, pose), (link, middle)) in told.iter().zip(middles) {
            let frame = robot.link_pose(link).unwrap();
            let seen = pose * Point3::new(0.0, 0.0, 0.5 * shape.size().z);
            let is = frame * Point3::from(middle);
            // What is convex has a surface, whose numbers are single.
            assert!((seen - is).norm() < 1e-7, "step {step}, {link}: {seen}, not {is}");
            assert!(pose.rotation.angle_to(&frame.rotation) < 1e-9, "step {step}, {link}");
        }
        let box_of_pad = told[2].0.size();
        assert!((box_of_pad - Vector3::new(0.2, 0.1, 0.3)).norm() < 1e-6, "what is convex fills its box");
        tips.push(told[3].1.translation.vector);
    }
    let swept = tips.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum::<f64>();
    assert!(swept > 2.0, "the arm turned: {swept} m");
}

/// The surface of the pad is that of the five points: six faces, of which a mean corner is one of the points.
#[test]
fn what_is_convex_is_drawn_as_that() {
    let mut stage = Stage::new();
    let id = put(&mut stage);
    stage.run(1);
    let models: Vec<_> = stage.world.links(id).unwrap().iter().map(|(form, _)| form.model.clone()).collect();
    assert!([0, 1, 3].iter().all(|link| models[*link].is_none()), "boxes and balls need none");
    let model = models[2].as_ref().expect("points have a surface of their own");
    assert_eq!(model.triangles.len(), 6, "two sides of a wedge, its slopes and its back");
    for vertex in &model.vertices {
        // The middle of the bottom of the box is at (0.1, 0.05, 0).
        let at = Vector3::from(vertex.position.map(f64::from)) + Vector3::new(0.1, 0.05, 0.0);
        let pad = [(0.0, 0.0, 0.0), (0.2, 0.0, 0.0), (0.0, 0.1, 0.0), (0.0, 0.0, 0.3), (0.2, 0.1, 0.3)];
        assert!(pad.iter().any(|(x, y, z)| (at - Vector3::new(*x, *y, *z)).norm() < 1e-6), "{at}");
    }
}

/// A link with something to see is drawn as that, and met as its solids.
#[test]
fn what_is_seen_of_a_link_stands_in_place_of_its_solids() {
    let surface = Surface {
        points: [(0.0, 0.0, 0.2), (0.4, 0.0, 0.2), (0.0, 0.4, 0.2), (0.0, 0.0, 0.6)]
            .map(|(x, y, z)| Vector3::new(x, y, z))
            .to_vec(),
        triangles: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]],
    };
    let mut description = boom();
    let tip =
        LinkVisual::of_surface(&surface, &Pose::translation(0.0, 0.0, 1.0), Some([0.1, 0.2, 0.3])).unwrap();
    description.links[0].visuals.push(tip);
    let mut stage = Stage::new();
    let id = stage.spawn(EntityKind::Robot, at(0.0, 0.0, 0.0), Shape::cuboid(0.3, 0.3, 2.0));
    stage.physics.add_robot(&stage.world, id, RobotConfig::from(description.clone())).unwrap();
    stage.run(1);
    let links = stage.world.links(id).unwrap();
    assert_eq!(links.len(), 4, "one in place of the mast");
    let (form, pose) =
        links.iter().find(|(form, _)| form.color.is_some()).expect("nothing else has a colour");
    assert!((form.shape.size() - Vector3::repeat(0.4)).norm() < 1e-6);
    assert!((pose.translation.vector - Vector3::new(0.2, 0.2, 1.2)).norm() < 1e-9, "{pose}");

    let wrong = |spoil: &dyn Fn(&mut LinkVisual)| {
        let mut spoilt = description.clone();
        spoil(&mut spoilt.links[0].visuals[0]);
        spoilt.validate().unwrap_err().to_string()
    };
    let hollow = wrong(&|seen| seen.form = VisualForm::Model(Arc::default()));
    assert!(hollow.contains("mast") && hollow.contains("surface"), "{hollow}");
    let pale = wrong(&|seen| seen.color = Some([0.0, 2.0, 0.0]));
    assert!(pale.contains("color"), "{pale}");
    let flat = wrong(&|seen| seen.form = VisualForm::Solid(Form::Sphere { radius: 0.0 }));
    assert!(flat.contains("radius"), "{flat}");
}

#[test]
fn links_go_along_with_who_is_put_elsewhere_and_change_no_digest() {
    let mut stage = Stage::new();
    let id = put(&mut stage);
    stage.run(5);
    let (before, digest) = (told(&stage, id), digest(&stage));
    let mut bare = stage.world.clone();
    bare.set_links(id, &std::sync::Arc::from([]), &[]).unwrap();
    let mut hasher = StateHasher::new();
    bare.state_hash(&mut hasher);
    assert_eq!(hasher.finish().0, digest);

    let there = pose_facing(Point3::new(-40.0, 8.0, 1.0), 0.7);
    stage.world.set_motion(id, there, simworld_core::geometry::Twist::ZERO).unwrap();
    stage.tick(0.002);
    let moved = Vector3::new(-43.0, 10.0, 1.0);
    for ((_, old), (_, new)) in before.iter().zip(told(&stage, id)) {
        let off = new.translation.vector - old.translation.vector - moved;
        assert!(off.norm() < 0.02, "{off}");
    }
    stage.physics.remove(id).unwrap();
    stage.world.remove(id).unwrap();
    assert!(stage.world.links(id).is_none());
}

fn digest(stage: &Stage) -> u64 {
    let mut hasher = StateHasher::new();
    stage.world.state_hash(&mut hasher);
    hasher.finish().0
}

/// Where the middles of the feet of a dog are, by its joints alone: front left, front right, rear left, rear right.
fn feet(stage: &Stage, dog: EntityId, joints: &JointAngles) -> [Point3; 4] {
    let model = QuadrupedModel::default();
    let JointAngles { left_arm, right_arm, left_leg, right_leg, .. } = joints;
    let legs = [
        (Side::Left, 1.0, left_arm.trunk_from_upper_arm(Side::Left), -left_arm.elbow_flexion),
        (Side::Right, 1.0, right_arm.trunk_from_upper_arm(Side::Right), -right_arm.elbow_flexion),
        (Side::Left, -1.0, left_leg.trunk_from_thigh(Side::Left), left_leg.knee_flexion),
        (Side::Right, -1.0, right_leg.trunk_from_thigh(Side::Right), right_leg.knee_flexion),
    ];
    let pose = *stage.world.entity(dog).unwrap().pose;
    legs.map(|(side, ahead, turned, knee)| {
        let (sin, cos) = ops::sin_cos(knee);
        let shank = Vector3::new(-sin, 0.0, -cos) * model.shank;
        let leg = Vector3::new(0.0, side.sign() * model.hip_offset, -model.thigh) + shank;
        let hip = Vector3::new(ahead * model.hip[0], side.sign() * model.hip[1], model.standing_height());
        pose * Point3::from(hip + turned * leg)
    })
}

#[test]
fn legs_of_a_dog_that_is_led_swing_with_its_way() {
    let ground = QuadrupedModel::default().foot_radius;
    for (action, what) in
        [(Action::MoveForward { speed: 0.8 }, "ahead"), (Action::MoveForward { speed: 0.3 }, "slowly")]
    {
        let mut stage = Stage::new();
        stage.physics.set_interest(&[Point3::new(1e4, 0.0, 0.0)]);
        let dog = stage.legged_dog(at(0.0, 0.0, 0.3));
        stage.run(3);
        let standing = *stage.world.joints(dog).unwrap();
        assert!(feet(&stage, dog, &standing).iter().all(|foot| (foot.z - ground).abs() < 1e-6));
        stage.tell(dog, action);
        stage.step();
        let mut was = feet(&stage, dog, stage.world.joints(dog).unwrap());
        let (mut bore, mut lifted, mut forward) = (0, 0, [f64::INFINITY, f64::NEG_INFINITY]);
        for step in 0..300 {
            stage.tick(1.0 / 60.0);
            let joints = stage.world.joints(dog).unwrap();
            let now = feet(&stage, dog, joints);
            let low = now.map(|foot| foot.z < ground + 1e-3);
            assert!(low[0] == low[3] && low[1] == low[2], "two at a time, across: {low:?}");
            assert!(low[0] || low[1], "{what}, step {step}: some feet bear");
            for (old, new) in was.iter().zip(&now) {
                let bears = old.z < ground + 1e-3 && new.z < ground + 1e-3;
                let slid = (new - old).xy().norm();
                assert!(!bears || slid < 4e-3, "{what}, step {step}: a foot that bears slid by {slid} m");
                (bore, lifted) = (bore + usize::from(bears), lifted + usize::from(new.z > ground + 0.03));
            }
            let hip = joints.left_arm.shoulder_flexion;
            forward = [forward[0].min(hip), forward[1].max(hip)];
            was = now;
        }
        assert!(bore > 400 && lifted > 150, "{what}: {bore} that bore, {lifted} lifted");
        assert!(forward[1] - forward[0] > 0.2, "{what}: {forward:?}");
        stage.tell(dog, Action::Stop);
        stage.run(10);
        assert_eq!(*stage.world.joints(dog).unwrap(), standing, "{what}: it stands again");
    }
}

#[test]
fn a_dog_on_its_legs_tells_where_its_feet_are_sideways_too() {
    let mut stage = Stage::new();
    let dog = stage.legged_dog(at(0.0, 0.0, 0.0));
    let mut aside: f64 = 0.0;
    stage.command(dog, simworld_physics::Command { lateral: 0.3, ..Default::default() });
    for _ in 0..40 {
        stage.run(1);
        let joints = *stage.world.joints(dog).unwrap();
        let readings = stage.quadruped(dog).readings().joints;
        let bends = [-joints.left_arm.elbow_flexion, -joints.right_arm.elbow_flexion];
        for (bend, leg) in bends.iter().zip(&readings) {
            assert!((bend - leg[2].angle).abs() < 1e-12);
        }
        let feet = feet(&stage, dog, &joints);
        let lowest = feet.iter().map(|foot| foot.z).fold(f64::INFINITY, f64::min);
        assert!((-0.02..0.06).contains(&lowest), "some foot is on the ground: {feet:?}");
        aside = aside.max(joints.left_leg.hip_abduction.abs());
    }
    assert!(aside > 0.05, "legs go aside: {aside}");
}
