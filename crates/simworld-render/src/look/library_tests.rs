//! What the assets of the library look like: themselves, and not their boxes; and what the season makes of plants.

use simworld_core::asset::{Asset, Catalogue, Material, Season};
use simworld_core::environment::Environment;
use simworld_core::geometry::{Point3, Pose, pose_facing};
use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape, World};

use super::*;

/// What is a box in life, or lies as flat as one.
const BOXES: [&str; 8] =
    ["parcel", "meal", "cardboard_box", "large_box", "pizza_box", "newspaper", "letter", "lawn"];

fn of_library(name: &str) -> Asset {
    let library = Catalogue::library();
    library.find(name).and_then(|id| library.get(id)).unwrap_or_else(|| panic!("no {name}")).clone()
}

/// The parts of the one entity of a world, as its recipe is changed, in a season.
fn dressed(
    asset: &Asset,
    season: Option<Season>,
    change: impl Fn(EntityDesc) -> EntityDesc,
) -> Vec<resident::Part> {
    let mut world = World::new();
    world.set_environment(Environment { season, ..Environment::default() }).unwrap();
    let id = world.add_asset(asset.clone()).unwrap();
    let id = world.spawn(change(asset.at(id, Pose::identity()))).unwrap();
    let mut parts = Vec::new();
    Looks::default().dress(&world.entity(id).unwrap(), &world, Detail::EVERY, &mut parts);
    parts
}

fn mesh_of(parts: &[resident::Part], detail: Detail) -> Option<MeshId> {
    parts.iter().find(|part| part.details & detail.bit() != 0).map(|part| part.look.mesh)
}

#[test]
fn nothing_of_the_library_is_drawn_as_its_box() {
    let plain = [MeshId::Cuboid, MeshId::Cylinder, MeshId::Capsule, MeshId::Sphere, MeshId::Parcel];
    let mut boxes = Vec::new();
    for (_, asset) in Catalogue::library().iter() {
        let parts = dressed(asset, None, |desc| desc);
        assert!(!parts.is_empty(), "{} is not drawn at all", asset.name);
        let is_plain = |part: &resident::Part| matches!(part.mesh, Drawn::Own(mesh) if plain.contains(&mesh));
        if parts.iter().all(is_plain) {
            boxes.push(asset.name.clone());
        }
    }
    boxes.sort_unstable();
    let mut known = BOXES.map(str::to_owned);
    known.sort_unstable();
    assert_eq!(boxes, known, "drawn as plain solids; known to be such in life");
}

#[test]
fn the_season_of_a_scene_turns_its_trees() {
    let oak = of_library("oak");
    for season in Season::ALL {
        let parts = dressed(&oak, Some(season), |desc| desc);
        assert_eq!(Some(parts[0].look.color), oak.color_in(season), "{season}");
        for (detail, bare) in Detail::ALL.into_iter().zip([MeshId::FarBare, MeshId::CoarseBare, MeshId::Bare])
        {
            let is_bare = mesh_of(&parts, detail) == Some(bare);
            assert_eq!(is_bare, season == Season::Winter, "{season}, {detail:?}");
        }
    }
    let as_planted = dressed(&oak, None, |desc| desc);
    assert_eq!(Some(as_planted[0].look.color), oak.color);
}

#[test]
fn needles_stay_and_dead_trees_stay_bare() {
    for (name, mesh) in
        [("spruce", MeshId::Conifer), ("palm_tree", MeshId::Palm), ("dead_tree", MeshId::Bare)]
    {
        for season in [None, Some(Season::Summer), Some(Season::Winter)] {
            let parts = dressed(&of_library(name), season, |desc| desc);
            assert_eq!(mesh_of(&parts, Detail::Near), Some(mesh), "{name}, {season:?}");
        }
    }
}

