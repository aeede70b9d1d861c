//! Scene files that ask for what cannot be: each fault is told with its file, its line, its row and how to mend it, all at once, and nothing
//! of any size or shape panics or runs away.

use proptest::prelude::*;
use simworld_agents::editing::EditError;
use simworld_agents::scenes::file::{
    At, Fault, Loaded, MOST_BYTES, MOST_LISTED, NoPlaces, Problems, SceneFile, SceneFileError, Thing,
};
use simworld_core::asset::Catalogue;
use simworld_core::scene::Scene;

const SAMPLE: &str = include_str!("../../../../examples/assets/scenes/harbour.scene.toml");

fn load(text: &str) -> Result<Loaded, SceneFileError> {
    SceneFile::parse(text)?.load(&Catalogue::library(), &mut NoPlaces)
}

/// Everything that is wrong with a file of these rows.
fn refused(rows: &str) -> Problems {
    match load(&format!("version = 1\n{rows}")) {
        Err(SceneFileError::Refused(problems)) => problems,
        Err(other) => panic!("{rows}: {other}"),
        Ok(_) => panic!("{rows}: it was not refused"),
    }
}

/// What is wrong with the form of a text.
fn malformed(text: &str) -> String {
    match SceneFile::parse(text) {
        Err(error @ SceneFileError::Form { .. }) => error.to_string(),
        other => panic!("{text}: {other:?}"),
    }
}

#[test]
fn what_is_no_scene_file_is_told_with_its_line() {
    for (text, line, told) in [
        ("", 1, "missing field `version`: write it"),
        ("version = 2", 1, "version 2 of the format is not known: write version = 1"),
        ("\nversion = 3\nfuture = true", 2, "version 3 of the format"),
        ("version = \"one\"", 1, "invalid type"),
        ("version = 1\nthings = 3", 2, "unknown field `things`, expected one of"),
        ("version = 1\n[[thing]]\nasset = \"cone\"\nplace = [0, 0]", 4, "unknown field `place`"),
        ("version = 1\n[[thing]]\nat = [0, 0]", 2, "missing field `asset`: write it"),
        (
            "version = 1\n[[thing]]\nasset = \"cone\"\nat = [0]",
            4,
            "give two numbers, [x, y], or three, [x, y, z]",
        ),
        ("version = 1\n[[thing]]\nasset = \"cone\"\nat = \"here\"", 4, "expected a sequence"),
        (
            "version = 1\n[[thing]]\nasset = \"cone\"\nfacing = \"up\"",
            4,
            "\"up\" is no direction: give degrees",
        ),
        ("version = 1\n[[thing]]\nasset = \"cone\"\nfacing = true", 4, "degrees counter-clockwise from east"),
        (
            "version = 1\n[[thing]]\nasset = \"cone\"\ncolour = \"loud\"",
            4,
            "\"loud\" is no colour that is known",
        ),
        ("version = 1\n[[thing]]\nasset = \"cone\"\ncolour = [1, 0]", 4, "a colour has three numbers"),
        ("version = 1\n[[thing]]\nasset = \"cone\"\ncolour = \"red\"\ncolor = \"red\"", 2, "duplicate field"),
        ("version = 1\n[[thing]]\nasset = \"cone\"\ncount = -1", 4, "docs/scenes.md says what it takes"),
        (
            "version = 1\n[[thing]]\nasset = \"cone\"\ncount = 99999999999",
            4,
            "docs/scenes.md says what it takes",
        ),
        ("version = 1\n[[thing]]\nasset = \"cone\"\nstep = [1, 2, 3]", 4, "give two numbers, [x, y]"),
        ("version = 1\n[environment]\ndate = 2026-02-30", 3, ""),
        ("version = 1\n[environment]\ndate = \"today\"", 3, ""),
        ("version = 1\n[place]\nkind = \"moon\"", 3, "moon"),
        ("version = 1\n[[say]]\nwords = ", 3, ""),
        ("version = 1\nversion = 1", 2, "duplicate key"),
    ] {
        let error = malformed(text);
        assert!(error.starts_with(&format!("scene:{line}: ")) && error.contains(told), "{text}\n{error}");
    }
}

