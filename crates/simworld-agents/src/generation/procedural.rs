//! The offline generator: a grammar of everyday things.

use std::sync::Arc;

use simworld_core::asset::{Asset, Material};
use simworld_core::hash::StateHasher;
use simworld_core::scene::{EntityKind, Shape};
use simworld_core::seed::{Seed, StreamRng};

use super::reading::{Order, checked_size, read};
use super::sculpt::{Cast, Sculpt};
use super::stuff::Stuff;
use super::thing::{Plan, Takes, Usual};
use super::{AssetGenerator, AssetPrompt, GenerateError, Made};

/// How much a side that nobody gave differs from the usual, by chance.
const VARIATION: f64 = 0.05;

/// Makes everyday things from words: furniture, street furniture, what stands in gardens, parks and squares, small
/// buildings, trees.
///
/// Words change size ("tall", "2 m high"), colour, material, shape ("round"), numbers of parts ("three-legged", "with five
/// boards") and what is there ("without a backrest"). What it makes is a function of the words, the seed and the sizes asked
/// for: the same bits every time.
///
/// ```
/// use simworld_agents::generation::{AssetGenerator, AssetPrompt, GenerateError, ProceduralGenerator};
/// let mut generator = ProceduralGenerator::new();
/// let made = generator.generate(&AssetPrompt::new("a tall green lamp post by candlelight"))?;
/// assert!(made.asset.collider.size().z > 5.5);
/// assert_eq!(made.unused, ["by", "candlelight"]);
/// let error = generator.generate(&AssetPrompt::new("a zeppelin")).unwrap_err();
/// assert!(matches!(error, GenerateError::Unknown { .. }));
/// # Ok::<(), GenerateError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ProceduralGenerator;

/// A thing of the grammar, as people may read it.
#[derive(Clone, Debug, PartialEq)]
pub struct KnownThing {
    /// What it is called.
    pub name: &'static str,
    /// Other names for it.
    pub other_names: &'static [&'static str],
    /// What it is in a world.
    pub kind: EntityKind,
    /// Usual length (x), width (y) and height, m.
    pub size: [f64; 3],
    /// The least and the greatest mass that is plausible at that size, kg.
    pub mass: [f64; 2],
    /// Words that change it beside those of size and colour, each in a prompt that uses it.
    pub prompts: Vec<String>,
}

impl ProceduralGenerator {
    /// The generator; it keeps nothing.
    pub fn new() -> Self {
        Self
    }

    /// Everything that it can make.
    pub fn things() -> impl Iterator<Item = KnownThing> {
        super::things::all().map(|thing| KnownThing {
            name: thing.names[0],
            other_names: &thing.names[1..],
            kind: thing.kind,
            size: thing.size,
            mass: thing.mass,
            prompts: thing.takes.iter().map(|takes| takes.prompt(thing.names[0])).collect(),
        })
    }
}

impl Takes {
    /// A prompt for a thing in which words change just this.
    fn prompt(&self, name: &str) -> String {
        match self {
            Self::Material => format!("concrete {name}"),
            Self::Round => format!("round {name}"),
            Self::Square => format!("square {name}"),
            Self::Accent => format!("white {name} with green stripes"),
            Self::Count { of, usual, least, most } => {
                let other = if usual < most { usual + 1 } else { *least };
                format!("{name} with {other} {}", of[0])
            }
            Self::Feature { what, usual: Usual::With } => format!("{name} without {}", what[0]),
            Self::Feature { what, .. } => format!("{name} with {}", what[0]),
        }
    }
}