/// A tree's own season, the colour of a season in which it was planted, and paint count more than the scene's season.
#[test]
fn what_a_tree_says_itself_counts_more() {
    let maple = of_library("maple");
    let told = dressed(&maple, Some(Season::Winter), |desc| desc.with("season", "autumn"));
    assert_eq!(Some(told[0].look.color), maple.color_in(Season::Autumn));
    assert_ne!(mesh_of(&told, Detail::Near), Some(MeshId::Bare));
    let [autumn, winter] = [Season::Autumn, Season::Winter].map(|season| maple.color_in(season).unwrap());
    let planted = dressed(&maple, Some(Season::Summer), |desc| desc.colored(winter));
    assert_eq!(mesh_of(&planted, Detail::Near), Some(MeshId::Bare));
    let golden = dressed(&maple, Some(Season::Winter), |desc| desc.colored(autumn));
    assert_eq!(golden[0].look.color, autumn);
    let painted = dressed(&maple, Some(Season::Spring), |desc| desc.colored([0.1, 0.2, 0.7]));
    assert_eq!(painted[0].look.color, [0.1, 0.2, 0.7]);
}

#[test]
fn plants_of_no_asset_turn_too() {
    // Some trees are conifers by chance, and stay as they are.
    let colors = |kind: EntityKind, season: Option<Season>| -> Vec<[f32; 3]> {
        let mut world = World::new();
        world.set_environment(Environment { season, ..Environment::default() }).unwrap();
        let mut plant = |k: u8| {
            let pose = pose_facing(Point3::new(9.0 * f64::from(k), 0.0, 0.0), 0.0);
            let id = world.spawn(EntityDesc::new(kind, pose, Shape::cuboid(1.0, 1.0, 4.0))).unwrap();
            let mut parts = Vec::new();
            Looks::default().dress(&world.entity(id).unwrap(), &world, Detail::EVERY, &mut parts);
            parts
        };
        let plants: Vec<Vec<resident::Part>> = (0..12).map(&mut plant).collect();
        let with_leaves = plants.iter().filter(|parts| mesh_of(parts, Detail::Near) != Some(MeshId::Conifer));
        with_leaves.map(|parts| parts[0].look.color).collect()
    };
    for kind in [EntityKind::Tree, EntityKind::Shrub] {
        let [summer, autumn] = [Season::Summer, Season::Autumn].map(|season| colors(kind, Some(season)));
        assert_eq!(colors(kind, None), summer, "{kind}");
        assert!(!summer.is_empty() && summer.iter().all(|[red, green, _]| green > red), "{kind}: {summer:?}");
        assert!(autumn.iter().all(|[red, green, _]| red > green), "{kind}: {autumn:?}");
    }
}

/// What a thing is made of reaches the shaders: roughness, and 2 more where it is bare metal.
#[test]
fn things_take_light_as_their_material_does() {
    let code = |name: &str| dressed(&of_library(name), None, |desc| desc)[0].look.param;
    let roughness = |material: Material| material.roughness() as f32;
    assert_eq!(code("table"), roughness(Material::Wood));
    assert_eq!(code("metal_can"), 2.0 + roughness(Material::Metal), "it is the colour of steel");
    assert!((0.3..1.0).contains(&code("hydrant")), "red metal is painted");
    // Patterns of walls have their storeys there.
    assert!(code("office_block") >= 1.0 && code("oak") == 0.0);
    let mut world = World::new();
    let desc = EntityDesc::new(EntityKind::Prop, Pose::identity(), Shape::cuboid(1.0, 1.0, 1.0));
    let id = world.spawn(desc.with("material", "rubber")).unwrap();
    let mut parts = Vec::new();
    Looks::default().dress(&world.entity(id).unwrap(), &world, Detail::EVERY, &mut parts);
    assert_eq!(parts[0].look.color, [Material::Rubber.reflectance() as f32; 3]);
}

/// A model takes light by what its asset is made of, and the colour of its entity where it is painted.
#[test]
fn models_of_the_library_take_light_as_their_material_does() {
    let finish = |name: &str| of_library(name).model.unwrap().parts[0].finish;
    let (cart, slide) = (finish("shopping_cart"), finish("slide"));
    assert!(cart.metallic == 1.0 && slide.metallic == 0.0 && slide.roughness < 0.5);
    let red = dressed(&of_library("slide"), None, |desc| desc.colored([0.6, 0.0, 0.0]));
    assert!(matches!(red[0].mesh, Drawn::Model(_)) && red[0].look.color == [0.6, 0.0, 0.0]);
}
