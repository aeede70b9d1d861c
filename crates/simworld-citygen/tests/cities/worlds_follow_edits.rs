//! A world that follows edits of its city holds what it would hold if the edited city were put into it, and nothing that an
//! edit does not touch gets another id.

use std::collections::{BTreeMap, BTreeSet};

use simworld_citygen::edit::{CityEdit, CityEditor, CityInWorld, NewStreet};
use simworld_citygen::terrain::TerrainConfig;
use simworld_citygen::{City, CityConfig, Style};
use simworld_core::geometry::{Point2, Vector2};
use simworld_core::id::{EntityId, IntersectionId, RoadId};
use simworld_core::scene::{EntityKind, Scene, World};
use simworld_core::seed::Seed;

/// Everything, by kind and place, with how often it is there.
fn content(world: &World) -> BTreeMap<(EntityKind, String), usize> {
    let mut content = BTreeMap::new();
    for entity in world.iter() {
        let info = entity.info;
        let what = format!("{:?} {:?} {:?} {:?}", entity.pose, info.shape, info.name, info.attributes);
        *content.entry((entity.kind, what)).or_default() += 1;
    }
    content
}

fn populated(city: &City) -> World {
    let mut world = World::new();
    city.populate(&mut world).expect("the world is empty");
    world
}

#[test]
fn a_world_follows_edits_and_their_undos() {
    for (style, relief) in [(Style::Grid, 0.0), (Style::Organic, 0.0), (Style::Mixed, 40.0)] {
        let terrain = TerrainConfig { relief, ..TerrainConfig::default() };
        let config = CityConfig { roads: style.roads(60), terrain, ..CityConfig::default() };
        let city = City::generate(&config, Seed(4)).expect("presets are valid");
        let mut world = World::new();
        let entities = city.populate(&mut world).expect("the world is empty");
        let mut there = CityInWorld::of(&entities, &world);
        let mut editor = CityEditor::new(city.clone());
        let node = city.network.intersections.len() / 2;
        let at = city.network.intersections[node].center;
        let middle = |road: usize| {
            let line = &city.network.roads[road].centerline;
            nalgebra::center(&line[0], &line[1])
        };
        let nodes = city.network.intersections.iter().map(|place| place.center);
        let outermost = nodes.max_by(|a, b| a.x.total_cmp(&b.x)).expect("it has junctions");
        let edits = [
            CityEdit::RemoveStreet(RoadId::from_index(city.network.roads.len() / 2)),
            CityEdit::MoveIntersection {
                intersection: IntersectionId::from_index(node),
                to: Point2::new(at.x + 7.0, at.y - 4.0),
            },
            CityEdit::AddStreet(NewStreet::local([middle(3), middle(20)])),
            // Beyond the outskirts: the ground grows with the city.
            CityEdit::AddStreet(NewStreet::local([outermost, outermost + Vector2::new(90.0, 15.0)])),
            CityEdit::RemoveBuilding(5),
        ];
        let mut backs = Vec::new();
        for edit in &edits {
            let Ok(back) = editor.apply(edit) else { continue };
            let ids: BTreeSet<EntityId> = world.iter().map(|entity| entity.id).collect();
            let followed = there.follow(&mut editor, back, &mut world).expect("a world follows");
            assert_eq!(content(&world), content(&populated(editor.city())), "{style:?} {edit:?}");
            assert_eq!(**world.roads().expect("it has roads"), *editor.city().network);
            let left: BTreeSet<EntityId> = world.iter().map(|entity| entity.id).collect();
            let stayed = ids.intersection(&left).count();
            assert!(stayed * 3 > ids.len(), "{style:?} {edit:?}: only {stayed} of {} stayed", ids.len());
            // There and back by the commands themselves.
            let after = content(&world);
            let undone = world.apply_all(&followed.undo).expect("an undo fits");
            assert_ne!(content(&world), after);
            world.apply_all(&undone.undo).expect("a redo fits");
            assert_eq!(content(&world), after);
            backs.push(followed.back);
        }
        assert!(backs.len() >= 3, "{style:?}: only {} edits were possible", backs.len());
        for back in backs.into_iter().rev() {
            let forth = editor.put(back).expect("an undo fits");
            there.follow(&mut editor, forth, &mut world).expect("a world follows");
        }
        assert_eq!(content(&world), content(&populated(&city)));
        assert_eq!(**world.roads().expect("it has roads"), *city.network);
    }
}
