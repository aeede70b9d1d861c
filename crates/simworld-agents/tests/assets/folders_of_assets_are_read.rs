//! Folders of assets: what they hold becomes assets, and what is wrong or leads out of them is refused with its place.

use std::fs;
use std::path::{Path, PathBuf};

use proptest::prelude::*;
use simworld_agents::assets::{ImportConfig, export_glb};
use simworld_agents::library::{LOCK, Library, LibraryError, LibraryLimits, MANIFEST, Manifest};
use simworld_agents::retrieval::AssetIndex;
use simworld_core::asset::{Affordance, Catalogue, Material, Model, ModelPart, ModelVertex};
use simworld_core::scene::EntityKind;

const HEAD: &str = "name = \"test\"\nlicence = \"CC0-1.0\"\n";
const POST: &str = "[[asset]]\nname = \"mooring_post\"\nwords = \"an iron mooring post\"\nmodel = \"post.glb\"\nsize = [0.3, 0.3, 0.9]\n";

/// A surface of revolution: radii and heights from the bottom up, closed at both ends.
fn turned(profile: &[(f32, f32)], color: [f32; 3]) -> Model {
    const SIDES: usize = 16;
    let mut model = Model::default();
    let mut put = |position: [f32; 3]| {
        model.vertices.push(ModelVertex {
            position,
            normal: [0.0, 0.0, 1.0],
            color,
            ..ModelVertex::default()
        });
        (model.vertices.len() - 1) as u32
    };
    let bottom = put([0.0, 0.0, profile[0].1]);
    let rings: Vec<Vec<u32>> = profile
        .iter()
        .map(|(radius, height)| {
            (0..SIDES)
                .map(|side| {
                    let (sin, cos) =
                        simworld_core::ops::sin_cos(std::f64::consts::TAU * side as f64 / SIDES as f64);
                    put([radius * cos as f32, radius * sin as f32, *height])
                })
                .collect()
        })
        .collect();
    let top = put([0.0, 0.0, profile[profile.len() - 1].1]);
    for side in 0..SIDES {
        let next = (side + 1) % SIDES;
        model.triangles.push([bottom, rings[0][next], rings[0][side]]);
        for pair in rings.windows(2) {
            model.triangles.push([pair[0][side], pair[0][next], pair[1][next]]);
            model.triangles.push([pair[0][side], pair[1][next], pair[1][side]]);
        }
        let last = &rings[rings.len() - 1];
        model.triangles.push([top, last[side], last[next]]);
    }
    let triangles = model.triangles.len() as u32;
    model.parts.push(ModelPart { name: "body".to_owned(), triangles, ..ModelPart::default() });
    model
}

fn post() -> Model {
    let profile =
        [(0.15, 0.0), (0.15, 0.06), (0.09, 0.1), (0.09, 0.7), (0.15, 0.78), (0.15, 0.86), (0.08, 0.9)];
    turned(&profile, [0.04, 0.04, 0.05])
}

/// The files of the library in `examples/assets/harbour`, made here.
fn harbour() -> Vec<(&'static str, Model)> {
    let buoy = [(0.1, 0.0), (0.45, 0.15), (0.5, 0.45), (0.2, 0.75), (0.08, 1.3), (0.08, 1.5)];
    let pot = [(0.3, 0.0), (0.32, 0.05), (0.32, 0.3), (0.2, 0.42), (0.1, 0.45)];
    vec![
        ("models/mooring_post.glb", post()),
        ("models/buoy.glb", turned(&buoy, [0.6, 0.05, 0.03])),
        ("models/lobster_pot.glb", turned(&pot, [0.25, 0.17, 0.09])),
    ]
}

fn example() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/assets/harbour")
}

fn read(folder: &Path) -> Result<Library, LibraryError> {
    Library::read(folder, &ImportConfig::default(), &LibraryLimits::default())
}

/// A folder with a manifest and a post.
fn folder(rows: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join(MANIFEST), format!("{HEAD}{rows}")).unwrap();
    fs::write(folder.path().join("post.glb"), export_glb(&post())).unwrap();
    folder
}

