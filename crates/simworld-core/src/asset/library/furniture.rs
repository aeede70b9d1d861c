//! Furniture of streets, squares and terraces.
//!
//! Sizes and masses are those of what is sold: wheelie bins and four-wheeled containers of EN 840, park benches and tables of
//! catalogues of street furniture, the K6 telephone box, signs on posts of 2.2 m clear height (Vienna Convention practice),
//! street lamps of 4 to 12 m (EN 40).

use super::super::row::{Row, boxed, fixed, round, row};
use super::super::{Affordance, Material};
use crate::scene::EntityKind;

use Affordance::{Carry, Open};
use EntityKind::{Bench, Chair, Mailbox, Parcel, Prop, Sign, StreetLamp, Table, TrafficSignal, TrashBin};
use Material::{Concrete, Fabric, Metal, Plastic, Stone, Wood};

#[rustfmt::skip]
pub(super) const ROWS: &[Row] = &[
    row("park_bench", Bench, boxed(0.65, 1.8, 0.85), 55.0, Wood, [0.34, 0.22, 0.12], &["seat", "backrest"]),
    row("stone_bench", Bench, boxed(0.5, 1.8, 0.45), 650.0, Stone, [0.5, 0.5, 0.49], &["seat", "granite"]),
    row("picnic_table", Bench, boxed(1.5, 1.8, 0.75), 70.0, Wood, [0.34, 0.22, 0.12], &["picnic", "table", "seats", "benches"]),
    row("long_bench", Bench, boxed(0.5, 3.0, 0.45), 90.0, Wood, [0.34, 0.22, 0.12], &["seat", "backless"]),
    row("couch", Bench, boxed(0.9, 2.0, 0.85), 60.0, Fabric, [0.28, 0.05, 0.04], &["sofa", "settee", "upholstered"]),
    row("armchair", Chair, boxed(0.85, 0.85, 0.9), 30.0, Fabric, [0.03, 0.11, 0.05], &["seat", "upholstered", "easy"]),
    row("stool", Chair, boxed(0.35, 0.35, 0.45), 3.0, Wood, [0.34, 0.22, 0.12], &["seat", "backless", "small"]),
    row("bar_stool", Chair, boxed(0.4, 0.4, 0.75), 6.0, Metal, [0.55, 0.56, 0.58], &["seat", "high"]),
    row("deck_chair", Chair, boxed(1.1, 0.6, 0.95), 4.0, Fabric, [0.3, 0.45, 0.6], &["beach", "lounger", "sun"]),
    row("folding_chair", Chair, boxed(0.45, 0.45, 0.8), 4.0, Metal, [0.3, 0.3, 0.3], &["seat", "event"]),
    row("plastic_chair", Chair, boxed(0.55, 0.55, 0.82), 3.0, Plastic, [0.8, 0.8, 0.79], &["seat", "garden", "monobloc"]),
    row("round_table", Table, round(0.4, 0.73), 16.0, Metal, [0.55, 0.56, 0.58], &["bistro", "cafe", "terrace"]),
    row("long_table", Table, boxed(0.8, 2.2, 0.75), 35.0, Wood, [0.34, 0.22, 0.12], &["beer", "feast", "dining"]),
    row("coffee_table", Table, boxed(0.6, 1.1, 0.45), 14.0, Wood, [0.1, 0.06, 0.04], &["low", "lounge"]),
    row("market_stall", Prop, boxed(2.0, 3.0, 2.5), 85.0, Wood, [0.34, 0.22, 0.12], &["stand", "booth", "vendor", "market", "awning"]),
    row("food_cart", Prop, boxed(0.9, 2.0, 2.1), 180.0, Metal, [0.5, 0.04, 0.03], &["hot", "dog", "street", "food", "vendor", "stand", "hand", "cart"]),
    row("hand_cart", Prop, boxed(1.3, 0.7, 1.0), 35.0, Wood, [0.34, 0.22, 0.12], &["cart", "barrow", "trolley"]),
    row("hand_truck", Prop, boxed(0.5, 0.5, 1.2), 12.0, Metal, [0.3, 0.3, 0.3], &["dolly", "sack", "barrow"]),
    row("shopping_cart", Prop, boxed(1.0, 0.6, 1.05), 22.0, Metal, [0.55, 0.56, 0.58], &["supermarket", "trolley"]),
    row("wheelbarrow", Prop, boxed(1.4, 0.65, 0.65), 18.0, Metal, [0.03, 0.11, 0.05], &["barrow", "garden", "building", "site"]),
    row("parasol", Prop, round(1.4, 2.5), 28.0, Fabric, [0.7, 0.63, 0.48], &["sunshade", "umbrella", "terrace"]),
    row("awning_tent", Prop, boxed(3.0, 3.0, 2.7), 32.0, Fabric, [0.8, 0.8, 0.79], &["gazebo", "pavilion", "canopy", "event", "party"]),
    row("tent", Prop, boxed(2.4, 2.1, 1.3), 5.0, Fabric, [0.75, 0.25, 0.03], &["camping", "dome"]),
    row("metal_trash_can", TrashBin, round(0.23, 0.7), 9.0, Metal, [0.55, 0.56, 0.58], &["rubbish", "garbage"]),
    row("trash_bin_b", TrashBin, boxed(0.45, 0.6, 1.1), 42.0, Metal, [0.12, 0.12, 0.13], &["rubbish", "litter", "bin", "large"]),
    row("wheelie_bin", TrashBin, boxed(0.74, 0.58, 1.07), 13.0, Plastic, [0.03, 0.11, 0.05], &["rubbish", "household", "waste"]).can(&[Open]),
    row("dumpster", TrashBin, boxed(1.37, 1.07, 1.45), 65.0, Metal, [0.03, 0.11, 0.05], &["skip", "container", "waste", "rubbish"]).can(&[Open]),
    row("recycling_bin", TrashBin, boxed(0.74, 0.58, 1.07), 13.0, Plastic, [0.05, 0.13, 0.45], &["paper", "glass", "bottles", "waste"]).can(&[Open]),
    fixed("recycling_station", TrashBin, boxed(1.2, 3.6, 1.5), Metal, [0.06, 0.25, 0.08], &["bottle", "bank", "glass", "paper", "containers"]),
    row("rubbish_pile", Prop, boxed(1.2, 1.0, 0.6), 40.0, Plastic, [0.12, 0.12, 0.13], &["garbage", "bags", "heap", "trash", "rabbish"]).can(&[]),
    row("garbage_bag", Parcel, boxed(0.45, 0.45, 0.6), 6.0, Plastic, [0.03, 0.03, 0.035], &["rubbish", "sack", "bin", "bag"]),
    fixed("phone_booth", Prop, boxed(0.9, 0.9, 2.4), Metal, [0.5, 0.04, 0.03], &["telephone", "box", "kiosk"]).can(&[Open]),
    fixed("information_board", Sign, boxed(0.15, 1.3, 2.2), Wood, [0.2, 0.12, 0.07], &["notice", "map", "display", "panel"]),
    fixed("billboard", Sign, boxed(0.4, 6.1, 4.5), Metal, [0.8, 0.8, 0.79], &["advertisement", "advertising", "hoarding", "poster"]),
    fixed("advertising_column", Sign, round(0.6, 3.2), Concrete, [0.03, 0.11, 0.05], &["poster", "pillar", "advertisement", "morris", "litfass"]),
    row("chalkboard", Sign, boxed(0.6, 0.6, 1.0), 9.0, Wood, [0.03, 0.03, 0.035], &["menu", "sandwich", "board", "cafe"]).can(&[Carry]),
    fixed("banner", Sign, boxed(0.1, 1.0, 3.0), Fabric, [0.05, 0.13, 0.45], &["flag", "advertising", "event"]),
    fixed("flagpole", Sign, round(0.05, 9.0), Metal, [0.8, 0.8, 0.79], &["flag", "mast"]),
    fixed("stop_sign", Sign, round(0.05, 2.7), Metal, [0.5, 0.04, 0.03], &["traffic", "halt", "octagon", "road"]),
    fixed("speed_limit_sign", Sign, round(0.05, 2.6), Metal, [0.8, 0.8, 0.79], &["traffic", "road"]),
    fixed("yield_sign", Sign, round(0.05, 2.6), Metal, [0.5, 0.04, 0.03], &["give", "way", "traffic", "road", "triangle"]),
    fixed("street_name_sign", Sign, round(0.05, 2.6), Metal, [0.02, 0.05, 0.18], &["signpost", "road"]),
    fixed("no_parking_sign", Sign, round(0.05, 2.5), Metal, [0.05, 0.13, 0.45], &["traffic", "road", "parking"]),
    fixed("direction_sign", Sign, boxed(0.1, 1.4, 2.8), Metal, [0.06, 0.25, 0.08], &["signpost", "wayfinding", "arrow"]),
    fixed("clock_post", Prop, round(0.25, 4.0), Metal, [0.03, 0.11, 0.05], &["street", "clock", "time"]),
    fixed("bicycle_rack", Prop, boxed(0.75, 2.0, 0.8), Metal, [0.55, 0.56, 0.58], &["bike", "stand", "cycle", "parking"]),
    fixed("bollard", Prop, round(0.08, 0.95), Metal, [0.12, 0.12, 0.13], &["post", "barrier"]),
    fixed("stone_bollard", Prop, round(0.2, 0.6), Stone, [0.3, 0.3, 0.3], &["post", "barrier"]),
    fixed("parking_meter", Prop, boxed(0.25, 0.3, 1.55), Metal, [0.3, 0.3, 0.3], &["ticket", "machine", "pay"]),
    fixed("charging_point", Prop, boxed(0.3, 0.45, 1.5), Metal, [0.8, 0.8, 0.79], &["electric", "car", "charger"]),
    row("vending_machine", Prop, boxed(0.8, 0.95, 1.83), 300.0, Metal, [0.5, 0.04, 0.03], &["snack", "drinks", "automat"]),
    row("cash_machine", Prop, boxed(0.8, 0.65, 1.6), 600.0, Metal, [0.05, 0.13, 0.45], &["atm", "bank", "money"]),
    row("newspaper_box", Prop, boxed(0.45, 0.5, 1.3), 40.0, Metal, [0.7, 0.5, 0.05], &["news", "stand", "paper"]).can(&[Open]),
    fixed("newsstand", Prop, boxed(2.0, 2.5, 2.6), Metal, [0.03, 0.11, 0.05], &["kiosk", "newspapers", "magazines"]),
    row("letter_box", Mailbox, boxed(0.35, 0.45, 1.5), 30.0, Metal, [0.5, 0.04, 0.03], &["post", "mail"]).can(&[Open]),
    fixed("parcel_locker", Mailbox, boxed(0.65, 2.4, 2.1), Metal, [0.7, 0.5, 0.05], &["packages", "pick", "up", "station"]).can(&[Open]),
    fixed("park_lantern", StreetLamp, round(0.07, 3.8), Metal, [0.03, 0.11, 0.05], &["light", "post", "park", "path"]),
    fixed("double_street_lamp", StreetLamp, round(0.11, 8.0), Metal, [0.3, 0.3, 0.3], &["light", "post", "boulevard", "two", "arms"]),
    fixed("tall_street_lamp", StreetLamp, round(0.12, 10.0), Metal, [0.55, 0.56, 0.58], &["light", "post", "highway"]),
    fixed("floodlight", StreetLamp, round(0.2, 12.0), Metal, [0.55, 0.56, 0.58], &["stadium", "mast", "light"]),
    fixed("pedestrian_signal", TrafficSignal, round(0.07, 3.0), Metal, [0.12, 0.12, 0.13], &["crossing", "walk", "light"]),
];
