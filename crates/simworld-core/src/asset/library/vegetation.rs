//! Trees, shrubs and what else grows, with their colours through the year.
//!
//! A tree's solid is its trunk, as high as the tree. Heights and trunks are those of grown trees along streets and in parks
//! (Roloff, Baeume in der Stadt, 2013; trunk diameter about a fortieth of the height, thicker for broad crowns). The heights of
//! `tree_1` to `tree_6` are those of the boxes that the Python release publishes.

use super::super::row::{Row, boxed, fixed, round, row};
use super::super::standard::LEAFY;
use super::super::{Affordance, Material};
use crate::scene::EntityKind;

use Affordance::Sit;
use EntityKind::{Prop, Shrub, Tree};
use Material::{Foliage, Grass, Stone, Wood};

/// Needles: the same all year, paler in spring.
const EVERGREEN: [[f32; 3]; 4] =
    [[0.06, 0.16, 0.05], [0.03, 0.11, 0.05], [0.03, 0.1, 0.045], [0.03, 0.09, 0.045]];
/// White and pink blossom before the leaves.
const BLOSSOM: [[f32; 3]; 4] = [[0.7, 0.45, 0.5], [0.08, 0.22, 0.06], [0.45, 0.18, 0.03], [0.14, 0.11, 0.08]];
/// Red leaves in autumn.
const MAPLE: [[f32; 3]; 4] = [[0.16, 0.3, 0.07], [0.08, 0.2, 0.06], [0.5, 0.08, 0.02], [0.14, 0.11, 0.08]];
/// Green all year.
const PALM: [[f32; 3]; 4] = [[0.1, 0.24, 0.06], [0.08, 0.22, 0.06], [0.09, 0.2, 0.06], [0.1, 0.18, 0.07]];
/// Whose sizes some rows have.
const RELEASE: &str = "simworld, procedural; named and sized after the Python release";