#[test]
fn the_example_library_is_what_its_recipe_makes() {
    let folder = example();
    if std::env::var_os("SIMWORLD_BLESS").is_some() {
        fs::create_dir_all(folder.join("models")).unwrap();
        for (path, model) in harbour() {
            fs::write(folder.join(path), export_glb(&model)).unwrap();
        }
        let _ = fs::remove_file(folder.join(LOCK));
        fs::write(folder.join(LOCK), read(&folder).unwrap().lock()).unwrap();
    }
    for (path, model) in harbour() {
        assert!(fs::read(folder.join(path)).unwrap() == export_glb(&model), "{path} is another");
    }
    let library = read(&folder).unwrap();
    let names: Vec<&str> = library.assets.iter().map(|asset| asset.name.as_str()).collect();
    assert_eq!(names, ["mooring_post", "buoy", "lobster_pot", "net_rack", "fish_box"]);
    let mut catalogue = Catalogue::library();
    library.add_to(&mut catalogue).unwrap();
    let hits = AssetIndex::of(&catalogue).retrieve("something to tie ships to on the quay", 1);
    assert_eq!(hits[0].name, "mooring_post");
}

#[test]
fn rows_become_assets_with_models_and_without() {
    let rows = format!(
        "{POST}mass = 120.0\nmaterial = \"metal\"\naffords = [\"sit\"]\ntags = [\"bollard\"]\nlicence = \"MIT\"\n\
         [[asset]]\nname = \"drum\"\nkind = \"prop\"\nform = \"cylinder\"\nsize = [0.6, 0.6, 0.9]\n"
    );
    let library = read(folder(&rows).path()).unwrap();
    let [post, drum] = &library.assets[..] else { panic!("{library:?}") };
    assert!(post.model.is_some() && post.validate().is_ok());
    assert!((post.collider.size() - simworld_core::geometry::Vector3::new(0.3, 0.3, 0.9)).norm() < 0.02);
    assert_eq!(
        (post.mass, post.material, post.licence.as_str()),
        (Some(120.0), Some(Material::Metal), "MIT")
    );
    assert!(post.affordances().contains(Affordance::Sit) && post.tags.contains(&"bollard".to_owned()));
    assert_eq!((drum.kind, drum.model.is_none(), drum.licence.as_str()), (EntityKind::Prop, true, "CC0-1.0"));
    assert_eq!(library.files.len(), 2, "manifest and model: {:?}", library.files);
}

#[test]
fn adding_is_whole_or_nothing() {
    let rows = "[[asset]]\nname = \"new_thing\"\nkind = \"prop\"\nsize = [1.0, 1.0, 1.0]\n\
                [[asset]]\nname = \"bench\"\nkind = \"prop\"\nsize = [1.0, 1.0, 1.0]\n";
    let library = read(folder(rows).path()).unwrap();
    let mut catalogue = Catalogue::library();
    let before = catalogue.clone();
    assert!(library.add_to(&mut catalogue).is_err(), "there is another bench");
    assert_eq!(catalogue, before);
}

#[test]
fn the_lock_holds_every_file() {
    let folder = folder(POST);
    let lock = folder.path().join(LOCK);
    fs::write(&lock, read(folder.path()).unwrap().lock()).unwrap();
    assert!(read(folder.path()).is_ok());

    let changed = turned(&[(0.15, 0.0), (0.15, 0.9)], [0.5; 3]);
    fs::write(folder.path().join("post.glb"), export_glb(&changed)).unwrap();
    let error = read(folder.path()).unwrap_err();
    assert!(matches!(&error, LibraryError::Changed { path, .. } if path == "post.glb"), "{error}");

    fs::write(folder.path().join("post.glb"), export_glb(&post())).unwrap();
    let text = fs::read_to_string(&lock).unwrap();
    fs::write(&lock, format!("{text}\"gone.glb\" = \"{:032}\"\n", 0)).unwrap();
    let error = read(folder.path()).unwrap_err();
    assert!(matches!(&error, LibraryError::Unlocked { path, .. } if path == "gone.glb"), "{error}");

    fs::write(&lock, text.lines().filter(|line| !line.contains("post")).collect::<Vec<_>>().join("\n"))
        .unwrap();
    let error = read(folder.path()).unwrap_err();
    assert!(matches!(&error, LibraryError::Unlocked { has: "folder", .. }), "{error}");

    fs::write(&lock, "[files]\n\"post.glb\" = \"12\"\n").unwrap();
    let error = read(folder.path()).unwrap_err().to_string();
    assert!(error.starts_with("library.lock:2:") && error.contains("32 hex digits"), "{error}");
}

