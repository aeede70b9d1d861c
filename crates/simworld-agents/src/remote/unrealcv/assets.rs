//! Assets of the release by the paths of their classes, as assets of the catalogue.

use simworld_core::asset::{Asset, Catalogue};
use simworld_core::id::AssetId;
use simworld_core::scene::Scene;

/// What the release's own classes are here: a part of the path in small letters, and the asset.
const KNOWN: &[(&str, &str)] = &[
    ("base_user_agent", "person"),
    ("base_pedestrian", "person"),
    ("humanoid", "person"),
    ("spotrobot", "robot_dog"),
    ("robot_dog", "robot_dog"),
    ("scooter", "scooter"),
    ("street_light", "traffic_signal"),
    ("trafficsignal", "traffic_signal"),
];

/// Words of a path that people would not say, and what is meant by others.
const SAID: &[(&str, &str)] = &[
    ("vehicle", "car"),
    ("auto", "car"),
    ("pedestrian", "person"),
    ("lamp", "light"),
    ("trashcan", "trash"),
];

/// Classes that stand for the engine itself.
pub(super) fn is_manager(path: &str) -> bool {
    let path = path.to_ascii_lowercase();
    ["manager", "intersection"].iter().any(|part| last_segment(&path).contains(part))
}

/// The asset that a class is here, with its id if the scene has it.
pub(super) fn asset_of(scene: &dyn Scene, path: &str) -> Option<(Option<AssetId>, Asset)> {
    let standard = Catalogue::standard();
    let own = scene.assets().filter(|assets| !assets.is_empty());
    let in_own = own.and_then(|assets| Some((best(assets, path)?, assets)));
    if let Some((id, assets)) = in_own {
        return assets.get(id).map(|asset| (Some(id), asset.clone()));
    }
    let id = best(&standard, path)?;
    standard.get(id).map(|asset| (None, asset.clone()))
}

fn best(assets: &Catalogue, path: &str) -> Option<AssetId> {
    let small = path.to_ascii_lowercase();
    if let Some(id) = assets.find(&small) {
        return Some(id);
    }
    let known = KNOWN.iter().find(|(part, _)| small.contains(part)).and_then(|(_, name)| assets.find(name));
    // The last part of a path says most, and each folder less.
    known.or_else(|| {
        path.rsplit('/').map(words).find_map(|words| {
            words.iter().find_map(|word| assets.find(word)).or_else(|| assets.best_match(&words))
        })
    })
}

fn last_segment(path: &str) -> &str {
    path.rsplit('/').next().unwrap_or(path)
}

/// The words of a name such as `BP_FireHydrant.BP_FireHydrant_C`.
fn words(segment: &str) -> Vec<String> {
    let name = segment.split('.').next().unwrap_or(segment);
    let (mut words, mut word, mut was_small) = (Vec::new(), String::new(), false);
    for letter in name.chars().chain(['_']) {
        let begins = letter.is_uppercase() && was_small;
        if !letter.is_alphanumeric() || begins {
            words.extend(Some(std::mem::take(&mut word)).filter(|word| word.len() > 2));
        }
        if letter.is_alphanumeric() {
            word.extend(letter.to_lowercase());
        }
        was_small = letter.is_lowercase();
    }
    for word in &mut words {
        if let Some((_, meant)) = SAID.iter().find(|(said, _)| said == word) {
            *word = (*meant).to_owned();
        }
    }
    words
}

#[cfg(test)]
mod tests {
    use simworld_core::scene::World;

    use super::*;

    fn name_of(path: &str) -> Option<String> {
        asset_of(&World::new(), path).map(|(_, asset)| asset.name)
    }

    #[test]
    fn classes_of_the_release_are_found() {
        for (path, name) in [
            ("/Game/TrafficSystem/Pedestrian/Base_User_Agent.Base_User_Agent_C", "person"),
            ("/Game/TrafficSystem/Pedestrian/Base_Pedestrian.Base_Pedestrian_C", "person"),
            ("/Game/Robot_Dog/Blueprint/BP_SpotRobot.BP_SpotRobot_C", "robot_dog"),
            ("/Game/city_props/BP/props/street_light/BP_street_light.BP_street_light_C", "traffic_signal"),
            ("/Game/city_props/BP/props/BP_FireHydrant.BP_FireHydrant_C", "hydrant"),
            ("/Game/TrafficSystem/Vehicle/BP_Hatchback.BP_Hatchback_C", "small_car"),
            ("/Game/TrafficSystem/Vehicle/BP_X12.BP_X12_C", "car"),
            ("bench", "bench"),
        ] {
            assert_eq!(name_of(path).as_deref(), Some(name), "{path}");
        }
        assert_eq!(name_of("/Game/Zeppelin/BP_Zeppelin.BP_Zeppelin_C"), None);
        assert!(is_manager("/Game/Weather/BP_WeatherManager.BP_WeatherManager_C"));
        assert!(!is_manager("/Game/Weather/BP_Tree.BP_Tree_C"));
    }
}