impl AssetGenerator for ProceduralGenerator {
    fn name(&self) -> &'static str {
        "procedural"
    }

    fn generate(&mut self, prompt: &AssetPrompt) -> Result<Made, GenerateError> {
        if prompt.shows_something() {
            return Err(GenerateError::Image { generator: self.name().to_owned() });
        }
        let words = prompt.checked_words()?;
        let mut order = read(words)?;
        let hints = [prompt.size.length, prompt.size.width, prompt.size.height];
        for (axis, hint) in hints.into_iter().enumerate() {
            if let Some(size) = hint {
                order.exact[axis] = Some(checked_size(order.thing, axis, size)?);
            }
        }
        let stream = Seed(prompt.seed).stream("agents/generation").named(order.thing.names[0]);
        let mut plan = planned(&order, stream.rng())?;
        let mut sculpt = Sculpt::new(plan.main());
        (order.thing.make)(&mut sculpt, &mut plan);
        let cast = sculpt.cast(order.exact);
        let asset = asset_of(&order, &plan, cast, words, prompt);
        asset.validate().map_err(|error| GenerateError::Asset { words: words.to_owned(), error })?;
        Ok(Made { asset, unused: order.unused })
    }
}

/// The size and everything else that is settled before the thing is made.
fn planned(order: &Order, mut rng: StreamRng) -> Result<Plan, GenerateError> {
    let usual = order.thing.size;
    let mut draw = || 1.0 + rng.uniform(-VARIATION, VARIATION);
    let (x, y, z) = (draw(), draw(), draw());
    // What is as long as wide stays so.
    let varied = [x, if usual[0] == usual[1] { x } else { y }, z];
    let mut size = [0.0; 3];
    for axis in 0..3 {
        size[axis] = match order.exact[axis] {
            Some(exact) => exact,
            None => checked_size(order.thing, axis, usual[axis] * order.factors[axis])? * varied[axis],
        };
    }
    Ok(Plan {
        size,
        stuff: order.stuff.unwrap_or(order.thing.stuff),
        stuff_is_said: order.stuff.is_some(),
        accent: order.accent,
        style: order.style,
        counts: order.counts.clone(),
        features: order.features.clone(),
        rng,
    })
}

fn asset_of(order: &Order, plan: &Plan, cast: Cast, words: &str, prompt: &AssetPrompt) -> Asset {
    let thing = order.thing;
    let [length, width, height] = cast.size;
    let collider = if cast.round {
        Shape::Cylinder { radius: length.max(width) * 0.5, height }
    } else {
        Shape::cuboid(length, width, height)
    };
    let mut digest = StateHasher::new();
    digest.bytes(words.as_bytes()).u64(prompt.seed);
    for size in [prompt.size.length, prompt.size.width, prompt.size.height] {
        digest.f64(size.unwrap_or(0.0));
    }
    let name = format!("{}_{:012x}", thing.names[0].replace([' ', '-'], "_"), digest.finish().0 >> 16);
    let asset = Asset::new(name, thing.kind, collider).tagged(thing.names.iter().copied());
    let stuff = plan.stuff;
    let color = order.color.or(thing.color).unwrap_or(stuff.color());
    Asset {
        mass: Some(cast.mass),
        material: Some(material_of(stuff)),
        color: Some(color),
        source: format!("procedural, seed {}: {words}", prompt.seed),
        licence: "MIT OR Apache-2.0".to_owned(),
        model: Some(Arc::new(cast.model)),
        ..asset.tagged(order.tags.iter().map(String::as_str))
    }
}

/// What physics knows it as.
fn material_of(stuff: Stuff) -> Material {
    match stuff {
        Stuff::Wood => Material::Wood,
        Stuff::Metal | Stuff::Iron => Material::Metal,
        Stuff::Stone | Stuff::Marble => Material::Stone,
        Stuff::Concrete => Material::Concrete,
        Stuff::Brick | Stuff::Clay => Material::Brick,
        Stuff::Plastic => Material::Plastic,
        Stuff::Glass => Material::Glass,
        Stuff::Fabric => Material::Fabric,
        Stuff::Straw | Stuff::Leaves | Stuff::Stem => Material::Foliage,
        Stuff::Snow | Stuff::Water => Material::Ice,
        Stuff::Soil => Material::Soil,
        Stuff::Sand => Material::Sand,
        Stuff::Rubber => Material::Rubber,
    }
}
