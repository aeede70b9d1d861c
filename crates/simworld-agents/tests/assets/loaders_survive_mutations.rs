//! Files that were sound once: models and manifests with bytes turned, cut, doubled and mixed are read within limits or refused.
//!
//! The bodies are those of the fuzz targets `glb` and `library`. `SIMWORLD_MUTATE_SECONDS` lets each run so long; `SIMWORLD_SEED`
//! begins elsewhere.

#![allow(clippy::disallowed_methods, reason = "how long an input takes is what is looked at")]

use std::path::{Component, Path};
use std::time::{Duration, Instant};

use crate::assets_common::{container, plain_model};
use simworld_agents::assets::{
    GlbLimits, ImportConfig, Moment, Thing, export_glb, import_glb, read_glb, read_glb_at,
};
use simworld_agents::library::Manifest;

/// Runs of each body if no time is named.
const RUNS: u64 = 400;
/// No input may take longer, however busy the machine is.
const LONGEST: Duration = Duration::from_secs(20);

/// Numbers of a seed, by the shifts of Marsaglia.
struct Dice(u64);

impl Dice {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    fn below(&mut self, most: usize) -> usize {
        (self.next() % most.max(1) as u64) as usize
    }
}

/// One to eight changes of some bytes, some of them with pieces of others.
fn mutated(dice: &mut Dice, bytes: &[u8], others: &[Vec<u8>]) -> Vec<u8> {
    const ODD: [&[u8]; 10] = [
        b"-1",
        b"4294967295",
        b"1e308",
        b"null",
        b"[]",
        b"{}",
        b"\0\0\0\0",
        b"\xff\xff\xff\xff",
        b"..",
        b"\"",
    ];
    let mut bytes = bytes.to_vec();
    for _ in 0..=dice.below(8) {
        let at = dice.below(bytes.len());
        let end = (at + dice.below(40)).min(bytes.len());
        match dice.below(7) {
            0 if !bytes.is_empty() => bytes[at] ^= 1 << dice.below(8),
            1 => drop(bytes.drain(at..end)),
            2 => {
                let piece = bytes[at..end].to_vec();
                bytes.splice(at..at, piece);
            }
            3 => {
                let other = &others[dice.below(others.len())];
                let from = dice.below(other.len());
                let to = (from + dice.below(60)).min(other.len());
                bytes.splice(at..end, other[from..to].iter().copied());
            }
            4 => drop(bytes.splice(at..end.min(at + 4), ODD[dice.below(ODD.len())].iter().copied())),
            5 => {
                // A digit stands for another, so that lengths and indices lie.
                if let Some(digit) = bytes.iter_mut().skip(at).find(|byte| byte.is_ascii_digit()) {
                    *digit = b'0' + dice.below(10) as u8;
                }
            }
            _ if dice.below(12) == 0 => bytes.truncate(at),
            _ => {}
        }
    }
    bytes
}

/// Runs a body over changed inputs for as long as is asked, and says how often.
fn run(name: &str, seeds: &[Vec<u8>], body: impl Fn(&[u8]) -> bool) {
    let number = |name: &str| std::env::var(name).ok().and_then(|value| value.parse::<u64>().ok());
    let time = number("SIMWORLD_MUTATE_SECONDS").map(Duration::from_secs);
    let mut dice = Dice(number("SIMWORLD_SEED").unwrap_or(7).wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1);
    let (began, mut runs, mut accepted) = (Instant::now(), 0, 0_u64);
    let mut slowest = Duration::ZERO;
    let mut pool = seeds.to_vec();
    while time.map_or(runs < RUNS, |time| began.elapsed() < time) {
        let seed = dice.below(pool.len());
        let input = mutated(&mut dice, &pool[seed], seeds);
        let start = Instant::now();
        if body(&input) {
            accepted += 1;
            // What was still sound is changed further.
            let place = dice.below(256).max(seeds.len());
            if place < pool.len() {
                pool[place] = input;
            } else {
                pool.push(input);
            }
        }
        slowest = slowest.max(start.elapsed());
        assert!(start.elapsed() < LONGEST, "{name}: run {runs} took {:?}", start.elapsed());
        runs += 1;
    }
    println!(
        "{name}: {runs} runs, {accepted} accepted, the slowest {slowest:?}, in all {:?}",
        began.elapsed()
    );
}