#[rustfmt::skip]
pub(super) const ROWS: &[Row] = &[
    fixed("oak", Tree, round(0.35, 18.0), Wood, [0.06, 0.25, 0.08], &["broadleaf", "large"]).through(LEAFY),
    fixed("birch", Tree, round(0.15, 15.0), Wood, [0.06, 0.25, 0.08], &["broadleaf", "slender", "white"]).through(LEAFY),
    fixed("maple", Tree, round(0.25, 13.0), Wood, [0.06, 0.25, 0.08], &["broadleaf"]).through(MAPLE),
    fixed("lime", Tree, round(0.3, 16.0), Wood, [0.06, 0.25, 0.08], &["broadleaf", "linden", "avenue"]).through(LEAFY),
    fixed("beech", Tree, round(0.35, 20.0), Wood, [0.06, 0.25, 0.08], &["broadleaf", "large"]).through(LEAFY),
    fixed("chestnut", Tree, round(0.35, 17.0), Wood, [0.06, 0.25, 0.08], &["broadleaf", "large"]).through(LEAFY),
    fixed("cherry_tree", Tree, round(0.15, 6.0), Wood, [0.06, 0.25, 0.08], &["blossom", "fruit"]).through(BLOSSOM),
    fixed("apple_tree", Tree, round(0.14, 5.0), Wood, [0.06, 0.25, 0.08], &["blossom", "fruit", "orchard"]).through(BLOSSOM),
    fixed("willow", Tree, round(0.3, 12.0), Wood, [0.06, 0.25, 0.08], &["weeping", "riverside"]).through(LEAFY),
    fixed("poplar", Tree, round(0.25, 22.0), Wood, [0.06, 0.25, 0.08], &["avenue", "slender", "tall"]).through(LEAFY),
    fixed("elm", Tree, round(0.3, 18.0), Wood, [0.06, 0.25, 0.08], &["broadleaf"]).through(LEAFY),
    fixed("pine", Tree, round(0.2, 16.0), Wood, [0.03, 0.11, 0.05], &["conifer", "evergreen", "needle"]).through(EVERGREEN),
    fixed("spruce", Tree, round(0.2, 18.0), Wood, [0.03, 0.11, 0.05], &["conifer", "evergreen", "needle", "fir"]).through(EVERGREEN),
    fixed("cypress", Tree, round(0.15, 12.0), Wood, [0.03, 0.11, 0.05], &["conifer", "evergreen", "slender"]).through(EVERGREEN),
    fixed("palm_tree", Tree, round(0.2, 9.0), Wood, [0.06, 0.25, 0.08], &["tropical", "beach", "palm"]).through(PALM),
    fixed("olive_tree", Tree, round(0.2, 5.0), Wood, [0.25, 0.29, 0.24], &["evergreen", "mediterranean", "fruit"]).through(PALM),
    fixed("sapling", Tree, round(0.03, 2.5), Wood, [0.06, 0.25, 0.08], &["young", "small"]).through(LEAFY),
    fixed("dead_tree", Tree, round(0.2, 9.0), Wood, [0.27, 0.23, 0.19], &["bare", "leafless", "withered"]),
    fixed("christmas_tree", Tree, round(0.1, 5.0), Wood, [0.03, 0.11, 0.05], &["fir", "conifer", "festive"]).through(EVERGREEN),
    fixed("tree_1", Tree, round(0.22, 17.9), Wood, [0.06, 0.25, 0.08], &["broadleaf"]).through(LEAFY).from(RELEASE),
    fixed("tree_2", Tree, round(0.21, 16.5), Wood, [0.06, 0.25, 0.08], &["broadleaf"]).through(LEAFY).from(RELEASE),
    fixed("tree_3", Tree, round(0.22, 17.4), Wood, [0.06, 0.25, 0.08], &["broadleaf"]).through(LEAFY).from(RELEASE),
    fixed("tree_4", Tree, round(0.17, 13.6), Wood, [0.06, 0.25, 0.08], &["broadleaf"]).through(LEAFY).from(RELEASE),
    fixed("tree_5", Tree, round(0.16, 12.6), Wood, [0.06, 0.25, 0.08], &["broadleaf"]).through(LEAFY).from(RELEASE),
    fixed("tree_6", Tree, round(0.21, 16.5), Wood, [0.06, 0.25, 0.08], &["broadleaf"]).through(LEAFY).from(RELEASE),
    fixed("box_hedge", Shrub, boxed(0.5, 2.0, 1.0), Foliage, [0.03, 0.11, 0.05], &["clipped", "topiary"]).through(EVERGREEN),
    fixed("tall_hedge", Shrub, boxed(0.8, 3.0, 2.0), Foliage, [0.03, 0.11, 0.05], &["privet", "screen"]).through(EVERGREEN),
    fixed("rose_bush", Shrub, boxed(0.8, 0.8, 1.1), Foliage, [0.5, 0.04, 0.03], &["roses", "flowers"]).through(LEAFY),
    fixed("lavender", Shrub, boxed(0.6, 0.6, 0.5), Foliage, [0.25, 0.29, 0.24], &["flowers", "herb", "purple"]).through(PALM),
    fixed("flower_bed", Shrub, boxed(1.2, 3.0, 0.3), Foliage, [0.55, 0.3, 0.28], &["flowers", "blossoms"]).through(LEAFY),
    fixed("tulip_bed", Shrub, boxed(1.0, 2.0, 0.35), Foliage, [0.5, 0.04, 0.03], &["flowers", "tulips"]).through(LEAFY),
    fixed("fern", Shrub, boxed(0.8, 0.8, 0.6), Foliage, [0.06, 0.25, 0.08], &["forest", "undergrowth"]).through(LEAFY),
    fixed("reeds", Shrub, boxed(0.8, 1.5, 1.6), Foliage, [0.25, 0.29, 0.24], &["waterside", "pond"]).through(LEAFY),
    fixed("tall_grass", Shrub, boxed(0.8, 0.8, 0.9), Foliage, [0.25, 0.29, 0.24], &["meadow", "tuft", "ornamental"]).through(LEAFY),
    fixed("bamboo", Shrub, boxed(1.0, 1.0, 4.0), Foliage, [0.06, 0.25, 0.08], &["evergreen", "screen", "cane"]).through(PALM),
    fixed("cactus", Shrub, boxed(0.4, 0.4, 1.8), Foliage, [0.06, 0.25, 0.08], &["desert", "succulent"]).through(PALM),
    fixed("ivy_wall", Shrub, boxed(0.3, 2.0, 2.2), Foliage, [0.03, 0.11, 0.05], &["climber", "creeper"]).through(EVERGREEN),
    fixed("tree_stump", Prop, round(0.3, 0.45), Wood, [0.2, 0.12, 0.07], &["cut", "trunk"]).can(&[Sit]),
    row("fallen_log", Prop, boxed(3.0, 0.4, 0.4), 190.0, Wood, [0.2, 0.12, 0.07], &["trunk", "timber", "driftwood"]).can(&[Sit]),
    row("flower_pot", Prop, round(0.2, 0.4), 12.0, Stone, [0.27, 0.11, 0.07], &["flowers", "terracotta", "potted", "plant"]),
    fixed("lawn", Prop, boxed(6.0, 6.0, 0.05), Grass, [0.06, 0.25, 0.08], &["turf", "grass", "meadow"]),
    row("boulder", Prop, boxed(1.2, 0.9, 0.8), 1400.0, Stone, [0.3, 0.3, 0.3], &["rock", "stone"]).can(&[Sit]),
];