#[test]
fn a_file_is_named_with_its_path() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("harbour.scene.toml");
    let name = path.display().to_string();
    let read = |bytes: &[u8]| {
        std::fs::write(&path, bytes).unwrap();
        SceneFile::read(&path)
    };
    let error = read(b"version = 1\n\n[[thing]]\nasset = \"cone\"\nat = 7").unwrap_err().to_string();
    assert!(error.starts_with(&format!("{name}:5: ")), "{error}");
    let error = read(b"version = 1\ntitle = \"\xff\"").unwrap_err().to_string();
    assert!(error.starts_with(&format!("{name}:2: ")) && error.contains("UTF-8"), "{error}");
    let scene = read(b"version = 1\n\n[[thing]]\nasset = \"bnch\"\nat = [0, 0]").unwrap();
    let error = scene.load(&Catalogue::library(), &mut NoPlaces).unwrap_err().to_string();
    let told = format!("{name}:3: [[thing]] 1 (bnch): no asset is called \"bnch\": perhaps bench");
    assert!(error.starts_with(&told), "{error}");
    let large = vec![b'#'; MOST_BYTES as usize + 1];
    let error = read(&large).unwrap_err();
    assert!(matches!(error, SceneFileError::Large { .. }) && error.to_string().contains("divide the scene"));
    let missing = SceneFile::read(&folder.path().join("none.scene.toml")).unwrap_err();
    assert!(matches!(missing, SceneFileError::Io { .. }) && missing.to_string().contains("none.scene.toml"));
    assert!(matches!(SceneFile::read(folder.path()), Err(SceneFileError::Io { .. })), "a folder is no file");
}

#[test]
fn every_fault_of_a_row_says_what_to_write() {
    for (row, told) in [
        ("asset = \"cone\"", "it is nowhere: write at = [x, y] in metres, or on ="),
        ("asset = \"\"\nat = [0, 0]", "asset = \"\" is empty"),
        ("asset = \"sofa\"\nat = [0, 0]", "no asset is called \"sofa\": perhaps"),
        ("asset = \"qqqqqqqq\"\nat = [0, 0]", "name one of the library, or add the library that has it"),
        ("asset = \"Bench\"\nat = [0, 0]", "perhaps bench"),
        ("asset = \"cone\"\nat = [nan, 0]", "at, east = NaN is out of range: give metres within ±100 000"),
        ("asset = \"cone\"\nat = [0, -inf]", "at, north = -inf is out of range"),
        ("asset = \"cone\"\nat = [1e300, 0]", "at, east = 1e300 is out of range"),
        (
            "asset = \"cone\"\nat = [0, 0, 1e9]",
            "at, up = 1000000000.0 is out of range: give metres within ±10 000",
        ),
        (
            "asset = \"cone\"\nat = [0, 0]\nfacing = 1e6",
            "facing = 1000000.0 is out of range: give -360 to 360",
        ),
        ("asset = \"cone\"\nat = [0, 0]\nscale = -2", "scale = -2.0 is out of range: give 0.05 to 20"),
        ("asset = \"cone\"\nat = [0, 0]\nscale = nan", "scale = NaN is out of range"),
        ("asset = \"cone\"\nat = [0, 0]\ncount = 0", "count = 0.0 is out of range: give 1 to 1000"),
        ("asset = \"cone\"\nat = [0, 0]\ncount = 3", "count needs step"),
        ("asset = \"cone\"\nat = [0, 0]\nstep = [1, 0]", "step is for several things"),
        ("asset = \"cone\"\nat = [0, 0]\ncount = 2\nstep = [1e7, 0]", "step, east = 10000000.0"),
        (
            "asset = \"cone\"\nat = [0, 0]\ncolour = [2, 0, 0]",
            "colour = 2.0 is out of range: give three numbers",
        ),
        ("asset = \"cone\"\nat = [0, 0]\nname = \" \"", "name = \" \" is empty"),
        ("asset = \"cone\"\nat = [0, 0]\nname = \"a\\u0000b\"", "has control characters"),
        (
            "asset = \"cone\"\non = \"desk\"",
            "no thing of this file is called \"desk\": give the thing that it stands on a name",
        ),
    ] {
        let problems = refused(&format!("\n[[thing]]\n{row}\n"));
        let problem = &problems.list[0];
        assert_eq!((problems.count(), problem.at.line), (1, Some(3)), "{row}: {problems}");
        assert!(problem.at.row.starts_with("[[thing]] 1 ("), "{problem}");
        assert!(problem.to_string().contains(told), "{row}: {problem}");
    }
}