#[test]
fn models_of_strangers_are_surfaces_or_refused() {
    let plain: Vec<(serde_json::Value, Vec<u8>)> = [
        crate::assets_common::cuboid([0.0; 3], [1.0; 3]),
        crate::assets_common::table(),
        crate::assets_common::dented_ball(200, 1.0),
    ]
    .iter()
    .map(plain_model)
    .collect();
    let mut seeds: Vec<Vec<u8>> = plain.iter().map(|(document, bytes)| container(document, bytes)).collect();
    seeds.push(export_glb(&crate::assets_common::table()));
    seeds.extend(["LINEAR", "CUBICSPLINE"].map(|curve| {
        let (document, bytes) = crate::assets_common::bending_bar(curve);
        container(&document, &bytes)
    }));
    seeds.push(crate::assets_common::painted(&crate::assets_common::halves()));
    let (mut document, bytes) = crate::assets_common::painted_document(&crate::assets_common::halves());
    let material = &mut document["materials"][0];
    (material["alphaMode"], material["alphaCutoff"]) = (serde_json::json!("MASK"), serde_json::json!(0.5));
    for kind in ["normalTexture", "occlusionTexture", "emissiveTexture"] {
        material[kind] = serde_json::json!({"index": 0});
    }
    seeds.push(container(&document, &bytes));
    run("glb", &seeds, |data| {
        let limits =
            GlbLimits { triangles: 400, vertices: 1200, nodes: 100, pixels: 1 << 12, ..GlbLimits::default() };
        let moment = Some(Moment { animation: 0, seconds: 2.0 });
        if let Ok(posed) = read_glb_at(data, &limits, moment) {
            assert!(posed.points.iter().all(|point| point.iter().all(|number| number.is_finite())));
        }
        let Ok(surface) = read_glb(data, &limits) else { return false };
        assert!(!surface.triangles.is_empty() && surface.triangles.len() <= 400);
        assert!(surface.points.iter().all(|point| point.iter().all(|number| number.is_finite())));
        assert!(surface.places.iter().flatten().all(|part| part.is_finite()));
        assert!(surface.images.iter().all(|image| image.is_whole() && image.pixels.len() <= 3 << 12));
        let config = ImportConfig { limits, voxels: 16, hulls: 4, tangled: 1.0, ..ImportConfig::default() };
        let thing = Thing { name: "thing".into(), words: "crate".into(), ..Thing::default() };
        if let Ok(imported) = import_glb(data, &thing, &config) {
            imported.asset.validate().expect("what is imported is an asset");
        }
        true
    });
}

#[test]
fn manifests_of_strangers_stay_in_their_folder_or_are_refused() {
    let head = "name = \"test\"\nlicence = \"CC0-1.0\"\n";
    let post = "[[asset]]\nname = \"mooring_post\"\nwords = \"an iron mooring post\"\nmodel = \"post.glb\"\nsize = [0.3, 0.3, 0.9]\n";
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/assets/harbour/library.toml");
    let mut seeds = vec![format!("{head}{post}").into_bytes(), format!("{head}{post}{post}").into_bytes()];
    seeds.push(std::fs::read(folder).expect("the example's manifest is there"));
    seeds.push(format!("{head}[[asset]]\nname = \"x\"\nmodel = \"../a\\\\b:c/../d.glb\"\n").into_bytes());
    run("library", &seeds, |data| {
        let text = String::from_utf8_lossy(data);
        let Ok(manifest) = Manifest::read(&text, 1000) else { return false };
        for row in &manifest.assets {
            let Some(path) = &row.get_ref().model else { continue };
            assert!(
                Path::new(path).components().all(|part| matches!(part, Component::Normal(_))),
                "{path:?}"
            );
            assert!(!path.contains([':', '\\', '\0']), "{path:?}");
        }
        true
    });
}