#[test]
fn hostile_folders_are_refused() {
    let outside = tempfile::tempdir().unwrap();
    fs::write(outside.path().join("post.glb"), export_glb(&post())).unwrap();
    let refuses = |folder: &Path, what: &str| {
        let error = read(folder).unwrap_err();
        assert!(error.to_string().contains(what), "{what}: {error}");
    };

    let missing = folder(&POST.replace("post.glb", "other.glb"));
    refuses(missing.path(), "no such file");
    let of_folder = folder(&POST.replace("post.glb", "sub.glb"));
    fs::create_dir(of_folder.path().join("sub.glb")).unwrap();
    refuses(of_folder.path(), "no file");
    let garbage = folder(POST);
    fs::write(garbage.path().join("post.glb"), b"glTF\x02\x00\x00\x00\xff\xff\xff\xff").unwrap();
    refuses(garbage.path(), "library.toml:3: post.glb");
    refuses(&outside.path().join("nowhere"), "nowhere");
    refuses(outside.path(), MANIFEST);
    let no_text = folder(POST);
    fs::write(no_text.path().join(MANIFEST), b"name = \"a\"\n\xff").unwrap();
    refuses(no_text.path(), "library.toml:2:");

    #[cfg(unix)]
    {
        use std::os::unix::fs::symlink;
        let linked = folder(&POST.replace("post.glb", "linked.glb"));
        symlink(outside.path().join("post.glb"), linked.path().join("linked.glb")).unwrap();
        refuses(linked.path(), "links are not followed");
        let below = folder(&POST.replace("post.glb", "sub/post.glb"));
        symlink(outside.path(), below.path().join("sub")).unwrap();
        refuses(below.path(), "links are not followed");
        let ring = folder(&POST.replace("post.glb", "ring/post.glb"));
        symlink(ring.path(), ring.path().join("ring")).unwrap();
        refuses(ring.path(), "links are not followed");
        let manifest = tempfile::tempdir().unwrap();
        symlink(folder(POST).path().join(MANIFEST), manifest.path().join(MANIFEST)).unwrap();
        refuses(manifest.path(), "no file of its own");
    }
}

#[test]
fn huge_files_are_not_read() {
    let folder = folder(POST);
    let limits = LibraryLimits { file: 1 << 20, ..LibraryLimits::default() };
    // 4 GiB that take no room on the disk.
    fs::OpenOptions::new()
        .write(true)
        .open(folder.path().join("post.glb"))
        .unwrap()
        .set_len(4 << 30)
        .unwrap();
    let error = Library::read(folder.path(), &ImportConfig::default(), &limits).unwrap_err();
    assert!(matches!(error, LibraryError::Large { limit: 1_048_576, .. }), "{error}");
    let tight = LibraryLimits { total: 300, ..LibraryLimits::default() };
    fs::write(folder.path().join("post.glb"), export_glb(&post())).unwrap();
    let error = Library::read(folder.path(), &ImportConfig::default(), &tight).unwrap_err();
    assert!(matches!(error, LibraryError::Large { .. }), "{error}");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]
    #[test]
    fn any_path_is_refused_or_stays_within(path in "[a-z./:\\\\~ %]{0,20}(\\.glb)?") {
        let row = format!("{HEAD}[[asset]]\nname = \"a\"\nmodel = '{path}'\n");
        if Manifest::read(&row, 1).is_ok() {
            let components: Vec<_> = Path::new(&path).components().collect();
            prop_assert!(components.iter().all(|part| matches!(part, std::path::Component::Normal(_))), "{}", path);
            prop_assert!(!path.contains(':') && !path.contains('\\'), "{}", path);
        }
    }

    #[test]
    fn any_text_is_answered(text in "\\PC{0,200}", rows in "[a-z\\[\\]=\"' \n0-9.]{0,120}") {
        let _ = Manifest::read(&text, 10);
        if let Err(error) = Manifest::read(&format!("{HEAD}[[asset]]\n{rows}"), 10) {
            prop_assert!(error.to_string().starts_with("library.toml:"), "{}", error);
        }
    }
}