#[test]
fn every_fault_of_the_whole_says_what_to_write() {
    for (text, told) in [
        ("title = \"\"", "scene: title = \"\" is empty"),
        ("[place]\n[ground]", "[place] brings its own ground: leave out [place] or [ground]"),
        ("[place]\n[[street]]\npoints = [[0, 0], [90, 0]]", "leave out [place] or every [[street]]"),
        ("[ground]\n[[street]]\npoints = [[0, 0], [90, 0]]", "leave out [ground]"),
        ("[place]\n[place.buildings]\ncount = 0", "scene:2: [place]: buildings.count = 0"),
        ("[ground]\nsize = [-3, 10]", "scene:2: [ground]: ground.size, west to east = -3.0 is out of range"),
        (
            "[ground]\nsize = [10, inf]",
            "ground.size, south to north = inf is out of range: give 1 to 20 000 m",
        ),
        ("[environment]\nhour = 25", "scene:2: [environment]: environment.hour = 25.0"),
        ("[environment]\nweather = \"Hail\"", "there is no weather \"Hail\": give one of Clear"),
        ("[[street]]\npoints = [[0, 0], [90, 0]]\nlanes = 9", "scene:2: [[street]] 1: lanes = 9.0"),
        (
            "[[street]]\npoints = [[0, 0], [90, 0]]\nsidewalk = -1",
            "sidewalk = -1.0 is out of range: give 1 to 20 m",
        ),
        ("[[say]]\nwords = \"\"", "scene:2: [[say]] 1: words = \"\" is empty"),
        ("[[say]]\nwords = \"make it rain\"\nfrom = [nan, 0]", "from, east = NaN"),
    ] {
        let problems = refused(text);
        assert_eq!(problems.count(), 1, "{text}: {problems}");
        assert!(problems.to_string().contains(told), "{text}: {problems}");
    }
}

#[test]
fn everything_that_is_wrong_is_told_at_once_with_its_line() {
    let problems = refused(
        "[environment]\nhour = -1\n[[street]]\npoints = [[0, 0]]\n\
         [[thing]]\nasset = \"bnch\"\nat = [0, 0]\nname = \"seat\"\n\
         [[thing]]\nasset = \"cone\"\nat = [0, 1e9]\nname = \"seat\"\n\
         [[thing]]\nasset = \"cone\"\non = \"seet\"\n",
    );
    let mut lines: Vec<Option<usize>> = problems.iter().map(|problem| problem.at.line).collect();
    lines.sort_unstable();
    assert_eq!(lines, [Some(2), Some(4), Some(6), Some(10), Some(10), Some(14)], "{problems}");
    let told = problems.to_string();
    for part in [
        "6 problems:",
        "\n  scene:14: [[thing]] 3 (cone): no thing of this file is called \"seet\": perhaps seat",
        "\"seat\" is the name of [[thing]] 1 (bnch \"seat\") on line 6 already: give each thing a name of its own",
    ] {
        assert!(told.contains(part), "{told}");
    }
}

#[test]
fn things_that_stand_on_each_other_in_a_circle_are_told_of_once() {
    let on = |name: &str, on: &str| {
        format!("[[thing]]\nasset = \"wooden_crate\"\nname = \"{name}\"\non = \"{on}\"\n")
    };
    let problems = refused(&[on("z", "a"), on("a", "b"), on("b", "c"), on("c", "a")].concat());
    assert_eq!(problems.count(), 1, "{problems}");
    let Fault::Circle { things } = &problems.list[0].fault else { panic!("{problems}") };
    assert_eq!(things.len(), 3, "the one on top of it is no part of it: {things:?}");
    assert_eq!(problems.list[0].at.line, Some(6));
    assert!(problems.to_string().contains("let one of them stand on the ground"));
    let alone = refused(&on("a", "a"));
    assert!(
        matches!(&alone.list[..], [only] if matches!(&only.fault, Fault::Circle { things } if things.len() == 1))
    );
}

#[test]
fn sentences_that_are_not_carried_out_are_told_of_with_their_answers() {
    let problems = refused(
        "[[thing]]\nasset = \"table\"\nname = \"desk\"\nat = [0, 0]\n\
         [[say]]\nwords = \"add a dragon next to the desk\"\n\
         [[say]]\nwords = \"paint the desk green\"\n\
         [[say]]\nwords = \"remove the fountain\"\n",
    );
    let rows: Vec<(Option<usize>, &str)> =
        problems.iter().map(|problem| (problem.at.line, problem.at.row.as_str())).collect();
    assert_eq!(rows, [(Some(6), "[[say]] 1"), (Some(10), "[[say]] 3")], "{problems}");
    let answers: Vec<&EditError> = problems
        .iter()
        .map(|problem| match &problem.fault {
            Fault::Said { answer, .. } => &**answer,
            other => panic!("{other}"),
        })
        .collect();
    assert!(matches!(answers[0], EditError::UnknownThing { .. }), "{problems}");
    assert!(matches!(answers[1], EditError::NotFound { .. }), "{problems}");
    assert!(problems.to_string().contains("\"add a dragon next to the desk\" was not carried out: "));
}

#[test]
fn more_than_a_file_may_hold_is_told_and_not_made() {
    let many = refused("[[thing]]\nasset = \"cone\"\nat = [0, 0]\nstep = [1, 0]\ncount = 1000000000\n");
    assert!(
        many.to_string().contains("1000000000 things: give at most 10000, or divide the scene"),
        "{many}"
    );
    assert!(many.to_string().contains("count = 1000000000.0 is out of range: give 1 to 1000"), "{many}");
    let rows = refused(&"[[thing]]\nasset = \"cone\"\nat = [0, 0]\n".repeat(10_001));
    assert!(rows.to_string().contains("10001 things"), "{rows}");
    let says = refused(&"[[say]]\nwords = \"make it rain\"\n".repeat(201));
    assert!(says.to_string().contains("201 rows of [[say]]: give at most 200"), "{says}");
    let streets = refused(&"[[street]]\npoints = [[0, 0], [90, 0]]\n".repeat(201));
    assert!(streets.to_string().contains("201 rows of [[street]]"), "{streets}");
    let points: Vec<String> = (0..2001).map(|x| format!("[{x}, 0]")).collect();
    let points = refused(&format!("[[street]]\npoints = [{}]\n", points.join(", ")));
    assert!(points.to_string().contains("2001 points of streets"), "{points}");
    let unknown = refused(&"[[thing]]\nasset = \"bnch\"\nat = [0, 0]\n".repeat(1500));
    assert_eq!((unknown.list.len(), unknown.count()), (MOST_LISTED, 1500));
    assert!(unknown.to_string().ends_with("\n  and 500 more"));
}

#[test]
fn a_pile_in_one_place_and_a_high_tower_are_loaded() {
    let heap = SceneFile {
        things: (0..300).map(|_| Thing::new("wooden_crate", At::new(1.0, 2.0))).collect(),
        ..SceneFile::default()
    };
    let loaded = heap.load(&Catalogue::library(), &mut NoPlaces).unwrap();
    assert_eq!(loaded.things.len(), 300);
    assert_eq!(loaded.problems.list.len(), MOST_LISTED, "eight of each, and a thousand of all");
    let tower = (0..500).rev().map(|level: u32| {
        let name = Some(format!("{level}"));
        let below = level.checked_sub(1).map(|below| below.to_string());
        let at = (level == 0).then_some(At::new(0.0, 0.0));
        Thing { name, on: below, at, ..Thing::new("wooden_crate", At::new(0.0, 0.0)) }
    });
    let tower = SceneFile { things: tower.collect(), ..SceneFile::default() };
    let loaded = tower.load(&Catalogue::library(), &mut NoPlaces).unwrap();
    assert!(loaded.problems.is_empty(), "{}", loaded.problems);
    let top = loaded.world.entity(loaded.things[0][0]).expect("it was put there");
    assert!((top.position().z - 499.0 * 0.6).abs() < 1e-6, "{}", top.position());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn any_text_is_a_scene_file_or_refused(text in "(\\PC|[\n\"=\\[\\]]){0,200}") {
        if let Err(error) = SceneFile::parse(&text) {
            prop_assert!(error.to_string().starts_with("scene:"), "{}", error);
        }
    }

    #[test]
    fn a_file_with_some_bytes_changed_is_loaded_or_refused(
        changes in proptest::collection::vec((0..SAMPLE.len(), any::<u8>()), 1..4),
    ) {
        let mut bytes = SAMPLE.as_bytes().to_vec();
        for (at, byte) in changes {
            bytes[at] = byte;
        }
        let text = String::from_utf8_lossy(&bytes);
        if let Ok(scene) = SceneFile::parse(&text) {
            prop_assert_eq!(&SceneFile::parse(&scene.to_toml().unwrap()).unwrap(), &scene);
            match scene.load(&Catalogue::library(), &mut NoPlaces) {
                Ok(loaded) => prop_assert_eq!(loaded.said.len(), scene.says.len()),
                Err(error) => prop_assert!(!error.to_string().is_empty()),
            }
        }
    }
}
